//! The error of one step of Gauss collocation, estimated from its stages.
//!
//! Input: a step of eight stages and a [`Tolerance`]. Output: the estimated error in units of the tolerated one.
//! Invariant: the estimate is the same for the step backwards, so that decisions by it are reversible.

use super::energy::Asked;
use crate::errors::{Error, StartError};
use crate::flows::map::{Clock, Map};
use crate::schemes::bundles::{Apart, StageLayout, in_bundles, number, spread, store, sum};
use crate::schemes::collocation::{Collocation, constant};
use crate::schemes::gauss::Gauss;
use crate::schemes::scheme::{CarriedBy, OneStep, Scheme};
use crate::schemes::second_order::GaussNystrom;
use crate::schemes::staged::{Inspect, StagedMap};
use crate::systems::state::Point;
use crate::systems::system::{QuadraticKinetic, Separable, System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The number of stages of schemes that follow a tolerance. The constants below belong to it.
pub(super) const STAGES: usize = 8;

/// The tolerated error of one step.
///
/// A step from x to x′ may change each coordinate and each momentum by an error of
///
/// ```text
/// min(absolute + relative·max(|xᵢ|, |xᵢ′|, 2⁻²⁰·max |xⱼ|), 1e-8·max |xⱼ|) + 4ε·max |xⱼ|
/// ```
///
/// where j runs over all coordinates, or over all momenta, and ε is the spacing of numbers at 1. The terms in 2⁻²⁰ and in ε
/// keep components that are small beside the others, or rounding, from deciding. A tolerance above 1e-8 is met by the
/// steps of 1e-8: with longer ones, the equations of a step take more iterations, and a run takes no less time.
///
/// A number is a relative tolerance:
///
/// ```
/// use hamiltonian::schemes::Tolerance;
///
/// assert_eq!(Tolerance::from(1e-10), Tolerance { relative: 1e-10, absolute: 0.0 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// In units of the coordinate or momentum itself.
    pub relative: f64,
    /// In the units of coordinates and of momenta.
    pub absolute: f64,
}

impl Tolerance {
    /// Refuses what no step can meet.
    pub(crate) fn check(self) -> Result<(), Error> {
        let Tolerance { relative, absolute } = self;
        // This is false for NaN.
        let is_size = |x: f64| x >= 0.0 && x.is_finite();
        match is_size(relative) && is_size(absolute) && relative + absolute > 0.0 {
            true => Ok(()),
            false => Err(StartError::Tolerance { relative, absolute }.into()),
        }
    }
}

impl From<f64> for Tolerance {
    fn from(relative: f64) -> Self {
        Tolerance {
            relative,
            absolute: 0.0,
        }
    }
}

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
        asked: &mut Asked<'_, T, S>,
        h_t: (T, T),
        before: &Point<VectorOf<S, T>>,
        after: &CarriedBy<Self, S, T>,
        energies: [T; 2],
    ) -> T;
    /// Makes up to `n` steps with stages beside each other, until one is not what is asked or is not solved, or the
    /// sizes end. Returns their number, and whether one more was refused: the value carried is then that after it, that
    /// before it is `before`. There are none if there are no lanes. The maps are that for the size `h`, and a
    /// [copy](Estimates::copy) of it for any size.
    fn steps<T: Real, Z: Sizes<T, VectorOf<S, T>>>(
        asked: &mut Asked<'_, T, S>,
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

/// The larger of two numbers; the second if one is NaN.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn larger<T: Real>(a: T, b: T) -> T {
    T::select(b.lt(a), a, b)
}

/// The larger of two numbers; NaN if one is NaN.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn worse<T: Real>(a: T, b: T) -> T {
    T::select(a.lt(b) | !b.equals(b), b, a)
}

/// The largest size of a component.
#[cfg_attr(not(unoptimised), inline(always))]
fn most<V: Vector>(x: &V) -> V::Scalar {
    let mut most = V::Scalar::zero();
    for k in 0..V::PARTS {
        for x in x.part(k) {
            most = larger(most, x.abs());
        }
    }
    most
}

/// The error of a step over `h·r²√r` times its slope. The errors that follow are tested at the ends of runs of twenty
/// problems, among them Kepler's with e = 0.99, the restricted three-body problem and H = ½(q² + 1)(p² + 1).
const FACTOR: f64 = 0.5;

/// The part of a step before its first stage, and beyond its last one.
const UNSEEN: f64 = 0.02;
/// The largest difference of the slope at an end from the stages' polynomial, in units of its last coefficient.
const DEFECT: f64 = 4.0;

/// The largest tolerance of a step, in units of the largest coordinate or momentum: steps with larger errors take so many
/// iterations that a run takes no less time.
const LOOSEST: f64 = 1e-8;

/// The most iterations of a step over `f64`. Shorter steps take less time than steps with more of them.
const ITERATIONS: f64 = 40.0;

/// The most iterations of a step: each gives as many digits as the one before.
fn most_iterations<T: Real>() -> u32 {
    (ITERATIONS * Real::ln(T::epsilon()) / Real::ln(f64::EPSILON)) as u32
}

