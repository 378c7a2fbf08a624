//! One register as a scalar.
//!
//! Input: a [`Register`]. Output: [`V`], [`Flags`]. Invariant: every operation is the register's
//! own, or a few of them; rare arguments of elementary functions are computed lane by lane.

use core::fmt::{Debug, Formatter, Result};
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use super::{Base, Nf, assigning};
use crate::level::register::Register;
use hamiltonian_real::parts::elementary;
use hamiltonian_real::parts::{Bits, Rare, TWO_OVER_PI_MODULO_4, Word};
use hamiltonian_real::{Mask, Pack, Real, itself_in_lanes};

/// The numbers of one register.
#[repr(transparent)]
pub struct V<R>(R);

/// One flag a lane of a [`V`].
#[repr(transparent)]
pub struct Flags<R: Register>(R::Flags);

/// The bits of the numbers of one register.
#[repr(transparent)]
pub struct Words<R>(R);

impl<R: Copy> Copy for V<R> {}
impl<R: Copy> Clone for V<R> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: Register> Copy for Flags<R> {}
impl<R: Register> Clone for Flags<R> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: Copy> Copy for Words<R> {}
impl<R: Copy> Clone for Words<R> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: Register> Debug for V<R> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        R::store(self.0).fmt(f)
    }
}
impl<R: Register> Debug for Flags<R> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_list()
            .entries((0..R::LANES).map(|k| self.lane(k)))
            .finish()
    }
}

impl<R: Register> Default for V<R> {
    #[inline(always)]
    fn default() -> Self {
        Self(R::splat(0.0))
    }
}
impl<R: Register> PartialEq for V<R> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.equals(*other).all()
    }
}

/// Every lane −0: the bits of a sign.
#[inline(always)]
fn signs<R: Register>() -> R {
    R::splat(-0.0)
}

/// An operator of `V` or `Flags` by a function of [`Register`].
macro_rules! operator {
    ($Type:ident: $($Trait:ident $method:ident $function:ident;)*) => {
        $(
            impl<R: Register> $Trait for $Type<R> {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self(R::$function(self.0, other.0))
                }
            }
        )*
    };
}

operator! { V:
    Add add add;
    Sub sub sub;
    Mul mul mul;
    Div div div;
}
operator! { Flags:
    BitAnd bitand both_flags;
    BitOr bitor either_flag;
}
operator! { Words:
    BitAnd bitand and;
    BitOr bitor or;
    BitXor bitxor xor;
}
assigning! { [R: Register] V<R> }

impl<R: Register> Neg for V<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(R::xor(self.0, signs()))
    }
}
impl<R: Register> Not for Flags<R> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(R::not(self.0))
    }
}

impl<R: Register> Mask for Flags<R> {
    #[inline(always)]
    fn splat(flag: bool) -> Self {
        Self(R::flags(flag))
    }
    #[inline(always)]
    fn all(self) -> bool {
        R::bits(R::not(self.0)) == 0
    }
    #[inline(always)]
    fn any(self) -> bool {
        R::bits(self.0) != 0
    }
    #[inline(always)]
    fn lane(self, k: u32) -> bool {
        k < R::LANES && R::bits(self.0) >> k & 1 != 0
    }
    #[inline(always)]
    fn first(self) -> Option<u32> {
        let bits = R::bits(self.0);
        (bits != 0).then(|| bits.trailing_zeros())
    }
}

impl<R: Register> Bits for Words<R> {
    #[inline(always)]
    fn splat(x: u64) -> Self {
        Self(R::splat(f64::from_bits(x)))
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(R::plus(self.0, other.0))
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self(R::minus(self.0, other.0))
    }
    #[inline(always)]
    fn shl<const K: u32>(self) -> Self {
        Self(R::shl::<K>(self.0))
    }
    #[inline(always)]
    fn shr<const K: u32>(self) -> Self {
        Self(R::shr::<K>(self.0))
    }
}

