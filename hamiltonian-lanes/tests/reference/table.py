"""Writes double_double.txt, values of operations and functions at double-double points, and
decimal.txt, decimal numbers beside their words and the 32 digits of these.

Run from the folder of the crate: python3 tests/reference/table.py
Needs mpmath (pip install mpmath).

A line is `function words-of-the-arguments words-of-the-value`, each word the bits of an f64 in
hexadecimal; one of decimal.txt is `text words digits`. Values are computed with 50 digits beyond what cancellation takes (2600 bits, so that
sines of 1e300 are right) and rounded to two words. Points: uniform, log-uniform over the full
range, near zeros, poles and branch points.
"""
import random
import struct
from decimal import Decimal, getcontext
from fractions import Fraction

from mpmath import mp, mpf
import mpmath

mp.prec = 2600
random.seed(1971)
getcontext().prec = 32


def words(x):
    hi = float(x)
    lo = float(x - mpf(hi))
    return hi, lo


def bits(w):
    return struct.pack(">d", w).hex()


def near(hi):
    """A double-double whose leading word is hi."""
    lo = hi * 2.0**-53 * random.uniform(-0.49, 0.49)
    return words(mpf(hi) + mpf(lo))


def exactly(hi):
    return (float(hi), 0.0)


def uniform(a, b, n):
    return [near(random.uniform(a, b)) for _ in range(n)]


def spread(low, high, n, signs=(1, -1)):
    """n points log-uniform in size from 10^low to 10^high."""
    return [near(random.choice(signs) * 10 ** random.uniform(low, high)) for _ in range(n)]


def around(centre, low, high, n, signs=(1, -1)):
    """n points at a distance of 10^low to 10^high from a centre."""
    return [words(centre + random.choice(signs) * mpf(10) ** random.uniform(low, high))
            for _ in range(n)]


def multiples(unit, largest, n):
    """n double-doubles next to a multiple of a unit, and the f64s next to one."""
    out = []
    for i in range(n):
        k = random.randint(1, largest)
        x = words(k * unit)
        out.append(x if i % 2 else exactly(x[0]))
    return out


pi = mp.pi
angles = (uniform(-8, 8, 80) + spread(-250, 0, 30) + spread(0, 16, 50) + spread(16, 300, 40)
          + multiples(pi / 2, 20, 20) + multiples(pi / 2, 10**15, 20)
          + [exactly(2.0**k) for k in (1, 20, 52, 53, 54, 100, 500, 1000, 1023)]
          + [exactly(6381956970095103 * 2.0**797)])
everywhere = uniform(-4, 4, 80) + spread(-250, 0, 60) + spread(0, 290, 60)
unit_interval = (uniform(-1, 1, 100) + spread(-250, 0, 60) + around(mpf(1), -30, -1, 30, (-1,))
                 + around(mpf(-1), -30, -1, 30, (1,)))
exponents = uniform(-1, 1, 60) + uniform(-650, 690, 100) + spread(-250, 0, 60)
# sinh and cosh are finite a little beyond exp.
hyperbolic = (uniform(-1, 1, 60) + uniform(-690, 690, 80) + spread(-250, 0, 60)
              + uniform(0.3, 0.4, 20) + uniform(39, 41, 20))
positive = (uniform(0.4, 2, 80) + spread(-280, 300, 100, (1,)) + around(mpf(1), -30, -1, 40)
            + [exactly(5e-324), exactly(2.0**-1040), exactly(1.7e308)])

ONE_ARGUMENT = {
    "sqrt": (mpmath.sqrt, spread(-280, 308, 200, (1,)) + [exactly(1.7e308), exactly(2.0)]),
    "cbrt": (lambda x: mpmath.sign(x) * mpmath.cbrt(abs(x)),
             spread(-280, 308, 200) + [exactly(1.7e308), exactly(-27.0)]),
    "sin": (mpmath.sin, angles),
    "cos": (mpmath.cos, angles),
    "tan": (mpmath.tan, angles),
    "asin": (mpmath.asin, unit_interval),
    "acos": (mpmath.acos, unit_interval),
    "atan": (mpmath.atan, everywhere),
    "sinh": (mpmath.sinh, hyperbolic),
    "cosh": (mpmath.cosh, hyperbolic),
    "tanh": (mpmath.tanh, hyperbolic + everywhere[:40]),
    "asinh": (mpmath.asinh, everywhere + spread(15, 18, 20)),
    "acosh": (mpmath.acosh, around(mpf(1), -30, 1, 100, (1,)) + spread(0.01, 300, 80, (1,))
              + spread(15, 18, 20, (1,))),
    "atanh": (mpmath.atanh, unit_interval),
    "exp": (mpmath.exp, exponents),
    "exp_m1": (mpmath.expm1, exponents + uniform(-0.4, 0.4, 60)),
    "ln": (mpmath.log, positive),
    "ln_1p": (mpmath.log1p, uniform(-0.99, 3, 80) + spread(-250, 0, 80)[:80]
              + spread(0, 300, 40, (1,)) + around(mpf(-1), -30, -1, 30, (1,))),
}

