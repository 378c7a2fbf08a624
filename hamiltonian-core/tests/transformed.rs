//! Another time: Kepler's problem in even steps of a monitor function, its form, and refused monitors.

use super::common::kepler::{InRadius, Kepler, in_radius, pericentre};
use super::common::measures::{assert_order, defect, tangent};
use super::common::systems::Hand;
use super::preserving::Close;
use hamiltonian_core::errors::StartError;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::*;
use hamiltonian_core::{
    DoubleDouble, Dual, Error, Integrator, Scheme, State, System, Vector,
    schemes::author::{Dynamics, VectorField, WithTime},
};

/// The largest |H + ½| of each tenth of a run.
fn tenths(scheme: impl Scheme<InRadius>, h: f64, steps: u64) -> Vec<f64> {
    let system = in_radius(false);
    let start = system.start(&pericentre(0.9)).expect("a good start");
    let mut run = Integrator::new(&system, scheme, start, h).expect("a good start");
    (0..10)
        .map(|_| {
            (0..steps / 10).fold(0.0_f64, |worst, _| {
                let state = system.declared(run.advance(1).expect("a good step"));
                worst.max((system.system.energy(&state) + 0.5).abs())
            })
        })
        .collect()
}

#[test]
fn variable_steps_do_not_drift_and_are_few() {
    const STEPS: u64 = 400;
    let heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    let periods = if heavy { 100_000 } else { 500 };
    let h = core::f64::consts::TAU / STEPS as f64;
    let errors = tenths(TransformedVerlet::default(), h, periods * STEPS);
    let largest = errors.iter().copied().fold(0.0, f64::max);
    println!("{periods} periods of {STEPS} steps: {errors:.4?}");
    assert!(largest <= 1.02 * errors[0], "{errors:?}");
    // Fixed steps, one gradient each too, have that error only where they are 15 times as many.
    let fixed = |steps: u64| {
        let (system, h) = (Hand(Kepler), core::f64::consts::TAU / steps as f64);
        let scheme = StormerVerlet::default();
        let mut run = Integrator::new(&system, scheme, pericentre(0.9), h).expect("a good start");
        (0..steps).fold(0.0_f64, |worst, _| {
            worst.max((system.energy(run.advance(1).expect("a good step")) + 0.5).abs())
        })
    };
    let (many, more) = (fixed(15 * STEPS), fixed(25 * STEPS));
    println!("fixed steps: {many:.4e}, {more:.4e}, here {largest:.4e}");
    assert!(
        many > largest && more < largest,
        "{many:e} {more:e} {largest:e}"
    );
}

/// One step satisfies its equations, with the derivatives of K.
#[test]
fn steps_satisfy_the_equations_of_k() {
    let (system, h) = (in_radius(false), 0.05);
    let start = system.start(&pericentre(0.6)).expect("a good start");
    let scheme = TransformedVerlet::default();
    let mut run = Integrator::new(&system, scheme, start.clone(), h).expect("a good start");
    let end = run.advance(1).expect("a good step").clone();
    let time: f64 = end.q.y[0] - start.q.y[0];
    let middle: SVector<f64, 2> = start.q.x + start.p.x * (0.5 * time);
    assert!((h * middle.norm() - time).abs() <= 1e-16);
    assert!((middle + end.p.x * (0.5 * time) - end.q.x).norm() <= 1e-15);
    let slope = |p: &WithTime<SVector<f64, 2>>| {
        let mut q = start.q.clone();
        q.x = middle;
        system
            .gradient(&State {
                t: 0.0,
                q,
                p: p.clone(),
            })
            .q
    };
    let mean = (slope(&start.p).x + slope(&end.p).x) * 0.5;
    assert!((start.p.x - mean * h - end.p.x).norm() <= 1e-15);
    assert_eq!(start.p.y, end.p.y);
}

#[test]
fn they_have_their_order() {
    let system = in_radius(false);
    let start = system
        .start(&pericentre::<DoubleDouble>(0.6))
        .expect("a good start");
    let verlet = TransformedVerlet::default();
    assert_order(&system, &verlet, &start, 2.0, 16);
    assert_order(&system, &KahanLi6.of(verlet), &start, 2.0, 8);
    // A monitor of momenta too, for schemes that ask for no structure.
    let system = in_radius(true);
    let start = system
        .start(&pericentre::<DoubleDouble>(0.6))
        .expect("a good start");
    assert_order(&system, &Gauss::<2>::default(), &start, 2.0, 16);
    assert_order(
        &system,
        &Semiexplicit::<Suzuki4>::default(),
        &start,
        2.0,
        16,
    );
}

#[test]
fn they_are_symplectic() {
    fn of(scheme: impl Scheme<InRadius>, with_momentum: bool) -> f64 {
        let system = in_radius(with_momentum);
        let start = system
            .start(&pericentre::<Dual<f64>>(0.6))
            .expect("a good start");
        let name = scheme.entry().name;
        let defect = defect::<f64>(&tangent(&system, &scheme, &start, 0.1, 3));
        println!("{name}: {defect:.1e}");
        defect
    }
    let verlet = TransformedVerlet::default();
    assert!(of(verlet, false) <= 3e-13);
    assert!(of(KahanLi6.of(verlet), false) <= 3e-13);
    assert!(of(Gauss::<2>::default(), true) <= 3e-13);
    assert!(of(Semiexplicit::<Strang>::default(), true) <= 3e-13);
    // The controls: no symplectic scheme, and steps that are chosen beside the system.
    assert!(of(RungeKutta4, false) > 1e-7);
    let scheme = Paced::new(StormerVerlet::default(), Close);
    let start = pericentre::<Dual<f64>>(0.6);
    let beside = defect::<f64>(&tangent(&Hand(Kepler), &scheme, &start, 0.05, 3));
    println!("Paced: {beside:.1e}");
    assert!(beside > 1e-4);
}

