#!/usr/bin/env python3
"""Fits the polynomials of the elementary functions and prints their Rust tables.

Usage: python3 scripts/fit_functions.py > hamiltonian-real/src/elementary/coefficients.rs
Needs mpmath (any version since 1.0). Every number is computed here with 50 digits.

Method: E. Y. Remez's exchange (C. R. Acad. Sci. 199, 337, 1934) for the weighted error
weight(z)·(p(z) − f(z)), in the monomial basis. Coefficients are then rounded to double one after
the other, the lowest first; after each rounding the rest is fitted anew, so that higher
coefficients make up for the rounding of lower ones.
"""

import sys

from mpmath import (asin, atan, atanh, cos, cosh, erf, erfc, exp, log, lu_solve, matrix, mp, mpf,
                    pi, polyval, sin, sinh, sqrt)

mp.dps = 50


def nodes(low, high, count):
    """Chebyshev's extreme points on [low, high]."""
    return [(low + high) / 2 - (high - low) / 2 * cos(pi * k / (count - 1)) for k in range(count)]


def exchange(f, weight, low, high, powers):
    """The coefficients of the given powers with the smallest greatest weighted error, and it."""
    count = len(powers)
    points = nodes(low, high, count + 1)
    grid = nodes(low, high, 24 * (count + 2))
    targets = [(z, f(z), weight(z)) for z in grid]
    best = None
    for _ in range(40):
        rows = matrix(count + 1, count + 1)
        right = matrix(count + 1, 1)
        for i, z in enumerate(points):
            for j, power in enumerate(powers):
                rows[i, j] = z**power
            rows[i, count] = (-1) ** i / weight(z)
            right[i] = f(z)
        solution = lu_solve(rows, right)
        coefficients = list(solution)[:count]
        level = abs(solution[count])

        def error(z, value, scale):
            return scale * (sum(c * z**p for c, p in zip(coefficients, powers)) - value)

        errors = [error(*target) for target in targets]
        worst = max(abs(e) for e in errors)
        if best is None or worst < best[1]:
            best = (coefficients, worst)
        if worst <= level * mpf("1.02"):
            break
        # The extreme error of each run of one sign becomes the next set of points.
        extremes = []
        for (z, _, _), e in zip(targets, errors):
            if extremes and (extremes[-1][1] > 0) == (e > 0):
                if abs(e) > abs(extremes[-1][1]):
                    extremes[-1] = (z, e)
            else:
                extremes.append((z, e))
        while len(extremes) > count + 1:
            if abs(extremes[0][1]) < abs(extremes[-1][1]):
                extremes.pop(0)
            else:
                extremes.pop()
        if len(extremes) < count + 1:
            break
        points = [z for z, _ in extremes]
    return best


def fit(f, weight, low, high, count):
    """`count` doubles: the polynomial's coefficients from the lowest, and its weighted error.

    On an interval around 0 the higher powers alone cannot make up for a rounding: there every
    coefficient is rounded at once, and the lowest keeps a second word, the last of the list."""
    low, high = mpf(low), mpf(high)
    if low < 0:
        exact, _ = exchange(f, weight, low, high, list(range(count - 1)))
        rounded = [mpf(float(c)) for c in exact]
        second = mpf(float(exact[0] - rounded[0]))
    else:
        # At 0 every weight but that of erf is 0, and below high/1000 errors fall with it.
        low = high / 1000
        rounded, second = [], mpf(0)
        for done in range(count):
            def rest(z):
                return f(z) - polyval(rounded[::-1], z) if rounded else f(z)
            coefficients, _ = exchange(rest, weight, low, high, list(range(done, count)))
            rounded.append(mpf(float(coefficients[0])))
    error = max(abs(weight(z) * (polyval(rounded[::-1], z) + second - f(z)))
                for z in nodes(low, high, 400))
    return [float(c) for c in rounded] + ([float(second)] if second else []), error


def head(x, bits):
    """`x` cut to its first bits."""
    exponent = int(mp.floor(log(x, 2))) + 1
    scale = mpf(2) ** (bits - exponent)
    return mp.floor(x * scale) / scale


def literal(x):
    text = repr(float(x))
    mantissa, _, exponent = text.partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def constant(name, value, text):
    print(f"/// {text}\npub(crate) const {name}: f64 = {literal(value)};")


