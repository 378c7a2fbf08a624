//! The paper's schemes on the paper's two systems: its figures, its table, and longer runs.
//!
//! Pictures: `target/paper/figure1.svg` has the pendulum, `figure2.svg` H = ½(q²+1)(p²+1) in a short run,
//! `figure3.svg` the same system in a longer run, and `figure4.svg` the same to t = 10⁵ with the exact flows of the
//! pieces into which the macro splits H: explicit and symplectic, which is the aim of the paper. The table is
//! printed and written to `results.csv`.
//!
//! The paper does not state g, the length of the runs, the zero of the potential, or the definition of
//! "uncertainty". The program prints what is assumed; "uncertainty" is taken as the deviation of the mean of H over
//! the run from H₀.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::VectorOf;
use hamiltonian::errors::StepError;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use hamiltonian::schemes::walk::{
    Visitor, visit_any, visit_separable, visit_split, visit_unforced,
};
use hamiltonian::schemes::{
    ConsecutiveSubTrajectories, IntersectingSubTrajectories, Pihajoki, SecondPoint, Yoshida4,
};
use hamiltonian::{Exact, Scheme, Separable, Split, System, Unforced, View, hamiltonian};
use std::fmt::{Display, Write as _};
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// The paper's pendulum; the potential is zero where it hangs.
    pub struct Pendulum {
        /// Mass of the bob.
        m = 1.0,
        /// Length.
        l = 10.0,
        /// Acceleration of gravity.
        g = 9.81,
    }
    H(q; p) = p^2/(2*m*l^2) + m*g*l*(1 - cos(q))
}

hamiltonian! {
    /// The same, the potential zero where it is horizontal.
    pub struct PendulumFromPivot { m = 1.0, l = 10.0, g = 9.81 }
    H(q; p) = p^2/(2*m*l^2) - m*g*l*cos(q)
}

hamiltonian! {
    /// The paper's equation (34).
    pub struct NonSeparable {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1)
}

const STEP: f64 = 1e-3;
const PENDULUM_END: f64 = 50.0;
/// The copies of (29) separate exponentially on (34): only a short run looks like the paper's figure.
const SHORT_END: f64 = 1.0;
const LONG_END: f64 = 20.0;
/// Ten times the paper's step, since the run is five thousand times longer.
const FAR_STEP: f64 = 1e-2;
const FAR_END: f64 = 1e5;

/// One row of the results.
struct Row {
    system: &'static str,
    scheme: &'static str,
    equations: &'static str,
    start: &'static str,
    end: f64,
    /// max |H/H₀ − 1|
    max: f64,
    /// mean |H/H₀ − 1|
    mean: f64,
    /// |mean H/H₀ − 1|
    of_mean: f64,
    copy_distance: Option<f64>,
    /// H/H₀ − 1 against t.
    curve: Vec<(f64, f64)>,
}

/// A system with its start, the length of the runs, and their results.
struct Problem<'a, S: System> {
    name: &'static str,
    system: &'a S,
    start: State<VectorOf<S>>,
    end: f64,
    rows: Vec<Row>,
    failure: Option<Error>,
}

impl<S: System + Unforced> Problem<'_, S> {
    /// Runs one scheme to the end; a run that stops being finite ends there.
    fn measure<M: Scheme<S>>(&self, scheme: M) -> Result<Row, Error> {
        let entry = scheme.entry();
        let energy = self.system.energy(&self.start);
        let mut curve = Vec::new();
        let interval = (self.end / STEP / 2000.0).ceil() as u64;
        let watcher = every(
            interval,
            watch(|view: &View<'_, f64, S>| {
                curve.push((view.state.t, view.energy() / energy - 1.0))
            }),
        );
        let mut run = Integrator::new(self.system, scheme, self.start.clone(), STEP)?
            .observe((EnergyDrift::new(), watcher));
        match run.advance_to(self.end) {
            Ok(_) | Err(Error::Step(StepError::NotFinite { .. })) => {}
            Err(error) => return Err(error),
        }
        let drift = &run.observer().0;
        let (max, mean, of_mean) = (
            drift.max_relative(),
            drift.mean_relative(),
            (drift.mean() / energy - 1.0).abs(),
        );
        Ok(Row {
            system: self.name,
            scheme: entry.name,
            equations: entry.equations,
            start: entry.variant.strip_suffix(" start").unwrap_or(""),
            end: self.end,
            max,
            mean,
            of_mean,
            copy_distance: None,
            curve,
        })
    }

    /// The distance of the copies of (29) or (30) at the end.
    fn copy_distance(&self, scheme: Pihajoki) -> Result<f64, Error> {
        let mut run = Integrator::new(self.system, scheme, self.start.clone(), STEP)?;
        run.advance_to(self.end)?;
        Ok(run.copy_distance())
    }

    /// The rows of all schemes run so far, copy distances filled in.
    fn rows(mut self) -> Result<Vec<Row>, Error> {
        if let Some(error) = self.failure {
            return Err(error);
        }
        let distances = [
            ("29", Pihajoki::CoordinateFirst),
            ("30", Pihajoki::MomentumFirst),
        ];
        for (equations, scheme) in distances {
            let distance = self.copy_distance(scheme).ok();
            for row in self
                .rows
                .iter_mut()
                .filter(|row| row.equations == equations)
            {
                row.copy_distance = distance;
            }
        }
        Ok(self.rows)
    }
}

