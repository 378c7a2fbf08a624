//! Numbers with a bound of their error: what a computation in `f64` says for certain.
//!
//! Input: numbers and operations. Output: [`Ball`]. Invariant: the exact value is within the error of the
//! value, whatever the platform: sums and products are those of IEEE 754, functions are our own with the bound
//! that their tests hold them to. Where nothing can be said the error is infinite; where the value itself does
//! not exist it is NaN.

use crate::dag::{Dag, Kind, Node, Partial, Relation};
use crate::list::IntoList;
use crate::op::Op;
use crate::rational::Rational;
use std::ops::{Add, Mul, Neg, Sub};

/// A number and a bound of its error.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ball {
    /// The value; NaN outside the expression's domain or on the edge of a condition.
    pub value: f64,
    /// The bound of its distance from the exact value.
    pub error: f64,
}

/// Half a unit in the last place of 1.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The error of our functions of numbers, in units in the last place; the tests of lanes hold them to 1.5.
const FUNCTION: f64 = 2.0;

/// Sums and products of multiples of 1/64, as whole numbers are, have no error up to this size.
const SHORT: f64 = 1e12;

/// An upper bound of an error that was computed in a few operations on numbers ≥ 0.
fn outward(error: f64) -> f64 {
    error * (1.0 + 64.0 * UNIT) + f64::MIN_POSITIVE
}

/// The larger of two errors; one that is no number is not bounded.
fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::INFINITY
    } else {
        a.max(b)
    }
}

impl Ball {
    /// A number as it is.
    #[must_use]
    pub fn exact(value: f64) -> Ball {
        Ball { value, error: 0.0 }
    }
    /// π
    #[must_use]
    pub fn pi() -> Ball {
        Ball {
            value: std::f64::consts::PI,
            error: outward(crate::PI_LOW),
        }
    }
    /// A value of which nothing is certain.
    fn unknown(value: f64) -> Ball {
        let error = f64::INFINITY;
        Ball { value, error }
    }

    /// Returns true if the exact value is certainly not 0.
    #[must_use]
    pub fn is_nonzero(self) -> bool {
        self.value.is_finite() && self.value.abs() > self.error
    }
    /// Returns true if the exact value certainly exists.
    #[must_use]
    pub fn is_defined(self) -> bool {
        self.value.is_finite() && self.error.is_finite()
    }
    /// Returns true if two exact values are certainly different.
    #[must_use]
    pub fn differs(self, other: Ball) -> bool {
        (self - other).is_nonzero()
    }
    /// Returns true if this is a multiple of 1/64 of moderate size, without an error.
    fn is_short(self) -> bool {
        self.error == 0.0 && (64.0 * self.value).fract() == 0.0
    }
    fn is_zero(self) -> bool {
        self.error == 0.0 && self.value == 0.0
    }

    /// A fraction of small numbers that the exact value may be.
    #[must_use]
    pub(crate) fn as_fraction(self) -> Option<Rational> {
        if !self.is_defined() || self.value.abs() > 64.0 {
            return None;
        }
        let is_near = |d: &f64| {
            let off = (self.value * d).round() - self.value * d;
            off.abs() <= d * self.error + 1e-12
        };
        let d = (1..=64_i32).map(f64::from).find(is_near)?;
        let n = (self.value * d).round() as i64;
        (n != 0).then(|| Rational::new(n, d as i64))
    }

    /// a + b + …
    pub(crate) fn sum(parts: impl Iterator<Item = Ball>) -> Ball {
        let (mut value, mut error, mut size, mut count) = (0.0, 0.0, 0.0, 0.0);
        let mut short = true;
        for part in parts {
            value += part.value;
            error += part.error;
            size += part.value.abs();
            count += 1.0;
            short &= part.is_short();
        }
        if count <= 1.0 || short && size < SHORT {
            return Ball { value, error };
        }
        // Each operation on n terms is off by at most a unit, and so are the sums of errors and sizes.
        let slack = 1.0 + 4.0 * count * UNIT;
        Ball {
            value,
            error: outward((error + count * UNIT * size) * slack),
        }
    }

