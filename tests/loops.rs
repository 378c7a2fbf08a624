//! Loops in lanes: the bits of iterations one by one, on every level, at every length, and of the
//! interpreter.

use crate::arrays;
use crate::common::bits::{LEVEL, check};
use crate::common::derivatives::numbers;
use crate::common::levels;
use crate::symbolic;
use hamiltonian::Vector;
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::{Dynamics, VectorField};
use hamiltonian_lanes::Cpu;
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::interpret;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Purpose, Target};
use hamiltonian_symbolic::structure;
use std::sync::PoisonError;

hamiltonian! {
    /// Neighbours at several distances, forwards and backwards.
    pub struct Ring { n: usize, k: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n]) }
        + sum(i in 0..n) { k[i]*cos(q[(i - 2) % n] - q[i])/4 + q[i]^2*q[(i + 5) % n]*(i + 1)/100 }
}

hamiltonian! {
    /// Open ends, second neighbours, and a condition.
    pub struct Open { n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n - 2) { (q[i + 2] - q[i])^4/4 }
        + sum(i in 1..n) { if q[i] < q[i - 1] { (q[i] - q[i - 1])^2/2 } else { sin(q[i])*q[i - 1] } }
}

hamiltonian! {
    /// Pairs of points of a plane, each after the other and all with all.
    pub struct Pairs { n: usize, G = 0.5, m: [n] }
    H(q[n][2]; p[n][2]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in i + 1..n) { m[i]*m[j]/sqrt(norm_squared(q[i] - q[j]) + 1/10) }
        + sum(i in 0..n, j in 0..n) { sin(q[i][0] - q[j][1])/100 }
}

hamiltonian! {
    /// Stores in a column that lie further apart than is settled at once, and sums inside functions.
    pub struct Far { n: usize }
    H(q[n]; p[n]) = sqrt(1 + sum(i in 0..n) { p[i]^2 }) + sum(i in 0..n) { q[i]*q[(i + 40) % n]^2 }
        + sum(i in 0..n) { q[i]*q[(n - 1 - i) % n]^2*p[(2*i + 1) % n] }/10
}

