//! Packs: several `f64` as one scalar.
//!
//! Input: registers of a level, or `f64`. Output: each [`Pack`], with one register ([`V`]), several
//! in lock-step ([`W`]), any of them unfused ([`Nf`]) or by calls ([`Called`]). Invariant: a lane's result depends on
//! that lane's operands alone, and equals that of `f64` in every pack that does not fuse.

mod apart;
mod called;
mod parameter;
mod register;
mod unfused;
mod wide;

use apart::OfRegisters;
pub use called::Called;
pub use register::V;
pub use unfused::Nf;
pub use wide::W;

use hamiltonian_real::Pack;
use hamiltonian_real::parts::Word;

/// A pack from which [`W`] and [`Nf`] make packs.
pub trait Base: Pack + Word {
    /// A function of each register, one after the other. This one is of one register.
    #[doc(hidden)]
    #[inline(always)]
    fn by_registers<F: OfRegisters<N>, const N: usize>(f: F, x: [Self; N]) -> Self {
        f.of(x)
    }
}

/// `x += y` and the other assignments from `x + y`, for a generic type.
macro_rules! assigning {
    (@one [$($generics:tt)*] $Type:ty, $Trait:ident $method:ident $operator:tt) => {
        impl<$($generics)*> core::ops::$Trait for $Type {
            #[inline(always)]
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    };
    ($generics:tt $Type:ty) => {
        crate::level::pack::assigning! { @one $generics $Type, AddAssign add_assign + }
        crate::level::pack::assigning! { @one $generics $Type, SubAssign sub_assign - }
        crate::level::pack::assigning! { @one $generics $Type, MulAssign mul_assign * }
        crate::level::pack::assigning! { @one $generics $Type, DivAssign div_assign / }
    };
}
use assigning;
