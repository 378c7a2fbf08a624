use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {}
    H = p^2/2 + q^2/2;
    invariant energy_of_motion = H*(H - 1) + q*(H - 1) on H = 2
}

fn main() {}
