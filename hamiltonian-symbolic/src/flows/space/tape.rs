//! Expressions as a list of operations on numbers, to be run many times at several points together.
//!
//! Input: nodes without loops. Output: [`Tape`]. Invariant: a condition is 1 or 0; a node that
//! depends on no variable comes first and is computed once a step coefficient.
//!
//! Error balls evaluate the same nodes (`Ball::of`), at one point at a time and with bounds that orbits do not need.

use super::Variables;
use crate::dag::{Array, Dag, Kind, Node, Numbers, Relation};
use crate::list::IntoList;
use crate::op::Op;
use crate::rational::Rational;

enum TapeStep {
    Number(f64),
    Variable(usize),
    Coefficient,
    Sum(f64, Vec<(f64, usize)>),
    Product(f64, Vec<(usize, i32)>),
    Call(Op, Vec<usize>),
    Compare(Relation, usize, usize),
    Not(usize),
    And(usize, usize),
    Or(usize, usize),
    Select(usize, usize, usize),
}

/// Nodes as operations.
pub(crate) struct Tape {
    steps: Vec<TapeStep>,
    /// The number of those that depend on no variable.
    fixed: usize,
    /// The places of the roots' values.
    pub(crate) results: Vec<usize>,
}

impl Tape {
    /// The tape of some nodes. `variables` are those that a node depends on, `given` the values of parameters
    /// and sizes. `None` if a node is no operation on numbers, such as
    /// a loop or a Rust function.
    pub(crate) fn of(
        dag: &Dag,
        roots: &[Node],
        variables: impl Fn(Node) -> Variables,
        mut given: impl FnMut(Node) -> f64,
    ) -> Option<Tape> {
        let nodes = dag.reachable(roots);
        let mut place = Numbers::new(dag);
        let mut steps = Vec::with_capacity(nodes.len());
        let number = |k: &Rational| k.to_f64();
        let (fixed, moving): (Vec<Node>, Vec<Node>) = nodes
            .into_iter()
            .partition(|node| variables(*node).is_empty());
        for &node in fixed.iter().chain(&moving) {
            // Every operand was placed before.
            let at = |child: &Node| place.get(*child).map_or(usize::MAX, |at| at as usize);
            let step = match dag.kind(node) {
                Kind::Constant(value) => TapeStep::Number(number(value)),
                Kind::Pi => TapeStep::Number(std::f64::consts::PI),
                Kind::Coefficient => TapeStep::Coefficient,
                Kind::StandIn(_) => TapeStep::Number(f64::NAN),
                Kind::Element(Array::Phase(_), ..) => TapeStep::Variable(variables(node).number()),
                Kind::Scalar(_) | Kind::Time | Kind::Extent(_) | Kind::Element(..) => {
                    TapeStep::Number(given(node))
                }
                Kind::Sum(c, terms) => TapeStep::Sum(
                    number(c),
                    terms.iter().map(|(k, n)| (number(k), at(n))).into_list(),
                ),
                Kind::Product(c, factors) => TapeStep::Product(
                    number(c),
                    factors.iter().map(|(n, k)| (at(n), *k)).into_list(),
                ),
                Kind::Call(op, arguments) => {
                    TapeStep::Call(*op, arguments.iter().map(at).into_list())
                }
                Kind::Compare(relation, a, b) => TapeStep::Compare(*relation, at(a), at(b)),
                Kind::Not(a) => TapeStep::Not(at(a)),
                Kind::And(a, b) => TapeStep::And(at(a), at(b)),
                Kind::Or(a, b) => TapeStep::Or(at(a), at(b)),
                Kind::Select(c, a, b) => TapeStep::Select(at(c), at(a), at(b)),
                Kind::External(..) | Kind::Reduce(..) | Kind::Count(_) | Kind::Variable(_) => {
                    return None;
                }
            };
            place.set(node, steps.len() as u32);
            steps.push(step);
        }
        let results = roots
            .iter()
            .map(|root| place.get(*root).map(|at| at as usize));
        Some(Tape {
            results: results.collect::<Option<_>>()?,
            fixed: fixed.len(),
            steps,
        })
    }

    /// The number of operations of a run.
    pub(crate) fn len(&self) -> usize {
        self.steps.len() - self.fixed
    }

    /// The numbers of all operations, those that depend on no variable computed.
    pub(crate) fn prepared(&self, c: f64) -> Vec<Lanes> {
        let mut numbers = vec![[0.0; LANES]; self.steps.len()];
        perform(&self.steps[..self.fixed], 0, c, &[], &mut numbers);
        numbers
    }

