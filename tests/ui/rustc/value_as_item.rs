use hamiltonian::hamiltonian;

hamiltonian! { H = p^2/2 + q^2/2 }

fn main() {}
