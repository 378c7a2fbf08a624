//! Tables as files of NumPy.
//!
//! Source: the NumPy enhancement proposal 1, "A simple file format for NumPy arrays" (R. Kern, 2007),
//! with its versions 1.0 to 3.0.

use super::Table;
use super::csv::BUFFER;
use crate::errors::Error;
use std::io::{BufWriter, Write};

impl Table {
    /// Writes a `.npy` file: a structured array, one record a row, with a field for each column.
    ///
    /// Fields are little-endian `<f8`, the index `<i8`. In Python `np.load(path)["theta"]` is a column,
    /// and `pd.DataFrame(np.load(path))` the table.
    ///
    /// ```
    /// use hamiltonian::Table;
    /// use hamiltonian::prelude::*;
    ///
    /// let mut table = Table::new(["t", "x"])?;
    /// table.push(&[0.5, 2.0])?;
    /// let mut bytes = Vec::new();
    /// table.write_npy(&mut bytes)?;
    /// assert!(bytes.starts_with(b"\x93NUMPY"));
    /// assert!(bytes.ends_with(&2.0_f64.to_le_bytes()));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Io`] with the kind and the message of the writer's error.
    pub fn write_npy(&self, to: impl Write) -> Result<(), Error> {
        let mut to = BufWriter::with_capacity(BUFFER, to);
        to.write_all(&self.npy_header())?;
        for row in self.iter() {
            for (index, value) in row.iter().enumerate() {
                match index {
                    0 if self.indexed => to.write_all(&(*value as i64).to_le_bytes())?,
                    _ => to.write_all(&value.to_le_bytes())?,
                }
            }
        }
        to.flush()?;
        Ok(())
    }

    /// Magic bytes, version, length and a Python literal that ends at a multiple of 64 bytes.
    #[inline]
    fn npy_header(&self) -> Vec<u8> {
        let fields: String = (self.columns.iter().enumerate())
            .map(|(index, name)| {
                let kind = if index == 0 && self.indexed { "i" } else { "f" };
                format!("('{}', '<{kind}8'), ", python_text(name))
            })
            .collect();
        let literal = format!(
            "{{'descr': [{fields}], 'fortran_order': False, 'shape': ({},), }}",
            self.rows()
        );
        // Version 1 has a length of two bytes, 2 of four; 3 is 2 with UTF-8 instead of Latin-1.
        let long = literal.len() + 128 > usize::from(u16::MAX);
        let version: u8 = match (literal.is_ascii(), long) {
            (true, false) => 1,
            (true, true) => 2,
            (false, _) => 3,
        };
        let before = 8 + if version == 1 { 2 } else { 4 };
        let padding = 64 - (before + literal.len() + 1) % 64;
        let length = literal.len() + padding + 1;
        let mut header = b"\x93NUMPY".to_vec();
        header.extend([version, 0]);
        match version {
            1 => header.extend((length as u16).to_le_bytes()),
            _ => header.extend((length as u32).to_le_bytes()),
        }
        header.extend(literal.as_bytes());
        header.extend(std::iter::repeat_n(b' ', padding));
        header.push(b'\n');
        header
    }
}

/// A text between single quotes of Python.
#[inline]
fn python_text(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '\'' | '\\' => escaped.extend(['\\', letter]),
            letter if letter.is_control() => {
                escaped.push_str(&format!("\\U{:08x}", u32::from(letter)));
            }
            letter => escaped.push(letter),
        }
    }
    escaped
}
