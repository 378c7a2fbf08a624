//! The same lattice with other names, orders and ranges of indices, against derivatives by hand.
//!
//! Forces by hand stand bond by bond, in numbers of 106 bits: they share no code with the macro.

use crate::common::bits;
use hamiltonian::Vector;
use hamiltonian::prelude::*;
use hamiltonian_lanes::{DoubleDouble, Real};

/// A bond between two sites: its energy is r²/2 + r⁴/4 for the difference r of the second and the first.
type Bond = (usize, usize);

/// The force of bonds on sites.
fn forces(q: &[f64], bonds: &[Bond]) -> Vec<f64> {
    let wide: Vec<DoubleDouble> = q.iter().map(|x| DoubleDouble::from(*x)).collect();
    let mut slopes = vec![DoubleDouble::zero(); q.len()];
    for &(i, j) in bonds {
        let r = wide[j] - wide[i];
        let slope = r + r * r * r;
        slopes[j] += slope;
        slopes[i] -= slope;
    }
    slopes.into_iter().map(|slope| slope.to_f64()).collect()
}

/// A number of modest size for a site.
fn given(k: usize, salt: usize) -> f64 {
    ((7 * k + 11 * salt) as f64).sin()
}

/// The gradient of a system against bonds.
#[track_caller]
fn check<S: System>(name: &str, system: &S, bonds: &[Bond], seed: usize) {
    let zeros = system.zeros();
    let mut start = State {
        q: zeros.clone(),
        p: zeros,
        t: 0.0,
    };
    let fill = |to: &mut [f64], salt| {
        for (k, to) in to.iter_mut().enumerate() {
            *to = given(k, salt);
        }
    };
    fill(start.q.part_mut(0), seed);
    fill(start.p.part_mut(0), seed + 1);
    let found = system.gradient(&start);
    let due = forces(start.q.part(0), bonds);
    for (k, (found, due)) in found.q.part(0).iter().zip(&due).enumerate() {
        let is_near = (found - due).abs() <= 1e-14 * (1.0 + due.abs());
        assert!(is_near, "{name}, site {k}: {found} is not {due}");
    }
    assert_eq!(found.p.part(0), start.p.part(0), "{name}");
}

hamiltonian! {
    /// Each site with the next.
    pub struct Forward { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n) { V(q[(i + 1) % n] - q[i]) }
}

