//! The files of a run.
//!
//! Input: tables, names of files. Output: the files, by the ends of their names. Invariant: a name that no file can have is
//! refused before the run.

use super::calculate::Tables;
use super::picture::picture;
use super::places::Word;
use super::study::Study;
use crate::Diagnostic;
use hamiltonian_core::Table;
use hamiltonian_core::results::{ChunkData, Layout, Rows, Store};
use std::error::Error;
use std::fs::File;
use std::io::{self, BufWriter, Write};

/// The forms of files.
#[derive(Clone, Copy, PartialEq)]
enum FileForm {
    Csv,
    Npy,
    Zarr,
    Svg,
}

/// The form of a file, by the end of its name.
fn form(file: &Word) -> Result<FileForm, Box<Diagnostic>> {
    match file.text.rsplit_once('.') {
        Some((_, "csv")) => Ok(FileForm::Csv),
        Some((_, "npy")) => Ok(FileForm::Npy),
        Some((_, "zarr")) => Ok(FileForm::Zarr),
        Some((_, "svg")) => Ok(FileForm::Svg),
        _ => {
            let message = format!("`{}` has no known form", file.text);
            let help = "a name ends in `.csv`, `.npy`, `.zarr` or `.svg`";
            Err(file.error(message, help))
        }
    }
}

/// Checks the names of all files.
pub(super) fn check(study: &Study) -> Result<(), Box<Diagnostic>> {
    for file in &study.write {
        form(file)?;
    }
    for file in &study.events {
        if ![FileForm::Csv, FileForm::Npy].contains(&form(file)?) {
            let message = format!("events are a table, and `{}` is none", file.text);
            return Err(file.error(message, "a name ends in `.csv` or `.npy`"));
        }
    }
    Ok(())
}

/// Writes the table of the orbit into a store of one member, whose columns have the dimension of the time.
fn zarr(table: &Table, path: &str) -> Result<(), hamiltonian_core::Error> {
    let [clock, columns @ ..] = table.columns() else {
        return Ok(());
    };
    let column = |name: &String| -> Vec<f64> { table.column(name).into_iter().flatten().collect() };
    let values = column(clock);
    let time = values.last().copied().unwrap_or(f64::NAN);
    let layout = Layout {
        rows: Rows::At {
            name: clock.clone(),
            values,
        },
        chunk: 1,
        ..Layout::new(1, columns)
    };
    let data = ChunkData {
        columns: columns.iter().map(column).collect(),
        status: vec![1],
        time: vec![time],
        steps: vec![0],
        ..ChunkData::default()
    };
    Store::open_or_create(path, &layout)?.write(0, &data)
}

/// Writes one table into one file.
fn one(table: &Table, coordinates: usize, file: &Word) -> Result<(), Box<Diagnostic>> {
    let written = || -> Result<(), Box<dyn Error>> {
        let form = form(file).map_err(|error| error.message)?;
        if form == FileForm::Zarr {
            return Ok(zarr(table, file.text)?);
        }
        let mut into = BufWriter::new(File::create(file.text)?);
        match form {
            FileForm::Npy => table.write_npy(&mut into)?,
            FileForm::Svg => into.write_all(picture(table, coordinates).as_bytes())?,
            FileForm::Csv | FileForm::Zarr => table.write_csv(&mut into)?,
        }
        Ok(into.flush()?)
    };
    written().map_err(|error| {
        let help = "write into a folder that is there and has room";
        file.error(format!("`{}` cannot be written: {error}", file.text), help)
    })
}

/// Writes all files; without one, the table of the orbit as CSV to the standard output.
pub(super) fn write(study: &Study, tables: &Tables) -> Result<(), String> {
    if study.write.is_empty() {
        let out = io::stdout().lock();
        tables
            .orbit
            .write_csv(out)
            .map_err(|error| format!("error: {error}"))?;
    }
    for file in &study.write {
        one(&tables.orbit, tables.coordinates, file).map_err(|error| error.to_string())?;
    }
    for file in &study.events {
        one(&tables.events, 0, file).map_err(|error| error.to_string())?;
    }
    Ok(())
}
