//! Double-double operations against values of 50 digits (`reference/double_double.txt`), and
//! against `f64` where both are exact: zeros, infinities, NaN, overflow.

use hamiltonian_lanes::{DoubleDouble, Real};

/// Largest relative errors allowed; `DoubleDouble`'s documentation states them. That of pow is
/// relative to 1 + |y ln x|. Twelve tables from other seeds stayed below as well.
const BOUNDS: [(&str, f64); 26] = [
    ("add", 1.5e-32),
    ("mul", 3e-32),
    ("div", 4e-32),
    ("sqrt", 3e-32),
    ("cbrt", 4e-32),
    ("sin", 3e-32),
    ("cos", 3e-32),
    ("tan", 5e-32),
    ("asin", 4e-32),
    ("acos", 4.5e-32),
    ("atan", 3e-32),
    ("sinh", 4e-32),
    ("cosh", 2e-32),
    ("tanh", 6e-32),
    ("asinh", 5e-32),
    ("acosh", 6e-32),
    ("atanh", 6e-32),
    ("exp", 1.5e-32),
    ("exp_m1", 4.5e-32),
    ("ln", 4.5e-32),
    ("ln_1p", 4.5e-32),
    ("erf", 5e-32),
    ("erfc", 7e-32),
    ("atan2", 3e-32),
    ("hypot", 3e-32),
    ("pow", 2.5e-31),
];

const UNARY: [&str; 22] = [
    "abs", "sign", "sqrt", "cbrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh",
    "tanh", "asinh", "acosh", "atanh", "exp", "exp_m1", "ln", "ln_1p", "erf", "erfc",
];

const BINARY: [&str; 9] = [
    "add", "sub", "mul", "div", "atan2", "hypot", "pow", "min", "max",
];

fn unary<T: Real>(function: &str, x: T) -> T {
    match function {
        "abs" => x.abs(),
        "sign" => x.sign(),
        "sqrt" => x.sqrt(),
        "cbrt" => x.cbrt(),
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.tan(),
        "asin" => x.asin(),
        "acos" => x.acos(),
        "atan" => x.atan(),
        "sinh" => x.sinh(),
        "cosh" => x.cosh(),
        "tanh" => x.tanh(),
        "asinh" => x.asinh(),
        "acosh" => x.acosh(),
        "atanh" => x.atanh(),
        "exp" => x.exp(),
        "exp_m1" => x.exp_m1(),
        "ln" => x.ln(),
        "ln_1p" => x.ln_1p(),
        "erf" => x.erf(),
        "erfc" => x.erfc(),
        other => panic!("no function {other}"),
    }
}

fn binary<T: Real>(function: &str, x: T, y: T) -> T {
    match function {
        "add" => x + y,
        "sub" => x - y,
        "mul" => x * y,
        "div" => x / y,
        "atan2" => x.atan2(y),
        "hypot" => x.hypot(y),
        "pow" => x.pow(y),
        "min" => x.min(y),
        "max" => x.max(y),
        other => panic!("no function {other}"),
    }
}

fn number(x: f64) -> DoubleDouble {
    DoubleDouble::from(x)
}

/// Relative distance; 0 for equal infinities and zeros, and for two NaN.
fn distance(computed: f64, expected: f64) -> f64 {
    if computed == expected || computed.is_nan() && expected.is_nan() {
        0.0
    } else {
        ((computed - expected) / expected).abs()
    }
}

#[test]
fn functions_meet_their_bounds() {
    let mut worst = BOUNDS.map(|(name, _)| (name, 0.0f64, 0));
    for line in include_str!("reference/double_double.txt").lines() {
        let mut fields = line.split(' ');
        let name = fields.next().unwrap();
        let words: Vec<_> = fields
            .map(|w| f64::from_bits(u64::from_str_radix(w, 16).unwrap()))
            .collect();
        let numbers: Vec<_> = words
            .chunks(2)
            .map(|w| DoubleDouble::new(w[0], w[1]))
            .collect();
        let (computed, expected, scale) = match numbers[..] {
            [x, value] => (unary(name, x), value, 1.0),
            [x, y, value] if name == "pow" => {
                (x.pow(y), value, 1.0 + (y * x.abs().ln()).hi().abs())
            }
            [x, y, value] => (binary(name, x, y), value, 1.0),
            _ => panic!("a line of {} numbers", numbers.len()),
        };
        let error = ((computed - expected) / expected).hi().abs() / scale;
        let entry = worst
            .iter_mut()
            .find(|w| w.0 == name)
            .expect("a function with a bound");
        // A NaN is an error beyond every bound.
        entry.1 = if error >= 0.0 {
            entry.1.max(error)
        } else {
            f64::INFINITY
        };
        entry.2 += 1;
    }
    for ((name, error, count), (_, bound)) in worst.into_iter().zip(BOUNDS) {
        println!("{name:8} {error:9.2e} of {bound:.1e} over {count} points");
        assert!(count >= 200, "{name}: {count} points");
        assert!(error <= bound, "{name}: {error:e} > {bound:e}");
    }
}

