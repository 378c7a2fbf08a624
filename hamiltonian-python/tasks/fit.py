"""A fit of a start and a parameter, with exact derivatives."""

import hamiltonian as hm
import numpy as np
from scipy.optimize import least_squares

pendulum = hm.define("H(theta; p) = p^2/2 - w*cos(theta)", w=9.5)  # w = g/l
t = np.linspace(0, 10, 60)
truth = np.array([1.2, 0.3, 9.81])  # theta, p, w
noise = 0.01


def solution(x):
    theta, p, w = x
    return pendulum.with_(w=w).solve(q=theta, p=p, t=t, tolerance=1e-10)


def derivatives(x):
    """∂theta(t)/∂(theta, p, w)"""
    sol = solution(x)
    return sol.system.sensitivity(sol, parameters="w")[:, 0]


observed = solution(truth).q[:, 0] + noise*np.random.default_rng(1).normal(size=len(t))
fit = least_squares(
    lambda x: (solution(x).q[:, 0] - observed)/noise,
    x0=[1.0, 0.0, 9.5],
    jac=lambda x: derivatives(x)/noise,
)
error = np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))
for name, value, own in zip(["theta", "p", "w"], fit.x, error):
    print(f"{name} = {value:.4f} ± {own:.4f}")
assert fit.success and (abs(fit.x - truth) < 4*error).all() and error[2] < 0.02
