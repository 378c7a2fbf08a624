//! H as a list of operations on numbers with a reverse sweep: Hamilton's equations without the engine's
//! derivatives, programs and flows.
//!
//! Input: a node, sizes, numbers of parameters, and of some loops the one iteration to take. Output:
//! [`Field`]. Invariant: loops are written out when it is made; every variable is a number of the
//! flat point.

use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::dag::{Array, Kind, Map, Node, Parameter, Relation, Side};
use hamiltonian_symbolic::index::{Affine, Domain};
use hamiltonian_symbolic::model::{Model, Shape};
use hamiltonian_symbolic::op::Op;

/// Sizes and parameters.
#[derive(Clone, Debug, Default)]
pub struct World {
    pub sizes: Vec<usize>,
    /// Of each parameter its columns.
    pub parameters: Vec<Vec<Vec<f64>>>,
    pub t: f64,
}

/// Rows and columns of a shape.
pub fn extents(shape: &Shape, sizes: &[usize]) -> (usize, usize) {
    let value = |a: &Affine| a.value(&|_| 0, &|s| sizes[s.0 as usize] as i64) as usize;
    match shape {
        Shape::Scalar => (1, 1),
        Shape::Vector(rows) | Shape::Lattice(rows, _) => (value(rows), 1),
        Shape::Matrix(rows, columns) => (value(rows), value(columns)),
    }
}

/// The numbers of a flat point: coordinates of group after group, column after column, then momenta.
pub struct Layout {
    /// Of each group the first place, the rows and the columns.
    pub groups: Vec<(usize, usize, usize)>,
    pub half: usize,
}

impl Layout {
    pub fn of(model: &Model, sizes: &[usize]) -> Layout {
        let mut half = 0;
        let mut groups = Vec::new();
        for group in &model.groups {
            let (rows, columns) = match &group.shape {
                Shape::Scalar => (1, 1),
                Shape::Vector(rows) | Shape::Lattice(rows, _) => {
                    extents(&Shape::Vector(rows.clone()), sizes)
                }
                Shape::Matrix(rows, columns) => {
                    let (rows, _) = extents(&Shape::Vector(rows.clone()), sizes);
                    (rows, usize::from(*columns))
                }
            };
            groups.push((half, rows, columns));
            half += rows * columns;
        }
        Layout { groups, half }
    }
    pub fn place(&self, side: Side, group: usize, column: usize, row: usize) -> usize {
        let (start, rows, columns) = self.groups[group];
        assert!(row < rows && column < columns, "row {row} of {rows}");
        let own = start + column * rows + row;
        match side {
            Side::Q => own,
            Side::P => self.half + own,
        }
    }
}

enum Operation {
    Number(D),
    Variable(usize),
    Sum(D, Vec<(D, usize)>),
    Product(D, Vec<(usize, i32)>),
    Call(Op, Vec<usize>),
    Compare(Relation, usize, usize),
    Not(usize),
    And(usize, usize),
    Or(usize, usize),
    Select(usize, usize, usize),
}

/// ż = J∇H.
pub struct Field {
    operations: Vec<Operation>,
    half: usize,
}

struct Maker<'a> {
    model: &'a Model,
    world: &'a World,
    only: &'a [(Domain, i64)],
    layout: Layout,
    variables: Map<Domain, i64>,
    /// What was made outside of loops.
    known: Map<Node, usize>,
    operations: Vec<Operation>,
}

impl Field {
    pub fn of(model: &Model, h: Node, world: &World, only: &[(Domain, i64)]) -> Field {
        let layout = Layout::of(model, &world.sizes);
        let mut maker = Maker {
            model,
            world,
            only,
            layout,
            variables: Map::default(),
            known: Map::default(),
            operations: Vec::new(),
        };
        maker.node(h);
        Field {
            half: maker.layout.half,
            operations: maker.operations,
        }
    }

    /// True for each base below a fraction line that is negative.
    pub fn divisors(&self, z: &[D]) -> Vec<bool> {
        let values = self.values(z);
        let mut signs = Vec::new();
        for operation in &self.operations {
            if let Operation::Product(_, factors) = operation {
                let below = factors.iter().filter(|(_, n)| *n < 0);
                signs.extend(below.map(|(base, _)| values[*base].to_f64() < 0.0));
            }
        }
        signs
    }

