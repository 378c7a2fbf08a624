//! The error of one step of Gauss collocation, estimated from its stages.
//!
//! Input: a step of eight stages and a [`Tolerance`]. Output: the estimated error in units of the tolerated one.
//! Invariant: the estimate is the same for the step backwards, so that decisions by it are reversible.

use crate::errors::{Error, StartError};
use crate::flows::map::Map;
use crate::schemes::collocation::{Collocation, constant};
use crate::schemes::gauss::Gauss;
use crate::schemes::scheme::{CarriedBy, OneStep, Scheme};
use crate::schemes::second_order::GaussNystrom;
use crate::systems::state::Point;
use crate::systems::system::{QuadraticKinetic, Separable, System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// The number of stages of schemes that follow a tolerance. The constants below belong to it.
pub(super) const STAGES: usize = 8;

/// The tolerated error of one step.
///
/// A step from x to x′ may change each coordinate and each momentum by an error of
///
/// ```text
/// absolute + relative·max(|xᵢ|, |xᵢ′|, 2⁻²⁰·max |xⱼ|) + 4ε·max |xⱼ|
/// ```
///
/// where j runs over all coordinates, or over all momenta, and ε is the spacing of numbers at 1. The last two terms keep
/// components that are small beside the
/// others, or rounding, from deciding.
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
    pub(super) fn check(self) -> Result<(), Error> {
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
    /// Copies a map.
    fn copy<T: Real>(of: &Self::Map<T>) -> Self::Map<T>;
    /// Makes `to`, a copy of `from`, the map for a step `by` times that of `from`.
    fn resize<T: Real>(from: &Self::Map<T>, by: T, to: &mut Self::Map<T>);
    /// The estimated error of a step of size `h` that led from `before` to `after`, in units of the tolerated one.
    fn error<T: Real>(
        tail: &Tail<T>,
        tolerance: Tolerance,
        h: T,
        before: &Point<VectorOf<S, T>>,
        after: &CarriedBy<Self, S, T>,
    ) -> T;
}

/// The map of the scheme `M` over `T`, which carries the same as `M` does.
pub(super) type MapBy<M, S, T> = <M as Scheme<S>>::Map<T>;
/// Its scratch.
pub(super) type WorkBy<M, S, T> = <MapBy<M, S, T> as Map>::Work;

/// Weights of the stages in the last two coefficients of the slopes' polynomial, in Legendre's polynomials.
#[derive(Debug, Clone, Copy)]
pub struct Tail<T> {
    weights: [[T; STAGES]; 2],
}

impl<T: Real> Tail<T> {
    pub(super) fn new() -> Self {
        let method = Collocation::<STAGES>::gauss();
        let polynomials = method.polynomials();
        let mut weights = [[T::zero(); STAGES]; 2];
        for (row, k) in weights.iter_mut().zip([STAGES - 1, STAGES - 2]) {
            for (i, to) in row.iter_mut().enumerate() {
                *to = constant(method.norm(k) * method.weights[i] * polynomials[i][k].0);
            }
        }
        Tail { weights }
    }

    /// The relative error ε of the integral of a component of the slopes, and the largest size of that component.
    ///
    /// Let r be its last Legendre coefficient in units of that size. If the coefficients decay like ρ⁻ᵏ, r is ρ⁻⁷, and
    /// the error of the quadrature, of order 17 in h, is near ρ⁻¹⁷ = r^(17/7). [`FACTOR`]·r²√r bounds it. So that a
    /// coefficient that happens to vanish does not hide the error, the one before it counts an eighth.
    #[inline(always)]
    fn of<X: Vector<Scalar = T>>(&self, stages: &[X; STAGES], part: usize, i: usize) -> [T; 2] {
        let [mut last, mut before, mut most] = [T::zero(); 3];
        for (stage, slopes) in stages.iter().enumerate() {
            let slope = slopes.part(part)[i];
            last = self.weights[0][stage].fma(slope, last);
            before = self.weights[1][stage].fma(slope, before);
            most = larger(most, slope.abs());
        }
        let tail = larger(last.abs(), before.abs() * T::constant(0.125, 0.0));
        let is_zero = most.equals(T::zero());
        let r = tail / T::select(is_zero, T::one(), most);
        [T::constant(FACTOR, 0.0) * r * r * r.sqrt(), most]
    }
}

/// The error of a step over `h·r²√r` times its slope. The errors that follow are tested at the ends of runs of twenty
/// problems, among them Kepler's with e = 0.99, the restricted three-body problem and H = ½(q² + 1)(p² + 1).
const FACTOR: f64 = 0.5;

/// The larger of two numbers; the second if one is NaN.
#[inline(always)]
pub(super) fn larger<T: Real>(a: T, b: T) -> T {
    T::select(b.lt(a), a, b)
}

/// The larger of two numbers; NaN if one is NaN.
#[inline(always)]
fn worse<T: Real>(a: T, b: T) -> T {
    T::select(a.lt(b) | !b.equals(b), b, a)
}

/// The largest size of a component.
#[inline(always)]
fn most<V: Vector>(x: &V) -> V::Scalar {
    let mut most = V::Scalar::zero();
    for k in 0..V::PARTS {
        for x in x.part(k) {
            most = larger(most, x.abs());
        }
    }
    most
}

/// The tolerated errors of a group, coordinates or momenta.
struct Tolerated<T> {
    tolerance: Tolerance,
    most: T,
}

impl<T: Real> Tolerated<T> {
    #[inline(always)]
    fn of<V: Vector<Scalar = T>>(tolerance: Tolerance, before: &V, after: &V) -> Self {
        Tolerated {
            tolerance,
            most: larger(most(before), most(after)),
        }
    }

    /// An error in units of the tolerated one, for a component that was `before` and is `after`.
    #[inline(always)]
    fn share(&self, error: T, before: T, after: T) -> T {
        /// 2⁻²⁰.
        const SMALL: f64 = 1.0 / (1_u64 << 20) as f64;
        let small = T::constant(SMALL, 0.0) * self.most;
        let rounding = T::constant(4.0 * T::epsilon(), 0.0) * self.most;
        let size = larger(larger(before.abs(), after.abs()), small);
        let tolerated = T::constant(self.tolerance.absolute, 0.0)
            + T::constant(self.tolerance.relative, 0.0) * size
            + rounding;
        T::select(error.equals(T::zero()), error, error / tolerated)
    }
}

impl<S: System> Estimates<S> for Gauss<STAGES> {
    fn copy<T: Real>(of: &Self::Map<T>) -> Self::Map<T> {
        of.clone()
    }
    #[inline(always)]
    fn resize<T: Real>(from: &Self::Map<T>, by: T, to: &mut Self::Map<T>) {
        from.resize(by, to);
    }
    #[inline(always)]
    fn error<T: Real>(
        tail: &Tail<T>,
        tolerance: Tolerance,
        h: T,
        before: &Point<VectorOf<S, T>>,
        after: &CarriedBy<Self, S, T>,
    ) -> T {
        let (now, stages) = (&after.x, &after.y.x.0);
        let parts = <VectorOf<S, T> as Vector>::PARTS;
        let groups = [
            Tolerated::of(tolerance, &before.q, &now.q),
            Tolerated::of(tolerance, &before.p, &now.p),
        ];
        let mut worst = T::zero();
        for k in 0..2 * parts {
            let group = &groups[k / parts];
            for i in 0..now.part(k).len() {
                let [error, most] = tail.of(stages, k, i);
                let error = error * most * h.abs();
                worst = worse(worst, group.share(error, before.part(k)[i], now.part(k)[i]));
            }
        }
        worst
    }
}

impl<S> Estimates<S> for GaussNystrom<STAGES>
where
    S: System + Separable + QuadraticKinetic + Unforced,
{
    fn copy<T: Real>(of: &Self::Map<T>) -> Self::Map<T> {
        of.clone()
    }
    #[inline(always)]
    fn resize<T: Real>(from: &Self::Map<T>, by: T, to: &mut Self::Map<T>) {
        from.resize(by, to);
    }
    /// The stages have forces alone. Their relative error is taken for that of the coordinates' change as well.
    #[inline(always)]
    fn error<T: Real>(
        tail: &Tail<T>,
        tolerance: Tolerance,
        h: T,
        before: &Point<VectorOf<S, T>>,
        after: &CarriedBy<Self, S, T>,
    ) -> T {
        let (now, stages) = (&after.x, &after.y.x.0);
        let q = Tolerated::of(tolerance, &before.q, &now.q);
        let p = Tolerated::of(tolerance, &before.p, &now.p);
        let mut worst = T::zero();
        for k in 0..<VectorOf<S, T> as Vector>::PARTS {
            for i in 0..now.q.part(k).len() {
                let [error, most] = tail.of(stages, k, i);
                let [q0, q1] = [before.q.part(k)[i], now.q.part(k)[i]];
                worst = worse(worst, q.share(error * (q1 - q0).abs(), q0, q1));
                let [p0, p1] = [before.p.part(k)[i], now.p.part(k)[i]];
                worst = worse(worst, p.share(error * most * h.abs(), p0, p1));
            }
        }
        worst
    }
}
