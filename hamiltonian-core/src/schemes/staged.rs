//! Steps of methods whose stages may lie beside each other in lanes.
//!
//! Input: a map ([`StagedMap`]). Output: its steps. Invariant: the bits are those of the steps stage by stage.

use super::bundles::{Abreast, LEAST, StageLayout, Width};
use super::polynomial::interpolate;
use crate::flows::map::{Cause, Clock, Map, ScalarOf};
use crate::systems::state::{Carried, Point};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The vectors of the point that a map moves.
type SeenBy<M> = <<M as Map>::Carried as Carried>::Vector;

/// Steps whose ends are looked at one by one, where they are in lanes.
pub(super) trait Inspect<T: Real, V: Vector<Scalar = T>, const S: usize> {
    /// True if there is anything to look at.
    const LOOKS: bool;
    /// The size of the next step in units of the map's, where steps are looked at.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn size(&self) -> T {
        T::one()
    }
    /// True if no step is to be made now.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn ends(&self) -> bool {
        false
    }
    /// The time at which step `k` of the clock begins.
    fn begins(&self, clock: Clock<T>, k: u64) -> T;
    /// Keeps a point and its low words.
    fn keep(&mut self, point: &Point<V>, low: &Point<V>);
    /// Returns true if the step from there, with these unknowns at its stages, is accepted.
    fn accepts<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(
        &mut self,
        point: &Point<V>,
        unknowns: &[X; S],
    ) -> bool;
    /// Keeps the unknowns of the step before one that is not accepted or not solved.
    fn refuse<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(&mut self, before: &[X; S]);
}

/// Steps of a run of fixed steps.
pub(super) struct Uninspected;

impl<T: Real, V: Vector<Scalar = T>, const S: usize> Inspect<T, V, S> for Uninspected {
    const LOOKS: bool = false;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn begins(&self, clock: Clock<T>, k: u64) -> T {
        clock.at(k)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn keep(&mut self, _: &Point<V>, _: &Point<V>) {}
    #[cfg_attr(not(unoptimised), inline(always))]
    fn accepts<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(
        &mut self,
        _: &Point<V>,
        _: &[X; S],
    ) -> bool {
        true
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn refuse<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(&mut self, _: &[X; S]) {}
}

/// A map whose steps are computed stage by stage, or with several stages in the lanes of a pack.
pub(super) trait StagedMap<const S: usize>: Map + Sized {
    /// The unknowns of a step at one stage.
    type Unknowns: Vector<Scalar = ScalarOf<Self>>;
    /// The unknowns of the last step.
    fn unknowns(z: &mut Self::Carried) -> &mut [Self::Unknowns; S];
    /// h, cᵢh, and bᵢh but for the sign of all.
    fn multiples(&self) -> (ScalarOf<Self>, &[ScalarOf<Self>; S], &[ScalarOf<Self>; S]);
    /// The map of a step of `by` times the size, whose unknowns are a guess for this step in place of those of the one
    /// before.
    fn part_of_size(&self, by: ScalarOf<Self>) -> Self;
    /// Moves the point by the unknowns as they are, by a step of `by` times the size.
    fn add_unknowns(
        &self,
        by: ScalarOf<Self>,
        t: ScalarOf<Self>,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    );

    /// [`Map::part`]: a step from the nearer end of the last one, whose iteration begins at the collocation polynomial of
    /// the last step.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn make_part(
        &self,
        t: ScalarOf<Self>,
        by: ScalarOf<Self>,
        last: ScalarOf<Self>,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        let [zero, one] = [ScalarOf::<Self>::zero(), ScalarOf::<Self>::one()];
        let half = ScalarOf::<Self>::constant(0.5, 0.0);
        let (h, times, weights) = self.multiples();
        let is_early = by.lt(-(last * half));
        if is_early.any() {
            // The step back, which has the same unknowns in the other order.
            let mut begin = z.clone();
            Self::unknowns(&mut begin).reverse();
            self.add_unknowns(-last, t, &mut begin, work);
            Self::unknowns(&mut begin).reverse();
            z.copy_where(is_early, &begin);
        }
        let from = ScalarOf::<Self>::select(is_early, t - last * h, t);
        let by = ScalarOf::<Self>::select(is_early, by + last, by);
        let first = ScalarOf::<Self>::select(is_early, zero, one);
        interpolate((h, times, weights), (first, by / last), Self::unknowns(z));
        let part = self.part_of_size(by);
        part.body(from, from + by * h, z, work);
    }

    /// True if the stages may lie beside each other.
    fn has_bundles(&self) -> bool {
        true
    }

    /// Makes up to `n` steps after the first `made`, with so many stages beside each other, until one is not solved or
    /// not accepted. Returns the number of steps made; `None` if there are no lanes. Of steps that are looked at, the
    /// sizes are those of the inspection in units of those of `sized`, a map that is otherwise the same.
    fn steps_beside<const WIDTH: usize, W: Inspect<ScalarOf<Self>, SeenBy<Self>, S>>(
        &self,
        sized: &Self,
        clock: (Clock<ScalarOf<Self>>, u64, u64),
        z: &mut Self::Carried,
        work: &mut Self::Work,
        inspection: &mut W,
    ) -> Option<u64>
    where
        Abreast<WIDTH>: Width;

    /// [`steps_beside`](StagedMap::steps_beside) of the width for `S` stages, of `(clock, made, n)`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn steps_in_lanes<W: Inspect<ScalarOf<Self>, SeenBy<Self>, S>>(
        &self,
        sized: &Self,
        clock: (Clock<ScalarOf<Self>>, u64, u64),
        z: &mut Self::Carried,
        work: &mut Self::Work,
        inspection: &mut W,
    ) -> Option<u64> {
        if const { S.is_multiple_of(8) } {
            self.steps_beside::<8, W>(sized, clock, z, work, inspection)
        } else {
            self.steps_beside::<4, W>(sized, clock, z, work, inspection)
        }
    }

    /// Completes the step that was not solved in lanes.
    fn complete_unsolved(&self, t: ScalarOf<Self>, z: &mut Self::Carried, work: &mut Self::Work);

    /// Makes one step, stage by stage.
    fn solve(&self, t: ScalarOf<Self>, z: &mut Self::Carried, work: &mut Self::Work) -> Cause;

    /// Makes at least one and up to `n` steps after the first `made`, stage by stage. Returns the number of steps
    /// made.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn steps_apart(
        &self,
        clock: Clock<ScalarOf<Self>>,
        made: u64,
        _n: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) -> u64 {
        self.solve(clock.at(made), z, work);
        1
    }

    /// Makes `n` steps after the first `from`, the stages beside each other where there are lanes for them.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn steps(
        &self,
        clock: Clock<ScalarOf<Self>>,
        from: u64,
        n: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        let mut made = 0;
        // The condition is constant, so that no code is compiled for the lanes of few stages.
        if const { S >= LEAST } {
            while made < n && self.has_bundles() {
                let clock_of = (clock, from + made, n - made);
                let Some(steps) = self.steps_in_lanes(self, clock_of, z, work, &mut Uninspected)
                else {
                    break;
                };
                made += steps;
                if made < n {
                    self.complete_unsolved(clock.at(from + made), z, work);
                    made += 1;
                }
            }
        }
        while made < n {
            made += self.steps_apart(clock, from + made, n - made, z, work);
        }
    }
}
