//! Systems: names, and H with its derivatives at many points.
//!
//! Input: points, one a row. Output: numbers or points, one a row.

use crate::layout::Layout;
use hamiltonian_core::System as _;
use hamiltonian_core::nalgebra::DVector;
use hamiltonian_core::schemes::author::{Dynamics, ObservableKind};
use hamiltonian_runtime::{Prepared, RuntimeSystem};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;

/// A definition with values.
#[pyclass(frozen, module = "hamiltonian._hamiltonian")]
pub struct System {
    pub system: RuntimeSystem,
    prepared: Prepared<f64>,
    pub layout: Layout,
}

/// Points, one a row.
type Rows<'py> = PyReadonlyArray2<'py, f64>;
/// Two arrays of points: of coordinates and of momenta.
type Pair<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

impl System {
    pub fn new(system: RuntimeSystem) -> Self {
        let layout = Layout::new(system.description(), system.degrees_of_freedom());
        let prepared = system.prepare();
        System {
            system,
            prepared,
            layout,
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

#[pymethods]
impl System {
    /// The name, the momentum and the extents of each group of coordinates.
    #[getter]
    fn groups(&self) -> Vec<(String, String, Vec<usize>)> {
        let groups = self.system.description().groups.iter();
        let all = groups.zip(self.layout.shapes());
        let one = |(group, shape): (&hamiltonian_core::schemes::author::Group, &Vec<usize>)| {
            let names = (group.coordinate.to_string(), group.momentum.to_string());
            (names.0, names.1, shape.clone())
        };
        all.map(one).collect()
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

    /// H at each point.
    fn energy<'py>(
        &self,
        py: Python<'py>,
        q: Rows<'_>,
        p: Rows<'_>,
        t: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let prepared = &self.prepared;
        self.numbers(py, (q, p, t), |t, q, p| prepared.energy(t, q, p))
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
