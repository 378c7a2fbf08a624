//! Pictures of results, as SVG (feature `plot`).
//!
//! Input: a [`Table`], or points. Output: a [`Figure`] and its file. Invariants: no fonts are needed; more
//! than [`DENSE`] dots of a figure become one embedded PNG, so that files stay small.
//!
//! ```
//! use hamiltonian::plot::Figure;
//! use hamiltonian::prelude::*;
//!
//! hamiltonian! {
//!     /// A mass on a spring.
//!     pub struct Oscillator {}
//!     H(q; p) = p^2/2 + q^2/2
//! }
//!
//! let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), State::new([1.0], [0.0]), 0.1)?
//!     .observe(Recorder::new().with_energy());
//! run.advance(500)?;
//! let folder = std::env::temp_dir();
//! Figure::against_time(run.observer(), ["q", "p"])?.write(folder.join("time.svg"))?;
//! Figure::phase_portrait(run.observer(), "q", "p")?.write(folder.join("portrait.svg"))?;
//! Figure::energy_drift(run.observer())?.write(folder.join("drift.svg"))?;
//! # Ok::<(), Error>(())
//! ```

mod draw;
mod field;
mod png;
mod raster;

pub use field::Field;

use crate::{Error, Lattice, Table};
use std::ops::Range;

/// The largest number of dots that are drawn one by one; more become one embedded PNG.
pub const DENSE: usize = 500;

/// A named curve. Curves with the same name share a colour and a line of the legend.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// The name in the legend; a curve with an empty name is not in the legend.
    pub name: String,
    /// The points (x, y). A y that is not finite interrupts the curve.
    pub points: Vec<(f64, f64)>,
}

/// A figure: curves with names, axes with labels, a legend.
///
/// ```
/// use hamiltonian::plot::{Curve, Figure};
///
/// let parabola = (-10..=10).map(|x| (f64::from(x), f64::from(x * x))).collect();
/// let figure = Figure {
///     title: "A parabola".to_string(),
///     x: "x".to_string(),
///     y: "y".to_string(),
///     curves: vec![Curve { name: "y = x²".to_string(), points: parabola }],
///     ..Figure::default()
/// };
/// assert!(figure.svg()?.starts_with("<svg"));
/// # Ok::<(), hamiltonian::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// The title.
    pub title: String,
    /// The label of the x axis.
    pub x: String,
    /// The label of the y axis.
    pub y: String,
    /// True if points are drawn instead of lines.
    pub dots: bool,
    /// True if both axes have one scale, so that circles are round.
    pub equal: bool,
    /// True if y is |y| on a logarithmic axis.
    pub logarithmic: bool,
    /// True if x is on a logarithmic axis too.
    pub decades: bool,
    /// True if the legend stands on the right.
    pub legend_right: bool,
    /// Words at points.
    pub marks: Vec<((f64, f64), String)>,
    /// The range of y; that of all curves if `None`.
    pub range: Option<Range<f64>>,
    /// Values on a lattice, below the curves.
    pub field: Option<Field>,
    /// The curves.
    pub curves: Vec<Curve>,
}

