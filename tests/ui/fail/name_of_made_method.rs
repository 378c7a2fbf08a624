use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Parameter { k = 1.0 }
    H = p^2/2 + k*q;
    monitor parameter = p
}

hamiltonian! {
    pub struct Gradient { k = 1.0 }
    H = p^2/2 + k*q;
    event x = p;
    monitor x_gradient = q
}

hamiltonian! {
    pub struct Pieces { k = 1.0 }
    H = p^2/2 + k*q;
    split { B = p^2/2; b = k*q }
}

hamiltonian! {
    pub struct Timed { k = 1.0 }
    H = p^2/2 + k*q;
    dt = 2*ds;
    split { Clock = p^2/2; V = k*q };
    monitor piece_v = q;
    monitor on_shell = p
}

fn main() {}
