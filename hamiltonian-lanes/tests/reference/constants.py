"""Writes the constants of the double-double functions, src/double_double/constants.rs, and the
coefficients that they share with the scalars, ../hamiltonian-real/src/real/series.rs.

Run from the folder of the crate: python3 tests/reference/constants.py
Needs mpmath (pip install mpmath).
"""
from mpmath import mp, mpf, factorial, floor, pi, log

mp.prec = 2000


def words(x, count=2):
    """x as `count` f64, each the rest rounded to nearest."""
    out = []
    for _ in range(count):
        w = float(x)
        out.append(w)
        x = x - mpf(w)
    return out


def literal(w):
    """The shortest decimal that reads back as w."""
    r = repr(w)
    return r if any(c in r for c in ".en") else r + ".0"


def pair(x):
    hi, lo = words(x)
    return f"({literal(hi)}, {literal(lo)})"


def number(name, x, doc):
    hi, lo = words(x)
    return (f"/// {doc}.\npub(super) const {name}: DoubleDouble = "
            f"DoubleDouble {{ hi: {literal(hi)}, lo: {literal(lo)} }};\n")


def table(name, terms, doc):
    body = "\n".join(f"    {pair(t)}," for t in terms)
    return f"/// {doc}.\npub(super) const {name}: [(f64, f64); {len(terms)}] = [\n{body}\n];\n"


def tail(name, terms, doc):
    body = "\n".join(f"    {literal(float(t))}," for t in terms)
    return f"/// {doc}.\npub(super) const {name}: [f64; {len(terms)}] = [\n{body}\n];\n"


ln2 = log(2)
unit = mpf(2) ** -42
ln2_1 = floor(ln2 / unit) * unit
ln2_2 = floor((ln2 - ln2_1) / unit**2) * unit**2
ln2_3 = ln2 - ln2_1 - ln2_2

parts = [
    """//! Constants of the double-double functions, rounded from 600 digits.
//!
//! Input: nothing. Output: numbers and series coefficients. Invariant: written by
//! `tests/reference/constants.py`, not by hand; each pair is the constant rounded to two words.
#![allow(clippy::excessive_precision, clippy::approx_constant)]

use super::DoubleDouble;
""",
    number("PI", pi, "π"),
    number("FRAC_PI_2", pi / 2, "π/2"),
    number("FRAC_PI_4", pi / 4, "π/4"),
    number("FRAC_3_PI_4", 3 * pi / 4, "3π/4"),
    number("LN_2", ln2, "ln 2"),
    f"/// The first 42 bits of ln 2, so that products with an exponent are exact.\n"
    f"pub(super) const LN_2_FIRST: f64 = {literal(float(ln2_1))};\n",
    f"/// The next 42 bits of ln 2.\npub(super) const LN_2_SECOND: f64 = {literal(float(ln2_2))};\n",
    f"/// The rest of ln 2.\npub(super) const LN_2_THIRD: f64 = {literal(float(ln2_3))};\n",
    table("EXP", [1 / factorial(k) for k in range(2, 15)],
          "1/k!, k = 2 to 14: for |x| ≤ ½ ln 2"),
    tail("EXP_TAIL", [1 / factorial(k) for k in range(15, 25)], "1/k!, k = 15 to 24"),
    table("ATANH", [1 / mpf(2 * k + 1) for k in range(1, 11)],
          "1/(2k + 1), k = 1 to 10: for |x| ≤ 0.172"),
    tail("ATANH_TAIL", [1 / mpf(2 * k + 1) for k in range(11, 23)], "1/(2k + 1), k = 11 to 22"),
]
with open("src/double_double/constants.rs", "w", encoding="utf-8") as out:
    out.write("\n".join(parts))

series = [
    """//! Coefficients of the sine and the cosine in two words, rounded from 600 digits.
//!
//! Input: nothing. Output: 1/n!. Invariant: written by `tests/reference/constants.py` of
//! `hamiltonian-lanes`, not by hand; each pair is the number rounded to two words.
#![allow(clippy::excessive_precision)]
""",
    table("SIN", [1 / factorial(2 * k + 1) for k in range(1, 8)],
          "1/(2k + 1)!, k = 1 to 7: the sine's terms that need two words where |x| ≤ π/4"),
    tail("SIN_TAIL", [1 / factorial(2 * k + 1) for k in range(8, 15)],
         "1/(2k + 1)!, k = 8 to 14: those that one word serves"),
    table("COS", [1 / factorial(2 * k) for k in range(1, 9)], "1/(2k)!, k = 1 to 8"),
    tail("COS_TAIL", [1 / factorial(2 * k) for k in range(9, 16)], "1/(2k)!, k = 9 to 15"),
]
with open("../hamiltonian-real/src/real/series.rs", "w", encoding="utf-8") as out:
    out.write("\n".join(series).replace("pub(super)", "pub"))

# 2/π for the reduction of angles, whose file is written by hand.
bits = int(floor(2 / pi * mpf(2) ** 1536))
limbs = [(bits >> (64 * i)) & (2**64 - 1) for i in reversed(range(24))]
with open("../hamiltonian-real/src/elementary/reduction.rs", encoding="utf-8") as file:
    text = file.read()
for limb in limbs:
    assert f"0x{limb:016x}" in text