/// Numbers at which something is special in some function.
const SPECIAL: [f64; 33] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    3.0,
    -3.0,
    2.5,
    -2.5,
    32.0,
    33.0,
    -33.0,
    1e-200,
    -1e-200,
    1e17,
    -1e17,
    9007199254740991.0,
    -9007199254740993.0,
    1e200,
    -1e200,
    709.0,
    -745.0,
    1e4,
    -1e4,
    f64::MIN_POSITIVE,
    f64::MAX,
    f64::MIN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// The leading word is that of `f64`, the signs of zeros too, and what is not an ordinary number
/// has no trailing word.
fn assert_like_f64(computed: DoubleDouble, expected: f64, what: &str) {
    let (hi, lo) = (computed.hi(), computed.lo());
    // Near the smallest numbers `f64` itself is off by a unit.
    let close = distance(hi, expected) < 4e-15 || (hi - expected).abs() < 1e-322;
    assert!(close, "{what}: {hi:e}, f64 {expected:e}");
    if expected == 0.0 {
        assert_eq!(
            hi.is_sign_negative(),
            expected.is_sign_negative(),
            "{what}: sign of zero"
        );
    }
    if hi == 0.0 || !hi.is_finite() {
        assert_eq!(lo, 0.0, "{what}: trailing word");
    } else {
        assert!(
            lo.abs() <= hi.abs() * f64::EPSILON / 2.0,
            "{what}: {hi:e} + {lo:e}"
        );
    }
}

#[test]
fn special_arguments_are_as_in_f64() {
    for x in SPECIAL {
        for name in UNARY {
            let expected = unary(name, x);
            assert_like_f64(unary(name, number(x)), expected, &format!("{name}({x:e})"));
        }
        let (sin, cos) = number(x).sin_cos();
        assert_like_f64(sin, x.sin(), &format!("sin_cos({x:e}).0"));
        assert_like_f64(cos, x.cos(), &format!("sin_cos({x:e}).1"));
    }
}

#[test]
fn special_pairs_are_as_in_f64() {
    for x in SPECIAL {
        for y in SPECIAL {
            for name in BINARY {
                let what = format!("{name}({x:e}, {y:e})");
                assert_like_f64(
                    binary(name, number(x), number(y)),
                    binary(name, x, y),
                    &what,
                );
            }
            assert_eq!(number(x).lt(number(y)), x < y);
            assert_eq!(number(x).le(number(y)), x <= y);
            assert_eq!(number(x).equals(number(y)), x == y);
        }
    }
}

#[test]
fn angles_on_the_axes_have_both_words() {
    let pi = number(0.0).atan2(number(-1.0));
    assert_eq!(
        (pi.hi(), pi.lo()),
        (core::f64::consts::PI, 1.2246467991473532e-16)
    );
    let quarter = number(f64::INFINITY).atan2(number(f64::INFINITY));
    assert_eq!(quarter * number(4.0), pi);
    let three_quarters = number(-f64::INFINITY).atan2(number(-f64::INFINITY));
    assert!((three_quarters / pi + number(0.75)).magnitude() < 3e-32);
    assert_eq!(number(1.0).asin() + number(1.0).asin(), pi);
    assert_eq!(number(-1.0).acos(), pi);
}

#[test]
fn subnormal_angles_are_quotients() {
    for (y, x) in [
        (3.630080428340714e-216, 3.7124821786949946e94),
        (-3.1898939823170595e-308, 2.1620040551956266e-257),
        (5e-324, 1.5),
    ] {
        assert_eq!(number(y).atan2(number(x)).hi(), y / x);
    }
}

