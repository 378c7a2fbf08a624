"""A Poincaré section of the Hénon–Heiles system, with one colour for each orbit."""

import hamiltonian as hm
import matplotlib.pyplot as plt
import numpy as np

hh = hm.define("""
    H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lam*(x^2*y - y^3/3);
    event section = x
""", lam=1.0)
print(hh)

energy = 1/8
_, ax = plt.subplots(figsize=(6, 6))
for y in np.linspace(-0.35, 0.6, 12):
    px = np.sqrt(2*energy - 2*hh.H([0, y], 0))  # the start lies on x = 0, with this energy
    sol = hh.solve(q=[0, y], p=[px, 0], t=[0, 2000], tolerance=1e-10)
    section = sol.events["section"]
    up = section.rising
    ax.plot(section.q[up, 1], section.p[up, 1], ".", markersize=2)
    assert abs(sol.energy[-1]/energy - 1) < 1e-8 and up.sum() > 200
ax.set(xlabel="y", ylabel="py", aspect="equal")
plt.savefig("section.png", dpi=150)
