//! Members with deviations, in the lanes of one pack type.
//!
//! Input: a scheme and members at their starts, with a number of deviations each. Output: an indicator of chaos or an
//! error for each member. Invariants: each deviation is computed by a run over dual numbers. A lane makes the
//! operations of [`Tangent`](crate::analysis::Tangent) in the same order, so its bits depend only on its member and on
//! the arithmetic of the pack.

use super::scalar::explain;
use super::transfer::{Begin, Prepare, gather, lanes_of, load, scatter, store};
use super::{CarriedIn, MapIn, MaskIn};
use crate::analysis::tangent::{Columns, Megno, gram_schmidt, volume};
use crate::errors::Error;
use crate::flows::map::{Clock, Map};
use crate::schemes::scheme::Scheme;
use crate::systems::domain::inside;
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, Point, State};
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use alloc::vec;
use alloc::vec::Vec;
use core::sync::atomic::{AtomicBool, Ordering};
use hamiltonian_lanes::{Kernel, Level, Mask, Pack, Real};

/// The number of steps between two checks that all numbers are finite, as in a single run.
const BLOCK: u64 = 1024;

/// A member with its deviations.
pub(crate) struct DeviatedMember<T: Real, S: System> {
    pub(crate) prepared: S::Prepared<T>,
    /// The carried values of the scheme, deviation after deviation.
    pub(crate) words: Vec<T>,
    /// The state at its start.
    pub(crate) start: State<VectorOf<S, T>>,
    /// The numbers of the indicator, or the error of the member.
    pub(crate) result: Result<Vec<f64>, Error>,
}

/// The indicator that is computed from the deviations of a member.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Indicator {
    /// The mean growth rate of each deviation, orthogonal to the previous ones.
    Rates,
    /// MEGNO of the first deviation.
    Megno,
    /// GALI: the volume spanned by the directions of the deviations.
    Gali,
}

/// Members of which an indicator of chaos is computed.
pub struct Deviations<'r, T: Real, S: System> {
    pub(crate) members: Vec<DeviatedMember<T, S>>,
    pub(crate) indicator: Indicator,
    /// The number of deviations per member.
    pub(crate) count: usize,
    pub(crate) step: T,
    /// The duration of one step.
    pub(crate) interval: T,
    pub(crate) steps: u64,
    /// The number of steps between two renormalisations.
    pub(crate) every: u64,
    /// The flag that stops the work.
    pub(crate) cancel: Option<&'r AtomicBool>,
}

impl<T: Real, S: System> Deviations<'_, T, S> {
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}

/// Members with deviations in lanes.
struct DeviationLanes<T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    map: MapIn<T, S, P, M>,
    work: <MapIn<T, S, P, M> as Map>::Work,
    clock: Clock<T::Over<P>>,
    /// The members for whose systems the map was prepared: only the first if all systems are equal.
    prepared_for: Vec<usize>,
    /// The member of each lane; `None` for a lane whose member failed and for one that repeats another.
    members: Vec<Option<usize>>,
    /// The index of the first deviation of each lane that is not finite.
    first_failed: Vec<Option<usize>>,
    /// The carried value of each deviation, the same before the last block, and the closed states.
    carried: Vec<CarriedIn<T, S, P, M>>,
    before: Vec<CarriedIn<T, S, P, M>>,
    shown: Vec<CarriedIn<T, S, P, M>>,
    /// The lanes in which a deviation is finite.
    finite: Vec<<T::Over<P> as Real>::Mask>,
    /// The deviations, one per column.
    matrix: Vec<T::Over<P>>,
    lengths: Vec<T::Over<P>>,
    /// The sums of the logarithms of their growth factors.
    sums: Vec<T::Over<P>>,
    megno: Megno<T::Over<P>>,
    /// Scratch for numbers of the lanes, component by component.
    rows: Vec<T>,
}

/// Advances all members to their ends, inside the level `L` of the pack.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::ensembles) fn advance<L, T, S, P, M>(scheme: &M, all: &mut Deviations<'_, T, S>)
where
    L: Level,
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    let mut lanes = None;
    let mut pending = Vec::new();
    // Members that are not finite after a block are replayed together, step by step.
    for is_replay in [false, true] {
        let queue: Vec<usize> = match is_replay {
            false => (0..all.members.len()).collect(),
            true => core::mem::take(&mut pending),
        };
        for group in queue.chunks(P::LANES as usize) {
            DeviationLanes::<T, S, P, M>::load_lanes::<L>(&mut lanes, scheme, all, group);
            if let Some(lanes) = &mut lanes {
                lanes.run::<L>(scheme, all, is_replay, &mut pending);
            }
        }
    }
}

