//! The guess from which the stages of a step are iterated: the slopes of the step before, extrapolated.
//!
//! Input: nodes and weights, this step and the one before. Output: matrices for the slopes of the step before.
//! Invariant: a guess changes the number of iterations, and what they converge to by rounding alone.

use crate::map::Step;
use crate::schemes::collocation::{Collocation, constant};
use crate::schemes::rows::of_the_guess;
use hamiltonian_lanes::Real;

/// The matrix that takes the slopes at the stages of the step before to guesses for this one's: the
/// slopes' polynomial, without its terms of degree 8 and more, whose extrapolation would be rounding;
/// their mean where the steps are too different.
pub(in crate::schemes) fn extrapolation<T: Real, const S: usize>(
    method: &Collocation<S>,
    step: Step<T>,
) -> [[T; S]; S] {
    const TERMS: usize = 8;
    const FAR: f64 = 1.5;
    let number = |x: usize| T::constant(x as f64, 0.0);
    let ratio = step.h / step.before;
    let terms = if ratio.magnitude() <= FAR {
        TERMS.min(S)
    } else {
        1
    };
    // Legendre's polynomials of x on [−1, 1]: Pₖ and Pₖ₋₁.
    let next = |k: usize, x: T, (value, before): (T, T)| {
        let next = (number(2 * k + 1) * x * value - number(k) * before) / number(k + 1);
        (next, value)
    };
    let two = number(2);
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let there = two * constant(method.nodes[j]) - T::one();
            // One step on, in units of the step before.
            let here = T::one() + two * constant(method.nodes[i]) * ratio;
            let (mut at_j, mut at_i) = ((T::one(), T::zero()), (T::one(), T::zero()));
            let mut sum = T::zero();
            for k in 0..terms {
                sum += constant::<T>(method.norm(k)) * at_j.0 * at_i.0;
                at_j = next(k, there, at_j);
                at_i = next(k, here, at_i);
            }
            constant::<T>(method.weights[j]) * sum
        })
    })
}

/// α and β of the guess that [`extrapolation`] makes, for the slopes of the step before in place of this one's;
/// and α and β themselves.
pub(in crate::schemes) fn of_fixed_point<T: Real, const S: usize>(
    method: &Collocation<S>,
    step: Step<T>,
    weights: &[T; S],
    matrices: [[[T; S]; S]; 2],
) -> [[[[T; S]; S]; 2]; 2] {
    let guess = extrapolation(method, step);
    let guess = matrices.map(|matrix| of_the_guess(&matrix, weights, &guess));
    [guess, matrices]
}