impl<R: Register> Base for V<R> {}

impl<R: Register> Real for V<R> {
    type Mask = Flags<R>;
    type Size = Self;
    const LANES: u32 = R::LANES;
    itself_in_lanes! {}

    #[inline(always)]
    fn constant(hi: f64, lo: f64) -> Self {
        Self(R::splat(f64::constant(hi, lo)))
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        Self(R::fma(self.0, b.0, c.0))
    }
    #[inline(always)]
    fn select(mask: Flags<R>, yes: Self, no: Self) -> Self {
        Self(R::select(mask.0, yes.0, no.0))
    }
    #[inline(always)]
    fn replaced(mask: Flags<R>, new: Self, old: Self) -> Self {
        Self(R::replaced(mask.0, new.0, old.0))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Flags<R> {
        Flags(R::lt(self.0, other.0))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Flags<R> {
        Flags(R::le(self.0, other.0))
    }
    #[inline(always)]
    fn equals(self, other: Self) -> Flags<R> {
        Flags(R::equals(self.0, other.0))
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        let lanes = R::store(self.0);
        let mut largest = 0.0;
        for lane in lanes.as_ref() {
            largest = <f64 as Real>::max(largest, lane.abs());
        }
        largest
    }
    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn finite(self) -> Flags<R> {
        self.abs().lt(Self::constant(f64::INFINITY, 0.0))
    }
    #[inline(always)]
    fn lane(self, k: u32) -> f64 {
        let lanes = R::store(self.0);
        lanes.as_ref().get(k as usize).copied().unwrap_or(f64::NAN)
    }
    #[inline(always)]
    fn look_up<const M: usize, const N: usize>(
        at: [Self; M],
        table: impl Fn([f64; M]) -> [f64; N],
    ) -> [Self; N] {
        let mut points = [R::Array::default(); M];
        for (lanes, x) in points.iter_mut().zip(&at) {
            *lanes = R::store(x.0);
        }
        let mut found = [R::Array::default(); N];
        let mut k = 0;
        while k < R::LANES as usize {
            let mut point = [0.0; M];
            for (number, lanes) in point.iter_mut().zip(&points) {
                *number = lanes.as_ref()[k];
            }
            for (lanes, number) in found.iter_mut().zip(table(point)) {
                lanes.as_mut()[k] = number;
            }
            k += 1;
        }
        let mut packs = [Self::default(); N];
        for (pack, lanes) in packs.iter_mut().zip(&found) {
            *pack = Self(R::load(lanes));
        }
        packs
    }
    #[inline(always)]
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
        R::out_of_line(f)
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        let mut lanes = R::Array::default();
        for lane in lanes.as_mut() {
            *lane = next();
        }
        Self(R::load(&lanes))
    }
    #[inline(always)]
    fn epsilon() -> f64 {
        f64::EPSILON
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(R::sqrt(self.0))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let sign = R::and(self.0, signs());
        Self(R::xor(self.0, sign))
    }
    #[inline(always)]
    fn sign(self) -> Self {
        // The sign of 0 is 0, and that of NaN is NaN.
        let one = R::or(R::and(self.0, signs()), R::splat(1.0));
        let zero = Self::zero();
        Self::select(self.lt(zero) | zero.lt(self), Self(one), self)
    }
    elementary! { #[inline(always)] }
}

impl<R: Register> Word for V<R> {
    type Bits = Words<R>;
    const FUSED: bool = R::FUSED;

    #[inline(always)]
    fn bits(self) -> Words<R> {
        Words(self.0)
    }
    #[inline(always)]
    fn from_bits(bits: Words<R>) -> Self {
        Self(bits.0)
    }
    #[inline(always)]
    fn odd(bits: Words<R>) -> Flags<R> {
        Flags(R::odd(bits.0))
    }
    #[inline(always)]
    fn scaled(self, k: Self) -> Option<Self> {
        Some(Self(R::scaled(self.0, k.0)?))
    }
    #[inline(always)]
    fn rare_of_each<F: Rare<N, M>, const N: usize, const M: usize, const K: usize>(
        x: [[Self; N]; K],
        fusing: bool,
    ) -> [[Self; M]; K] {
        let mut values = [[Self::default(); M]; K];
        // These are copies, because an argument that is passed by reference is in memory at each
        // use.
        if fusing || !R::FUSED {
            let mut copies = [[Self::default(); N]; K];
            for (copies, x) in copies.iter_mut().zip(&x) {
                for (copy, x) in copies.iter_mut().zip(x) {
                    *copy = *x;
                }
            }
            R::rare::<F, Self, N, M, K>(&copies, &mut values);
            return values;
        }
        let mut copies = [[Nf(Self::default()); N]; K];
        for (copies, x) in copies.iter_mut().zip(&x) {
            for (copy, x) in copies.iter_mut().zip(x) {
                *copy = Nf(*x);
            }
        }
        let mut unfused = [[Nf(Self::default()); M]; K];
        R::rare::<F, Nf<Self>, N, M, K>(&copies, &mut unfused);
        for (values, unfused) in values.iter_mut().zip(&unfused) {
            for (value, y) in values.iter_mut().zip(unfused) {
                *value = y.0;
            }
        }
        values
    }
    #[inline(always)]
    fn two_over_pi(bits: Words<R>) -> [Self; 4] {
        let [a, b, c, d] = R::rows(R::shr::<52>(bits.0), &TWO_OVER_PI_MODULO_4);
        [Self(a), Self(b), Self(c), Self(d)]
    }
    #[cold]
    #[inline(never)]
    fn replace(self, mask: Flags<R>, x: Self, f: fn(f64) -> f64) -> Self {
        let (mut lanes, x) = (R::store(self.0), R::store(x.0));
        for (k, (lane, x)) in (0..).zip(lanes.as_mut().iter_mut().zip(x.as_ref())) {
            if mask.lane(k) {
                *lane = f(*x);
            }
        }
        Self(R::load(&lanes))
    }
    #[cold]
    #[inline(never)]
    fn replace2(self, mask: Flags<R>, x: Self, y: Self, f: fn(f64, f64) -> f64) -> Self {
        let (mut lanes, x, y) = (R::store(self.0), R::store(x.0), R::store(y.0));
        let operands = x.as_ref().iter().zip(y.as_ref());
        for (k, (lane, (x, y))) in (0..).zip(lanes.as_mut().iter_mut().zip(operands)) {
            if mask.lane(k) {
                *lane = f(*x, *y);
            }
        }
        Self(R::load(&lanes))
    }
}

impl<R: Register> Pack for V<R> {
    #[inline(always)]
    fn load(from: &[f64], missing: f64) -> Self {
        let lanes = from.get(..R::LANES as usize);
        match lanes.and_then(|lanes| R::Array::try_from(lanes).ok()) {
            Some(lanes) => Self(R::load(&lanes)),
            None => {
                let mut lanes = R::store(R::splat(missing));
                for (lane, value) in lanes.as_mut().iter_mut().zip(from) {
                    *lane = *value;
                }
                Self(R::load(&lanes))
            }
        }
    }
    #[inline(always)]
    fn store(self, into: &mut [f64]) {
        let lanes = R::store(self.0);
        match into.get_mut(..R::LANES as usize) {
            Some(into) => into.copy_from_slice(lanes.as_ref()),
            None => {
                for (value, lane) in into.iter_mut().zip(lanes.as_ref()) {
                    *value = *lane;
                }
            }
        }
    }
    #[inline(always)]
    fn below(n: u32) -> Flags<R> {
        let mut lanes = R::Array::default();
        for (k, lane) in (0..).zip(lanes.as_mut()) {
            *lane = f64::from(k);
        }
        Flags(R::lt(R::load(&lanes), R::splat(f64::from(n))))
    }
}
