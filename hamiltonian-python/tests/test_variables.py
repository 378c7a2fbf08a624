"""Other coordinates, another time, velocities, and lattices."""

import hamiltonian as hm
import numpy as np
import pytest

KEPLER = "H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2)"


def test_polar_coordinates():
    polar = hm.define(f"{KEPLER}; coordinates polar(x, y)")
    assert polar.coordinates == ("r", "phi") and polar.momenta == ("p_r", "p_phi")
    assert polar.declared.coordinates == ("x", "y") and polar.declared.shape == (2,)
    q, p = np.array([[0.0, 0.5], [1.0, 1.0]]), np.array([[-1.5, 0.0], [0.5, -0.5]])
    start = polar.from_declared(q, p, t=0.25)
    r, phi = np.hypot(*q.T), np.arctan2(q[:, 1], q[:, 0])
    assert np.allclose(start.q, np.stack([r, phi], axis=-1), rtol=1e-15)
    assert np.allclose(start.p[:, 1], q[:, 0]*p[:, 1] - q[:, 1]*p[:, 0], rtol=1e-15)
    assert (start.t == 0.25).all()
    back = polar.to_declared(start.q, start.p, start.t)
    assert np.allclose(back.q, q, atol=1e-15) and np.allclose(back.p, p, atol=1e-15)

    # The same orbit as in the declared coordinates.
    t = np.linspace(0, 2, 5)
    own = polar.solve(start.q[0], start.p[0], t, tolerance=1e-12)
    other = hm.define(KEPLER).solve(q[0], p[0], t, tolerance=1e-12)
    assert np.abs(own.declared.q - other.q).max() < 1e-9
    assert np.abs(own.q - other.q).max() > 0.1


def test_another_time():
    plain = hm.define(KEPLER)
    sundman = hm.define(f"{KEPLER}; dt = sqrt(x^2 + y^2)*ds")
    assert (sundman.clock, plain.clock) == ("s", "t")
    q, p = [0.1, 0.0], [0.0, np.sqrt(19)]
    start = sundman.from_declared(q, p, t=3.0)
    assert (start.t, start.q[2], start.p[2]) == (0.0, 3.0, -plain.H(q, p))
    assert sundman.H(start.q, start.p) == plain.H(q, p)
    sol = sundman.solve(start.q, start.p, np.linspace(0, 2*np.pi, 5), tolerance=1e-12)
    declared = sol.declared
    assert abs(declared.t[-1] - 3 - 2*np.pi) < 1e-9 and np.abs(declared.q[-1] - q).max() < 1e-8
    assert np.abs(sol.energy + 0.5).max() < 1e-10
    swarm = sundman.ensemble(start.q, np.array([start.p, start.p]))
    assert (swarm.energy == plain.H(q, p)).all()
    with pytest.raises(ValueError, match="shell"):
        sundman.run(start.q, [0.0, 4.0, 9.0], scheme="RungeKutta4", step=0.1)


def test_velocities():
    pendulum = hm.define("L(theta; v) = l^2*v^2/2 + l*cos(theta)", l=2.0)
    assert pendulum.declared.velocities == ("v",)
    start = pendulum.from_velocity(0.5, [[1.5], [3.0]])
    assert start.p.tolist() == [[6.0], [12.0]] and start.q.tolist() == [[0.5], [0.5]]
    with pytest.raises(ValueError, match="velocities"):
        hm.define(KEPLER).from_velocity([1.0, 0.0], [0.0, 1.0])
    with pytest.raises(ValueError, match="shape"):
        hm.define(KEPLER).from_declared([1.0, 0.0, 2.0], [0.0, 1.0])


def test_lattices():
    text = """struct Sheet { n: usize, m: usize }
        H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
            p[i][j]^2/2 + (u[(i + 1) % n][j] - u[i][j])^2/2 + (u[i][(j + 1) % m] - u[i][j])^2/2 };
        monitor corner = u[1][2]"""
    sheet = hm.define(text, n=3, m=5)
    assert sheet.shape == (3, 5)
    u = np.arange(15.0).reshape(3, 5)
    rows, columns = np.roll(u, -1, 0) - u, np.roll(u, -1, 1) - u
    assert sheet.H(u, 2.0) == 2.0*15 + (rows**2).sum()/2 + (columns**2).sum()/2
    assert sheet.observable("corner", u, 0.0) == u[1, 2]
    sol = sheet.solve(u, 0.0, [0, 1], scheme="GaussNystrom8", step=0.1)
    assert sol.q.shape == (2, 3, 5) and abs(sol.energy[1]/sol.energy[0] - 1) < 1e-12
