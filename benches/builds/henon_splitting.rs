//! Hénon–Heiles with `BlanesMoan6`, many starts.

use hamiltonian::prelude::*;

hamiltonian! {
    pub struct HenonHeiles {}
    H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

fn main() -> Result<(), Error> {
    let start = |member: Member| {
        (
            HenonHeiles {},
            State::new([0.0, 1e-4 * member.index as f64], [0.3, 0.0]),
        )
    };
    let mut swarm = Ensemble::new(1_000, start, BlanesMoan6, 0.1)?;
    swarm.advance(1_000);
    for end in swarm.states().take(3) {
        println!("{:.6}", end?.q[0]);
    }
    Ok(())
}
