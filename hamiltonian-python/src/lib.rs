//! The extension module `_hamiltonian` of the Python package `hamiltonian`.
//!
//! Input: arrays of `float64` whose shapes the Python code has checked. Output: arrays. Invariant: a mistake of the user
//! is an exception with the text of the Rust error. A long computation releases the interpreter's lock.

mod definition;
mod errors;
mod layout;
mod system;

use pyo3::prelude::*;

#[pymodule]
fn _hamiltonian(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<definition::Definition>()?;
    module.add_class::<system::System>()?;
    Ok(())
}
