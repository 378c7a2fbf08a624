//! Reasons to refuse a run.
//!
//! Input: a step, a start. Output: nothing, or the error. Invariant: a run begins where H and all its
//! first derivatives are finite, and for a time-transformed system on the shell H = 0.

use super::{numbers, parameter_without_value};
use crate::errors::{Error, StartError};
use crate::observers::output::names;
use crate::schemes::scheme::{Entry, Needs, Scheme};
use crate::systems::state::State;
use crate::systems::system::{
    Description, Dynamics, ParameterText, System, VectorOf, check_shape_like, declared_energy,
};
use crate::systems::vector::Vector;
use alloc::format;
use alloc::string::String;
use hamiltonian_lanes::{Mask, Real};

/// Returns an error for a step that is zero, NaN or infinite.
pub(crate) fn check_step<T: Real>(step: T) -> Result<(), StartError> {
    if step.is_finite() && !step.equals(T::zero()).any() {
        return Ok(());
    }
    Err(StartError::Step {
        value: step.to_f64(),
    })
}

/// Returns an error for a state of another shape, or with a NaN or an infinity.
pub(crate) fn check_state<T: Real, S: System>(
    system: &S,
    state: &State<VectorOf<S, T>>,
) -> Result<(), Error> {
    system.check_shape(state)?;
    Ok(check_numbers(system.description(), state)?)
}

/// Returns an error for a state that cannot replace another one of a run: of another time or shape, with a NaN or an
/// infinity, or for which a run cannot begin. The state of a time-transformed system is first moved onto the shell.
pub(crate) fn check_change<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    from: &State<VectorOf<S, T>>,
    to: &mut State<VectorOf<S, T>>,
) -> Result<(), Error> {
    let description = prepared.description();
    if !to.t.equals(from.t).all() {
        return Err(StartError::OtherTime {
            clock: description.clock().into(),
            time: to.t.to_f64(),
            now: from.t.to_f64(),
        }
        .into());
    }
    check_shape_like(description, [&from.q, &from.p], to)?;
    check_numbers(description, to)?;
    onto_shell::<T, S>(prepared, to);
    // The parameters are those of the run, which has begun with them.
    Ok(check_values::<T, S>(prepared, to, String::new)?)
}

/// Sets the momentum of time of a time-transformed system to −h, so that H = g·(h + p_t) = 0.
pub(super) fn onto_shell<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    state: &mut State<VectorOf<S, T>>,
) {
    if prepared.description().fictitious_time.is_none() {
        return;
    }
    let h = declared_energy::<T, S>(prepared, state);
    if let Some(last) = state.p.len().checked_sub(1) {
        *state.p.component_mut(last) = -h;
    }
}

/// Returns an error for a state with a NaN or an infinity.
fn check_numbers<V: Vector>(description: &Description, state: &State<V>) -> Result<(), StartError> {
    if state.t.is_finite() && state.q.is_finite() && state.p.is_finite() {
        return Ok(());
    }
    Err(StartError::NotFinite {
        clock: description.clock().into(),
        time: state.t.to_f64(),
        q: numbers(&state.q).into(),
        p: numbers(&state.p).into(),
    })
}

/// Prepares the system of a run from a start, or returns an error for a start that is refused.
pub(crate) fn check_start<T: Real, S: System>(
    system: &S,
    start: &State<VectorOf<S, T>>,
) -> Result<S::Prepared<T>, Error> {
    check_state(system, start)?;
    let prepared = system.prepare();
    check_values::<T, S>(&prepared, start, || ParameterText::of_now(system))?;
    Ok(prepared)
}

