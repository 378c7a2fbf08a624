"""Runs and solutions: schemes by name, tolerances, events, errors, pickles."""

import pickle

import hamiltonian as hm
import numpy as np
import pytest

SPRING = "H(x; p) = p^2/2 + k*x^2/2; event turn = p; monitor speed = abs(p)"
HENON = "H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3; event section = x"


@pytest.fixture(scope="module")
def spring():
    return hm.define(SPRING, k=4.0)


def test_solutions(spring):
    t = np.linspace(0, 10, 41)
    sol = spring.solve(q=1.0, p=0.0, t=t, tolerance=1e-12)
    assert (sol.t == t).all() and sol.q.shape == sol.p.shape == (41, 1) and len(sol) == 41
    np.testing.assert_allclose(sol.q[:, 0], np.cos(2 * t), atol=1e-11)
    np.testing.assert_allclose(sol.p[:, 0], -2 * np.sin(2 * t), atol=1e-11)
    np.testing.assert_allclose(sol.energy, 2.0, rtol=1e-12)
    assert (sol.observable("speed") == abs(sol.p[:, 0])).all()
    turn = sol.events["turn"]
    np.testing.assert_allclose(turn.t, np.pi / 2 * np.arange(1, 7), rtol=1e-11)
    assert turn.rising.tolist() == [True, False] * 3
    np.testing.assert_allclose(turn.q[:, 0], [-1, 1] * 3, rtol=1e-11)
    assert abs(turn.p).max() < 1e-12
    assert sol.order == 16 and 0 < sol.steps < 60 and sol.scheme in repr(sol)
    assert "41 states from t = 0 to 10" in repr(sol) and "turn: 6 crossings" in repr(sol)


def test_a_smaller_tolerance_is_a_smaller_error(spring):
    t = np.linspace(0, 100, 3)
    # Kepler's problem with an eccentricity of 0.99, from the far end.
    kepler = hm.define("H(x, y; px, py) = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)")
    start = [1.99, 0.0], [0.0, np.sqrt(2 / 1.99 - 1)]
    sols = [kepler.solve(*start, t, tolerance=own) for own in (1e-8, 1e-9, 1e-11, 1e-13)]
    errors = [abs(sol.q[-1] - sols[-1].q[-1]).max() for sol in sols[:-1]]
    assert errors[0] > errors[1] > errors[2] and errors[2] < 1e-4
    assert sols[0].steps < sols[-1].steps
    default = spring.solve(1.0, 0.0, t)
    assert abs(default.q[-1, 0] - np.cos(200)) < 1e-9
    pair = spring.solve(1.0, 0.0, t, tolerance=(1e-10, 1e-12))
    assert abs(pair.q[-1, 0] - np.cos(200)) < 1e-8


def test_schemes_with_steps(spring):
    t = np.linspace(3, 5, 9)
    rough, fine = (spring.solve(1.0, 0.0, t, scheme="StormerVerlet", step=step) for step in (0.02, 0.01))
    due = np.cos(2 * (t - 3))
    # Order 2: half of the step is a quarter of the error.
    ratio = abs(rough.q[:, 0] - due).max() / abs(fine.q[:, 0] - due).max()
    assert 3.8 < ratio < 4.2 and fine.steps == 200
    # Times between steps, and times that decrease.
    exact = spring.solve(1.0, 0.0, [3.0, 3.123, 4.9], scheme="GaussNystrom8", step=0.1)
    np.testing.assert_allclose(exact.q[:, 0], np.cos(2 * (exact.t - 3)), atol=1e-13)
    back = spring.solve(exact.q[-1], exact.p[-1], [4.9, 3.0], scheme="GaussNystrom8", step=0.1)
    np.testing.assert_allclose([back.q[-1, 0], back.p[-1, 0]], [1, 0], atol=1e-12)


def test_runs_advance(spring):
    run = spring.run(q=1.0, p=0.0, scheme="GaussNystrom8", step=0.1)
    assert (run.t, run.steps, run.step) == (0.0, 0, 0.1)
    state = run.advance(10)
    assert run.steps == 10 and state.t == run.t == pytest.approx(1.0)
    np.testing.assert_allclose(state.q, [np.cos(2.0)], atol=1e-14)
    assert run.advance_to(2.0).q[0] == pytest.approx(np.cos(4.0), abs=1e-13)
    assert run.energy == pytest.approx(2.0, rel=1e-14) and run.observable("speed") == abs(run.p[0])
    assert run.advance_until(2.55).t == 2.55 and run.t == pytest.approx(2.5)
    with pytest.raises(ValueError, match="2.6"):
        run.advance_to(2.55)
    with pytest.raises(ValueError):
        run.advance_to(1.0)
    assert run.events["turn"].t == pytest.approx([np.pi / 2])
    assert "after 25 steps" in repr(run)
    with pytest.raises(KeyError, match="declares no 'depth'; it has: turn, speed"):
        run.observable("depth")


