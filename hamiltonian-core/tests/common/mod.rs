//! What the tests share: systems written by hand, a reference solution, and the checks
//! themselves, which are generic over system and scheme.
#![allow(dead_code)]

pub mod checks;
pub mod reference;
pub mod systems;

/// Whether `value` rounds to `quoted`, a number given to so many significant digits.
#[track_caller]
pub fn assert_digits(what: &str, value: f64, quoted: f64, digits: i32) {
    let unit = 10f64.powi(quoted.abs().log10().floor() as i32 - digits + 1);
    // Half a unit for the rounding of the quoted number, and no more.
    assert!(
        (value - quoted).abs() <= 0.5 * unit,
        "{what}: {value:e}, quoted {quoted:e}"
    );
}
