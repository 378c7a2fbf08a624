//! Work against precision: the CPU time of each scheme for a given error.
//!
//! Three problems: Hénon–Heiles, which is separable; the paper's (34) and an orbit round a black hole, which are not
//! separable, but are sums of pieces with exact flows. For these two, schemes are compared order by order:
//! compositions of exact flows, the implicit midpoint rule and Gauss's schemes, M. Tao's doubled phase space, and
//! its symmetric projection.
//!
//! The program writes two pictures of each problem to `target/work_precision/`: the change of H (`…_energy.svg`) and
//! the error of the end point (`…_end.svg`) against the CPU time for one unit of time, with steps that are halved
//! repeatedly. The number at a curve is the order of its scheme. Tables of both are printed. Times are those of this
//! machine; the program checks that each error of H decreases with the order of its scheme.

use checks::Checks;
use hamiltonian::VectorOf;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use hamiltonian::schemes::{
    BlanesCasasEscorihuela8, Compensated, Semiexplicit, SofroniouSpaletta10, Srkn6b, Srkn11b, Tao,
};
use hamiltonian::{Exact, Scheme, Split, Unforced, hamiltonian};
use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::time::Instant;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// Stars in a galaxy, near its middle.
    pub struct Galaxy {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

hamiltonian! {
    /// The paper's equation (34), in pieces that take little time.
    pub struct NonSeparable {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1);
    split {
        Turning = (q^2 + p^2)/2 + 0.5;
        Scaling = q^2*p^2/2;
    }
}

hamiltonian! {
    /// An orbit round a black hole in Schwarzschild's coordinates, in pieces that take little time.
    pub struct Schwarzschild { E = 0.995, L = 4.6 }
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2)
        - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2);
    split {
        Falling = -p_r^2/r;
        Radial = p_r^2/2;
        Turning = p_theta^2/(2*r^2);
        Potential = -E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2);
    }
}

hamiltonian! {
    /// (34) in the pieces that the macro finds.
    pub struct NonSeparableFound {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1)
}

hamiltonian! {
    /// The orbit round a black hole in the pieces that the macro finds.
    pub struct SchwarzschildFound { E = 0.995, L = 4.6 }
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2)
        - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2)
}

/// The errors that are asked for.
const GOALS: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

/// Runs to one time from one start, and how far their ends are from the exact one.
struct Race<'a, S: System> {
    name: &'a str,
    system: &'a S,
    start: State<VectorOf<S>>,
    end: f64,
    exact: State<VectorOf<S>>,
    /// Steps of the first run of a scheme with one stage.
    steps: u64,
    entries: Vec<Entered>,
}

/// The results of a scheme.
struct Entered {
    kind: &'static str,
    name: String,
    order: u32,
    runs: Vec<Ran>,
}

/// The result of a run.
#[derive(Clone, Copy)]
struct Ran {
    /// Nanoseconds for a unit of time.
    nanoseconds: f64,
    /// max |H/H(0) − 1|
    of_energy: f64,
    /// The distance of the end point from the exact one.
    of_end: f64,
}

/// One of the errors of a run.
type Measure = fn(&Ran) -> f64;
/// The errors that a scheme is judged by.
const MEASURES: [(&str, &str, Measure); 2] = [
    ("max |H/H(0) − 1|", "energy", |ran| ran.of_energy),
    ("error of the end point", "end", |ran| ran.of_end),
];

impl Entered {
    /// The nanoseconds that an error takes, by the straight line between two runs.
    fn nanoseconds(&self, error: Measure, goal: f64) -> Option<f64> {
        let mut pairs = self.runs.windows(2);
        let pair = pairs.find(|pair| error(&pair[0]) >= goal && error(&pair[1]) < goal)?;
        let (a, b) = (pair[0], pair[1]);
        let part = (goal / error(&a)).ln() / (error(&b) / error(&a)).ln();
        Some(a.nanoseconds * (b.nanoseconds / a.nanoseconds).powf(part))
    }

    /// The power of the step with which the error of H fell, over the last halvings well above rounding.
    fn slope(&self) -> f64 {
        let errors = self.runs.iter().map(|ran| ran.of_energy);
        let clear: Vec<_> = errors.filter(|error| *error > 1e-11).collect();
        match clear[..] {
            [.., a, _, c] => 0.5 * (a / c).log2(),
            [a, b] => (a / b).log2(),
            _ => f64::NAN,
        }
    }
}

