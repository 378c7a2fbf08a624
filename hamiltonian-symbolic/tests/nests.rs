//! Systems with sums that stay loops: against dual numbers over the same H added up term by term,
//! and against the same system written out over scalar coordinates; the operations of the loops.

use crate::common::{self, PURPOSES};
use crate::soundness;
use crate::systems::{GRAVITY, Instance, Place, SQUARE_ROOT, SYSTEMS, System, TODA, at};
use crate::tape;
use crate::tape::Traced;
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble, Dual, Real};
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Program, Purpose, Target};
use std::collections::HashMap;

/// Returns true if a purpose stores at a place.
fn stores(purpose: Purpose, place: Place) -> bool {
    use Purpose::*;
    match place {
        Place::Phase(Side::Q, ..) => matches!(
            purpose,
            GradientQ | Gradient | EnergyAndGradient | HessianVector | VectorField | Drift
        ),
        Place::Phase(Side::P, ..) => matches!(
            purpose,
            GradientP | Gradient | EnergyAndGradient | HessianVector | VectorField | Kick
        ),
        Place::Parameter(..) => purpose == ParameterGradient,
        Place::Time => purpose == TimeDerivative,
        Place::Direction(..) => false,
    }
}

/// The value of a purpose at a place by the oracle.
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
                Purpose::VectorField | Purpose::Kick | Purpose::Drift,
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

/// Judges one value against the oracle; a value with too wide a bound is skipped.
fn judge(what: &str, got: Traced, want: DoubleDouble, skipped: &mut usize) {
    let bound = 8.0 * f64::EPSILON * tape::sensitivity(got);
    let noise = 1e-18 * (1.0 + want.to_f64().abs());
    let error = (DoubleDouble::from(got.value) - want).to_f64().abs();
    if error <= noise {
        return;
    }
    if bound > 1e-3 * want.to_f64().abs() {
        *skipped += 1;
    } else {
        let judged = error <= bound + noise;
        assert!(judged, "{what}: {} for {want}, bound {bound:e}", got.value);
    }
}

fn against_duals(system: &System, n: usize) {
    let mut instance = Instance::new(system, n);
    let program = derive(&mut instance.model, &PURPOSES).unwrap();
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
    let looped = derive(&mut instance.model, &PURPOSES).unwrap();
    let (mut model, pairs, parameters) = instance.written_out(system.h);
    let written = derive(&mut model, &PURPOSES).unwrap();
    let mut point: Point<f64> = Point::new();
    (point.t, point.c) = (instance.values[&Place::Time], instance.coefficient);
    for (number, pair) in pairs.iter().enumerate() {
        for place in *pair {
            let Place::Phase(side, g, c, r) = place else {
                continue;
            };
            let (group, column) = (number as u16, 0);
            let phase = Array::Phase(Column {
                side,
                group,
                column,
            });
            let direction = Array::Direction(Column {
                side,
                group,
                column,
            });
            let along = instance.values[&Place::Direction(side, g, c, r)];
            point
                .arrays
                .insert(phase, vec![vec![instance.values[&place]]]);
            point.arrays.insert(direction, vec![vec![along]]);
            let target = Target::Phase(Column {
                side,
                group,
                column,
            });
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

/// The lengths that systems are taken at.
fn lengths() -> &'static [usize] {
    &[1, 2, 3, 7, 64, 200][..common::cases(4, 6)]
}

#[test]
fn loops_against_duals() {
    for system in SYSTEMS {
        for &n in lengths() {
            if n.pow(system.order) <= 1_000_000 {
                against_duals(system, n);
            }
        }
    }
}

#[test]
fn loops_against_the_system_written_out() {
    for system in SYSTEMS {
        for &n in lengths() {
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
            Purpose::VectorField,
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
    // A value that depends on the outer loop alone is computed there.
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
        let derived = |n| derive(&mut Instance::new(system, n).model, &PURPOSES).unwrap();
        assert_eq!(derived(8), derived(10_000 / 8usize.pow(system.order)));
    }
}
