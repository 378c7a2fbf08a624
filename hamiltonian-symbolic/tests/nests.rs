//! Systems with sums that stay loops: against dual numbers over the same H added up term by term,
//! and against the same system written out over scalar coordinates; what the loops execute.

mod common;
mod soundness;
mod sums;
mod tape;
mod tree;

use hamiltonian_lanes::{DoubleDouble, Dual, Real};
use hamiltonian_symbolic::dag::{Array, Node, Parameter, Side};
use hamiltonian_symbolic::eval::{Outcome, Point, run};
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::model::{Group, Model, ParameterDeclaration, Shape};
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Program, Purpose, Target};
use std::collections::HashMap;
use std::marker::PhantomData;
use sums::{Numbers, World, read};
use tape::Traced;
use tree::Random;

const ALL: [Purpose; 11] = [
    Purpose::Energy,
    Purpose::GradientQ,
    Purpose::GradientP,
    Purpose::Gradient,
    Purpose::EnergyAndGradient,
    Purpose::TimeDerivative,
    Purpose::ParameterGradient,
    Purpose::HessianVector,
    Purpose::Flow,
    Purpose::Kick,
    Purpose::Drift,
];

/// A system: signature, parameters, H; its number of terms grows like `N^order`.
struct System {
    name: &'static str,
    signature: &'static str,
    parameters: &'static str,
    h: &'static str,
    order: u32,
}

const TODA: System = System {
    name: "Toda ring",
    signature: "q[N]; p[N]",
    parameters: "",
    h: "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }",
    order: 1,
};
const GRAVITY: System = System {
    name: "gravity",
    signature: "q[N][3]; p[N][3]",
    parameters: "G m[N]",
    h: "sum(i in 0..N) { (p[i][0]^2 + p[i][1]^2 + p[i][2]^2)/(2*m[i]) }
        - G*sum(i in 0..N, j in 0..i) { m[i]*m[j]
        / sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2 + (q[i][2] - q[j][2])^2) }",
    order: 2,
};
const SQUARE_ROOT: System = System {
    name: "root of a sum",
    signature: "q[N]; p[N]",
    parameters: "",
    h: "sqrt(1 + sum(i in 0..N) { p[i]^2 }) + sum(i in 0..N) { cos(q[i]) }",
    order: 1,
};

