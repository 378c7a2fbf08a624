#!/usr/bin/env python3
"""Compares the code that the macro emits with that of another revision, definition by definition.

    python3 scripts/emitted.py REVISION

The corpus is every `hamiltonian! { … }` of the examples, tests, benches, API pages and the book, as they are in the
working tree. Both trees' `show` expand it: that of REVISION is built in a worktree below `target/`. Each definition
whose code differs is listed with its first different line; the last line has the counts. The exit status is 1 if
any differs.
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "target" / "emitted"
OPENING = re.compile(r"hamiltonian!\s*([{(\[])")
CLOSING = {"{": "}", "(": ")", "[": "]"}
# Comments, strings and characters, in which brackets do not count.
SKIPPED = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'', re.S)


def definitions(text):
    """The text inside each `hamiltonian! { … }`; listings in doc comments are read without their slashes."""
    text = re.sub(r"^\s*//[/!] ?", "", text, flags=re.M) if "```" in text else text
    for opening in OPENING.finditer(text):
        at, depth, bracket = opening.end(), 1, opening.group(1)
        while at < len(text) and depth:
            skipped = SKIPPED.match(text, at)
            if skipped:
                at = skipped.end()
                continue
            depth += {bracket: 1, CLOSING[bracket]: -1}.get(text[at], 0)
            at += 1
        if depth == 0:
            yield text[opening.end() : at - 1]


def corpus():
    """A file for each source file with definitions, one definition each."""
    listed = subprocess.run(["git", "ls-files", "*.rs", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True)
    found = {}
    for name in listed.stdout.split():
        text = (ROOT / name).read_text(encoding="utf-8")
        for number, definition in enumerate(definitions(text)):
            file = WORK / "corpus" / f"{name.replace('/', '-')}-{number}.rs"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(f"hamiltonian! {{ {definition} }}\n", encoding="utf-8")
            found[f"{name} #{number}"] = file
    return found


def build(tree, target):
    """Builds `show` of a tree and returns the path."""
    command = ["cargo", "build", "--quiet", "--release", "-p", "hamiltonian-macros", "--example", "show"]
    subprocess.run([*command, "--target-dir", str(target)], cwd=tree, check=True)
    return target / "release" / "examples" / "show"


def built_at(revision):
    """`show` of a revision, which is built once."""
    command = ["git", "rev-parse", "--short", revision]
    commit = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    target, tree = WORK / commit, WORK / "tree"
    show = target / "release" / "examples" / "show"
    if show.exists():
        return show
    subprocess.run(["git", "worktree", "remove", "--force", str(tree)], cwd=ROOT, capture_output=True, check=False)
    subprocess.run(["git", "worktree", "add", "--detach", str(tree), commit], cwd=ROOT, check=True)
    try:
        return build(tree, target)
    finally:
        subprocess.run(["git", "worktree", "remove", "--force", str(tree)], cwd=ROOT, check=True)


def emitted(show, file):
    """The code of a definition, or the reason why there is none."""
    done = subprocess.run([str(show), str(file)], capture_output=True, text=True, check=False)
    return done.stdout or done.stderr


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    shows = [built_at(sys.argv[1]), build(ROOT, WORK / "after")]
    files, different = corpus(), 0
    for name, file in files.items():
        before, after = (emitted(show, file).splitlines() for show in shows)
        if before != after:
            different += 1
            lines = [(a, b) for a, b in zip(before, after) if a != b]
            first = f"{lines[0][0].strip()!r} -> {lines[0][1].strip()!r}" if lines else "one is longer"
            print(f"{name}: {first}")
    print(f"{len(files)} definitions, {different} emitted differently")
    sys.exit(different > 0)


if __name__ == "__main__":
    main()
