//! Ensembles.
//!
//! Input: starts, one a row, and the parameters of members. Output: their states, and their indicators of chaos.

use crate::definition::Definition;
use crate::errors;
use crate::signals::Signals;
use crate::system::System;
use hamiltonian_core::System as _;
use hamiltonian_core::nalgebra::DVector;
use hamiltonian_core::private::declared_energy_at;
use hamiltonian_runtime::{RunError, RuntimeSystem};
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::{Mutex, MutexGuard};

/// The systems of all members: one, or one for each.
#[pyclass(frozen, module = "hamiltonian._hamiltonian")]
pub struct Members {
    pub systems: Vec<RuntimeSystem>,
    pub first: Py<System>,
}

#[pymethods]
impl Members {
    /// Members with the values of `system` and those of `own`, one row a member.
    #[new]
    fn new(
        py: Python<'_>,
        definition: &Definition,
        system: Py<System>,
        values: Vec<(String, crate::definition::Value<'_>)>,
        own: Vec<(String, bool, PyReadonlyArray2<'_, f64>)>,
    ) -> PyResult<Members> {
        let systems = match own.first() {
            None => vec![system.get().system.clone()],
            Some((_, _, first)) => {
                let base = crate::definition::values(&values)?;
                let mut systems = Vec::with_capacity(first.shape()[0]);
                for member in 0..first.shape()[0] {
                    let mut all = base.clone();
                    for (name, is_number, rows) in &own {
                        let width = rows.shape()[1];
                        let row = &rows.as_slice()?[member * width..][..width];
                        all = match is_number {
                            true => all.with(name, row[0]),
                            false => all.with(name, row),
                        };
                    }
                    systems.push(definition.made(py, all)?);
                }
                systems
            }
        };
        let first = system;
        Ok(Members { systems, first })
    }

    /// H of each member at its state.
    fn energy<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<'_, f64>,
        p: PyReadonlyArray2<'_, f64>,
        t: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (q, p, t) = (q.as_slice()?, p.as_slice()?, t.as_slice()?);
        let layout = &self.first.get().layout;
        let len = layout.len();
        let all = py.detach(|| {
            let mut point = [DVector::zeros(len), DVector::zeros(len)];
            let mut prepared = self.systems[0].prepare::<f64>();
            let one = |(member, t): (usize, &f64)| {
                for (into, from) in point.iter_mut().zip([q, p]) {
                    layout.read(&from[member * len..][..len], into.as_mut_slice());
                }
                if self.systems.len() > 1 {
                    prepared = self.systems[member].prepare();
                }
                declared_energy_at::<f64, RuntimeSystem>(&prepared, *t, &point[0], &point[1])
            };
            t.iter().enumerate().map(one).collect::<Vec<f64>>()
        });
        Ok(all.into_pyarray(py))
    }
}

impl Members {
    /// The points in the order of the systems.
    pub fn read(&self, rows: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<f64>> {
        let (layout, rows) = (&self.first.get().layout, rows.as_slice()?);
        let mut all = vec![0.0; rows.len()];
        let len = layout.len();
        for (into, from) in all.chunks_exact_mut(len).zip(rows.chunks_exact(len)) {
            layout.read(from, into);
        }
        Ok(all)
    }

    /// The points in the order of Python.
    fn write<'py>(&self, py: Python<'py>, rows: &[f64]) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let layout = &self.first.get().layout;
        let mut all = vec![0.0; rows.len()];
        let len = layout.len();
        for (into, from) in all.chunks_exact_mut(len).zip(rows.chunks_exact(len)) {
            layout.write(from, into);
        }
        all.into_pyarray(py).reshape([rows.len() / len, len])
    }
}

/// Times, coordinates, momenta, and the errors of members that failed.
type States<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Vec<(usize, String)>,
);

/// Members of one definition that advance together.
#[pyclass(frozen, module = "hamiltonian._hamiltonian")]
pub struct Swarm {
    swarm: Mutex<hamiltonian_runtime::Swarm>,
    members: Py<Members>,
    signals: Signals,
}

impl Swarm {
    fn of(swarm: hamiltonian_runtime::Swarm, members: Py<Members>, threads: Option<usize>) -> Self {
        let swarm = match threads {
            Some(threads) => swarm.with_threads(threads),
            None => swarm,
        };
        let signals = Signals::default();
        Swarm {
            swarm: Mutex::new(swarm.with_cancel(signals.hook())),
            members,
            signals,
        }
    }

