//! Tables as comma-separated values (RFC 4180).
//!
//! Input: a [`Table`]. Output: its text. Invariant: each number reads back to the same bits.

use super::Table;
use crate::errors::Error;
use std::io::{BufWriter, Write};

/// The number of bytes that are collected before the writer receives them.
pub(super) const BUFFER: usize = 1 << 16;

impl Table {
    /// Writes a header and the rows as comma-separated values, each number in the fewest digits that
    /// read back to the same bits. Missing numbers are `NaN`, as pandas and gnuplot read them.
    ///
    /// The writer needs no buffer of its own: it receives 64 KiB at a time, and is flushed at the end.
    ///
    /// ```
    /// use hamiltonian::Table;
    /// use hamiltonian::prelude::*;
    /// use std::fs::File;
    ///
    /// fn main() -> Result<(), Error> {
    ///     let mut table = Table::new(["t", "x"])?;
    ///     table.push(&[0.5, 1e-300])?;
    ///     let path = std::env::temp_dir().join("table.csv");
    ///     table.write_csv(File::create(&path)?)?;
    ///     assert_eq!(std::fs::read_to_string(&path)?, "t,x\n0.5,1e-300\n");
    ///     Ok(())
    /// }
    /// ```
    ///
    /// # Errors
    /// [`Error::Io`] with the kind and the message of the writer's error.
    pub fn write_csv(&self, to: impl Write) -> Result<(), Error> {
        let mut to = BufWriter::with_capacity(BUFFER, to);
        for (index, name) in self.columns.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            match name.contains([',', '"', '\n', '\r']) {
                true => write!(to, "{comma}\"{}\"", name.replace('"', "\"\""))?,
                false => write!(to, "{comma}{name}")?,
            }
        }
        writeln!(to)?;
        for row in self.iter() {
            for (index, value) in row.iter().enumerate() {
                match index {
                    0 if self.indexed => write!(to, "{value:.0}")?,
                    0 => write!(to, "{value:?}")?,
                    _ => write!(to, ",{value:?}")?,
                }
            }
            writeln!(to)?;
        }
        to.flush()?;
        Ok(())
    }
}
