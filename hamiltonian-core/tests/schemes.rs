//! Orders, forms and figures of the schemes of higher order, on systems written by hand.
//!
//! Input: the schemes. Output: slopes in double-double, defects of forms by exact tangents, and
//! figures of long runs. Invariant: a scheme has the order and preserves the form in its entry, and
//! schemes that should not have them fail the same checks.

use super::common::systems::{DoublePendulum, Hand, HenonHeiles, Paper34, Pumped, Relativistic};
use super::common::walk::{Sample, everywhere};
use super::common::{difference, start};
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::*;
use hamiltonian_core::schemes::{
    author::Splitting,
    walk::{Visitor, visit_exact},
};
use hamiltonian_core::{
    DoubleDouble, Dual, Integrator, Real, Scheme, State, System, Vector, schemes::author::Form,
};

/// The slopes between successive halvings of the step, from differences of successive results, with
/// the largest over `parts` times up to the span.
pub fn slopes<S, M>(
    system: &S,
    scheme: &M,
    start: &State<S::Vector>,
    span: f64,
    steps: u64,
) -> Vec<f64>
where
    S: System<DoubleDouble>,
    M: Scheme<DoubleDouble, S>,
{
    const PARTS: u64 = 4;
    let states: Vec<Vec<_>> = (0..6)
        .map(|halving| {
            let steps = steps << halving;
            let h = DoubleDouble::from(span) / DoubleDouble::from((PARTS * steps) as f64);
            let run = Integrator::new(system, scheme.clone(), start.clone(), h);
            let mut run = run.expect("a good start");
            (0..PARTS)
                .map(|_| run.advance(steps).expect("good steps").clone())
                .collect()
        })
        .collect();
    let errors: Vec<_> = (states.windows(2))
        .map(|pair| {
            (pair[0].iter().zip(&pair[1]))
                .map(|(coarse, fine)| difference(coarse, fine))
                .fold(0.0, f64::max)
        })
        .collect();
    errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).log2())
        .collect()
}

/// The distance of the mean of the last three of four slopes from the entry's order.
fn off_order<S, M>(system: &S, scheme: &M, start: &State<S::Vector>, span: f64, steps: u64) -> f64
where
    S: System<DoubleDouble>,
    M: Scheme<DoubleDouble, S>,
{
    let entry = scheme.entry();
    let slopes = slopes(system, scheme, start, span, steps);
    let (name, variant) = (entry.name, entry.variant);
    println!("{name} {variant} on {}: {slopes:.3?}", S::NAME);
    let mean = slopes[1..].iter().sum::<f64>() / (slopes.len() - 1) as f64;
    (mean - f64::from(entry.order)).abs()
}

/// The slope of the entry's order, within 0.1.
pub fn assert_order<S, M>(system: &S, scheme: &M, start: &State<S::Vector>, span: f64, steps: u64)
where
    S: System<DoubleDouble>,
    M: Scheme<DoubleDouble, S>,
{
    let off = off_order(system, scheme, start, span, steps);
    assert!(off <= 0.1, "{:?}: {off}", scheme.entry());
}

/// From coarse steps for schemes of high order.
struct Orders {
    missed: Vec<String>,
}

impl<S: Sample<DoubleDouble>> Visitor<DoubleDouble, S> for Orders {
    fn visit<M: Scheme<DoubleDouble, S>>(&mut self, scheme: M) {
        let steps = match scheme.entry().order {
            0..=4 => 32,
            5..=8 => 16,
            _ => 4,
        };
        let off = off_order(&S::sample(), &scheme, &S::begin(), 2.0, steps);
        // False for NaN.
        let meets = off <= 0.1;
        if !meets {
            self.missed.push(format!("{:?}: {off}", scheme.entry()));
        }
    }
}

#[test]
fn every_scheme_has_its_order() {
    let mut orders = Orders { missed: Vec::new() };
    everywhere::<DoubleDouble, _>(&mut orders);
    assert!(orders.missed.is_empty(), "{:#?}", orders.missed);
}

/// The form each scheme says it preserves, over three steps; the forms of two points are measured on the
/// carried values, at the root of the workspace.
struct Forms {
    missed: Vec<String>,
}

impl<S: Sample<Dual<f64>>> Visitor<Dual<f64>, S> for Forms {
    fn visit<M: Scheme<Dual<f64>, S>>(&mut self, scheme: M) {
        let entry = scheme.entry();
        let defect = defect::<f64>(&tangent(&S::sample(), &scheme, &S::begin(), 0.05, 3));
        println!(
            "{} {} on {}: {defect:.1e}",
            entry.name,
            entry.variant,
            S::NAME
        );
        let right = match entry.preserves {
            Form::OnePoint => defect <= 3e-13,
            // Of the observed state, whatever is carried.
            _ => defect > 1e-11,
        };
        if !right {
            self.missed.push(format!("{entry:?}: {defect:e}"));
        }
    }
}

#[test]
fn every_scheme_preserves_its_form() {
    let mut forms = Forms { missed: Vec::new() };
    everywhere::<Dual<f64>, _>(&mut forms);
    assert!(forms.missed.is_empty(), "{:#?}", forms.missed);
}

