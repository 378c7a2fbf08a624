//! Packs from all types of numbers that a parameter may have.
//!
//! Input: floats, integers. Output: [`Lift`] for packs, [`LiftEvery`], [`Parameter`]. Invariant: every lane is the
//! number as `f64`.

use core::any::Any;
use hamiltonian_real::{Lift, Parameter, Real};

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

/// A pack has parameters of its own in each lane, for states over the same pack alone. Over another scalar they have no
/// value, so that a start there is refused.
impl<P: Base, const K: usize> Parameter for W<P, K> {
    #[inline(always)]
    fn into_real<T: Real>(self) -> T {
        let own: &dyn Any = &self;
        own.downcast_ref::<T>()
            .copied()
            .unwrap_or_else(|| T::constant(f64::NAN, 0.0))
    }
}
