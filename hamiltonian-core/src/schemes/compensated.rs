//! Compensated summation: rounding errors are carried as low words.
//!
//! Input: a table of weights and H = T(p, t) + V(q, t). Output: [`Compensated`]. Invariant: the point
//! and its low words together are the sum of all kicks and drifts to twice the digits; kicks and drifts
//! themselves are computed at the point.
//!
//! Exact flows that are not sums (rotations, scalings, friction) have no increment to carry: the bounds
//! are [`Separable`] and [`Unforced`].

use super::splitting::Splitting;
use super::zigzag::Zigzag;
use crate::flows::map::Step;
use crate::schemes::scheme::{Entry, Listed, Needs, Scheme, Symmetric};
use crate::systems::flow::{Flow, Piece, Pieces, Scratch};
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::{Separable, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// A splitting into kicks and drifts by the table `M`, with compensated summation: its rounding errors
/// are those of J∇H alone, which are smaller by the factor h.
///
/// ```text
/// y = low + cF;   z[+] = z + y;   low[+] = (z − z[+]) + y
/// ```
///
/// for each kick and each drift. The low words are part of the carried value, and of checkpoints. The
/// durations of the stages are rounded so that kicks, and drifts, add up to h exactly, for a clock that
/// is wrong by ε makes an error that grows like t. Kick first; preserves dq∧dp. Costs three additions a
/// component.
///
/// Source: W. Kahan, Commun. ACM 8 (1965) 40, doi:10.1145/363707.363723; E. Hairer, C. Lubich,
/// G. Wanner, Geometric Numerical Integration (2006), section VIII.5, doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Compensated;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, Compensated(KahanLi8), start, 0.1)?;
/// assert!((run.advance(1_000)?.q[0] - 100.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Error>(())
/// ```
///
/// Friction is not a sum: a system with a force is refused.
///
/// ```compile_fail,E0277
/// use hamiltonian::{Scheme, Separable};
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::Compensated;
///
/// fn takes<S: Separable>() where Compensated<Strang>: Scheme<S> {}
/// fn with_or_without_a_force<S: Separable>() { takes::<S>() }
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Compensated<M>(pub M);

impl<M: Splitting> Listed for Compensated<M> {
    fn entry(&self) -> Entry {
        let of = self.0.entry();
        Entry {
            name: "Compensated",
            variant: of.name,
            needs: Needs::SEPARABLE.and(Needs::UNFORCED),
            ..of
        }
    }
}

symmetric!(Compensated<M>, M: Splitting + Symmetric);

/// The point and its low words.
type Words<V> = Pair<Point<V>, Point<V>>;

/// `z + low` as a new z and its rounding error, for |low| ≤ |z|, which holds after a few steps.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn carry<V: Vector>(z: &mut V, low: &mut V) {
    for k in 0..V::PARTS {
        for (z, low) in z.part_mut(k).iter_mut().zip(low.part_mut(k)) {
            let before = *z;
            let sum = before + *low;
            // This is exact even if the low word is the larger one (Knuth).
            let rest = sum - before;
            *low = (before - (sum - rest)) + (*low - rest);
            *z = sum;
        }
    }
}

/// A kick (if `KICK`) or a drift that adds to the low words and carries.
#[derive(Debug, Clone, Copy)]
pub struct Carrying<A, const KICK: bool>(A);

/// The scalar of a flow of points.
#[derive(Debug)]
pub struct OfPoint<W>(W);

impl<V: Vector, W: Scratch<Point<V>>> Scratch<Words<V>> for OfPoint<W> {
    fn like(words: &Words<V>) -> Self {
        OfPoint(W::like(&words.x))
    }
}

impl<V: Vector, F: Flow<Point<V>>, const KICK: bool> Flow<Words<V>> for Carrying<F, KICK> {
    const NAME: &'static str = F::NAME;
    type Work = OfPoint<F::Work>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: V::Scalar, z: &mut Words<V>, OfPoint(work): &mut Self::Work) {
        let Pair { x: point, y: low } = z;
        let (moved, low) = if KICK {
            (&mut point.p, &mut low.p)
        } else {
            (&mut point.q, &mut low.q)
        };
        // The flow adds its increment to the existing values.
        core::mem::swap(moved, low);
        self.0.apply(t, point, work);
        let moved = if KICK { &mut point.p } else { &mut point.q };
        core::mem::swap(moved, low);
        carry(moved, low);
    }
}

impl<T, P, V, A, const KICK: bool> Piece<T, P> for Carrying<A, KICK>
where
    T: Real,
    V: Vector<Scalar = T>,
    A: Piece<T, P, Point = Point<V>>,
{
    type Point = Words<V>;
    type Flow = Carrying<A::Flow, KICK>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn flow(&self, prepared: &P, c: T) -> Self::Flow {
        Carrying(self.0.flow(prepared, c))
    }
}

/// Kick and drift of a system with low words.
type KickAndDrift<T, S> = (
    Carrying<<S as Separable>::Kick<T>, true>,
    Carrying<<S as Separable>::Drift<T>, false>,
);

impl<S: Separable + Unforced, M: Splitting> Scheme<S> for Compensated<M> {
    type Carried = Words<S::Shape>;
    type Map<T: Real> = Zigzag<
        Words<VectorOf<S, T>>,
        <KickAndDrift<T, S> as Pieces<T, S::Prepared<T>>>::Outer,
        <KickAndDrift<T, S> as Pieces<T, S::Prepared<T>>>::Inner,
        M,
    >;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let halves = (Carrying(S::kick::<T>()), Carrying(S::drift::<T>()));
        Zigzag::exact(&self.0, &halves, prepared, step)
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Words<VectorOf<S, T>> {
        let point = state.point();
        Pair {
            y: point.zeros_like(),
            x: point,
        }
    }
}