impl<T, S, P, M> DeviationLanes<T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    /// Loads members at their starts into lanes. The remaining lanes repeat the last member.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn load_lanes<L: Level>(
        lanes: &mut Option<Self>,
        scheme: &M,
        all: &Deviations<'_, T, S>,
        group: &[usize],
    ) {
        let members = &all.members;
        let equals = |a: usize, b: usize| S::equals(&members[a].prepared, &members[b].prepared);
        let is_uniform = group.iter().all(|other| equals(group[0], *other));
        let of = if is_uniform { &group[..1] } else { group };
        let is_prepared = |lanes: &Self| {
            is_uniform && lanes.prepared_for.len() == 1 && equals(lanes.prepared_for[0], of[0])
        };
        if !lanes.as_ref().is_some_and(is_prepared) {
            let systems: Vec<_> = of.iter().map(|at| &members[*at].prepared).collect();
            let steps = [all.step];
            let (prepared, map) = L::enter(Prepare::<T, S, P, M>::new(scheme, &systems, &steps));
            match lanes {
                Some(lanes) => lanes.map = map,
                None => {
                    let start = &members[group[0]].start;
                    let begin = Begin::<T, S, P, M>::new(scheme, &prepared, start, &steps);
                    let carried = L::enter(begin);
                    let zero = <T::Over<P> as Real>::zero();
                    let (n, size) = (all.count, carried.point().len());
                    *lanes = Some(DeviationLanes {
                        map,
                        work: Scratch::like(&carried),
                        clock: Clock::new(zero, all.interval.spread::<P>()),
                        prepared_for: Vec::new(),
                        members: Vec::new(),
                        first_failed: Vec::new(),
                        rows: vec![T::zero(); carried.len() * P::LANES as usize],
                        before: vec![carried.clone(); n],
                        shown: vec![carried.clone(); n],
                        carried: vec![carried; n],
                        finite: vec![Mask::splat(true); n],
                        matrix: vec![zero; n * size],
                        lengths: vec![zero; n],
                        sums: vec![zero; n],
                        megno: Megno::new(),
                    });
                }
            }
        }
        let Some(lanes) = lanes else { return };
        lanes.prepared_for = of.into();
        lanes.members = group.iter().map(|at| Some(*at)).collect();
        lanes.members.resize(P::LANES as usize, None);
        lanes.first_failed = vec![None; P::LANES as usize];
        let starts: Vec<T> = group.iter().map(|at| members[*at].start.t).collect();
        gather::<L, T, P>(&starts, &mut lanes.clock.start);
        let last = group[group.len() - 1];
        for (d, carried) in lanes.carried.iter_mut().enumerate() {
            let mut row = lanes.rows.iter_mut();
            let width = members[last].words.len() / all.count;
            for c in d * width..(d + 1) * width {
                for (member, number) in lanes.members.iter().zip(&mut row) {
                    *number = members[member.unwrap_or(last)].words[c];
                }
            }
            load::<L, T, P, _>(&lanes.rows, carried);
        }
        for sum in &mut lanes.sums {
            *sum = <T::Over<P> as Real>::zero();
        }
        lanes.megno = Megno::new();
    }

    /// Advances the members in the lanes to their ends. Members that are not finite are added to `pending`; in a replay
    /// they have failed.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(
        &mut self,
        scheme: &M,
        all: &mut Deviations<'_, T, S>,
        is_replay: bool,
        pending: &mut Vec<usize>,
    ) {
        let most = if is_replay { 1 } else { BLOCK };
        // The first block has no steps: deviations are renormalised at the start too.
        let (mut made, mut next_renormalisation, mut last_renormalisation) = (0, 0, 0);
        let is_gali = all.indicator == Indicator::Gali;
        loop {
            if all.is_cancelled() {
                return;
            }
            let n = most.min(next_renormalisation - made);
            if is_replay {
                self.before.clone_from(&self.carried);
            }
            let (mut is_finite, reached) = L::enter(DeviationBlock {
                map: &self.map,
                clock: self.clock,
                made,
                n,
                // GALI needs the deviations of the last step before they are renormalised.
                renormalises: made + n == next_renormalisation
                    && !(is_gali && next_renormalisation == all.steps),
                orthogonal: !is_gali,
                last_renormalisation,
                carried: &mut self.carried,
                shown: &mut self.shown,
                work: &mut self.work,
                finite: &mut self.finite,
                matrix: &mut self.matrix,
                lengths: &mut self.lengths,
                sums: &mut self.sums,
                megno: &mut self.megno,
            });
            let numbers = self.finite[0];
            if n > 0 {
                self.finite[0] = self.finite[0] & self.inside::<L>(all, &reached);
                is_finite &= self.finite[0].all();
            }
            if !is_finite {
                self.record_failures::<L>(scheme, all, (made, is_replay), &reached, numbers);
            }
            made += n;
            if made < next_renormalisation {
                continue;
            }
            if !is_finite && !self.remove_failed::<L>(is_replay, pending) {
                return;
            }
            if made == all.steps {
                return self.write_results::<L>(all, &reached);
            }
            last_renormalisation = next_renormalisation;
            next_renormalisation = made.saturating_add(all.every).min(all.steps);
        }
    }

    /// Returns the lanes whose members are inside the domain of H. All deviations have the same state.
    #[inline(never)]
    fn inside<L: Level>(
        &mut self,
        all: &Deviations<'_, T, S>,
        reached: &T::Over<P>,
    ) -> MaskIn<T, P> {
        let lanes = P::LANES as usize;
        let Point { q, p } = self.shown[0].point();
        let mut rows = vec![T::zero(); (q.len() + p.len() + 1) * lanes];
        let components = q.components().chain(p.components()).chain([*reached]);
        for (component, row) in components.zip(rows.chunks_exact_mut(lanes)) {
            scatter::<L, T, P>(&component, row);
        }
        let members = self.members.iter().map(|member| {
            let member = &all.members[(*member)?];
            Some((&member.prepared, &member.start))
        });
        let inside = inside::<T, S>(members, &rows, lanes);
        match inside.contains(&false) {
            true => lanes_of::<L, T, P>(&inside),
            false => Mask::splat(true),
        }
    }

    /// Records the lanes that are not finite after a block, and in a replay the cause. As in a single run, the error is
    /// that of the first deviation that is not finite at the next renormalisation. In the lanes of `numbers`, H alone
    /// is not finite for the first deviation.
    #[cold]
    #[inline(never)]
    fn record_failures<L: Level>(
        &mut self,
        scheme: &M,
        all: &mut Deviations<'_, T, S>,
        (made, is_replay): (u64, bool),
        reached: &T::Over<P>,
        numbers: MaskIn<T, P>,
    ) {
        let lanes = P::LANES as usize;
        let mut times = vec![T::zero(); lanes];
        scatter::<L, T, P>(reached, &mut times);
        for (d, finite) in self.finite.iter().enumerate() {
            for lane in 0..lanes {
                let Some(at) = self.members[lane].filter(|_| !finite.lane(lane as u32)) else {
                    continue;
                };
                if self.first_failed[lane].is_some_and(|first| first <= d) {
                    continue;
                }
                self.first_failed[lane] = Some(d);
                if !is_replay {
                    continue;
                }
                let member = &mut all.members[at];
                store::<L, T, P, _>(&self.before[d], &mut self.rows);
                let words: Vec<T> = self.rows.chunks_exact(lanes).map(|row| row[lane]).collect();
                let Point { q, p } = self.shown[d].point();
                let point = q.components().chain(p.components());
                let point: Vec<f64> = point.map(|number| number.lane(lane as u32)).collect();
                let clock = Clock::new(member.start.t, all.interval);
                let single = (&member.prepared, &member.start, all.step, clock);
                let end = (&*point, times[lane].to_f64());
                let only_energy = d == 0 && numbers.lane(lane as u32);
                let error = explain(scheme, single, (made, made == 0, &words), end, only_energy);
                member.result = Err(error);
            }
        }
    }

    /// Removes failed members from the lanes. Their lanes repeat another member, so that they compute with finite
    /// numbers. Returns true if any member is left.
    #[cold]
    #[inline(never)]
    fn remove_failed<L: Level>(&mut self, is_replay: bool, pending: &mut Vec<usize>) -> bool {
        let lanes = P::LANES as usize;
        for (member, failed) in self.members.iter_mut().zip(&self.first_failed) {
            let removed = member.take_if(|_| failed.is_some());
            pending.extend(removed.filter(|_| !is_replay));
        }
        let Some(stand_in) = self.members.iter().position(Option::is_some) else {
            return false;
        };
        for carried in &mut self.carried {
            store::<L, T, P, _>(carried, &mut self.rows);
            for row in self.rows.chunks_exact_mut(lanes) {
                for lane in 0..lanes {
                    if self.members[lane].is_none() {
                        row[lane] = row[stand_in];
                    }
                }
            }
            load::<L, T, P, _>(&self.rows, carried);
        }
        true
    }

    /// Writes the results of the members.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn write_results<L: Level>(&mut self, all: &mut Deviations<'_, T, S>, reached: &T::Over<P>) {
        let lanes = P::LANES as usize;
        let mut times = vec![T::zero(); lanes];
        scatter::<L, T, P>(reached, &mut times);
        let megno = [self.megno.area()];
        let packs = match all.indicator {
            Indicator::Rates => &self.sums[..],
            Indicator::Megno => &megno,
            Indicator::Gali => &self.matrix,
        };
        let mut rows = vec![T::zero(); packs.len() * lanes];
        for (pack, row) in packs.iter().zip(rows.chunks_exact_mut(lanes)) {
            scatter::<L, T, P>(pack, row);
        }
        for (lane, member) in self.members.iter().enumerate() {
            let Some(member) = member.map(|at| &mut all.members[at]) else {
                continue;
            };
            let Ok(result) = &mut member.result else {
                continue;
            };
            let numbers = rows.chunks_exact(lanes).map(|row| row[lane].to_f64());
            let time = times[lane].to_f64() - member.start.t.to_f64();
            match all.indicator {
                Indicator::Rates => result.extend(numbers.map(|sum| sum / time)),
                Indicator::Megno => result.extend(numbers.map(|area| Megno::mean(area, all.steps))),
                Indicator::Gali => {
                    let mut matrix: Vec<f64> = numbers.collect();
                    result.push(volume(&mut matrix, all.count));
                }
            }
        }
    }
}

