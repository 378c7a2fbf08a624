//! Unsigned integers of 2 560 bits, on the stack.
//!
//! Input: small integers, products, shifts. Output: exact integers, and integers rounded to a
//! double-double. Invariant: callers keep results below 2^2560, which suffices for every finite
//! double-double in units of 2⁻¹⁰⁷⁴, and for 80 digits times any power of ten in range.

use super::DoubleDouble;

/// Words of 64 bits.
const WORDS: usize = 40;

/// An unsigned integer, least significant word first.
#[derive(Clone, Copy)]
pub(super) struct Big([u64; WORDS]);

impl Big {
    pub(super) fn from(value: u64) -> Self {
        let mut words = [0; WORDS];
        words[0] = value;
        Self(words)
    }

    /// `self·factor + term`.
    pub(super) fn mul_add(mut self, factor: u64, term: u64) -> Self {
        let mut carry = u128::from(term);
        for word in &mut self.0 {
            carry += u128::from(*word) * u128::from(factor);
            *word = carry as u64;
            carry >>= 64;
        }
        self
    }

    /// Quotient and remainder by `divisor`.
    pub(super) fn div_rem(mut self, divisor: u64) -> (Self, u64) {
        let mut rest = 0u128;
        for word in self.0.iter_mut().rev() {
            rest = rest << 64 | u128::from(*word);
            *word = (rest / u128::from(divisor)) as u64;
            rest %= u128::from(divisor);
        }
        (self, rest as u64)
    }

    /// `self·10^power`.
    pub(super) fn mul_power_of_ten(mut self, mut power: u32) -> Self {
        while power > 0 {
            let step = power.min(19);
            self = self.mul_add(10u64.pow(step), 0);
            power -= step;
        }
        self
    }

    /// `⌊self/10^power⌋`, and true if the quotient is exact.
    pub(super) fn div_power_of_ten(mut self, mut power: u32) -> (Self, bool) {
        let mut exact = true;
        while power > 0 {
            let step = power.min(19);
            let (quotient, rest) = self.div_rem(10u64.pow(step));
            self = quotient;
            exact &= rest == 0;
            power -= step;
        }
        (self, exact)
    }

    /// `self·2^shift`.
    pub(super) fn shift_left(self, shift: u32) -> Self {
        let (words, bit) = ((shift / 64) as usize, shift % 64);
        let mut out = [0; WORDS];
        for (i, word) in out.iter_mut().enumerate().skip(words) {
            let below = if bit > 0 && i > words {
                self.0[i - words - 1] >> (64 - bit)
            } else {
                0
            };
            *word = self.0[i - words] << bit | below;
        }
        Self(out)
    }

    /// `⌊self/2^shift⌋` and the rest.
    pub(super) fn split(self, shift: u32) -> (Self, Self) {
        let (words, bit) = ((shift / 64) as usize, shift % 64);
        let mut quotient = [0; WORDS];
        for (i, word) in quotient
            .iter_mut()
            .enumerate()
            .take(WORDS.saturating_sub(words))
        {
            let above = match self.0.get(i + words + 1) {
                Some(&above) if bit > 0 => above << (64 - bit),
                _ => 0,
            };
            *word = self.0[i + words] >> bit | above;
        }
        let mut rest = self.0;
        for (i, word) in rest.iter_mut().enumerate().skip(words) {
            *word &= if i == words { (1 << bit) - 1 } else { 0 };
        }
        (Self(quotient), Self(rest))
    }

    /// `self + other`.
    pub(super) fn add(self, other: Self) -> Self {
        self.add_with_carry(other, false)
    }

    /// `self − other`, for `other ≤ self`.
    pub(super) fn sub(self, other: Self) -> Self {
        self.add_with_carry(Self(other.0.map(|word| !word)), true)
    }

    fn add_with_carry(mut self, other: Self, carry: bool) -> Self {
        let mut carry = u128::from(carry);
        for (a, b) in self.0.iter_mut().zip(other.0) {
            carry += u128::from(*a) + u128::from(b);
            *a = carry as u64;
            carry >>= 64;
        }
        self
    }

    /// The number of bits up to the leading one; 0 for 0.
    pub(super) fn length(&self) -> u32 {
        let leading = self.0.iter().rposition(|&word| word != 0);
        leading.map_or(0, |i| 64 * (i as u32 + 1) - self.0[i].leading_zeros())
    }

    /// The integer, if it is below 2¹²⁸.
    pub(super) fn low(&self) -> u128 {
        u128::from(self.0[1]) << 64 | u128::from(self.0[0])
    }

    /// The comparison with half of `2^shift`.
    pub(super) fn compare_with_half(&self, shift: u32) -> core::cmp::Ordering {
        let half = if shift == 0 {
            Self::from(0)
        } else {
            Self::from(1).shift_left(shift - 1)
        };
        self.0.iter().rev().cmp(half.0.iter().rev())
    }

    /// Sets the last bit in place of a truncated rest, so that a number above a tie stays above it.
    pub(super) fn with_rest(mut self, exact: bool) -> Self {
        self.0[0] |= u64::from(!exact);
        self
    }

    /// `self·2^scale`, each word rounded to nearest, ties to even.
    pub(super) fn to_double_double(self, scale: i32) -> DoubleDouble {
        let (hi, shift, rest, above) = self.leading_word();
        let (lo, low_shift, ..) = rest.leading_word();
        let hi = DoubleDouble::from(hi).scale_by_power(shift as i32 + scale);
        let lo = DoubleDouble::from(lo).scale_by_power(low_shift as i32 + scale);
        if above { hi - lo } else { hi + lo }
    }

    /// 53 bits rounded to nearest, their shift, the distance from `self` to them, and true if they
    /// are above it.
    fn leading_word(self) -> (f64, u32, Self, bool) {
        let shift = self.length().saturating_sub(53);
        let (leading, rest) = self.split(shift);
        let bits = leading.low() as u64;
        let up = match rest.compare_with_half(shift) {
            core::cmp::Ordering::Less => false,
            core::cmp::Ordering::Equal => shift > 0 && bits & 1 == 1,
            core::cmp::Ordering::Greater => true,
        };
        if up {
            (
                (bits + 1) as f64,
                shift,
                Self::from(1).shift_left(shift).sub(rest),
                true,
            )
        } else {
            (bits as f64, shift, rest, false)
        }
    }
}
