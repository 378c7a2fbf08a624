//! The output that the README prints beside its first program is what the program prints.

use hamiltonian::prelude::*;

hamiltonian! {
    /// The pendulum of the README.
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

#[test]
fn its_first_program_prints_what_it_says() -> Result<(), Error> {
    let pendulum = Pendulum {
        l: 2.0,
        ..Default::default()
    };
    let start = State::new([0.5], [0.0]);
    let mut run = Integrator::new(&pendulum, StormerVerlet::default(), start, 1e-3)?
        .observe(EnergyDrift::new());
    run.advance(10_000)?;
    let printed = format!(
        "theta({}) = {:.6}\nmax |ΔH/H₀| = {:.1e}\n",
        run.state().t,
        run.state().q[0],
        run.observer().max_relative()
    );
    let readme = include_str!("../README.md").replace('\r', "");
    assert!(readme.contains(&printed), "the README lacks:\n{printed}");
    Ok(())
}