plane = []
for _ in range(150):
    plane.append((near(random.uniform(-3, 3)), near(random.uniform(-3, 3))))
for _ in range(100):
    y = random.choice((1, -1)) * 10 ** random.uniform(-140, 140)
    x = random.choice((1, -1)) * 10 ** random.uniform(-140, 140)
    plane.append((near(y), near(x)))
for _ in range(40):
    scale = 10 ** random.uniform(280, 307)
    plane.append((near(scale * random.uniform(-1, 1)), near(scale * random.uniform(-1, 1))))
    scale = 10 ** random.uniform(-270, -200)
    plane.append((near(scale * random.uniform(-1, 1)), near(scale * random.uniform(-1, 1))))

powers = []
for _ in range(150):
    powers.append((near(10 ** random.uniform(-3, 3)), near(random.uniform(-20, 20))))
for n in range(-40, 41):
    powers.append((near(random.uniform(-4, 4)), exactly(n)))
for _ in range(60):
    x = 10 ** random.uniform(-200, 200)
    powers.append((near(x), near(random.uniform(-1, 1))))
for _ in range(60):
    x = 1 + random.choice((1, -1)) * 10 ** random.uniform(-10, -1)
    powers.append((near(x), near(random.uniform(-600, 600) / abs(mpmath.log(x)).__float__())))

pairs = [(a, b) for a, b in zip(spread(-120, 120, 150), spread(-120, 120, 150))]
cancelling = []
for _ in range(150):
    a = near(random.uniform(-3, 3))
    b = words(-(mpf(a[0]) + mpf(a[1])) * (1 + mpf(2) ** random.uniform(-104, -1)))
    cancelling.append((a, b))

TWO_ARGUMENTS = {
    "add": (lambda x, y: x + y, plane[:150] + cancelling),
    "mul": (lambda x, y: x * y, plane[:150] + pairs),
    "div": (lambda x, y: x / y, plane[:150] + pairs),
    "atan2": (mpmath.atan2, plane),
    "hypot": (lambda y, x: mpmath.sqrt(y * y + x * x), plane),
    "pow": (lambda x, y: x ** int(y) if y == int(y) else x ** y, powers),
}


def line(name, arguments, value):
    size = abs(value)
    if not mpf("1e-280") < size < mpf("1.7e308"):
        return None
    if any(a[0] != 0 and abs(a[0]) < 1e-290 and name != "ln" for a in arguments):
        return None
    text = [bits(w) for a in arguments for w in a] + [bits(w) for w in words(value)]
    return " ".join([name] + text)


lines = []
for name, (function, points) in ONE_ARGUMENT.items():
    for p in points:
        x = mpf(p[0]) + mpf(p[1])
        if name in ("asin", "acos", "atanh") and abs(x) > 1:
            continue
        if name == "ln_1p" and x <= -1:
            continue
        if name == "tan" and mpmath.cos(x) == 0:
            continue
        lines.append(line(name, (p,), function(x)))
for name, (function, points) in TWO_ARGUMENTS.items():
    for a, b in points:
        lines.append(line(name, (a, b), function(mpf(a[0]) + mpf(a[1]), mpf(b[0]) + mpf(b[1]))))

texts = []
for k in range(200):
    if k < 60:
        text = random.choice(("", "-")) + f"{random.randint(0, 999)}." + "".join(
            random.choice("0123456789") for _ in range(random.randint(1, 45)))
    else:
        text = (random.choice(("", "-")) + f"{random.randint(1, 9)}." + "".join(
            random.choice("0123456789") for _ in range(random.randint(1, 90)))
            + f"e{random.randint(-270, 307)}")
    hi, lo = words(mpf(text))
    value = Fraction(hi) + Fraction(lo)
    # Decimal's division rounds the exact quotient to 32 digits, ties to even.
    digits = f"{Decimal(value.numerator) / Decimal(value.denominator):.31e}".replace("e+", "e")
    texts.append(" ".join((text, bits(hi), bits(lo), digits)))
# Drawn last, so that the points above stay what they were.
ERRORS = {
    "erf": (mpmath.erf, uniform(-6, 6, 120) + spread(-250, 0, 60) + uniform(0.9, 1.1, 20)),
    "erfc": (mpmath.erfc, uniform(-6, 25, 160) + spread(-250, 0, 40) + uniform(0.4, 1.1, 60)),
}
for name, (function, points) in ERRORS.items():
    for p in points:
        lines.append(line(name, (p,), function(mpf(p[0]) + mpf(p[1]))))

with open("tests/reference/decimal.txt", "w", encoding="ascii") as out:
    out.write("\n".join(texts) + "\n")

with open("tests/reference/double_double.txt", "w", encoding="ascii") as out:
    out.write("\n".join(l for l in lines if l) + "\n")
