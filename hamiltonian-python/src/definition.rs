//! Definitions: texts that are read once, and made systems with any values.
//!
//! Input: a text. Output: [`Definition`], or the exception with the diagnostics.

use crate::errors;
use crate::function::Function;
use crate::system::System;
use hamiltonian_runtime as runtime;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::Arc;

/// The stack of the thread that reads a text: the parser recurses to depth 128.
const STACK: usize = 16 << 20;

/// A text that was read, with everything proven of it.
#[pyclass(frozen, module = "hamiltonian._hamiltonian")]
pub struct Definition {
    read: Arc<runtime::Definition>,
    text: String,
}

/// A number, the elements of an array row after row, or a function.
#[derive(FromPyObject)]
pub enum Value<'py> {
    Number(f64),
    List(PyReadonlyArray1<'py, f64>),
    Function(Py<Function>),
}

#[pymethods]
impl Definition {
    /// Reads a text. `source` is its name in errors.
    #[new]
    fn new(py: Python<'_>, text: String, source: String) -> PyResult<Self> {
        // Parsed text stays in the memory of its thread, so a thread of its own gives it back.
        let (sent, name) = (text.clone(), source);
        let thread = std::thread::Builder::new().stack_size(STACK);
        let read = py.detach(|| {
            let parse = move || runtime::Definition::parse(&sent, &name);
            thread.spawn(parse).map(std::thread::JoinHandle::join)
        });
        let read = read.map_err(|error| errors::of_thread(&error))?;
        let read = read.map_err(|_| PyRuntimeError::new_err("the text cannot be read"))?;
        let read = read.map_err(|diagnostics| errors::of_text(py, &diagnostics))?;
        let read = Arc::new(read);
        Ok(Definition { read, text })
    }

    /// The name of the struct; `H` of a definition without one.
    #[getter]
    fn name(&self) -> &str {
        self.read.name()
    }

    /// The names of the sizes.
    #[getter]
    fn sizes(&self) -> Vec<&str> {
        self.read.sizes().collect()
    }

    /// The names of the parameters.
    #[getter]
    fn parameters(&self) -> Vec<&str> {
        self.read.parameters().collect()
    }

    /// The names of the functions with data.
    #[getter]
    fn functions(&self) -> Vec<&str> {
        self.read.functions().collect()
    }

    /// The proven properties of H, a sentence each.
    #[getter]
    fn facts(&self) -> Vec<&str> {
        self.read.facts().collect()
    }

    /// H in LaTeX.
    #[getter]
    fn latex(&self) -> &str {
        self.read.latex()
    }

    /// H in the author's notation.
    #[getter]
    fn formula(&self) -> String {
        self.read.to_string()
    }

    /// The system with these values of its parameters and sizes.
    fn system(&self, py: Python<'_>, values: Vec<(String, Value<'_>)>) -> PyResult<System> {
        Ok(System::new(self.made(py, self::values(&values)?)?))
    }
}

impl Definition {
    pub fn made(
        &self,
        py: Python<'_>,
        values: runtime::Values,
    ) -> PyResult<runtime::RuntimeSystem> {
        let made = py.detach(|| self.read.system(values));
        made.map_err(|error| errors::of_values(py, &error, &self.text))
    }
}

/// The values of a system.
pub fn values(all: &[(String, Value<'_>)]) -> PyResult<runtime::Values> {
    let mut values = runtime::Values::new();
    for (name, value) in all {
        values = match value {
            Value::Number(number) => values.with(name, *number),
            Value::List(list) => values.with(name, list.as_slice()?),
            Value::Function(function) => values.with(name, function.get().own.clone()),
        };
    }
    Ok(values)
}
