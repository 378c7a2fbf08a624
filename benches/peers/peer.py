"""What the scripts of all peers share: problems, CPU times, rows.

A script calls `main({name: function})`. Each function takes a `Problem` and yields (method, setting, run), where
`run()` integrates from the start and returns the end point, coordinates first. A row is printed as one JSON line.
"""

import json
import os
import statistics
import sys
import time
from fractions import Fraction
from importlib.metadata import version

# As many measurements, or at least three where they take longer together than PATIENCE.
RUNS = 9
PATIENCE = 0.3
# Shorter runs are repeated within a measurement.
SECONDS = 0.02


class Problem:
    """Start, parameters and end as the peers read them; the reference in two words of `float`."""

    def __init__(self, line):
        self.name, self.end, self.rows = line["problem"], line["end"], line["rows"]
        self.start, self.parameters = line["start"], line["parameters"]
        low = line.get("reference_low", [0.0] * len(line["reference"]))
        self.reference = [Fraction(a) + Fraction(b) for a, b in zip(line["reference"], low)]

    def error(self, end):
        """The largest difference of a component from the reference."""
        return max(abs(float(Fraction(float(x)) - exact)) for x, exact in zip(end, self.reference))

    def columns(self, values):
        """Arrays of bodies are stored component by component; here body by body."""
        return [[values[c * self.rows + i] for c in range(len(values) // self.rows)] for i in range(self.rows)]


def flat(bodies):
    """The inverse of `Problem.columns`."""
    return [body[c] for c in range(len(bodies[0])) for body in bodies]


def problems():
    with open(os.environ["PROBLEMS"], encoding="utf-8") as file:
        return {line["problem"]: Problem(line) for line in map(json.loads, file)}


def seconds_of(run):
    """The median CPU time."""
    times = []
    while len(times) < RUNS and (len(times) < 3 or sum(times) < PATIENCE):
        began, count = time.thread_time(), 0
        while True:
            run()
            count += 1
            taken = time.thread_time() - began
            if taken >= SECONDS:
                break
        times.append(taken / count)
        # A run this long is measured once: the clock is no matter then.
        if taken > 2.0:
            break
    return statistics.median(times)


def main(peer, package, solvers):
    wanted = sys.argv[1:]
    for name, problem in problems().items():
        if name not in solvers or (wanted and name not in wanted):
            continue
        for method, setting, run in solvers[name](problem):
            try:
                error = problem.error(run())
                row = {"error": error, "seconds": seconds_of(run)}
            except Exception as reason:  # A peer that fails is a result too.
                row = {"failed": f"{type(reason).__name__}: {reason}"}
            row = {"problem": name, "peer": peer, "version": version(package), "method": method,
                   "setting": setting, **row}
            print(json.dumps(row), flush=True)
