//! Numbers at sample points, each with a bound of its rounding error.
//!
//! Input: a model, nodes, sizes, a seed. Output: [`Sampled`] values and the point they were taken
//! at. Invariant: the same seed gives the same point on every machine; |value| beyond its error
//! means that the expression is not identically zero.

use super::walk::{Meaning, Place, walk};
use crate::dag::{Array, Column, Dag, Kind, Map, Mixer, Node, Parameter, Part, Relation, Side};
use crate::index::Affine;
use crate::model::Model;
use crate::op::Op;
use crate::rational::Rational;
use std::hash::{Hash, Hasher};

/// A number and a bound of its error.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sampled {
    /// The value; NaN outside the expression's domain or on the edge of a condition.
    pub value: f64,
    /// The bound of its distance from the exact value.
    pub error: f64,
}

impl Sampled {
    /// Whether the exact value is certainly not 0.
    #[must_use]
    pub fn is_nonzero(self) -> bool {
        self.value.is_finite() && self.value.abs() > 16.0 * self.error
    }
}

/// The choice of a sample point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sample {
    /// Different seeds give different points.
    pub seed: u64,
    /// Another seed for coordinates.
    pub q: u64,
    /// Another seed for momenta.
    pub p: u64,
    /// Whether coordinates and momenta may be negative.
    pub signed: bool,
    /// The parameters that may be negative, and whether the time may.
    pub signs: Signs,
    /// Whether parameters are multiples of 1/2: powers of negative numbers have values where
    /// exponents are whole.
    pub halves: bool,
}

/// The parameters that are negative: those whose number modulo 3 is a bit of the set; of arrays, some
/// elements. The time may be where any is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Signs(u8);

impl Signs {
    /// All choices but that of no negative ones, all negative first.
    pub fn negative() -> impl Iterator<Item = Signs> + Clone {
        [7, 1, 2, 4, 3, 5, 6].into_iter().map(Signs)
    }
    fn of(self, parameter: Parameter) -> bool {
        self.0 >> (parameter.0 % 3) & 1 == 1
    }
}

/// A sample point: names with their values, in order of first use.
pub type Point = Vec<(String, f64)>;

/// The values of some nodes at a sample point, and the point; `None` if a loop runs too long.
/// Some elements, and the time, may be given values of their own.
#[must_use]
pub fn sample(
    model: &Model,
    roots: &[Node],
    sizes: &[i64],
    how: Sample,
    given: &[(Node, f64)],
) -> Option<(Vec<Sampled>, Point)> {
    let mut elements = Map::default();
    let mut time = None;
    for (node, value) in given {
        match model.dag.kind(*node) {
            Kind::Element(array, row, None) => {
                if let Some(row) = row.affine.as_constant() {
                    elements.insert((*array, row, 0), *value);
                }
            }
            Kind::Time => time = Some(*value),
            _ => {}
        }
    }
    let meaning = Numbers {
        given: elements,
        time,
        ..Numbers::new(model, how)
    };
    let (values, numbers) = walk(&model.dag, roots, sizes, meaning);
    Some((values?, numbers.point))
}

/// Values at one sample point of nodes without loops, each computed once. Every size is 3.
#[derive(Debug)]
pub(crate) struct Values {
    how: Sample,
    known: Vec<Option<Sampled>>,
}

impl Values {
    pub(crate) fn new(how: Sample) -> Values {
        let known = Vec::new();
        Values { how, known }
    }
    /// The value of a node.
    pub(crate) fn at(&mut self, model: &Model, node: Node) -> Sampled {
        let dag = &model.dag;
        let place = |node: Node| node.0 as usize;
        self.known.resize(dag.len(), None);
        if let Some(known) = self.known[place(node)] {
            return known;
        }
        let unknown = dag.reached(&[node], |node, ahead| {
            dag.for_children(node, |child| {
                if self.known[place(child)].is_none() {
                    ahead.add(child);
                }
            });
        });
        let sizes = vec![3; model.sizes.len()];
        let (outside, mut numbers) = (Place::new(&sizes), Numbers::new(model, self.how));
        for node in unknown {
            let child = |child: Node| self.known[place(child)].unwrap_or(exact(f64::NAN));
            let value = numbers.value(dag, node, &outside, &child);
            self.known[place(node)] = Some(value);
        }
        self.known[place(node)].unwrap_or(exact(f64::NAN))
    }
}

/// The next number of a pseudo-random sequence (SplitMix64: Steele, Lea & Flood 2014).
pub(crate) fn next_random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut bits = *state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ (bits >> 31)
}

/// The most nodes a sample may visit.
const LONGEST: usize = 1 << 20;

struct Numbers<'a> {
    model: &'a Model,
    how: Sample,
    given: Map<(Array, i64, i64), f64>,
    time: Option<f64>,
    read: Map<(Array, i64, i64), ()>,
    point: Point,
    visits: usize,
}