impl<'a, S: System> Race<'a, S> {
    /// A run of so many steps: the least time of five, and its errors, computed outside that time.
    fn run<M: Scheme<S>>(&self, scheme: &M, steps: u64) -> Result<Ran, Error> {
        let h = self.end / steps as f64;
        let begin = || Integrator::new(self.system, scheme.clone(), self.start.clone(), h);
        let mut run = begin()?.observe(EnergyDrift::new());
        let end = run.advance(steps)?;
        let of_q = Vector::distance(&end.q, &self.exact.q);
        let of_end = of_q.max(Vector::distance(&end.p, &self.exact.p));
        let of_energy = run.observer().max_relative();
        let mut nanoseconds = f64::INFINITY;
        for _ in 0..5 {
            let mut run = begin()?;
            let clock = Instant::now();
            run.advance(steps)?;
            nanoseconds = nanoseconds.min(1e9 * clock.elapsed().as_secs_f64() / self.end);
        }
        Ok(Ran {
            nanoseconds,
            of_energy,
            of_end,
        })
    }

    /// One scheme, its steps halved until its errors are rounding or a run takes too long.
    fn enter<M: Scheme<S>>(&mut self, kind: &'static str, scheme: M, stages: u64) {
        let entry = scheme.entry();
        let name = match entry.name {
            name @ ("Semiexplicit" | "Gauss") => format!("{name}, {}", entry.variant),
            name => name.to_string(),
        };
        let mut steps = (self.steps / stages).max(1);
        let mut runs = Vec::new();
        for _ in 0..14 {
            // A step so long that the solver fails gives no point.
            if let Ok(ran) = self.run(&scheme, steps) {
                runs.push(ran);
                let is_exact = ran.of_energy.max(ran.of_end) < 1e-11 || ran.of_energy < 1e-13;
                if is_exact || ran.nanoseconds * self.end > 2e6 {
                    break;
                }
            }
            steps *= 2;
        }
        self.entries.push(Entered {
            kind,
            name,
            order: entry.order,
            runs,
        });
    }

    /// Exact flows of pieces and the schemes for any H, order by order.
    fn enter_all(&mut self)
    where
        S: Split + Exact + Unforced,
    {
        let flows = "exact flows";
        self.enter(flows, Strang, 1);
        self.enter(flows, BlanesMoan4, 6);
        self.enter(flows, BlanesMoan6, 10);
        self.enter(flows, KahanLi8, 17);
        let gauss = "midpoint, Gauss";
        self.enter(gauss, ImplicitMidpoint::default(), 1);
        self.enter(gauss, Gauss::<2>::default(), 4);
        self.enter(gauss, Gauss::<3>::default(), 8);
        self.enter(gauss, Gauss::<4>::default(), 16);
        let projected = "semiexplicit";
        self.enter(projected, Semiexplicit::<Strang>::default(), 1);
        self.enter(projected, Semiexplicit::<BlanesMoan4>::default(), 6);
        self.enter(projected, Semiexplicit::<BlanesMoan6>::default(), 10);
        self.enter(projected, Semiexplicit::<KahanLi8>::default(), 17);
    }

    /// The tables, for a README, and the figures; the error of H is to fall with its order or faster.
    fn finish(self, checks: &mut Checks, file: &str) -> Result<(), Box<dyn std::error::Error>> {
        let mut entries = self.entries;
        for entry in &entries {
            let (name, order) = (format!("{file}: {}", entry.name), f64::from(entry.order));
            checks.compare(name, entry.slope().min(order), order, 0.3);
        }
        for (what, measure, error) in MEASURES {
            entries.sort_by_key(|entry| entry.order);
            println!("\n{}: nanoseconds for a unit of time, by {what}", self.name);
            print!("| order | scheme |");
            for goal in GOALS {
                print!(" {goal:.0e} |");
            }
            println!("\n|---|---|{}", "---|".repeat(GOALS.len()));
            for entry in &entries {
                print!("| {} | {} |", entry.order, entry.name);
                for goal in GOALS {
                    let cell = entry.nanoseconds(error, goal);
                    print!(" {} |", cell.map_or("–".into(), |ns| format!("{ns:.0}")));
                }
                println!();
            }
            entries.sort_by_key(|entry| entry.kind);
            let of_run = |ran: &Ran| (ran.nanoseconds, error(ran).max(1e-16));
            let of_entry = |entry: &Entered| Curve {
                name: entry.kind.into(),
                points: entry.runs.iter().map(of_run).collect(),
            };
            let mark = |entry: &Entered| {
                let last = entry.runs.last()?;
                Some((of_run(last), entry.order.to_string()))
            };
            let path = format!("target/work_precision/{file}_{measure}.svg");
            Figure {
                title: self.name.into(),
                x: "nanoseconds for a unit of time".into(),
                y: what.into(),
                logarithmic: true,
                decades: true,
                legend_right: true,
                marks: entries.iter().filter_map(mark).collect(),
                curves: entries.iter().map(of_entry).collect(),
                ..Default::default()
            }
            .write(Path::new(&path))?;
            println!("Written to {path}");
        }
        Ok(())
    }
}

