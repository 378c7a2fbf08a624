//! Observers receive the states of a run; events are located between steps.
//!
//! Input: a [`View`](crate::View) of the run after each step, or after each n-th step ([`every`]). Output: what the
//! observer made of it, by [`Integrator::observer`](crate::Integrator::observer). [`watch`] makes an observer from a
//! closure. A tuple of observers is an observer. Observers change no bit of a run.

pub(crate) mod events;
pub(crate) mod observe;
pub(crate) mod output;
#[cfg(feature = "progress")]
pub(crate) mod progress;
pub(crate) mod root;
pub(crate) mod times;

pub use crate::results::checkpoint::Memory;
pub use events::{Event, Events, Located};
pub use observe::{
    Deviation, EnergyDrift, Every, Monitor, Monitors, Unobserved, Verdict, Watch, every, watch,
};
pub use output::Recorder;
#[cfg(feature = "progress")]
pub use progress::Progress;
pub use times::{AtTimes, at_times};
