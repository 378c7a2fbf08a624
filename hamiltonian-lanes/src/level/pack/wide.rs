//! Several packs in lock-step.
//!
//! Input: a pack and how many of it. Output: [`W`]. Invariant: each operation is done for all packs
//! before the next operation begins, so that independent operations overlap. A single pack would
//! wait for the result of every operation.

use core::fmt::{Debug, Formatter, Result};
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use super::apart::{Apart, OfRegisters};
use super::{Base, assigning};
use hamiltonian_real::parts::elementary;
use hamiltonian_real::parts::{Bits, Rare, Word};
use hamiltonian_real::{Mask, OfNumbers, Pack, Real, itself_in_lanes};

/// `K` packs as one of `K` times as many lanes; pack 0 has the first lanes.
///
/// ```
/// use hamiltonian::lanes::Mask;
/// use hamiltonian::lanes::W;
/// use hamiltonian::prelude::*;
///
/// let x = W([1.0, 2.0, f64::NAN, 4.0]);
/// assert_eq!((x + x).lane(3), 8.0);
/// assert_eq!((!x.finite()).first(), Some(2));
/// assert_eq!((W([1.0; 9]) + W([2.0; 9])).lane(8), 3.0);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct W<P, const K: usize>(pub [P; K]);

/// The masks of the packs of a [`W`].
#[repr(transparent)]
pub struct Masks<P: Real, const K: usize>([P::Mask; K]);

/// The bits of the packs of a [`W`].
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct WideWords<P: Word, const K: usize>([P::Bits; K]);

impl<P: Real, const K: usize> Copy for Masks<P, K> {}
impl<P: Real, const K: usize> Clone for Masks<P, K> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<P: Real, const K: usize> Debug for Masks<P, K> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        self.0.fmt(f)
    }
}

/// The array whose element `k` is `$each`; it replaces `$before`, which is not read.
///
/// The first eight elements are written out. A loop around an instruction of a level is unrolled only where all is
/// inlined, and a block of steps would have a thousand of them: LLVM takes longer for these loops than for all else.
macro_rules! each {
    ($K:ident, $before:expr, $k:ident => $each:expr) => {{
        let mut out = $before;
        each! { @ 0 1 2 3 4 5 6 7; $K, out, $k => $each }
        let mut $k = 8;
        while $k < $K {
            out[$k] = $each;
            $k += 1;
        }
        out
    }};
    (@ $($number:literal)*; $K:ident, $out:ident, $k:ident => $each:expr) => {
        $(if const { $number < $K } {
            let $k = $number;
            $out[$k] = $each;
        })*
    };
}

/// An operator by that of the packs.
macro_rules! operators {
    ($Type:ident<$Bound:ident>: $($Trait:ident $method:ident;)*) => {
        $(
            impl<P: $Bound, const K: usize> $Trait for $Type<P, K> {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self(each!(K, self.0, k => self.0[k].$method(other.0[k])))
                }
            }
        )*
    };
    (unary $Type:ident<$Bound:ident>: $Trait:ident $method:ident) => {
        impl<P: $Bound, const K: usize> $Trait for $Type<P, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self) -> Self {
                Self(each!(K, self.0, k => self.0[k].$method()))
            }
        }
    };
}

operators! { W<Base>:
    Add add;
    Sub sub;
    Mul mul;
    Div div;
}
operators! { Masks<Base>:
    BitAnd bitand;
    BitOr bitor;
}
operators! { WideWords<Base>:
    BitAnd bitand;
    BitOr bitor;
    BitXor bitxor;
}
operators! { unary W<Base>: Neg neg }
operators! { unary Masks<Base>: Not not }
assigning! { [P: Base, const K: usize] W<P, K> }

impl<P: Base, const K: usize> Default for W<P, K> {
    #[inline(always)]
    fn default() -> Self {
        Self::zero()
    }
}
impl<P: Base, const K: usize> PartialEq for W<P, K> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.equals(*other).all()
    }
}

