//! The exact flow of a quadratic form, as a matrix.
//!
//! Input: the emitted program of c·J∇h of a form h = ½zᵀAz + gᵀz over a whole point. Output:
//! [`Exponential`], z ← e^{cM}z + ∫e^{sM}ds·b with M = JA and b = Jg, prepared once a step size.
//! Invariant: e^{cM} − 1 is kept, so that a short step loses no digits.

use crate::systems::flow::Flow;
use crate::systems::state::Point;
use crate::systems::vector::Vector;
use core::marker::PhantomData;
use hamiltonian_lanes::{Mask, Real};

/// The exact flow of a quadratic form with constant coefficients, N components of coordinates and momenta
/// together.
///
/// ```text
/// F₀ = Σ Xᵏ/k!,  g₀ = Σ Xᵏ⁻¹v/k!  (k ≥ 1),  X = cM/2ˢ,  v = cb/2ˢ,  |X| ≤ ½
/// F ← 2F + F²,   g ← 2g + Fg      s times
/// z ← z + Fz + g
/// ```
///
/// Source: scaling and squaring, C. Moler, C. Van Loan, SIAM Review 45 (2003) 3, method 3,
/// doi:10.1137/S00361445024180; of the exponential minus 1, as in N. J. Higham, Functions of
/// Matrices, 2008, §10.5.
#[derive(Debug, Clone)]
pub struct Exponential<F, T, const N: usize> {
    /// e^{cM} − 1
    less_one: [[T; N]; N],
    /// The image of the origin.
    shift: [T; N],
    of: PhantomData<fn() -> F>,
}

/// The largest number of terms of the series: (½)ᵏ/k! is below ε of a double-double number at k =
/// 23.
const TERMS: u32 = 40;

/// The largest number of squarings: a matrix of more than 2⁶⁰ overflows.
const SQUARINGS: usize = 64;

/// The coefficient of the rates in units of the step's. Beside c·Mz of this size, the z that the rates add
/// takes no digits of the diagonal of M.
const RAISED: f64 = (1u64 << 40) as f64;

type Square<T, const N: usize> = [[T; N]; N];

impl<F, T: Real, const N: usize> Exponential<F, T, N> {
    /// The coefficient of the rates, given that of the step.
    #[must_use]
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn raised(c: T) -> T {
        c * T::constant(RAISED, 0.0)
    }

    /// Makes the flow from the map z ↦ z + C·(Mz + b), with C of [`raised`](Self::raised), and a
    /// zero point.
    #[must_use]
    pub fn new<V: Vector<Scalar = T>>(rates: &F, zero: &Point<V>) -> Self
    where
        F: Flow<Point<V>, Work = ()>,
    {
        let zeros = [T::zero(); N];
        let column = |place: Option<usize>| {
            let mut point = zero.clone();
            if let Some(place) = place {
                *point.component_mut(place) = T::one();
            }
            rates.apply(T::zero(), &mut point, &mut ());
            let mut column = zeros;
            for (i, entry) in column.iter_mut().enumerate() {
                *entry = point.component(i);
            }
            column
        };
        let mut shift = column(None);
        let mut matrix = [zeros; N];
        for j in 0..N {
            let mut moved = column(Some(j));
            moved[j] -= T::one();
            for i in 0..N {
                matrix[i][j] = moved[i] - shift[i];
            }
        }
        let lowered = T::constant(1.0 / RAISED, 0.0);
        scale(&mut matrix, &mut shift, lowered);
        // Each lane is halved, summed and squared as often as it requires, so that its bits do not
        // depend on its neighbours.
        let (one, half) = (T::one(), T::constant(0.5, 0.0));
        let limit = T::Size::constant(0.5, 0.0);
        let mut halved = [T::Mask::splat(false); SQUARINGS];
        for is_large in &mut halved {
            *is_large = !norm(&matrix).le(limit);
            if !is_large.any() {
                break;
            }
            scale(&mut matrix, &mut shift, T::select(*is_large, half, one));
        }
        let (mut power, mut moved) = (matrix, shift);
        let mut less_one = matrix;
        let rounding = T::Size::constant(T::epsilon(), 0.0);
        for k in 2..TERMS {
            power = product(&matrix, &power);
            moved = image(&matrix, &moved);
            let over = one / T::constant(f64::from(k), 0.0);
            scale(&mut power, &mut moved, over);
            for i in 0..N {
                for j in 0..N {
                    less_one[i][j] += power[i][j];
                }
                shift[i] += moved[i];
            }
            let is_last = norm(&power).le(rounding * norm(&less_one));
            if is_last.all() {
                break;
            }
            scale(&mut power, &mut moved, T::select(is_last, T::zero(), one));
        }
        let two = T::constant(2.0, 0.0);
        for is_large in halved {
            if !is_large.any() {
                break;
            }
            let (squared, pushed) = (product(&less_one, &less_one), image(&less_one, &shift));
            let square = |f: T, more: T| T::select(is_large, two.fma(f, more), f);
            for i in 0..N {
                for j in 0..N {
                    less_one[i][j] = square(less_one[i][j], squared[i][j]);
                }
                shift[i] = square(shift[i], pushed[i]);
            }
        }
        Exponential {
            less_one,
            shift,
            of: PhantomData,
        }
    }
}

/// Multiplies a matrix and a vector.
fn scale<T: Real, const N: usize>(matrix: &mut Square<T, N>, vector: &mut [T; N], by: T) {
    for entry in matrix.as_flattened_mut().iter_mut().chain(vector) {
        *entry *= by;
    }
}

/// The largest sum of a row.
fn norm<T: Real, const N: usize>(matrix: &Square<T, N>) -> T::Size {
    let mut largest = T::Size::zero();
    for row in matrix {
        let mut sum = T::Size::zero();
        for entry in row {
            sum += entry.size();
        }
        largest = largest.max(sum);
    }
    largest
}

fn product<T: Real, const N: usize>(a: &Square<T, N>, b: &Square<T, N>) -> Square<T, N> {
    let mut out = [[T::zero(); N]; N];
    for (row, into) in a.iter().zip(&mut out) {
        for (entry, other) in row.iter().zip(b) {
            for (sum, x) in into.iter_mut().zip(other) {
                *sum = entry.fma(*x, *sum);
            }
        }
    }
    out
}

#[cfg_attr(not(unoptimised), inline(always))]
fn image<T: Real, const N: usize>(matrix: &Square<T, N>, z: &[T; N]) -> [T; N] {
    let mut out = [T::zero(); N];
    for (row, sum) in matrix.iter().zip(&mut out) {
        for (entry, x) in row.iter().zip(z) {
            *sum = entry.fma(*x, *sum);
        }
    }
    out
}

impl<V: Vector, F: Flow<Point<V>>, const N: usize> Flow<Point<V>> for Exponential<F, V::Scalar, N> {
    const NAME: &'static str = F::NAME;
    type Work = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, _: V::Scalar, x: &mut Point<V>, (): &mut ()) {
        let mut z = [V::Scalar::zero(); N];
        for (i, into) in z.iter_mut().enumerate() {
            *into = x.component(i);
        }
        let moved = image(&self.less_one, &z);
        for i in 0..N {
            *x.component_mut(i) = z[i] + (moved[i] + self.shift[i]);
        }
    }
}
