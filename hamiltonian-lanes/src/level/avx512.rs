//! AVX-512: eight lanes.
//!
//! Input: registers. Output: [`Register`] for `__m512d`. Invariant: flags are the bits of a mask
//! register.

use core::arch::x86_64::*;

use super::register::{Register, intrinsics, out_of_line};

impl Register for __m512d {
    type Flags = __mmask8;
    type Array = [f64; 8];
    const LANES: u32 = 8;
    const FUSED: bool = true;

    out_of_line!("avx512f,avx512dq,avx512cd,avx512bw,avx512vl,avx2,fma");
    intrinsics! {
        fn splat(value: f64) -> Self { _mm512_set1_pd(value) }
        fn load(lanes: &[f64; 8]) -> Self { _mm512_loadu_pd(lanes.as_ptr()) }
        fn store(a: Self) -> [f64; 8] {
            let mut lanes = [0.0; 8];
            _mm512_storeu_pd(lanes.as_mut_ptr(), a);
            lanes
        }
        fn add(a: Self, b: Self) -> Self { _mm512_add_pd(a, b) }
        fn sub(a: Self, b: Self) -> Self { _mm512_sub_pd(a, b) }
        fn mul(a: Self, b: Self) -> Self { _mm512_mul_pd(a, b) }
        fn div(a: Self, b: Self) -> Self { _mm512_div_pd(a, b) }
        fn fma(a: Self, b: Self, c: Self) -> Self { _mm512_fmadd_pd(a, b, c) }
        fn sqrt(a: Self) -> Self { _mm512_sqrt_pd(a) }
        fn and(a: Self, b: Self) -> Self { _mm512_and_pd(a, b) }
        fn or(a: Self, b: Self) -> Self { _mm512_or_pd(a, b) }
        fn xor(a: Self, b: Self) -> Self { _mm512_xor_pd(a, b) }
        fn plus(a: Self, b: Self) -> Self {
            _mm512_castsi512_pd(_mm512_add_epi64(_mm512_castpd_si512(a), _mm512_castpd_si512(b)))
        }
        fn minus(a: Self, b: Self) -> Self {
            _mm512_castsi512_pd(_mm512_sub_epi64(_mm512_castpd_si512(a), _mm512_castpd_si512(b)))
        }
        fn shl<const K: u32>(a: Self) -> Self {
            _mm512_castsi512_pd(_mm512_slli_epi64::<K>(_mm512_castpd_si512(a)))
        }
        fn shr<const K: u32>(a: Self) -> Self {
            _mm512_castsi512_pd(_mm512_srli_epi64::<K>(_mm512_castpd_si512(a)))
        }
        fn odd(a: Self) -> __mmask8 {
            _mm512_test_epi64_mask(_mm512_castpd_si512(a), _mm512_set1_epi64(1))
        }
        fn scaled(a: Self, k: Self) -> Option<Self> {
            // The smaller size of the two, positive: 2 where `a` is NaN.
            let a = _mm512_range_pd::<0b10_10>(a, _mm512_set1_pd(2.0));
            Some(_mm512_scalef_pd(a, k))
        }
        fn lt(a: Self, b: Self) -> __mmask8 { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b) }
        fn le(a: Self, b: Self) -> __mmask8 { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b) }
        fn equals(a: Self, b: Self) -> __mmask8 { _mm512_cmp_pd_mask::<_CMP_EQ_OQ>(a, b) }
        fn select(flags: __mmask8, yes: Self, no: Self) -> Self {
            _mm512_mask_blend_pd(flags, no, yes)
        }
        fn flags(flag: bool) -> __mmask8 { if flag { !0 } else { 0 } }
        fn both_flags(a: __mmask8, b: __mmask8) -> __mmask8 { a & b }
        fn either_flag(a: __mmask8, b: __mmask8) -> __mmask8 { a | b }
        fn not(a: __mmask8) -> __mmask8 { !a }
        fn bits(a: __mmask8) -> u32 { u32::from(a) }
        fn rows(bits: Self, table: &[[f64; 4]; 1024]) -> [Self; 4] {
            let bits = Self::store(bits);
            let mut rows = [_mm256_setzero_pd(); 8];
            let mut k = 0;
            while k < 8 {
                rows[k] = _mm256_loadu_pd(table[bits[k].to_bits() as usize & 1023].as_ptr());
                k += 1;
            }
            // Rows k and k + 2, whose pairs of neighbours are in order.
            let mut pairs = [Self::splat(0.0); 4];
            let mut k = 0;
            while k < 4 {
                let first = k + k / 2 * 2;
                pairs[k] = _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(rows[first]), rows[first + 2]);
                k += 1;
            }
            let even = (_mm512_unpacklo_pd(pairs[0], pairs[1]), _mm512_unpacklo_pd(pairs[2], pairs[3]));
            let odd = (_mm512_unpackhi_pd(pairs[0], pairs[1]), _mm512_unpackhi_pd(pairs[2], pairs[3]));
            [
                _mm512_shuffle_f64x2::<0x88>(even.0, even.1),
                _mm512_shuffle_f64x2::<0x88>(odd.0, odd.1),
                _mm512_shuffle_f64x2::<0xdd>(even.0, even.1),
                _mm512_shuffle_f64x2::<0xdd>(odd.0, odd.1),
            ]
        }
    }
}
