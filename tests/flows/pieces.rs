//! Tests that every exact flow passes as it is emitted.

use crate::common::geometry::{defect, one_point};
use crate::symbolic as text;
use hamiltonian::VectorOf;
use hamiltonian::{
    DoubleDouble, Dual, Real, Split, System, Vector,
    schemes::author::{Flow, Piece, Point, Scratch},
};
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::interpret::{self, run};
use hamiltonian_symbolic::model::{Group, Model, Shape};
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Program, Purpose, Target};

/// A system as text, and where its points are taken.
pub struct Case<'a> {
    /// Coordinates and momenta; sizes are called N or n.
    pub signature: &'a str,
    pub parameters: &'a [(&'a str, &'a [f64])],
    /// Of coordinates, then of momenta.
    pub ranges: &'a [(f64, f64)],
}

/// Pieces by number.
pub trait Each<T: Real, P, V> {
    /// The flow of a piece for the duration `c`.
    fn apply(&self, number: usize, prepared: &P, c: T, point: &mut V);
}

macro_rules! each {
    ($($piece:ident $at:tt),+) => {
        impl<T: Real, P, V: Vector<Scalar = T>, $($piece: Piece<T, P, Point = V>),+> Each<T, P, V>
            for ($($piece,)+)
        {
            fn apply(&self, number: usize, prepared: &P, c: T, point: &mut V) {
                match number {
                    $($at => {
                        let flow = self.$at.flow(prepared, c);
                        flow.apply(T::zero(), point, &mut Scratch::like(point));
                    })+
                    _ => unreachable!("there are no more"),
                }
            }
        }
    };
}
each!(A 0);
each!(A 0, B 1);
each!(A 0, B 1, C 2);
each!(A 0, B 1, C 2, D 3);

/// The point of a system with these numbers, coordinates first.
pub fn point<T: Real, S: System>(system: &S, z: &[T]) -> Point<VectorOf<S, T>> {
    let (mut q, mut p) = (system.zeros(), system.zeros());
    for at in 0..q.len() {
        *q.component_mut(at) = z[at];
        *p.component_mut(at) = z[z.len() / 2 + at];
    }
    Point { q, p }
}

pub fn flat<V: Vector>(point: &Point<V>) -> Vec<V::Scalar> {
    point.q.components().chain(point.p.components()).collect()
}

/// A piece of H and J∇ of it, from its text.
struct Equations {
    model: Model,
    program: Program,
    parameters: Vec<Vec<f64>>,
}

impl Equations {
    fn of(case: &Case, text: &str) -> Equations {
        let names: Vec<&str> = case.parameters.iter().map(|(name, _)| *name).collect();
        let mut model = text::model(case.signature, "N n", &names.join(" "));
        for (parameter, (_, values)) in model.parameters.iter_mut().zip(case.parameters) {
            if values.len() > 1 {
                let rows = hamiltonian_symbolic::index::Affine::constant(values.len() as i64);
                parameter.shape = Shape::Vector(rows);
            }
        }
        let is_literal = |group: &Group| matches!(group.shape.literal(), Some((1.., 1)));
        assert!(model.groups.iter().all(is_literal));
        let h = text::parse(&mut model, text);
        model.hamiltonian = Some(h);
        let wanted = [Purpose::VectorField, Purpose::Energy];
        let program = derive(&mut model, &wanted).expect("a program");
        let values = case.parameters.iter().map(|(_, values)| values.to_vec());
        Equations {
            parameters: values.collect(),
            program,
            model,
        }
    }
    fn at(&self, z: &[DoubleDouble], purpose: Purpose) -> interpret::Outcome<DoubleDouble> {
        let mut point = interpret::Point::new();
        let n = z.len() / 2;
        let rows = |group: &Group| match &group.shape {
            Shape::Vector(rows) => rows.as_constant().expect("a number") as usize,
            _ => 1,
        };
        point.sizes = vec![rows(&self.model.groups[0]); 2];
        let exact = |values: &[f64]| values.iter().copied().map(DoubleDouble::from).collect();
        for (number, values) in self.parameters.iter().enumerate() {
            point.scalars.push(DoubleDouble::from(values[0]));
            let array = Array::Parameter(Parameter(number as u16));
            point.arrays.insert(array, vec![exact(values)]);
        }
        for (side, numbers) in [(Side::Q, &z[..n]), (Side::P, &z[n..])] {
            let mut left = numbers.iter().copied();
            for (group, declared) in self.model.groups.iter().enumerate() {
                let rows = rows(declared);
                let column = Column::first(side, group as u16);
                let values: Vec<_> = left.by_ref().take(rows).collect();
                let nothing = vec![DoubleDouble::zero(); rows];
                point.arrays.insert(Array::Phase(column), vec![values]);
                point.outputs.insert(Target::Phase(column), vec![nothing]);
            }
        }
        let function = self.program.function(purpose).expect("it was asked for");
        run(&self.program, function, &point)
    }
    fn energy(&self, z: &[f64]) -> f64 {
        let z: Vec<_> = z.iter().copied().map(DoubleDouble::from).collect();
        self.at(&z, Purpose::Energy).results[0].to_f64()
    }
    fn field(&self, z: &[DoubleDouble]) -> Vec<DoubleDouble> {
        let outputs = self.at(z, Purpose::VectorField).outputs;
        let mut all = Vec::with_capacity(z.len());
        for side in [Side::Q, Side::P] {
            for group in 0..self.model.groups.len() {
                let target = Target::Phase(Column::first(side, group as u16));
                all.extend(&outputs[&target][0]);
            }
        }
        all
    }

