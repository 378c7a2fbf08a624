//! Lanes in plain code, for every architecture.
//!
//! Input: one or two numbers. Output: [`Register`] for [`Two`], and [`plain!`] that makes it.
//! Invariant: straight-line code without loops, which compilers turn into packed instructions where
//! there are any; only the given `fma` may fuse.

use super::register::Register;

/// Two numbers beside each other.
#[derive(Clone, Copy)]
pub struct Two([f64; 2]);

/// [`Register`] for `$Type([f64; $n])`, lane by lane, with a function for `fma` of one lane.
macro_rules! plain {
    ($Type:ident, $n:literal, fused: $fused:literal, fma: $fma:path, features: [$($features:literal)?], $($k:tt)*) => {
        impl Register for $Type {
            type Flags = [bool; $n];
            type Array = [f64; $n];
            const LANES: u32 = $n;
            const FUSED: bool = $fused;

            crate::level::register::out_of_line!($($features)?);

            #[inline(always)]
            fn splat(value: f64) -> Self {
                Self([value; $n])
            }
            #[inline(always)]
            fn load(lanes: &[f64; $n]) -> Self {
                Self(*lanes)
            }
            #[inline(always)]
            fn store(a: Self) -> [f64; $n] {
                a.0
            }
            #[inline(always)]
            fn add(a: Self, b: Self) -> Self {
                Self([$(a.0[$k] + b.0[$k]),*])
            }
            #[inline(always)]
            fn sub(a: Self, b: Self) -> Self {
                Self([$(a.0[$k] - b.0[$k]),*])
            }
            #[inline(always)]
            fn mul(a: Self, b: Self) -> Self {
                Self([$(a.0[$k] * b.0[$k]),*])
            }
            #[inline(always)]
            fn div(a: Self, b: Self) -> Self {
                Self([$(a.0[$k] / b.0[$k]),*])
            }
            #[inline(always)]
            fn fma(a: Self, b: Self, c: Self) -> Self {
                Self([$($fma(a.0[$k], b.0[$k], c.0[$k])),*])
            }
            #[inline(always)]
            fn sqrt(a: Self) -> Self {
                Self([$(hamiltonian_real::Real::sqrt(a.0[$k])),*])
            }
            #[inline(always)]
            fn and(a: Self, b: Self) -> Self {
                Self([$(f64::from_bits(a.0[$k].to_bits() & b.0[$k].to_bits())),*])
            }
            #[inline(always)]
            fn or(a: Self, b: Self) -> Self {
                Self([$(f64::from_bits(a.0[$k].to_bits() | b.0[$k].to_bits())),*])
            }
            #[inline(always)]
            fn xor(a: Self, b: Self) -> Self {
                Self([$(f64::from_bits(a.0[$k].to_bits() ^ b.0[$k].to_bits())),*])
            }
            #[inline(always)]
            fn plus(a: Self, b: Self) -> Self {
                Self([$(f64::from_bits(
                    a.0[$k].to_bits().wrapping_add(b.0[$k].to_bits()),
                )),*])
            }
            #[inline(always)]
            fn minus(a: Self, b: Self) -> Self {
                Self([$(f64::from_bits(
                    a.0[$k].to_bits().wrapping_sub(b.0[$k].to_bits()),
                )),*])
            }
            #[inline(always)]
            fn shl<const K: u32>(a: Self) -> Self {
                Self([$(f64::from_bits(a.0[$k].to_bits() << K)),*])
            }
            #[inline(always)]
            fn shr<const K: u32>(a: Self) -> Self {
                Self([$(f64::from_bits(a.0[$k].to_bits() >> K)),*])
            }
            #[inline(always)]
            fn odd(a: Self) -> [bool; $n] {
                [$(a.0[$k].to_bits() & 1 != 0),*]
            }
            #[inline(always)]
            fn lt(a: Self, b: Self) -> [bool; $n] {
                [$(a.0[$k] < b.0[$k]),*]
            }
            #[inline(always)]
            fn le(a: Self, b: Self) -> [bool; $n] {
                [$(a.0[$k] <= b.0[$k]),*]
            }
            #[inline(always)]
            fn equals(a: Self, b: Self) -> [bool; $n] {
                [$(a.0[$k] == b.0[$k]),*]
            }
            #[inline(always)]
            fn select(flags: [bool; $n], yes: Self, no: Self) -> Self {
                Self([$(if flags[$k] { yes.0[$k] } else { no.0[$k] }),*])
            }
            #[inline(always)]
            fn flags(flag: bool) -> [bool; $n] {
                [flag; $n]
            }
            #[inline(always)]
            fn both_flags(a: [bool; $n], b: [bool; $n]) -> [bool; $n] {
                [$(a[$k] & b[$k]),*]
            }
            #[inline(always)]
            fn either_flag(a: [bool; $n], b: [bool; $n]) -> [bool; $n] {
                [$(a[$k] | b[$k]),*]
            }
            #[inline(always)]
            fn not(a: [bool; $n]) -> [bool; $n] {
                [$(!a[$k]),*]
            }
            #[inline(always)]
            fn bits(a: [bool; $n]) -> u32 {
                $(u32::from(a[$k]) << $k)|*
            }
        }
    };
}
// One lane of it is made where a level has one.
#[allow(unused_imports)]
pub(super) use plain;

#[inline(always)]
fn twice_rounded(a: f64, b: f64, c: f64) -> f64 {
    a * b + c
}

plain!(Two, 2, fused: false, fma: twice_rounded, features: [], 0 1);
