"""Definitions: names, values, derivatives, copies, pickles."""

import copy
import math
import pickle

import hamiltonian as hm
import numpy as np
import pytest

HENON = """
H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lam*(x^2*y - y^3/3);
event section = x;
monitor speed = sqrt(px^2 + py^2)
"""
BODIES = """
struct Bodies { n: usize, G = 1.0, m: [n] }
H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
    - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
invariant angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) }
"""


@pytest.fixture(scope="module")
def henon():
    return hm.define(HENON, lam=1.0)


@pytest.fixture(scope="module")
def bodies():
    return hm.define(BODIES, n=4, m=[1.0, 2.0, 3.0, 4.0])


def test_names(henon, bodies):
    assert (henon.name, bodies.name) == ("H", "Bodies")
    assert henon.coordinates == ("x", "y") and henon.momenta == ("px", "py")
    assert henon.shape == (2,) and bodies.shape == (4, 3)
    assert henon.events == ("section",) and henon.monitors == ("speed",) and henon.invariants == ()
    assert bodies.invariants == tuple(f"angular_momentum[{i}]" for i in range(3))
    assert bodies.sizes == {"n": 4} and bodies.parameters["G"] == 1.0
    assert bodies.parameters["m"].tolist() == [1.0, 2.0, 3.0, 4.0]
    free = hm.define("H(x, y; px, py) = (px^2 + py^2)/2 + y^2")
    assert free.cyclic == ("x",)


def test_structure():
    product = hm.define("H = (q^2 + 1)*(p^2 + 1)/2")
    assert len(product.pieces) >= 2 and all(product.pieces.values())
    assert "couples q and p" in product.missing["Separable"] and "Split" not in product.missing
    assert "Separable" not in hm.define("H = p^2/2 - cos(q)").missing


def test_shown(henon, bodies):
    shown = repr(henon).splitlines()
    assert shown[0] == "H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lam*(x^2*y - y^3/3)"
    assert shown[1] == "with lam = 1.0"
    assert "H is separable" in shown[2]
    assert shown[-2:] == ["monitors: speed", "events: section"]
    assert "n = 4, G = 1.0, m = [1., 2., 3., 4.]" in repr(bodies)
    assert "invariants: angular_momentum[0], " in repr(bodies)
    assert henon._repr_latex_().startswith("$\\displaystyle H = \\frac{1}{2}")


