//! The guess from which the stages of a step are iterated: the slopes of the step before, extrapolated.
//!
//! Input: nodes and weights, this step and the one before. Output: matrices for the slopes of the step before.
//! Invariant: a guess changes the number of iterations, and what they converge to by rounding alone.

use crate::flows::map::Step;
use crate::schemes::bundles::of_the_guess;
use crate::schemes::collocation::{Collocation, constant};
use crate::schemes::polynomial::TERMS;
use hamiltonian_lanes::{DoubleDouble, Real};

/// The matrix that takes the slopes at the stages of the step before to guesses for this one's: the
/// slopes' polynomial, without its terms of degree 8 and more, whose extrapolation would be rounding;
/// their mean where the steps are too different.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::schemes) fn extrapolation<T: Real, const S: usize>(
    method: &Collocation<S>,
    step: Step<T>,
) -> [[T; S]; S] {
    const FAR: f64 = 1.5;
    let ratio = step.h / step.before;
    let terms = if ratio.magnitude() <= FAR {
        TERMS.min(S)
    } else {
        1
    };
    // Double-double arithmetic is a call, and the loops below contain none.
    let norms: [DoubleDouble; S] = core::array::from_fn(|k| method.norm(k));
    let two = number::<T>(2);
    // Legendre's polynomials at the nodes of the step before, and where the nodes of this one lie, in its units.
    let mut there = [[T::zero(); S]; TERMS];
    let mut here = [[T::zero(); S]; TERMS];
    for i in 0..S {
        let node = constant::<T>(method.nodes[i]);
        let (mut at_node, mut at_point) = ((T::one(), T::zero()), (T::one(), T::zero()));
        for k in 0..terms {
            (there[k][i], here[k][i]) = (at_node.0, at_point.0);
            at_node = next(k, two * node - T::one(), at_node);
            at_point = next(k, T::one() + two * node * ratio, at_point);
        }
    }
    let mut matrix = [[T::zero(); S]; S];
    for (i, row) in matrix.iter_mut().enumerate() {
        for (j, to) in row.iter_mut().enumerate() {
            let mut sum = T::zero();
            for (k, norm) in norms.iter().enumerate().take(terms) {
                sum += constant::<T>(*norm) * there[k][j] * here[k][i];
            }
            *to = constant::<T>(method.weights[j]) * sum;
        }
    }
    matrix
}

/// Legendre's polynomials Pₖ₊₁ and Pₖ at x of [−1, 1], from Pₖ and Pₖ₋₁.
#[cfg_attr(not(unoptimised), inline(always))]
fn next<T: Real>(k: usize, x: T, (value, before): (T, T)) -> (T, T) {
    let next = (number::<T>(2 * k + 1) * x * value - number::<T>(k) * before) / number(k + 1);
    (next, value)
}

#[cfg_attr(not(unoptimised), inline(always))]
fn number<T: Real>(x: usize) -> T {
    T::constant(x as f64, 0.0)
}

/// α and β of the guess that [`extrapolation`] makes, for the slopes of the step before in place of this one's;
/// and α and β themselves.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::schemes) fn of_fixed_point<T: Real, const S: usize>(
    method: &Collocation<S>,
    step: Step<T>,
    weights: &[T; S],
    matrices: [[[T; S]; S]; 2],
) -> [[[[T; S]; S]; 2]; 2] {
    let guess = extrapolation(method, step);
    let [alpha, beta] = &matrices;
    let guess = [
        of_the_guess(alpha, weights, &guess),
        of_the_guess(beta, weights, &guess),
    ];
    [guess, matrices]
}
