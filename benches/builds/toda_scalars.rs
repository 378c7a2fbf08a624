//! Toda's ring of eight as sixteen numbers, many starts.

use hamiltonian::prelude::*;

hamiltonian! {
    pub struct Toda {}
    H(a, b, c, d, e, f, g, h; p, q, r, s, t, u, v, w) =
        (p^2 + q^2 + r^2 + s^2 + t^2 + u^2 + v^2 + w^2)/2
        + exp(a - b) + exp(b - c) + exp(c - d) + exp(d - e) + exp(e - f) + exp(f - g) + exp(g - h) + exp(h - a)
}

fn main() -> Result<(), Error> {
    let start = |member: Member| {
        let mut p = [0.0; 8];
        p[0] = 1e-3 * member.index as f64;
        (Toda {}, State::new([0.0; 8], p))
    };
    let mut swarm = Ensemble::new(1_000, start, StormerVerlet::default(), 1e-2)?;
    swarm.advance(1_000);
    for end in swarm.states().take(3) {
        println!("{:.6}", end?.q[0]);
    }
    Ok(())
}
