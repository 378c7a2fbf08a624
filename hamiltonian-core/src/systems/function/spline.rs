//! Cubic splines of one variable.
//!
//! Input: knots, values at them, and a condition at the ends. Output: [`Spline`]. Invariant: the spline passes
//! through each value, and its second derivative is continuous.

use super::line::{TridiagonalRow, solve, solve_around};
use super::{Function, fingerprint, floor};
use crate::errors::KnotError;
use alloc::sync::Arc;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// The cubic spline through values at knots: on each interval a polynomial of degree 3, with continuous first
/// and second derivatives (C. de Boor, *A Practical Guide to Splines*, 1978, chapter IV).
///
/// Outside the knots it is NaN, so that a run that leaves them ends with an error; a periodic spline is
/// defined everywhere. A clone shares the data. With the feature `serde` it is written as its knots, values and slopes.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// let knots: Vec<f64> = (0..=20).map(|i| f64::from(i) * 0.1).collect();
/// let values: Vec<f64> = knots.iter().map(|x| x.sin()).collect();
/// let spline = Spline::clamped(&knots, &values, [1.0, 2f64.cos()])?;
/// assert!((spline.value([0.73]) - 0.73f64.sin()).abs() < 1e-6);
/// // Its slope, by a dual number.
/// assert!((spline.value([Dual::variable(0.73)]).eps - 0.73f64.cos()).abs() < 1e-5);
/// assert!(spline.value([2.1_f64]).is_nan());
/// # Ok::<(), hamiltonian::errors::KnotError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Spline(Arc<PiecewiseCubic>);

/// A piecewise cubic: the knots, and a polynomial for each interval.
#[derive(Debug)]
struct PiecewiseCubic {
    knots: Vec<f64>,
    /// The coefficients of powers of (x − left knot), the constant first.
    polynomials: Vec<[f64; 4]>,
    /// The value at the last knot.
    #[cfg(feature = "serde")]
    last: f64,
    #[cfg(feature = "serde")]
    ends: EndCondition,
    period: Option<f64>,
    fingerprint: u64,
}

/// The condition at the ends of a spline.
#[derive(Debug, Clone, Copy)]
pub(crate) enum EndCondition {
    /// The second derivative is 0.
    Natural,
    /// The slopes are given.
    Clamped([f64; 2]),
    /// The derivatives at both ends agree.
    Periodic,
}

impl Spline {
    /// The natural spline, whose second derivative is 0 at both ends. It needs two knots.
    ///
    /// # Errors
    /// [`KnotError`] if the numbers of knots and values differ, if there are too few, if a number is not
    /// finite, or if the knots do not increase.
    #[inline]
    pub fn natural(knots: &[f64], values: &[f64]) -> Result<Spline, KnotError> {
        Spline::through(knots, values, EndCondition::Natural)
    }

    /// The spline with given slopes at the first and the last knot. It needs two knots.
    ///
    /// # Errors
    /// Those of [`natural`](Spline::natural).
    #[inline]
    pub fn clamped(knots: &[f64], values: &[f64], slopes: [f64; 2]) -> Result<Spline, KnotError> {
        KnotError::check_finite("slope", &slopes)?;
        Spline::through(knots, values, EndCondition::Clamped(slopes))
    }

    /// The periodic spline: its period is the distance of the last knot from the first, and the last value is
    /// the first again. It needs four knots.
    ///
    /// ```
    /// use hamiltonian::errors::KnotError;
    /// use hamiltonian::prelude::*;
    ///
    /// let spline = Spline::periodic(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, -1.0, 0.0])?;
    /// assert_eq!(spline.value([1.0]), 1.0);
    /// assert_eq!(spline.value([-2.0]), 1.0);
    ///
    /// let error = Spline::periodic(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, -1.0, 0.5]).unwrap_err();
    /// assert!(matches!(error, KnotError::NotPeriodic { first: 0.0, last: 0.5, .. }));
    /// # Ok::<(), KnotError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`natural`](Spline::natural), and [`KnotError::NotPeriodic`] if the first and the last value
    /// differ.
    #[inline]
    pub fn periodic(knots: &[f64], values: &[f64]) -> Result<Spline, KnotError> {
        Spline::through(knots, values, EndCondition::Periodic)
    }

    /// The knots, the values at them, and the condition at the ends, from which the spline was made.
    #[cfg(feature = "serde")]
    pub(crate) fn given(&self) -> (&[f64], Vec<f64>, EndCondition) {
        let PiecewiseCubic {
            knots,
            polynomials,
            last,
            ends,
            ..
        } = &*self.0;
        // At its left knot a polynomial is the value there.
        let values = polynomials.iter().map(|[value, ..]| *value).chain([*last]);
        (knots, values.collect(), *ends)
    }

