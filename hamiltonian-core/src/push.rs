//! Kicks of systems with a force.
//!
//! Input: what the macro emitted for ṗ = f − ∂V/∂q at frozen q. Output: [`Both`], two accumulations that
//! are the exact flow together, and [`SubStep`], a symmetric step for a force that has no exact flow.
//! Invariant: only momenta move.

use crate::flow::{Flow, VectorField};
use crate::schemes::{Contraction, iterate};
use crate::state::Point;
use crate::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// One flow after the other: together they are one exact flow, which merges.
#[derive(Debug, Clone)]
pub struct Both<A, B>(pub A, pub B);

impl<X: Vector, A: Flow<X>, B: Flow<X>> Flow<X> for Both<A, B> {
    const NAME: &'static str = A::NAME;
    #[inline(always)]
    fn apply(&self, t: X::Scalar, x: &mut X) {
        self.0.apply(t, x);
        self.1.apply(t, x);
    }
}

/// A step of the implicit midpoint rule for ṗ = f(q, p, t) − ∂V/∂q at frozen q: symmetric, of order 2.
///
/// ```text
/// p ← p + c·(f − ∂V/∂q)(q, (p + p′)/2, t) = p′
/// ```
///
/// Solved by fixed-point iteration; where that does not converge the momenta become NaN. Two steps do
/// not merge. Vectors sized at run time are copied.
#[derive(Debug, Clone)]
pub struct SubStep<F>(pub F);

/// A sub-step that is not solved after so many iterations is an error.
const LIMIT: u32 = 100;

/// Δp ↦ c·(f − ∂V/∂q)(q, p + Δp/2)
struct Change<'a, V: Vector, F> {
    field: &'a F,
    t: V::Scalar,
    point: &'a Point<V>,
    middle: V,
    /// The drift of the field, which is not used.
    drift: V,
}

impl<V: Vector, F: VectorField<V>> Contraction<V> for Change<'_, V, F> {
    #[inline(always)]
    fn map(&mut self, change: &V, next: &mut V) {
        self.middle.copy_from(&self.point.p);
        self.middle
            .accumulate(V::Scalar::constant(0.5, 0.0), change);
        next.set_zero();
        (self.field).add(self.t, &self.point.q, &self.middle, &mut self.drift, next);
    }
    #[inline(always)]
    fn scale(&self, change: &V) -> <V::Scalar as Real>::Size {
        self.point.p.size() + change.size()
    }
}

impl<V: Vector, F: VectorField<V>> Flow<Point<V>> for SubStep<F> {
    const NAME: &'static str = "force";
    const MERGES: bool = false;
    #[inline(always)]
    fn apply(&self, t: V::Scalar, x: &mut Point<V>) {
        let mut change = x.p.zeros_like();
        let mut next = change.clone();
        let mut equation = Change {
            field: &self.0,
            t,
            point: x,
            middle: change.clone(),
            drift: change.clone(),
        };
        let outcome = iterate(LIMIT, &mut equation, &mut change, &mut next);
        x.p.accumulate(V::Scalar::one(), &change);
        if !outcome.solved.all() {
            x.p.poison(!outcome.solved);
        }
    }
}
