//! Basins of attraction of a damped, driven pendulum.
//!
//! θ̈ + γθ̇ + sin θ = f cos t with γ = 0.2 and f = 1.66: friction contracts phase space, and all orbits tend to a
//! few periodic ones with the period of the drive. The starts that tend to one of them are its basin; boundaries
//! between basins are fractal (J. Kennedy and J. A. Yorke, Physica D 51 (1991) 213,
//! doi:10.1016/0167-2789(91)90234-Z).
//!
//! Each orbit is sampled once a period, when the driving force is largest. `-- N` computes about N starts, 10 000 by
//! default; 1 000 000 take minutes. The basins are written to `target/basins/basins.svg`.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::{PI, TAU};

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// A damped pendulum that is pushed to and fro.
    pub struct Pushed { f = 1.66, gamma = 0.2 }
    H(theta; p; t) = p^2/2 - cos(theta) - f*theta*cos(t);
    force(theta; p) = -gamma*p
}

/// Steps in a period of the push.
const STEPS: u64 = 50;
/// Periods after which every orbit is on an attractor.
const PERIODS: u64 = 200;
/// Points of one attractor differ by less than this.
const NEAR: f64 = 1e-4;

/// The angle in [−π, π).
fn wrapped(theta: f64) -> f64 {
    theta - TAU * ((theta + PI) / TAU).floor()
}

/// The distance of two points of the cylinder.
fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    wrapped(a[0] - b[0]).hypot(a[1] - b[1])
}

/// The points of a closed orbit, one a period; none if it does not close after two periods.
fn orbit(start: [f64; 2], step: f64) -> Result<Option<Vec<[f64; 2]>>, Error> {
    let begin = State::new([start[0]], [start[1]]);
    let mut run = Integrator::new(&Pushed::default(), BlanesMoan4, begin, step)?;
    let mut points = vec![start];
    for _ in 0..2 {
        let State { q, p, .. } = run.advance(STEPS)?;
        let point = [wrapped(q[0]), p[0]];
        if distance(point, start) < NEAR {
            return Ok(Some(points));
        }
        points.push(point);
    }
    Ok(None)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let starts = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let starts: f64 = starts.unwrap_or(10_000.0);
    let side = starts.sqrt().ceil() as usize;
    let place = move |index: usize| {
        let at = |k: usize| PI * ((2 * k + 1) as f64 / side as f64 - 1.0);
        [at(index % side), at(index / side)]
    };
    let step = TAU / STEPS as f64;
    let sweep = Sweep::new(
        side * side,
        |member| {
            let [theta, p] = place(member.index);
            (Pushed::default(), State::new([theta], [p]))
        },
        BlanesMoan4,
        step,
    )
    .with_steps(STEPS * PERIODS)
    .reproducible()
    .with_progress(|done, of| eprint!("\r{done} of {of} starts"))
    .record(["theta", "p"], |end| {
        [wrapped(end.state.q[0]), end.state.p[0]]
    });

    // The attractors in the order in which they are met: their points, one a period.
    let mut attractors: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut failure = None;
    let ends = sweep.fold(Vec::new(), |mut ends, row| {
        let end = [row.values[0], row.values[1]];
        let meets = |orbit: &Vec<[f64; 2]>| orbit.iter().any(|known| distance(*known, end) < NEAR);
        let mut number = attractors.iter().position(meets);
        if number.is_none() {
            match orbit(end, step) {
                Ok(Some(orbit)) => {
                    attractors.push(orbit);
                    number = Some(attractors.len() - 1);
                }
                Ok(None) => {}
                Err(error) => failure = Some(error),
            }
        }
        ends.push(number);
        ends
    })?;
    eprintln!();
    if let Some(error) = failure {
        return Err(error.into());
    }

    let mut checks = Checks::default();
    for (number, points) in attractors.iter().enumerate() {
        let size = ends.iter().filter(|end| **end == Some(number)).count() as f64;
        println!(
            "attractor {number}: {} periods, through θ = {:.6}, p = {:.6}; basin {:.4} of the starts",
            points.len(),
            points[0][0],
            points[0][1],
            size / ends.len() as f64
        );
        // Areas shrink by e^(−2πγ) in a period.
        let [theta, p] = points[0];
        let start = State::new([theta], [p]);
        let mut tangent = Tangent::new(&Pushed::default(), BlanesMoan4, start, step, 2)?;
        tangent.advance(STEPS)?;
        let shrinks = (-Pushed::default().gamma * TAU).exp();
        let area = tangent.matrix().determinant();
        checks.compare(
            format!("areas after a period at {number}"),
            area,
            shrinks,
            1e-9,
        );
        // If θ(t) is a solution, so is −θ(t + π).
        let mut half = Integrator::new(
            &Pushed::default(),
            BlanesMoan4,
            State::new([theta], [p]),
            step,
        )?;
        let State { q, p, .. } = half.advance(STEPS / 2)?;
        let mirrored = [wrapped(-q[0]), -p[0]];
        let distances = attractors
            .iter()
            .flatten()
            .map(|known| distance(*known, mirrored));
        let nearest = distances.fold(f64::INFINITY, f64::min);
        checks.compare(format!("mirror image of {number}"), nearest, 0.0, NEAR);
    }
    let settled = ends.iter().flatten().count() as f64 / ends.len() as f64;
    checks.compare("share of starts that have settled", settled, 1.0, 0.002);

    // Each start fills its cell.
    let dots = (900.0 / side as f64).ceil() as usize;
    let spacing = TAU / side as f64;
    let basin = |number: usize| Curve {
        name: match attractors[number].len() {
            1 => "one period".into(),
            periods => format!("{periods} periods, θ = {:.2}", attractors[number][0][0]),
        },
        points: (0..ends.len())
            .filter(|index| ends[*index] == Some(number))
            .flat_map(|index| {
                let [theta, p] = place(index);
                let shift = |k: usize| spacing * ((k as f64 + 0.5) / dots as f64 - 0.5);
                (0..dots * dots).map(move |k| (theta + shift(k / dots), p + shift(k % dots)))
            })
            .collect(),
    };
    Figure {
        title: "Basins of θ̈ + θ̇/5 + sin θ = 1.66 cos t".into(),
        x: "θ".into(),
        y: "p".into(),
        dots: true,
        curves: (0..attractors.len()).map(basin).collect(),
        ..Default::default()
    }
    .write("target/basins/basins.svg")?;
    println!("Written to target/basins/basins.svg");
    checks.finish()
}
