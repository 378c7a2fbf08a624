use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Gravity { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    invariant total_momentum = sum(i in 0..n) { p[i] } - 2*p[0];
    invariant angular_momentum = sum(i in 0..n) { [
        q[i][1]*p[i][2] + q[i][2]*p[i][1],
        q[i][2]*p[i][0] - q[i][0]*p[i][2],
        q[i][0]*p[i][1] - q[i][1]*p[i][0],
    ] }
}

hamiltonian! {
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    invariant total_momentum = sum(i in 0..N) { p[i] } - 2*p[0]
}

hamiltonian! {
    pub struct Toda3 {}
    H(q[3]; p[3]) = sum(i in 0..3) { p[i]^2/2 + exp(q[i] - q[(i + 1) % 3]) };
    invariant cubic = sum(i in 0..3) {
        p[i]^3/3 - (p[i] + p[(i + 1) % 3])*exp(q[i] - q[(i + 1) % 3])
    }
}

hamiltonian! {
    pub struct HenonHeilesPlus {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y + y^3/3;
    invariant second = p_x*p_y + x*y + x^3/3 - x*y^2
}

hamiltonian! {
    pub struct Kerr { a = 0.9, M = 1.0, E = 0.95, L = 3.0 }
    let Sigma = r^2 + a^2*cos(theta)^2;
    let Delta = r^2 - 2*M*r + a^2;
    H(r, theta; p_r, p_theta) = (Delta*p_r^2 + p_theta^2 - ((r^2 + a^2)*E - a*L)^2/Delta
        + (L - a*E*sin(theta)^2)^2/sin(theta)^2)/(2*Sigma);
    invariant carter = p_theta^2 + cos(theta)^2*(a^2*(-2*H + E^2) + L^2/sin(theta)^2);
    invariant carter_of_unit_mass = p_theta^2
        + cos(theta)^2*(a^2*(1 - E^2) + L^2/sin(theta)^2);
    invariant carter_on_other_shell = p_theta^2
        + cos(theta)^2*(a^2*(1 - E^2) + L^2/sin(theta)^2) on H = 1/2
}

fn main() {}
