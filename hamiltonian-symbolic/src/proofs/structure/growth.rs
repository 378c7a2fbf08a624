//! The growth of H: where it is finite without being evaluated.
//!
//! Input: a model with its H. Output: a power n such that H is defined for all finite numbers and no part of it grows
//! faster than the n-th power of their size. Invariant: an answer holds for all parameters with which H is finite at
//! one state: expressions of parameters alone are not looked at, unless a condition may keep them from being evaluated.
//! Numbers in the definition are of moderate size; parameters are taken to be.

use crate::dag::{Dag, Dependence, Kind, Map, Node};
use crate::op::Op;

/// The largest power: values of numbers below 2^75 are then below 2^600.
const MAX_POWER: u32 = 8;

/// The largest size of a number in the definition, 2^50: its powers up to `MAX_POWER` are below 2^400.
const LARGEST: f64 = (1_u64 << 50) as f64;

/// The growth of an expression; `None` if it may not be finite, or grows too fast.
#[must_use]
pub fn growth(dag: &Dag, root: Node) -> Option<u32> {
    // What a condition has hidden at the start may show later.
    let seen = dag.reached(&[root], &mut |node, ahead| match *dag.kind(node) {
        Kind::Select(condition, ..) if moves(dag, condition) => ahead.add(condition),
        _ => dag.for_children(node, |child| ahead.add(child)),
    });
    let matters = |node: Node| moves(dag, node) || seen.binary_search(&node).is_err();
    let mut known: Map<Node, u32> = Map::default();
    let mut most = 0;
    for node in dag.reachable(&[root]) {
        let power = match matters(node) {
            true => of(dag, node, &known, &matters).filter(|power| *power <= MAX_POWER)?,
            false => 0,
        };
        known.insert(node, power);
        most = most.max(power);
    }
    Some(most)
}

fn is_moderate(number: f64) -> bool {
    number.abs() <= LARGEST
}

fn moves(dag: &Dag, node: Node) -> bool {
    dag.dependence(node).on(Dependence::MOVING)
}

/// The growth of a node, whose children are known.
fn of(
    dag: &Dag,
    node: Node,
    known: &Map<Node, u32>,
    matters: &dyn Fn(Node) -> bool,
) -> Option<u32> {
    let power = |node: &Node| known.get(node).copied();
    let largest = |nodes: &[Node]| -> Option<u32> {
        nodes
            .iter()
            .try_fold(0, |most: u32, node| Some(most.max(power(node)?)))
    };
    match dag.kind(node) {
        Kind::Constant(c) => is_moderate(c.to_f64()).then_some(0),
        Kind::Pi
        | Kind::Scalar(_)
        | Kind::Coefficient
        | Kind::Variable(_)
        | Kind::Extent(_)
        | Kind::Count(_) => Some(0),
        Kind::Time => Some(1),
        Kind::Element(..) => Some(u32::from(moves(dag, node))),
        Kind::Sum(c, _) if !is_moderate(c.to_f64()) => None,
        Kind::Sum(_, terms) => terms.iter().try_fold(0, |most: u32, (k, term)| {
            let power = power(term).filter(|_| is_moderate(k.to_f64()));
            Some(most.max(power?))
        }),
        Kind::Product(k, _) if !is_moderate(k.to_f64()) => None,
        Kind::Product(_, factors) => factors.iter().try_fold(0_u32, |sum, (base, n)| {
            let each = match u32::try_from(*n) {
                Ok(n) => power(base)?.checked_mul(n)?,
                Err(_) if matters(*base) => {
                    let is_bounded = n.unsigned_abs() <= MAX_POWER && is_away_from_zero(dag, *base);
                    is_bounded.then_some(0)?
                }
                // H at the start has shown that a divisor of parameters is not 0.
                Err(_) => 0,
            };
            sum.checked_add(each)
        }),
        Kind::Call(op, x) => {
            let most = largest(x)?;
            match op {
                Op::Sin
                | Op::Cos
                | Op::Atan
                | Op::Atan2
                | Op::Tanh
                | Op::Erf
                | Op::Erfc
                | Op::Sign => Some(0),
                Op::Abs | Op::Cbrt | Op::Asinh | Op::Hypot | Op::Min | Op::Max => Some(most),
                Op::Floor | Op::Round => Some(most),
                Op::Modulo | Op::Remainder => is_away_from_zero(dag, x[1]).then_some(most),
                Op::Sqrt => dag.is_nonnegative(x[0]).then_some(most),
                // Poles, domains that end, and exponential growth.
                Op::Tan
                | Op::Asin
                | Op::Acos
                | Op::Sinh
                | Op::Cosh
                | Op::Acosh
                | Op::Atanh
                | Op::Exp
                | Op::ExpM1
                | Op::Ln
                | Op::Ln1p
                | Op::Pow
                | Op::Anomaly
                | Op::Orbit
                | Op::Stumpff2
                | Op::Stumpff3 => None,
            }
        }
        Kind::Reduce(_, body) => power(body),
        Kind::Compare(_, a, b) | Kind::And(a, b) | Kind::Or(a, b) => largest(&[*a, *b]),
        Kind::Not(a) => power(a),
        Kind::Select(condition, yes, no) => largest(&[*condition, *yes, *no]),
        // A function in Rust may end.
        Kind::External(..) | Kind::StandIn(_) => None,
    }
}

/// Returns true if an expression is at least a positive constant that is not tiny.
fn is_away_from_zero(dag: &Dag, node: Node) -> bool {
    match dag.kind(node) {
        Kind::Constant(c) => c.to_f64().abs() >= 1.0 / LARGEST,
        Kind::Pi => true,
        Kind::Sum(c, terms) => {
            c.to_f64() >= 1.0 / LARGEST
                && (terms.iter()).all(|(k, term)| !k.is_negative() && dag.is_nonnegative(*term))
        }
        Kind::Call(Op::Sqrt, x) => is_away_from_zero(dag, x[0]),
        _ => false,
    }
}
