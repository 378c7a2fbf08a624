//! A star and eight planets in heliocentric pieces, eight starts.

use hamiltonian::prelude::*;

hamiltonian! {
    pub struct Planets {
        G = 2.95912208286e-4,
        m: [9],
    }
    H(q[9][3]; p[9][3]) = sum(i in 0..9) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..9, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m);
    split {
        Star = norm_squared(p_heliocentric[0] - sum(i in 1..9) { p_heliocentric[i] })/(2*m[0]);
        Pulls = -G*sum(i in 1..9, j in 1..i) {
            m[i]*m[j]/norm(q_heliocentric[i] - q_heliocentric[j])
        };
        Orbits = sum(i in 1..9) {
            norm_squared(p_heliocentric[i])/(2*m[i]) - G*m[0]*m[i]/norm(q_heliocentric[i])
        };
    }
}

fn main() -> Result<(), Error> {
    let start = |member: Member| {
        let mut m = [1e-3; 9];
        m[0] = 1.0;
        let system = Planets::new(m);
        let (mut q, mut p) = ([[0.0; 3]; 9], [[0.0; 3]; 9]);
        for i in 1..9 {
            let r = 1.0 + 2.0 * i as f64 + 1e-3 * member.index as f64;
            let angle = 2.0 * i as f64;
            let speed = (system.G / r).sqrt();
            q[i] = [r * angle.cos(), r * angle.sin(), 0.0];
            p[i] = [-m[i] * speed * angle.sin(), m[i] * speed * angle.cos(), 0.0];
        }
        let start = system.from_declared(&State::new(q, p));
        (system, start)
    };
    let mut swarm = Ensemble::new(8, start, Strang, 10.0)?;
    swarm.advance(1_000);
    for end in swarm.states() {
        println!("{:.6}", end?.q[(1, 0)]);
    }
    Ok(())
}
