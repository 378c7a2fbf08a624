use hamiltonian::prelude::*;

hamiltonian! { pub struct T { m = 1.0 } H = p^2/(2*m) + q^2/2 }

fn main() {}