impl<'a> Numbers<'a> {
    fn new(model: &'a Model, how: Sample) -> Numbers<'a> {
        Numbers {
            model,
            how,
            given: Map::default(),
            time: None,
            read: Map::default(),
            point: Vec::new(),
            visits: 0,
        }
    }

    /// A multiple of 1/64 between 1/4 and 9/4, of either sign where asked.
    fn leaf(&self, key: &impl Hash, salt: u64, signed: bool) -> f64 {
        let mut hasher = Mixer::default();
        key.hash(&mut hasher);
        self.how.seed.hash(&mut hasher);
        salt.hash(&mut hasher);
        let bits = next_random(&mut hasher.finish());
        let size = (16 + bits % 128) as f64 / 64.0;
        if signed && bits >> 32 & 1 == 1 {
            -size
        } else {
            size
        }
    }

    fn given_parameter(&self, value: f64) -> f64 {
        if self.how.halves {
            (2.0 * value).ceil() / 2.0
        } else {
            value
        }
    }

    fn element(&mut self, array: Array, row: i64, column: i64, place: &Place) -> f64 {
        let key = (array, row, column);
        let value = match (self.given.get(&key), array) {
            (Some(value), _) => *value,
            (None, Array::Phase(Column { side: Side::Q, .. })) => {
                self.leaf(&key, self.how.q, self.how.signed)
            }
            (None, Array::Phase(Column { side: Side::P, .. })) => {
                self.leaf(&key, self.how.p, self.how.signed)
            }
            (None, Array::Direction(_) | Array::Velocity(_) | Array::Held(_)) => {
                self.leaf(&key, 0, self.how.signed)
            }
            (None, Array::Parameter(parameter)) => {
                let value = self.leaf(&key, 0, self.how.signs.of(parameter));
                self.given_parameter(value)
            }
        };
        if self.read.insert(key, ()).is_none() {
            let column = match array {
                Array::Phase(at) | Array::Direction(at) | Array::Velocity(at) => {
                    i64::from(at.column)
                }
                Array::Parameter(_) | Array::Held(_) => column,
            };
            let (name, extent) = (self.model.array_name(array), |e: &Affine| place.affine(e));
            let name = self.model.element(&name, array, [row, column], extent);
            self.point.push((name, value));
        }
        value
    }

    fn named(&mut self, name: &str, value: f64) -> f64 {
        if !self.point.iter().any(|(n, _)| n == name) {
            self.point.push((name.to_owned(), value));
        }
        value
    }
}

const UNIT: f64 = f64::EPSILON / 2.0;

fn exact(value: f64) -> Sampled {
    Sampled { value, error: 0.0 }
}

fn number(value: &Rational) -> Sampled {
    let (hi, lo) = value.to_words();
    Sampled {
        value: hi,
        error: lo.abs() * (1.0 + f64::EPSILON),
    }
}

/// Sums and products of multiples of 1/64, as whole numbers are, have no error up to this size.
const SHORT: f64 = 1e12;

/// Whether this is such a number.
fn is_short(a: Sampled) -> bool {
    a.error == 0.0 && (64.0 * a.value).fract() == 0.0
}

/// a + b + …
pub(crate) fn sum(parts: impl Iterator<Item = Sampled>) -> Sampled {
    let (mut value, mut error, mut size, mut count) = (0.0, 0.0, 0.0, 0.0);
    let mut short = true;
    for part in parts {
        value += part.value;
        error += part.error;
        size += part.value.abs();
        count += 1.0;
        short &= is_short(part);
    }
    if short && size < SHORT {
        return exact(value);
    }
    Sampled {
        value,
        error: error + count * UNIT * size,
    }
}

/// a·b
pub(crate) fn product(a: Sampled, b: Sampled) -> Sampled {
    let value = a.value * b.value;
    if is_short(a) && is_short(b) && value.abs() < SHORT {
        return exact(value);
    }
    Sampled {
        value,
        error: a.value.abs() * b.error
            + b.value.abs() * a.error
            + a.error * b.error
            + UNIT * value.abs(),
    }
}

/// A function of one number: its error is how much the argument's error moves it.
fn through(x: Sampled, f: impl Fn(f64) -> f64) -> Sampled {
    let value = f(x.value);
    let by = x.error.max(UNIT * x.value.abs());
    let moved = (f(x.value + by) - value)
        .abs()
        .max((f(x.value - by) - value).abs());
    Sampled {
        value,
        error: if x.error == 0.0 { 0.0 } else { 2.0 * moved } + 8.0 * UNIT * value.abs(),
    }
}

fn power(x: Sampled, n: i32) -> Sampled {
    let value = x.value.powi(n);
    let relative = f64::from(n.unsigned_abs()) * (x.error / x.value.abs() + UNIT);
    if x.value == 0.0 && x.error == 0.0 {
        return exact(value);
    }
    Sampled {
        value,
        error: 2.0 * relative * value.abs(),
    }
}

impl Meaning for Numbers<'_> {
    type Value = Sampled;

