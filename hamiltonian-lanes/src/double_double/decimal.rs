//! Decimal text to double-doubles and back.
//!
//! Input: text as Rust writes floats, or a double-double. Output: the number, or its digits.
//! Invariant: both directions are exact integer arithmetic with one rounding at the end, and
//! nothing is allocated.

use core::cmp::Ordering;
use core::error::Error;
use core::fmt;
use core::str::FromStr;

use super::DoubleDouble;
use super::big::Big;

/// The number of digits that [`Display`](fmt::Display) writes.
const DIGITS: u32 = 32;
/// The largest number of digits that are computed: as many as fit in 128 bits.
const MOST_DIGITS: u32 = 38;
/// The number of digits that are read; later ones affect the rounding only.
const MOST_DIGITS_READ: u32 = 80;

/// The text is not a decimal number.
///
/// ```
/// use hamiltonian::lanes::ParseDoubleDoubleError;
/// use hamiltonian::prelude::*;
/// assert_eq!("0.1.2".parse::<DoubleDouble>(), Err(ParseDoubleDoubleError));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParseDoubleDoubleError;

impl fmt::Display for ParseDoubleDoubleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not a decimal number")
    }
}

impl Error for ParseDoubleDoubleError {}

impl FromStr for DoubleDouble {
    type Err = ParseDoubleDoubleError;

    /// Reads `[+-]digits[.digits][e[+-]digits]`, `inf`, `infinity` or `nan`, and rounds to nearest
    /// word by word: the relative error is at most 2⁻¹⁰⁷ for numbers above 10⁻²⁹⁰.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let tenth: DoubleDouble = "0.1".parse()?;
    /// assert_eq!((tenth.hi(), tenth.lo()), (0.1, -5.551115123125783e-18));
    /// # Ok::<(), hamiltonian::lanes::ParseDoubleDoubleError>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, ParseDoubleDoubleError> {
        let (negative, unsigned) = match text.as_bytes() {
            [b'-', rest @ ..] => (true, rest),
            [b'+', rest @ ..] => (false, rest),
            all => (false, all),
        };
        let names = [
            ("inf", f64::INFINITY),
            ("infinity", f64::INFINITY),
            ("nan", f64::NAN),
        ];
        let named = names
            .iter()
            .find(|(name, _)| unsigned.eq_ignore_ascii_case(name.as_bytes()));
        let size = match named {
            Some(&(_, value)) => Self::from(value),
            None => read(unsigned)?,
        };
        Ok(if negative { -size } else { size })
    }
}

/// A number without sign.
fn read(text: &[u8]) -> Result<DoubleDouble, ParseDoubleDoubleError> {
    let exponent_at = text.iter().position(|&c| c == b'e' || c == b'E');
    let (mantissa, written) = match exponent_at {
        Some(at) => (&text[..at], read_exponent(&text[at + 1..])?),
        None => (text, 0),
    };

    let mut digits = Big::from(0);
    let (mut count, mut exact, mut power) = (0, true, written);
    let (mut any, mut after_point) = (false, false);
    for &c in mantissa {
        match c {
            b'.' if !after_point => after_point = true,
            b'0'..=b'9' => {
                any = true;
                let digit = u64::from(c - b'0');
                if count < MOST_DIGITS_READ {
                    digits = digits.mul_add(10, digit);
                    count += u32::from(count > 0 || digit > 0);
                    power -= i64::from(after_point);
                } else {
                    exact &= digit == 0;
                    power += i64::from(!after_point);
                }
            }
            _ => return Err(ParseDoubleDoubleError),
        }
    }
    if !any {
        return Err(ParseDoubleDoubleError);
    }
    // 10^(size − 1) ≤ number < 10^size.
    let size = power.saturating_add(i64::from(count));
    Ok(if count == 0 || size < -400 {
        DoubleDouble::from(0.0)
    } else if size > 310 {
        DoubleDouble::from(f64::INFINITY)
    } else if power >= 0 {
        digits
            .mul_power_of_ten(power as u32)
            .with_rest(exact)
            .to_double_double(0)
    } else {
        // Shifted so far that the quotient keeps at least 170 bits: 10^n < 2^(10n/3).
        let power = power.unsigned_abs() as u32;
        let shift = power * 10 / 3 + 171;
        let (quotient, no_rest) = digits.shift_left(shift).div_power_of_ten(power);
        quotient
            .with_rest(exact && no_rest)
            .to_double_double(-(shift as i32))
    })
}

/// `[+-]digits`; sizes beyond any number's are cut short.
fn read_exponent(text: &[u8]) -> Result<i64, ParseDoubleDoubleError> {
    let (negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        all => (false, all),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(ParseDoubleDoubleError);
    }
    const LARGEST: i64 = 1 << 50;
    let size = digits
        .iter()
        .fold(0, |n: i64, c| (n * 10 + i64::from(c - b'0')).min(LARGEST));
    Ok(if negative { -size } else { size })
}

/// The decimal digits of |x| rounded to `count` ≤ 38 digits, ties to even: an integer of exactly
/// `count` digits and the power of ten of its first digit; for finite `x` other than 0.
fn digits(x: DoubleDouble, count: u32) -> (u128, i32) {
    let units = in_smallest_units(x);
    let limit = 10u128.pow(count);
    // From below, by the leading bit: the true power or one less, and then the integer is below
    // 2·10^count, which 128 bits hold.
    let leading_bit = i64::from(units.length()) - 1 - 1074;
    let mut power = (leading_bit * 301_029_995_664).div_euclid(1_000_000_000_000) as i32;
    loop {
        let integer = rounded(units, count as i32 - 1 - power);
        if integer < limit {
            return (integer, power);
        }
        power += 1;
    }
}

