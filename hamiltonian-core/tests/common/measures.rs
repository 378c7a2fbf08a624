//! Measures of schemes: slopes of errors, and the defect of a form.

use super::difference;
use hamiltonian_core::VectorOf;
use hamiltonian_core::{DoubleDouble, Dual, Integrator, Real, Scheme, State, System, Vector};

/// The slopes between successive halvings of the step, from differences of successive results, with
/// the largest over `parts` times up to the span.
pub fn slopes<S, M>(
    system: &S,
    scheme: &M,
    start: &State<VectorOf<S, DoubleDouble>>,
    span: f64,
    steps: u64,
) -> Vec<f64>
where
    S: System,
    M: Scheme<S>,
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
pub fn off_order<S, M>(
    system: &S,
    scheme: &M,
    start: &State<VectorOf<S, DoubleDouble>>,
    span: f64,
    steps: u64,
) -> f64
where
    S: System,
    M: Scheme<S>,
{
    let entry = scheme.entry();
    let slopes = slopes(system, scheme, start, span, steps);
    let (name, variant) = (entry.name, entry.variant);
    println!(
        "{name} {variant} on {}: {slopes:.3?}",
        system.description().name
    );
    let mean = slopes[1..].iter().sum::<f64>() / (slopes.len() - 1) as f64;
    (mean - f64::from(entry.order)).abs()
}

/// The slope of the entry's order, within 0.1.
pub fn assert_order<S, M>(
    system: &S,
    scheme: &M,
    start: &State<VectorOf<S, DoubleDouble>>,
    span: f64,
    steps: u64,
) where
    S: System,
    M: Scheme<S>,
{
    let off = off_order(system, scheme, start, span, steps);
    assert!(off <= 0.1, "{:?}: {off}", scheme.entry());
}

/// The tangent of the visible state after `steps` steps, by dual numbers over any scalar.
pub fn tangent<T, S, M>(
    system: &S,
    scheme: &M,
    start: &State<VectorOf<S, Dual<T>>>,
    h: f64,
    steps: u64,
) -> Vec<Vec<T>>
where
    T: Real,
    S: System,
    M: Scheme<S>,
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
