//! The cost of a release build of a user's program: CPU seconds of rustc and the linker, the same in units, and the peak
//! memory.
//!
//! Input: the programs of `benches/builds`, one in a file; with `-- --book` also those of the book. Output: a line for
//! each, with the library already built; with `-- --debug` of a debug build. A unit is the CPU time of `readme.rs`,
//! measured first; with `-- --unit SECONDS` it is given, to compare revisions. With a name, `-- toda`, only the programs
//! are built whose name begins with it. Programs are built in a package of their own under `target/builds`, as a user's
//! are. CPU time and memory are those that GNU `time` reports of cargo and all that it starts; without `/usr/bin/time`
//! nothing is measured.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

const TIME: &str = "/usr/bin/time";

fn main() -> Result<(), Box<dyn Error>> {
    if !Path::new(TIME).exists() {
        println!("SKIPPED: {TIME} is not on this machine");
        return Ok(());
    }
    let (mut unit, mut only, mut has_book) = (None, String::new(), false);
    let mut profile = "release";
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--unit" => unit = Some(arguments.next().unwrap_or_default().parse::<f64>()?),
            "--debug" => profile = "dev",
            "--book" => has_book = true,
            name if !name.starts_with("--") => only = argument,
            _ => {}
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let package = root.join("target/builds");
    let mut programs = files(&root.join("benches/builds"), "rs")?;
    let mut features = "";
    if has_book {
        features = ", features = [\"linear-algebra\", \"plot\", \"progress\"]";
        programs.extend(book(&root.join("book/src"), &package)?);
    }
    let names: Vec<String> = programs.iter().map(|path| name(path)).collect();
    std::fs::create_dir_all(&package)?;
    let mut manifest = format!(
        "[package]\nname = \"builds\"\nedition = \"2024\"\n[workspace]\n\
         [dependencies]\nhamiltonian = {{ package = \"hamiltonian-dynamics\", path = {root:?}{features} }}\n"
    );
    for (name, path) in names.iter().zip(&programs) {
        write!(manifest, "[[bin]]\nname = {name:?}\npath = {path:?}\n")?;
    }
    std::fs::write(package.join("Cargo.toml"), manifest)?;
    // The library is built with the first program, which is then built again.
    build(&package, profile, "readme")?;
    let [readme, _] = build(&package, profile, "readme")?;
    let unit = unit.unwrap_or(readme);
    println!(
        "{:<24} {:>8} {:>8} {:>8}",
        "program", "CPU s", "units", "MB"
    );
    for name in names.iter().filter(|name| name.starts_with(&only)) {
        let [seconds, megabytes] = build(&package, profile, name)?;
        println!(
            "{name:<24} {seconds:>8.1} {:>8.1} {megabytes:>8.0}",
            seconds / unit
        );
    }
    Ok(())
}

/// The files with an extension in a folder and those in it, sorted.
fn files(folder: &Path, extension: &str) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            found.extend(files(&path, extension)?);
        } else if path.extension().is_some_and(|other| other == extension) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// The name of a file without its extension.
fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// The programs of the book that need no other crate, each written to a file of the package.
fn book(chapters: &Path, package: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let sources = package.join("book");
    std::fs::create_dir_all(&sources)?;
    let mut found = Vec::new();
    for chapter in files(chapters, "md")? {
        let text = std::fs::read_to_string(&chapter)?;
        let listings = text.split("```rust\n").skip(1);
        let listings = listings.filter_map(|rest| rest.split("\n```").next());
        let programs = listings.filter(|listing| {
            listing.contains("fn main()")
                && !listing.contains("ode_solvers")
                && !listing.contains("argmin")
        });
        for (k, listing) in programs.enumerate() {
            // Lines that the book hides.
            let lines = listing.lines().map(|line| match line {
                "#" => "",
                line => line.strip_prefix("# ").unwrap_or(line),
            });
            let path = sources.join(format!("book_{}_{k}.rs", name(&chapter)));
            std::fs::write(&path, lines.collect::<Vec<_>>().join("\n"))?;
            found.push(path);
        }
    }
    Ok(found)
}

/// Builds a program, also if it is built already: the CPU seconds and the peak memory in MB.
fn build(package: &Path, profile: &str, name: &str) -> Result<[f64; 2], Box<dyn Error>> {
    // Another condition each time, so that cargo does not take the program from before.
    let now = SystemTime::now().duration_since(UNIX_EPOCH)?.as_nanos();
    let anew = format!("anew=\"{now}\"");
    let mut command = Command::new(TIME);
    command.args([
        "-f",
        "%U %S %M",
        "cargo",
        "rustc",
        "--quiet",
        "--profile",
        profile,
        "--bin",
        name,
    ]);
    command.args(["--", "--cfg", &anew]);
    // The target directory of this bench is another one.
    command.env_remove("CARGO_TARGET_DIR").current_dir(package);
    let output = command.output()?;
    let text = String::from_utf8_lossy(&output.stderr);
    let last = text.lines().last().unwrap_or_default();
    let numbers: Vec<f64> = last.split(' ').flat_map(str::parse).collect();
    match numbers[..] {
        [user, system, kilobytes] if output.status.success() => {
            Ok([user + system, kilobytes / 1e3])
        }
        _ => Err(format!("{name} is not built: {text}").into()),
    }
}
