use hamiltonian::prelude::*;

hamiltonian! {
    /// A chain whose momenta meet the displacement of their neighbours.
    pub struct Chain<const N: usize> { c = 0.1 }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + q[i]^4/4 + c*p[i]*q[(i + 1) % N] }
}

fn main() -> Result<(), Error> {
    let start = State::new([1.0; 8], [0.0; 8]);
    Integrator::new(&Chain::default(), StormerVerlet::default(), start, 1e-3)?;
    Ok(())
}
