//! Extents that are products of sizes.

use crate::common::bits;
use hamiltonian::errors::InputError;
use hamiltonian::prelude::*;

hamiltonian! {
    /// A product of sizes and a multiple of a size: sums over all elements, over a ring, over neighbours; a product as
    /// a number, and in an index.
    pub struct Flat { n: usize, m: usize, k = 1.5, w: [n*m], s: [2*n] }
    H(q[n*m]; p[n*m]) = sum(i in 0..n*m) {
        p[i]^2/(2*w[i]) + k*q[i]^4/4 + (q[(i + 1) % (m*n)] - q[i])^2/2
    } + sum(i in 0..2*n) { s[i] }*q[0] + dot(w, q)/(n*m) + q[n*m - 1]^2
        + sum(i in 0..n*m - 1) { cos(q[i + 1] - q[i]) };
    monitor last = q[n*m - 1]
}

hamiltonian! {
    /// The same with a name for each extent.
    pub struct Line { n: usize, l: usize, k = 1.5, w: [n], s: [l] }
    H(q[n]; p[n]) = sum(i in 0..n) {
        p[i]^2/(2*w[i]) + k*q[i]^4/4 + (q[(i + 1) % n] - q[i])^2/2
    } + sum(i in 0..l) { s[i] }*q[0] + dot(w, q)/n + q[n - 1]^2
        + sum(i in 0..n - 1) { cos(q[i + 1] - q[i]) };
    monitor last = q[n - 1]
}

hamiltonian! {
    /// A const generic among the factors, columns, and sums over pairs.
    pub struct Bonds<const N: usize> { m: usize, G = 1.0 }
    H(q[N*m][3]; p[N*m][3]) = sum(i in 0..N*m) { norm_squared(p[i])/2 }
        + sum(i in 0..N*m, j in 0..i) { G*norm_squared(q[i] - q[j])^2 };
    invariant momentum = sum(i in 0..N*m) { p[i] };
    invariant angular = sum(i in 0..m*N) { cross(q[i], p[i]) }
}

hamiltonian! {
    /// The twin of `Bonds`.
    pub struct Pairs { n: usize, G = 1.0 }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/2 }
        + sum(i in 0..n, j in 0..i) { G*norm_squared(q[i] - q[j])^2 }
}

hamiltonian! {
    /// Rows of a lattice.
    pub struct Sheet { n: usize, m: usize }
    H(u[n*m][n]; p[n*m][n]) = sum(i in 0..n*m, j in 0..n) {
        p[i][j]^2/2 + (u[(i + 1) % (n*m)][j] - u[i][j])^4/4
    };
    invariant momentum = sum(i in 0..n*m, j in 0..n) { p[i][j] }
}

hamiltonian! {
    /// The twin of `Sheet`.
    pub struct Rows { r: usize, n: usize }
    H(u[r][n]; p[r][n]) = sum(i in 0..r, j in 0..n) {
        p[i][j]^2/2 + (u[(i + 1) % r][j] - u[i][j])^4/4
    }
}

fn given(count: usize, salt: usize) -> Vec<f64> {
    (0..count).map(|k| ((7 * k + salt) as f64).sin()).collect()
}

/// Both systems have the same energies and gradients at a state, and after some steps of each scheme, bit for bit.
macro_rules! same {
    ($a:expr, $b:expr, $start:expr) => {{
        let (a, b, start) = (&$a, &$b, $start);
        assert_eq!(a.energy(&start).to_bits(), b.energy(&start).to_bits());
        assert_eq!(a.gradient(&start), b.gradient(&start));
        same!(@ StormerVerlet::default(), a, b, start);
        same!(@ Gauss::<2>::default(), a, b, start);
    }};
    (@ $scheme:expr, $a:ident, $b:ident, $start:ident) => {
        let mut one = Integrator::new($a, $scheme, $start.clone(), 0.01).unwrap();
        let mut other = Integrator::new($b, $scheme, $start.clone(), 0.01).unwrap();
        one.advance(20).unwrap();
        other.advance(20).unwrap();
        assert_eq!(one.state(), other.state());
        assert_ne!(*one.state(), $start);
    };
}

