//! Numbers without a type are `f64`: of states, of the coordinates that the macro emits, and of starts from velocities.
//!
//! Each call of `ceil` is an error (E0689) if the type is open.

use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::{IntoStart, System};

hamiltonian! {
    /// A pendulum.
    pub struct Pendulum { m = 1.0 }
    H(theta; p) = p^2/(2*m) - m*cos(theta)
}

hamiltonian! {
    /// A pendulum from its Lagrangian.
    pub struct Bob { l = 1.0 }
    L(a; v) = l*v^2/2 + cos(a)
}

hamiltonian! {
    /// A mass on a cart: coordinates of mixed shape.
    pub struct Cart { m = 1.0 }
    H(s, r[3]; w, p[3]) = w^2/(2*m) + norm_squared(p)/2 + s*r[0]
}

hamiltonian! {
    /// The same in other coordinates.
    pub struct Turned { m = 1.0 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/(2*m) - 1/hypot(x, y);
    coordinates polar(x, y)
}

hamiltonian! {
    /// Masses, whose number is set at run time.
    pub struct Chain { n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { (p[i]^2 + q[i]^2)/2 }
}

/// The time and the first coordinate of a run after no step, rounded up.
macro_rules! rounded {
    ($system:expr, $start:expr) => {{
        let run = Integrator::new(&$system, Gauss::<1>::default(), $start, 0.1).unwrap();
        (run.state().t.ceil(), run.state().q[0].ceil())
    }};
}

#[test]
fn states_have_numbers_of_type_f64() -> Result<(), Error> {
    let start = State::new([0.5], [0.0]).at(2.5);
    assert_eq!((start.t.ceil(), start.q[0].ceil()), (3.0, 1.0));
    assert_eq!(rounded!(Pendulum::default(), start), (3.0, 1.0));

    let start = Bob::default().state_from_velocity(1.5, [0.5], [0.0]);
    assert_eq!((start.t.ceil(), start.q[0].ceil()), (2.0, 1.0));
    assert_eq!(rounded!(Bob::default(), start), (2.0, 1.0));

    let start = State::new(
        CartVector::new(0.5, [1.5; 3]),
        CartVector::new(0.0, [0.0; 3]),
    );
    assert_eq!(
        (start.t.ceil(), start.q.s.ceil(), start.q.r[1].ceil()),
        (0.0, 1.0, 2.0)
    );
    let start = State { t: 0.5, ..start };
    assert_eq!((start.t.ceil(), start.q.s.ceil()), (1.0, 1.0));

    let turned = Turned::default();
    let start = turned.from_declared(&State::new([0.5, 0.0], [0.0, 1.0]));
    assert_eq!((start.t.ceil(), start.q[0].ceil()), (0.0, 1.0));
    assert_eq!(rounded!(turned, start), (0.0, 1.0));

    let chain = Chain::new(2)?;
    assert_eq!(
        rounded!(chain, State::new(vec![0.5; 2], vec![0.0; 2])),
        (0.0, 1.0)
    );

    let value = hamiltonian! { H(s, r[2]; w, p[2]) = w^2/2 + norm_squared(p)/2 + s*r[0] };
    let start = State::new(value.vector(0.5, [1.5; 2]), value.vector(0.0, [0.0; 2]));
    assert_eq!((start.t.ceil(), start.q.s.ceil()), (0.0, 1.0));
    Ok(())
}

/// The same over any scalar.
fn over<T: Real>(x: T) -> T {
    let zero = T::zero();
    let start = State::over(
        CartVector::over(x, [x; 3]),
        CartVector::over(zero, [zero; 3]),
    );
    let value = hamiltonian! { H(s, r[2]; w, p[2]) = w^2/2 + norm_squared(p)/2 + s*r[0] };
    start.q.r[0] + value.vector_over(x, [x; 2]).s
}

/// A run from a state of any system.
fn first<S: Separable>(system: &S, start: impl IntoStart<VectorOf<S>>) -> f64 {
    let run = Integrator::new(system, StormerVerlet::default(), start, 0.1).unwrap();
    System::energy(system, run.state())
}

#[test]
fn other_scalars_are_asked_for() {
    assert_eq!(over(Dual::variable(2.0)).eps, 2.0);
    let bob = Bob::default();
    let start =
        bob.state_from_velocity_over(Dual::fixed(0.0), [Dual::variable(0.5)], [Dual::fixed(0.0)]);
    assert_eq!(bob.energy(&start).eps, 0.5_f64.sin());
    assert_eq!(first(&Pendulum::default(), State::new([0.0], [0.0])), -1.0);
}
