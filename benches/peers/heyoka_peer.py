"""heyoka.py: Taylor's method of adaptive order and step, compiled for the problem.

Compilation is not timed. Source: F. Biscani, D. Izzo, Mon. Not. R. Astron. Soc. 504 (2021) 2614,
doi:10.1093/mnras/stab1032.
"""

import heyoka as hy
import numpy as np
from peer import main

TOLERANCES = (*(10.0**-n for n in range(4, 16)), 2.3e-16)


def taylor(equations, problem, order=lambda end: end, start=None, **options):
    """The equations for each tolerance; `order` brings the end to the order of the reference."""
    start = problem.start if start is None else start
    for tolerance in TOLERANCES:
        integrator = hy.taylor_adaptive(equations, list(start), tol=tolerance, **options)

        def run(integrator=integrator):
            integrator.time = 0.0
            integrator.state[:] = start
            integrator.propagate_until(problem.end)
            return order(integrator.state.copy())

        yield "Taylor", f"tol {tolerance:g}", run


def hamilton(h, q, p):
    """Hamilton's equations by heyoka's own derivatives."""
    return [(x, hy.diff(h, y)) for x, y in zip(q, p)] + [(y, -hy.diff(h, x)) for x, y in zip(q, p)]


def kepler(problem):
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    h = (u**2 + v**2) / 2.0 - (x**2 + y**2) ** -0.5
    yield from taylor(hamilton(h, (x, y), (u, v)), problem)


def henon_heiles(problem):
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    h = (u**2 + v**2) / 2.0 + (x**2 + y**2) / 2.0 + x**2 * y - y**3 / 3.0
    yield from taylor(hamilton(h, (x, y), (u, v)), problem)


def pendulum(problem):
    q, p = hy.make_vars("q", "p")
    yield from taylor([(q, p), (p, -hy.sin(q))], problem)


def coupled(problem):
    q, p = hy.make_vars("q", "p")
    yield from taylor(hamilton(0.5 * (q**2 + 1.0) * (p**2 + 1.0), (q,), (p,)), problem)


def black_hole(problem):
    energy, momentum = problem.parameters["E"][0], problem.parameters["L"][0]
    r, theta, u, v = hy.make_vars("r", "theta", "u", "v")
    h = ((1.0 - 2.0 / r) * u**2 / 2.0 + v**2 / (2.0 * r**2) - energy**2 / (2.0 * (1.0 - 2.0 / r))
         + momentum**2 / (2.0 * r**2 * hy.sin(theta) ** 2))
    yield from taylor(hamilton(h, (r, theta), (u, v)), problem)


def bodies(problem, masses, gravity):
    """heyoka's own equations of N bodies, with velocities, body by body: x y z vx vy vz."""
    count, half = problem.rows, len(problem.start) // 2
    places = problem.columns(problem.start[:half])
    momenta = problem.columns(problem.start[half:])
    start = [x for q, p, m in zip(places, momenta, masses) for x in [*q, *(y / m for y in p)]]

    def order(end):
        end = np.reshape(end, (count, 6))
        momenta = end[:, 3:] * np.reshape(masses, (-1, 1))
        return np.concatenate([end[:, :3].T.ravel(), momenta.T.ravel()])

    equations = hy.model.nbody(count, masses=list(masses), Gconst=gravity)
    yield from taylor(equations, problem, order, start)


def planets(problem):
    yield from bodies(problem, problem.parameters["m"], problem.parameters["G"][0])


def toda(problem):
    n = problem.rows
    q, p = hy.make_vars(*(f"q{i}" for i in range(n))), hy.make_vars(*(f"p{i}" for i in range(n)))
    springs = [hy.exp(q[i] - q[(i + 1) % n]) for i in range(n)]
    equations = list(zip(q, p)) + [(p[i], springs[i - 1] - springs[i]) for i in range(n)]
    yield from taylor(equations, problem, compact_mode=True)


def fput(problem):
    n, alpha = problem.rows, problem.parameters["alpha"][0]
    q, p = hy.make_vars(*(f"q{i}" for i in range(n))), hy.make_vars(*(f"p{i}" for i in range(n)))
    ends = [0.0, *q, 0.0]
    stretched = [b - a for a, b in zip(ends, ends[1:])]
    springs = [r + alpha * r**2 for r in stretched]
    equations = list(zip(q, p)) + [(p[i], springs[i + 1] - springs[i]) for i in range(n)]
    yield from taylor(equations, problem, compact_mode=True)