impl<S: System + Unforced> Visitor<S> for Problem<'_, S> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        match self.measure(scheme) {
            Ok(row) => self.rows.push(row),
            Err(error) => self.failure = Some(error),
        }
    }
}

/// A problem for any scheme.
fn problem<'a, S: System>(
    name: &'static str,
    system: &'a S,
    start: State<VectorOf<S>>,
    end: f64,
) -> Problem<'a, S> {
    Problem {
        name,
        system,
        start,
        end,
        rows: Vec::new(),
        failure: None,
    }
}

/// All schemes of the catalogue on a separable system.
fn all_on<S: Separable + Unforced>(mut problem: Problem<'_, S>) -> Result<Vec<Row>, Error> {
    visit_unforced(&mut problem);
    visit_any(&mut problem);
    visit_separable(&mut problem);
    problem.rows()
}

/// The schemes that need no structure, and those by exact flows of pieces.
fn split_on<S: Split + Exact + Unforced>(mut problem: Problem<'_, S>) -> Result<Vec<Row>, Error> {
    visit_unforced(&mut problem);
    visit_any(&mut problem);
    visit_split(&mut problem);
    problem.visit(Yoshida4);
    problem.visit(BlanesMoan4);
    problem.rows()
}

/// The run that the paper was after: its schemes part from the orbit, the others stay, and those by
/// exact flows need neither copies nor iterations.
fn far<S: Split + Exact + Unforced + Display>(
    system: &S,
    start: State<VectorOf<S>>,
    checks: &mut Checks,
) -> Result<(), Box<dyn std::error::Error>> {
    let energy = system.energy(&start);
    println!("To t = {FAR_END:e}, Δt = {FAR_STEP}:");
    print_pieces(system);
    let mut contest = Contest::new(system, start, FAR_STEP, FAR_END);
    let second = SecondPoint::Equal;
    contest.every = 7;
    contest.enter(
        "scheme 1, (26)",
        ConsecutiveSubTrajectories::default().with_second_point(second),
    )?;
    let crossing = contest.enter(
        "scheme 2, (33)",
        IntersectingSubTrajectories::default().with_second_point(second),
    )?;
    let [doubled, midpoint] = contest.enter_others()?;
    let strang = contest.enter("exact flows, Strang", Strang)?;
    let fourth = contest.enter("exact flows, Yoshida 4", Yoshida4)?;
    contest.draw(
        "Figure 4: H = ½(q² + 1)(p² + 1), Δt = 0.01, by exact flows of its pieces",
        "target/paper/figure4.svg",
    )?;
    // Every step of both is exact to second order in Δt: the errors at Δt = 1e-3 a hundred times.
    checks.compare(
        "Strang to t = 1e5: max |ΔH/H₀|",
        strang / energy,
        9.0e-5,
        2e-6,
    );
    checks.compare("midpoint: the same", midpoint / energy, 1.17e-4, 1e-6);
    checks.compare("Yoshida 4: the same", fourth / energy, 0.0, 1e-6);
    // The paper's: H is ½ at least, so little more than 0.9 can go.
    let lost = |moved: f64| f64::from(moved > 0.8 * energy);
    checks.compare("H is lost by (33)", lost(crossing), 1.0, 0.0);
    checks.compare("H is lost by (29)", lost(doubled), 1.0, 0.0);
    Ok(())
}

/// The curves of some equations; of (26) and (33) those with the paper's start.
fn curves(rows: &[Row], wanted: &[(&str, &str)]) -> Vec<Curve> {
    let find = |equations: &str| {
        rows.iter().find(|row| {
            (row.equations == equations || row.scheme == equations)
                && matches!(row.start, "" | "equal")
        })
    };
    wanted
        .iter()
        .filter_map(|(equations, name)| {
            find(equations).map(|row| Curve {
                name: (*name).to_string(),
                points: row.curve.clone(),
            })
        })
        .collect()
}

const AS_THE_PAPER: [(&str, &str); 3] = [
    ("26", "scheme 1, (26)"),
    ("33", "scheme 2, (33)"),
    ("29", "PSVM, (29)"),
];

fn csv(rows: &[Row]) -> String {
    let mut text = String::from(
        "system,scheme,equation,start,dt,t_end,max_rel_energy_error,mean_rel_energy_error,copy_distance\n",
    );
    for row in rows {
        let distance = row
            .copy_distance
            .map_or_else(String::new, |d| format!("{d:e}"));
        let _ = writeln!(
            text,
            "{},{},{},{},{STEP},{},{:e},{:e},{distance}",
            row.system, row.scheme, row.equations, row.start, row.end, row.max, row.mean
        );
    }
    text
}