/// |x| in units of 2⁻¹⁰⁷⁴.
fn in_smallest_units(x: DoubleDouble) -> Big {
    let word = |word: f64| {
        let bits = word.to_bits();
        let field = ((bits >> 52) & 0x7ff) as u32;
        let fraction = bits & ((1 << 52) - 1);
        if field == 0 {
            Big::from(fraction)
        } else {
            Big::from(fraction | 1 << 52).shift_left(field - 1)
        }
    };
    let (hi, lo) = (word(x.hi), word(x.lo));
    if (x.hi < 0.0) == (x.lo < 0.0) {
        hi.add(lo)
    } else {
        hi.sub(lo)
    }
}

/// `units·2⁻¹⁰⁷⁴·10^power` rounded to an integer, ties to even.
fn rounded(units: Big, power: i32) -> u128 {
    let (scaled, exact) = if power >= 0 {
        (units.mul_power_of_ten(power as u32), true)
    } else {
        units.div_power_of_ten(power.unsigned_abs())
    };
    let (integer, rest) = scaled.split(1074);
    let integer = integer.low();
    match rest.with_rest(exact).compare_with_half(1074) {
        Ordering::Less => integer,
        Ordering::Equal => integer + (integer & 1),
        Ordering::Greater => integer + 1,
    }
}

/// Text built on the stack.
struct Text {
    bytes: [u8; 64],
    length: usize,
}

impl Text {
    fn new() -> Self {
        Self {
            bytes: [0; 64],
            length: 0,
        }
    }

    fn push(&mut self, byte: u8) {
        self.bytes[self.length] = byte;
        self.length += 1;
    }

    /// `count` digits of `integer` with a point after the first `before`.
    fn push_digits(&mut self, integer: u128, count: u32, before: u32) {
        for i in 0..count {
            if i == before {
                self.push(b'.');
            }
            self.push(b'0' + (integer / 10u128.pow(count - 1 - i) % 10) as u8);
        }
    }

    fn push_exponent(&mut self, power: i32) {
        self.push(b'e');
        if power < 0 {
            self.push(b'-');
        }
        let size = u128::from(power.unsigned_abs());
        let count = if size >= 100 {
            3
        } else {
            1 + u32::from(size >= 10)
        };
        self.push_digits(size, count, count);
    }

    fn as_str(&self) -> &str {
        core::str::from_utf8(&self.bytes[..self.length]).unwrap_or_default()
    }
}

/// Writes numbers without digits: NaN, infinities and zero.
fn write_special(x: DoubleDouble, zero: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let text = if x.hi.is_nan() {
        "NaN"
    } else if x.hi == 0.0 {
        zero
    } else {
        "inf"
    };
    f.pad_integral(x.hi.is_sign_positive(), "", text)
}

/// 32 significant digits, correctly rounded, without trailing zeros; in scientific form below 10⁻⁵
/// and from 10³² on. Width and sign are as for `f64`; a precision is ignored (see
/// [`LowerExp`](fmt::LowerExp)).
///
/// ```
/// use hamiltonian::prelude::*;
/// let pi = DoubleDouble::from(-1.0).acos();
/// assert_eq!(pi.to_string(), "3.1415926535897932384626433832795");
/// assert_eq!(DoubleDouble::from(2.5).to_string(), "2.5");
/// assert_eq!((pi / DoubleDouble::from(1e9)).to_string(), "3.1415926535897932384626433832795e-9");
/// ```
impl fmt::Display for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.hi == 0.0 || !self.hi.is_finite() {
            return write_special(*self, "0", f);
        }
        let (mut integer, power) = digits(*self, DIGITS);
        let mut count = DIGITS;
        while integer.is_multiple_of(10) {
            integer /= 10;
            count -= 1;
        }
        let mut text = Text::new();
        if power < -5 || power >= DIGITS as i32 {
            text.push_digits(integer, count, 1);
            text.push_exponent(power);
        } else if power < 0 {
            // Leading zeros are digits of the integer, too.
            let zeros = power.unsigned_abs();
            text.push(b'0');
            text.push(b'.');
            (1..zeros).for_each(|_| text.push(b'0'));
            text.push_digits(integer, count, count);
        } else {
            let before = power as u32 + 1;
            text.push_digits(integer, count, before);
            (count..before).for_each(|_| text.push(b'0'));
        }
        f.pad_integral(self.hi > 0.0, "", text.as_str())
    }
}

/// Scientific form, correctly rounded: the precision is the number of digits after the point, 31
/// if none is given, and never more than 37.
///
/// ```
/// use hamiltonian::prelude::*;
/// let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
/// assert_eq!(format!("{third:.4e}"), "3.3333e-1");
/// ```
impl fmt::LowerExp for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.hi == 0.0 || !self.hi.is_finite() {
            return write_special(*self, "0e0", f);
        }
        let after = f
            .precision()
            .map_or(DIGITS - 1, |p| p.min(MOST_DIGITS as usize - 1) as u32);
        let (integer, power) = digits(*self, after + 1);
        let mut text = Text::new();
        text.push_digits(integer, after + 1, 1);
        text.push_exponent(power);
        f.pad_integral(self.hi > 0.0, "", text.as_str())
    }
}
