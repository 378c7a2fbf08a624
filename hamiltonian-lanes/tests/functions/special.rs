//! Values where a function has a rule of its own: zeros, infinities, NaN, poles, ends of domains.
//! Those of the C library, C17 annex F.10.

#![allow(clippy::approx_constant, clippy::type_complexity)]

use hamiltonian_lanes::{Cpu, Real};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::points::ROWS;

const INF: f64 = f64::INFINITY;
const NAN: f64 = f64::NAN;
const TINY: f64 = 5e-324;

/// The function's values at ±0, ±∞, NaN, the smallest number, ±1, ±2.
#[rustfmt::skip]
const RULES: &[(&str, [f64; 10])] = &[
    // 0, −0, ∞, −∞, NaN, 5e-324, 1, −1, 2, −2.
    ("sin", [0.0, -0.0, NAN, NAN, NAN, TINY,
        0.8414709848078965, -0.8414709848078965, 0.9092974268256817, -0.9092974268256817]),
    ("cos", [1.0, 1.0, NAN, NAN, NAN, 1.0,
        0.5403023058681398, 0.5403023058681398, -0.4161468365471424, -0.4161468365471424]),
    ("tan", [0.0, -0.0, NAN, NAN, NAN, TINY,
        1.5574077246549023, -1.5574077246549023, -2.185039863261519, 2.185039863261519]),
    ("exp", [1.0, 1.0, INF, 0.0, NAN, 1.0,
        2.718281828459045, 0.36787944117144233, 7.38905609893065, 0.1353352832366127]),
    ("exp_m1", [0.0, -0.0, INF, -1.0, NAN, TINY,
        1.718281828459045, -0.6321205588285577, 6.38905609893065, -0.8646647167633873]),
    ("ln", [-INF, -INF, INF, NAN, NAN, -744.4400719213812,
        0.0, NAN, 0.6931471805599453, NAN]),
    ("ln_1p", [0.0, -0.0, INF, NAN, NAN, TINY,
        0.6931471805599453, -INF, 1.0986122886681098, NAN]),
    ("cbrt", [0.0, -0.0, INF, -INF, NAN, 1.7031839360032603e-108,
        1.0, -1.0, 1.2599210498948732, -1.2599210498948732]),
    ("sinh", [0.0, -0.0, INF, -INF, NAN, TINY,
        1.1752011936438014, -1.1752011936438014, 3.626860407847019, -3.626860407847019]),
    ("cosh", [1.0, 1.0, INF, INF, NAN, 1.0,
        1.5430806348152437, 1.5430806348152437, 3.7621956910836314, 3.7621956910836314]),
    ("tanh", [0.0, -0.0, 1.0, -1.0, NAN, TINY,
        0.7615941559557649, -0.7615941559557649, 0.9640275800758169, -0.9640275800758169]),
    ("asinh", [0.0, -0.0, INF, -INF, NAN, TINY,
        0.881373587019543, -0.881373587019543, 1.4436354751788103, -1.4436354751788103]),
    ("acosh", [NAN, NAN, INF, NAN, NAN, NAN,
        0.0, NAN, 1.3169578969248166, NAN]),
    ("atanh", [0.0, -0.0, NAN, NAN, NAN, TINY,
        INF, -INF, NAN, NAN]),
    ("atan", [0.0, -0.0, FRAC_PI_2, -FRAC_PI_2, NAN, TINY,
        FRAC_PI_4, -FRAC_PI_4, 1.1071487177940904, -1.1071487177940904]),
    ("asin", [0.0, -0.0, NAN, NAN, NAN, TINY,
        FRAC_PI_2, -FRAC_PI_2, NAN, NAN]),
    ("acos", [FRAC_PI_2, FRAC_PI_2, NAN, NAN, NAN, FRAC_PI_2,
        0.0, PI, NAN, NAN]),
    ("erf", [0.0, -0.0, 1.0, -1.0, NAN, TINY,
        0.8427007929497149, -0.8427007929497149, 0.9953222650189527, -0.9953222650189527]),
    ("erfc", [1.0, 1.0, 0.0, 2.0, NAN, 1.0,
        0.15729920705028513, 1.8427007929497148, 0.004677734981047266, 1.9953222650189528]),
    ("sqrt", [0.0, -0.0, INF, NAN, NAN, 2.2227587494850775e-162,
        1.0, NAN, 1.4142135623730951, NAN]),
];
const AT: [f64; 10] = [0.0, -0.0, INF, -INF, NAN, TINY, 1.0, -1.0, 2.0, -2.0];

