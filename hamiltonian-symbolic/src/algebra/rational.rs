//! Exact rational numbers of any size, small ones without heap memory.
//!
//! Input: decimal literals, integers. Output: [`Rational`], rounded once to two `f64` words by
//! [`Rational::to_words`]. Invariant: in lowest terms, denominator positive, and `Small` whenever
//! numerator and denominator fit `i64`.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive};
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};

/// Numbers of more bits than this are not multiplied out: their greatest common divisor alone takes
/// a time that grows with the square.
pub const LONGEST: u64 = 1 << 14;

/// An exact rational number, ordered by value.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Rational(Repr);

#[derive(Clone, Debug)]
enum Repr {
    Small(i64, i64),
    Big(Box<BigRational>),
}

/// In lowest terms equal values have equal parts; `BigRational` compares and hashes as continued
/// fractions, which recurses.
impl PartialEq for Repr {
    fn eq(&self, other: &Repr) -> bool {
        match (self, other) {
            (Repr::Small(a, b), Repr::Small(c, d)) => (a, b) == (c, d),
            (Repr::Big(a), Repr::Big(b)) => a.numer() == b.numer() && a.denom() == b.denom(),
            _ => false,
        }
    }
}

impl Eq for Repr {}

impl Hash for Repr {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Repr::Small(n, d) => (n, d).hash(state),
            Repr::Big(value) => (value.numer(), value.denom()).hash(state),
        }
    }
}

impl Rational {
    /// 0.
    pub const ZERO: Rational = Rational(Repr::Small(0, 1));
    /// 1.
    pub const ONE: Rational = Rational(Repr::Small(1, 1));
    /// −1.
    pub const MINUS_ONE: Rational = Rational(Repr::Small(-1, 1));

    /// An integer.
    #[must_use]
    pub fn integer(value: i64) -> Rational {
        if value == i64::MIN {
            return Rational::from_big(BigRational::from_integer(value.into()));
        }
        Rational(Repr::Small(value, 1))
    }

    /// `numerator/denominator`; the denominator must not be 0.
    #[must_use]
    pub fn new(numerator: i64, denominator: i64) -> Rational {
        Rational::reduce(i128::from(numerator), i128::from(denominator))
    }

    /// The number of a text such as `1`, `0.1`, `1.`, `1e-3`; `None` for anything else.
    #[must_use]
    pub fn decimal(text: &str) -> Option<Rational> {
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let is_written = !whole.is_empty() && exponent.len() <= 18;
        let exponent = exponent.parse::<i64>().ok()? - i64::try_from(fraction.len()).ok()?;
        let digits = format!("{whole}{fraction}");
        if !is_written || !digits.bytes().all(|digit| digit.is_ascii_digit()) {
            return None;
        }
        let mantissa = BigInt::parse_bytes(digits.as_bytes(), 10)?;
        let power = BigInt::from(10).pow(u32::try_from(exponent.unsigned_abs()).ok()?);
        Some(Rational::from_big(if exponent >= 0 {
            BigRational::from_integer(mantissa * power)
        } else {
            BigRational::new(mantissa, power)
        }))
    }

    fn reduce(mut n: i128, mut d: i128) -> Rational {
        assert!(d != 0);
        if d != 1 {
            let g = gcd(n.unsigned_abs(), d.unsigned_abs());
            if g > 1 {
                // g divides d, which came from products of i64 values, so it fits.
                n /= g as i128;
                d /= g as i128;
            }
            if d < 0 {
                n = -n;
                d = -d;
            }
        }
        match (i64::try_from(n), i64::try_from(d)) {
            (Ok(n), Ok(d)) if n != i64::MIN => Rational(Repr::Small(n, d)),
            _ => Rational(Repr::Big(Box::new(BigRational::new_raw(
                n.into(),
                d.into(),
            )))),
        }
    }

    fn from_big(value: BigRational) -> Rational {
        match (value.numer().to_i64(), value.denom().to_i64()) {
            (Some(n), Some(d)) if n != i64::MIN => Rational(Repr::Small(n, d)),
            _ => Rational(Repr::Big(Box::new(value))),
        }
    }

