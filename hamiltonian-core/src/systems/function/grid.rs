//! Cubic splines of two variables on a regular grid.
//!
//! Input: values at the points of a grid. Output: [`Grid`], a sum of products of B-splines. Invariant: the
//! function passes through each value, and its second derivatives are continuous.

use super::line::{TridiagonalRow, solve, solve_around};
use super::{Function, fingerprint, floor};
use crate::errors::KnotError;
use alloc::sync::Arc;
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// The bicubic spline through the values of a regular grid: value (i, j) is that at
/// (x₀ + i·hₓ, y₀ + j·h_y). First and second derivatives are continuous (C. de Boor, *J. Math. and Phys.* 41,
/// 212, 1962, doi:10.1002/sapm1962411212).
///
/// Outside the grid it is NaN, so that a run that leaves the grid ends with an error; a periodic one is
/// defined everywhere. A clone shares the data. With the feature `serde` it is written as its origin, spacing and values.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// // An egg box of period 2π in both directions, 64 × 64 values.
/// let spacing = std::f64::consts::TAU / 64.0;
/// let at = |i: usize| i as f64 * spacing;
/// let rows: Vec<Vec<f64>> =
///     (0..64).map(|i| (0..64).map(|j| at(i).cos() * at(j).cos()).collect()).collect();
/// let grid = Grid::periodic([0.0; 2], [spacing; 2], &rows)?;
/// let (x, y) = (1.0_f64, -20.0_f64);
/// assert!((grid.value([x, y]) - x.cos() * y.cos()).abs() < 1e-6);
/// // ∂/∂y, by a dual number.
/// let slope = grid.value([Dual::fixed(x), Dual::variable(y)]).eps;
/// assert!((slope + x.cos() * y.sin()).abs() < 1e-5);
/// # Ok::<(), hamiltonian::errors::KnotError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Grid(Arc<Data>);

#[derive(Debug)]
struct Data {
    origin: [f64; 2],
    spacing: [f64; 2],
    /// The number of cells in each direction.
    cells: [usize; 2],
    /// The factors of the products of B-splines, row by row: three more than there are cells.
    factors: Vec<f64>,
    /// The values, row by row, which the factors give up to rounding only.
    #[cfg(feature = "serde")]
    values: Vec<f64>,
    is_periodic: bool,
    fingerprint: u64,
}

impl Grid {
    /// The natural spline: across each edge the second derivative is 0. `rows[i][j]` is the value at
    /// (`origin[0] + i·spacing[0]`, `origin[1] + j·spacing[1]`). It needs two points in each direction.
    ///
    /// # Errors
    /// [`KnotError`] if rows have different lengths, if there are too few points, if a number is not finite, or
    /// if a spacing is not positive.
    pub fn natural<R: AsRef<[f64]>>(
        origin: [f64; 2],
        spacing: [f64; 2],
        rows: &[R],
    ) -> Result<Grid, KnotError> {
        Grid::through(origin, spacing, rows, false)
    }

    /// The periodic spline: the first row follows the last, and likewise the columns, so the
    /// periods are `rows.len()·spacing[0]` and `rows[0].len()·spacing[1]`. It needs three points in
    /// each direction.
    ///
    /// # Errors
    /// Those of [`natural`](Grid::natural).
    pub fn periodic<R: AsRef<[f64]>>(
        origin: [f64; 2],
        spacing: [f64; 2],
        rows: &[R],
    ) -> Result<Grid, KnotError> {
        Grid::through(origin, spacing, rows, true)
    }

    /// The origin, the spacing, the rows of values, and true if the spline is periodic: from which it was made.
    #[cfg(feature = "serde")]
    pub(crate) fn given(
        &self,
    ) -> (
        [f64; 2],
        [f64; 2],
        impl Iterator<Item = &[f64]> + Clone,
        bool,
    ) {
        let data = &*self.0;
        let columns = match data.is_periodic {
            true => data.cells[1],
            false => data.cells[1] + 1,
        };
        let rows = data.values.chunks_exact(columns);
        (data.origin, data.spacing, rows, data.is_periodic)
    }

    fn through<R: AsRef<[f64]>>(
        origin: [f64; 2],
        spacing: [f64; 2],
        rows: &[R],
        is_periodic: bool,
    ) -> Result<Grid, KnotError> {
        let needed = if is_periodic { 3 } else { 2 };
        KnotError::check_count(needed, rows.len())?;
        let columns = rows[0].as_ref().len();
        KnotError::check_count(needed, columns)?;
        KnotError::check_finite("origin", &origin)?;
        KnotError::check_finite("spacing", &spacing)?;
        if let Some(index) = spacing.iter().position(|spacing| *spacing <= 0.0) {
            return Err(KnotError::Spacing {
                index,
                value: spacing[index],
            });
        }
        let mut values = Vec::with_capacity(rows.len() * columns);
        for row in rows {
            let row = row.as_ref();
            if row.len() != columns {
                return Err(KnotError::Lengths {
                    knots: columns,
                    values: row.len(),
                });
            }
            values.extend_from_slice(row);
        }
        KnotError::check_finite("value", &values)?;
        let sizes = [rows.len() as f64, columns as f64];
        let kind = [f64::from(u8::from(is_periodic))];
        let numbers = kind.iter().chain(&sizes).chain(&origin).chain(&spacing);
        let fingerprint = fingerprint(numbers.chain(&values).copied());
        // First along y in each row, then along x.
        let wide = factors(columns, &vec![0.0; columns], is_periodic).len();
        let mut half = Vec::with_capacity(rows.len() * wide);
        for row in values.chunks(columns) {
            half.extend(factors(columns, row, is_periodic));
        }
        let tall = rows.len() + wide - columns;
        let mut all = vec![0.0; tall * wide];
        for j in 0..wide {
            let column: Vec<f64> = (0..rows.len()).map(|i| half[i * wide + j]).collect();
            for (i, factor) in factors(rows.len(), &column, is_periodic)
                .into_iter()
                .enumerate()
            {
                all[i * wide + j] = factor;
            }
        }
        Ok(Grid(Arc::new(Data {
            origin,
            spacing,
            cells: [tall - 3, wide - 3],
            factors: all,
            #[cfg(feature = "serde")]
            values,
            is_periodic,
            fingerprint,
        })))
    }
}

