#!/usr/bin/env python3
"""The seconds of what takes longest in each build, and of each test binary.

Input: the folder that `cargo --timings` writes to, and the output of `cargo test`. Output: a table.

    python3 scripts/seconds.py target/cargo-timings target/tests.log
"""

import json
import pathlib
import re
import sys


def built(page):
    """(seconds, crate and target) of each unit of a build."""
    units = json.loads(re.search(r"const UNIT_DATA = (\[.*?\n\]|\[.*?\]);", page, re.DOTALL)[1])
    return [(unit["duration"], f"{unit['name']}{unit['target']}") for unit in units]


def ran(log):
    """(seconds, binary) of each test binary that has tests."""
    found, name = [], None
    for line in log.splitlines():
        if start := re.match(r"\s+(?:Running (.*) \(|Doc-tests (\S+))", line):
            name = start[1] or f"examples of {start[2]}"
            place = re.search(r"(\w+)/deps/(\w+)-", line)
            name += f" of {place[2]}, {place[1]}" if place else ""
        elif end := re.match(r"test result: .* (\d+) passed.* finished in ([\d.]+)s", line):
            if int(end[1]):
                found.append((float(end[2]), name))
    return found


def main():
    timings, log = map(pathlib.Path, sys.argv[1:])
    for page in sorted(timings.glob("cargo-timing-*.html"), key=lambda page: page.stat().st_mtime):
        units = built(page.read_text(encoding="utf-8"))
        print(f"{sum(seconds for seconds, _ in units):7.1f} s all of a build")
        for seconds, name in sorted(units, reverse=True)[:12]:
            print(f"{seconds:7.1f} s to build {name}")
    for seconds, name in ran(log.read_text(encoding="utf-8")):
        print(f"{seconds:7.1f} s to run {name}")


if __name__ == "__main__":
    main()
