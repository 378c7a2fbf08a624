//! Sweeps into Zarr stores.
//!
//! Input: members with their starts, the name of a scheme, names of columns. Output: a store on the disk. Invariant: Ctrl-C
//! leaves the chunks that are done, from which the next call continues.

use crate::chaos::watched;
use crate::errors;
use crate::signals::Signals;
use crate::swarm::Members;
use hamiltonian_runtime::{NamedSweep, RunError};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Runs members to the time `end`, or to the last of `times`, and writes the columns.
#[pyfunction]
#[pyo3(signature = (members, q, p, t, scheme, step, end, times, columns, path, threads, progress=None))]
#[allow(clippy::too_many_arguments)]
pub fn sweep(
    py: Python<'_>,
    members: &Bound<'_, Members>,
    q: PyReadonlyArray2<'_, f64>,
    p: PyReadonlyArray2<'_, f64>,
    t: f64,
    scheme: &str,
    step: f64,
    end: f64,
    times: Option<PyReadonlyArray1<'_, f64>>,
    columns: Vec<String>,
    path: PathBuf,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<()> {
    let own = members.get();
    let (q, p) = (own.read(&q)?, own.read(&p)?);
    let times = times.map(|times| times.as_slice().map(<[f64]>::to_vec));
    let times = times.transpose()?;
    let signals = Signals::default();
    let compute = |cancel: &AtomicBool| {
        let mut sweep = NamedSweep::new(&own.systems, scheme, &q, &p, t, step)
            .record(columns)
            .with_end(end)
            .with_cancel(cancel);
        if let Some(times) = times {
            sweep = sweep.at(times);
        }
        if let Some(threads) = threads {
            sweep = sweep.with_threads(threads);
        }
        if let Some(progress) = progress {
            let signals = signals.clone();
            sweep = sweep.with_progress(move |made, _| {
                let shown = Python::attach(|py| progress.call1(py, (made,)).map(|_| ()));
                shown.unwrap_or_else(|error| signals.keep(error));
            });
        }
        sweep.store(path)
    };
    let made = py.detach(|| watched(compute, signals.hook()));
    if let Some(error) = signals.take() {
        return Err(error);
    }
    let none = || PyRuntimeError::new_err("the computation ended without a result");
    let made: Result<_, RunError> = made.ok_or_else(none)?;
    made.map(|_| ()).map_err(|error| errors::of_run(py, &error))
}
