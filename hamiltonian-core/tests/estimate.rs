//! The estimated error of a run against its true one.

use crate::common::systems::*;
use crate::common::{difference, start};
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::{Composition, Processed6, SymplecticEuler};
use hamiltonian_core::{ErrorEstimate, Scheme, schemes::author::Listed};

type Estimate = ErrorEstimate<hamiltonian_core::private::SVector<f64, 1>>;

/// The estimate of a run to t = 5, and its true error.
fn estimate(scheme: impl Scheme<Hand<Relativistic, 1>>, n: u64) -> (Estimate, f64, f64) {
    const END: f64 = 5.0;
    let system = Hand(Relativistic);
    let begin = start(&system, &[0.9], &[0.4]);
    let run = |n: u64| Integrator::new(&system, scheme.clone(), begin.clone(), END / n as f64);
    let mut planned = run(n).unwrap();
    let estimate = planned.estimate_error(n).unwrap();
    // The run has not moved, and goes where the estimate says.
    assert_eq!((planned.steps(), planned.state()), (0, &begin));
    assert_eq!(planned.advance(n).unwrap(), &estimate.end);
    let exact = Integrator::new(&system, KahanLi8, begin.clone(), END / 2000.0);
    let mut exact = exact.unwrap();
    let error = difference(exact.advance(2000).unwrap(), &estimate.end);
    let energy = (planned.energy() - exact.energy()).abs();
    (estimate, error, energy)
}

#[test]
fn estimates_are_the_errors_of_schemes_of_known_order() {
    fn check(scheme: impl Scheme<Hand<Relativistic, 1>>, n: u64) {
        let entry = scheme.entry();
        let (estimate, error, energy) = estimate(scheme, n);
        println!(
            "{entry}: order {:.3}, {:.2e} of {error:.2e}",
            estimate.order, estimate.error
        );
        assert!(
            (estimate.order - f64::from(entry.order)).abs() < 0.1,
            "{entry}: {estimate:?}"
        );
        assert!(
            (estimate.error / error - 1.0).abs() < 0.05,
            "{entry}: {error:e}, {estimate:?}"
        );
        let of_energy = estimate.energy_error / energy - 1.0;
        assert!(of_energy.abs() < 0.1, "{entry}: {energy:e}, {estimate:?}");
    }
    check(SymplecticEuler::KickDrift, 4000);
    check(StormerVerlet::KickDriftKick, 400);
    check(BlanesMoan4, 60);
    check(BlanesMoan6, 30);
    check(Processed6::default(), 30);
    check(RungeKutta4, 200);
}

/// Where steps are of the size of rounding, or far too long, the observed order says so.
#[test]
fn estimates_that_cannot_be_trusted_show_another_order() {
    let (rounding, ..) = estimate(KahanLi8, 4000);
    assert!((rounding.order - 8.0).abs() > 2.0, "{rounding:?}");
    assert!(rounding.error < 1e-12, "{rounding:?}");
    // A scheme of order 2 that is entered with order 6.
    let weights =
        [1.0, 0.0, 0.0].map(|weight| hamiltonian_core::schemes::author::Weight(weight, 0.0));
    let wrong = Composition::new(
        StormerVerlet::KickDriftKick,
        weights,
        6,
        "said to be of order 6",
    );
    assert_eq!(wrong.entry().order, 6);
    let (estimate, error, _) = estimate(wrong, 400);
    assert!((estimate.order - 2.0).abs() < 0.1, "{estimate:?}");
    assert!(
        (estimate.error / error - 1.0).abs() < 0.05,
        "{error:e}, {estimate:?}"
    );
}
