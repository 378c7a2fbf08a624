//! A block of steps of all lanes, compiled at a level, out of line.
//!
//! Input: the carried values of the lanes. Output: the carried values `n` steps later, and a closed copy.
//! Invariant: the bits of a lane depend on that lane alone. They are those of [`Map::run`] for every
//! division of the steps into blocks.

use super::marks::Marks;
use crate::flows::map::{Clock, Map};
use crate::observers::observe::{LaneDrift, LaneSection, Quantity};
use crate::systems::state::Carried;
use crate::systems::system::{Dynamics, System, VectorOf, declared_energy_at};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Kernel, Level, Mask, Real};

/// The piece before the first body of a block.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Opening<M> {
    /// All lanes are at their starts.
    Open,
    /// All lanes are under way.
    Join,
    /// The lanes of the mask are at their starts.
    Mixed(M),
}

/// The steps after which the observer of each lane receives a state, if the lanes differ.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct LaneSchedule<U> {
    /// The steps to the next state that the observer receives; 0 if it receives none.
    pub(crate) left: U,
    /// The steps between two such states.
    pub(crate) interval: U,
}

impl<U: Real> LaneSchedule<U> {
    /// Returns the lanes whose observers receive a state after `n` more steps.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn due(&mut self, n: u64) -> U::Mask {
        let left = self.left - U::constant(n as i64 as f64, 0.0);
        let due = left.equals(U::zero());
        self.left = U::select(due, self.interval, left);
        due
    }
}

/// The quantities that a block evaluates for observers.
pub(crate) struct Followed<'a, U: Real, S: System> {
    pub(crate) prepared: &'a S::Prepared<U>,
    pub(crate) drifts: &'a mut [LaneDrift<U>],
    /// The functions whose sign is followed. If there are any, states are evaluated after every step.
    pub(crate) sections: &'a mut [LaneSection<U>],
    /// The lanes whose observers follow signs.
    pub(crate) section_lanes: U::Mask,
    /// True if the drift of H is followed.
    pub(crate) energy: bool,
    /// True if any followed quantity depends on coordinates or momenta that the closing piece changes.
    pub(crate) closes: bool,
    /// The steps to the first state that observers receive.
    pub(crate) first: u64,
    /// The steps between two such states.
    pub(crate) interval: u64,
    /// The schedule of each lane, if the lanes differ.
    pub(crate) by_lane: Option<&'a mut LaneSchedule<U>>,
    /// The lanes whose observers receive their first state at the end of this block, which then has no steps.
    pub(crate) attach: Option<U::Mask>,
}

