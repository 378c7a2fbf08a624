//! The error of one step of Gauss collocation, estimated from its stages.
//!
//! Input: a step of eight stages and a [`Tolerance`]. Output: the estimated error in units of the tolerated one.
//! Invariant: the estimate is the same for the step backwards, so that decisions by it are reversible.

use crate::errors::{Error, StartError};
use crate::schemes::bundles::{StageLayout, number, spread, sum};
use crate::schemes::collocation::{Collocation, constant};
use crate::systems::state::Point;
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

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

    /// The error `FACTOR·r²√r·of` in units of the tolerated one, as in [`Estimates::error`](super::Estimates::error).
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
    pub(super) weights: [[T; STAGES]; 4],
}

impl<T: Real> Estimate<T> {
    pub(super) fn new(method: &Collocation<STAGES>, tolerance: Tolerance) -> Self {
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
    /// one. Beyond the last stage lies a part of the step that no stage sees, with the weight [`UNSEEN`]; the last
    /// coefficient bounds the error of the polynomial.
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
                    let gap = (slope.part(part)[i] - of).abs();
                    let is_none = gap.equals(T::zero());
                    worst = worse(worst, T::select(is_none, gap, gap / tolerated));
                }
            }
        }
        worst
    }

    /// The error of a step in units of the tolerated one, from the slopes at its stages, or from the forces there: their
    /// relative error is taken for that of the coordinates' change as well.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn error<L, V, X, const EXACT: bool>(
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