/// A block of steps of all deviations in lanes, compiled at a level, out of line.
struct DeviationBlock<'a, R: Map<Carried: Carried<Scalar = U>>, U: Real> {
    map: &'a R,
    clock: Clock<U>,
    made: u64,
    n: u64,
    /// True if deviations are renormalised after the steps.
    renormalises: bool,
    /// True if renormalised deviations are orthogonal; otherwise they are only of length 1.
    orthogonal: bool,
    /// The number of steps at the last renormalisation.
    last_renormalisation: u64,
    carried: &'a mut [R::Carried],
    shown: &'a mut [R::Carried],
    work: &'a mut R::Work,
    finite: &'a mut [U::Mask],
    matrix: &'a mut [U],
    lengths: &'a mut [U],
    sums: &'a mut [U],
    megno: &'a mut Megno<U>,
}

impl<R, U> Kernel for DeviationBlock<'_, R, U>
where
    R: Map<Carried: Carried<Scalar = U>>,
    U: Real,
{
    /// True if all numbers are finite; and the time of the first deviation.
    type Output = (bool, U);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> (bool, U) {
        let end = self.made + self.n;
        let clock = self.clock.at(end);
        let size = self.matrix.len() / self.carried.len();
        let mut is_finite = true;
        for (d, carried) in self.carried.iter_mut().enumerate() {
            let shown = &mut self.shown[d];
            self.map
                .run(self.clock, self.made, self.n, carried, self.work);
            shown.copy_from(carried);
            if end > 0 {
                self.map.close(clock, shown, self.work);
            }
            let finite = shown.finite() & carried.finite() & shown.time(clock).finite();
            self.finite[d] = finite;
            is_finite &= finite.all();
            let mut column = self.matrix[d * size..][..size].iter_mut();
            let Point { q, p } = shown.point();
            for vector in [q, p] {
                for k in 0..<R::Carried as Carried>::Vector::PARTS {
                    for (from, to) in vector.part(k).iter().zip(&mut column) {
                        *to = from.derivative();
                    }
                }
            }
        }
        if self.renormalises {
            let mut carried = CarriedColumns(self.carried);
            gram_schmidt(self.matrix, self.lengths, self.orthogonal, &mut carried);
            carried.align();
            if end > 0 {
                for (d, (sum, length)) in self.sums.iter_mut().zip(self.lengths).enumerate() {
                    let logarithm = length.ln().with_derivative(U::zero());
                    *sum += logarithm;
                    if d == 0 {
                        self.megno.add([self.last_renormalisation, end], logarithm);
                    }
                }
            }
        }
        (is_finite, self.shown[0].time(clock))
    }
}

