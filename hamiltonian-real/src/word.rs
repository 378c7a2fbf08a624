//! The operations from which elementary functions are built.
//!
//! Input: [`Real`]. Output: [`Word`], lanes of `f64` with operations on their bits; implemented
//! here for `f64`, and beside each pack for the pack. Invariant: a lane's result depends on that
//! lane's operands alone, so a function written over `Word` gives the same bits in a scalar and in
//! a lane of every type that fuses alike.

use core::ops::{BitAnd, BitOr, BitXor};

use crate::real::{Mask, Real};
use crate::two_over_pi::{TWO_OVER_PI_MODULO_4, two_over_pi};

/// One `u64` a lane. Sums wrap; shifts are logical and by a constant.
pub trait Bits:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self>
{
    /// Every lane `x`.
    fn splat(x: u64) -> Self;
    /// The sum modulo 2⁶⁴.
    fn plus(self, other: Self) -> Self;
    /// The difference modulo 2⁶⁴.
    fn minus(self, other: Self) -> Self;
    /// Towards higher bits, by `K < 64`.
    fn shl<const K: u32>(self) -> Self;
    /// Towards lower bits, zeros from above, by `K < 64`.
    fn shr<const K: u32>(self) -> Self;
}

/// A function at rare arguments, for [`Word::rare`].
pub trait Rare<const N: usize, const M: usize> {
    /// The values, in all lanes. To be `#[inline(always)]`.
    fn of<W: Word>(x: [W; N]) -> [W; M];
}

/// One `f64` a lane, with its bits. Each operator rounds; [`Real::fma`] is fused if [`Word::FUSED`]
/// is true, otherwise it is `self * b + c`.
pub trait Word: Real {
    /// The lanes' bits.
    type Bits: Bits;
    /// True if [`Real::fma`] rounds once.
    const FUSED: bool;

    /// The lanes' bits.
    fn bits(self) -> Self::Bits;
    /// The lanes with these bits.
    fn from_bits(bits: Self::Bits) -> Self;
    /// The mask of the lanes whose lowest bit is set.
    fn odd(bits: Self::Bits) -> Self::Mask;
    /// The number whose last `K` bits are 0 instead.
    #[inline(always)]
    fn cut<const K: u32>(self) -> Self {
        Self::from_bits(self.bits() & Self::Bits::splat(u64::MAX << K))
    }
    /// A third of numbers below 2³², rounded to nearest, in the lowest 32 bits.
    #[inline(always)]
    fn third(bits: Self::Bits) -> Self::Bits {
        const TWO_TO_52: f64 = (1u64 << 52) as f64;
        // The bits of 2⁵² and an integer: a quotient is a third away from a tie, or farther.
        let x = Self::from_bits(bits | Self::Bits::splat(TWO_TO_52.to_bits()));
        let x = x - Self::splat(TWO_TO_52);
        x.fma(Self::splat(1.0 / 3.0), Self::splat(TWO_TO_52)).bits()
    }
    /// `self·2^k` rounded once, for `0 < self ≤ 2` and an integer `k`, infinity or NaN, on levels
    /// that have an instruction for it. If `k` is not between −1100 and 1100, the result does not
    /// depend on `self`.
    #[inline(always)]
    fn scaled(self, _k: Self) -> Option<Self> {
        None
    }
    /// `F::of(x)`, out of line: one function of each level for all calls with rare arguments.
    #[inline(always)]
    fn rare<F: Rare<N, M>, const N: usize, const M: usize>(x: [Self; N]) -> [Self; M] {
        let [values] = Self::rare_of_each::<F, N, M, 1>([x], true);
        values
    }
    /// [`Word::rare`] of each, register by register; without fusing where `fusing` is false.
    fn rare_of_each<F: Rare<N, M>, const N: usize, const M: usize, const K: usize>(
        x: [[Self; N]; K],
        fusing: bool,
    ) -> [[Self; M]; K];
    /// Four words whose sum is 2^(e − 52)·2/π modulo 4, for the exponents e of numbers with these
    /// bits; undefined for numbers below 2.
    fn two_over_pi(bits: Self::Bits) -> [Self; 4];
    /// `f(x)` in the lanes where the mask is set, `self` elsewhere: rare arguments, lane by lane.
    /// Callers call it only if a lane is set, and from a function that is not inlined (`#[cold]`).
    fn replace(self, mask: Self::Mask, x: Self, f: fn(f64) -> f64) -> Self;
    /// [`Word::replace`] for functions of two arguments.
    fn replace2(self, mask: Self::Mask, x: Self, y: Self, f: fn(f64, f64) -> f64) -> Self;

    /// `self` where `plain` is set and `f(x)` elsewhere, with one test on the common path.
    #[inline(always)]
    fn or_rare(self, plain: Self::Mask, x: Self, f: fn(f64) -> f64) -> Self {
        let rare = !plain;
        if rare.any() {
            return self.replace(rare, x, f);
        }
        self
    }
    /// [`Word::or_rare`] for functions of two arguments.
    #[inline(always)]
    fn or_rare2(self, plain: Self::Mask, x: Self, y: Self, f: fn(f64, f64) -> f64) -> Self {
        let rare = !plain;
        if rare.any() {
            return self.replace2(rare, x, y, f);
        }
        self
    }

    /// Every lane `x`.
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self::constant(x, 0.0)
    }
}

impl Bits for u64 {
    #[inline(always)]
    fn splat(x: u64) -> Self {
        x
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self.wrapping_sub(other)
    }
    #[inline(always)]
    fn shl<const K: u32>(self) -> Self {
        self << K
    }
    #[inline(always)]
    fn shr<const K: u32>(self) -> Self {
        self >> K
    }
}

impl Word for f64 {
    type Bits = u64;
    const FUSED: bool = false;

    #[inline(always)]
    fn bits(self) -> u64 {
        self.to_bits()
    }
    #[inline(always)]
    fn from_bits(bits: u64) -> Self {
        Self::from_bits(bits)
    }
    #[inline(always)]
    fn odd(bits: u64) -> bool {
        bits & 1 != 0
    }
    #[inline(always)]
    fn third(bits: u64) -> u64 {
        // This avoids a conversion to a float and back.
        (bits + 1) / 3
    }
    #[inline(always)]
    fn rare_of_each<F: Rare<N, M>, const N: usize, const M: usize, const K: usize>(
        x: [[f64; N]; K],
        _fusing: bool,
    ) -> [[f64; M]; K] {
        #[cold]
        #[inline(never)]
        fn entry<F: Rare<N, M>, const N: usize, const M: usize>(x: [f64; N]) -> [f64; M] {
            F::of(x)
        }
        x.map(entry::<F, N, M>)
    }
    #[inline(always)]
    fn two_over_pi(bits: u64) -> [f64; 4] {
        let field = bits >> 52;
        if cfg!(feature = "std") {
            TWO_OVER_PI_MODULO_4[field as usize & 1023]
        } else {
            // This needs no memory for a table.
            two_over_pi((field & 2047).max(1024))
        }
    }
    #[inline(always)]
    fn replace(self, mask: bool, x: Self, f: fn(f64) -> f64) -> Self {
        if mask { f(x) } else { self }
    }
    #[inline(always)]
    fn replace2(self, mask: bool, x: Self, y: Self, f: fn(f64, f64) -> f64) -> Self {
        if mask { f(x, y) } else { self }
    }
}
