//! Cheap post-processors: the observed state as the mean of two points near the kernel's.
//!
//! Input: a [`Processed`] scheme and the table of ρ. Output: [`CheapProcessed`]. Invariant: the carried value
//! has the bits of the processed scheme; the mean is part of the observed copy alone.

use super::processed::{Kernel4, PostProcessor, Processed, ProcessedMap, Processor4, weights};
use super::splitting::{Durations, Negated, Splitting};
use super::tables::processed as tables;
use super::zigzag::{Zigzag, ZigzagOf};
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::{Flow, Pieces};
use crate::systems::state::{Carried, Point, State};
use crate::systems::system::{Exact, Split, VectorOf};
use hamiltonian_lanes::Real;

/// A [`Processed`] scheme whose observed states are means instead of images under π:
///
/// ```text
/// z + ½ (ρ(h) z − z) + ½ (ρ(−h) z − z)
/// ```
///
/// z is the point that the kernel carries, ρ a composition of the exact flows whose durations sum to zero. The
/// processor π of a symmetric kernel is even in h up to its order, and so is the mean. Therefore ρ satisfies
/// fewer conditions than π, and is shorter.
///
/// The carried values, and so the trajectory, have the bits of the [`Processed`] scheme. An observed state of
/// [`CheapProcessed4`] is off from that of the processed scheme by O(h⁵). This does not grow with time, because no
/// later step depends on it. A run that starts from an observed state, and a part of a step, begin at a point that is
/// off by as much.
///
/// Of the invariants that all flows share, the mean preserves linear ones. Quadratic ones, such as the angular momentum,
/// change by O(h⁶): with H = (p_x² + p_y²)/2 + (x² + y²)²/4 and h = 0.2, 0.1, 0.05 by 1.3e-8, 2.1e-10, 3.3e-12;
/// [`Processed4`](super::Processed4) preserves them up to rounding. The observed state does not preserve dq∧dp, which
/// the carried value does.
///
/// ρ belongs to one processor π. The [entry](Listed::entry) has the name of ρ, and the lesser order of the two.
///
/// Source: after S. Blanes, F. Casas, A. Murua, SIAM J. Numer. Anal. 42 (2004) 531, doi:10.1137/S0036142902417029,
/// whose cheap post-processors are weighted sums of the kernel's stages; the mean and its table are by
/// `scripts/coefficients.py`.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::{CheapProcessed4, Processed4};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, CheapProcessed4::default(), start.clone(), 0.1)?;
/// assert!((run.advance(10)?.q[0] - 1.0_f64.cos()).abs() < 1e-6);
/// // The carried value is that of the processed scheme.
/// let mut processed = Integrator::new(&Oscillator {}, Processed4::default(), start, 0.1)?;
/// processed.advance(10)?;
/// assert_eq!(run.carried(), processed.carried());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CheapProcessed<K, P, R> {
    /// The scheme of the carried values.
    processed: Processed<K, P>,
    /// ρ.
    mean_of: R,
}

impl<K, P, R> CheapProcessed<K, P, R> {
    /// Returns the scheme that carries the values of `processed` and shows the mean ρ.
    #[must_use]
    pub fn new(processed: Processed<K, P>, mean_of: R) -> Self {
        CheapProcessed { processed, mean_of }
    }

    /// The scheme of the carried values.
    #[must_use]
    pub fn processed(&self) -> &Processed<K, P> {
        &self.processed
    }

    /// ρ.
    #[must_use]
    pub fn mean_of(&self) -> &R {
        &self.mean_of
    }
}

impl<K: Splitting, P: Splitting, R: Splitting> Listed for CheapProcessed<K, P, R> {
    fn entry(&self) -> Entry {
        let entry = self.mean_of.entry();
        Entry {
            order: entry.order.min(self.processed.entry().order),
            preserves: Form::CarriedPoint,
            ..entry
        }
    }
}

impl<S, K, P, R> Scheme<S> for CheapProcessed<K, P, R>
where
    S: Split + Exact,
    K: Splitting,
    P: Splitting,
    R: Splitting,
{
    type Carried = Point<S::Shape>;
    type Map<T: Real> = ProcessedMap<
        Point<VectorOf<S, T>>,
        <S::Pieces<T> as Pieces<T, S::Prepared<T>>>::Outer,
        <S::Pieces<T> as Pieces<T, S::Prepared<T>>>::Inner,
        K,
        P,
        Mean<ZigzagOf<T, S, S::Pieces<T>, R>, ZigzagOf<T, S, S::Pieces<T>, Negated<R>>>,
    >;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let (pieces, whole) = (&S::pieces::<T>(), Step::of(step.h));
        let mean = Mean {
            forward: Zigzag::new(&self.mean_of, pieces, prepared, whole),
            backward: Zigzag::new(&Negated(self.mean_of), pieces, prepared, whole),
        };
        ProcessedMap::new(&self.processed, mean, pieces, prepared, step)
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}

/// The mean of a [`CheapProcessed`] scheme for a given step.
#[derive(Debug)]
pub struct Mean<F, B> {
    /// ρ(h).
    forward: F,
    /// ρ(−h).
    backward: B,
}

impl<X, O, I, R> PostProcessor<X, (O::Work, I::Work)>
    for Mean<Zigzag<X, O, I, R>, Zigzag<X, O, I, Negated<R>>>
where
    X: Carried,
    O: Flow<X>,
    I: Flow<X>,
    R: Splitting,
{
    /// The images of the point under ρ(h) and ρ(−h).
    type Work = (X, X);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn post_process(&self, t: X::Scalar, z: &mut X, work: &mut ((O::Work, I::Work), (X, X))) {
        let (flows, (ahead, behind)) = work;
        ahead.copy_from(z);
        self.forward.step(t, t, ahead, flows);
        behind.copy_from(z);
        self.backward.step(t, t, behind, flows);
        let half = X::Scalar::constant(0.5, 0.0);
        for k in 0..X::PARTS {
            let moved = ahead.part(k).iter().zip(behind.part(k));
            for (z, (ahead, behind)) in z.part_mut(k).iter_mut().zip(moved) {
                *z += half * ((*ahead - *z) + (*behind - *z));
            }
        }
    }

    #[cold]
    fn blame(&self, t: X::Scalar, z: &mut X, work: &mut ((O::Work, I::Work), (X, X))) -> Cause {
        let (flows, (moved, _)) = work;
        moved.copy_from(z);
        let cause = self.forward.explain(t, t, true, moved, flows);
        if !moved.is_finite() {
            return cause;
        }
        self.backward.explain(t, t, true, z, flows)
    }
}

weights! {
    /// ρ of [`CheapProcessed4`].
    Mean4: tables::MEAN_4, stages, 3, CheapProcessed4
}

/// [`Processed4`](super::Processed4) with an observed state that costs 2 × 2½ stages instead of 12. If every step, or
/// every second one, is observed, [`BlanesMoan4`](super::BlanesMoan4) takes fewer stages.
///
/// The carried values preserve dq∧dp. See [`CheapProcessed`].
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::CheapProcessed4;
///
/// let start = State::new([1.0], [0.0]);
/// let mut largest = 0.0_f64;
/// let run = Integrator::new(&Oscillator {}, CheapProcessed4::default(), start, 0.05)?;
/// let mut run = run.watch(4, |view| largest = largest.max((view.state.q[0] - view.state.t.cos()).abs()));
/// run.advance(40)?;
/// drop(run);
/// assert!(largest < 1e-6);
/// # Ok::<(), Error>(())
/// ```
pub type CheapProcessed4 = CheapProcessed<Kernel4, Processor4, Mean4>;
