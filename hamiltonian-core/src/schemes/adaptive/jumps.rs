//! Jumps of H and of its gradient, which the estimate of an error from stages may miss.
//!
//! Input: the points before and after a step. Output: the lanes in which H is not the same, but for tolerated errors.
//! Invariant: a smooth H takes no time.

use super::{Estimates, Following, WorkOf};
use crate::systems::flow::VectorField;
use crate::systems::state::{Carried, Point};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// The largest change of H, in units of the one by which the tolerated errors of a step change it.
const LARGEST: f64 = 16.0;
/// The part of H, and of Σ |xᵢ·∂H/∂xᵢ|, that is taken for rounding: 2⁻³⁶.
const ROUNDING: f64 = 1.0 / (1_u64 << 36) as f64;

/// The system, if H is to be compared at the ends of each step.
pub(super) fn watched<T: Real, S: System>(prepared: &S::Prepared<T>) -> Option<S::Prepared<T>> {
    let of = prepared.description();
    let keeps_energy = !of.is_forced && of.jumps == [false; 2];
    (keeps_energy && of.is_piecewise()).then(|| prepared.clone())
}

/// The lanes in which H jumps in the step of size h from t that led here.
#[inline(never)]
pub(super) fn in_step<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    system: &S::Prepared<T>,
    (h, t): (T, T),
    after: &Point<VectorOf<S, T>>,
    work: &mut WorkOf<T, S, M>,
) -> T::Mask {
    T::out_of_line(
        #[cfg_attr(not(unoptimised), inline(always))]
        || {
            let before = work.before.point();
            let slope = work.derivatives.scratch();
            let mut energies = [T::zero(); 2];
            let mut tolerated = T::zero();
            for (k, (t, x)) in [(t, before), (t + h, after)].into_iter().enumerate() {
                energies[k] = system.energy(t, &x.q, &x.p);
                slope.set_zero();
                map.field.add(t, &x.q, &x.p, &mut slope.q, &mut slope.p);
                let [change, size] = map.estimate.change_of_energy(before, after, slope);
                tolerated += T::constant(LARGEST, 0.0) * change;
                tolerated += T::constant(ROUNDING, 0.0) * (size + energies[k].abs());
                tolerated += (h * system.time_derivative(t, &x.q, &x.p)).abs();
            }
            // False for NaN, of a step that was not solved.
            let jumps = tolerated.lt((energies[1] - energies[0]).abs());
            for (to, energy) in work.jump.iter_mut().zip(energies) {
                *to = T::select(jumps, energy, *to);
            }
            jumps
        },
    )
}
