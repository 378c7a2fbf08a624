//! Rare operations on members, over the members' own scalar: compiled once for all packs.
//!
//! Input: numbers of the lanes. Output: states passed to observers, and causes of failures. Invariant: nothing here
//! depends on the level.

use crate::ensembles::host::{Host, MemberRun, RunAtStop};
use crate::ensembles::occupants::Occupants;
use crate::errors::Error;
use crate::flows::map::{Clock, Map, Step};
use crate::observers::observe::View;
use crate::runs::failed::Failed;
use crate::runs::integrator::{LastStep, Part, Recipe};
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::systems::domain::{self, write_state};
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, State};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use core::cell::RefCell;
use hamiltonian_lanes::Real;

/// Passes the states of members at their stops to the host. The rows are those that
/// [`Close`](crate::ensembles::close::Close) writes; `carries_duration` is true if they have the duration of a step.
#[inline(never)]
pub(super) fn pass_to_host<T: Real, S: System, M: Scheme<S>>(
    scheme: &M,
    occupants: &mut Occupants<T, S>,
    host: &mut dyn Host<T, S>,
    (rows, carries_duration): (&[T], bool),
    words: Option<&[T]>,
) {
    let lanes = occupants.lanes();
    let recipe: &dyn Recipe<T, S, M::Map<T>> = scheme;
    let (mut is_any_changed, mut is_any_moved) = (false, false);
    occupants.for_each_due(|lane, run| {
        let mut rows = rows.chunks_exact(lanes);
        let mut next = || rows.next().map_or(T::zero(), |row| row[lane]);
        write_state(&mut run.state, core::iter::from_fn(|| Some(next())));
        let carried = carried_after::<T, S, M>(scheme, run, run.made, lane, words);
        let part = Part {
            prepared: &run.prepared,
            recipe,
            state: &run.state,
            step: run.step,
            clock: run.clock,
            duration: carries_duration.then(next),
            last: last_step(carried.as_ref()),
        };
        let view = View {
            steps: run.made,
            state: &run.state,
            prepared: &run.prepared,
            between: &part,
        };
        let was_followed = !run.followed.is_empty();
        let at_stop = RunAtStop {
            stop: &mut run.stop,
            followed: &mut run.followed,
            words: &mut run.words,
            began: &mut run.began,
        };
        let began = *at_stop.began;
        let stays = host.receive(run.key, at_stop, &view);
        is_any_moved |= run.began != began;
        if !was_followed && !run.followed.is_empty() {
            (run.since, run.received) = (run.made, run.made);
            is_any_changed = true;
        }
        stays
    });
    if is_any_changed {
        occupants.followed_changed();
    }
    if is_any_moved {
        occupants.reload();
    }
}

/// States of lanes, for observers that follow signs.
pub(super) struct PassedStates<'a, T> {
    /// The states, as [`Close`](crate::ensembles::close::Close) writes them.
    pub(super) rows: &'a [T],
    pub(super) carries_duration: bool,
    /// The lanes whose observers receive the states.
    pub(super) which: &'a [bool],
    /// The steps since the beginning of the block.
    pub(super) ahead: u64,
    /// The number of steps from these states to the last of three.
    pub(super) back: u64,
    pub(super) signs_kept: bool,
    /// The carried values after the step, in rows, if the map makes parts of its steps.
    pub(super) words: Option<&'a [T]>,
}

/// The carried value of a member after a step, from rows of all lanes; `None` if there are no rows, or the scheme started
/// there.
fn carried_after<T: Real, S: System, M: Scheme<S>>(
    scheme: &M,
    run: &MemberRun<T, S>,
    step: u64,
    lane: usize,
    words: Option<&[T]>,
) -> Option<CarriedBy<M, S, T>> {
    let words = words.filter(|_| step > run.began)?;
    let lanes = words.len() / run.words.len();
    let mut carried = scheme.start_alone(&run.prepared, &run.state, run.step);
    for (c, row) in words.chunks_exact(lanes).enumerate() {
        *carried.component_mut(c) = row[lane];
    }
    Some(carried)
}

