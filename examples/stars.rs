//! Two star clusters merge: thousands of stars, each of which attracts all others, on all cores.
//!
//! Each cluster is H. C. Plummer's sphere with the velocities of its distribution function (S. Aarseth, M. Hénon and
//! R. Wielen, Astronomy and Astrophysics 37, 183, 1974). They fall towards each other on a parabola. Prints H of
//! the start, which is −3π/64·GM²/a for each sphere, how well H and momentum are preserved, and how the merged cluster
//! settles: 2T = −V on the average (the virial theorem), but for stars that were thrown out.
//!
//! 1000 stars take seconds; `cargo run --release --example stars -- 10000` shows a progress bar for a minute or
//! two. The picture is `target/stars/merger.svg`.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::{PI, TAU};

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// Stars of mass 1/n under Newtonian gravity, G = 1, softened at the distance `epsilon`.
    pub struct Stars { n: usize, epsilon = 0.02 }
    let T = n*sum(i in 0..n) { norm_squared(p[i]) }/2;
    let V = -sum(i in 0..n, j in 0..i) { 1/sqrt(norm_squared(q[i] - q[j]) + epsilon^2) }/n^2;
    H(q[n][3]; p[n][3]) = T + V;
    invariant total_momentum = sum(i in 0..n) { p[i] };
    monitor kinetic = T
}

/// The scale of each sphere and its mass.
const SCALE: f64 = 0.5;
const MASS: f64 = 0.5;

/// The distance of the spheres at the start along x, and across.
const APART: [f64; 2] = [4.0, 1.0];

const STEP: f64 = 0.01;
/// The time of the picture, after the first passage, and the end.
const PICTURE: u64 = 600;
const END: u64 = 1600;

/// Numbers in [0, 1), the same in every run: G. Marsaglia, Journal of Statistical Software 8 (14), 2003.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A vector of this length in any direction.
    fn direction(&mut self, length: f64) -> [f64; 3] {
        let (z, angle) = (2.0 * self.next() - 1.0, TAU * self.next());
        let across = (1.0 - z * z).sqrt();
        [across * angle.cos(), across * angle.sin(), z].map(|x| length * x)
    }

    /// The place and the velocity of a star of Plummer's sphere.
    fn star(&mut self) -> [[f64; 3]; 2] {
        // Stars far outside are left out, as is usual.
        let r = loop {
            let r = (self.next().powf(-2.0 / 3.0) - 1.0).powf(-0.5);
            if r < 10.0 {
                break r;
            }
        };
        let part = loop {
            let (x, y) = (self.next(), 0.1 * self.next());
            if y < x * x * (1.0 - x * x).powf(3.5) {
                break x;
            }
        };
        let escape = (2.0 * MASS / SCALE).sqrt() * (1.0 + r * r).powf(-0.25);
        [self.direction(r * SCALE), self.direction(part * escape)]
    }
}

/// The stars of one sphere, at rest as a whole.
fn sphere(numbers: &mut Numbers, count: usize) -> Vec<[[f64; 3]; 2]> {
    let mut stars: Vec<_> = (0..count).map(|_| numbers.star()).collect();
    for what in 0..2 {
        for axis in 0..3 {
            let mean = stars.iter().map(|star| star[what][axis]).sum::<f64>() / count as f64;
            stars.iter_mut().for_each(|star| star[what][axis] -= mean);
        }
    }
    stars
}

/// Both spheres on their way to each other, n stars in all.
fn start(spheres: [Vec<[[f64; 3]; 2]>; 2], n: usize) -> StateOf<Stars> {
    let [x, y] = APART;
    // A parabola: both come from rest far away.
    let speed = (2.0 / x.hypot(y)).sqrt();
    let (mut places, mut momenta) = (Vec::new(), Vec::new());
    for (sphere, side) in spheres.into_iter().zip([-0.5, 0.5]) {
        for [[a, b, c], [u, v, w]] in sphere {
            places.push([a + side * x, b + side * y, c]);
            momenta.push([u - side * speed, v, w].map(|v| v / n as f64));
        }
    }
    State::new(places, momenta)
}

/// The stars seen from above, at most some thousands of each sphere.
fn picture(state: &StateOf<Stars>, n: usize) -> Figure {
    const MAX_DRAWN: usize = 3000;
    let curves = [("one cluster", 0..n / 2), ("the other", n / 2..n)].map(|(name, stars)| Curve {
        name: name.into(),
        points: stars
            .step_by(n.div_ceil(2 * MAX_DRAWN))
            .map(|i| (state.q[(i, 0)], state.q[(i, 1)]))
            .filter(|(x, y)| x.abs() < 2.5 && y.abs() < 2.5)
            .collect(),
    });
    Figure {
        title: format!("Two clusters of {} stars merge: t = {:.0}", n / 2, state.t),
        x: "x".into(),
        y: "y".into(),
        dots: true,
        equal: true,
        curves: curves.into(),
        ..Default::default()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let n = match std::env::args().nth(1) {
        Some(number) => 2 * (number.parse::<usize>()? / 2),
        None => 1000,
    };
    let mut numbers = Numbers(88_172_645_463_325_252);
    let start = start([(); 2].map(|()| sphere(&mut numbers, n / 2)), n);
    let stars = Stars::new(n)?;
    let (energy, momentum) = (stars.energy(&start), stars.total_momentum(&start));

    // The bits do not depend on the number of threads.
    let cores = std::thread::available_parallelism()?.get();
    let observers = (
        Progress::new(END),
        every(40, (EnergyDrift::new(), Recorder::new())),
    );
    let mut run = Integrator::new(&stars, StormerVerlet::default(), start, STEP)?
        .with_threads(cores)
        .observe(observers);
    run.advance(PICTURE)?;
    picture(run.state(), n).write("target/stars/merger.svg")?;
    run.advance(END - PICTURE)?;

    let (drift, record) = run.observer().1.inner();
    let column = |name| record.column(name).ok_or(format!("no column {name}"));
    // −V = T − H.
    let late: Vec<f64> = column("t")?
        .zip(column("kinetic")?)
        .filter(|(t, _)| *t > 10.0)
        .map(|(_, kinetic)| 2.0 * kinetic / (kinetic - energy))
        .collect();
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    let now = stars.total_momentum(run.state());
    let moved = (0..3).map(|k| (now[k] - momentum[k]).abs());

    let mut checks = Checks::default();
    // Of two spheres, T + V = −3π/64·GM²/a each.
    let of_spheres = -2.0 * 3.0 * PI / 64.0 * MASS * MASS / SCALE;
    checks.compare(
        format!("{n} stars: H of the start"),
        energy,
        of_spheres,
        0.02,
    );
    checks.compare("max |ΔH/H₀|", drift.max_relative(), 0.0, 1e-2);
    checks.compare("change of momentum", moved.fold(0.0, f64::max), 0.0, 1e-12);
    checks.compare("mean of 2T/|V| after t = 10", mean, 1.0, 0.15);
    println!("Written to target/stars/merger.svg");
    checks.finish()
}
