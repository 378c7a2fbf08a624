use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2 + q^2; split { A = p^2; B = q^2 }; split { C = p^2; D = q^2 } };
}
