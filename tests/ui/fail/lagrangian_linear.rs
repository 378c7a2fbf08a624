use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Linear {}
    L(q; v) = q*v - q^2/2
}

fn main() {}
