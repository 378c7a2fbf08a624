//! Tridiagonal systems of equations, for splines.
//!
//! Input: rows `lower·x[i−1] + middle·x[i] + upper·x[i+1] = right`. Output: x. Invariant: the
//! matrix is diagonally dominant, so elimination needs no exchange of rows.

use alloc::vec;
use alloc::vec::Vec;

/// A row of a tridiagonal system: the factors of the unknown before it, its own and the one after it, and the right side.
/// The factor of an unknown that does not exist is not read.
#[derive(Debug, Clone, Copy)]
pub(super) struct TridiagonalRow {
    pub lower: f64,
    pub middle: f64,
    pub upper: f64,
    pub right: f64,
}

/// The solution (L. H. Thomas's elimination).
#[inline]
pub(super) fn solve(rows: &[TridiagonalRow]) -> Vec<f64> {
    let mut x = vec![0.0; rows.len()];
    let mut above = vec![0.0; rows.len()];
    let (mut factor, mut right) = (0.0, 0.0);
    for (at, row) in rows.iter().enumerate() {
        let lower = if at == 0 { 0.0 } else { row.lower };
        let pivot = row.middle - lower * factor;
        factor = row.upper / pivot;
        right = (row.right - lower * right) / pivot;
        (above[at], x[at]) = (factor, right);
    }
    for at in (0..rows.len().saturating_sub(1)).rev() {
        x[at] -= above[at] * x[at + 1];
    }
    x
}

/// The solution of at least three rows if the first and the last unknown are neighbours (J. Sherman
/// and W. J. Morrison, *Ann. Math. Stat.* 21, 124, 1950, doi:10.1214/aoms/1177729893).
#[inline]
pub(super) fn solve_around(rows: &[TridiagonalRow]) -> Vec<f64> {
    let last = rows.len() - 1;
    let (corner, other) = (rows[0].lower, rows[last].upper);
    let gamma = -rows[0].middle;
    let mut bent = rows.to_vec();
    bent[0].middle -= gamma;
    bent[last].middle -= corner * other / gamma;
    let x = solve(&bent);
    for (at, row) in bent.iter_mut().enumerate() {
        row.right = match at {
            0 => gamma,
            at if at == last => other,
            _ => 0.0,
        };
    }
    let z = solve(&bent);
    let along = corner / gamma;
    let scale = (x[0] + along * x[last]) / (1.0 + z[0] + along * z[last]);
    x.iter().zip(&z).map(|(x, z)| x - scale * z).collect()
}
