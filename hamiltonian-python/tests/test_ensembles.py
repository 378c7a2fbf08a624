"""Ensembles: broadcasting, parameters of members, failures, indicators of chaos."""

import os
import pickle

import hamiltonian as hm
import numpy as np
import pytest

HENON = "H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lam*(x^2*y - y^3/3)"


@pytest.fixture(scope="module")
def henon():
    return hm.define(HENON, lam=1.0)


def test_members_have_the_bits_of_their_runs(henon):
    rng = np.random.default_rng(1)
    q, lam = rng.normal(size=(37, 2)) * 0.1, np.linspace(0, 1, 37)
    swarm = henon.ensemble(q=q, p=0.05, lam=lam)
    assert (swarm.shape, len(swarm), swarm.t) == ((37,), 37, 0.0)
    assert (swarm.state.q == q).all() and (swarm.state.p == 0.05).all()
    end = swarm.advance_to(10.0, step=0.05)
    assert end.q.shape == (37, 2) and (end.t == 10.0).all()
    for member in (0, 17, 36):
        run = henon.with_(lam=lam[member]).run(q[member], 0.05, scheme="BlanesMoan4", step=0.05)
        due = run.advance_until(10.0)
        assert np.array_equal(end.q[member], due.q) and np.array_equal(end.p[member], due.p)
    energy = [henon.with_(lam=own).H(state_q, state_p) for own, state_q, state_p in zip(lam, *swarm.state[1:])]
    assert swarm.energy.tolist() == energy


def test_the_results_do_not_depend_on_threads(henon):
    q = np.random.default_rng(2).normal(size=(100, 2)) * 0.1
    one, all = (henon.ensemble(q, 0.0, threads=threads).advance_to(5.0, step=0.1) for threads in (1, None))
    assert np.array_equal(one.q, all.q) and np.array_equal(one.p, all.p)


def test_leading_axes_are_broadcast(henon):
    swarm = henon.ensemble(q=np.zeros((3, 1, 2)), p=[0.1, 0.2], lam=np.array([0.0, 0.5, 1.0, 2.0]))
    assert swarm.shape == (3, 4) and swarm.advance_to(1.0, step=0.1).q.shape == (3, 4, 2)
    assert swarm.energy.shape == (3, 4)
    arrays = hm.define("struct A { w: [3] } H(q[3]; p[3]) = sum(i in 0..3) { p[i]^2/2 + w[i]^2*q[i]^2/2 }", w=[1, 1, 1])
    w = np.array([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0]])
    end = arrays.ensemble(q=1.0, p=0.0, w=w).advance_to(1.0, step=0.01)
    np.testing.assert_allclose(end.q, np.cos(w), atol=1e-5)
    bodies = hm.define("struct A { n: usize } H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/2 }", n=2)
    q, p = np.arange(30.0).reshape(5, 2, 3), np.arange(6.0).reshape(2, 3)
    end = bodies.ensemble(q, p).advance_to(1.0, step=0.25)
    np.testing.assert_allclose(end.q, q + p, rtol=1e-13)


def test_calls_continue(henon):
    q = np.random.default_rng(3).normal(size=(10, 2)) * 0.1
    swarm, other = henon.ensemble(q, 0.0), henon.ensemble(q, 0.0)
    swarm.advance(20, step=0.1)
    assert swarm.t == pytest.approx(2.0)
    between = swarm.advance_to(2.03)
    assert (between.t == 2.03).all() and swarm.t == pytest.approx(2.0)
    end, due = swarm.advance_to(4.0), other.advance_to(4.0, step=0.1)
    assert np.array_equal(end.q, due.q)
    finer = swarm.advance_to(5.0, step=0.01)
    assert abs(finer.q - other.advance_to(5.0).q).max() < 1e-4
    assert other.advance_to(6.0, scheme="Gauss4").q.shape == (10, 2)


def test_members_that_fail_are_nan():
    falling = hm.define("H(x; p) = p^2/2 + 10*sqrt(x)")
    swarm = falling.ensemble(q=np.array([[1.0], [100.0]]), p=-1.0)
    end = swarm.advance_to(2.0, step=0.01)
    assert np.isnan(end.q[0, 0]) and np.isfinite(end.q[1, 0])
    assert list(swarm.errors) == [(0,)] and swarm.errors[0,]
    assert "2 members of H at t = 2, 1 failed" in repr(swarm)


