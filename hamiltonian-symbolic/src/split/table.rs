//! Every node's value at a few points, each computed once.
//!
//! Input: the arena, leaf by leaf numbers. Output: [`Table::at`]. Invariant: a value comes with a
//! bound of its rounding error; an undefined value is NaN.

use crate::dag::{Dag, Kind, Node, Relation};

/// How many points there are.
pub(super) const POINTS: usize = 2;

const EPSILON: f64 = f64::EPSILON;

/// A value and how far rounding may have moved it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub(super) value: f64,
    error: f64,
}

impl Near {
    /// A number that is rounded once.
    pub(super) fn rounded(value: f64) -> Near {
        Near {
            value,
            error: EPSILON * value.abs(),
        }
    }
    /// a + b
    pub(super) fn plus(self, other: Near) -> Near {
        let value = self.value + other.value;
        let size = self.value.abs() + other.value.abs();
        Near {
            value,
            error: self.error + other.error + EPSILON * size,
        }
    }
    /// a·b
    pub(super) fn times(self, other: Near) -> Near {
        let value = self.value * other.value;
        let moved = (self.value.abs() + self.error) * other.error + self.error * other.value.abs();
        Near {
            value,
            error: moved + EPSILON * value.abs(),
        }
    }
    /// Whether the exact value is certainly not 0.
    pub(super) fn is_nonzero(self) -> bool {
        self.value.is_finite() && self.value.abs() > 64.0 * self.error
    }
}

/// Values of all nodes so far, at every point.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    values: Vec<[Near; POINTS]>,
}

impl Table {
    /// The values of a node; `leaf` gives those of leaves.
    pub(super) fn at(
        &mut self,
        dag: &Dag,
        node: Node,
        leaf: impl Fn(Node) -> [Near; POINTS],
    ) -> [Near; POINTS] {
        // Children have smaller numbers.
        for number in self.values.len()..=node.0 as usize {
            let node = Node(number as u32);
            let is_leaf = matches!(
                dag.kind(node),
                Kind::Scalar(_)
                    | Kind::Time
                    | Kind::Coefficient
                    | Kind::Extent(_)
                    | Kind::Element(..)
            );
            let known = match is_leaf {
                true => leaf(node),
                false => {
                    let mut found = [Near::rounded(f64::NAN); POINTS];
                    for (at, found) in found.iter_mut().enumerate() {
                        *found = value(dag, node, |child: Node| self.values[child.0 as usize][at]);
                    }
                    found
                }
            };
            self.values.push(known);
        }
        self.values[node.0 as usize]
    }
}

fn value(dag: &Dag, node: Node, of: impl Fn(Node) -> Near) -> Near {
    let nothing = Near::rounded(f64::NAN);
    let truth = |holds: bool| Near {
        value: f64::from(u8::from(holds)),
        error: 0.0,
    };
    match dag.kind(node) {
        Kind::Constant(value) => Near::rounded(value.to_f64()),
        Kind::Pi => Near::rounded(std::f64::consts::PI),
        Kind::Sum(c, terms) => {
            let c = c.to_f64();
            let (mut sum, mut size, mut error) = (c, c.abs(), 0.0);
            for (k, child) in terms {
                let (k, child) = (k.to_f64(), of(*child));
                sum += k * child.value;
                size += (k * child.value).abs();
                error += k.abs() * child.error;
            }
            Near {
                value: sum,
                error: error + 2.0 * EPSILON * size,
            }
        }
        Kind::Product(c, factors) => {
            let (mut product, mut relative) = (c.to_f64(), EPSILON);
            for (child, n) in factors {
                let child = of(*child);
                product *= match n {
                    1 => child.value,
                    -1 => 1.0 / child.value,
                    n => child.value.powi(*n),
                };
                relative +=
                    f64::from(n.unsigned_abs()) * (child.error / child.value.abs() + EPSILON);
            }
            Near {
                value: product,
                // A factor 0 has no relative error: nothing is known of such a product.
                error: product.abs() * relative,
            }
        }
        Kind::Call(op, arguments) => match arguments.as_slice() {
            [a] => {
                let a = of(*a);
                let image = op.eval(&[a.value]);
                let (up, down) = (op.eval(&[a.value + a.error]), op.eval(&[a.value - a.error]));
                Near {
                    value: image,
                    error: (up - image).abs() + (image - down).abs() + 4.0 * EPSILON * image.abs(),
                }
            }
            [a, b] => {
                let (a, b) = (of(*a), of(*b));
                let image = op.eval(&[a.value, b.value]);
                let first = op.eval(&[a.value + a.error, b.value]);
                let second = op.eval(&[a.value, b.value + b.error]);
                Near {
                    value: image,
                    error: 2.0 * ((first - image).abs() + (second - image).abs())
                        + 4.0 * EPSILON * image.abs(),
                }
            }
            _ => nothing,
        },
        Kind::Compare(relation, a, b) => {
            let (a, b) = (of(*a).value, of(*b).value);
            truth(match relation {
                Relation::Less => a < b,
                Relation::LessEqual => a <= b,
                Relation::Equal => a == b,
            })
        }
        Kind::Not(a) => truth(of(*a).value == 0.0),
        Kind::And(a, b) => truth(of(*a).value * of(*b).value != 0.0),
        Kind::Or(a, b) => truth(of(*a).value + of(*b).value != 0.0),
        Kind::Select(c, a, b) => of(if of(*c).value == 0.0 { *b } else { *a }),
        _ => nothing,
    }
}
