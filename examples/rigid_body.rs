//! A free rigid body, and a heavy top.
//!
//! The body is given in Andoyer's variables, the top in Euler's angles. No term of H depends on momenta alone, so
//! neither is separable. But H is a sum of squares of components of the angular momentum along the axes of the
//! body. The flow of each square rotates the angular momentum about that axis by an angle known in closed form. The
//! composition of these rotations is explicit and symplectic.
//!
//! The program prints orbits of both beside solutions in quadruple precision, the period of the angular momentum in
//! the body, and the drift of the constant that S. Kowalevski found for the top with A = B = 2C (Acta Mathematica
//! 12, 177, 1889), which the macro proves. Pictures: `target/rigid_body/body.svg` and `top.svg` have the drift of
//! H, `axis.svg` the path of the top's axis.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::View;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// A body without forces: L is the angular momentum along its third axis, G its magnitude.
    pub struct Body {
        /// Moments of inertia.
        A = 1.0,
        B = 2.0,
        C = 3.0,
    }
    H(l, g; L, G) = (G^2 - L^2)*(sin(l)^2/A + cos(l)^2/B)/2 + L^2/(2*C)
}

hamiltonian! {
    /// Kowalevski's top: A = B = 2, C = 1, its weight on the first axis.
    pub struct Top {}
    let M_1 = (p_phi - p_psi*cos(theta))*sin(psi)/sin(theta) + p_theta*cos(psi);
    let M_2 = (p_phi - p_psi*cos(theta))*cos(psi)/sin(theta) - p_theta*sin(psi);
    let gamma_1 = sin(theta)*sin(psi);
    let gamma_2 = sin(theta)*cos(psi);
    H(phi, theta, psi; p_phi, p_theta, p_psi) = M_1^2/4 + M_2^2/4 + p_psi^2/2 - gamma_1;
    invariant kowalevski = ((M_1^2 - M_2^2)/4 + gamma_1)^2 + (M_1*M_2/2 + gamma_2)^2
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();

    let body = Body::default();
    let start = State::new([0.7, 0.2], [0.5, 1.3]);
    print_pieces(&body);
    let mut run = Integrator::new(&body, KahanLi8, start.clone(), 0.05)?;
    let end = run.advance_to(20.0)?;
    checks.compare("body, t = 20: l", end.q[0], 2.385_267_154_242_963_7, 1e-12);
    checks.compare("body, t = 20: g", end.q[1], 20.632_978_680_799_48, 1e-12);
    checks.compare("body, t = 20: L", end.p[0], -0.591_721_023_341_516_3, 1e-12);
    // L and l have the period of the angular momentum in the body.
    let period = 13.510_502_678_700_29;
    let mut run = Integrator::new(&body, KahanLi8, start.clone(), period / 300.0)?;
    let end = run.advance(300)?;
    checks.compare("body, after a period: L", end.p[0], 0.5, 1e-12);
    let turns = (end.q[0] - 0.7) / std::f64::consts::TAU;
    checks.compare(
        "body, after a period: whole turns of l",
        turns,
        turns.round(),
        1e-12,
    );

    let mut contest = Contest::new(&body, start, 0.1, 1e4);
    contest.enter_others()?;
    contest.enter("exact flows, Strang", Strang)?;
    let fourth = contest.enter("exact flows, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw(
        "A free rigid body in Andoyer's variables, steps of 0.1",
        "target/rigid_body/body.svg",
    )?;
    checks.compare("body, Blanes–Moan 4: max |H − H(0)|", fourth, 0.0, 1e-7);

    let top = Top {};
    let start = State::new([0.3, 1.1, 0.4], [0.8, 0.3, 0.6]);
    print_pieces(&top);
    let kowalevski = 0.997_501_132_866_785_3;
    checks.compare(
        "top: Kowalevski's constant",
        top.kowalevski(&start),
        kowalevski,
        1e-14,
    );
    let mut run = Integrator::new(&top, KahanLi8, start.clone(), 0.02)?.observe(Monitors::new());
    let end = run.advance_to(10.0)?;
    let known = [
        ("φ", end.q[0], 4.366_923_070_525_686),
        ("θ", end.q[1], 0.678_169_011_862_110_9),
        ("ψ", end.q[2], 2.025_795_011_871_466),
        ("p_φ", end.p[0], 0.8),
        ("p_θ", end.p[1], -0.907_236_155_622_159_9),
        ("p_ψ", end.p[2], 0.163_230_408_592_397_67),
    ];
    for (name, found, known) in known {
        checks.compare(format!("top, t = 10: {name}"), found, known, 1e-11);
    }
    let constant = run
        .observer()
        .get("kowalevski")
        .map_or(f64::NAN, |m| m.max_relative());
    checks.compare(
        "top: Kowalevski's constant, change to t = 10",
        constant,
        0.0,
        1e-11,
    );

    let mut contest = Contest::new(&top, start.clone(), 0.02, 1e3);
    contest.enter_others()?;
    contest.enter("exact flows, Strang", Strang)?;
    let fourth = contest.enter("exact flows, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw(
        "Kowalevski's top in Euler's angles, steps of 0.02",
        "target/rigid_body/top.svg",
    )?;
    checks.compare("top, Blanes–Moan 4: max |H − H(0)|", fourth, 0.0, 1e-6);

    let mut axis = Vec::new();
    let watcher = watch(|view: &View<'_, f64, Top>| {
        let (phi, theta) = (view.state.q[0], view.state.q[1]);
        axis.push((theta.sin() * phi.sin(), -theta.sin() * phi.cos()));
    });
    let mut run = Integrator::new(&top, BlanesMoan4, start, 0.01)?.observe(every(2, watcher));
    run.advance_to(60.0)?;
    drop(run);
    Figure {
        title: "Kowalevski's top: its third axis, from above, to t = 60".into(),
        x: "sin θ sin φ".into(),
        y: "−sin θ cos φ".into(),
        equal: true,
        curves: vec![Curve {
            name: String::new(),
            points: axis,
        }],
        ..Default::default()
    }
    .write(Path::new("target/rigid_body/axis.svg"))?;
    println!("Written to target/rigid_body/axis.svg");
    checks.finish()
}
