"""SciPy: DOP853 and LSODA with Python functions, the tools that are nearest at hand."""

import numpy as np
from peer import main
from scipy.integrate import solve_ivp

TOLERANCES = (1e-6, 1e-9, 1e-12)


def solve(field, problem, methods=("DOP853", "LSODA")):
    for method in methods:
        for tolerance in TOLERANCES:
            def run(method=method, tolerance=tolerance):
                made = solve_ivp(field, (0.0, problem.end), problem.start, method=method, rtol=max(tolerance, 3e-14),
                                 atol=tolerance * 1e-2, t_eval=[problem.end])
                if not made.success:
                    raise RuntimeError(made.message)
                return made.y[:, -1]

            yield method, f"rtol {tolerance:g}", run


def kepler(problem):
    def field(_, z):
        x, y, u, v = z
        r3 = (x * x + y * y) ** 1.5
        return [u, v, -x / r3, -y / r3]

    yield from solve(field, problem)


def henon_heiles(problem):
    def field(_, z):
        x, y, u, v = z
        return [u, v, -x - 2 * x * y, -y - x * x + y * y]

    yield from solve(field, problem)


def pendulum(problem):
    from math import sin

    yield from solve(lambda _, z: [z[1], -sin(z[0])], problem)


def coupled(problem):
    yield from solve(lambda _, z: [(z[0] ** 2 + 1) * z[1], -z[0] * (z[1] ** 2 + 1)], problem)


def black_hole(problem):
    from math import cos, sin

    energy, momentum = problem.parameters["E"][0], problem.parameters["L"][0]

    def field(_, z):
        r, theta, u, v = z
        s = sin(theta)
        of_r = (u / r) ** 2 - v**2 / r**3 + energy**2 / (r - 2) ** 2 - momentum**2 / (r**3 * s**2)
        return [(1 - 2 / r) * u, v / r**2, -of_r, momentum**2 * cos(theta) / (r**2 * s**3)]

    yield from solve(field, problem)


def gravity(problem, masses, constant, softening=0.0):
    count, half = problem.rows, len(problem.start) // 2
    masses = np.array(masses)[:, None]

    def field(_, z):
        q, p = z[:half].reshape(3, count).T, z[half:].reshape(3, count).T
        apart = q[:, None, :] - q[None, :, :]
        square = (apart**2).sum(axis=2) + softening
        np.fill_diagonal(square, 1.0)
        pulls = constant * masses * (apart * (masses.T / square**1.5)[:, :, None]).sum(axis=1)
        return np.concatenate([(p / masses).T.ravel(), -pulls.T.ravel()])

    return field


def planets(problem):
    field = gravity(problem, problem.parameters["m"], problem.parameters["G"][0])
    yield from solve(field, problem)


def cluster(problem):
    field = gravity(problem, problem.parameters["m"] * problem.rows, 1.0, problem.parameters["eps2"][0])
    yield from solve(field, problem, ("DOP853",))


def toda(problem):
    n = problem.rows

    def field(_, z):
        springs = np.exp(z[:n] - np.roll(z[:n], -1))
        return np.concatenate([z[n:], np.roll(springs, 1) - springs])

    yield from solve(field, problem, ("DOP853",))


def fput(problem):
    n, alpha = problem.rows, problem.parameters["alpha"][0]

    def field(_, z):
        stretched = np.diff(z[:n], prepend=0.0, append=0.0)
        return np.concatenate([z[n:], np.diff(stretched + alpha * stretched**2)])

    yield from solve(field, problem, ("DOP853",))


def ensemble(problem):
    n = problem.rows
    yield from solve(lambda _, z: np.concatenate([z[n:], -np.sin(z[:n])]), problem, ("DOP853",))


main("SciPy", "scipy", {"encounter": kepler, **{f.__name__: f for f in (
    kepler, henon_heiles, pendulum, coupled, black_hole, planets, cluster, toda, fput, ensemble)}})