const SYSTEMS: &[System] = &[
    TODA,
    GRAVITY,
    SQUARE_ROOT,
    System {
        name: "open chain",
        signature: "q[N]; p[N]",
        parameters: "k m[N]",
        h: "sum(i in 0..N) { p[i]^2/(2*m[i]) }
            + sum(i in 0..N-1) { k*(q[i + 1] - q[i])^2/2 + (q[i] - q[i + 1])^4/4 }",
        order: 1,
    },
    System {
        name: "FPUT",
        signature: "x[N]; y[N]",
        parameters: "alpha beta",
        h: "sum(i in 0..N) { y[i]^2/2 } + sum(i in 0..N) { (x[(i + 1) % N] - x[i])^2/2
            + alpha*(x[(i + 1) % N] - x[i])^3/3 + beta*(x[(i + 1) % N] - x[i])^4/4 }",
        order: 1,
    },
    System {
        name: "mean field",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N) { cos(q[i]) }^2/(2*N)
            + exp(sum(i in 0..N) { sin(q[i]) }/N)",
        order: 1,
    },
    System {
        name: "loop variables as reals",
        signature: "q[N]; p[N]",
        parameters: "a",
        h: "sum(i in 0..N) { (i + 1)*q[i]^2/2 + p[i]^2/(2 + i*N) + sin(a*i)*q[i] }
            + sum(i in 1..N+1, j in i..N+1) { q[i - 1]/(i + j) }",
        order: 2,
    },
    System {
        name: "inner sums on their own",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2 + sin(q[i])*sum(j in 0..N) { q[j]^2 }
            + exp(q[i]*sum(j in 0..N) { p[j] }/N^2) }",
        order: 2,
    },
    System {
        name: "joint sums",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N, j in 0..N) { cos(q[i] - q[j]) } + sum(i in 0..N, j in i..N) { q[i]*q[j]*p[j] }",
        order: 2,
    },
    System {
        name: "offsets",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { sin(q[(i - 1) % N])*p[(i + 2) % N] } + sum(i in 0..N-2) { q[i]*q[i + 1]*q[i + 2] }
            + sum(i in 1..N) { p[i]*p[i - 1]^2 } + sum(i in 0..N) { q[N - 1 - i]*p[i] }",
        order: 1,
    },
    System {
        name: "constant bodies",
        signature: "q[N]; p[N]",
        parameters: "a",
        h: "sum(i in 0..N) { 3 }*q[0]^2 + sum(i in 0..N, j in 0..i) { 1 }*p[0]^2
            + sum(i in 0..N, j in 0..i) { q[i] } + sum(i in 0..N) { a*q[0] + a^2 } + sum(i in 0..N) { i }*p[0]
            + sum(i in N..N) { q[i] } + sum(i in 3..1) { q[i] }",
        order: 2,
    },
    System {
        name: "matrix",
        signature: "q[N]; p[N]",
        parameters: "M[N][N] V[N][N]",
        h: "sum(i in 0..N) { p[i]*sum(j in 0..N) { M[i][j]*p[j] } }/2
            + sum(i in 0..N, j in 0..N) { cos(q[i])*V[i][j]*q[j] }",
        order: 2,
    },
    System {
        name: "conditions",
        signature: "q[N]; p[N]",
        parameters: "k",
        h: "sum(i in 0..N) { if q[i] > 0 && i > 0 { k*q[i]^1.5 } else { p[i]^2*exp(-q[i]) }
            + abs(q[i] - p[i]) + min(q[i], p[i]^2) }
            + sum(i in 0..N, j in 0..i) { if (q[i] - q[j])^2 < 1 { ln((q[i] - q[j])^2) } else { 0 } }",
        order: 2,
    },
    System {
        name: "mixed shapes and time",
        signature: "q[N], s, r[N][2]; p[N], u, w[N][2]; t",
        parameters: "a",
        h: "u^2/2 + s*sum(i in 0..N) { p[i]^2*exp(-a*t) } + cos(t)*sum(i in 0..N) { q[i]*s }
            + sum(i in 0..N) { r[i][0]*w[i][1] - r[i][1]*w[i][0]/(1 + q[i]^2) }",
        order: 1,
    },
    System {
        name: "functions of inner sums",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { ln(1 + sum(j in 0..N) { (q[i] - q[j])^2 }) + p[i]^2/2 }
            + sum(i in 0..N) { sqrt(1 + sum(j in 0..i) { exp(q[j] - q[i]) }) }",
        order: 2,
    },
    System {
        name: "quotients of sums",
        signature: "q[N]; p[N]",
        parameters: "m[N]",
        h: "sum(i in 0..N) { m[i]*q[i] }^2/sum(i in 0..N) { m[i] } + sum(i in 0..N) { p[i]^2/m[i] }
            /sqrt(sum(i in 0..N) { m[i]^2 }) + sin(sum(i in 0..N) { p[i]*sum(j in 0..i) { m[j] } })",
        order: 2,
    },
    System {
        name: "three indices",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N, j in 0..i, k in 0..j) {
            1/(1 + (q[i] - q[j])^2*(q[j] - q[k])^2) }/N^2",
        order: 3,
    },
    System {
        name: "single elements",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "p[0]^2/2 + cos(q[0] - q[N - 1]) + q[0]*sum(i in 0..N) { sin(q[i] - q[0]) }",
        order: 1,
    },
];

/// One number of the system.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Place {
    Phase(Side, usize, usize, usize),
    Direction(Side, usize, usize, usize),
    /// Number, column, row.
    Parameter(usize, usize, usize),
    Time,
}

/// A system with numbers.
struct Instance {
    model: Model,
    n: usize,
    values: HashMap<Place, f64>,
    coefficient: f64,
    start: f64,
}

fn extents(shape: &Shape, n: usize) -> (usize, usize) {
    let value = |a: &Affine| usize::try_from(a.value(&|_| 0, &|_| n as i64)).unwrap();
    match shape {
        Shape::Scalar => (1, 1),
        Shape::Vector(rows) => (value(rows), 1),
        Shape::Matrix(rows, columns) => (value(rows), value(columns)),
    }
}

impl Instance {
    fn new(system: &System, n: usize) -> Instance {
        let model = common::system(system.signature, "N", system.parameters, system.h);
        let mut random = Random(n as u64);
        let mut instance = Instance {
            n,
            values: HashMap::new(),
            coefficient: 0.3,
            start: 0.7,
            model,
        };
        for place in instance.places() {
            let positive = matches!(place, Place::Parameter(..) | Place::Time);
            let value = random.unit() * 2.0 - if positive { -0.5 } else { 1.0 };
            instance.values.insert(place, value);
        }
        instance
    }

