//! Changes of sign, found in lanes.
//!
//! Input: the values of a function after each step, lane by lane. Output: the lanes in which its
//! sign may have changed, so that [`Events`](crate::observers::Events) must receive the step.
//! Invariant: in a lane that is not returned, the observer would find no event.

use hamiltonian_lanes::{Mask, Real};

/// A section of a member: a function whose sign an observer follows, with its values after the last two steps.
#[derive(Debug, Clone, Copy)]
pub struct MemberSection<T> {
    /// The index of the function among the observables.
    pub(crate) observable: usize,
    /// The period: multiples of it count as 0.
    pub(crate) period: Option<T>,
    /// The value after the last step.
    pub(crate) value: T,
    /// Its change in that step.
    pub(crate) change: T,
    /// True if the event may end the run.
    pub(crate) ends: bool,
}

impl<T: Real> MemberSection<T> {
    /// Returns true if another section has the same function.
    pub(crate) fn is_of(&self, other: &Self) -> bool {
        let is_same_period = match (self.period, other.period) {
            (Some(one), Some(other)) => one.equals(other).all(),
            (one, other) => one.is_none() && other.is_none(),
        };
        self.observable == other.observable && is_same_period
    }
}

/// A section of the members in lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LaneSection<U> {
    /// The index of the function among the observables.
    pub(crate) observable: usize,
    pub(crate) period: Option<U>,
    /// The value after the last step, at the index `newest`, and the one before. With a period, the one before is
    /// unwrapped to be near the last. Values are not moved, since packs are long.
    values: [U; 2],
    newest: usize,
    /// True if all `section_lanes` were far from 0 after the last step.
    is_far: bool,
}

/// Rounds `x` to the nearest integer, for |x| below 2⁵¹: adding 1.5·2⁵² leaves no digits after the point.
#[cfg_attr(not(unoptimised), inline(always))]
fn nearest<U: Real>(x: U) -> U {
    let large = U::constant(6_755_399_441_055_744.0, 0.0);
    (x + large) - large
}

impl<U: Real> LaneSection<U> {
    /// Creates a function whose values, here `any`, are written later.
    pub(crate) fn new(observable: usize, period: Option<U>, any: U) -> Self {
        LaneSection {
            observable,
            period,
            values: [any; 2],
            newest: 0,
            is_far: false,
        }
    }

    /// Returns the value after the last step and the one before, for writing.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn values_mut(&mut self) -> &mut [U; 2] {
        self.newest = 0;
        &mut self.values
    }

    /// The value after the last step.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn value(&self) -> &U {
        &self.values[self.newest & 1]
    }

    /// The value after the last step, and the one before.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn last(&self) -> [&U; 2] {
        [self.value(), &self.values[(self.newest + 1) & 1]]
    }

    /// Accepts the value after the next step and returns true if the observers of `section_lanes` do not need the step.
    /// Otherwise the value is not accepted. This is a fast form of [`lanes_to_mark`](LaneSection::lanes_to_mark) for
    /// the usual step.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn try_skip(&mut self, value: U, section_lanes: &U::Mask) -> bool {
        if self.period.is_some() {
            return false;
        }
        // A lane is far from 0 if the ratio of the last value to this one is between 1/262144 and 1.476. Then the sign
        // is the same, and the function decreases by less than half of its value, so `lanes_to_mark` returns no lane in
        // the next step either.
        let above = U::constant(-1.0 / 262_144.0, 0.0).fma(value, *self.value());
        let below = U::constant(3.1, 0.0).fma(value, U::constant(-2.1, 0.0) * *self.value());
        let is_far = U::zero().lt(above * below);
        let is_far = is_far.all() || !(!is_far & *section_lanes).any();
        let was_far = core::mem::replace(&mut self.is_far, is_far);
        if is_far && was_far {
            self.newest = (self.newest + 1) & 1;
            self.values[self.newest] = value;
        }
        is_far && was_far
    }

    /// Accepts the value after the next step. Returns the lanes in which the observer may find an event.
    ///
    /// The observer evaluates the function again without fused products. Therefore a lane is also returned, at this
    /// step and at the next, if its value is so small relative to its change that rounding may decide the sign.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn lanes_to_mark(&mut self, value: U) -> U::Mask {
        let [&from, &before] = self.last();
        let changed = from - before;
        let (value, unwrapped) = match self.period {
            None => (value, value),
            Some(period) => {
                let value = value - nearest(value / period) * period;
                let change = value - from;
                (value, from + (change - nearest(change / period) * period))
            }
        };
        let change = unwrapped - from;
        (self.values, self.newest) = ([value, value - change], 0);
        // The signs are the same, and from·unwrapped is not small relative to the square of the change.
        let least = U::constant(1.0 / 1_048_576.0, 0.0);
        let product = change.fma(from, from * from);
        let margin = (least * change).fma(-change, product);
        let steady = U::zero().lt(margin);
        // The condition of `Events` for two roots in one step, multiplied by `from`. The factor allows for rounding.
        let last_approach = changed * U::constant(-2.002, 0.0);
        let is_near = (from * from).lt(from * last_approach);
        let to_mark = !steady | is_near;
        if !is_near.any() {
            return to_mark;
        }
        let approach = change * U::constant(-4.0, 0.0);
        !steady | (is_near & (from * approach).lt(from * last_approach))
    }
}
