//! Fixed-point iteration, lane by lane, shared by all implicit steps.
//!
//! Input: a contraction and a guess. Output: its fixed point to rounding, or which lanes have none.
//! Invariant: a lane that has converged is not touched any more, so its bits depend on nothing in
//! the other lanes.

use crate::flows::map::Cause;
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The map whose fixed point is looked for.
pub trait Contraction<V: Vector> {
    /// `next = g(x)`.
    fn map(&mut self, x: &V, next: &mut V);
    /// The size of the numbers that g adds up; a change that is a few ε of it is rounding.
    fn scale(&self, x: &V) -> <V::Scalar as Real>::Size;
}

/// The end of an iteration.
#[derive(Debug, Clone, Copy)]
pub struct Outcome<T: Real> {
    /// The lanes that were solved.
    pub solved: T::Mask,
    /// The last change of the iterate, in the sum norm.
    pub residual: T::Size,
    /// The number of iterations made.
    pub iterations: u32,
}

impl<T: Real> Outcome<T> {
    /// No lane is solved.
    pub(crate) fn unsolved() -> Self {
        Outcome {
            solved: T::Mask::splat(false),
            residual: T::Size::zero(),
            iterations: 0,
        }
    }

    /// That it was not solved, with the residual of the first lane that was not.
    pub fn cause(&self) -> Cause {
        let lane = (!self.solved).first().unwrap_or(0);
        Cause::Unsolved {
            residual: self.residual.lane(lane),
            iterations: self.iterations,
        }
    }
}

/// A change that no longer shrinks is rounding if it is at most this many ε of the numbers added:
/// evaluations of J∇H may lose three decimal digits by cancellation.
const ROUNDING: f64 = 1024.0;

/// Iterates `x ← g(x)` until the change is 0, or rounding and not shrinking any more; at most
/// `limit` times.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn iterate<V: Vector, G: Contraction<V>>(
    limit: u32,
    g: &mut G,
    x: &mut V,
    next: &mut V,
) -> Outcome<V::Scalar> {
    type Size<V> = <<V as Vector>::Scalar as Real>::Size;
    let mut solved = <<V::Scalar as Real>::Mask as Mask>::splat(false);
    let mut before = Size::<V>::constant(f64::INFINITY, 0.0);
    let mut residual = before;
    let mut iterations = 0;
    while iterations < limit {
        g.map(x, next);
        let change = next.size_of_difference(x);
        residual = Size::<V>::select(solved, residual, change);
        // Before the update: the values left behind are functions of the final x alone.
        x.copy_where(!solved, next);
        iterations += 1;
        let mut now = change.equals(Size::<V>::zero());
        // Strictly smaller than infinity: ∞ ≤ ∞ is no convergence.
        let stalled = before.le(change) & before.lt(Size::<V>::constant(f64::INFINITY, 0.0));
        if stalled.any() {
            let floor = Size::<V>::constant(ROUNDING * V::Scalar::epsilon(), 0.0) * g.scale(x);
            now = now | (stalled & change.lt(floor));
        }
        solved = solved | now;
        if solved.all() {
            break;
        }
        // A lane that is not a number stays one.
        let lost = !change.equals(change);
        if (solved | lost).all() {
            break;
        }
        before = change;
    }
    Outcome {
        solved,
        residual,
        iterations,
    }
}