    /// Every number, in order.
    fn places(&self) -> Vec<Place> {
        let mut all = vec![Place::Time];
        for (number, group) in self.model.groups.iter().enumerate() {
            let (rows, columns) = extents(&group.shape, self.n);
            for side in [Side::Q, Side::P] {
                for column in 0..columns {
                    all.extend((0..rows).map(|row| Place::Phase(side, number, column, row)));
                    all.extend((0..rows).map(|row| Place::Direction(side, number, column, row)));
                }
            }
        }
        for (number, parameter) in self.model.parameters.iter().enumerate() {
            let (rows, columns) = extents(&parameter.shape, self.n);
            for column in 0..columns {
                all.extend((0..rows).map(|row| Place::Parameter(number, column, row)));
            }
        }
        all
    }

    /// The columns of one array.
    fn columns<T>(
        &self,
        shape: &Shape,
        place: impl Fn(usize, usize) -> Place,
        lift: &mut impl FnMut(Place, f64) -> T,
    ) -> Vec<Vec<T>> {
        let (rows, columns) = extents(shape, self.n);
        let mut column = |c: usize| {
            (0..rows)
                .map(|row| lift(place(c, row), self.values[&place(c, row)]))
                .collect()
        };
        (0..columns).map(&mut column).collect()
    }

    /// The values by name.
    fn world<T: Copy>(&self, mut lift: impl FnMut(Place, f64) -> T) -> World<T> {
        let mut world = World {
            values: HashMap::new(),
            sizes: HashMap::from([("N".to_owned(), self.n as i64)]),
            loops: Vec::new(),
        };
        for (number, group) in self.model.groups.iter().enumerate() {
            for (side, name) in [(Side::Q, &group.coordinate), (Side::P, &group.momentum)] {
                let place = |column, row| Place::Phase(side, number, column, row);
                let columns = self.columns(&group.shape, place, &mut lift);
                world.values.insert(name.clone(), columns);
            }
        }
        for (number, parameter) in self.model.parameters.iter().enumerate() {
            let place = |column, row| Place::Parameter(number, column, row);
            let columns = self.columns(&parameter.shape, place, &mut lift);
            world.values.insert(parameter.name.clone(), columns);
        }
        let time = lift(Place::Time, self.values[&Place::Time]);
        world.values.insert("t".into(), vec![vec![time]]);
        world
    }

    /// H over a scalar.
    fn evaluate<T: Real>(&self, h: &str, lift: impl FnMut(Place, f64) -> T) -> T {
        self.world(lift)
            .evaluate(&mut Numbers::<T>(PhantomData), &read(h))
    }

    /// The point for the interpreter.
    fn point<T: Real>(&self, mut lift: impl FnMut(Place, f64) -> T) -> Point<T> {
        let mut point = Point::new();
        point.sizes = vec![self.n];
        point.c = lift(Place::Time, self.coefficient);
        point.t = lift(Place::Time, self.values[&Place::Time]);
        let start = lift(Place::Time, self.start);
        for (number, declared) in self.model.groups.iter().enumerate() {
            let (rows, columns) = extents(&declared.shape, self.n);
            let group = number as u16;
            for side in [Side::Q, Side::P] {
                for at in 0..columns {
                    let column = at as u16;
                    let place = |row| Place::Phase(side, number, at, row);
                    let along = |row| Place::Direction(side, number, at, row);
                    let mut read = |place: &dyn Fn(usize) -> Place| {
                        let list = (0..rows).map(|r| lift(place(r), self.values[&place(r)]));
                        vec![list.collect::<Vec<T>>()]
                    };
                    point.arrays.insert(
                        Array::Phase {
                            side,
                            group,
                            column,
                        },
                        read(&place),
                    );
                    point.arrays.insert(
                        Array::Direction {
                            side,
                            group,
                            column,
                        },
                        read(&along),
                    );
                    point.outputs.insert(
                        Target::Phase {
                            side,
                            group,
                            column,
                        },
                        vec![vec![start; rows]],
                    );
                }
            }
        }
        for (number, parameter) in self.model.parameters.iter().enumerate() {
            let place = |column, row| Place::Parameter(number, column, row);
            let columns = self.columns(&parameter.shape, place, &mut lift);
            let (rows, count) = extents(&parameter.shape, self.n);
            point
                .scalars
                .push(columns[0].first().copied().unwrap_or(T::zero()));
            let number = Parameter(number as u16);
            point.arrays.insert(Array::Parameter(number), columns);
            let target = Target::Parameter(number);
            point.outputs.insert(target, vec![vec![start; rows]; count]);
        }
        point
    }

