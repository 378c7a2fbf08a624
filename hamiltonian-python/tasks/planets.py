"""The Sun and nine planets for 200 years: the perihelion of Mercury."""

import hamiltonian as hm
import numpy as np

# 1/mass in masses of the Sun, and the elements of J2000: a/AU, e, inclination, mean longitude, longitude of the perihelion,
# longitude of the node, in degrees (E. M. Standish, Keplerian elements for approximate positions of the major planets, JPL).
PLANETS = np.array([
    [6023600, 0.38709927, 0.20563593, 7.00497902, 252.25032350, 77.45779628, 48.33076593],
    [408523.71, 0.72333566, 0.00677672, 3.39467605, 181.97909950, 131.60246718, 76.67984255],
    [328900.56, 1.00000261, 0.01671123, -0.00001531, 100.46457166, 102.93768193, 0.0],
    [3098708, 1.52371034, 0.09339410, 1.84969142, -4.55343205, -23.94362959, 49.55953891],
    [1047.3486, 5.20288700, 0.04838624, 1.30439695, 34.39644051, 14.72847983, 100.47390909],
    [3497.898, 9.53667594, 0.05386179, 2.48599187, 49.95424423, 92.59887831, 113.66242448],
    [22902.98, 19.18916464, 0.04725744, 0.77263783, 313.23810451, 170.95427630, 74.01692503],
    [19412.24, 30.06992276, 0.00859048, 1.77004347, -55.12002969, 44.96476227, 131.78422574],
    [1.352e8, 39.48211675, 0.24882730, 17.14001206, 238.92903833, 224.06891629, 110.30393684],
])
G = 4*np.pi**2  # AU³/(year² solar masses)


def state(mass, a, e, inclination, longitude, perihelion, node):
    """Position and velocity from the elements."""
    turn, tilt, begin = np.radians([node, inclination, perihelion - node])
    mean = np.radians(longitude - perihelion)
    u = mean
    for _ in range(20):
        u -= (u - e*np.sin(u) - mean)/(1 - e*np.cos(u))
    x = np.array([a*(np.cos(u) - e), a*np.sqrt(1 - e**2)*np.sin(u)])
    v = np.sqrt(G*(1 + mass)/a)/(1 - e*np.cos(u))*np.array([-np.sin(u), np.sqrt(1 - e**2)*np.cos(u)])
    (c, s), (ct, st), (cb, sb) = ((np.cos(w), np.sin(w)) for w in (turn, tilt, begin))
    plane = np.array([[c*cb - s*sb*ct, -c*sb - s*cb*ct], [s*cb + c*sb*ct, -s*sb + c*cb*ct], [sb*st, cb*st]])
    return plane @ x, plane @ v


system = hm.define("""
    struct Gravity { n: usize, G, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    invariant angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) }
""", n=10, G=G, m=np.append(1.0, 1/PLANETS[:, 0]))
m = system.parameters["m"]
states = [(np.zeros(3), np.zeros(3)), *(state(1/own[0], *own[1:]) for own in PLANETS)]
q = np.array([x for x, _ in states])
p = m[:, None]*np.array([v for _, v in states])
p[0] -= p.sum(axis=0)  # the centre of mass rests

sol = system.solve(q, p, t=np.linspace(0, 200, 2001), tolerance=1e-11)
x, v = sol.q[:, 1] - sol.q[:, 0], sol.p[:, 1]/m[1] - sol.p[:, 0]/m[0]
# The vector of Laplace points to the perihelion. It turns in the plane of the orbit.
laplace = np.cross(v, np.cross(x, v))/(G*(1 + m[1])) - x/np.linalg.norm(x, axis=1)[:, None]
ahead = np.cross(np.cross(x[0], v[0]), laplace[0])
angle = np.arctan2(laplace @ ahead/np.linalg.norm(ahead), laplace @ laplace[0]/np.linalg.norm(laplace[0]))
rate = np.degrees(np.polyfit(sol.t, angle, 1)[0])*3600*100
print(f"{sol.steps} steps; the perihelion of Mercury turns by {rate:.0f}″ in a century")
assert abs(sol.energy/sol.energy[0] - 1).max() < 1e-10
# 532″ by the planets in Newton's theory (G. M. Clemence, Reviews of Modern Physics 19, 361, 1947).
assert abs(rate - 532) < 3
