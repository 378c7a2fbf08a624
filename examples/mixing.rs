//! Mixing in a bar: stars of one energy, half of them blue and half red, in a potential that turns.
//!
//! The bar is logarithmic and turns with Ω (J. Binney and S. Tremaine, Galactic Dynamics, second edition,
//! Princeton 2008, eq. 3.103). In its frame the Jacobi integral H is conserved. Stars are spread evenly over the
//! energy surface, which in the plane means evenly where Φ − Ω²r²/2 < H. That never changes, whatever the orbits
//! are; but colours, at first one on each side, mix as far as orbits are chaotic.
//!
//! `-- N` computes N stars, 2000 by default, 100 000 in minutes. Pictures are written to `target/mixing/`.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// A logarithmic bar in the frame in which it rests.
    #[derive(Copy)]
    pub struct Bar { v = 1.0, core = 0.1, b = 0.8, omega = 1.0 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - omega*(x*p_y - y*p_x)
        + v^2/2*ln(core^2 + x^2 + (y/b)^2)
}

const STEP: f64 = 0.005;

/// Φ − Ω²r²/2: the least H at a place.
fn effective(bar: &Bar, x: f64, y: f64) -> f64 {
    let r_squared = x * x + y * y;
    let depth = bar.core * bar.core + x * x + (y / bar.b) * (y / bar.b);
    0.5 * bar.v * bar.v * depth.ln() - 0.5 * bar.omega * bar.omega * r_squared
}

/// Numbers in [0, 1) from a seed (SplitMix64).
fn uniform(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stars = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let stars: usize = stars.unwrap_or(2_000);
    let bar = Bar::default();
    // Corotation: on the axes Φ − Ω²r²/2 is stationary at the Lagrange points.
    let lagrange = ((bar.v / bar.omega).powi(2) - bar.core.powi(2)).sqrt();
    let pass = effective(&bar, lagrange, 0.0);
    let energy = pass - 0.1;
    let start = |member: Member| {
        // Uniform in the plane where the energy allows it, inside corotation; uniform in the direction of the velocity.
        let mut seed = member.seed;
        loop {
            let x = lagrange * (2.0 * uniform(&mut seed) - 1.0);
            let y = lagrange * (2.0 * uniform(&mut seed) - 1.0);
            let square = 2.0 * (energy - effective(&bar, x, y));
            if x * x + y * y > lagrange * lagrange || square < 0.0 {
                continue;
            }
            let angle = std::f64::consts::TAU * uniform(&mut seed);
            let (sin, cos) = angle.sin_cos();
            let (u, w) = (square.sqrt() * cos, square.sqrt() * sin);
            // p = velocity in the frame at rest.
            let start = State::new([x, y], [u - bar.omega * y, w + bar.omega * x]);
            return (bar, start);
        }
    };
    let mut swarm =
        Ensemble::new(stars, start, BlanesMoan4, STEP)?.observe(|_| every(20, EnergyDrift::new()));

    let places = |swarm: &Ensemble<Bar, _, _>| -> Result<Vec<(f64, f64)>, Error> {
        let places = swarm
            .states()
            .map(|state| state.map(|State { q, .. }| (q[0], q[1])));
        places.collect()
    };
    let begin = places(&swarm)?;
    let mean = |places: &[(f64, f64)], of: fn(&(f64, f64)) -> f64| {
        places.iter().map(of).sum::<f64>() / places.len() as f64
    };
    let (x_squared, y_squared) = (
        |place: &(f64, f64)| place.0 * place.0,
        |place: &(f64, f64)| place.1 * place.1,
    );
    // The share of blue stars, which start on the right, that are on the right now.
    let stay = |now: &[(f64, f64)]| {
        let blue = begin.iter().zip(now).filter(|(begin, _)| begin.0 > 0.0);
        let (on_right, all) = blue.fold((0.0, 0.0), |(on_right, all), (_, now)| {
            (on_right + f64::from(u8::from(now.0 > 0.0)), all + 1.0)
        });
        on_right / all
    };
    let draw = |now: &[(f64, f64)], t: f64| {
        let colour = |name: &str, right: bool| Curve {
            name: name.into(),
            points: (begin.iter().zip(now))
                .filter(|(begin, _)| (begin.0 > 0.0) == right)
                .map(|(_, now)| *now)
                .collect(),
        };
        Figure {
            title: format!("Stars in a rotating bar at t = {t}"),
            x: "x".into(),
            y: "y".into(),
            equal: true,
            dots: true,
            legend_right: true,
            curves: vec![
                colour("began on the right", true),
                colour("began on the left", false),
            ],
            ..Default::default()
        }
        .write(format!("target/mixing/t{t}.svg"))
    };

    println!(
        "{:>6} {:>14} {:>10} {:>10}",
        "t", "blue on right", "mean x²", "mean y²"
    );
    let report = |t: f64, now: &[(f64, f64)]| {
        println!(
            "{t:>6} {:>14.4} {:>10.5} {:>10.5}",
            stay(now),
            mean(now, x_squared),
            mean(now, y_squared)
        );
    };
    report(0.0, &begin);
    draw(&begin, 0.0)?;
    let mut now = begin.clone();
    for t in [2.0, 5.0, 10.0, 50.0, 100.0] {
        let steps = (t / STEP).round() as u64;
        swarm.advance_watched(steps - swarm.steps(), 500, |swarm| {
            eprint!("\r{} of {} steps", swarm.steps(), (100.0 / STEP).round());
        });
        now = places(&swarm)?;
        report(t, &now);
        draw(&now, t)?;
    }

    eprintln!();
    let mut checks = Checks::default();
    let drift = swarm.observers().map(|drift| {
        drift
            .inner()
            .drift()
            .map_or(f64::NAN, |drift| drift.max_absolute())
    });
    checks.compare(
        "max |H − H(0)| of all stars",
        drift.fold(0.0, f64::max),
        0.0,
        1e-5,
    );
    let radius = now.iter().map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    checks.compare(
        "stars beyond corotation",
        f64::from(u8::from(radius > lagrange)),
        0.0,
        0.0,
    );
    // Means of N even draws differ by about 1/√N of their spread, which is less than a half of each.
    let within = 4.0 * 0.1 / (stars as f64).sqrt();
    checks.compare(
        "mean x² at the end",
        mean(&now, x_squared),
        mean(&begin, x_squared),
        within,
    );
    checks.compare(
        "mean y² at the end",
        mean(&now, y_squared),
        mean(&begin, y_squared),
        within,
    );
    checks.finish()
}
