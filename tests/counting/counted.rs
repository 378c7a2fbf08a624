//! A scalar that counts the operations on it.
//!
//! Input: any code generic over the scalar. Output: its values as `f64`, and how many operations
//! of each kind this thread made meanwhile. Invariant: every arithmetic operation of [`Real`]
//! counts, once each; lifting, constants, signs, comparisons and choices are no arithmetic.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use hamiltonian::Real;
use std::cell::Cell;

/// Operations by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Sums and differences; a fused operation has one.
    pub additions: usize,
    /// Products; a fused operation has one.
    pub multiplications: usize,
    /// Quotients and reciprocals.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
    /// Exponentials.
    pub exponentials: usize,
    /// All other functions.
    pub functions: usize,
}

thread_local! {
    static COUNTS: Cell<Counts> = Cell::default();
}

/// The result of `work`, and the operations it made.
pub fn counted<R>(work: impl FnOnce() -> R) -> (R, Counts) {
    COUNTS.set(Counts::default());
    let result = work();
    (result, COUNTS.get())
}

fn count<const COUNTS: bool>(what: impl FnOnce(&mut Counts) -> &mut usize) {
    if !COUNTS {
        return;
    }
    let mut counts = self::COUNTS.get();
    *what(&mut counts) += 1;
    self::COUNTS.set(counts);
}

/// An `f64` whose functions are compiled once, as calls; it counts, or does not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Called<const COUNTS: bool>(pub f64);

/// An `f64` that counts.
pub type Counted = Called<true>;

macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $assign_method:ident $counter:ident;)*) => {
        $(
            impl<const COUNTS: bool> $operator for Called<COUNTS> {
                type Output = Self;
                fn $method(self, other: Self) -> Self {
                    count::<COUNTS>(|counts| &mut counts.$counter);
                    Self(self.0.$method(other.0))
                }
            }
            impl<const COUNTS: bool> $assign for Called<COUNTS> {
                fn $assign_method(&mut self, other: Self) {
                    *self = self.$method(other);
                }
            }
        )*
    };
}

operators! {
    Add add AddAssign add_assign additions;
    Sub sub SubAssign sub_assign additions;
    Mul mul MulAssign mul_assign multiplications;
    Div div DivAssign div_assign divisions;
}

impl<const COUNTS: bool> Neg for Called<COUNTS> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! functions {
    ($counter:ident: $($name:ident)*) => {
        $(
            #[inline(never)]
            fn $name(self) -> Self {
                count::<COUNTS>(|counts| &mut counts.$counter);
                Self(Real::$name(self.0))
            }
        )*
    };
}

macro_rules! functions_of_two {
    ($($name:ident)*) => {
        $(
            #[inline(never)]
            fn $name(self, other: Self) -> Self {
                count::<COUNTS>(|counts| &mut counts.functions);
                Self(Real::$name(self.0, other.0))
            }
        )*
    };
}

impl<const COUNTS: bool> Real for Called<COUNTS> {
    type Mask = bool;
    type Size = f64;
    const LANES: u32 = 1;
    hamiltonian::lanes::itself_in_lanes! {}

    fn constant(hi: f64, lo: f64) -> Self {
        Self(f64::constant(hi, lo))
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Self(next())
    }
    fn fma(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    fn le(self, other: Self) -> bool {
        self.0 <= other.0
    }
    fn equals(self, other: Self) -> bool {
        self.0 == other.0
    }
    fn magnitude(self) -> f64 {
        self.0.abs()
    }
    fn size(self) -> f64 {
        self.0.abs()
    }
    fn finite(self) -> bool {
        self.0.is_finite()
    }
    fn lane(self, k: u32) -> f64 {
        self.0.lane(k)
    }
    fn epsilon() -> f64 {
        f64::EPSILON
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn sign(self) -> Self {
        Self(self.0.sign())
    }
    #[inline(never)]
    fn sin_cos(self) -> (Self, Self) {
        count::<COUNTS>(|counts| &mut counts.functions);
        let (sin, cos) = Real::sin_cos(self.0);
        (Self(sin), Self(cos))
    }
    functions!(roots: sqrt);
    functions!(exponentials: exp);
    functions!(functions: cbrt sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp_m1
        ln ln_1p erf erfc floor round);
    functions_of_two!(atan2 hypot pow modulo remainder);
}