/// The factors of the B-splines that pass through values: (cᵢ₋₁ + 4cᵢ + cᵢ₊₁)/6 = vᵢ. The first belongs to
/// the point before the grid.
#[inline]
fn factors(count: usize, values: &[f64], is_periodic: bool) -> Vec<f64> {
    let inner = |right: f64| TridiagonalRow {
        lower: 1.0,
        middle: 4.0,
        upper: 1.0,
        right: 6.0 * right,
    };
    if is_periodic {
        let rows: Vec<TridiagonalRow> = values.iter().map(|value| inner(*value)).collect();
        let around = solve_around(&rows);
        return (0..count + 3)
            .map(|i| around[(i + count - 1) % count])
            .collect();
    }
    // cᵢ₋₁ − 2cᵢ + cᵢ₊₁ = 0 at the ends, where therefore cᵢ = vᵢ.
    let mut rows: Vec<TridiagonalRow> = values.iter().map(|value| inner(*value)).collect();
    for at in [0, count - 1] {
        rows[at] = TridiagonalRow {
            lower: 0.0,
            middle: 1.0,
            upper: 0.0,
            right: values[at],
        };
    }
    let own = solve(&rows);
    let mut all = Vec::with_capacity(count + 2);
    all.push(2.0 * own[0] - own[1]);
    all.extend_from_slice(&own);
    all.push(2.0 * own[count - 1] - own[count - 2]);
    all
}

impl Data {
    /// The cell of a point and its corner, in the direction `k`.
    #[inline]
    fn cell(&self, k: usize, x: f64) -> Option<(usize, f64)> {
        let place = (x - self.origin[k]) / self.spacing[k];
        let count = self.cells[k];
        let (start, cell) = match self.is_periodic {
            true if place.is_finite() => {
                let cell = floor(place);
                let turns = floor(cell / count as f64);
                (cell, (cell - turns * count as f64) as usize)
            }
            false if 0.0 <= place && place <= count as f64 => {
                let cell = (place as usize).min(count - 1);
                (cell as f64, cell)
            }
            _ => return None,
        };
        Some((
            cell.min(count - 1),
            self.origin[k] + start * self.spacing[k],
        ))
    }

    /// The corner of the cell around a point, and the factors of the 16 products there; NaN outside.
    #[inline]
    fn around(&self, [x, y]: [f64; 2]) -> [f64; 18] {
        let (Some((i, left)), Some((j, low))) = (self.cell(0, x), self.cell(1, y)) else {
            return [f64::NAN; 18];
        };
        let mut found = [0.0; 18];
        (found[0], found[1]) = (left, low);
        let wide = self.cells[1] + 3;
        for (k, four) in found[2..].chunks_mut(4).enumerate() {
            let start = (i + k) * wide + j;
            four.copy_from_slice(&self.factors[start..start + 4]);
        }
        found
    }
}

/// The four B-splines of a cell at u in [0, 1], times 6.
#[cfg_attr(not(unoptimised), inline(always))]
fn weights<T: Real>(u: T) -> [T; 4] {
    let [one, three, four, six] = [1.0, 3.0, 4.0, 6.0].map(|number| T::constant(number, 0.0));
    let rest = one - u;
    [
        rest * rest * rest,
        (three * u - six) * u * u + four,
        ((one - u) * u + one) * u * three + one,
        u * u * u,
    ]
}

impl Function<2> for Grid {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn value<T: Real>(&self, [x, y]: [T; 2]) -> T {
        let found = T::look_up([x, y], |at| self.0.around(at));
        let [wide, high] = self.0.spacing;
        let u = weights((x - found[0]) * T::constant(1.0 / wide, 0.0));
        let v = weights((y - found[1]) * T::constant(1.0 / high, 0.0));
        let mut sum = T::zero();
        let mut k = 0;
        while k < 4 {
            let at = 2 + 4 * k;
            let row = found[at].fma(v[0], found[at + 1] * v[1]);
            let row = found[at + 2].fma(v[2], row);
            let row = found[at + 3].fma(v[3], row);
            sum = row.fma(u[k], sum);
            k += 1;
        }
        sum * T::constant(1.0 / 36.0, 0.0)
    }
    #[inline]
    fn fingerprint(&self) -> u64 {
        self.0.fingerprint
    }
}
