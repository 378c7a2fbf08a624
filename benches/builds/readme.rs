use hamiltonian::prelude::*;

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum {
        /// Mass of the bob.
        m = 1.0,
        /// Length of the rod.
        l = 10.0,
        /// Acceleration of gravity.
        g = 9.81,
    }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

fn main() -> Result<(), Error> {
    let pendulum = Pendulum {
        l: 2.0,
        ..Default::default()
    };
    let start = State::new([0.5], [0.0]); // theta, p; t = 0

    let mut run = Integrator::new(&pendulum, StormerVerlet::default(), start, 1e-3)?
        .observe(EnergyDrift::new());
    run.advance(10_000)?;

    println!("theta({}) = {:.6}", run.state().t, run.state().q[0]);
    println!("max |ΔH/H₀| = {:.1e}", run.observer().max_relative());
    Ok(())
}