    /// The same system written out over scalars, and where each of its numbers stands here.
    fn written_out(&self, h: &str) -> (Model, Vec<[Place; 2]>, Vec<Place>) {
        let mut model = Model {
            name: "WrittenOut".into(),
            time: Some("t".into()),
            ..Model::default()
        };
        let mut leaves: HashMap<Place, Node> = HashMap::new();
        let (mut pairs, mut parameters) = (Vec::new(), Vec::new());
        for place in self.places() {
            match place {
                Place::Phase(Side::Q, group, column, row) => {
                    let momentum = Place::Phase(Side::P, group, column, row);
                    pairs.push([place, momentum]);
                    let number = model.groups.len();
                    model.groups.push(Group {
                        coordinate: format!("q{number}"),
                        momentum: format!("p{number}"),
                        shape: Shape::Scalar,
                    });
                    leaves.insert(place, model.scalar(Side::Q, number));
                    leaves.insert(momentum, model.scalar(Side::P, number));
                }
                Place::Parameter(..) => {
                    parameters.push(place);
                    let number = model.parameters.len();
                    model.parameters.push(ParameterDeclaration {
                        name: format!("a{number}"),
                        shape: Shape::Scalar,
                    });
                    leaves.insert(place, model.dag.parameter(Parameter(number as u16)));
                }
                Place::Time => {
                    leaves.insert(place, model.dag.time());
                }
                _ => {}
            }
        }
        let mut world = self.world(|place, _| leaves[&place]);
        model.hamiltonian = Some(world.evaluate(&mut model.dag, &read(h)));
        (model, pairs, parameters)
    }
}

/// What a function gave at a place.
fn at<T: Copy>(outcome: &Outcome<T>, place: Place) -> T {
    match place {
        Place::Phase(side, group, column, row) => {
            let (group, column) = (group as u16, column as u16);
            outcome.outputs[&Target::Phase {
                side,
                group,
                column,
            }][0][row]
        }
        Place::Parameter(number, column, row) => {
            outcome.outputs[&Target::Parameter(Parameter(number as u16))][column][row]
        }
        Place::Time | Place::Direction(..) => outcome.results[0],
    }
}

/// Whether a purpose stores at a place.
fn stores(purpose: Purpose, place: Place) -> bool {
    use Purpose::*;
    match place {
        Place::Phase(Side::Q, ..) => matches!(
            purpose,
            GradientQ | Gradient | EnergyAndGradient | HessianVector | Flow | Drift
        ),
        Place::Phase(Side::P, ..) => matches!(
            purpose,
            GradientP | Gradient | EnergyAndGradient | HessianVector | Flow | Kick
        ),
        Place::Parameter(..) => purpose == ParameterGradient,
        Place::Time => purpose == TimeDerivative,
        Place::Direction(..) => false,
    }
}

/// What the oracle says a purpose gives at a place.
struct Oracle<'a> {
    instance: &'a Instance,
    h: &'a str,
    gradient: HashMap<Place, DoubleDouble>,
}

impl Oracle<'_> {
    fn derivative(&mut self, by: Place) -> DoubleDouble {
        if let Some(known) = self.gradient.get(&by) {
            return *known;
        }
        let seeded = |place: Place, x: f64| {
            let x = DoubleDouble::from(x);
            if place == by {
                Dual::variable(x)
            } else {
                Dual::fixed(x)
            }
        };
        let value = self.instance.evaluate(self.h, seeded).eps;
        self.gradient.insert(by, value);
        value
    }

    fn along(&self, by: Place) -> DoubleDouble {
        let seeded = |place: Place, x: f64| {
            let along = match place {
                Place::Phase(side, group, column, row) => {
                    self.instance.values[&Place::Direction(side, group, column, row)]
                }
                _ => 0.0,
            };
            let inner = Dual::new(DoubleDouble::from(x), DoubleDouble::from(along));
            if place == by {
                Dual::variable(inner)
            } else {
                Dual::fixed(inner)
            }
        };
        self.instance.evaluate(self.h, seeded).eps.eps
    }

    fn expected(&mut self, purpose: Purpose, place: Place) -> DoubleDouble {
        let start = DoubleDouble::from(self.instance.start);
        let c = DoubleDouble::from(self.instance.coefficient);
        match (purpose, place) {
            (Purpose::HessianVector, _) => self.along(place),
            (
                Purpose::Flow | Purpose::Kick | Purpose::Drift,
                Place::Phase(side, g, column, row),
            ) => {
                if side == Side::Q {
                    start + c * self.derivative(Place::Phase(Side::P, g, column, row))
                } else {
                    start - c * self.derivative(Place::Phase(Side::Q, g, column, row))
                }
            }
            _ => self.derivative(place),
        }
    }
}