hamiltonian! {
    /// Parameters with three axes: neighbours of each.
    pub struct Weighed { n: usize, w: [n][2][n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..2, k in 0..n) {
        w[i][j][k]*q[i]*q[k] + w[(i + 1) % n][1 - j][(k - 2) % n]*cos(q[k])
    }
}

hamiltonian! {
    /// Bodies on orbits of their own, which disturb their neighbours, and sites that swing.
    pub struct Orbits { n: usize, k: [n] }
    H(q[n][2], x[n]; p[n][2], y[n]) = sum(i in 0..n) {
            norm_squared(p[i])/2 - k[i]/norm(q[i]) + (y[i]^2 + k[i]*x[i]^2)/2
        } + sum(i in 0..n) { q[i][0]*x[(i + 1) % n]/100 };
    split {
        Round = sum(i in 0..n) { norm_squared(p[i])/2 - k[i]/norm(q[i]) };
        Swing = sum(i in 0..n) { (y[i]^2 + k[i]*x[i]^2)/2 };
        Disturb = sum(i in 0..n) { q[i][0]*x[(i + 1) % n]/100 };
    }
}

/// The energy, and whether one run of one step ends, without points.
fn of_nothing<S: System>(system: &S) -> f64
where
    Gauss<2>: Scheme<S>,
{
    let (q, p) = (system.zeros(), system.zeros());
    let start = State { t: 0.0, q, p };
    let mut run = Integrator::new(system, Gauss::<2>::default(), start.clone(), 0.1).unwrap();
    run.advance(1).unwrap();
    system.energy(&start)
}

#[test]
fn loops_without_iterations_reach_nothing() {
    assert_eq!(of_nothing(&Ring::new(0, Vec::<f64>::new()).unwrap()), 0.0);
    assert_eq!(of_nothing(&Open::new(0).unwrap()), 0.0);
    assert_eq!(of_nothing(&Pairs::new(0, Vec::<f64>::new()).unwrap()), 0.0);
    assert_eq!(of_nothing(&Far::new(0).unwrap()), 1.0);
}

/// The lengths of loops: all tails, of cheap iterations as well, which go through lanes from 96 on, and blocks with
/// and without a rest.
fn lengths() -> impl Iterator<Item = usize> {
    (1..=40)
        .chain(63..=65)
        .chain(95..=104)
        .chain([127, 128, 129, 136, 200, 257, 300])
}

fn some(n: usize) -> Vec<f64> {
    numbers(7).map(f64::abs).take(n).collect()
}

#[test]
fn lanes_have_the_bits_of_iterations_one_by_one() {
    for n in lengths() {
        let seed = n as u64;
        check(&Ring::new(n, some(n)).unwrap(), seed);
        check(&Pairs::new(n, some(n)).unwrap(), seed);
        check(&arrays::Gravity::new(n, some(n)).unwrap(), seed);
        check(&arrays::Fput::new(n).unwrap(), seed);
        check(&Far::new(n).unwrap(), seed);
        if n > 2 {
            check(&Open::new(n).unwrap(), seed);
        }
    }
    check(&arrays::Chain::<64> {}, 1);
    check(&arrays::Wraps::<67> { a: 0.5 }, 2);
    check(&arrays::Walls::<100> { k: 3.0 }, 3);
}

/// The numbers of a run of exact flows.
fn orbits(n: usize, lanes: bool, fused: bool) -> Vec<u64> {
    let system = Orbits::new(n, some(n)).unwrap();
    let mut start = State::new(system.zeros(), system.zeros());
    for (i, (a, b)) in numbers(5).zip(numbers(6)).take(n).enumerate() {
        start.q.q[(i, 0)] = 1.0 + a.abs();
        start.q.x[i] = b;
        start.p.q[(i, 1)] = 0.5 + b.abs();
        start.p.x[i] = a;
    }
    let run = Integrator::new(&system, Strang, start, 0.1).unwrap();
    let mut run = run.with_lanes(lanes);
    if fused {
        run = run.fused();
    }
    let end = run.advance(3).unwrap();
    let all = end.q.components().chain(end.p.components());
    all.map(f64::to_bits).collect()
}

#[test]
fn flows_in_lanes_have_the_bits_of_flows_one_by_one() {
    for n in lengths() {
        let expected = orbits(n, false, false);
        let _hidden = LEVEL.write().unwrap_or_else(PoisonError::into_inner);
        for limit in levels() {
            Cpu::limit_to(limit);
            let found = orbits(n, true, false);
            Cpu::limit_to(Cpu::Avx512);
            assert_eq!(found, expected, "{limit:?}, {n} bodies");
        }
    }
    // Products fuse in lanes alone: eight bodies are in them, seven are not.
    if Cpu::best() > Cpu::Sse2 {
        assert_eq!(orbits(7, true, true), orbits(7, true, false));
        assert_ne!(orbits(8, true, true), orbits(8, true, false));
    }
}

#[test]
fn long_sums_are_eight_partial_sums_and_a_tree() {
    let n = 100;
    let q: Vec<f64> = numbers(3).take(n).collect();
    let fput = arrays::Fput::new(n).unwrap();
    let at = State::new(vec![0.0; n], q.clone());
    let mut parts = [0.0; 8];
    let mut one_by_one = 0.0;
    for (k, x) in q.iter().enumerate() {
        parts[k % 8] += x * x;
        one_by_one += x * x;
    }
    let [a, b, c, d, e, f, g, h] = parts;
    let tree = ((a + e) + (c + g)) + ((b + f) + (d + h));
    assert_eq!(fput.energy(&at), 0.5 * tree);
    // The test tells the two apart.
    assert_ne!(tree, one_by_one);
}

/// A system as the macro reads it and as the tests' reader does: its outputs are equal to the bit.
#[track_caller]
fn interpreted<S>(system: &S, n: usize, [signature, parameters, h]: [&str; 3], arrays: &[Vec<f64>])
where
    S: System<Shape = hamiltonian::private::DVector<()>>,
{
    let mut model = symbolic::system(signature, "n", parameters, h);
    let structure = structure::analyse(&mut model);
    assert!(structure.separable.is_ok());
    let program = derive(&mut model, &symbolic::PURPOSES).expect("a program");
    let mut some = numbers(n as u64);
    let [q, p, vq, vp] = [(); 4].map(|()| some.by_ref().take(n).collect::<Vec<f64>>());
    let mut point = interpret::Point::<f64>::new();
    point.sizes = vec![n];
    point.scalars = vec![0.0; arrays.len()];
    for (number, values) in arrays.iter().enumerate() {
        let parameter = Array::Parameter(Parameter(number as u16));
        point.arrays.insert(parameter, vec![values.clone()]);
    }
    for (side, [at, direction]) in [(Side::Q, [&q, &vq]), (Side::P, [&p, &vp])] {
        let column = Column::first(side, 0);
        point.arrays.insert(Array::Phase(column), vec![at.clone()]);
        point
            .arrays
            .insert(Array::Direction(column), vec![direction.clone()]);
        point
            .outputs
            .insert(Target::Phase(column), vec![vec![0.0; n]]);
    }
    let outcome = |purpose| {
        let function = program.function(purpose).expect("it was asked for");
        interpret::run(&program, function, &point)
    };
    let column = |outcome: &interpret::Outcome<f64>, side| {
        outcome.outputs[&Target::Phase(Column::first(side, 0))][0].clone()
    };
    let prepared = system.prepare();
    let [q, p, vq, vp] = [q, p, vq, vp].map(hamiltonian::private::DVector::from);
    let (mut a, mut b) = (system.zeros(), system.zeros());
    let energy = prepared.energy_and_gradient(0.0, &q, &p, &mut a, &mut b);
    let expected = outcome(Purpose::EnergyAndGradient);
    assert_eq!(expected.results, [energy], "energy, n = {n}");
    assert_eq!(expected.results, outcome(Purpose::Energy).results);
    assert_eq!(
        column(&expected, Side::Q),
        a.as_slice(),
        "gradient, n = {n}"
    );
    assert_eq!(
        column(&expected, Side::P),
        b.as_slice(),
        "gradient, n = {n}"
    );
    prepared.hessian_vector(0.0, &q, &p, &vq, &vp, &mut a, &mut b);
    // Emitted code has the derivatives of the gradient in place of this function.
    let expected = outcome(Purpose::HessianVector);
    for (side, found) in [(Side::Q, &a), (Side::P, &b)] {
        let expected = column(&expected, side);
        let size = expected.iter().fold(0.0, |most, x| x.abs().max(most));
        for (expected, found) in expected.iter().zip(found) {
            let error = (expected - found).abs();
            assert!(
                error <= 32.0 * f64::EPSILON * size,
                "Hessian, n = {n}: {error:e} of {size}"
            );
        }
    }
    (a, b) = (system.zeros(), system.zeros());
    prepared.field(1.0).add(0.0, &q, &p, &mut a, &mut b);
    let expected = outcome(Purpose::VectorField);
    assert_eq!(column(&expected, Side::Q), a.as_slice(), "field, n = {n}");
    assert_eq!(column(&expected, Side::P), b.as_slice(), "field, n = {n}");
}

#[test]
fn the_interpreter_sums_in_the_same_order() {
    for n in lengths().filter(|n| *n > 2) {
        let ring = [
            "q[n]; p[n]",
            "k[n]",
            "sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n]) } \
             + sum(i in 0..n) { k[i]*cos(q[(i - 2) % n] - q[i])/4 + q[i]^2*q[(i + 5) % n]*(i + 1)/100 }",
        ];
        interpreted(&Ring::new(n, some(n)).unwrap(), n, ring, &[some(n)]);
    }
    for n in [1, 2, 7, 32, 37] {
        let weighed = [
            "q[n]; p[n]",
            "w[n][2][n]",
            "sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..2, k in 0..n) {
                w[i][j][k]*q[i]*q[k] + w[(i + 1) % n][1 - j][(k - 2) % n]*cos(q[k]) }",
        ];
        let w = some(2 * n * n);
        let rows = w.chunks(n).map(<[f64]>::to_vec).collect::<Vec<_>>();
        let lists = rows.chunks(2).map(<[Vec<f64>]>::to_vec).collect::<Vec<_>>();
        interpreted(&Weighed::new(n, lists).unwrap(), n, weighed, &[w]);
    }
}
