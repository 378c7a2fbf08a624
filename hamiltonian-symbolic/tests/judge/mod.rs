//! An independent judge of flows: every form, every composed flow and every loop against the orbits of its
//! own piece in 32 digits, there and back.
//!
//! Input: definitions. Output: verdicts. Invariant: the orbits come from [`field`] and [`orbit`], which
//! share no code with the search: derivatives, loops and steps are their own.

pub mod field;
mod flows;
mod limits;
mod orbit;
mod random;

use crate::common;
use crate::tree::Random;
use field::{Field, Layout, World, extents};
use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::PI_LOW;
use hamiltonian_symbolic::dag::{Array, Column, Dag, Parameter, Side};
use hamiltonian_symbolic::index::Domain;
use hamiltonian_symbolic::interpret::{Point, run, run_reversed};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::model::{ExactFlow, Piece};
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Program, Purpose, Target};
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::split::{exact_flow, find};

/// A definition, as text.
#[derive(Clone, Debug)]
pub struct Definition {
    pub signature: String,
    pub parameters: String,
    pub h: String,
    /// The size `n` of arrays.
    pub n: usize,
}

/// The verdict on a flow at one point.
#[derive(Clone, PartialEq, Debug)]
pub enum Verdict {
    /// It ends where the orbit does.
    Right,
    /// It is NaN and the orbit is not.
    Missing(String),
    /// There is no orbit, and no flow.
    Nothing,
    /// The flow ends somewhere else.
    Wrong(String),
}

/// The pieces of a definition with their programs.
pub struct Subject {
    pub model: Model,
    program: Program,
    layout: Layout,
    pub n: usize,
}

impl Subject {
    /// The flow of the whole.
    pub fn whole(definition: &Definition) -> Option<Subject> {
        let mut model = definition.model();
        let h = model.h();
        let flow = exact_flow(&mut model, h)?;
        let name = definition.h.clone();
        model.pieces = vec![Piece { h, name, flow }];
        Some(Subject::of(model, definition.n))
    }
    /// The velocity of the whole, which is added to a point.
    fn velocity(definition: &Definition) -> Subject {
        let mut model = definition.model();
        let (h, name) = (model.h(), definition.h.clone());
        let flow = ExactFlow::Linear;
        model.pieces = vec![Piece { h, name, flow }];
        Subject::of(model, definition.n)
    }
    /// The pieces that are found.
    pub fn split(definition: &Definition) -> Option<Subject> {
        let mut model = definition.model();
        model.pieces = find(&mut model).ok()?.pieces;
        Some(Subject::of(model, definition.n))
    }
    fn of(mut model: Model, n: usize) -> Subject {
        let count = model.pieces.len() as u16;
        let wanted: Vec<Purpose> = (0..count).map(Purpose::Piece).collect();
        let program = derive(&mut model, &wanted).expect("there is a program");
        let layout = Layout::of(&model, &[n]);
        Subject {
            model,
            program,
            layout,
            n,
        }
    }

    /// The numbers of a flat point after the flow of a piece.
    fn act<T: Real>(&self, at: usize, world: &World, z: &[T], c: T, is_reversed: bool) -> Vec<T> {
        let step = |z: &[T]| self.step(at, world, z, c, is_reversed);
        if !matches!(self.model.pieces[at].flow, ExactFlow::Exponential) {
            return step(z);
        }
        // The program of a quadratic form makes z + c·(Mz + b), which is exponentiated elsewhere:
        // Δₖ = c·M·Δₖ₋₁/k.
        let less = |a: &[T], b: &[T]| -> Vec<T> { a.iter().zip(b).map(|(a, b)| *a - *b).collect() };
        let plus = |a: &[T], b: &[T]| -> Vec<T> { a.iter().zip(b).map(|(a, b)| *a + *b).collect() };
        let first = less(&step(z), z);
        let (mut end, mut term) = (plus(z, &first), first.clone());
        for k in 2..60 {
            let there = plus(z, &term);
            let grown = less(&less(&step(&there), &there), &first);
            let over = T::constant(f64::from(k), 0.0);
            term = grown.into_iter().map(|x| x / over).collect();
            end = plus(&end, &term);
        }
        end
    }
    /// The numbers that the program of a piece makes.
    fn step<T: Real>(&self, at: usize, world: &World, z: &[T], c: T, is_reversed: bool) -> Vec<T> {
        let number = |x: f64| T::constant(x, 0.0);
        let mut point = Point::<T>::new();
        point.c = c;
        point.t = number(world.t);
        point.sizes.clone_from(&world.sizes);
        for (at, columns) in world.parameters.iter().enumerate() {
            let column = |column: &Vec<f64>| column.iter().map(|x| number(*x)).collect();
            let columns: Vec<Vec<T>> = columns.iter().map(column).collect();
            let first = columns[0].first().copied();
            point.scalars.push(first.unwrap_or(number(0.0)));
            let array = Array::Parameter(Parameter(at as u16));
            point.arrays.insert(array, columns);
        }
        let places = self.places();
        for (target, first, rows) in &places {
            let column = z[*first..first + rows].to_vec();
            point.outputs.insert(*target, vec![column]);
        }
        let function = &self.program.functions[at];
        let outcome = match is_reversed {
            false => run(&self.program, function, &point),
            true => run_reversed(&self.program, function, &point),
        };
        let mut end = z.to_vec();
        for (target, first, rows) in &places {
            end[*first..first + rows].copy_from_slice(&outcome.outputs[target][0]);
        }
        end
    }
    /// The targets of all columns with their first place and rows.
    fn places(&self) -> Vec<(Target, usize, usize)> {
        let mut places = Vec::new();
        for (group, &(_, rows, columns)) in self.layout.groups.iter().enumerate() {
            for side in [Side::Q, Side::P] {
                for column in 0..columns {
                    let first = match rows {
                        0 => 0,
                        _ => self.layout.place(side, group, column, 0),
                    };
                    let at = Column {
                        side,
                        group: group as u16,
                        column: column as u16,
                    };
                    places.push((Target::Phase(at), first, rows));
                }
            }
        }
        places
    }