impl<P: Base, const K: usize> Mask for Masks<P, K> {
    #[inline(always)]
    fn splat(flag: bool) -> Self {
        Self([P::Mask::splat(flag); K])
    }
    #[inline(always)]
    fn all(self) -> bool {
        !(!self).any()
    }
    #[inline(always)]
    fn any(self) -> bool {
        // Three masks at a time: compilers would combine more masks of a byte each in vectors, which is
        // slower. Without a branch, so that what is computed before one on the result is not computed
        // again for an equal argument after it.
        let (mut k, mut found) = (0, false);
        while k < K {
            let mut any = self.0[k];
            if k + 1 < K {
                any = any | self.0[k + 1];
            }
            if k + 2 < K {
                any = any | self.0[k + 2];
            }
            found |= any.any();
            k += 3;
        }
        found
    }
    #[inline(always)]
    fn lane(self, k: u32) -> bool {
        let pack = self.0.get((k / P::LANES) as usize);
        pack.is_some_and(|mask| mask.lane(k % P::LANES))
    }
    #[inline(always)]
    fn first(self) -> Option<u32> {
        let mut before = 0;
        for mask in self.0 {
            if let Some(k) = mask.first() {
                return Some(before + k);
            }
            before += P::LANES;
        }
        None
    }
}

impl<P: Base, const K: usize> Bits for WideWords<P, K> {
    #[inline(always)]
    fn splat(x: u64) -> Self {
        Self([P::Bits::splat(x); K])
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(each!(K, self.0, k => self.0[k].plus(other.0[k])))
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self(each!(K, self.0, k => self.0[k].minus(other.0[k])))
    }
    #[inline(always)]
    fn shl<const S: u32>(self) -> Self {
        Self(each!(K, self.0, k => self.0[k].shl::<S>()))
    }
    #[inline(always)]
    fn shr<const S: u32>(self) -> Self {
        Self(each!(K, self.0, k => self.0[k].shr::<S>()))
    }
}

impl<P: Base, const K: usize> Base for W<P, K> {
    /// The calls stand in a function of their own: a loop that interprets code has many places that call it.
    #[inline(always)]
    fn by_registers<F: OfRegisters<N>, const N: usize>(f: F, x: [Self; N]) -> Self {
        P::out_of_line(
            #[inline(always)]
            || {
                let mut values = [P::default(); K];
                for (k, value) in values.iter_mut().enumerate() {
                    let mut of_register = [P::default(); N];
                    for (to, x) in of_register.iter_mut().zip(&x) {
                        *to = x.0[k];
                    }
                    *value = P::by_registers(f, of_register);
                }
                W(values)
            },
        )
    }
}

impl<P: Base, const K: usize> Real for W<P, K> {
    type Mask = Masks<P, K>;
    type Size = Self;
    const LANES: u32 = P::LANES * K as u32;
    itself_in_lanes! {}

