"""REBOUND: N bodies only.

WHFast with its correctors (H. Rein, D. Tamayo, Mon. Not. R. Astron. Soc. 452, 2015, 376), IAS15 (H. Rein, D. S.
Spiegel, ibid. 446, 2015, 1424), SABA(10,6,4), leapfrog.
"""

import numpy as np
import rebound
from peer import main


def simulation(problem, masses, gravity, softening=0.0):
    half = len(problem.start) // 2
    places, momenta = problem.columns(problem.start[:half]), problem.columns(problem.start[half:])
    made = rebound.Simulation()
    made.G, made.softening = gravity, softening
    for q, p, m in zip(places, momenta, masses):
        q, v = [*q, 0.0][:3], [*(y / m for y in p), 0.0][:3]
        made.add(m=m, x=q[0], y=q[1], z=q[2], vx=v[0], vy=v[1], vz=v[2])
    return made


def runs(problem, masses, gravity, settings, softening=0.0):
    template = simulation(problem, masses, gravity, softening)

    def ends(made):
        bodies = made.particles
        axes = len(problem.start) // 2 // problem.rows
        q = [[getattr(b, "xyz"[c]) for b in bodies] for c in range(axes)]
        momenta = [[b.m * getattr(b, "v" + "xyz"[c]) for b in bodies] for c in range(axes)]
        return np.concatenate([np.ravel(q), np.ravel(momenta)])

    for integrator, options, steps in settings:
        def run(integrator=integrator, options=options, steps=steps):
            made = template.copy()
            made.integrator = integrator
            for name, value in options.items():
                setattr(made.integrator, name, value)
            if steps:
                made.dt = problem.end / steps
                made.steps(steps)
                made.synchronize()
            else:
                made.integrate(problem.end)
            return ends(made)

        yield integrator, f"{steps} steps" if steps else str(options), run


def doubled(integrator, options, first, times):
    return [(integrator, options, first << k) for k in range(times)]


def planets(problem):
    fast = {"corrector": 17, "safe_mode": 0}
    saba = {"type": "10_6_4", "safe_mode": 0}
    adaptive = [("ias15", {"epsilon": e}, 0) for e in (1e-6, 1e-9)]
    yield from runs(problem, problem.parameters["m"], problem.parameters["G"][0],
                    doubled("whfast", fast, 1000, 6) + doubled("saba", saba, 500, 6)
                    + doubled("leapfrog", {}, 20_000, 4) + adaptive)


def cluster(problem):
    masses = problem.parameters["m"] * problem.rows
    yield from runs(problem, masses, 1.0, doubled("leapfrog", {}, 8, 4), problem.parameters["eps2"][0] ** 0.5)


main("REBOUND", "rebound", {"planets": planets, "cluster": cluster})
