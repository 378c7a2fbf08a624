//! A definition in an adaptive solver of another crate: Dormand and Prince's method of order 8.

use hamiltonian::prelude::*;
use hamiltonian::Gradient;
use ode_solvers::{Dop853, OutputType, SVector, System as Equations};

hamiltonian! {
    /// Kepler's problem.
    pub struct Kepler {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/hypot(x, y)
}

type Phase = SVector<f64, 4>;

impl Equations<f64, Phase> for Kepler {
    fn system(&self, t: f64, z: &Phase, dz: &mut Phase) {
        let state = State::new([z[0], z[1]], [z[2], z[3]]).at(t);
        let Gradient { q, p } = self.gradient(&state);
        *dz = Phase::new(p[0], p[1], -q[0], -q[1]);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Eccentricity 0.5, from the nearest point: after 2π it is back.
    let start = Phase::new(0.5, 0.0, 0.0, 3.0_f64.sqrt());
    let period = 2.0*std::f64::consts::PI;
    let mut solver = Dop853::new(Kepler {}, 0.0, period, period, start, 1e-13, 1e-13);
    solver.set_output(OutputType::Sparse);
    let statistics = solver.integrate()?;
    let end = solver.y_out().last().ok_or("no step was made")?;
    println!("{} evaluations, error {:.1e}", statistics.num_eval, (end - start).norm());
    assert!((end - start).norm() < 1e-10);
    Ok(())
}