/// `(x, y, value)` where C17 gives a rule, or the value is exact.
#[rustfmt::skip]
const PAIRS: &[(&str, &[(f64, f64, f64)])] = &[
    ("atan2", &[
        (0.0, 0.0, 0.0), (-0.0, 0.0, -0.0), (0.0, -0.0, PI), (-0.0, -0.0, -PI), (0.0, 2.0, 0.0),
        (-0.0, 2.0, -0.0), (0.0, -2.0, PI), (-0.0, -2.0, -PI), (2.0, 0.0, FRAC_PI_2),
        (2.0, -0.0, FRAC_PI_2), (-2.0, 0.0, -FRAC_PI_2), (-2.0, -0.0, -FRAC_PI_2),
        (1.0, 1.0, FRAC_PI_4), (1.0, -1.0, 3.0 * FRAC_PI_4), (-1.0, 1.0, -FRAC_PI_4),
        (-1.0, -1.0, -3.0 * FRAC_PI_4), (1.0, INF, 0.0), (-1.0, INF, -0.0), (1.0, -INF, PI),
        (-1.0, -INF, -PI), (0.0, INF, 0.0), (-0.0, -INF, -PI), (INF, 0.0, FRAC_PI_2),
        (-INF, -0.0, -FRAC_PI_2), (INF, INF, FRAC_PI_4), (INF, -INF, 3.0 * FRAC_PI_4),
        (-INF, INF, -FRAC_PI_4), (-INF, -INF, -3.0 * FRAC_PI_4), (TINY, 1.0, TINY),
        (TINY, 2.0, 0.0), (TINY, f64::MAX, 0.0), (TINY, TINY, FRAC_PI_4),
        (TINY, -TINY, 3.0 * FRAC_PI_4), (f64::MAX, f64::MAX, FRAC_PI_4),
        (f64::MAX, TINY, FRAC_PI_2), (-TINY, -f64::MAX, -PI), (1e-310, -1.0, PI), (NAN, 1.0, NAN),
        (1.0, NAN, NAN), (NAN, NAN, NAN), (NAN, INF, NAN), (0.0, NAN, NAN),
    ]),
    ("hypot", &[
        (0.0, 0.0, 0.0), (-0.0, 0.0, 0.0), (3.0, -4.0, 5.0), (-0.0, -2.0, 2.0), (INF, NAN, INF),
        (NAN, -INF, INF), (INF, 1.0, INF), (-INF, -INF, INF), (NAN, 1.0, NAN), (1.0, NAN, NAN),
        (f64::MAX, 0.0, f64::MAX), (f64::MAX, f64::MAX, INF), (TINY, 0.0, TINY), (TINY, TINY, TINY),
        (3e300, 4e300, 5e300), (3.0 * TINY, 4.0 * TINY, 5.0 * TINY), (1e308, 1.0, 1e308),
        (f64::MIN_POSITIVE, TINY, f64::MIN_POSITIVE),
    ]),
    ("pow", &[
        (0.0, 0.0, 1.0), (NAN, 0.0, 1.0), (INF, -0.0, 1.0), (-3.0, 0.0, 1.0), (1.0, NAN, 1.0),
        (1.0, INF, 1.0), (1.0, -5.5, 1.0), (0.0, 3.0, 0.0), (-0.0, 3.0, -0.0), (-0.0, 2.0, 0.0),
        (-0.0, 2.5, 0.0), (0.0, -3.0, INF), (-0.0, -3.0, -INF), (-0.0, -2.0, INF), (0.0, -INF, INF),
        (0.0, INF, 0.0), (-1.0, INF, 1.0), (-1.0, -INF, 1.0), (-1.0, 1e300, 1.0),
        (-1.0, 9007199254740991.0, -1.0), (-1.0, 9007199254740992.0, 1.0), (0.5, INF, 0.0),
        (-0.5, INF, 0.0), (2.0, INF, INF), (-2.0, INF, INF), (0.5, -INF, INF), (2.0, -INF, 0.0),
        (INF, 2.0, INF), (INF, -2.0, 0.0), (-INF, 3.0, -INF), (-INF, 2.0, INF), (-INF, 2.5, INF),
        (-INF, -3.0, -0.0), (-INF, -2.0, 0.0), (-8.0, 3.0, -512.0), (-8.0, 2.0, 64.0),
        (-8.0, -1.0, -0.125), (-8.0, 1.0 / 3.0, NAN), (-2.5, 0.5, NAN), (2.0, 10.0, 1024.0),
        (2.0, 1024.0, INF), (2.0, -1074.0, TINY), (2.0, -1075.0, 0.0), (2.0, -1076.0, 0.0),
        (4.0, 0.5, 2.0), (10.0, 22.0, 1e22), (TINY, 1.0, TINY), (TINY, -1.0, INF),
        (TINY, 0.5, 2.2227587494850775e-162), (-TINY, 1.0, -TINY), (f64::MAX, 1.0, f64::MAX),
        (f64::MAX, -1.0, 5.562684646268003e-309), (1.0, f64::MAX, 1.0), (2.0, f64::MAX, INF),
        (0.5, f64::MAX, 0.0), (2.0, -f64::MAX, 0.0), (1.5, TINY, 1.0), (-2.0, f64::MAX, INF),
        (-2.0, -f64::MAX, 0.0), (NAN, 1.0, NAN), (2.0, NAN, NAN), (NAN, NAN, NAN), (-1.0, NAN, NAN),
        (0.0, NAN, NAN),
    ]),
];