    /// The power.
    #[must_use]
    pub fn powi(self, n: i32) -> Ball {
        let mut power = Ball::exact(1.0);
        let mut square = self;
        let mut left = n.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                power = power * square;
            }
            left >>= 1;
            if left > 0 {
                square = square * square;
            }
        }
        if n < 0 { power.recip() } else { power }
    }

    fn recip(self) -> Ball {
        let value = 1.0 / self.value;
        let least = self.value.abs() * (1.0 - 4.0 * UNIT) - self.error;
        if self.error == 0.0 && matches!(value.abs(), 0.25 | 0.5 | 1.0 | 2.0 | 4.0 | 8.0) {
            return Ball::exact(value);
        }
        if least.is_nan() || least <= 0.0 || !value.is_finite() {
            return Ball::unknown(value);
        }
        let moved = self.error / least * value.abs();
        Ball {
            value,
            error: outward(moved + UNIT * value.abs()),
        }
    }

    /// A function's value.
    #[must_use]
    pub fn call(op: Op, x: &[Ball]) -> Ball {
        match *x {
            [x] => x.through(op),
            [x, y] => x.through_two(op, y),
            ref x => {
                let values: Vec<f64> = x.iter().map(|x| x.value).into_list();
                Ball::unknown(op.eval(&values))
            }
        }
    }

    fn through(self, op: Op) -> Ball {
        let (x, e) = (self.value, self.error);
        let value = op.eval(&[x]);
        if !value.is_finite() || !e.is_finite() {
            return Ball::unknown(value);
        }
        if op == Op::Abs {
            return Ball { value, error: e };
        }
        if op == Op::Sign {
            return match x.abs() > e || self.is_zero() {
                true => Ball::exact(value),
                false => Ball::unknown(value),
            };
        }
        if matches!(op, Op::Floor | Op::Round) {
            let ends = [x - e, x + e].map(|end| op.eval(&[end]));
            return match ends == [value; 2] {
                true => Ball::exact(value),
                false => Ball::unknown(value),
            };
        }
        if self.is_zero() && op.row().at_zero.is_some() {
            return Ball::exact(value);
        }
        let own = |value: f64| FUNCTION * f64::EPSILON * value.abs() + f64::MIN_POSITIVE;
        if e == 0.0 {
            let error = outward(own(value));
            return Ball { value, error };
        }
        // The largest distance to the values at the ends of an interval on which the function is monotone.
        let over = |low: f64, high: f64| {
            let ends = [low.next_down(), high.next_up()].map(|x| op.eval(&[x]));
            let [a, b] = ends.map(|end| (end - value).abs() + own(end));
            largest(a, b)
        };
        let moved = match op {
            Op::Sin | Op::Cos => e.min(2.0),
            // tan(x + h) − tan x = tan h·(1 + tan²x)/(1 − tan x·tan h), and tan h ≤ 1.1·h up to 1/2.
            Op::Tan if e <= 0.5 => {
                let below = 1.0 - 1.25 * e * value.abs();
                if below > 0.0 {
                    1.25 * e * (1.0 + value * value) / below
                } else {
                    f64::INFINITY
                }
            }
            // The slopes are at most twice those at x.
            Op::Exp if e <= 0.5 => 2.0 * e * value,
            Op::Sinh | Op::Cosh if e <= 0.5 => 2.0 * e * (value.abs() + 1.0),
            // |√(x + h) − √x| ≤ |h|/√x
            Op::Sqrt if x > e => 1.25 * e / value,
            Op::Ln if x > 2.0 * e => 2.0 * e / x,
            Op::Cosh => over((x.abs() - e).max(0.0), x.abs() + e),
            Op::Sqrt
            | Op::Cbrt
            | Op::Asin
            | Op::Acos
            | Op::Atan
            | Op::Sinh
            | Op::Tanh
            | Op::Asinh
            | Op::Acosh
            | Op::Atanh
            | Op::Exp
            | Op::ExpM1
            | Op::Ln
            | Op::Ln1p
            | Op::Erf
            | Op::Erfc => over(x - e, x + e),
            _ => f64::INFINITY,
        };
        Ball {
            value,
            error: outward(moved + own(value)),
        }
    }

    fn through_two(self, op: Op, other: Ball) -> Ball {
        let (x, y) = (self, other);
        // Emitted code keeps a NaN of either.
        if x.value.is_nan() || y.value.is_nan() {
            return Ball::unknown(f64::NAN);
        }
        let value = op.eval(&[x.value, y.value]);
        let both = x.error + y.error;
        let own = FUNCTION * f64::EPSILON * value.abs() + f64::MIN_POSITIVE;
        let moved = match op {
            Op::Min | Op::Max => {
                if !x.differs(y) {
                    let error = x.error.max(y.error);
                    return Ball { value, error };
                }
                let first = (op == Op::Min) == (x.value <= y.value);
                return if first { x } else { y };
            }
            Op::Hypot => both,
            // Errors of the divisor count as often as it is taken away.
            Op::Modulo | Op::Remainder => {
                let n = ((x.value - value) / y.value).abs() + 1.0;
                let moved = outward(x.error + n * y.error);
                let edge = match op {
                    Op::Modulo => largest(-value, value - y.value.abs()),
                    _ => value.abs() - 0.5 * y.value.abs(),
                };
                match moved < -edge || x.is_zero() && y.is_nonzero() {
                    true => moved,
                    false => f64::INFINITY,
                }
            }
            // The gradient is 1/r, and the jump is where x ≤ 0 = y.
            Op::Atan2 if both > 0.0 => {
                let r = Op::Hypot.eval(&[x.value, y.value]) * (1.0 - 4.0 * f64::EPSILON) - both;
                let is_cut = y.value - y.error <= 0.0 && x.value.abs() <= x.error;
                if r > 0.0 && !is_cut {
                    both / r
                } else {
                    f64::INFINITY
                }
            }
            Op::Pow if both > 0.0 => {
                if y.error == 0.0 && y.value.fract() == 0.0 && y.value.abs() < 1024.0 {
                    return x.powi(y.value as i32);
                }
                // Monotone in either argument where x > 0.
                if x.value <= x.error {
                    f64::INFINITY
                } else {
                    let (low, high) = ((x.value - x.error).next_down(), x.value + x.error);
                    let mut most: f64 = 0.0;
                    for x in [low, high.next_up()] {
                        for y in [y.value - y.error, y.value + y.error] {
                            for y in [y.next_down(), y.next_up()] {
                                let corner = op.eval(&[x, y]);
                                let off =
                                    (corner - value).abs() + 2.0 * FUNCTION * f64::EPSILON * corner;
                                most = largest(most, off);
                            }
                        }
                    }
                    if low > 0.0 { most } else { f64::INFINITY }
                }
            }
            _ => 0.0,
        };
        Ball {
            value,
            error: outward(moved + own),
        }
    }

    /// The value of a node that is no leaf, from the values of its children; `None` for leaves and loops.
    pub(crate) fn of(dag: &Dag, node: Node, child: &dyn Fn(Node) -> Ball) -> Option<Ball> {
        let truth = |flag: bool| Ball::exact(f64::from(u8::from(flag)));
        Some(match dag.kind(node) {
            Kind::Constant(value) => Ball::from(value),
            Kind::Pi => Ball::pi(),
            Kind::Sum(c, terms) => {
                let parts = terms.iter().map(|(k, n)| {
                    if k.is_one() {
                        child(*n)
                    } else {
                        Ball::from(k) * child(*n)
                    }
                });
                let constant = (!c.is_zero()).then(|| Ball::from(c));
                Ball::sum(constant.into_iter().chain(parts))
            }
            Kind::Product(k, factors) => {
                factors.iter().fold(Ball::from(k), |value, &(n, exponent)| {
                    let factor = if exponent == 1 {
                        child(n)
                    } else {
                        child(n).powi(exponent)
                    };
                    value * factor
                })
            }
            Kind::Call(op, x) => {
                let x: Vec<Ball> = x.iter().map(|x| child(*x)).into_list();
                Ball::call(*op, &x)
            }
            Kind::External(function, part, arguments) => {
                // Any smooth function will do: sin(w·x + 1), with its own derivatives.
                let weight = |i: usize| 0.625 + 0.25 * i as f64 + 0.375 * f64::from(*function);
                let weighted = arguments.iter().enumerate();
                let weighted = weighted.map(|(i, x)| Ball::exact(weight(i)) * child(*x));
                let angle = Ball::sum(std::iter::once(Ball::exact(1.0)).chain(weighted));
                let scaled = |factor: f64, op: Op| Ball::exact(factor) * angle.through(op);
                match part {
                    Partial::Value => scaled(1.0, Op::Sin),
                    Partial::First(i) => scaled(weight(usize::from(*i)), Op::Cos),
                    Partial::Second(i, j) => {
                        let [a, b] = [i, j].map(|i| Ball::exact(weight(usize::from(*i))));
                        -(a * b) * scaled(1.0, Op::Sin)
                    }
                    // Its arguments are not known: points do not refute what has it.
                    Partial::Higher { .. } => Ball::exact(f64::NAN),
                }
            }
            Kind::Compare(relation, a, b) => {
                let (a, b) = (child(*a), child(*b));
                // `q[i] <= q[j]` has no difference at i = j.
                let is_same = a == b && a.error == 0.0;
                if !(a.differs(b) || is_same) {
                    return Some(Ball::exact(f64::NAN));
                }
                truth(match relation {
                    Relation::Less => a.value < b.value,
                    Relation::LessEqual => a.value <= b.value,
                    Relation::Equal => a.value == b.value,
                })
            }
            Kind::Not(a) => Ball::exact(1.0 - child(*a).value),
            Kind::And(a, b) => Ball::exact(child(*a).value * child(*b).value),
            Kind::Or(a, b) => {
                let (a, b) = (child(*a).value, child(*b).value);
                Ball::exact(a + b - a * b)
            }
            Kind::Select(c, yes, no) => match child(*c).value {
                c if c.is_nan() => Ball::exact(f64::NAN),
                c => child(if c == 1.0 { *yes } else { *no }),
            },
            _ => return None,
        })
    }
}

