//! A pendulum, many starts.

use hamiltonian::prelude::*;

hamiltonian! {
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

fn main() -> Result<(), Error> {
    let start = |member: Member| {
        (
            Pendulum::default(),
            State::new([1e-4 * member.index as f64], [0.0]),
        )
    };
    let mut swarm = Ensemble::new(10_000, start, StormerVerlet::default(), 1e-3)?;
    swarm.advance(1_000);
    let mut mean = 0.0;
    for end in swarm.states() {
        mean += end?.q[0] / 1e4;
    }
    println!("the mean angle is {mean:.6}");
    Ok(())
}
