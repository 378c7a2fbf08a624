use hamiltonian::prelude::*;

hamiltonian! {
    /// A pendulum with a mistake.
    pub struct Pendulum {
        m = 1.0,
        l = 10.0,
        g = 9.81,
    }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(phi)
}

hamiltonian! {
    pub struct Chain<const N: usize> {
        k: [N],
    }
    H(q[N]; p[N]) = norm_squared(p)/2 + k
}

fn energy<S: System>(_: &S) -> f64 {
    0.0
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Pendulum { l: 2.0, ..Default::default() };
    let start = State::new([0.5], [0.0]);
    let mut run = Integrator::new(&pendulum, StormerVerlet::default(), start, 1e-3)?;
    run.advance(1_000)?;
    println!("{} {}", pendulum.m * energy(&pendulum), run.state().q[0]);
    let chain = Chain::<3>::new([1.0; 3])?;
    println!("{}", energy(&chain) + chain.momentum(&start)[0]);
    let value = hamiltonian! { H = p^2/2 + 2q };
    println!("{}", energy(&value) + value.gradient(&start).q[0]);
    Ok(())
}
