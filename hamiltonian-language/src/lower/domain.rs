//! Functions of numbers outside their domains.
//!
//! Input: a function and its arguments as nodes. Output: the reason why the value is not a real
//! number, if the arguments are known numbers. Invariant: exact for rational arguments; others,
//! such as `pi/2`, must lie outside by more than their bounded errors.

use hamiltonian_symbolic::Ball;
use hamiltonian_symbolic::dag::{Dag, Kind, Node};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::rational::Rational;
use std::cmp::Ordering;

/// The domain of the function, if a known number is outside it.
pub fn outside(dag: &Dag, function: Op, arguments: &[Node]) -> Option<&'static str> {
    let [x, rest @ ..] = arguments else {
        return None;
    };
    let against = |bound: i64| compared(dag, *x, bound);
    let below = |bound| against(bound) == Some(Ordering::Less);
    let above = |bound| against(bound) == Some(Ordering::Greater);
    let at = |bound| against(bound) == Some(Ordering::Equal);
    let (is_outside, takes) = match function {
        Op::Sqrt => (below(0), "the argument of `sqrt` must be ≥ 0"),
        Op::Ln => (below(0) || at(0), "the argument of `ln` must be > 0"),
        Op::Ln1p => (below(-1) || at(-1), "the argument of `ln_1p` must be > -1"),
        Op::Asin => (
            below(-1) || above(1),
            "the argument of `asin` must be in [-1, 1]",
        ),
        Op::Acos => (
            below(-1) || above(1),
            "the argument of `acos` must be in [-1, 1]",
        ),
        Op::Tan => (
            dag.in_pi(*x)
                .and_then(|turn| turn.to_small())
                .is_some_and(|(_, d)| d == 2),
            "the argument of `tan` must not be an odd multiple of `pi/2`",
        ),
        Op::Acosh => (below(1), "the argument of `acosh` must be ≥ 1"),
        Op::Atanh => (
            below(-1) || at(-1) || at(1) || above(1),
            "the argument of `atanh` must be in (-1, 1)",
        ),
        Op::Modulo | Op::Remainder => (
            rest.iter()
                .all(|y| compared(dag, *y, 0) == Some(Ordering::Equal)),
            "the divisor of a remainder must not be 0",
        ),
        Op::Pow => {
            let exponent = rest.first().and_then(|y| rational(dag, *y))?;
            let is_whole = exponent.to_small().is_none_or(|(_, d)| d == 1);
            if at(0) && exponent.is_negative() {
                return Some("the base of a negative power must not be 0");
            }
            (
                below(0) && !is_whole,
                "a negative base needs a whole exponent",
            )
        }
        _ => return None,
    };
    is_outside.then_some(takes)
}

fn rational(dag: &Dag, node: Node) -> Option<&Rational> {
    match dag.kind(node) {
        Kind::Constant(value) => Some(value),
        _ => None,
    }
}

/// The order of a known number and a bound; equal only if it is so exactly.
fn compared(dag: &Dag, node: Node, bound: i64) -> Option<Ordering> {
    if let Some(value) = rational(dag, node) {
        let difference = value.sub(&Rational::integer(bound));
        return Some(match (difference.is_zero(), difference.is_negative()) {
            (true, _) => Ordering::Equal,
            (_, true) => Ordering::Less,
            (_, false) => Ordering::Greater,
        });
    }
    let difference = dag.number(node)? - Ball::exact(bound as f64);
    difference
        .is_nonzero()
        .then(|| difference.value.total_cmp(&0.0))
}
