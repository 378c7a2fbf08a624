//! A charged particle in the field of a magnetic dipole (Størmer's problem), trapped as in the radiation belts of
//! the Earth; and one in uniform fields, trapped as in a laboratory.
//!
//! A magnetic field couples q and p, so H is not T(p) + V(q). Motion in a uniform magnetic field, with or without a
//! uniform electric field, has an exact flow: a single step can have any length. With another potential, this flow
//! is one of two pieces of H. A dipole has two pieces as well.
//!
//! A magnetic field does no work, so H is the kinetic energy. The dipole is symmetric about its axis, so the
//! angular momentum about the axis is conserved; the macro proves it. The magnetic moment of the gyration, |v ×
//! B|²/(2|B|³), is conserved approximately, as long as the radius of gyration is small. The particle turns back
//! before the poles for this reason.
//!
//! The program prints an orbit in crossed fields and an orbit in a Penning trap beside their closed forms, an orbit
//! in the dipole beside a solution in quadruple precision, and the period between the mirror points beside the
//! approximation 4R/v·(1.30 − 0.56 sin α) (W. N. Hess, The Radiation Belt and Magnetosphere, 1968). Pictures:
//! `target/dipole/meridian.svg` has the orbit in the plane that turns with the particle; `energy.svg` and
//! `trap.svg` have the drift of H.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// Charge and mass 1 in the field of a dipole `mu` at the origin, along z.
    pub struct Dipole { mu = 1.0 }
    let r = sqrt(x^2 + y^2 + z^2);
    let v_x = p_x + mu*y/r^3;
    let v_y = p_y - mu*x/r^3;
    H(x, y, z; p_x, p_y, p_z) = norm_squared([v_x, v_y, p_z])/2;
    invariant l_z = x*p_y - y*p_x;
    let B = [3*mu*x*z/r^5, 3*mu*y*z/r^5, mu*(3*z^2 - r^2)/r^5];
    monitor magnetic_moment = norm_squared(cross([v_x, v_y, p_z], B))/(2*norm(B)^3)
}

hamiltonian! {
    /// Charge and mass 1 in crossed fields: `B` along z, `E` along x.
    pub struct Crossed { B = 2.0, E = 0.3 }
    H(x, y, z; p_x, p_y, p_z) = ((p_x + B*y/2)^2 + (p_y - B*x/2)^2 + p_z^2)/2 - E*x
}

hamiltonian! {
    /// Charge and mass 1 in a field along z and the potential k(2z² − x² − y²)/2.
    pub struct Trap { B = 2.0, k = 0.5 }
    H(x, y, z; p_x, p_y, p_z) = ((p_x + B*y/2)^2 + (p_y - B*x/2)^2 + p_z^2)/2
        + k*(2*z^2 - x^2 - y^2)/2;
    split {
        Gyration = ((p_x + B*y/2)^2 + (p_y - B*x/2)^2 + p_z^2)/2;
        Potential = k*(2*z^2 - x^2 - y^2)/2;
    }
}

