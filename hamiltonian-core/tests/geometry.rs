//! The forms that steps preserve, by exact tangents, with negative controls.

mod common;

use common::checks::*;
use common::systems::*;
use hamiltonian_core::schemes::*;
use hamiltonian_core::{Dual, System};

fn geometry<S: System<Dual<f64>>>(system: S, q: &[f64], p: &[f64], h: f64) -> Geometry<S> {
    Geometry {
        system,
        q: q.to_vec(),
        p: p.to_vec(),
        h,
        measured: Vec::new(),
    }
}

#[test]
fn of_all_schemes_on_separable_systems() {
    let mut geometry = geometry(Hand(Relativistic), &[0.9], &[0.4], 0.2);
    visit_any(&mut geometry);
    visit_separable(&mut geometry);
    for (entry, defect) in geometry.measured {
        println!("{} {}: {defect:.1e}", entry.name, entry.variant);
    }
    let mut geometry = self::geometry(Hand(HenonHeiles), &[0.1, -0.25], &[0.42, 0.1], 0.2);
    visit_any(&mut geometry);
    visit_separable(&mut geometry);
}

#[test]
fn of_all_schemes_with_time_in_both_halves() {
    let mut geometry = geometry(Hand(Pumped), &[0.9], &[0.4], 0.2);
    visit_any(&mut geometry);
    visit_separable(&mut geometry);
}

#[test]
fn on_systems_that_are_not_separable() {
    visit_any(&mut geometry(Hand(Paper34), &[-3.0], &[0.5], 0.05));
    visit_any(&mut geometry(Hand(Shaken34), &[1.0], &[0.5], 0.1));
    visit_any(&mut geometry(
        Hand(DoublePendulum),
        &[0.8, -0.4],
        &[0.3, 0.2],
        0.05,
    ));
}

/// In the extended space of both copies at one time, (29) and (30) preserve dq∧dp + dq̃∧dp̃.
#[test]
fn of_the_synchronised_copies() {
    let system = Hand(DoublePendulum);
    let start = start(&system, &[0.8, -0.4], &[0.3, 0.2]);
    for scheme in [Pihajoki::CoordinateFirst, Pihajoki::MomentumFirst] {
        let columns = copies_tangent(&system, &scheme, &start, 0.05);
        let (worst, size) = defect(&columns, uncrossed(2));
        assert!(worst <= 1e-13 * size, "{worst:e} of {size:e}");
    }
}

/// The wrong forms are not preserved: the checks can fail.
#[test]
fn negative_controls() {
    let system = Hand(Paper34);
    let (q, p) = ([-3.0], [0.5]);
    let start = start(&system, &q, &p);
    // What is seen of (29) after three steps is no symplectic map of the start.
    let columns = visible_tangent(&system, &Pihajoki::default(), &start, 0.05, 3);
    let (worst, size) = defect(&columns, one_point(1));
    assert!(worst > 1e-10 * size, "(29): {worst:e} of {size:e}");
    // Two points, each with its own momentum.
    let scheme = IntersectingSubTrajectories::default();
    let columns = carried_tangent(&system, &scheme, &start, 0.05, 1);
    let (worst, size) = defect(&columns, uncrossed(1));
    assert!(worst > 1e-10 * size, "(33): {worst:e} of {size:e}");
    let columns = carried_tangent(&system, &TwoStepMidpoint::default(), &start, 0.05, 1);
    let (worst, size) = defect(&columns, uncrossed(1));
    assert!(worst > 1e-10 * size, "(25): {worst:e} of {size:e}");
}
