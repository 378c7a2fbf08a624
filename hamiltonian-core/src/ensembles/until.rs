//! Members in memory, advanced to a time.
//!
//! Input: an ensemble and a time. Output: the states of its members at that time. Invariant: only whole steps change
//! members. A state between two steps is computed by a part of a step of a temporary run.

use super::chunk::Shared;
use super::in_memory::Ensemble;
use super::rounding::Rounding;
use crate::errors::{Error, SweepError, TimeError};
use crate::flows::map::Clock;
use crate::observers::observe::Observer;
use crate::schemes::scheme::Scheme;
use crate::systems::state::State;
use crate::systems::system::{Description, System, VectorOf};

impl<S: System, M: Scheme<S>, O: Observer<f64, S> + Send, A: Rounding> Ensemble<S, M, O, A> {
    /// Advances all members to the time `t`, which is a whole number of steps from the current time. For any other time,
    /// use [`advance_until`](Ensemble::advance_until).
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.0]));
    /// let mut swarm = Ensemble::new(10, start, ImplicitMidpoint::default(), 0.01)?;
    /// assert_eq!(swarm.advance_to(1.0)?.steps(), 100);
    /// assert!(matches!(swarm.advance_to(1.005), Err(Error::Time(_))));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TimeError::OffGrid`], [`TimeError::Behind`], [`TimeError::Unreachable`]; [`SweepError::Apart`] if members
    /// start at different times or if their steps vary in time. After an error no step has been made.
    pub fn advance_to(&mut self, t: f64) -> Result<&mut Self, Error> {
        let steps = self.steps_to(t)?;
        Ok(self.advance(steps))
    }

    /// Returns the number of steps to the time `t`, which is a whole number of them; 0 if no member could start.
    ///
    /// # Errors
    /// Those of [`advance_to`](Ensemble::advance_to).
    pub fn steps_to(&self, t: f64) -> Result<u64, Error> {
        let Some(time) = self.clock()? else {
            return Ok(0);
        };
        let made = self.common.steps;
        match time.whole_steps(made, t, self.time_name())? {
            (None, steps) => Ok(steps),
            (Some(before), after) => Err(TimeError::OffGrid {
                clock: self.time_name().into(),
                target: t,
                before: time.at(made + before),
                after: time.at(made + after),
            }
            .into()),
        }
    }

    /// Advances all members by the whole steps up to `t`, and returns the state of each member at `t`, in the order of
    /// the index. `t` is any later time.
    ///
    /// The states at `t` are made by one shorter step of temporary runs, as in
    /// [`Integrator::advance_until`](crate::Integrator::advance_until): [`states`](Ensemble::states) remain those after
    /// the last whole step. The shorter step does not fuse products and sums. A member that its observer has ended has
    /// the state of its end.
    ///
    /// If steps vary in time, as those from a tolerance do, each member makes the step that passes `t` too, and has made a
    /// [number of steps](Ensemble::steps_of) of its own.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.0]));
    /// let mut swarm = Ensemble::new(10, start, ImplicitMidpoint::default(), 0.01)?;
    /// for end in swarm.advance_until(1.005)? {
    ///     assert_eq!(end?.t, 1.005);
    /// }
    /// assert_eq!(swarm.steps(), 100);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TimeError::Behind`], [`TimeError::Unreachable`]; [`SweepError::Apart`] if members with fixed steps start at
    /// different times. The error of a member is in its place, see [`states`](Ensemble::states);
    /// [`TimeError::Far`] for a time before its last step, if steps vary in time.
    pub fn advance_until(
        &mut self,
        t: f64,
    ) -> Result<impl Iterator<Item = Result<State<VectorOf<S>>, Error>>, Error> {
        let (mut between, mut passed) = (None, None);
        if self.common.varies {
            if !t.is_finite() {
                let (clock, target) = (self.time_name().into(), t);
                return Err(TimeError::Unreachable { clock, target }.into());
            }
            passed = Some(self.pass_time(t));
        } else if let Some(time) = self.clock()? {
            let (before, after) = time.whole_steps(self.common.steps, t, self.time_name())?;
            between = before.map(|_| t);
            self.advance(before.unwrap_or(after));
        }
        let chunks = match passed {
            Some(_) => 0..0,
            None => 0..self.chunks.len(),
        };
        let closed = chunks.flat_map(move |number| self.closed(number, 0..usize::MAX, between));
        Ok(passed.into_iter().flatten().chain(closed))
    }

    /// Returns the name of the time of the members.
    fn time_name(&self) -> &str {
        self.description().map_or("t", Description::clock)
    }

    /// Returns the clock that all members share; `None` if no member could start.
    fn clock(&self) -> Result<Option<Clock<f64>>, Error> {
        if self.common.varies {
            let reason = "their steps vary in time".into();
            return Err(SweepError::Apart { reason }.into());
        }
        let mut first: Option<f64> = None;
        for chunk in &self.chunks {
            let starts = match &chunk.starts {
                Shared::Nothing => &[],
                Shared::One(start) => core::slice::from_ref(start),
                Shared::Each(starts) => starts.as_slice(),
            };
            for start in starts {
                if first.get_or_insert(*start).to_bits() != start.to_bits() {
                    let reason = "they start at different times".into();
                    return Err(SweepError::Apart { reason }.into());
                }
            }
        }
        let interval = self.common.interval;
        Ok(first.map(|start| Clock::new(start, interval)))
    }
}
