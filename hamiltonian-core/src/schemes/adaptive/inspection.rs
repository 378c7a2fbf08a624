//! Schemes with an estimate of their error, and their steps in lanes.
//!
//! Input: a map, sizes, and the conditions on a step. Output: steps, until one fails. Invariant: a step that
//! is refused in lanes is refused alone.

use super::energy::StepConditions;
use super::tolerance::{Estimate, STAGES, Tolerance};
use crate::flows::map::{Clock, Map};
use crate::schemes::bundles::{Apart, StageLayout, in_bundles, store};
use crate::schemes::gauss::Gauss;
use crate::schemes::scheme::{CarriedBy, OneStep, Scheme};
use crate::schemes::second_order::GaussNystrom;
use crate::schemes::staged::{Inspect, StagedMap};
use crate::systems::state::Point;
use crate::systems::system::{QuadraticKinetic, Separable, System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// A scheme with an estimate of its error, whose map can change its step at little cost. [`Adaptive`](super::Adaptive)
/// requires it; [`Gauss`] and [`GaussNystrom`] with eight stages implement it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no estimate of the error of a step of `{S}`",
    label = "a tolerance needs one",
    note = "`Gauss::<8>` and, for a quadratic T without forces, `GaussNystrom::<8>` have it"
)]
pub trait Estimates<S: System>: OneStep + Scheme<S> {
    /// True if the scheme requires H = ½pᵀM⁻¹p + V(q, t).
    const IS_OF_SECOND_ORDER: bool;
    /// The estimate of errors with this tolerance.
    fn estimate<T: Real>(&self, tolerance: Tolerance) -> Estimate<T>;
    /// Copies a map. The equations of the copy fail where they converge slowly.
    fn copy<T: Real>(of: &Self::Map<T>) -> Self::Map<T>;
    /// Makes `to`, a copy of `from`, the map for a step `by` times that of `from`.
    fn resize<T: Real>(from: &Self::Map<T>, by: T, to: &mut Self::Map<T>);
    /// The estimated error of a step of size `h` that led from `before` to `after`, in units of the tolerated one. If it
    /// is not `EXACT`, then 0 or 2 for one that is at most 1 or not, without roots and most quotients; 2 where they
    /// would be needed.
    fn error<T: Real, const EXACT: bool>(
        estimate: &Estimate<T>,
        h: T,
        before: &Point<VectorOf<S, T>>,
        after: &CarriedBy<Self, S, T>,
    ) -> T;
    /// The change at the ends of a step of size h from t, in units of the tolerated one: that of H, or that of the slopes
    /// from the polynomial of the stages.
    fn change<T: Real>(
        conditions: &mut StepConditions<'_, T, S>,
        h_t: (T, T),
        before: &Point<VectorOf<S, T>>,
        after: &CarriedBy<Self, S, T>,
        energies: [T; 2],
    ) -> T;
    /// Makes up to `n` steps with stages beside each other, until one fails a condition or is not solved, or the
    /// sizes end. Returns their number, and whether one more was refused: the value carried is then that after it, that
    /// before it is `before`. There are none if there are no lanes. The maps are that for the size `h`, and a
    /// [copy](Estimates::copy) of it for any size.
    fn steps<T: Real, Z: Sizes<T, VectorOf<S, T>>>(
        conditions: &mut StepConditions<'_, T, S>,
        maps: [&Self::Map<T>; 2],
        h_time_n: (T, [T; 2], u64),
        sizes: &mut Z,
        z: &mut CarriedBy<Self, S, T>,
        before: &mut CarriedBy<Self, S, T>,
        work: &mut WorkBy<Self, S, T>,
    ) -> (u64, bool);
}

/// The sizes of the steps of a run, one after the other.
pub trait Sizes<T: Real, V: Vector<Scalar = T>> {
    /// The size of the step that is made now, in units of the map's.
    fn size(&self) -> T;
    /// Goes on to the step after one that led to this time, with its low word, and this point. Returns false if its size
    /// needs a closer look.
    fn next(&mut self, time: [T; 2], point: &Point<V>) -> bool;
}

