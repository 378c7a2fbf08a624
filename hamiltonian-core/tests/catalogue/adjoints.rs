//! Adjoints, and steps that are made at once.

use crate::common::pieces::{Loops, Polar};
use crate::common::systems::*;
use crate::common::walk::{Sample, everywhere};
use crate::common::{difference, start};
use crate::saved::watchers;
use hamiltonian_core::VectorOf;
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::Ruth3;
use hamiltonian_core::schemes::{author::Reversed, walk::Visitor};
use hamiltonian_core::{
    Scheme, Vector,
    schemes::author::{Form, Map, OneStep, Scratch, Step},
};

/// A step of the adjoint with h undoes one with −h.
struct Adjoints {
    /// Those that do not undo their own.
    others: Vec<&'static str>,
    missed: Vec<String>,
}

impl<S: Sample<f64>> Visitor<S> for Adjoints {
    fn visit<M: Scheme<S>>(&mut self, _: M) {}
    fn visit_one_step<M>(&mut self, scheme: M)
    where
        M: Scheme<S> + OneStep<Adjoint: Scheme<S>>,
    {
        fn step<S: Sample<f64>>(
            scheme: impl Scheme<S>,
            from: &State<VectorOf<S>>,
            h: f64,
        ) -> State<VectorOf<S>> {
            let run = Integrator::new(&S::sample(), scheme, from.clone(), h);
            let mut run = run.unwrap().observe(watchers());
            run.advance(1).unwrap().clone()
        }
        let entry = scheme.entry();
        // Of two copies one is not the state.
        if entry.preserves == Form::TwoCopies {
            return;
        }
        let begin = S::begin();
        let away = step::<S>(scheme.clone(), &begin, -0.05);
        let back = difference(&step::<S>(scheme.adjoint(), &away, 0.05), &begin);
        if back > 1e-14 {
            self.missed.push(format!("{entry:?}: {back:e}"));
        }
        if difference(&step::<S>(scheme, &away, 0.05), &begin) > 1e-12 {
            self.others.push(entry.name);
        }
    }
}

#[test]
fn every_adjoint_undoes_a_step() {
    let mut adjoints = Adjoints {
        others: Vec::new(),
        missed: Vec::new(),
    };
    everywhere(&mut adjoints);
    assert!(adjoints.missed.is_empty(), "{:#?}", adjoints.missed);
    // The control: these are not symmetric.
    let euler = "SymplecticEuler";
    let (plain, processed): (Vec<_>, Vec<_>) = (adjoints.others.into_iter())
        .partition(|name| ["RungeKutta4", "Ruth3", euler].contains(name));
    assert_eq!(plain, ["RungeKutta4", "Ruth3", euler, euler]);
    // Nor are these, whose processors agree with those of −h to their order only.
    let with_correctors = ["3", "5", "7", "11", "17"].map(|order| format!("WisdomHolman{order}"));
    assert_eq!(processed[..2], ["Processed4", "Processed6"]);
    assert_eq!(processed[2..], with_correctors);
}

/// The bits of what a scheme carries after a step from a state: of a prepared step, or of one made at once.
fn after_a_step<S, M>(
    system: &S,
    scheme: &M,
    begin: &State<VectorOf<S>>,
    h: f64,
    at_once: bool,
) -> Vec<u64>
where
    S: System,
    M: Scheme<S>,
{
    let prepared = system.prepare();
    let mut carried = scheme.start(&prepared, begin, h);
    let mut work = Scratch::like(&carried);
    let [t, end] = [begin.t, begin.t + h];
    if at_once {
        scheme.step(&prepared, h, [t, end], &mut carried, &mut work);
    } else {
        let map = scheme.prepare(&prepared, Step::of(h));
        map.step(t, end, &mut carried, &mut work);
    }
    let parts = 0..<<M::Map<f64> as Map>::Carried as Vector>::PARTS;
    (parts.flat_map(|k| carried.part(k).to_vec()))
        .map(f64::to_bits)
        .collect()
}

#[derive(Default)]
struct AtOnce {
    apart: Vec<String>,
    /// How many schemes had other bits after a slightly longer step.
    moved: usize,
}

impl<S: Sample<f64>> Visitor<S> for AtOnce {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let step = |h: f64, at_once| after_a_step(&S::sample(), &scheme, &S::begin(), h, at_once);
        for h in [0.05, -0.03] {
            if step(h, true) != step(h, false) {
                self.apart.push(format!("{:?} with {h}", scheme.entry()));
            }
        }
        self.moved += usize::from(step(0.05, true) != step(0.051, true));
    }
}

#[test]
fn a_step_at_once_has_the_bits_of_a_prepared_one() {
    let mut at_once = AtOnce::default();
    everywhere(&mut at_once);
    assert!(at_once.apart.is_empty(), "{:#?}", at_once.apart);
    assert!(at_once.moved > 50, "{}", at_once.moved);

    // Three pieces; loops of terms that do not commute, innermost and outermost; the table of an adjoint.
    let (q, p) = ([0.5, -0.4], [0.3, 0.8]);
    fn same<S: Split>(system: &S, q: &[f64], p: &[f64])
    where
        Ruth3: Scheme<S>,
        BlanesMoan4: Scheme<S>,
        Reversed<Ruth3>: Scheme<S>,
    {
        let begin = start::<f64, S>(system, q, p);
        fn of<S: System, M: Scheme<S>>(system: &S, begin: &State<VectorOf<S>>, scheme: M) {
            let step = |at_once| after_a_step(system, &scheme, begin, 0.05, at_once);
            assert_eq!(step(true), step(false));
        }
        of(system, &begin, Ruth3);
        of(system, &begin, Reversed(Ruth3));
        of(system, &begin, BlanesMoan4);
    }
    same(&Hand(Polar::<3>), &q, &p);
    same(&Hand(Loops::<0, true>), &q, &p);
    same(&Hand(Loops::<1, true>), &q, &p);
}
