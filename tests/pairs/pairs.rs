//! Sums over the pairs of a triangle in tiles: the bits of the interpreter, of iterations one by one and of
//! every level, at numbers of rows around the least one that has tiles.

use crate::common::bits::check;
use crate::common::derivatives::numbers;
use crate::symbolic;
use hamiltonian::errors::{StartError, StepError};
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::{Dynamics, VectorField};
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::pairs::LEAST;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Purpose, Target};
use hamiltonian_symbolic::structure;

hamiltonian! {
    /// Points of a line, each with those before it.
    pub struct Before { n: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) }
        - sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt((q[i] - q[j])^2 + 1) }
}

hamiltonian! {
    /// Points of a line, each by itself and with those after it, in bonds of different strength.
    pub struct After { n: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + q[i]^4/4 }
        + sum(i in 0..n, j in i + 1..n) { m[i]*(j + 1)*(q[i] - q[j])^2/n }
}

hamiltonian! {
    /// Points that push each other away.
    pub struct Charges { n: usize, e = 0.0 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + e^2*sum(i in 0..n, j in 0..i) { 1/(q[i] - q[j])^2 }
}

/// The text of [`Before`] and of [`After`], for the tests' reader.
const TEXTS: [&str; 2] = [
    "sum(i in 0..n) { p[i]^2/(2*m[i]) } \
     - sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt((q[i] - q[j])^2 + 1) }",
    "sum(i in 0..n) { p[i]^2/2 + q[i]^4/4 } \
     + sum(i in 0..n, j in i + 1..n) { m[i]*(j + 1)*(q[i] - q[j])^2/n }",
];

fn masses(n: usize) -> Vec<f64> {
    numbers(7).map(|x| x.abs() + 0.5).take(n).collect()
}

/// The field of a system as the macro reads it and as the tests' reader does: equal to the bit.
#[track_caller]
fn interpreted<S>(system: &S, n: usize, h: &str)
where
    S: System<Shape = hamiltonian::private::DVector<()>>,
{
    let mut model = symbolic::system("q[n]; p[n]", "n", "m[n]", h);
    assert!(structure::analyse(&mut model).separable.is_ok());
    // Values that other functions read as well are prepared in advance.
    let program = derive(&mut model, &symbolic::PURPOSES).expect("a program");
    let mut some = numbers(n as u64);
    let [q, p] = [(); 2].map(|()| some.by_ref().take(n).collect::<Vec<f64>>());
    let mut point = Point::<f64>::new();
    point.sizes = vec![n];
    point.scalars = vec![0.0];
    let parameter = Array::Parameter(Parameter(0));
    point.arrays.insert(parameter, vec![masses(n)]);
    let columns = [Side::Q, Side::P].map(|side| Column::first(side, 0));
    for (column, values) in columns.into_iter().zip([&q, &p]) {
        let zeros = vec![vec![0.0; n]];
        (point.arrays).insert(Array::Phase(column), vec![values.clone()]);
        point.outputs.insert(Target::Phase(column), zeros);
    }
    let function = program.function(Purpose::VectorField);
    let expected = run(&program, function.expect("it was asked for"), &point);
    let [q, p] = [q, p].map(hamiltonian::private::DVector::from);
    let (mut a, mut b) = (system.zeros(), system.zeros());
    system.prepare().field(1.0).add(0.0, &q, &p, &mut a, &mut b);
    for (column, found) in columns.into_iter().zip([&a, &b]) {
        let expected = &expected.outputs[&Target::Phase(column)][0];
        let differ = expected.iter().zip(found).position(|(a, b)| a != b);
        assert_eq!(differ, None, "{column:?}, n = {n}");
    }
}

#[test]
fn the_interpreter_makes_the_same_tiles() {
    let n = LEAST + 1;
    interpreted(&Before::new(n, masses(n)).unwrap(), n, TEXTS[0]);
    interpreted(&After::new(n, masses(n)).unwrap(), n, TEXTS[1]);
}

#[test]
fn tiles_have_the_bits_of_iterations_one_by_one() {
    for n in [LEAST - 1, LEAST, LEAST + 1, 5000] {
        check(&Before::new(n, masses(n)).unwrap(), n as u64);
        check(&After::new(n, masses(n)).unwrap(), n as u64);
    }
}

#[test]
fn points_that_meet_are_an_error_with_its_place() -> Result<(), Error> {
    for n in [2, 40, 4100] {
        let system = Charges::new(n)?;
        let mut places: Vec<f64> = (0..n).map(|i| 2.0 * i as f64).collect();
        let (mut momenta, last) = (vec![0.0; n], n - 1);
        // Without charges points move freely, and 0/0 is what is left of the force where they meet.
        (places[last], momenta[last]) = (-1.0, 1.0);
        for threads in [1, 2] {
            let start = State::new(places.clone(), momenta.clone());
            let run = Integrator::new(&system, StormerVerlet::default(), start, 0.5)?;
            let mut run = run.with_threads(threads);
            let Err(Error::Step(StepError::NotFinite { step, p, .. })) = run.advance(10) else {
                panic!("{n} points met")
            };
            assert_eq!(step, 2);
            let lost: Vec<usize> = (0..n).filter(|i| !p[*i].is_finite()).collect();
            assert_eq!(lost, [0, last]);
            assert_eq!((run.steps(), run.state().q[last]), (1, -0.5));
        }
        places[last] = 0.0;
        let start = State::new(places, momenta);
        let error = Integrator::new(&system, StormerVerlet::default(), start, 0.5);
        let Err(Error::Start(StartError::Values { name, .. })) = error else {
            panic!("{n} points met at the start")
        };
        assert_eq!(&*name, "H");
    }
    Ok(())
}

#[test]
fn a_point_and_none_have_no_pairs() -> Result<(), Error> {
    for n in [0, 1] {
        let system = Charges::new(n)?;
        let start = State::new(vec![1.0; n], vec![0.5; n]);
        let run = Integrator::new(&system, StormerVerlet::default(), start, 0.5)?;
        let mut run = run.with_threads(2);
        assert_eq!(run.advance(2)?.q.as_slice(), vec![1.5; n]);
        assert_eq!(system.energy(run.state()), 0.125 * n as f64);
    }
    Ok(())
}
