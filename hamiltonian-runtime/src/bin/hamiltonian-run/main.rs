//! `hamiltonian-run FILE`: a definition with its run in one text file, to tables.
//!
//! Input: a file, of which the chapter "From a file" of the guide has the form. Output: the files that it names, or CSV on the
//! standard output. Invariant: an error has its place in the file and a remedy; states before a failed step are written.
#![forbid(unsafe_code)]

mod calculate;
mod places;
mod study;
mod tables;

use std::io::Write;
use std::process::ExitCode;

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
    write pendulum.csv
    events bottom.csv

Instead of `tolerance`, `scheme = GaussNystrom8, step = 0.1`. Without `write`, the table goes to the standard output.

    hamiltonian-run --schemes    the names of all schemes";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let done = match (arguments.next().as_deref(), arguments.next()) {
        (Some("--help" | "-h"), None) => {
            println!("{HELP}");
            Ok(())
        }
        (Some("--schemes"), None) => {
            let line = |scheme: hamiltonian_runtime::NamedScheme| {
                let entry = scheme.entry;
                let (name, order, needs) = (scheme.name, entry.order, entry.needs.to_string());
                format!("{name:44} order {order:2}, needs {needs}\n")
            };
            let all: String = hamiltonian_runtime::schemes().map(line).collect();
            // Whoever reads them may have read enough.
            let _ = std::io::stdout().write_all(all.as_bytes());
            Ok(())
        }
        (Some(file), None) if !file.starts_with('-') => run(file),
        _ => Err(HELP.to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
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
