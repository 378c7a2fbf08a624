//! The scalar of all generic code: schemes and emitted programs.
//!
//! Input: nothing. Output: [`Real`], [`Mask`], [`Parameter`]. Invariant: a `Real` is a value of fixed
//! size without heap memory; all its operations are total (NaN and infinities instead of panics).

mod calls;
pub(crate) mod kepler;
mod parameter;
pub mod series;

pub use calls::OfNumbers;
pub use parameter::{Parameter, words};

use core::fmt::Debug;
use core::ops::{
    Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign,
};

/// The result of comparing two [`Real`]s: `bool` for scalars, one flag a lane for packs.
///
/// ```
/// use hamiltonian::lanes::Mask;
/// use hamiltonian::prelude::*;
///
/// fn inside<T: Real>(x: T) -> T::Mask {
///     T::zero().le(x) & x.lt(T::one())
/// }
/// assert!(inside(0.5f64).all() && !inside(1.0f64).any());
/// ```
pub trait Mask:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + Not<Output = Self>
{
    /// Every lane the same flag.
    fn splat(flag: bool) -> Self;
    /// Returns true if every lane is set.
    fn all(self) -> bool;
    /// Returns true if any lane is set.
    fn any(self) -> bool;
    /// The flag of lane `k`; `false` if there is no such lane.
    fn lane(self, k: u32) -> bool;
    /// The first lane that is set.
    fn first(self) -> Option<u32>;
}

