//! Kinks of the φ⁴ field in two dimensions: a kink and an antikink meet.
//!
//! H = ∫ (π² + |∇φ|²)/2 + (φ² − 1)²/4 has the kinks φ = tanh(γ(x − vt)/√2). A pair that meets faster than v_c =
//! 0.2598 bounces and escapes with v' where v'² = 0.887 (v² − v_c²); a slower one is captured, except in windows of
//! resonance above v = 0.19 (D. K. Campbell, J. F. Schonfeld, C. A. Wingate, Physica D 9 (1983) 1). Flat fronts
//! behave likewise in two dimensions. The picture `target/phi4/fronts.svg` has the field of bent fronts at four times,
//! from top to bottom: they leave a bubble that shrinks.
//!
//! `-- N` sets N times as many sites along each axis.

use checks::Checks;
use hamiltonian::Lattice;
use hamiltonian::plot::Figure;
use hamiltonian::prelude::*;
use std::f64::consts::{SQRT_2, TAU};

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// The φ⁴ field on a torus, at sites with the distance d.
    pub struct Field { n: usize, m: usize, d = 0.25 }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 + (u[i][j]^2 - 1)^2/4
            + ((u[(i + 1) % n][j] - u[i][j])^2 + (u[i][(j + 1) % m] - u[i][j])^2)/(2*d^2)
    }
}

/// The extents of the torus, and where the fronts start.
const HEIGHT: f64 = 12.0;
const LENGTH: f64 = 80.0;
const START: f64 = 10.0;

/// A field and a kink and an antikink with velocities ±v that approach each other. Their fronts are bent by
/// `bend`.
struct Pair {
    field: Field,
    start: StateOf<Field>,
}

impl Pair {
    fn new(v: f64, bend: f64, fine: usize) -> Result<Pair, Error> {
        let d = 0.25 / fine as f64;
        let (n, m) = ((HEIGHT / d) as usize, (LENGTH / d) as usize);
        let mut field = Field::new(n, m)?;
        field.d = d;
        let rate = 1.0 / (SQRT_2 * (1.0 - v * v).sqrt());
        let front = |i: usize| START + bend * (TAU * i as f64 / n as f64).cos();
        // The distances from both fronts, each growing away from the middle.
        let apart = |[i, j]: [usize; 2]| {
            let x = (j as f64 + 0.5) * d - LENGTH / 2.0;
            [rate * (x + front(i)), rate * (front(i) - x)]
        };
        let u = |at| {
            let [a, b] = apart(at);
            a.tanh() + b.tanh() - 1.0
        };
        let p = |at| {
            let slopes = apart(at).map(|z| rate / z.cosh().powi(2));
            -v * (slopes[0] + slopes[1])
        };
        let start = State::new(Lattice::from_fn([n, m], u), Lattice::from_fn([n, m], p));
        Ok(Pair { field, start })
    }
}

/// The places where row i of the field is 0, from left to right.
fn zeros(u: &Lattice<f64, 2>, d: f64, i: usize) -> Vec<f64> {
    let m = u.extents()[1];
    let crossing = |j: usize| {
        let (a, b) = (u[[i, j]], u[[i, j + 1]]);
        (a * b < 0.0).then(|| (j as f64 + 0.5 + a / (a - b)) * d - LENGTH / 2.0)
    };
    (0..m - 1).filter_map(crossing).collect()
}

/// The velocity of the left front between two times.
fn velocity(v: f64, fine: usize, [from, to]: [f64; 2]) -> Result<f64, Error> {
    let Pair { field, start } = Pair::new(v, 0.0, fine)?;
    let step = field.d / 2.0;
    let mut run = Integrator::new(&field, StormerVerlet::default(), start, step)?;
    let mut place = |t: f64| -> Result<f64, Error> {
        run.advance((t / step) as u64 - run.steps())?;
        Ok(zeros(&run.state().q, field.d, 0)
            .first()
            .copied()
            .unwrap_or(f64::NAN))
    };
    Ok((-place(from)? + place(to)?) / (to - from))
}

/// The times of the picture.
const TIMES: [f64; 4] = [0.0, 10.0, 30.0, 45.0];

/// The largest energy error of bent fronts for a step of `part` of d, and the field at some times.
fn bent(part: f64, fine: usize) -> Result<(f64, Vec<Lattice<f64, 2>>), Error> {
    let Pair { field, start } = Pair::new(0.6, 0.8, fine)?;
    let step = part * field.d;
    let mut run =
        Integrator::new(&field, StormerVerlet::default(), start, step)?.observe(EnergyDrift::new());
    let mut frames = Vec::new();
    for t in TIMES {
        run.advance((t / step) as u64 - run.steps())?;
        frames.push(run.state().q.clone());
    }
    Ok((run.observer().max_relative(), frames))
}

/// The frames one below the other.
fn picture(frames: &[Lattice<f64, 2>], fine: usize) -> Figure {
    // A pixel for each site of the coarsest lattice, and gaps between the frames.
    let [n, m] = frames[0].extents().map(|extent| extent / fine);
    let gap = 3;
    let height = frames.len() * (n + gap) - gap;
    let all = Lattice::from_fn([height, m], |[i, j]| {
        let (below, row) = (i / (n + gap), i % (n + gap));
        match row < n {
            true => frames[frames.len() - 1 - below][[row * fine, j * fine]],
            false => f64::NAN,
        }
    });
    let [a, b, c, d] = TIMES;
    let y = HEIGHT * height as f64 / n as f64;
    Figure {
        title: format!("A kink and an antikink of φ⁴ with bent fronts: t = {a}, {b}, {c} and {d}"),
        ..Figure::field(-LENGTH / 2.0..LENGTH / 2.0, 0.0..y, all)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fine = std::env::args()
        .nth(1)
        .and_then(|n| n.parse().ok())
        .unwrap_or(1usize);
    let mut checks = Checks::default();
    let towards = velocity(0.3, fine, [0.0, 20.0])?;
    checks.compare("velocity of a kink that approaches", towards, 0.3, 2e-3);
    let away = velocity(0.3, fine, [100.0, 160.0])?;
    let due = -(0.887f64 * (0.09 - 0.2598 * 0.2598)).sqrt();
    checks.compare("its velocity after the bounce", away, due, 0.02);

    let Pair { field, start } = Pair::new(0.18, 0.0, fine)?;
    let step = field.d / 2.0;
    let mut run = Integrator::new(&field, StormerVerlet::default(), start, step)?;
    run.advance((160.0 / step) as u64)?;
    let u = &run.state().q;
    let inside = u.as_slice().iter().filter(|u| **u > 0.0).count() as f64;
    let share = inside / u.as_slice().len() as f64;
    checks.compare("share of φ > 0 after a capture", share, 0.0, 0.1);
    let rows = u.as_slice().chunks(u.extents()[1]);
    let differ = rows
        .filter(|row| *row != &u.as_slice()[..row.len()])
        .count();
    checks.compare("rows of flat fronts that differ", differ as f64, 0.0, 0.0);

    let (drift, frames) = bent(0.5, fine)?;
    let (narrow, _) = bent(0.25, fine)?;
    checks.compare(
        "max |ΔH/H₀|, ratio of steps d/2, d/4",
        drift / narrow,
        4.0,
        0.3,
    );

    picture(&frames, fine).write("target/phi4/fronts.svg")?;
    println!("Written to target/phi4/fronts.svg");
    checks.finish()
}