impl<U: Real, S: System> Followed<'_, U, S> {
    /// Returns true if signs are followed in this block.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_sections(&self) -> bool {
        !self.sections.is_empty() && self.attach.is_none()
    }

    /// Evaluates the followed quantities after step `k`, at the time `t`. If signs are followed, `marks` has the
    /// carried value of this step. `shown` is closed if [`closes`](Followed::closes). Returns true if the block
    /// should end.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn evaluate<L: Level, C: Carried<Vector = VectorOf<S, U>, Scalar = U>>(
        &mut self,
        (k, t): (u64, U),
        shown: &C,
        marks: &mut Marks<C, U::Mask>,
    ) -> bool {
        let due = match (&mut self.by_lane, self.attach) {
            (Some(lanes), None) => Some(lanes.due(self.interval)),
            _ => None,
        };
        let has_sections = self.has_sections();
        let (t, point) = (shown.time(t), shown.point());
        // Outside the loop: the compiler would hoist H out of it, and evaluate it for all quantities.
        if self.energy {
            let value = declared_energy_at::<U, S>(self.prepared, t, &point.q, &point.p);
            for drift in &mut *self.drifts {
                if drift.quantity == Quantity::Energy {
                    drift.follow(self.attach, due, value);
                }
            }
        }
        let mut is_any_marked = false;
        // A single call evaluates all quantities: each further call would inline a copy of every observable,
        // whose length is proportional to the width of the pack.
        let count = self.drifts.len();
        let all = count + if has_sections { self.sections.len() } else { 0 };
        for at in 0..all {
            let index = match self.drifts.get(at).map(|drift| drift.quantity) {
                Some(Quantity::Energy) => continue,
                Some(Quantity::Observable(index)) => index,
                None => self.sections[at - count].observable,
            };
            let value = self.prepared.observable(index, t, &point.q, &point.p);
            if at < count {
                self.drifts[at].follow(self.attach, due, value);
                continue;
            }
            let section = &mut self.sections[at - count];
            is_any_marked |= follow_sign::<L, _, _>(section, value, &self.section_lanes, marks);
        }
        is_any_marked && L::enter(Mark { marks, step: k })
    }

    /// Makes the steps from number `k` to number `end`, of which the piece before the first body has been made, and
    /// evaluates the functions whose sign is followed after each. They must not depend on what the closing piece
    /// changes. Returns the number of the last step, since a block ends if too many steps are marked.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn go_on_with_sections<
        L: Level,
        R: Map<Carried: Carried<Vector = VectorOf<S, U>, Scalar = U>>,
    >(
        &mut self,
        map: &R,
        (clock, mut k, end): (Clock<U>, u64, u64),
        z: &mut R::Carried,
        work: &mut R::Work,
        marks: &mut Marks<R::Carried, U::Mask>,
    ) -> u64 {
        loop {
            map.body(clock.at(k), clock.at(k + 1), z, work);
            k += 1;
            marks.add(z);
            let (t, point) = (z.time(clock.at(k)), z.point());
            let mut is_any_marked = false;
            for section in &mut *self.sections {
                let value = self
                    .prepared
                    .observable(section.observable, t, &point.q, &point.p);
                is_any_marked |= follow_sign::<L, _, _>(section, value, &self.section_lanes, marks);
            }
            if is_any_marked && L::enter(Mark { marks, step: k }) || k == end {
                return k;
            }
            map.join(clock.at(k), z, work);
        }
    }
}

/// Gives a section its value after a step. Returns true if any lane will be marked.
#[cfg_attr(not(unoptimised), inline(always))]
fn follow_sign<L: Level, C: Vector, U: Real>(
    section: &mut LaneSection<U>,
    value: U,
    section_lanes: &U::Mask,
    marks: &mut Marks<C, U::Mask>,
) -> bool {
    !section.try_skip(value, section_lanes)
        && L::enter(FindMarks {
            section,
            value,
            section_lanes,
            marks,
        })
}

/// A call of [`LaneSection::lanes_to_mark`]. It is out of line, since few steps need it and the compiler would move
/// some of its operations into every step.
struct FindMarks<'a, C, U: Real> {
    section: &'a mut LaneSection<U>,
    value: U,
    section_lanes: &'a U::Mask,
    marks: &'a mut Marks<C, U::Mask>,
}

impl<C: Vector, U: Real> Kernel for FindMarks<'_, C, U> {
    /// True if any lane will be marked.
    type Output = bool;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> bool {
        let lanes = self.section.lanes_to_mark(self.value) & *self.section_lanes;
        let is_any = lanes.any();
        if is_any {
            self.marks.to_mark = self.marks.to_mark | lanes;
        }
        is_any
    }
}

/// A call of [`Marks::mark`], out of line.
struct Mark<'a, C, M> {
    marks: &'a mut Marks<C, M>,
    step: u64,
}

impl<C: Vector, M: Mask> Kernel for Mark<'_, C, M> {
    /// True if the block should end.
    type Output = bool;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> bool {
        self.marks.mark(self.step)
    }
}

/// A block of steps of all lanes.
///
/// Without `FOLLOWS` nothing is followed, and no code is compiled for it.
pub(crate) struct Block<
    'a,
    R: Map<Carried: Carried<Scalar = U>>,
    U: Real,
    S: System,
    const FOLLOWS: bool,
