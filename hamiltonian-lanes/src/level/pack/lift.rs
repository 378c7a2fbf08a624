//! Packs from all types of numbers that a parameter may have.
//!
//! Input: floats, integers. Output: [`Lift`] for packs, [`LiftEvery`]. Invariant: every lane is the
//! number as `f64`.

use hamiltonian_real::Lift;

use super::{Base, Nf, V, W};
use crate::level::register::Register;

/// From one number. (From `f64` itself packs lift beside their definition.)
macro_rules! lift_pack {
    (f64) => {};
    ($number:ident) => {
        impl<R: Register> Lift<$number> for V<R> {
            #[inline(always)]
            fn lift(value: $number) -> Self {
                Self::lift(value as f64)
            }
        }
        impl<P: Base, const K: usize> Lift<$number> for W<P, K> {
            #[inline(always)]
            fn lift(value: $number) -> Self {
                Self::lift(value as f64)
            }
        }
        impl<P: Base> Lift<$number> for Nf<P> {
            #[inline(always)]
            fn lift(value: $number) -> Self {
                Self::lift(value as f64)
            }
        }
    };
}

/// Lifting from all types of numbers that a parameter may have.
macro_rules! lift_every {
    ($($number:ident)*) => {
        /// A scalar that lifts from every kind of number.
        pub trait LiftEvery: $(Lift<$number> +)* {}
        impl<T: $(Lift<$number> +)*> LiftEvery for T {}
        $(lift_pack!($number);)*
    };
}
lift_every!(f64 f32 i8 i16 i32 i64 isize u8 u16 u32 u64 usize);
