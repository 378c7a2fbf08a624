//! Newton's method for implicit stages, for steps at which the fixed-point iteration fails.
//!
//! Input: a prepared system, the stages' points, their equations. Output: the slopes one Newton step
//! further. Invariant: lanes do not mix; rows are exchanged lane by lane.

use super::Stages;
use crate::systems::state::Point;
use crate::systems::system::Dynamics;
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// More unknowns than these, the components of all stages together, are not solved for: the matrix
/// has their square.
const LARGEST: usize = 256;

/// The dependence of a stage's point on the unknowns (x, y) of another, or on its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entries<T> {
    /// ∂Q/∂x.
    pub(super) coordinate: T,
    /// ∂P/∂y.
    pub(super) momentum: T,
    /// ∂P/∂x.
    pub(super) across: T,
    /// ∂(dq/dt)/∂x.
    pub(super) velocity: T,
}

/// The matrix of the linear equations, its right-hand side, and vectors of the system's shape.
#[derive(Debug, Clone)]
pub(super) struct LinearSystem<V: Vector> {
    /// None where there are too many unknowns.
    matrix: Option<Vec<V::Scalar>>,
    right: Vec<V::Scalar>,
    unit: Point<V>,
    column: Point<V>,
}

impl<V: Vector> LinearSystem<V> {
    /// For `stages` points like this one.
    pub(super) fn new(like: &Point<V>, stages: usize) -> Self {
        let size = stages * like.len();
        let fits = size <= LARGEST;
        let zero = V::Scalar::zero();
        LinearSystem {
            matrix: fits.then(|| alloc::vec![zero; size * size]),
            right: alloc::vec![zero; if fits { size } else { 0 }],
            unit: like.zeros_like(),
            column: like.zeros_like(),
        }
    }

    /// Returns true if Newton's method can be used.
    pub(super) fn fits(&self) -> bool {
        self.matrix.is_some()
    }

    /// Puts the derivative of `(dq/dt, dp/dt) − J∇H(z)` at stage `i` into its rows, where `entries(j)`
    /// says how both depend on the unknowns of stage j; dp/dt is the unknown y itself.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn linearise<P: Dynamics<V::Scalar, Vector = V>>(
        &mut self,
        dynamics: &P,
        t: V::Scalar,
        z: &Point<V>,
        i: usize,
        stages: usize,
        entries: impl Fn(usize) -> Entries<V::Scalar>,
    ) {
        let Some(matrix) = &mut self.matrix else {
            return;
        };
        let n = z.len();
        let (half, size) = (n / 2, stages * n);
        // Coordinates first: the part of P that depends on x is added to their columns.
        for k in 0..n {
            self.unit.set_zero();
            *self.unit.component_mut(k) = V::Scalar::one();
            let Point { q, p } = &mut self.column;
            dynamics.hessian_vector(t, &z.q, &z.p, &self.unit.q, &self.unit.p, q, p);
            for row in 0..n {
                // J: (∂/∂p, −∂/∂q).
                let entry = if row < half {
                    self.column.component(row + half)
                } else {
                    -self.column.component(row - half)
                };
                for j in 0..stages {
                    let of = entries(j);
                    let at = (i * n + row) * size + j * n + k;
                    if k < half {
                        let own = if row == k {
                            of.velocity
                        } else {
                            V::Scalar::zero()
                        };
                        matrix[at] = own - of.coordinate * entry;
                    } else {
                        let own = f64::from(u8::from(i == j && row == k));
                        matrix[at] = V::Scalar::constant(own, 0.0) - of.momentum * entry;
                        matrix[at - half] -= of.across * entry;
                    }
                }
            }
        }
    }

    /// Solves for the right-hand side `residual` and adds the solution to it in place.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn solve<const S: usize>(&mut self, residual: &mut Stages<Point<V>, S>) {
        let Some(matrix) = &mut self.matrix else {
            return;
        };
        let n = residual.0.first().map_or(0, Vector::len);
        for (i, stage) in residual.0.iter().enumerate() {
            for k in 0..n {
                self.right[i * n + k] = stage.component(k);
            }
        }
        eliminate(matrix, &mut self.right);
        for (i, stage) in residual.0.iter_mut().enumerate() {
            for k in 0..n {
                *stage.component_mut(k) = self.right[i * n + k];
            }
        }
    }
}

/// Gaussian elimination with partial pivoting, lane by lane; `right` becomes the solution.
#[cfg_attr(not(unoptimised), inline(always))]
fn eliminate<T: Real>(matrix: &mut [T], right: &mut [T]) {
    let size = right.len();
    for k in 0..size {
        for i in k + 1..size {
            // The larger of the two moves up, in the lanes where it is the lower one.
            let larger = matrix[k * size + k].abs().lt(matrix[i * size + k].abs());
            for j in k..size {
                let (a, b) = (matrix[k * size + j], matrix[i * size + j]);
                matrix[k * size + j] = T::replaced(larger, b, a);
                matrix[i * size + j] = T::replaced(larger, a, b);
            }
            let (a, b) = (right[k], right[i]);
            right[k] = T::replaced(larger, b, a);
            right[i] = T::replaced(larger, a, b);
        }
        for i in k + 1..size {
            let factor = matrix[i * size + k] / matrix[k * size + k];
            for j in k + 1..size {
                let product = factor * matrix[k * size + j];
                matrix[i * size + j] -= product;
            }
            let product = factor * right[k];
            right[i] -= product;
        }
    }
    for k in (0..size).rev() {
        let mut sum = right[k];
        for j in k + 1..size {
            sum -= matrix[k * size + j] * right[j];
        }
        right[k] = sum / matrix[k * size + k];
    }
}