@pytest.mark.parametrize("how", [{"scheme": "GaussNystrom8", "step": 0.1}, {"scheme": "StormerVerlet", "step": 0.01}, {"tolerance": 1e-9}])
def test_pickled_runs_continue_with_the_same_bits(how):
    henon = hm.define(HENON)
    run = henon.run([0.0, 0.1], [0.4, 0.0], **how)
    run.advance(1000)
    again = pickle.loads(pickle.dumps(run))
    assert (again.steps, again.t) == (run.steps, run.t)
    for own, other in zip(run.advance(200), again.advance(200)):
        assert np.array_equal(own, other)
    assert np.array_equal(run.events["section"].q, again.events["section"].q) and len(run.events["section"].t)


def test_arrays_of_two_axes_keep_their_order():
    text = "struct A { n: usize } H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/2 }"
    free = hm.define(text, n=4)
    q, p = np.arange(12.0).reshape(4, 3), np.arange(12.0, 24.0).reshape(4, 3)
    sol = free.solve(q, p, [0.0, 2.0])
    assert sol.q.shape == (2, 4, 3)
    np.testing.assert_allclose(sol.q[-1], q + 2 * p, rtol=1e-12)
    np.testing.assert_allclose(free.run(q, p, scheme="StormerVerlet", step=0.5).advance(4).q, q + 2 * p, rtol=1e-12)


def test_starts_and_times_are_checked(spring):
    henon = hm.define(HENON)
    for q, text in [([0.0], "`q` must have the shape (2,), found (1,)"), ([0, np.nan], "`q` is nan at index 1, and must be finite"), ([0, np.inf], "`q` is inf")]:
        with pytest.raises(ValueError) as raised:
            henon.solve(q, 0.0, [0, 1])
        assert text in str(raised.value)
    for t, text in [([], "a list of times"), ([[0, 1]], "a list of times"), ([0, 2, 1], "increase or decrease"), ([0, np.nan], "`t` is nan"), ([1, 0], "forwards alone")]:
        with pytest.raises(ValueError) as raised:
            spring.solve(1.0, 0.0, t)
        assert text in str(raised.value)
    with pytest.raises(TypeError, match="`t` must be a real number"):
        spring.solve(1.0, 0.0, ["a"])
    for tolerance in (-1e-9, np.nan, [1, 2, 3]):
        with pytest.raises(ValueError):
            spring.solve(1.0, 0.0, [0, 1], tolerance=tolerance)
    for how in ({"scheme": "Gauss4"}, {"step": 0.1}, {"scheme": "Gauss4", "step": 0.1, "tolerance": 1e-9}, {"scheme": 3, "step": 0.1}):
        with pytest.raises(TypeError):
            spring.solve(1.0, 0.0, [0, 1], **how)
    for step in (0.0, np.nan, np.inf):
        with pytest.raises(ValueError):
            spring.run(1.0, 0.0, scheme="Gauss4", step=step)
    for steps in (-1, 2.5, np.nan, 10**30):
        with pytest.raises(ValueError, match="`steps`"):
            spring.run(1.0, 0.0, scheme="Gauss4", step=0.1).advance(steps)
    with pytest.raises(ValueError, match="there is no scheme `StormerVerlt`"):
        spring.run(1.0, 0.0, scheme="StormerVerlt", step=0.1)


def test_schemes_that_do_not_fit_are_refused():
    product = hm.define("H = (q^2 + 1)*(p^2 + 1)/2")
    with pytest.raises(ValueError, match="couples q and p"):
        product.run(1.0, 0.0, scheme="StormerVerlet", step=0.1)
    sol = product.solve(-3.0, 0.0, np.linspace(0, 1, 3), scheme="BlanesMoan4", step=0.001)
    assert abs(sol.energy / sol.energy[0] - 1).max() < 1e-7


def test_failures_keep_what_was_computed():
    falling = hm.define("H(x; p) = p^2/2 + sqrt(x)*10")
    with pytest.raises(hm.RunError) as raised:
        falling.solve(1.0, -1.0, np.linspace(0, 10, 101), scheme="RungeKutta4", step=0.01)
    kept = raised.value.solution
    assert 0 < len(kept) < 101 and np.isfinite(kept.q).all() and str(raised.value)
    run = falling.run(1.0, -1.0, scheme="RungeKutta4", step=0.01)
    with pytest.raises(hm.RunError):
        run.advance(10_000)
    assert 0 < run.t < 10 and np.isfinite(run.q).all()
    with pytest.raises(ValueError):
        falling.run(-1.0, 0.0, scheme="RungeKutta4", step=0.01)


