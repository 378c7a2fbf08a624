//! The cost of a definition in its user's build: the time in the macro, compiled as cargo compiles it,
//! and the time of rustc on programs: definitions written out term by term, lattices, and a pendulum with and without
//! an ensemble.
//!
//! `cargo bench --bench compile` prints the least CPU time of several builds; nothing depends on it. The
//! test `budgets` counts the macro's instructions. `cargo bench --bench compile -- pendulum` builds the programs whose
//! names contain the word alone.

#[allow(dead_code)]
#[path = "../tests/toolchain/cargo.rs"]
mod cargo;

use cargo::{Package, Workspace, workspace, write};
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

fn main() {
    let filter = std::env::args().skip(1).find(|word| !word.starts_with('-'));
    if filter.is_none() {
        macros();
    }
    programs(&filter.unwrap_or_default());
}

/// The time in the macro, for each definition of the examples.
fn macros() {
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
}

/// The CPU time of cargo and rustc, for each program.
fn programs(filter: &str) {
    println!(
        "{:<28} {:>10} {:>10} {:>10}",
        "CPU time, s", "check", "debug", "release"
    );
    let programs = [
        ("nothing", "fn main() {}".to_owned()),
        ("toda_512", program(&toda(512), 512)),
        ("waves_1600", program(&waves(1600), 1)),
        ("waves_4000", program(&waves(4000), 1)),
        ("sine_gordon", lattice(false)),
        ("sine_gordon_256", lattice(true)),
        ("pendulum", PENDULUM.to_owned()),
        ("pendulum_ensemble", ensemble()),
    ];
    let workspace = workspace("compile", &[Package::new("compile", "")]);
    let folder = workspace.path.join("compile/src/bin");
    std::fs::create_dir_all(&folder).expect("the target directory can be written to");
    let programs = programs.iter().filter(|(name, _)| name.contains(filter));
    for (name, text) in programs.clone() {
        write(&folder.join(format!("{name}.rs")), &format!("{text}\n"));
    }
    for (name, _) in programs {
        let file = folder.join(format!("{name}.rs"));
        let builds: [&[&str]; 3] = [&["check"], &["build"], &["build", "--release"]];
        let times = builds.map(|build| {
            let seconds = time(&workspace, &file, &[build, &["--bin", name]].concat());
            format!("{:>10.2}", seconds.as_secs_f64())
        });
        println!("{name:<28} {}", times.join(" "));
    }
}

/// The least of three CPU times that cargo takes when nothing but one file is new. The builds are not incremental, as in
/// a new clone.
fn time(workspace: &Workspace, file: &Path, arguments: &[&str]) -> Duration {
    let run = || {
        let text = std::fs::read(file).expect("it was written");
        std::fs::write(file, text).expect("it can be written again");
        let (start, before) = (Instant::now(), of_children());
        let outcome = workspace.cargo(arguments);
        let passed = start.elapsed();
        assert!(outcome.success, "{}", outcome.text);
        match (before, of_children()) {
            (Some(before), Some(after)) => after.saturating_sub(before),
            _ => passed,
        }
    };
    // The first compiles what the package depends on.
    run();
    (0..3).map(|_| run()).min().unwrap_or_default()
}

/// The CPU time of the processes that this one has waited for, and of those that they have waited for; `None` where there
/// is no `/proc`.
fn of_children() -> Option<Duration> {
    /// A tick is a hundredth of a second on every Linux.
    const TICK: Duration = Duration::from_millis(10);
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in brackets, may have spaces. The fields after it are numbered from 3 in proc(5):
    // 16 and 17 are the times of children, by users and by the system.
    let (_, fields) = text.rsplit_once(')')?;
    let mut fields = fields.split_whitespace().skip(13);
    let mut next = || fields.next()?.parse::<u32>().ok();
    Some(TICK * (next()? + next()?))
}

/// One pendulum.
const PENDULUM: &str = "use hamiltonian::prelude::*;
hamiltonian! {
    pub struct Pendulum { m = 1.0, l = 1.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}
fn main() -> Result<(), Error> {
    let start = State::new([0.5], [0.0]);
    let mut run = Integrator::new(&Pendulum::default(), StormerVerlet::default(), start, 1e-3)?;
    run.advance(1000)?;
    println!(\"{}\", run.state().q[0]);
    Ok(())
}";

/// The same with many of them.
fn ensemble() -> String {
    PENDULUM.replace(
        "    Ok(())",
        "    let start = |member: Member| (Pendulum::default(), State::new([member.index as f64], [0.0]));
    let mut many = Ensemble::new(1000, start, StormerVerlet::default(), 1e-3)?;
    many.advance(1000);
    println!(\"{:?}\", many.states().next());
    Ok(())",
    )
}

/// The sine-Gordon equation on a ring of n sites, or of n rows of 256.
fn lattice(rows: bool) -> String {
    let (definition, zeros) = match rows {
        false => (
            "H(u[n]; p[n]) = sum(i in 0..n) {
        p[i]^2/2 + (u[(i + 1) % n] - u[i])^2/2 + 1 - cos(u[i])
    }",
            "vec![0.1; 1000]",
        ),
        true => (
            "H(u[n][256]; p[n][256]) = sum(i in 0..n, j in 0..256) {
        p[i][j]^2/2 + (u[(i + 1) % n][j] - u[i][j])^2/2 + (u[i][(j + 1) % 256] - u[i][j])^2/2 + 1 - cos(u[i][j])
    }",
            "vec![[0.1; 256]; 1000]",
        ),
    };
    format!(
        "use hamiltonian::prelude::*;
hamiltonian! {{
    pub struct Field {{ n: usize }}
    {definition}
}}
fn main() -> Result<(), Error> {{
    let start = State::new({zeros}, {zeros});
    let mut run = Integrator::new(&Field::new(1000)?, StormerVerlet::default(), start, 0.1)?;
    run.advance(100)?;
    println!(\"{{}}\", run.state().t);
    Ok(())
}}"
    )
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
