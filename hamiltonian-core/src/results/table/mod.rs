//! Tables of numbers with named columns.
//!
//! Input: rows, from a [`Recorder`](crate::observers::Recorder) or a sweep. Output: columns by name, CSV
//! ([`Table::write_csv`]) and NumPy files ([`Table::write_npy`]). Invariants: names are unique, and
//! each row has a value for each column.

#[cfg(feature = "std")]
mod csv;
#[cfg(feature = "std")]
mod npy;

use crate::errors::{Error, TableError};
use alloc::string::String;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// Rows of `f64` under named columns.
///
/// A [`Recorder`](crate::observers::Recorder) dereferences to the table of its run, and a sweep collects a table. A
/// table with an index has whole numbers in its first column. For example, if members have several rows, the index is
/// the member of each row.
///
/// ```
/// use hamiltonian::Table;
///
/// let mut table = Table::with_index("member", ["theta", "drift"])?;
/// table.push(&[0.0, 0.25, 1e-9])?;
/// table.push(&[1.0, 7.0, 2e-9])?;
/// table.wrap("theta")?;
/// let theta: Vec<f64> = table.column("theta").into_iter().flatten().collect();
/// assert_eq!(theta[0], 0.25);
/// assert!((theta[1] - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
/// assert_eq!(table.row(1).map(|row| row[0]), Some(1.0));
/// # Ok::<(), hamiltonian::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    columns: Vec<String>,
    /// True if the first column is an index.
    indexed: bool,
    /// Row after row.
    values: Vec<f64>,
}

impl Table {
    /// Creates a table without rows.
    ///
    /// # Errors
    /// [`TableError::Twice`] if two columns have the same name.
    pub fn new<N: Into<String>>(columns: impl IntoIterator<Item = N>) -> Result<Self, Error> {
        Self::over(columns.into_iter().map(Into::into).collect(), false)
    }

    /// Creates a table without rows whose first column, `index`, has whole numbers.
    ///
    /// # Errors
    /// [`TableError::Twice`] if two columns have the same name.
    pub fn with_index<N: Into<String>>(
        index: impl Into<String>,
        columns: impl IntoIterator<Item = N>,
    ) -> Result<Self, Error> {
        let columns = columns.into_iter().map(Into::into);
        Self::over(
            core::iter::once(index.into()).chain(columns).collect(),
            true,
        )
    }

