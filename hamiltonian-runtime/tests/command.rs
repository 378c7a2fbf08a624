//! The command `hamiltonian-run`, as a program.
//!
//! Input: files. Output: a panic with what it writes. Invariant: its numbers are those of a run, and each error has its place.

use hamiltonian::prelude::State;
use hamiltonian_runtime::{Definition, Run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const DEFINITION: &str = "struct Pendulum { l = 1.0, g = 9.81 }
H(theta; p) = p^2/(2*l^2) - g*l*cos(theta);
event bottom = theta
";

/// A folder of a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder is made");
    folder
}

/// Runs the command on a text in a folder.
fn command(folder: &Path, text: &str) -> Output {
    fs::write(folder.join("study.ham"), text).expect("a file is written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_hamiltonian-run"));
    command.current_dir(folder).arg("study.ham");
    command.output().expect("the command runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("it is text")
}

/// The error of a text.
fn refused(lines: &str) -> String {
    let output = command(&folder("refused"), &format!("{DEFINITION}{lines}"));
    assert!(!output.status.success(), "{lines}");
    text(&output.stderr)
}

#[test]
fn a_file_becomes_the_tables_of_its_run() {
    let folder = folder("tables");
    let lines = "---
with l = 2.0              // metres
start theta = 0.5, p = 0
run t = 0..2, every = 0.25, scheme = BlanesMoan6, step = 0.1

write orbit.csv, orbit.npy, orbit.zarr, orbit.svg
events crossings.csv
";
    let output = command(&folder, &format!("{DEFINITION}{lines}"));
    assert_eq!(text(&output.stderr), "");
    assert!(output.status.success() && output.stdout.is_empty());

    let definition = Definition::parse(DEFINITION, "text").expect("it is right");
    let system = definition.system([("l", 2.0)]).expect("it is right");
    let start = State::new(vec![0.5], vec![0.0]);
    let mut run = Run::new(&system, "BlanesMoan6", start, 0.1).expect("it fits");
    let times: Vec<f64> = (0..9).map(|k| 0.25 * f64::from(k)).collect();
    let (states, _) = run.states_at(&times);
    let csv = fs::read_to_string(folder.join("orbit.csv")).expect("it is written");
    let mut rows = csv.lines();
    assert_eq!(rows.next(), Some("t,theta,p,H,bottom"));
    for state in &states {
        let row = rows.next().expect("a row for each time");
        let numbers: Vec<f64> = row
            .split(',')
            .map(|one| one.parse().expect("a number"))
            .collect();
        assert_eq!(numbers[..3], [state.t, state.q[0], state.p[0]]);
        assert_eq!(numbers[4], state.q[0]);
    }
    assert_eq!(rows.next(), None);
    let crossings = fs::read_to_string(folder.join("crossings.csv")).expect("it is written");
    assert_eq!(crossings.lines().next(), Some("event,rising,t,theta,p"));
    assert_eq!(crossings.lines().count(), 1 + run.crossings().count());
    assert!(run.crossings().count() > 0);
    assert!(
        fs::read(folder.join("orbit.npy"))
            .expect("it is written")
            .starts_with(b"\x93NUMPY")
    );
    // A store of one member, with the dimension of the time.
    let bytes = |name: &str| fs::read(folder.join("orbit.zarr").join(name)).expect("it is written");
    let numbers =
        |all: &mut dyn Iterator<Item = f64>| all.flat_map(f64::to_le_bytes).collect::<Vec<u8>>();
    assert_eq!(bytes("t/c/0"), numbers(&mut times.iter().copied()));
    assert_eq!(
        bytes("p/c/0/0"),
        numbers(&mut states.iter().map(|state| state.p[0]))
    );
    // The picture has one curve, from the left to the right; its lowest point is the least angle.
    let svg = fs::read_to_string(folder.join("orbit.svg")).expect("it is written");
    let curve = svg.rsplit_once("<path d=\"M80.00 ");
    let (_, curve) = curve.expect("it begins on the left");
    let (curve, rest) = curve.split_once('"').expect("it ends");
    let place = |point: &str| -> f64 {
        let y = point.split_whitespace().next_back().expect("two numbers");
        y.parse().expect("a number")
    };
    let places: Vec<f64> = curve.split('L').map(place).collect();
    assert_eq!(places.len(), times.len());
    assert!(curve.contains("L780.00 ") && rest.contains("<title>theta</title>"));
    assert_eq!(svg.matches("<title>").count(), 1);
    let least = |all: &[f64]| (0..all.len()).min_by(|a, b| all[*a].total_cmp(&all[*b]));
    let angles: Vec<f64> = states.iter().map(|state| -state.q[0]).collect();
    assert_eq!(least(&places), least(&angles));
    assert!(places.contains(&400.0) && places.contains(&20.0));
}

