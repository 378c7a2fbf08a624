//! Least squares by reflections (A. S. Householder, *J. ACM* 5, 339, 1958, doi:10.1145/320941.320947).

use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;
use nalgebra::DMatrix;

/// The x for which |matrix·x − right| is least; not finite where columns depend on each other. The matrix has no
/// fewer rows than columns.
#[inline]
pub(super) fn solve(matrix: &DMatrix<f64>, right: &[f64]) -> Vec<f64> {
    let (rows, columns) = matrix.shape();
    let (mut a, mut b) = (matrix.clone(), right.to_vec());
    let mut diagonal = vec![0.0; columns];
    for k in 0..columns {
        let square = (k..rows).fold(0.0, |sum, i| sum + a[(i, k)] * a[(i, k)]);
        let length = Real::sqrt(square);
        let turned = if a[(k, k)] > 0.0 { -length } else { length };
        // The reflection takes column k to `turned` times the k-th unit vector; v = a_k − turned·e_k.
        a[(k, k)] -= turned;
        diagonal[k] = turned;
        let half = -turned * a[(k, k)];
        for j in k + 1..columns {
            let along = (k..rows).fold(0.0, |sum, i| sum + a[(i, k)] * a[(i, j)]) / half;
            for i in k..rows {
                let by = along * a[(i, k)];
                a[(i, j)] -= by;
            }
        }
        let along = (k..rows).fold(0.0, |sum, i| sum + a[(i, k)] * b[i]) / half;
        for i in k..rows {
            b[i] -= along * a[(i, k)];
        }
    }
    let mut x = vec![0.0; columns];
    for k in (0..columns).rev() {
        let known = (k + 1..columns).fold(b[k], |rest, j| rest - a[(k, j)] * x[j]);
        x[k] = known / diagonal[k];
    }
    x
}
