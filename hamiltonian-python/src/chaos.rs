//! Derivatives of a trajectory with respect to its start and to parameters, and indicators of chaos.
//!
//! Input: starts, one a row. Output: matrices, exponents, MEGNO. Invariant: all are exact derivatives of the numerical maps,
//! by dual numbers.

use crate::errors;
use crate::run;
use crate::swarm::Members;
use crate::system::System;
use hamiltonian_core::schemes::{Gauss, GaussNystrom};
use hamiltonian_core::{Error, Integrator, Lyapunov, Member, Scheme, State};
use hamiltonian_lanes::Dual;
use hamiltonian_runtime::{FlatState, RunError, RuntimeSystem, scheme_of_members};
use numpy::{
    IntoPyArray, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

/// A number of a parameter: the name, and the element of an array row after row.
type Number = (String, usize);

/// The derivatives of the state after the time `time`, in `steps` steps, with respect to the start, and behind it to numbers
/// of parameters: a column each, coordinates, then momenta, in the order of Python.
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
    numbers: Vec<Number>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let own = system.get();
    let start = run::state(own, &q, &p, t)?;
    let by = |(name, element): &Number| own.system.by_parameter(name, *element);
    let by: Result<Vec<_>, _> = numbers.iter().map(by).collect();
    let by = by.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let of = (&own.system, &start);
    let made = py.detach(|| match nystrom {
        true => columns(GaussNystrom::<8>::default(), of, (time, steps), &by),
        false => columns(Gauss::<8>::default(), of, (time, steps), &by),
    });
    let columns = made.map_err(|error| errors::of_run(py, &error.into()))?;
    let len = own.layout.len();
    // The place of each row and column in the order of Python.
    let mut places = vec![0.0; len];
    let all: Vec<f64> = (0..len).map(|at| at as f64).collect();
    own.layout.write(&all, &mut places);
    let place = |at: usize| match at / len {
        side @ (0 | 1) => places[at % len] as usize + side * len,
        _ => at,
    };
    let (rows, width) = (2 * len, columns.len());
    let numbers = (0..rows).flat_map(|row| (0..width).map(move |column| (row, column)));
    let numbers: Vec<f64> = numbers
        .map(|(row, column)| columns[place(column)][place(row)])
        .collect();
    numbers.into_pyarray(py).reshape([rows, width])
}

/// The derivatives of the numerical map, a column for each component of the start, and for each system by a parameter.
fn columns<M: Scheme<RuntimeSystem>>(
    scheme: M,
    (system, start): (&RuntimeSystem, &FlatState),
    (time, steps): (f64, u64),
    by: &[RuntimeSystem],
) -> Result<Vec<Vec<f64>>, Error> {
    let len = start.q.len();
    let column = |system: &RuntimeSystem, direction: Option<usize>| {
        let mut lifted = State {
            t: Dual::fixed(start.t),
            q: start.q.map(Dual::fixed),
            p: start.p.map(Dual::fixed),
        };
        match direction {
            Some(at) if at < len => lifted.q[at].eps = 1.0,
            Some(at) => lifted.p[at - len].eps = 1.0,
            None => {}
        }
        let step = Dual::fixed(time / steps as f64);
        let mut run = Integrator::new(system, scheme.clone(), lifted, step)?;
        let end = run.advance(steps)?;
        Ok(end.q.iter().chain(&end.p).map(|one| one.eps).collect())
    };
    let starts = (0..2 * len).map(|at| column(system, Some(at)));
    let parameters = by.iter().map(|system| column(system, None));
    starts.chain(parameters).collect()
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
pub fn watched<A: Send>(
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
    let scheme = match splitting {
        true => "BlanesMoan4",
        false => "Gauss4",
    };
    let scheme = scheme_of_members(scheme).map_err(|error| errors::of_run(py, &error))?;
    let compute = |cancel: &AtomicBool| rows(scheme, make, count, steps, indicator, cancel);
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