    /// The point of the orbit from z after c: extrapolated midpoint steps; `None` where it does not get
    /// there.
    fn orbit(&self, z: &[f64], c: f64) -> Option<Vec<f64>> {
        const ROWS: usize = 9;
        const TOLERANCE: f64 = 1e-20;
        let whole = DoubleDouble::from(c);
        let mut z: Vec<DoubleDouble> = z.iter().copied().map(DoubleDouble::from).collect();
        let (mut t, mut size) = (DoubleDouble::zero(), c / 2.0);
        for _ in 0..400 {
            let left = whole - t;
            let is_last = size.abs() >= left.to_f64().abs();
            let big = if is_last {
                left
            } else {
                DoubleDouble::from(size)
            };
            let mut rows: Vec<Vec<DoubleDouble>> = Vec::new();
            let mut error = f64::INFINITY;
            for row in 0..ROWS {
                let n = 2 * (row + 1);
                let mut new = self.midpoint(&z, big, n);
                let mut next_rows = Vec::new();
                for (column, old) in rows.iter().enumerate() {
                    let before = DoubleDouble::from(2.0 * (row - column) as f64);
                    let ratio = DoubleDouble::from(n as f64) / before;
                    let factor = DoubleDouble::one() / (ratio * ratio - DoubleDouble::one());
                    let next = new.iter().zip(old).map(|(a, b)| *a + factor * (*a - *b));
                    let next: Vec<_> = next.collect();
                    error = largest(&next, &new);
                    next_rows.push(new);
                    new = next;
                }
                next_rows.push(new);
                rows = next_rows;
            }
            if !error.is_finite() || error > 1.0 {
                size = big.to_f64() / 4.0;
            } else {
                let factor = 0.8 * (TOLERANCE / error).powf(1.0 / (2 * ROWS - 1) as f64);
                size = big.to_f64() * factor.clamp(0.1, 4.0);
                if error <= TOLERANCE {
                    z = rows.pop().expect("there is a row");
                    t += big;
                    if is_last {
                        return Some(z.iter().map(|x| x.to_f64()).collect());
                    }
                }
            }
            if size.abs() < 1e-6 * c.abs() || z.iter().any(|x| x.to_f64().abs() > 1e6) {
                return None;
            }
        }
        None
    }
    fn midpoint(&self, start: &[DoubleDouble], big: DoubleDouble, n: usize) -> Vec<DoubleDouble> {
        let h = big / DoubleDouble::from(n as f64);
        let along = |z: &[DoubleDouble], h: DoubleDouble, slope: &[DoubleDouble]| {
            let moved = z.iter().zip(slope).map(|(z, f)| *z + h * *f);
            moved.collect::<Vec<_>>()
        };
        let mut before = start.to_vec();
        let mut now = along(start, h, &self.field(start));
        for _ in 1..n {
            let next = along(&before, h + h, &self.field(&now));
            before = std::mem::replace(&mut now, next);
        }
        now
    }
}

