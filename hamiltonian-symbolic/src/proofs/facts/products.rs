//! Products: where a factor is 0 and another one infinite or jumps.
//!
//! Input: the factors of a product with their regularity. Output: the regularity of the product. Invariant: 0·∞ is
//! decided among quotients and powers of one base alone; a jump between finite values is none where another factor
//! is 0.

use super::{Facts, Points, Regular, STEP, comparisons};
use crate::dag::{Dag, Kind, Node, Partial};
use crate::list::IntoList;
use crate::op::{Op, SingularSet};
use crate::rational::Rational;

impl Facts {
    pub(super) fn product(&mut self, dag: &Dag, factors: &[(Node, i32)]) -> Regular {
        if let Some(regular) = self.joined_steps(dag, factors) {
            return regular;
        }
        let mut each: Vec<(Node, Regular)> = Vec::with_capacity(factors.len());
        for &(base, n) in factors {
            let regular = self.get(base);
            if n < 0 && !regular.has_no_moving_zero {
                self.note(SingularSet::Zero, base, base);
            }
            let power = if n < 0 {
                regular.recip(self.points)
            } else {
                regular
            };
            each.push((base, power));
        }
        let all = each.iter().fold(Regular::ALL, |all, (_, f)| all.and(*f));
        // 0·∞ is decided among quotients only. A factor that is 0 for some parameters is so on both
        // sides of a place.
        let is_clear = |(a, f): &(Node, Regular), (b, g): &(Node, Regular)| {
            f.is_continuous
                || g.has_no_moving_zero
                || self.points == Points::Most && f.is_meromorphic && g.is_meromorphic
                || self.meet_rarely(dag, *a, *b)
                || self.is_one_power(dag, *a, *b)
        };
        let is_clear = (0..each.len())
            .all(|a| (0..each.len()).all(|b| a == b || is_clear(&each[a], &each[b])))
            || self.is_quotient_in_one(dag, factors.iter().map(|(factor, _)| *factor));
        Regular {
            is_projective: all.is_projective && is_clear,
            ..all
        }
    }

    /// Returns true if two factors are powers of one base, x^a and x or x^b, with exponents that do not move: their
    /// product is a power of it, which is 0, finite or infinite at x = 0 on both sides alike.
    fn is_one_power(&self, dag: &Dag, a: Node, b: Node) -> bool {
        let power = |node: Node| match dag.kind(node) {
            Kind::Call(Op::Pow, x) if self.get(x[1]).is_still => Some(x[0]),
            _ => None,
        };
        match (power(a), power(b)) {
            (Some(x), Some(y)) => x == y,
            (Some(x), None) => x == b,
            (None, Some(y)) => a == y,
            (None, None) => false,
        }
    }

    /// Returns true if expressions are quotients of analytic functions of one continuous s ≥ 0, such as (b − |x|)/|x|:
    /// sums and products of them have one limit as s tends to a zero of a divisor.
    pub(super) fn is_quotient_in_one(
        &self,
        dag: &Dag,
        parts: impl Iterator<Item = Node> + Clone,
    ) -> bool {
        let is_distance = |s: &Node| {
            matches!(dag.kind(*s), Kind::Call(Op::Abs | Op::Sqrt | Op::Hypot, _))
                && self.get(*s).is_continuous
        };
        let below = |node: Node| -> Vec<Node> {
            match dag.kind(node) {
                Kind::Product(_, factors) => factors.iter().map(|(factor, _)| *factor).into_list(),
                _ => vec![node],
            }
        };
        let distance = parts.clone().flat_map(below).find(is_distance);
        distance.is_some_and(|s| parts.clone().all(|part| self.is_quotient_in(dag, part, s)))
    }

    /// Returns true if an expression is a quotient of analytic functions of another one.
    fn is_quotient_in(&self, dag: &Dag, node: Node, s: Node) -> bool {
        let is_quotient = |node: &Node| self.is_quotient_in(dag, *node, s);
        match dag.kind(node) {
            Kind::Sum(_, terms) => terms.iter().all(|(_, term)| is_quotient(term)),
            Kind::Product(_, factors) => factors.iter().all(|(factor, _)| is_quotient(factor)),
            _ => self.is_analytic_in(dag, node, s),
        }
    }

