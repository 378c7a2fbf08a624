//! Runs that are cut, observed and iterated, and their first bad step.

use crate::common::start;
use crate::common::systems::*;
use hamiltonian_core::errors::StepError;
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_separable, visit_split, visit_unforced,
};
use hamiltonian_core::{Scheme, Vector, observers::watch};

/// Cuts and observers leave every bit as it is.
struct SameBits<S>(S);

impl<S: System> Visitor<S> for SameBits<S> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let n = <S as System>::zeros::<f64>(&self.0).len();
        let (q, p) = ([0.1, -0.25], [0.42, 0.1]);
        let start = start::<f64, S>(&self.0, &q[..n], &p[..n]);
        let new = || Integrator::new(&self.0, scheme.clone(), start.clone(), 0.01).unwrap();
        let mut whole = new();
        let whole = whole.advance(5000).unwrap();
        let name = scheme.entry().name;
        let mut cut = new();
        for n in [1, 2, 1021, 3, 0, 1024, 2949] {
            cut.advance(n).unwrap();
        }
        assert_eq!(cut.state(), whole, "{name}, cut");
        let mut seen = 0;
        let mut watched = new().observe((
            EnergyDrift::new(),
            every(7, watch(|_: &hamiltonian_core::View<'_, f64, S>| seen += 1)),
        ));
        watched
            .advance_to(start.t + watched.duration() * 5000.0)
            .unwrap();
        assert_eq!(watched.state(), whole, "{name}, watched");
        drop(watched);
        assert_eq!(seen, 1 + 5000 / 7, "{name}");
        let mut iterated = new();
        let last = iterated.states(40).nth(124).unwrap().unwrap();
        assert_eq!(&last, whole, "{name}, iterated");
    }
}

#[test]
fn bits_do_not_depend_on_cuts_or_observers() {
    let mut visitor = SameBits(Hand(Pumped));
    visit_any::<_>(&mut visitor);
    visit_unforced::<_>(&mut visitor);
    visit_separable::<_>(&mut visitor);
    visit_split::<_>(&mut visitor);
    visit_any::<_>(&mut SameBits(Hand(DoublePendulum)));
    visit_unforced::<_>(&mut SameBits(Hand(DoublePendulum)));
}

/// Escape from Hénon–Heiles overflows; the step that does is found wherever the block lies.
#[test]
fn the_first_bad_step_is_found() {
    struct FirstBad;
    impl Visitor<Hand<HenonHeiles, 2>> for FirstBad {
        fn visit<M: Scheme<Hand<HenonHeiles, 2>>>(&mut self, scheme: M) {
            let start = State::new([0.3, 1.2], [0.4, 0.6]);
            let new = || {
                Integrator::new(&Hand(HenonHeiles), scheme.clone(), start.clone(), 0.01).unwrap()
            };
            let mut single = new();
            let expected = (0..100_000)
                .find_map(|_| single.advance(1).err())
                .expect("it escapes");
            let entry = scheme.entry();
            match &expected {
                Error::Step(StepError::NotFinite {
                    step,
                    energy,
                    time,
                    q,
                    p,
                    ..
                }) => {
                    assert_eq!(*step, single.steps() + 1);
                    assert_eq!(*time, *step as f64 * single.duration());
                    // H overflows before its variables do.
                    let numbers_are_finite = q.iter().chain(p).all(|x| x.is_finite());
                    assert_eq!(energy.is_some(), numbers_are_finite, "{}", entry.name);
                    assert!(energy.is_none_or(|h| !h.is_finite()), "{}", entry.name);
                }
                Error::Step(StepError::Unsolved {
                    step,
                    time,
                    residual,
                    iterations,
                    ..
                }) => {
                    let implicit = [
                        "ImplicitMidpoint",
                        "Gauss",
                        "DiscreteGradient",
                        "Semiexplicit",
                    ];
                    assert!(implicit.contains(&entry.name), "{}", entry.name);
                    assert_eq!(*step, single.steps() + 1);
                    assert_eq!(*time, single.time());
                    assert!(
                        // The limits of the semiexplicit method and of the others.
                        !residual.is_finite() || matches!(*iterations, 50 | 100),
                        "{residual} {iterations}"
                    );
                }
                other => panic!("{other:?}"),
            }
            assert!(
                single
                    .state()
                    .q
                    .iter()
                    .chain(&single.state().p)
                    .all(|x| x.is_finite())
            );
            let same = |a: &Error, b: &Error| assert_eq!(format!("{a:?}"), format!("{b:?}"));
            // In one call, across blocks, observed, iterated: the same error, the same last state.
            let mut whole = new();
            same(&whole.advance(1_000_000).unwrap_err(), &expected);
            assert_eq!(whole.state(), single.state());
            assert_eq!(whole.steps(), single.steps());
            let mut shifted = new();
            shifted.advance(13).unwrap();
            same(&shifted.advance(1_000_000).unwrap_err(), &expected);
            let mut watched = new().observe(every(
                3,
                watch(
                    |view: &hamiltonian_core::View<'_, f64, Hand<HenonHeiles, 2>>| {
                        assert!(view.state.q.is_finite() && view.state.p.is_finite());
                    },
                ),
            ));
            same(&watched.advance(1_000_000).unwrap_err(), &expected);
            let mut iterated = new();
            let items: Vec<_> = iterated.states(5).collect();
            same(items.last().unwrap().as_ref().unwrap_err(), &expected);
            assert!(items[..items.len() - 1].iter().all(Result::is_ok));
            // Asked again, the run says the same again.
            same(&whole.advance(1).unwrap_err(), &expected);
        }
    }
    visit_any::<_>(&mut FirstBad);
    visit_unforced::<_>(&mut FirstBad);
    visit_separable::<_>(&mut FirstBad);
    visit_split::<_>(&mut FirstBad);
}
