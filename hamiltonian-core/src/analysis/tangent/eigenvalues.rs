//! Eigenvalues of a real matrix.
//!
//! Input: a square matrix. Output: its eigenvalues, complex ones in pairs. Invariant: only
//! arithmetic and square roots, so that no standard library is needed; NaN for eigenvalues for
//! which the iteration does not converge.
//!
//! The matrix is reduced to Hessenberg form by reflections, then to blocks of one or two rows by
//! steps with two shifts at once (J. G. F. Francis, *Comput. J.* 4, 332, 1962,
//! doi:10.1093/comjnl/4.4.332; G. H. Golub and C. F. Van Loan, *Matrix Computations*, 4th ed.,
//! 2013, §7.4 and §7.5).

use alloc::vec;
use alloc::vec::Vec;
use core::ops::RangeInclusive;

use hamiltonian_lanes::Real;
use nalgebra::{Complex, DMatrix};

/// The largest number of steps for one eigenvalue; two or three are usual. Every tenth has other
/// shifts.
const STEPS: usize = 60;

/// The eigenvalues of a square matrix.
#[inline]
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let n = matrix.nrows();
    let mut h = matrix.clone();
    reduce_to_hessenberg(&mut h);
    let mut found = vec![Complex::new(f64::NAN, f64::NAN); n];
    // Rows from `end` on are done.
    let (mut end, mut steps) = (n, 0);
    while end > 0 && steps < STEPS {
        let high = end - 1;
        let low = block(&mut h, high);
        match high - low {
            0 => found[high] = Complex::new(h[(high, high)], 0.0),
            1 => (found[low], found[high]) = pair(&h, low),
            _ => {
                steps += 1;
                let (sum, product) = shifts(&h, high, steps % 10 == 0);
                step(&mut h, low, high, sum, product);
                continue;
            }
        }
        (end, steps) = (low, 0);
    }
    found
}

/// Makes every entry below the first subdiagonal 0 by similarities.
#[inline]
fn reduce_to_hessenberg(h: &mut DMatrix<f64>) {
    let n = h.nrows();
    for k in 0..n.saturating_sub(2) {
        let column: Vec<f64> = (k + 1..n).map(|i| h[(i, k)]).collect();
        if let Some(normal) = normal(&column) {
            reflect_rows(h, k + 1, &normal, k..=n - 1);
            reflect_columns(h, k + 1, &normal, 0..=n - 1);
        }
        for i in k + 2..n {
            h[(i, k)] = 0.0;
        }
    }
}

/// The first row of the block that ends in row `high`: above it the subdiagonal is 0, or set to 0
/// if it is a rounding error relative to the diagonal.
#[inline]
fn block(h: &mut DMatrix<f64>, high: usize) -> usize {
    let size = h.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let mut low = high;
    while low > 0 {
        let beside = h[(low, low)].abs() + h[(low - 1, low - 1)].abs();
        let beside = if beside == 0.0 { size } else { beside };
        if h[(low, low - 1)].abs() <= f64::EPSILON * beside {
            h[(low, low - 1)] = 0.0;
            break;
        }
        low -= 1;
    }
    low
}

/// The eigenvalues of rows and columns `k` and `k + 1`.
#[inline]
fn pair(h: &DMatrix<f64>, k: usize) -> (Complex<f64>, Complex<f64>) {
    let (a, d) = (h[(k, k)], h[(k + 1, k + 1)]);
    let product = h[(k, k + 1)] * h[(k + 1, k)];
    let half = 0.5 * (a - d);
    let square = half * half + product;
    let root = Real::sqrt(square.abs());
    if square < 0.0 {
        let middle = d + half;
        return (Complex::new(middle, root), Complex::new(middle, -root));
    }
    // The eigenvalue farther from `d` does not cancel, and determines the other.
    let far = half + if half < 0.0 { -root } else { root };
    let near = if far == 0.0 { 0.0 } else { product / far };
    (Complex::new(d + far, 0.0), Complex::new(d - near, 0.0))
}

/// Sum and product of the eigenvalues of the last two rows, towards which a step converges; numbers
/// off them where an iteration goes round in a circle.
#[inline]
fn shifts(h: &DMatrix<f64>, high: usize, is_other: bool) -> (f64, f64) {
    let (a, d) = (h[(high - 1, high - 1)], h[(high, high)]);
    if is_other {
        let off = h[(high, high - 1)].abs() + h[(high - 1, high - 2)].abs();
        let middle = d + 0.75 * off;
        return (2.0 * middle, middle * middle + 0.4375 * off * off);
    }
    (a + d, a * d - h[(high - 1, high)] * h[(high, high - 1)])
}

/// One step on rows and columns `low` to `high`, three of them or more.
#[inline]
fn step(h: &mut DMatrix<f64>, low: usize, high: usize, sum: f64, product: f64) {
    let (a, b, c) = (h[(low, low)], h[(low, low + 1)], h[(low + 1, low)]);
    let d = h[(low + 1, low + 1)];
    // The first column of h² − sum·h + product.
    let mut column = [
        a * (a - sum) + product + b * c,
        c * (a + d - sum),
        c * h[(low + 2, low + 1)],
    ];
    for k in low..high {
        let width = (high - k + 1).min(3);
        let left = if k > low { k - 1 } else { low };
        if let Some(normal) = normal(&column[..width]) {
            reflect_rows(h, k, &normal, left..=high);
            reflect_columns(h, k, &normal, low..=(k + 3).min(high));
        }
        for i in k + 1..k + width {
            if k > low {
                h[(i, k - 1)] = 0.0;
            }
        }
        for (i, entry) in column.iter_mut().enumerate() {
            *entry = if k + 1 + i <= high {
                h[(k + 1 + i, k)]
            } else {
                0.0
            };
        }
    }
}

/// The vector `v`, scaled so that `1 − v·vᵀ` takes `column` to a multiple of the first axis; `None`
/// if the column is 0.
#[inline]
fn normal(column: &[f64]) -> Option<Vec<f64>> {
    let size = column.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    if size == 0.0 {
        return None;
    }
    let mut v: Vec<f64> = column.iter().map(|x| x / size).collect();
    let length = Real::sqrt(v.iter().map(|x| x * x).sum::<f64>());
    let length = if v[0] < 0.0 { -length } else { length };
    // |v + length·e|²/2, with the root of which the vector is scaled.
    let scale = Real::sqrt(length * (length + v[0]));
    v[0] += length;
    v.iter_mut().for_each(|x| *x /= scale);
    Some(v)
}

/// Multiplies rows from `first` on by `1 − v·vᵀ`, in these columns.
#[inline]
fn reflect_rows(h: &mut DMatrix<f64>, first: usize, v: &[f64], columns: RangeInclusive<usize>) {
    for j in columns {
        let along: f64 = (first..).zip(v).map(|(i, v)| v * h[(i, j)]).sum();
        for (i, v) in (first..).zip(v) {
            h[(i, j)] -= along * v;
        }
    }
}

/// Multiplies columns from `first` on by `1 − v·vᵀ`, in these rows.
#[inline]
fn reflect_columns(h: &mut DMatrix<f64>, first: usize, v: &[f64], rows: RangeInclusive<usize>) {
    for i in rows {
        let along: f64 = (first..).zip(v).map(|(j, v)| v * h[(i, j)]).sum();
        for (j, v) in (first..).zip(v) {
            h[(i, j)] -= along * v;
        }
    }
}