/// A system with a scheme that follows a tolerance, for
/// [`Integrator::to_tolerance`](crate::Integrator::to_tolerance).
///
/// `hamiltonian!` implements it: the scheme is [`GaussNystrom`] if T is proven to be quadratic and no
/// force acts, and [`Gauss`] otherwise, each with eight stages. A system written by hand names its scheme:
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::ToTolerance;
#[doc = include_str!("../../doc/oscillator.md")]
///
/// fn scheme<S: ToTolerance>(_: &S) -> String {
///     S::Scheme::default().entry().to_string()
/// }
/// use hamiltonian::schemes::author::Listed;
/// assert_eq!(scheme(&Oscillator {}), "GaussNystrom (8 stages)");
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` names no scheme that follows a tolerance",
    label = "this run takes its scheme from the system",
    note = "in generic code bound the system, `S: ToTolerance`",
    note = "a system written by hand: `impl ToTolerance for … {{ type Scheme = Gauss<8>; }}`"
)]
pub trait ToTolerance: System + Sized {
    /// The scheme.
    type Scheme: Estimates<Self> + Default;
}

/// The map of the scheme `M` over `T`, which carries the same as `M` does.
pub(super) type MapBy<M, S, T> = <M as Scheme<S>>::Map<T>;
/// Its scratch.
pub(super) type WorkBy<M, S, T> = <MapBy<M, S, T> as Map>::Work;

/// The most iterations of a step over `f64`. Shorter steps take less time than steps with more of them.
const ITERATIONS: f64 = 40.0;

/// The most iterations of a step: each gives as many digits as the one before.
fn most_iterations<T: Real>() -> u32 {
    (ITERATIONS * Real::ln(T::epsilon()) / Real::ln(f64::EPSILON)) as u32
}

/// Looks at the estimated errors of steps, and at their ends.
struct ErrorInspection<'a, 'b, T: Real, S: System, Y, Z> {
    conditions: &'a mut StepConditions<'b, T, S>,
    /// The size of the map's steps.
    h: T,
    sizes: &'a mut Z,
    /// True if no step follows.
    ends: bool,
    /// The time and its low word.
    time: [T; 2],
    /// The point before the step, and its low words.
    before: [&'a mut Point<VectorOf<S, T>>; 2],
    /// H there.
    energy: T,
    /// The unknowns of the step before one that is refused.
    unknowns: &'a mut [Y; STAGES],
    is_refused: bool,
}

impl<T, S, Y, Z> Inspect<T, VectorOf<S, T>, STAGES> for ErrorInspection<'_, '_, T, S, Y, Z>
where
    T: Real,
    S: System,
    Y: Vector<Scalar = T>,
    Z: Sizes<T, VectorOf<S, T>>,
{
    const LOOKS: bool = true;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn size(&self) -> T {
        self.sizes.size()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn ends(&self) -> bool {
        self.ends
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn begins(&self, _: Clock<T>, _: u64) -> T {
        self.time[0]
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn keep(&mut self, point: &Point<VectorOf<S, T>>, low: &Point<VectorOf<S, T>>) {
        self.before[0].copy_from(point);
        self.before[1].copy_from(low);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn accepts<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(
        &mut self,
        point: &Point<VectorOf<S, T>>,
        slopes: &[X; STAGES],
    ) -> bool {
        let ErrorInspection {
            conditions,
            energy,
            time,
            before,
            sizes,
            ..
        } = self;
        let h = self.h * sizes.size();
        let (estimate, t) = (conditions.estimate, time[0]);
        let [last, before_last, begin, end] = &estimate.weights;
        let weights = [
            in_bundles::<T, L, STAGES>(last),
            in_bundles::<T, L, STAGES>(before_last),
            in_bundles::<T, L, STAGES>(begin),
            in_bundles::<T, L, STAGES>(end),
        ];
        let error = estimate.error::<L, _, X, false>(&weights, h, before[0], point, slopes);
        if !(error.le(T::one()) & moves(t, h)).all() {
            return false;
        }
        // The time at which the next step begins, in this block or in another one.
        let later = later(*time, h);
        let energies = [*energy, conditions.energy(later[0], point)];
        let ends = [&*before[0], point];
        let change = conditions.change::<L, X>(&weights, (h, t), ends, slopes, energies);
        if !change.le(T::one()).all() {
            return false;
        }
        *energy = energies[1];
        *time = later;
        self.ends = !sizes.next(*time, point);
        true
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn refuse<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(&mut self, before: &[X; STAGES]) {
        store::<T, L, _, _, STAGES>(before, self.unknowns);
        self.is_refused = true;
    }
}

/// The smallest step in units of the rounding of t.
const STUCK: f64 = 0.01;

/// The lanes in which a step moves the time.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn moves<T: Real>(t: T, h: T) -> T::Mask {
    (t.abs() * T::constant(T::epsilon() * STUCK, 0.0)).lt(h.abs())
}

/// A time and its low word after a step.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn later<T: Real>([t, low]: [T; 2], h: T) -> [T; 2] {
    let by = h + low;
    let end = t + by;
    // Exact whichever of the two is larger (D. E. Knuth, The Art of Computer Programming, section 4.2.2).
    let moved = end - t;
    [end, (t - (end - moved)) + (by - moved)]
}

macro_rules! estimates {
    ($scheme:ident, $is_of_second_order:literal $(, $bound:ident)*) => {
        impl<S: System $(+ $bound)*> Estimates<S> for $scheme<STAGES> {
            const IS_OF_SECOND_ORDER: bool = $is_of_second_order;
            fn estimate<T: Real>(&self, tolerance: Tolerance) -> Estimate<T> {
                Estimate::new(&self.coefficients, tolerance)
            }
            fn copy<T: Real>(of: &Self::Map<T>) -> Self::Map<T> {
                let mut map = of.clone();
                map.restrict(most_iterations::<T>());
                map
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn resize<T: Real>(from: &Self::Map<T>, by: T, to: &mut Self::Map<T>) {
                from.resize(by, to);
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn error<T: Real, const EXACT: bool>(
                estimate: &Estimate<T>,
                h: T,
                before: &Point<VectorOf<S, T>>,
                after: &CarriedBy<Self, S, T>,
            ) -> T {
                let (point, slopes) = (&after.x, &after.y.x.0);
                estimate.error::<Apart, _, _, EXACT>(&estimate.weights, h, before, point, slopes)
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn change<T: Real>(
                conditions: &mut StepConditions<'_, T, S>,
                step: (T, T),
                before: &Point<VectorOf<S, T>>,
                after: &CarriedBy<Self, S, T>,
                energies: [T; 2],
            ) -> T {
                let weights = &conditions.estimate.weights;
                conditions.change::<Apart, _>(weights, step, [before, &after.x], &after.y.x.0, energies)
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn steps<T: Real, Z: Sizes<T, VectorOf<S, T>>>(
                conditions: &mut StepConditions<'_, T, S>,
                [map, copy]: [&Self::Map<T>; 2],
                (h, time, n): (T, [T; 2], u64),
                sizes: &mut Z,
                z: &mut CarriedBy<Self, S, T>,
                before: &mut CarriedBy<Self, S, T>,
                work: &mut WorkBy<Self, S, T>,
            ) -> (u64, bool) {
                let mut inspection = ErrorInspection {
                    energy: conditions.energy(time[0], &z.x),
                    conditions,
                    h,
                    sizes,
                    ends: false,
                    time,
                    before: [&mut before.x, &mut before.y.y],
                    unknowns: &mut before.y.x.0,
                    is_refused: false,
                };
                let clock = (Clock::between(time[0], time[0] + h), 0, n);
                let made = T::out_of_line(
                    #[cfg_attr(not(unoptimised), inline(always))]
                    || copy.steps_in_lanes(map, clock, z, work, &mut inspection),
                );
                (made.unwrap_or(0), inspection.is_refused)
            }
        }
    };
}

estimates!(Gauss, false);
estimates!(GaussNystrom, true, Separable, QuadraticKinetic, Unforced);