impl From<&Rational> for Ball {
    fn from(value: &Rational) -> Ball {
        const WHOLE: u64 = 1 << 53;
        if let Some((n, d)) = value.to_small()
            && n.unsigned_abs() <= WHOLE
            && d.unsigned_abs() <= WHOLE
        {
            // Both are doubles, and their quotient is rounded once.
            let value = n as f64 / d as f64;
            let is_exact = d.unsigned_abs().is_power_of_two();
            let error = if is_exact {
                0.0
            } else {
                outward(UNIT * value.abs())
            };
            return Ball { value, error };
        }
        let (hi, lo) = value.to_words();
        let is_exact = lo == 0.0 && (hi == 0.0 || hi.abs() > 1e-280);
        Ball {
            value: hi,
            error: if is_exact { 0.0 } else { outward(lo.abs()) },
        }
    }
}

impl Add for Ball {
    type Output = Ball;
    fn add(self, other: Ball) -> Ball {
        Ball::sum([self, other].into_iter())
    }
}

impl Sub for Ball {
    type Output = Ball;
    fn sub(self, other: Ball) -> Ball {
        self + -other
    }
}

impl Neg for Ball {
    type Output = Ball;
    fn neg(self) -> Ball {
        Ball {
            value: -self.value,
            ..self
        }
    }
}

impl Mul for Ball {
    type Output = Ball;
    fn mul(self, other: Ball) -> Ball {
        let (a, b) = (self, other);
        let value = a.value * b.value;
        let is_unit = |one: Ball, other: Ball| {
            one.error == 0.0 && one.value.abs() == 1.0 && !other.value.is_nan()
        };
        if a.is_short() && b.is_short() && value.abs() < SHORT
            || is_unit(a, b) && b.error == 0.0
            || is_unit(b, a) && a.error == 0.0
        {
            return Ball::exact(value);
        }
        // 0·∞ of an unknown factor is unknown.
        if (a.is_zero() || b.is_zero()) && a.is_defined() && b.is_defined() {
            return Ball::exact(value);
        }
        Ball {
            value,
            error: outward(
                a.value.abs() * b.error
                    + b.value.abs() * a.error
                    + a.error * b.error
                    + UNIT * value.abs(),
            ),
        }
    }
}