hamiltonian! {
    /// Each site with the one before.
    pub struct Backward { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(k in 0..n) { V(q[k] - q[(k - 1) % n]) }
}

hamiltonian! {
    /// A range that begins and ends late.
    pub struct Late { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(j in 5..n + 5) { V(q[(j - 4) % n] - q[(j - 5) % n]) }
}

hamiltonian! {
    /// From the last site to the first.
    pub struct Turned { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n) { V(q[n - 1 - i] - q[(n - 2 - i) % n]) }
}

hamiltonian! {
    /// The bond across the ends by itself.
    pub struct Apart { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 1..n) { V(q[i] - q[i - 1]) } + V(q[0] - q[n - 1])
}

hamiltonian! {
    /// Next-nearest neighbours.
    pub struct Second { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n) { V(q[(i + 2) % n] - q[i]) }
}

hamiltonian! {
    /// The fifth neighbours, backwards.
    pub struct Fifth { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n) { V(q[i] - q[(i - 5) % n]) }
}

hamiltonian! {
    /// Three bonds of a site.
    pub struct Several { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n) { V(q[(i + 2) % n] - q[i]) + V(q[(i - 5) % n] - q[i]) + V(q[(i + 1) % n] - q[(i - 1) % n]) }
}

hamiltonian! {
    /// Open ends.
    pub struct Open { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 1..n) { V(q[i] - q[i - 1]) }
}

hamiltonian! {
    /// Open ends, by the lower site.
    pub struct OpenBelow { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n - 1) { V(q[i + 1] - q[i]) }
}

hamiltonian! {
    /// Open ends, of a range that ends beyond them.
    pub struct OpenLate { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 2..n + 1) { V(q[i - 1] - q[i - 2]) }
}

hamiltonian! {
    /// Open ends by a condition.
    pub struct OpenIf { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n) { if i > 0 { V(q[i] - q[(i - 1) % n]) } else { 0 } }
}

hamiltonian! {
    /// Open ends, the fifth neighbours.
    pub struct OpenFifth { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 5..n) { V(q[i] - q[i - 5]) }
}

hamiltonian! {
    /// Open ends, two bonds of a site.
    pub struct OpenBoth { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n - 2) { V(q[i + 2] - q[i]) } + sum(k in 5..n) { V(q[k] - q[k - 5]) }
}

hamiltonian! {
    /// Pairs, below the diagonal.
    pub struct Below { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..i) { V(q[i] - q[j]) }
}

hamiltonian! {
    /// Pairs, above the diagonal.
    pub struct Above { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in i + 1..n) { V(q[j] - q[i]) }
}

hamiltonian! {
    /// Pairs, each twice.
    pub struct All { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..n) { V(q[j] - q[i])/2 }
}

hamiltonian! {
    /// Pairs of the sites that are no ends, from a shifted range.
    pub struct Inner { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 1..n - 1, j in 2..i + 1) { V(q[i] - q[j - 1]) }
}

/// Each of `n` sites with another one ahead, around the end.
fn ring(n: usize, by: usize) -> Vec<Bond> {
    (0..n).map(|i| (i, (i + by) % n)).collect()
}

/// The same without bonds around the end.
fn open(n: usize, by: usize) -> Vec<Bond> {
    (by..n).map(|i| (i - by, i)).collect()
}

/// All pairs.
fn pairs(n: usize) -> Vec<Bond> {
    (0..n).flat_map(|i| (0..i).map(move |j| (j, i))).collect()
}

/// All pairs without the first and the last site: 1 ≤ j < i < n − 1.
fn inner_pairs(n: usize) -> Vec<Bond> {
    let is_inner = |(j, i): &Bond| *j > 0 && i + 1 < n;
    pairs(n).into_iter().filter(is_inner).collect()
}

#[test]
fn chains_have_the_forces_of_their_bonds() {
    for n in (1..=40).chain(95..=104) {
        bits::check(&Several::new(n).unwrap(), n as u64);
        bits::check(&OpenBoth::new(n).unwrap(), n as u64);
        check("Forward", &Forward::new(n).unwrap(), &ring(n, 1), n);
        check("Backward", &Backward::new(n).unwrap(), &ring(n, 1), n);
        check("Late", &Late::new(n).unwrap(), &ring(n, 1), n);
        check("Turned", &Turned::new(n).unwrap(), &ring(n, 1), n);
        check("Apart", &Apart::new(n).unwrap(), &ring(n, 1), n);
        check("Second", &Second::new(n).unwrap(), &ring(n, 2), n);
        check("Fifth", &Fifth::new(n).unwrap(), &ring(n, 5), n);
        check(
            "Several",
            &Several::new(n).unwrap(),
            &[ring(n, 2), ring(n, 5), ring(n, 2)].concat(),
            n,
        );
        check("Open", &Open::new(n).unwrap(), &open(n, 1), n);
        check("OpenBelow", &OpenBelow::new(n).unwrap(), &open(n, 1), n);
        check("OpenLate", &OpenLate::new(n).unwrap(), &open(n, 1), n);
        check("OpenIf", &OpenIf::new(n).unwrap(), &open(n, 1), n);
        check("OpenFifth", &OpenFifth::new(n).unwrap(), &open(n, 5), n);
        check(
            "OpenBoth",
            &OpenBoth::new(n).unwrap(),
            &[open(n, 2), open(n, 5)].concat(),
            n,
        );
        check("Below", &Below::new(n).unwrap(), &pairs(n), n);
        check("Above", &Above::new(n).unwrap(), &pairs(n), n);
        check("All", &All::new(n).unwrap(), &pairs(n), n);
        check("Inner", &Inner::new(n).unwrap(), &inner_pairs(n), n);
    }
}

hamiltonian! {
    /// Both axes.
    pub struct Square { n: usize, m: usize }
    let V(r) = r^2/2 + r^4/4;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 }
        + sum(i in 0..n, j in 0..m) { V(u[(i + 1) % n][j] - u[i][j]) + V(u[i][(j + 1) % m] - u[i][j]) }
}

hamiltonian! {
    /// The same with the loops exchanged, and backwards.
    pub struct Crossed { n: usize, m: usize }
    let V(r) = r^2/2 + r^4/4;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 }
        + sum(j in 0..m, i in 0..n) { V(u[i][j] - u[(i - 1) % n][j]) } + sum(j in 1..m + 1, i in 0..n) { V(u[i][j - 1] - u[i][(j - 2) % m]) }
}

