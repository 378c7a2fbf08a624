//! The systems that all peers integrate.

// Each program has systems of its own beside those of both.
#![allow(dead_code)]

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

/// The Sun and the outer planets on 5 September 1994 (Hairer, Lubich, Wanner, Geometric Numerical Integration,
/// 2006, table I.2.2): mass, position, velocity.
#[rustfmt::skip]
pub const PLANETS: [(f64, [f64; 3], [f64; 3]); 6] = [
    (1.00000597682, [0.0; 3], [0.0; 3]),
    (0.000954786104043, [-3.5023653, -3.8169847, -1.5507963], [0.00565429, -0.00412490, -0.00190589]),
    (0.000285583733151, [9.0755314, -3.0458353, -1.6483708], [0.00168318, 0.00483525, 0.00192462]),
    (0.0000437273164546, [8.3101420, -16.2901086, -7.2521278], [0.00354178, 0.00137102, 0.00055029]),
    (0.0000517759138449, [11.4707666, -25.7294829, -10.8169456], [0.00288930, 0.00114527, 0.00039677]),
    (1.0 / 1.3e8, [-15.5387357, -25.2225594, -3.1902382], [0.00276725, -0.00170702, -0.00136504]),
];

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

// Those below are integrated to tolerances alone.

hamiltonian! {
    /// The restricted three-body problem, in the rotating frame.
    pub struct Restricted { mu = 0.012277471 }
    H(x, y; px, py) = (px^2 + py^2)/2 + y*px - x*py - (1 - mu)/sqrt((x + mu)^2 + y^2) - mu/sqrt((x - 1 + mu)^2 + y^2)
}

hamiltonian! {
    /// Three bodies in a plane.
    pub struct ThreeBodies { m: [3] }
    H(q[3][2]; p[3][2]) = sum(i in 0..3) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..3, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }
}

hamiltonian! {
    /// Two pendulums, one below the other, of unit lengths and masses.
    pub struct DoublePendulum {}
    H(a, b; u, v) = (u^2 + 2*v^2 - 2*u*v*cos(a - b))/(2*(1 + sin(a - b)^2)) - 2*cos(a) - cos(b)
}

hamiltonian! {
    /// A charge in the field of a magnetic dipole, Störmer's problem.
    pub struct Dipole {}
    H(rho, z; u, v) = (u^2 + v^2)/2 + (1/rho - rho/(rho^2 + z^2)^(3/2))^2/2
}

hamiltonian! {
    /// Duffing's oscillator without friction, driven.
    pub struct Duffing {}
    H(q; p; t) = p^2/2 - q^2/2 + q^4/4 - 0.3*q*cos(1.2*t)
}

hamiltonian! {
    /// Lotka's and Volterra's populations, in their logarithms.
    pub struct Volterra {}
    H(q; p) = exp(q) - q + exp(p) - p
}

hamiltonian! {
    /// Two atoms with Lennard-Jones's potential.
    pub struct Atoms {}
    H(q; p) = p^2/2 + 4*(1/q^12 - 1/q^6)
}
