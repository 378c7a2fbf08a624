//! Lanes: four runs in one scalar are four lone runs, whatever becomes of each.

use crate::common::four::Four;
use crate::common::systems::*;
use hamiltonian_core::errors::StepError;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::Coupled;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::{
    Adjoint, Composition, ConsecutiveSubTrajectories, IntersectingSubTrajectories, Pihajoki,
    SymplecticEuler, TwoStepMidpoint,
};
use hamiltonian_core::{
    Real, Scheme, Vector,
    schemes::author::{Clock, Flow, Map, Point, Scratch, Step, VectorField},
};

/// (34) from these, and the Hénon–Heiles system.
const STARTS: [[f64; 4]; 2] = [[0.4, -1.1, 0.05, 0.8], [0.3, 0.1, -0.02, -0.5]];

fn lanes<const N: usize>(q: [[f64; 4]; N], p: [[f64; 4]; N]) -> State<SVector<Four, N>> {
    State {
        t: Four([0.0; 4]),
        q: SVector::from(q.map(Four)),
        p: SVector::from(p.map(Four)),
    }
}

/// Lane `k` alone.
fn lone<const N: usize>(state: &State<SVector<Four, N>>, k: usize) -> State<SVector<f64, N>> {
    State {
        t: state.t.0[k],
        q: state.q.map(|x| x.0[k]),
        p: state.p.map(|x| x.0[k]),
    }
}

/// Lane by lane the bits of four lone runs; with one lane dead, those of the other three.
fn check<H, M, const N: usize>(
    system: &Hand<H, N>,
    scheme: &M,
    start: &State<SVector<Four, N>>,
    h: f64,
) where
    H: Formula<N>,
    M: Scheme<Hand<H, N>>,
{
    let name = scheme.entry().name;
    let mut run = Integrator::new(system, scheme.clone(), start.clone(), Four([h; 4])).unwrap();
    let end = run.advance(700).unwrap();
    let alone = |k: usize| {
        let mut run = Integrator::new(system, scheme.clone(), lone(start, k), h).unwrap();
        run.advance(700).unwrap().clone()
    };
    for k in 0..4 {
        assert_eq!(lone(end, k), alone(k), "{name}, lane {k}");
    }
    // A run refuses a start that is not finite; a map does not look.
    let prepared = System::prepare::<Four>(system);
    let mut dead = start.clone();
    dead.q[0].0[2] = f64::NAN;
    let mut carried = Scheme::start(scheme, &prepared, &dead, Four([h; 4]));
    let map = Scheme::prepare(scheme, &prepared, Step::of(Four([h; 4])));
    let mut work = Scratch::like(&carried);
    let clock = Clock::new(Four([0.0; 4]), run.duration());
    map.run(clock, 0, 700, &mut carried, &mut work);
    map.close(clock.at(700), &mut carried, &mut work);
    let point = hamiltonian_core::schemes::author::Carried::point(&carried);
    let end = State {
        t: clock.at(700),
        q: point.q,
        p: point.p,
    };
    for k in [0, 1, 3] {
        assert_eq!(
            lone(&end, k),
            alone(k),
            "{name}, lane {k} beside a dead one"
        );
    }
    assert!(!lone(&end, 2).q.is_finite(), "{name}: the dead lane lives");
}

/// Helpers for both scalars.
macro_rules! both_scalars {
    ($system:expr, $start:expr, $($scheme:expr),+ $(,)?) => {$(
        check($system, &$scheme, $start, 0.01);
    )+};
}

#[test]
fn lanes_are_lone_runs() {
    let start = lanes([STARTS[0]], [STARTS[1]]);
    both_scalars!(
        &Hand(Paper34),
        &start,
        ImplicitMidpoint::default(),
        Adjoint(RungeKutta4),
        RungeKutta4,
        Composition::yoshida(ImplicitMidpoint::default()),
        Pihajoki::MomentumFirst,
        TwoStepMidpoint::default(),
        ConsecutiveSubTrajectories::default(),
        IntersectingSubTrajectories::default(),
    );
    let start = lanes(
        [STARTS[0].map(|x| 0.2 * x), STARTS[1]],
        [STARTS[1], [0.1; 4]],
    );
    both_scalars!(
        &Hand(HenonHeiles),
        &start,
        Strang,
        SymplecticEuler::KickDrift,
        Composition::yoshida(StormerVerlet::DriftKickDrift),
        Adjoint(SymplecticEuler::KickDrift),
        ImplicitMidpoint::default(),
    );
}

