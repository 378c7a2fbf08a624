//! Single runs.
//!
//! Input: a start, the name of a scheme or a tolerance, times. Output: states, one a row, and crossings of events.

use crate::errors;
use crate::signals::Signals;
use crate::system::System;
use hamiltonian_core::State;
use hamiltonian_core::nalgebra::DVector;
use hamiltonian_core::schemes::Tolerance;
use hamiltonian_runtime::{FlatState, RunError};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::{Mutex, MutexGuard};

/// Times, coordinates and momenta, one state a row.
pub type States<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

/// One trajectory.
#[pyclass(frozen, module = "hamiltonian._hamiltonian")]
pub struct Run {
    run: Mutex<hamiltonian_runtime::Run>,
    system: Py<System>,
    signals: Signals,
}

impl Run {
    fn new(run: hamiltonian_runtime::Run, system: Py<System>) -> Self {
        let signals = Signals::default();
        Run {
            run: Mutex::new(run.with_cancel(signals.hook())),
            system,
            signals,
        }
    }

    /// The run. It does not wait for another thread, which may wait for the lock of the interpreter.
    fn own(&self) -> PyResult<MutexGuard<'_, hamiltonian_runtime::Run>> {
        errors::unused(self.run.try_lock())
    }

    /// The exception for an error of the run.
    fn error(&self, py: Python<'_>, error: &RunError) -> PyErr {
        let signal = matches!(error, RunError::Interrupted).then(|| self.signals.take());
        signal
            .flatten()
            .unwrap_or_else(|| errors::of_run(py, error))
    }
}

/// The states as arrays in the order of Python.
fn rows<'a, 'py>(
    py: Python<'py>,
    system: &System,
    states: impl ExactSizeIterator<Item = &'a FlatState>,
) -> PyResult<States<'py>> {
    let (count, len) = (states.len(), system.layout.len());
    let mut t = Vec::with_capacity(count);
    let mut all = [(); 2].map(|()| vec![0.0; count * len]);
    for (row, state) in states.enumerate() {
        t.push(state.t);
        for (into, from) in all.iter_mut().zip([&state.q, &state.p]) {
            let into = &mut into[row * len..][..len];
            system.layout.write(from.as_slice(), into);
        }
    }
    let [q, p] = all.map(|all| all.into_pyarray(py).reshape([count, len]));
    Ok((t.into_pyarray(py), q?, p?))
}

/// A state of the system from arrays in the order of Python.
pub fn state(
    system: &System,
    q: &PyReadonlyArray1<'_, f64>,
    p: &PyReadonlyArray1<'_, f64>,
    t: f64,
) -> PyResult<FlatState> {
    let vector = |from: &PyReadonlyArray1<'_, f64>| -> PyResult<DVector<f64>> {
        let mut into = DVector::zeros(system.layout.len());
        system.layout.read(from.as_slice()?, into.as_mut_slice());
        Ok(into)
    };
    let (q, p) = (vector(q)?, vector(p)?);
    Ok(State { t, q, p })
}

#[pymethods]
impl Run {
    /// A run of the scheme of this name with fixed steps.
    #[staticmethod]
    fn by_scheme(
        py: Python<'_>,
        system: Py<System>,
        q: PyReadonlyArray1<'_, f64>,
        p: PyReadonlyArray1<'_, f64>,
        t: f64,
        scheme: &str,
        step: f64,
    ) -> PyResult<Run> {
        let own = system.get();
        let start = state(own, &q, &p, t)?;
        let made = py.detach(|| hamiltonian_runtime::Run::new(&own.system, scheme, start, step));
        let run = made.map_err(|error| errors::of_run(py, &error))?;
        Ok(Run::new(run, system))
    }

    /// A run with steps from a tolerance, relative and absolute.
    #[staticmethod]
    fn to_tolerance(
        py: Python<'_>,
        system: Py<System>,
        q: PyReadonlyArray1<'_, f64>,
        p: PyReadonlyArray1<'_, f64>,
        t: f64,
        relative: f64,
        absolute: f64,
    ) -> PyResult<Run> {
        let own = system.get();
        let start = state(own, &q, &p, t)?;
        let tolerance = Tolerance { relative, absolute };
        let made =
            py.detach(|| hamiltonian_runtime::Run::to_tolerance(&own.system, start, tolerance));
        let run = made.map_err(|error| errors::of_run(py, &error))?;
        Ok(Run::new(run, system))
    }

    /// A saved run.
    #[staticmethod]
    fn resume(py: Python<'_>, system: Py<System>, bytes: &[u8]) -> PyResult<Run> {
        let made = hamiltonian_runtime::Run::resume(&system.get().system, bytes);
        let run = made.map_err(|error| errors::of_run(py, &error))?;
        Ok(Run::new(run, system))
    }

    /// The run as bytes.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.own()?.save()))
    }

    fn advance(&self, py: Python<'_>, steps: u64) -> PyResult<()> {
        let mut own = self.own()?;
        let run = &mut *own;
        let made = py.detach(|| run.advance(steps));
        made.map_err(|error| self.error(py, &error))
    }

    fn advance_to(&self, py: Python<'_>, t: f64) -> PyResult<()> {
        let mut own = self.own()?;
        let run = &mut *own;
        let made = py.detach(|| run.advance_to(t));
        made.map_err(|error| self.error(py, &error))
    }

    /// The states at the times; with fewer rows, also the exception that ended the run.
    fn states_at<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<(States<'py>, Option<PyErr>)> {
        let mut own = self.own()?;
        let (run, times) = (&mut *own, times.as_slice()?);
        let (states, made) = py.detach(|| run.states_at(times));
        let error = made.err().map(|error| self.error(py, &error));
        Ok((rows(py, self.system.get(), states.iter())?, error))
    }

    /// The current state.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<States<'py>> {
        rows(py, self.system.get(), std::iter::once(self.own()?.state()))
    }

    /// The crossings of events: the index of each among the events, whether it increases, its state.
    fn crossings<'py>(&self, py: Python<'py>) -> PyResult<(Vec<String>, Vec<bool>, States<'py>)> {
        let run = self.own()?;
        let all: Vec<_> = run.crossings().collect();
        let names = all.iter().map(|one| one.event.to_owned()).collect();
        let rising = all.iter().map(|one| one.rising).collect();
        let states = rows(py, self.system.get(), all.iter().map(|one| one.state))?;
        Ok((names, rising, states))
    }

    #[getter]
    fn t(&self) -> PyResult<f64> {
        Ok(self.own()?.t())
    }

    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.own()?.steps())
    }

    #[getter]
    fn step(&self) -> PyResult<f64> {
        Ok(self.own()?.step())
    }

    #[getter]
    fn refused_steps(&self) -> PyResult<u64> {
        Ok(self.own()?.refused_steps())
    }

    #[getter]
    fn energy(&self) -> PyResult<f64> {
        Ok(self.own()?.energy())
    }

    /// The name of the scheme, its order and its source.
    #[getter]
    fn scheme(&self) -> PyResult<(String, u32, &'static str)> {
        let entry = self.own()?.entry();
        Ok((entry.to_string(), entry.order, entry.source))
    }

    fn observable(&self, name: &str) -> PyResult<Option<f64>> {
        Ok(self.own()?.observable(name))
    }
}
