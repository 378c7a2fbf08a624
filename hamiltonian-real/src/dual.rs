//! Dual numbers: a value and one directional derivative, by the rules of calculus.
//!
//! Input: `re + eps·ε` with ε² = 0 over any [`Real`]. Output: every operation's value and its
//! exact derivative (no step size); `Dual<Dual<T>>` gives second derivatives. Invariant: values
//! are those of `T` alone, comparisons go by value, and a derivative part that is exactly 0
//! (a constant) stays 0 whatever infinity the rule has there.

use core::f64::consts::FRAC_2_SQRT_PI;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::real::{Mask, Pack, Parameter, Real, kepler};

/// The largest number of lanes of a pack over which dual numbers are gathered.
const MAX_LANES: usize = 128;
/// As many take less memory.
const FEW: usize = 8;

/// `re + eps·ε` with ε² = 0: a value and its derivative along one direction, so that
/// `f(x + ε) = f(x) + f′(x)·ε` for every function built from [`Real`]'s operations (W. K. Clifford,
/// *Proc. London Math. Soc.* s1-4, 381, 1871; R. E. Wengert, *Commun. ACM* 7, 463, 1964,
/// doi:10.1145/355586.364791).
///
/// Nested, `Dual<Dual<T>>` carries two directions and the mixed second derivative in `eps.eps`.
///
/// # Conventions where a derivative does not exist
/// - `abs′ = sign`, so 0 at 0; `sign′ = floor′ = round′ = 0` everywhere.
/// - `x.modulo(y)` and `x.remainder(y)` are x − n·y: their derivatives are 1 and −n, at jumps too.
/// - `sqrt′(0) = cbrt′(0) = +∞`, `asin′(±1) = +∞`, `acos′(±1) = −∞`, `acosh′(1) = +∞`,
///   `atanh′(±1) = ln′(0) = ln_1p′(−1) = +∞`.
/// - `hypot` and `atan2` have no derivative at the origin: NaN.
/// - `x^y`: ∂/∂x is `y·x^(y−1)`, and 0 where `y = 0`; ∂/∂y is `x^y·ln x`, left out altogether
///   where the exponent's derivative part is 0 (so integer powers of negative bases have
///   derivatives), and 0 at `x = 0 < y`.
/// - `min`, `max`: the derivative of the returned operand; of the first if they are equal.
/// - Outside the domain the value is NaN; the derivative part is the formula's value.
///
/// In each case an operand whose derivative part is exactly 0 contributes exactly 0.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// let x = Dual::variable(3.0);
/// let y = x * x + x.sqrt();
/// assert_eq!(y.re, 9.0 + 3f64.sqrt());
/// assert_eq!(y.eps, 6.0 + 0.5 / 3f64.sqrt());
///
/// // d²(x³)/dx² = 6x
/// let x = Dual::new(Dual::variable(2.0), Dual::fixed(1.0));
/// assert_eq!((x * x * x).eps.eps, 12.0);
///
/// // The root of a constant 0 has the derivative 0, the root of a variable an infinite one.
/// assert_eq!(Dual::fixed(0.0).sqrt().eps, 0.0);
/// assert_eq!(Dual::variable(0.0).sqrt().eps, f64::INFINITY);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dual<T> {
    /// The value.
    pub re: T,
    /// The derivative along the direction of the variables.
    pub eps: T,
}

impl<T: Real> Dual<T> {
    /// `re + eps·ε`.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let x = Dual::new(1.0, 2.0);
    /// assert_eq!((x.re, x.eps), (1.0, 2.0));
    /// ```
    #[inline(always)]
    pub fn new(re: T, eps: T) -> Self {
        Self { re, eps }
    }

    /// The variable to differentiate by: `re + 1·ε`.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(Dual::variable(0.0).sin().eps, 1.0);
    /// ```
    #[inline(always)]
    pub fn variable(re: T) -> Self {
        Self { re, eps: T::one() }
    }

    /// A number that does not vary: `re + 0·ε`.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// assert_eq!(Dual::fixed(1.0).exp().eps, 0.0);
    /// ```
    #[inline(always)]
    pub fn fixed(re: T) -> Self {
        Self { re, eps: T::zero() }
    }

    /// The value `re` of a function whose derivative at the argument `self` is `slope`.
    #[inline(always)]
    fn chain(self, re: T, slope: T) -> Self {
        Self {
            re,
            eps: slope.mul_absorbing(self.eps),
        }
    }

