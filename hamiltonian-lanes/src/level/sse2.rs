//! SSE2: two lanes, on every x86-64.
//!
//! Input: registers. Output: [`Register`] for `__m128d`. Invariant: flags are all bits of a lane or
//! none; nothing fuses.

use core::arch::x86_64::*;

use super::register::{Register, intrinsics, out_of_line};

impl Register for __m128d {
    type Flags = __m128d;
    type Array = [f64; 2];
    const LANES: u32 = 2;
    const FUSED: bool = false;

    out_of_line!();
    intrinsics! {
        fn splat(value: f64) -> Self { _mm_set1_pd(value) }
        fn load(lanes: &[f64; 2]) -> Self { _mm_loadu_pd(lanes.as_ptr()) }
        fn store(a: Self) -> [f64; 2] {
            let mut lanes = [0.0; 2];
            _mm_storeu_pd(lanes.as_mut_ptr(), a);
            lanes
        }
        fn add(a: Self, b: Self) -> Self { _mm_add_pd(a, b) }
        fn sub(a: Self, b: Self) -> Self { _mm_sub_pd(a, b) }
        fn mul(a: Self, b: Self) -> Self { _mm_mul_pd(a, b) }
        fn div(a: Self, b: Self) -> Self { _mm_div_pd(a, b) }
        fn fma(a: Self, b: Self, c: Self) -> Self { _mm_add_pd(_mm_mul_pd(a, b), c) }
        fn sqrt(a: Self) -> Self { _mm_sqrt_pd(a) }
        fn and(a: Self, b: Self) -> Self { _mm_and_pd(a, b) }
        fn or(a: Self, b: Self) -> Self { _mm_or_pd(a, b) }
        fn xor(a: Self, b: Self) -> Self { _mm_xor_pd(a, b) }
        fn plus(a: Self, b: Self) -> Self {
            _mm_castsi128_pd(_mm_add_epi64(_mm_castpd_si128(a), _mm_castpd_si128(b)))
        }
        fn minus(a: Self, b: Self) -> Self {
            _mm_castsi128_pd(_mm_sub_epi64(_mm_castpd_si128(a), _mm_castpd_si128(b)))
        }
        fn shl<const K: u32>(a: Self) -> Self {
            _mm_castsi128_pd(_mm_sll_epi64(_mm_castpd_si128(a), _mm_cvtsi32_si128(K as i32)))
        }
        fn shr<const K: u32>(a: Self) -> Self {
            _mm_castsi128_pd(_mm_srl_epi64(_mm_castpd_si128(a), _mm_cvtsi32_si128(K as i32)))
        }
        fn odd(a: Self) -> __m128d {
            // Two halves a lane: the lower one of each, twice, its lowest bit moved to the top and
            // spread from there.
            let lower = _mm_shuffle_epi32::<0b10_10_00_00>(_mm_castpd_si128(a));
            _mm_castsi128_pd(_mm_srai_epi32::<31>(_mm_slli_epi32::<31>(lower)))
        }
        fn lt(a: Self, b: Self) -> __m128d { _mm_cmplt_pd(a, b) }
        fn le(a: Self, b: Self) -> __m128d { _mm_cmple_pd(a, b) }
        fn equals(a: Self, b: Self) -> __m128d { _mm_cmpeq_pd(a, b) }
        fn select(flags: __m128d, yes: Self, no: Self) -> Self {
            _mm_or_pd(_mm_and_pd(flags, yes), _mm_andnot_pd(flags, no))
        }
        fn flags(flag: bool) -> __m128d {
            _mm_castsi128_pd(_mm_set1_epi64x(if flag { -1 } else { 0 }))
        }
        fn both_flags(a: __m128d, b: __m128d) -> __m128d { _mm_and_pd(a, b) }
        fn either_flag(a: __m128d, b: __m128d) -> __m128d { _mm_or_pd(a, b) }
        fn not(a: __m128d) -> __m128d { _mm_xor_pd(a, _mm_castsi128_pd(_mm_set1_epi64x(-1))) }
        fn bits(a: __m128d) -> u32 { _mm_movemask_pd(a) as u32 }
    }
}
