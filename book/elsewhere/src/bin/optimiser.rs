//! A definition in an optimiser of another crate: the equilibrium of ions in a trap.

use argmin::core::{CostFunction, Error, Executor, Gradient};
use argmin::solver::{linesearch::MoreThuenteLineSearch, quasinewton::LBFGS};
use hamiltonian::prelude::{State, System, hamiltonian};

hamiltonian! {
    /// Ions on a line in a harmonic trap.
    pub struct Ions { n: usize }
    H(x[n]; p[n]) = sum(i in 0..n) { (p[i]^2 + x[i]^2)/2 }
        + sum(i in 0..n, j in 0..i) { 1/abs(x[i] - x[j]) }
}

impl CostFunction for Ions {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.energy(&State::new(x.clone(), vec![0.0; x.len()])))
    }
}

impl Gradient for Ions {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;
    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let at = State::new(x.clone(), vec![0.0; x.len()]);
        Ok(System::gradient(self, &at).q.as_slice().to_vec())
    }
}

fn main() -> Result<(), Error> {
    let solver = LBFGS::new(MoreThuenteLineSearch::new(), 7).with_tolerance_grad(1e-9)?;
    let executor = Executor::new(Ions::new(3)?, solver);
    let result = executor.configure(|state| state.param(vec![-1.5, 0.2, 1.0])).run()?;
    let rest = result.state().best_param.as_ref().expect("a point was found");
    // Three ions: 0 and ±(5/4)^(1/3).
    println!("at rest: {rest:?}");
    assert!((rest[2] - 1.25_f64.cbrt()).abs() < 1e-6 && rest[1].abs() < 1e-6);
    Ok(())
}