#[test]
fn arrays_are_lists_of_rows_and_the_table_goes_to_the_standard_output() {
    let lines = "struct Bodies { n: usize, m: [n] }
H(q[n][2]; p[n][2]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) } + norm_squared(q[1] - q[0])/2
---
with n = 2, m = [1, 4]
start q = [[1, 2], [3, 4]], p = 0
run t = 1..0.5, every = 0.5, scheme = StormerVerlet, step = 0.125
";
    let output = command(&folder("arrays"), lines);
    assert_eq!(text(&output.stderr), "");
    let csv = text(&output.stdout);
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!(
        rows[0],
        "t,q[0][0],q[0][1],q[1][0],q[1][1],p[0][0],p[0][1],p[1][0],p[1][1],H"
    );
    assert!(
        rows[1].starts_with("1,1,2,3,4,0,0,0,0,") || rows[1].starts_with("1.0,1.0,2.0,3.0,4.0,"),
        "{}",
        rows[1]
    );
    assert!(rows[2].starts_with("0.5,") && rows.len() == 3, "{csv}");
}

#[test]
fn errors_have_a_place_and_a_remedy() {
    let caret =
        refused("---\nstart theta = 0.5, q = 1\nrun t = 0..1, every = 0.1, tolerance = 1e-8\n");
    assert_eq!(
        caret,
        "error: there is no coordinate or momentum `q`
 --> study.ham:5:20
  |
5 | start theta = 0.5, q = 1
  |                    ^
  = help: there are `theta`, `p`
"
    );
    let start = "---\nstart theta = 0.5, p = 0\n";
    let times = "run t = 0..1, every = 0.1";
    let begin = |lines: &str| refused(lines).lines().take(2).collect::<Vec<_>>().join(" ");
    for (lines, due) in [
        (
            String::new(),
            "error: the file does not say how the definition runs  --> study.ham:3:1",
        ),
        (
            "---\n".to_owned(),
            "error: there is no line `run`  --> study.ham:4:1",
        ),
        (
            format!("{start}{times}\n"),
            "error: `run` has no tolerance and no scheme  --> study.ham:6:1",
        ),
        (
            format!("{start}{times}, step = 1\n"),
            "error: `run` has no scheme  --> study.ham:6:1",
        ),
        (
            format!("{start}{times}, scheme = Strang\n"),
            "error: `run` has no step  --> study.ham:6:1",
        ),
        (
            format!("{start}{times}, tolerance = 1e-8, step = 0.1\n"),
            "error: `run` has a tolerance and a scheme or a step  --> study.ham:6:1",
        ),
        (
            format!("{start}run every = 1\n"),
            "error: `run` has no times  --> study.ham:6:1",
        ),
        (
            format!("{start}run t = 0..0\n"),
            "error: the run ends where it begins  --> study.ham:6:9",
        ),
        (
            format!("{start}run t = 0..x\n"),
            "error: `x` is not a number  --> study.ham:6:12",
        ),
        (
            format!("{start}run t = 0..inf\n"),
            "error: `inf` is not a number  --> study.ham:6:12",
        ),
        (
            format!("{start}run t = 0..1, every = -1\n"),
            "error: expected a positive number  --> study.ham:6:23",
        ),
        (
            format!("{start}run t = 0..1, ever = 1\n"),
            "error: unknown name `ever`  --> study.ham:6:15",
        ),
        (
            format!("{start}{start}"),
            "error: unknown word `---`  --> study.ham:6:1",
        ),
        (
            format!("{start}{times}, scheme = Stromer, step = 1\n"),
            "error: there is no scheme `Stromer`: `schemes()` lists all, for example `StormerVerlet` and `Gauss8`  --> study.ham:6:37",
        ),
        (
            format!("---\nstart theta = [1], p = 0\n{times}, tolerance = 1e-8\n"),
            "error: `theta` must be a number  --> study.ham:5:15",
        ),
        (
            format!("---\nstart theta = 1\n{times}, tolerance = 1e-8\n"),
            "error: `p` has no value at the start  --> study.ham:5:7",
        ),
        (
            format!("---\nstart theta = 1, theta = 2\n{times}, tolerance = 1e-8\n"),
            "error: `theta` has two values  --> study.ham:5:18",
        ),
        (
            format!("{start}with k = 2\n{times}, tolerance = 1e-8\n"),
            "error: there is no parameter or size `k`; there are `l`, `g`  --> study.ham:6:6",
        ),
        (
            format!("{start}{times}, tolerance = 1e-8\nwrite a.txt\n"),
            "error: `a.txt` has no known form  --> study.ham:7:7",
        ),
    ] {
        let found = begin(&lines);
        assert_eq!(found, due, "{lines}");
    }
    // An error of the definition has its place in the file.
    let output = command(
        &folder("refused"),
        "H(q; p) = p^2/2 + sin(r)*q\n---\nrun t = 0..1\n",
    );
    assert!(!output.status.success());
    let unwritten = format!("{DEFINITION}{start}{times}, tolerance = 1e-8\nwrite none/a.csv\n");
    let unwritten = text(&command(&folder("refused"), &unwritten).stderr);
    assert!(
        unwritten.starts_with("error: `none/a.csv` cannot be written: "),
        "{unwritten}"
    );
}

