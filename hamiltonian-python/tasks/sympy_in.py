"""A double pendulum, from a Lagrangian in SymPy."""

import hamiltonian as hm
import numpy as np
import sympy as sp

a, b, va, vb, pa, pb = sp.symbols("a b va vb pa pb", real=True)
m, g = sp.symbols("m g", positive=True)

x1, y1 = sp.sin(a), -sp.cos(a)
x2, y2 = x1 + sp.sin(b), y1 - sp.cos(b)


def speed_squared(x, y):
    return sum((sp.diff(c, a)*va + sp.diff(c, b)*vb)**2 for c in (x, y))


kinetic = speed_squared(x1, y1)/2 + m*speed_squared(x2, y2)/2
potential = g*y1 + m*g*y2
# T is v·M·v/2, so H = p·M⁻¹·p/2 + V.
mass = sp.simplify(sp.hessian(kinetic, (va, vb)))
momenta = sp.Matrix([pa, pb])
h = sp.simplify((momenta.T*mass.inv()*momenta)[0]/2) + potential

double = hm.define(h, coordinates=(a, b), momenta=(pa, pb), events={"upright": sp.cos(b/2)}, m=0.5, g=9.81)
print(double)
sol = double.solve(q=[2.0, 2.5], p=[0, 0], t=np.linspace(0, 20, 2001), tolerance=1e-12)
print(f"the outer arm turned over {len(sol.events['upright'].t)} times")
assert abs(sol.energy/sol.energy[0] - 1).max() < 1e-9
