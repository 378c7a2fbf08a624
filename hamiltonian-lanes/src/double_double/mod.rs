//! Double-double numbers: the unevaluated sum of two `f64`, about 106 bits.
//!
//! Input: `f64`s, pairs of them, decimal text. Output: [`DoubleDouble`] with every operation of
//! [`Real`]. Invariant: `hi` is the sum rounded to nearest (|lo| ≤ ½ ulp(hi)), and `lo = 0` where
//! `hi` is 0, infinite or NaN.

mod arithmetic;
mod constants;
mod roots;

mod error;
mod exponential;
mod trigonometric;
mod whole;

mod scalar;

mod big;
mod decimal;

use hamiltonian_real::parts::exact::two_sum;

pub use decimal::ParseDoubleDoubleError;

/// `hi + lo`, two `f64` as one number of about 106 bits (32 decimal digits), to measure orders and
/// invariants below the precision of `f64`.
///
/// The arithmetic is Dekker's (*Numer. Math.* 18, 224, 1971, doi:10.1007/BF01397083) in the
/// variants whose bounds Joldes, Muller and Popescu proved (*ACM Trans. Math. Softw.* 44, 15,
/// 2017, doi:10.1145/3121432).
///
/// # Accuracy
/// Largest relative errors over the full range (angles up to 10³⁰⁰, results above 10⁻²⁸⁰), asserted
/// against 6 500 values of 50 digits; one unit 2⁻¹⁰⁵ is 2.5e-32:
///
/// | | ≤ | | ≤ | | ≤ |
/// |---|---|---|---|---|---|
/// | + − | 1.5e-32 | sin, cos | 3e-32 | exp | 1.5e-32 |
/// | × | 3e-32 | tan | 5e-32 | exp_m1 | 4.5e-32 |
/// | ÷ | 4e-32 | asin | 4e-32 | ln, ln_1p | 4.5e-32 |
/// | sqrt | 3e-32 | acos | 4.5e-32 | sinh | 4e-32 |
/// | cbrt | 4e-32 | atan, atan2 | 3e-32 | cosh | 2e-32 |
/// | hypot | 3e-32 | tanh | 6e-32 | asinh, acosh, atanh | 5e-32, 6e-32, 6e-32 |
///
/// 5e-32 for erf, 7e-32 for erfc, and 2.5e-31·(1 + |y ln x|) for x^y. Below 10⁻²⁹⁰ the trailing word is subnormal and digits are
/// lost, as with any pair of `f64`. Signed zeros, infinities and NaN are as in `f64`.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
/// let error = third * DoubleDouble::from(3.0) - DoubleDouble::from(1.0);
/// assert!(error.magnitude() < 1e-31);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

impl DoubleDouble {
    /// The number `a + b`, exactly unless it needs more than 106 bits; the words need not be
    /// ordered.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let x = DoubleDouble::new(1e-20, 1.0);
    /// assert_eq!((x.hi(), x.lo()), (1.0, 1e-20));
    /// ```
    #[inline(always)]
    pub const fn new(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, b);
        Self::finish(a + b, hi, lo)
    }

    /// The leading word: the number rounded to `f64`.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(DoubleDouble::from(0.5).hi(), 0.5);
    /// ```
    #[inline(always)]
    pub const fn hi(self) -> f64 {
        self.hi
    }

    /// The trailing word: the value minus `hi`.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let tenth = DoubleDouble::from(1.0) / DoubleDouble::from(10.0);
    /// assert!(tenth.lo() != 0.0 && tenth.lo().abs() < 1e-17);
    /// ```
    #[inline(always)]
    pub const fn lo(self) -> f64 {
        self.lo
    }
}

impl From<f64> for DoubleDouble {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}
