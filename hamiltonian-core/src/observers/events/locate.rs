//! The roots of the function of one event within a step.
//!
//! Input: the function at fractions of the step, its values at both ends, its sign before the step. Output: the roots in
//! order, and the sign before the end. Invariant: the function tends to 0 from both sides of a root. A root at the end
//! of a step belongs to the next step, in which it is known whether the sign changes.

use crate::errors::Error;
use crate::observers::root::{Sample, dip, root, side};
use alloc::vec::Vec;
use hamiltonian_lanes::{Mask, Real};

/// The distance from a root, in units of the step, at which the function must be small.
const BESIDE: f64 = 1.0 / (1_u64 << 40) as f64;

/// The largest value beside a root, relative to values further away.
const SMALL: f64 = 1.0 / 1024.0;

/// A value beside a root that is this small, relative to the ends of a bracket, needs no values between.
const TINY: f64 = 1.0 / (1_u64 << 36) as f64;

/// The distances from an end without a sign at which the function is evaluated.
const NEAR: [f64; 3] = [1.0 / 4096.0, 1.0 / 512.0, 1.0 / 64.0];

/// A root, in units of the step.
pub(super) struct Root<T> {
    pub(super) at: T,
    pub(super) rising: bool,
}

/// The function of an event in a step.
pub(super) struct StepFunction<T, F, N> {
    /// The value at a fraction of the step.
    pub(super) function: F,
    /// The change of the function due to rounding of the state at a fraction of the step.
    pub(super) rounding: N,
    /// The values at the start and at the end.
    pub(super) ends: [Sample<T>; 2],
    /// The last sign before the step, 0 if there is none.
    pub(super) was: i8,
    /// The change of the function in the step before.
    pub(super) change: T,
    /// The sign of the slope that counts, 0 for both.
    pub(super) slope: i8,
}

/// The size of a value, without derivative parts; infinite if it is NaN.
fn size<T: Real>(sample: Sample<T>) -> f64 {
    let size = Real::abs(sample.value.to_f64());
    if size.is_nan() { f64::INFINITY } else { size }
}

/// Returns true if the function has a sign there.
fn is_signed<T: Real>(sample: Sample<T>) -> bool {
    size(sample).is_finite() && side(sample.value) != 0
}

/// Returns true if the function is 0 there.
fn is_zero<T: Real>(sample: Sample<T>) -> bool {
    size(sample).is_finite() && side(sample.value) == 0
}

/// The largest finite size.
fn largest<T: Real>(samples: &[Sample<T>]) -> f64 {
    let sizes = samples.iter().map(|sample| size(*sample));
    sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
}

