//! The double pendulum, from its Hamiltonian and from its Lagrangian.
//!
//! The Lagrangian is the shorter text. The macro transforms it into the Hamiltonian, and the two systems agree to
//! rounding.
//!
//! The program prints the difference of the two; the periods of the two small oscillations, whose squared
//! frequencies are (2 ∓ √2)g/l; and the distance of two pendulums whose starts differ by 10⁻⁶. Picture:
//! `target/double_pendulum/paths.svg`, the paths of the lower bobs.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::TAU;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// Two rods in a plane, one hanging from the other; angles are measured from the downward vertical.
    pub struct FromHamiltonian { m1 = 1.0, m2 = 1.0, l1 = 1.0, l2 = 1.0, g = 9.81 }
    H(a, b; p_a, p_b) = (m2*l2^2*p_a^2 + (m1 + m2)*l1^2*p_b^2 - 2*m2*l1*l2*p_a*p_b*cos(a - b))
            /(2*m2*l1^2*l2^2*(m1 + m2*sin(a - b)^2))
        - (m1 + m2)*g*l1*cos(a) - m2*g*l2*cos(b)
}

hamiltonian! {
    /// The same.
    pub struct FromLagrangian { m1 = 1.0, m2 = 1.0, l1 = 1.0, l2 = 1.0, g = 9.81 }
    L(a, b; v_a, v_b) = (m1 + m2)*l1^2*v_a^2/2 + m2*l2^2*v_b^2/2 + m2*l1*l2*v_a*v_b*cos(a - b)
        + (m1 + m2)*g*l1*cos(a) + m2*g*l2*cos(b)
}

/// The largest difference between the two in ∂H/∂q and ∂H/∂p, relative to the largest component,
/// over many states.
fn disagreement() -> f64 {
    let masses = (1.0, 0.8, 1.2, 0.9, 9.81);
    let (m1, m2, l1, l2, g) = masses;
    let (one, other) = (
        FromHamiltonian { m1, m2, l1, l2, g },
        FromLagrangian { m1, m2, l1, l2, g },
    );
    let mut largest: f64 = 0.0;
    for k in 0..1000 {
        let k = f64::from(k);
        let state = State::new(
            [k, 1.7 * k * k],
            [9.0 * (2.3 * k).sin(), 7.0 * (0.7 * k).cos()],
        );
        let (from_h, from_l) = (one.gradient(&state), other.gradient(&state));
        let difference = (from_h.q - from_l.q)
            .norm()
            .max((from_h.p - from_l.p).norm());
        largest = largest.max(difference / from_h.q.norm().max(from_h.p.norm()));
    }
    largest
}

/// The period of the small oscillation in which the lower angle is `ratio` times the upper one.
fn period(pendulum: &FromLagrangian, ratio: f64) -> Result<f64, Error> {
    let mut crossings = Vec::new();
    let mut before = 0.0;
    let step = 1e-3;
    let start = State::new([1e-3, 1e-3 * ratio], [0.0, 0.0]);
    // The kinetic energy depends on the angles, so H is not separable, and short runs are to be
    // exact: Runge–Kutta.
    let mut run = Integrator::new(pendulum, RungeKutta4, start, step)?;
    for state in run.states(1).take(20_000) {
        let state = state?;
        if before < 0.0 && state.q[0] >= 0.0 {
            crossings.push(state.t - step * state.q[0] / (state.q[0] - before));
        }
        before = state.q[0];
    }
    Ok(match (crossings.first(), crossings.last()) {
        (Some(first), Some(last)) => (last - first) / (crossings.len() as f64 - 1.0),
        _ => f64::NAN,
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = FromLagrangian::default();
    println!("H from the Lagrangian:\n{pendulum}");
    println!("H as one finds it:\n{}", FromHamiltonian::default());

    let mut checks = Checks::default();
    checks.compare(
        "disagreement of the two gradients",
        disagreement(),
        0.0,
        1e-13,
    );
    let root = 2.0_f64.sqrt();
    for (name, ratio) in [("together", root), ("against each other", -root)] {
        let known = TAU / ((2.0 - ratio) * pendulum.g).sqrt();
        let what = format!("period, rods swinging {name}");
        checks.compare(what, period(&pendulum, ratio)?, known, 1e-5);
    }

    // A large amplitude and a long run: a symplectic scheme that needs no structure of H.
    let at_rest = |a: f64| pendulum.state_from_velocity(0.0, [a, 2.5], [0.0, 0.0]);
    let run_from = |a: f64| {
        Integrator::new(&pendulum, ImplicitMidpoint::default(), at_rest(a), 5e-4)
            .map(|run| run.observe(EnergyDrift::new()))
    };
    let (mut one, mut other) = (run_from(2.0)?, run_from(2.0 + 1e-6)?);
    let mut paths = [Vec::new(), Vec::new()];
    println!("\n{:>6} {:>16}", "t", "distance");
    for part in 0..=1200 {
        let states = [one.state(), other.state()];
        for (state, path) in states.iter().zip(&mut paths) {
            let (a, b) = (state.q[0], state.q[1]);
            path.push((
                pendulum.l1 * a.sin() + pendulum.l2 * b.sin(),
                -pendulum.l1 * a.cos() - pendulum.l2 * b.cos(),
            ));
        }
        if part % 100 == 0 {
            let distance = (states[0].q - states[1].q).norm();
            println!("{:>6.1} {distance:>16.1e}", states[0].t);
        }
        one.advance(20)?;
        other.advance(20)?;
    }
    let drift = one.observer().max_relative();
    checks.compare("max |ΔH/H₀|", drift, 0.0, 1e-4);

    Figure {
        title: "Two double pendulums that started 10⁻⁶ apart".into(),
        x: "x".into(),
        y: "y".into(),
        equal: true,
        curves: paths
            .into_iter()
            .zip(["one", "the other"])
            .map(|(points, name)| Curve {
                name: name.into(),
                points,
            })
            .collect(),
        ..Default::default()
    }
    .write(Path::new("target/double_pendulum/paths.svg"))?;
    println!("Written to target/double_pendulum/paths.svg");
    checks.finish()
}
