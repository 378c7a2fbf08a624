//! Energies over many steps: what rounding makes of those of implicit schemes is a random walk.
//!
//! Input: Gauss's schemes and their kin on autonomous systems. Output: the change of the mean of H from
//! block to block. Invariant: the sum of these changes is that of independent ones, or at least below a
//! bound that a coefficient with a wrong last place exceeds: the steps of such a method are not symplectic,
//! and it drifts.

use crate::common::systems::{Hand, HenonHeiles, Paper34, Pendulum, pendulum as swings};
use hamiltonian_core::VectorOf;
use hamiltonian_core::schemes::*;
use hamiltonian_core::{Integrator, QuadraticKinetic, Scheme, State, System};

/// Blocks of a run, and samples of H in a block.
const BLOCKS: u64 = 100;
const SAMPLES: u64 = 101;

/// A drift in units of H and ε for each step that is not found: iterating until nothing changes leaves as much.
const FOUND: f64 = 1e-3;

/// Runs, and compares the change of H with a random walk.
fn walks<S, M>(system: &S, size: f64, scheme: M, start: &State<VectorOf<S>>, h: f64)
where
    S: System,
    M: Scheme<S>,
{
    let entry = scheme.entry();
    let heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    // Samples as far apart as a number without common factors with a period.
    let stride = if heavy { 991 } else { 19 };
    let mut run = Integrator::new(system, scheme, start.clone(), h).expect("a good start");
    let first = system.energy(run.state());
    let means: Vec<f64> = (0..BLOCKS)
        .map(|_| {
            let mut sum = 0.0;
            for _ in 0..SAMPLES {
                let state = run.advance(stride).expect("good steps");
                sum += system.energy(state) - first;
            }
            sum / SAMPLES as f64
        })
        .collect();
    let changes: Vec<f64> = means.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let count = changes.len() as f64;
    let total: f64 = changes.iter().sum();
    let square = |change: &f64| (change - total / count).powi(2);
    let deviation = (changes.iter().map(square).sum::<f64>() / (count - 1.0)).sqrt();
    let steps = count * (SAMPLES * stride) as f64;
    println!(
        "{} {} on {}, h = {h}: {total:.1e} in {steps:.0e} steps, {:.1} deviations",
        entry.name,
        entry.variant,
        system.description().name,
        total / (deviation * count.sqrt())
    );
    let walked = 5.0 * deviation * count.sqrt();
    let bound = walked + FOUND * f64::EPSILON * size * steps;
    assert!(total.abs() <= bound, "{total:e} beyond {bound:e}");
}

impl QuadraticKinetic for Hand<Pendulum, 1> {}

fn pendulum(scheme: impl Scheme<Hand<Pendulum, 1>>, h: f64) {
    let system = Hand(Pendulum {
        m: 1.0,
        l: 1.0,
        g: 1.0,
        from_bottom: false,
    });
    walks(&system, 1.0, scheme, &State::new([1.5], [0.0]), h);
}

fn henon_heiles(scheme: impl Scheme<Hand<HenonHeiles, 2>>, h: f64) {
    let start = State::new([0.12, 0.23], [0.31, -0.17]);
    walks(&Hand(HenonHeiles), 0.1, scheme, &start, h);
}

fn paper_34(scheme: impl Scheme<Hand<Paper34, 1>>, h: f64) {
    walks(&Hand(Paper34), 5.0, scheme, &State::new([-3.0], [0.0]), h);
}

/// Steps that are short decimal fractions too: products with them are biased.
#[test]
fn energies_of_nystrom_forms_walk_at_random() {
    henon_heiles(GaussNystrom::<1>::default(), 0.01);
    henon_heiles(GaussNystrom::<2>::default(), 0.02);
    henon_heiles(GaussNystrom::<3>::default(), 0.05);
    henon_heiles(GaussNystrom::<4>::default(), 0.1);
    henon_heiles(GaussNystrom::<5>::default(), 0.25);
    henon_heiles(GaussNystrom::<6>::default(), 0.3);
    henon_heiles(GaussNystrom::<7>::default(), 0.5);
    henon_heiles(GaussNystrom::<8>::default(), 0.8);
    pendulum(GaussNystrom::<5>::default(), 0.3);
    pendulum(GaussNystrom::<8>::default(), 0.8);
}

#[test]
fn energies_of_gauss_walk_at_random() {
    paper_34(Gauss::<1>::default(), 0.0005);
    paper_34(Gauss::<2>::default(), 0.002);
    paper_34(Gauss::<3>::default(), 0.01);
    paper_34(Gauss::<4>::default(), 0.02);
    paper_34(Gauss::<5>::default(), 0.04);
    paper_34(Gauss::<6>::default(), 0.05);
    paper_34(Gauss::<7>::default(), 0.06);
    paper_34(Gauss::<8>::default(), 0.1);
    henon_heiles(Gauss::<8>::default(), 0.5);
}

#[test]
fn energies_of_variational_schemes_walk_at_random() {
    paper_34(Variational::<4, 4>::gauss(), 0.02);
    paper_34(Variational::<5, 5>::lobatto(), 0.03);
    paper_34(Variational::<3, 4>::lobatto(), 0.02);
    paper_34(MomentumVariational::<5>::default(), 0.03);
}

/// The largest |ΔH| of each tenth of a run.
fn tenths<S: System>(
    system: &S,
    scheme: impl Scheme<S>,
    start: State<VectorOf<S>>,
    h: f64,
    steps: u64,
) -> Vec<f64> {
    let energy = system.energy(&start);
    let mut run = Integrator::new(system, scheme, start, h).expect("a good start");
    (0..10)
        .map(|_| {
            (0..steps / 10).fold(0.0_f64, |worst, _| {
                let state = run.advance(1).expect("a good step");
                worst.max((system.energy(state) - energy).abs())
            })
        })
        .collect()
}

/// The error of H in every tenth of a long run is that in the first, to 2 per cent.
#[test]
fn symplectic_schemes_do_not_drift() {
    let heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    let steps = if heavy { 10_000_000 } else { 100_000 };
    fn spread(name: &str, tenths: &[f64]) -> f64 {
        let spread = (tenths.iter())
            .map(|worst| (worst / tenths[0] - 1.0).abs())
            .fold(0.0, f64::max);
        println!(
            "{name}: |ΔH| {:.3e}, tenths differ by {spread:.1e}",
            tenths[0]
        );
        spread
    }
    let of_pendulum = |scheme: StormerVerlet| {
        let start = State::new([std::f64::consts::FRAC_PI_4], [0.0]);
        tenths(&swings(true), scheme, start, 0.1, steps)
    };
    assert!(spread("Verlet", &of_pendulum(StormerVerlet::default())) <= 0.02);
    fn of_34(scheme: impl Scheme<Hand<Paper34, 1>>, steps: u64) -> f64 {
        let name = format!("{scheme:?}");
        let start = State::new([-3.0], [0.0]);
        spread(&name, &tenths(&Hand(Paper34), scheme, start, 0.1, steps))
    }
    assert!(of_34(Gauss::<2>::default(), steps) <= 0.02);
    assert!(of_34(Variational::<2, 2>::lobatto(), steps) <= 0.02);
    assert!(of_34(Variational::<1, 2>::lobatto(), steps) <= 0.02);
    assert!(of_34(Semiexplicit::<Strang>::default(), steps) <= 0.02);
    // Negative control: it loses H, all of it in the long run.
    assert!(of_34(RungeKutta4, steps) > 0.1);
}
