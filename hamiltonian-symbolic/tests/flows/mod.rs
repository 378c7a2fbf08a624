//! Tests of every exact flow, by its values and tangents in 32 digits.

use crate::common::{self, parse};
use hamiltonian_lanes::{DoubleDouble, Dual, Real};
use hamiltonian_symbolic::dag::{Array, Column, Dependence, Kind, Node, Side};
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::model::ExactFlow;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::program::{Program, Purpose};
use hamiltonian_symbolic::schedule::{Request, prepared, schedule};
use hamiltonian_symbolic::split::exact_flow;

/// A piece, and the form that takes it.
pub struct Case {
    pub signature: &'static str,
    pub parameters: &'static str,
    pub h: &'static str,
    pub form: &'static str,
}

/// The values of nodes of a model, as a program.
pub struct Values(Program);

impl Values {
    pub fn of(model: &Model, nodes: &[Node]) -> Values {
        let request = Request {
            purpose: Purpose::Energy,
            results: nodes.to_vec(),
            stores: Vec::new(),
            cleared: Vec::new(),
            pinned: None,
        };
        let requests = [request];
        let wanted = prepared(&model.dag, &requests);
        let prepared = (&wanted[..], &wanted[..]);
        Values(schedule(&model.dag, &requests, prepared, Vec::new()))
    }
    /// At coordinates and momenta (interleaved), parameters and a step coefficient.
    pub fn at<T: Real>(&self, model: &Model, z: &[T], parameters: &[f64], c: T) -> Vec<T> {
        let mut point = Point::<T>::new();
        point.c = c;
        point.scalars = parameters.iter().map(|x| T::constant(*x, 0.0)).collect();
        for group in 0..model.groups.len() {
            for (side, at) in [(Side::Q, 0), (Side::P, 1)] {
                let array = Array::Phase(Column {
                    side,
                    group: group as u16,
                    column: 0,
                });
                point.arrays.insert(array, vec![vec![z[2 * group + at]]]);
            }
        }
        run(&self.0, &self.0.functions[0], &point).results
    }
}

/// A small generator of numbers.
pub struct Random(pub u64);
impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }
}

/// z₁(c) of a flow and J∇h, as programs.
pub struct Checked {
    pub model: Model,
    pub image: Values,
    pub field: Values,
    pub energy: Values,
    pub forms: Vec<&'static str>,
}

pub fn prepare(signature: &str, parameters: &str, text: &str) -> Option<Checked> {
    let mut model = common::model(signature, "", parameters);
    let h = parse(&mut model, text);
    let found = exact_flow(&mut model, h)?;
    let ExactFlow::Closed(motion, forms) = found else {
        return None;
    };
    let guard = motion.domain.clone();
    let images = motion.images(&mut model.dag);
    let minus = model.dag.integer(-1);
    let nan = model.dag.call(hamiltonian_symbolic::op::Op::Sqrt, &[minus]);
    let mut nodes = Vec::new();
    let gradient = diff::gradient(
        &mut model.dag,
        h,
        Dependence(Dependence::Q.0 | Dependence::P.0),
    );
    let mut field = Vec::new();
    for group in 0..model.groups.len() {
        for side in [Side::Q, Side::P] {
            let leaf = model.scalar(side, group);
            let image = images
                .iter()
                .find(|(l, _)| *l == leaf)
                .map_or(leaf, |(_, i)| *i);
            let image = guard.iter().fold(image, |image, condition| {
                model.dag.select(*condition, image, nan)
            });
            nodes.push(image);
            let other = if side == Side::Q { Side::P } else { Side::Q };
            let conjugate = model.scalar(other, group);
            let zero = model.dag.integer(0);
            let slope = gradient
                .iter()
                .find(|(l, _)| *l == conjugate)
                .map_or(zero, |(_, s)| *s);
            field.push(if side == Side::Q {
                slope
            } else {
                model.dag.neg(slope)
            });
        }
    }
    for node in model.dag.reachable(&nodes) {
        assert!(
            !matches!(model.dag.kind(node), Kind::Scalar(p) if p.0 > 1000),
            "a placeholder is left"
        );
    }
    Some(Checked {
        image: Values::of(&model, &nodes),
        field: Values::of(&model, &field),
        energy: Values::of(&model, &[h]),
        forms,
        model,
    })
}

type D = Dual<DoubleDouble>;

fn size(z: &[DoubleDouble]) -> f64 {
    z.iter().fold(1.0, |m, x| m.max(x.to_f64().abs()))
}

