//! Shapes of loops, generated: shifts of 1, 2 and 5, periodic and with open ends, on one to three axes, with
//! bonds that are polynomials, conditions, or have a row of parameters. Each against its energy in plain Rust,
//! and in lanes against its iterations one by one.

// Each definition uses one of three bonds, and the tests few of the methods of each.
#![allow(dead_code, unused_variables)]

use crate::common::bits;
use crate::common::derivatives::{Plain, check_plain, chosen, numbers};
use hamiltonian::prelude::*;

/// The extents of a lattice, its bonds, and two parameters for each place on its last axis.
struct Shape {
    extents: [usize; 3],
    axes: usize,
    shift: usize,
    is_periodic: bool,
    kind: Kind,
    w: Vec<Vec<f64>>,
}

/// The energy of a bond.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(non_camel_case_types)]
enum Kind {
    /// r²/2 + r⁴/4
    plain,
    /// r⁴/4 below 0
    condition,
    /// w r²/2
    row,
}

impl Plain for Shape {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let number = |x: f64| T::constant(x, 0.0);
        let [n, m, k] = self.extents;
        let mut h = number(0.0);
        for at in 0..n * m * k {
            let place = [at / (m * k), at / k % m, at % k];
            let w = |row: usize| number(self.w[row][place[2]]);
            h += (p[at] * p[at] + w(0) * q[at] * q[at]) * number(0.5);
            for axis in 3 - self.axes..3 {
                let mut next = place;
                next[axis] += self.shift;
                if self.is_periodic {
                    next[axis] %= self.extents[axis];
                } else if next[axis] >= self.extents[axis] {
                    continue;
                }
                let r = q[(next[0] * m + next[1]) * k + next[2]] - q[at];
                let (r2, half) = (r * r, number(0.5));
                h += match self.kind {
                    Kind::plain => r2 * half + r2 * r2 * number(0.25),
                    Kind::condition => {
                        T::select(r.lt(number(0.0)), r2 * r2 * number(0.25), number(0.0))
                    }
                    Kind::row => w(1) * r2 * half,
                };
            }
        }
        h
    }
}

/// The sizes of each number of axes: all tails, and blocks with and without a rest.
fn sizes(axes: usize) -> Vec<[usize; 3]> {
    match axes {
        1 => (1..=40)
            .chain(95..=104)
            .chain([136, 257])
            .map(|k| [1, 1, k])
            .collect(),
        2 => vec![[1, 1, 1], [1, 6, 33], [1, 3, 40], [1, 37, 45], [1, 40, 2]],
        _ => vec![[1, 1, 1], [2, 6, 38], [7, 3, 34], [6, 5, 2]],
    }
}