def test_arguments_are_checked(henon):
    for call, error, text in [
        (lambda: henon.ensemble(np.zeros((3, 2)), np.zeros((4, 2))), ValueError, "do not fit together"),
        (lambda: henon.ensemble(np.zeros((3, 2)), 0.0, lam=np.zeros(4)), ValueError, "do not fit together"),
        (lambda: henon.ensemble(np.zeros((0, 2)), 0.0), ValueError, "at least one member"),
        (lambda: henon.ensemble(np.zeros((3, 3)), 0.0), ValueError, "`q` must have the shape (…, 2)"),
        (lambda: henon.ensemble(np.full((3, 2), np.nan), 0.0), ValueError, "`q` is nan at index (0, 0)"),
        (lambda: henon.ensemble([0, 0], 0.0, mu=1.0), TypeError, "there is no parameter `mu`; there are `lam`"),
        (lambda: henon.ensemble([0, 0], 0.0, lam=np.array([1.0, np.nan])), ValueError, "the parameter `lam` is NaN"),
        (lambda: henon.ensemble([0, 0], 0.0, lam="1"), TypeError, "`lam` must be a real number"),
        (lambda: henon.ensemble([0, 0], 0.0, threads=-1), ValueError, "`threads` must be a whole number"),
        (lambda: henon.ensemble([0, 0], 0.0).advance(10), TypeError, "the first call needs a `step`"),
        (lambda: henon.ensemble([0, 0], 0.0).advance_to(1.0, step=0.0), ValueError, ""),
        (lambda: henon.ensemble([0, 0], 0.0).advance_to(-1.0, step=0.1), ValueError, "behind"),
        (lambda: henon.ensemble([0, 0], 0.0).advance_to(np.inf, step=0.1), ValueError, "`t` is inf"),
        (lambda: henon.ensemble([0, 0], 0.0).advance_to(1e300, step=0.1), ValueError, "cannot be reached"),
        (lambda: henon.ensemble([0, 0], 0.0).megno(1e300, step=0.1), ValueError, "from 1 to 2^53 steps"),
        (lambda: henon.ensemble([0, 0], 0.0).advance(-1, step=0.1), ValueError, "`steps` must be a whole number"),
        (lambda: henon.ensemble([0, 0], 0.0).advance(1, step=0.1, scheme="Verlet"), ValueError, "no scheme `Verlet`"),
        (lambda: henon.ensemble([0, 0], 0.0).lyapunov(0.0, step=0.1), ValueError, "from 1 to 2^53 steps"),
        (lambda: henon.ensemble([0, 0], 0.0).lyapunov(1.0, step=0.1, deviations=9), ValueError, ""),
    ]:
        with pytest.raises(error) as raised:
            call()
        assert text in str(raised.value)
    sized = hm.define("struct A { n: usize } H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 }", n=2)
    with pytest.raises(ValueError, match="the size `n` is that of all members"):
        sized.ensemble([0, 0], 0.0, n=[2, 3])
    none = sized.with_(n=0)
    with pytest.raises(ValueError, match="its system at least one coordinate"):
        none.ensemble(np.zeros((3, 0)), 0.0)
    with pytest.raises(ValueError, match="without coordinates"):
        none.sensitivity(none.solve([], [], [0, 1]))
    product = hm.define("H = (q^2 + 1)*(p^2 + 1)/2")
    with pytest.raises(ValueError, match="couples q and p"):
        product.ensemble(1.0, 0.0).advance(1, step=0.1, scheme="StormerVerlet")


def test_indicators_of_chaos(henon):
    # At E = 1/8: a regular orbit near the stable one, and a chaotic one.
    y, py = np.array([0.3, -0.2]), np.array([0.0, 0.0])
    px = np.sqrt(2 * (1 / 8 - py**2 / 2 - y**2 / 2 + y**3 / 3))
    q, p = np.stack([0 * y, y], axis=1), np.stack([px, py], axis=1)
    swarm = henon.ensemble(q, p)
    exponents, megno = swarm.lyapunov(t=2000.0, step=0.1), swarm.megno(t=2000.0, step=0.1)
    assert exponents.shape == megno.shape == (2,) and swarm.t == 0.0
    assert abs(megno[0] - 2) < 0.3 and megno[1] > 10
    assert exponents[0] < 0.01 < 0.02 < exponents[1] < 0.08
    # Exponents of a Hamiltonian system come in pairs of opposite sign.
    spectrum = swarm.lyapunov(t=500.0, step=0.1, deviations=4)
    assert spectrum.shape == (2, 4) and abs(spectrum.sum(axis=1)).max() < 1e-9
    rotor = hm.define("H = (q^2 + 1)*(p^2 + 1)/2 + sin(q*p)/5")
    assert abs(rotor.ensemble(np.array([[0.5], [1.0]]), 0.0).megno(100.0, step=0.05) - 2).max() < 1.0


def test_progress(henon, capsys):
    pytest.importorskip("tqdm")
    swarm = henon.ensemble(np.full((10, 2), 0.1), 0.0)
    swarm.advance(1000, step=0.01, progress=True)
    assert "1000/1000" in capsys.readouterr().err
    assert swarm.t == pytest.approx(10.0)


def test_a_callback_that_fails_ends_the_call(henon, monkeypatch):
    from hamiltonian import ensembles

    class Bar:
        n = 0

        def update(self, made):
            raise ZeroDivisionError("in the callback")

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

    monkeypatch.setattr(ensembles, "_bar", lambda steps: Bar())
    swarm = henon.ensemble(np.full((10, 2), 0.1), 0.0)
    with pytest.raises(ZeroDivisionError, match="in the callback"):
        swarm.advance(10**9, step=0.01, progress=True)
    assert swarm.t > 0
    swarm.advance(10)


