//! Point vortices in the plane, each moved by the others.
//!
//! A vortex has a position and no mass: the momentum of x is y times the strength Γ (G. Kirchhoff, Vorlesungen über
//! mathematische Physik, 1876, lecture 20). H has no kinetic energy and is not separable. But two vortices alone
//! rotate about the centre of their strengths (or move along a straight line if the strengths cancel), and H is a
//! sum over pairs. The composition of these rotations is explicit and symplectic, and keeps the impulses of the
//! flow, as each rotation does.
//!
//! The program prints the drift of the impulses, four vortices beside a solution in quadruple precision, and the
//! speeds of a pair with equal and of a pair with opposite strengths. Pictures: `target/vortices/energy.svg` has
//! the drift of H, `paths.svg` the paths of the vortices.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::View;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::{PI, TAU};
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// Vortices of strengths Γ at (x, w/Γ).
    pub struct Vortices {
        /// The number of vortices.
        n: usize,
        /// Their strengths.
        Gamma: [n],
    }
    H(x[n]; w[n]) = -sum(i in 0..n, j in 0..i) {
        Gamma[i]*Gamma[j]*ln((x[i] - x[j])^2 + (w[i]/Gamma[i] - w[j]/Gamma[j])^2)/(4*pi)
    };
    invariant impulse_x = sum(i in 0..n) { Gamma[i]*x[i] };
    invariant impulse_y = sum(i in 0..n) { w[i] };
    invariant angular_impulse = sum(i in 0..n) { Gamma[i]*x[i]^2 + w[i]^2/Gamma[i] }
}

/// Two vortices at a distance of 1: their positions after `t`.
fn pair(strengths: [f64; 2], t: f64) -> Result<[[f64; 2]; 2], Error> {
    let system = Vortices::new(2, strengths.to_vec())?;
    let start = State::new(vec![0.0, 1.0], vec![0.0, 0.0]);
    // One pair is one piece: its flow is exact, and one step suffices.
    let mut run = Integrator::new(&system, Strang, start, t)?;
    let end = run.advance(1)?;
    Ok([0, 1].map(|i| [end.q[i], end.p[i] / strengths[i]]))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();

    // A pair rotates about its centre with the rate (Γ₁ + Γ₂)/(2πd²); one with opposite strengths moves with Γ/(2πd).
    let [one, other] = pair([1.0, 1.0], PI * PI / 2.0)?;
    for (name, found, known) in [
        ("x of one", one[0], 0.5),
        ("y of one", one[1], -0.5),
        ("x of the other", other[0], 0.5),
        ("y of the other", other[1], 0.5),
    ] {
        let name = format!("a pair, a quarter of a turn later: {name}");
        checks.compare(name, found, known, 1e-14);
    }
    let [one, other] = pair([1.0, -1.0], TAU)?;
    checks.compare(
        "an opposed pair: one has moved by",
        one[1].abs(),
        1.0,
        1e-14,
    );
    checks.compare("the other by", other[1].abs(), 1.0, 1e-14);
    checks.compare("their distance", other[0] - one[0], 1.0, 1e-14);

    let strengths = vec![1.0, 2.0, -0.5, 1.0];
    let y = [0.0, 0.1, 1.2, -1.1];
    let system = Vortices::new(4, strengths.clone())?;
    let momenta: Vec<f64> = strengths
        .iter()
        .zip(y)
        .map(|(gamma, y)| gamma * y)
        .collect();
    let start = State::new(vec![1.0, -1.0, 0.0, 0.2], momenta);
    print_pieces(&system);
    checks.compare("H", system.energy(&start), -0.273_164_118_829_138_6, 1e-15);
    let mut run = Integrator::new(&system, KahanLi8, start.clone(), 0.02)?.observe(Monitors::new());
    let end = run.advance_to(20.0)?;
    let known = [
        [0.774_832_009_367_877_9, -1.680_244_550_479_663_7],
        [-0.093_131_710_935_730_3, -0.911_136_728_730_642],
        [0.828_126_867_039_044_8, -2.375_620_278_146_924_6],
        [-0.974_505_153_976_894_9, 0.814_707_868_867_486],
    ];
    for (i, [x, y]) in known.into_iter().enumerate() {
        checks.compare(format!("x of {i} at t = 20"), end.q[i], x, 1e-11);
        checks.compare(format!("y of {i}"), end.p[i] / strengths[i], y, 1e-11);
    }
    for name in ["impulse_x", "impulse_y", "angular_impulse"] {
        let moved = run
            .observer()
            .get(name)
            .map_or(f64::NAN, |m| m.max_absolute());
        checks.compare(format!("how far {name} moves"), moved, 0.0, 1e-12);
    }

    let mut contest = Contest::new(&system, start.clone(), 0.02, 2e3);
    contest.enter_others()?;
    let second = contest.enter("turns of pairs, Strang", Strang)?;
    contest.enter("turns of pairs, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw("Four vortices, steps of 0.02", "target/vortices/energy.svg")?;
    checks.compare("Strang to t = 2000: max |H − H(0)|", second, 0.0, 1e-3);

    let mut curves: Vec<_> = (strengths.iter())
        .map(|gamma| Curve {
            name: format!("Γ = {gamma}"),
            points: Vec::new(),
        })
        .collect();
    let watcher = watch(|view: &View<'_, f64, Vortices>| {
        for (i, curve) in curves.iter_mut().enumerate() {
            let (x, y) = (view.state.q[i], view.state.p[i] / strengths[i]);
            curve.points.push((x, y));
        }
    });
    let mut run = Integrator::new(&system, BlanesMoan4, start, 0.02)?.observe(every(2, watcher));
    run.advance_to(40.0)?;
    drop(run);
    Figure {
        title: "Four vortices to t = 40".into(),
        x: "x".into(),
        y: "y".into(),
        equal: true,
        curves,
        ..Default::default()
    }
    .write(Path::new("target/vortices/paths.svg"))?;
    println!("Written to target/vortices/paths.svg");
    checks.finish()
}
