//! Orders, forms and figures of the schemes of higher order, on systems written by hand.
//!
//! Input: the schemes. Output: slopes in double-double, defects of forms by exact tangents, and
//! figures of long runs. Invariant: a scheme has the order and preserves the form in its entry, and
//! schemes that should not have them fail the same checks.

use super::common::measures::{assert_order, defect, slopes, tangent};
use super::common::systems::{DoublePendulum, Hand, HenonHeiles, Paper34, Pumped, Relativistic};
use super::common::{difference, start};
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::author::Splitting;
use hamiltonian_core::schemes::*;
use hamiltonian_core::{DoubleDouble, Integrator, Scheme, State, System};

#[test]
fn splittings_have_their_order_where_both_pieces_depend_on_time() {
    let system = Hand(Pumped);
    let start = start(&system, &[0.9], &[0.4]);
    assert_order(&system, &Ruth3, &start, 2.0, 32);
    assert_order(&system, &BlanesMoan6, &start, 2.0, 16);
    assert_order(&system, &KahanLi8, &start, 2.0, 8);
    assert_order(&system, &Gauss::<3>::default(), &start, 2.0, 8);
    let semiexplicit = Semiexplicit::<KahanLi6>::default();
    assert_order(&system, &semiexplicit, &start, 2.0, 8);
    let projected = MidpointProjected::<KahanLi6>::default();
    assert_order(&system, &projected, &start, 2.0, 8);
}

#[test]
fn nystrom_schemes_lose_their_order_where_their_bound_forbids_them() {
    fn control<M: Scheme<Hand<Relativistic, 1>>>(scheme: M) {
        let system = Hand(Relativistic);
        let start = start(&system, &[0.9], &[0.4]);
        let slopes = slopes(&system, &scheme, &start, 2.0, 32);
        println!(
            "{} where it has no right to be: {slopes:.3?}",
            scheme.entry().name
        );
        assert!((slopes[3] - 4.0).abs() <= 0.1, "{slopes:?}");
    }
    control(Srkn11b);
    control(Srkn14a);
    control(BlanesCasasEscorihuela8);
}

/// With the velocities eliminated the steps are the same.
#[test]
fn the_second_order_form_of_gauss_makes_the_same_steps() {
    fn end(scheme: impl Scheme<Hand<HenonHeiles, 2>>) -> State<SVector<f64, 2>> {
        let system = Hand(HenonHeiles);
        let start = start(&system, &[0.12, 0.23], &[0.31, -0.17]);
        let mut run = Integrator::new(&system, scheme, start, 0.2).expect("a good start");
        run.advance(100).expect("good steps").clone()
    }
    let apart = difference(
        &end(Gauss::<4>::default()),
        &end(GaussNystrom::<4>::default()),
    );
    let control = difference(
        &end(Gauss::<3>::default()),
        &end(GaussNystrom::<4>::default()),
    );
    println!("Gauss and its second-order form: {apart:.1e}, with a stage less {control:.1e}");
    assert!(apart <= 2e-15 && control > 1e-12, "{apart:e} {control:e}");
    let system = Hand(HenonHeiles);
    let begin = start(&system, &[0.12, 0.23], &[0.31, -0.17]);
    let scheme = GaussNystrom::<3>::default();
    let defect = defect::<f64>(&tangent(&system, &scheme, &begin, 0.2, 3));
    assert!(defect <= 3e-13, "{defect:e}");
}

/// A scheme for any H on the paper's (34).
pub fn on_34(scheme: impl Scheme<Hand<Paper34, 1>>, steps: u64) {
    let system = Hand(Paper34);
    let start = start(&system, &[-1.5], &[0.3]);
    assert_order(&system, &scheme, &start, 1.0, steps);
}

/// And on the double pendulum.
pub fn on_the_double_pendulum(scheme: impl Scheme<Hand<DoublePendulum, 2>>, steps: u64) {
    let system = Hand(DoublePendulum);
    let start = start(&system, &[0.8, -0.4], &[0.3, 0.2]);
    assert_order(&system, &scheme, &start, 1.0, steps);
}

#[test]
fn doubled_schemes_have_their_order() {
    on_34(Tao::default().with_omega(10.0), 32);
    on_34(Yoshida6.of(Tao::default().with_omega(3.0)), 32);
    on_34(MidpointProjected::<Suzuki4>::default(), 16);
    on_34(MidpointProjected::<BlanesMoan6>::default(), 8);
    on_34(MidpointProjected::<SofroniouSpaletta10>::default(), 4);
    on_34(Semiexplicit::<Strang>::default(), 16);
    on_34(Semiexplicit::<BlanesMoan4>::default(), 16);
    on_34(Semiexplicit::<KahanLi8>::default(), 8);
    on_the_double_pendulum(Tao::default().with_omega(10.0), 32);
    on_the_double_pendulum(MidpointProjected::<KahanLi8>::default(), 8);
    on_the_double_pendulum(Semiexplicit::<KahanLi6>::default(), 8);
}

#[test]
fn gauss_has_its_order() {
    on_34(Gauss::<1>::default(), 16);
    on_34(Gauss::<2>::default(), 8);
    on_34(Gauss::<4>::default(), 4);
    on_34(Yoshida6.of(Gauss::<1>::default()), 8);
    on_the_double_pendulum(Gauss::<3>::default(), 8);
}

