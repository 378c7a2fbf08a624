//! Forces: systems that lose energy, against closed forms, and the order of every scheme that takes
//! forces.

use crate::allocator::allocations;
use crate::common::order::slope;
use hamiltonian::prelude::*;
use hamiltonian::schemes::{Visitor, visit_any, visit_separable, visit_split};
use hamiltonian::{DoubleDouble, Scheme, Separable, Split, hamiltonian};

hamiltonian! {
    /// A damped oscillator.
    pub struct Damped { gamma = 0.3, omega = 1.2 }
    H = p^2/2 + omega^2*q^2/2;
    force(q; p) = -gamma*p
}

hamiltonian! {
    /// A pendulum with friction that is linear in the momentum.
    pub struct Linear { gamma = 0.4 }
    H = sqrt(1 + p^2) - cos(q);
    force(q; p) = -gamma*p
}

hamiltonian! {
    /// A pendulum in air.
    pub struct Air { c = 0.4 }
    H = p^2/2 - cos(q);
    force(q; p) = -c*abs(p)*p
}

hamiltonian! {
    /// A pendulum pushed by a force without a potential of its own in H.
    pub struct Pushed {}
    H(q; p; t) = sqrt(1 + p^2) - cos(q);
    force(q; p) = sin(2*t)*cos(q)
}

hamiltonian! {
    /// Friction that depends on time and place.
    pub struct Changing {}
    H(q; p; t) = (1 + sin(t)/2)*p^2/2 - cos(q)*(2 + cos(t));
    force(q; p) = -(1 + sin(3*t)/2)*(1 + q^2/4)*p + q/5
}

hamiltonian! {
    /// A chain whose bonds push two masses each, every mass with a friction of its own.
    pub struct Chain<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + (q[(i + 1) % N] - q[i])^4/4 };
    force(q; p) = -0.3*p
}

hamiltonian! {
    /// The same with a number of masses set at run time, and a mass each.
    pub struct Long { N: usize, m: [N] }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/(2*m[i]) + (q[(i + 1) % N] - q[i])^4/4 };
    force(q; p) = -0.3*p
}

type D = DoubleDouble;

/// The slope of every scheme against a run of order 4 with a step 64 times as small.
struct Slopes<S: System<D>> {
    system: S,
    start: State<S::Vector>,
    exact: State<S::Vector>,
    measured: usize,
}

const END: f64 = 1.0;

impl<S: System<D>> Slopes<S> {
    fn new(system: S, start: State<S::Vector>) -> Self {
        let h = D::from(END / 4096.0);
        let mut run = Integrator::new(&system, RungeKutta4, start.clone(), h).unwrap();
        let exact = run.advance(4096).unwrap().clone();
        Slopes {
            system,
            start,
            exact,
            measured: 0,
        }
    }
}

impl<S: System<D>> Visitor<D, S> for Slopes<S> {
    fn visit<M: Scheme<D, S>>(&mut self, scheme: M) {
        let entry = scheme.entry();
        let points: Vec<(f64, f64)> = [16_u64, 32, 64, 128]
            .into_iter()
            .map(|n| {
                let h = D::from(END / n as f64);
                let run = Integrator::new(&self.system, scheme.clone(), self.start.clone(), h);
                let mut run = run.unwrap();
                let end = run.advance(n).unwrap();
                (
                    h.to_f64(),
                    crate::common::reference::difference(end, &self.exact),
                )
            })
            .collect();
        let slope = slope(&points);
        assert!(
            (slope - f64::from(entry.order)).abs() < 0.15,
            "{} {} on {}: slope {slope}, {points:?}",
            entry.name,
            entry.variant,
            S::NAME
        );
        self.measured += 1;
    }
}

fn all<S>(mut slopes: Slopes<S>)
where
    S: Separable<D> + Split<D>,
{
    visit_any(&mut slopes);
    visit_separable(&mut slopes);
    visit_split(&mut slopes);
    assert!(slopes.measured >= 7);
}

fn at(q: f64, p: f64) -> State<hamiltonian::private::SVector<D, 1>> {
    State::new([D::from(q)], [D::from(p)])
}

#[test]
fn orders_with_forces() {
    all(Slopes::new(Linear::default(), at(0.9, 0.4)));
    all(Slopes::new(Air::default(), at(-0.5, 1.5)));
    all(Slopes::new(Pushed::default(), at(0.9, 0.4)));
    all(Slopes::new(Changing::default(), at(0.9, 0.4)));
    let numbers = |v: [f64; 4]| v.map(D::from);
    let (q, p) = ([0.3, -0.2, 0.9, 0.1], [0.4, 0.1, -0.5, 0.2]);
    all(Slopes::new(
        Chain::<4>::default(),
        State::new(numbers(q), numbers(p)),
    ));
}

/// q = e^(−γt/2) (cos ωt + γ/(2ω) sin ωt)
#[test]
fn damped_oscillator_in_closed_form() {
    let system = Damped::default();
    let exact = |t: f64| {
        let (g, w) = (
            system.gamma / 2.0,
            (system.omega.powi(2) - system.gamma.powi(2) / 4.0).sqrt(),
        );
        (-g * t).exp() * ((w * t).cos() + g / w * (w * t).sin())
    };
    let start = State::new([1.0], [0.0]);
    let fourth = Composition::yoshida(Strang);
    let mut run = Integrator::new(&system, fourth, start.clone(), 1e-3).unwrap();
    let end = run.advance_to(10.0).unwrap();
    assert!(
        (end.q[0] - exact(10.0)).abs() < 1e-11,
        "{}",
        end.q[0] - exact(10.0)
    );
    let mut run = Integrator::new(&system, ImplicitMidpoint::default(), start, 1e-3).unwrap();
    let end = run.advance_to(10.0).unwrap();
    assert!((end.q[0] - exact(10.0)).abs() < 1e-6);
}

/// Where V = 0 the kick alone is the exact flow of the friction: p e^(−γt), to rounding, in any step.
#[test]
fn friction_alone_is_exact() {
    hamiltonian! {
        /// A free particle with friction.
        pub struct Free { gamma = 0.7 }
        H = p^2/2;
        force(q; p) = -gamma*p
    }
    let mut run = Integrator::new(&Free::default(), Strang, State::new([0.0], [2.0]), 0.5).unwrap();
    let end = run.advance(8).unwrap();
    let exact = 2.0 * (-0.7_f64 * 4.0).exp();
    assert!(
        (end.p[0] - exact).abs() < 8.0 * f64::EPSILON * exact,
        "{}",
        end.p[0]
    );
}

#[test]
fn a_kick_with_friction_allocates_nothing() {
    let long = Long::new(3, vec![1.0, 2.0, 0.5]).unwrap();
    let start = State::new(vec![0.3, -0.2, 0.9], vec![0.4, 0.1, -0.5]);
    let mut run = Integrator::new(&long, Yoshida4, start, 0.01).unwrap();
    let count = allocations(|| {
        run.advance(3000).unwrap();
    });
    assert_eq!(count, 0);
}