/// Real arithmetic: `f64`, `f32`, dual numbers, double-double and packs of lanes.
///
/// Values, domains and special cases are those of IEEE 754 and of the C library: a point outside
/// the domain gives NaN, a pole an infinity, odd functions keep the sign of zero, `atan2(±0, −0) =
/// ±π`, `hypot(∞, NaN) = ∞`, `pow(x, 0) = pow(1, y) = 1`. The errors of double-doubles are listed
/// at their type, in `hamiltonian-lanes`. If a derivative does not exist, [`Dual`](crate::Dual)
/// states the convention.
///
/// # Accuracy of `f64` and of packs
/// The elementary functions belong to this crate, with the same operations for a single number and
/// for a lane: the same bits on every machine and at every level that does not fuse, and the same
/// bounds at levels that fuse. Largest errors in units in the last place, beside the bounds that
/// the tests assert, over 10⁷ points a function on all of its range (angles to 1.8e308 and next to
/// multiples of π/2, subnormal numbers, the surroundings of 1 and of each seam):
///
/// | | bound | unfused | fused | | bound | unfused | fused |
/// |---|---|---|---|---|---|---|---|
/// | `sin` | 0.8 | 0.79 | 0.79 | `acosh` | 1 | 0.87 | 0.80 |
/// | `cos` | 0.8 | 0.80 | 0.77 | `atanh` | 1 | 0.91 | 0.84 |
/// | `tan` | 1 | 1.00 | 0.89 | `atan` | 1 | 0.84 | 0.81 |
/// | `exp` | 0.8 | 0.72 | 0.68 | `asin` | 1 | 0.65 | 0.64 |
/// | `exp_m1` | 1 | 0.61 | 0.61 | `acos` | 1 | 0.63 | 0.60 |
/// | `ln` | 1 | 0.83 | 0.81 | `erf` | 1.5 | 0.85 | 0.81 |
/// | `ln_1p` | 1 | 0.80 | 0.77 | `erfc` | 1.5 | 0.85 | 0.83 |
/// | `cbrt` | 1 | 0.51 | 0.51 | `sqrt` | 0.5 | 0.50 | 0.50 |
/// | `sinh` | 1 | 0.71 | 0.67 | `atan2` | 1 | 0.87 | 0.87 |
/// | `cosh` | 1 | 0.62 | 0.62 | `hypot` | 1 | 0.50 | 0.50 |
/// | `tanh` | 1 | 0.68 | 0.67 | `pow` | 1.5 | 0.84 | 0.82 |
/// | `asinh` | 1 | 0.96 | 0.82 |  | | |  |
///
/// An odd function is odd and an even one even to the bit; `exp`, `ln` and `atan` never fall by more
/// than a unit where they should rise. `f32` rounds the values of `f64`.
///
/// # Cost of rare arguments
/// No normal argument with a normal value meets a subnormal number on its way, which on many CPUs
/// takes a hundred times as long. Where a value is not finite, or below 64 times the smallest normal
/// number, terms may be subnormal. Some arguments take up to four times as long as others: angles beyond 2²⁰;
/// `atan2` where the larger argument is outside 2⁻³⁸¹ to 2³⁸¹, or they are 2³⁸¹ apart; `pow` of bases that are
/// subnormal or below 0, or with results that leave the normal numbers; `sinh` and `cosh` from ±708 on.
///
/// A pack computes these arguments lane by lane, for as long as each takes alone: subnormal arguments of `ln`;
/// `exp` and `exp_m1` from ±708 on (but `exp` on AVX-512).
///
/// ```
/// use hamiltonian::prelude::*;
///
/// /// One step of Newton's iteration for `x·eˣ = y`, written once for every scalar.
/// fn improve<T: Real>(x: T, y: T) -> T {
///     x - (x * x.exp() - y) / ((T::one() + x) * x.exp())
/// }
///
/// let x = (0..4).fold(0.6, |x, _| improve(x, 1.0));
/// assert!((x - 0.567143290409784_f64).abs() < 1e-15);
/// // With its derivative by y, which is 1/((1 + x)·eˣ).
/// let x = improve(Dual::fixed(0.5671432904097838), Dual::variable(1.0));
/// assert!((x.eps - 0.3618962566348892).abs() < 1e-14);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no scalar",
    label = "expected a scalar such as `f64`",
    note = "scalars are `f64`, `f32`, `Dual`, `DoubleDouble` and packs of lanes; a number is written `1.0`, not `1`",
    note = "in generic code bound the type: `P: Real`"
)]
pub trait Real:
    Copy
    + Debug
    + PartialEq
    + Default
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The result of comparisons.
    type Mask: Mask;
    /// The type of a [`size`](Self::size): one number a lane, without derivative parts.
    type Size: Real<Mask = Self::Mask>;
    /// The number of independent numbers in a value: 1 for scalars.
    const LANES: u32;

    /// This scalar with a value in each lane of `P`: `P` itself for `f64`, `Dual<P>` for
    /// `Dual<f64>`. For scalars without a form in lanes ([`WIDENS`](Self::WIDENS) is `false`) it is
    /// the scalar itself.
    type Over<P: Pack>: Real;
    /// True if [`Over`](Self::Over) has a value in each lane of the pack.
    const WIDENS: bool = false;
    /// Puts value k into lane k, and the last value into the remaining lanes. Without a form in
    /// lanes, returns the first value.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// // `f64` is a pack of one lane.
    /// let x = Real::gather::<f64>(&[Dual::variable(1.5)]);
    /// assert_eq!((x.re, x.eps), (1.5, 1.0));
    /// ```
    fn gather<P: Pack>(values: &[Self]) -> Self::Over<P>;
    /// Writes lane k to number k of `into`; lanes for which there is no place are left out.
    fn scatter<P: Pack>(from: Self::Over<P>, into: &mut [Self]);
    /// The value in every lane.
    #[inline(always)]
    fn spread<P: Pack>(self) -> Self::Over<P> {
        Self::gather::<P>(&[self])
    }

    /// The number of dual numbers inside each other: 1 for `Dual<f64>`.
    const DUALS: u32 = 0;
    /// The number with this value and this derivative, each a number with `A::DUALS` derivatives of its own. The
    /// derivative is dropped by scalars that have none.
    #[inline(always)]
    fn from_dual<A: Parameter>(value: A, _derivative: A) -> Self {
        value.into_real()
    }

    /// The value of a number as this scalar: a parameter, a captured value, or a constant of a Rust function. A scalar with
    /// fewer digits rounds to nearest; a dual number of `f64` is constant. See [`Parameter`].
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// fn twice<T: Real>(x: T) -> T {
    ///     T::lift(2) * x
    /// }
    /// assert_eq!(twice(2.5), 5.0);
    /// assert_eq!(twice(Dual::variable(2.5)).eps, 2.0);
    /// ```
    #[inline(always)]
    fn lift<A: Parameter>(value: A) -> Self {
        value.into_real()
    }

    /// The number `hi + lo` (two words, so that double-double constants are exact to 106 bits).
    fn constant(hi: f64, lo: f64) -> Self;
    /// `self·b + c`, fused where this type fuses; for `f64` it is `self * b + c`.
    fn fma(self, b: Self, c: Self) -> Self;
    /// `yes` where the mask is set, `no` elsewhere; the value not taken has no effect.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The same of a new and an old value of a variable. A choice that is stored where the old value was becomes a store
    /// under a mask, which takes some CPUs twenty times as long as a store; this one does not.
    #[inline(always)]
    fn replaced(mask: Self::Mask, new: Self, old: Self) -> Self {
        Self::select(mask, new, old)
    }
    /// `self·factor`, where a factor of exactly 0 gives 0 even if `self` is infinite or NaN. It
    /// multiplies a slope by a derivative part, so that a constant contributes nothing.
    #[inline(always)]
    fn mul_absorbing(self, factor: Self) -> Self {
        Self::select(factor.equals(Self::zero()), factor, self * factor)
    }
    /// `self < other`, by value, without derivative parts.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self ≤ other`.
    fn le(self, other: Self) -> Self::Mask;
    /// `self = other`.
    fn equals(self, other: Self) -> Self::Mask;
    /// The largest absolute value of any component (lanes, derivative parts) as `f64`; NaN if any
    /// component is NaN.
    fn magnitude(self) -> f64;
    /// The sum of the absolute values of a lane's components (the value and its derivative parts),
    /// lane by lane; NaN in the lanes where any is NaN. A norm for stopping: it costs less than a
    /// maximum that keeps NaN.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(Dual::new(-3.0, 0.5).size(), 3.5);
    /// assert!(Dual::new(1.0, f64::NAN).size().is_nan());
    /// ```
    fn size(self) -> Self::Size;
    /// The lanes all of whose components are finite.
    ///
    /// ```
    /// use hamiltonian::lanes::Mask;
    /// use hamiltonian::prelude::*;
    /// assert!(!Dual::new(1.0, f64::INFINITY).finite().all());
    /// ```
    fn finite(self) -> Self::Mask;
    /// Returns true if every component is finite.
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.finite().all()
    }
    /// The value in lane `k` rounded to `f64` (derivative parts dropped); NaN if there is no such
    /// lane.
    fn lane(self, k: u32) -> f64;
    /// The value of the first lane rounded to `f64` (derivative parts dropped).
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.lane(0)
    }
    /// The derivative part, as a number without one; 0 for a scalar that has none.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(Dual::new(1.5, -2.0).derivative(), Dual::fixed(-2.0));
    /// assert_eq!(1.5.derivative(), 0.0);
    /// ```
    #[inline(always)]
    fn derivative(self) -> Self {
        Self::zero()
    }
    /// This value with the value of `derivative` as its derivative part; a scalar that has none stays.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(Dual::new(1.5, -2.0).with_derivative(Dual::fixed(3.0)), Dual::new(1.5, 3.0));
    /// ```
    #[inline(always)]
    fn with_derivative(self, _derivative: Self) -> Self {
        self
    }
    /// The spacing of this type's numbers at 1.
    fn epsilon() -> f64;
    /// Writes the value as `f64`s that contain all its bits (words, derivative parts, lanes), to
    /// save runs.
    fn write_words(self, to: &mut dyn FnMut(f64)) {
        for k in 0..Self::LANES {
            to(self.lane(k));
        }
    }
    /// Reads a value from its words, in the same order.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let mut words = Vec::new();
    /// Dual::new(0.1, -2.0).write_words(&mut |word| words.push(word));
    /// let mut words = words.into_iter();
    /// let again: Dual<f64> = Real::read_words(&mut || words.next().unwrap());
    /// assert_eq!(again, Dual::new(0.1, -2.0));
    /// ```
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self;

    /// The numbers of a table at the point `at`: each lane reads those of its own values. They are
    /// constants, so dual numbers have them without derivative parts.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// /// The line through the two points of a table around x, at x.
    /// fn line<T: Real>(table: &[f64], x: T) -> T {
    ///     let [start, left, right] = T::look_up([x], |[x]| {
    ///         let cell = (x.floor().max(0.0) as usize).min(table.len() - 2);
    ///         [cell as f64, table[cell], table[cell + 1]]
    ///     });
    ///     left + (right - left) * (x - start)
    /// }
    /// let y = line(&[1.0, 2.0, 5.0], Dual::variable(1.5));
    /// assert_eq!((y.re, y.eps), (3.5, 3.0));
    /// ```
    #[inline(always)]
    fn look_up<const M: usize, const N: usize>(
        at: [Self; M],
        table: impl Fn([f64; M]) -> [f64; N],
    ) -> [Self; N] {
        let mut found = [Self::default(); N];
        for (n, to) in found.iter_mut().enumerate() {
            let mut k = 0;
            *to = Self::read_words(&mut || {
                let mut point = [0.0; M];
                for (number, x) in point.iter_mut().zip(&at) {
                    *number = x.lane(k);
                }
                k += 1;
                table(point)[n]
            });
        }
        found
    }

    /// `f()` in a function of its own, compiled with the instructions of this scalar. For parts of
    /// a body that is too long for one function: a plain call would lose the level of a pack
    /// (`Level` in `hamiltonian-lanes`).
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(f64::out_of_line(|| 2.0_f64.sqrt()), 2.0_f64.sqrt());
    /// ```
    #[inline(always)]
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
        #[inline(never)]
        fn entry<A>(f: impl FnOnce() -> A) -> A {
            f()
        }
        entry(f)
    }
    /// A function in a function of its own, as [`out_of_line`](Real::out_of_line). A pack of several registers calls it with
    /// one after the other, where its own functions compute all in lock-step; see [`OfNumbers`].
    #[inline(always)]
    fn apart<F: OfNumbers<N>, const N: usize>(f: F, x: [Self; N]) -> Self {
        Self::out_of_line(
            #[inline(always)]
            || f.of(x),
        )
    }

    /// 0.
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(0.0, 0.0)
    }
    /// 1.
    #[inline(always)]
    fn one() -> Self {
        Self::constant(1.0, 0.0)
    }
    /// `1/self`.
    #[inline(always)]
    fn recip(self) -> Self {
        Self::one() / self
    }
    /// Square root; NaN below 0.
    fn sqrt(self) -> Self;
    /// Cube root, odd.
    fn cbrt(self) -> Self;
    /// Absolute value; its derivative is `sign`.
    fn abs(self) -> Self;
    /// −1, 0 or 1; `sign(0) = 0`; its derivative is 0.
    fn sign(self) -> Self;
    /// The largest whole number ≤ self, ⌊self⌋; its derivative is 0.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(Real::floor(-0.5), -1.0);
    /// assert_eq!(Dual::variable(2.5).floor().eps, 0.0);
    /// ```
    fn floor(self) -> Self;
    /// The nearest whole number, ties to even; its derivative is 0. The method `round` of `f64` in the standard
    /// library rounds ties away from 0 and comes first in method calls: write `Real::round(x)` for an `f64`.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!([0.5, 1.5, 2.5].map(Real::round), [0.0, 2.0, 2.0]);
    /// assert_eq!([0.5, 1.5, 2.5].map(f64::round), [1.0, 2.0, 3.0]);
    /// ```
    fn round(self) -> Self;
    /// `self` modulo `other`: `self − |other|·⌊self/|other|⌋`, in [0, |other|), exact but for one rounding. A
    /// remainder that rounds to |other| is 0. NaN where `other` is 0 or `self` is infinite. The derivatives are 1
    /// and minus the multiple.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!((7.5.modulo(2.0), (-0.5).modulo(2.0)), (1.5, 1.5));
    /// assert_eq!((-1e-20).modulo(1.0), 0.0);
    /// assert_eq!(Dual::fixed(7.5).modulo(Dual::variable(2.0)).eps, -3.0);
    /// ```
    fn modulo(self, other: Self) -> Self;
    /// The remainder of IEEE 754: `self − n·other` with n the whole number nearest to `self/other`, ties to even,
    /// exact, in [−|other|/2, |other|/2]: the minimum image of `self` in a cell of length `other`. NaN where
    /// `other` is 0 or `self` is infinite. The derivatives are 1 and −n.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!((5.5.remainder(2.0), (-5.5).remainder(2.0), 3.0.remainder(2.0)), (-0.5, 0.5, -1.0));
    /// ```
    fn remainder(self, other: Self) -> Self;
    /// Sine.
    fn sin(self) -> Self;
    /// Cosine.
    fn cos(self) -> Self;
    /// Tangent.
    fn tan(self) -> Self;
    /// Arc sine in [−π/2, π/2].
    fn asin(self) -> Self;
    /// Arc cosine in [0, π].
    fn acos(self) -> Self;
    /// Arc tangent in (−π/2, π/2).
    fn atan(self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Inverse hyperbolic sine.
    fn asinh(self) -> Self;
    /// Inverse hyperbolic cosine; NaN below 1.
    fn acosh(self) -> Self;
    /// Inverse hyperbolic tangent; NaN outside [−1, 1].
    fn atanh(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// `exp(self) − 1`, accurate near 0.
    fn exp_m1(self) -> Self;
    /// Natural logarithm; NaN below 0.
    fn ln(self) -> Self;
    /// `ln(1 + self)`, accurate near 0.
    fn ln_1p(self) -> Self;
    /// Error function `2/√π·∫₀ˣ exp(−t²) dt`; its derivative is `2/√π·exp(−x²)`.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let x = Dual::variable(0.0).erf();
    /// assert_eq!((x.re, x.eps), (0.0, core::f64::consts::FRAC_2_SQRT_PI));
    /// ```
    fn erf(self) -> Self;
    /// Complementary error function `1 − erf(self)`, relatively accurate where it is small.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(1.0 - 10f64.erf(), 0.0);
    /// assert!((10f64.erfc() / 2.088487583762545e-45 - 1.0).abs() < 4.0 * f64::EPSILON);
    /// ```
    fn erfc(self) -> Self;
    /// Sine and cosine of one angle.
    fn sin_cos(self) -> (Self, Self);
    /// The angle of the point (`other`, `self`) in (−π, π].
    fn atan2(self, other: Self) -> Self;
    /// `√(self² + other²)` without undue overflow.
    fn hypot(self, other: Self) -> Self;
    /// `self` to the power `exponent`; NaN for a negative base and an exponent that is no integer.
    fn pow(self, exponent: Self) -> Self;
    /// The smaller; where equal, the derivative is that of `self`; a NaN operand is returned.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.le(other) | !self.equals(self), self, other)
    }
    /// The larger; where equal, the derivative is that of `self`; a NaN operand is returned.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.le(self) | !self.equals(self), self, other)
    }
    /// The universal anomaly y > 0 of Kepler's problem: `y·c₁ + a·y²·c₂ + b·y³·c₃ = 1` with `a = self`
    /// and Stumpff's functions cₙ at c·y². For r̈ = −μr/r³ from r₀, v₀ over a time t of either sign
    /// `a = t·(r₀·v₀)/r₀²`, `b = μt²/r₀³`, `c = 2b − v₀²t²/r₀²`; the universal variable of the text
    /// books is s = y·t/r₀, and `y²·c₂·b` is 1 − f. One equation serves ellipses (c > 0), parabolas
    /// and hyperbolas, attraction and repulsion (b < 0). NaN where an argument is not finite.
    ///
    /// J. M. A. Danby, *Fundamentals of Celestial Mechanics*, 2nd ed., 1988, §6.9;
    /// J. Wisdom and D. M. Hernandez, *Mon. Not. R. Astron. Soc.* 453, 3015, 2015,
    /// doi:10.1093/mnras/stv1862.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// // A circle of radius 1 with μ = 1: the anomaly grows with the time.
    /// let t = 2.5_f64;
    /// let y = 0.0.universal_anomaly(t * t, t * t);
    /// assert!((y - 1.0).abs() < 1e-15);
    /// ```
    #[inline(always)]
    fn universal_anomaly(self, b: Self, c: Self) -> Self {
        kepler::anomaly(self, b, c)
    }
    /// The part of the time that is left after whole revolutions, for b = `self` and c of
    /// [`universal_anomaly`](Real::universal_anomaly), in units of the time: 1 if the orbit does not return in it;
    /// otherwise of either sign and at most half a revolution. With a, b and c for that part of the time no digits
    /// are lost in long times but those that the period has lost. NaN from 2⁵⁰ revolutions on.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// // A circle of radius 1 with μ = 1, after two and a quarter revolutions.
    /// let t = 4.5 * core::f64::consts::PI;
    /// assert!(((t * t).orbit_remainder(t * t) - 1.0 / 9.0).abs() < 1e-15);
    /// ```
    #[inline(always)]
    fn orbit_remainder(self, c: Self) -> Self {
        kepler::remainder(self, c)
    }
    /// Stumpff's function c₂(ψ) = (1 − cos √ψ)/ψ = ½ − ψ/4! + ψ²/6! − …, for ψ of either sign.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(0f64.stumpff_2(), 0.5);
    /// assert!((4f64.stumpff_2() - (1.0 - 2f64.cos()) / 4.0).abs() < 1e-16);
    /// ```
    #[inline(always)]
    fn stumpff_2(self) -> Self {
        kepler::stumpff(self).0
    }
    /// Stumpff's function c₃(ψ) = (√ψ − sin √ψ)/√ψ³ = 1/3! − ψ/5! + ψ²/7! − …, for ψ of either sign.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert!(((-4f64).stumpff_3() - (2f64.sinh() - 2.0) / 8.0).abs() < 1e-16);
    /// ```
    #[inline(always)]
    fn stumpff_3(self) -> Self {
        kepler::stumpff(self).1
    }
}

