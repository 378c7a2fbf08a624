//! The forms that steps preserve, by exact tangents, with negative controls.

use crate::common::geometry::*;
use crate::common::measured_here;
use crate::common::systems::*;
use hamiltonian::schemes::walk::{
    Visitor, visit_any, visit_separable, visit_split, visit_unforced,
};
use hamiltonian::schemes::{IntersectingSubTrajectories, Pihajoki, Tao, TwoStepMidpoint};
use hamiltonian::{Separable, Split, Unforced};

fn separable<S>(mut geometry: Geometry<S>)
where
    S: Separable + Split + Unforced,
{
    visit_any(&mut geometry);
    visit_unforced(&mut geometry);
    visit_split(&mut geometry);
    visit_separable(&mut geometry);
    assert_eq!(geometry.measured.len(), 3 * measured_here());
    for (entry, defect) in geometry.measured {
        println!("{entry}: {defect:.1e}");
    }
}

#[test]
fn on_a_separable_system() {
    let (q, p) = ([0.1, -0.25], [0.42, 0.1]);
    separable(Geometry::new(HenonHeiles::default(), &q, &p, 0.2));
}

#[test]
fn with_time() {
    separable(Geometry::new(Pumped::default(), &[0.9], &[0.4], 0.2));
}

#[test]
fn on_systems_that_are_not_separable() {
    let mut geometry = Geometry::new(Paper34::default(), &[-3.0], &[0.5], 0.05);
    visit_any(&mut geometry);
    visit_unforced(&mut geometry);
    visit_split(&mut geometry);
    let mut geometry = Geometry::new(Shaken34::default(), &[1.0], &[0.5], 0.1);
    visit_any(&mut geometry);
    visit_unforced(&mut geometry);
    let (q, p) = ([0.8, -0.4], [0.3, 0.2]);
    let mut geometry = Geometry::new(DoublePendulum::default(), &q, &p, 0.05);
    visit_any(&mut geometry);
    visit_unforced(&mut geometry);
    geometry.visit(Tao::default().with_omega(10.0));
}

/// The wrong forms are not preserved: the checks can fail.
#[test]
fn negative_controls() {
    let system = Paper34::default();
    let start = start(&system, &[-3.0], &[0.5]);
    // The visible state of (29) after three steps is no symplectic map of the start.
    let columns = visible_tangent(&system, &Pihajoki::default(), &start, 0.05, 3);
    let (worst, size) = defect(&columns, one_point(1));
    assert!(worst > 1e-10 * size, "(29): {worst:e} of {size:e}");
    // Nor do the copies preserve the form of two points of a trajectory.
    let columns = carried_tangent(&system, &Pihajoki::default(), &start, 0.05, 1);
    let (worst, size) = defect(&columns, crossed(1));
    assert!(worst > 1e-10 * size, "(29), crossed: {worst:e} of {size:e}");
    // The visible state of bound copies is no symplectic map either.
    let columns = visible_tangent(&system, &Tao::default().with_omega(10.0), &start, 0.05, 3);
    let (worst, size) = defect(&columns, one_point(1));
    assert!(worst > 1e-10 * size, "bound: {worst:e} of {size:e}");
    // Two points, each with its own momentum.
    let scheme = IntersectingSubTrajectories::default();
    let columns = carried_tangent(&system, &scheme, &start, 0.05, 1);
    let (worst, size) = defect(&columns, uncrossed(1));
    assert!(worst > 1e-10 * size, "(33): {worst:e} of {size:e}");
    let columns = carried_tangent(&system, &TwoStepMidpoint::default(), &start, 0.05, 1);
    let (worst, size) = defect(&columns, uncrossed(1));
    assert!(worst > 1e-10 * size, "(25): {worst:e} of {size:e}");
}
