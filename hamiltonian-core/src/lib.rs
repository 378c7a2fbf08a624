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
//! The modules follow the data: vectors and states, the system at a state, what moves it (vector
//! fields and exact flows), one-step maps and the schemes that make them, the run and parts of its
//! steps, observers, saved runs; starts on a surface and other coordinates of a state.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

extern crate alloc;

mod lattice;
mod uneven;
mod vector;

mod state;

mod system;

mod domain;

mod exponential;
mod flow;
mod held;
mod kernel;
mod push;

mod map;

mod scheme;
pub mod schemes;

mod integrator;

mod events;
mod observe;
mod observed;
mod output;
#[cfg(feature = "plot")]
pub mod plot;
#[cfg(feature = "progress")]
mod progress;
mod root;
mod shard;
#[cfg(feature = "std")]
mod store;
mod table;
mod tangent;

mod periodic;
mod times;
mod transformed;

mod checkpoint;
mod resume;

mod any;

mod ensemble;

mod calls;
mod loops;
mod pairs;
mod slabs;

pub mod function;

pub mod start;

pub mod coordinates;

mod derivatives;

mod error;
mod failed;

mod reach;

#[doc(hidden)]
pub mod private;

pub use any::AnyRun;
pub use checkpoint::Checkpoint;
pub use ensemble::{
    End, Ensemble, Fused, Lyapunov, Member, Record, Rounding, Row, Status, Sweep, Unfused,
};
pub use error::Error;
pub use hamiltonian_lanes::{DoubleDouble, Dual, Real};
pub use integrator::{ErrorEstimate, Integrator, Run, States};
pub use lattice::Lattice;
pub use observe::{Observer, View};
pub use scheme::Scheme;
pub use shard::Shard;
pub use state::{Gradient, IntoStart, Plain, State};
pub use system::{
    Autonomous, Exact, Nystrom, QuadraticKinetic, Separable, Split, System, Unforced, VectorOf,
};
pub use table::Table;
pub use transformed::TimeTransformed;
pub use vector::{IntoVector, Vector, shape};

// Hidden, since the glob of the facade would put its pages among those of the library.
#[doc(hidden)]
pub use nalgebra;

/// Observers receive the states of a run; events are located between steps.
///
/// An [`Observer`] receives a [`View`] of the run after each step, or after each n-th step
/// ([`every`](observers::every)). [`watch`](observers::watch) makes an observer from a closure. A tuple of observers is
/// an observer.
pub mod observers {
    pub use crate::checkpoint::Memory;
    pub use crate::events::{Event, Events, Located};
    pub use crate::observe::{
        Deviation, EnergyDrift, Every, Monitor, Monitors, Unobserved, Verdict, Watch, every, watch,
    };
    pub use crate::output::Recorder;
    #[cfg(feature = "progress")]
    pub use crate::progress::Progress;
    pub use crate::times::{AtTimes, at_times};
}

/// The parts of [`Error`]: errors of saved runs, tables, stores, shards and the knots of splines.
pub mod errors {
    #[cfg(feature = "std")]
    pub use crate::error::StoreError;
    pub use crate::error::{CheckpointError, KnotError, ShardError, TableError};
}

/// Zarr stores of sweeps, written chunk by chunk.
#[cfg(feature = "std")]
pub mod stores {
    pub use crate::store::{Attribute, ChunkData, Completeness, Layout, Rows, Store};
}

/// Derivatives of the numerical map: Lyapunov exponents, Floquet multipliers, periodic orbits.
pub mod tangents {
    pub use crate::periodic::{Closing, OrbitSearch, PeriodicOrbit};
    pub use crate::tangent::{Tangent, megno, monodromy, multipliers, symplectic_defect};
}

/// The state of a system: `StateOf<Pendulum>`, `StateOf<Toda<8>, Dual<f64>>`.
pub type StateOf<S, T = f64> = State<VectorOf<S, T>>;

/// The names that a program needs to run systems.
///
/// It imports the methods of its traits also if a name is taken: in a program with a type `System` of its own,
/// `energy` is still a method of every definition.
pub mod prelude {
    pub use crate::{Observer as _, System as _};

    // The message of `Name::new(…)` for a system whose parameters all have defaults.
    #[doc(hidden)]
    pub use crate::private::EveryParameterHasADefault as _;

    pub use crate::function::{Function, Grid, Spline};
    pub use crate::observers::{
        EnergyDrift, Event, Events, Monitors, Recorder, at_times, every, watch,
    };
    pub use crate::schemes::{
        Aba104, Aba864, Aba1064, Adjoint, BlanesCasasEscorihuela8, BlanesCasasMurua8, BlanesMoan4,
        BlanesMoan6, CheapProcessed, CheapProcessed4, Compensated, Composition,
        ConsecutiveSubTrajectories, Density, DiscreteGradient, Gauss, GaussNystrom,
        ImplicitMidpoint, IntersectingSubTrajectories, KahanLi6, KahanLi8, McLachlan8,
        MidpointProjected, Mixed, MomentumVariational, Paced, Pihajoki, Processed, Processed4,
        Processed6, RungeKutta4, Ruth3, Saba2, Saba3, Saba4, Semiexplicit, SofroniouSpaletta8,
        SofroniouSpaletta10, Srkn6b, Srkn11b, Srkn14a, Start, StormerVerlet, Strang, Suzuki4,
        SymplecticEuler, Tao, TransformedVerlet, TwoStepMidpoint, Variational, WisdomHolman3,
        WisdomHolman5, WisdomHolman7, WisdomHolman11, WisdomHolman17, Yoshida4, Yoshida6,
    };
    pub use crate::tangents::{
        Closing, OrbitSearch, PeriodicOrbit, Tangent, megno, monodromy, symplectic_defect,
    };
    pub use crate::{
        AnyRun, Checkpoint, DoubleDouble, Dual, Ensemble, Error, Gradient, Integrator, Lyapunov,
        Member, Observer, Real, Run, Scheme, Shard, Split, State, StateOf, Status, Sweep, System,
        TimeTransformed,
    };

    #[cfg(feature = "progress")]
    pub use crate::observers::Progress;
}
