//! Conservation of H by schemes, side by side: the largest |H − H(0)| since the last point of a curve,
//! against time, both axes logarithmic.

use hamiltonian::VectorOf;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use hamiltonian::schemes::Pihajoki;
use hamiltonian::{Scheme, Split, Unforced, View};
use std::fmt::Display;
use std::path::Path;
use std::time::Instant;

/// Prints a system with the pieces of H that have exact flows, the outermost first.
pub fn print_pieces<S: Split + Display>(system: &S) {
    println!("{system}\nin the pieces");
    for name in system.description().piece_names() {
        println!("    {name}");
    }
}

/// Runs of one system from one start.
pub struct Contest<'a, S: System> {
    pub system: &'a S,
    pub start: State<VectorOf<S>>,
    pub step: f64,
    pub end: f64,
    /// The number of steps between two looks at H.
    pub every: u64,
    pub curves: Vec<Curve>,
}

impl<'a, S: System> Contest<'a, S> {
    /// A contest that looks at H after each step.
    pub fn new(system: &'a S, start: State<VectorOf<S>>, step: f64, end: f64) -> Self {
        println!(
            "{:<34} {:>16} {:>12} {:>10}",
            "scheme", "max |H − H(0)|", "to t =", "ns a step"
        );
        Self {
            system,
            start,
            step,
            end,
            every: 1,
            curves: Vec::new(),
        }
    }

    /// Runs one scheme, and says how far H moved: ∞ for a run that does not come to its end.
    pub fn enter<M: Scheme<S>>(&mut self, name: &str, scheme: M) -> Result<f64, Error> {
        let run = Integrator::new(self.system, scheme, self.start.clone(), self.step)?;
        let energy = run.energy();
        let (mut points, mut next) = (Vec::new(), 0.0);
        let (mut farthest, mut recent) = (0.0_f64, 0.0_f64);
        let look = watch(|view: &View<'_, f64, S>| {
            let moved = (view.energy() - energy).abs();
            recent = recent.max(moved);
            if view.state.t >= next {
                points.push((view.state.t, recent));
                farthest = farthest.max(recent);
                (recent, next) = (0.0, 1.02 * view.state.t);
            }
        });
        let mut run = run.observe(every(self.every, look));
        let steps = (self.end / run.duration()).round() as u64;
        let begin = Instant::now();
        let broken = match run.advance(steps) {
            Ok(_) => false,
            // The paper's schemes leave the numbers, the implicit ones find no solution.
            Err(Error::Step(_)) => true,
            Err(error) => return Err(error),
        };
        let each = begin.elapsed().as_secs_f64() / run.steps().max(1) as f64;
        let end = run.time();
        drop(run);
        farthest = farthest.max(recent);
        println!(
            "{name:<34} {farthest:>16.3e} {end:>12.0} {:>10.1}{}",
            1e9 * each,
            if broken { " and no further" } else { "" }
        );
        // The start has no place on a logarithmic axis, and of a run that has lost H a hundred times
        // over nothing is left to see.
        let lost = 100.0 * energy.abs().max(1.0);
        let until = points.iter().position(|(_, moved)| *moved > lost);
        points.truncate(until.unwrap_or(points.len()));
        points.retain(|(t, _)| *t > 0.0);
        self.curves.push(Curve {
            name: name.into(),
            points,
        });
        Ok(if broken { f64::INFINITY } else { farthest })
    }

    /// The two that take any H: the paper's explicit favourite and the implicit midpoint rule.
    pub fn enter_others(&mut self) -> Result<[f64; 2], Error>
    where
        S: Unforced,
    {
        Ok([
            self.enter("PSVM, (29)", Pihajoki::CoordinateFirst)?,
            self.enter("implicit midpoint", ImplicitMidpoint::default())?,
        ])
    }

    /// Draws all runs.
    pub fn draw(self, title: &str, path: &str) -> Result<(), Box<dyn std::error::Error>> {
        Figure {
            title: title.into(),
            x: "time t".into(),
            y: "|H − H(0)|".into(),
            logarithmic: true,
            decades: true,
            curves: self.curves,
            ..Default::default()
        }
        .write(Path::new(path))?;
        println!("Written to {path}\n");
        Ok(())
    }
}
