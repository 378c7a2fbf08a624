#!/usr/bin/env python3
"""Runs the comparison with other programs and writes BENCHMARKS.md and a table of the book.

    python3 benches/peers/run.py            all peers, all problems
    python3 benches/peers/run.py kepler     one problem, its old rows replaced
    python3 benches/peers/run.py --ours     this library alone, its old rows replaced
    python3 benches/peers/run.py --report   the report from the rows that are there

Everything is pinned: packages from PyPI in a virtual environment of `requirements.txt`, Rust packages by their
`Cargo.lock`, Julia's by `Project.toml` where Julia is installed. One process runs at a time, with one thread, on one
core. Results are kept in `target/peers/`; run it when nothing else runs.
"""

import json
import os
import platform
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import report

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
OUT = ROOT / "target" / "peers"
VERSION = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
PROBLEMS, ROWS = OUT / "problems.jsonl", OUT / "rows.jsonl"
SCRIPTS = ("heyoka_peer.py", "rebound_peer.py", "scipy_peer.py", "numba_peer.py")


def pinned(command, problems=PROBLEMS, **options):
    """The command on one core, with one thread, and with a file of problems."""
    if shutil.which("taskset"):
        core = max(os.sched_getaffinity(0))
        command = ["taskset", "-c", str(core), *command]
    threads = {name: "1" for name in (
        "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "RAYON_NUM_THREADS",
        "JULIA_NUM_THREADS")}
    environment = {**os.environ, **threads, "PROBLEMS": str(problems)}
    return subprocess.run([str(part) for part in command], env=environment, text=True, cwd=HERE, **options)


def environment():
    """The Python of the virtual environment."""
    folder = OUT / "venv"
    python = folder / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    subprocess.run([python, "-m", "pip", "install", "--quiet", "-r", HERE / "requirements.txt"], check=True)
    return python


def built(name, *options):
    target = OUT / "rust"
    manifest = HERE / name / "Cargo.toml"
    command = ["cargo", "build", "--release", "--manifest-path", manifest, "--target-dir", target, *options]
    subprocess.run(command, check=True)
    return target / "release" / (options[-1] if options else f"peers-{name}")


def lines(text):
    return [json.loads(line) for line in text.splitlines() if line.startswith("{")]


def write(file, content):
    file.write_text("".join(json.dumps(line) + "\n" for line in content), encoding="utf-8")


def kept(file, wanted, alone):
    """The lines of other problems than those that are made anew, or of other programs than this library."""
    old = lines(file.read_text(encoding="utf-8")) if file.exists() and (wanted or alone) else []
    return [line for line in old
            if wanted and line["problem"] not in wanted or alone and line.get("peer", "hamiltonian") != "hamiltonian"]


def peers():
    """The commands of the peers that can run here, with their names."""
    python = environment()
    commands = [("diffsol", [built("diffsol")]), *((script, [python, HERE / script]) for script in SCRIPTS)]
    if shutil.which("julia"):
        setup = ["julia", f"--project={HERE}", "-e", "using Pkg; Pkg.instantiate()"]
        subprocess.run(setup, check=True)
        commands.append(("julia", ["julia", f"--project={HERE}", HERE / "julia_peer.jl"]))
    else:
        print("julia is not installed: its packages are left out", flush=True)
    return commands


def main():
    wanted = [word for word in sys.argv[1:] if not word.startswith("--")]
    OUT.mkdir(parents=True, exist_ok=True)
    if "--report" not in sys.argv:
        alone = "--ours" in sys.argv
        # This library is first: it makes the references as well.
        commands = [("hamiltonian", [built("ours", "--bin", "peers-ours")]), *([] if alone else peers())]
        problems, rows = kept(PROBLEMS, wanted, alone), kept(ROWS, wanted, alone)
        for name, command in commands:
            for problem in wanted or [""]:
                print(name, problem, flush=True)
                done = pinned([*command, *([problem] if problem else [])], stdout=subprocess.PIPE)
                if done.returncode:
                    print(f"{name} ended with status {done.returncode}: its rows so far are kept")
                for line in lines(done.stdout):
                    line.setdefault("version", VERSION)
                    (problems if "reference" in line else rows).append(line)
                write(PROBLEMS, problems)
                write(ROWS, rows)
    report.write(lines(PROBLEMS.read_text(encoding="utf-8")), lines(ROWS.read_text(encoding="utf-8")), machine(), ROOT)


def machine():
    """The processor's name."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
        names = [line.split(":")[1].strip() for line in text.splitlines() if line.startswith("model name")]
        return names[0]
    except (OSError, IndexError):
        return platform.processor() or platform.machine()


if __name__ == "__main__":
    main()