#[test]
fn sums_and_products_of_words_are_exact() {
    // (2⁵³ + 1)² needs 107 bits, (1 + 2⁻⁵²)² needs 105.
    let x = number(1.0 + f64::EPSILON);
    let square = x * x;
    assert_eq!(square.hi(), 1.0 + 2.0 * f64::EPSILON);
    assert_eq!(square.lo(), f64::EPSILON * f64::EPSILON);
    let sum = number(1e16) + number(1.0);
    assert_eq!((sum.hi(), sum.lo()), (1e16, 1.0));
    assert_eq!(sum - number(1e16), number(1.0));
    // The largest number whose splitting by a product would overflow.
    let large = number(f64::MAX) * number(0.5);
    assert_eq!((large.hi(), large.lo()), (f64::MAX / 2.0, 0.0));
    let root = number(f64::MAX).sqrt();
    // √(2¹⁰²⁴(1 − 2⁻⁵³)) = 2⁵¹²(1 − 2⁻⁵⁴ − …).
    let expected = number(1.0) - number(f64::EPSILON / 4.0);
    assert!((root / number(2f64.powi(512)) - expected).magnitude() < 3e-32);
}

#[test]
fn integer_powers_are_exact_where_products_are() {
    assert_eq!(number(3.0).pow(number(5.0)), number(243.0));
    assert_eq!(number(-2.0).pow(number(-3.0)), number(-0.125));
    assert_eq!(number(10.0).pow(number(30.0)), "1e30".parse().unwrap());
    // An even exponent whose leading word alone is odd, and a fraction below the leading word.
    let even = DoubleDouble::new(2f64.powi(53) - 1.0, 2f64.powi(-3));
    assert!(number(-1.0).pow(even).hi().is_nan());
    let odd = number(2f64.powi(60)) + number(1.0);
    assert_eq!(number(-1.0).pow(odd), number(-1.0));
    assert_eq!(number(-1.0).pow(odd + number(1.0)), number(1.0));
}

#[test]
fn results_beyond_the_exponential_are_finite() {
    // sinh and cosh of 710 are below the largest number, exp(710) is not.
    let x = number(710.0);
    assert_eq!(x.exp().hi(), f64::INFINITY);
    let half = number(355.0).exp();
    let expected = half * number(0.5) * half;
    for value in [x.sinh(), x.cosh(), -(-x).sinh()] {
        assert!(((value - expected) / expected).magnitude() < 1e-31);
    }
}

#[test]
fn identities_hold_to_the_last_digits() {
    for i in 0..400 {
        // The words of 1/7 and of square roots fill both halves.
        let x = number(f64::from(i) - 200.5) / number(7.0);
        let (s, c) = x.sin_cos();
        assert!((s * s + c * c - number(1.0)).magnitude() < 1e-31);
        assert_eq!((s, c), (x.sin(), x.cos()));
        let (sinh, cosh) = (x.sinh(), x.cosh());
        assert!(((cosh - sinh) * x.exp() - number(1.0)).magnitude() < cosh.hi().powi(2) * 1e-31);
        assert!((x.asinh().sinh() - x).magnitude() <= 1e-30 * x.magnitude());
        assert!((x.cbrt().fma(x.cbrt() * x.cbrt(), -x)).magnitude() <= 2e-31 * x.magnitude());
        assert_eq!(x.fma(s, c), x * s + c);
        let mut y = x;
        y += s;
        y -= c;
        y *= x;
        y /= number(3.0);
        assert_eq!(y, (x + s - c) * x / number(3.0));
    }
}

#[test]
fn a_long_sum_keeps_its_digits() {
    // Σ 1/(k(k+1)) = 1 − 1/(n+1).
    let n = 100_000;
    let mut sum = DoubleDouble::zero();
    for k in 1..=n {
        sum += number(f64::from(k) * f64::from(k + 1)).recip();
    }
    let expected = number(1.0) - number(f64::from(n + 1)).recip();
    assert!((sum - expected).magnitude() < 1e-29);
}

#[test]
fn constants_have_two_words() {
    let third = DoubleDouble::constant(1.0 / 3.0, 1.850371707708594e-17);
    assert!((third * number(3.0) - number(1.0)).magnitude() < 1e-32);
    assert_eq!(DoubleDouble::new(1e-20, 1.0), DoubleDouble::new(1.0, 1e-20));
    assert_eq!(DoubleDouble::epsilon(), 2f64.powi(-105));
    let next = number(1.0) + number(DoubleDouble::epsilon());
    assert!(next > number(1.0));
    assert_eq!(next.to_f64(), 1.0);
    assert_eq!(DoubleDouble::default(), DoubleDouble::zero());
}
