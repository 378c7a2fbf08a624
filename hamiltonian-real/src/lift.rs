//! Conversions of values to scalars.
//!
//! Input: floats, duals, integers. Output: [`Lift`] between them. Invariant: every scalar lifts
//! from itself and from `f64`; a value with more digits than the scalar is rounded to nearest, ties
//! to even; a value lifted into a dual is constant (its derivative part is 0).

use crate::dual::Dual;
use crate::real::{Lift, Parameter, Real};

/// Scalars that hold any float: a float is cast, which is exact or rounds to nearest.
macro_rules! lift_float {
    ($($float:ident)*) => {
        $(
            impl Lift<$float> for f64 {
                #[inline(always)]
                fn lift(value: $float) -> Self {
                    value as f64
                }
            }
            impl Lift<$float> for f32 {
                #[inline(always)]
                fn lift(value: $float) -> Self {
                    value as f32
                }
            }
            impl<T: Real> Lift<$float> for Dual<T> {
                #[inline(always)]
                fn lift(value: $float) -> Self {
                    Self::fixed(T::lift(value as f64))
                }
            }
        )*
    };
}

/// Integers, in two words if one does not suffice.
macro_rules! lift_integer {
    ($($integer:ident)*) => {
        $(
            impl Lift<$integer> for f64 {
                #[inline(always)]
                fn lift(value: $integer) -> Self {
                    value as f64
                }
            }
            impl Lift<$integer> for f32 {
                #[inline(always)]
                fn lift(value: $integer) -> Self {
                    value as f32
                }
            }
            impl<T: Real> Lift<$integer> for Dual<T> {
                #[inline(always)]
                fn lift(value: $integer) -> Self {
                    let (hi, lo) = words(value as i128);
                    Self::fixed(T::constant(hi, lo))
                }
            }
        )*
    };
}

/// Parameters: floats in one word, integers in two.
macro_rules! parameter {
    ($($number:ident: |$value:ident| $made:expr),*) => {
        $(
            impl Parameter for $number {
                #[inline(always)]
                fn into_real<T: Real>(self) -> T {
                    let $value = self;
                    $made
                }
            }
        )*
    };
}

macro_rules! parameter_integer {
    ($($integer:ident)*) => {
        parameter!($($integer: |value| {
            let (hi, lo) = words(value as i128);
            T::constant(hi, lo)
        }),*);
    };
}

parameter!(f64: |value| T::lift(value), f32: |value| T::lift(f64::from(value)));
parameter_integer!(i8 i16 i32 i64 isize u8 u16 u32 u64 usize);

lift_float!(f64 f32);
lift_integer!(i8 i16 i32 i64 isize u8 u16 u32 u64 usize);

impl<T: Real> Lift<Dual<T>> for Dual<T> {
    #[inline(always)]
    fn lift(value: Dual<T>) -> Self {
        value
    }
}

/// An integer of at most 64 bits as `hi + lo`, exactly.
#[inline(always)]
pub fn words(value: i128) -> (f64, f64) {
    let hi = value as f64;
    (hi, (value - hi as i128) as f64)
}
