//! Members with forces, declared pieces, another time and variable steps are single runs, bit by bit.

use super::members::agrees;
use super::*;
use hamiltonian::Vector;
use hamiltonian::schemes::{Adaptive, Suzuki4};
use hamiltonian_core::VectorOf;

hamiltonian! {
    /// A pendulum in air and oil.
    pub struct Dragged { oil = 0.1, air = 0.2 }
    H(q; p) = p^2/2 - cos(q);
    force(q; p) = -oil*p - air*abs(p)*p
}

hamiltonian! {
    /// A pendulum pushed by a force that is affine in p.
    pub struct Pushed { gamma = 0.1 }
    H(q; p) = p^2/2 - cos(q);
    force(q; p) = -gamma*p + sin(2*q)/4
}

hamiltonian! {
    /// An oscillator and its perturbation.
    pub struct Perturbed { e = 0.1 }
    H(q; p) = (p^2 + q^2)/2 + e*q^4;
    split { Oscillator = (p^2 + q^2)/2; Perturbation = e*q^4 }
}

hamiltonian! {
    /// Kepler's problem, with the distance as a monitor.
    pub struct Kepler { mu = 1.0 }
    H(x, y; u, v) = (u^2 + v^2)/2 - mu/sqrt(x^2 + y^2);
    monitor r = sqrt(x^2 + y^2)
}

hamiltonian! {
    /// The same in another time.
    pub struct Slowed { mu = 1.0 }
    H(x, y; u, v) = (u^2 + v^2)/2 - mu/sqrt(x^2 + y^2);
    dt = sqrt(x^2 + y^2)*ds
}

/// Q = r^(−3/2).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Close;

impl<S: System> Density<S> for Close {
    #[inline(always)]
    fn rate<T: Real>(
        &self,
        _: T,
        q: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
        dq: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
    ) -> T {
        let (x, y) = (q.component(0), q.component(1));
        let (u, v) = (dq.component(0), dq.component(1));
        T::constant(-1.5, 0.0) * (x * u + y * v) / (x * x + y * y)
    }
}

fn swing(at: f64) -> State<hamiltonian::private::SVector<f64, 1>> {
    State::new([2.0 * at - 1.0], [0.7 - at])
}

fn kepler(member: Member) -> (Kepler, StateOf<Kepler>) {
    let at = part(member.index);
    let mu = 1.0 + 0.2 * at;
    (
        Kepler { mu },
        State::new([0.5 + at, 0.0], [0.1, 1.2 - 0.2 * at]),
    )
}

#[test]
fn members_with_forces() {
    let dragged = |member: Member| {
        let at = part(member.index);
        let (oil, air) = (0.3 * at, 0.2 - 0.1 * at);
        (Dragged { oil, air }, swing(at))
    };
    agrees(dragged, StormerVerlet::default());
    let pushed = |member: Member| {
        let at = part(member.index);
        (Pushed { gamma: 0.3 * at }, swing(at))
    };
    agrees(pushed, BlanesMoan4);
}

#[test]
fn members_with_declared_pieces() {
    let perturbed = |member: Member| {
        let at = part(member.index);
        (Perturbed { e: 0.2 * at }, swing(at))
    };
    agrees(perturbed, Saba4);
}

#[test]
fn members_in_another_time() {
    let slowed = |member: Member| {
        let at = part(member.index);
        let (Kepler { mu }, start) = kepler(member);
        let system = Slowed { mu };
        let start = system.from_declared(&start.at(at));
        (system, start)
    };
    agrees(slowed, ImplicitMidpoint::default());
    let transformed = |member: Member| {
        let (system, start) = kepler(member);
        let system = TimeTransformed::by(system, "r").expect("it is declared");
        let start = system
            .start(&start.at(part(member.index)))
            .expect("g is positive");
        (system, start)
    };
    agrees(transformed, TransformedVerlet::default());
}

#[test]
fn members_with_variable_steps() {
    // The first prepares each step, the second makes it at once.
    let verlet = Paced::new(StormerVerlet::default(), Close);
    let suzuki = Paced::new(Suzuki4, Close);
    agrees(kepler, verlet);
    agrees(kepler, suzuki);
}

#[test]
fn members_to_a_tolerance() {
    let scheme = Adaptive::new(GaussNystrom::<8>::default(), 1e-9);
    agrees(kepler, scheme);
}