    /// Computes the other numbers, at several points.
    pub(crate) fn run(&self, z: &[Lanes], numbers: &mut [Lanes]) {
        perform(&self.steps[self.fixed..], self.fixed, 0.0, z, numbers);
    }
}

/// At how many points operations are performed together.
pub(crate) const LANES: usize = 4;

/// A number at each of the points.
pub(crate) type Lanes = [f64; LANES];

/// A function of each lane's numbers, lane by lane: loops over lanes take most of the time without
/// optimisation.
macro_rules! lanes {
    ($f:expr, $a:expr) => {{
        let ([a, b, c, d], f) = ($a, $f);
        [f(a), f(b), f(c), f(d)]
    }};
    ($f:expr, $a:expr, $b:expr) => {{
        let ([a, b, c, d], [e, g, h, i], f) = ($a, $b, $f);
        [f(a, e), f(b, g), f(c, h), f(d, i)]
    }};
    ($f:expr, $a:expr, $b:expr, $c:expr) => {{
        let ([a, b, c, d], [e, g, h, i], [j, k, l, m], f) = ($a, $b, $c, $f);
        [f(a, e, j), f(b, g, k), f(c, h, l), f(d, i, m)]
    }};
}

/// Operations in turn, the first of which has the number `first`.
fn perform(steps: &[TapeStep], first: usize, c: f64, z: &[Lanes], numbers: &mut [Lanes]) {
    let mut at = 0;
    while at < steps.len() {
        numbers[first + at] = match &steps[at] {
            TapeStep::Number(value) => [*value; LANES],
            TapeStep::Variable(bit) => z[*bit],
            TapeStep::Coefficient => [c; LANES],
            TapeStep::Sum(constant, terms) => sum(*constant, terms, numbers),
            TapeStep::Product(constant, factors) => product(*constant, factors, numbers),
            TapeStep::Call(op, arguments) => match *arguments.as_slice() {
                [a] => lanes!(|a: f64| called(*op, &[a]), numbers[a]),
                [a, b] => lanes!(|a, b| called(*op, &[a, b]), numbers[a], numbers[b]),
                [a, b, c] => {
                    let (a, b, c) = (numbers[a], numbers[b], numbers[c]);
                    lanes!(|a, b, c| called(*op, &[a, b, c]), a, b, c)
                }
                ref more => unreachable!("{op:?} of {} arguments", more.len()),
            },
            TapeStep::Compare(relation, a, b) => {
                let holds = |a: f64, b: f64| {
                    f64::from(match relation {
                        Relation::Less => a < b,
                        Relation::LessEqual => a <= b,
                        Relation::Equal => a == b,
                    })
                };
                lanes!(holds, numbers[*a], numbers[*b])
            }
            TapeStep::Not(a) => lanes!(|a: f64| 1.0 - a, numbers[*a]),
            TapeStep::And(a, b) => lanes!(|a: f64, b: f64| a * b, numbers[*a], numbers[*b]),
            TapeStep::Or(a, b) => lanes!(f64::max, numbers[*a], numbers[*b]),
            TapeStep::Select(condition, a, b) => {
                let chosen = |condition: f64, a: f64, b: f64| if condition == 0.0 { b } else { a };
                lanes!(chosen, numbers[*condition], numbers[*a], numbers[*b])
            }
        };
        at += 1;
    }
}

/// A function's value, by our own functions: the platform's round in other ways elsewhere. An orbit that has ended
/// costs nothing.
fn called(op: Op, arguments: &[f64]) -> f64 {
    match arguments {
        [a, ..] if a.is_nan() => f64::NAN,
        _ => op.eval(arguments),
    }
}

fn sum(constant: f64, terms: &[(f64, usize)], numbers: &[Lanes]) -> Lanes {
    let [mut a, mut b, mut c, mut d] = [constant; LANES];
    let mut i = 0;
    while i < terms.len() {
        let (k, at) = terms[i];
        let [e, f, g, h] = numbers[at];
        a += k * e;
        b += k * f;
        c += k * g;
        d += k * h;
        i += 1;
    }
    [a, b, c, d]
}

fn product(constant: f64, factors: &[(usize, i32)], numbers: &[Lanes]) -> Lanes {
    let [mut a, mut b, mut c, mut d] = [constant; LANES];
    let mut i = 0;
    while i < factors.len() {
        let (at, n) = factors[i];
        let [e, f, g, h] = numbers[at];
        let mut left = n;
        while left < 0 {
            a /= e;
            b /= f;
            c /= g;
            d /= h;
            left += 1;
        }
        while left > 0 {
            a *= e;
            b *= f;
            c *= g;
            d *= h;
            left -= 1;
        }
        i += 1;
    }
    [a, b, c, d]
}
