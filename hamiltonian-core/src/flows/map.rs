//! One-step maps: schemes prepared for a given step.
//!
//! Input: the carried value and the time. Output: the carried value one step later. Invariants:
//!
//! - A map owns constants and no state. Therefore threads share a map, stages of a composition share its scratch, and a
//!   part of a step is another map.
//! - Nothing allocates or dispatches inside a step.
//! - The carried value depends only on the start and the number of steps made, so that the bits of a trajectory do not
//!   depend on its division into blocks or on observers.

use crate::systems::flow::Scratch;
use crate::systems::state::Carried;
use crate::systems::vector::Vector;
use core::marker::PhantomData;
use hamiltonian_lanes::Real;

/// The scalar of the value that a map carries.
pub type ScalarOf<M> = <<M as Map>::Carried as Vector>::Scalar;

/// A one-step map Φ = close ∘ body ∘ open.
///
/// The closing piece of a step and the opening piece of the next are merged into [`join`](Map::join). Therefore the
/// value carried after a step is the one before its closing piece. The state after the step is a copy to which
/// [`close`](Map::close) was applied.
pub trait Map {
    /// The value carried from step to step.
    type Carried: Carried;
    /// Scratch. Results do not depend on its contents.
    type Work: Scratch<Self::Carried>;

    /// Applies the piece before the body of the first step.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn open(&self, _t: ScalarOf<Self>, _z: &mut Self::Carried, _work: &mut Self::Work) {}
    /// Makes the step from `t` to `end`, without its opening and closing pieces.
    fn body(
        &self,
        t: ScalarOf<Self>,
        end: ScalarOf<Self>,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    );
    /// Applies the piece after the body, at the end of a step.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn close(&self, _t: ScalarOf<Self>, _z: &mut Self::Carried, _work: &mut Self::Work) {}
    /// Returns whether [`close`](Map::close) changes coordinates, and whether it changes momenta. An observer that
    /// reads only unchanged ones needs no closed copy.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn closing(&self) -> [bool; 2] {
        [true; 2]
    }
    /// Applies `close` of the previous step, then `open`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn join(&self, t: ScalarOf<Self>, z: &mut Self::Carried, work: &mut Self::Work) {
        self.close(t, z, work);
        self.open(t, z, work);
    }
    /// Repeats a step that led to a value that is not finite, and returns the cause. `first` is true if the step began
    /// with `open` instead of `join`.
    #[cold]
    fn explain(
        &self,
        _t: ScalarOf<Self>,
        _end: ScalarOf<Self>,
        _first: bool,
        _z: &mut Self::Carried,
        _work: &mut Self::Work,
    ) -> Cause {
        Cause::Overflow
    }

    /// Returns true if the map makes parts of its steps, see [`part`](Map::part).
    #[doc(hidden)]
    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_parts(&self) -> bool {
        false
    }
    /// Returns the size of the step that led to `z`, in units of this map's.
    #[doc(hidden)]
    #[cfg_attr(not(unoptimised), inline(always))]
    fn last_step(&self, _z: &Self::Carried) -> ScalarOf<Self> {
        ScalarOf::<Self>::one()
    }
    /// Moves `z`, the value after a step that ended at `t` and had the size `last` in units of this map's, by `by` such
    /// units, at most back to the beginning of that step.
    #[doc(hidden)]
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(
        &self,
        _t: ScalarOf<Self>,
        _by: ScalarOf<Self>,
        _last: ScalarOf<Self>,
        _z: &mut Self::Carried,
        _work: &mut Self::Work,
    ) {
    }

    /// Applies [`join`](Map::join), and, if `closes`, [`close`](Map::close) to a copy. Both begin at the same point, so
    /// common expressions are computed once.
    #[doc(hidden)]
    #[cfg_attr(not(unoptimised), inline(always))]
    fn join_and_close(
        &self,
        t: ScalarOf<Self>,
        z: &mut Self::Carried,
        copy: &mut Self::Carried,
        closes: bool,
        work: &mut Self::Work,
    ) {
        self.join(t, z, work);
        if closes {
            self.close(t, copy, work);
        }
    }

    /// Makes the steps after the first `made`, up to number `end`. The piece before the first body has been applied.
    #[doc(hidden)]
    #[cfg_attr(not(unoptimised), inline(always))]
    fn go_on(
        &self,
        clock: Clock<ScalarOf<Self>>,
        made: u64,
        end: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        // Counting down to zero saves an instruction. The number of the step is computed only if the system depends on
        // time. The body, the largest part, is compiled once.
        let mut left = end - made;
        loop {
            let k = end - left;
            self.body(clock.at(k), clock.at(k + 1), z, work);
            left -= 1;
            if left == 0 {
                break;
            }
            self.join(clock.at(k + 1), z, work);
        }
    }

    /// Makes `n` steps after the first `made`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run(
        &self,
        clock: Clock<ScalarOf<Self>>,
        made: u64,
        n: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        if n == 0 {
            return;
        }
        // As a local variable, the carried value stays in registers during the loop.
        let mut carried = z.take();
        if made == 0 {
            self.open(clock.at(0), &mut carried, work);
        } else {
            self.join(clock.at(made), &mut carried, work);
        }
        self.go_on(clock, made, made + n, &mut carried, work);
        *z = carried;
    }

    /// Makes one whole step from `t` to `end`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn step(
        &self,
        t: ScalarOf<Self>,
        end: ScalarOf<Self>,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        self.open(t, z, work);
        self.body(t, end, z, work);
        self.close(end, z, work);
    }
}

