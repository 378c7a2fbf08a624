//! Errors of Rust as exceptions of Python.
//!
//! Input: the errors of hamiltonian-runtime. Output: exceptions with the same text.

use hamiltonian_core::Error;
use hamiltonian_runtime::{Diagnostic, Diagnostics, RunError, SystemError};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::{MutexGuard, TryLockError, TryLockResult};

/// The arguments of `hamiltonian.errors.Diagnostic`: message, help, source, line, column, the line of the text.
type Fields = (String, String, String, usize, usize, String);

/// `hamiltonian.DefinitionError` with its diagnostics.
fn definition_error(py: Python<'_>, list: Vec<Fields>, shown: String) -> PyErr {
    let make = || {
        let class = py
            .import("hamiltonian.errors")?
            .getattr("DefinitionError")?;
        class.call1((list, shown))
    };
    match make() {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

fn fields(one: &Diagnostic) -> Fields {
    let place = &one.place;
    (
        one.message.clone(),
        one.help.clone(),
        place.source.clone(),
        place.line,
        place.column,
        one.text.clone(),
    )
}

/// The exception for a text that is no definition.
pub fn of_text(py: Python<'_>, errors: &Diagnostics) -> PyErr {
    let list = errors.list().iter().map(fields).collect();
    definition_error(py, list, errors.to_string())
}

/// The exception for values of which no system is made. `text` is that of the definition.
pub fn of_values(py: Python<'_>, error: &SystemError, text: &str) -> PyErr {
    let shown = error.to_string();
    match error {
        SystemError::NotCarried { feature, place, .. } => {
            let line = text.lines().nth(place.line - 1).unwrap_or_default();
            let message = format!("{feature}: definitions at run time do not have this");
            let help = "compile the definition in Rust, with `hamiltonian!`".to_owned();
            let source = place.source.clone();
            let one = (
                message,
                help,
                source,
                place.line,
                place.column,
                line.to_owned(),
            );
            definition_error(py, vec![one], shown)
        }
        SystemError::Unknown { .. } | SystemError::NoValue { .. } => PyTypeError::new_err(shown),
        _ => PyValueError::new_err(shown),
    }
}

/// The exception for a run that is refused or fails. A mistake of the caller is a `ValueError`.
pub fn of_run(py: Python<'_>, error: &RunError) -> PyErr {
    let shown = error.to_string();
    match error {
        RunError::Run(Error::Start(_) | Error::Input(_) | Error::Time(_)) => {
            PyValueError::new_err(shown)
        }
        RunError::Run(_) => {
            let make = || {
                py.import("hamiltonian.errors")?
                    .getattr("RunError")?
                    .call1((shown,))
            };
            make().map_or_else(|error| error, PyErr::from_value)
        }
        _ => PyValueError::new_err(shown),
    }
}

/// What a lock guards, or the exception for a run that another thread advances.
pub fn unused<'a, T>(lock: TryLockResult<MutexGuard<'a, T>>) -> PyResult<MutexGuard<'a, T>> {
    match lock {
        Ok(own) => Ok(own),
        Err(TryLockError::Poisoned(own)) => Ok(own.into_inner()),
        Err(TryLockError::WouldBlock) => {
            let text = "another thread advances this run or ensemble: make one for each thread";
            Err(PyRuntimeError::new_err(text))
        }
    }
}

/// The exception for a thread that the operating system does not start.
pub fn of_thread(error: &std::io::Error) -> PyErr {
    PyRuntimeError::new_err(format!("a thread for the text cannot be started: {error}"))
}
