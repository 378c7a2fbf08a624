//! Errors of a run.
//!
//! Input: nothing. Output: [`Error`]. Invariant: a variant carries the values that went wrong, as
//! `f64` whatever the scalar of the run, so that the error is one type.

mod knots;
mod nearest;
mod shard;
#[cfg(feature = "std")]
mod store;
mod table;
mod words;

pub use knots::KnotError;
pub use shard::ShardError;
#[cfg(feature = "std")]
pub use store::StoreError;
pub use table::TableError;

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
pub(crate) use words::Known;
use words::{Lane, Number, Numbers, Part, Remedy, Within};

/// An error of a run. Memory is allocated only when one happened.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The step is zero, NaN or infinite.
    #[error("a step must be finite and not zero, found {}", Number(*.step))]
    Step {
        /// The step given.
        step: f64,
    },
    /// A vector, or an array of parameters, has the wrong number of components.
    #[error("`{name}` must have {expected} components, found {found}")]
    Shape {
        /// The name of the coordinate, momentum or parameter.
        name: &'static str,
        /// The number of components the system asks for.
        expected: usize,
        /// The number of components given.
        found: usize,
    },
    /// An axis of an array has the wrong extent.
    #[error("axis {axis} of `{name}` must have the extent {expected}, found {found}")]
    Extent {
        /// The name of the coordinate, momentum or parameter.
        name: &'static str,
        /// The number of the axis, from 0 on.
        axis: usize,
        /// The extent the system asks for.
        expected: usize,
        /// The extent given.
        found: usize,
    },
    /// A list in nested lists has another length than its extent.
    #[error("`{name}` must have {expected} elements, found {found}")]
    Row {
        /// Its name with its place: `u[1]`.
        name: String,
        /// The extent.
        expected: usize,
        /// The number of elements given.
        found: usize,
    },
    /// An array of the sizes given does not fit into memory.
    #[error("`{name}` does not fit into memory: the sizes are too large")]
    Memory {
        /// The name of the coordinate or parameter.
        name: &'static str,
    },
    /// An index of the definition that leaves its range for the sizes given.
    #[error("`{index}` reaches {reached}, but the extent is {extent}: the sizes do not fit")]
    Index {
        /// The index as it is written.
        index: &'static str,
        /// A value it takes.
        reached: i64,
        /// The extent it goes into; indices run from 0 to one less.
        extent: usize,
    },
    /// A sum of the definition that begins below 0 for the sizes given.
    #[error("`{range}` begins at {first}, but ranges begin at 0 or above: the sizes do not fit")]
    Range {
        /// The range as it is written.
        range: &'static str,
        /// Its first value.
        first: i64,
    },
    /// A start has a NaN or an infinity in it.
    #[error("the start is not finite: {clock} = {}, q = {}, p = {}", Number(*.time), Numbers(.q), Numbers(.p))]
    Start {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: &'static str,
        /// Its time.
        time: f64,
        /// Its coordinates.
        q: Vec<f64>,
        /// Its momenta.
        p: Vec<f64>,
    },
    /// A start at which H or a first derivative of it is NaN or infinite.
    #[error(
        "{}{name} is {}{} at the start {clock} = {}, q = {}, p = {}: {}",
        Part(*.derivative), Number(*.value), Lane(*.lane), Number(*.time), Numbers(.q), Numbers(.p),
        Remedy(.parameter, *.derivative)
    )]
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
        clock: &'static str,
        /// The time of the start.
        time: f64,
        /// Its coordinates.
        q: Box<[f64]>,
        /// Its momenta.
        p: Box<[f64]>,
    },
    /// A parameter that is NaN.
    #[error("the parameter `{name}` is NaN, and must be a number")]
    Parameter {
        /// Its name, with the place in an array: `m[1]`.
        name: String,
    },
    /// Mean rates over no steps are asked for.
    #[error(
        "indicators of chaos are means over steps: the number of steps must be at least 1, found 0"
    )]
    NoSteps,
    /// A start of a system in another time (`dt = g*ds`) that is not on the shell H = 0, where alone
    /// its orbits are those of the declared system.
    #[error(
        "the start is not on the shell H = 0: `{momentum}` is {} and must be {}; the methods \
         `on_shell` and `from_declared` set it",
        Number(*.given), Number(*.due)
    )]
    Shell {
        /// The momentum of time.
        momentum: &'static str,
        /// Its value.
        given: f64,
        /// Its value on the shell.
        due: f64,
    },
    /// The monitor function g of another time, dt = g ds, is not positive.
    #[error("the monitor function is {} at the start, and must be positive", Number(*.value))]
    Monitor {
        /// Its value there.
        value: f64,
    },
    /// A monitor function of momenta, for a scheme that asks for one of coordinates alone.
    #[error(
        "the monitor function depends on momenta, and `{scheme}` asks for one of coordinates alone: `Gauss` and \
         other schemes that ask for no structure take any"
    )]
    MonitorOfMomenta {
        /// The scheme.
        scheme: &'static str,
    },
    /// A monitor that depends on time, where only q and p may occur.
    #[error(
        "the monitor `{name}` of `{system}` depends on time: only a definition with `dt = …*ds` may have \
         time in its monitor function"
    )]
    Timed {
        /// The monitor.
        name: &'static str,
        /// The system.
        system: &'static str,
    },
    /// A name that the system declares no monitor, invariant or event by.
    #[error("`{system}` declares no monitor, invariant or event `{name}`{}", Known("it declares", .known))]
    Unknown {
        /// The name asked for.
        name: String,
        /// The system.
        system: &'static str,
        /// The names that the system declares.
        known: Vec<&'static str>,
    },
    /// A step led to a NaN or an infinity: a number grew beyond all bounds, or the exact flow of a
    /// piece left its domain. The run stays at the state before that step.
    #[error(
        "step {step} led to a state that is not finite{}{}: {clock} = {}, q = {}, p = {}",
        Within(*.piece), Lane(*.lane), Number(*.time), Numbers(.q), Numbers(.p)
    )]
    NotFinite {
        /// The number of the step, counted from 1: the first whose end is not finite.
        step: u64,
        /// The piece of H whose flow led there, where the scheme is a splitting.
        piece: Option<&'static str>,
        /// The first lane it happened in, where the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: &'static str,
        /// The time at the end of that step.
        time: f64,
        /// The coordinates there.
        q: Vec<f64>,
        /// The momenta there.
        p: Vec<f64>,
    },
    /// The equations of an implicit step were not solved. The run stays at the state before that
    /// step.
    #[error(
        "step {step} from {clock} = {} was not solved{}: residual {residual:e} after {iterations} iterations; \
         a shorter step, or more iterations, may solve it",
        Number(*.time), Lane(*.lane)
    )]
    Solve {
        /// The number of the step, counted from 1.
        step: u64,
        /// The first lane that was not solved, where the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: &'static str,
        /// The time at its beginning.
        time: f64,
        /// The last change of the iterate, in the sum norm.
        residual: f64,
        /// The number of iterations made.
        iterations: u32,
    },
    /// No stationary path of a variational integrator was found between the ends given.
    #[error(
        "no stationary path of a step of {} from t = {} was found: residual {residual:e} after \
         {iterations} iterations; ends nearer to each other, or a shorter step, may have one",
        Number(*.step), Number(*.time)
    )]
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
    #[error(
        "{clock} = {} is no whole number of steps ahead: the nearest times are {} and {}; \
         `advance_until` goes to any time",
        Number(*.target), Number(*.before), Number(*.after)
    )]
    OffGrid {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: &'static str,
        /// The time asked for.
        target: f64,
        /// The last reachable time that is not beyond it.
        before: f64,
        /// The first reachable time beyond it.
        after: f64,
    },
    /// A time that no number of steps leads to: NaN, infinite, or 2⁵³ steps ahead and more.
    #[error(
        "{clock} = {} cannot be reached: give a finite time, less than 2^53 steps ahead", Number(*.target)
    )]
    Unreachable {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: &'static str,
        /// The time asked for.
        target: f64,
    },
    /// A time that lies behind the run.
    #[error(
        "{clock} = {} lies behind the run, which is at {clock} = {}: a step of the other sign leads there", Number(*.target), Number(*.now)
    )]
    Behind {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: &'static str,
        /// The time asked for.
        target: f64,
        /// The present time.
        now: f64,
    },
    /// No number of steps is known to lead to a time.
    #[error("steps of this scheme vary in time: `advance_until` goes to any time")]
    Uneven,
    /// A time more than one step from the present one.
    #[error(
        "{clock} = {} is more than one step from the present: from {} to {} can be asked for",
        Number(*.target), Number(*.from), Number(*.to)
    )]
    Far {
        /// The name of the run's time: `t`, in another time the one that it has there.
        clock: &'static str,
        /// The time asked for.
        target: f64,
        /// One step back from the present time.
        from: f64,
        /// One step on.
        to: f64,
    },
    /// An event that a run cannot locate.
    #[error("the event `{name}` cannot be located: {reason}")]
    Event {
        /// Its name.
        name: String,
        /// Why it cannot, and a remedy.
        reason: String,
    },
    /// An error of one member of an ensemble.
    #[error("member {index}: {error}")]
    Member {
        /// Its index.
        index: usize,
        /// Its error.
        error: Box<Error>,
    },
    /// An ensemble or a sweep of no members.
    #[error("an ensemble has at least one member, found 0")]
    NoMembers,
    /// A sweep whose members have no end.
    #[error(
        "the members of the sweep have no end\nhelp: give them one: `.until(t)`, `.steps(n)`, or at least one time \
         of `.record_at(…)`"
    )]
    NoEnd,
    /// Members that no common number of steps leads to one time.
    #[error(
        "no number of steps leads all members to one time, since {reason}; a `Sweep` ends each at its time"
    )]
    Apart {
        /// What differs between them.
        reason: &'static str,
    },
    /// A member with run-time sizes, or functions as parameters, other than those of the first.
    #[error(
        "`{system}` has other sizes or functions than in member 0: members of one ensemble have the same"
    )]
    OtherSizes {
        /// The system.
        system: &'static str,
    },
    /// The error of a member before its ensemble was saved.
    #[error("{message} (before the ensemble was saved)")]
    Before {
        /// Its message.
        message: String,
    },
    /// A sweep was cancelled.
    #[error("the sweep was cancelled after {done} of {of} members")]
    Cancelled {
        /// The number of members that were done.
        done: usize,
        /// The number of members to be done.
        of: usize,
    },
    /// A closure panicked.
    #[error("a closure panicked: {message}")]
    Panicked {
        /// The message of the panic.
        message: String,
    },
    /// A saved run that cannot be read, or does not fit.
    #[error("{0}")]
    Checkpoint(#[from] CheckpointError),
    /// A column that there is not, or a row that does not fit.
    #[error("{0}")]
    Table(#[from] TableError),
    /// Knots that no spline passes through.
    #[error("{0}")]
    Knots(#[from] KnotError),
    /// A part of a sweep that does not exist, or cannot be found out.
    #[error("{0}")]
    Shard(#[from] ShardError),
    /// A store that cannot be written or read, or is that of another sweep.
    #[cfg(feature = "std")]
    #[error("{0}")]
    Store(#[from] StoreError),
    /// A file or another writer failed.
    #[cfg(feature = "std")]
    #[error("{message}")]
    Io {
        /// The kind of the failure.
        kind: std::io::ErrorKind,
        /// The system's message.
        message: String,
    },
    /// An index of a component that there is not.
    #[error("there is no component {index}: there are {count}")]
    Component {
        /// The index given.
        index: usize,
        /// Their number.
        count: usize,
    },
    /// No deviation, or more of them than there are coordinates and momenta.
    #[error("the number of deviations must be from 1 to {most}, found {found}")]
    Deviations {
        /// The number of coordinates and momenta together.
        most: usize,
        /// The number asked for.
        found: usize,
    },
    /// An index of an observable that there is not.
    #[error("there is no observable {index}: the system declares {count}")]
    Observable {
        /// The index given.
        index: usize,
        /// Their number.
        count: usize,
    },
    /// No periodic orbit was found near a guess.
    #[error(
        "no periodic orbit was found: the best start, with the period {period}, misses its conditions by \
         {gap:e}\nhelp: give a nearer guess, or more steps"
    )]
    NoPeriodicOrbit {
        /// The largest difference after a period, or distance from the section or the energy.
        gap: f64,
        /// The period of the best start.
        period: f64,
    },
    /// No value of a momentum gives the energy asked for (on the branch asked for).
    #[error(
        "no `{name}` (component {index}) gives H = {}: the nearest H found is {}, at {}",
        Number(*.energy), Number(*.reached), Number(*.at)
    )]
    NoMomentum {
        /// The name of the momentum.
        name: &'static str,
        /// Its flat index.
        index: usize,
        /// The energy asked for.
        energy: f64,
        /// The value of H nearest to it that was found; at a turning point the minimum of H.
        reached: f64,
        /// The momentum there.
        at: f64,
    },
    /// No value of a coordinate was found where an event is 0.
    #[error(
        "`{event}` changes sign for no `{name}` (component {index}): it is {} at {}",
        Number(*.value), Number(*.from)
    )]
    NoCrossing {
        /// The name of the event.
        event: &'static str,
        /// The name of the coordinate.
        name: &'static str,
        /// Its flat index.
        index: usize,
        /// The coordinate of the guess.
        from: f64,
        /// The event there.
        value: f64,
    },
    /// Masses of bodies whose partial sums m_0 + … + m_i are not all positive and finite.
    #[error("the masses of the bodies up to {body} add up to {}", Number(*.sum))]
    Masses {
        /// The last body of the sum.
        body: usize,
        /// The sum.
        sum: f64,
    },
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

