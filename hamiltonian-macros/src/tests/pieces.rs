//! Splits that are true and of known flows are accepted, from one piece to eight, in the variables of charts, of sums of
//! sums; those beside them are refused.
//!
//! Input: definitions. Output: a panic with those that are judged otherwise. Invariant: a refusal is one of the proof or
//! of the search for flows, with its words.

use super::{Stage, refuse};

const ACCEPTED: &[&str] = &[
    // Three to eight pieces.
    "struct A {} H(x, y; u, v) = u^2/2 + v^2/2 + x^4 + y^4 + x*y; split { A = u^2/2 + v^2/2; B = x^4 + y^4; C = x*y }",
    "struct A {} H(x, y; u, v) = u^2/2 + v^2/2 + x^4 + y^4; split { A = u^2/2; B = v^2/2; C = x^4; D = y^4 }",
    "struct A {} H(x, y; u, v) = u^2/2 + v^2/2 + x^4 + y^4 + x*y; split { A = u^2/2; B = v^2/2; C = x^4; D = y^4; E = x*y }",
    "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4;
     split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4 }",
    "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4 + x*y*z;
     split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4; G = x*y*z }",
    "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4 + x*y*z + x*v - y*u;
     split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4; G = x*y*z; Turn = x*v - y*u }",
    // In the variables of charts.
    "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 - k/sqrt(x^2 + y^2) + (x^2 + y^2)^2; coordinates polar(x, y);
     split { Free = p_r^2/2 + p_phi^2/(2*r^2); Bound = -k/r + r^4 }",
    "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 + k*x; coordinates polar(x, y);
     split { Free = p_r^2/2 + p_phi^2/(2*r^2); Fall = k*r*cos(phi) }",
    "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 + k*x; coordinates polar(x, y);
     split { Free = (px^2 + py^2)/2; Fall = k*x }",
    "struct A {g} H(q[3]; p[3]) = norm_squared(p)/2 + g*q[2]; coordinates spherical(q);
     split { Free = p_r^2/2 + p_theta^2/(2*r^2) + p_phi^2/(2*r^2*sin(theta)^2); Fall = g*r*cos(theta) }",
    "struct A {g} H(x, y, z; px, py, pz) = (px^2 + py^2 + pz^2)/2 + g*z*(x^2 + y^2); coordinates polar(x, y);
     split { Plane = p_r^2/2 + p_phi^2/(2*r^2); Along = pz^2/2; V = g*z*r^2 }",
    "struct A {k} H(x, y, a, b; px, py, pa, pb) = (px^2 + py^2 + pa^2 + pb^2)/2 + k*(x*a + y*b);
     coordinates polar(x, y); coordinates polar(a, b);
     split { One = p_r^2/2 + p_phi^2/(2*r^2); Two = p_r_2^2/2 + p_phi_2^2/(2*r_2^2); V = k*r*r_2*cos(phi - phi_2) }",
    // Sums of sums of flows.
    "struct A {n: usize, k: usize, m: [n], e = 0.1}
     H(q[n][3], w[k][3]; p[n][3], u[k][3]) = sum(i in 0..n) { norm_squared(p[i])/2 - m[i]/norm(q[i]) }
       + sum(i in 0..k) { norm_squared(u[i])/2 - 1/norm(w[i]) } + e*sum(i in 0..n, j in 0..k) { dot(q[i], w[j]) };
     split {
         Kepler = sum(i in 0..n) { norm_squared(p[i])/2 - m[i]/norm(q[i]) } + sum(i in 0..k) { norm_squared(u[i])/2 - 1/norm(w[i]) };
         V = e*sum(i in 0..n, j in 0..k) { dot(q[i], w[j]) };
     }",
    "struct A<const N: usize> {k: [N]}
     H(q[N], w[N]; p[N], u[N]) = sum(i in 0..N) { (p[i]^2 + k[i]*q[i]^2)/2 + (u[i]^2 + w[i]^2)/2 + q[i]^2*w[i]^2 };
     split {
         Turns = sum(i in 0..N) { (p[i]^2 + k[i]*q[i]^2)/2 } + sum(i in 0..N) { (u[i]^2 + w[i]^2)/2 };
         V = sum(i in 0..N) { q[i]^2*w[i]^2 };
     }",
    // On one array: the lower part and the upper part, the even and the odd sites, the first one alone.
    "struct A {n: usize}
     H(q[2*n]; p[2*n]) = sum(i in 0..2*n) { (p[i]^2 + q[i]^2)/2 } + sum(i in 0..2*n) { q[i]^4 };
     split {
         Turns = sum(i in 0..n) { (p[i]^2 + q[i]^2)/2 } + sum(i in n..2*n) { (p[i]^2 + q[i]^2)/2 };
         V = sum(i in 0..2*n) { q[i]^4 };
     }",
    "struct A {n: usize}
     H(q[2*n]; p[2*n]) = sum(i in 0..n) { p[2*i]^2/2 - cos(q[2*i]) + p[2*i + 1]^2/2 + 2*q[2*i + 1]^2 } + sum(i in 0..n) { q[2*i]*q[2*i + 1] };
     split {
         Both = sum(i in 0..n) { (p[2*i]^2 + q[2*i]^2)/2 } + sum(i in 0..n) { p[2*i + 1]^2/2 + 2*q[2*i + 1]^2 };
         V = sum(i in 0..n) { q[2*i]*q[2*i + 1] - cos(q[2*i]) - q[2*i]^2/2 };
     }",
    "struct A {n: usize}
     H(q[n][3]; p[n][3]) = norm_squared(p[0])/2 - 2/norm(q[0]) + sum(i in 1..n) { norm_squared(p[i])/2 - 1/norm(q[i]) } + sum(i in 0..n) { q[i][0] };
     split {
         Kepler = norm_squared(p[0])/2 - 2/norm(q[0]) + sum(i in 1..n) { norm_squared(p[i])/2 - 1/norm(q[i]) };
         V = sum(i in 0..n) { q[i][0] };
     }",
    // Fixed points of the flows of single monomials.
    "struct A {a, b, c} H(q; p) = (a*q^2 + b*q^3 + c*q^4)*p^2 + q^2; split { A = (a*q^2 + b*q^3 + c*q^4)*p^2; B = q^2 }",
    "struct A {a} H(q; p) = a*q^3*p + q^2; split { A = a*q^3*p; B = q^2 }",
];

