//! Canonical transformations of a system: another time, other coordinates; the pieces and forces
//! that are declared beside H, checked and carried along.
//!
//! Input: a [`Model`] with its H. Output: a model of the same dynamics in other variables, with
//! the maps between them as nodes. Invariant: signs stay q̇ = ∂H/∂p, ṗ = −∂H/∂q; the order of the
//! stages is coordinates, then time, and declarations beside H (observables, pieces, forces,
//! the factor of time) are written in the variables of the definition and carried through both.

mod bodies;
pub mod charts;
pub mod coordinates;
mod layout;
mod peel;
mod reduce;
mod sum;
pub mod time;
mod verify;

pub use charts::{Bodies, Chart, Component};
pub use coordinates::Transformed;
pub use layout::{Placement, names_of_scalars};
pub use sum::{Difference, check_split};
pub use time::{Retimed, retime};
pub use verify::check;

use crate::index::LOOPS;
use crate::loops::SamplePoint;
use crate::model::Model;
use reduce::OPERATIONS;
use std::fmt;

/// The system in the coordinates of the charts, which replace different coordinates.
///
/// Loops that read a replaced coordinate are unrolled, so their lengths must be literal, but
/// for heliocentric coordinates of any number of bodies.
///
/// # Errors
/// [`NoTransform`]; also where [`check`] finds that H in the new coordinates is not H in the old ones.
pub fn apply(model: &Model, charts: &[Chart]) -> Result<Transformed, NoTransform> {
    let transformed = Transformed::new(model, charts)?;
    check(&transformed)?;
    Ok(transformed)
}

/// Why a transformation is refused.
#[derive(Clone, PartialEq, Debug)]
pub enum NoTransform {
    /// A name that the transformation introduces is declared already.
    NameTaken {
        /// The name that is there twice.
        name: String,
        /// The chart that would introduce it: `polar`.
        by: &'static str,
    },
    /// A coordinate is replaced by two charts.
    Twice {
        /// The coordinate.
        coordinate: String,
    },
    /// The chart takes a literal number of bodies.
    Number {
        /// Their positions.
        coordinate: String,
    },
    /// Bodies in a loop are read at an index with `%`, of which it is not known whether it is row 0.
    Wrapped {
        /// Their positions.
        coordinate: String,
    },
    /// A coordinate of the chart is read in loops that cannot be unrolled.
    Loops {
        /// The coordinate.
        coordinate: String,
        /// Why not.
        reason: String,
    },
    /// More than [`crate::index::LOOPS`] loops are needed.
    TooManyLoops,
    /// H is too long in the new coordinates.
    TooLong,
    /// The factor of the time transformation is none.
    Factor {
        /// Why not.
        reason: &'static str,
    },
    /// The power of a force on an array is not known, because its velocities are not.
    Power {
        /// The momenta the force acts on.
        momentum: String,
    },
    /// H in the new variables could not be compared with H in the old ones.
    Uncompared {
        /// Why not.
        reason: &'static str,
    },
    /// H in the new variables is not H in the old ones at a point.
    Unverified {
        /// The point, in the new variables.
        point: SamplePoint,
        /// H in the old variables.
        old: f64,
        /// H in the new variables.
        new: f64,
    },
}

impl fmt::Display for NoTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoTransform::NameTaken { name, by } => {
                write!(f, "`{by}` introduces `{name}`, which is declared already")
            }
            NoTransform::Twice { coordinate } => write!(f, "`{coordinate}` is replaced twice"),
            NoTransform::Number { coordinate } => {
                write!(f, "the number of bodies `{coordinate}` is not a literal")
            }
            NoTransform::Wrapped { coordinate } => write!(
                f,
                "`{coordinate}`, or its momentum, is read at an index with `%`, which may be row 0 or another"
            ),
            NoTransform::Loops { coordinate, reason } => write!(
                f,
                "`{coordinate}` is read in a loop that cannot be unrolled: {reason}"
            ),
            NoTransform::TooManyLoops => write!(f, "it takes more than {LOOPS} loops"),
            NoTransform::TooLong => write!(f, "H has more than {OPERATIONS} operations in them"),
            NoTransform::Factor { reason } => write!(f, "the factor of `dt = …*ds` {reason}"),
            NoTransform::Power { momentum } => write!(
                f,
                "the work of the force on `{momentum}` needs ∂H/∂{momentum} row by row, and an index of H cannot be solved for the row"
            ),
            NoTransform::Uncompared { reason } => write!(
                f,
                "H in the old and in the new ones could not be compared: {reason}"
            ),
            NoTransform::Unverified { old, new, .. } => write!(
                f,
                "H is {old} in the old coordinates and {new} in the new ones at the same point"
            ),
        }
    }
}

impl std::error::Error for NoTransform {}