/// The uniform field: in one step, and in a trap.
fn in_uniform_field(checks: &mut Checks) -> Result<(), Box<dyn std::error::Error>> {
    let crossed = Crossed::default();
    print_pieces(&crossed);
    // From rest, the particle moves along −y on a cycloid of radius E/B².
    let start = State::new([0.0; 3], [0.0; 3]);
    let t = 1000.0;
    let mut run = Integrator::new(&crossed, Strang, start, t)?;
    let end = run.advance(1)?;
    let (radius, turned) = (crossed.E / crossed.B.powi(2), crossed.B * t);
    let (x, y) = (
        radius * (1.0 - turned.cos()),
        radius * (turned.sin() - turned),
    );
    checks.compare("crossed fields, one step of 1000: x", end.q[0], x, 1e-12);
    checks.compare("crossed fields, one step of 1000: y", end.q[1], y, 1e-11);

    let trap = Trap::default();
    print_pieces(&trap);
    let root = (trap.B.powi(2) - 4.0 * trap.k).sqrt();
    let (fast, slow) = (0.5 * (trap.B + root), 0.5 * (trap.B - root));
    let along = (2.0 * trap.k).sqrt();
    // The sum of two circular motions, and an oscillation along z: (x, y, z, ẋ, ẏ, ż).
    let orbit = |t: f64| {
        let circle = |radius: f64, omega: f64| {
            let (sin, cos) = (omega * t).sin_cos();
            let (x, y) = (radius * cos, -radius * sin);
            [x, y, omega * y, -omega * x]
        };
        let ([a, b, c, d], [e, f, g, h]) = (circle(0.2, fast), circle(1.0, slow));
        let (sin, cos) = (along * t).sin_cos();
        let (x, y) = (a + e, b + f);
        let p = [
            c + g - trap.B * y / 2.0,
            d + h + trap.B * x / 2.0,
            -0.5 * along * sin,
        ];
        State::new([x, y, 0.5 * cos], p)
    };
    let mut run = Integrator::new(&trap, KahanLi8, orbit(0.0), 0.1)?;
    let end = run.advance_to(100.0)?;
    let known = orbit(100.0);
    let off = (end.q - known.q).norm().max((end.p - known.p).norm());
    checks.compare("trap, t = 100: off by", off, 0.0, 1e-10);
    let mut contest = Contest::new(&trap, orbit(0.0), 0.1, 1e4);
    contest.enter_others()?;
    let second = contest.enter("gyration and kick, Strang", Strang)?;
    contest.enter("the same, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw("Penning's trap, steps of 0.1", "target/dipole/trap.svg")?;
    checks.compare("trap, Strang: max |H − H(0)|", second, 0.0, 1e-2);
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let dipole = Dipole::default();
    let mut checks = Checks::default();
    in_uniform_field(&mut checks)?;

    print_pieces(&dipole);
    let start = State::new([1.2, 0.3, 0.2], [0.1, -0.2, 0.3]);
    let mut run = Integrator::new(&dipole, KahanLi8, start, 0.01)?;
    let end = run.advance_to(20.0)?;
    let known = [
        ("x", end.q[0], 12.085803855002737),
        ("y", end.q[1], -9.394898242086061),
        ("z", end.q[2], 10.641560792938645),
        ("p_x", end.p[0], 0.5623643087949075),
        ("p_y", end.p[1], -0.459494090979351),
        ("p_z", end.p[2], 0.5313978164539163),
    ];
    for (name, found, known) in known {
        checks.compare(format!("dipole, t = 20: {name}"), found, known, 1e-11);
    }

    // At the equator, 45° to the field, slow enough to gyrate on 1/70 of the distance.
    let speed = 0.02_f64;
    let pitch = 45.0_f64.to_radians();
    // p = v + A, where A = μ(−y, x, 0)/r³.
    let start = State::new(
        [1.0, 0.0, 0.0],
        [speed * pitch.sin(), 1.0, speed * pitch.cos()],
    );
    let mut contest = Contest::new(&dipole, start.clone(), 0.1, 2e4);
    contest.enter_others()?;
    contest.enter("exact flows, Strang", Strang)?;
    contest.enter("exact flows, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw(
        "Trapped by a dipole, steps of 0.1",
        "target/dipole/energy.svg",
    )?;

    let mut run = Integrator::new(&dipole, BlanesMoan4, start, 0.1)?
        .observe((EnergyDrift::new(), Monitors::new()));
    let mut meridian = Vec::new();
    let mut crossings = Vec::new();
    let mut before = (0.0, 0.0);
    for state in run.states(1).take(20_000) {
        let state = state?;
        let now = (state.t, state.q[2]);
        // Upwards through the equator.
        if before.1 < 0.0 && now.1 >= 0.0 {
            crossings.push(now.0 - now.1 * (now.0 - before.0) / (now.1 - before.1));
        }
        before = now;
        if crossings.len() < 2 {
            meridian.push((state.q[0].hypot(state.q[1]), state.q[2]));
        }
    }
    let bounce = match (crossings.first(), crossings.last()) {
        (Some(first), Some(last)) => (last - first) / (crossings.len() - 1) as f64,
        _ => f64::NAN,
    };
    let known = 4.0 / speed * (1.30 - 0.56 * pitch.sin());
    checks.compare("period of the bounce", bounce, known, 0.02 * known);
    let (drift, monitors) = run.observer();
    let drift_of = |name| monitors.get(name);
    let l_z = drift_of("l_z").map_or(f64::NAN, |l| l.max_relative());
    let moment = drift_of("magnetic_moment").map_or(f64::NAN, |m| m.max_relative());
    checks.compare(
        "max |ΔH/H₀| over ten bounces",
        drift.max_relative(),
        0.0,
        1e-2,
    );
    checks.compare("max |Δl_z/l_z|, exact", l_z, 0.0, 1e-10);
    checks.compare("the same of the magnetic moment, nearly", moment, 0.0, 0.2);

    let line = (-60..=60).map(|degrees| f64::from(degrees).to_radians().sin_cos());
    Figure {
        title: "Trapped: one bounce in the plane that turns with the particle".into(),
        x: "distance from the axis".into(),
        y: "z".into(),
        equal: true,
        curves: vec![
            Curve {
                name: "particle".into(),
                points: meridian,
            },
            Curve {
                name: "line of the field, r = cos²λ".into(),
                points: line
                    .map(|(sin, cos)| (cos.powi(3), cos.powi(2) * sin))
                    .collect(),
            },
        ],
        ..Default::default()
    }
    .write(Path::new("target/dipole/meridian.svg"))?;
    println!("Written to target/dipole/meridian.svg");
    checks.finish()
}