/// Equal with the sign of zero; any NaN equals any other; elsewhere within one unit.
fn agrees(value: f64, expected: f64) -> bool {
    if expected.is_nan() || expected == 0.0 || expected.is_infinite() || expected.abs() == 1.0 {
        value.is_nan() && expected.is_nan() || value.to_bits() == expected.to_bits()
    } else {
        value.to_bits().abs_diff(expected.to_bits()) <= 1
    }
}

/// Checks a function in the scalar, in f32 and in the last lane of each level.
fn check(name: &str, x: f64, y: f64, expected: f64) {
    let row = ROWS
        .iter()
        .find(|row| row.name == name)
        .expect("a function");
    let value = (row.f64)(x, y);
    assert!(
        agrees(value, expected),
        "{name}({x:e}, {y:e}) = {value:e}, expected {expected:e}"
    );
    for cpu in Cpu::available() {
        for unfused in [false, true] {
            let (mut xs, mut ys, mut out) = ([1.0; 8], [1.0; 8], [0.0; 8]);
            (xs[7], ys[7]) = (x, y);
            (row.lanes)(cpu, unfused, &xs, &ys, &mut out);
            assert!(
                agrees(out[7], expected),
                "{cpu:?} {name}({x:e}, {y:e}) = {:e}, expected {expected:e}",
                out[7]
            );
        }
    }
}

#[test]
fn one_number() {
    assert_eq!(RULES.len() + PAIRS.len(), ROWS.len());
    for (name, values) in RULES {
        for (&x, &expected) in AT.iter().zip(values) {
            check(name, x, 1.0, expected);
        }
    }
}

#[test]
fn two_numbers() {
    for (name, rows) in PAIRS {
        for &(x, y, expected) in *rows {
            check(name, x, y, expected);
        }
    }
}

#[test]
fn results_at_the_ends_of_the_range() {
    // Overflow begins half a unit above the largest number, underflow half below the smallest.
    assert!(
        Real::exp(709.782712893384f64).is_finite() && Real::exp(709.7827128933841f64).is_infinite()
    );
    for (x, expected) in [
        (-745.1332191019411, TINY),
        (-745.1332191019412, 0.0),
        (800.0, INF),
        (1e9, INF),
        (f64::MAX, INF),
        (-800.0, 0.0),
        (-1e9, 0.0),
        (f64::MIN, 0.0),
    ] {
        check("exp", x, 1.0, expected);
    }
    assert!(
        Real::exp_m1(709.782712893384f64).is_finite()
            && Real::exp_m1(709.7827128933841f64).is_infinite()
    );
    for f in [<f64 as Real>::sinh, <f64 as Real>::cosh] {
        assert!(f(710.4758600739439).is_finite() && f(710.475860073944).is_infinite());
    }
    assert_eq!(Real::erfc(27.226), TINY);
    assert_eq!(Real::erfc(27.23), 0.0);
    assert_eq!(Real::erfc(-27.3), 2.0);
    assert_eq!(Real::exp_m1(-1e10), -1.0);
}