fn largest(a: &[DoubleDouble], b: &[DoubleDouble]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (*a - *b).to_f64().abs());
    differences.fold(0.0, |m, x| if x.is_nan() { x } else { m.max(x) })
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// Flow equations, group law, energy and the symplectic form of every piece of H.
///
/// Bounds are multiples of 1 + ‖M‖, M the tangent by duals.
pub fn check<S>(system: &S, case: &Case)
where
    S: Split,
    <S as Split>::Pieces<f64>: Each<f64, <S as System>::Prepared<f64>, Point<VectorOf<S>>>,
    <S as Split>::Pieces<Dual<f64>>:
        Each<Dual<f64>, <S as System>::Prepared<Dual<f64>>, Point<VectorOf<S, Dual<f64>>>>,
{
    const POINTS: usize = 24;
    const BOUND: f64 = 1e-13;
    // H of a piece is constant to rounding.
    const BOUNDS: [f64; 4] = [BOUND, BOUND, 0.1 * BOUND, BOUND];
    let prepared = System::prepare::<f64>(system);
    let dual = System::prepare::<Dual<f64>>(system);
    let act = |number: usize, c: f64, z: &[f64]| {
        let mut point = point::<f64, S>(system, z);
        <S as Split>::pieces::<f64>().apply(number, &prepared, c, &mut point);
        flat(&point)
    };
    let n = case.ranges.len();
    let mut random = crate::common::derivatives::numbers(41);
    let mut unit = move || {
        // Three quarters of a line, without its middle.
        let x = random.next().expect("there is no end");
        0.5 + (x.abs() - 0.25) * x.signum()
    };
    let mut report = Vec::new();
    for (number, name) in system.description().piece_names().iter().enumerate() {
        let equations = Equations::of(case, name);
        let (mut alive, mut worst, mut later) = (0, [0.0_f64; 4], 0.0_f64);
        for trial in 0..POINTS {
            let z: Vec<f64> = case
                .ranges
                .iter()
                .map(|(a, b)| a + (b - a) * unit())
                .collect();
            let c = (0.1 + 2.0 * unit()) * if trial % 2 == 0 { 1.0 } else { -1.0 };
            let end = act(number, c, &z);
            let Some(there) = equations.orbit(&z, c) else {
                // Without an orbit there is no flow: a formula may go on past the end.
                if let Some(x) = end.iter().find(|x| x.is_finite() && x.abs() < 1e3) {
                    assert!(
                        end.iter().any(|x| !x.is_finite()),
                        "{name}: {x} past the end of {z:?} in {c}"
                    );
                }
                continue;
            };
            assert!(
                end.iter().all(|x| x.is_finite()),
                "{name}: {end:?} is {there:?} from {z:?} in {c}"
            );
            alive += 1;
            let columns: Vec<Vec<f64>> = (0..n)
                .map(|k| {
                    let mut seeded: Vec<_> = z.iter().map(|x| Dual::fixed(*x)).collect();
                    seeded[k].eps = 1.0;
                    let mut point = point::<Dual<f64>, S>(system, &seeded);
                    let c = Dual::fixed(c);
                    <S as Split>::pieces::<Dual<f64>>().apply(number, &dual, c, &mut point);
                    flat(&point).iter().map(|x| x.eps).collect()
                })
                .collect();
            let (off, square) = defect(&columns, one_point(n / 2));
            let size = 1.0 + square.sqrt();
            let first = 0.3 * c;
            let twice = act(number, c - first, &act(number, first, &z));
            let slopes: Vec<_> = z.iter().copied().map(DoubleDouble::from).collect();
            let slopes = equations.field(&slopes);
            let slope = slopes.iter().fold(1.0, |m: f64, x| m.max(x.to_f64().abs()));
            let found = [
                difference(&end, &there) / size,
                difference(&end, &twice) / size,
                (equations.energy(&end) - equations.energy(&z)).abs() / (size * slope),
                off / square.max(1.0),
            ];
            for (worst, found) in worst.iter_mut().zip(found) {
                assert!(!found.is_nan(), "{name} at {z:?} in {c}: {found}");
                *worst = worst.max(found);
            }
            let late = act(number, c * (1.0 + 1e-9), &z);
            later = later.max(difference(&late, &there) / size);
            if found.iter().zip(BOUNDS).any(|(x, bound)| *x > bound) {
                report.push(format!("{name} at {z:?} in {c}: {found:?}, {size}"));
            }
        }
        println!("{name}: {alive} alive, flow, group, energy, form: {worst:?}");
        assert!(alive >= POINTS / 3, "{name}: only {alive} points");
        // A flow a billionth too long would not pass.
        assert!(later > BOUND, "{name}: {later:e}");
    }
    assert!(report.is_empty(), "{report:#?}");
}
