//! AVX2 with FMA: four lanes, and one.
//!
//! Input: registers. Output: [`Register`] for `__m256d` and for [`One`]. Invariant: a lane's flag
//! is its sign bit; its other bits are undefined.

use core::arch::x86_64::*;

use super::portable::plain;
use super::register::{Register, intrinsics, out_of_line};

/// The same number, of which the compiler does not know where it comes from: LLVM makes a store under a mask of a choice
/// that it sees. There is no instruction.
#[inline]
#[target_feature(enable = "avx")]
fn opaque(mut a: __m256d) -> __m256d {
    // SAFETY: no instruction, and no effect.
    unsafe {
        core::arch::asm!("/* {0} */", inout(ymm_reg) a, options(pure, nomem, nostack, preserves_flags));
    }
    a
}

impl Register for __m256d {
    type Flags = __m256d;
    type Array = [f64; 4];
    const LANES: u32 = 4;
    const FUSED: bool = true;

    out_of_line!("avx2,fma");
    intrinsics! {
        fn splat(value: f64) -> Self { _mm256_set1_pd(value) }
        fn load(lanes: &[f64; 4]) -> Self { _mm256_loadu_pd(lanes.as_ptr()) }
        fn store(a: Self) -> [f64; 4] {
            let mut lanes = [0.0; 4];
            _mm256_storeu_pd(lanes.as_mut_ptr(), a);
            lanes
        }
        fn add(a: Self, b: Self) -> Self { _mm256_add_pd(a, b) }
        fn sub(a: Self, b: Self) -> Self { _mm256_sub_pd(a, b) }
        fn mul(a: Self, b: Self) -> Self { _mm256_mul_pd(a, b) }
        fn div(a: Self, b: Self) -> Self { _mm256_div_pd(a, b) }
        fn fma(a: Self, b: Self, c: Self) -> Self { _mm256_fmadd_pd(a, b, c) }
        fn sqrt(a: Self) -> Self { _mm256_sqrt_pd(a) }
        fn and(a: Self, b: Self) -> Self { _mm256_and_pd(a, b) }
        fn or(a: Self, b: Self) -> Self { _mm256_or_pd(a, b) }
        fn xor(a: Self, b: Self) -> Self { _mm256_xor_pd(a, b) }
        fn plus(a: Self, b: Self) -> Self {
            _mm256_castsi256_pd(_mm256_add_epi64(_mm256_castpd_si256(a), _mm256_castpd_si256(b)))
        }
        fn minus(a: Self, b: Self) -> Self {
            _mm256_castsi256_pd(_mm256_sub_epi64(_mm256_castpd_si256(a), _mm256_castpd_si256(b)))
        }
        fn shl<const K: u32>(a: Self) -> Self {
            _mm256_castsi256_pd(_mm256_sll_epi64(_mm256_castpd_si256(a), _mm_cvtsi32_si128(K as i32)))
        }
        fn shr<const K: u32>(a: Self) -> Self {
            _mm256_castsi256_pd(_mm256_srl_epi64(_mm256_castpd_si256(a), _mm_cvtsi32_si128(K as i32)))
        }
        fn odd(a: Self) -> __m256d { Self::shl::<63>(a) }
        fn lt(a: Self, b: Self) -> __m256d { _mm256_cmp_pd::<_CMP_LT_OQ>(a, b) }
        fn le(a: Self, b: Self) -> __m256d { _mm256_cmp_pd::<_CMP_LE_OQ>(a, b) }
        fn equals(a: Self, b: Self) -> __m256d { _mm256_cmp_pd::<_CMP_EQ_OQ>(a, b) }
        fn select(flags: __m256d, yes: Self, no: Self) -> Self { _mm256_blendv_pd(no, yes, flags) }
        fn replaced(flags: __m256d, new: Self, old: Self) -> Self {
            opaque(_mm256_blendv_pd(old, new, flags))
        }
        fn flags(flag: bool) -> __m256d {
            _mm256_castsi256_pd(_mm256_set1_epi64x(if flag { -1 } else { 0 }))
        }
        fn both_flags(a: __m256d, b: __m256d) -> __m256d { _mm256_and_pd(a, b) }
        fn either_flag(a: __m256d, b: __m256d) -> __m256d { _mm256_or_pd(a, b) }
        fn not(a: __m256d) -> __m256d {
            _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))
        }
        fn bits(a: __m256d) -> u32 { _mm256_movemask_pd(a) as u32 }
        fn rows(bits: Self, table: &[[f64; 4]; 1024]) -> [Self; 4] {
            let bits = Self::store(bits);
            let mut rows = [Self::splat(0.0); 4];
            let mut k = 0;
            while k < 4 {
                rows[k] = Self::load(&table[bits[k].to_bits() as usize & 1023]);
                k += 1;
            }
            let even = (_mm256_unpacklo_pd(rows[0], rows[1]), _mm256_unpacklo_pd(rows[2], rows[3]));
            let odd = (_mm256_unpackhi_pd(rows[0], rows[1]), _mm256_unpackhi_pd(rows[2], rows[3]));
            [
                _mm256_permute2f128_pd::<0x20>(even.0, even.1),
                _mm256_permute2f128_pd::<0x20>(odd.0, odd.1),
                _mm256_permute2f128_pd::<0x31>(even.0, even.1),
                _mm256_permute2f128_pd::<0x31>(odd.0, odd.1),
            ]
        }
    }
}

/// One number, with fused products and sums.
#[derive(Clone, Copy)]
pub struct One([f64; 1]);

#[inline(always)]
fn once_rounded(a: f64, b: f64, c: f64) -> f64 {
    // SAFETY: `One` is named by the levels Avx2 and Avx512 alone, which are entered only on CPUs
    // that have FMA (see the module).
    unsafe { _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c))) }
}

plain!(One, 1, fused: true, fma: once_rounded, features: ["avx2,fma"], 0);