/// The tolerated errors of a group, coordinates or momenta.
struct Tolerated<T> {
    tolerance: Tolerance,
    most: T,
}

impl<T: Real> Tolerated<T> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn of<V: Vector<Scalar = T>>(tolerance: Tolerance, before: &V, after: &V) -> Self {
        Tolerated {
            tolerance,
            most: larger(most(before), most(after)),
        }
    }

    /// The tolerated error of a component that was `before` and is `after`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn error(&self, before: T, after: T) -> T {
        /// 2⁻²⁰.
        const SMALL: f64 = 1.0 / (1_u64 << 20) as f64;
        let small = T::constant(SMALL, 0.0) * self.most;
        let rounding = T::constant(4.0 * T::epsilon(), 0.0) * self.most;
        let size = larger(larger(before.abs(), after.abs()), small);
        let asked = T::constant(self.tolerance.absolute, 0.0)
            + T::constant(self.tolerance.relative, 0.0) * size;
        let most = T::constant(LOOSEST, 0.0) * self.most;
        T::select(most.lt(asked), most, asked) + rounding
    }

    /// The error `FACTOR·r²√r·of` in units of the tolerated one, as in [`Estimates::error`].
    #[cfg_attr(not(unoptimised), inline(always))]
    fn share<const EXACT: bool>(&self, r: T, of: T, before: T, after: T) -> T {
        let [zero, two] = [T::zero(), T::constant(2.0, 0.0)];
        let tolerated = self.error(before, after);
        let error = T::constant(FACTOR, 0.0) * (r * r) * of;
        if EXACT {
            let error = error.abs() * r.sqrt();
            return T::select(error.equals(zero), error, error / tolerated);
        }
        let tolerated = tolerated * tolerated;
        // The squares of very small numbers are 0.
        let is_met = (error * error * r).le(tolerated) & zero.lt(tolerated);
        T::select(is_met, zero, two)
    }
}

/// The estimate of an error from the slopes at the stages, or from the forces there.
#[derive(Debug, Clone, Copy)]
pub struct Estimate<T> {
    tolerance: Tolerance,
    /// Weights of the stages in the last two coefficients of the slopes' polynomial, in Legendre's polynomials, and in its
    /// values at the ends of the step.
    weights: [[T; STAGES]; 4],
}

impl<T: Real> Estimate<T> {
    fn new(method: &Collocation<STAGES>, tolerance: Tolerance) -> Self {
        let weights = method.of_slopes().map(|row| row.map(constant));
        Estimate { tolerance, weights }
    }

    /// Σ |∂H/∂xᵢ|·(the tolerated error of xᵢ) of a step, and Σ |xᵢ·∂H/∂xᵢ|. `slope` is J∇H.
    pub(super) fn change_of_energy<V: Vector<Scalar = T>>(
        &self,
        [before, after]: [&Point<V>; 2],
        slope: &Point<V>,
    ) -> [T; 2] {
        let [mut tolerated, mut size] = [T::zero(); 2];
        for (before, after, slope) in [
            (&before.q, &after.q, &slope.p),
            (&before.p, &after.p, &slope.q),
        ] {
            let group = Tolerated::of(self.tolerance, before, after);
            for k in 0..V::PARTS {
                for i in 0..slope.part(k).len() {
                    let [from, to] = [before.part(k)[i], after.part(k)[i]];
                    let slope = slope.part(k)[i].abs();
                    tolerated += slope * group.error(from, to);
                    size += slope * larger(from.abs(), to.abs());
                }
            }
        }
        [tolerated, size]
    }