/// Definitions, and a test of each. The neighbours of a site have the indices that follow `|`.
macro_rules! shapes {
    ($($axes:tt $name:ident $shift:tt $ends:ident $kind:ident;)*) => {
        $(shapes!(@define $axes $name $shift $ends $kind);)*

        #[test]
        fn shapes_have_the_energy_of_plain_rust_and_the_bits_of_iterations_one_by_one() {
            $(for extents in sizes($axes) {
                let [n, m, k] = extents;
                let w: Vec<Vec<f64>> = (0..2).map(|row| numbers(row + 5).take(k).collect()).collect();
                let system = shapes!(@new $axes $name n m k w);
                let shape = Shape {
                    extents,
                    axes: $axes,
                    shift: $shift,
                    is_periodic: shapes!(@periodic $ends),
                    kind: Kind::$kind,
                    w,
                };
                if n * m * k < 250 {
                    check_plain(&system, &chosen(&system, 1), &shape);
                }
                bits::check(&system, (n * m * k) as u64);
            })*
        }
    };
    (@periodic periodic) => { true };
    (@periodic open) => { false };
    (@new 1 $name:ident $n:ident $m:ident $k:ident $w:ident) => { $name::new($k, [$w[0].clone(), $w[1].clone()]).unwrap() };
    (@new 2 $name:ident $n:ident $m:ident $k:ident $w:ident) => { $name::new($m, $k, [$w[0].clone(), $w[1].clone()]).unwrap() };
    (@new 3 $name:ident $n:ident $m:ident $k:ident $w:ident) => { $name::new($n, $m, $k, [$w[0].clone(), $w[1].clone()]).unwrap() };
    (@define 1 $name:ident $s:tt periodic $kind:ident) => { shapes!(@one $name $kind [0..k] [(a + $s) % k]); };
    (@define 1 $name:ident $s:tt open $kind:ident) => { shapes!(@one $name $kind [0..k - $s] [a + $s]); };
    (@define 2 $name:ident $s:tt periodic $kind:ident) => {
        shapes!(@two $name $kind [0..m] [0..k] [(b + $s) % m] [(a + $s) % k]);
    };
    (@define 2 $name:ident $s:tt open $kind:ident) => {
        shapes!(@two $name $kind [0..m - $s] [0..k - $s] [b + $s] [a + $s]);
    };
    (@define 3 $name:ident $s:tt periodic $kind:ident) => {
        shapes!(@three $name $kind [0..n] [0..m] [0..k] [(c + $s) % n] [(b + $s) % m] [(a + $s) % k]);
    };
    (@define 3 $name:ident $s:tt open $kind:ident) => {
        shapes!(@three $name $kind [0..n - $s] [0..m - $s] [0..k - $s] [c + $s] [b + $s] [a + $s]);
    };
    (@one $name:ident $kind:ident [$($in:tt)*] [$($next:tt)*]) => {
        hamiltonian! {
            #[allow(missing_docs)]
            pub struct $name { k: usize, w: [2][k] }
            let plain(r, w) = r^2/2 + r^4/4;
            let condition(r, w) = if r < 0 { r^4/4 } else { 0 };
            let row(r, w) = w*r^2/2;
            H(q[k]; p[k]) = sum(a in 0..k) { p[a]^2/2 + w[0][a]*q[a]^2/2 }
                + sum(a in $($in)*) { $kind(q[$($next)*] - q[a], w[1][a]) }
        }
    };
    (@two $name:ident $kind:ident [$($rows:tt)*] [$($in:tt)*] [$($below:tt)*] [$($next:tt)*]) => {
        hamiltonian! {
            #[allow(missing_docs)]
            pub struct $name { m: usize, k: usize, w: [2][k] }
            let plain(r, w) = r^2/2 + r^4/4;
            let condition(r, w) = if r < 0 { r^4/4 } else { 0 };
            let row(r, w) = w*r^2/2;
            H(u[m][k]; p[m][k]) = sum(b in 0..m, a in 0..k) { p[b][a]^2/2 + w[0][a]*u[b][a]^2/2 }
                + sum(b in $($rows)*, a in 0..k) { $kind(u[$($below)*][a] - u[b][a], w[1][a]) }
                + sum(b in 0..m, a in $($in)*) { $kind(u[b][$($next)*] - u[b][a], w[1][a]) }
        }
    };
    (@three $name:ident $kind:ident [$($layers:tt)*] [$($rows:tt)*] [$($in:tt)*]
        [$($behind:tt)*] [$($below:tt)*] [$($next:tt)*]) => {
        hamiltonian! {
            #[allow(missing_docs)]
            pub struct $name { n: usize, m: usize, k: usize, w: [2][k] }
            let plain(r, w) = r^2/2 + r^4/4;
            let condition(r, w) = if r < 0 { r^4/4 } else { 0 };
            let row(r, w) = w*r^2/2;
            H(u[n][m][k]; p[n][m][k]) = sum(c in 0..n, b in 0..m, a in 0..k) {
                p[c][b][a]^2/2 + w[0][a]*u[c][b][a]^2/2
            } + sum(c in $($layers)*, b in 0..m, a in 0..k) { $kind(u[$($behind)*][b][a] - u[c][b][a], w[1][a]) }
                + sum(c in 0..n, b in $($rows)*, a in 0..k) { $kind(u[c][$($below)*][a] - u[c][b][a], w[1][a]) }
                + sum(c in 0..n, b in 0..m, a in $($in)*) { $kind(u[c][b][$($next)*] - u[c][b][a], w[1][a]) }
        }
    };
}

// Each bond and each shift with both ends, each shift on each number of axes. The whole product took too long to
// compile.
shapes! {
    1 Ring1 1 periodic plain;
    1 Ring2 2 periodic condition;
    1 Ring5 5 periodic row;
    1 Chain1 1 open condition;
    1 Chain2 2 open row;
    1 Chain5 5 open plain;
    2 Torus1 1 periodic row;
    2 Torus2 2 periodic plain;
    2 Plate5 5 open condition;
    3 Block1 1 open plain;
    3 Solid2 2 periodic condition;
    3 Block5 5 open row;
}
