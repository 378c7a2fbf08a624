//! Elementary functions of `f64` and packs: errors against double-double, the same bits in lanes,
//! special values, symmetries, monotony.
//!
//! `HAMILTONIAN_HEAVY=1` measures 10⁷ points a function instead of 5·10⁴, and prints the table that
//! the documentation of `Real` holds with `--nocapture`.

mod accuracy;
mod bits;
mod points;
mod shape;
mod special;
mod subnormal;
mod whole;