    fn own(&self) -> PyResult<MutexGuard<'_, hamiltonian_runtime::Swarm>> {
        errors::unused(self.swarm.try_lock())
    }

    fn error(&self, py: Python<'_>, error: &RunError) -> PyErr {
        let signal = matches!(error, RunError::Interrupted).then(|| self.signals.take());
        signal
            .flatten()
            .unwrap_or_else(|| errors::of_run(py, error))
    }

    fn shown<'py>(
        &self,
        py: Python<'py>,
        states: hamiltonian_runtime::MemberStates,
    ) -> PyResult<States<'py>> {
        let members = self.members.get();
        let errors = states.errors.iter();
        let errors = errors
            .map(|(member, error)| (*member, error.to_string()))
            .collect();
        let (q, p) = (members.write(py, &states.q)?, members.write(py, &states.p)?);
        Ok((states.t.into_pyarray(py), q, p, errors))
    }
}

#[pymethods]
impl Swarm {
    #[new]
    #[pyo3(signature = (members, q, p, t, scheme, step, threads))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        members: Py<Members>,
        q: PyReadonlyArray2<'_, f64>,
        p: PyReadonlyArray2<'_, f64>,
        t: f64,
        scheme: &str,
        step: f64,
        threads: Option<usize>,
    ) -> PyResult<Swarm> {
        let own = members.get();
        let (q, p) = (own.read(&q)?, own.read(&p)?);
        let made =
            py.detach(|| hamiltonian_runtime::Swarm::new(&own.systems, scheme, &q, &p, t, step));
        let swarm = made.map_err(|error| errors::of_run(py, &error))?;
        Ok(Swarm::of(swarm, members, threads))
    }

    /// Saved members, from their starts and the bytes.
    #[staticmethod]
    #[pyo3(signature = (members, q, p, t, bytes, threads))]
    fn resume(
        py: Python<'_>,
        members: Py<Members>,
        q: PyReadonlyArray2<'_, f64>,
        p: PyReadonlyArray2<'_, f64>,
        t: f64,
        bytes: &[u8],
        threads: Option<usize>,
    ) -> PyResult<Swarm> {
        let own = members.get();
        let (q, p) = (own.read(&q)?, own.read(&p)?);
        let made = py.detach(|| hamiltonian_runtime::Swarm::resume(&own.systems, &q, &p, t, bytes));
        let swarm = made.map_err(|error| errors::of_run(py, &error))?;
        Ok(Swarm::of(swarm, members, threads))
    }

    /// The members as bytes.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let mut own = self.own()?;
        let swarm = &mut *own;
        let bytes = py.detach(move || swarm.save());
        Ok(PyBytes::new(py, &bytes))
    }

    /// Makes steps, and calls `progress` with their number about ten times a second.
    #[pyo3(signature = (steps, progress=None))]
    fn advance(&self, py: Python<'_>, steps: u64, progress: Option<Py<PyAny>>) -> PyResult<()> {
        let mut own = self.own()?;
        let (swarm, signals) = (&mut *own, self.signals.clone());
        let made = py.detach(|| {
            swarm.advance_watched(steps, &mut |made| {
                if let Some(progress) = &progress {
                    let shown = Python::attach(|py| progress.call1(py, (made,)).map(|_| ()));
                    shown.unwrap_or_else(|error| signals.keep(error));
                }
            })
        });
        drop(own);
        made.map_err(|error| self.error(py, &error))?;
        // A callback may fail at the end.
        self.signals.take().map_or(Ok(()), Err)
    }

    /// Advances by the whole steps up to the time, and returns the states there.
    fn advance_until<'py>(&self, py: Python<'py>, t: f64) -> PyResult<States<'py>> {
        let mut own = self.own()?;
        let swarm = &mut *own;
        let made = py.detach(|| swarm.advance_until(t));
        drop(own);
        let states = made.map_err(|error| self.error(py, &error))?;
        self.shown(py, states)
    }

    fn states<'py>(&self, py: Python<'py>) -> PyResult<States<'py>> {
        let states = self.own()?.states();
        self.shown(py, states)
    }

    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.own()?.steps())
    }

    #[getter]
    fn t(&self) -> PyResult<f64> {
        Ok(self.own()?.t())
    }
}