/// Returns an error for a scheme that cannot integrate this system from this state.
pub(crate) fn check_scheme<T: Real, S: System, M: Scheme<S>>(
    scheme: &M,
    prepared: &S::Prepared<T>,
    start: &State<VectorOf<S, T>>,
) -> Result<(), Error> {
    /// Sums of weights are rounded.
    const ROUNDING: f64 = 1e-9;
    let description = prepared.description();
    check_needs(scheme.entry(), description)?;
    if description.is_jumping() {
        let [first, last] = scheme.times_of_jumps(description);
        if !(first > ROUNDING && last < 1.0 - ROUNDING) {
            return Err(StartError::Jumps {
                scheme: scheme.entry().name.into(),
                system: (*description.name).into(),
            }
            .into());
        }
    }
    scheme.check(prepared, start)
}

/// Returns an error for a scheme that requires a property which H is not proven to have.
fn check_needs(scheme: Entry, description: &Description) -> Result<(), StartError> {
    let mut needs = scheme.needs;
    if description.fictitious_time.is_some() {
        // Another time is introduced for such systems alone.
        needs = needs.and(Needs::UNFORCED).and(Needs::AUTONOMOUS);
    }
    let is_needed = |name: &str| {
        let mut all = Needs::ALL.iter();
        all.any(|(need, known)| *known == name && needs.contains(*need))
    };
    let mut missing = description.missing.iter();
    match missing.find(|missing| is_needed(&missing.marker)) {
        None => Ok(()),
        Some(missing) => Err(StartError::Structure {
            scheme: scheme.name.into(),
            marker: (*missing.marker).into(),
            message: (*missing.message).into(),
            label: (*missing.label).into(),
            note: (*missing.note).into(),
        }),
    }
}

/// Returns an error if H or a first derivative is not finite, or if the start of a
/// time-transformed system is off its shell.
pub(super) fn check_values<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    start: &State<VectorOf<S, T>>,
    parameters: impl Fn() -> String,
) -> Result<(), StartError> {
    let description = prepared.description();
    let (mut slopes, mut velocities) = (start.q.clone(), start.p.clone());
    let h = prepared.energy(start.t, &start.q, &start.p);
    prepared.gradient(start.t, &start.q, &start.p, &mut slopes, &mut velocities);
    let bad = |name: &str, value: T| {
        let lane = (!value.finite()).first()?;
        let mut found = value.lane(lane);
        let derivative = found.is_finite();
        if derivative {
            // The first words are the value.
            value.write_words(&mut |word| {
                if found.is_finite() {
                    found = word;
                }
            });
        }
        Some(StartError::Values {
            name: name.into(),
            derivative,
            value: found,
            lane: (T::LANES > 1).then_some(lane),
            parameter: parameter_without_value(&parameters()),
            clock: description.clock().into(),
            time: start.t.to_f64(),
            q: numbers(&start.q).into(),
            p: numbers(&start.p).into(),
        })
    };
    if let Some(error) = bad("H", h) {
        return Err(error);
    }
    if !(slopes.is_finite() && velocities.is_finite()) {
        for name in names(&description.groups, &start.q) {
            let by = [
                (&name.group.coordinate, &slopes),
                (&name.group.momentum, &velocities),
            ];
            for (variable, values) in by {
                let derivative = format!("∂H/∂{}", name.of(variable));
                if let Some(error) = bad(&derivative, values.component(name.index)) {
                    return Err(error);
                }
            }
        }
    }
    if description.fictitious_time.is_none() {
        return Ok(());
    }
    let Some(&value) = numbers(&start.p).last() else {
        return Ok(());
    };
    // H = g·(h + p_t) is compared with Σ p ∂H/∂p, in which g·p_t is one term. The bound is wide
    // enough that a run can continue from the end of another that has errors in its energy.
    let terms = start.p.components().zip(velocities.components());
    let scale: f64 = terms.map(|(p, velocity)| (p * velocity).magnitude()).sum();
    if h.to_f64().abs() <= 1e-3 * scale {
        return Ok(());
    }
    Err(StartError::Shell {
        momentum: (description.groups.last())
            .map_or("", |group| &group.momentum)
            .into(),
        value,
        due: -declared_energy::<T, S>(prepared, start).to_f64(),
    })
}
