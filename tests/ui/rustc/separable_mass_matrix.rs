use hamiltonian::prelude::*;

hamiltonian! {
    /// A double pendulum.
    pub struct DoublePendulum { m = 1.0, l = 1.0, g = 9.81 }
    H(a, b; p_a, p_b) = (p_a^2 + 2*p_b^2 - 2*p_a*p_b*cos(a - b))/(2*m*l^2*(1 + sin(a - b)^2))
        - m*g*l*(2*cos(a) + cos(b))
}

fn main() -> Result<(), Error> {
    let start = State::new([1.0, 0.0], [0.0, 0.0]);
    Integrator::new(&DoublePendulum::default(), StormerVerlet::default(), start, 1e-3)?;
    Ok(())
}
