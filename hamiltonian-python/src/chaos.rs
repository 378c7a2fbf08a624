//! Derivatives of a trajectory with respect to its start, and indicators of chaos.
//!
//! Input: starts, one a row. Output: matrices, exponents, MEGNO. Invariant: all are exact derivatives of the numerical maps,
//! by dual numbers.

use crate::errors;
use crate::run;
use crate::swarm::Members;
use crate::system::System;
use hamiltonian_core::analysis::monodromy;
use hamiltonian_core::nalgebra::DMatrix;
use hamiltonian_core::schemes::{BlanesMoan4, Gauss, GaussNystrom};
use hamiltonian_core::{Error, Lyapunov, Member, Scheme, State};
use hamiltonian_runtime::{FlatState, RunError, RuntimeSystem};
use numpy::{
    IntoPyArray, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

/// The derivative of the state after the time `time` with respect to the start, in `steps` steps: coordinates, then momenta,
/// in the order of Python.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub fn derivative<'py>(
    py: Python<'py>,
    system: &Bound<'py, System>,
    q: PyReadonlyArray1<'_, f64>,
    p: PyReadonlyArray1<'_, f64>,
    t: f64,
    time: f64,
    steps: u64,
    nystrom: bool,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let own = system.get();
    let start = run::state(own, &q, &p, t)?;
    let of = &own.system;
    let made = py.detach(|| match nystrom {
        true => monodromy(of, GaussNystrom::<8>::default(), start, time, steps),
        false => monodromy(of, Gauss::<8>::default(), start, time, steps),
    });
    let matrix: DMatrix<f64> = made.map_err(|error| errors::of_run(py, &error.into()))?;
    let len = own.layout.len();
    // The place of each row and column in the order of Python.
    let mut places = vec![0.0; len];
    let all: Vec<f64> = (0..len).map(|at| at as f64).collect();
    own.layout.write(&all, &mut places);
    let place = |at: usize| places[at % len] as usize + at / len * len;
    let size = 2 * len;
    let numbers = (0..size).flat_map(|row| (0..size).map(move |column| (row, column)));
    let numbers: Vec<f64> = numbers
        .map(|(row, column)| matrix[(place(row), place(column))])
        .collect();
    numbers.into_pyarray(py).reshape([size, size])
}

/// The numbers that are computed for each member.
#[derive(Clone, Copy)]
enum Indicator {
    Exponents(usize),
    Megno,
}

/// A number or numbers of each member, or its error.
type Rows = Vec<Result<Vec<f64>, Error>>;

fn rows<M: Scheme<RuntimeSystem>>(
    scheme: M,
    make: impl Fn(Member) -> (RuntimeSystem, FlatState) + Send + Sync,
    count: usize,
    (step, steps, every): (f64, u64, u64),
    indicator: Indicator,
    cancel: &AtomicBool,
) -> Result<Rows, Error> {
    let all = Lyapunov::new(count, make, scheme, step)
        .with_steps(steps)
        .with_interval(every)
        .with_cancel(cancel)
        .reproducible();
    match indicator {
        Indicator::Exponents(deviations) => all.with_deviations(deviations).collect(),
        Indicator::Megno => {
            let numbers = all.megno()?.into_iter();
            Ok(numbers.map(|number| Ok(vec![number?])).collect())
        }
    }
}

/// Computes on another thread, and asks the hook meanwhile, which sets the flag.
fn watched<A: Send>(
    compute: impl FnOnce(&AtomicBool) -> A + Send,
    hook: impl Fn() -> bool,
) -> Option<A> {
    const PAUSE: Duration = Duration::from_millis(60);
    let cancel = AtomicBool::new(false);
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        let flag = &cancel;
        scope.spawn(move || sender.send(compute(flag)));
        loop {
            match receiver.recv_timeout(PAUSE) {
                Ok(made) => return Some(made),
                Err(RecvTimeoutError::Timeout) if hook() => cancel.store(true, Ordering::Relaxed),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return None,
            }
        }
    })
}

/// Lyapunov exponents of each member, as many as `deviations`; with 0, MEGNO.
#[pyfunction]
#[allow(clippy::too_many_arguments, clippy::type_complexity)]
pub fn indicators<'py>(
    py: Python<'py>,
    members: &Bound<'py, Members>,
    q: PyReadonlyArray2<'_, f64>,
    p: PyReadonlyArray2<'_, f64>,
    t: f64,
    splitting: bool,
    step: f64,
    steps: u64,
    every: u64,
    deviations: usize,
) -> PyResult<(Bound<'py, PyArray2<f64>>, Vec<(usize, String)>)> {
    let own = members.get();
    let count = q.shape()[0];
    let len = own.first.get().layout.len();
    let (q, p) = (own.read(&q)?, own.read(&p)?);
    let make = |member: Member| {
        let at = member.index * len..(member.index + 1) * len;
        let system = own.systems.get(member.index).unwrap_or(&own.systems[0]);
        let start = State::new(q[at.clone()].to_vec(), p[at].to_vec()).at(t);
        (system.clone(), start)
    };
    let indicator = match deviations {
        0 => Indicator::Megno,
        some => Indicator::Exponents(some),
    };
    let signals = crate::signals::Signals::default();
    let steps = (step, steps, every);
    let compute = |cancel: &AtomicBool| match splitting {
        true => rows(BlanesMoan4, make, count, steps, indicator, cancel),
        false => rows(Gauss::<4>::default(), make, count, steps, indicator, cancel),
    };
    let made = py.detach(|| watched(compute, signals.hook()));
    if let Some(error) = signals.take() {
        return Err(error);
    }
    let made =
        made.ok_or_else(|| PyRuntimeError::new_err("the computation ended without a result"))?;
    let made = made.map_err(|error| errors::of_run(py, &RunError::from(error)))?;
    let width = deviations.max(1);
    let (mut numbers, mut failed) = (Vec::with_capacity(count * width), Vec::new());
    for (member, row) in made.into_iter().enumerate() {
        match row {
            Ok(row) => numbers.extend(row),
            Err(error) => {
                numbers.extend(std::iter::repeat_n(f64::NAN, width));
                failed.push((member, error.to_string()));
            }
        }
    }
    Ok((numbers.into_pyarray(py).reshape([count, width])?, failed))
}
