//! Systems: names, and H with its derivatives at many points.
//!
//! Input: points, one a row. Output: numbers or points, one a row.

use crate::errors;
use crate::layout::Layout;
use hamiltonian_core::System as _;
use hamiltonian_core::nalgebra::DVector;
use hamiltonian_core::private::declared_energy_at;
use hamiltonian_core::schemes::author::{Dynamics, ObservableKind};
use hamiltonian_runtime::{Coordinates, FlatState, Prepared, RunError, RuntimeSystem};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;

/// A definition with values.
#[pyclass(frozen, module = "hamiltonian._hamiltonian")]
pub struct System {
    pub system: RuntimeSystem,
    prepared: Prepared<f64>,
    pub layout: Layout,
    /// Of the variables that the definition declares.
    declared: Layout,
}

/// Points, one a row.
type Rows<'py> = PyReadonlyArray2<'py, f64>;
/// Times, coordinates, momenta.
type States<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);
/// Names of coordinates, of momenta, of velocities, and extents.
type Groups = Vec<(String, String, Option<String>, Vec<usize>)>;
/// Two arrays of points: of coordinates and of momenta.
type Pair<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

impl System {
    pub fn new(system: RuntimeSystem) -> Self {
        let layout = Layout::new(system.coordinates());
        let declared = Layout::new(system.declared_coordinates());
        let prepared = system.prepare();
        System {
            system,
            prepared,
            layout,
            declared,
        }
    }

    /// Calls a function at each point, with the number of the point.
    fn each(
        &self,
        [q, p]: [&[f64]; 2],
        t: &[f64],
        mut at: impl FnMut(usize, f64, &DVector<f64>, &DVector<f64>),
    ) {
        let len = self.layout.len();
        let mut point = [DVector::zeros(len), DVector::zeros(len)];
        for (row, t) in t.iter().enumerate() {
            for (into, from) in point.iter_mut().zip([q, p]) {
                self.layout
                    .read(&from[row * len..][..len], into.as_mut_slice());
            }
            let [q, p] = &point;
            at(row, *t, q, p);
        }
    }

    /// A number at each point.
    fn numbers<'py>(
        &self,
        py: Python<'py>,
        (q, p, t): (Rows<'_>, Rows<'_>, PyReadonlyArray1<'_, f64>),
        number: impl Fn(f64, &DVector<f64>, &DVector<f64>) -> f64 + Sync,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (point, t) = ([q.as_slice()?, p.as_slice()?], t.as_slice()?);
        let all = py.detach(|| {
            let mut all = vec![0.0; t.len()];
            self.each(point, t, |row, t, q, p| all[row] = number(t, q, p));
            all
        });
        Ok(all.into_pyarray(py))
    }

    /// Two vectors at each point, which the function writes.
    fn vectors<'py>(
        &self,
        py: Python<'py>,
        (q, p, t): (Rows<'_>, Rows<'_>, PyReadonlyArray1<'_, f64>),
        vectors: impl Fn(f64, &DVector<f64>, &DVector<f64>, &mut DVector<f64>, &mut DVector<f64>) + Sync,
    ) -> PyResult<Pair<'py>> {
        let (point, t) = ([q.as_slice()?, p.as_slice()?], t.as_slice()?);
        let len = self.layout.len();
        let [of_q, of_p] = py.detach(|| {
            let mut all = [(); 2].map(|()| vec![0.0; t.len() * len]);
            let [mut dq, mut dp] = [DVector::zeros(len), DVector::zeros(len)];
            self.each(point, t, |row, t, q, p| {
                dq.fill(0.0);
                dp.fill(0.0);
                vectors(t, q, p, &mut dq, &mut dp);
                for (into, from) in all.iter_mut().zip([&dq, &dp]) {
                    self.layout
                        .write(from.as_slice(), &mut into[row * len..][..len]);
                }
            });
            all
        });
        let rows = t.len();
        let shaped = |all: Vec<f64>| all.into_pyarray(py).reshape([rows, len]);
        Ok((shaped(of_q)?, shaped(of_p)?))
    }
}

/// Names and extents.
fn groups(all: &[Coordinates]) -> Groups {
    let one = |of: &Coordinates| {
        let velocity = of.velocity().map(str::to_owned);
        let (name, momentum) = (of.name().to_owned(), of.momentum().to_owned());
        (name, momentum, velocity, of.extents().to_vec())
    };
    all.iter().map(one).collect()
}

/// States in other variables, from one layout into another.
fn mapped<'py>(
    py: Python<'py>,
    [from, into]: [&Layout; 2],
    (q, p, t): (Rows<'_>, Rows<'_>, PyReadonlyArray1<'_, f64>),
    map: impl Fn(&FlatState) -> Result<FlatState, RunError> + Sync,
) -> PyResult<States<'py>> {
    let (q, p, t) = (q.as_slice()?, p.as_slice()?, t.as_slice()?);
    let (len, own) = (from.len(), into.len());
    let made = py.detach(|| {
        let mut times = Vec::with_capacity(t.len());
        let mut sides = [(); 2].map(|()| vec![0.0; t.len() * own]);
        let zeros = || DVector::zeros(len);
        let mut state = FlatState {
            t: 0.0,
            q: zeros(),
            p: zeros(),
        };
        for (row, t) in t.iter().enumerate() {
            state.t = *t;
            from.read(&q[row * len..][..len], state.q.as_mut_slice());
            from.read(&p[row * len..][..len], state.p.as_mut_slice());
            let found = map(&state)?;
            times.push(found.t);
            for (side, found) in sides.iter_mut().zip([&found.q, &found.p]) {
                into.write(found.as_slice(), &mut side[row * own..][..own]);
            }
        }
        Ok((times, sides))
    });
    let (times, [q, p]) = made.map_err(|error| errors::of_run(py, &error))?;
    let shaped = |all: Vec<f64>| all.into_pyarray(py).reshape([t.len(), own]);
    Ok((times.into_pyarray(py), shaped(q)?, shaped(p)?))
}

