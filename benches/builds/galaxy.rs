//! Stars in a galaxy with a disk, a halo and a turning bar: two sweeps of one type.

use hamiltonian::prelude::*;

hamiltonian! {
    pub struct Galaxy { disk = 1.0, halo = 0.5, bar = 0.1, omega = 0.3 }
    H(x, y, z; u, v, w) = (u^2 + v^2 + w^2)/2 - omega*(x*v - y*u)
        - disk/sqrt(x^2 + y^2 + (1 + sqrt(z^2 + 0.01))^2)
        + halo/2*ln(x^2 + y^2 + z^2 + 1)
        + bar*(x^2 - y^2)/(1 + x^2 + y^2)^2
}

fn main() -> Result<(), Error> {
    let star = |member: Member| {
        let r = 1.0 + 1e-3 * member.index as f64;
        (
            Galaxy::default(),
            State::new([r, 0.0, 0.1], [0.0, 0.8, 0.0]),
        )
    };
    for step in [0.02, 0.01] {
        let sweep = Sweep::new(1_000, star, BlanesMoan4, step).with_end(20.0);
        let table = sweep
            .record(["x", "y"], |end| [end.state.q[0], end.state.q[1]])
            .collect()?;
        println!("{} stars", table.rows());
    }
    let slow = |member: Member| {
        let (system, mut start) = star(member);
        start.p[1] *= 0.5;
        (system, start)
    };
    let sweep = Sweep::new(1_000, slow, BlanesMoan4, 0.01).with_end(20.0);
    let table = sweep.record(["z"], |end| [end.state.q[2]]).collect()?;
    println!("{} slow stars", table.rows());
    Ok(())
}