    fn big(&self) -> BigRational {
        match &self.0 {
            Repr::Small(n, d) => BigRational::new_raw((*n).into(), (*d).into()),
            Repr::Big(value) => (**value).clone(),
        }
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Repr::Small(a, 1), Repr::Small(b, 1)) => {
                Rational::reduce(i128::from(*a) + i128::from(*b), 1)
            }
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                let (a, b, c, d) = (
                    i128::from(*a),
                    i128::from(*b),
                    i128::from(*c),
                    i128::from(*d),
                );
                match (a * d).checked_add(c * b) {
                    Some(n) => Rational::reduce(n, b * d),
                    None => Rational::from_big(self.big() + other.big()),
                }
            }
            _ => match self.integers(other) {
                Some((a, b)) => Rational::from_big(BigRational::from_integer(a + b)),
                None => Rational::from_big(self.big() + other.big()),
            },
        }
    }

    /// Both as integers, if they are: these have no common divisor to look for.
    fn integers(&self, other: &Rational) -> Option<(BigInt, BigInt)> {
        let integer = |value: &Rational| match &value.0 {
            Repr::Small(n, 1) => Some(BigInt::from(*n)),
            Repr::Big(value) if value.denom().is_one() => Some(value.numer().clone()),
            _ => None,
        };
        Some((integer(self)?, integer(other)?))
    }

    /// The product.
    #[must_use]
    pub fn mul(&self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Repr::Small(a, b), Repr::Small(c, d)) => Rational::reduce(
                i128::from(*a) * i128::from(*c),
                i128::from(*b) * i128::from(*d),
            ),
            _ => match self.integers(other) {
                Some((a, b)) => Rational::from_big(BigRational::from_integer(a * b)),
                None => Rational::from_big(self.big() * other.big()),
            },
        }
    }

    /// The negative.
    #[must_use]
    pub fn neg(&self) -> Rational {
        match &self.0 {
            Repr::Small(n, d) => Rational(Repr::Small(-n, *d)),
            Repr::Big(value) => Rational::from_big(-(**value).clone()),
        }
    }

    /// The difference.
    #[must_use]
    pub fn sub(&self, other: &Rational) -> Rational {
        self.add(&other.neg())
    }

    /// The reciprocal; `None` of 0.
    #[must_use]
    pub fn recip(&self) -> Option<Rational> {
        match &self.0 {
            Repr::Small(0, _) => None,
            Repr::Small(n, d) => Some(Rational(Repr::Small(d * n.signum(), n.abs()))),
            Repr::Big(value) => Some(Rational::from_big(value.recip())),
        }
    }

    /// The power with an integer exponent; `None` for 0 to a negative power or beyond [`LONGEST`].
    #[must_use]
    pub fn pow(&self, exponent: i32) -> Option<Rational> {
        if exponent == 1 {
            return Some(self.clone());
        }
        if self.is_one() {
            return Some(Rational::ONE);
        }
        let base = if exponent < 0 {
            self.recip()?
        } else {
            self.clone()
        };
        let value = base.big();
        let bits = value.numer().bits().max(value.denom().bits());
        let power = exponent.unsigned_abs();
        if bits.saturating_mul(u64::from(power)) > LONGEST {
            return None;
        }
        // In lowest terms already.
        let (n, d) = (value.numer().pow(power), value.denom().pow(power));
        Some(Rational::from_big(BigRational::new_raw(n, d)))
    }

    /// The exact square root, if it is rational.
    #[must_use]
    pub fn sqrt(&self) -> Option<Rational> {
        self.root(2)
    }
    /// The root of a degree, if it is rational.
    #[must_use]
    pub fn root(&self, degree: u32) -> Option<Rational> {
        if self.is_negative() && degree.is_multiple_of(2) {
            return None;
        }
        let value = self.big();
        let [n, d] = [value.numer(), value.denom()].map(|part| part.nth_root(degree));
        (n.pow(degree) == *value.numer() && d.pow(degree) == *value.denom())
            .then(|| Rational::from_big(BigRational::new_raw(n, d)))
    }

    /// The number as x·4ⁿ with x near 1; `None` of 0 or where 4ⁿ is longer than [`LONGEST`].
    #[must_use]
    pub fn in_powers_of_four(&self) -> Option<(Rational, i32)> {
        let value = self.big();
        let bits = |part: &BigInt| i64::try_from(part.bits()).ok();
        let n = i32::try_from((bits(value.numer())? - bits(value.denom())?) / 2).ok()?;
        let power = Rational::integer(4).pow(-n)?;
        (!self.is_zero()).then(|| (self.mul(&power), n))
    }

    /// Returns true if this is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0, _))
    }
    /// Returns true if this is 1.
    #[must_use]
    pub fn is_one(&self) -> bool {
        matches!(self.0, Repr::Small(1, 1))
    }
    /// Returns true if this is 1 or −1.
    #[must_use]
    pub fn is_unit(&self) -> bool {
        matches!(self.0, Repr::Small(1 | -1, 1))
    }
    /// Returns true if this is below 0.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small(n, _) => *n < 0,
            Repr::Big(value) => value.is_negative(),
        }
    }
    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Rational {
        if self.is_negative() {
            self.neg()
        } else {
            self.clone()
        }
    }
    /// −1, 0 or 1.
    #[must_use]
    pub fn sign(&self) -> Rational {
        match (self.is_zero(), self.is_negative()) {
            (true, _) => Rational::ZERO,
            (_, true) => Rational::MINUS_ONE,
            _ => Rational::ONE,
        }
    }
    /// The largest integer that is not larger.
    #[must_use]
    pub fn floor(&self) -> Rational {
        match &self.0 {
            Repr::Small(n, d) => Rational::integer(n.div_euclid(*d)),
            Repr::Big(value) => Rational::from_big(value.floor()),
        }
    }
    /// The nearest integer, ties to even.
    #[must_use]
    pub fn round(&self) -> Rational {
        let below = self.floor();
        let twice = Rational::integer(2).mul(&self.sub(&below));
        let rest = twice.sub(&Rational::ONE);
        match rest.is_negative() || rest.is_zero() && !below.is_odd() {
            true => below,
            false => below.add(&Rational::ONE),
        }
    }
    /// Returns true if the value is an integer.
    #[must_use]
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Repr::Small(_, d) => *d == 1,
            Repr::Big(value) => value.is_integer(),
        }
    }
    /// Returns true if the value is an odd integer.
    #[must_use]
    pub fn is_odd(&self) -> bool {
        match &self.0 {
            Repr::Small(n, d) => *d == 1 && n % 2 != 0,
            Repr::Big(value) => value.is_integer() && value.numer().is_odd(),
        }
    }
    /// The number of bits of the longer of numerator and denominator, rounded up to 64.
    #[must_use]
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Repr::Small(..) => 64,
            Repr::Big(value) => value
                .numer()
                .bits()
                .max(value.denom().bits())
                .next_multiple_of(64),
        }
    }
    /// The number of bits of the longer of numerator and denominator.
    #[must_use]
    pub fn length(&self) -> u64 {
        match &self.0 {
            Repr::Small(n, d) => {
                u64::from(64 - (n.unsigned_abs() | d.unsigned_abs()).leading_zeros())
            }
            Repr::Big(value) => value.numer().bits().max(value.denom().bits()),
        }
    }
    /// Numerator and denominator where both fit `i64`.
    #[must_use]
    pub fn to_small(&self) -> Option<(i64, i64)> {
        match self.0 {
            Repr::Small(n, d) => Some((n, d)),
            Repr::Big(_) => None,
        }
    }

    /// The nearest `f64` (ties to even), infinite past its range.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        if let Repr::Small(n, d) = self.0 {
            // Both are exact below 2⁵³, and one division rounds once.
            if n.unsigned_abs() < 1 << 53 && d.unsigned_abs() < 1 << 53 {
                return n as f64 / d as f64;
            }
        }
        round(&self.big())
    }

    /// Returns true if its nearest `f64` is infinite, or 0 although it is not 0.
    #[must_use]
    pub fn leaves_f64(&self) -> bool {
        let nearest = self.to_f64();
        nearest.is_infinite() || (nearest == 0.0 && !self.is_zero())
    }

    /// The two words `hi + lo` nearest to the value: `hi` is [`Rational::to_f64`], `lo` the
    /// nearest `f64` to what is left.
    #[must_use]
    pub fn to_words(&self) -> (f64, f64) {
        let hi = self.to_f64();
        // A short fraction of a power of two is a double.
        if let Repr::Small(n, d) = self.0
            && n.unsigned_abs() <= 1 << 53
            && d.unsigned_abs().is_power_of_two()
        {
            return (hi, 0.0);
        }
        match BigRational::from_float(hi) {
            Some(word) => (hi, round(&(self.big() - word))),
            None => (hi, 0.0),
        }
    }

    /// The text: an integer, a finite decimal of at most 6 places, or `n/d`.
    #[must_use]
    pub fn to_text(&self) -> String {
        match &self.0 {
            Repr::Small(n, 1) => n.to_string(),
            Repr::Small(n, d) => {
                for places in 1..=6usize {
                    let scale = 10i64.pow(places as u32);
                    if scale % d == 0 {
                        let Some(scaled) = n.unsigned_abs().checked_mul((scale / d) as u64) else {
                            break;
                        };
                        let sign = if *n < 0 { "-" } else { "" };
                        let (whole, part) = (scaled / scale as u64, scaled % scale as u64);
                        return format!("{sign}{whole}.{part:0places$}");
                    }
                }
                format!("{n}/{d}")
            }
            Repr::Big(value) => {
                let f = self.to_f64();
                if f != 0.0
                    && f.is_finite()
                    && BigRational::from_float(f).as_ref() != Some(value)
                    && value.denom().bits() > 64
                {
                    return format!("{f:e}");
                }
                if value.denom().is_one() {
                    value.numer().to_string()
                } else {
                    value.to_string()
                }
            }
        }
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Rational) -> Ordering {
        match (&self.0, &other.0) {
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b)))
            }
            // By the sign of the difference: comparing them as fractions recurses.
            _ => match self.sub(other) {
                difference if difference.is_negative() => Ordering::Less,
                difference if difference.is_zero() => Ordering::Equal,
                _ => Ordering::Greater,
            },
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        if let (Ok(x), Ok(y)) = (u64::try_from(a), u64::try_from(b)) {
            return u128::from(x.gcd(&y));
        }
        (a, b) = (b, a % b);
    }
    a
}

/// The nearest `f64`, ties to even.
fn round(value: &BigRational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}
