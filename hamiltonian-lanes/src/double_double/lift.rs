//! Conversions of values to double-doubles.
//!
//! Input: floats, integers, double-doubles. Output: [`Lift`]. Invariant: integers of at most 64 bits
//! and floats are lifted exactly.

use hamiltonian_real::parts::words;
use hamiltonian_real::{Dual, Lift, Parameter, Real};

use super::DoubleDouble;

/// Floats, in one word.
macro_rules! lift_float {
    ($($float:ident)*) => {
        $(
            impl Lift<$float> for DoubleDouble {
                #[inline(always)]
                fn lift(value: $float) -> Self {
                    Self::from(value as f64)
                }
            }
        )*
    };
}

/// Integers, in two words if one does not suffice.
macro_rules! lift_integer {
    ($($integer:ident)*) => {
        $(
            impl Lift<$integer> for DoubleDouble {
                #[inline(always)]
                fn lift(value: $integer) -> Self {
                    let (hi, lo) = words(value as i128);
                    Self::constant(hi, lo)
                }
            }
        )*
    };
}

lift_float!(f64 f32);
lift_integer!(i8 i16 i32 i64 isize u8 u16 u32 u64 usize);

impl Lift<DoubleDouble> for DoubleDouble {
    #[inline(always)]
    fn lift(value: DoubleDouble) -> Self {
        value
    }
}

impl<T: Real + Lift<DoubleDouble>> Lift<DoubleDouble> for Dual<T> {
    #[inline(always)]
    fn lift(value: DoubleDouble) -> Self {
        Self::fixed(T::lift(value))
    }
}

impl Parameter for DoubleDouble {
    #[inline(always)]
    fn into_real<T: Real>(self) -> T {
        T::constant(self.hi(), self.lo())
    }
}