hamiltonian! {
    /// Far along both axes.
    pub struct Far { n: usize, m: usize }
    let V(r) = r^2/2 + r^4/4;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 }
        + sum(i in 0..n, j in 0..m) { V(u[(i + 2) % n][j] - u[i][j]) + V(u[i][(j - 5) % m] - u[i][j]) }
}

hamiltonian! {
    /// Across both.
    pub struct Diagonal { n: usize, m: usize }
    let V(r) = r^2/2 + r^4/4;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 }
        + sum(i in 3..n + 3, j in 0..m) { V(u[(i - 2) % n][(j + 2) % m] - u[(i - 3) % n][j]) }
}

hamiltonian! {
    /// Open ends.
    pub struct OpenSquare { n: usize, m: usize }
    let V(r) = r^2/2 + r^4/4;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 }
        + sum(i in 1..n, j in 0..m) { V(u[i][j] - u[i - 1][j]) } + sum(i in 0..n, j in 0..m - 1) { V(u[i][j + 1] - u[i][j]) }
}

hamiltonian! {
    /// Open ends by conditions.
    pub struct OpenIfs { n: usize, m: usize }
    let V(r) = r^2/2 + r^4/4;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 }
        + sum(i in 0..n, j in 0..m) { if i > 0 { V(u[i][j] - u[(i - 1) % n][j]) } else { 0 } + if j + 1 < m { V(u[i][(j + 1) % m] - u[i][j]) } else { 0 } }
}

hamiltonian! {
    /// Open ends, far and across.
    pub struct OpenFar { n: usize, m: usize }
    let V(r) = r^2/2 + r^4/4;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 }
        + sum(i in 2..n, j in 0..m - 5) { V(u[i][j + 5] - u[i - 2][j]) }
}

/// The bonds of a lattice between sites at these distances.
fn bonds([n, m]: [usize; 2], distances: &[(usize, usize)], is_periodic: bool) -> Vec<Bond> {
    let mut bonds = Vec::new();
    for &(down, right) in distances {
        for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
            if is_periodic || i + down < n && j + right < m {
                bonds.push((i * m + j, (i + down) % n * m + (j + right) % m));
            }
        }
    }
    bonds
}

#[test]
fn lattices_have_the_forces_of_their_bonds() {
    let narrow = (1..=40).map(|m| [3, m]);
    let high = (1..=7).map(|n| [n, 35]);
    for extents in narrow.chain(high) {
        let [n, m] = extents;
        let seed = 100 * n + m;
        let due = |distances: &[_], is_periodic| bonds(extents, distances, is_periodic);
        check(
            "Square",
            &Square::new(n, m).unwrap(),
            &due(&[(1, 0), (0, 1)], true),
            seed,
        );
        check(
            "Crossed",
            &Crossed::new(n, m).unwrap(),
            &due(&[(1, 0), (0, 1)], true),
            seed,
        );
        check(
            "Far",
            &Far::new(n, m).unwrap(),
            &due(&[(2, 0), (0, 5)], true),
            seed,
        );
        check(
            "Diagonal",
            &Diagonal::new(n, m).unwrap(),
            &due(&[(1, 2)], true),
            seed,
        );
        check(
            "OpenSquare",
            &OpenSquare::new(n, m).unwrap(),
            &due(&[(1, 0), (0, 1)], false),
            seed,
        );
        check(
            "OpenIfs",
            &OpenIfs::new(n, m).unwrap(),
            &due(&[(1, 0), (0, 1)], false),
            seed,
        );
        check(
            "OpenFar",
            &OpenFar::new(n, m).unwrap(),
            &due(&[(2, 5)], false),
            seed,
        );
    }
}
