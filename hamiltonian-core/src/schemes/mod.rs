//! The schemes, each with its equation, order, coefficients and source, and the list of them.
//!
//! | scheme | equations | order | asks for | preserves | evaluations a step |
//! |---|---|---|---|---|---|
//! | [`StormerVerlet`] | (27) | 2 | `Separable` | dq∧dp | 1 kick, 1 drift |
//! | [`SymplecticEuler`] | | 1 | `Separable` | dq∧dp | 1 kick, 1 drift |
//! | [`Pihajoki`] | (29), (30) | 2 | | dq∧dp + dq̃∧dp̃ of the copies | 2 gradients |
//! | [`TwoStepMidpoint`] | (25) | 2 | | dq_a∧dp_b + dq_b∧dp_a | 1 gradient |
//! | [`ConsecutiveSubTrajectories`] | (26) | 2 | | dq_a∧dp_b + dq_b∧dp_a | 2 gradients, **time advances by 2Δt** |
//! | [`IntersectingSubTrajectories`] | (33) | 2 | | dq_a∧dp_b + dq_b∧dp_a | 2 gradients |
//! | [`ImplicitMidpoint`] | | 2 | | dq∧dp | 1 gradient an iteration |
//! | [`RungeKutta4`] | | 4 | | nothing | 4 gradients |
//!
//! "Asks for" is a trait bound: a scheme on a system without the structure does not compile.
//! Equation numbers are those of "Developing an explicit Hamiltonian variational integrator".
//!
//! A new scheme is a type with its [`Listed`](crate::Listed) entry and its
//! [`Scheme`](crate::Scheme) implementation — for a splitting into two pieces, a [`Table`] — and
//! one line in `catalogue.rs`; the tests then measure its order and the form it preserves.

mod splitting;
pub mod tables;

pub mod collocation;

mod separable;

mod extended;
mod trajectories;

mod midpoint;
mod runge_kutta;

mod catalogue;

pub use catalogue::{Visitor, catalogue, visit_any, visit_separable};
pub use extended::{Doubled, Pihajoki};
pub use midpoint::{ImplicitMidpoint, Midpoint};
pub use runge_kutta::{Classical, RungeKutta4};
pub use separable::{Alternation, StormerVerlet, SymplecticEuler};
pub use splitting::{Drifting, Flowing, Kicking, Piece, Splitting, Table, Weight};
pub use trajectories::{
    ConsecutiveSubTrajectories, Interleaved, IntersectingSubTrajectories, Start, TwoStep,
    TwoStepMidpoint,
};
