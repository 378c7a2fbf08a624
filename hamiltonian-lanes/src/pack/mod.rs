//! Packs: several `f64` as one scalar.
//!
//! Input: registers of a level, or `f64`. Output: [`Pack`], with one register ([`V`]), several in
//! lock-step ([`W`]) and any of them unfused ([`Nf`]). Invariant: a lane's result depends on that
//! lane's operands alone, and is what `f64` gives in every pack that does not fuse.

mod register;
mod unfused;
mod wide;

pub use register::V;
pub use unfused::Nf;
pub use wide::W;

use crate::lift::LiftEvery;
use crate::real::Real;
use crate::word::Word;

/// A scalar that is several `f64` beside each other, lanes; `f64` itself is one lane.
///
/// The packs depend on the CPU, so a kernel takes them from its
/// [`Level`](crate::Level); [`W`] and [`Nf`] make packs from packs.
///
/// ```
/// use hamiltonian_lanes::{Pack, Real, W};
///
/// let x = W::<f64, 4>::load(&[1.0, 4.0, 9.0], 0.0);
/// let mut roots = [0.0; 3];
/// x.sqrt().store(&mut roots);
/// assert_eq!(roots, [1.0, 2.0, 3.0]);
/// ```
pub trait Pack: Word + Real<Size = Self> + LiftEvery {
    /// Lane k is number k of `from`, or `missing` where there is none.
    fn load(from: &[f64], missing: f64) -> Self;
    /// Writes lane k to number k of `into`; lanes for which there is no place are left out.
    fn store(self, into: &mut [f64]);
    /// The first `n` lanes: those that [`load`](Pack::load) takes from `n` numbers.
    ///
    /// ```
    /// use hamiltonian_lanes::{Mask, Pack, W};
    /// let mask = W::<f64, 4>::below(3);
    /// assert!(mask.lane(2) && !mask.lane(3));
    /// ```
    fn below(n: u32) -> Self::Mask;
}

impl Pack for f64 {
    #[inline(always)]
    fn load(from: &[f64], missing: f64) -> Self {
        from.first().copied().unwrap_or(missing)
    }
    #[inline(always)]
    fn store(self, into: &mut [f64]) {
        if let Some(first) = into.first_mut() {
            *first = self;
        }
    }
    #[inline(always)]
    fn below(n: u32) -> bool {
        n > 0
    }
}

/// `x += y` and its kin from `x + y`, for a generic type.
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
        crate::pack::assigning! { @one $generics $Type, AddAssign add_assign + }
        crate::pack::assigning! { @one $generics $Type, SubAssign sub_assign - }
        crate::pack::assigning! { @one $generics $Type, MulAssign mul_assign * }
        crate::pack::assigning! { @one $generics $Type, DivAssign div_assign / }
    };
}
use assigning;