def ensemble(problem):
    """Batches of as many pendulums as registers have lanes."""
    q, p = hy.make_vars("q", "p")
    lanes, count = hy.recommended_simd_size(), problem.rows
    start = np.reshape(problem.start, (2, count))
    padded = np.pad(start, ((0, 0), (0, -count % lanes)), mode="edge")
    for tolerance in TOLERANCES:
        integrator = hy.taylor_adaptive_batch(
            [(q, p), (p, -hy.sin(q))], padded[:, :lanes].copy(), tol=tolerance)

        def run(integrator=integrator):
            ends = np.empty_like(padded)
            for first in range(0, padded.shape[1], lanes):
                integrator.set_time(0.0)
                integrator.state[:] = padded[:, first : first + lanes]
                integrator.propagate_until(problem.end)
                ends[:, first : first + lanes] = integrator.state
            return ends[:, :count].ravel()

        yield "Taylor, batches", f"tol {tolerance:g}", run


def arenstorf(problem):
    """The restricted three-body problem in its rotating frame."""
    mu = problem.parameters["mu"][0]
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    h = ((u**2 + v**2) / 2.0 + y * u - x * v - (1.0 - mu) * ((x + mu) ** 2 + y**2) ** -0.5
         - mu * ((x - 1.0 + mu) ** 2 + y**2) ** -0.5)
    yield from taylor(hamilton(h, (x, y), (u, v)), problem)


def planar(problem):
    """Bodies in a plane, with momenta: each distance is taken once."""
    masses, n = problem.parameters["m"], problem.rows
    q = [hy.make_vars(f"x{i}", f"y{i}") for i in range(n)]
    p = [hy.make_vars(f"u{i}", f"v{i}") for i in range(n)]
    force = [[hy.expression(0.0)] * 2 for _ in range(n)]
    for i in range(n):
        for j in range(i):
            apart = [a - b for a, b in zip(q[i], q[j])]
            factor = masses[i] * masses[j] * (apart[0] ** 2 + apart[1] ** 2) ** -1.5
            for c in range(2):
                force[i][c] = force[i][c] - factor * apart[c]
                force[j][c] = force[j][c] + factor * apart[c]
    equations = [(q[i][c], p[i][c] / masses[i]) for c in range(2) for i in range(n)]
    equations += [(p[i][c], force[i][c]) for c in range(2) for i in range(n)]
    yield from taylor(equations, problem)


def double_pendulum(problem):
    a, b, u, v = hy.make_vars("a", "b", "u", "v")
    h = ((u**2 + 2.0 * v**2 - 2.0 * u * v * hy.cos(a - b)) / (2.0 * (1.0 + hy.sin(a - b) ** 2))
         - 2.0 * hy.cos(a) - hy.cos(b))
    yield from taylor(hamilton(h, (a, b), (u, v)), problem)


def dipole(problem):
    rho, z, u, v = hy.make_vars("rho", "z", "u", "v")
    h = (u**2 + v**2) / 2.0 + (1.0 / rho - rho * (rho**2 + z**2) ** -1.5) ** 2 / 2.0
    yield from taylor(hamilton(h, (rho, z), (u, v)), problem)


def duffing(problem):
    q, p = hy.make_vars("q", "p")
    yield from taylor([(q, p), (p, q - q**3 + 0.3 * hy.cos(1.2 * hy.time))], problem)


def volterra(problem):
    q, p = hy.make_vars("q", "p")
    yield from taylor([(q, hy.exp(p) - 1.0), (p, 1.0 - hy.exp(q))], problem)


def atoms(problem):
    q, p = hy.make_vars("q", "p")
    h = p**2 / 2.0 + 4.0 * (q**-12.0 - q**-6.0)
    yield from taylor(hamilton(h, (q,), (p,)), problem)


main("heyoka", "heyoka", {"encounter": kepler, "grazing": kepler, "figure_eight": planar, "burrau": planar,
                          **{f.__name__: f for f in (
    kepler, henon_heiles, pendulum, coupled, black_hole, planets, toda, fput, ensemble, arenstorf, double_pendulum, dipole,
    duffing, volterra, atoms)}})
