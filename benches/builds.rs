//! The cost of a release build of a user's program: CPU seconds of rustc and the linker, the same in units, and the peak
//! memory.
//!
//! Input: the programs of `benches/builds`, one in a file. Output: a line for each, with the library already built. A
//! unit is the CPU time of `readme.rs`, measured first; with `-- --unit SECONDS` it is given, to compare revisions.
//! With a name, `-- toda`, only the programs are built whose name begins with it. Programs are built in a package of
//! their own under `target/builds`, as a user's are. CPU time and memory are those that GNU `time` reports of cargo and
//! all that it starts; without `/usr/bin/time` nothing is measured.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

const TIME: &str = "/usr/bin/time";

fn main() -> Result<(), Box<dyn Error>> {
    if !Path::new(TIME).exists() {
        println!("SKIPPED: {TIME} is not on this machine");
        return Ok(());
    }
    let (mut unit, mut only) = (None, String::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--unit" => unit = Some(arguments.next().unwrap_or_default().parse::<f64>()?),
            name if !name.starts_with("--") => only = argument,
            _ => {}
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let sources = root.join("benches/builds");
    let mut names = Vec::new();
    for entry in std::fs::read_dir(&sources)? {
        let path = entry?.path();
        names.extend(
            path.file_stem()
                .map(|name| name.to_string_lossy().into_owned()),
        );
    }
    names.sort();
    let package = root.join("target/builds");
    std::fs::create_dir_all(&package)?;
    let mut manifest = format!(
        "[package]\nname = \"builds\"\nedition = \"2024\"\n[workspace]\n\
         [dependencies]\nhamiltonian = {{ package = \"hamiltonian-dynamics\", path = {root:?} }}\n"
    );
    for name in &names {
        let path = sources.join(format!("{name}.rs"));
        write!(manifest, "[[bin]]\nname = {name:?}\npath = {path:?}\n")?;
    }
    std::fs::write(package.join("Cargo.toml"), manifest)?;
    // The library is built with the first program, which is then built again.
    build(&package, "readme")?;
    let [readme, _] = build(&package, "readme")?;
    let unit = unit.unwrap_or(readme);
    println!(
        "{:<20} {:>8} {:>8} {:>8}",
        "program", "CPU s", "units", "MB"
    );
    for name in names.iter().filter(|name| name.starts_with(&only)) {
        let [seconds, megabytes] = build(&package, name)?;
        println!(
            "{name:<20} {seconds:>8.1} {:>8.1} {megabytes:>8.0}",
            seconds / unit
        );
    }
    Ok(())
}

/// Builds a program, also if it is built already: the CPU seconds and the peak memory in MB.
fn build(package: &Path, name: &str) -> Result<[f64; 2], Box<dyn Error>> {
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
        "--release",
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
