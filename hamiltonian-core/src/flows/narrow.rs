//! A scalar whose loops go one iteration after the other.
//!
//! Input: a scalar. Output: [`Narrow`], the same without a form in lanes, and dual numbers over it. Invariant: the bits
//! are those of the scalar, and no code is compiled for other levels.

use crate::systems::vector::{Over, Vector};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use hamiltonian_lanes::{Dual, Real, itself_in_lanes};

/// The scalar `T` without a form in lanes, for code that runs seldom: each loop in lanes is several copies of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Narrow<T>(pub T);

/// Numbers with derivatives along one direction.
pub type Varied<T> = Dual<Narrow<T>>;

/// A number without a derivative.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn fixed<T: Real>(x: T) -> Varied<T> {
    Dual::fixed(Narrow(x))
}

/// A vector without derivatives.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn fixed_vector<V: Vector>(v: &V) -> Over<V, Varied<V::Scalar>> {
    let mut to = v.zeros_over::<Varied<V::Scalar>>();
    for k in 0..V::PARTS {
        for (to, from) in to.part_mut(k).iter_mut().zip(v.part(k)) {
            *to = fixed(*from);
        }
    }
    to
}

/// A vector with the derivatives along a direction.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn along<V: Vector>(v: &V, direction: &V) -> Over<V, Varied<V::Scalar>> {
    let mut to = fixed_vector(v);
    for k in 0..V::PARTS {
        for (to, from) in to.part_mut(k).iter_mut().zip(direction.part(k)) {
            to.eps = Narrow(*from);
        }
    }
    to
}

/// Writes the derivatives.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn derivatives<V: Vector>(from: &Over<V, Varied<V::Scalar>>, to: &mut V) {
    for k in 0..V::PARTS {
        for (to, from) in to.part_mut(k).iter_mut().zip(from.part(k)) {
            *to = from.eps.0;
        }
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $assign_method:ident;)*) => {
        $(
            impl<T: Real> $operator for Narrow<T> {
                type Output = Self;
                #[cfg_attr(not(unoptimised), inline(always))]
                fn $method(self, other: Self) -> Self {
                    Narrow($operator::$method(self.0, other.0))
                }
            }
            impl<T: Real> $assign for Narrow<T> {
                #[cfg_attr(not(unoptimised), inline(always))]
                fn $assign_method(&mut self, other: Self) {
                    $assign::$assign_method(&mut self.0, other.0);
                }
            }
        )*
    };
}

operators! {
    Add add AddAssign add_assign;
    Sub sub SubAssign sub_assign;
    Mul mul MulAssign mul_assign;
    Div div DivAssign div_assign;
}

impl<T: Real> Neg for Narrow<T> {
    type Output = Self;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn neg(self) -> Self {
        Narrow(-self.0)
    }
}

/// Functions of numbers whose value is a number.
macro_rules! numbers {
    ($($name:ident($($argument:ident),*);)*) => {
        $(
            #[cfg_attr(not(unoptimised), inline(always))]
            fn $name(self $(, $argument: Self)*) -> Self {
                Narrow(self.0.$name($($argument.0),*))
            }
        )*
    };
}

/// Functions of numbers whose value is of another type.
macro_rules! others {
    ($($name:ident($($argument:ident),*) -> $result:ty;)*) => {
        $(
            #[cfg_attr(not(unoptimised), inline(always))]
            fn $name(self $(, $argument: Self)*) -> $result {
                self.0.$name($($argument.0),*)
            }
        )*
    };
}

impl<T: Real> Real for Narrow<T> {
    type Mask = T::Mask;
    type Size = T::Size;
    const LANES: u32 = T::LANES;
    itself_in_lanes! {}

    #[cfg_attr(not(unoptimised), inline(always))]
    fn constant(hi: f64, lo: f64) -> Self {
        Narrow(T::constant(hi, lo))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Narrow(T::select(mask, yes.0, no.0))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn lane(self, k: u32) -> f64 {
        self.0.lane(k)
    }
    fn epsilon() -> f64 {
        T::epsilon()
    }
    fn write_words(self, to: &mut dyn FnMut(f64)) {
        self.0.write_words(to);
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Narrow(T::read_words(next))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn look_up<const M: usize, const N: usize>(
        at: [Self; M],
        table: impl Fn([f64; M]) -> [f64; N],
    ) -> [Self; N] {
        let mut values = [T::default(); M];
        for (value, x) in values.iter_mut().zip(&at) {
            *value = x.0;
        }
        let mut found = [Self::default(); N];
        for (to, number) in found.iter_mut().zip(T::look_up(values, table)) {
            *to = Narrow(number);
        }
        found
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
        T::out_of_line(f)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Narrow(sin), Narrow(cos))
    }
    others! {
        lt(other) -> T::Mask;
        le(other) -> T::Mask;
        equals(other) -> T::Mask;
        finite() -> T::Mask;
        magnitude() -> f64;
        size() -> T::Size;
    }
    numbers! {
        fma(b, c); mul_absorbing(factor); derivative(); with_derivative(derivative); recip(); sqrt(); cbrt(); abs();
        sign(); floor(); round(); modulo(other); remainder(other); sin(); cos(); tan(); asin(); acos(); atan(); sinh();
        cosh(); tanh(); asinh(); acosh(); atanh(); exp(); exp_m1(); ln(); ln_1p(); erf(); erfc(); atan2(other);
        hypot(other); pow(exponent); min(other); max(other); universal_anomaly(b, c); orbit_remainder(c); stumpff_2();
        stumpff_3();
    }
}
