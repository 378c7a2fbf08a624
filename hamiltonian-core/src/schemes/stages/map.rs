//! The steps of [`Collocated`], stage by stage or in lanes.
//!
//! Input: a map and the value that it carries. Output: the value after a number of steps. Invariant: the bits do not depend
//! on the layout of the stages.

use super::slopes::{StepScratch, StepsBeside, finish, fixed_point, steps};
use super::{Carries, Collocated, CollocatedWork};
use crate::flows::iterate::Outcome;
use crate::flows::map::{Cause, Clock, Map};
use crate::schemes::bundles::{Abreast, Apart, LEAST, Width};
use crate::schemes::staged::{Inspect, StagedMap, Uninspected};
use crate::systems::flow::Scratch;
use crate::systems::state::{Pair, Point};
use crate::systems::system::Dynamics;
use crate::systems::system::gather::in_lanes;
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

impl<T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> StagedMap<S>
    for Collocated<T, P, S, HALVES>
{
    type Unknowns = Point<P::Vector>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn unknowns(z: &mut Carries<P::Vector, S>) -> &mut [Point<P::Vector>; S] {
        &mut z.y.x.0
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn multiples(&self) -> (T, &[T; S], &[T; S]) {
        (self.h, &self.times, &self.weights)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part_of_size(&self, by: T) -> Self {
        let mut part = self.clone();
        self.resize(by, &mut part);
        part.is_part = true;
        part
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_unknowns(
        &self,
        by: T,
        _: T,
        z: &mut Carries<P::Vector, S>,
        _: &mut CollocatedWork<P::Vector, S>,
    ) {
        let Pair { x: point, y } = z;
        let weights = self.weights.map(|weight| weight * by);
        finish::<T, Apart, _, _, S>(&weights, &y.x.0, point, &mut y.y);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_bundles(&self) -> bool {
        self.modes.is_none()
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn steps_beside<const WIDTH: usize, W: Inspect<T, P::Vector, S>>(
        &self,
        sized: &Self,
        (clock, made, n): (Clock<T>, u64, u64),
        z: &mut Carries<P::Vector, S>,
        work: &mut CollocatedWork<P::Vector, S>,
        inspection: &mut W,
    ) -> Option<u64>
    where
        Abreast<WIDTH>: Width,
    {
        let steps = StepsBeside::<_, _, _, S, WIDTH, HALVES> {
            map: self,
            sized,
            clock,
            made,
            n,
            z,
            inspection,
        };
        in_lanes(&self.dynamics, &mut work.kept, steps)
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn complete_unsolved(
        &self,
        t: T,
        z: &mut Carries<P::Vector, S>,
        work: &mut CollocatedWork<P::Vector, S>,
    ) {
        self.complete(t, Outcome::unsolved(), z, work);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn solve(
        &self,
        t: T,
        z: &mut Carries<P::Vector, S>,
        work: &mut CollocatedWork<P::Vector, S>,
    ) -> Cause {
        // Compiled once for steps and for the repetition of a step.
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || {
                let Pair { x: point, y } = &mut *z;
                let unknowns = &mut y.x;
                let outcome = if self.modes.is_some() {
                    self.solve_between(t, point, None, unknowns, work, |_, _| {})
                } else {
                    fixed_point::<T, Apart, _, _, _, S, HALVES>(
                        self.fixed_point_limit(),
                        &self.tableau(),
                        &self.field,
                        t,
                        point,
                        &mut unknowns.0,
                        &mut work.next.0,
                        &mut work.stage,
                    )
                };
                self.complete(t, outcome, z, work)
            },
        )
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn steps_apart(
        &self,
        clock: Clock<T>,
        made: u64,
        n: u64,
        z: &mut Carries<P::Vector, S>,
        work: &mut CollocatedWork<P::Vector, S>,
    ) -> u64 {
        if const { S >= LEAST } || self.modes.is_some() {
            self.solve(clock.at(made), z, work);
            return 1;
        }
        // Few stages may stay in registers, if they are variables of this loop alone.
        let mut scratch = StepScratch {
            slopes: z.y.x.take(),
            points: work.next.take(),
            next: work.stage.take(),
        };
        let (mut point, mut low) = (z.x.take(), z.y.y.take());
        let (solved, outcome) = steps::<T, Apart, _, _, _, _, S, HALVES>(
            self.fixed_point_limit(),
            &self.tableau(),
            &self.field,
            (clock, made, n),
            (&mut scratch, &mut work.guess.0),
            (&mut point, &mut low),
            &mut Uninspected,
        );
        (z.x, z.y.y) = (point, low);
        z.y.x = scratch.slopes;
        (work.next, work.stage) = (scratch.points, scratch.next);
        if solved < n {
            self.complete(clock.at(made + solved), outcome, z, work);
            return solved + 1;
        }
        n
    }
}

impl<V: Vector, const S: usize> Scratch<Carries<V, S>> for CollocatedWork<V, S> {
    fn like(like: &Carries<V, S>) -> Self {
        CollocatedWork::new(&like.x, &like.y.x)
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> Map
    for Collocated<T, P, S, HALVES>
{
    type Carried = Carries<P::Vector, S>;
    type Work = CollocatedWork<P::Vector, S>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: T, end: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.go_on(Clock::between(t, end), 0, 1, z, work);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn go_on(
        &self,
        clock: Clock<T>,
        made: u64,
        end: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || self.steps(clock, made, end - made, z, work),
        );
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_parts(&self) -> bool {
        self.modes.is_none()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, t: T, by: T, last: T, z: &mut Self::Carried, work: &mut Self::Work) {
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || self.make_part(t, by, last, z, work),
        );
    }

    #[cold]
    fn explain(&self, t: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        self.solve(t, z, work)
    }
}
