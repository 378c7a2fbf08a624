//! Functions with data: splines and grids.
//!
//! Input: knots and values. Output: [`Function`], the value of a parameter that is a function.

use hamiltonian_core::systems::function::{Function as _, Grid, Spline};
use hamiltonian_runtime::Tabulated;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A function of one number or of two.
#[pyclass(frozen, module = "hamiltonian._hamiltonian")]
pub struct Function {
    pub own: Tabulated,
}

/// The function, or the exception for its numbers.
fn made<F: Into<Tabulated>>(made: Result<F, impl std::fmt::Display>) -> PyResult<Function> {
    match made {
        Ok(own) => Ok(Function { own: own.into() }),
        Err(error) => Err(PyValueError::new_err(error.to_string())),
    }
}

#[pymethods]
impl Function {
    /// A cubic spline, with these slopes at its ends, natural or periodic.
    #[staticmethod]
    fn spline(
        knots: PyReadonlyArray1<'_, f64>,
        values: PyReadonlyArray1<'_, f64>,
        slopes: Option<[f64; 2]>,
        periodic: bool,
    ) -> PyResult<Function> {
        let (knots, values) = (knots.as_slice()?, values.as_slice()?);
        made(match (slopes, periodic) {
            (Some(slopes), _) => Spline::clamped(knots, values, slopes),
            (None, true) => Spline::periodic(knots, values),
            (None, false) => Spline::natural(knots, values),
        })
    }

    /// A bicubic spline through the values on a regular grid.
    #[staticmethod]
    fn grid(
        origin: [f64; 2],
        spacing: [f64; 2],
        values: PyReadonlyArray2<'_, f64>,
        periodic: bool,
    ) -> PyResult<Function> {
        let columns = values.shape()[1].max(1);
        let rows: Vec<&[f64]> = values.as_slice()?.chunks(columns).collect();
        made(match periodic {
            true => Grid::periodic(origin, spacing, &rows),
            false => Grid::natural(origin, spacing, &rows),
        })
    }

    /// The values at points, one a row.
    fn values<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let width = points.shape()[1].max(1);
        let points = points.as_slice()?.chunks(width);
        let value = |at: &[f64]| match (&self.own, at) {
            (Tabulated::Spline(spline), [x]) => spline.value([*x]),
            (Tabulated::Grid(grid), [x, y]) => grid.value([*x, *y]),
            _ => f64::NAN,
        };
        Ok(points.map(value).collect::<Vec<f64>>().into_pyarray(py))
    }
}
