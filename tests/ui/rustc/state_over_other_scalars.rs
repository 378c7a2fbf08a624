use hamiltonian::prelude::*;

fn at_rest<T: Real>(angle: T) -> T {
    State::new([angle], [T::zero()]).q[0]
}

fn main() {
    let _ = State::new([Dual::variable(at_rest(1.0))], [Dual::fixed(0.0)]);
}
