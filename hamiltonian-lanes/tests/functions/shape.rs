//! Properties between points: symmetry, monotony, identities.

use hamiltonian_lanes::Real;

use super::points::{ROWS, Random, Range};

/// The functions of two numbers.
const TWO: [&str; 3] = ["atan2", "hypot", "pow"];

/// The number of neighbours, or random points, of a check.
fn count() -> usize {
    if std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1") {
        1_000_000
    } else {
        20_000
    }
}

#[test]
fn odd_and_even_to_the_bit() {
    let mut random = Random(5);
    let odd = [
        "sin", "tan", "cbrt", "sinh", "tanh", "asinh", "atanh", "atan", "asin", "erf",
    ];
    let even = ["cos", "cosh"];
    for row in ROWS.iter().filter(|row| !TWO.contains(&row.name)) {
        let (name, f) = (row.name, row.f64);
        let (is_odd, is_even) = (odd.contains(&name), even.contains(&name));
        let mut differs = false;
        for k in 0..count() {
            let (x, y) = row.draw(k, &mut random);
            let (plus, minus) = (f(x, y), f(-x, y));
            if is_odd || is_even {
                let expected = if is_odd { -plus } else { plus };
                assert_eq!(minus.to_bits(), expected.to_bits(), "{name}({x:e})");
            }
            differs |= minus.to_bits() != plus.to_bits() && minus.to_bits() != (-plus).to_bits();
        }
        // The lists are complete: the other functions are seen to be neither.
        assert!(is_odd || is_even || differs, "{name}");
    }
}

/// Reversals between neighbours, at most one unit.
fn monotone(f: impl Fn(f64) -> f64, from: f64) -> u64 {
    let mut worst = 0;
    let mut greatest = f(from);
    let mut x = from;
    for _ in 0..count() {
        x = if x > 0.0 {
            f64::from_bits(x.to_bits() + 1)
        } else {
            f64::from_bits(x.to_bits() - 1)
        };
        let value = f(x);
        if value >= greatest {
            greatest = value;
        } else {
            worst = worst.max(value.to_bits().abs_diff(greatest.to_bits()));
        }
    }
    worst
}

#[test]
fn exp_ln_and_atan_are_monotone() {
    let half_ln_2 = 0.34657359027997264;
    for start in [
        1.0,
        half_ln_2 - 1e-13,
        -half_ln_2 - 1e-13,
        3.0 * half_ln_2 - 1e-13,
        1e-8,
        20.0,
        -700.0,
        708.0 - 1e-10,
    ] {
        assert!(monotone(Real::exp, start) <= 1, "exp at {start:e}");
    }
    for start in [
        0.9999999999,
        1.0,
        0.69 - 1e-13,
        1.38 - 1e-13,
        2.0,
        1e-300,
        12345.0,
        f64::MIN_POSITIVE,
    ] {
        assert!(monotone(Real::ln, start) <= 1, "ln at {start:e}");
    }
    let root = std::f64::consts::SQRT_2;
    for start in [
        1e-8,
        0.3,
        root - 1.0 - 1e-13,
        1.0 - 1e-13,
        1.0 + root - 1e-13,
        2.0,
        1e15,
        -3.0,
    ] {
        assert!(monotone(Real::atan, start) <= 1, "atan at {start:e}");
    }
    // A function that is not monotone is seen.
    assert!(monotone(|x| Real::sin(x * 1e16), 1.0) > 1);
}

#[test]
fn identities() {
    let mut random = Random(7);
    for _ in 0..count() {
        let x = Range::Binades(1e-300, 1e300).draw(&mut random);
        let (sine, cosine) = Real::sin_cos(x);
        assert_eq!((sine, cosine), (Real::sin(x), Real::cos(x)));
        let sum = sine * sine + cosine * cosine;
        assert!(
            (sum - 1.0).abs() <= 2.0 * f64::EPSILON,
            "sin² + cos² at {x:e}: {sum}"
        );

        let size = x.abs();
        let back = Real::exp(Real::ln(size));
        // An error of one unit in ln x is a relative error of |ln x| units.
        let bound = f64::EPSILON * (1.0 + Real::ln(size).abs());
        assert!(
            (back / size - 1.0).abs() <= bound,
            "exp(ln {size:e}) = {back:e}"
        );
        assert_eq!(Real::pow(size, 1.0), size);
        let root = Real::sqrt(size);
        assert!(
            (Real::pow(size, 0.5) / root - 1.0).abs() <= f64::EPSILON,
            "{size:e}^½"
        );
        assert!((Real::hypot(x, 0.0) - size).abs() == 0.0);
        let cube = Real::cbrt(size);
        assert!(
            (cube * cube * cube / size - 1.0).abs() <= 4.0 * f64::EPSILON,
            "cbrt {size:e}"
        );
    }
    for k in 1..200_000u32 {
        let x = f64::from(k);
        assert_eq!(Real::cbrt(x * x * x), x);
        assert_eq!(Real::hypot(3.0 * x, 4.0 * x), 5.0 * x);
    }
}

#[test]
fn single_precision_rounds_double() {
    let mut random = Random(9);
    for k in 0..count() {
        for row in ROWS {
            let (x, y) = row.draw(k, &mut random);
            let (x, y) = (x as f32, y as f32);
            let single = (row.f32)(x, y);
            let double = (row.f64)(f64::from(x), f64::from(y)) as f32;
            assert!(
                single.to_bits() == double.to_bits() || single.is_nan() && double.is_nan(),
                "{}({x:e}, {y:e}) = {single:e}, expected {double:e}",
                row.name
            );
        }
    }
}