/// Prints what a step of Strang's splitting takes and how far it lets H move.
fn step<S: Split>(system: &S, start: &State<VectorOf<S>>, h: f64) -> Result<(), Error> {
    let (steps, mut least) = (100_000, f64::INFINITY);
    for _ in 0..5 {
        let mut run = Integrator::new(system, Strang, start.clone(), h)?;
        let began = Instant::now();
        run.advance(steps)?;
        least = least.min(began.elapsed().as_secs_f64() * 1e9 / steps as f64);
    }
    let run = Integrator::new(system, Strang, start.clone(), h)?;
    let mut run = run.observe(EnergyDrift::new());
    run.advance(steps)?;
    let moved = run.observer().max_relative();
    println!(
        "{:20} {least:6.1} ns a step, H moves by {moved:.1e}",
        system.description().name
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();

    let system = Galaxy {};
    let start = State::new([0.12, 0.23], [0.31, -0.17]);
    let mut run = Integrator::new(
        &system,
        Compensated(SofroniouSpaletta10),
        start.clone(),
        0.02,
    )?;
    let mut race = Race {
        name: "Hénon–Heiles, to t = 50",
        system: &system,
        start,
        end: 50.0,
        exact: run.advance_to(50.0)?.clone(),
        steps: 100,
        entries: Vec::new(),
    };
    let kicks = "compositions";
    race.enter(kicks, StormerVerlet::default(), 1);
    race.enter(kicks, BlanesMoan4, 6);
    race.enter(kicks, BlanesMoan6, 10);
    race.enter(kicks, KahanLi8, 17);
    race.enter(kicks, SofroniouSpaletta10, 35);
    let nystrom = "for T = ½pᵀM⁻¹p";
    race.enter(nystrom, Srkn6b, 6);
    race.enter(nystrom, Srkn11b, 11);
    race.enter(nystrom, BlanesCasasEscorihuela8, 19);
    race.finish(&mut checks, "henon_heiles")?;

    let system = NonSeparable {};
    let start = State::new([-3.0], [0.0]);
    let mut race = Race {
        name: "H = ½(q² + 1)(p² + 1), to t = 10",
        system: &system,
        start,
        end: 10.0,
        // −3·cn(√10·t | 0.9), and p = q̇/(q² + 1).
        exact: State::new([-2.402_238_313_100_827], [0.690_609_507_457_253_5]),
        steps: 400,
        entries: Vec::new(),
    };
    race.enter_all();
    race.enter("Tao, ω = 20", Tao::default().with_omega(20.0), 1);
    race.finish(&mut checks, "paper34")?;

    let system = Schwarzschild::default();
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    let mut race = Race {
        name: "Round a black hole, to τ = 1000",
        system: &system,
        start,
        end: 1000.0,
        // From a solution in quadruple precision.
        exact: State::new(
            [122.486_719_036_045, 1.495_696_594_046_55],
            [0.069_598_468_153_017_1, -2.033_200_752_273_33],
        ),
        steps: 400,
        entries: Vec::new(),
    };
    race.enter_all();
    race.enter("Tao, ω = 0.1", Tao::default().with_omega(0.1), 1);
    race.finish(&mut checks, "schwarzschild")?;

    println!("\nStrang in declared pieces, and in those that the macro finds:");
    let start = State::new([-3.0], [0.0]);
    step(&NonSeparable {}, &start, 0.01)?;
    step(&NonSeparableFound {}, &start, 0.01)?;
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    step(&Schwarzschild::default(), &start, 1.0)?;
    step(&SchwarzschildFound::default(), &start, 1.0)?;
    checks.finish()
}
