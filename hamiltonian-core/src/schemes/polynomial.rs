//! The polynomial through the unknowns at the nodes of a Gauss step.
//!
//! Input: the unknowns of a step. Output: a guess for those of another step in or near it. Invariant: a guess changes the
//! number of iterations, and what they converge to by rounding alone.

use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// The most terms of a polynomial in a guess: others would be rounding where they are extrapolated.
pub(super) const TERMS: usize = 8;

/// Replaces the unknowns at the nodes of a step, whose h, cᵢh and bᵢh are given, by the values of their polynomial at
/// `first + cᵢ·ratio` in units of the step: a guess for another step that begins at `first` and is `ratio` times as long.
/// Terms of degree 8 and more are left out.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn interpolate<T: Real, X: Vector<Scalar = T>, const S: usize>(
    (h, times, weights): (T, &[T; S], &[T; S]),
    (first, ratio): (T, T),
    unknowns: &mut [X; S],
) {
    let (one, two) = (T::one(), number::<T>(2));
    let per = h.recip();
    // Values of a polynomial at the nodes and at the new points, and of the one before it.
    let (mut nodes, mut points) = ([T::zero(); S], [T::zero(); S]);
    let mut shares = [T::zero(); S];
    for i in 0..S {
        let node = times[i] * per;
        nodes[i] = two * node - one;
        points[i] = two * (first + node * ratio) - one;
        shares[i] = (weights[i] * per).abs();
    }
    let mut there = [[T::zero(); S]; TERMS];
    let mut here = [[T::zero(); S]; TERMS];
    for i in 0..S {
        let (mut at_node, mut at_point) = ((one, T::zero()), (one, T::zero()));
        for k in 0..TERMS.min(S) {
            there[k][i] = number::<T>(2 * k + 1) * shares[i] * at_node.0;
            here[k][i] = at_point.0;
            at_node = nearly_next(k, nodes[i], at_node);
            at_point = nearly_next(k, points[i], at_point);
        }
    }
    for part in 0..X::PARTS {
        for c in 0..unknowns[0].part(part).len() {
            let mut values = [T::zero(); S];
            for (there, here) in there.iter().zip(&here).take(S) {
                let mut coefficient = T::zero();
                for (of, unknown) in there.iter().zip(&*unknowns) {
                    coefficient = of.fma(unknown.part(part)[c], coefficient);
                }
                for (value, of) in values.iter_mut().zip(here) {
                    *value = of.fma(coefficient, *value);
                }
            }
            for (unknown, value) in unknowns.iter_mut().zip(values) {
                unknown.part_mut(part)[c] = value;
            }
        }
    }
}

/// Legendre's polynomials Pₖ₊₁ and Pₖ at x of [−1, 1], from Pₖ and Pₖ₋₁, without a division: to the rounding of the quotients.
#[cfg_attr(not(unoptimised), inline(always))]
fn nearly_next<T: Real>(k: usize, x: T, (value, before): (T, T)) -> (T, T) {
    let part = |n: usize| T::constant(n as f64 / (k + 1) as f64, 0.0);
    (part(2 * k + 1) * x * value - part(k) * before, value)
}

#[cfg_attr(not(unoptimised), inline(always))]
fn number<T: Real>(x: usize) -> T {
    T::constant(x as f64, 0.0)
}
