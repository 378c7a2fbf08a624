"""Bad input: each an exception with a text that names the argument and the fault."""

from fractions import Fraction

import hamiltonian as hm
import numpy as np
import pytest

SPRING = "H(x; p) = p^2/2 + k*x^2/2"
CHAIN = "struct C { n: usize, m: [n] } H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + q[i]^2/2 }"


@pytest.mark.parametrize(
    ("values", "error", "text"),
    [
        ({}, TypeError, "`k` has no default: give it a value"),
        ({"k": 1, "z": 2}, TypeError, "there is no parameter or size `z`; there are `k`"),
        ({"k": "1"}, TypeError, "`k` must be a real number or an array of them, found a value of type str"),
        ({"k": 1j}, TypeError, "found a value of type complex"),
        ({"k": True}, TypeError, "found a value of type bool"),
        ({"k": None}, TypeError, "found objects that are none"),
        ({"k": object()}, TypeError, "found objects that are none"),
        ({"k": b"1"}, TypeError, "found a value of type bytes"),
        ({"k": np.datetime64("2026-01-01")}, TypeError, "found a value of type datetime64"),
        ({"k": 10**400}, ValueError, "`k` has a number outside the range of float64"),
        ({"k": np.nan}, ValueError, "the parameter `k` is NaN"),
        ({"k": [1.0, 2.0]}, ValueError, "`k` must be a number"),
        ({"k": [[1.0], [2.0, 3.0]]}, ValueError, "`k` has rows of different lengths"),
        ({"k": np.ma.masked_array([1.0], [True])}, ValueError, "`k` has masked elements"),
    ],
)
def test_parameters(values, error, text):
    with pytest.raises(error) as raised:
        hm.define(SPRING, **values)
    assert text in str(raised.value)


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"n": -1, "m": []}, "`n` must be a size, a whole number that is not negative"),
        ({"n": 2.5, "m": [1, 1]}, "`n` must be a size"),
        ({"n": np.inf, "m": [1, 1]}, "`n` must be a size"),
        ({"n": np.nan, "m": [1, 1]}, "`n` must be a size"),
        ({"n": [2], "m": [1, 1]}, "`n` must be a size"),
        ({"n": 3, "m": [1, 1]}, "`m` must have 3 elements, found 2"),
        ({"n": 3, "m": 1}, "`m` must be a list of numbers"),
        ({"n": 2, "m": [1, np.nan]}, "the parameter `m` is NaN"),
        ({"n": 4, "m": [[1, 1], [1, 1]]}, "`m` must have the shape (4,), found (2, 2)"),
        ({"n": 10**12, "m": [1]}, "`q` does not fit into memory: the sizes are too large"),
        ({"n": 10**15, "m": [1]}, "does not fit into memory"),
        ({"n": 2**64, "m": [1]}, "`n` must be a size"),
    ],
)
def test_sizes(values, text):
    with pytest.raises(ValueError) as raised:
        hm.define(CHAIN, **values)
    assert text in str(raised.value)


def test_numbers_of_other_kinds_are_taken():
    assert hm.define(SPRING, k=Fraction(1, 2)).parameters == {"k": 0.5}
    assert hm.define(SPRING, k=np.float32(0.5)).parameters == {"k": 0.5}
    assert hm.define(SPRING, k=np.array(3)).parameters == {"k": 3.0}
    assert hm.define(SPRING, k=np.inf).parameters == {"k": np.inf}
    assert hm.define(CHAIN, n=np.int64(2), m=(1, 2)).sizes == {"n": 2}


@pytest.mark.parametrize(
    ("q", "p", "t", "error", "text"),
    [
        ([1.0], [1.0, 2.0], 0, ValueError, "`q` must have the shape (…, 2), found (1,)"),
        ([1.0, 2.0], [1.0, 2.0, 3.0], 0, ValueError, "`p` must have the shape (…, 2), found (3,)"),
        (np.zeros((3, 2)), np.zeros((4, 2)), 0, ValueError, "do not fit together: `q` (3,), `p` (4,)"),
        (np.zeros((3, 2)), 0, np.zeros(4), ValueError, "do not fit together: `q` (3,), `t` (4,)"),
        ("12", 0, 0, TypeError, "`q` must be a real number"),
        (["1", "2"], 0, 0, TypeError, "`q` must be a real number or an array of them, found an array of <U1"),
        ([1, 2j], 0, 0, TypeError, "found an array of complex128"),
        ([[1, 2], [3]], 0, 0, ValueError, "`q` has rows of different lengths"),
        ([1, 2], None, 0, TypeError, "`p` must be a real number"),
        ([1, 2], {}, 0, TypeError, "`p` must be a real number"),
        ([1, 2], 0, "now", TypeError, "`t` must be a real number"),
        (np.ma.masked_array([1.0, 2.0], [False, True]), 0, 0, ValueError, "`q` has masked elements"),
    ],
)
def test_points(q, p, t, error, text):
    system = hm.define("H(x, y; u, v) = (u^2 + v^2)/2 + x^2*y")
    for method in (system.H, system.gradient, system.field):
        with pytest.raises(error) as raised:
            method(q, p, t)
        assert text in str(raised.value)


def test_observables():
    system = hm.define("H(x; p) = p^2/2 + x; monitor height = x")
    with pytest.raises(KeyError, match="H declares no 'depth'; it has: height"):
        system.observable("depth", 1.0, 0.0)


@pytest.mark.parametrize("definition", [None, 3.5, b"H = p^2/2", ["H = p^2/2"], np.zeros(3)])
def test_no_texts(definition):
    pytest.importorskip("sympy")
    with pytest.raises(TypeError):
        hm.define(definition)


@pytest.mark.parametrize(
    "text", ["", " ", "\n\n", "H", "H =", "H = p^2/2 + ", "\0", "H = p^2/2 + q\0", "(", ")", '"', "'", "H = p^2/2 # q", "λ", "🦀", "H = p^2/2 + 🦀", "H = p^2/2 + q\ud800"]
)
def test_no_definitions(text):
    with pytest.raises((hm.DefinitionError, UnicodeEncodeError)) as raised:
        hm.define(text)
    if isinstance(raised.value, hm.DefinitionError):
        assert raised.value.message and raised.value.help and raised.value.line >= 1


def test_depth_is_limited():
    for text in ["H = p^2/2 + " + "(" * 5000 + "q" + ")" * 5000, "H = p^2/2 + " + "-" * 5000 + "q", "H = p^2/2" + "^2" * 5000]:
        with pytest.raises(hm.DefinitionError) as raised:
            hm.define(text)
        assert raised.value.message
