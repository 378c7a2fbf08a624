//! Sums and products of two `f64` with their rounding errors.
//!
//! Input: two numbers. Output: `(result, error)`. Invariant: result and error together are exact,
//! except for overflow and subnormal errors, with and without fused instructions.

/// `a + b = s + e` exactly, `s` rounded to nearest (D. E. Knuth, *The Art of Computer Programming*
/// 2, §4.2.2, theorem B, 1969).
#[inline(always)]
pub const fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

/// [`two_sum`] where |a| ≥ |b| or a = 0 (Dekker 1971).
#[inline(always)]
pub const fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// `a·b = p + e` exactly, except if `e` is subnormal (Dekker 1971; G. W. Veltkamp's splitting).
#[inline(always)]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    // If the target is known to fuse, one instruction gives the same error term.
    #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
    {
        (p, a.mul_add(b, -p))
    }
    #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
    {
        let (a1, a2) = split(a);
        let (b1, b2) = split(b);
        (p, (((a1 * b1 - p) + a1 * b2) + a2 * b1) + a2 * b2)
    }
}

/// `a` as two words of 26 bits. The bits are rounded in place: Veltkamp's product with 2²⁷ + 1
/// overflows for the largest numbers and is no faster.
#[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let high = f64::from_bits(a.to_bits().wrapping_add(1 << 26) & !((1 << 27) - 1));
    (high, a - high)
}

/// `2^k` for −1022 ≤ k ≤ 1023.
#[inline(always)]
pub fn power_of_two(k: i32) -> f64 {
    f64::from_bits(((1023 + k) as u64) << 52)
}