/// A solve that fails in one lane says so of that one, and leaves the others' bits as they are.
#[test]
fn a_solve_fails_in_its_lane_alone() {
    let scheme = ImplicitMidpoint::default().with_max_iterations(40);
    let start = lanes([[0.4, 9.0, 0.05, 0.8]], [[0.3, 5.0, -0.02, -0.5]]);
    let step = Four([0.05; 4]);
    let mut run = Integrator::new(&Hand(Paper34), scheme, start.clone(), step).unwrap();
    match run.advance(5).unwrap_err() {
        Error::Step(StepError::Unsolved {
            step: 1,
            lane: Some(1),
            ..
        }) => {}
        other => panic!("{other:?}"),
    }
    let prepared = System::prepare::<Four>(&Hand(Paper34));
    let map = Scheme::<Hand<Paper34, 1>>::prepare(&scheme, &prepared, Step::of(step));
    let mut carried = Scheme::<Hand<Paper34, 1>>::start(&scheme, &prepared, &start, step);
    let mut work = Scratch::like(&carried);
    map.step(start.t, step, &mut carried, &mut work);
    for k in 0..4 {
        let mut alone = Integrator::new(&Hand(Paper34), scheme, lone(&start, k), 0.05).unwrap();
        let found = carried.x.q[0].0[k];
        match alone.advance(1) {
            Ok(end) => assert_eq!(end.q[0].to_bits(), found.to_bits(), "lane {k}"),
            Err(_) => assert!(k == 1 && found.is_nan(), "lane {k}: {found}"),
        }
    }
}

/// c·(A·p + b) with A = −γ + ω J, or c·A·p.
#[derive(Debug, Clone)]
struct Turning<T> {
    c: T,
    gamma: T,
    omega: T,
    b: T,
}

impl<T: Real> VectorField<SVector<T, 2>> for Turning<T> {
    fn add(
        &self,
        _: T,
        _: &SVector<T, 2>,
        p: &SVector<T, 2>,
        _: &mut SVector<T, 2>,
        into: &mut SVector<T, 2>,
    ) {
        into[0] += self.c * (self.omega * p[1] - self.gamma * p[0] + self.b);
        into[1] -= self.c * (self.omega * p[0] + self.gamma * p[1]);
    }
}

fn turned<T: Real>([gamma, omega, p]: [T; 3]) -> SVector<T, 2> {
    let zero = T::zero();
    let linear = Turning {
        c: T::constant(0.7, 0.0),
        gamma,
        omega,
        b: zero,
    };
    let field = Turning {
        b: T::one(),
        ..linear.clone()
    };
    let mut point = Point {
        q: SVector::from([zero; 2]),
        p: SVector::from([p, zero]),
    };
    let mut work = Scratch::like(&point);
    Coupled { field, linear }.apply(zero, &mut point, &mut work);
    point.p
}

/// Momenta that push each other: a lane that needs 300 parts of the duration, one that stands still and
/// one that is no number are each what they are alone.
#[test]
fn momenta_push_each_other_in_their_lane_alone() {
    let lanes = [
        [0.1, 0.3, 1.0],
        [5.0, 900.0, -2.0],
        [0.0, 0.0, 0.5],
        [0.1, f64::NAN, 1.0],
    ];
    let found = turned([0, 1, 2].map(|k| Four(lanes.map(|lane| lane[k]))));
    for (k, lane) in lanes.into_iter().enumerate() {
        let alone = turned(lane);
        for i in 0..2 {
            assert_eq!(
                found[i].0[k].to_bits(),
                alone[i].to_bits(),
                "lane {k}, p[{i}]"
            );
        }
        assert_eq!(alone.iter().all(|p| p.is_nan()), k == 3);
    }
}
