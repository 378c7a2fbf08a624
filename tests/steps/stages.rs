//! Stages in the lanes of one trajectory: the same bits as stage by stage, on every CPU, whatever a
//! scheme meets; and the same errors.

use crate::allocator::allocations;
use crate::common::bits::LEVEL;
use hamiltonian::VectorOf;
use hamiltonian::errors::StepError;
use hamiltonian::lanes::Cpu;
use hamiltonian::prelude::*;
use hamiltonian::schemes::{MomentumVariational, Variational, Yoshida4};
use hamiltonian::{Checkpoint, Dual, Run, Scheme};
use std::sync::PoisonError;

hamiltonian! {
    /// (34).
    pub struct NonSeparable {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1)
}

hamiltonian! {
    /// Two coupled, driven pendulums in air, with a matrix of masses.
    pub struct Driven { k = 0.3, c = 0.05, m: [2] = [1.0, 2.5] }
    H(q[2]; p[2]; t) = sum(i in 0..2) { p[i]^2/(2*m[i]) - cos(q[i])*(1 + sin(t)/4) }
        + k*(q[0] - q[1])^2/2;
    force(q[2]; p[2]) = [-c*p[0]*abs(p[0]), -c*p[1]]
}

hamiltonian! {
    /// A chain with masses and an anharmonic force between neighbours; its length is set at run time.
    pub struct Chain { n: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + q[i]^2/2 }
        + sum(i in 0..n) { (q[i] - q[(i + 1) % n])^4/4 }
}

hamiltonian! {
    /// A pendulum driven by its potential.
    pub struct Swing { a = 0.2 }
    H(q; p; t) = p^2/2 - cos(q)*(1 + a*sin(2*t))
}

hamiltonian! {
    /// A stiff spring that is not quite linear.
    pub struct Stiff { omega = 100.0 }
    H(q; p) = p^2/2 + omega^2*(q^2/2 + q^4/10)
}

hamiltonian! {
    /// Kepler's problem, with monitors of its time.
    pub struct Planet { mu = 1.0 }
    H(x, y; u, v) = (u^2 + v^2)/2 - mu/sqrt(x^2 + y^2);
    monitor radius = sqrt(x^2 + y^2);
    monitor area = x^2 + y^2
}

/// The run after some steps, and between two of them, in lanes and without.
fn same_bits<S, M>(system: &S, scheme: M, start: &State<VectorOf<S>>, h: f64) -> State<VectorOf<S>>
where
    S: System,
    M: Scheme<S>,
{
    let name = scheme.entry();
    let run = |lanes| {
        let run = Integrator::new(system, scheme.clone(), start.clone(), h).unwrap();
        let mut run = run.with_lanes(lanes);
        run.advance(40).unwrap();
        let between = run.state_at(run.time() + 0.3 * h).unwrap();
        run.advance(3).unwrap();
        (run.state().clone(), between)
    };
    let alone = run(false);
    let _hidden = LEVEL.write().unwrap_or_else(PoisonError::into_inner);
    for cpu in Cpu::available() {
        Cpu::limit_to(cpu);
        let beside = run(true);
        Cpu::limit_to(Cpu::Avx512);
        assert_eq!(
            beside,
            alone,
            "{name} on {}, up to {cpu:?}",
            system.description().name
        );
    }
    alone.0
}

/// Calls [`same_bits`] for each scheme.
macro_rules! all_same {
    ($system:expr, $start:expr, $h:expr; $($scheme:expr),* $(,)?) => {
        $(same_bits($system, $scheme, $start, $h);)*
    };
}

#[test]
fn lanes_change_no_bits() {
    let start = State::new([-1.2], [0.4]);
    all_same!(&NonSeparable {}, &start, 0.2;
        Gauss::<4>::default(), Gauss::<5>::default(), Gauss::<6>::default(), Gauss::<7>::default(),
        Gauss::<8>::default(), Gauss::<9>::default(), Gauss::<12>::default(), Gauss::<16>::default(),
        Variational::<4, 4>::gauss(), Variational::<5, 5>::lobatto(),
        MomentumVariational::<4>::default(), MomentumVariational::<7>::default(),
        Yoshida4.of(Gauss::<4>::default()), Gauss::<3>::default(), Variational::<3, 4>::lobatto(),
    );
    let start = State::new([0.7, -0.4], [0.1, 0.9]).at(0.5);
    all_same!(&Driven::default(), &start, 0.3;
        Gauss::<4>::default(), Gauss::<7>::default(), Gauss::<8>::default(), Gauss::<10>::default(),
        Variational::<5, 5>::lobatto(), MomentumVariational::<5>::default(),
    );
    let start = State::new([0.7], [0.3]).at(-1.0);
    all_same!(&Swing::default(), &start, 0.5;
        GaussNystrom::<4>::default(), GaussNystrom::<5>::default(), GaussNystrom::<8>::default(),
        GaussNystrom::<11>::default(), GaussNystrom::<2>::default(),
    );
    for n in [1, 3, 10] {
        let masses: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
        let chain = Chain::new(n, masses).unwrap();
        let place = |i: usize| (0.3 * i as f64).sin();
        let start = State::new((0..n).map(place).collect::<Vec<_>>(), vec![0.2; n]);
        all_same!(&chain, &start, 0.25;
            Gauss::<4>::default(), Gauss::<8>::default(),
            GaussNystrom::<6>::default(), GaussNystrom::<8>::default(),
        );
    }
}