    fn values(&self, z: &[D]) -> Vec<D> {
        let (zero, one) = (D::from(0.0), D::from(1.0));
        let mut values: Vec<D> = Vec::with_capacity(self.operations.len());
        let truth = |is: bool| if is { one } else { zero };
        for operation in &self.operations {
            let v = |at: &usize| values[*at];
            let holds = |at: &usize| values[*at].to_f64() != 0.0;
            values.push(match operation {
                Operation::Number(x) => *x,
                Operation::Variable(at) => z[*at],
                Operation::Sum(c, terms) => terms.iter().fold(*c, |sum, (k, at)| sum + *k * v(at)),
                Operation::Product(k, factors) => factors
                    .iter()
                    .fold(*k, |product, (at, n)| product * power(v(at), *n)),
                Operation::Call(op, x) => {
                    let x: Vec<D> = x.iter().map(v).collect();
                    op.eval(&x)
                }
                Operation::Compare(relation, a, b) => {
                    let difference = v(a) - v(b);
                    let difference = difference.to_f64();
                    truth(match relation {
                        Relation::Less => difference < 0.0,
                        Relation::LessEqual => difference <= 0.0,
                        Relation::Equal => difference == 0.0,
                    })
                }
                Operation::Not(a) => truth(!holds(a)),
                Operation::And(a, b) => truth(holds(a) && holds(b)),
                Operation::Or(a, b) => truth(holds(a) || holds(b)),
                Operation::Select(c, a, b) => v(if holds(c) { a } else { b }),
            });
        }
        values
    }

    /// H and J∇H.
    pub fn at(&self, z: &[D]) -> (D, Vec<D>) {
        let (zero, one) = (D::from(0.0), D::from(1.0));
        let values = self.values(z);
        let mut slopes = vec![zero; values.len()];
        let mut gradient = vec![zero; 2 * self.half];
        if let Some(last) = slopes.last_mut() {
            *last = one;
        }
        for (at, operation) in self.operations.iter().enumerate().rev() {
            let slope = slopes[at];
            if slope.to_f64() == 0.0 {
                continue;
            }
            match operation {
                Operation::Variable(place) => gradient[*place] += slope,
                Operation::Sum(_, terms) => {
                    for (k, term) in terms {
                        slopes[*term] += slope * *k;
                    }
                }
                Operation::Product(k, factors) => {
                    for (one_of, (factor, n)) in factors.iter().enumerate() {
                        let mut by = *k * D::from(f64::from(*n)) * power(values[*factor], n - 1);
                        for (other, (factor, n)) in factors.iter().enumerate() {
                            if other != one_of {
                                by *= power(values[*factor], *n);
                            }
                        }
                        slopes[*factor] += slope * by;
                    }
                }
                Operation::Call(op, x) => {
                    let arguments: Vec<D> = x.iter().map(|at| values[*at]).collect();
                    for (place, by) in x.iter().zip(partials(*op, &arguments, values[at])) {
                        slopes[*place] += slope * by;
                    }
                }
                Operation::Select(c, a, b) => {
                    let chosen = if values[*c].to_f64() != 0.0 { a } else { b };
                    slopes[*chosen] += slope;
                }
                _ => {}
            }
        }
        let (by_q, by_p) = gradient.split_at(self.half);
        let rates = by_p.iter().copied().chain(by_q.iter().map(|x| -*x));
        (values.last().copied().unwrap_or(zero), rates.collect())
    }
}

fn power(x: D, n: i32) -> D {
    let whole = (0..n.unsigned_abs()).fold(D::from(1.0), |product, _| product * x);
    if n < 0 { D::from(1.0) / whole } else { whole }
}

/// The partial derivatives of a function with value f.
fn partials(op: Op, x: &[D], f: D) -> Vec<D> {
    let one = D::from(1.0);
    let a = x[0];
    let root = |x: D| x.sqrt();
    let pick = |is: bool| {
        if is {
            [one, D::from(0.0)]
        } else {
            [D::from(0.0), one]
        }
    };
    match op {
        Op::Sqrt => vec![one / (f + f)],
        Op::Cbrt => vec![one / (D::from(3.0) * f * f)],
        Op::Abs => vec![Op::Sign.eval(&[a])],
        Op::Sign | Op::Floor | Op::Round => vec![D::from(0.0)],
        Op::Modulo | Op::Remainder => vec![one, ((f - a) / x[1]).round()],
        Op::Sin => vec![a.cos()],
        Op::Cos => vec![-a.sin()],
        Op::Tan => vec![one + f * f],
        Op::Asin => vec![one / root(one - a * a)],
        Op::Acos => vec![-(one / root(one - a * a))],
        Op::Atan => vec![one / (one + a * a)],
        Op::Sinh => vec![a.cosh()],
        Op::Cosh => vec![a.sinh()],
        Op::Tanh => vec![one - f * f],
        Op::Asinh => vec![one / root(one + a * a)],
        Op::Acosh => vec![one / root(a * a - one)],
        Op::Atanh => vec![one / (one - a * a)],
        Op::Exp => vec![f],
        Op::ExpM1 => vec![a.exp()],
        Op::Ln => vec![one / a],
        Op::Ln1p => vec![one / (one + a)],
        Op::Atan2 => {
            let square = a * a + x[1] * x[1];
            vec![x[1] / square, -(a / square)]
        }
        Op::Hypot => vec![a / f, x[1] / f],
        Op::Min => pick((a - x[1]).to_f64() <= 0.0).to_vec(),
        Op::Max => pick((a - x[1]).to_f64() >= 0.0).to_vec(),
        Op::Pow => vec![x[1] * Op::Pow.eval(&[a, x[1] - one]), f * a.ln()],
        other => panic!("{other:?} is not in the judge's books"),
    }
}