/// Judges one value against the oracle; what the bound says too little about is skipped.
fn judge(what: &str, got: Traced, want: DoubleDouble, skipped: &mut usize) {
    let bound = 8.0 * f64::EPSILON * tape::sensitivity(got);
    let noise = 1e-18 * (1.0 + want.to_f64().abs());
    let error = (DoubleDouble::from(got.value) - want).to_f64().abs();
    if error <= noise {
        return;
    }
    if bound > 1e-3 * want.to_f64().abs() {
        *skipped += 1;
    } else if !(error <= bound + noise) {
        panic!("{what}: {} for {want}, bound {bound:e}", got.value);
    }
}

fn against_duals(system: &System, n: usize) {
    let mut instance = Instance::new(system, n);
    let program = derive(&mut instance.model, &ALL).unwrap();
    soundness::check(&program);
    let mut random = Random(5);
    let few = if n > 7 { 4 } else { 64 };
    let mut oracle = Oracle {
        instance: &instance,
        h: system.h,
        gradient: HashMap::new(),
    };
    let energy = instance.evaluate(system.h, |_, x| DoubleDouble::from(x));
    let places: Vec<Place> = instance.places();
    let (mut judged, mut skipped) = (0, 0);
    // The same few places for all purposes, so that their derivatives are found once.
    let mut chosen: Vec<Place> = places.clone();
    while chosen.len() > 5 * few {
        let out = random.below(chosen.len());
        if chosen[out] != Place::Time {
            chosen.swap_remove(out);
        }
    }
    for function in &program.functions {
        tape::start();
        let outcome = run(&program, function, &instance.point(|_, x| Traced::input(x)));
        let what = |place| format!("{} N={n} {:?} {place:?}", system.name, function.purpose);
        if matches!(
            function.purpose,
            Purpose::Energy | Purpose::EnergyAndGradient
        ) {
            judge(&what(Place::Time), outcome.results[0], energy, &mut skipped);
        }
        for &place in &chosen {
            if stores(function.purpose, place) {
                let want = oracle.expected(function.purpose, place);
                judge(&what(place), at(&outcome, place), want, &mut skipped);
                judged += 1;
            }
        }
    }
    assert!(
        skipped * 20 <= judged + 20,
        "{} N={n}: {skipped} of {judged} skipped",
        system.name
    );
}

fn against_written_out(system: &System, n: usize) {
    let mut instance = Instance::new(system, n);
    let looped = derive(&mut instance.model, &ALL).unwrap();
    let (mut model, pairs, parameters) = instance.written_out(system.h);
    let written = derive(&mut model, &ALL).unwrap();
    let mut point: Point<f64> = Point::new();
    (point.t, point.c) = (instance.values[&Place::Time], instance.coefficient);
    for (number, pair) in pairs.iter().enumerate() {
        for place in *pair {
            let Place::Phase(side, g, c, r) = place else {
                continue;
            };
            let (group, column) = (number as u16, 0);
            let phase = Array::Phase {
                side,
                group,
                column,
            };
            let direction = Array::Direction {
                side,
                group,
                column,
            };
            let along = instance.values[&Place::Direction(side, g, c, r)];
            point
                .arrays
                .insert(phase, vec![vec![instance.values[&place]]]);
            point.arrays.insert(direction, vec![vec![along]]);
            let target = Target::Phase {
                side,
                group,
                column,
            };
            point.outputs.insert(target, vec![vec![instance.start]]);
        }
    }
    for (number, place) in parameters.iter().enumerate() {
        point.scalars.push(instance.values[place]);
        let target = Target::Parameter(Parameter(number as u16));
        point.outputs.insert(target, vec![vec![instance.start]]);
    }
    for (one, other) in looped.functions.iter().zip(&written.functions) {
        let purpose = one.purpose;
        let one = run(&looped, one, &instance.point(|_, x| x));
        let other = run(&written, other, &point);
        let close = |what: Place, a: f64, b: f64| {
            assert!(
                (a - b).abs() <= 1e-10 * (1.0 + a.abs() + b.abs()),
                "{} N={n} {purpose:?} {what:?}: {a} or {b}",
                system.name
            );
        };
        for (a, b) in one.results.iter().zip(&other.results) {
            close(Place::Time, *a, *b);
        }
        let scalar = pairs.iter().enumerate().flat_map(|(number, pair)| {
            pair.map(|place| match place {
                Place::Phase(side, ..) => (place, Place::Phase(side, number, 0, 0)),
                other => (other, other),
            })
        });
        let scalars = parameters
            .iter()
            .enumerate()
            .map(|(number, place)| (*place, Place::Parameter(number, 0, 0)));
        for (place, apart) in scalar.chain(scalars) {
            if stores(purpose, place) {
                close(place, at(&one, place), at(&other, apart));
            }
        }
    }
}

