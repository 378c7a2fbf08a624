use hamiltonian::prelude::*;

hamiltonian! {
    /// Kepler's problem in rotating axes.
    pub struct Rotating { omega = 1.0 }
    let r = sqrt(x^2 + y^2);
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/r + omega*(y*p_x - x*p_y)
}

fn main() -> Result<(), Error> {
    let start = State::new([1.0, 0.0], [0.0, 1.0]);
    Integrator::new(&Rotating::default(), StormerVerlet::default(), start, 1e-3)?;
    Ok(())
}
