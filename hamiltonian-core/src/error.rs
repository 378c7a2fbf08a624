//! Errors of a run.
//!
//! Input: nothing. Output: [`Error`]. Invariant: a variant carries the values that went wrong, as
//! `f64` whatever the scalar of the run, so that the error is one type. The messages are in
//! `message`.

mod checkpoint;
mod knots;
mod message;
mod nearest;
mod shard;
#[cfg(feature = "std")]
mod store;
mod table;
mod words;

pub use checkpoint::CheckpointError;
pub use knots::KnotError;
pub use shard::ShardError;
#[cfg(feature = "std")]
pub use store::StoreError;
pub use table::TableError;

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::{self, Display, Formatter};
pub(crate) use words::Known;

/// An error of a run. Memory is allocated only when one happened.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The step is zero, NaN or infinite.
    Step {
        /// The step given.
        step: f64,
    },
    /// A vector, or an array of parameters, has the wrong number of components.
    Shape {
        /// The name of the coordinate, momentum or parameter.
        name: Box<str>,
        /// The number of components the system asks for.
        expected: usize,
        /// The number of components given.
        found: usize,
    },
    /// An axis of an array has the wrong extent.
    Extent {
        /// The name of the coordinate, momentum or parameter.
        name: Box<str>,
        /// The number of the axis, from 0 on.
        axis: usize,
        /// The extent the system asks for.
        expected: usize,
        /// The extent given.
        found: usize,
    },
    /// A list in nested lists has another length than its extent.
    Row {
        /// Its name with its place: `u[1]`.
        name: String,
        /// The extent.
        expected: usize,
        /// The number of elements given.
        found: usize,
    },
    /// An array of the sizes given does not fit into memory, or a product of sizes is larger than an `isize`.
    Memory {
        /// The name of the coordinate or parameter, or the product.
        name: Box<str>,
    },
    /// An index of the definition that leaves its range for the sizes given.
    Index {
        /// The index as it is written.
        index: &'static str,
        /// A value it takes.
        reached: i64,
        /// The extent it goes into; indices run from 0 to one less.
        extent: usize,
    },
    /// A sum of the definition that begins below 0 for the sizes given.
    Range {
        /// The range as it is written.
        range: &'static str,
        /// Its first value.
        first: i64,
    },
    /// A start has a NaN or an infinity in it.
    Start {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// Its time.
        time: f64,
        /// Its coordinates.
        q: Vec<f64>,
        /// Its momenta.
        p: Vec<f64>,
    },
    /// A start at which H or a first derivative of it is NaN or infinite.
    Values {
        /// `H`, or a derivative, `∂H/∂q[1]`.
        name: Box<str>,
        /// Over dual numbers, whether `value` is the derivative part: the value itself is finite.
        derivative: bool,
        /// Its value.
        value: f64,
        /// The first lane in which it is that, where the scalar has several.
        lane: Option<u32>,
        /// The first parameter that is NaN or infinite, `m[1] = NaN`, where there is one.
        parameter: Option<Box<str>>,
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The time of the start.
        time: f64,
        /// Its coordinates.
        q: Box<[f64]>,
        /// Its momenta.
        p: Box<[f64]>,
    },
    /// A parameter that is NaN.
    Parameter {
        /// Its name, with the place in an array: `m[1]`.
        name: String,
    },
    /// A mean rate over no steps.
    NoSteps,
    /// A start of a system in another time (`dt = g*ds`) that is not on the shell H = 0, where alone
    /// its orbits are those of the declared system.
    Shell {
        /// The momentum of time.
        momentum: Box<str>,
        /// Its value.
        given: f64,
        /// Its value on the shell.
        due: f64,
    },
    /// The monitor function g of another time, dt = g ds, is not positive.
    Monitor {
        /// Its value there.
        value: f64,
    },
    /// A monitor function of momenta, for a scheme that asks for one of coordinates alone.
    MonitorOfMomenta {
        /// The scheme.
        scheme: &'static str,
    },
    /// H jumps at times that do not depend on the state, and the scheme evaluates it at the ends of steps or outside of
    /// them, where the jumps may be.
    Jumps {
        /// The scheme.
        scheme: &'static str,
        /// The system.
        system: Box<str>,
    },
    /// A monitor that depends on time, where only q and p may occur.
    Timed {
        /// The monitor.
        name: Box<str>,
        /// The system.
        system: Box<str>,
    },
    /// A name that the system declares no monitor, invariant or event by.
    Unknown {
        /// The unknown name.
        name: String,
        /// The system.
        system: Box<str>,
        /// The names that the system declares.
        known: Box<[Box<str>]>,
    },
    /// A step led to a NaN or an infinity: a number grew beyond all bounds, the exact flow of a
    /// piece left its domain, or H is not defined at the end of the step. The run stays at the state before that step.
    NotFinite {
        /// The number of the step, counted from 1: the first whose end is not finite.
        step: u64,
        /// H at the end of the step, if only H is not finite there.
        energy: Option<f64>,
        /// The piece of H whose flow led there, where the scheme is a splitting.
        piece: Option<&'static str>,
        /// The first lane it happened in, where the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The time at the end of that step.
        time: f64,
        /// The coordinates there.
        q: Vec<f64>,
        /// The momenta there.
        p: Vec<f64>,
    },
    /// The equations of an implicit step were not solved. The run stays at the state before that
    /// step.
    Solve {
        /// The number of the step, counted from 1.
        step: u64,
        /// The first lane that was not solved, where the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The time at its beginning.
        time: f64,
        /// The last change of the iterate, in the sum norm.
        residual: f64,
        /// The number of iterations made.
        iterations: u32,
    },
    /// No stationary path of a variational integrator was found between the ends given.
    Stationary {
        /// The time at its beginning.
        time: f64,
        /// Its length.
        step: f64,
        /// The last change of the iterate, in the sum norm.
        residual: f64,
        /// The number of iterations made.
        iterations: u32,
    },
    /// A time that whole steps from the present one do not meet.
    OffGrid {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The target time.
        target: f64,
        /// The last reachable time that is not beyond it.
        before: f64,
        /// The first reachable time beyond it.
        after: f64,
    },
    /// A time that no number of steps leads to: NaN, infinite, or 2⁵³ steps ahead and more.
    Unreachable {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The target time.
        target: f64,
    },
    /// A time that lies behind the run.
    Behind {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The target time.
        target: f64,
        /// The present time.
        now: f64,
    },
    /// A new state of a run, at another time than the run.
    OtherTime {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The time of the state.
        given: f64,
        /// The present time of the run.
        now: f64,
    },
    /// No number of steps is known to lead to a time.
    Uneven,
    /// A time more than one step from the present one.
    Far {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: Box<str>,
        /// The target time.
        target: f64,
        /// One step back from the present time.
        from: f64,
        /// One step on.
        to: f64,
    },
    /// An event that a run cannot locate.
    Event {
        /// Its name.
        name: String,
        /// Why it cannot, and a remedy.
        reason: String,
    },
    /// An error of one member of an ensemble.
    Member {
        /// Its index.
        index: usize,
        /// Its error.
        error: Box<Error>,
    },
    /// An ensemble or a sweep of no members.
    NoMembers,
    /// A sweep whose members have no end.
    NoEnd,
    /// Members that no common number of steps leads to one time.
    Apart {
        /// What differs between them.
        reason: &'static str,
    },
    /// A member with run-time sizes, or functions as parameters, other than those of the first.
    OtherSizes {
        /// The system.
        system: Box<str>,
    },
    /// The error of a member before its ensemble was saved.
    Before {
        /// Its message.
        message: String,
    },
    /// A sweep was cancelled.
    Cancelled {
        /// The number of members that were done.
        done: usize,
        /// The number of members to be done.
        of: usize,
    },
    /// A closure panicked.
    Panicked {
        /// The message of the panic.
        message: String,
    },
    /// A saved run that cannot be read, or does not fit.
    Checkpoint(CheckpointError),
    /// A column that there is not, or a row that does not fit.
    Table(TableError),
    /// Knots that no spline passes through.
    Knots(KnotError),
    /// A part of a sweep that does not exist, or cannot be found out.
    Shard(ShardError),
    /// A store that cannot be written or read, or is that of another sweep.
    #[cfg(feature = "std")]
    Store(StoreError),
    /// A file or another writer failed.
    #[cfg(feature = "std")]
    Io {
        /// The kind of the failure.
        kind: std::io::ErrorKind,
        /// The system's message.
        message: String,
    },
    /// An index of a component that there is not.
    Component {
        /// The index given.
        index: usize,
        /// Their number.
        count: usize,
    },
    /// No deviation, or more of them than there are coordinates and momenta.
    Deviations {
        /// The number of coordinates and momenta together.
        most: usize,
        /// The number of deviations.
        found: usize,
    },
    /// An index of an observable that there is not.
    Observable {
        /// The index given.
        index: usize,
        /// Their number.
        count: usize,
    },
    /// No periodic orbit was found near a guess.
    NoPeriodicOrbit {
        /// The largest difference after a period, or distance from the section or the energy.
        gap: f64,
        /// The period of the best start.
        period: f64,
    },
    /// The search for a periodic orbit ended at a point, an equilibrium, or at an orbit much narrower than the guess.
    PointOrbit {
        /// The largest difference of a component between it and the guess.
        distance: f64,
    },
    /// The periodic orbit that was found is far from the guess.
    FarOrbit {
        /// The largest difference of a component between its start and the guess.
        distance: f64,
        /// The distance in units of the width of the guessed orbit.
        widths: f64,
        /// Its period.
        period: f64,
    },
    /// Signs of coordinates and momenta that are no symmetry which turns time round.
    Symmetry {
        /// The change of H at a point of the guess; `None` if the signs themselves are wrong.
        change: Option<f64>,
    },
    /// No value of a momentum, on the chosen branch, gives the required energy.
    NoMomentum {
        /// The name of the momentum.
        name: Box<str>,
        /// Its flat index.
        index: usize,
        /// The required energy.
        energy: f64,
        /// The value of H nearest to it that was found; at a turning point the minimum of H.
        reached: f64,
        /// The momentum there.
        at: f64,
    },
    /// No value of a coordinate was found where an event is 0.
    NoCrossing {
        /// The name of the event.
        event: Box<str>,
        /// The name of the coordinate.
        name: Box<str>,
        /// Its flat index.
        index: usize,
        /// The coordinate of the guess.
        from: f64,
        /// The event there.
        value: f64,
    },
    /// Masses of bodies whose partial sums m_0 + … + m_i are not all positive and finite.
    Masses {
        /// The last body of the sum.
        body: usize,
        /// The sum.
        sum: f64,
    },
}

impl core::error::Error for Error {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Checkpoint(error) => Some(error),
            Self::Table(error) => Some(error),
            Self::Knots(error) => Some(error),
            Self::Shard(error) => Some(error),
            #[cfg(feature = "std")]
            Self::Store(error) => Some(error),
            _ => None,
        }
    }
}

#[cfg(feature = "std")]
impl From<std::io::Error> for Error {
    /// The kind and the message, which are what two errors are compared by.
    fn from(error: std::io::Error) -> Self {
        Error::Io {
            kind: error.kind(),
            message: alloc::format!("{error}"),
        }
    }
}

/// The message, because that is what `fn main() -> Result<(), Error>` shows.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        Display::fmt(self, f)
    }
}