def test_every_scheme_has_a_name():
    names = [scheme.name for scheme in hm.schemes()]
    assert len(names) == len(set(names)) > 40
    assert {"StormerVerlet", "BlanesMoan6", "Gauss8", "GaussNystrom8"} <= {name.split("(")[0] for name in names}
    assert all(scheme.order >= 1 and scheme.source for scheme in hm.schemes())


def test_derivatives_with_respect_to_the_start():
    henon = hm.define(HENON)
    q, p, t = np.array([0.0, 0.1]), np.array([0.4, 0.2]), np.array([0.0, 0.7, 3.0, 8.0])
    sol = henon.solve(q, p, t, tolerance=1e-13)
    matrices = henon.sensitivity(sol, tolerance=1e-11)
    assert matrices.shape == (4, 4, 4) and (matrices[0] == np.eye(4)).all()
    step = 1e-5
    for column in range(4):
        moved = []
        for sign in (1, -1):
            z = np.concatenate([q, p])
            z[column] += sign * step
            end = henon.solve(z[:2], z[2:], t, tolerance=1e-13)
            moved.append(np.concatenate([end.q, end.p], axis=1))
        np.testing.assert_allclose(matrices[:, :, column], (moved[0] - moved[1]) / (2 * step), rtol=1e-6, atol=1e-7)
    # The matrices are symplectic.
    j = np.kron([[0, 1], [-1, 0]], np.eye(2))
    assert abs(matrices[-1].T @ j @ matrices[-1] - j).max() < 1e-9 * abs(matrices[-1]).max() ** 2


def test_derivatives_keep_the_order_of_arrays():
    text = "struct A { n: usize } H(q[n][3]; p[n][3]) = sum(i in 0..n) { (1 + i)*norm_squared(p[i])/2 } + q[1][2]*q[0][1]"
    chain = hm.define(text, n=2)
    sol = chain.solve(np.zeros((2, 3)), np.zeros((2, 3)), [0.0, 0.5])
    matrix = chain.sensitivity(sol)[-1]
    # ẍ of q[1][2] is −2·q[0][1], and of q[0][1] it is −q[1][2].
    free = [0, 2, 3, 4]
    assert matrix[free, [6 + i for i in free]] == pytest.approx([0.5, 0.5, 1.0, 1.0], rel=1e-12)
    assert matrix[5, 1] == pytest.approx(-0.25, rel=0.02) and matrix[1, 5] == pytest.approx(-0.125, rel=0.02)


def test_derivatives_with_respect_to_parameters():
    # ẍ = −(k/m)·x from (1, v): x = cos(w·t) + v·sin(w·t)/w with w = √(k/m).
    spring = hm.define("struct S { k, m: [2] } H(x; p) = p^2/(2*m[1]) + k*x^2/2 + 0*m[0]", k=4.0, m=[3.0, 2.0])
    t = np.linspace(0, 3, 4)
    sol = spring.solve(1.0, 0.0, t, tolerance=1e-13)
    all = spring.sensitivity(sol, parameters=["m", "k"])
    assert all.shape == (4, 2, 5) and (all[:, :, :2] == spring.sensitivity(sol)).all()
    w = np.sqrt(2.0)
    by_w = -t * np.sin(w * t)
    np.testing.assert_allclose(all[:, 0, 2:], np.stack([0 * t, -by_w * w / 4, by_w * w / 8], axis=1), atol=1e-9)
    # Over two intervals, for an H that is not quadratic, against differences.
    swing = hm.define("H(a; p) = p^2/(2*l^2) - g*l*cos(a)*(1 + p^2/50)", l=1.3, g=9.81)
    t = np.array([0.0, 0.4, 1.5])
    sol = swing.solve(1.0, 0.5, t, tolerance=1e-13)
    by_l = swing.sensitivity(sol, parameters="l", tolerance=1e-11)[:, :, 2]
    ends = [swing.with_(l=1.3 + h).solve(1.0, 0.5, t, tolerance=1e-13) for h in (1e-5, -1e-5)]
    ends = [np.concatenate([end.q, end.p], axis=1) for end in ends]
    np.testing.assert_allclose(by_l, (ends[0] - ends[1]) / 2e-5, rtol=1e-6, atol=1e-7)
    with pytest.raises(TypeError, match="there is no parameter `x`; there are `l`, `g`"):
        swing.sensitivity(sol, parameters=["x"])


def test_plots(spring):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    sol = spring.solve(1.0, 0.0, np.linspace(0, 10, 41))
    ax = sol.plot()
    assert len(ax.lines) == 1 and ax.get_xlabel() == "t"
    _, ax = plt.subplots()
    assert sol.plot("x", "p", ax=ax) is ax and (ax.lines[0].get_ydata() == sol.p[:, 0]).all()
    sol.plot(y=["energy", "speed"], ax=ax)
    assert len(ax.lines) == 3
    with pytest.raises(KeyError):
        sol.plot("x", "depth", ax=ax)
    plt.close("all")