impl<T, F, N> StepFunction<T, F, N>
where
    T: Real,
    F: FnMut(T) -> Result<T, Error>,
    N: FnMut(T) -> Result<f64, Error>,
{
    /// Returns the roots, and the sign before the end if the value at the end has none.
    ///
    /// # Errors
    /// Those of the function.
    pub(super) fn roots(&mut self) -> Result<(Vec<Root<T>>, Option<i8>), Error> {
        match self.ends.iter().all(|end| is_signed(*end)) {
            true => Ok((self.between_signs()?, None)),
            false => self.between_zeros(),
        }
    }

    /// Returns the roots in a step with a sign at both ends.
    fn between_signs(&mut self) -> Result<Vec<Root<T>>, Error> {
        let ([start, end], was) = (self.ends, self.was);
        let (from, value, now) = (start.value, end.value, side(end.value));
        // Twice the approach to 0 in the previous step and in this one.
        let toward_zero = T::constant(-2.0 * f64::from(was), 0.0);
        let (last_approach, approach) = (toward_zero * self.change, toward_zero * (value - from));
        let is_convex = (approach + approach).lt(last_approach).any();
        let may_dip = was != 0 && now == was && is_convex && from.abs().lt(last_approach).any();
        let mut roots = Vec::new();
        if was != 0 && now == -was {
            self.root_between(start, end, &mut roots)?;
        } else if may_dip && let Some(middle) = dip(was, &mut self.function)? {
            self.root_between(start, middle, &mut roots)?;
            self.root_between(middle, end, &mut roots)?;
        }
        Ok(roots)
    }

    /// Returns the roots in a step with a zero at an end, or without a finite value there. Signs are those at points
    /// between the ends, dense where an end has none.
    fn between_zeros(&mut self) -> Result<(Vec<Root<T>>, Option<i8>), Error> {
        let [start, end] = self.ends;
        let is_flat = is_zero(start)
            && is_zero(end)
            && is_zero(self.sample(0.5)?)
            && is_zero(self.sample(0.125)?);
        if is_flat {
            return Ok((Vec::new(), Some(self.was)));
        }
        let mut samples = Vec::new();
        match is_signed(start) {
            true => samples.push(start),
            false => {
                for at in NEAR {
                    samples.push(self.sample(at)?);
                }
            }
        }
        for k in 1..8 {
            samples.push(self.sample(f64::from(k) / 8.0)?);
        }
        match is_signed(end) {
            true => samples.push(end),
            false => {
                for at in NEAR.into_iter().rev() {
                    samples.push(self.sample(1.0 - at)?);
                }
            }
        }
        let noise = self.noise()?;
        let is_plain =
            |sample: &Sample<T>| sample.at.equals(start.at).all() || sample.at.equals(end.at).all();
        samples.retain(|sample| is_signed(*sample) && (is_plain(sample) || size(*sample) > noise));
        let mut roots = Vec::new();
        let first = samples.first().map_or(0, |first| side(first.value));
        if is_zero(start)
            && self.was != 0
            && first == -self.was
            && self.counts(first)
            && self.tends_to_zero(|at| at, noise)?
        {
            roots.push(Root {
                at: start.at,
                rising: first > 0,
            });
        }
        for pair in samples.windows(2) {
            if side(pair[0].value) != side(pair[1].value) {
                self.root_between(pair[0], pair[1], &mut roots)?;
            }
        }
        if is_signed(end) {
            return Ok((roots, None));
        }
        let last = samples.last().map_or(0, |last| side(last.value));
        let is_root = is_zero(end) && self.tends_to_zero(|at| 1.0 - at, noise)?;
        Ok((roots, Some(if is_root { last } else { 0 })))
    }

    /// Returns true if the function tends to 0 towards an end, from which distances are measured.
    fn tends_to_zero(&mut self, from: impl Fn(f64) -> f64, noise: f64) -> Result<bool, Error> {
        let [beside, apart] = [self.sample(from(BESIDE))?, self.sample(from(NEAR[2]))?];
        Ok(size(beside) <= noise.max(SMALL * largest(&[apart])))
    }

    /// Returns the least change of the function due to rounding at three points: it is large at a jump.
    fn noise(&mut self) -> Result<f64, Error> {
        let [start, end] = self.ends;
        let mut noise = f64::INFINITY;
        for at in [start.at, T::constant(0.5, 0.0), end.at] {
            noise = noise.min((self.rounding)(at)?);
        }
        Ok(noise)
    }

    /// Returns true if a root of this slope counts.
    fn counts(&self, slope: i8) -> bool {
        self.slope != -slope
    }

    fn sample(&mut self, at: f64) -> Result<Sample<T>, Error> {
        self.sample_at(T::constant(at, 0.0))
    }

    fn sample_at(&mut self, at: T) -> Result<Sample<T>, Error> {
        let value = (self.function)(at)?;
        Ok(Sample { at, value })
    }

    /// Adds the root between two points of different signs, unless the sign changes at a pole or a jump.
    fn root_between(
        &mut self,
        left: Sample<T>,
        right: Sample<T>,
        roots: &mut Vec<Root<T>>,
    ) -> Result<(), Error> {
        let rising = side(right.value) > 0;
        if !self.counts(side(right.value)) {
            return Ok(());
        }
        let at = root(left, right, &mut self.function)?.at;
        let by = T::constant(BESIDE, 0.0);
        let (below, above) = (at - by, at + by);
        let is_inside = [left.at.lt(below).all(), above.lt(right.at).all()];
        let below = if is_inside[0] {
            self.sample_at(below)?
        } else {
            left
        };
        let above = if is_inside[1] {
            self.sample_at(above)?
        } else {
            right
        };
        let beside = size(below).max(size(above));
        let half = T::constant(0.5, 0.0);
        let is_root = beside <= TINY * largest(&[left, right])
            || {
                // An end may itself be near a root, or near a pole.
                let below = self.sample_at((left.at + at) * half)?;
                let above = self.sample_at((at + right.at) * half)?;
                beside <= SMALL * largest(&[below, above])
            }
            || beside <= self.noise()?;
        if is_root {
            roots.push(Root { at, rising });
        }
        Ok(())
    }
}
