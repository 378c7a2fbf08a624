//! The trait carries packs of lanes: a pack written here gives, lane by lane, the bits of `f64`,
//! alone and inside dual numbers.

use core::array;
use core::ops::{
    Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign,
};

use hamiltonian_lanes::{Dual, Mask, Real};

const LANES: usize = 4;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Pack([f64; LANES]);

#[derive(Clone, Copy, Debug)]
struct Flags([bool; LANES]);

impl Pack {
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(array::from_fn(|i| f(self.0[i], other.0[i])))
    }
    fn compare(self, other: Self, f: impl Fn(f64, f64) -> bool) -> Flags {
        Flags(array::from_fn(|i| f(self.0[i], other.0[i])))
    }
}

impl BitAnd for Flags {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(array::from_fn(|i| self.0[i] & other.0[i]))
    }
}

impl BitOr for Flags {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(array::from_fn(|i| self.0[i] | other.0[i]))
    }
}

impl Not for Flags {
    type Output = Self;
    fn not(self) -> Self {
        Self(self.0.map(|flag| !flag))
    }
}

impl Mask for Flags {
    fn splat(flag: bool) -> Self {
        Self([flag; LANES])
    }
    fn all(self) -> bool {
        self.0.into_iter().all(|flag| flag)
    }
    fn any(self) -> bool {
        self.0.into_iter().any(|flag| flag)
    }
    fn lane(self, k: u32) -> bool {
        self.0.get(k as usize).copied().unwrap_or(false)
    }
    fn first(self) -> Option<u32> {
        (0..LANES as u32).find(|&k| self.lane(k))
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $assign_method:ident;)*) => {
        $(
            impl $operator for Pack {
                type Output = Self;
                fn $method(self, other: Self) -> Self {
                    self.zip(other, |a, b| a.$method(b))
                }
            }
            impl $assign for Pack {
                fn $assign_method(&mut self, other: Self) {
                    *self = self.$method(other);
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

impl Neg for Pack {
    type Output = Self;
    fn neg(self) -> Self {
        self.each(Neg::neg)
    }
}

macro_rules! by_lane {
    ($($name:ident)*) => {
        $(
            fn $name(self) -> Self {
                self.each(Real::$name)
            }
        )*
    };
}

impl Real for Pack {
    type Mask = Flags;
    type Size = Self;
    const LANES: u32 = LANES as u32;
    hamiltonian_lanes::itself_in_lanes! {}

    fn constant(hi: f64, lo: f64) -> Self {
        Self([f64::constant(hi, lo); LANES])
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Self([(); LANES].map(|()| next()))
    }
    fn fma(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    fn select(mask: Flags, yes: Self, no: Self) -> Self {
        Self(array::from_fn(
            |i| if mask.0[i] { yes.0[i] } else { no.0[i] },
        ))
    }
    fn lt(self, other: Self) -> Flags {
        self.compare(other, |a, b| a < b)
    }
    fn le(self, other: Self) -> Flags {
        self.compare(other, |a, b| a <= b)
    }
    fn equals(self, other: Self) -> Flags {
        self.compare(other, |a, b| a == b)
    }
    fn magnitude(self) -> f64 {
        self.0.into_iter().map(f64::abs).fold(0.0, Real::max)
    }
    fn size(self) -> Self {
        self.each(f64::abs)
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
    fn sin_cos(self) -> (Self, Self) {
        (self.each(Real::sin), self.each(Real::cos))
    }
    fn atan2(self, other: Self) -> Self {
        self.zip(other, Real::atan2)
    }
    fn hypot(self, other: Self) -> Self {
        self.zip(other, Real::hypot)
    }
    fn pow(self, exponent: Self) -> Self {
        self.zip(exponent, Real::pow)
    }
    fn modulo(self, other: Self) -> Self {
        self.zip(other, Real::modulo)
    }
    fn remainder(self, other: Self) -> Self {
        self.zip(other, Real::remainder)
    }
    by_lane!(sqrt cbrt abs sign sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh
        exp exp_m1 ln ln_1p erf erfc floor round);
}

/// Everything that decides lane by lane, in one value each.
fn decisions<T: Real>(x: T, y: T) -> Vec<T> {
    vec![
        x.min(y),
        x.max(y),
        x.pow(y),
        x.hypot(y),
        x.atan2(y),
        x.modulo(y) - x.remainder(y),
        x.floor() + x.round(),
        x.sqrt(),
        x.tanh(),
        x.abs() * x.sign(),
        x.ln().mul_absorbing(y),
        T::select(x.lt(y) & !y.equals(T::zero()), x.sin(), y.exp()),
        x.sin_cos().0 + x.asinh() / x.acosh(),
    ]
}

fn bits(x: f64) -> u64 {
    // All NaN are one.
    if x.is_nan() {
        f64::NAN.to_bits()
    } else {
        x.to_bits()
    }
}

const X: [f64; LANES] = [0.0, -2.0, 3.0, f64::NAN];
const Y: [f64; LANES] = [0.0, 3.0, 3.0, 1.0];

#[test]
fn lanes_have_the_bits_of_scalars() {
    let packed = decisions(Pack(X), Pack(Y));
    for lane in 0..LANES {
        let alone = decisions(X[lane], Y[lane]);
        for (packed, alone) in packed.iter().zip(&alone) {
            assert_eq!(bits(packed.0[lane]), bits(*alone));
        }
    }
}

#[test]
fn lanes_of_duals_have_the_bits_of_dual_scalars() {
    // Directions that vanish in some lanes only.
    for (dx, dy) in [
        ([1.0, 0.0, 1.0, 1.0], [0.0; LANES]),
        ([0.0; LANES], [1.0, 0.0, 2.0, 1.0]),
    ] {
        let packed = decisions(Dual::new(Pack(X), Pack(dx)), Dual::new(Pack(Y), Pack(dy)));
        for lane in 0..LANES {
            let alone = decisions(Dual::new(X[lane], dx[lane]), Dual::new(Y[lane], dy[lane]));
            for (packed, alone) in packed.iter().zip(&alone) {
                assert_eq!(bits(packed.re.0[lane]), bits(alone.re));
                assert_eq!(bits(packed.eps.0[lane]), bits(alone.eps));
            }
        }
    }
}

#[test]
fn masks_of_packs_and_sizes() {
    let mask = Pack(X).lt(Pack(Y));
    assert!(mask.any() && !mask.all());
    assert!((Flags::splat(true) & !Flags::splat(false)).all());
    assert!((Flags::splat(false) | mask).any());
    assert!(Pack(X).magnitude().is_nan() && !Pack(X).is_finite());
    assert_eq!(
        Dual::new(Pack(Y), Pack([0.0, -5.0, 1.0, 0.0])).magnitude(),
        5.0
    );
    assert_eq!(Dual::<Pack>::lift(2.0).re, Pack([2.0; LANES]));
}

#[test]
fn lanes_are_told_apart() {
    // Lane 3 of X is NaN.
    let finite = Pack(X).finite();
    assert!(finite.lane(2) && !finite.lane(3) && !finite.lane(4));
    assert_eq!((!finite).first(), Some(3));
    assert_eq!(Flags::splat(false).first(), None);
    assert_eq!(Pack(X).lane(1), -2.0);
    assert!(Pack(X).lane(4).is_nan());
    assert_eq!(<Dual<Pack> as Real>::LANES, 4);
    // Sizes: |value| + |derivative part|, and NaN in its own lane only.
    let size = Dual::new(Pack(X), Pack(Y)).size();
    assert_eq!(size.0[..3], [0.0, 5.0, 6.0]);
    assert_eq!((!size.finite()).first(), Some(3));
    let bad = Dual::new(Pack(Y), Pack([0.0, f64::INFINITY, 0.0, f64::NAN]));
    assert_eq!((!bad.finite()).first(), Some(1));
    assert!(!bad.is_finite() && Dual::new(Pack(Y), Pack(Y)).is_finite());
}

#[test]
fn an_anomaly_does_not_see_its_neighbours() {
    // A circle, a comet, a hyperbola, and what has no solution; then a parabola and repulsion.
    let a = Pack([0.0, -3.0, 0.5, f64::NAN]);
    let b = Pack([0.04, 30.0, 0.1, 1.0]);
    let c = Pack([0.04, 25.0, -7.0, 1.0]);
    for turn in 0..LANES {
        let turned = |x: Pack| Pack(array::from_fn(|i| x.0[(i + turn) % LANES]));
        let (a, b, c) = (turned(a), turned(b), turned(c));
        let found = a.universal_anomaly(b, c);
        let slope =
            Dual::new(a, Pack([1.0; LANES])).universal_anomaly(Dual::fixed(b), Dual::fixed(c));
        for i in 0..LANES {
            let alone = a.0[i].universal_anomaly(b.0[i], c.0[i]);
            assert_eq!(found.0[i].to_bits(), alone.to_bits());
            assert_eq!(slope.re.0[i].to_bits(), alone.to_bits());
            let dual = Dual::variable(a.0[i]);
            let dual = dual.universal_anomaly(Dual::fixed(b.0[i]), Dual::fixed(c.0[i]));
            assert_eq!(slope.eps.0[i].to_bits(), dual.eps.to_bits());
            assert_eq!(alone.is_nan(), a.0[i].is_nan());
            let part = (Pack([900.0; LANES]) * b).orbit_remainder(Pack([900.0; LANES]) * c);
            let (b, c) = (900.0 * b.0[i], 900.0 * c.0[i]);
            assert_eq!(part.0[i].to_bits(), b.orbit_remainder(c).to_bits());
        }
    }
}