def test_values_are_those_of_numpy(henon, bodies):
    rng = np.random.default_rng(1)
    q, p = rng.normal(size=(2, 5, 7, 2))
    x, y, px, py = q[..., 0], q[..., 1], p[..., 0], p[..., 1]
    due = (px**2 + py**2) / 2 + (x**2 + y**2) / 2 + x**2 * y - y**3 / 3
    assert henon.H(q, p).shape == (5, 7)
    np.testing.assert_allclose(henon.H(q, p), due, rtol=1e-13, atol=1e-14)
    dq, dp = henon.gradient(q, p)
    np.testing.assert_allclose(dq, np.stack([x + 2 * x * y, y + x**2 - y**2], axis=-1), rtol=1e-12, atol=1e-14)
    assert (dp == p).all()
    of_q, of_p = henon.field(q, p)
    assert (of_q == dp).all()
    np.testing.assert_allclose(of_p, -dq, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(henon.observable("speed", q, p), np.hypot(px, py), rtol=1e-15)

    # Arrays of two axes are row after row: the order in the system is another one.
    q, p = rng.normal(size=(2, 6, 4, 3))
    m = np.arange(1.0, 5.0)
    due = (p**2 / (2 * m[:, None])).sum(axis=(1, 2))
    for i in range(4):
        for j in range(i):
            due -= m[i] * m[j] / np.linalg.norm(q[:, i] - q[:, j], axis=-1)
    np.testing.assert_allclose(bodies.H(q, p), due, rtol=1e-13)
    dq, dp = bodies.gradient(q, p)
    assert dq.shape == (6, 4, 3)
    np.testing.assert_allclose(dp, p / m[:, None], rtol=1e-15)
    step = 1e-6
    moved = q.copy()
    moved[:, 2, 1] += step
    np.testing.assert_allclose((bodies.H(moved, p) - bodies.H(q, p)) / step, dq[:, 2, 1], rtol=1e-3, atol=1e-4)
    np.testing.assert_allclose(bodies.observable("angular_momentum[2]", q, p), np.cross(q, p).sum(axis=1)[:, 2])


def test_mixed_groups_keep_their_places():
    text = "H(s, u[2][3], v[2]; ps, pu[2][3], pv[2]) = ps^2/2 + sum(i in 0..2) { norm_squared(pu[i])/2 + pv[i]^2/2 }"
    mixed = hm.define(text + " + s + u[0][1]*10 + u[1][2]*100 + v[1]*1000")
    assert mixed.shape == (9,)
    dq, dp = mixed.gradient(np.zeros(9), np.arange(9.0))
    assert dq.tolist() == [1, 0, 10, 0, 0, 0, 100, 0, 1000] and dp.tolist() == list(range(9))


def test_points_are_broadcast(henon):
    driven = hm.define("H(q; p; t) = p^2/2 - q*cos(t)")
    t = np.linspace(0, 1, 5)
    np.testing.assert_allclose(driven.H(2.0, 0.0, t), -2 * np.cos(t), rtol=1e-15)
    assert driven.field([1.0], [3.0])[0].tolist() == [3.0]
    assert henon.H(np.zeros((4, 1, 2)), np.zeros((3, 2))).shape == (4, 3)
    assert henon.H(np.zeros((0, 2)), 0.0).shape == (0,)
    assert henon.H([0.0, 0.1], 0.0) == henon.H([0.0, 0.1], [0.0, 0.0])
    # Views and other types are read as they are.
    whole = np.arange(8.0).reshape(4, 2)
    assert henon.H(whole[::2], 0).tolist() == henon.H(whole[::2].copy(), 0).tolist()
    assert henon.H(np.array([1, 2], dtype=np.int32), np.float32(0)) == henon.H([1.0, 2.0], 0.0)
    assert henon.H(np.array([[1, 2], [3, 4]]).T, 0).tolist() == henon.H([[1.0, 3.0], [2.0, 4.0]], 0.0).tolist()


def test_outside_of_the_domain_values_are_not_finite():
    kepler = hm.define("H(x; p) = p^2/2 - 1/x + ln(x)")
    assert not np.isfinite(kepler.H(0.0, 0.0)) and np.isnan(kepler.H(-1.0, 0.0))
    assert np.isnan(kepler.H(np.nan, 0.0)) and np.isfinite(kepler.H(1.0, 0.0))


def test_other_values(henon, bodies):
    other = henon.with_(lam=0.5)
    assert (henon.parameters, other.parameters) == ({"lam": 1.0}, {"lam": 0.5})
    assert other.H([0.0, 1.0], 0.0) == 0.5 - 0.5 / 3
    larger = bodies.with_(n=2, m=[1.0, 1.0])
    assert larger.shape == (2, 3) and bodies.shape == (4, 3)
    masses = np.array([1.0, 1.0])
    own = bodies.with_(n=2, m=masses)
    masses[0] = 7.0
    assert own.parameters["m"].tolist() == [1.0, 1.0]


def test_matrices_of_parameters():
    text = "struct A { K: [2][3] } H(a[2], b[3]; pa[2], pb[3]) = norm_squared(pa)/2 + norm_squared(pb)/2 + dot(a, K*b)"
    matrix = np.arange(6.0).reshape(2, 3)
    own = hm.define(text, K=matrix)
    assert own.H([0, 1, 0, 0, 1], 0) == matrix[1, 2]
    assert own.with_(K=np.asfortranarray(matrix)).H([0, 1, 0, 0, 1], 0) == matrix[1, 2]
    with pytest.raises(ValueError, match=r"`K` must have the shape \(2, 3\), found \(3, 2\)"):
        hm.define(text, K=matrix.T)


def test_copies_and_pickles(henon, bodies):
    assert copy.copy(henon) is henon and copy.deepcopy(henon) is henon
    for system in (henon, bodies):
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
            again = pickle.loads(pickle.dumps(system, protocol))
            assert repr(again) == repr(system)
            q = np.linspace(0.1, 1, math.prod(again.shape)).reshape(again.shape)
            assert again.H(q, q) == system.H(q, q)


def test_files(tmp_path):
    path = tmp_path / "spring.txt"
    path.write_text("// A spring\nH(x; p) = p^2/2 + k*x^2/2 // of constant k", encoding="utf-8")
    assert hm.load(path, k=4.0).H(1.0, 0.0) == 2.0
    path.write_text("H(x; p) = p^2/2 +\n", encoding="utf-8")
    with pytest.raises(hm.DefinitionError) as raised:
        hm.load(path)
    assert raised.value.source == str(path)
    with pytest.raises(OSError):
        hm.load(tmp_path / "none.txt")
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(UnicodeDecodeError):
        hm.load(path)


def test_errors_carry_the_diagnostics():
    with pytest.raises(hm.DefinitionError) as raised:
        hm.define("H(x; p) = p^2/2 + k*x^2/2;\ninvariant momentum = p", k=1.0)
    error = raised.value
    assert error.message.startswith("`momentum` is not conserved: its time derivative is `-k*x`")
    assert error.help == "correct it or H, or declare it as `monitor`"
    assert (error.source, error.line, error.column) == ("definition", 2, 11)
    assert error.text == "invariant momentum = p"
    assert "\n2 | invariant momentum = p\n  |           ^^^^^^^^\n" in str(error)
    assert isinstance(error, ValueError) and len(error.diagnostics) == 1
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.diagnostics) == (str(error), error.diagnostics)

    with pytest.raises(hm.DefinitionError) as raised:
        hm.define("struct A {} H(q; p) = p^2/2 + a + b")
    assert len(raised.value.diagnostics) == 2