def table(name, text, f, weight, low, high, count):
    coefficients, error = fit(f, weight, low, high, count)
    bits = -log(error, 2)
    if low < 0:
        constant(f"{name}_HIGH", coefficients[0], "The lowest coefficient of the next.")
        constant(f"{name}_LOW", coefficients[-1], "Its second word.")
        coefficients = coefficients[1:-1]
        count = len(coefficients)
    print(f"/// {text}, to 2^−{float(bits):.1f}.")
    print(f"pub(crate) const {name}: [f64; {count}] = [")
    for c in coefficients:
        print(f"    {literal(c)},")
    print("];")
    print(f"{name}: 2^-{float(bits):.2f}", file=sys.stderr)


def precise(f):
    """`f` with digits to spare for its cancellations, remembered."""
    known = {}

    def value(z):
        if z not in known:
            mp.dps = 90
            result = f(z)
            mp.dps = 50
            known[z] = +result
        return known[z]
    return value


def cube_root_offset():
    """The offset whose guess for x^(−1/3) has the smallest greatest error.

    The bits of 2^e·(1 + μ), as a number in units of 2^52, are L = e + 1023 + μ; the guess has the
    bits C − L/3. Its error is periodic in e with period 3."""
    def guess(centre, e, mu):
        bits = centre - (e + 1023 + mu) / 3
        whole = mp.floor(bits)
        return mpf(2) ** (whole - 1023) * (1 + bits - whole)

    samples = [(e, mpf(i) / 400) for e in range(3) for i in range(400)]

    def ratios(centre):
        found = [guess(centre, e, mu) * (mpf(2) ** e * (1 + mu)) ** (mpf(1) / 3)
                 for e, mu in samples]
        return min(found), max(found)

    low, high = mpf(1363), mpf(1365)
    for _ in range(40):
        centre = (low + high) / 2
        least, most = ratios(centre)
        if most - 1 > 1 - least:
            high = centre
        else:
            low = centre
    error = float(max(most - 1, 1 - least))
    print(f"cube root: {error}", file=sys.stderr)
    print(f"/// In units of 2^−20: the guess for x^(−1/3) has errors of at most {error:.3f}.\n"
          f"pub(crate) const CUBE_ROOT_OFFSET: u64 = {int(mp.nint(centre * mpf(2) ** 20))};")


