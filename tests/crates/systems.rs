//! Every construct in a crate of its own: compiled under each edition with every lint denied.

#![deny(
    warnings,
    missing_docs,
    missing_debug_implementations,
    unused_qualifications
)]
#![deny(
    unreachable_pub,
    unused_results,
    unnameable_types,
    single_use_lifetimes
)]
#![deny(clippy::all, clippy::pedantic)]
#![forbid(unsafe_code)]

use mechanics::prelude::*;
use mechanics::{Real, hamiltonian};

/// Several in one module, with attributes, derives and configuration.
pub mod several {
    use super::hamiltonian;

    hamiltonian! {
        /// A pendulum.
        #[derive(PartialEq, Copy)]
        #[max_ops = 40]
        pub struct Pendulum {
            /// Mass of the bob.
            m = 1.0,
            l = 10.0,
            g,
        }
        H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta);
        monitor height = l*(1 - cos(theta))
    }

    hamiltonian! {
        #[cfg(all())]
        pub(crate) struct Inner { k = 1.0 }
        H = p^2/2 + k*q^2/2
    }

    hamiltonian! {
        #[cfg(any())]
        pub struct Absent { k = 1.0 }
        H = p^2/2 + k*q^2/2
    }

    hamiltonian! {
        #[allow(dead_code)]
        struct Private {}
        H = p^2/2 + q^4/4
    }

    /// Only if it is there once can this compile.
    #[derive(Debug, Clone, Copy)]
    pub struct Absent;
}

hamiltonian! {
    /// A driven oscillator.
    pub struct Driven { a = 0.1, omega = 1.0 }
    let U(r) = r^2/2 + r^4/4;
    H(q; p; t) = p^2/2 + U(q) - a*q*cos(omega*t);
    event crossing = q
}

hamiltonian! {
    /// Equation (34): not separable.
    pub struct Coupled {}
    H = 0.5*(q^2 + 1)*(p^2 + 1);
    invariant energy_itself = H
}

hamiltonian! {
    /// A lattice of particles.
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    invariant total_momentum = sum(i in 0..N) { p[i] }
}

hamiltonian! {
    /// Bodies whose number is set at run time.
    pub struct Gravity { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }
}

hamiltonian! {
    /// Groups of different shape and a matrix.
    pub struct Mixed { w: [3][3] }
    H(x, r[3]; u, s[3]) = u^2/2 + x^2/2 + norm_squared(s)/2 + dot(r, w*r)/2
}

hamiltonian! {
    /// From a Lagrangian.
    pub struct DoublePendulum { m1 = 1.0, m2 = 1.0, l1 = 1.0, l2 = 1.0, g = 9.81 }
    L(a, b; va, vb) = (m1 + m2)*l1^2*va^2/2 + m2*l2^2*vb^2/2 + m2*l1*l2*va*vb*cos(a - b)
        + (m1 + m2)*g*l1*cos(a) + m2*g*l2*cos(b)
}

fn well<T: Real>(x: T) -> T {
    x * x
}

fn slope<T: Real>(x: T) -> T {
    x + x
}

hamiltonian! {
    /// With a function in Rust and a force.
    pub struct Well {}
    fn f(x) = well, (slope);
    H = p^2/2 + if q > 0 { f(q) } else { -q };
    force(q; p) = -0.1*p
}

/// Definitions inside of a function, as an item and as a value.
#[must_use]
pub fn inside() -> f64 {
    hamiltonian! {
        struct Local { a = 1.0 }
        H = p^2/2 + a*q^2/2
    }
    let (m, k) = (1.0, 4);
    let value = hamiltonian! { H(x; p_x) = p_x^2/(2*m) + k*x^2/2 };
    let state = State::new([1.0], [0.5]);
    let inner = several::Inner::default();
    Local::default().energy(&state) + value.energy(&state) + inner.energy(&state)
}

/// One of each runs.
///
/// # Errors
/// If a run does.
pub fn run() -> Result<f64, Error> {
    let start = || State::new([0.5], [0.0]);
    let pendulum = several::Pendulum::new(9.81);
    let mut swing = Integrator::new(&pendulum, StormerVerlet::default(), start(), 1e-3)?;
    let _ = swing.advance(10)?;
    let mut coupled = Integrator::new(
        &Coupled::default(),
        ImplicitMidpoint::default(),
        start(),
        1e-3,
    )?;
    let _ = coupled.advance(10)?;
    Ok(swing.state().q[0] + coupled.state().q[0])
}