    /// Returns true if an expression is an analytic function of another one.
    fn is_analytic_in(&self, dag: &Dag, node: Node, s: Node) -> bool {
        let is_analytic = |node: &Node| self.is_analytic_in(dag, *node, s);
        if node == s || self.get(node).is_still {
            return true;
        }
        match dag.kind(node) {
            Kind::Sum(_, terms) => terms.iter().all(|(_, term)| is_analytic(term)),
            Kind::Product(_, factors) => {
                let mut factors = factors.iter();
                factors.all(|(factor, n)| *n > 0 && is_analytic(factor))
            }
            Kind::Call(op, x) => {
                let regularity = op.row().regularity;
                let is_finite = regularity.is_entire && regularity.pole.is_none();
                is_finite && x.iter().all(is_analytic)
            }
            Kind::External(_, _, x) => x.iter().all(is_analytic),
            _ => false,
        }
    }

    /// The regularity of a product with factors that jump between finite values, such as x·sign x, if each of them
    /// jumps only where another factor is 0 and the others have no jump.
    fn joined_steps(&mut self, dag: &Dag, factors: &[(Node, i32)]) -> Option<Regular> {
        let is_step = |(factor, n): &&(Node, i32)| {
            *n > 0
                && !self.get(*factor).is_continuous
                && matches!(
                    dag.kind(*factor),
                    Kind::Call(Op::Sign, _) | Kind::Select(..)
                )
        };
        let (steps, others): (Vec<_>, Vec<_>) =
            factors.iter().copied().partition(|factor| is_step(&factor));
        let each = others.iter().map(|(factor, n)| {
            let regular = self.get(*factor);
            if *n < 0 {
                regular.recip(self.points)
            } else {
                regular
            }
        });
        let all = each.fold(Regular::ALL, Regular::and);
        if steps.is_empty() || !all.is_continuous {
            return None;
        }
        let mut is_lipschitz = all.is_lipschitz;
        for (step, _) in steps {
            let is_lost = |place: Node| vanishes(dag, &others, place);
            match dag.kind(step) {
                Kind::Call(Op::Sign, x) if self.get(x[0]).is_continuous && is_lost(x[0]) => {}
                Kind::Select(condition, yes, no) => {
                    let both = self.get(*yes).and(self.get(*no));
                    is_lipschitz &= both.is_lipschitz;
                    let is_joined = |(a, b): &(Node, Node)| {
                        let sides = self.get(*a).and(self.get(*b));
                        let is_apart = || match (dag.is_zero(*a), dag.is_zero(*b)) {
                            (_, true) => is_lost(*a),
                            (true, _) => is_lost(*b),
                            _ => false,
                        };
                        sides.is_continuous && is_apart()
                    };
                    if !(both.is_continuous && comparisons(dag, *condition).iter().all(is_joined)) {
                        return None;
                    }
                }
                _ => return None,
            }
        }
        Some(Regular {
            is_still: false,
            is_continuous: true,
            is_lipschitz,
            ..Regular::UNKNOWN
        })
    }
}

/// Returns true if factors are 0 wherever x is: those of x, up to roots, absolute values and powers, are among them.
fn vanishes(dag: &Dag, factors: &[(Node, i32)], x: Node) -> bool {
    let single = [(x, 1)];
    let parts = match dag.kind(x) {
        Kind::Product(_, parts) => parts.as_slice(),
        _ => &single,
    };
    let is_met = |part: Node| {
        let mut above = factors.iter().filter(|(_, n)| *n > 0);
        above.any(|(factor, _)| stem(dag, *factor) == stem(dag, part))
    };
    parts.iter().all(|(part, n)| *n > 0 && is_met(*part))
}

/// Returns true if an expression is made of functions in the place of conditions such that its values are between 0 and
/// 1, without the ends.
pub(super) fn is_between(dag: &Dag, node: Node) -> bool {
    match dag.kind(node) {
        Kind::External(function, Partial::Value, _) => (STEP - 3..STEP).contains(function),
        Kind::Sum(c, terms) => match terms.as_slice() {
            [(k, x)] => c.is_one() && *k == Rational::MINUS_ONE && is_between(dag, *x),
            _ => false,
        },
        Kind::Product(k, factors) => {
            k.is_one() && factors.iter().all(|(x, n)| *n > 0 && is_between(dag, *x))
        }
        _ => false,
    }
}

/// The expression that is 0 exactly where a node is, without roots, absolute values and powers.
pub(crate) fn stem(dag: &Dag, mut node: Node) -> Node {
    loop {
        node = match dag.kind(node) {
            Kind::Call(Op::Sqrt | Op::Abs | Op::Cbrt, x) => x[0],
            Kind::Product(_, factors) if factors.len() == 1 && factors[0].1 > 0 => factors[0].0,
            _ => return node,
        };
    }
}