    /// The value `re = self − n·other` for a whole number n, with its derivative.
    #[inline(always)]
    fn less_multiples(self, re: T, other: Self) -> Self {
        let n = ((self.re - re) / other.re).round();
        Self {
            re,
            eps: self.eps - n.mul_absorbing(other.eps),
        }
    }
}

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            eps: self.eps + other.eps,
        }
    }
}

impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            re: self.re - other.re,
            eps: self.eps - other.eps,
        }
    }
}

impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re,
            eps: self.re.fma(other.eps, self.eps * other.re),
        }
    }
}

impl<T: Real> Div for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let re = self.re / other.re;
        Self {
            re,
            eps: (self.eps - re * other.eps) / other.re,
        }
    }
}

impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            re: -self.re,
            eps: -self.eps,
        }
    }
}

impl<T: Real> AddAssign for Dual<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real> SubAssign for Dual<T> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<T: Real> MulAssign for Dual<T> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<T: Real> DivAssign for Dual<T> {
    #[inline(always)]
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}

/// [`Real::gather`] of at most `N` dual numbers.
#[inline(always)]
fn gathered<T: Real, P: Pack, const N: usize>(values: &[Dual<T>]) -> Dual<T::Over<P>> {
    let (mut re, mut eps) = ([T::default(); N], [T::default(); N]);
    let n = values.len().min(N);
    for k in 0..n {
        (re[k], eps[k]) = (values[k].re, values[k].eps);
    }
    Dual {
        re: T::gather::<P>(&re[..n]),
        eps: T::gather::<P>(&eps[..n]),
    }
}

/// [`Real::scatter`] to at most `N` dual numbers.
#[inline(always)]
fn scattered<T: Real, P: Pack, const N: usize>(from: Dual<T::Over<P>>, into: &mut [Dual<T>]) {
    let (mut re, mut eps) = ([T::default(); N], [T::default(); N]);
    let n = into.len().min(N);
    T::scatter::<P>(from.re, &mut re[..n]);
    T::scatter::<P>(from.eps, &mut eps[..n]);
    for k in 0..n {
        into[k] = Dual::new(re[k], eps[k]);
    }
}

impl<A: Parameter> Parameter for Dual<A> {
    const DUALS: u32 = A::DUALS + 1;
    #[inline(always)]
    fn into_real<T: Real>(self) -> T {
        T::from_dual(self.re, self.eps)
    }
}

impl<T: Real> Real for Dual<T> {
    type Mask = T::Mask;
    type Size = T::Size;
    const LANES: u32 = T::LANES;

    type Over<P: Pack> = Dual<T::Over<P>>;
    const WIDENS: bool = T::WIDENS;
    #[inline(always)]
    fn gather<P: Pack>(values: &[Self]) -> Dual<T::Over<P>> {
        const { assert!(P::LANES as usize <= MAX_LANES) }
        match values.len() <= FEW {
            true => gathered::<T, P, FEW>(values),
            false => gathered::<T, P, MAX_LANES>(values),
        }
    }
    #[inline(always)]
    fn scatter<P: Pack>(from: Dual<T::Over<P>>, into: &mut [Self]) {
        match into.len() <= FEW {
            true => scattered::<T, P, FEW>(from, into),
            false => scattered::<T, P, MAX_LANES>(from, into),
        }
    }
    #[inline(always)]
    fn spread<P: Pack>(self) -> Dual<T::Over<P>> {
        Dual {
            re: self.re.spread::<P>(),
            eps: self.eps.spread::<P>(),
        }
    }

    const DUALS: u32 = T::DUALS + 1;
    #[inline(always)]
    fn from_dual<A: Parameter>(value: A, derivative: A) -> Self {
        // The innermost numbers keep the derivatives of parameters, so that the outer ones are free for those by
        // coordinates.
        match const { T::DUALS > A::DUALS } {
            true => Self::fixed(T::from_dual(value, derivative)),
            false => Self::new(value.into_real(), derivative.into_real()),
        }
    }

