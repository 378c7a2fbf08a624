//! Expressions of numbers alone.
//!
//! Input: nodes without variables. Output: the value of a function where it is known exactly, the
//! nearest `f64`, and whether there is one. Invariant: an exact value is exact in every scalar.

use crate::dag::{Dag, Kind, Map, Node, Stage};
use crate::op::Op;
use crate::rational::Rational;
use core::f64::consts::PI;

impl Dag {
    /// The rational multiple of π that a node is.
    #[must_use]
    pub fn in_pi(&self, node: Node) -> Option<Rational> {
        match self.kind(node) {
            Kind::Pi => Some(Rational::ONE),
            Kind::Product(k, factors) => match factors.as_slice() {
                [(pi, 1)] if *self.kind(*pi) == Kind::Pi => Some(k.clone()),
                _ => None,
            },
            _ => None,
        }
    }

    /// The value of a function at a rational number, or at a multiple of π/6 or π/4, where it is a
    /// square root of a rational or a rational multiple of π.
    pub(crate) fn exact_value(&mut self, op: Op, x: Node) -> Option<Node> {
        match op {
            Op::Sin | Op::Cos | Op::Tan => {
                let angle = twelfths(&self.in_pi(x)?)?;
                let (sin, cos) = (squared_sine(angle)?, squared_sine(angle + 6)?);
                let (square, is_negative) = match op {
                    Op::Sin => (sin, angle >= 12),
                    Op::Cos => (cos, (angle + 6) % 24 >= 12),
                    _ => (sin.mul(&cos.recip()?), angle % 12 > 6),
                };
                let square = self.constant(square);
                let value = self.call(Op::Sqrt, &[square]);
                Some(if is_negative { self.neg(value) } else { value })
            }
            Op::Asin | Op::Acos | Op::Atan => {
                let (n, d) = self.as_constant(x)?.to_small()?;
                let turn = match (op, n.abs(), d) {
                    (_, 0, _) => Rational::ZERO,
                    (Op::Atan, 1, 1) => Rational::new(n, 4),
                    (Op::Asin | Op::Acos, 1, 1) => Rational::new(n, 2),
                    (Op::Asin | Op::Acos, 1, 2) => Rational::new(n, 6),
                    _ => return None,
                };
                let turn = match op {
                    Op::Acos => Rational::new(1, 2).sub(&turn),
                    _ => turn,
                };
                let pi = self.pi();
                Some(self.product(&turn, &[(pi, 1)]))
            }
            Op::Acosh if self.is_one(x) => Some(self.integer(0)),
            _ => None,
        }
    }

    /// The nearest `f64` to an expression of numbers alone; infinite past its range, `None` at a
    /// pole.
    #[must_use]
    pub fn number(&self, root: Node) -> Option<f64> {
        if let Kind::Constant(value) = self.kind(root) {
            return Some(value.to_f64());
        }
        if self.stage(root) != Stage::Constant || self.variables(root) != 0 {
            return None;
        }
        let mut values: Map<Node, f64> = Map::default();
        for node in self.reachable(&[root]) {
            let value = match self.kind(node) {
                Kind::Constant(value) => value.to_f64(),
                Kind::Pi => PI,
                Kind::Sum(c, terms) => terms
                    .iter()
                    .fold(c.to_f64(), |sum, (k, n)| sum + k.to_f64() * values[n]),
                Kind::Product(k, factors) => factors
                    .iter()
                    .fold(k.to_f64(), |product, (f, n)| product * values[f].powi(*n)),
                Kind::Call(op, arguments) => {
                    let arguments: Vec<f64> = arguments.iter().map(|n| values[n]).collect();
                    op.eval(&arguments)
                }
                _ => return None,
            };
            let overflows = |op: Op, x: f64| match op {
                Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh => true,
                Op::Pow => x != 0.0,
                _ => false,
            };
            let is_pole = match self.kind(node) {
                Kind::Product(_, factors) => {
                    factors.iter().any(|(f, n)| *n < 0 && values[f] == 0.0)
                }
                Kind::Call(op, arguments) => {
                    value.is_infinite() && !overflows(*op, values[&arguments[0]])
                }
                _ => false,
            };
            if is_pole {
                return None;
            }
            values.insert(node, value);
        }
        values.get(&root).copied()
    }

    /// Whether the coefficient of a node, or all of it where it is made of numbers alone, is past the
    /// range of `f64`.
    #[must_use]
    pub fn leaves_f64(&self, node: Node) -> bool {
        let coefficient = match self.kind(node) {
            Kind::Constant(k) | Kind::Product(k, _) => k.leaves_f64(),
            _ => false,
        };
        coefficient || self.number(node).is_some_and(f64::is_infinite)
    }
}

/// A multiple of π as twelfths from 0 to 23.
fn twelfths(turn: &Rational) -> Option<i64> {
    let (n, d) = turn.to_small()?;
    (12 % d == 0)
        .then(|| (n % (2 * d)) * (12 / d))
        .map(|n| n.rem_euclid(24))
}

/// sin² of so many twelfths of π, where it is a quarter of an integer.
fn squared_sine(twelfths: i64) -> Option<Rational> {
    let folded = twelfths % 12;
    let quarters = match folded.min(12 - folded) {
        0 => 0,
        2 => 1,
        3 => 2,
        4 => 3,
        6 => 4,
        _ => return None,
    };
    Some(Rational::new(quarters, 4))
}
