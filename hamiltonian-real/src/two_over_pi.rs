//! The bits of 2/π, and the window of them that reduces an angle modulo π/2.
//!
//! Input: the exponent of an angle. Output: the bits of 2/π whose products with the angle are
//! neither multiples of a turn nor below the required precision. Invariant: the table for packs
//! equals the function for single numbers.

/// 64 bits before the point and 1536 bits of 2/π, the most significant first.
#[rustfmt::skip]
const BITS: [u64; 25] = [
    0,
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d,
    0xa9e391615ee61b08, 0x6599855f14a06840, 0x8dffd8804d732731, 0x06061556ca73a8c9,
];

/// 64 bits of 2/π from the bit `start − 64` after the point.
#[inline(always)]
pub(crate) const fn window(start: usize) -> u64 {
    let (word, bit) = (start / 64, start % 64);
    let next = if bit == 0 {
        0
    } else {
        BITS[word + 1] >> (64 - bit)
    };
    BITS[word] << bit | next
}

/// `2^(field − 1075)·2/π` modulo 4, for the exponent field of an angle from 2 on: a sum of words up to 2,
/// 2⁻⁵¹, 2⁻¹⁰¹ and 2⁻¹⁵⁴. They are multiples of 2⁻⁵⁰, 2⁻¹⁰⁰, 2⁻¹⁵³ and 2⁻¹⁹⁰. NaN for the field of infinity.
pub(crate) const fn two_over_pi(field: u64) -> [f64; 4] {
    if field == 2047 {
        return [f64::NAN; 4];
    }
    // The bit worth 2 comes first.
    let start = field as usize + 62 - 1075;
    let (a, b, c) = (window(start), window(start + 64), window(start + 128));
    // Each word is rounded to nearest, so the remainder has a sign.
    let first = a.wrapping_add(1 << 11) as i64 >> 12;
    let rest = (a << 52) as i64 >> 52;
    let second = (rest << 38) + (b >> 26) as i64 + (b >> 25 & 1) as i64;
    let rest = (b << 38) as i64 >> 38;
    let third = (rest << 27) + (c >> 37) as i64 + (c >> 36 & 1) as i64;
    let rest = (c << 27) as i64 >> 27;
    [
        first as f64 * two_to(-50),
        second as f64 * two_to(-100),
        third as f64 * two_to(-153),
        rest as f64 * two_to(-190),
    ]
}

/// The same words of the fields from 1024 on: 32 kB, for packs and, with the feature `std`, single numbers.
pub static TWO_OVER_PI_MODULO_4: [[f64; 4]; 1024] = {
    let mut rows = [[0.0; 4]; 1024];
    let mut k = 0;
    while k < 1024 {
        rows[k] = two_over_pi(k as u64 + 1024);
        k += 1;
    }
    rows
};

/// `2^k` for −1022 ≤ k ≤ 1023, in constants.
const fn two_to(k: i64) -> f64 {
    f64::from_bits(((1023 + k) as u64) << 52)
}
