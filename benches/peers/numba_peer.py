"""numba: kick-drift-kick loops as one writes them, and Blanes and Moan's S6 and S10 with the same kicks and drifts.

Compilation is not timed. Only H = T + V: the loops know nothing of others.
"""

import numba
import numpy as np
from peer import main

STRANG = [0.5, 0.5]
S6 = [0.0792036964311957, 0.1303114101821663, 0.2228614958676077, -0.3667132690474257, 0.3246481886897062,
      0.1096884778767498]
S10 = [0.050262764400392, 0.098553683500650, 0.314960616927694, -0.447346482695478, 0.492426372489876,
       -0.425118767797691, 0.237063913978122, 0.195602488600053, 0.346358189850727, -0.362762779254345]
TABLES = {"Störmer–Verlet": (STRANG, 1), "Blanes–Moan 4": (S6 + S6[::-1], 6), "Blanes–Moan 6": (S10 + S10[::-1], 10)}


def strokes(durations):
    flat = [0.0, *durations, 0.0]
    return np.array([a + b for a, b in zip(flat, flat[1:])])


def loop(kick):
    """`kick(q, p, c)` adds c times the force to p; masses are 1."""

    @numba.njit(fastmath=False)
    def run(q, p, table, h, steps):
        last = len(table) - 1
        kick(q, p, h * table[0])
        for step in range(steps):
            for k in range(1, last, 2):
                for i in range(len(q)):
                    q[i] += h * table[k] * p[i]
                closes = k + 1 == last and step + 1 < steps
                kick(q, p, h * (table[k + 1] + (table[0] if closes else 0.0)))

    return run


def runs(problem, kick, first, times=6):
    compiled, half = loop(numba.njit(fastmath=False)(kick)), len(problem.start) // 2
    for name, (durations, stages) in TABLES.items():
        table = strokes(durations)
        for k in range(times):
            steps = max(1, first // stages) << k

            def run(table=table, steps=steps):
                q, p = np.array(problem.start[:half]), np.array(problem.start[half:])
                compiled(q, p, table, problem.end / steps, steps)
                return np.concatenate([q, p])

            run()
            yield name, f"{steps} steps", run


def kepler(problem):
    def kick(q, p, c):
        square = q[0] * q[0] + q[1] * q[1]
        factor = c / (square * np.sqrt(square))
        p[0] -= factor * q[0]
        p[1] -= factor * q[1]

    yield from runs(problem, kick, 1_000_000)


def henon_heiles(problem):
    def kick(q, p, c):
        p[0] -= c * (q[0] + 2 * q[0] * q[1])
        p[1] -= c * (q[1] + q[0] * q[0] - q[1] * q[1])

    yield from runs(problem, kick, 100_000)


def pendulum(problem):
    def kick(q, p, c):
        p[0] -= c * np.sin(q[0])

    yield from runs(problem, kick, 100_000)


def ensemble(problem):
    def kick(q, p, c):
        for i in range(len(q)):
            p[i] -= c * np.sin(q[i])

    yield from runs(problem, kick, 1000, 4)


def toda(problem):
    def kick(q, p, c):
        n = len(q)
        before = np.exp(q[n - 1] - q[0])
        for i in range(n):
            after = np.exp(q[i] - q[(i + 1) % n])
            p[i] += c * (before - after)
            before = after

    yield from runs(problem, kick, 200)


def fput(problem):
    alpha = problem.parameters["alpha"][0]

    def kick(q, p, c):
        n = len(q)
        before = q[0] + alpha * q[0] * q[0]
        for i in range(n):
            r = (q[i + 1] if i + 1 < n else 0.0) - q[i]
            after = r + alpha * r * r
            p[i] += c * (after - before)
            before = after

    yield from runs(problem, kick, 10_000)


main("numba", "numba", {"encounter": kepler, **{f.__name__: f for f in (kepler, henon_heiles, pendulum, ensemble, toda, fput)}})
