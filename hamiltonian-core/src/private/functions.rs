//! Functions with data and saved runs for serde, with the feature `serde`.
//!
//! Input: a spline, a grid or a saved run. Output: `Serialize` and `Deserialize`. Invariant: what is read is made by the
//! constructors, so it has the bits and the fingerprint of what was written, or is an error.

use super::record::Collected;
use crate::errors::KnotError;
use crate::results::checkpoint::Checkpoint;
use crate::systems::function::{EndCondition, Grid, Spline};
use alloc::vec::Vec;
use core::fmt;
use serde_core::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde_core::ser::{Serialize, SerializeStruct, Serializer};

/// A spline as it is read. Slopes are those of a clamped one.
struct SplineRead {
    knots: Vec<f64>,
    values: Vec<f64>,
    periodic: bool,
    slopes: Option<[f64; 2]>,
}

crate::__record! {
    [] [] SplineRead, "Spline", [], []
    {
        knots: number Vec<f64>,
        values: number Vec<f64>,
        periodic: number bool,
        slopes: number Option<[f64; 2]>,
    }
}

impl Serialize for Spline {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (knots, values, ends) = self.given();
        let (periodic, slopes) = match ends {
            EndCondition::Natural => (false, None),
            EndCondition::Clamped(slopes) => (false, Some(slopes)),
            EndCondition::Periodic => (true, None),
        };
        let mut to = to.serialize_struct("Spline", 4)?;
        to.serialize_field("knots", knots)?;
        to.serialize_field("values", &values)?;
        to.serialize_field("periodic", &periodic)?;
        to.serialize_field("slopes", &slopes)?;
        to.end()
    }
}

impl<'de> Deserialize<'de> for Spline {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let read = SplineRead::deserialize(from)?;
        let (knots, values) = (&read.knots, &read.values);
        let spline = match (read.periodic, read.slopes) {
            (false, None) => Spline::natural(knots, values),
            (false, Some(slopes)) => Spline::clamped(knots, values, slopes),
            (true, None) => Spline::periodic(knots, values),
            (true, Some(_)) => return Err(D::Error::custom("a periodic spline has no `slopes`")),
        };
        spline.map_err(D::Error::custom)
    }
}

/// A grid as it is read.
struct GridRead {
    origin: [f64; 2],
    spacing: [f64; 2],
    rows: Vec<Vec<f64>>,
    periodic: bool,
}

crate::__record! {
    [] [] GridRead, "Grid", [], []
    {
        origin: number [f64; 2],
        spacing: number [f64; 2],
        rows: number Vec<Vec<f64>>,
        periodic: number bool,
    }
}

impl GridRead {
    /// The grid.
    fn grid(&self) -> Result<Grid, KnotError> {
        match self.periodic {
            true => Grid::periodic(self.origin, self.spacing, &self.rows),
            false => Grid::natural(self.origin, self.spacing, &self.rows),
        }
    }
}

impl Serialize for Grid {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (origin, spacing, rows, periodic) = self.given();
        let mut to = to.serialize_struct("Grid", 4)?;
        to.serialize_field("origin", &origin)?;
        to.serialize_field("spacing", &spacing)?;
        to.serialize_field("rows", &Collected(rows))?;
        to.serialize_field("periodic", &periodic)?;
        to.end()
    }
}

impl<'de> Deserialize<'de> for Grid {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let read = GridRead::deserialize(from)?;
        read.grid().map_err(D::Error::custom)
    }
}

impl Serialize for Checkpoint {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_bytes(&self.to_bytes())
    }
}

impl<'de> Deserialize<'de> for Checkpoint {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_bytes(FileBytes)
    }
}

/// The bytes of the file of a saved run, as bytes or as a list of numbers.
struct FileBytes;

impl<'de> Visitor<'de> for FileBytes {
    type Value = Checkpoint;
    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str("the bytes of a saved run")
    }
    fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<Checkpoint, E> {
        Checkpoint::from_bytes(bytes).map_err(E::custom)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Checkpoint, A::Error> {
        let mut bytes = Vec::new();
        while let Some(byte) = list.next_element()? {
            bytes.push(byte);
        }
        self.visit_bytes(&bytes)
    }
}
