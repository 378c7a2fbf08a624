"""An H that is not separable: its pieces with exact flows make explicit symplectic schemes."""

import hamiltonian as hm
import numpy as np

system = hm.define("H(q; p) = (q^2 + 1)*(p^2 + 1)/2")
print(system)
for name, formula in system.pieces.items():
    print("piece:", formula)
print("not separable:", system.missing["Separable"])

t = np.linspace(0, 1000, 201)
by_pieces = system.solve(q=-3.0, p=0.0, t=t, scheme="BlanesMoan4", step=0.01)
other = system.solve(q=-3.0, p=0.0, t=t, scheme="RungeKutta4", step=0.01)
for sol in (by_pieces, other):
    print(f"{sol.scheme}: H changes by {abs(sol.energy/sol.energy[0] - 1).max():.1e}")
try:
    system.run(q=-3.0, p=0.0, scheme="StormerVerlet", step=0.01)
except ValueError as error:
    print(error)
assert abs(by_pieces.energy/by_pieces.energy[0] - 1).max() < 1e-7
