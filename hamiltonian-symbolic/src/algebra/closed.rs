//! Expressions of numbers alone.
//!
//! Input: nodes without variables. Output: the value of a function where it is known exactly, a number with
//! a bound of its error. Invariant: an exact value is exact in every scalar.

use crate::algebra::ball::Ball;
use crate::dag::{Dag, Kind, Map, Node, Stage};
use crate::op::Op;
use crate::rational::Rational;

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

    /// Returns true if the expression is made of numbers alone.
    #[must_use]
    pub fn is_number(&self, node: Node) -> bool {
        self.stage(node) == Stage::Constant && self.variables(node).is_empty()
    }

    /// The value of an expression of numbers alone, with a bound of its error; infinite past the range of `f64`,
    /// `None` at a pole, or so near to one that rounding hides it.
    #[must_use]
    pub fn number(&self, root: Node) -> Option<Ball> {
        if !self.is_number(root) {
            return None;
        }
        let mut values: Map<Node, Ball> = Map::default();
        for node in self.reachable(&[root]) {
            let value = Ball::of(self, node, &|child| values[&child])?;
            let overflows = |op: Op, x: Ball| match op {
                Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh => true,
                Op::Pow => x.is_nonzero(),
                _ => false,
            };
            let is_pole = match self.kind(node) {
                Kind::Product(_, factors) => factors
                    .iter()
                    .any(|(f, n)| *n < 0 && !values[f].is_nonzero() && values[f].value.is_finite()),
                Kind::Call(op, arguments) => {
                    value.value.is_infinite() && !overflows(*op, values[&arguments[0]])
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