    /// The fields whose orbits, one after the other, are the flow of a piece.
    fn fields(&self, at: usize, world: &World) -> Vec<Field> {
        let piece = &self.model.pieces[at];
        let ExactFlow::Loop {
            innermost: Some(innermost),
            merges: false,
            ..
        } = &piece.flow
        else {
            return vec![Field::of(&self.model, piece.h, world, &[])];
        };
        let mut chain = vec![*innermost];
        while let Some(parent) = self.model.dag.range(chain[0]).parent {
            chain.insert(0, parent);
        }
        let mut all: Vec<Vec<(Domain, i64)>> = vec![Vec::new()];
        for domain in chain {
            let range = self.model.dag.range(domain);
            let mut longer = Vec::new();
            for known in all {
                let variable = |d: Domain| {
                    let own = known.iter().find(|(domain, _)| *domain == d);
                    own.expect("an outer loop stands before").1
                };
                let size = |s: hamiltonian_symbolic::index::Size| world.sizes[s.0 as usize] as i64;
                let ends = [&range.start, &range.end].map(|end| end.value(&variable, &size));
                for i in ends[0]..ends[1] {
                    longer.push([known.as_slice(), &[(domain, i)]].concat());
                }
            }
            all = longer;
        }
        let of = |only: &Vec<(Domain, i64)>| Field::of(&self.model, piece.h, world, only);
        all.iter().map(of).collect()
    }

    /// A world of random parameters, some of them 0.
    pub fn world(&self, random: &mut Random) -> World {
        let sizes = vec![self.n];
        let parameters = self.model.parameters.iter().map(|parameter| {
            let (rows, columns) = extents(&parameter.shape, &sizes);
            let column = |_| (0..rows).map(|_| number(random, 0.25)).collect();
            (0..columns).map(column).collect()
        });
        World {
            parameters: parameters.collect(),
            sizes,
            t: 0.3,
        }
    }
    /// A random point, some of whose numbers are 0.
    pub fn point(&self, random: &mut Random, zeros: f64) -> Vec<D> {
        let numbers = (0..2 * self.layout.half).map(|_| D::from(number(random, zeros)));
        numbers.collect()
    }

    /// A point many of whose numbers are 0, 1 or a quarter of a turn.
    fn resting(&self, random: &mut Random) -> Vec<D> {
        let quarter = D::constant(std::f64::consts::FRAC_PI_2, PI_LOW / 2.0);
        let numbers = (0..2 * self.layout.half).map(|_| match random.unit() {
            x if x < 0.55 => D::from(0.0),
            x if x < 0.7 => D::from(1.0),
            x if x < 0.85 => quarter,
            _ => D::from(number(random, 0.0)),
        });
        numbers.collect()
    }
    /// Compares the flow of a piece with orbits, there and back.
    pub fn judge(&self, at: usize, world: &World, z: &[D], c: f64) -> Verdict {
        let fields = self.fields(at, world);
        let c = D::from(c);
        let (mut end, mut size) = (z.to_vec(), orbit::largest(z));
        let mut crosses = false;
        let mut is_there = fields.iter().all(|field| field.at(z).0.is_finite());
        for field in &fields {
            if !is_there {
                break;
            }
            match orbit::follow(field, &end, c) {
                Some(next) => {
                    end = next.z;
                    crosses |= next.crosses;
                    size = size.max(next.size);
                }
                None => is_there = false,
            }
        }
        let there = self.act(at, world, z, c, false);
        let is_finite = there.iter().all(|x| x.is_finite());
        let numbers = |z: &[D]| z.iter().map(|x| x.to_f64()).collect::<Vec<f64>>();
        let place = format!(
            "{:?}, {:?}, c = {}",
            numbers(z),
            world.parameters,
            c.to_f64()
        );
        match (is_there, is_finite) {
            (false, false) => return Verdict::Nothing,
            (true, false) => return Verdict::Missing(place),
            // Without an orbit there may be a flow: a field has no value where H has a removable
            // singularity, and the judge's patience ends.
            (false, true) => return Verdict::Nothing,
            (true, true) => {}
        }
        // The condition of the orbit is that of its tangent, seen from a point beside it.
        let bound = 1e-21 * (1.0 + size).powi(4);
        let apart = |a: &[D], b: &[D]| {
            let pairs = a.iter().zip(b);
            pairs.fold(0.0, |m: f64, (a, b)| m.max((*a - *b).to_f64().abs()))
        };
        let off = apart(&there, &end);
        // Past a pole a chart has two names for one point.
        if off > bound && crosses {
            return Verdict::Nothing;
        }
        if off > bound {
            return Verdict::Wrong(format!(
                "piece {at} is off by {off:.1e} at {place}: {:?}, not {:?}",
                numbers(&there),
                numbers(&end)
            ));
        }
        let back = self.act(at, world, &there, -c, true);
        let off = apart(&back, z);
        match off <= bound {
            true => Verdict::Right,
            false => Verdict::Wrong(format!("comes back off by {off:.1e}")),
        }
    }
}

