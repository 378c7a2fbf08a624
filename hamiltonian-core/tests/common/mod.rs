//! Shared by the tests: systems written by hand, and states of them. What needs no system of
//! its own (order, forms, check values) is tested at the workspace root, on systems the macro
//! makes.

pub mod allocator;
pub mod chain;
pub mod four;
pub mod kepler;
pub mod measures;
pub mod pieces;
pub mod python;
pub mod random;
pub mod systems;
pub mod walk;

use hamiltonian_core::VectorOf;
use hamiltonian_core::{Real, State, System, Vector};

/// A start at t = 0.3 in any scalar.
pub fn start<T: Real, S: System>(system: &S, q: &[f64], p: &[f64]) -> State<VectorOf<S, T>> {
    let mut state = State {
        t: T::constant(0.3, 0.0),
        q: system.zeros(),
        p: system.zeros(),
    };
    for (i, (q, p)) in q.iter().zip(p).enumerate() {
        *state.q.component_mut(i) = T::constant(*q, 0.0);
        *state.p.component_mut(i) = T::constant(*p, 0.0);
    }
    state
}

/// The largest difference of any component.
pub fn difference<V: Vector>(a: &State<V>, b: &State<V>) -> f64 {
    a.q.distance(&b.q).max(a.p.distance(&b.p))
}
