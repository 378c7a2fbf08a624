use hamiltonian::prelude::*;

hamiltonian! {
    struct S { n: usize, K: [n][n] }
    H(q[n]; p[n]) = norm_squared(p)/2
        + sum(i in 1..n) { (K*q)[i]^2 }
        + sum(i in 2..n) { (K*q)[i]^2 }
        + sum(i in 3..n) { (K*q)[i]^2 }
        + sum(i in 4..n) { (K*q)[i]^2 }
        + sum(i in 5..n) { (K*q)[i]^2 }
        + sum(i in 6..n) { (K*q)[i]^2 }
        + sum(i in 7..n) { (K*q)[i]^2 }
        + sum(i in 8..n) { (K*q)[i]^2 }
        + sum(i in 9..n) { (K*q)[i]^2 }
        + sum(i in 10..n) { (K*q)[i]^2 }
        + sum(i in 11..n) { (K*q)[i]^2 }
        + sum(i in 12..n) { (K*q)[i]^2 }
        + sum(i in 13..n) { (K*q)[i]^2 }
        + sum(i in 14..n) { (K*q)[i]^2 }
        + sum(i in 15..n) { (K*q)[i]^2 }
        + sum(i in 16..n) { (K*q)[i]^2 }
        + sum(i in 17..n) { (K*q)[i]^2 }
        + sum(i in 18..n) { (K*q)[i]^2 }
        + sum(i in 19..n) { (K*q)[i]^2 }
        + sum(i in 20..n) { (K*q)[i]^2 }
        + sum(i in 21..n) { (K*q)[i]^2 }
        + sum(i in 22..n) { (K*q)[i]^2 }
        + sum(i in 23..n) { (K*q)[i]^2 }
        + sum(i in 24..n) { (K*q)[i]^2 }
        + sum(i in 25..n) { (K*q)[i]^2 }
        + sum(i in 26..n) { (K*q)[i]^2 }
        + sum(i in 27..n) { (K*q)[i]^2 }
        + sum(i in 28..n) { (K*q)[i]^2 }
        + sum(i in 29..n) { (K*q)[i]^2 }
        + sum(i in 30..n) { (K*q)[i]^2 }
        + sum(i in 31..n) { (K*q)[i]^2 }
        + sum(i in 32..n) { (K*q)[i]^2 }
}

fn main() {}
