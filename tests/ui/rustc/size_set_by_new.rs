use hamiltonian::prelude::*;

hamiltonian! {
    /// Free bodies.
    pub struct Free { n: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) }
}

fn main() -> Result<(), Error> {
    // In the module of the definition its private fields can be seen.
    let mut free = Free::new(2, vec![1.0, 2.0])?;
    assert_eq!(*free.n, free.m.len());
    free.n = 3;
    Ok(())
}