    #[inline]
    pub(crate) fn over(columns: Vec<String>, indexed: bool) -> Result<Self, Error> {
        let mut sorted: Vec<&String> = columns.iter().collect();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            let name = pair[0].clone();
            return Err(TableError::Twice { name: name.into() }.into());
        }
        Ok(Table {
            columns,
            indexed,
            values: Vec::new(),
        })
    }

    /// Reserves memory for `rows` more rows.
    #[inline]
    pub fn reserve(&mut self, rows: usize) {
        self.values.reserve(rows.saturating_mul(self.columns.len()));
    }

    /// Adds a row: one value for each column, the index included.
    ///
    /// # Errors
    /// [`TableError::Width`] for another number of values, [`TableError::Index`] for an index that is
    /// not a whole number of at most 2⁵³.
    #[inline]
    pub fn push(&mut self, row: &[f64]) -> Result<(), Error> {
        if row.len() != self.columns.len() {
            let (columns, found) = (self.columns.len(), row.len());
            return Err(TableError::Width { columns, found }.into());
        }
        if self.indexed {
            let (name, found) = (&self.columns[0], row[0]);
            // The range in which every whole number is an `f64`.
            let whole = Real::abs(found) <= 9_007_199_254_740_992.0 && found == found as i64 as f64;
            if !whole {
                let (name, value) = (name.as_str().into(), found);
                return Err(TableError::Index { name, value }.into());
            }
        }
        self.values.extend_from_slice(row);
        Ok(())
    }

    /// Adds one value; the caller adds one for each column.
    #[inline]
    pub(crate) fn push_value(&mut self, value: f64) {
        self.values.push(value);
    }

    /// All values, row after row.
    #[inline]
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Replaces the values of the table.
    #[inline]
    pub(crate) fn set_values(&mut self, values: Vec<f64>) {
        self.values = values;
    }

    /// The names of the columns.
    #[inline]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// Returns true if the first column is an index, with whole numbers.
    #[inline]
    pub fn has_index(&self) -> bool {
        self.indexed
    }

    /// The number of rows.
    #[inline]
    pub fn rows(&self) -> usize {
        (self.values.len())
            .checked_div(self.columns.len())
            .unwrap_or(0)
    }

    /// Row `index`, in the order of [`Table::columns`].
    #[inline]
    pub fn row(&self, index: usize) -> Option<&[f64]> {
        self.iter().nth(index)
    }

    /// All rows, in the order in which they were added.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.columns.len().max(1))
    }

    /// The column of that name; `None` if there is none.
    pub fn column(&self, name: &str) -> Option<impl Iterator<Item = f64>> {
        let at = self.position(name).ok()?;
        Some(self.iter().map(move |row| row[at]))
    }

    /// The elements of an array in each row, in the order of the declaration: those of `q[n][3]` are the columns
    /// `q[0][0]`, `q[0][1]`, …; `None` if there is no such array.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// hamiltonian! {
    ///     /// Two free bodies.
    ///     pub struct Free {}
    ///     H(q[2][3]; p[2][3]) = sum(i in 0..2) { norm_squared(p[i])/2 }
    /// }
    /// let start = State::new([[0.0; 3]; 2], [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    /// let mut run = Integrator::new(&Free {}, StormerVerlet::default(), start, 1.0)?.observe(Recorder::new());
    /// run.advance(2)?;
    /// for q in run.observer().array("q").into_iter().flatten() {
    ///     for [x, y, z] in q.as_chunks::<3>().0 {
    ///         println!("{x} {y} {z}");
    ///     }
    /// }
    /// let last = run.observer().array("q").and_then(Iterator::last);
    /// assert_eq!(last, Some(&[2.0, 4.0, 6.0, 8.0, 10.0, 12.0][..]));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn array(&self, name: &str) -> Option<impl Iterator<Item = &[f64]>> {
        let is_in = |column: &String| {
            let indices = column.strip_prefix(name);
            indices.is_some_and(|indices| indices.starts_with('['))
        };
        let first = self.columns.iter().position(is_in)?;
        let width = self.columns[first..]
            .iter()
            .take_while(|c| is_in(c))
            .count();
        Some(self.iter().map(move |row| &row[first..first + width]))
    }

    /// The position of the column of that name in [`columns`](Table::columns), from 0.
    ///
    /// ```
    /// use hamiltonian::Table;
    ///
    /// let table = Table::new(["t", "x"])?;
    /// assert_eq!(table.position("x")?, 1);
    /// assert!(table.position("y").is_err());
    /// # Ok::<(), hamiltonian::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TableError::Unknown`] if there is no such column.
    #[inline]
    pub fn position(&self, name: &str) -> Result<usize, Error> {
        (self.columns.iter().position(|column| column == name))
            .ok_or_else(|| TableError::unknown(name, &self.columns).into())
    }

    /// Wraps the angles of a column into (−π, π].
    ///
    /// # Errors
    /// [`TableError::Unknown`] if there is no such column.
    #[inline]
    pub fn wrap(&mut self, name: &str) -> Result<(), Error> {
        let at = self.position(name)?;
        let width = self.columns.len();
        for value in self.values.iter_mut().skip(at).step_by(width) {
            *value = wrapped(*value);
        }
        Ok(())
    }
}

/// The angle in (−π, π] that differs by a multiple of 2π; an angle in that interval keeps its bits.
#[inline]
pub(crate) fn wrapped(angle: f64) -> f64 {
    use core::f64::consts::PI;
    match -PI < angle && angle <= PI {
        true => angle,
        // Sine and cosine reduce large angles exactly, which a subtraction of multiples does not.
        false => Real::atan2(Real::sin(angle), Real::cos(angle)),
    }
}