    #[inline(always)]
    fn constant(hi: f64, lo: f64) -> Self {
        Self([P::constant(hi, lo); K])
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        Self(each!(K, self.0, k => self.0[k].fma(b.0[k], c.0[k])))
    }
    #[inline(always)]
    fn select(mask: Masks<P, K>, yes: Self, no: Self) -> Self {
        Self(each!(K, no.0, k => P::select(mask.0[k], yes.0[k], no.0[k])))
    }
    #[inline(always)]
    fn replaced(mask: Masks<P, K>, new: Self, old: Self) -> Self {
        Self(each!(K, old.0, k => P::replaced(mask.0[k], new.0[k], old.0[k])))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Masks<P, K> {
        Masks(each!(K, [P::Mask::splat(false); K], k => self.0[k].lt(other.0[k])))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Masks<P, K> {
        Masks(each!(K, [P::Mask::splat(false); K], k => self.0[k].le(other.0[k])))
    }
    #[inline(always)]
    fn equals(self, other: Self) -> Masks<P, K> {
        Masks(each!(K, [P::Mask::splat(false); K], k => self.0[k].equals(other.0[k])))
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        let mut largest = 0.0;
        for pack in self.0 {
            largest = <f64 as Real>::max(largest, pack.magnitude());
        }
        largest
    }
    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn finite(self) -> Masks<P, K> {
        Masks(each!(K, [P::Mask::splat(false); K], k => self.0[k].finite()))
    }
    #[inline(always)]
    fn lane(self, k: u32) -> f64 {
        let pack = self.0.get((k / P::LANES) as usize);
        pack.map_or(f64::NAN, |pack| pack.lane(k % P::LANES))
    }
    #[inline(always)]
    fn look_up<const M: usize, const N: usize>(
        at: [Self; M],
        table: impl Fn([f64; M]) -> [f64; N],
    ) -> [Self; N] {
        let mut found = [Self::default(); N];
        let mut k = 0;
        while k < K {
            let mut inner = [P::default(); M];
            for (to, x) in inner.iter_mut().zip(&at) {
                *to = x.0[k];
            }
            for (to, number) in found.iter_mut().zip(P::look_up(inner, &table)) {
                to.0[k] = number;
            }
            k += 1;
        }
        found
    }
    #[inline(always)]
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
        P::out_of_line(f)
    }
    #[inline(always)]
    fn apart<F: OfNumbers<N>, const N: usize>(f: F, x: [Self; N]) -> Self {
        Self::by_registers(Apart(f), x)
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Self([(); K].map(|()| P::read_words(next)))
    }
    #[inline(always)]
    fn epsilon() -> f64 {
        f64::EPSILON
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(each!(K, self.0, k => self.0[k].sqrt()))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(each!(K, self.0, k => self.0[k].abs()))
    }
    #[inline(always)]
    fn sign(self) -> Self {
        Self(each!(K, self.0, k => self.0[k].sign()))
    }
    // These run in lock-step too: pack by pack they take 20 to 50 % more time.
    elementary! { #[inline(always)] }
}

impl<P: Base, const K: usize> Word for W<P, K> {
    type Bits = WideWords<P, K>;
    const FUSED: bool = P::FUSED;

    #[inline(always)]
    fn bits(self) -> WideWords<P, K> {
        WideWords(each!(K, [P::Bits::splat(0); K], k => self.0[k].bits()))
    }
    #[inline(always)]
    fn from_bits(bits: WideWords<P, K>) -> Self {
        Self(each!(K, [P::zero(); K], k => P::from_bits(bits.0[k])))
    }
    #[inline(always)]
    fn odd(bits: WideWords<P, K>) -> Masks<P, K> {
        Masks(each!(K, [P::Mask::splat(false); K], k => P::odd(bits.0[k])))
    }
    #[inline(always)]
    fn scaled(self, power: Self) -> Option<Self> {
        Some(Self(each!(K, self.0, k => self.0[k].scaled(power.0[k])?)))
    }
    #[inline(always)]
    fn rare_of_each<F: Rare<N, M>, const N: usize, const M: usize, const J: usize>(
        x: [[Self; N]; J],
        fusing: bool,
    ) -> [[Self; M]; J] {
        let mut values = [[W([P::zero(); K]); M]; J];
        for (values, x) in values.iter_mut().zip(&x) {
            let mut packs = [[P::zero(); N]; K];
            for (k, pack) in packs.iter_mut().enumerate() {
                for (to, x) in pack.iter_mut().zip(x) {
                    *to = x.0[k];
                }
            }
            let packs = P::rare_of_each::<F, N, M, K>(packs, fusing);
            for (k, pack) in packs.iter().enumerate() {
                for (value, y) in values.iter_mut().zip(pack) {
                    value.0[k] = *y;
                }
            }
        }
        values
    }
    #[inline(always)]
    fn two_over_pi(bits: WideWords<P, K>) -> [Self; 4] {
        let mut words = [W([P::zero(); K]); 4];
        let mut k = 0;
        while k < K {
            for (to, word) in words.iter_mut().zip(P::two_over_pi(bits.0[k])) {
                to.0[k] = word;
            }
            k += 1;
        }
        words
    }
    #[inline(always)]
    fn replace(self, mask: Masks<P, K>, x: Self, f: fn(f64) -> f64) -> Self {
        // These are copies, because an argument that is passed by reference is in memory at each
        // use: the values would leave their registers on the common path.
        let mut out = Self(each!(K, [P::zero(); K], k => self.0[k]));
        let x = Self(each!(K, [P::zero(); K], k => x.0[k]));
        replace_in_packs(&mut out, &mask.ones(), &x, f);
        Self(each!(K, [P::zero(); K], k => out.0[k]))
    }
    #[inline(always)]
    fn replace2(self, mask: Masks<P, K>, x: Self, y: Self, f: fn(f64, f64) -> f64) -> Self {
        let mut out = Self(each!(K, [P::zero(); K], k => self.0[k]));
        let x = Self(each!(K, [P::zero(); K], k => x.0[k]));
        let y = Self(each!(K, [P::zero(); K], k => y.0[k]));
        replace_in_packs2(&mut out, &mask.ones(), &x, &y, f);
        Self(each!(K, [P::zero(); K], k => out.0[k]))
    }
}

impl<P: Base, const K: usize> Masks<P, K> {
    /// 1 where a lane is set, 0 elsewhere: a mask for calls. As masks of a byte each they would be
    /// gathered in a vector on the common path.
    #[inline(always)]
    fn ones(self) -> W<P, K> {
        W(each!(K, [P::zero(); K], k => P::select(self.0[k], P::one(), P::zero())))
    }
}

/// [`Word::replace`] pack by pack, in the lanes where `ones` is not 0.
#[cold]
#[inline(never)]
fn replace_in_packs<P: Base, const K: usize>(
    out: &mut W<P, K>,
    ones: &W<P, K>,
    x: &W<P, K>,
    f: fn(f64) -> f64,
) {
    for (k, pack) in out.0.iter_mut().enumerate() {
        let mask = P::zero().lt(ones.0[k]);
        if mask.any() {
            *pack = pack.replace(mask, x.0[k], f);
        }
    }
}

/// [`Word::replace2`] pack by pack, in the lanes where `ones` is not 0.
#[cold]
#[inline(never)]
fn replace_in_packs2<P: Base, const K: usize>(
    out: &mut W<P, K>,
    ones: &W<P, K>,
    x: &W<P, K>,
    y: &W<P, K>,
    f: fn(f64, f64) -> f64,
) {
    for (k, pack) in out.0.iter_mut().enumerate() {
        let mask = P::zero().lt(ones.0[k]);
        if mask.any() {
            *pack = pack.replace2(mask, x.0[k], y.0[k], f);
        }
    }
}

impl<P: Base, const K: usize> Pack for W<P, K> {
    #[inline(always)]
    fn load(from: &[f64], missing: f64) -> Self {
        let lanes = P::LANES as usize;
        Self(each!(K, [P::zero(); K], k => {
            P::load(from.get(k * lanes..).unwrap_or_default(), missing)
        }))
    }
    #[inline(always)]
    fn store(self, into: &mut [f64]) {
        let lanes = P::LANES as usize;
        let mut k = 0;
        while k < K {
            self.0[k].store(into.get_mut(k * lanes..).unwrap_or_default());
            k += 1;
        }
    }
    #[inline(always)]
    fn below(n: u32) -> Masks<P, K> {
        Masks(each!(K, [P::Mask::splat(false); K], k => {
            P::below(n.saturating_sub(k as u32 * P::LANES))
        }))
    }
}
