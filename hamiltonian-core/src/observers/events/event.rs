//! An event: a function of the state, and the selection of its roots.
//!
//! Input: a name, or a closure. Output: an [`Event`], and differences of its values.

use crate::systems::state::State;
use crate::systems::vector::Vector;
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::sync::Arc;
use core::fmt;
use hamiltonian_lanes::Real;

/// A function of the state whose roots a run locates, see [`Events`](crate::observers::Events).
///
/// By default, roots in both directions are events and the run continues. Options change this:
///
/// ```
/// use hamiltonian::nalgebra::SVector;
/// use hamiltonian::prelude::*;
///
/// type Plane = State<SVector<f64, 2>>;
/// let section = Event::named("meridian").with_direction(1);
/// let ground = Event::of("ground", |state: &Plane| state.q[1]).with_direction(-1).with_end_after(1);
/// let node = Event::of("node", |state: &Plane| state.q[0] - 0.5).with_period(std::f64::consts::TAU);
/// # let _: [Event<SVector<f64, 2>>; 3] = [section, ground, node];
/// ```
pub struct Event<V: Vector> {
    pub(super) name: String,
    pub(super) function: Option<StateFunction<V>>,
    /// The required sign of the slope; 0 for both.
    pub(super) direction: i8,
    pub(super) period: Option<V::Scalar>,
    pub(super) ends_after: Option<u64>,
}

/// A function of the state.
type StateFunction<V> = Arc<dyn Fn(&State<V>) -> <V as Vector>::Scalar + Send + Sync>;

impl<V: Vector> Event<V> {
    /// Creates an event at the roots of the event, monitor or invariant of this name.
    pub fn named(name: &str) -> Self {
        Event {
            name: name.to_owned(),
            function: None,
            direction: 0,
            period: None,
            ends_after: None,
        }
    }

    /// Creates an event at the roots of a function of the state, with a name.
    pub fn of(
        name: &str,
        function: impl Fn(&State<V>) -> V::Scalar + Send + Sync + 'static,
    ) -> Self {
        Event {
            function: Some(Arc::new(function)),
            ..Event::named(name)
        }
    }

    /// Selects roots by the sign of the slope, in the direction of the run: 1 for roots at which the function increases, −1
    /// for those at which it decreases, 0 for both. The default is 0.
    #[must_use]
    pub fn with_direction(self, direction: i8) -> Self {
        Event { direction, ..self }
    }

    /// Selects points at which the function is a multiple of `period`, which is positive. This is for angles, which
    /// grow without bound or jump by 2π. In each step the function must change by less than half a period.
    #[must_use]
    pub fn with_period(self, period: V::Scalar) -> Self {
        Event {
            period: Some(period),
            ..self
        }
    }

    /// Ends the run at event number `count`, counted from 1: after 1, at the first event. By default, no event ends the run.
    #[must_use]
    pub fn with_end_after(self, count: u64) -> Self {
        Event {
            ends_after: Some(count),
            ..self
        }
    }

    /// Returns the name and the selection of roots, which a resumed run must repeat. It may change the end of the run.
    pub(super) fn text(&self) -> String {
        let direction = match self.direction {
            0 => "",
            1.. => ", rising",
            _ => ", falling",
        };
        let period = self.period.map(|period| format!(", modulo {period:?}"));
        format!("{}{direction}{}", self.name, period.unwrap_or_default())
    }

    /// Reduces a difference of two values, or a value, by multiples of the period to the least size.
    pub(super) fn difference(&self, value: V::Scalar) -> V::Scalar {
        let Some(period) = self.period else {
            return value;
        };
        let turns = (value / period).to_f64();
        let whole = turns as i64 as f64;
        // Halves are rounded away from 0.
        let turns = (2.0 * (turns - whole)) as i64 as f64 + whole;
        value - V::Scalar::constant(turns, 0.0) * period
    }

    /// Returns a value plus the multiple of the period that brings it nearest to the previous value.
    pub(super) fn unwrapped(&self, from: V::Scalar, value: V::Scalar) -> V::Scalar {
        match self.period {
            None => value,
            Some(_) => from + self.difference(value - from),
        }
    }
}

impl<V: Vector> Clone for Event<V> {
    fn clone(&self) -> Self {
        Event {
            name: self.name.clone(),
            function: self.function.clone(),
            ..*self
        }
    }
}

impl<V: Vector> fmt::Debug for Event<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Event")
            .field("name", &self.name)
            .field("direction", &self.direction)
            .field("period", &self.period)
            .field("ends_after", &self.ends_after)
            .finish_non_exhaustive()
    }
}
