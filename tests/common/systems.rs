//! The systems that several tests integrate, each one line of mathematics.

use hamiltonian::prelude::*;

hamiltonian! {
    /// The paper's pendulum; the potential is zero at the pivot.
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

hamiltonian! {
    /// The same; the potential is zero where it hangs.
    pub struct PendulumFromBottom { m = 1.0, l = 10.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) + m*g*l*(1 - cos(theta))
}

hamiltonian! {
    /// The paper's equation (34).
    pub struct Paper34 {}
    H = 0.5*(q^2 + 1)*(p^2 + 1)
}

hamiltonian! {
    /// (34) with a clock.
    pub struct Shaken34 {}
    H(q; p; t) = 0.5*(q^2 + 1)*(p^2 + 1)*(1 + sin(2*t)/2)
}

hamiltonian! {
    /// Separable, neither half quadratic.
    pub struct Relativistic {}
    H = sqrt(1 + p^2) - cos(q) + q^4/10
}

hamiltonian! {
    /// Both halves depend on time.
    pub struct Pumped {}
    H(q; p; t) = (1 + sin(2*t)/2)*sqrt(1 + p^2) + (1 + cos(3*t)/2)*(q^2/2 + q^4/4)
}

hamiltonian! {
    /// A driven oscillator with a function of its own.
    pub struct Driven { a = 0.1, omega = 1.0 }
    let U(r) = r^2/2 + r^4/4;
    H(q; p; t) = p^2/2 + U(q) - a*q*cos(omega*t)
}

hamiltonian! {
    /// The Hénon–Heiles system.
    pub struct HenonHeiles {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

hamiltonian! {
    /// The planar double pendulum, angles from the vertical.
    pub struct DoublePendulum { m1 = 1.0, m2 = 1.0, l1 = 1.0, l2 = 1.0, g = 9.81 }
    H(a, b; p_a, p_b) = (m2*l2^2*p_a^2 + (m1 + m2)*l1^2*p_b^2 - 2*m2*l1*l2*p_a*p_b*cos(a - b))
            /(2*m2*l1^2*l2^2*(m1 + m2*sin(a - b)^2))
        - (m1 + m2)*g*l1*cos(a) - m2*g*l2*cos(b)
}
