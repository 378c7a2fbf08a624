//! Tables for serde, with the feature `serde`.
//!
//! Input: a table, or its columns and rows. Output: `Serialize` and `Deserialize`. Invariant: what is read is checked as
//! by `Table::new` and `Table::push`.

use crate::errors::Error;
use crate::results::table::Table;
use alloc::string::String;
use alloc::vec::Vec;
use serde_core::de::{Deserialize, Deserializer, Error as _};
use serde_core::ser::{Serialize, SerializeStruct, Serializer};

/// A table as it is read.
struct TableRead {
    columns: Vec<String>,
    index: bool,
    rows: Vec<Vec<f64>>,
}

crate::__record! {
    [] [] TableRead, "Table", [], []
    { columns: number Vec<String>, index: number bool, rows: number Vec<Vec<f64>> }
}

impl TableRead {
    /// The table.
    fn table(self) -> Result<Table, Error> {
        let mut table = Table::over(self.columns, self.index)?;
        self.rows.iter().try_for_each(|row| table.push(row))?;
        Ok(table)
    }
}

/// The rows of a table.
struct TableRows<'a>(&'a Table);

impl Serialize for TableRows<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.0.iter())
    }
}

impl Serialize for Table {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut to = to.serialize_struct("Table", 3)?;
        to.serialize_field("columns", self.columns())?;
        to.serialize_field("index", &self.has_index())?;
        to.serialize_field("rows", &TableRows(self))?;
        to.end()
    }
}

impl<'de> Deserialize<'de> for Table {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let read = TableRead::deserialize(from)?;
        if read.index && read.columns.is_empty() {
            return Err(D::Error::custom("a table with an index has no columns"));
        }
        read.table().map_err(D::Error::custom)
    }
}