/// The second derivatives of K are those of its first.
#[test]
fn derivatives_of_k() {
    let system = in_radius(true);
    let mut start = system.start(&pericentre::<f64>(0.6)).expect("a good start");
    // Beside the shell, where all terms are there.
    start.p.y[0] += 0.25;
    start.q.x[1] += 0.125;
    let directions = [0.5, -0.25, 0.75, 0.125, 1.5, -0.5];
    let mut moved = State {
        t: Dual::fixed(0.0),
        q: System::zeros::<Dual<f64>>(&system),
        p: System::zeros::<Dual<f64>>(&system),
    };
    let (mut vq, mut vp) = (start.q.zeros_like(), start.p.zeros_like());
    for i in 0..3 {
        *moved.q.component_mut(i) = Dual::new(start.q.component(i), directions[i]);
        *moved.p.component_mut(i) = Dual::new(start.p.component(i), directions[i + 3]);
        *vq.component_mut(i) = directions[i];
        *vp.component_mut(i) = directions[i + 3];
    }
    let along = System::energy::<Dual<f64>>(&system, &moved).eps;
    let first = System::gradient::<f64>(&system, &start);
    let second = System::gradient::<Dual<f64>>(&system, &moved);
    let prepared = System::prepare::<f64>(&system);
    let (mut out_q, mut out_p) = (vq.zeros_like(), vp.zeros_like());
    prepared.hessian_vector(0.0, &start.q, &start.p, &vq, &vp, &mut out_q, &mut out_p);
    let mut field = (vq.zeros_like(), vp.zeros_like());
    (prepared.field(2.0)).add(0.0, &start.q, &start.p, &mut field.0, &mut field.1);
    let mut sum = 0.0;
    for i in 0..3 {
        sum += first.q.component(i) * directions[i] + first.p.component(i) * directions[i + 3];
        let apart = (out_q.component(i) - second.q.component(i).eps).abs()
            + (out_p.component(i) - second.p.component(i).eps).abs()
            + (field.0.component(i) - 2.0 * first.p.component(i)).abs()
            + (field.1.component(i) + 2.0 * first.q.component(i)).abs();
        assert!(apart <= 1e-13, "component {i}: {apart:e}");
    }
    assert!((sum - along).abs() <= 1e-14);
}

#[test]
fn what_is_no_monitor_is_refused() {
    let system = in_radius(false);
    let nowhere = State::new([0.0, 0.0], [0.0, 1.0]);
    let refused = system.start::<f64>(&nowhere).expect_err("g = 0");
    assert!(matches!(
        refused,
        Error::Start(StartError::Monitor { value: 0.0, .. })
    ));
    let system = in_radius(true);
    let mut off = system.start(&pericentre::<f64>(0.6)).expect("a good start");
    // At rest too, where ∂g/∂p is 0.
    let rest = (system.start(&State::new([1.0, 0.0], [0.0, 0.0]))).expect("a good start");
    let verlet = TransformedVerlet::default();
    let is_refused = |error: Option<Error>| matches!(error, Some(Error::Start(StartError::MonitorOfMomenta { scheme, .. })) if *scheme == *"TransformedVerlet");
    for start in [off.clone(), rest.clone()] {
        let alone = Integrator::new(&system, verlet, start.clone(), 0.1).err();
        assert!(is_refused(alone));
        let composed = Integrator::new(&system, KahanLi6.of(verlet), start, 0.1).err();
        assert!(is_refused(composed));
    }
    Integrator::new(&in_radius(false), verlet, rest, 0.1).expect("a monitor of coordinates");
    off.p.y[0] += 0.1;
    let refused =
        Integrator::new(&system, Gauss::<2>::default(), off, 0.1).expect_err("off the shell");
    assert!(
        matches!(&refused, Error::Start(StartError::Shell { momentum, .. }) if **momentum == *"p_t"),
        "{refused}"
    );
}

/// Errors call the time of a run by its name, and write large ones with an exponent.
#[test]
fn errors_name_the_time() {
    let system = in_radius(false);
    let start = system.start(&pericentre::<f64>(0.6)).expect("a good start");
    let scheme = Gauss::<2>::default();
    let mut run = Integrator::new(&system, scheme, start.clone(), 0.125).expect("a good start");
    let message = |error: Option<Error>| error.expect("it is refused").to_string();
    run.advance(2).expect("good steps");
    assert_eq!(
        message(run.advance_to(0.3).err()),
        "s = 0.3 is no whole number of steps ahead: the nearest times are 0.25 and 0.375; `advance_until` goes to any \
         time"
    );
    assert_eq!(
        message(run.advance_until(-1e200).err()),
        "s = -1e200 lies behind the run, which is at s = 0.25: a step of the other sign leads there"
    );
    let beyond = message(run.advance_until(1e200).err());
    assert!(
        beyond.starts_with("s = 1e200 cannot be reached"),
        "{beyond}"
    );
    let far = message(run.state_at(1e-7).err());
    assert!(far.starts_with("s = 1e-7 is more than one step"), "{far}");
    let mut run = Integrator::new(&system, scheme.with_max_iterations(1), start, 0.125)
        .expect("a good start");
    let unsolved = message(run.advance(1).err());
    assert!(
        unsolved.starts_with("step 1 from s = 0 was not solved"),
        "{unsolved}"
    );
}