    /// The last Legendre coefficient r of number `i` of part `k` of the slopes in units of its largest size, and that
    /// size.
    ///
    /// If the coefficients decay like ρ⁻ᵏ, r is ρ⁻⁷, and the relative error of the quadrature, of order 17 in h, is near
    /// ρ⁻¹⁷ = r^(17/7). [`FACTOR`]·r²√r bounds it. So that a coefficient that happens to vanish does not hide the error,
    /// the one before it counts an eighth.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn tail<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(
        weights: &WeightsOf<L, T>,
        slopes: &[X; STAGES],
        (k, i): (usize, usize),
    ) -> [T; 2] {
        let last = spread::<T, L, _, 1, STAGES>([&weights[0]], slopes, k, i);
        let before = spread::<T, L, _, 1, STAGES>([&weights[1]], slopes, k, i);
        let last = sum::<T, L, STAGES>(&last);
        let before = sum::<T, L, STAGES>(&before);
        let few = spread::<T, L, _, 0, STAGES>([], slopes, k, i);
        let mut most = T::zero();
        for stage in 0..STAGES {
            most = larger(most, number::<T, L, STAGES>(&few, stage).abs());
        }
        let tail = larger(last.abs(), before.abs() * T::constant(0.125, 0.0));
        let is_zero = most.equals(T::zero());
        [tail / T::select(is_zero, T::one(), most), most]
    }

    /// The largest difference of the slopes at the ends of a step from their polynomial there, in units of the tolerated
    /// one. Beyond the last stage lies a part of the step that no stage sees, with the weight [`UNSEEN`]; a polynomial of
    /// slopes is worth what its last coefficient is.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn defect<L, V, X>(
        &self,
        weights: &WeightsOf<L, T>,
        h: T,
        [before, after]: [&Point<V>; 2],
        slopes: &[X; STAGES],
        at_ends: &[Point<V>; 2],
    ) -> T
    where
        L: StageLayout<T>,
        V: Vector<Scalar = T>,
        X: Vector<Scalar = L::Bundle>,
    {
        let q = Tolerated::of(self.tolerance, &before.q, &after.q);
        let p = Tolerated::of(self.tolerance, &before.p, &after.p);
        let per = (T::constant(UNSEEN, 0.0) * h.abs()).recip();
        let mut worst = T::zero();
        for k in 0..X::PARTS {
            for i in 0..slopes[0].part(k).len() {
                let [r, most] = Self::tail::<L, X>(weights, slopes, (k, i));
                // Forces stand for ∂V/∂q.
                let (group, part, sign) = match X::PARTS > V::PARTS {
                    true if k < V::PARTS => (&q, k, 1.0),
                    true => (&p, k, 1.0),
                    false => (&p, k + V::PARTS, -1.0),
                };
                let tolerated = group.error(before.part(part)[i], after.part(part)[i]) * per
                    + T::constant(DEFECT, 0.0) * r * most;
                for (weights, slope) in weights[2..].iter().zip(at_ends) {
                    let of = spread::<T, L, _, 1, STAGES>([weights], slopes, k, i);
                    let of = sum::<T, L, STAGES>(&of) * T::constant(sign, 0.0);
                    worst = worse(worst, (slope.part(part)[i] - of).abs() / tolerated);
                }
            }
        }
        worst
    }

    /// The error of a step in units of the tolerated one, from the slopes at its stages, or from the forces there: their
    /// relative error is taken for that of the coordinates' change as well.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn error<L, V, X, const EXACT: bool>(
        &self,
        weights: &WeightsOf<L, T>,
        h: T,
        before: &Point<V>,
        after: &Point<V>,
        slopes: &[X; STAGES],
    ) -> T
    where
        L: StageLayout<T>,
        V: Vector<Scalar = T>,
        X: Vector<Scalar = L::Bundle>,
    {
        let q = Tolerated::of(self.tolerance, &before.q, &after.q);
        let p = Tolerated::of(self.tolerance, &before.p, &after.p);
        let mut worst = T::zero();
        for k in 0..X::PARTS {
            for i in 0..slopes[0].part(k).len() {
                let [r, most] = Self::tail::<L, X>(weights, slopes, (k, i));
                let of = most * h;
                if X::PARTS > V::PARTS {
                    let group = if k < V::PARTS { &q } else { &p };
                    let ends = [before.part(k)[i], after.part(k)[i]];
                    worst = worse(worst, group.share::<EXACT>(r, of, ends[0], ends[1]));
                } else {
                    let [q0, q1] = [before.q.part(k)[i], after.q.part(k)[i]];
                    let [p0, p1] = [before.p.part(k)[i], after.p.part(k)[i]];
                    worst = worse(worst, q.share::<EXACT>(r, q1 - q0, q0, q1));
                    worst = worse(worst, p.share::<EXACT>(r, of, p0, p1));
                }
            }
        }
        worst
    }
}

/// The weights of the stages of a step in bundles.
pub(super) type WeightsOf<L, T> = [[<L as StageLayout<T>>::Bundle; STAGES]; 4];

/// Looks at the estimated errors of steps, and at their ends.
struct ErrorInspection<'a, 'b, T: Real, S: System, Y, Z> {
    asked: &'a mut Asked<'b, T, S>,
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
            asked,
            energy,
            time,
            before,
            sizes,
            ..
        } = self;
        let h = self.h * sizes.size();
        let (estimate, t) = (asked.estimate, time[0]);
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
        let energies = [*energy, asked.energy(t + h, point)];
        let ends = [&*before[0], point];
        let change = asked.change::<L, X>(&weights, (h, t), ends, slopes, energies);
        if !change.le(T::one()).all() {
            return false;
        }
        *energy = energies[1];
        *time = later(*time, h);
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
                asked: &mut Asked<'_, T, S>,
                step: (T, T),
                before: &Point<VectorOf<S, T>>,
                after: &CarriedBy<Self, S, T>,
                energies: [T; 2],
            ) -> T {
                let weights = &asked.estimate.weights;
                asked.change::<Apart, _>(weights, step, [before, &after.x], &after.y.x.0, energies)
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn steps<T: Real, Z: Sizes<T, VectorOf<S, T>>>(
                asked: &mut Asked<'_, T, S>,
                [map, copy]: [&Self::Map<T>; 2],
                (h, time, n): (T, [T; 2], u64),
                sizes: &mut Z,
                z: &mut CarriedBy<Self, S, T>,
                before: &mut CarriedBy<Self, S, T>,
                work: &mut WorkBy<Self, S, T>,
            ) -> (u64, bool) {
                let mut inspection = ErrorInspection {
                    energy: asked.energy(time[0], &z.x),
                    asked,
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
