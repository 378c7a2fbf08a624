//! The Hénon–Heiles system: regular and chaotic orbits at one energy.
//!
//! The system is a simplified model of a star in the meridian plane of a galaxy. It was made to find out if there
//! is a third integral of motion (M. Hénon and C. Heiles, Astronomical Journal 69, 73, 1964). If there is, the
//! points at which an orbit crosses x = 0 upwards lie on a curve; if there is none, they fill an area. At H = 1/8
//! there are orbits of both kinds.
//!
//! The program prints an orbit beside a solution in quadruple precision, and its number of crossings. Pictures:
//! `target/henon_heiles/section.svg` has each orbit in one colour. `polar.svg` has the drift of H for the same
//! system in polar coordinates, where the momentum of the angle stands beside r and H splits into free motion and a
//! kick.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::analysis::{Branch, momentum_from_energy};
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// The Hénon–Heiles system.
    pub struct HenonHeiles {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3;
    event meridian = x
}

hamiltonian! {
    /// The same in polar coordinates.
    pub struct Polar {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3;
    coordinates polar(x, y)
}

const STEP: f64 = 0.02;

/// The crossings of x = 0 with p_x > 0: (y, p_y), by interpolation between two steps.
fn section<const STEPS: usize>(start: (f64, f64, f64, f64)) -> Result<Vec<(f64, f64)>, Error> {
    let (x, y, p_x, p_y) = start;
    let mut points = Vec::new();
    let mut before = (x, y, p_y);
    let start = State::new([x, y], [p_x, p_y]);
    // H is separable: an explicit symplectic scheme, so that regular orbits stay on their curves.
    let mut run = Integrator::new(&HenonHeiles {}, StormerVerlet::default(), start, STEP)?;
    for state in run.states(1).take(STEPS) {
        let state = state?;
        let now = (HenonHeiles {}.meridian(&state), state.q[1], state.p[1]);
        if before.0 < 0.0 && now.0 >= 0.0 {
            let share = before.0 / (before.0 - now.0);
            let between = |a: f64, b: f64| a + share * (b - a);
            points.push((between(before.1, now.1), between(before.2, now.2)));
        }
        before = now;
    }
    Ok(points)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();
    let regular = (
        0.0,
        0.2587703282931232,
        -0.2525875586263492,
        -0.2178423952983717,
    );
    let start = State::new([regular.0, regular.1], [regular.2, regular.3]);
    println!("{}", HenonHeiles {});

    let mut run = Integrator::new(&HenonHeiles {}, StormerVerlet::default(), start, 1e-3)?
        .observe(EnergyDrift::new());
    let end = run.advance_to(100.0)?;
    checks.compare("x at t = 100", end.q[0], -0.12050586173746139, 1e-5);
    checks.compare("y at t = 100", end.q[1], -0.22192786721797048, 1e-5);
    checks.compare("p_x at t = 100", end.p[0], 0.0494084540741289, 1e-5);
    checks.compare("p_y at t = 100", end.p[1], -0.3156101434489458, 1e-5);
    checks.compare("max |ΔH/H₀|", run.observer().max_relative(), 0.0, 1e-6);
    let crossings = section::<100_000>(regular)?.len();
    checks.compare(
        "upward crossings of x = 0 to t = 2000",
        crossings as f64,
        306.0,
        0.0,
    );

    let start = Polar {}.from_declared(&State::new([regular.0, regular.1], [regular.2, regular.3]));
    print_pieces(&Polar {});
    let mut run = Integrator::new(&Polar {}, KahanLi8, start.clone(), 0.05)?;
    let end = Polar {}.to_declared(run.advance_to(100.0)?);
    checks.compare("polar, t = 100: x", end.q[0], -0.12050586173746139, 1e-12);
    checks.compare("polar, t = 100: p_x", end.p[0], 0.0494084540741289, 1e-12);
    let mut contest = Contest::new(&Polar {}, start, 0.05, 1e4);
    contest.enter_others()?;
    contest.enter("exact flows, Strang", Strang)?;
    let fourth = contest.enter("exact flows, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw(
        "Hénon–Heiles in polar coordinates, steps of 0.05",
        "target/henon_heiles/polar.svg",
    )?;
    checks.compare("polar, Blanes–Moan 4: max |H − H(0)|", fourth, 0.0, 1e-8);

    let mut curves = Vec::new();
    for (y, p_y) in [
        (-0.25, 0.0),
        (0.1, 0.0),
        (0.2, 0.0),
        (0.25, 0.0),
        (0.37, 0.0),
        (0.46, 0.0),
        (0.55, 0.0),
        (-0.15, 0.0),
        (-0.05, 0.27),
        (-0.05, 0.34),
        (-0.05, -0.27),
        (-0.05, -0.34),
        (0.0, 0.42),
    ] {
        let guess = State::new([0.0, y], [0.0, p_y]);
        let start = momentum_from_energy(&HenonHeiles {}, &guess, 0, 0.125, Branch::Forward)?;
        let (q, p) = (start.q, start.p);
        curves.push(Curve {
            name: String::new(),
            points: section::<200_000>((q[0], q[1], p[0], p[1]))?,
        });
    }
    Figure {
        title: "Hénon and Heiles: crossings of x = 0 at H = 1/8".into(),
        x: "y".into(),
        y: "p_y".into(),
        equal: true,
        dots: true,
        curves,
        ..Default::default()
    }
    .write(Path::new("target/henon_heiles/section.svg"))?;
    println!("Written to target/henon_heiles/section.svg");
    checks.finish()
}