/// The reason why a step led to a value that is not finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cause {
    /// A number overflowed, or J∇H was evaluated outside its domain.
    Overflow,
    /// The exact flow of this piece left its domain, or its J∇H was evaluated outside its domain.
    Piece(&'static str),
    /// The equations of an implicit step were not solved.
    Unsolved {
        /// The last change of the iterate, in the sum norm.
        residual: f64,
        /// The number of iterations made.
        iterations: u32,
    },
    /// The estimated error of a step was above the tolerance for every size that moves the time.
    Refused {
        /// The relative tolerance.
        relative: f64,
        /// The absolute tolerance.
        absolute: f64,
    },
    /// H jumped in the step at every size that moves the time.
    Jumped {
        /// H at the beginning of the step.
        before: f64,
        /// H at its end.
        after: f64,
    },
}

/// The step for which a map is prepared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<T> {
    /// Its size.
    pub h: T,
    /// The size of the step whose closing piece is part of [`Map::join`]: `h` in a run, the previous stage in a
    /// composition.
    pub before: T,
}

impl<T: Copy> Step<T> {
    /// Steps of one size.
    pub fn of(h: T) -> Self {
        Step { h, before: h }
    }
}

/// Time as a function of the number of steps: `start + (first + k)·interval`, never a running sum.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Clock<T> {
    /// The time at which the clock was set.
    pub start: T,
    /// The duration of one step.
    pub interval: T,
    /// The number of steps between that time and step 0. A run whose state was changed counts its steps from there anew,
    /// and its times stay those of the run without the change. Members beside each other have made different numbers of
    /// steps.
    pub first: T,
}

impl<T: Real> Clock<T> {
    /// Creates the clock of one step.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn between(start: T, end: T) -> Self {
        Clock::new(start, end - start)
    }

    /// Creates a clock that shows `start` at step 0.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn new(start: T, interval: T) -> Self {
        Clock {
            start,
            interval,
            first: T::zero(),
        }
    }

    /// Returns the time after `made` steps. A number that is negative as an `i64` is a step before.
    ///
    /// The function is pure, so that the compiler removes it if the system does not depend on time. The number of steps
    /// is exact up to 2⁵³.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn at(&self, made: u64) -> T {
        // Conversion of signed integers takes one instruction, of unsigned integers several.
        let made = T::constant(made as i64 as f64, 0.0) + self.first;
        self.interval.fma(made, self.start)
    }
}

/// One of two maps, between which a scheme chooses at run time, or by `C` when a program is compiled. The choice is made
/// once per block of steps.
#[derive(Debug, Clone)]
pub enum Either<A, B, C = AtRunTime> {
    /// The first.
    First(A),
    /// The second.
    Second(B, PhantomData<C>),
}

impl<A, B, C> Either<A, B, C> {
    /// Makes the second map.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn second(map: B) -> Self {
        Either::Second(map, PhantomData)
    }
}

/// What the type of a map says about its choice between two. No code is compiled for a map that is never chosen.
pub trait Choice {
    /// `Some(true)` if the first map is always chosen, `Some(false)` if the second is, `None` if that is known at run time
    /// alone.
    const IS_FIRST: Option<bool>;
    /// True if the first map may be chosen.
    const MAY_BE_FIRST: bool = !matches!(Self::IS_FIRST, Some(false));
    /// True if the second map may be chosen.
    const MAY_BE_SECOND: bool = !matches!(Self::IS_FIRST, Some(true));
}

/// A choice that is made at run time.
#[derive(Debug, Clone)]
pub struct AtRunTime;

impl Choice for AtRunTime {
    const IS_FIRST: Option<bool> = None;
}

/// Calls the same method of the chosen map.
macro_rules! either {
    ($self:ident.$method:ident($($argument:expr),* $(; $work:ident)?)) => {
        match $self {
            Either::First(map) if const { C::MAY_BE_FIRST } => {
                map.$method($($argument),* $(, &mut $work.0)?)
            }
            Either::Second(map, _) if const { C::MAY_BE_SECOND } => {
                map.$method($($argument),* $(, &mut $work.1)?)
            }
            _ => unreachable!("a map that is never chosen"),
        }
    };
}

impl<A: Map, B: Map<Carried = A::Carried>, C: Choice> Map for Either<A, B, C> {
    type Carried = A::Carried;
    /// The scratch of the first map, and of the second.
    type Work = (A::Work, B::Work);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn open(&self, t: ScalarOf<A>, z: &mut A::Carried, work: &mut Self::Work) {
        either!(self.open(t, z; work));
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: ScalarOf<A>, end: ScalarOf<A>, z: &mut A::Carried, work: &mut Self::Work) {
        either!(self.body(t, end, z; work));
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn close(&self, t: ScalarOf<A>, z: &mut A::Carried, work: &mut Self::Work) {
        either!(self.close(t, z; work));
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn closing(&self) -> [bool; 2] {
        either!(self.closing())
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn join(&self, t: ScalarOf<A>, z: &mut A::Carried, work: &mut Self::Work) {
        either!(self.join(t, z; work));
    }
    #[cold]
    fn explain(
        &self,
        t: ScalarOf<A>,
        end: ScalarOf<A>,
        first: bool,
        z: &mut A::Carried,
        work: &mut Self::Work,
    ) -> Cause {
        either!(self.explain(t, end, first, z; work))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn join_and_close(
        &self,
        t: ScalarOf<A>,
        z: &mut A::Carried,
        copy: &mut A::Carried,
        closes: bool,
        work: &mut Self::Work,
    ) {
        either!(self.join_and_close(t, z, copy, closes; work));
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn go_on(
        &self,
        clock: Clock<ScalarOf<A>>,
        made: u64,
        end: u64,
        z: &mut A::Carried,
        work: &mut Self::Work,
    ) {
        either!(self.go_on(clock, made, end, z; work));
    }
}
