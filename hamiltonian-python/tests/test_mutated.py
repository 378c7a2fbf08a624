"""Definitions with one mistake: a system, or an exception that names the place."""

import random
import re

import hamiltonian as hm
import pytest

TEXTS = [
    "struct Pendulum { m = 1.0, l = 10.0, g = 9.81 } H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)",
    "struct Henon { lam = 1.0 } H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lam*(x^2*y - y^3/3); event section = x",
    "struct Product {} H(q; p) = (q^2 + 1)*(p^2 + 1)/2; split { A = (q^2 + 1)/2 + p^2/2; B = q^2*p^2/2 }",
    "struct Driven { a = 0.3, omega = 2.0 } H(q; p; t) = p^2/2 + q^4/4 - a*q*cos(omega*t); monitor power = p*a*cos(omega*t)",
    "struct Chain { n: usize, k = 1.0, m: [n] } H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + k*(exp(q[(i + 1) % n] - q[i]) - 1) }; invariant momentum = sum(i in 0..n) { p[i] }",
    "struct Bodies { n: usize, m: [n] } H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) } - sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }; invariant L = sum(i in 0..n) { cross(q[i], p[i]) }",
    "struct Damped { gamma = 0.1 } H(q; p) = p^2/2 - cos(q); force(q; p) = -gamma*p*abs(p)",
    "struct Switched { k = 3.0 } let r = x - y; H(x, y; u, v) = (u^2 + v^2)/2 + if x > y { k*r^2/2 } else { sqrt(1 + r^2) }",
    "struct Rod { m = 2.0 } L(x; v) = m*v^2/2 - x^4/4; monitor height = x",
    "struct Kepler { mu = 1.0 } H(x, y; px, py) = (px^2 + py^2)/2 - mu/sqrt(x^2 + y^2); invariant L = x*py - y*px",
]
WORDS = re.compile(r"\d+\.\d+|\.\.|\w+|\S")
EXTRA = ["(", ")", "{", "}", "[", "]", ";", ",", "+", "*", "^", "%", "=", "..", "q", "sum", "let", "1e999", "0", "-", "if", "norm", "é", "'"]


def mutated(text: str, rng: random.Random) -> str:
    """The text with one word removed, repeated, exchanged or replaced, or cut off."""
    words = WORDS.findall(text)
    at = rng.randrange(len(words))
    match rng.randrange(6):
        case 0:
            del words[at]
        case 1:
            words.insert(at, words[at])
        case 2:
            other = rng.randrange(len(words))
            words[at], words[other] = words[other], words[at]
        case 3:
            words[at] = rng.choice(EXTRA)
        case 4:
            words.insert(at, rng.choice(EXTRA))
        case _:
            words = words[: at + 1]
    return " ".join(words)


def values(text: str) -> dict:
    known = {"n": 3, "m": [1.0, 2.0, 3.0]}
    return {name: known[name] for name in ("n", "m") if f"{name} :" in text or f"{name}:" in text}


@pytest.mark.parametrize("text", TEXTS)
def test_as_written(text):
    assert hm.define(text, **values(text)).H(0.5, 0.5) == pytest.approx(hm.define(text, **values(text)).H(0.5, 0.5), nan_ok=True)


def test_two_hundred_mutations():
    rng = random.Random(41)
    refused = 0
    for number in range(200):
        text = mutated(TEXTS[number % len(TEXTS)], rng)
        try:
            system = hm.define(text, **values(text))
        except hm.DefinitionError as error:
            refused += 1
            for one in error.diagnostics:
                assert one.message and one.help, text
                assert "internal" not in one.message and "this is a fault" not in one.message, (text, str(error))
                assert 1 <= one.line <= text.count("\n") + 1 and 1 <= one.column <= len(text) + 1, text
                assert f"error: {one.message}" in str(error) and "^" in str(error), text
        except (TypeError, ValueError) as error:
            assert re.search(r"`\w+`", str(error)), (text, str(error))
        else:
            assert system.H(0.5, 0.25).shape == (), text
    # Most mutations are mistakes, and some are not.
    assert 100 <= refused < 195
