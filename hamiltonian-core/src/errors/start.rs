//! Errors of the start of a run.

use super::words::{DerivativePart, Lane, Number, Numbers, StartRemedy};
use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why a run, a change of a run, or the start of a computation is refused before a step is made.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum StartError {
    /// The step is zero, NaN or infinite.
    #[non_exhaustive]
    Step {
        /// The step given.
        value: f64,
    },
    /// The tolerance is negative, NaN or infinite, or both of its numbers are zero.
    #[non_exhaustive]
    Tolerance {
        /// The relative tolerance given.
        relative: f64,
        /// The absolute tolerance given.
        absolute: f64,
    },
    /// The start has a NaN or an infinity in it.
    #[non_exhaustive]
    NotFinite {
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// Its time.
        time: f64,
        /// Its coordinates.
        q: Box<[f64]>,
        /// Its momenta.
        p: Box<[f64]>,
    },
    /// H or a first derivative of it is NaN or infinite at the start.
    #[non_exhaustive]
    Values {
        /// `H`, or a derivative, `∂H/∂q[1]`.
        name: Box<str>,
        /// Over dual numbers, whether `value` is the derivative part: the value itself is finite.
        derivative: bool,
        /// Its value.
        value: f64,
        /// The first lane in which it is that, if the scalar has several.
        lane: Option<u32>,
        /// The first parameter that is NaN or infinite, `m[1] = NaN`, if there is one.
        parameter: Option<Box<str>>,
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The time of the start.
        time: f64,
        /// Its coordinates.
        q: Box<[f64]>,
        /// Its momenta.
        p: Box<[f64]>,
    },
    /// The start of a time-transformed system (`dt = g*ds`) is not on the shell H = 0. Orbits off the shell are not those
    /// of the declared system.
    #[non_exhaustive]
    Shell {
        /// The momentum of time.
        momentum: Box<str>,
        /// Its value.
        value: f64,
        /// Its value on the shell.
        due: f64,
    },
    /// The monitor function g of a time-transformed system, dt = g ds, is not positive.
    #[non_exhaustive]
    Monitor {
        /// Its value at the start.
        value: f64,
    },
    /// The monitor function depends on momenta, and the scheme requires one of coordinates alone.
    #[non_exhaustive]
    MonitorOfMomenta {
        /// The scheme.
        scheme: Box<str>,
    },
    /// H jumps at times that do not depend on the state, and the scheme evaluates it at the ends of steps or outside of
    /// them, where the jumps may be.
    #[non_exhaustive]
    Jumps {
        /// The scheme.
        scheme: Box<str>,
        /// The system.
        system: Box<str>,
    },
    /// The scheme requires a property that H is not proven to have, of a system that is defined at run time.
    #[non_exhaustive]
    Structure {
        /// The scheme.
        scheme: Box<str>,
        /// The name of the trait that stands for the property: `Separable`.
        marker: Box<str>,
        /// The reason, with the term of H.
        message: Box<str>,
        /// The relation of the scheme to that structure: `needs H = T(p) + V(q)`.
        label: Box<str>,
        /// The alternative.
        note: Box<str>,
    },
    /// A new state of a run is at another time than the run.
    #[non_exhaustive]
    OtherTime {
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The time of the state.
        time: f64,
        /// The current time of the run.
        now: f64,
    },
    /// A mean rate over no steps.
    #[non_exhaustive]
    NoSteps,
    /// No deviation, or more of them than there are coordinates and momenta.
    #[non_exhaustive]
    Deviations {
        /// The number of coordinates and momenta together.
        most: usize,
        /// The number of deviations.
        found: usize,
    },
}

impl Display for StartError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Step { value } => write!(
                f,
                "a step must be finite and not zero, found {}",
                Number(*value)
            ),
            Self::Tolerance { relative, absolute } => write!(
                f,
                "a tolerance must be positive and finite, found {} relative and {} absolute",
                Number(*relative),
                Number(*absolute)
            ),
            Self::NotFinite { clock, time, q, p } => write!(
                f,
                "the start is not finite: {clock} = {}, q = {}, p = {}",
                Number(*time),
                Numbers(q),
                Numbers(p)
            ),
            Self::Values {
                name,
                derivative,
                value,
                lane,
                parameter,
                clock,
                time,
                q,
                p,
            } => write!(
                f,
                "{}{name} is {}{} at the start {clock} = {}, q = {}, p = {}: {}",
                DerivativePart(*derivative),
                Number(*value),
                Lane(*lane),
                Number(*time),
                Numbers(q),
                Numbers(p),
                StartRemedy(parameter, *derivative)
            ),
            Self::Shell {
                momentum,
                value,
                due,
            } => write!(
                f,
                "the start is not on the shell H = 0: `{momentum}` is {} and must be {}; the \
                 methods `on_shell` and `from_declared` set it",
                Number(*value),
                Number(*due)
            ),
            Self::Monitor { value } => write!(
                f,
                "the monitor function is {} at the start, and must be positive",
                Number(*value)
            ),
            Self::MonitorOfMomenta { scheme } => write!(
                f,
                "the monitor function depends on momenta, and `{scheme}` asks for one of \
                 coordinates alone: `Gauss` and other schemes that ask for no structure take any"
            ),
            Self::Jumps { scheme, system } => write!(
                f,
                "`{system}` jumps in time, and `{scheme}` evaluates what jumps at the ends of steps or outside of \
                 them: use `Gauss` or `ImplicitMidpoint`, which evaluate it inside, or, if a piece of H does not \
                 jump, `StormerVerlet`, `BlanesMoan4` or another splitting; let steps end at the jumps"
            ),
            Self::Structure {
                scheme,
                message,
                label,
                note,
                ..
            } => write!(f, "{message}; `{scheme}` {label}: {note}"),
            Self::OtherTime { clock, time, now } => write!(
                f,
                "the new state is at {clock} = {}, the run at {clock} = {}: a change keeps the time, give the state \
                 that of the run, `state.at(run.state().t)`",
                Number(*time),
                Number(*now)
            ),
            Self::NoSteps => f.write_str(
                "indicators of chaos are means over steps: the number of steps must be at least 1, \
                 found 0",
            ),
            Self::Deviations { most, found } => write!(
                f,
                "the number of deviations must be from 1 to {most}, found {found}"
            ),
        }
    }
}

impl core::error::Error for StartError {}
