use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Taken { r = 1.0 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - r/hypot(x, y);
    coordinates polar(x, y)
}

hamiltonian! {
    pub struct RunTime { n: usize, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) };
    coordinates jacobi(q, m)
}

hamiltonian! {
    pub struct Twice {}
    H(x, y, z; p_x, p_y, p_z) = (p_x^2 + p_y^2 + p_z^2)/2 - 1/hypot(x, y);
    coordinates polar(x, y);
    coordinates polar(x, z)
}

hamiltonian! {
    pub struct Vectors {}
    H(x[2], y[2]; p_x[2], p_y[2]) = (norm_squared(p_x) + norm_squared(p_y))/2;
    coordinates polar(x, y)
}

hamiltonian! {
    pub struct Ring<const N: usize> { m: [N] }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m[i]) + norm(q[i] - q[(i + 1) % N]) };
    coordinates heliocentric(q, m)
}

hamiltonian! {
    pub struct Sliced<const N: usize> {}
    H(s[N], q[2]; w[N], p[2]) = norm_squared(p)/2 + norm_squared(w) + sum(i in 0..N) { q[i]*s[i] };
    coordinates polar(q)
}

fn main() {}
