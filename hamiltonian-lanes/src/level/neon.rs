//! NEON: two lanes, on every aarch64, and one.
//!
//! Input: registers. Output: [`Register`] for `float64x2_t` and for [`One`]. Invariant: flags are
//! all bits of a lane or none; products with a sum are fused.

use core::arch::aarch64::*;

use super::portable::plain;
use super::register::{Register, intrinsics, out_of_line};

impl Register for float64x2_t {
    type Flags = uint64x2_t;
    type Array = [f64; 2];
    const LANES: u32 = 2;
    const FUSED: bool = true;

    out_of_line!();
    intrinsics! {
        fn splat(value: f64) -> Self { vdupq_n_f64(value) }
        fn load(lanes: &[f64; 2]) -> Self { vld1q_f64(lanes.as_ptr()) }
        fn store(a: Self) -> [f64; 2] {
            let mut lanes = [0.0; 2];
            vst1q_f64(lanes.as_mut_ptr(), a);
            lanes
        }
        fn add(a: Self, b: Self) -> Self { vaddq_f64(a, b) }
        fn sub(a: Self, b: Self) -> Self { vsubq_f64(a, b) }
        fn mul(a: Self, b: Self) -> Self { vmulq_f64(a, b) }
        fn div(a: Self, b: Self) -> Self { vdivq_f64(a, b) }
        fn fma(a: Self, b: Self, c: Self) -> Self { vfmaq_f64(c, a, b) }
        fn sqrt(a: Self) -> Self { vsqrtq_f64(a) }
        fn and(a: Self, b: Self) -> Self {
            vreinterpretq_f64_u64(vandq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))
        }
        fn or(a: Self, b: Self) -> Self {
            vreinterpretq_f64_u64(vorrq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))
        }
        fn xor(a: Self, b: Self) -> Self {
            vreinterpretq_f64_u64(veorq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))
        }
        fn plus(a: Self, b: Self) -> Self {
            vreinterpretq_f64_u64(vaddq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))
        }
        fn minus(a: Self, b: Self) -> Self {
            vreinterpretq_f64_u64(vsubq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))
        }
        fn shl<const K: u32>(a: Self) -> Self {
            vreinterpretq_f64_u64(vshlq_u64(vreinterpretq_u64_f64(a), vdupq_n_s64(i64::from(K))))
        }
        fn shr<const K: u32>(a: Self) -> Self {
            vreinterpretq_f64_u64(vshlq_u64(vreinterpretq_u64_f64(a), vdupq_n_s64(-i64::from(K))))
        }
        fn odd(a: Self) -> uint64x2_t { vtstq_u64(vreinterpretq_u64_f64(a), vdupq_n_u64(1)) }
        fn lt(a: Self, b: Self) -> uint64x2_t { vcltq_f64(a, b) }
        fn le(a: Self, b: Self) -> uint64x2_t { vcleq_f64(a, b) }
        fn equals(a: Self, b: Self) -> uint64x2_t { vceqq_f64(a, b) }
        fn select(flags: uint64x2_t, yes: Self, no: Self) -> Self { vbslq_f64(flags, yes, no) }
        fn flags(flag: bool) -> uint64x2_t { vdupq_n_u64(if flag { u64::MAX } else { 0 }) }
        fn both_flags(a: uint64x2_t, b: uint64x2_t) -> uint64x2_t { vandq_u64(a, b) }
        fn either_flag(a: uint64x2_t, b: uint64x2_t) -> uint64x2_t { vorrq_u64(a, b) }
        fn not(a: uint64x2_t) -> uint64x2_t { veorq_u64(a, vdupq_n_u64(u64::MAX)) }
        fn bits(a: uint64x2_t) -> u32 {
            let (first, second) = (vgetq_lane_u64::<0>(a), vgetq_lane_u64::<1>(a));
            (first & 1) as u32 | ((second & 1) << 1) as u32
        }
    }
}

/// One number, with fused products and sums.
#[derive(Clone, Copy)]
pub struct One([f64; 1]);

#[inline(always)]
fn once_rounded(a: f64, b: f64, c: f64) -> f64 {
    // SAFETY: every aarch64 program is compiled with NEON.
    #[allow(unused_unsafe)]
    unsafe {
        vget_lane_f64::<0>(vfma_f64(vdup_n_f64(c), vdup_n_f64(a), vdup_n_f64(b)))
    }
}

plain!(One, 1, fused: true, fma: once_rounded, features: [], 0);