impl Definition {
    pub fn of(signature: &str, parameters: &str, h: &str, n: usize) -> Definition {
        Definition {
            signature: signature.to_owned(),
            parameters: parameters.to_owned(),
            h: h.to_owned(),
            n,
        }
    }
    fn model(&self) -> Model {
        common::system(&self.signature, "n", &self.parameters, &self.h)
    }
}

/// A number of either sign, near 1, or now and then 0.
fn number(random: &mut Random, zero: f64) -> f64 {
    if random.chance(zero) {
        return 0.0;
    }
    let size = 0.2 + 1.3 * random.unit();
    let number = if random.chance(0.5) { size } else { -size };
    // Short numbers, so that a failure can be read.
    (number * 1024.0).round() / 1024.0
}

/// The verdicts on all pieces of a subject at a number of points, some of whose numbers are 0.
pub fn verdicts(subject: &Subject, points: usize, zeros: f64, random: &mut Random) -> Vec<Verdict> {
    let mut all = Vec::new();
    for at in 0..subject.model.pieces.len() {
        for _ in 0..points {
            let world = subject.world(random);
            let z = subject.point(random, zeros);
            let c = number(random, 0.0) / 2.0;
            all.push(subject.judge(at, &world, &z, c));
        }
    }
    all
}

/// What the judge would not see would prove nothing.
#[test]
fn wrong_flows_are_seen() {
    let judged = |h: &str, n: usize, change: &dyn Fn(&mut Model)| {
        let signature = if n > 0 { "q[n]; p[n]" } else { "q; p" };
        let mut model = Definition::of(signature, "", h, n).model();
        let piece = model.h();
        let flow = exact_flow(&mut model, piece).expect("it has a flow");
        let name = h.to_owned();
        model.pieces = vec![Piece {
            h: piece,
            name,
            flow,
        }];
        change(&mut model);
        let mut random = Random(5);
        let all = verdicts(&Subject::of(model, n), 12, 0.0, &mut random);
        all.iter()
            .filter(|v| matches!(v, Verdict::Wrong(_)))
            .count()
    };
    let shears = "sum(i in 1..n) { q[i]*p[i - 1] }";
    assert_eq!(judged(shears, 3, &|_| {}), 0);
    // One flow of terms that do not commute, as c·J∇h and as a loop in any order.
    let linear = |model: &mut Model| model.pieces[0].flow = ExactFlow::Linear;
    assert!(judged(shears, 3, &linear) > 6);
    let merging = |model: &mut Model| {
        if let ExactFlow::Loop { merges, .. } = &mut model.pieces[0].flow {
            *merges = true;
        }
    };
    assert!(judged(shears, 3, &merging) > 6);
    // The flow of one side of a kink.
    let kinked = |model: &mut Model| {
        model.pieces[0].h = common::parse(model, "(1 + q + abs(q))*p");
    };
    assert_eq!(judged("(1 + q)*p", 0, &|_| {}), 0);
    assert!(judged("(1 + q)*p", 0, &kinked) > 6);
    // A part in 10¹⁶ of the time.
    let late = |model: &mut Model| {
        if let ExactFlow::Closed(motion, _) = &mut model.pieces[0].flow {
            let late = model.dag.constant(Rational::new(
                1_000_000_000_000_000_001,
                1_000_000_000_000_000_000,
            ));
            let c = model.dag.coefficient();
            let time = model.dag.mul(&[late, c]);
            for moved in &mut motion.moves {
                let on = |_: &mut Dag, node| (node == c).then_some(time);
                moved.value = model.dag.substitute(moved.value, on);
            }
        }
    };
    assert!(judged("(1 + q)*p", 0, &late) > 6);
}
