"""Ensembles from Python: the CPU time of this library's package and of heyoka's batch mode, at equal errors.

`python swarms.py` where both packages are installed. The error is the largest one of a component of an end point, against
heyoka with a tolerance of 2.3e-16. Of this library the fastest scheme and step with the error or a smaller one counts; of
heyoka, which fuses products and sums, compilation is not timed. A time is that of all threads, the least of a few.
"""

import time

import hamiltonian as hm
import heyoka as hy
import numpy as np

MEMBERS, END, TURNS = 10_000, 100.0, 2
SCHEMES = ("StormerVerlet", "BlanesMoan4", "BlanesMoan6", "Srkn11b", "Srkn14a", "BlanesCasasEscorihuela8", "SofroniouSpaletta10")
STEPS = (1.25, 1.0, 0.8, 0.625, 0.5, 0.4, 0.3125, 0.25, 0.2, 0.125, 0.1, 0.05)
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)

spread = np.linspace(0.0, 1.0, MEMBERS)


def pendulum():
    q, p = hy.make_vars("q", "p")
    start = np.stack([0.1 + 1.9 * spread, np.zeros(MEMBERS)])
    return "H(q; p) = p^2/2 - cos(q)", [(q, p), (p, -hy.sin(q))], start


def henon_heiles():
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    equations = [(x, u), (y, v), (u, -x - 2.0 * x * y), (v, -y - x**2 + y**2)]
    start = np.stack([0.3 * spread, np.full(MEMBERS, -0.1), np.full(MEMBERS, 0.2), np.full(MEMBERS, 0.1)])
    return "H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3", equations, start


def seconds(run):
    best = np.inf
    for _ in range(TURNS):
        began = time.process_time()
        end = run()
        best = min(best, time.process_time() - began)
    return best, end


def ours(text, start, scheme, steps):
    q, p = np.split(start, 2)

    def run():
        swarm = hm.define(text).ensemble(q.T, p.T, threads=2)
        state = swarm.advance(steps, step=END / steps, scheme=scheme)
        return np.concatenate([state.q.T, state.p.T])

    return run


def heyoka(equations, start, tolerance):
    lanes = hy.recommended_simd_size()
    integrator = hy.taylor_adaptive_batch(equations, start[:, :lanes].copy(), tol=tolerance)

    def run():
        ends = np.empty_like(start)
        for first in range(0, MEMBERS, lanes):
            integrator.set_time(0.0)
            integrator.state[:] = start[:, first : first + lanes]
            integrator.propagate_until(END)
            ends[:, first : first + lanes] = integrator.state
        return ends

    return run


def main():
    for problem in (pendulum, henon_heiles):
        text, equations, start = problem()
        exact = heyoka(equations, start, 2.3e-16)()
        error = lambda end: np.abs(end - exact).max()
        own = []
        for scheme in SCHEMES:
            for step in STEPS:
                taken, end = seconds(ours(text, start, scheme, round(END / step)))
                own.append((error(end), taken, scheme, step))
        for tolerance in TOLERANCES:
            taken, end = seconds(heyoka(equations, start, tolerance))
            due = error(end)
            best = min((row for row in own if row[0] <= due), key=lambda row: row[1], default=None)
            if best:
                print(f"{problem.__name__}: error {due:.1e}: heyoka {taken:.3f} s, ours {best[1]:.3f} s ({best[2]}, {best[3]}, error {best[0]:.1e}), ratio {taken / best[1]:.2f}", flush=True)
            else:
                print(f"{problem.__name__}: error {due:.1e}: heyoka {taken:.3f} s, ours none", flush=True)


main()
