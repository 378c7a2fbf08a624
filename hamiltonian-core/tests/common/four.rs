//! Four independent numbers as one scalar, without any care for speed.

use hamiltonian_core::Real;
use hamiltonian_lanes::Mask;
use std::array::from_fn;
use std::ops::{
    Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign,
};

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Four(pub [f64; 4]);

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flags(pub [bool; 4]);

impl BitAnd for Flags {
    type Output = Flags;
    fn bitand(self, other: Flags) -> Flags {
        Flags(from_fn(|k| self.0[k] & other.0[k]))
    }
}

impl BitOr for Flags {
    type Output = Flags;
    fn bitor(self, other: Flags) -> Flags {
        Flags(from_fn(|k| self.0[k] | other.0[k]))
    }
}

impl Not for Flags {
    type Output = Flags;
    fn not(self) -> Flags {
        Flags(self.0.map(|flag| !flag))
    }
}

impl Mask for Flags {
    fn splat(flag: bool) -> Self {
        Flags([flag; 4])
    }
    fn all(self) -> bool {
        self.0.iter().all(|flag| *flag)
    }
    fn any(self) -> bool {
        self.0.iter().any(|flag| *flag)
    }
    fn lane(self, k: u32) -> bool {
        self.0.get(k as usize).copied().unwrap_or(false)
    }
    fn first(self) -> Option<u32> {
        (0..4).find(|k| self.lane(*k))
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $in_place:ident;)+) => {$(
        impl $operator for Four {
            type Output = Four;
            fn $method(self, other: Four) -> Four {
                Four(from_fn(|k| self.0[k].$method(other.0[k])))
            }
        }
        impl $assign for Four {
            fn $in_place(&mut self, other: Four) {
                *self = self.$method(other);
            }
        }
    )+};
}

operators! {
    Add add AddAssign add_assign;
    Sub sub SubAssign sub_assign;
    Mul mul MulAssign mul_assign;
    Div div DivAssign div_assign;
}

impl Neg for Four {
    type Output = Four;
    fn neg(self) -> Four {
        Four(self.0.map(|x| -x))
    }
}

macro_rules! functions {
    ($($unary:ident)+; $($binary:ident)+) => {
        $(fn $unary(self) -> Self {
            Four(self.0.map(Real::$unary))
        })+
        $(fn $binary(self, other: Self) -> Self {
            Four(from_fn(|k| Real::$binary(self.0[k], other.0[k])))
        })+
    };
}

impl Real for Four {
    type Mask = Flags;
    type Size = Four;
    const LANES: u32 = 4;
    hamiltonian_lanes::itself_in_lanes! {}

    fn constant(hi: f64, lo: f64) -> Self {
        Four([<f64 as Real>::constant(hi, lo); 4])
    }
    fn fma(self, b: Self, c: Self) -> Self {
        Four(from_fn(|k| Real::fma(self.0[k], b.0[k], c.0[k])))
    }
    fn select(mask: Flags, yes: Self, no: Self) -> Self {
        Four(from_fn(|k| if mask.0[k] { yes.0[k] } else { no.0[k] }))
    }
    fn lt(self, other: Self) -> Flags {
        Flags(from_fn(|k| self.0[k] < other.0[k]))
    }
    fn le(self, other: Self) -> Flags {
        Flags(from_fn(|k| self.0[k] <= other.0[k]))
    }
    fn equals(self, other: Self) -> Flags {
        Flags(from_fn(|k| self.0[k] == other.0[k]))
    }
    fn magnitude(self) -> f64 {
        let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
        self.0.map(f64::abs).into_iter().fold(0.0, larger)
    }
    fn size(self) -> Four {
        Four(self.0.map(f64::abs))
    }
    fn finite(self) -> Flags {
        Flags(self.0.map(f64::is_finite))
    }
    fn lane(self, k: u32) -> f64 {
        self.0.get(k as usize).copied().unwrap_or(f64::NAN)
    }
    fn epsilon() -> f64 {
        f64::EPSILON
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Four(from_fn(|_| next()))
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    functions! {
        sqrt cbrt abs sign sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp erf erfc exp_m1
        ln ln_1p floor round;
        atan2 hypot pow modulo remainder
    }
}