/// The last step of a member whose map makes parts of its steps.
fn last_step<R: Map>(carried: Option<&R::Carried>) -> Option<LastStep<'_, R>> {
    carried.map(|carried| LastStep {
        map: None,
        carried,
        work: RefCell::new(None),
    })
}

impl<T: Real> PassedStates<'_, T> {
    /// Passes the states to the observers that have not received them.
    #[inline(never)]
    pub(super) fn pass<S: System, M: Scheme<S>>(
        &self,
        scheme: &M,
        occupants: &mut Occupants<T, S>,
        host: &mut dyn Host<T, S>,
    ) {
        let recipe: &dyn Recipe<T, S, M::Map<T>> = scheme;
        let which = |lane: usize| self.which[lane];
        occupants.for_each_with_sections(which, |lane, run| {
            let step = (run.made + self.ahead).checked_sub(self.back);
            let Some(step) = step.filter(|step| *step > run.received) else {
                return true;
            };
            let mut rows = self.rows.chunks_exact(self.which.len());
            let mut next = || rows.next().map_or(T::zero(), |row| row[lane]);
            write_state(&mut run.state, core::iter::from_fn(|| Some(next())));
            run.received = step;
            let carried = carried_after::<T, S, M>(scheme, run, step, lane, self.words);
            let part = Part {
                prepared: &run.prepared,
                recipe,
                state: &run.state,
                step: run.step,
                clock: run.clock,
                duration: self.carries_duration.then(next),
                last: last_step(carried.as_ref()),
            };
            let view = View {
                steps: step,
                state: &run.state,
                prepared: &run.prepared,
                between: &part,
            };
            host.pass(run.key, &view, self.signs_kept)
        });
    }
}

/// A member over its own scalar: its system, a state of its shape, its step, its clock.
pub(in crate::ensembles) type ScalarMember<'a, T, S> = (
    &'a <S as System>::Prepared<T>,
    &'a State<VectorOf<S, T>>,
    T,
    Clock<T>,
);

/// Returns the error of a member whose step after `made` others is not finite. `is_first` is true if the scheme started
/// there. The step is replayed over the
/// member's own scalar from the carried value. `point` is the state after it, `reached` its time. If `only_energy` is
/// true, H alone is not finite there.
#[inline(never)]
pub(in crate::ensembles) fn explain<T: Real, S: System, M: Scheme<S>>(
    scheme: &M,
    (prepared, state, step, clock): ScalarMember<'_, T, S>,
    (made, is_first, words): (u64, bool, &[T]),
    (point, reached): (&[f64], f64),
    only_energy: bool,
) -> Error {
    let mut carried = scheme.start(prepared, state, step);
    for (c, word) in words.iter().enumerate() {
        *carried.component_mut(c) = *word;
    }
    let map = scheme.prepare(prepared, Step::of(step));
    let mut work = Scratch::like(&carried);
    let (begin, end) = (clock.at(made), clock.at(made + 1));
    let shown = carried.time(begin);
    let cause = map.explain(begin, end, is_first, &mut carried, &mut work);
    let (q, p) = point.split_at(point.len() / 2);
    let energy = only_energy.then(|| {
        let numbers: Vec<T> = point
            .iter()
            .chain([&reached])
            .map(|x| T::constant(*x, 0.0))
            .collect();
        let mut state = state.clone();
        write_state(&mut state, numbers.into_iter());
        // H that a pack evaluates with fused products may be NaN where this one is not.
        domain::undefined::<T, S>(prepared, &state).map_or(f64::NAN, |(_, energy)| energy)
    });
    let failed = Failed {
        step: made + 1,
        lane: None,
        clock: prepared.description().clock().into(),
        begin: shown.to_f64(),
        end: reached,
        q: q.into(),
        p: p.into(),
        energy,
    };
    failed.because(cause).into()
}