> {
    pub(crate) map: &'a R,
    pub(crate) clock: Clock<U>,
    /// Steps since the count of times began.
    pub(crate) made: u64,
    pub(crate) n: u64,
    pub(crate) opening: Opening<U::Mask>,
    pub(crate) carried: &'a mut R::Carried,
    pub(crate) shown: &'a mut R::Carried,
    /// Scratch of the shape of the carried value.
    pub(crate) spare: &'a mut R::Carried,
    pub(crate) work: &'a mut R::Work,
    pub(crate) followed: Followed<'a, U, S>,
    pub(crate) marks: &'a mut Marks<R::Carried, U::Mask>,
}

impl<R, U, S, const FOLLOWS: bool> Kernel for Block<'_, R, U, S, FOLLOWS>
where
    R: Map<Carried: Carried<Vector = VectorOf<S, U>, Scalar = U>>,
    U: Real,
    S: System,
{
    /// The lanes in which all numbers are finite, and the steps since the count of times began. A block ends
    /// before `n` steps if too many of them are marked. `shown` is then closed only if a followed quantity
    /// requires it.
    type Output = (U::Mask, u64);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> Self::Output {
        let Block {
            map,
            clock,
            made,
            n,
            opening,
            carried,
            shown,
            spare,
            work,
            mut followed,
            marks,
        } = self;
        let mut end = made + n;
        if const { !FOLLOWS } {
            (followed.drifts, followed.sections) = (&mut [], &mut []);
            (followed.closes, followed.by_lane, followed.attach) = (false, None, None);
        }
        // Steps with few numbers are so fast that another loop, with nothing but them and the signs, is worth its code.
        let is_small = const {
            let size = size_of::<R::Carried>() + size_of::<R::Work>();
            size <= 4 * size_of::<U>()
        };
        let only_sections = followed.has_sections() && followed.drifts.is_empty();
        let in_loop = is_small && only_sections && !followed.closes;
        let follows_any = !followed.sections.is_empty() || !followed.drifts.is_empty();
        // A local variable stays in registers in the loop.
        let mut z = spare.take();
        z.copy_from(carried);
        let mut k = made;
        // The next step whose state observers receive.
        let mut due = match n > 0 && follows_any && !in_loop {
            true => made.saturating_add(followed.first),
            false => u64::MAX,
        };
        let mut stop = end.min(due);
        // Each piece occurs only once outside the loop of steps, which keeps the code of a level small. The joining
        // piece after the last step is evaluated even if no step follows, since a further case would cost more code.
        loop {
            let t = clock.at(k);
            let opens = if k == made { opening } else { Opening::Join };
            let stops = k == stop;
            // Local to one iteration.
            let mut closed = shown.take();
            if stops {
                if k == due && followed.has_sections() {
                    marks.add(&z);
                }
                if k == end {
                    carried.copy_from(&z);
                }
            }
            closed.copy_from(&z);
            if !matches!(opens, Opening::Open) {
                let closes = stops && (k == end || followed.closes);
                map.join_and_close(t, &mut z, &mut closed, closes, work);
            }
            if stops {
                if let Opening::Mixed(at_start) = opens {
                    closed.copy_where(at_start, carried);
                }
                let evaluates = k == due || followed.attach.is_some();
                due = k.saturating_add(followed.interval);
                stop = end.min(due);
                if evaluates && followed.evaluate::<L, _>((k, t), &closed, marks) && k < end {
                    end = k;
                    carried.copy_from(marks.newest());
                }
                if k == end {
                    *shown = closed;
                    break;
                }
            } else if !matches!(opens, Opening::Join) {
                map.open(t, &mut closed, work);
                match opens {
                    Opening::Mixed(at_start) => z.copy_where(at_start, &closed),
                    _ => z.copy_from(&closed),
                }
            }
            if const { core::mem::needs_drop::<R::Carried>() } {
                *shown = closed;
            }
            if in_loop {
                k = followed.go_on_with_sections::<L, R>(map, (clock, k, end), &mut z, work, marks);
                (end, stop) = (k, k);
                continue;
            }
            // The loop of steps contains nothing else, so that the carried value stays in registers.
            map.go_on(clock, k, stop, &mut z, work);
            k = stop;
        }
        *spare = z;
        let t = clock.at(end);
        let finite = shown.finite() & carried.finite();
        (finite & shown.time(t).finite(), end)
    }
}