/// The carried values of the deviations as columns; derivative parts are linear in the deviation.
struct CarriedColumns<'a, C>(&'a mut [C]);

impl<C: Vector> CarriedColumns<'_, C> {
    /// Sets the values of all deviations to those of the first, see
    /// [`Tangent::orthonormalise`](crate::analysis::Tangent::orthonormalise).
    #[cfg_attr(not(unoptimised), inline(always))]
    fn align(&mut self) {
        let Some((first, others)) = self.0.split_first_mut() else {
            return;
        };
        for other in others {
            for k in 0..C::PARTS {
                for (word, first) in other.part_mut(k).iter_mut().zip(first.part(k)) {
                    *word = first.with_derivative(word.derivative());
                }
            }
        }
    }
}

impl<C: Vector> Columns<C::Scalar> for CarriedColumns<'_, C> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn combine(&mut self, to: usize, scale: C::Scalar, less: Option<(usize, C::Scalar)>) {
        let (before, carried) = self.0.split_at_mut(to);
        for k in 0..C::PARTS {
            for (i, word) in carried[0].part_mut(k).iter_mut().enumerate() {
                let mut derivative = word.derivative() * scale;
                if let Some((from, along)) = less {
                    derivative -= along * before[from].part(k)[i].derivative();
                }
                *word = word.with_derivative(derivative);
            }
        }
    }
}
