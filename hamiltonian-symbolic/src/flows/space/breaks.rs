//! The sets across which an expression is not smooth, and whether an orbit crosses them.
//!
//! Input: expressions over a space. Output: nodes whose zeros are such sets. Invariant: an expression
//! is analytic between the zeros of its breaks. An identity between derivatives, such as {h, L} = 0,
//! holds on each side of a break by itself, so a form that is proven by derivatives asks that no orbit
//! leaves its side.

use super::Space;
use crate::dag::{Dag, Dependence, Kind, Node};
use crate::list::IntoList;
use crate::op::{Break, Op, SingularSet};
use crate::rational::Rational;
use crate::sort::Arrange;

impl Space {
    /// Returns true if the orbits of h stay on one side of every break of f: each is proven to be constant
    /// along them.
    pub(crate) fn stays_smooth(&mut self, f: Node, h: Node) -> bool {
        let breaks = self.breaks(f);
        breaks
            .into_iter()
            .all(|(node, _)| self.brackets_vanish(node, h))
    }

    /// The expressions of moving variables at whose zeros f may have a jump or a kink, and whether it may be a
    /// jump. Poles are among them where branched functions could join different constants at their two
    /// sides.
    pub(crate) fn breaks(&mut self, f: Node) -> Vec<(Node, bool)> {
        let (mut found, mut poles) = (Vec::new(), Vec::new());
        let mut is_entire = true;
        let dag = &mut self.model.dag;
        for node in dag.reachable(&[f]) {
            match dag.kind(node).clone() {
                Kind::Call(op, x) => {
                    let regularity = op.row().regularity;
                    is_entire &= regularity.is_entire;
                    match regularity.breaks {
                        Break::Nowhere => {}
                        Break::Kink(at) => found.extend(place(dag, at, &x).map(|x| (x, false))),
                        Break::Jump(at) => found.extend(place(dag, at, &x).map(|x| (x, true))),
                    }
                    if let Some(at) = regularity.pole {
                        poles.extend(place(dag, at, &x).map(|x| (x, true)));
                    }
                }
                Kind::Product(_, factors) => {
                    let below = factors.iter().filter(|(_, n)| *n < 0);
                    poles.extend(below.map(|(base, _)| (*base, true)));
                }
                Kind::Compare(_, a, b) => {
                    is_entire = false;
                    found.push((dag.sub(a, b), true));
                }
                Kind::External(_, _, arguments) => {
                    is_entire = false;
                    found.extend(arguments.into_iter().map(|x| (x, true)));
                }
                _ => {}
            }
        }
        if !is_entire {
            found.append(&mut poles);
        }
        found.arrange();
        found.dedup();
        found.retain(|(node, _)| {
            !self.set(*node).is_empty() && !separates_nothing(&self.model.dag, *node)
        });
        found
    }
}

/// An expression that is 0 at a set of arguments.
fn place(dag: &mut Dag, at: SingularSet, x: &[Node]) -> Option<Node> {
    let first = *x.first()?;
    let second = x.get(1).copied().unwrap_or(first);
    let one = dag.integer(1);
    Some(match at {
        SingularSet::Zero | SingularSet::Cut => first,
        SingularSet::One => dag.sub(first, one),
        SingularSet::MinusOne => dag.add(&[first, one]),
        SingularSet::PlusMinusOne => {
            let square = dag.powi(first, 2);
            dag.sub(square, one)
        }
        SingularSet::Cosine => dag.call(Op::Cos, &[first]),
        SingularSet::Equal => dag.sub(first, second),
        SingularSet::Origin => dag.sum_of_squares(&[first, second]),
        // sin πx and cos πx, sin πx/y and cos πx/y
        SingularSet::Whole => in_turns(dag, Op::Sin, first, one),
        SingularSet::HalfWhole => in_turns(dag, Op::Cos, first, one),
        SingularSet::Multiple => in_turns(dag, Op::Sin, first, second),
        SingularSet::HalfMultiple => in_turns(dag, Op::Cos, first, second),
    })
}

/// A function of π·x/y.
fn in_turns(dag: &mut Dag, op: Op, x: Node, y: Node) -> Node {
    let pi = dag.pi();
    let turns = dag.div(x, y);
    let angle = dag.mul(&[pi, turns]);
    dag.call(op, &[angle])
}

/// Returns true if the zeros of an expression are none, or a set of codimension 2: those of a sum of terms
/// ≥ 0, two of which have no variable in common.
fn separates_nothing(dag: &Dag, node: Node) -> bool {
    match dag.kind(node) {
        Kind::Constant(value) => !value.is_zero(),
        Kind::Call(Op::Exp | Op::Cosh, _) => true,
        Kind::Call(Op::Sqrt | Op::Cbrt | Op::Abs, x) => separates_nothing(dag, x[0]),
        Kind::Call(Op::Hypot, x) => have_nothing_in_common(dag, x[0], x[1]),
        Kind::Product(_, factors) => factors
            .iter()
            .all(|(base, _)| leaves(dag, *base).is_empty() || separates_nothing(dag, *base)),
        Kind::Sum(c, terms) => {
            let is_definite = |(k, term): &(Rational, Node)| {
                k.is_negative() == terms[0].0.is_negative() && dag.is_nonnegative(*term)
            };
            let number = c.is_zero() || c.is_negative() == terms[0].0.is_negative();
            let moving: Vec<Node> = terms.iter().map(|(_, term)| *term).into_list();
            // A factor that may be 0 leaves the zeros of the other terms.
            let is_sure = |node: Node| !dag.dependence(node).on(Dependence::PARAMETER);
            let apart = |a: usize, b: usize| {
                let (a, b) = (moving[a], moving[b]);
                is_sure(a) && is_sure(b) && have_nothing_in_common(dag, a, b)
            };
            number
                && terms.iter().all(is_definite)
                && (!c.is_zero() || (0..moving.len()).any(|a| (0..a).any(|b| apart(a, b))))
        }
        _ => false,
    }
}

/// Returns true if both of two expressions move, and no variable stands in both.
fn have_nothing_in_common(dag: &Dag, a: Node, b: Node) -> bool {
    let (a, b) = (leaves(dag, a), leaves(dag, b));
    !a.is_empty() && !b.is_empty() && !a.iter().any(|leaf| b.contains(leaf))
}

/// The coordinates and momenta in an expression.
fn leaves(dag: &Dag, node: Node) -> Vec<Node> {
    let is_leaf = |node: &Node| dag.phase_place(*node).is_some();
    dag.reachable(&[node])
        .into_iter()
        .filter(is_leaf)
        .into_list()
}
