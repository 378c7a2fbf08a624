//! The domain of H: states at which H is finite.
//!
//! Input: a prepared system and a state of finite numbers. Output: H, if it is NaN or infinite there. Invariant: H is
//! not evaluated where [`Description::growth`](super::system::Description::growth) and the sizes of the numbers show that it is finite.

use crate::systems::state::State;
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// Numbers below 2^(this / growth) lead to values below 2^this, times parameters and numbers of terms.
const EXPONENT: u64 = 600;

/// Returns true if H is finite at a state of finite numbers.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn is_inside<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    state: &State<VectorOf<S, T>>,
) -> bool {
    is_moderate(prepared.description(), state) || undefined::<T, S>(prepared, state).is_none()
}

/// H is finite at states all of whose numbers are smaller; 0 if there is no such bound.
#[cfg_attr(not(unoptimised), inline(always))]
fn bound_of_moderate<T: Real>(system: &Description) -> f64 {
    match system.growth {
        // Scalars of less than double precision have smaller exponents.
        Some(growth) if T::epsilon() <= f64::EPSILON => {
            f64::from_bits((1023 + EXPONENT / u64::from(growth.max(1))) << 52)
        }
        _ => 0.0,
    }
}

/// Returns true if the numbers of a state are so small that H is finite there.
#[cfg_attr(not(unoptimised), inline(always))]
fn is_moderate<V: Vector>(system: &Description, state: &State<V>) -> bool {
    let bound = bound_of_moderate::<V::Scalar>(system);
    let mut is_moderate = state.t.magnitude() < bound;
    for vector in [&state.q, &state.p] {
        for k in 0..V::PARTS {
            for number in vector.part(k) {
                is_moderate &= number.magnitude() < bound;
            }
        }
    }
    is_moderate
}

/// Returns the first lane in which H is not finite, with its value there. It is compiled once for each system, since
/// the code of H may be long.
#[inline(never)]
pub(crate) fn undefined<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    state: &State<VectorOf<S, T>>,
) -> Option<(u32, f64)> {
    let h = prepared.energy(state.t, &state.q, &state.p);
    for lane in 0..T::LANES {
        let value = h.lane(lane);
        if !value.is_finite() {
            return Some((lane, value));
        }
    }
    None
}

/// Writes numbers, those of the coordinates, of the momenta and the time, into a state.
pub(crate) fn write_state<V: Vector>(
    state: &mut State<V>,
    mut numbers: impl Iterator<Item = V::Scalar>,
) {
    let State { t, q, p } = state;
    for vector in [q, p] {
        for k in 0..V::PARTS {
            for (component, number) in vector.part_mut(k).iter_mut().zip(&mut numbers) {
                *component = number;
            }
        }
    }
    if let Some(number) = numbers.next() {
        *t = number;
    }
}

/// Returns true for each lane whose member is inside the domain of H at the state of these rows, or which has none. A
/// member is a prepared system and a state of its shape.
#[inline(never)]
pub(crate) fn inside<'a, T: Real, S: System + 'a>(
    members: impl Iterator<Item = Option<(&'a S::Prepared<T>, &'a State<VectorOf<S, T>>)>> + Clone,
    rows: &[T],
    lanes: usize,
) -> Vec<bool> {
    let mut inside = vec![true; lanes];
    // Most often the numbers of all are moderate.
    let mut bound = f64::INFINITY;
    for (prepared, _) in members.clone().flatten() {
        bound = bound.min(bound_of_moderate::<T>(prepared.description()));
    }
    let mut are_moderate = true;
    for number in rows {
        are_moderate &= number.magnitude() < bound;
    }
    if are_moderate {
        return inside;
    }
    let mut of_shape: Option<State<VectorOf<S, T>>> = None;
    for (lane, member) in members.enumerate() {
        let Some((prepared, shape)) = member else {
            continue;
        };
        let state = of_shape.get_or_insert_with(|| shape.clone());
        write_state(state, rows.chunks_exact(lanes).map(|row| row[lane]));
        inside[lane] = is_inside::<T, S>(prepared, state);
    }
    inside
}