/// Extents of one element, short ones, and ones that enter lanes.
const SIZES: [(usize, usize); 6] = [(1, 1), (1, 2), (2, 3), (5, 13), (8, 37), (40, 40)];

#[test]
fn a_product_has_the_bits_of_a_size_of_its_value() {
    for (n, m) in SIZES {
        let k = n * m;
        let w: Vec<f64> = given(k, 0).iter().map(|x| x + 1.5).collect();
        let flat = Flat::new(n, m, w.clone(), given(2 * n, 1)).unwrap();
        let line = Line::new(k, 2 * n, w, given(2 * n, 1)).unwrap();
        let start = State::new(given(k, 2), given(k, 3));
        let (a, b) = (
            flat.parameter_gradient(&start),
            line.parameter_gradient(&start),
        );
        assert_eq!((a.k, a.w(), a.s()), (b.k, b.w(), b.s()));
        assert_eq!(flat.last(&start), start.q[k - 1]);
        bits::check(&flat, k as u64);
        same!(flat, line, start);
    }
}

#[test]
fn products_are_extents_of_columns_and_of_lattices() {
    for m in [1, 2, 17, 20] {
        let triples = |salt| {
            let numbers = given(6 * m, salt).into_iter();
            numbers.map(|x| [x, x * x, 0.5 - x]).collect::<Vec<_>>()
        };
        let bonds = Bonds::<2>::new(m).unwrap();
        let start = State::new(triples(0)[..2 * m].to_vec(), triples(1)[..2 * m].to_vec());
        same!(bonds, Pairs::new(2 * m).unwrap(), start);
        let rows = |salt| vec![given(3, salt); 3 * m];
        let sheet = Sheet::new(3, m).unwrap();
        same!(
            sheet,
            Rows::new(3 * m, 3).unwrap(),
            State::new(rows(0), rows(1))
        );
    }
}

#[test]
fn errors_name_the_product() {
    let refused = |n, m, w: usize, s: usize| {
        let made = Flat::new(n, m, vec![1.0; w], vec![1.0; s]);
        made.unwrap_err().to_string()
    };
    assert_eq!(
        refused(2, 3, 5, 4),
        "`w[n*m]` must have 6 components, found 5"
    );
    assert_eq!(
        refused(2, 3, 6, 3),
        "`s[2*n]` must have 4 components, found 3"
    );
    assert_eq!(
        refused(2, 0, 0, 4),
        "`q[0]` reaches 0, but the extent is 0: the sizes do not fit"
    );
    let large = 1 << (usize::BITS - 2);
    assert_eq!(
        refused(large, 8, 1, 1),
        "`n*m` does not fit into memory: the sizes are too large"
    );
    assert_eq!(
        Round::new(2, 3, 5)
            .err()
            .map(|error| error.to_string())
            .unwrap(),
        "`q[(i + 1) % (n*m)]` reaches 5, but the extent is 5: the sizes do not fit"
    );
    let flat = Flat::new(2, 3, vec![1.0; 6], vec![1.0; 4]).unwrap();
    let short = State::new(vec![1.0; 5], vec![1.0; 5]);
    assert_eq!(
        flat.check_shape(&short).unwrap_err().to_string(),
        "`q` must have 6 components, found 5"
    );
    assert!(
        flat.to_string()
            .starts_with("H(q[n*m]; p[n*m]) = sum(i in 0..n*m) { p[i]^2/(2*w[i])")
    );
}

hamiltonian! {
    /// A product in an index alone.
    pub struct Last { n: usize, m: usize, k: usize }
    H(q[k]; p[k]) = norm_squared(p)/2 + q[n*m - 1]^2
}

