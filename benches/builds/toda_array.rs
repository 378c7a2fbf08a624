//! Toda's ring of eight as arrays, many starts.

use hamiltonian::prelude::*;

hamiltonian! {
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }
}

fn main() -> Result<(), Error> {
    let start = |member: Member| {
        let mut p = [0.0; 8];
        p[0] = 1e-3 * member.index as f64;
        (Toda::<8> {}, State::new([0.0; 8], p))
    };
    let mut swarm = Ensemble::new(1_000, start, StormerVerlet::default(), 1e-2)?;
    swarm.advance(1_000);
    for end in swarm.states().take(3) {
        println!("{:.6}", end?.q[0]);
    }
    Ok(())
}