    fn value(
        &mut self,
        dag: &Dag,
        node: Node,
        place: &Place,
        child: &dyn Fn(Node) -> Sampled,
    ) -> Sampled {
        self.visits += 1;
        let truth = |flag: bool| exact(f64::from(u8::from(flag)));
        match dag.kind(node) {
            Kind::Constant(value) => number(value),
            Kind::Pi => Sampled {
                value: std::f64::consts::PI,
                error: crate::PI_LOW,
            },
            Kind::Scalar(parameter) => {
                let declared = self.model.parameters.get(usize::from(parameter.0));
                // A parameter that stands for a node of the engine has no value.
                let Some(name) = declared.map(|declared| declared.name.clone()) else {
                    return exact(f64::NAN);
                };
                let size = self.leaf(&(1u8, parameter), 0, false);
                let is_negative = self.how.signs.of(*parameter);
                let value = self.given_parameter(if is_negative { -size } else { size });
                exact(self.named(&name, value))
            }
            Kind::Time => {
                let name = self.model.time_name().to_owned();
                let value = self.time.unwrap_or_else(|| {
                    let is_signed = self.how.signs != Signs::default();
                    self.leaf(&2u8, 0, is_signed)
                });
                exact(self.named(&name, value))
            }
            Kind::Coefficient => exact(self.leaf(&3u8, 0, false)),
            Kind::Variable(domain) => exact(place.variable(*domain) as f64),
            Kind::Extent(size) => exact(place.size(*size) as f64),
            Kind::Count(domain) => exact(place.count(dag, *domain) as f64),
            Kind::Element(array, row, column) => {
                let (row, column) = (
                    place.index(row),
                    column.as_ref().map_or(0, |c| place.index(c)),
                );
                exact(self.element(*array, row, column, place))
            }
            Kind::Sum(c, terms) => {
                let parts = terms.iter().map(|(k, n)| {
                    if k.is_one() {
                        child(*n)
                    } else {
                        product(number(k), child(*n))
                    }
                });
                sum(std::iter::once(number(c))
                    .filter(|c| c.value != 0.0)
                    .chain(parts))
            }
            Kind::Product(k, factors) => factors.iter().fold(number(k), |value, &(n, exponent)| {
                let factor = if exponent == 1 {
                    child(n)
                } else {
                    power(child(n), exponent)
                };
                product(value, factor)
            }),
            Kind::Call(op, x) => match x.as_slice() {
                [x] => through(child(*x), |x| op.eval(&[x])),
                [x, y] => {
                    let (x, y) = (child(*x), child(*y));
                    if matches!(op, Op::Min | Op::Max) {
                        // Emitted code keeps a NaN of either.
                        if x.value.is_nan() || y.value.is_nan() {
                            return exact(f64::NAN);
                        }
                        let first = (*op == Op::Min) == (x.value <= y.value);
                        return if first { x } else { y };
                    }
                    let (a, b) = (
                        through(x, |x| op.eval(&[x, y.value])),
                        through(y, |y| op.eval(&[x.value, y])),
                    );
                    Sampled {
                        value: a.value,
                        error: a.error + b.error,
                    }
                }
                more => unreachable!("{op:?} of {} arguments", more.len()),
            },
            Kind::External(function, part, arguments) => {
                // Any smooth function will do: sin(w·x + 1), with its own derivatives.
                let weight = |i: usize| 0.625 + 0.25 * i as f64 + 0.375 * f64::from(*function);
                let angle = sum(std::iter::once(exact(1.0)).chain(
                    arguments
                        .iter()
                        .enumerate()
                        .map(|(i, x)| product(exact(weight(i)), child(*x))),
                ));
                let scaled =
                    |factor: f64, f: fn(f64) -> f64| product(exact(factor), through(angle, f));
                match part {
                    Part::Value => scaled(1.0, f64::sin),
                    Part::First(i) => scaled(weight(usize::from(*i)), f64::cos),
                    Part::Second(i, j) => {
                        scaled(-weight(usize::from(*i)) * weight(usize::from(*j)), f64::sin)
                    }
                    // Its arguments are not known: points do not refute what has it.
                    Part::Higher { .. } => exact(f64::NAN),
                }
            }
            Kind::Compare(relation, a, b) => {
                let (a, b) = (child(*a), child(*b));
                let distance = (a.value - b.value).abs();
                let error = a.error + b.error;
                // `q[i] <= q[j]` has no difference at i = j: both are rounded alike.
                let is_same = distance == 0.0 && a.error == b.error;
                if !(distance > error || is_same) {
                    return exact(f64::NAN);
                }
                truth(match relation {
                    Relation::Less => a.value < b.value,
                    Relation::LessEqual => a.value <= b.value,
                    Relation::Equal => a.value == b.value,
                })
            }
            Kind::Not(a) => exact(1.0 - child(*a).value),
            Kind::And(a, b) => exact(child(*a).value * child(*b).value),
            Kind::Or(a, b) => {
                let (a, b) = (child(*a).value, child(*b).value);
                exact(a + b - a * b)
            }
            Kind::Select(c, yes, no) => match child(*c).value {
                c if c.is_nan() => exact(f64::NAN),
                c => child(if c == 1.0 { *yes } else { *no }),
            },
            Kind::Reduce(..) => unreachable!("the walk runs loops itself"),
        }
    }

    fn total(&mut self, parts: Vec<Sampled>) -> Sampled {
        sum(parts.into_iter())
    }

    fn is_done(&self) -> bool {
        self.visits > LONGEST
    }
}
