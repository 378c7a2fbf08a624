//! Kicks of systems with a force.
//!
//! Input: the emitted program of ṗ = f − ∂V/∂q at frozen q. Output: [`Both`], two updates
//! whose composition is the exact flow, [`Coupled`], the exact flow if momenta are coupled, and
//! [`SubStep`], a symmetric step for a force that has no exact flow. Invariant: only momenta move.

use crate::flows::iterate::{Contraction, iterate};
use crate::systems::flow::{Flow, Scratch, VectorField};
use crate::systems::state::Point;
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// One flow after the other: together they are one exact flow that merges.
#[derive(Debug, Clone)]
pub struct Both<A, B>(pub A, pub B);

impl<X: Vector, A: Flow<X>, B: Flow<X>> Flow<X> for Both<A, B> {
    const NAME: &'static str = A::NAME;
    const MOVES: [bool; 2] = [A::MOVES[0] || B::MOVES[0], A::MOVES[1] || B::MOVES[1]];
    type Work = (A::Work, B::Work);
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: X::Scalar, x: &mut X, (first, second): &mut Self::Work) {
        self.0.apply(t, x, first);
        self.1.apply(t, x, second);
    }
}

/// Scratch momenta.
#[derive(Debug, Clone)]
pub struct Momenta<V>([V; 4]);

impl<V: Vector> Scratch<Point<V>> for Momenta<V> {
    fn like(x: &Point<V>) -> Self {
        let zeros = || x.p.zeros_like();
        Momenta([zeros(), zeros(), zeros(), zeros()])
    }
}

/// The exact flow of ṗ = A(q, t)·p + b(q, t) at frozen q and t, from c·(A·p + b) and c·A·p.
///
/// ```text
/// p ← p + Σ Δₖ,   Δ₁ = s·c·(A·p + b),   Δₖ = s·c·A·Δₖ₋₁/k
/// ```
///
/// summed to rounding, 1/s times one after the other. s is the largest power of ½ for which no term
/// is larger than p and Δ₁ together, so that no term costs digits of the sum; each lane has its
/// own. A lane whose sum does not converge becomes NaN.
///
/// Source: A. H. Al-Mohy, N. J. Higham, SIAM J. Sci. Comput. 33 (2011) 488, eqs. (3.1) and (3.15),
/// doi:10.1137/100788860.
#[derive(Debug, Clone)]
pub struct Coupled<F, L> {
    /// c·(A·p + b).
    pub field: F,
    /// c·A·p.
    pub linear: L,
}

/// The largest number of terms of a series in which no term is larger than p and the first
/// together. If c·A is at most 2, which is then the usual case, term 38 is below ε of a
/// double-double number.
const TERMS: u32 = 48;

/// The largest number of parts of a duration; more are an error.
const PARTS: u32 = 10_000;

impl<V: Vector, F: VectorField<V>, L: VectorField<V>> Flow<Point<V>> for Coupled<F, L> {
    const NAME: &'static str = "force";
    type Work = Momenta<V>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: V::Scalar, x: &mut Point<V>, Momenta(work): &mut Momenta<V>) {
        type Size<V> = <<V as Vector>::Scalar as Real>::Size;
        let [term, next, sum, drift] = work;
        let (zero, one) = (V::Scalar::zero(), V::Scalar::one());
        let half = V::Scalar::constant(0.5, 0.0);
        let rounding = Size::<V>::constant(V::Scalar::epsilon(), 0.0);
        let none = <<V::Scalar as Real>::Mask as Mask>::splat(false);
        // The rest of the duration, and the part that is tried.
        let (mut left, mut part) = (one, one);
        let mut lost = none;
        for _ in 0..PARTS {
            term.set_zero();
            (self.field).add(t, &x.q, &x.p, drift, term);
            term.scale(part);
            sum.copy_from(term);
            let scale = x.p.size() + term.size();
            let (mut ended, mut small, mut grows) = (none, none, none);
            for k in 2..TERMS {
                next.set_zero();
                (self.linear).add(t, &x.q, term, drift, next);
                // A lane that has ended adds zeros.
                let factor = part / V::Scalar::constant(f64::from(k), 0.0);
                next.scale(V::Scalar::select(ended | grows, zero, factor));
                sum.accumulate(one, next);
                core::mem::swap(term, next);
                let size = term.size();
                grows = grows | scale.lt(size);
                // Two in succession, because one term may be small by chance.
                let was_small = core::mem::replace(&mut small, size.le(rounding * scale));
                ended = ended | (small & was_small);
                lost = lost | !(size + scale).equals(size + scale);
                if (ended | grows | lost).all() {
                    break;
                }
            }
            let moves = ended & !grows & zero.lt(left);
            next.copy_from(&x.p);
            next.accumulate(one, sum);
            x.p.copy_where(moves, next);
            left = V::Scalar::select(moves, left - part, left);
            part = V::Scalar::select(grows, half * part, part);
            part = V::Scalar::select(zero.lt(left), part, zero);
            if (lost | !zero.lt(left)).all() {
                break;
            }
        }
        let unsolved = lost | zero.lt(left);
        if unsolved.any() {
            x.p.poison(unsolved);
        }
    }
}

/// A step of the implicit midpoint rule for ṗ = f(q, p, t) − ∂V/∂q at frozen q: symmetric, of order 2.
///
/// ```text
/// p ← p + c·(f − ∂V/∂q)(q, (p + p′)/2, t) = p′
/// ```
///
/// Solved by fixed-point iteration; if it does not converge, the momenta become NaN. Two steps do
/// not merge.
#[derive(Debug, Clone)]
pub struct SubStep<F>(pub F);

/// The number of iterations after which an unsolved sub-step is an error.
const LIMIT: u32 = 100;

/// The fixed-point equation Δp ↦ c·(f − ∂V/∂q)(q, p + Δp/2)
struct MomentumEquation<'a, V: Vector, F> {
    field: &'a F,
    t: V::Scalar,
    point: &'a Point<V>,
    middle: &'a mut V,
    /// The drift of the field, which is not used.
    drift: &'a mut V,
}

impl<V: Vector, F: VectorField<V>> Contraction<V> for MomentumEquation<'_, V, F> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn map(&mut self, change: &V, next: &mut V) {
        self.middle.copy_from(&self.point.p);
        self.middle
            .accumulate(V::Scalar::constant(0.5, 0.0), change);
        next.set_zero();
        (self.field).add(self.t, &self.point.q, self.middle, self.drift, next);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self, change: &V) -> <V::Scalar as Real>::Size {
        self.point.p.size() + change.size()
    }
}

impl<V: Vector, F: VectorField<V>> Flow<Point<V>> for SubStep<F> {
    const NAME: &'static str = "force";
    const MERGES: bool = false;
    type Work = Momenta<V>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: V::Scalar, x: &mut Point<V>, Momenta(work): &mut Momenta<V>) {
        let [change, next, middle, drift] = work;
        change.set_zero();
        let mut equation = MomentumEquation {
            field: &self.0,
            t,
            point: x,
            middle,
            drift,
        };
        let outcome = iterate(LIMIT, &mut equation, change, next);
        x.p.accumulate(V::Scalar::one(), change);
        if !outcome.solved.all() {
            x.p.poison(!outcome.solved);
        }
    }
}
