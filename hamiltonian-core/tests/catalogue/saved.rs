//! The observers of runs of every scheme, and saved runs.

use crate::common::start;
use crate::common::systems::*;
use crate::common::walk::{Sample, everywhere};
use core::marker::PhantomData;
use hamiltonian_core::VectorOf;
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::walk::{Visitor, visit_any, visit_split};
use hamiltonian_core::schemes::{
    Adjoint, Composition, IntersectingSubTrajectories, TwoStepMidpoint,
};
use hamiltonian_core::{
    DoubleDouble, Scheme,
    observers::{Deviation, Every},
};

pub type Watchers<T> = (EnergyDrift<T>, (Monitors<T>, Every<Recorder>));

pub fn watchers<T: Real>() -> Watchers<T> {
    let recorder = every(3, Recorder::new().with_energy());
    (EnergyDrift::new(), (Monitors::new(), recorder))
}

impl<T: Real> Sample<T> for Chain {
    fn sample() -> Self {
        Chain { n: 2 }
    }
    fn begin() -> State<VectorOf<Self, T>> {
        start::<T, Self>(&Chain { n: 2 }, &[0.9, -0.25], &[0.42, 0.1])
    }
}

/// Saves at odd and even steps, within a block and beyond, and goes on from the bytes.
struct Resumes<T>(PhantomData<T>);

impl<T: Real, S: Sample<T>> Visitor<S> for Resumes<T> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let system = &S::sample();
        let begin: State<VectorOf<S, T>> = S::begin();
        let step = T::constant(0.01, 0.0);
        let name = scheme.entry().name;
        for steps in [0, 1, 7, 8, 1031] {
            let mut run = Integrator::new(system, scheme.clone(), begin.clone(), step)
                .unwrap()
                .observe(watchers());
            run.advance(steps).unwrap();
            let bytes = run.checkpoint().to_bytes();
            let saved = Checkpoint::from_bytes(&bytes).unwrap();
            assert_eq!((saved.steps(), saved.to_bytes() == bytes), (steps, true));
            let mut again = Integrator::resume_over(system, scheme.clone(), saved)
                .unwrap()
                .observe(watchers());
            assert_eq!(again.state(), run.state(), "{name} at {steps}");
            assert_eq!(again.observer().0, run.observer().0, "{name} at {steps}");
            assert_eq!(again.checkpoint().to_bytes(), bytes, "{name} at {steps}");
            run.advance(1030).unwrap();
            again.advance(1).unwrap();
            again.advance(1029).unwrap();
            // The whole carried state, not only the visible one.
            assert_eq!(again.carried(), run.carried(), "{name} at {steps}");
            assert_eq!((again.steps(), again.time()), (run.steps(), run.time()));
            let ((drift, (monitors, recorder)), ours) = (again.observer(), run.observer());
            assert_eq!((drift, monitors), (&ours.0, &ours.1.0), "{name} at {steps}");
            assert_eq!(recorder.inner(), ours.1.1.inner(), "{name} at {steps}");
            let count = drift.drift().map(Deviation::count);
            assert_eq!(count, Some(steps + 1031), "{name} at {steps}");
        }
    }
}

#[test]
fn every_scheme_goes_on_with_the_same_bits() {
    everywhere(&mut Resumes::<f64>(PhantomData));
    fn of<T: Real>(scheme: impl Scheme<Hand<Pumped, 1>>) {
        Visitor::<Hand<Pumped, 1>>::visit(&mut Resumes::<T>(PhantomData), scheme);
    }
    let implicit = Composition::yoshida(ImplicitMidpoint::default());
    of::<f64>(implicit);
    of::<f64>(Composition::yoshida(Strang));
    of::<f64>(Adjoint(RungeKutta4));
    of::<DoubleDouble>(implicit);
    of::<DoubleDouble>(IntersectingSubTrajectories::default());
    of::<Dual<f64>>(Strang);
    of::<f32>(TwoStepMidpoint::default());
    // Sizes that are set at run time.
    visit_split::<Chain>(&mut Resumes::<f64>(PhantomData));
    visit_any::<Chain>(&mut Resumes::<f64>(PhantomData));
}
