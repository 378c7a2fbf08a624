//! The schemes and runs of `hamiltonian`.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

extern crate alloc;

mod error;
mod state;
mod system;
mod vector;

#[doc(hidden)]
pub mod private;

pub use error::Error;
pub use hamiltonian_lanes::{Lift, Mask, Real};
pub use state::{Gradient, Pair, Point, State};
pub use system::{
    Autonomous, Cyclic, Drift, Dynamics, Flow, Group, Kick, Observable, ObservableKind,
    QuadraticKinetic, Separable, System,
};
pub use vector::{IntoVector, Vector, shape};