/// The paper's figure, in per cent, for a system, an equation and its start.
fn reported(row: &Row) -> Option<f64> {
    let paper_start = matches!(row.start, "" | "equal");
    match (row.system, row.equations) {
        _ if !paper_start => None,
        ("pendulum", "26") => Some(8.23e-4),
        ("pendulum", "33") => Some(1.93e-3),
        ("pendulum", "29") => Some(2.40e-5),
        ("nonseparable", "26") => Some(1.11e-1),
        ("nonseparable", "33") => Some(1.74e-1),
        ("nonseparable", "29") => Some(1.44e-4),
        _ => None,
    }
}

fn print(rows: &[Row]) {
    println!(
        "{:<20} {:<28} {:<8} {:<13} {:>5} {:>11} {:>11} {:>11} {:>11} {:>10}",
        "system",
        "scheme",
        "equation",
        "start",
        "t_end",
        "max %",
        "mean %",
        "of mean %",
        "paper %",
        "copies"
    );
    for row in rows {
        let paper = reported(row).map_or_else(String::new, |p| format!("{p:.2e}"));
        let copies = row
            .copy_distance
            .map_or_else(String::new, |d| format!("{d:.1e}"));
        println!(
            "{:<20} {:<28} {:<8} {:<13} {:>5} {:>11.3e} {:>11.3e} {:>11.3e} {:>11} {:>10}",
            row.system,
            row.scheme,
            row.equations,
            row.start,
            row.end,
            100.0 * row.max,
            100.0 * row.mean,
            100.0 * row.of_mean,
            paper,
            copies
        );
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let angle = std::f64::consts::FRAC_PI_4;
    let (pendulum, from_pivot, nonseparable) = (
        Pendulum::default(),
        PendulumFromPivot::default(),
        NonSeparable {},
    );
    let at_rest = || State::new([angle], [0.0]);
    let far_out = || State::new([-3.0], [0.0]);

    let mut rows = all_on(problem("pendulum", &pendulum, at_rest(), PENDULUM_END))?;
    let pendulum_rows = rows.len();
    rows.extend(all_on(problem(
        "pendulum from pivot",
        &from_pivot,
        at_rest(),
        PENDULUM_END,
    ))?);
    let short = split_on(problem("nonseparable", &nonseparable, far_out(), SHORT_END))?;
    let long = split_on(problem("nonseparable", &nonseparable, far_out(), LONG_END))?;

    let folder = Path::new("target/paper");
    std::fs::create_dir_all(folder)?;
    let (time, error) = ("time t", "relative energy error H/H(0) − 1");
    Figure {
        title: "Figure 1: pendulum, Δt = 0.001".into(),
        x: time.into(),
        y: error.into(),
        curves: curves(&rows[..pendulum_rows], &AS_THE_PAPER),
        ..Default::default()
    }
    .write(folder.join("figure1.svg"))?;
    Figure {
        title: "Figure 2: H = ½(q² + 1)(p² + 1), Δt = 0.001".into(),
        x: time.into(),
        y: error.into(),
        curves: curves(&short, &AS_THE_PAPER),
        ..Default::default()
    }
    .write(folder.join("figure2.svg"))?;
    let beside = [
        ("29", "PSVM, (29)"),
        ("33", "scheme 2, (33)"),
        ("ImplicitMidpoint", "implicit midpoint"),
        ("RungeKutta4", "Runge–Kutta 4 (not symplectic)"),
    ];
    Figure {
        title: "Figure 3: the same H in a longer run".into(),
        x: time.into(),
        y: "|H/H(0) − 1|".into(),
        logarithmic: true,
        curves: curves(&long, &beside),
        ..Default::default()
    }
    .write(folder.join("figure3.svg"))?;

    let mut checks = Checks::default();
    let relative = |name: &str| {
        let row = long.iter().find(|row| row.scheme == name);
        row.map_or(f64::NAN, |row| row.max)
    };
    let found = relative("Strang");
    checks.compare(
        "Strang to t = 20, Δt = 1e-3: max |ΔH/H₀|",
        found,
        9.0e-7,
        2e-8,
    );
    let found = relative("ImplicitMidpoint");
    checks.compare("midpoint: the same", found, 1.17e-6, 1e-8);

    rows.extend(short);
    rows.extend(long);
    std::fs::write(folder.join("results.csv"), csv(&rows))?;
    print(&rows);
    println!();
    println!(
        "Assumed, because the paper does not say: g = 9.81; V = mgl(1 − cos q) (\"from pivot\": −mgl cos q);"
    );
    println!(
        "runs to t = {PENDULUM_END} and {SHORT_END}; its \"uncertainty\" is |mean H/H(0) − 1| (column \"of mean\")."
    );
    println!("Scheme (26) advances time by 2Δt a step; t is the time of the system.");
    println!(
        "Written to {}: figure1.svg, figure2.svg, figure3.svg, results.csv\n",
        folder.display()
    );
    far(&nonseparable, far_out(), &mut checks)?;
    checks.finish()
}