#[test]
fn a_failed_step_keeps_the_rows_before_it() {
    let lines = "H(q; p) = p^2/2 - q^4
---
start q = 1, p = 0
run t = 0..2, every = 0.25, scheme = StormerVerlet, step = 0.001
";
    let output = command(&folder("failed"), lines);
    assert!(!output.status.success());
    assert!(
        text(&output.stdout).lines().count() >= 4,
        "the orbit is infinite at t = 0.93"
    );
    let error = text(&output.stderr);
    assert!(
        error.starts_with("error: ") && error.ends_with("note: the rows before it are written\n"),
        "{error}"
    );
}

#[test]
fn help_and_schemes_are_listed() {
    let run = |argument: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hamiltonian-run"));
        command.arg(argument).output().expect("the command runs")
    };
    assert!(text(&run("--help").stdout).starts_with("usage: hamiltonian-run FILE"));
    assert!(text(&run("--schemes").stdout).contains("\nGaussNystrom8 "));
    let output = run("--nothing");
    assert!(!output.status.success() && text(&output.stderr).starts_with("usage: "));
    assert!(text(&run("none.ham").stderr).starts_with("error: none.ham: "));
}

#[test]
fn a_start_is_in_declared_variables_or_from_velocities() {
    let kepler = "struct Kepler {}
H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2);
coordinates polar(x, y);
dt = sqrt(x^2 + y^2)*ds
---
start x = 0, y = 0.5, p_x = -1.5, p_y = 0, t = 2
";
    let folder = folder("variables");
    let rows = |text: &str| -> Vec<String> {
        let output = command(&folder, text);
        assert_eq!(self::text(&output.stderr), "");
        self::text(&output.stdout)
            .lines()
            .map(str::to_owned)
            .collect()
    };
    let run = "run s = 0..1, every = 0.5, tolerance = 1e-10\n";
    let table = rows(&format!("{kepler}{run}"));
    assert_eq!(table[0], "s,r,phi,t,p_r,p_phi,p_t,H");
    let first: Vec<f64> = table[1]
        .split(',')
        .map(|one| one.parse().expect("a number"))
        .collect();
    let angle = std::f64::consts::FRAC_PI_2;
    assert_eq!(first[..4], [0.0, 0.5, angle, 2.0]);
    // H = 1.5²/2 − 1/0.5, and not g·(H + p_t) = 0.
    assert!((first[7] + 0.875).abs() < 1e-14, "{}", table[1]);
    assert_eq!(table.len(), 4);

    let output = command(
        &folder,
        &format!("{kepler}run t = 0..1, every = 0.5, tolerance = 1e-10\n"),
    );
    let error = text(&output.stderr);
    assert!(
        error.starts_with("error: the time of this run is `s`\n --> study.ham:7:5"),
        "{error}"
    );

    let swing = "struct Pendulum { l = 2.0 } L(theta; v) = l^2*v^2/2 + l*cos(theta)
---
start theta = 0.5, v = 1.5
run t = 0..1, every = 0.5, tolerance = 1e-10
";
    let table = rows(swing);
    assert_eq!(table[0], "t,theta,p_theta,H");
    assert!(table[1].starts_with("0.0,0.5,6.0,"), "{}", table[1]);
}
