//! The files of a run.
//!
//! Input: tables, names of files. Output: the files, by the ends of their names. Invariant: a name that no file can have is
//! refused before the run.

use super::calculate::Tables;
use super::places::Word;
use super::study::Study;
use crate::Diagnostic;
use hamiltonian_core::Table;
use std::fs::File;
use std::io::{self, BufWriter, Write};

/// The forms of files.
#[derive(Clone, Copy)]
enum FileForm {
    Csv,
    Npy,
}

/// The form of a file, by the end of its name.
fn form(file: &Word) -> Result<FileForm, Box<Diagnostic>> {
    match file.text.rsplit_once('.') {
        Some((_, "csv")) => Ok(FileForm::Csv),
        Some((_, "npy")) => Ok(FileForm::Npy),
        _ => {
            let message = format!("`{}` has no known form", file.text);
            Err(file.error(message, "a name ends in `.csv` or `.npy`"))
        }
    }
}

/// Checks the names of all files.
pub(super) fn check(study: &Study) -> Result<(), Box<Diagnostic>> {
    let mut files = study.write.iter().chain(&study.events);
    files.try_for_each(|file| form(file).map(|_| ()))
}

/// Writes one table into one file.
fn one(table: &Table, file: &Word) -> Result<(), Box<Diagnostic>> {
    let written = || -> Result<(), Box<dyn std::error::Error>> {
        let form = form(file).map_err(|error| error.message)?;
        let mut into = BufWriter::new(File::create(file.text)?);
        match form {
            FileForm::Csv => table.write_csv(&mut into)?,
            FileForm::Npy => table.write_npy(&mut into)?,
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
        one(&tables.orbit, file).map_err(|error| error.to_string())?;
    }
    for file in &study.events {
        one(&tables.events, file).map_err(|error| error.to_string())?;
    }
    Ok(())
}