#[test]
fn loops_against_duals() {
    for system in SYSTEMS {
        for n in [1, 2, 3, 7, 64, 200] {
            if n < 200 || system.order < 3 {
                against_duals(system, n);
            }
        }
    }
}

#[test]
fn loops_against_the_system_written_out() {
    for system in SYSTEMS {
        for n in [1usize, 2, 3, 7, 64, 200] {
            if n.pow(system.order) <= 350 {
                against_written_out(system, n);
            }
        }
    }
}

/// Another H in the oracle's hands is found out.
#[test]
fn a_wrong_index_is_found() {
    let mut instance = Instance::new(&TODA, 7);
    let program = derive(&mut instance.model, &[Purpose::GradientQ]).unwrap();
    let mut oracle = Oracle {
        instance: &instance,
        h: "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 2) % N]) }",
        gradient: HashMap::new(),
    };
    tape::start();
    let point = instance.point(|_, x| Traced::input(x));
    let outcome = run(&program, &program.functions[0], &point);
    let place = Place::Phase(Side::Q, 0, 0, 3);
    let want = oracle.expected(Purpose::GradientQ, place);
    let judged = std::panic::catch_unwind(|| judge("control", at(&outcome, place), want, &mut 0));
    assert!(judged.is_err());
}

/// A program, run once on the tape.
fn traced(system: &System, n: usize, purpose: Purpose) -> Program {
    let mut instance = Instance::new(system, n);
    let program = derive(&mut instance.model, &[purpose]).unwrap();
    tape::start();
    let point = instance.point(|_, x| Traced::input(x));
    let _ = run(&program, &program.functions[0], &point);
    program
}

/// The nesting of the loops of a program's evaluation: `[(…)]` for each loop.
fn nests(program: &Program) -> String {
    fn write(steps: &[hamiltonian_symbolic::program::Step], out: &mut String) {
        for step in steps {
            if let hamiltonian_symbolic::program::Step::Loop(l) = step {
                out.push('(');
                write(&l.body, out);
                out.push(')');
            }
        }
    }
    let mut out = String::new();
    write(&program.functions[0].evaluation, &mut out);
    out
}

#[test]
fn one_exponential_for_each_bond() {
    for n in [1, 8, 200] {
        for purpose in [
            Purpose::EnergyAndGradient,
            Purpose::HessianVector,
            Purpose::Flow,
        ] {
            let program = traced(&TODA, n, purpose);
            assert_eq!(tape::count("exp"), n, "{purpose:?}");
            assert_eq!(nests(&program), "()", "{purpose:?}");
        }
        let program = traced(&TODA, n, Purpose::Drift);
        assert_eq!(tape::count("exp"), 0);
        assert_eq!(tape::count("*") + tape::count("+"), 2 * n);
        assert_eq!(nests(&program), "()");
    }
}