/// A system in another time is made of two, each of which is gathered.
#[test]
fn lanes_change_no_bits_in_another_time() {
    let declared = State::new([0.1, 0.0], [0.0, 19.0_f64.sqrt()]);
    for monitor in ["radius", "area"] {
        let system = TimeTransformed::by(Planet::default(), monitor).unwrap();
        let start = system.start(&declared).unwrap();
        all_same!(&system, &start, 0.1;
            Gauss::<4>::default(), Gauss::<6>::default(), Gauss::<8>::default(),
            Gauss::<9>::default(), MomentumVariational::<5>::default(),
        );
    }
    // H itself is a monitor that depends on momenta.
    let system = TimeTransformed::new(NonSeparable {}, NonSeparable {});
    let start = system.start(&State::new([-1.2], [0.4])).unwrap();
    all_same!(&system, &start, 0.1; Gauss::<4>::default(), Gauss::<8>::default());
    let system = TimeTransformed::by(Planet::default(), "radius").unwrap();
    // Fused runs tell that the stages lie in lanes: without lanes nothing fuses.
    {
        let _shown = LEVEL.read().unwrap_or_else(PoisonError::into_inner);
        let end = |fused, lanes| {
            let start = system.start(&declared).unwrap();
            let run = Integrator::new(&system, Gauss::<8>::default(), start, 0.1).unwrap();
            let mut run = if fused { run.fused() } else { run }.with_lanes(lanes);
            run.advance(200).unwrap();
            run.state().q.x[0]
        };
        let plain = end(false, true);
        let change = (end(true, true) - plain).abs();
        let has_lanes = matches!(Cpu::best(), Cpu::Avx2 | Cpu::Avx512 | Cpu::Neon);
        assert_eq!(change > 0.0, has_lanes, "{change:e}");
        assert!(change < 1e-11, "{change:e}");
        assert_eq!(end(true, false), plain);
    }
    // A run of dual numbers, and one that is saved.
    let end = |lanes| {
        let start = State::over(
            [Dual::variable(0.1), Dual::fixed(0.0)],
            [Dual::fixed(0.0), Dual::fixed(19.0_f64.sqrt())],
        );
        let start = system.start(&start).unwrap();
        let run = Integrator::new(&system, Gauss::<8>::default(), start, Dual::fixed(0.1));
        let mut run = run.unwrap().with_lanes(lanes);
        run.advance(30).unwrap();
        run.state().q.x[0]
    };
    let (beside, alone) = (end(true), end(false));
    assert_eq!((beside.re, beside.eps), (alone.re, alone.eps));
    let start = system.start(&declared).unwrap();
    let mut whole = Integrator::new(&system, Gauss::<8>::default(), start, 0.1).unwrap();
    whole.advance(20).unwrap();
    let saved = Checkpoint::from_bytes(&whole.checkpoint().to_bytes()).unwrap();
    let again = Integrator::resume(&system, Gauss::<8>::default(), saved).unwrap();
    let mut again = again.with_lanes(false);
    again.advance(20).unwrap();
    whole.advance(20).unwrap();
    assert_eq!(again.state(), whole.state());
}

