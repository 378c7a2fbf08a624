//! Scalars and systems of the other tests.

#[path = "../common/chain.rs"]
pub mod chain;
#[path = "../common/four.rs"]
pub mod four;
#[path = "../common/kepler.rs"]
pub mod kepler;
#[path = "../common/systems.rs"]
pub mod systems;
#[path = "../common/walk.rs"]
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
