//! Failures of one lane of several.

use crate::common::four::Four;
use crate::common::systems::*;
use hamiltonian_core::errors::StepError;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_separable, visit_split, visit_unforced,
};
use hamiltonian_core::{Scheme, Vector};

fn lanes<const N: usize>(q: [[f64; 4]; N], p: [[f64; 4]; N]) -> State<SVector<Four, N>> {
    State {
        t: Four([0.0; 4]),
        q: SVector::from(q.map(Four)),
        p: SVector::from(p.map(Four)),
    }
}

/// Errors name the lane and the step, which are those of the lone run.
#[test]
fn failures_name_their_lane() {
    struct Escapes;
    impl Visitor<Hand<HenonHeiles, 2>> for Escapes {
        fn visit<M: Scheme<Hand<HenonHeiles, 2>>>(&mut self, scheme: M) {
            let start = lanes(
                [[0.1, -0.2, 0.3, 0.0], [0.1, 0.0, 1.2, 0.2]],
                [[0.1, 0.2, 0.4, 0.0], [0.0, 0.1, 0.6, 0.1]],
            );
            let name = scheme.entry().name;
            let mut run =
                Integrator::new(&Hand(HenonHeiles), scheme, start, Four([0.01; 4])).unwrap();
            let error = run.advance(100_000).unwrap_err();
            match &error {
                Error::Step(
                    StepError::NotFinite { lane, step, .. }
                    | StepError::Unsolved { lane, step, .. },
                ) => {
                    assert_eq!((*lane, *step), (Some(2), run.steps() + 1), "{name}");
                }
                other => panic!("{name}: {other:?}"),
            }
            assert!(error.to_string().contains("lane 2"), "{error}");
            assert!(run.state().q.is_finite() && run.state().p.is_finite());
        }
    }
    visit_any(&mut Escapes);
    visit_unforced(&mut Escapes);
    visit_separable(&mut Escapes);
    visit_split(&mut Escapes);
}
