"""A fit of a start and a parameter, with exact derivatives."""

import hamiltonian as hm
import numpy as np
from scipy.optimize import least_squares

# w = g/l is a coordinate whose momentum does not appear in H. So it is constant, and derivatives with respect to the start
# are derivatives with respect to w too.
pendulum = hm.define("H(theta, w; p, pw) = p^2/2 - w*cos(theta)")
t = np.linspace(0, 10, 60)
truth = np.array([1.2, 9.81, 0.3])  # theta, w, p
noise = 0.01


def solution(x):
    theta, w, p = x
    return pendulum.solve(q=[theta, w], p=[p, 0.0], t=t, tolerance=1e-10)


observed = solution(truth).q[:, 0] + noise*np.random.default_rng(1).normal(size=len(t))
fit = least_squares(
    lambda x: (solution(x).q[:, 0] - observed)/noise,
    x0=[1.0, 9.5, 0.0],
    jac=lambda x: pendulum.sensitivity(solution(x))[:, 0, :3]/noise,  # ∂theta(t)/∂(theta, w, p)
)
error = np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))
for name, value, own in zip(["theta", "w", "p"], fit.x, error):
    print(f"{name} = {value:.4f} ± {own:.4f}")
assert fit.success and (abs(fit.x - truth) < 4*error).all() and error[1] < 0.02
