//! The systems that all peers integrate.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A planet round a fixed star.
    pub struct Kepler {}
    H(q[2]; p[2]) = norm_squared(p)/2 - 1/norm(q);
    monitor radius = norm(q)
}

hamiltonian! {
    /// Stars in a galaxy, near its middle.
    pub struct HenonHeiles {}
    H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum {}
    H(q; p) = p^2/2 - cos(q)
}

hamiltonian! {
    /// Not separable: equation (34) of the paper.
    pub struct Coupled {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1);
    split {
        Turning = (q^2 + p^2)/2 + 0.5;
        Scaling = q^2*p^2/2;
    }
}

hamiltonian! {
    /// The Sun and the outer planets: astronomical units, days, masses of the Sun.
    pub struct Planets { G = 2.95912208286e-4, m: [6] }
    H(q[6][3]; p[6][3]) = sum(i in 0..6) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..6, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }
}

hamiltonian! {
    /// An orbit round a black hole in Schwarzschild's coordinates.
    pub struct BlackHole { E = 0.995, L = 4.6 }
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2)
        - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2);
    split {
        Falling = -p_r^2/r;
        Radial = p_r^2/2;
        Turning = p_theta^2/(2*r^2);
        Potential = -E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2);
    }
}

hamiltonian! {
    /// A ring of particles with exponential springs.
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }
}

hamiltonian! {
    /// The chain of Fermi, Pasta, Ulam and Tsingou between walls.
    pub struct Fput<const N: usize> { alpha = 0.25 }
    let V(r) = r^2/2 + alpha*r^3/3;
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 } + V(q[0]) + V(-q[N - 1])
        + sum(i in 1..N) { V(q[i] - q[i - 1]) }
}

hamiltonian! {
    /// Equal masses that attract each other, softened.
    pub struct Cluster { n: usize, m = 1e-3, eps2 = 2.5e-3 }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m) }
        - sum(i in 0..n, j in 0..i) { m^2/sqrt(norm_squared(q[i] - q[j]) + eps2) }
}
