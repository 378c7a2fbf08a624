//! Errors of searches for starts, paths and periodic orbits.

use super::words::Number;
use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why a search for a start, a path or a periodic orbit found nothing, or nothing that is accepted.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum SearchError {
    /// There is no component of that index.
    #[non_exhaustive]
    Component {
        /// The index given.
        index: usize,
        /// The number of components.
        count: usize,
    },
    /// No value of a momentum, on the chosen branch, gives the required energy.
    #[non_exhaustive]
    NoMomentum {
        /// The name of the momentum.
        name: Box<str>,
        /// Its flat index.
        index: usize,
        /// The required energy.
        required: f64,
        /// The value of H nearest to it that was found; at a turning point the minimum of H.
        closest: f64,
        /// The momentum there.
        at: f64,
    },
    /// No value of a coordinate was found at which an event is 0.
    #[non_exhaustive]
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
    /// No stationary path of a variational integrator was found between the ends given.
    #[non_exhaustive]
    NoStationaryPath {
        /// The time at its beginning.
        time: f64,
        /// Its length: the step.
        length: f64,
        /// The last change of the iterate, in the sum norm.
        residual: f64,
        /// The number of iterations made.
        iterations: u32,
    },
    /// No periodic orbit was found near a guess.
    #[non_exhaustive]
    NoPeriodicOrbit {
        /// The largest difference after a period, or distance from the section or the energy.
        gap: f64,
        /// The period of the best start.
        period: f64,
    },
    /// The search for a periodic orbit ended at a point, an equilibrium, or at an orbit much narrower than the guess.
    #[non_exhaustive]
    PointOrbit {
        /// The largest difference of a component between it and the guess.
        distance: f64,
    },
    /// The periodic orbit that was found is far from the guess.
    #[non_exhaustive]
    FarOrbit {
        /// The largest difference of a component between its start and the guess.
        distance: f64,
        /// The distance in units of the width of the guessed orbit.
        widths: f64,
        /// Its period.
        period: f64,
    },
    /// The signs of coordinates and momenta are no symmetry that turns time round.
    #[non_exhaustive]
    Symmetry {
        /// The change of H at a point of the guess; `None` if the signs themselves are wrong.
        change: Option<f64>,
    },
}

impl Display for SearchError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Component { index, count } => {
                write!(f, "there is no component {index}: there are {count}")
            }
            Self::NoMomentum {
                name,
                index,
                required,
                closest,
                at,
            } => write!(
                f,
                "no `{name}` (component {index}) gives H = {}: the nearest H found is {}, at {}",
                Number(*required),
                Number(*closest),
                Number(*at)
            ),
            Self::NoCrossing {
                event,
                name,
                index,
                from,
                value,
            } => write!(
                f,
                "`{event}` changes sign for no `{name}` (component {index}): it is {} at {}",
                Number(*value),
                Number(*from)
            ),
            Self::NoStationaryPath {
                time,
                length,
                residual,
                iterations,
            } => write!(
                f,
                "no stationary path of a step of {} from t = {} was found: residual {residual:e} \
                 after {iterations} iterations; ends nearer to each other, or a shorter step, may \
                 have one",
                Number(*length),
                Number(*time)
            ),
            Self::NoPeriodicOrbit { gap, period } => write!(
                f,
                "no periodic orbit was found: the best start, with the period {period}, misses its \
                 conditions by {gap:e}\n\
                 help: give a nearer guess, or more steps"
            ),
            Self::PointOrbit { distance } => write!(
                f,
                "the search for a periodic orbit tends to an equilibrium, at a distance of {distance:e} from the guess\n\
                 help: give the energy instead of the period (`Closing::OfEnergy`), or a guess on a larger orbit"
            ),
            Self::FarOrbit {
                distance,
                widths,
                period,
            } => write!(
                f,
                "the periodic orbit that was found, with the period {period}, starts at a distance of {distance:e} from \
                 the guess, {widths:.1} times the width of the guessed orbit\n\
                 help: give a nearer guess, more arcs or a symmetry; `with_reach` accepts orbits that are further away"
            ),
            Self::Symmetry { change: None } => write!(
                f,
                "a symmetry needs a sign, 1 or -1, for each coordinate, then for each momentum; those of a coordinate and \
                 its momentum must differ"
            ),
            Self::Symmetry {
                change: Some(change),
            } => write!(
                f,
                "H changes by {change:e} under the symmetry, at a point of the guess\n\
                 help: give the signs of a symmetry that turns time round, such as `&[1, -1, -1, 1]` for \
                 H(x, -y, -p_x, p_y) = H(x, y, p_x, p_y)"
            ),
        }
    }
}

impl core::error::Error for SearchError {}
