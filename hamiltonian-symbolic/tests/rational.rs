//! Rational numbers: reading, rounding, order, printing.

use hamiltonian_symbolic::rational::Rational;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

#[test]
fn decimals_are_exact_and_round_once() {
    let [tenth, fifth, rest] = ["0.1", "0.2", "0.3"].map(|text| Rational::decimal(text).unwrap());
    assert!(tenth.add(&fifth).sub(&rest).is_zero());
    for text in [
        "0.1",
        "9.81",
        "1e-300",
        "4.9e-324",
        "2.2250738585072011e-308",
        "1.7976931348623157e308",
        "123456789012345678901234567890",
        "3e-324",
        "2e-324",
    ] {
        let value = Rational::decimal(text).unwrap();
        assert_eq!(value.to_f64(), text.parse::<f64>().unwrap(), "{text}");
    }
    assert_eq!(Rational::decimal("1e400").unwrap().to_f64(), f64::INFINITY);
    for text in [
        "",
        ".5",
        "1e",
        "-1",
        "0x1f",
        "1f64",
        "1_0",
        "1e1234567890123456789",
    ] {
        assert_eq!(Rational::decimal(text), None, "{text}");
    }
}

#[test]
fn two_words_hold_more_than_a_hundred_bits() {
    let third = Rational::new(1, 3);
    let (hi, lo) = third.to_words();
    let error = BigRational::from_float(hi).unwrap() + BigRational::from_float(lo).unwrap()
        - BigRational::new(1.into(), 3.into());
    assert!(error.abs() < BigRational::new(1.into(), BigInt::one() << 107));
    assert_ne!(lo, 0.0);
}

#[test]
fn large_values_leave_and_reenter_the_small_form() {
    let big = Rational::integer(i64::MAX).mul(&Rational::integer(i64::MAX));
    assert!(big.to_small().is_none());
    let back = big.mul(&Rational::integer(i64::MAX).recip().unwrap());
    assert_eq!(back, Rational::integer(i64::MAX));
    assert_eq!(Rational::new(4, 9).sqrt(), Some(Rational::new(2, 3)));
    assert_eq!(Rational::new(2, 9).sqrt(), None);
    assert_eq!(Rational::new(-3, 2).pow(-3), Some(Rational::new(-8, 27)));
}

#[test]
fn order_is_by_value() {
    assert!(Rational::new(1, 3) < Rational::new(1, 2));
    assert!(Rational::integer(32) > Rational::new(981, 100));
    assert!(Rational::new(-5, 1) < Rational::new(-7, 4));
    let big = Rational::integer(i64::MAX).mul(&Rational::integer(2));
    assert!(big > Rational::integer(5) && big.neg() < Rational::integer(-5));
}

#[test]
fn text_is_decimal_where_it_ends() {
    assert_eq!(Rational::new(1, 2).to_text(), "0.5");
    assert_eq!(Rational::new(-7, 4).to_text(), "-1.75");
    assert_eq!(Rational::new(1, 3).to_text(), "1/3");
}
