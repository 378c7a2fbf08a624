//! The values of parameters and sizes by name.
//!
//! Input: numbers, lists and functions. Output: [`Values`]. Invariant: nothing is checked before a system is made of them.

use crate::tabulated::Tabulated;
use hamiltonian_core::systems::function::{Grid, Spline};

/// The value of a parameter or of a size.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number. A whole one is a size too.
    Number(f64),
    /// The elements of an array, the last index fastest: those of `w[n][m]` row after row.
    List(Vec<f64>),
    /// A function with data.
    Function(Tabulated),
}

impl From<Spline> for Value {
    fn from(spline: Spline) -> Value {
        Value::Function(spline.into())
    }
}

impl From<Grid> for Value {
    fn from(grid: Grid) -> Value {
        Value::Function(grid.into())
    }
}

impl From<Tabulated> for Value {
    fn from(function: Tabulated) -> Value {
        Value::Function(function)
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Value {
        Value::Number(number)
    }
}

impl From<i32> for Value {
    fn from(number: i32) -> Value {
        Value::Number(f64::from(number))
    }
}

impl From<usize> for Value {
    fn from(number: usize) -> Value {
        Value::Number(number as f64)
    }
}

impl From<Vec<f64>> for Value {
    fn from(list: Vec<f64>) -> Value {
        Value::List(list)
    }
}

impl From<&[f64]> for Value {
    fn from(list: &[f64]) -> Value {
        Value::List(list.to_vec())
    }
}

impl<const N: usize> From<[f64; N]> for Value {
    fn from(list: [f64; N]) -> Value {
        Value::List(list.to_vec())
    }
}

/// The values of parameters and sizes by name; a parameter that is not named has its default.
///
/// ```
/// use hamiltonian_runtime::Values;
///
/// // Numbers alone, or numbers and lists.
/// let values: Values = [("m", 1.0), ("l", 2.0)].into();
/// let values = Values::new().with("n", 3).with("m", [1.0, 2.0, 3.0]);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Values(pub(crate) Vec<(String, Value)>);

impl Values {
    /// No values: every parameter has its default.
    #[must_use]
    pub fn new() -> Values {
        Values::default()
    }

    /// These values, and that of one more name.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl Into<Value>) -> Values {
        self.0.push((name.to_owned(), value.into()));
        self
    }

    /// The last value of a name.
    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        let found = self.0.iter().rev().find(|(known, _)| known == name);
        found.map(|(_, value)| value)
    }
}

impl<V: Into<Value>, const N: usize> From<[(&str, V); N]> for Values {
    fn from(values: [(&str, V); N]) -> Values {
        let named = |(name, value): (&str, V)| (name.to_owned(), value.into());
        Values(values.into_iter().map(named).collect())
    }
}