def main():
    print("""//! Constants and coefficients of the elementary functions.
//!
//! Input: nothing. Output: tables, the lowest power first, each with its formula and the largest
//! error of that formula relative to the function. Invariant: only `scripts/fit_functions.py`
//! writes this file.

#![allow(
    clippy::approx_constant,
    reason = "printed with all others by the fitting script"
)]
""")
    third = mpf(1) / 3
    cube_root_offset()
    # Angles and logarithms by parts: the head times an integer of 20 (11) bits is exact.
    half_pi = pi / 2
    constant("TWO_OVER_PI", 2 / pi, "2/π.")
    a = head(half_pi, 33)
    b = head(half_pi - a, 33)
    c = head(half_pi - a - b, 33)
    constant("HALF_PI_1", a, "π/2 to 33 bits: its product with 20 bits is exact.")
    constant("HALF_PI_2", b, "33 bits of π/2 less the above.")
    constant("HALF_PI_3", c, "33 bits of the rest.")
    constant("HALF_PI_4", half_pi - a - b - c, "The rest of π/2.")
    a = mpf(float(half_pi))
    b = mpf(float(half_pi - a))
    constant("HALF_PI_HIGH", a, "π/2 rounded.")
    constant("HALF_PI_LOW", b, "π/2 less the above.")
    b = head(half_pi - a, 33)
    constant("HALF_PI_LOW_HEAD", b, "HALF_PI_LOW to 33 bits: its product with 20 bits is exact.")
    constant("HALF_PI_TAIL", half_pi - a - b, "π/2 less HALF_PI_HIGH and the above.")
    a = head(half_pi, 33) / 2
    constant("QUARTER_PI_HEAD", a, "π/4 to 33 bits: its product with 20 bits is exact.")
    constant("QUARTER_PI_REST", pi / 4 - a, "π/4 less the above.")
    constant("ROOT_2_LESS_1", sqrt(2) - 1, "tan(π/8) = √2 − 1.")
    constant("LOG2_E", 1 / log(2), "1/ln 2.")
    a = head(log(2), 42)
    constant("LN_2_HIGH", a, "ln 2 to 42 bits: its product with 11 bits is exact.")
    constant("LN_2_LOW", log(2) - a, "ln 2 less the above.")
    constant("TWO_THIRDS_LOW", 2 * third - mpf(float(2 * third)), "⅔ less its double.")

    edge = (pi / 4 * mpf("1.0001")) ** 2
    table("SINE", "sin r = r + r·z·P(z), z = r² ≤ (π/4)²",
          precise(lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z),
          lambda z: z, 0, edge, 6)
    table("COSINE", "cos r = 1 − z/2 + z²·P(z), z = r² ≤ (π/4)²",
          precise(lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2),
          lambda z: z**2 / cos(sqrt(z)), 0, edge, 6)
    edge = (log(2) / 2 * mpf("1.0001")) ** 2
    table("EXP_EVEN", "cosh r = 1 + z·P(z), z = r² ≤ (ln 2/2)²",
          precise(lambda z: (cosh(sqrt(z)) - 1) / z),
          lambda z: z, 0, edge, 6)
    table("EXP_EVEN_SHORT", "cosh r = 1 + z·P(z), z = r² ≤ (ln 2/2)²",
          precise(lambda z: (cosh(sqrt(z)) - 1) / z),
          lambda z: z, 0, edge, 5)
    table("EXP_ODD", "sinh r = r + r·z·P(z), z = r² ≤ (ln 2/2)²",
          precise(lambda z: (sinh(sqrt(z)) / sqrt(z) - 1) / z),
          lambda z: z, 0, edge, 5)
    # A little below √½: errors of ln x next to it are alike on both sides, where k is 0 and −1.
    least = mpf(0.69)
    constant("LOGARITHM_LEAST", least, "The least 1 + f of a logarithm; the greatest is below its double.")
    edge = ((1 - least) / (1 + least) * mpf("1.0001")) ** 2
    table("LOGARITHM", "ln((1 + s)/(1 − s)) = 2s + s·z·P(z), z = s² ≤ 0.184²",
          precise(lambda z: (2 * atanh(sqrt(z)) / sqrt(z) - 2) / z),
          lambda z: z / 2, 0, edge, 7)
    table("LOGARITHM_TAIL", "ln((1 + s)/(1 − s)) = 2s + ⅔s·z + s·z²·P(z), z = s² ≤ 0.184²",
          precise(lambda z: (2 * atanh(sqrt(z)) / sqrt(z) - 2 - 2 * z / 3) / z**2),
          lambda z: z**2 / 2, 0, edge, 9)
    edge = (sqrt(2) - 1) ** 2 * mpf("1.0001")
    table("ARC_TANGENT", "atan t = t + t·z·P(z), z = t² ≤ (√2 − 1)²",
          precise(lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z),
          lambda z: z, 0, edge, 11)
    table("ARC_SINE", "asin s = s + s·z·P(z), z = s² ≤ ¼",
          precise(lambda z: (asin(sqrt(z)) / sqrt(z) - 1) / z),
          lambda z: z, 0, mpf("0.2501"), 13)
    table("ERROR", "erf x = x + x·P(z), z = x² ≤ ⅝²",
          precise(lambda z: erf(sqrt(z)) / sqrt(z) - 1),
          lambda z: sqrt(z) / erf(sqrt(z)), 0, mpf(25) / 64, 10)
    centre = mpf(4)
    last = mpf("27.3")

    def scaled(t):
        x = centre * (1 + t) / (1 - t)
        return (1 + 2 * x) * exp(x * x) * erfc(x)

    scaled = precise(scaled)
    table("ERROR_COMPLEMENT",
          "(1 + 2x)·exp(x²)·erfc x = c + t·P(t), t = (x − 4)/(x + 4), ⅝ ≤ x ≤ 27.3",
          scaled, lambda t: 1 / scaled(t), (mpf("0.62") - centre) / (mpf("0.62") + centre), (last - centre) / (last + centre), 23)


main()