hamiltonian! {
    /// Products after `%` and before it.
    pub struct Round { n: usize, m: usize, k: usize }
    H(q[k]; p[k]) = sum(i in 0..k) { p[i]^2/2 + q[(i + 1) % (n*m)]^2 + q[(i + n*m) % k]^2 + q[(i - 3*n) % k]^2 }
}

hamiltonian! {
    /// A range to a product of five sizes.
    pub struct Five { a: usize, b: usize, c: usize, d: usize, e: usize }
    H(q; p) = p^2/2 + sum(i in 0..a*b*c*d*e) { q^2 }
}

hamiltonian! {
    /// Multiples of a size and of a product, and sums.
    pub struct Multiples { n: usize, m: usize }
    H(q; p) = p^2/2 + sum(i in 0..2*n*m) { q^2 } + sum(i in 0..3*m) { q^4 } + sum(i in 1..m + 2) { q^6 }
}

hamiltonian! {
    /// A range that begins at a loop variable.
    pub struct Nested { n: usize, m: usize }
    H(q; p) = p^2/2 + sum(i in n..n + 2, j in i..i + m) { q^2 }
}

hamiltonian! {
    /// Three sizes, one of which may be 0.
    pub struct Three { n: usize, m: usize, k: usize }
    H(q[n*m*k]; p[n*m*k]) = sum(i in 0..n*m*k) { p[i]^2/2 + q[i]^2/2 }
}

hamiltonian! {
    /// The same with an extent for each size.
    pub struct Axes { n: usize, m: usize, k: usize }
    H(q[n][m][k]; p[n][m][k]) = sum(a in 0..n, b in 0..m, c in 0..k) { p[a][b][c]^2/2 + q[a][b][c]^2/2 }
}

#[test]
fn products_beyond_usize_are_refused_wherever_they_stand() {
    fn refused<S>(made: Result<S, Error>, product: &str) {
        let Err(Error::Input(InputError::Memory { name, .. })) = made else {
            panic!("`{product}`: {:?}", made.err());
        };
        assert_eq!(&*name, product);
    }
    let half = 1 << (usize::BITS / 2);
    let top = 1 << (usize::BITS - 1);
    refused(Last::new(top + 1, 2, 3), "n*m");
    refused(Last::new(half, half, 3), "n*m");
    refused(Round::new(top + 1, 2, 3), "n*m");
    refused(Round::new(half, half, 3), "n*m");
    refused(Round::new(usize::MAX / 5, 0, 3), "3*n");
    refused(Five::new(half, 1, half, 1, 1), "a*b*c*d*e");
    refused(Multiples::new(top, 1), "2*n*m");
    refused(Multiples::new(0, top), "3*m");
    refused(Multiples::new(0, usize::MAX), "3*m");
    refused(Nested::new(top / 2, top / 2), "n + m + 1");
    refused(Three::new(half, half, 1), "n*m*k");
}

#[test]
fn products_that_are_0_are_0() {
    let half = 1 << (usize::BITS / 2);
    let start = State::new([2.0], [0.0]);
    let five = Five::new(half, half, half, 0, 3).unwrap();
    assert_eq!(five.energy(&start), 0.0);
    let none = Multiples::new(1 << (usize::BITS - 1), 0).unwrap();
    assert_eq!(none.energy(&start), 64.0);
    for (n, m, k) in [(half, half, 0), (half, 0, half), (0, half, half)] {
        let empty = Three::new(n, m, k).unwrap();
        let start = State::new(Vec::<f64>::new(), Vec::<f64>::new());
        assert_eq!(empty.energy(&start), 0.0);
        let mut run = Integrator::new(&empty, StormerVerlet::default(), start, 0.1).unwrap();
        run.advance(3).unwrap();
        // A sum over three loops would run the outer ones.
        assert!(Axes::new(n, m, k).is_ok());
    }
}