#[test]
fn every_pair_is_visited_once() {
    let n = 7;
    let pairs = n * (n - 1) / 2;
    for purpose in [Purpose::EnergyAndGradient, Purpose::Kick] {
        let program = traced(&GRAVITY, n, purpose);
        assert_eq!(tape::count("sqrt"), pairs, "{purpose:?}");
        let kinetic = if purpose == Purpose::Kick { 0 } else { n };
        assert_eq!(tape::count("/"), pairs + kinetic, "{purpose:?}");
        assert_eq!(nests(&program), "(())", "{purpose:?}");
        // Both bodies feel the force of one computation: about two dozen operations a pair.
        let work = tape::count("*") + tape::count("+") + tape::count("-");
        println!(
            "{purpose:?}: {} operations a pair",
            work as f64 / pairs as f64
        );
        assert!(work <= 28 * pairs, "{purpose:?}: {work}");
    }
    traced(&GRAVITY, n, Purpose::HessianVector);
    assert_eq!(tape::count("sqrt"), pairs);
}

#[test]
fn a_second_nest_only_where_a_finished_sum_is_needed() {
    let program = traced(&SQUARE_ROOT, 10, Purpose::EnergyAndGradient);
    assert_eq!(nests(&program), "()()");
    assert_eq!(tape::count("sqrt") + tape::count("/"), 2);
    let loops = soundness::loops(&program.functions[0].evaluation);
    assert_eq!(
        loops[1].body.len(),
        3,
        "load, product, store: {:?}",
        loops[1]
    );
    // The gradient by q alone needs no sum at all.
    let program = traced(&SQUARE_ROOT, 10, Purpose::GradientQ);
    assert_eq!(nests(&program), "()");
    assert_eq!(tape::count("sqrt"), 0);
}

#[test]
fn what_does_not_depend_on_a_loop_stands_outside() {
    let shape = |h: &'static str, parameters: &'static str, purpose: Purpose| {
        let system = System {
            name: "",
            signature: "q[N]; p[N]",
            parameters,
            h,
            order: 1,
        };
        nests(&traced(&system, 10, purpose))
    };
    use Purpose::{Energy, EnergyAndGradient, GradientQ};
    // Sums over one range share one nest; inner sums that stand on their own move out.
    let two = "sum(i in 0..N) { p[i]^2 } + sum(j in 0..N) { cos(q[j]) }";
    assert_eq!(shape(two, "", EnergyAndGradient), "()");
    let inner = "sum(i in 0..N) { sin(q[i])*sum(j in 0..N) { q[j]^2 } }";
    assert_eq!(shape(inner, "", Energy), "()");
    let inner = "sum(i in 0..N) { exp(q[i]*sum(j in 0..N) { q[j]^2 }) }";
    assert_eq!(shape(inner, "", Energy), "()()");
    // A body that does not depend on the loop is a product with its length.
    assert_eq!(
        shape("sum(i in 0..N) { 3 }*q[0]", "", EnergyAndGradient),
        ""
    );
    assert_eq!(
        shape("sum(i in 0..N, j in 0..i) { q[i] }", "", Energy),
        "()"
    );
    // Factors are taken out of the loop.
    shape("sum(i in 0..N) { a*b*q[i]*q[0] }", "a b", Energy);
    assert_eq!(tape::count("*"), 3);
    // What depends on the outer loop alone is computed there.
    shape(
        "sum(i in 0..N, j in 0..i) { cos(exp(q[i])*q[j]) }",
        "",
        Energy,
    );
    assert_eq!(tape::count("exp"), 10);
    assert_eq!(tape::count("cos"), 45);
    shape(
        "sum(i in 0..N, j in 0..i) { cos(exp(q[i])*q[j]) }",
        "",
        GradientQ,
    );
    assert_eq!(tape::count("exp"), 10);
    assert_eq!(tape::count("sin"), 45);
    // Sums of parameters are prepared.
    shape(
        "p[0]^2*sum(i in 0..N) { m[i]*sqrt(m[i]) }",
        "m[N]",
        GradientQ,
    );
    assert_eq!(tape::count("sqrt"), 0);
    let mut model = common::system(
        "q[N]; p[N]",
        "N",
        "m[N]",
        "p[0]^2*sum(i in 0..N) { m[i]^3 }",
    );
    let program = derive(&mut model, &[Energy]).unwrap();
    assert_eq!(soundness::loops(&program.prepare).len(), 1);
    assert_eq!(soundness::loops(&program.functions[0].evaluation).len(), 0);
}

#[test]
fn the_program_does_not_grow_with_n() {
    for system in SYSTEMS {
        let derived = |n| derive(&mut Instance::new(system, n).model, &ALL).unwrap();
        assert_eq!(derived(8), derived(10_000 / 8usize.pow(system.order)));
    }
}
