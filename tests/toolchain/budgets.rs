//! Budgets of the macro: instructions of the pipeline, compiled without optimisation as cargo
//! compiles it for its users.
//!
//! One definition is counted, with `HAMILTONIAN_HEAVY=1` each of every example; products of up to 100
//! factors, with it of up to 400.
//!
//! `cargo bench --bench compile` prints times.

use crate::{cargo, valgrind};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Instructions that a system may take on its way through the macro; each piece of a declared split is
/// one too, and an expression is one.
const SYSTEM: u64 = 200_000_000;

/// And the search for pieces with exact flows.
const SEARCH: u64 = 200_000_000;

/// Bodies in Jacobi's coordinates are written out one by one: six are 36 variables, in three systems.
const WRITTEN_OUT: (&str, u64) = ("wisdom_holman 1", 16 * SYSTEM);

#[test]
fn examples_are_expanded_within_their_budget() {
    if !valgrind::is_there() {
        cargo::note("SKIPPED: valgrind is not on this machine, instructions are not counted");
        return;
    }
    let show = cargo::show();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut files: Vec<_> = fs::read_dir(&examples)
        .expect("there are examples")
        .map(|entry| entry.expect("it can be listed").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect();
    files.sort();
    if !crate::is_heavy() {
        files.retain(|file| file.ends_with("toda.rs"));
    }
    let mut counts = Vec::new();
    for file in &files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        let text = fs::read_to_string(file).expect("an example can be read");
        let definitions = text.matches("hamiltonian! {").count();
        for number in 0..definitions {
            let arguments = [
                file.as_os_str(),
                "--number".as_ref(),
                number.to_string().as_ref(),
            ]
            .map(|argument: &std::ffi::OsStr| argument.to_owned());
            let count = valgrind::instructions(&show, &arguments, Some("*expanded*"))
                .unwrap_or_else(|| panic!("definition {number} of {name} is not expanded"));
            cargo::note(&format!("{count:>12} instructions: {name} {number}"));
            let printed = Command::new(&show).args(&arguments).output();
            let printed = printed.expect("it is expanded once more").stdout;
            let printed = String::from_utf8(printed).expect("names are text");
            let (systems, searched) = printed.split_once(" systems").expect("they are counted");
            let systems: u64 = systems.parse().expect("a number of systems");
            let search = if searched.contains("searched") {
                SEARCH
            } else {
                0
            };
            let name = format!("{name} {number}");
            let budget = match WRITTEN_OUT {
                (exception, budget) if exception == name => budget,
                _ => systems.max(1) * SYSTEM + search,
            };
            counts.push((name, count, budget));
        }
    }
    // A count of nothing would pass anything.
    assert!(counts.len() >= if crate::is_heavy() { 10 } else { 1 });
    assert!(counts.iter().all(|(_, count, _)| *count > 10_000_000));
    let over = counts.iter().filter(|(_, count, budget)| count > budget);
    let over: Vec<_> = over.collect();
    assert!(over.is_empty(), "past their budget: {over:?}");
}

#[test]
fn products_grow_nearly_linearly() {
    if !valgrind::is_there() {
        cargo::note("SKIPPED: valgrind is not on this machine, instructions are not counted");
        return;
    }
    let show = cargo::show();
    let count = |name: &str, text: &str| {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.rs"));
        fs::write(&file, text).expect("the target directory can be written to");
        let arguments = [file.as_os_str(), "--number".as_ref(), "0".as_ref()];
        let count = valgrind::instructions(&show, &arguments, Some("*expanded*"));
        let count = count.unwrap_or_else(|| panic!("{name} is not expanded"));
        cargo::note(&format!("{count:>12} instructions: {name}"));
        count
    };
    let names = |letter: char, count: usize| {
        let names: Vec<String> = (0..count).map(|at| format!("{letter}{at}")).collect();
        names.join(", ")
    };
    let sines = |count: usize| {
        let factors: Vec<String> = (1..=count).map(|k| format!("sin({k}*q)")).collect();
        format!("hamiltonian! {{ H(q; p) = p^2/2 + {} }}", factors.join("*"))
    };
    let scalars = |count: usize| {
        let (q, p) = (names('q', count), names('p', count));
        let (product, squares) = (q.replace(", ", "*"), p.replace(", ", "^2 + "));
        format!("hamiltonian! {{ H({q}; {p}) = {product} + {squares}^2 }}")
    };
    let array = |count: usize| {
        let factors: Vec<String> = (0..count).map(|at| format!("q[{at}]")).collect();
        let squares: Vec<String> = (0..count).map(|at| format!("p[{at}]^2")).collect();
        let (product, squares) = (factors.join("*"), squares.join(" + "));
        format!("hamiltonian! {{ H(q[{count}]; p[{count}]) = {product} + {squares} }}")
    };
    // Quadratic terms show in the large ones best, which take a minute.
    let by = if crate::is_heavy() { 4 } else { 1 };
    let sines = [25 * by, 100 * by].map(|n| count(&format!("sines {n}"), &sines(n)));
    let scalars = [12 * by, 48 * by].map(|n| count(&format!("scalars {n}"), &scalars(n)));
    let array = [12 * by, 48 * by].map(|n| count(&format!("array {n}"), &array(n)));
    for [few, many] in [sines, scalars, array] {
        assert!(few > 10_000_000 && many <= 5 * few, "{few} becomes {many}");
    }
    assert!(array[1] <= scalars[1], "{array:?} past {scalars:?}");
}
