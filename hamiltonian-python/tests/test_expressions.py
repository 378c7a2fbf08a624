"""Expressions of SymPy as definitions."""

import hamiltonian as hm
import numpy as np
import pytest

sympy = pytest.importorskip("sympy")
from sympy import Rational as R  # noqa: E402
from sympy.physics.mechanics import dynamicsymbols  # noqa: E402

x, y, px, py, a, b, t = SYMBOLS = sympy.symbols("x y px py a b t", real=True)
sp = sympy
EXPRESSIONS = [
    (px**2 + py**2) / 2 + (x**2 + y**2) / 2 + a * (x**2 * y - y**3 / 3),
    px**2 / (2 * a) + sp.sqrt(1 + x**2) - a * sp.cos(y),
    1 / sp.sqrt(x**2 + y**2) + px / py**2,
    -x * R(1, 3) * y ** R(-3, 2) * px + py,
    sp.exp(-x) * sp.log(a) + sp.E**2 * x,
    sp.Piecewise((x**2, x < 0), (sp.sin(x) * a, (x < 1) | (y > 2)), (3, True)),
    sp.Piecewise((x, sp.And(x > 0, sp.Not(sp.Eq(y, 1)))), (y, True)) * 2,
    sp.Min(x, y, px) + sp.Max(x, 0) * py,
    sp.Abs(x - y) * sp.sign(px) + sp.atan2(y, x) + sp.sinh(x) / sp.cosh(y) + sp.tanh(py),
    x**y + (x + y) ** (a + b) * (-x) ** 2 + 2**x,
    -(x + y) * (px - py) / (a * b) + x / y / px / py,
    sp.pi * x * sp.GoldenRatio + sp.EulerGamma + sp.Catalan,
    sp.Float("1e-7") * x + sp.Float(1) / 3 * y + px * 1.5e30 / 1e30,
    sp.sec(x) * sp.cot(y) + sp.csch(x) - sp.coth(y),
    sp.ceiling(x) + sp.floor(y) + sp.Mod(x, 2) * 3,
    sp.Heaviside(x - 1) * y + sp.Heaviside(px, 1),
    (x**2) ** R(1, 3) + x ** (-a) + 1 / x ** (-y) + (1 / x) ** R(1, 2) + R(-1, 2) / x,
    (x**2) ** y + x ** (y**2) + (x**y) ** 2 + sp.exp(x) ** 2 + sp.exp(-(x**2)) / sp.exp(y),
    -(x**2) - 2 * x * (1 - 3 * y) - sp.sqrt(2) * x / 2,
    1 / (1 + 1 / (1 + x**2)) + x**-1 * y**-2 + (x * y) ** -1,
    -(a - b) - (x - y) - (-(x - y)) * 3,
    sp.erf(x) * sp.erfc(y) + sp.cbrt(x) + sp.acos(x / 9) + sp.atanh(y / 9),
    sp.diff(sp.sqrt(1 + x**2 * y), x) + sp.series(sp.sin(x), x, 0, 8).removeO(),
    sp.Matrix([[x, y], [a, 2]]).det() + sp.Matrix([x, y]).dot(sp.Matrix([a, b])),
]


@pytest.mark.parametrize("expression", EXPRESSIONS, ids=str)
def test_values_are_those_of_sympy(expression):
    h = px**2 + py**2 + expression
    rng = np.random.default_rng(len(str(expression)))
    used = [symbol for symbol in (a, b) if symbol in h.free_symbols]
    for _ in range(5):
        numbers = dict(zip(SYMBOLS, rng.uniform(0.3, 1.7, len(SYMBOLS))))
        values = {symbol.name: numbers[symbol] for symbol in used}
        system = hm.define(h, coordinates=(x, y), momenta=(px, py), **values)
        q, p = [numbers[x], numbers[y]], [numbers[px], numbers[py]]
        assert system.H(q, p) == pytest.approx(float(h.subs(numbers)), rel=1e-13)


def test_time_events_and_functions_of_time():
    theta, p = dynamicsymbols("theta p")
    time = dynamicsymbols._t
    h = p**2 / 2 - sympy.cos(theta) - theta * sympy.cos(3 * time)
    own = dict(events={"upright": sympy.sin(theta)}, monitors={"speed": p})
    system = hm.define(h, coordinates=theta, momenta=p, time=time, **own)
    assert system.text.startswith("H(theta; p; t) = ") and system.events == ("upright",) and system.monitors == ("speed",)
    assert system.H(0.5, 0.1, 2.0) == pytest.approx(0.005 - np.cos(0.5) - 0.5 * np.cos(6.0), rel=1e-14)
    conserved = hm.define(p**2 / 2, coordinates=theta, momenta=p, invariants={"momentum": p})
    assert conserved.invariants == ("momentum",)
    with pytest.raises(hm.DefinitionError, match="is not conserved"):
        hm.define(p**2 / 2 + theta, coordinates=theta, momenta=p, invariants={"momentum": p})


@pytest.mark.parametrize(
    ("call", "error", "text"),
    [
        (lambda: hm.define(x + px), TypeError, "needs its `coordinates` and `momenta`"),
        (lambda: hm.define(x * sympy.I + px, coordinates=x, momenta=px), ValueError, "`I` is not in the language"),
        (lambda: hm.define(px + sympy.besselj(0, x), coordinates=x, momenta=px), ValueError, "the function `besselj`"),
        (lambda: hm.define(px, coordinates=(x, y), momenta=px), ValueError, "as many momenta as coordinates"),
        (lambda: hm.define(px, coordinates=(), momenta=()), ValueError, "`coordinates` must not be empty"),
        (lambda: hm.define(x, coordinates=x, momenta=x), ValueError, "`x` is there twice"),
        (lambda: hm.define(x, coordinates=x + 1, momenta=px), TypeError, "`coordinates` must be symbols"),
        (lambda: hm.define(px + sympy.Symbol("x"), coordinates=x, momenta=px), ValueError, "two symbols are named `x`"),
        (lambda: hm.define(px + sympy.Symbol("x_{1}"), coordinates=x, momenta=px), ValueError, "needs a name of letters"),
        (lambda: hm.define(px + sympy.Integral(x, (x, 0, y)), coordinates=x, momenta=px), ValueError, "Integral"),
        (lambda: hm.define(px + sympy.Piecewise((x, x < 0)), coordinates=x, momenta=px), ValueError, "a last branch"),
        (lambda: hm.define(sympy.Matrix([px]), coordinates=x, momenta=px), TypeError, "a text or an expression"),
        (lambda: hm.define(px + sympy.oo * x, coordinates=x, momenta=px), ValueError, "`oo` is not in the language"),
        (lambda: hm.define(px**2 + a * x, coordinates=x, momenta=px), TypeError, "`a` has no default"),
    ],
)
def test_refused(call, error, text):
    with pytest.raises(error) as raised:
        call()
    assert text in str(raised.value)