    #[inline]
    fn through(knots: &[f64], values: &[f64], ends: EndCondition) -> Result<Spline, KnotError> {
        if knots.len() != values.len() {
            return Err(KnotError::Lengths {
                knots: knots.len(),
                values: values.len(),
            });
        }
        let is_periodic = matches!(ends, EndCondition::Periodic);
        KnotError::check_count(if is_periodic { 4 } else { 2 }, knots.len())?;
        KnotError::check_finite("knot", knots)?;
        KnotError::check_finite("value", values)?;
        if let Some(at) = knots.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(KnotError::NotIncreasing {
                index: at + 1,
                before: knots[at],
                value: knots[at + 1],
            });
        }
        let last = knots.len() - 1;
        if is_periodic && values[0] != values[last] {
            return Err(KnotError::NotPeriodic {
                first: values[0],
                last: values[last],
            });
        }
        let curvatures = curvatures(knots, values, ends);
        let polynomials = (0..last)
            .map(|i| {
                let width = knots[i + 1] - knots[i];
                let (left, right) = (curvatures[i], curvatures[i + 1]);
                let slope =
                    (values[i + 1] - values[i]) / width - width * (2.0 * left + right) / 6.0;
                [values[i], slope, 0.5 * left, (right - left) / (6.0 * width)]
            })
            .collect();
        let kind = match ends {
            EndCondition::Natural => [0.0, 0.0, 0.0],
            EndCondition::Clamped([left, right]) => [1.0, left, right],
            EndCondition::Periodic => [2.0, 0.0, 0.0],
        };
        let numbers = kind.iter().chain(knots).chain(values);
        Ok(Spline(Arc::new(PiecewiseCubic {
            fingerprint: fingerprint(numbers.copied()),
            knots: knots.to_vec(),
            polynomials,
            #[cfg(feature = "serde")]
            last: values[last],
            #[cfg(feature = "serde")]
            ends,
            period: is_periodic.then(|| knots[last] - knots[0]),
        })))
    }
}

/// The second derivatives at the knots.
#[inline]
fn curvatures(knots: &[f64], values: &[f64], ends: EndCondition) -> Vec<f64> {
    let last = knots.len() - 1;
    let width = |i: usize| knots[i + 1] - knots[i];
    let slope = |i: usize| (values[i + 1] - values[i]) / width(i);
    // The slopes of two neighbouring polynomials agree at their knot.
    let joint = |before: usize, after: usize| TridiagonalRow {
        lower: width(before),
        middle: 2.0 * (width(before) + width(after)),
        upper: width(after),
        right: 6.0 * (slope(after) - slope(before)),
    };
    let end = |at: usize, change: f64| TridiagonalRow {
        lower: width(at),
        middle: 2.0 * width(at),
        upper: width(at),
        right: 6.0 * change,
    };
    let straight = TridiagonalRow {
        lower: 0.0,
        middle: 1.0,
        upper: 0.0,
        right: 0.0,
    };
    let (first_row, last_row) = match ends {
        EndCondition::Natural => (straight, straight),
        EndCondition::Clamped([left, right]) => (
            end(0, slope(0) - left),
            end(last - 1, right - slope(last - 1)),
        ),
        EndCondition::Periodic => {
            let mut rows: Vec<TridiagonalRow> = (1..last).map(|i| joint(i - 1, i)).collect();
            rows.insert(0, joint(last - 1, 0));
            let mut around = solve_around(&rows);
            around.push(around[0]);
            return around;
        }
    };
    let mut rows = Vec::with_capacity(last + 1);
    rows.push(first_row);
    rows.extend((1..last).map(|i| joint(i - 1, i)));
    rows.push(last_row);
    solve(&rows)
}

impl PiecewiseCubic {
    /// The left knot of the interval around x and the polynomial there; NaN outside the knots.
    #[inline]
    fn around(&self, x: f64) -> [f64; 5] {
        let (first, last) = (self.knots[0], self.knots[self.knots.len() - 1]);
        let shift = match self.period {
            Some(period) => floor((x - first) / period) * period,
            None => 0.0,
        };
        // Rounding may put the point of a periodic spline past an end by a little.
        let inside = match self.period {
            Some(_) => (x - shift).clamp(first, last),
            None => x,
        };
        if !(first <= inside && inside <= last) {
            return [f64::NAN; 5];
        }
        let after = self.knots.partition_point(|knot| *knot <= inside);
        let at = after.clamp(1, self.polynomials.len()) - 1;
        let [a, b, c, d] = self.polynomials[at];
        [self.knots[at] + shift, a, b, c, d]
    }
}

impl Function<1> for Spline {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn value<T: Real>(&self, [x]: [T; 1]) -> T {
        let [left, a, b, c, d] = T::look_up([x], |[x]| self.0.around(x));
        let x = x - left;
        d.fma(x, c).fma(x, b).fma(x, a)
    }
    #[inline]
    fn fingerprint(&self) -> u64 {
        self.0.fingerprint
    }
}
