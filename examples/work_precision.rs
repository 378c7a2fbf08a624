//! Work against precision: what a digit costs with each scheme, on a separable system and on one that is
//! not.
//!
//! Writes `target/work_precision/separable.svg` (Hénon–Heiles) and `any.svg` (the paper's (34)): the
//! error of the end point against the time that the run took, for steps halved again and again; and
//! prints, for some errors, which scheme was the fastest. Times are this machine's.

use hamiltonian::prelude::*;
use hamiltonian::{Scheme, hamiltonian};
use plot::{Curve, Figure};
use std::path::Path;
use std::time::Instant;

#[path = "support/plot.rs"]
mod plot;

hamiltonian! {
    /// Stars in a galaxy, near its middle.
    pub struct Galaxy {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

hamiltonian! {
    /// The paper's equation (34).
    pub struct NonSeparable {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1)
}

/// Runs to one time from one start, and how far their ends are from the exact one.
struct Race<'a, S: System<f64>> {
    system: &'a S,
    start: State<S::Vector>,
    end: f64,
    exact: State<S::Vector>,
    curves: Vec<Curve>,
}

impl<S: System<f64>> Race<'_, S> {
    /// The end point with so many steps, and the seconds it took: the least of three.
    fn run<M: Scheme<f64, S>>(&self, scheme: &M, steps: u64) -> Result<(f64, f64), Error> {
        let h = self.end / steps as f64;
        let mut seconds = f64::INFINITY;
        let mut distance = f64::NAN;
        for _ in 0..3 {
            let mut run = Integrator::new(self.system, scheme.clone(), self.start.clone(), h)?;
            let begin = Instant::now();
            let end = run.advance(steps)?;
            seconds = seconds.min(begin.elapsed().as_secs_f64());
            let of_q = hamiltonian::Vector::distance(&end.q, &self.exact.q);
            distance = of_q.max(hamiltonian::Vector::distance(&end.p, &self.exact.p));
        }
        Ok((distance, seconds))
    }

    /// One scheme from `steps` steps on, until its error is rounding or a run takes too long.
    fn enter<M: Scheme<f64, S>>(&mut self, scheme: M, mut steps: u64) -> Result<(), Error> {
        let entry = scheme.entry();
        let mut points = Vec::new();
        for _ in 0..8 {
            // A step too long to be solved is no point.
            if let Ok((error, seconds)) = self.run(&scheme, steps) {
                points.push((seconds.log10(), error.max(1e-16)));
                if error < 1e-12 || seconds > 0.2 {
                    break;
                }
            }
            steps *= 2;
        }
        let name = match entry.name {
            "Semiexplicit" | "MidpointProjected" | "Gauss" => {
                format!("{}, {}", entry.name, entry.variant)
            }
            name => name.to_string(),
        };
        self.curves.push(Curve { name, points });
        Ok(())
    }

    /// Which scheme was the fastest to an error, by the straight line between two runs.
    fn print(&self, title: &str) {
        println!("{title}");
        for goal in [1e-4, 1e-6, 1e-8, 1e-10] {
            let time = |curve: &Curve| {
                let pair =
                    (curve.points.windows(2)).find(|pair| pair[0].1 >= goal && pair[1].1 < goal)?;
                let (a, b) = (pair[0], pair[1]);
                let part = (goal / a.1).ln() / (b.1 / a.1).ln();
                Some(10_f64.powf(a.0 + part * (b.0 - a.0)))
            };
            let mut times: Vec<_> = (self.curves.iter())
                .filter_map(|curve| Some((time(curve)?, &curve.name)))
                .collect();
            times.sort_by(|a, b| a.0.total_cmp(&b.0));
            let best: Vec<_> = (times.iter().take(3))
                .map(|(seconds, name)| format!("{name} {:.2} ms", 1e3 * seconds))
                .collect();
            println!("  error {goal:.0e}: {}", best.join("; "));
        }
    }

    fn draw(self, title: &str, file: &str) -> Result<(), Box<dyn std::error::Error>> {
        Figure {
            title,
            x: "log₁₀ of the seconds the run took",
            y: "error of the end point",
            logarithmic: true,
            curves: self.curves,
            ..Default::default()
        }
        .write(&Path::new("target/work_precision").join(file))
    }
}

/// A race whose exact end is that of `scheme` with so many steps.
fn race<'a, S: System<f64>, M: Scheme<f64, S>>(
    system: &'a S,
    start: State<S::Vector>,
    end: f64,
    scheme: M,
    steps: u64,
) -> Result<Race<'a, S>, Error> {
    let mut run = Integrator::new(system, scheme, start.clone(), end / steps as f64)?;
    let exact = run.advance(steps)?.clone();
    Ok(Race {
        system,
        start,
        end,
        exact,
        curves: Vec::new(),
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let galaxy = Galaxy {};
    let start = State::new([0.12, 0.23], [0.31, -0.17]);
    let mut separable = race(
        &galaxy,
        start,
        100.0,
        Compensated(SofroniouSpaletta10),
        2_000,
    )?;
    separable.enter(StormerVerlet::default(), 200)?;
    separable.enter(BlanesMoan4, 50)?;
    separable.enter(BlanesMoan6, 50)?;
    separable.enter(Srkn11b, 50)?;
    separable.enter(KahanLi8, 50)?;
    separable.enter(BlanesCasasEscorihuela8, 25)?;
    separable.enter(SofroniouSpaletta10, 25)?;
    separable.print("Hénon–Heiles, to t = 100");
    separable.draw("Hénon–Heiles: error against work", "separable.svg")?;

    let system = NonSeparable {};
    let start = State::new([-3.0], [0.0]);
    let mut any = race(&system, start, 20.0, Gauss::<8>::default(), 1_000)?;
    any.enter(ImplicitMidpoint::default(), 400)?;
    any.enter(Tao { omega: 20.0 }, 1_600)?;
    any.enter(Gauss::<2>::default(), 100)?;
    any.enter(Gauss::<4>::default(), 50)?;
    any.enter(Semiexplicit::<BlanesMoan4>::default(), 100)?;
    any.enter(Semiexplicit::<KahanLi8>::default(), 50)?;
    any.enter(MidpointProjected::<KahanLi8>::default(), 50)?;
    any.print("H = ½(q² + 1)(p² + 1), to t = 20");
    any.draw("H = ½(q² + 1)(p² + 1): error against work", "any.svg")?;
    println!("Written to target/work_precision: separable.svg, any.svg");
    Ok(())
}
