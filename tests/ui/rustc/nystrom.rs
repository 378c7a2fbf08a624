use hamiltonian::{Nystrom, hamiltonian};

hamiltonian! {
    /// Motion at great speed.
    pub struct Relativistic { m = 1.0 }
    H(q; p) = sqrt(m^2 + p^2) + q^2/2
}

hamiltonian! {
    /// Pieces that both depend on momenta.
    pub struct Squares {}
    H = (q^2 + 1)*(p^2 + 1)/2;
    split { Oscillator = (q^2 + p^2 + 1)/2; Product = q^2*p^2/2; }
}

hamiltonian! {
    /// A field that grows: the piece beside the potential depends on time.
    pub struct Growing {}
    H(x, y; p_x, p_y; t) = (p_x^2 + p_y^2)/2 + t*(x*p_y - y*p_x) + x^4;
    split { Rest = (p_x^2 + p_y^2)/2 + t*(x*p_y - y*p_x); V = x^4; }
}

hamiltonian! {
    /// A damped oscillator: the kick depends on momenta.
    pub struct Damped {}
    H(q; p) = p^2/2 + q^2/2;
    force(q; p) = -p/10
}

fn by_nystrom<S: Nystrom>(_: &S) {}

fn main() {
    by_nystrom(&Relativistic::default());
    by_nystrom(&Squares::default());
    by_nystrom(&Growing::default());
    by_nystrom(&Damped::default());
}
