//! Numbers at sample points, each with a bound of its rounding error.
//!
//! Input: a model, nodes, sizes, a seed. Output: [`Ball`] values and the point they were taken
//! at. Invariant: the same seed gives the same point on every machine; |value| beyond its error
//! means that the expression is not identically zero, and so do its bounds, which hold on every machine.

use super::walk::{Environment, Meaning, walk};
use crate::algebra::ball::Ball;
use crate::dag::{Array, Column, Dag, Kind, Map, Mixer, Node, Parameter, Side};
use crate::index::Affine;
use crate::model::Model;
use std::hash::{Hash, Hasher};

/// The choice of a sample point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sample {
    /// Different seeds give different points.
    pub seed: u64,
    /// Another seed for coordinates.
    pub q: u64,
    /// Another seed for momenta.
    pub p: u64,
    /// True if coordinates and momenta may be negative.
    pub signed: bool,
    /// The parameters that may be negative, and whether the time may.
    pub signs: Signs,
    /// True if parameters are multiples of 1/2: powers of negative numbers have values where
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
pub type SamplePoint = Vec<(String, f64)>;

/// The values of some nodes at a sample point, and the point; `None` if a loop runs too long.
/// Some elements, and the time, may be given values of their own.
#[must_use]
pub fn sample(
    model: &Model,
    roots: &[Node],
    sizes: &[i64],
    how: Sample,
    given: &[(Node, Ball)],
) -> Option<(Vec<Ball>, SamplePoint)> {
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
    let meaning = Evaluator {
        given: elements,
        time,
        ..Evaluator::new(model, how)
    };
    let (values, numbers) = walk(&model.dag, roots, sizes, meaning);
    Some((values?, numbers.point))
}

/// Values at one sample point of nodes without loops, each computed once. Every size is 3.
#[derive(Debug)]
pub(crate) struct Values {
    how: Sample,
    known: Vec<Option<Ball>>,
}

impl Values {
    pub(crate) fn new(how: Sample) -> Values {
        let known = Vec::new();
        Values { how, known }
    }
    /// The values of nodes for given values of some leaves.
    pub(crate) fn with(how: Sample, given: impl Iterator<Item = (Node, Ball)>) -> Values {
        let mut values = Values::new(how);
        for (leaf, value) in given {
            values.reach(leaf);
            values.known[leaf.0 as usize] = Some(value);
        }
        values
    }
    /// Makes place for a node and its operands, which have smaller numbers; the arena may be much longer.
    fn reach(&mut self, node: Node) {
        while self.known.len() <= node.0 as usize {
            // Blocks are copied whole.
            self.known.extend_from_slice(&[None; 256]);
        }
    }
    /// The value of a node.
    pub(crate) fn at(&mut self, model: &Model, node: Node) -> Ball {
        let dag = &model.dag;
        let place = |node: Node| node.0 as usize;
        self.reach(node);
        if let Some(known) = self.known[place(node)] {
            return known;
        }
        let unknown = dag.reached(&[node], &mut |node, ahead| {
            dag.for_children(node, |child| {
                if self.known[place(child)].is_none() {
                    ahead.add(child);
                }
            });
        });
        let sizes = vec![3; model.sizes.len()];
        let (outside, mut numbers) = (Environment::new(&sizes), Evaluator::new(model, self.how));
        for node in unknown {
            let child = |child: Node| self.known[place(child)].unwrap_or(Ball::exact(f64::NAN));
            let value = numbers.value(dag, node, &outside, &child);
            self.known[place(node)] = Some(value);
        }
        self.known[place(node)].unwrap_or(Ball::exact(f64::NAN))
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

struct Evaluator<'a> {
    model: &'a Model,
    how: Sample,
    given: Map<(Array, i64, i64), Ball>,
    time: Option<Ball>,
    read: Map<(Array, i64, i64), ()>,
    point: SamplePoint,
    visits: usize,
}

impl<'a> Evaluator<'a> {
    fn new(model: &'a Model, how: Sample) -> Evaluator<'a> {
        Evaluator {
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

    fn element(&mut self, array: Array, row: i64, column: i64, place: &Environment) -> Ball {
        let key = (array, row, column);
        let leaf = || match array {
            Array::Phase(Column { side: Side::Q, .. }) => {
                self.leaf(&key, self.how.q, self.how.signed)
            }
            Array::Phase(Column { side: Side::P, .. }) => {
                self.leaf(&key, self.how.p, self.how.signed)
            }
            Array::Direction(_) | Array::Velocity(_) | Array::Hoisted(_) => {
                self.leaf(&key, 0, self.how.signed)
            }
            Array::Parameter(parameter) => {
                let value = self.leaf(&key, 0, self.how.signs.of(parameter));
                self.given_parameter(value)
            }
        };
        let given = self.given.get(&key).copied();
        let value = given.unwrap_or_else(|| Ball::exact(leaf()));
        if self.read.insert(key, ()).is_none() {
            let column = match array {
                Array::Phase(at) | Array::Direction(at) | Array::Velocity(at) => {
                    i64::from(at.column)
                }
                Array::Parameter(_) | Array::Hoisted(_) => column,
            };
            let (name, extent) = (self.model.array_name(array), |e: &Affine| place.affine(e));
            let name = self.model.element(&name, array, [row, column], extent);
            self.point.push((name, value.value));
        }
        value
    }

    fn named(&mut self, name: &str, value: Ball) -> Ball {
        if !self.point.iter().any(|(n, _)| n == name) {
            self.point.push((name.to_owned(), value.value));
        }
        value
    }
}

impl Meaning for Evaluator<'_> {
    type Value = Ball;

    fn value(
        &mut self,
        dag: &Dag,
        node: Node,
        place: &Environment,
        child: &dyn Fn(Node) -> Ball,
    ) -> Ball {
        self.visits += 1;
        if let Some(value) = Ball::of(dag, node, child) {
            return value;
        }
        match dag.kind(node) {
            Kind::Scalar(parameter) => {
                let declared = &self.model.parameters[usize::from(parameter.0)];
                let name = declared.name.clone();
                let size = self.leaf(&(1u8, parameter), 0, false);
                let is_negative = self.how.signs.of(*parameter);
                let value = self.given_parameter(if is_negative { -size } else { size });
                self.named(&name, Ball::exact(value))
            }
            Kind::Time => {
                let name = self.model.time_name().to_owned();
                let value = self.time.unwrap_or_else(|| {
                    let is_signed = self.how.signs != Signs::default();
                    Ball::exact(self.leaf(&2u8, 0, is_signed))
                });
                self.named(&name, value)
            }
            Kind::StandIn(_) => Ball::exact(f64::NAN),
            Kind::Coefficient => Ball::exact(self.leaf(&3u8, 0, false)),
            Kind::Variable(domain) => Ball::exact(place.variable(*domain) as f64),
            Kind::Extent(size) => Ball::exact(place.size(*size) as f64),
            Kind::Count(domain) => Ball::exact(place.count(dag, *domain) as f64),
            Kind::Element(array, row, column) => {
                let (row, column) = (
                    place.index(row),
                    column.as_ref().map_or(0, |c| place.index(c)),
                );
                self.element(*array, row, column, place)
            }
            _ => unreachable!("the walk runs loops itself"),
        }
    }

    fn total(&mut self, parts: Vec<Ball>) -> Ball {
        Ball::sum(parts.into_iter())
    }

    fn is_done(&self) -> bool {
        self.visits > LONGEST
    }
}