def test_features_of_rust_alone_are_named():
    with pytest.raises(hm.DefinitionError, match="written in Rust") as raised:
        hm.define("struct A {}\nfn f(x) = sin, (cos);\nH = p^2/2 + f(q)")
    assert raised.value.message.startswith("the function `f`") and raised.value.line == 2


def test_threads_define_at_once():
    from concurrent.futures import ThreadPoolExecutor

    def of(k):
        return float(hm.define("H(x; p) = p^2/2 + k*x^2/2", k=float(k)).H(2.0, 0.0))

    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(of, range(40))) == [2.0 * k for k in range(40)]


def test_functions_with_data():
    text = "struct Well { V: fn(r), W: fn(x, y), m = 1.0 } H(x, y; u, v) = (u^2 + v^2)/(2*m) + V(x) + W(x, y)"
    knots = np.linspace(-4, 4, 17)
    spline = hm.Spline(knots, knots**2/2)
    x, y = np.meshgrid(knots, knots, indexing="ij")
    grid = hm.Grid([-4, -4], [0.5, 0.5], y**2/2 + 0*x)
    well = hm.define(text, V=spline, W=grid, m=2.0)
    assert well.H([0.3, 0.7], 0.0) == spline(0.3) + grid(0.3, 0.7)
    assert abs(spline(knots) - knots**2/2).max() < 1e-14 and np.isnan(spline(5.0))
    again = pickle.loads(pickle.dumps(well))
    sol = again.solve(q=[1, 0], p=[0, 1], t=[0, 1], scheme="BlanesMoan6", step=0.05)
    assert abs(sol.q[1, 0] - np.cos(1/np.sqrt(2))) < 0.01 and abs(sol.energy[1]/sol.energy[0] - 1) < 1e-6
    for values, error, words in [
        ({"V": spline, "W": spline}, ValueError, "`W` must be a function of two numbers"),
        ({"V": spline}, TypeError, "`W` has no default"),
        ({"V": spline, "W": 1.0}, TypeError, "`W` must be a function: a `Spline` or a `Grid`"),
        ({"V": spline, "W": grid, "m": spline}, TypeError, "`m` must be a real number"),
    ]:
        with pytest.raises(error, match=words):
            hm.define(text, **values)
    with pytest.raises(ValueError, match="knot"):
        hm.Spline([0, 0, 1], [1, 2, 3])
