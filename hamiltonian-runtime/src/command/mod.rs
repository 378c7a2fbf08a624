//! A definition with its run in one text file, to tables: the command `hamiltonian-run FILE`.
//!
//! Input: a file, of which the chapter "From a file" of the guide has the form. Output: the files that it names, or CSV on the
//! standard output. Invariant: an error has its place in the file and a remedy; states before a failed step are written.

mod calculate;
mod picture;
mod places;
mod study;
mod tables;

use crate::schemes::{NamedScheme, schemes};
use std::io::Write;

const HELP: &str = "\
usage: hamiltonian-run FILE

Runs the definition in FILE, a text in the language of `hamiltonian!`, as the lines below `---` say:

    struct Pendulum { l = 1.0, g = 9.81 }
    H(theta; p) = p^2/(2*l^2) - g*l*cos(theta);
    event bottom = theta
    ---
    with l = 2.0
    start theta = 0.5, p = 0
    run t = 0..100, every = 0.1, tolerance = 1e-10
    write pendulum.csv, pendulum.svg
    events bottom.csv

Instead of `tolerance`, `scheme = GaussNystrom8, step = 0.1`. A file ends in `.csv`, `.npy` (NumPy), `.zarr` (a store, for
xarray) or `.svg` (a picture of the coordinates). Without `write`, the table goes to the standard output.

    hamiltonian-run --schemes    the names of all schemes";

/// Runs the command `hamiltonian-run` with its arguments, without the name of the program: a file, `--schemes` or `--help`.
///
/// # Errors
/// The text for the standard error: the usage, an error of the file with its place, a failed step.
///
/// ```
/// let error = hamiltonian_runtime::command(["missing.ham"]).unwrap_err();
/// assert!(error.starts_with("error: missing.ham: "));
/// assert!(hamiltonian_runtime::command([""; 0]).unwrap_err().starts_with("usage: hamiltonian-run FILE"));
/// ```
pub fn command<A: AsRef<str>>(arguments: impl IntoIterator<Item = A>) -> Result<(), String> {
    let arguments: Vec<A> = arguments.into_iter().collect();
    let arguments: Vec<&str> = arguments.iter().map(AsRef::as_ref).collect();
    match arguments.as_slice() {
        ["--help" | "-h"] => {
            show(&format!("{HELP}\n"));
            Ok(())
        }
        ["--schemes"] => {
            let line = |scheme: NamedScheme| {
                let entry = scheme.entry;
                let (name, order, needs) = (scheme.name, entry.order, entry.needs.to_string());
                format!("{name:44} order {order:2}, needs {needs}\n")
            };
            let all: String = schemes().map(line).collect();
            show(&all);
            Ok(())
        }
        [file] if !file.starts_with('-') => run(file),
        _ => Err(HELP.to_owned()),
    }
}

/// Writes to the standard output. Whoever reads it may have read enough.
fn show(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// Runs a file.
fn run(file: &str) -> Result<(), String> {
    let text = std::fs::read_to_string(file).map_err(|error| format!("error: {file}: {error}"))?;
    let study = study::read(&text, file).map_err(|error| error.to_string())?;
    tables::check(&study).map_err(|error| error.to_string())?;
    let (tables, ended) = calculate::calculate(&study)?;
    tables::write(&study, &tables)?;
    ended
}
