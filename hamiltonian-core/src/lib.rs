//! The schemes and runs of `hamiltonian`.
//!
//! Input: a [`System`], which the `hamiltonian!` macro implements (this crate does not depend on the macro), a
//! [`State`] and a [`Scheme`]. Output: an [`Integrator`], and the results that observers compute from the run.
//! Invariants: nothing allocates or dispatches inside a step; the bits of a trajectory depend only on the
//! system, the scheme, the start and the step.
//!
//! ```
#![doc = include_str!("doc/oscillator.md")]
//!
//! let start = State::new([1.0], [0.0]);
//! let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 1e-3)?
//!     .observe(EnergyDrift::new());
//! run.advance_to(10.0)?;
//! assert_eq!(run.steps(), 10_000);
//! assert!(run.observer().max_relative() < 1e-6);
//! # Ok::<(), Error>(())
//! ```
//!
//! Systems come from the macro. By this crate alone, a potential that is known at points, and its slope by a dual
//! number:
//! ```
//! use hamiltonian_core::prelude::*;
//!
//! let knots: Vec<f64> = (0..=20).map(|i| f64::from(i) * 0.1).collect();
//! let values: Vec<f64> = knots.iter().map(|x| x.sin()).collect();
//! let potential = Spline::clamped(&knots, &values, [1.0, 2f64.cos()])?;
//! let there = potential.value([Dual::variable(0.73)]);
//! assert!((there.re - 0.73f64.sin()).abs() < 1e-6);
//! assert!((there.eps - 0.73f64.cos()).abs() < 1e-5);
//! # Ok::<(), hamiltonian_core::errors::KnotError>(())
//! ```
//!
//! The folders are layers, and each reads only those before it: [`errors`]; [`systems`], with vectors and states; `flows`,
//! what moves a state; `loops` over arrays; [`schemes`]; [`results`]; [`observers`]; `runs`; [`analysis`]; `ensembles`;
//! `private`, for emitted code. The page of each has its input and its output. The types of a run are at the root.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

extern crate alloc;

pub mod analysis;
mod ensembles;
pub mod errors;
mod flows;
mod loops;
pub mod observers;
pub mod results;
mod runs;
pub mod schemes;
pub mod systems;

#[doc(hidden)]
pub mod private;

pub use ensembles::{
    End, Ensemble, Fused, Lyapunov, Member, Record, Rounding, Row, Status, Sweep, Unfused,
};
pub use errors::Error;
pub use hamiltonian_lanes::{DoubleDouble, Dual, Real};
pub use observers::observe::{Observer, View};
pub use results::checkpoint::Checkpoint;
pub use results::shard::Shard;
pub use results::table::Table;
pub use runs::any::AnyRun;
pub use runs::integrator::{ErrorEstimate, Integrator, Run, States};
pub use schemes::scheme::Scheme;
pub use systems::lattice::Lattice;
pub use systems::rows::ByRow;
pub use systems::state::{Gradient, IntoStart, Plain, State};
pub use systems::system::{
    Autonomous, Exact, Nystrom, QuadraticKinetic, Separable, Split, System, Unforced, VectorOf,
};
pub use systems::transformed::TimeTransformed;
pub use systems::vector::{IntoVector, Vector, shape};

// Hidden, since the glob of the facade would put its pages among those of the library.
#[doc(hidden)]
pub use nalgebra;

/// The state of a system: `StateOf<Pendulum>`, `StateOf<Toda<8>, Dual<f64>>`.
pub type StateOf<S, T = f64> = State<VectorOf<S, T>>;

/// The names that most programs need to run systems: runs, ensembles, observers, and the schemes with which to start. All
/// other schemes are in [`schemes`].
///
/// It imports the methods of its traits also if a name is taken: in a program with a type `System` of its own,
/// `energy` is still a method of every definition.
pub mod prelude {
    pub use crate::{ByRow as _, Observer as _, System as _};

    // The message of `Name::new(…)` for a system whose parameters all have defaults.
    #[doc(hidden)]
    pub use crate::private::EveryParameterHasADefault as _;

    pub use crate::analysis::{
        Closing, OrbitSearch, PeriodicOrbit, Tangent, megno, symplectic_defect,
    };
    pub use crate::observers::{
        EnergyDrift, Event, Events, Monitors, Recorder, at_times, every, watch,
    };
    pub use crate::schemes::{
        Aba1064, BlanesMoan4, BlanesMoan6, Density, Gauss, GaussNystrom, ImplicitMidpoint,
        KahanLi8, Paced, RungeKutta4, Saba4, StormerVerlet, Strang, TransformedVerlet,
    };
    pub use crate::systems::function::{Function, Grid, Spline};
    pub use crate::{
        Checkpoint, DoubleDouble, Dual, Ensemble, Error, Integrator, Lyapunov, Member, Observer,
        Real, Run, Scheme, Separable, Shard, Split, State, StateOf, Sweep, System, TimeTransformed,
        Vector,
    };
    pub use hamiltonian_lanes::Mask;

    #[cfg(feature = "progress")]
    pub use crate::observers::Progress;
}