/// Why a saved run cannot be read or gone on with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file cannot be read or written.
    #[error("`{path}`: {message}")]
    File {
        /// Its path.
        path: String,
        /// The system's message.
        message: String,
    },
    /// These bytes are no saved run.
    #[error("this is no saved run: it does not begin as one")]
    Foreign,
    /// It was saved by a newer version of this library.
    #[error("the run was saved in format {found}, this version reads up to {known}: update it")]
    Newer {
        /// The version of the file.
        found: u64,
        /// The newest version that can be read.
        known: u64,
    },
    /// It was saved by an older version of this library, whose steps have other bits.
    #[error(
        "the run was saved in format {found}, this version reads format {known} alone, since its steps \
         have other bits: go on with the version that saved it, or begin a new run from its last state"
    )]
    Older {
        /// The version of the file.
        found: u64,
        /// The version that can be read.
        known: u64,
    },
    /// The bytes are not those that were written.
    #[error("the saved run is damaged: {reason}")]
    Damaged {
        /// The part that does not fit.
        reason: &'static str,
    },
    /// It is the run of something else.
    #[error("the saved run has another {what}: saved `{saved}`, given `{given}`")]
    Other {
        /// `system`, `parameter`, `scheme`, `scalar`, `observer`.
        what: &'static str,
        /// That of the file.
        saved: String,
        /// That of the program.
        given: String,
    },
}

/// The message, because that is what `fn main() -> Result<(), Error>` shows.
impl core::fmt::Debug for Error {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Display::fmt(self, f)
    }
}
