#!/usr/bin/env python3
"""Compares this library with heyoka by tolerances alone, and writes a section of BENCHMARKS.md.

    python3 benches/peers/tolerances.py           all problems
    python3 benches/peers/tolerances.py kepler    one problem, its old rows replaced
    python3 benches/peers/tolerances.py --report  the section from the rows that are there

Both programs run in turns, and each row keeps its least median, so that both have the quiet moments of the machine.
"""

import json
import math
import sys

import report
import run

TITLES = {
    "kepler": "Kepler, e = 0.6, 1000 periods",
    "encounter": "Kepler, e = 0.9, 100 periods",
    "grazing": "Kepler, e = 0.99, 20 periods",
    "henon_heiles": "Hénon–Heiles, to t = 10⁴",
    "pendulum": "a pendulum, to t = 10⁴",
    "coupled": "H = ½(q² + 1)(p² + 1), to t = 10⁴",
    "planets": "the outer solar system, 1000 years",
    "black_hole": "round a black hole, to τ = 10⁴",
    "arenstorf": "Arenstorf's orbit, one period",
    "figure_eight": "three bodies on an eight, 100 periods",
    "burrau": "Burrau's three bodies, to t = 10 *",
    "double_pendulum": "a double pendulum, to t = 50 *",
    "dipole": "a charge near a magnetic dipole, to t = 1000 *",
    "duffing": "Duffing's oscillator, driven, to t = 100 *",
    "volterra": "Lotka and Volterra, to t = 1000 *",
    "atoms": "two atoms, Lennard-Jones, to t = 1000 *",
}
GOALS = (1e-3, 1e-6, 1e-9, 1e-11)
ROUNDS = 1
PROBLEMS, ROWS = run.OUT / "tolerance_problems.jsonl", run.OUT / "tolerance_rows.jsonl"


def measure(wanted):
    program = run.built("ours", "--bin", "tolerances")
    commands = ([program], [run.environment(), run.HERE / "heyoka_peer.py"])
    problems = {line["problem"]: line for line in run.kept(PROBLEMS, wanted, False)}
    rows = {key(line): line for line in run.kept(ROWS, wanted, False)}
    for name in wanted or TITLES:
        for turn in range(ROUNDS):
            print(name, turn, flush=True)
            for command in commands:
                done = run.pinned([*command, name], stdout=run.subprocess.PIPE, problems=PROBLEMS)
                for line in run.lines(done.stdout):
                    if "reference" in line:
                        problems[name] = line
                        continue
                    old = rows.get(key(line))
                    if old is None or line.get("seconds", math.inf) < old.get("seconds", math.inf):
                        rows[key(line)] = line
                run.write(PROBLEMS, problems.values())
        run.write(ROWS, rows.values())


def key(row):
    return row["problem"], row["peer"], row["setting"], row.get("fused", False)


def seconds_at(rows, goal):
    """The time at an error, on the straight lines between rows in logarithms; None outside of them."""
    edge = sorted(report.edge([row for row in rows if row.get("error")]), key=lambda row: row["error"])
    if edge and goal >= edge[-1]["error"]:
        return edge[-1]["seconds"]
    for fine, coarse in zip(edge, edge[1:]):
        if fine["error"] <= goal <= coarse["error"]:
            part = math.log(goal / fine["error"]) / math.log(coarse["error"] / fine["error"])
            return fine["seconds"] * (coarse["seconds"] / fine["seconds"]) ** part
    return None


def cell(rows, goal):
    """Times of both and their ratios, unfused and fused."""
    ours = [row for row in rows if row["peer"] == "hamiltonian"]
    taylor = seconds_at([row for row in rows if row["peer"] == "heyoka"], goal)
    unfused = seconds_at([row for row in ours if not row["fused"]], goal)
    fused = seconds_at([row for row in ours if row["fused"]], goal)
    if taylor is None or unfused is None:
        return "–"
    text = f"**{taylor / unfused:.2f}**" if taylor < unfused else f"{taylor / unfused:.2f}"
    return text + (f", {taylor / fused:.2f}" if fused else "")


def section(rows):
    out = ["## By a tolerance alone", "",
           "heyoka's CPU time in units of this library's at equal errors of the end point, unfused and fused: above 1 "
           "this library is faster. Nothing but the tolerance was chosen on either side (`Integrator::to_tolerance` and "
           "`taylor_adaptive(tol=…)`). The time at an error lies on the work–precision curve between two tolerances, "
           "straight in logarithms; where all tolerances have a smaller error, it is that of the fastest. A dash means "
           "that one program does not reach the error. Compilation is not counted, nor is the construction of heyoka's "
           "integrator. This library's time includes the start of the run, in which it chooses steps (58 000 instructions "
           "for a pendulum); coefficients are computed once in a program. Problems with a star were chosen before they "
           "were measured. `python3 benches/peers/tolerances.py` makes these numbers again.", "",
           "| problem | " + " | ".join(map(report.number, GOALS)) + " |", "|---|" + "---|" * len(GOALS)]
    for name, title in TITLES.items():
        own = [row for row in rows if row["problem"] == name and "seconds" in row]
        if own:
            out.append(f"| {title} | " + " | ".join(cell(own, goal) for goal in GOALS) + " |")
    return "\n".join(out)


def main():
    wanted = [word for word in sys.argv[1:] if not word.startswith("--")]
    run.OUT.mkdir(parents=True, exist_ok=True)
    if "--report" not in sys.argv:
        measure(wanted)
    text = section(run.lines(ROWS.read_text(encoding="utf-8")))
    report.replace(run.ROOT / "BENCHMARKS.md", report.TOLERANCES, text)


if __name__ == "__main__":
    main()