/// max |ΔH/H| of the paper's (34) from (−3, 0) to T = 1000.
fn drift_34<M: Scheme<Hand<Paper34, 1>>>(scheme: M, h: f64) -> f64 {
    let system = Hand(Paper34);
    let start = State::new([-3.0], [0.0]);
    let mut run = Integrator::new(&system, scheme.clone(), start, h).expect("a good start");
    let mut worst = 0.0_f64;
    for _ in 0..(1000.0 / h).round() as u64 {
        let state = run.advance(1).expect("a good step").clone();
        worst = worst.max((system.energy(&state) / 5.0 - 1.0).abs());
    }
    let entry = scheme.entry();
    println!("{} {} h = {h}: {worst:.3e}", entry.name, entry.variant);
    worst
}

#[test]
fn figures_of_the_papers_34() {
    assert!(drift_34(Semiexplicit::<Strang>::default(), 0.1) <= 6.0e-3);
    assert!(drift_34(Semiexplicit::<Suzuki4>::default(), 0.1) <= 1.9e-5);
    assert!(drift_34(Semiexplicit::<Yoshida6>::default(), 0.1) <= 3.7e-6);
    assert!(drift_34(Semiexplicit::<KahanLi6>::default(), 0.1) <= 1.4e-7);
    assert!(drift_34(Gauss::<2>::default(), 0.1) <= 4.7e-5);
    assert!((drift_34(Tao::default().with_omega(20.0), 0.1) - 0.079).abs() <= 0.0005);
    assert!(drift_34(Tao::default().with_omega(20.0), 0.01) <= 6.3e-4);
}

pub fn symplectic<M>(scheme: M)
where
    M: Scheme<Hand<Paper34, 1>> + Scheme<Hand<DoublePendulum, 2>>,
{
    let entry = scheme.entry();
    let system = Hand(Paper34);
    let of_34 = defect::<f64>(&tangent(
        &system,
        &scheme,
        &start(&system, &[-3.0], &[0.5]),
        0.05,
        3,
    ));
    let system = Hand(DoublePendulum);
    let start = start(&system, &[0.8, -0.4], &[0.3, 0.2]);
    let of_pendulum = defect::<f64>(&tangent(&system, &scheme, &start, 0.05, 3));
    println!(
        "{} {}: {of_34:.1e} {of_pendulum:.1e}",
        entry.name, entry.variant
    );
    // Over three steps.
    assert!(
        of_34 <= 3e-13 && of_pendulum <= 3e-13,
        "{of_34:e} {of_pendulum:e}"
    );
}

#[test]
fn schemes_for_any_h_are_symplectic() {
    symplectic(Gauss::<1>::default());
    symplectic(Gauss::<2>::default());
    symplectic(Gauss::<6>::default());
    symplectic(Gauss::<16>::default());
    symplectic(Semiexplicit::<Strang>::default());
    symplectic(Semiexplicit::<KahanLi6>::default());
}

/// The distance of the copies after a step, an estimate of its error, falls with h^(p+1).
#[test]
fn copies_part_by_the_error_of_a_step() {
    fn slope<M: Splitting>(scheme: MidpointProjected<M>) -> f64 {
        let system = Hand(Paper34);
        let begin = start(&system, &[-1.5], &[0.3]);
        let distance = |h: f64| {
            let h = DoubleDouble::from(h);
            let run = Integrator::new(&system, scheme, begin.clone(), h);
            let mut run = run.expect("a good start");
            run.advance(1).expect("a good step");
            run.copy_distance()
        };
        let h = [4, 5, 6, 7].map(|k| 0.5_f64.powi(k));
        let slopes = h.map(|h| (distance(h) / distance(h / 2.0)).log2());
        println!("copies after a step of {scheme:?}: {slopes:.3?}");
        slopes[3]
    }
    for (slope, order) in [
        (slope(MidpointProjected::<Strang>::default()), 2.0),
        (slope(MidpointProjected::<BlanesMoan4>::default()), 4.0),
        (slope(MidpointProjected::<KahanLi6>::default()), 6.0),
    ] {
        assert!(
            (slope - (order + 1.0)).abs() <= 0.1,
            "{slope} for order {order}"
        );
    }
}

/// One step of midpoint projection violates dq∧dp by O(h^(2p+2)).
#[test]
fn midpoint_projection_is_pseudo_symplectic() {
    fn slope<M: Scheme<Hand<Paper34, 1>>>(scheme: M, h: f64) -> f64 {
        let system = Hand(Paper34);
        let start = start(&system, &[-1.5], &[0.3]);
        let of = |h: f64| defect::<DoubleDouble>(&tangent(&system, &scheme, &start, h, 1));
        let slopes: Vec<_> = (0..4)
            .map(|k| h / f64::from(1 << k))
            .map(|h| (of(h) / of(h / 2.0)).log2())
            .collect();
        println!(
            "{} {}: {slopes:.3?}",
            scheme.entry().name,
            scheme.entry().variant
        );
        slopes.iter().sum::<f64>() / 4.0
    }
    let second = slope(MidpointProjected::<Strang>::default(), 0.02);
    assert!((second - 6.0).abs() <= 0.1, "{second}");
    let fourth = slope(MidpointProjected::<BlanesMoan4>::default(), 0.05);
    assert!((fourth - 10.0).abs() <= 0.1, "{fourth}");
    // It is not symplectic, so the check of those that are can fail.
    let system = Hand(Paper34);
    let start = start(&system, &[-3.0], &[0.5]);
    let control = defect(&tangent::<f64, _, _>(
        &system,
        &MidpointProjected::<Strang>::default(),
        &start,
        0.05,
        3,
    ));
    assert!(control > 1e-10, "{control:e}");
}