/// H = √(1 + p²) − cos q + q⁴/10.
#[test]
fn tables_have_their_order_where_neither_half_is_quadratic() {
    let mut orders = Orders { missed: Vec::new() };
    visit_exact::<DoubleDouble, Hand<Relativistic, 1>>(&mut orders);
    assert!(orders.missed.is_empty(), "{:#?}", orders.missed);
}

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
    fn control<M: Scheme<DoubleDouble, Hand<Relativistic, 1>>>(scheme: M) {
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
    fn end(scheme: impl Scheme<f64, Hand<HenonHeiles, 2>>) -> State<SVector<f64, 2>> {
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
pub fn on_34(scheme: impl Scheme<DoubleDouble, Hand<Paper34, 1>>, steps: u64) {
    let system = Hand(Paper34);
    let start = start(&system, &[-1.5], &[0.3]);
    assert_order(&system, &scheme, &start, 1.0, steps);
}

/// And on the double pendulum.
pub fn on_the_double_pendulum(
    scheme: impl Scheme<DoubleDouble, Hand<DoublePendulum, 2>>,
    steps: u64,
) {
    let system = Hand(DoublePendulum);
    let start = start(&system, &[0.8, -0.4], &[0.3, 0.2]);
    assert_order(&system, &scheme, &start, 1.0, steps);
}

#[test]
fn doubled_schemes_have_their_order() {
    on_34(Tao { omega: 10.0 }, 32);
    on_34(Yoshida6.of(Tao { omega: 3.0 }), 32);
    on_34(MidpointProjected::<Suzuki4>::default(), 16);
    on_34(MidpointProjected::<BlanesMoan6>::default(), 8);
    on_34(MidpointProjected::<SofroniouSpaletta10>::default(), 4);
    on_34(Semiexplicit::<Strang>::default(), 16);
    on_34(Semiexplicit::<BlanesMoan4>::default(), 16);
    on_34(Semiexplicit::<KahanLi8>::default(), 8);
    on_the_double_pendulum(Tao { omega: 10.0 }, 32);
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
fn drift_34<M: Scheme<f64, Hand<Paper34, 1>>>(scheme: M, h: f64) -> f64 {
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
    assert!((drift_34(Tao { omega: 20.0 }, 0.1) - 0.079).abs() <= 0.0005);
    assert!(drift_34(Tao { omega: 20.0 }, 0.01) <= 6.3e-4);
}

/// The tangent of the visible state after `steps` steps, by dual numbers over any scalar.
pub fn tangent<T, S, M>(
    system: &S,
    scheme: &M,
    start: &State<S::Vector>,
    h: f64,
    steps: u64,
) -> Vec<Vec<T>>
where
    T: Real,
    S: System<Dual<T>>,
    M: Scheme<Dual<T>, S>,
{
    let n = start.q.len();
    let column = |seed: usize| {
        let mut start = start.clone();
        let moved = if seed < n { &mut start.q } else { &mut start.p };
        moved.component_mut(seed % n).eps = T::one();
        let h = Dual::fixed(T::constant(h, 0.0));
        let run = Integrator::new(system, scheme.clone(), start, h);
        let mut run = run.expect("a good start");
        let end = run.advance(steps).expect("good steps");
        (end.q.components().chain(end.p.components()))
            .map(|x| x.eps)
            .collect()
    };
    (0..2 * n).map(column).collect()
}

/// The largest entry of MᵀJM − J over ‖M‖².
pub fn defect<T: Real>(columns: &[Vec<T>]) -> f64 {
    let n = columns.len() / 2;
    let (mut defect, mut size) = (0.0_f64, 0.0_f64);
    for (i, a) in columns.iter().enumerate() {
        for (j, b) in columns.iter().enumerate() {
            let mut sum = T::constant(f64::from(i8::from(i == j + n) - i8::from(j == i + n)), 0.0);
            for k in 0..n {
                sum += a[k] * b[k + n] - a[k + n] * b[k];
            }
            defect = defect.max(sum.magnitude());
            size = size.max(a[j].magnitude());
        }
    }
    defect / (size * size)
}

pub fn symplectic<M>(scheme: M)
where
    M: Scheme<Dual<f64>, Hand<Paper34, 1>> + Scheme<Dual<f64>, Hand<DoublePendulum, 2>>,
{
    let entry = scheme.entry();
    let system = Hand(Paper34);
    let of_34 = defect(&tangent(
        &system,
        &scheme,
        &start(&system, &[-3.0], &[0.5]),
        0.05,
        3,
    ));
    let system = Hand(DoublePendulum);
    let start = start(&system, &[0.8, -0.4], &[0.3, 0.2]);
    let of_pendulum = defect(&tangent(&system, &scheme, &start, 0.05, 3));
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
    fn slope<M: Scheme<Dual<DoubleDouble>, Hand<Paper34, 1>>>(scheme: M, h: f64) -> f64 {
        let system = Hand(Paper34);
        let start = start(&system, &[-1.5], &[0.3]);
        let of = |h: f64| defect(&tangent(&system, &scheme, &start, h, 1));
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
