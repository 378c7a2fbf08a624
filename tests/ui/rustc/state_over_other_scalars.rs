use hamiltonian::prelude::*;

hamiltonian! {
    /// A mass on a cart, from its Lagrangian.
    pub struct Cart { m = 1.0 }
    L(s, r[3]; w, v[3]) = m*w^2/2 + norm_squared(v)/2
}

fn at_rest<T: Real>(angle: T) -> T {
    let _ = Cart::<f64>::default().state_from_velocity(
        angle,
        CartVector::over(angle, [angle; 3]),
        CartVector::over(angle, [angle; 3]),
    );
    let _ = CartVector::new(angle, [angle; 3]);
    State::new([angle], [T::zero()]).q[0]
}

fn main() {
    let _ = State::new([Dual::variable(at_rest(1.0))], [Dual::fixed(0.0)]);
}