/// Flow equations, start, energy, and the symplectic form at random points, to 1e-22.
pub fn check(case: &Case) {
    let name = case.h;
    let Some(checked) = prepare(case.signature, case.parameters, case.h) else {
        panic!("{name}: no flow");
    };
    assert!(
        checked.forms.contains(&case.form),
        "{name}: {:?}",
        checked.forms
    );
    let Checked {
        model,
        image,
        field,
        energy,
        ..
    } = &checked;
    let n = 2 * model.groups.len();
    let mut random = Random(7);
    let mut alive = 0;
    for trial in 0..24 {
        let z: Vec<f64> = (0..n)
            .map(|_| 2.5 * random.unit() - if trial % 2 == 0 { 0.0 } else { 1.25 })
            .collect();
        let parameters: Vec<f64> = model
            .parameters
            .iter()
            .map(|_| 0.25 + random.unit() - if trial % 4 == 3 { 1.0 } else { 0.0 })
            .collect();
        let c = DoubleDouble::from(1.5 * random.unit() - 0.75);
        let start: Vec<DoubleDouble> = z.iter().map(|x| DoubleDouble::from(*x)).collect();
        let here = energy.at(model, &start, &parameters, c)[0];
        if !here.is_finite() {
            continue;
        }
        let fixed: Vec<D> = start.iter().map(|x| D::fixed(*x)).collect();
        let moved = image.at(model, &fixed, &parameters, D::variable(c));
        if !moved.iter().all(|x| x.re.is_finite()) {
            continue;
        }
        alive += 1;
        let end: Vec<DoubleDouble> = moved.iter().map(|x| x.re).collect();
        let bound = |x: f64| 1e-22 * x;
        // At the start nothing has moved.
        let rest = image.at(model, &start, &parameters, DoubleDouble::from(0.0));
        for (a, b) in rest.iter().zip(&start) {
            assert!(
                (*a - *b).to_f64().abs() <= bound(size(&start)),
                "{name}: moves in no time at {z:?}: {a:?} {b:?}"
            );
        }
        let slopes = field.at(model, &end, &parameters, c);
        for (at, (moved, slope)) in moved.iter().zip(&slopes).enumerate() {
            let difference = (moved.eps - *slope).to_f64().abs();
            assert!(
                difference <= bound(size(&slopes) * size(&end) * size(&end)),
                "{name}: {at} is {} and should be {} at {z:?} {parameters:?} {c:?}",
                moved.eps.to_f64(),
                slope.to_f64()
            );
        }
        let there = energy.at(model, &end, &parameters, c)[0];
        assert!(
            (there - here).to_f64().abs() <= bound(size(&slopes) * size(&end)),
            "{name}: energy {} {}",
            there.to_f64(),
            here.to_f64()
        );
        // The tangent, column by column.
        let columns: Vec<Vec<DoubleDouble>> = (0..n)
            .map(|k| {
                let z: Vec<D> = start
                    .iter()
                    .enumerate()
                    .map(|(i, x)| {
                        if i == k {
                            D::variable(*x)
                        } else {
                            D::fixed(*x)
                        }
                    })
                    .collect();
                image
                    .at(model, &z, &parameters, D::fixed(c))
                    .iter()
                    .map(|x| x.eps)
                    .collect()
            })
            .collect();
        let largest = columns.iter().map(|c| size(c)).fold(1.0, f64::max);
        for i in 0..n {
            for j in 0..n {
                let mut form = DoubleDouble::from(0.0);
                for k in 0..n / 2 {
                    form += columns[i][2 * k] * columns[j][2 * k + 1]
                        - columns[i][2 * k + 1] * columns[j][2 * k];
                }
                let exact = if i / 2 == j / 2 {
                    j as f64 - i as f64
                } else {
                    0.0
                };
                let error = (form.to_f64() - exact).abs();
                assert!(
                    error <= bound(largest * largest).max(1e-15),
                    "{name}: symplectic form {i} {j}: {} at {z:?}",
                    form.to_f64()
                );
            }
        }
        follow(&checked, &z, &parameters, c.to_f64(), &end, name);
    }
    assert!(alive >= 6, "{name}: only {alive} points");
}

/// The orbit itself, by small steps, wherever they tell: a formula that goes on past the orbit's
/// end shows.
fn follow(
    checked: &Checked,
    z: &[f64],
    parameters: &[f64],
    c: f64,
    end: &[DoubleDouble],
    name: &str,
) {
    let fine = steps(checked, z, parameters, c, 400);
    let coarse = steps(checked, z, parameters, c, 200);
    let scale = fine.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    if fine
        .iter()
        .zip(&coarse)
        .any(|(a, b)| (a - b).abs() > 1e-7 * scale || (a - b).is_nan())
    {
        return;
    }
    for (a, b) in fine.iter().zip(end) {
        let difference = (a - b.to_f64()).abs();
        assert!(
            difference <= 1e-6 * scale,
            "{name}: the orbit goes from {z:?} ({parameters:?}) in {c} to {fine:?}, not to {:?}",
            end.iter().map(|x| x.to_f64()).collect::<Vec<_>>()
        );
    }
}

/// Runge and Kutta's steps of fourth order.
fn steps(checked: &Checked, z: &[f64], parameters: &[f64], c: f64, steps: usize) -> Vec<f64> {
    let h = c / steps as f64;
    let field = |z: &[f64]| checked.field.at(&checked.model, z, parameters, 0.0);
    let plus = |z: &[f64], k: &[f64], h: f64| -> Vec<f64> {
        z.iter().zip(k).map(|(z, k)| z + h * k).collect()
    };
    let mut at = z.to_vec();
    for _ in 0..steps {
        let k1 = field(&at);
        let k2 = field(&plus(&at, &k1, h / 2.0));
        let k3 = field(&plus(&at, &k2, h / 2.0));
        let k4 = field(&plus(&at, &k3, h));
        for i in 0..at.len() {
            at[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }
    at
}
