//! The schemes and runs of `hamiltonian`.
//!
//! Input: a [`System`], which the `hamiltonian!` macro implements (this crate knows nothing of
//! it), a [`State`] and a [`Scheme`]. Output: an [`Integrator`] and the results its observers make of
//! the run. Invariants: nothing allocates or dispatches inside a step; the bits of a trajectory
//! depend on the system, the scheme, the start and the step, and on nothing else.
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
//! The modules follow the data: vectors and states, the system at a state, what moves it (vector
//! fields and exact flows), one-step maps and the schemes that make them, the run and parts of its
//! steps, observers, saved runs; starts on a surface and other coordinates of a state.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

extern crate alloc;

mod lattice;
mod vector;

mod state;

mod system;
pub use system::gather;

mod exponential;
mod flow;
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

mod loops;

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
pub use checkpoint::{Checkpoint, Memory};
pub use derivatives::{WrongDerivative, check_derivatives};
pub use ensemble::{End, Ensemble, Ensembles, Lyapunov, Member, Record, Row, Status, Sweep};
#[cfg(feature = "std")]
pub use error::StoreError;
pub use error::{CheckpointError, Error, KnotError, ShardError, TableError};
pub use events::{Event, Events, Located};
pub use flow::{Flow, Nothing, Piece, Pieces, Sandwich, Scratch, Turn, VectorField};
pub use function::{Function, Grid, Spline};
pub use hamiltonian_lanes::{DoubleDouble, Dual, Lift, Mask, Real};
pub use integrator::{ErrorEstimate, Integrator, MapOf, Run, States};
pub use lattice::Lattice;
pub use map::{Cause, Clock, Either, Map, ScalarOf, Step};
pub use observe::{
    Deviation, EnergyDrift, Every, Monitor, Monitors, Observer, Unobserved, Verdict, View, Watch,
    every, watch,
};
pub use observed::{FieldObserved, Observed, ReadyObserved};
pub use output::Recorder;
pub use periodic::{Closing, PeriodicOrbit};
#[cfg(feature = "progress")]
pub use progress::Progress;
pub use push::{Both, Coupled, SubStep};
pub use scheme::{Entry, Form, Listed, Needs, OneStep, Scheme, Symmetric};
pub use shard::Shard;
pub use state::{Carried, Gradient, Pair, Plain, Point, State};
#[cfg(feature = "std")]
pub use store::{Attribute, ChunkData, Completeness, Layout, Rows, Store};
pub use system::gather::{Gather, InLanes, Kept};
pub use system::{
    Arithmetic, Autonomous, Cyclic, Dynamics, Exact, Group, Nystrom, Observable, ObservableKind,
    QuadraticKinetic, Separable, Split, System, Unforced,
};
pub use table::Table;
pub use tangent::{Tangent, monodromy, multipliers, symplectic_defect};
pub use times::{AtTimes, at_times};
pub use transformed::{FieldInNewTime, InNewTime, TimeTransformed, WithTime};
pub use vector::{IntoVector, Vector, shape};

/// The state of a system: `StateOf<Pendulum>`, `StateOf<Toda<8>, Dual<f64>>`.
pub type StateOf<S, T = f64> = State<<S as System<T>>::Vector>;

/// The names that a program needs to run systems.
///
/// Its traits are there without their names too: a type of yours may be called `System`, and
/// `energy` is still a method of it.
pub mod prelude {
    pub use crate::{Observer as _, System as _};

    pub use crate::schemes::{
        Aba104, Aba864, Aba1064, Adjoint, BlanesCasasEscorihuela8, BlanesCasasMurua8, BlanesMoan4,
        BlanesMoan6, Compensated, Composition, ConsecutiveSubTrajectories, Density,
        DiscreteGradient, Gauss, GaussNystrom, ImplicitMidpoint, IntersectingSubTrajectories,
        KahanLi6, KahanLi8, McLachlan8, MidpointProjected, Mixed, MomentumVariational, Paced,
        Pihajoki, Processed, Processed4, Processed6, RungeKutta4, Ruth3, Saba2, Saba3, Saba4,
        Semiexplicit, SofroniouSpaletta8, SofroniouSpaletta10, Srkn6b, Srkn11b, Srkn14a, Start,
        StormerVerlet, Strang, Suzuki4, SymplecticEuler, Tao, TransformedVerlet, TwoStepMidpoint,
        Variational, WisdomHolman3, WisdomHolman5, WisdomHolman7, WisdomHolman11, WisdomHolman17,
        Yoshida4, Yoshida6,
    };
    pub use crate::{
        AnyRun, Checkpoint, Closing, DoubleDouble, Dual, EnergyDrift, Ensemble, Ensembles, Error,
        Event, Events, Function, Gradient, Grid, Integrator, Lyapunov, Member, Monitors, Observer,
        PeriodicOrbit, Real, Recorder, Run, Shard, Spline, Split, State, StateOf, Status, Sweep,
        System, Tangent, TimeTransformed, at_times, every, monodromy, symplectic_defect, watch,
    };
}
