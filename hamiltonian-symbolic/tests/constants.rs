//! Constants at the limits of `f64`: accepted if their value after simplification is in range, and then exact to the last
//! digits; otherwise refused as too large or too small.
//!
//! Products of powers that cancel up to one power with a known value are written at random. The control evaluates them in
//! `f64` as they stand: many are infinite, 0 or NaN.

use crate::common;
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::dag::{Array, Column, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::overflow::OutOfRange;
use hamiltonian_symbolic::pipeline::{NoProgram, derive};
use hamiltonian_symbolic::program::Purpose;

/// Bases with their decimal logarithms.
const BASES: [(&str, f64); 6] = [
    ("2", std::f64::consts::LOG10_2),
    ("3", 0.477_121_254_719_662_4),
    ("10", 1.0),
    ("(1/7)", -0.845_098_040_014_256_8),
    ("pi", 0.497_149_872_694_133_85),
    ("exp", std::f64::consts::LOG10_E),
];

/// The n-th power of a base.
fn text(base: usize, n: i64) -> String {
    match BASES[base].0 {
        "exp" => format!("exp({n})"),
        base => format!("{base}^({n})"),
    }
}

/// Its value in `f64` operations.
fn plain(base: usize, n: i64) -> f64 {
    let power = |base: f64| base.powi(n as i32);
    match BASES[base].0 {
        "exp" => (n as f64).exp(),
        "(1/7)" => power(1.0 / 7.0),
        "pi" => power(std::f64::consts::PI),
        base => power(base.parse().unwrap()),
    }
}

/// Its value in 32 digits, which `f64` can hold.
fn exact(base: usize, n: i64) -> D {
    let (one, seven) = (D::from(1.0), D::from(7.0));
    let base = match BASES[base].0 {
        "exp" => return D::from(n as f64).exp(),
        "(1/7)" => seven,
        "pi" => D::constant(std::f64::consts::PI, hamiltonian_symbolic::PI_LOW),
        base => D::from(base.parse::<f64>().unwrap()),
    };
    let n = if base == seven { -n } else { n };
    let power = (0..n.abs()).fold(one, |power, _| power * base);
    if n < 0 { one / power } else { power }
}

/// k of H = p²/2 + k·q, or why there is none.
fn factor(k: &str) -> Result<f64, OutOfRange> {
    let mut model = common::system("q; p", "", "", &format!("p^2/2 + q*({k})"));
    let program = match derive(&mut model, &[Purpose::Energy]) {
        Ok(program) => program,
        Err(NoProgram::OutOfRange(number)) => return Err(number),
        Err(other) => panic!("{k}: {other:?}"),
    };
    let mut point = Point::<f64>::new();
    for (side, x) in [(Side::Q, 1.0), (Side::P, 0.0)] {
        let column = Column {
            side,
            group: 0,
            column: 0,
        };
        point.arrays.insert(Array::Phase(column), vec![vec![x]]);
    }
    Ok(run(&program, &program.functions[0], &point).results[0])
}

#[test]
fn constants_count_after_simplification() {
    let mut random = Random(3803);
    let (mut accepted, mut refused, mut control) = (0, 0, 0);
    let count = common::cases(400, 4_000);
    for _ in 0..count {
        let base = random.below(BASES.len());
        let digits = match random.below(3) {
            0 => 290.0 * (2.0 * random.unit() - 1.0),
            1 => 4.0 * (2.0 * random.unit() - 1.0),
            _ => (330.0 + 200.0 * random.unit()) * random.one_of(&[1.0, -1.0]),
        };
        let n = (digits / BASES[base].1).round() as i64;
        let digits = n as f64 * BASES[base].1;
        // Powers that cancel, the largest first.
        let mut powers = vec![(base, n)];
        for _ in 0..1 + random.below(2) {
            let other = random.below(BASES.len());
            let shift = random.below(1500) as i64;
            powers.extend([(other, shift), (other, -shift)]);
        }
        for at in (1..powers.len()).rev() {
            powers.swap(at, random.below(at + 1));
        }
        let text: Vec<String> = powers.iter().map(|(base, n)| text(*base, *n)).collect();
        let text = text.join("*");
        let naive: f64 = powers.iter().map(|(base, n)| plain(*base, *n)).product();
        match factor(&text) {
            Ok(found) => {
                assert!(digits.abs() < 300.0, "{text}: {found}");
                let value = exact(base, n).to_f64();
                let steps = if base == 4 { 1.0 + n.abs() as f64 } else { 1.0 };
                let off = (found - value).abs() / value;
                assert!(off <= steps * f64::EPSILON, "{text}: {found} for {value}");
                accepted += 1;
                control += usize::from(((naive - value) / value).abs() > 1e-3 || naive.is_nan());
            }
            Err(number) => {
                assert!(digits.abs() > 300.0, "{text}: {number:?}");
                assert_eq!(number.is_small(), digits < 0.0, "{text}: {number:?}");
                refused += 1;
            }
        }
    }
    println!("{accepted} accepted, {control} of these wrong as they stand; {refused} refused");
    assert!(accepted > count / 2 && refused > count / 5 && control > count / 4);
}

/// A number that vanishes does no harm beside another, and is refused in a product.
#[test]
fn small_parts_of_constants_are_not_lost() {
    for (k, value) in [
        ("1 + exp(-1000)", 1.0),
        ("cosh(exp(-1000))", 1.0),
        ("exp(-740)", (-740_f64).exp()),
        ("ln(10^400)", 400.0 * std::f64::consts::LN_10),
        ("sqrt(10^401)/10^200", 10_f64.sqrt()),
        ("sqrt(exp(1000))/exp(499)", std::f64::consts::E),
    ] {
        let found = factor(k).unwrap_or_else(|number| panic!("{k}: {number:?}"));
        assert!(
            (found / value - 1.0).abs() < 4.0 * f64::EPSILON,
            "{k}: {found}"
        );
    }
    for (k, is_small) in [
        ("10^300*(exp(-1000) + exp(-1001))", true),
        ("10^300*(exp(-740) + exp(-741))", true),
        ("sqrt(exp(-1000) + exp(-1001))", true),
        ("erfc(40)", true),
        ("pi^(-700.5)", true),
        ("exp(-1000)*pi^0.3", true),
        ("exp(1000) - exp(999)", false),
        ("pi^700", false),
        ("sinh(800)", false),
    ] {
        let number = factor(k).expect_err(k);
        assert_eq!(number.is_small(), is_small, "{k}: {number:?}");
    }
}
