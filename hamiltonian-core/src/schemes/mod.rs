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

mod table;
pub mod tables;
mod zigzag;

pub mod collocation;

mod separable;
mod splittings;

mod extended;
mod trajectories;

mod iterate;
mod midpoint;
mod runge_kutta;

mod composition;

mod catalogue;

pub use catalogue::{Visitor, catalogue, visit_any, visit_separable, visit_split, visit_unforced};
pub use composition::{Adjoint, Composed, Composition, Inverted, InvertedWork};
pub use extended::{Copies, Cross, Crossed, Pihajoki};
pub use iterate::{Contraction, Outcome, iterate};
pub use midpoint::{ImplicitMidpoint, Midpoint, MidpointWork};
pub use runge_kutta::{Classical, ClassicalWork, RungeKutta4};
pub use separable::{StormerVerlet, SymplecticEuler};
pub use splittings::Strang;
pub use table::{Durations, Reversed, Table, Weight};
pub use trajectories::{
    ConsecutiveSubTrajectories, Interleaved, IntersectingSubTrajectories, Start, TwoStep,
    TwoStepMidpoint,
};
pub use zigzag::{Zigzag, ZigzagOf};