def test_pickles_continue_with_the_same_bits(henon):
    # The first member leaves the well and fails; the others have parameters of their own.
    q = np.array([[[30.0, 30.0], [0.1, 0.2]]])
    swarm = henon.ensemble(q, 0.05, t=1.0, lam=np.array([[1.0], [0.5]]))
    fresh = pickle.loads(pickle.dumps(swarm))
    assert fresh.t == 1.0 and np.array_equal(fresh.state.q, swarm.state.q)
    swarm.advance(40, step=0.05)
    swarm.advance(30, scheme="Srkn6b")  # from states on the way
    assert list(swarm.errors) == [(0, 0), (1, 0)]
    other = pickle.loads(pickle.dumps(swarm))
    assert other.shape == (2, 2) and other.errors == swarm.errors and other.t == swarm.t == 4.5
    for one in (swarm, other):
        one.advance(50)
    assert other.t == swarm.t == 7.0
    for a, b in zip(swarm.state, other.state):
        assert np.array_equal(a, b, equal_nan=True)
    with pytest.raises(ValueError, match="not the bytes of a saved run"):
        other.__setstate__({**swarm.__getstate__(), "_own": b"scheme"})


def test_sweeps_fill_stores(henon, tmp_path):
    xr = pytest.importorskip("xarray")
    pytest.importorskip("zarr")
    q = np.array([[0.1, 0.2], [30.0, 30.0], [0.0, 0.3]])
    swarm = henon.ensemble(q, 0.05, lam=np.array([1.0, 1.0, 0.5]))
    swarm.advance_to(1.0, step=0.05)
    columns = ["x", "py", "H", "drift"]
    swarm.sweep(tmp_path / "map.zarr", t=[2.0, 3.51], record=columns)
    assert swarm.t == 1.0
    data = xr.open_zarr(tmp_path / "map.zarr")
    assert data.x.dims == ("member", "t") and data.t.values.tolist() == [2.0, 3.51]
    # Members that begin where the swarm stands.
    others, state = [0, 2], swarm.state
    again = henon.ensemble(state.q[others], state.p[others], t=1.0, lam=np.array([1.0, 0.5]))
    for row, t in enumerate([2.0, 3.51]):
        state = again.advance_to(t, step=0.05)
        assert data.x.values[others, row].tolist() == state.q[:, 0].tolist()
        assert data.py.values[others, row].tolist() == state.p[:, 1].tolist()
    assert (data.drift.values[[0, 2]] > 0).all() and (data.drift.values[[0, 2]] < 1e-3).all()
    # The member that has left is NaN, with a status above 2.
    assert np.isnan(data.x.values[1]).all() and data.status.values[1] > 2
    # One row for each member at the end; a run of the same sweep does nothing more.
    for _ in range(2):
        swarm.sweep(str(tmp_path / "end.zarr"), t=5.0, record="y", progress=True)
    end = xr.open_zarr(tmp_path / "end.zarr")
    assert end.y.dims == ("member",) and end.y.values[0] == again.advance_to(5.0).q[0, 1]


def test_sweeps_refuse_what_they_cannot_record(henon, tmp_path):
    swarm = henon.ensemble([[0.1, 0.2]], 0.05)
    path = tmp_path / "map.zarr"
    with pytest.raises(ValueError, match=r"nothing named `z` to record; there are `t`, `H`, `drift`, `x`, `px`, `y`, `py`"):
        swarm.sweep(path, t=1.0, record=["z"], step=0.1)
    with pytest.raises(ValueError, match="ensembles do not have `Gauss8`"):
        swarm.sweep(path, t=1.0, record=["x"], step=0.1, scheme="Gauss8")
    with pytest.raises(TypeError, match="needs a `step`"):
        swarm.sweep(path, t=1.0, record=["x"])
    with pytest.raises(ValueError, match="a time or a list of times"):
        swarm.sweep(path, t=[], record=["x"], step=0.1)
    swarm.sweep(path, t=1.0, record=["x"], step=0.1)
    with pytest.raises(hm.RunError, match="map.zarr"):
        swarm.sweep(path, t=2.0, record=["x"], step=0.1)


@pytest.mark.skipif(os.name != "posix", reason="limits of POSIX")
def test_a_full_disk_is_an_error_and_what_is_written_stays(henon, tmp_path):
    import resource

    swarm = henon.ensemble(np.linspace(0, 0.3, 40).reshape(20, 2), 0.1)
    options = {"t": np.linspace(1, 100, 100), "record": ["x", "drift"], "step": 0.1}
    swarm.sweep(tmp_path / "due.zarr", **options)
    # As on a full disk, writing fails: here beyond so many bytes of a file. Python ignores the signal.
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    try:
        with pytest.raises(hm.RunError) as raised:
            swarm.sweep(tmp_path / "map.zarr", **options)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert "large" in str(raised.value)
    swarm.sweep(tmp_path / "map.zarr", **options)
    files = [path.relative_to(tmp_path / "due.zarr") for path in (tmp_path / "due.zarr").rglob("*") if path.is_file()]
    assert files and all((tmp_path / "map.zarr" / path).read_bytes() == (tmp_path / "due.zarr" / path).read_bytes() for path in files)