/// A scalar that is several `f64` beside each other, lanes; `f64` itself is one lane.
///
/// The packs of CPUs are those of `hamiltonian-lanes`; a kernel takes them from its level.
///
/// ```
/// use hamiltonian::lanes::Pack;
/// use hamiltonian::prelude::*;
///
/// /// The roots of numbers, as many at a time as `P` has lanes.
/// fn roots<P: Pack>(numbers: &mut [f64]) {
///     for some in numbers.chunks_mut(P::LANES as usize) {
///         P::load(some, 0.0).sqrt().store(some);
///     }
/// }
/// let mut numbers = [1.0, 4.0, 9.0];
/// roots::<f64>(&mut numbers);
/// assert_eq!(numbers, [1.0, 2.0, 3.0]);
/// ```
pub trait Pack: Real<Size = Self> {
    /// Lane k is number k of `from`, or `missing` if there is none.
    fn load(from: &[f64], missing: f64) -> Self;
    /// Writes lane k to number k of `into`; lanes for which there is no place are left out.
    fn store(self, into: &mut [f64]);
    /// The first `n` lanes: those that [`load`](Pack::load) takes from `n` numbers.
    ///
    /// ```
    /// use hamiltonian::lanes::Pack;
    /// assert!(f64::below(1) && !f64::below(0));
    /// ```
    fn below(n: u32) -> Self::Mask;
}

/// [`Real::Over`], [`Real::gather`] and [`Real::scatter`] of a scalar that has no form in lanes: itself,
/// one value.
#[macro_export]
macro_rules! itself_in_lanes {
    () => {
        type Over<Lanes: $crate::Pack> = Self;
        #[inline(always)]
        fn gather<Lanes: $crate::Pack>(values: &[Self]) -> Self {
            values.first().copied().unwrap_or_default()
        }
        #[inline(always)]
        fn scatter<Lanes: $crate::Pack>(from: Self, into: &mut [Self]) {
            if let Some(first) = into.first_mut() {
                *first = from;
            }
        }
    };
}
