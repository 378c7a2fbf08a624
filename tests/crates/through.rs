//! A crate that knows the library only through another one.

#![deny(warnings, missing_docs)]

use facade::dynamics::prelude::*;

facade::dynamics::system! {
    /// Under another name.
    pub struct Renamed { k = 1.0 }
    H = p^2/2 + k*q^2/2
}

facade::oscillator!(pub Made, 2.0, q^4/4 + 1);

/// A value.
#[must_use]
pub fn value() -> f64 {
    let value = facade::mechanics::hamiltonian! { H = p^2/2 + q^2/2 };
    let state = State::new([1.0], [0.0]);
    value.energy(&state) + Renamed::default().energy(&state) + Made::default().energy(&state)
}
