//! The square root of a double, rounded to nearest.
//!
//! Input: any double. Output: its root. Invariant: with and without the standard library the same
//! bits; without it by integers, since `core` has no root of a float.

/// Square root; NaN below 0, and −0 of −0.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// Square root; NaN below 0, and −0 of −0.
#[cfg(not(feature = "std"))]
pub(crate) fn sqrt(x: f64) -> f64 {
    by_integers(x)
}

/// With `|x| = m·2^(2e)` and 2¹⁰⁶ ≤ m < 2¹⁰⁸, the root is ⌊√m⌋·2^e of 54 bits. The last bit and the
/// presence of a remainder decide the rounding.
#[cfg(any(test, not(feature = "std")))]
fn by_integers(x: f64) -> f64 {
    if x == 0.0 || x.is_nan() || x == f64::INFINITY {
        return x;
    }
    if x < 0.0 {
        return f64::NAN;
    }
    let field = (x.to_bits() >> 52) as i32;
    let fraction = x.to_bits() & ((1 << 52) - 1);
    let (significand, scale) = if field == 0 {
        let shift = fraction.leading_zeros() - 11;
        (fraction << shift, -1074 - shift as i32)
    } else {
        (fraction | 1 << 52, field - 1075)
    };
    // The scale left over is made even.
    let shift = 54 + (scale & 1);
    let m = u128::from(significand) << shift;
    let root = m.isqrt();
    let sticky = u128::from(root * root != m);
    // One bit more, so that the conversion rounds to nearest with ties to even.
    let rounded = (root << 1 | sticky) as f64;
    let exponent = (scale - shift) / 2 - 1;
    rounded * f64::from_bits(((1023 + exponent) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::by_integers;

    #[test]
    fn roots_by_integers_are_rounded_to_nearest() {
        let mut bits = 0x9e37_79b9_7f4a_7c15u64;
        for _ in 0..100_000 {
            bits = bits.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            let x = f64::from_bits(bits ^ bits >> 29);
            let (found, expected) = (by_integers(x), x.sqrt());
            assert!(
                found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(),
                "{x:e}: {found:e}, expected {expected:e}"
            );
        }
        for x in [
            0.0,
            -0.0,
            f64::INFINITY,
            f64::from_bits(1),
            f64::from_bits(2),
            f64::MAX,
            1.0,
        ] {
            assert_eq!(by_integers(x).to_bits(), x.sqrt().to_bits(), "{x:e}");
        }
    }
}
