//! Numbers that parameters may be.
//!
//! Input: a float, an integer, a dual number. Output: [`Parameter`], the same value as any scalar. Invariant: an integer of
//! at most 64 bits has two words; a value with more digits than the scalar is rounded to nearest, ties to even.

use super::Real;
use core::fmt::Debug;

/// A number that a parameter or a captured value may be: a float, an integer, a double-double, or a dual number of such.
/// It serves every scalar of a state.
///
/// A scalar with fewer digits rounds to nearest. Derivatives are kept where the scalar is a dual number. In dual numbers
/// of dual numbers those of a parameter are the innermost, so that the outer ones are free for derivatives by
/// coordinates. They are dropped where the scalar is no dual number: a system with dual parameters runs over `f64` with
/// their values.
///
/// ```
/// use hamiltonian::lanes::Parameter;
/// use hamiltonian::prelude::*;
///
/// fn twice<P: Parameter, T: Real>(parameter: P, x: T) -> T {
///     parameter.into_real::<T>() * x
/// }
/// assert_eq!(twice(2.5, 2.0), 5.0);
/// assert_eq!(twice(2.5, Dual::variable(2.0)).eps, 2.5);
/// assert_eq!(twice(2u32, 2.0f32), 4.0);
/// // With the derivative by the parameter, or its value alone.
/// assert_eq!(twice(Dual::variable(2.5), Dual::fixed(2.0)).eps, 2.0);
/// assert_eq!(twice(Dual::variable(2.5), 2.0), 5.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a number from which scalars are made",
    label = "a parameter or a captured value is `{Self}`",
    note = "parameters and captured values are `f64`, `f32`, integers, `DoubleDouble` or `Dual`s of such",
    note = "in code that is generic over the scalar `P` of the parameters, write `P: Real + Parameter`"
)]
pub trait Parameter: Copy + Debug + Send + Sync + 'static {
    /// The number of dual numbers inside each other: 1 for `Dual<f64>`.
    const DUALS: u32 = 0;
    /// The value as a scalar.
    fn into_real<T: Real>(self) -> T;
}

/// Parameters, each as two words whose sum it is.
macro_rules! parameter {
    ($($number:ident)*: |$value:ident| $words:expr) => { $(
        impl Parameter for $number {
            #[inline(always)]
            fn into_real<T: Real>(self) -> T {
                let $value = self;
                let (hi, lo) = $words;
                T::constant(hi, lo)
            }
        }
    )* };
}

parameter!(f64: |value| (value, 0.0));
parameter!(f32: |value| (f64::from(value), 0.0));
parameter!(i8 i16 i32 i64 isize u8 u16 u32 u64 usize: |value| words(value as i128));

/// An integer of at most 64 bits as `hi + lo`, exactly.
#[inline(always)]
pub fn words(value: i128) -> (f64, f64) {
    let hi = value as f64;
    (hi, (value - hi as i128) as f64)
}
