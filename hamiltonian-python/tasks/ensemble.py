"""2500 pendulums of different lengths, as a data set of xarray."""

import hamiltonian as hm
import numpy as np
import xarray as xr

pendulum = hm.define("""
    struct Pendulum { l = 1.0, g = 9.81 }
    H(theta; p) = p^2/(2*l^2) - g*l*cos(theta)
""")
length = np.linspace(0.5, 2.0, 50)
angle = np.linspace(0.01, 3.0, 50)

# The leading axes of q and of the parameter are broadcast: one member for each length and angle.
swarm = pendulum.ensemble(q=angle[None, :, None], p=0.0, l=length[:, None])
before = swarm.energy
times = np.linspace(0, 20, 41)
states = [swarm.advance_to(t, step=0.01) for t in times]

axes = ("time", "length", "angle")
data = xr.Dataset(
    {"theta": (axes, [state.q[..., 0] for state in states]), "p": (axes, [state.p[..., 0] for state in states])},
    coords={"time": times, "length": length, "angle": angle},
)
print(data.theta.std("time").sel(angle=0.01, length=[0.5, 1.0, 2.0], method="nearest"))
data.to_netcdf("pendulums.nc", engine="scipy")
assert not swarm.errors and abs(swarm.energy - before).max() < 1e-5
