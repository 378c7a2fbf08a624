//! Lists that do not have the extents of a parameter with three of them.

use hamiltonian::prelude::*;

hamiltonian! {
    /// Extents in the type.
    pub struct Layers { w: [2][1][3] }
    H(q[3]; p[3]) = norm_squared(p)/2 + sum(i in 0..2, k in 0..3) { w[i][0][k]*q[k]^2 }
}

hamiltonian! {
    /// Extents set at run time.
    pub struct Crystal { n: usize, w: [n][2][n] }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n, j in 0..2, k in 0..n) { w[i][j][k]*q[i]*q[k] }
}

fn main() -> Result<(), Error> {
    let _ = Layers::new([[[1.0, 2.0]]; 2]);
    let _ = Crystal::new(3, vec![1.0; 18])?;
    let _ = Crystal::new(3, vec![vec![vec![1; 3]; 2]; 3])?;
    let layers = Layers::new([[[1.0, 2.0, 3.0]]; 2]);
    let crystal = Crystal::new(3, vec![[[1.0; 3]; 2]; 3])?;
    let energy: f64 = layers.energy(&State::new([1.0; 3], [0.0; 3]));
    assert_eq!(energy, crystal.energy(&State::new(vec![1.0; 3], vec![0.0; 3])));
    Ok(())
}
