//! A library that hands this one on.

pub use mechanics;

/// Under another path.
pub mod dynamics {
    pub use mechanics::hamiltonian as system;
    pub use mechanics::prelude;
}

/// As part of a macro of its own.
#[macro_export]
macro_rules! oscillator {
    ($visibility:vis $name:ident, $k:literal, $potential:expr) => {
        $crate::mechanics::hamiltonian! {
            /// An oscillator.
            $visibility struct $name { k = $k }
            H = p^2/2 + k*q^2/2 + $potential
        }
    };
}
