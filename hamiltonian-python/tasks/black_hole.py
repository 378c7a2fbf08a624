"""A geodesic of the Kerr metric in Mino's time."""

import hamiltonian as hm
import numpy as np

# With dτ = Σ dλ (Y. Mino, Physical Review D 67, 084027, 2003), K = Σ·(h + p_tau) is the Hamiltonian in λ, where h is that
# of the geodesic in proper time τ. Orbits of a particle of mass 1 have h = −1/2, so p_tau = 1/2 and K = 0.
hole = hm.define("""
    struct Kerr { a = 0.9, E = 0.95 }
    let Delta = r^2 - 2*r + a^2;
    let Sigma = r^2 + a^2*cos(theta)^2;
    H(r, theta, phi, tau; p_r, p_theta, L, p_tau) = (Delta*p_r^2 + p_theta^2
        - ((r^2 + a^2)*E - a*L)^2/Delta + (L - a*E*sin(theta)^2)^2/sin(theta)^2)/2 + Sigma*p_tau;
    invariant carter = p_theta^2 + cos(theta)^2*(a^2*(2*p_tau - E^2) + L^2/sin(theta)^2);
    event equator = cos(theta)
""")
for name in hole.pieces:
    print("piece:", name)

q, p = np.array([8.0, np.pi/2, 0.0, 0.0]), np.array([0.0, 0.0, 2.0, 0.5])
p[1] = np.sqrt(-2*hole.H(q, p))  # the shell K = 0
run = hole.run(q, p, scheme="KahanLi8", step=0.01)
carter = run.observable("carter")
run.advance(10_000)
print(f"proper time {run.q[3]:.1f}, {run.q[2]/(2*np.pi):.2f} turns, {len(run.events['equator'].t)} crossings of the equator")
print(f"Carter's constant changed by {run.observable('carter')/carter - 1:.1e}")
assert abs(run.observable("carter")/carter - 1) < 1e-10 and abs(run.energy) < 1e-9
