//! Numbers as source text.
//!
//! Input: exact rationals. Output: text that rustc reads back to the same bits. Invariant: a
//! number is rounded here and nowhere else.

use hamiltonian_symbolic::PI_LOW;
use hamiltonian_symbolic::dag::{Dag, Kind, Node};
use hamiltonian_symbolic::rational::Rational;

/// A float as an expression of type `f64`: the shortest decimal that reads back exactly.
pub fn float(value: f64) -> String {
    if value.is_infinite() {
        let sign = if value < 0.0 { "-" } else { "" };
        format!("{sign}__h::core::f64::INFINITY")
    } else {
        format!("{value:?}")
    }
}

/// A number as an expression of the scalar type `T`, rounded once.
pub fn constant(value: &Rational) -> String {
    // Fractions of a power of two are exact in one word.
    if let Some((numerator, denominator)) = value.to_small()
        && numerator.unsigned_abs() < 1 << 53
        && denominator.unsigned_abs().is_power_of_two()
        && denominator.unsigned_abs() < 1 << 53
    {
        return two_words((numerator as f64 / denominator as f64, 0.0));
    }
    two_words(value.to_words())
}

/// An expression of numbers alone, over the scalar type `T`.
pub fn closed(dag: &Dag, node: Node) -> Option<String> {
    Some(match dag.kind(node) {
        Kind::Constant(value) => constant(value),
        Kind::Pi => pi(),
        Kind::Sum(c, terms) => {
            let mut text = constant(c);
            for (k, term) in terms {
                text = format!("({text} + {} * {})", constant(k), closed(dag, *term)?);
            }
            text
        }
        Kind::Product(k, factors) => {
            let mut text = constant(k);
            for (factor, n) in factors {
                let (base, n) = (closed(dag, *factor)?, n);
                let sign = if *n > 0 { '*' } else { '/' };
                for _ in 0..n.unsigned_abs() {
                    text = format!("({text} {sign} {base})");
                }
            }
            text
        }
        Kind::Call(op, arguments) => {
            let arguments: Option<Vec<String>> =
                arguments.iter().map(|node| closed(dag, *node)).collect();
            format!("__h::Real::{}({})", op.row().name, arguments?.join(", "))
        }
        _ => return None,
    })
}

/// π as an expression of the scalar type `T`.
pub fn pi() -> String {
    format!("T::constant(__h::core::f64::consts::PI, {})", float(PI_LOW))
}

fn two_words((hi, lo): (f64, f64)) -> String {
    // The rest of a number that overflowed, or of one below the normal range, says nothing.
    let lo = if hi.is_finite() { lo } else { 0.0 };
    format!("T::constant({}, {})", float(hi), float(lo))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_reads_back_to_the_same_bits() {
        for value in [
            0.1,
            -9.81,
            1e-300,
            4.9e-324,
            1.797e308,
            1.0 / 3.0,
            123_456_789.0,
            1e22,
        ] {
            assert_eq!(
                float(value).parse::<f64>().unwrap().to_bits(),
                value.to_bits()
            );
        }
        assert_eq!(constant(&Rational::new(1, 2)), "T::constant(0.5, 0.0)");
        assert_eq!(float(f64::NEG_INFINITY), "-__h::core::f64::INFINITY");
    }
}
