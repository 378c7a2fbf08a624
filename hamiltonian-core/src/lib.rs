//! The schemes and runs of `hamiltonian`.
//!
//! Input: a [`System`], which the `hamiltonian!` macro implements (this crate knows nothing of
//! it), a [`State`] and a [`Scheme`]. Output: an [`Integrator`] and what its observers make of
//! the run. Invariants: nothing allocates or dispatches inside a step; the bits of a trajectory
//! depend on the system, the scheme, the start and the step, and on nothing else.
//!
//! ```
#![doc = include_str!("doc/oscillator.md")]
//! use hamiltonian_core::prelude::*;
//!
//! let start = State::new([1.0], [0.0]);
//! let mut run = Integrator::new(&Oscillator, StormerVerlet::default(), start, 1e-3)?
//!     .observe(EnergyDrift::new());
//! run.advance_to(10.0)?;
//! assert_eq!(run.steps(), 10_000);
//! assert!(run.observer().max_relative() < 1e-6);
//! # Ok::<(), hamiltonian_core::Error>(())
//! ```
//!
//! The modules follow the data: vectors and states, the system at a state, the scheme made for
//! it, the run, what is seen of the run; starts on a surface and other coordinates of a state.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

extern crate alloc;

mod vector;

mod state;

mod system;

mod scheme;
pub mod schemes;

mod integrator;

mod observe;
mod output;

pub mod start;

pub mod coordinates;

mod error;

mod reach;

#[doc(hidden)]
pub mod private;

pub use error::Error;
pub use hamiltonian_lanes::{DoubleDouble, Dual, Lift, Mask, Real};
pub use integrator::{Integrator, Run, States};
pub use observe::{
    Deviation, EnergyDrift, Every, Monitor, Monitors, Observer, View, Watch, every, watch,
};
pub use output::Recorder;
pub use scheme::{Clock, Copies, Entry, Form, Listed, Needs, Scheme, Stepper, Unsolved};
pub use state::{Gradient, Pair, Point, State};
pub use system::{
    Autonomous, Cyclic, Drift, Dynamics, Flow, Group, Kick, Observable, ObservableKind,
    QuadraticKinetic, Separable, System,
};
pub use vector::{IntoVector, Vector, shape};

/// The linear algebra that vectors are stored in.
pub use nalgebra;

/// The state of a system: `StateOf<Pendulum>`, `StateOf<Toda<8>, Dual<f64>>`.
pub type StateOf<S, T = f64> = State<<S as System<T>>::Vector>;

/// What a program that runs systems names.
///
/// Its traits are there without their names too: a type of yours may be called `System`, and
/// `energy` is still a method of it.
pub mod prelude {
    pub use crate::{Observer as _, System as _};

    pub use crate::schemes::{
        ConsecutiveSubTrajectories, ImplicitMidpoint, IntersectingSubTrajectories, Pihajoki,
        RungeKutta4, Start, StormerVerlet, SymplecticEuler, TwoStepMidpoint,
    };
    pub use crate::{
        EnergyDrift, Error, Gradient, Integrator, Monitors, Observer, Recorder, Run, State, System,
        every, watch,
    };
}