impl Figure {
    /// Draws columns of a table against its time: the column `t`, or the first one if there is none.
    ///
    /// # Errors
    /// [`TableError::Unknown`](crate::errors::TableError::Unknown) if there is no such column.
    pub fn against_time<'n>(
        table: &Table,
        columns: impl IntoIterator<Item = &'n str>,
    ) -> Result<Self, Error> {
        let (time, t) = time_of(table)?;
        let mut curves = Vec::new();
        for name in columns {
            curves.push(Curve {
                name: name.to_owned(),
                points: t.iter().copied().zip(values(table, name)?).collect(),
            });
        }
        let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).collect();
        Ok(Figure {
            title: format!("{} against {time}", names.join(", ")),
            x: time,
            y: names.join(", "),
            curves,
            ..Figure::default()
        })
    }

    /// Draws one column of a table against another, for example a momentum against its coordinate.
    ///
    /// A wrapped angle interrupts the curve where it jumps: where it changes by more than π between two
    /// rows, from one end of (−π, π] to the other.
    ///
    /// # Errors
    /// [`TableError::Unknown`](crate::errors::TableError::Unknown) if there is no such column.
    pub fn phase_portrait(table: &Table, x: &str, y: &str) -> Result<Self, Error> {
        let (across, up) = (values(table, x)?, values(table, y)?);
        let mut points: Vec<(f64, f64)> = Vec::with_capacity(across.len());
        for point in across.into_iter().zip(up) {
            use std::f64::consts::PI;
            if let Some(last) = points.last()
                && (last.0 - point.0).abs() > PI
                && last.0.abs().max(point.0.abs()) <= PI
            {
                points.push((point.0, f64::NAN));
            }
            points.push(point);
        }
        Ok(Figure {
            title: "Phase portrait".to_owned(),
            x: x.to_owned(),
            y: y.to_owned(),
            curves: vec![Curve {
                name: String::new(),
                points,
            }],
            ..Figure::default()
        })
    }

    /// Draws a section: a dot for each point (x, y), for example of an [`Events`](crate::observers::Events) observer
    /// or of a sweep.
    ///
    /// ```
    /// use hamiltonian::plot::Figure;
    ///
    /// let circle = (0..10_000).map(|k| f64::from(k)).map(|k| (k.cos(), k.sin()));
    /// let figure = Figure::section("y", "p_y", circle);
    /// assert!(figure.svg()?.contains("data:image/png;base64,"));
    /// # Ok::<(), hamiltonian::Error>(())
    /// ```
    pub fn section(x: &str, y: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Figure {
            title: "Section".to_owned(),
            x: x.to_owned(),
            y: y.to_owned(),
            dots: true,
            curves: vec![Curve {
                name: String::new(),
                points: points.into_iter().collect(),
            }],
            ..Figure::default()
        }
    }

    /// Draws values on a lattice with two axes as colours, which the legend explains: rows from bottom to top in the
    /// range of y, columns from left to right in that of x. Values of both signs have colours about 0. Values that
    /// are not finite are left out.
    ///
    /// ```
    /// use hamiltonian::Lattice;
    /// use hamiltonian::plot::Figure;
    ///
    /// let wave = Lattice::from_fn([40, 60], |[i, j]| (0.2 * (i + j) as f64).sin());
    /// let figure = Figure::field(0.0..6.0, 0.0..4.0, wave);
    /// assert!(figure.svg()?.contains("data:image/png;base64,"));
    /// # Ok::<(), hamiltonian::Error>(())
    /// ```
    #[must_use]
    pub fn field(x: Range<f64>, y: Range<f64>, values: Lattice<f64, 2>) -> Self {
        Figure {
            x: "x".to_owned(),
            y: "y".to_owned(),
            legend_right: true,
            field: Some(Field { x, y, values }),
            ..Figure::default()
        }
    }

    /// Draws |H/H₀ − 1| against time on a logarithmic axis, with the first value H₀ of the column `H`. If H₀ is 0, it
    /// draws |H − H₀|.
    ///
    /// # Errors
    /// [`TableError::Unknown`](crate::errors::TableError::Unknown) if the table has no column `H`:
    /// [`Recorder::with_energy`](crate::observers::Recorder::with_energy) records it.
    pub fn energy_drift(table: &Table) -> Result<Self, Error> {
        let (time, t) = time_of(table)?;
        let energy = values(table, "H")?;
        let start = energy.first().copied().unwrap_or(f64::NAN);
        let (scale, label) = match start == 0.0 {
            true => (1.0, "|H − H₀|"),
            false => (start, "|H/H₀ − 1|"),
        };
        let drift = energy.into_iter().map(|h| ((h - start) / scale).abs());
        Ok(Figure {
            title: "Drift of the energy".to_owned(),
            x: time,
            y: label.to_owned(),
            logarithmic: true,
            curves: vec![Curve {
                name: String::new(),
                points: t.into_iter().zip(drift).collect(),
            }],
            ..Figure::default()
        })
    }
}

/// The name of the time and its values.
fn time_of(table: &Table) -> Result<(String, Vec<f64>), Error> {
    let first = table.columns().first().map_or("t", String::as_str);
    let name = if table.column("t").is_some() {
        "t"
    } else {
        first
    };
    Ok((name.to_owned(), values(table, name)?))
}

fn values(table: &Table, name: &str) -> Result<Vec<f64>, Error> {
    let at = table.position(name)?;
    Ok(table.iter().map(|row| row[at]).collect())
}