impl Maker<'_> {
    fn push(&mut self, operation: Operation) -> usize {
        self.operations.push(operation);
        self.operations.len() - 1
    }
    fn affine(&self, affine: &Affine) -> i64 {
        let size = |s: hamiltonian_symbolic::index::Size| self.world.sizes[s.0 as usize] as i64;
        affine.value(&|d| self.variables[&d], &size)
    }
    fn all(&mut self, nodes: &[Node]) -> Vec<usize> {
        nodes.iter().map(|node| self.node(*node)).collect()
    }

    fn node(&mut self, node: Node) -> usize {
        if let Some(known) = self.known.get(&node) {
            return *known;
        }
        let real = |x: i64| Operation::Number(D::from(x as f64));
        let number = |k: &hamiltonian_symbolic::rational::Rational| {
            let (high, low) = k.to_words();
            D::constant(high, low)
        };
        let operation = match self.model.dag.kind(node).clone() {
            Kind::Constant(k) => Operation::Number(number(&k)),
            Kind::Pi => Operation::Number(D::constant(
                std::f64::consts::PI,
                hamiltonian_symbolic::PI_LOW,
            )),
            Kind::Scalar(Parameter(at)) => {
                Operation::Number(D::from(self.world.parameters[usize::from(at)][0][0]))
            }
            Kind::Time => Operation::Number(D::from(self.world.t)),
            Kind::Variable(domain) => real(self.variables[&domain]),
            Kind::Extent(size) => real(self.world.sizes[usize::from(size.0)] as i64),
            Kind::Element(array, row, column) => {
                let size =
                    |s: hamiltonian_symbolic::index::Size| self.world.sizes[s.0 as usize] as i64;
                let value = |index: &hamiltonian_symbolic::index::Index| {
                    index.value(&|d| self.variables[&d], &size) as usize
                };
                let (row, column) = (value(&row), column.as_deref().map_or(0, value));
                match array {
                    Array::Phase(at) => {
                        let own = usize::from(at.column);
                        let group = usize::from(at.group);
                        Operation::Variable(self.layout.place(at.side, group, own, row))
                    }
                    Array::Parameter(Parameter(at)) => Operation::Number(D::from(
                        self.world.parameters[usize::from(at)][column][row],
                    )),
                    other => panic!("{other:?} has no numbers"),
                }
            }
            Kind::Sum(c, terms) => {
                let mut own = Vec::with_capacity(terms.len());
                for (k, term) in &terms {
                    own.push((number(k), self.node(*term)));
                }
                Operation::Sum(number(&c), own)
            }
            Kind::Product(k, factors) => {
                let mut own = Vec::with_capacity(factors.len());
                for (factor, n) in factors {
                    own.push((self.node(factor), n));
                }
                Operation::Product(number(&k), own)
            }
            Kind::Call(op, x) => Operation::Call(op, self.all(&x)),
            Kind::Reduce(domain, body) => {
                let range = self.model.dag.range(domain).clone();
                let (start, end) = (self.affine(&range.start), self.affine(&range.end));
                let chosen = self.only.iter().find(|(own, _)| *own == domain);
                // A loop inside the same loop binds the variable once more.
                let around = self.known.clone();
                let outer = self.variables.get(&domain).copied();
                let is_free = |(node, _): &(&Node, &usize)| {
                    let mut loops = self.model.dag.variables(**node).members();
                    loops.all(|other| other != domain)
                };
                let known: Map<Node, usize> = around
                    .iter()
                    .filter(is_free)
                    .map(|(node, at)| (*node, *at))
                    .collect();
                self.known.clone_from(&known);
                let mut terms = Vec::new();
                for i in start..end {
                    if chosen.is_none_or(|(_, only)| *only == i) {
                        self.variables.insert(domain, i);
                        terms.push((D::from(1.0), self.node(body)));
                    }
                    // What stands in a loop is another thing in its next iteration.
                    self.known.clone_from(&known);
                }
                self.known = around;
                if let Some(outer) = outer {
                    self.variables.insert(domain, outer);
                }
                Operation::Sum(D::from(0.0), terms)
            }
            Kind::Count(domain) => {
                let range = self.model.dag.range(domain).clone();
                real((self.affine(&range.end) - self.affine(&range.start)).max(0))
            }
            Kind::Compare(relation, a, b) => {
                let (a, b) = (self.node(a), self.node(b));
                Operation::Compare(relation, a, b)
            }
            Kind::Not(a) => Operation::Not(self.node(a)),
            Kind::And(a, b) => Operation::And(self.node(a), self.node(b)),
            Kind::Or(a, b) => Operation::Or(self.node(a), self.node(b)),
            Kind::Select(c, a, b) => {
                let (c, a, b) = (self.node(c), self.node(a), self.node(b));
                Operation::Select(c, a, b)
            }
            other @ (Kind::Coefficient | Kind::External(..) | Kind::StandIn(_)) => {
                panic!("{other:?} is not in the judge's books")
            }
        };
        let at = self.push(operation);
        self.known.insert(node, at);
        at
    }
}
