#!/usr/bin/env python3
"""Runs the program `book/wasm`.

Input: its `.wasm` and the README. Output: its numbers; the exit status says whether the angle is the one that the
README prints, and members of an ensemble have the bits of a run.

    python3 scripts/wasm.py FILE.wasm       (needs the package `wasmtime`)
"""

import pathlib
import re
import sys

import wasmtime


def main():
    [file] = sys.argv[1:]
    readme = (pathlib.Path(__file__).parent.parent / "README.md").read_text(encoding="utf-8")
    due = re.search(r"^theta\(10\) = (\S+)$", readme, re.MULTILINE)[1]

    store = wasmtime.Store()
    module = wasmtime.Module.from_file(store.engine, file)
    exports = wasmtime.Instance(store, module, []).exports(store)
    angle = exports["angle"](store, 10_000)
    members = exports["members"](store, 19, 1_000)
    print(f"theta(10) = {angle:.6f}; {members} of 19 members have the bits of a run")
    sys.exit(f"{angle:.6f}" != due or members != 19)


if __name__ == "__main__":
    main()
