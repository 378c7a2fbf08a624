//! Constants outside the range of `f64`.
//!
//! Input: simplified expressions. Output: the first constant that `f64` cannot hold, or that its arithmetic would lose
//! on the way. Invariant: what is accepted is computed without overflow, and without underflow that reaches a factor or
//! the value of an expression: a number that vanishes beside another term does no harm.

use crate::algebra::ball::Ball;
use crate::dag::{Dag, Kind, Node};
use crate::op::Op;
use crate::rational::Rational;

/// A constant outside the range of `f64`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum OutOfRange {
    /// A rational number.
    Number(Rational),
    /// Another number that is too large.
    Large,
    /// Another number that is too small, though it is not 0.
    Small,
}

impl OutOfRange {
    /// Returns true if the number is too small.
    #[must_use]
    pub fn is_small(&self) -> bool {
        match self {
            OutOfRange::Number(number) => number.to_f64() == 0.0,
            OutOfRange::Large => false,
            OutOfRange::Small => true,
        }
    }
}

impl Dag {
    /// The first constant below the roots that is outside the range of `f64`.
    #[must_use]
    pub fn out_of_range(&self, roots: &[Node]) -> Option<OutOfRange> {
        let is_lost = |node: &Node| self.is_number(*node) && self.vanishes(*node);
        if roots.iter().any(is_lost) {
            return Some(OutOfRange::Small);
        }
        let nodes = self.reachable(roots);
        nodes.into_iter().find_map(|node| {
            let mut lost = false;
            self.for_children(node, |child| lost |= self.is_lost_in(child, node));
            let small = lost.then_some(OutOfRange::Small);
            self.number_past_f64(node).or(small)
        })
    }

    /// The number past the range of `f64` that an expression makes of its parts.
    fn number_past_f64(&self, node: Node) -> Option<OutOfRange> {
        let refused = |k: &Rational| k.leaves_f64().then(|| OutOfRange::Number(k.clone()));
        match self.kind(node) {
            Kind::Constant(k) => return refused(k),
            Kind::Sum(c, terms) => {
                let mut numbers = std::iter::once(c).chain(terms.iter().map(|(k, _)| k));
                if let Some(number) = numbers.find_map(refused) {
                    return Some(number);
                }
            }
            Kind::Product(k, factors) => {
                if let Some(number) = refused(k) {
                    return Some(number);
                }
                if !self.is_number(node) {
                    return self.factors_past_f64(k, factors);
                }
            }
            _ => {}
        }
        if !self.is_number(node) {
            return None;
        }
        let is_large = self.number(node).is_some_and(|n| n.value.is_infinite());
        is_large.then_some(OutOfRange::Large)
    }

    /// The same, and a number that is too small for `f64`, which does harm only if a factor or a value is made of it.
    #[must_use]
    pub fn number_near_limits(&self, node: Node) -> Option<OutOfRange> {
        let is_small = || self.is_number(node) && self.vanishes(node);
        let small = || is_small().then_some(OutOfRange::Small);
        self.number_past_f64(node).or_else(small)
    }

    /// The same of the constant factors of a product, multiplied in any order.
    fn factors_past_f64(&self, k: &Rational, factors: &[(Node, i32)]) -> Option<OutOfRange> {
        let k = k.to_f64().abs();
        let (mut large, mut small) = (k.max(1.0), k.min(1.0));
        let mut has_lost_digits = false;
        for &(factor, n) in factors.iter().filter(|(factor, _)| self.is_number(*factor)) {
            let Some(number) = self.number(factor) else {
                continue;
            };
            let power = number.powi(n).value.abs();
            if power == 0.0 && !self.sign(factor).may_be_zero() {
                return Some(OutOfRange::Small);
            }
            if power.is_nan() || number.value == 0.0 {
                continue;
            }
            has_lost_digits |= power < f64::MIN_POSITIVE;
            large *= power.max(1.0);
            small *= power.min(1.0);
        }
        match (large.is_infinite(), small == 0.0) {
            (true, _) => Some(OutOfRange::Large),
            (_, true) => Some(OutOfRange::Small),
            _ if has_lost_digits && large * small >= f64::MIN_POSITIVE => Some(OutOfRange::Small),
            _ => None,
        }
    }

    /// Returns true if a number is not 0 and its value in `f64` is.
    fn vanishes(&self, node: Node) -> bool {
        let is_zero = |number: Ball| number.value == 0.0;
        !self.sign(node).may_be_zero() && self.number(node).is_some_and(is_zero)
    }

    /// Returns true if a number vanishes, or has lost digits, where it is a part of an expression that depends on them.
    fn is_lost_in(&self, number: Node, whole: Node) -> bool {
        if !self.is_number(number) || self.sign(number).may_be_zero() {
            return false;
        }
        let Some(part) = self.number(number) else {
            return false;
        };
        if part.value.abs() >= f64::MIN_POSITIVE {
            return false;
        }
        if !self.is_number(whole) {
            return part.value == 0.0;
        }
        match self.kind(whole) {
            // Its error counts if it is seen in the sum.
            Kind::Sum(_, terms) => {
                let own = terms.iter().filter(|(_, node)| *node == number);
                let size: f64 = own.map(|(k, _)| k.to_f64().abs()).sum();
                let sum = self.number(whole).map_or(0.0, |whole| whole.value.abs());
                size * f64::MIN_POSITIVE > f64::EPSILON / 16.0 * sum
            }
            Kind::Compare(..) | Kind::Not(_) | Kind::And(..) | Kind::Or(..) => false,
            // Its value at 0 is not 0, and so near to 0 it is that.
            Kind::Call(op, _) if *op != Op::Pow && op.at_zero().is_some_and(|y| !y.is_zero()) => {
                false
            }
            _ => {
                let value = self.number(whole).map_or(0.0, |whole| whole.value.abs());
                part.value == 0.0 || value >= f64::MIN_POSITIVE
            }
        }
    }
}
