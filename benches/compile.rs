//! The cost of a definition in its user's build: the time in the macro, compiled as cargo compiles it,
//! and the time of rustc with full optimisation on definitions written out term by term.
//!
//! `cargo bench --bench compile` prints the shortest of several times; nothing depends on them. The
//! test `budgets` counts the macro's instructions.

#[allow(dead_code)]
#[path = "../tests/cargo/mod.rs"]
mod cargo;

use cargo::{Package, Workspace, workspace, write};
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

fn main() {
    println!("{:<28} {:>10}", "in the macro", "ms");
    let show = cargo::show();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut examples: Vec<_> = std::fs::read_dir(root.join("examples"))
        .expect("there are examples")
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    examples.sort();
    for file in examples {
        let output = Command::new(&show).arg(&file).arg("--time").output();
        let text = String::from_utf8(output.expect("it runs").stdout).expect("numbers are text");
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        for (number, time) in text.lines().enumerate() {
            println!("{:<28} {time:>10}", format!("{name} {number}"));
        }
    }

    println!("\n{:<28} {:>10} {:>10}", "rustc", "check, s", "-O3, s");
    let programs = [
        ("nothing", "fn main() {}".to_owned()),
        ("toda_512", program(&toda(512), 512)),
        ("waves_1600", program(&waves(1600), 1)),
        ("waves_4000", program(&waves(4000), 1)),
    ];
    let workspace = workspace("compile", &[Package::new("compile", "")]);
    let folder = workspace.path.join("compile/src/bin");
    std::fs::create_dir_all(&folder).expect("the target directory can be written to");
    for (name, text) in &programs {
        write(&folder.join(format!("{name}.rs")), &format!("{text}\n"));
    }
    for (name, _) in &programs {
        let file = folder.join(format!("{name}.rs"));
        let check = time(&workspace, &file, &["check", "--bin", name]);
        let build = time(&workspace, &file, &["build", "--release", "--bin", name]);
        let seconds = |time: Duration| time.as_secs_f64();
        println!(
            "{name:<28} {:>10.2} {:>10.2}",
            seconds(check),
            seconds(build)
        );
    }
}

/// The shortest of three times that cargo takes when nothing but one file is new.
fn time(workspace: &Workspace, file: &Path, arguments: &[&str]) -> Duration {
    let run = || {
        let text = std::fs::read(file).expect("it was written");
        std::fs::write(file, text).expect("it can be written again");
        let start = Instant::now();
        let outcome = workspace.cargo(arguments);
        let time = start.elapsed();
        assert!(outcome.success, "{}", outcome.text);
        time
    };
    // The first compiles what the package depends on.
    run();
    (0..3).map(|_| run()).min().unwrap_or_default()
}

/// A program that uses value and gradient of a system with that many coordinates.
fn program(definition: &str, coordinates: usize) -> String {
    format!(
        "use hamiltonian::prelude::*;
hamiltonian! {{ pub struct Written {{}} {definition} }}
fn main() {{
    let state = State::new([0.1; {coordinates}], [0.2; {coordinates}]);
    let system = Written::default();
    println!(\"{{}} {{:?}}\", system.energy(&state), system.gradient(&state));
}}"
    )
}

/// A periodic Toda lattice written out.
fn toda(n: usize) -> String {
    let list = |letter: char| {
        let names: Vec<String> = (0..n).map(|i| format!("{letter}{i}")).collect();
        names.join(", ")
    };
    let mut text = format!("H({}; {}) = 0", list('q'), list('p'));
    for i in 0..n {
        let next = (i + 1) % n;
        write!(text, " + p{i}^2/2 + exp(q{i} - q{next})").expect("strings can be written to");
    }
    text
}

/// `sin(q) + sin(2*q) + …`: with the gradient five operations a term.
fn waves(terms: usize) -> String {
    let mut text = String::from("H = p^2/2 + sin(q)");
    for k in 2..=terms {
        write!(text, " + sin({k}*q)").expect("strings can be written to");
    }
    text
}