    #[inline(always)]
    fn constant(hi: f64, lo: f64) -> Self {
        Self::fixed(T::constant(hi, lo))
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        Self {
            re: self.re.fma(b.re, c.re),
            eps: self.re.fma(b.eps, self.eps.fma(b.re, c.eps)),
        }
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self {
            re: T::select(mask, yes.re, no.re),
            eps: T::select(mask, yes.eps, no.eps),
        }
    }
    #[inline(always)]
    fn replaced(mask: Self::Mask, new: Self, old: Self) -> Self {
        Self {
            re: T::replaced(mask, new.re, old.re),
            eps: T::replaced(mask, new.eps, old.eps),
        }
    }
    #[inline(always)]
    fn mul_absorbing(self, factor: Self) -> Self {
        Self {
            re: self.re.mul_absorbing(factor.re),
            eps: self.re.mul_absorbing(factor.eps) + self.eps.mul_absorbing(factor.re),
        }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        self.re.lt(other.re)
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        self.re.le(other.re)
    }
    #[inline(always)]
    fn equals(self, other: Self) -> Self::Mask {
        self.re.equals(other.re)
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        let (re, eps) = (self.re.magnitude(), self.eps.magnitude());
        // `!(re < eps)` keeps a NaN in `re`; a NaN in `eps` is tested.
        if re < eps || eps.is_nan() { eps } else { re }
    }
    #[inline(always)]
    fn size(self) -> T::Size {
        self.re.size() + self.eps.size()
    }
    #[inline(always)]
    fn finite(self) -> Self::Mask {
        self.re.finite() & self.eps.finite()
    }
    fn write_words(self, to: &mut dyn FnMut(f64)) {
        self.re.write_words(to);
        self.eps.write_words(to);
    }
    #[inline(always)]
    fn look_up<const M: usize, const N: usize>(
        at: [Self; M],
        table: impl Fn([f64; M]) -> [f64; N],
    ) -> [Self; N] {
        let mut values = [T::default(); M];
        for (value, x) in values.iter_mut().zip(&at) {
            *value = x.re;
        }
        let numbers = T::look_up(values, table);
        let mut found = [Self::default(); N];
        for (to, number) in found.iter_mut().zip(numbers) {
            *to = Self::fixed(number);
        }
        found
    }
    #[inline(always)]
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
        T::out_of_line(f)
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Self {
            re: T::read_words(next),
            eps: T::read_words(next),
        }
    }
    #[inline(always)]
    fn lane(self, k: u32) -> f64 {
        self.re.lane(k)
    }
    #[inline(always)]
    fn derivative(self) -> Self {
        Self::fixed(self.eps)
    }
    #[inline(always)]
    fn with_derivative(self, derivative: Self) -> Self {
        Self {
            re: self.re,
            eps: derivative.re,
        }
    }
    #[inline(always)]
    fn epsilon() -> f64 {
        T::epsilon()
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.re.sqrt();
        // √(−0) = −0; adding 0 makes its slope +∞ as at +0.
        self.chain(root, T::constant(0.5, 0.0) / (root + T::zero()))
    }
    #[inline(always)]
    fn cbrt(self) -> Self {
        let root = self.re.cbrt();
        self.chain(root, (T::constant(3.0, 0.0) * root * root).recip())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.chain(self.re.abs(), self.re.sign())
    }
    #[inline(always)]
    fn sign(self) -> Self {
        Self::fixed(self.re.sign())
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self::fixed(self.re.floor())
    }
    #[inline(always)]
    fn round(self) -> Self {
        Self::fixed(self.re.round())
    }
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    #[inline(always)]
    fn tan(self) -> Self {
        let tan = self.re.tan();
        self.chain(tan, tan.fma(tan, T::one()))
    }
    #[inline(always)]
    fn asin(self) -> Self {
        self.chain(self.re.asin(), cosine_of_asin(self.re).recip())
    }
    #[inline(always)]
    fn acos(self) -> Self {
        self.chain(self.re.acos(), -cosine_of_asin(self.re).recip())
    }
    #[inline(always)]
    fn atan(self) -> Self {
        self.chain(self.re.atan(), self.re.fma(self.re, T::one()).recip())
    }
    #[inline(always)]
    fn sinh(self) -> Self {
        self.chain(self.re.sinh(), self.re.cosh())
    }
    #[inline(always)]
    fn cosh(self) -> Self {
        self.chain(self.re.cosh(), self.re.sinh())
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        // 1/cosh² as 4u/(1 + u)² with u = exp(−2|x|): 1 − tanh² cancels, cosh² overflows. The sign
        // is taken by `select`, not `abs`, so that higher derivatives at 0 are those of u.
        let down = T::select(self.re.lt(T::zero()), self.re, -self.re);
        let u = (down + down).exp();
        let sum = T::one() + u;
        self.chain(self.re.tanh(), T::constant(4.0, 0.0) * u / (sum * sum))
    }
    #[inline(always)]
    fn asinh(self) -> Self {
        self.chain(self.re.asinh(), T::one().hypot(self.re).recip())
    }
    #[inline(always)]
    fn acosh(self) -> Self {
        let x = self.re;
        let root = (x - T::one()).sqrt() * (x + T::one()).sqrt();
        self.chain(x.acosh(), root.recip())
    }
    #[inline(always)]
    fn atanh(self) -> Self {
        let x = self.re;
        self.chain(x.atanh(), ((T::one() - x) * (T::one() + x)).recip())
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let exp = self.re.exp();
        self.chain(exp, exp)
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        self.chain(self.re.exp_m1(), self.re.exp())
    }
    #[inline(always)]
    fn ln(self) -> Self {
        // Adding 0 makes the slope at −0 that at +0: +∞.
        self.chain(self.re.ln(), (self.re + T::zero()).recip())
    }
    #[inline(always)]
    fn ln_1p(self) -> Self {
        self.chain(self.re.ln_1p(), (T::one() + self.re).recip())
    }
    #[inline(always)]
    fn erf(self) -> Self {
        self.chain(self.re.erf(), bell(self.re))
    }
    #[inline(always)]
    fn erfc(self) -> Self {
        self.chain(self.re.erfc(), -bell(self.re))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.re.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline(always)]
    fn atan2(self, other: Self) -> Self {
        let (y, x) = (self.re, other.re);
        let radius = x.hypot(y);
        // Divided twice: the square of the radius would overflow.
        let (along_y, along_x) = (x / radius / radius, y / radius / radius);
        Self {
            re: y.atan2(x),
            eps: along_y.mul_absorbing(self.eps) - along_x.mul_absorbing(other.eps),
        }
    }
    #[inline(always)]
    fn hypot(self, other: Self) -> Self {
        let re = self.re.hypot(other.re);
        Self {
            re,
            eps: (self.re / re).mul_absorbing(self.eps) + (other.re / re).mul_absorbing(other.eps),
        }
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        let (x, y) = (self.re, exponent.re);
        let re = x.pow(y);
        let by_base = x.pow(y - T::one()).mul_absorbing(y).mul_absorbing(self.eps);
        let constant = exponent.eps.size().equals(T::Size::zero());
        if constant.all() {
            return Self { re, eps: by_base };
        }
        // x^y·ln x → 0 as x → 0 from above, for y > 0.
        let vanishes = x.equals(T::zero()) & T::zero().lt(y);
        let slope = T::select(vanishes, T::zero(), re * x.ln());
        Self {
            re,
            eps: T::select(
                constant,
                by_base,
                by_base + slope.mul_absorbing(exponent.eps),
            ),
        }
    }
    #[inline(always)]
    fn modulo(self, other: Self) -> Self {
        let re = self.re.modulo(other.re);
        self.less_multiples(re, other)
    }
    #[inline(always)]
    fn remainder(self, other: Self) -> Self {
        let re = self.re.remainder(other.re);
        self.less_multiples(re, other)
    }
    #[inline(always)]
    fn orbit_remainder(self, c: Self) -> Self {
        // 1 − n/turns, where the whole number n is constant.
        let re = self.re.orbit_remainder(c.re);
        let off = T::one() - re;
        let growth = T::constant(1.5, 0.0) * c.eps / c.re - self.eps / self.re;
        Self {
            re,
            eps: T::select(off.equals(T::zero()), T::zero(), off * growth),
        }
    }
    #[inline(always)]
    fn universal_anomaly(self, b: Self, c: Self) -> Self {
        // The derivative of the equation: 0 = F′·dy + ∂F.
        let y = self.re.universal_anomaly(b.re, c.re);
        let (f, slope, _) = kepler::equation(self, b, c, Self::fixed(y));
        Self {
            re: y,
            eps: -f.eps / slope.re,
        }
    }
}

/// `√(1 − x²)`, without cancellation near ±1.
#[inline(always)]
fn cosine_of_asin<T: Real>(x: T) -> T {
    ((T::one() - x) * (T::one() + x)).sqrt()
}

/// `2/√π·exp(−x²)`, the derivative of the error function.
#[inline(always)]
fn bell<T: Real>(x: T) -> T {
    T::constant(FRAC_2_SQRT_PI, FRAC_2_SQRT_PI_LOW) * (-(x * x)).exp()
}

/// 2/√π minus its rounded value.
const FRAC_2_SQRT_PI_LOW: f64 = 1.533545961316588e-17;
