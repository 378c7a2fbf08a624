//! The extension module `_hamiltonian` of the Python package `hamiltonian`.
//!
//! Input: arrays of `float64` whose shapes the Python code has checked. Output: arrays. Invariant: a mistake of the user
//! is an exception with the text of the Rust error. A long computation releases the interpreter's lock.

mod chaos;
mod definition;
mod errors;
mod function;
mod layout;
mod run;
mod signals;
mod swarm;
mod sweep;
mod system;

use pyo3::prelude::*;

#[pymodule]
fn _hamiltonian(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<definition::Definition>()?;
    module.add_class::<function::Function>()?;
    module.add_class::<system::System>()?;
    module.add_class::<run::Run>()?;
    module.add_class::<swarm::Members>()?;
    module.add_class::<swarm::Swarm>()?;
    module.add_function(wrap_pyfunction!(chaos::derivative, module)?)?;
    module.add_function(wrap_pyfunction!(chaos::indicators, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep, module)?)?;
    module.add_function(wrap_pyfunction!(schemes, module)?)?;
    module.add_function(wrap_pyfunction!(command, module)?)?;
    Ok(())
}

/// The name, the order and the source of each scheme, and whether ensembles have it.
#[pyfunction]
fn schemes() -> Vec<(String, u32, &'static str, bool)> {
    let all = hamiltonian_runtime::schemes();
    all.map(|one| {
        (
            one.name,
            one.entry.order,
            one.entry.source,
            one.in_ensembles,
        )
    })
    .collect()
}

/// Runs the command `hamiltonian-run` with these arguments; returns its error.
#[pyfunction]
fn command(py: Python<'_>, arguments: Vec<String>) -> Option<String> {
    py.detach(|| hamiltonian_runtime::command(&arguments).err())
}