#[pymethods]
impl System {
    /// The names of each group of coordinates, of its momenta and of its velocities, and its extents.
    #[getter]
    fn groups(&self) -> Groups {
        groups(self.system.coordinates())
    }

    /// The same of the variables that the definition declares.
    #[getter]
    fn declared_groups(&self) -> Groups {
        groups(self.system.declared_coordinates())
    }

    /// The name of the time of runs.
    #[getter]
    fn clock(&self) -> &str {
        self.system.description().clock()
    }

    /// The states of the system from states in the declared variables, with momenta or with velocities.
    fn of_declared<'py>(
        &self,
        py: Python<'py>,
        q: Rows<'_>,
        p: Rows<'_>,
        t: PyReadonlyArray1<'_, f64>,
        velocities: bool,
    ) -> PyResult<States<'py>> {
        let layouts = [&self.declared, &self.layout];
        mapped(py, layouts, (q, p, t), |state| match velocities {
            true => self.system.state_from_velocity(state),
            false => self.system.from_declared(state),
        })
    }

    /// The states in the declared variables from states of the system.
    fn to_declared<'py>(
        &self,
        py: Python<'py>,
        q: Rows<'_>,
        p: Rows<'_>,
        t: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<States<'py>> {
        let layouts = [&self.layout, &self.declared];
        mapped(py, layouts, (q, p, t), |state| {
            self.system.to_declared(state)
        })
    }

    /// The name and the kind of each observable: `monitor`, `invariant`, `event`.
    #[getter]
    fn observables(&self) -> Vec<(String, &'static str)> {
        let all = self.system.description().observables.iter();
        let kind = |kind| match kind {
            ObservableKind::Monitor => "monitor",
            ObservableKind::Invariant => "invariant",
            ObservableKind::Event => "event",
        };
        all.map(|one| (one.name.to_string(), kind(one.kind)))
            .collect()
    }

    /// The name and the formula of each piece, the outermost first.
    #[getter]
    fn pieces(&self) -> Vec<(String, String)> {
        let all = self.system.description().pieces.iter();
        all.map(|one| (one.name.to_string(), one.formula.to_string()))
            .collect()
    }

    /// The coordinates that do not appear in H.
    #[getter]
    fn cyclic(&self) -> Vec<String> {
        let all = self.system.description().cyclic.iter();
        all.map(ToString::to_string).collect()
    }

    /// The properties that H is not proven to have, each with the reason.
    #[getter]
    fn missing(&self) -> Vec<(String, String)> {
        let all = self.system.description().missing.iter();
        all.map(|one| (one.marker.to_string(), one.message.to_string()))
            .collect()
    }

    /// The name and the value of each size.
    #[getter]
    fn sizes(&self) -> Vec<(String, usize)> {
        let all = self.system.sizes();
        all.map(|(name, size)| (name.to_owned(), size)).collect()
    }

    /// The name, the extents and the numbers of each parameter, row after row; a number has no extents.
    #[getter]
    fn parameters<'py>(
        &self,
        py: Python<'py>,
    ) -> Vec<(String, Vec<usize>, Bound<'py, PyArray1<f64>>)> {
        let all = self.system.parameters();
        let one = |(name, extents, numbers): (&str, &[usize], &[f64])| {
            let numbers = PyArray1::from_slice(py, numbers);
            (name.to_owned(), extents.to_vec(), numbers)
        };
        all.map(one).collect()
    }

    /// H of the definition at each point.
    fn energy<'py>(
        &self,
        py: Python<'py>,
        q: Rows<'_>,
        p: Rows<'_>,
        t: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let prepared = &self.prepared;
        self.numbers(py, (q, p, t), |t, q, p| {
            declared_energy_at::<f64, RuntimeSystem>(prepared, t, q, p)
        })
    }

    /// An observable at each point, by its name.
    fn observable<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        q: Rows<'_>,
        p: Rows<'_>,
        t: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let index = self.system.description().observable_index(name);
        let index = index.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        let prepared = &self.prepared;
        self.numbers(py, (q, p, t), |t, q, p| prepared.observable(index, t, q, p))
    }

    /// ∂H/∂q and ∂H/∂p at each point.
    fn gradient<'py>(
        &self,
        py: Python<'py>,
        q: Rows<'_>,
        p: Rows<'_>,
        t: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Pair<'py>> {
        let prepared = &self.prepared;
        self.vectors(py, (q, p, t), |t, q, p, dq, dp| {
            prepared.gradient(t, q, p, dq, dp);
        })
    }

    /// q̇ and ṗ at each point, with the force where there is one.
    fn field<'py>(
        &self,
        py: Python<'py>,
        q: Rows<'_>,
        p: Rows<'_>,
        t: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Pair<'py>> {
        let prepared = &self.prepared;
        self.vectors(py, (q, p, t), |t, q, p, dq, dp| {
            prepared.add_field(1.0, t, q, p, dq, dp);
        })
    }
}
