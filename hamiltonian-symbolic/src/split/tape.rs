//! Expressions as a list of operations on numbers, to be run many times.
//!
//! Input: nodes without loops. Output: [`Tape`]. Invariant: a condition is 1 or 0.

use super::space::Space;
use crate::dag::{Array, Kind, Map, Node, Relation};
use crate::op::Op;
use crate::rational::Rational;

enum Step {
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
pub(super) struct Tape {
    steps: Vec<Step>,
    results: Vec<usize>,
}

impl Tape {
    /// The tape of some nodes; variables are numbered as in sets, parameters and time have the
    /// values of a sample point. `None` where something has no number.
    pub(super) fn of(space: &mut Space, roots: &[Node]) -> Option<Tape> {
        let nodes = space.model.dag.reachable(roots);
        let mut place: Map<Node, usize> = Map::default();
        let mut steps = Vec::with_capacity(nodes.len());
        let number = |k: &Rational| k.to_f64();
        for node in nodes {
            let at = |child: &Node| place[child];
            let step = match space.model.dag.kind(node).clone() {
                Kind::Constant(value) => Step::Number(number(&value)),
                Kind::Pi => Step::Number(std::f64::consts::PI),
                Kind::Coefficient => Step::Coefficient,
                Kind::Element(Array::Phase(_), ..) => {
                    let bit = space.set(node).trailing_zeros();
                    Step::Variable(bit as usize)
                }
                Kind::Scalar(_) | Kind::Time | Kind::Extent(_) | Kind::Element(..) => {
                    Step::Number(space.value(node))
                }
                Kind::Sum(c, terms) => Step::Sum(
                    number(&c),
                    terms.iter().map(|(k, n)| (number(k), at(n))).collect(),
                ),
                Kind::Product(c, factors) => Step::Product(
                    number(&c),
                    factors.iter().map(|(n, k)| (at(n), *k)).collect(),
                ),
                Kind::Call(op, arguments) => Step::Call(op, arguments.iter().map(at).collect()),
                Kind::Compare(relation, a, b) => Step::Compare(relation, at(&a), at(&b)),
                Kind::Not(a) => Step::Not(at(&a)),
                Kind::And(a, b) => Step::And(at(&a), at(&b)),
                Kind::Or(a, b) => Step::Or(at(&a), at(&b)),
                Kind::Select(c, a, b) => Step::Select(at(&c), at(&a), at(&b)),
                Kind::External(..) | Kind::Reduce(..) | Kind::Count(_) | Kind::Variable(_) => {
                    return None;
                }
            };
            place.insert(node, steps.len());
            steps.push(step);
        }
        Some(Tape {
            steps,
            results: roots.iter().map(|root| place[root]).collect(),
        })
    }

    /// How many operations there are.
    pub(super) fn len(&self) -> usize {
        self.steps.len()
    }

    /// The values at a point and step coefficient; `numbers` is scratch.
    pub(super) fn run(&self, z: &[f64], c: f64, numbers: &mut Vec<f64>, results: &mut Vec<f64>) {
        numbers.clear();
        for step in &self.steps {
            let value = match step {
                Step::Number(value) => *value,
                Step::Variable(bit) => z[*bit],
                Step::Coefficient => c,
                Step::Sum(c, terms) => {
                    let mut sum = *c;
                    for (k, at) in terms {
                        sum += k * numbers[*at];
                    }
                    sum
                }
                Step::Product(c, factors) => {
                    let mut product = *c;
                    for (at, n) in factors {
                        product *= match n {
                            1 => numbers[*at],
                            2 => numbers[*at] * numbers[*at],
                            -1 => 1.0 / numbers[*at],
                            n => numbers[*at].powi(*n),
                        };
                    }
                    product
                }
                Step::Call(op, arguments) => match arguments.as_slice() {
                    [a] => op.eval(&[numbers[*a]]),
                    [a, b] => op.eval(&[numbers[*a], numbers[*b]]),
                    [a, b, c] => op.eval(&[numbers[*a], numbers[*b], numbers[*c]]),
                    more => unreachable!("{op:?} of {} arguments", more.len()),
                },
                Step::Compare(relation, a, b) => {
                    let (a, b) = (numbers[*a], numbers[*b]);
                    f64::from(match relation {
                        Relation::Less => a < b,
                        Relation::LessEqual => a <= b,
                        Relation::Equal => a == b,
                    })
                }
                Step::Not(a) => 1.0 - numbers[*a],
                Step::And(a, b) => numbers[*a] * numbers[*b],
                Step::Or(a, b) => numbers[*a].max(numbers[*b]),
                Step::Select(c, a, b) => numbers[if numbers[*c] == 0.0 { *b } else { *a }],
            };
            numbers.push(value);
        }
        results.clear();
        results.extend(self.results.iter().map(|at| numbers[*at]));
    }
}
