"""A map of chaos of the Hénon–Heiles system: MEGNO and the Lyapunov exponent over a section."""

import hamiltonian as hm
import matplotlib.pyplot as plt
import numpy as np

hh = hm.define("H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3")
energy = 1/8
y, py = np.meshgrid(np.linspace(-0.45, 0.7, 36), np.linspace(-0.5, 0.5, 30), indexing="ij")
squared = 2*energy - py**2 - y**2 + 2*y**3/3  # px² on x = 0
inside = squared > 0
q = np.stack([0*y[inside], y[inside]], axis=-1)
p = np.stack([np.sqrt(squared[inside]), py[inside]], axis=-1)

swarm = hh.ensemble(q, p)
megno = swarm.megno(t=600, step=0.1)
exponent = swarm.lyapunov(t=600, step=0.1)

_, axes = plt.subplots(1, 2, figsize=(10, 4), sharey=True)
for ax, name, values in zip(axes, ["MEGNO", "Lyapunov exponent"], [megno, exponent]):
    picture = np.full(y.shape, np.nan)
    picture[inside] = values
    colours = ax.pcolormesh(y, py, picture, shading="nearest")
    plt.colorbar(colours, ax=ax, label=name)
    ax.set(xlabel="y", ylabel="py")
plt.savefig("chaos.png", dpi=150)
chaotic = megno > 4
print(f"{chaotic.mean():.0%} of the orbits are chaotic; their mean exponent is {exponent[chaotic].mean():.3f}")
assert 0.2 < chaotic.mean() < 0.7 and exponent[chaotic].mean() > 5*exponent[abs(megno - 2) < 0.2].mean()
