"""The package: the time of its import, and its documentation."""

import doctest
import pathlib
import subprocess
import sys

import hamiltonian as hm
import hamiltonian.functions
import hamiltonian.system
import pytest

CPU = "import time, numpy; start = time.process_time(); import hamiltonian; print(time.process_time() - start)"


def test_import_takes_at_most_50_ms_beyond_numpy():
    runs = [subprocess.run([sys.executable, "-c", CPU], capture_output=True, text=True, check=True) for _ in range(5)]
    assert min(float(run.stdout) for run in runs) <= 0.05


def test_other_packages_are_imported_by_their_users_alone():
    code = "import sys, hamiltonian; print([name for name in ('sympy', 'matplotlib', 'tqdm', 'scipy') if name in sys.modules])"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_examples_of_the_documentation():
    for module in (hm, hamiltonian.functions, hamiltonian.system):
        failed, _ = doctest.testmod(module)
        assert failed == 0


def test_types_are_declared():
    assert (pathlib.Path(hm.__file__).parent / "py.typed").exists()


def test_every_public_name_is_documented():
    for name in hm.__all__:
        public = getattr(hm, name)
        assert public.__doc__, name
        own = [] if not isinstance(public, type) else [member for member in vars(public).items() if member[0][0] != "_"]
        for member, value in own:
            assert not (callable(value) or isinstance(value, property)) or value.__doc__, f"{name}.{member}"


def test_the_command_runs_a_file(tmp_path):
    text = "H(x; p) = p^2/2 + x^2/2\n---\nstart x = 1, p = 0\nrun t = 0..1, every = 0.5, tolerance = 1e-10\n"
    (tmp_path / "spring.ham").write_text(text, encoding="utf-8")

    def run(*arguments):
        command = [sys.executable, "-m", "hamiltonian", *arguments]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)

    done = run("spring.ham")
    assert done.returncode == 0 and done.stdout.splitlines()[0] == "t,x,p,H" and len(done.stdout.splitlines()) == 4
    failed = run("missing.ham")
    assert failed.returncode == 1 and failed.stderr.startswith("error: missing.ham: ")


@pytest.mark.skipif(not pathlib.Path("/dev/full").exists(), reason="a device that is full")
def test_the_command_needs_somewhere_to_write(tmp_path):
    text = "H(x; p) = p^2/2 + x^2/2\n---\nstart x = 1, p = 0\nrun t = 0..1, every = 0.5, tolerance = 1e-10\n"
    (tmp_path / "out.ham").write_text(text, encoding="utf-8")
    (tmp_path / "file.ham").write_text(text + "write /dev/full/table.csv\n", encoding="utf-8")
    for arguments, output in [("out.ham", "> /dev/full"), ("file.ham", ""), ("--help", "> /dev/full"), ("--schemes", ">&-")]:
        command = f"exec {sys.executable} -m hamiltonian {arguments} {output}"
        done = subprocess.run(command, cwd=tmp_path, shell=True, capture_output=True, text=True)
        assert "panicked" not in done.stderr and done.returncode in (0, 1), done.stderr
        assert arguments[0] == "-" or done.returncode == 1 and done.stderr.startswith("error: "), (arguments, output, done.stderr)