/// Newton's method solves steps longer than the fastest motion, which no fixed point does. (Lobatto's pairs
/// are not stable for such steps.)
#[test]
fn steps_that_need_newtons_method_have_the_same_bits() {
    let (stiff, start) = (Stiff::default(), State::new([0.01], [0.0]));
    all_same!(&stiff, &start, 0.2;
        Gauss::<4>::default(), Gauss::<6>::default(), Gauss::<8>::default(),
    );
    // Without Newton's method the step fails, with the same error.
    let fails = |lanes| {
        let scheme = GaussNystrom::<8>::default();
        let run = Integrator::new(&stiff, scheme, start.clone(), 0.2).unwrap();
        run.with_lanes(lanes).advance(100).unwrap_err()
    };
    assert!(matches!(
        fails(true),
        Error::Step(StepError::Unsolved { step: 1, .. })
    ));
    // By text, since a residual that is NaN is not itself.
    assert_eq!(fails(true).to_string(), fails(false).to_string());
}

/// A run of dual numbers is one in lanes of dual numbers.
#[test]
fn tangents_have_the_same_bits() {
    let run = |lanes| {
        let start = State::over([Dual::variable(-1.2)], [Dual::fixed(0.4)]);
        let (scheme, h) = (Gauss::<8>::default(), Dual::fixed(0.2));
        let run = Integrator::new(&NonSeparable {}, scheme, start, h).unwrap();
        let mut run = run.with_lanes(lanes);
        run.advance(30).unwrap();
        let State { q, p, .. } = run.state().clone();
        [q[0].re, q[0].eps, p[0].re, p[0].eps]
    };
    assert_eq!(run(true), run(false));
    let start = State::new([-1.2], [0.4]);
    let single = same_bits(&NonSeparable {}, Gauss::<8>::default(), &start, 0.2);
    let mut dual = Integrator::new(&NonSeparable {}, Gauss::<8>::default(), start, 0.2).unwrap();
    dual.advance(30).unwrap();
    assert_eq!(run(true)[0], dual.state().q[0]);
    assert!(single.q[0].is_finite());
}

/// Fused products are others, by rounding alone; a saved run remembers the choice.
#[test]
fn fused_runs_differ_by_rounding_and_are_saved_as_such() {
    let _shown = LEVEL.read().unwrap_or_else(PoisonError::into_inner);
    type Fused = Run<NonSeparable, Gauss<8>>;
    let new = || -> Fused {
        let start = State::new([-1.2], [0.4]);
        Integrator::new(&NonSeparable {}, Gauss::default(), start, 0.2).unwrap()
    };
    let (mut plain, mut fused) = (new(), new().fused());
    plain.advance(200).unwrap();
    fused.advance(200).unwrap();
    let change = (plain.state().q[0] - fused.state().q[0]).abs();
    assert!(change < 1e-12, "{change:e}");
    if cfg!(target_arch = "x86_64") && Cpu::best() < Cpu::Avx2 {
        assert_eq!(change, 0.0);
    }
    let saved = Checkpoint::from_bytes(&fused.checkpoint().to_bytes()).unwrap();
    let mut again: Fused = Integrator::resume(&NonSeparable {}, Gauss::default(), saved).unwrap();
    again.advance(200).unwrap();
    fused.advance(200).unwrap();
    assert_eq!(again.state(), fused.state());
    // Without lanes nothing fuses.
    let (mut alone, mut plain) = (new().fused().with_lanes(false), new());
    alone.advance(200).unwrap();
    plain.advance(200).unwrap();
    assert_eq!(alone.state(), plain.state());
}

#[test]
fn steps_in_lanes_do_not_allocate() {
    let _shown = LEVEL.read().unwrap_or_else(PoisonError::into_inner);
    let chain = Chain::new(5, vec![1.0; 5]).unwrap();
    let start = State::new(vec![0.3; 5], vec![0.1; 5]);
    let mut first = Integrator::new(&chain, Gauss::<8>::default(), start.clone(), 0.2).unwrap();
    let mut second = Integrator::new(&chain, GaussNystrom::<8>::default(), start, 0.1).unwrap();
    let planet = TimeTransformed::by(Planet::default(), "radius").unwrap();
    let start = State::new([0.1, 0.0], [0.0, 19.0_f64.sqrt()]);
    let start = planet.start(&start).unwrap();
    let mut third = Integrator::new(&planet, Gauss::<8>::default(), start, 0.1).unwrap();
    let warm = allocations(|| {
        first.advance(1).unwrap();
        second.advance(1).unwrap();
        third.advance(1).unwrap();
    });
    assert!(warm > 0, "memory for lanes");
    let count = allocations(|| {
        for _ in 0..20 {
            first.advance(1).unwrap();
            second.advance(1).unwrap();
            third.advance(1).unwrap();
        }
        first.advance(3000).unwrap();
        second.advance(3000).unwrap();
        third.advance(3000).unwrap();
    });
    assert_eq!(count, 0);
}
