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
/// together, by [`exponentiate`].
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

/// The coefficient of the rates, given that of the step.
#[must_use]
#[cfg_attr(not(unoptimised), inline(always))]
pub fn raised<T: Real>(c: T) -> T {
    c * T::constant(RAISED, 0.0)
}

impl<F, T: Real, const N: usize> Exponential<F, T, N> {
    /// Makes the flow from the map z ↦ z + C·(Mz + b), with C of [`raised`], and a zero point.
    #[must_use]
    pub fn new<V: Vector<Scalar = T>>(rates: &F, zero: &Point<V>) -> Self
    where
        F: Flow<Point<V>, Work = ()>,
    {
        let none = [[T::zero(); N]; N];
        let [mut less_one, mut matrix, mut power, mut product] = [none; 4];
        let [mut shift, mut moved, mut next] = [[T::zero(); N]; 3];
        let moves = |place: Option<usize>, column: &mut [T]| {
            let mut point = zero.clone();
            if let Some(place) = place {
                *point.component_mut(place) = T::one();
            }
            rates.apply(T::zero(), &mut point, &mut ());
            for (i, entry) in column.iter_mut().enumerate() {
                *entry = point.component(i);
            }
        };
        exponentiate(
            moves,
            less_one.as_flattened_mut(),
            &mut shift,
            [&mut matrix, &mut power, &mut product].map(|matrix| matrix.as_flattened_mut()),
            [&mut moved, &mut next],
        );
        Exponential {
            less_one,
            shift,
            of: PhantomData,
        }
    }
}

/// Computes F = e^{cM} − 1, row after row, and g = ∫e^{sM}ds·b from the map z ↦ z + C·(Mz + b), with C of [`raised`]. `moves`
/// writes the image of a unit vector, or that of the origin.
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
///
/// The matrices and vectors of scratch have the sizes of F and g.
pub fn exponentiate<T: Real>(
    mut moves: impl FnMut(Option<usize>, &mut [T]),
    less_one: &mut [T],
    shift: &mut [T],
    [matrix, power, squared]: [&mut [T]; 3],
    [moved, next]: [&mut [T]; 2],
) {
    let n = shift.len();
    moves(None, shift);
    for j in 0..n {
        moves(Some(j), moved);
        moved[j] -= T::one();
        for i in 0..n {
            matrix[i * n + j] = moved[i] - shift[i];
        }
    }
    let lowered = T::constant(1.0 / RAISED, 0.0);
    scale(matrix, shift, lowered);
    // Each lane is halved, summed and squared as often as it requires, so that its bits do not
    // depend on its neighbours.
    let (one, half) = (T::one(), T::constant(0.5, 0.0));
    let limit = T::Size::constant(0.5, 0.0);
    let mut halved = [T::Mask::splat(false); SQUARINGS];
    for is_large in &mut halved {
        *is_large = !norm(matrix, n).le(limit);
        if !is_large.any() {
            break;
        }
        scale(matrix, shift, T::select(*is_large, half, one));
    }
    power.copy_from_slice(matrix);
    moved.copy_from_slice(shift);
    less_one.copy_from_slice(matrix);
    let rounding = T::Size::constant(T::epsilon(), 0.0);
    for k in 2..TERMS {
        product(matrix, power, squared, n);
        image(matrix, moved, next);
        power.copy_from_slice(squared);
        moved.copy_from_slice(next);
        let over = one / T::constant(f64::from(k), 0.0);
        scale(power, moved, over);
        add(less_one, power);
        add(shift, moved);
        let is_last = norm(power, n).le(rounding * norm(less_one, n));
        if is_last.all() {
            break;
        }
        scale(power, moved, T::select(is_last, T::zero(), one));
    }
    let two = T::constant(2.0, 0.0);
    for is_large in halved {
        if !is_large.any() {
            break;
        }
        product(less_one, less_one, squared, n);
        image(less_one, shift, next);
        let square = |f: T, more: T| T::select(is_large, two.fma(f, more), f);
        for (f, more) in (less_one.iter_mut().zip(&*squared)).chain(shift.iter_mut().zip(&*next)) {
            *f = square(*f, *more);
        }
    }
}

/// Multiplies a matrix and a vector.
fn scale<T: Real>(matrix: &mut [T], vector: &mut [T], by: T) {
    for entry in matrix.iter_mut().chain(vector) {
        *entry *= by;
    }
}

fn add<T: Real>(sum: &mut [T], terms: &[T]) {
    for (sum, term) in sum.iter_mut().zip(terms) {
        *sum += *term;
    }
}

/// The largest sum of a row.
fn norm<T: Real>(matrix: &[T], n: usize) -> T::Size {
    let mut largest = T::Size::zero();
    for row in matrix.chunks_exact(n) {
        let mut sum = T::Size::zero();
        for entry in row {
            sum += entry.size();
        }
        largest = largest.max(sum);
    }
    largest
}

fn product<T: Real>(a: &[T], b: &[T], out: &mut [T], n: usize) {
    out.fill(T::zero());
    for (row, into) in a.chunks_exact(n).zip(out.chunks_exact_mut(n)) {
        for (entry, other) in row.iter().zip(b.chunks_exact(n)) {
            for (sum, x) in into.iter_mut().zip(other) {
                *sum = entry.fma(*x, *sum);
            }
        }
    }
}

/// The image of a vector.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn image<T: Real>(matrix: &[T], z: &[T], out: &mut [T]) {
    for (row, into) in matrix.chunks_exact(z.len()).zip(out) {
        let mut sum = T::zero();
        for (entry, x) in row.iter().zip(z) {
            sum = entry.fma(*x, sum);
        }
        *into = sum;
    }
}

impl<V: Vector, F: Flow<Point<V>>, const N: usize> Flow<Point<V>> for Exponential<F, V::Scalar, N> {
    const NAME: &'static str = F::NAME;
    type Work = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, _: V::Scalar, x: &mut Point<V>, (): &mut ()) {
        let [mut z, mut moved] = [[V::Scalar::zero(); N]; 2];
        for (i, into) in z.iter_mut().enumerate() {
            *into = x.component(i);
        }
        image(self.less_one.as_flattened(), &z, &mut moved);
        for i in 0..N {
            *x.component_mut(i) = z[i] + (moved[i] + self.shift[i]);
        }
    }
}
