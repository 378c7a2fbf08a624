//! Signs of values.
//!
//! Input: the signs of operands. Output: the sign of the result. Invariant: a value that exists has one of the
//! signs in the set; the set is never empty.

use super::op::{Op, ValueSign};
use crate::rational::Rational;

/// The signs that a value may have: a set of − (1), 0 (2) and + (4).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Sign(u8);

impl Sign {
    pub(crate) const NEGATIVE: Sign = Sign(1);
    pub(crate) const ZERO: Sign = Sign(2);
    pub(crate) const POSITIVE: Sign = Sign(4);
    pub(crate) const NONNEGATIVE: Sign = Sign(6);
    pub(crate) const UNKNOWN: Sign = Sign(7);

    /// The sign of a number.
    pub(crate) fn of(k: &Rational) -> Sign {
        match k.is_negative() {
            true => Sign::NEGATIVE,
            false if k.is_zero() => Sign::ZERO,
            false => Sign::POSITIVE,
        }
    }
    /// The sign of a product `k·Π xⁿ`.
    pub(crate) fn of_product(k: &Rational, factors: impl Iterator<Item = (Sign, i32)>) -> Sign {
        let mut product = Sign::of(k);
        for (sign, n) in factors {
            product = match n % 2 {
                // 0 has no reciprocal of which a sign is known.
                _ if n < 0 && sign == Sign::ZERO => Sign::UNKNOWN,
                0 => product.times(Sign((sign.0 | sign.opposite().0) & Sign::NONNEGATIVE.0)),
                _ => product.times(sign),
            };
            if product.is_unknown() {
                break;
            }
        }
        product
    }
    /// The sign of a function, by the sign of its first argument.
    pub(crate) fn of_call(op: Op, first: Sign) -> Sign {
        match op.row().regularity.range {
            ValueSign::Positive => Sign::POSITIVE,
            ValueSign::NonNegative if op == Op::Sqrt => first.root(),
            ValueSign::NonNegative => Sign::NONNEGATIVE,
            ValueSign::OfBase if first == Sign::POSITIVE => Sign::POSITIVE,
            ValueSign::OfBase if first.is_nonnegative() => Sign::NONNEGATIVE,
            ValueSign::OfBase | ValueSign::Any => Sign::UNKNOWN,
        }
    }
    /// The sign of the square root.
    pub(crate) fn root(self) -> Sign {
        match self {
            Sign::POSITIVE => self,
            _ => Sign::NONNEGATIVE,
        }
    }
    /// The signs of either of two values.
    pub(crate) fn or(self, other: Sign) -> Sign {
        Sign(self.0 | other.0)
    }
    /// The sign of a sum.
    pub(crate) fn plus(self, other: Sign) -> Sign {
        match (self.0 | other.0) & !Sign::ZERO.0 {
            // − and +
            5 => Sign::UNKNOWN,
            either => Sign(either | self.0 & other.0 & Sign::ZERO.0),
        }
    }
    /// The sign of a product.
    pub(crate) fn times(self, other: Sign) -> Sign {
        let zero = (self.0 | other.0) & Sign::ZERO.0;
        let same = if self.is_nonpositive() { 0 } else { other.0 };
        let opposite = if self.is_nonnegative() {
            0
        } else {
            other.opposite().0
        };
        Sign(zero | same | opposite)
    }
    fn opposite(self) -> Sign {
        Sign((self.0 << 2 | self.0 & Sign::ZERO.0 | self.0 >> 2) & Sign::UNKNOWN.0)
    }
    /// Returns true if nothing is known, which further terms and factors do not change.
    pub(crate) fn is_unknown(self) -> bool {
        self.0 == Sign::UNKNOWN.0
    }
    pub(crate) fn may_be_zero(self) -> bool {
        self.0 & Sign::ZERO.0 != 0
    }
    pub(crate) fn is_nonnegative(self) -> bool {
        self.0 & Sign::NEGATIVE.0 == 0
    }
    pub(crate) fn is_nonpositive(self) -> bool {
        self.0 & Sign::POSITIVE.0 == 0
    }
}