const REFUSED: &[(&str, &str)] = &[
    (
        "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 - k/sqrt(x^2 + y^2); coordinates polar(x, y);
         split { Free = p_r^2/2 + p_phi^2/r^2; Bound = -k/r }",
        "do not add up",
    ),
    (
        "struct A {k} H(x, y, a, b; px, py, pa, pb) = (px^2 + py^2 + pa^2 + pb^2)/2 + k*(x*a + y*b);
         coordinates polar(x, y); coordinates polar(a, b);
         split { One = p_r^2/2 + p_phi^2/(2*r^2); Two = p_r_2^2/2 + p_phi_2^2/(2*r_2^2); V = k*r*r_2*cos(phi + phi_2) }",
        "do not add up",
    ),
    (
        "struct A {n: usize}
         H(q[n]; p[n]) = sum(i in 0..n) { (p[i]^2 + q[i]^2)/2 } + sum(i in 0..n) { q[i]^4 };
         split { Turns = sum(i in 1..n) { (p[i]^2 + q[i]^2)/2 }; V = sum(i in 0..n) { q[i]^4 } }",
        "do not add up",
    ),
    // Overlapping sums do not commute.
    (
        "struct A {n: usize}
         H(q[2*n]; p[2*n]) = sum(i in 0..n) { (p[2*i]^2 + q[2*i]^2)/2 } + sum(i in 0..n) { p[i]^2/2 - 1/q[i]^2 } + q[0];
         split { V = q[0]; All = sum(i in 0..n) { (p[2*i]^2 + q[2*i]^2)/2 } + sum(i in 0..n) { p[i]^2/2 - 1/q[i]^2 } }",
        "no exact flow",
    ),
    (
        "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4 + x*y*z + x*v - y*u + y*w - z*v;
         split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4; G = x*y*z; Turn = x*v - y*u; More = y*w - z*v }",
        "more than 8",
    ),
];

#[test]
fn pieces_are_accepted_or_refused_for_a_reason() {
    let errors = |source: &str| -> Vec<String> {
        let errors = refuse(source).1;
        errors.iter().map(|error| error.text()).collect()
    };
    let refused = ACCEPTED.iter().map(|source| (source, errors(source)));
    let refused: Vec<_> = refused.filter(|(_, errors)| !errors.is_empty()).collect();
    assert!(refused.is_empty(), "{refused:#?}");
    for (source, reason) in REFUSED {
        let (stage, _) = refuse(source);
        let errors = errors(source);
        let is_said = errors.iter().any(|error| error.contains(reason));
        assert!(
            is_said && stage == Some(Stage::Prove),
            "{source}: {errors:#?}"
        );
    }
}
