//! `f64` and `f32` as scalars: the right function behind every name, masks, lifting.

use hamiltonian_lanes::{DoubleDouble, Mask, Real};

/// Every function of the trait at a point in (0, 1), which is inside all domains; acosh beyond 2.
fn functions<T: Real>(x: T) -> Vec<T> {
    let other = T::constant(0.75, 0.0);
    vec![
        x.sqrt(),
        x.cbrt(),
        (-x).abs(),
        (-x).sign(),
        x.sin(),
        x.cos(),
        x.tan(),
        x.asin(),
        x.acos(),
        x.atan(),
        x.sinh(),
        x.cosh(),
        x.tanh(),
        x.asinh(),
        (T::constant(2.0, 0.0) + x).acosh(),
        x.atanh(),
        x.exp(),
        x.exp_m1(),
        x.ln(),
        x.ln_1p(),
        x.sin_cos().0,
        x.sin_cos().1,
        x.atan2(other),
        x.hypot(other),
        x.pow(other),
        x.min(other),
        x.max(other),
        x.recip(),
        x.fma(other, x),
        x.mul_absorbing(other),
    ]
}

/// The largest relative error of `T`'s functions, in units of its epsilon.
fn worst_error<T: Real>() -> f64 {
    let mut worst = 0.0f64;
    for i in 1..200u16 {
        // Exact in every scalar, down to 1e-9.
        let x = (f32::from(i) / 200.0).powi(if i % 3 == 0 { 4 } else { 1 });
        let reference = functions(DoubleDouble::lift(x));
        for (computed, expected) in functions(T::lift(x)).into_iter().zip(reference) {
            let error = DoubleDouble::from(computed.to_f64()) / expected - DoubleDouble::one();
            worst = worst.max(error.magnitude() / T::epsilon());
        }
    }
    worst
}

#[test]
fn f64_functions_are_within_two_units() {
    let worst = worst_error::<f64>();
    println!("{worst}");
    assert!(worst > 0.0 && worst < 2.0, "{worst}");
}

#[test]
fn f32_functions_are_within_two_units() {
    let worst = worst_error::<f32>();
    println!("{worst}");
    assert!(worst > 0.0 && worst < 2.0, "{worst}");
}

#[test]
fn inverse_hyperbolic_functions_are_accurate_near_their_zeros() {
    for x in [1e-3, 1e-6, 1e-9, 1e-12] {
        let near_one = Real::acosh(1.0 + x);
        let exact = DoubleDouble::from(1.0 + x).acosh().to_f64();
        assert!((near_one / exact - 1.0).abs() < 1e-15, "acosh(1 + {x})");
        assert!((Real::atanh(x) / DoubleDouble::from(x).atanh().to_f64() - 1.0).abs() < 1e-15);
        assert!((Real::asinh(x) / DoubleDouble::from(x).asinh().to_f64() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn f64_is_not_fused() {
    // Fused, (1 + ε)(1 − ε) − 1 is −ε²; rounded after the product it is 0.
    let (a, b) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
    assert_eq!(a.fma(b, -1.0), 0.0);
    let (a, b) = (1.0 + f32::EPSILON, 1.0 - f32::EPSILON);
    assert_eq!(a.fma(b, -1.0), 0.0);
}

#[test]
fn signs_and_zeros() {
    fn check<T: Real>() {
        let (one, zero) = (T::one(), T::zero());
        assert_eq!(
            [one.sign(), (-one - one).sign(), zero.sign()],
            [one, -one, zero]
        );
        let nan = zero / zero;
        assert!(nan.sign().magnitude().is_nan());
        assert_eq!((-zero).abs(), zero);
        assert!(!nan.is_finite() && !(one / zero).is_finite() && one.is_finite());
        assert!(nan.magnitude().is_nan());
        assert_eq!((-one - one).magnitude(), 2.0);
        assert_eq!(T::default(), zero);
        assert_eq!((one / zero).mul_absorbing(zero), zero);
        assert!((one / zero).mul_absorbing(nan).magnitude().is_nan());
    }
    check::<f64>();
    check::<f32>();
    check::<DoubleDouble>();
    assert!(f64::constant(-0.0, 0.0).is_sign_negative());
    assert!((-0.0f64).sqrt().is_sign_negative());
}

#[test]
fn extremes_return_nan_and_the_first_of_equals() {
    fn check<T: Real>() {
        let (one, two) = (T::one(), T::one() + T::one());
        let nan = T::zero() / T::zero();
        assert_eq!([one.min(two), two.min(one)], [one, one]);
        assert_eq!([one.max(two), two.max(one)], [two, two]);
        for value in [one.min(nan), nan.min(one), one.max(nan), nan.max(one)] {
            assert!(value.magnitude().is_nan());
        }
    }
    check::<f64>();
    check::<f32>();
    check::<DoubleDouble>();
    // Zeros are equal: the first is returned, whatever its sign.
    assert!(Real::min(-0.0f64, 0.0).is_sign_negative());
    assert!(Real::min(0.0f64, -0.0).is_sign_positive());
}

#[test]
fn masks_of_scalars_are_flags() {
    assert!(bool::splat(true).all() && bool::splat(true).any());
    assert!(!bool::splat(false).all() && !bool::splat(false).any());
    let [one, two] = [1.0f64, 2.0];
    let mask = Real::lt(one, two) & !Real::le(two, one) | one.equals(two);
    assert_eq!(f64::select(mask, 1.0, f64::NAN), 1.0);
    assert_eq!(f64::select(!mask, f64::NAN, 1.0), 1.0);
    let nan = f64::NAN;
    assert!(!(Real::lt(nan, nan) || Real::le(nan, nan) || nan.equals(nan)));
}

#[test]
fn values_lift_without_loss_where_they_fit() {
    assert_eq!(f64::lift(0.1f32), f64::from(0.1f32));
    assert_eq!(f32::lift(0.1f64), 0.1f32);
    assert_eq!(f64::lift(-3i32), -3.0);
    assert_eq!(f32::lift(16_777_217u32), 16_777_216.0);
    assert_eq!(f64::lift(usize::MAX), 2f64.powi(64));
    let exact = DoubleDouble::lift(u64::MAX);
    assert_eq!((exact.hi(), exact.lo()), (2f64.powi(64), -1.0));
    assert_eq!(DoubleDouble::lift(exact), exact);
    assert_eq!(DoubleDouble::lift(i64::MIN).to_f64(), -2f64.powi(63));
    assert_eq!(f64::constant(1.0, f64::EPSILON), 1.0 + f64::EPSILON);
    assert_eq!(f32::constant(0.1, 0.0), 0.1f32);
}

/// A scalar is one lane: lane 0 is the value, there is no other.
fn one_lane<T: Real>() {
    let x = T::lift(-2.5f32);
    assert_eq!(T::LANES, 1);
    assert_eq!(
        (x.lane(0), x.to_f64(), x.size().to_f64()),
        (-2.5, -2.5, 2.5)
    );
    assert!(x.lane(1).is_nan());
    assert!(x.finite().lane(0) && !x.finite().lane(1));
    let pole = x / T::zero();
    assert!(!pole.is_finite() && !pole.finite().any());
    assert_eq!((!pole.finite()).first(), Some(0));
    assert_eq!(pole.finite().first(), None);
    assert!((pole * T::zero()).size().to_f64().is_nan());
}

#[test]
fn scalars_are_one_lane() {
    one_lane::<f64>();
    one_lane::<f32>();
    one_lane::<DoubleDouble>();
}
