"""The tasks of the chapter "From Python": each program runs, and the chapter shows it as it is."""

import pathlib
import subprocess
import sys

import pytest

FOLDER = pathlib.Path(__file__).resolve().parent.parent
TASKS = sorted((FOLDER / "tasks").glob("*.py"))
CHAPTER = FOLDER.parent / "book" / "src" / "from-python.md"


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.stem)
def test_tasks_run(task, tmp_path):
    for package in ("matplotlib", "scipy", "sympy", "xarray"):
        if package in task.read_text(encoding="utf-8"):
            pytest.importorskip(package)
    environment = {"MPLBACKEND": "Agg", "PYTHONPATH": ":".join(sys.path), "PATH": ""}
    run = subprocess.run([sys.executable, task], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_the_chapter_shows_the_tasks():
    chapter = CHAPTER.read_text(encoding="utf-8")
    for task in TASKS:
        assert f"```python\n{task.read_text(encoding='utf-8')}```\n" in chapter, task.name


def test_the_first_program_of_the_chapter_runs(capsys):
    first = CHAPTER.read_text(encoding="utf-8").split("```python\n")[1].split("```")[0]
    exec(compile(first, "from-python.md", "exec"), {})
    assert "H is separable" in capsys.readouterr().out
