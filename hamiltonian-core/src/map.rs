//! One-step maps: schemes prepared for a given step.
//!
//! Input: the carried value, and the time. Output: the value a step later. Invariants: a map owns
//! constants and no state, so threads share one, stages of a composition share its scratch, and a
//! part of a step is another map; nothing allocates or dispatches inside a step; the carried value
//! depends on the number of steps made and on nothing else, so that the bits of a trajectory are the
//! same however it is cut into blocks and whoever observes it.

use crate::flow::Scratch;
use crate::state::Carried;
use crate::vector::Vector;
use hamiltonian_lanes::Real;

/// The scalar of the value a map carries.
pub type ScalarOf<M> = <<M as Map>::Carried as Vector>::Scalar;

/// A one-step map Φ = close ∘ body ∘ open.
///
/// The closing piece of a step and the opening piece of the next are one,
/// [`join`](Map::join). What is carried after a step stands before its closing piece; whoever wants
/// to see the state closes a copy.
pub trait Map {
    /// All that is carried from step to step.
    type Carried: Carried;
    /// Scratch, whose contents never matter.
    type Work: Scratch<Self::Carried>;

    /// The piece before the body of the first step, at its beginning.
    #[inline(always)]
    fn open(&self, _t: ScalarOf<Self>, _z: &mut Self::Carried, _work: &mut Self::Work) {}
    /// The step from `t` to `end`, but for its opening and closing pieces.
    fn body(
        &self,
        t: ScalarOf<Self>,
        end: ScalarOf<Self>,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    );
    /// The piece after the body, at the end of the step.
    #[inline(always)]
    fn close(&self, _t: ScalarOf<Self>, _z: &mut Self::Carried, _work: &mut Self::Work) {}
    /// True if [`close`](Map::close) changes coordinates, and the same for momenta: an observer of the
    /// others alone needs no closed copy.
    #[inline(always)]
    fn closing(&self) -> [bool; 2] {
        [true; 2]
    }
    /// `close` of the step before, then `open`.
    #[inline(always)]
    fn join(&self, t: ScalarOf<Self>, z: &mut Self::Carried, work: &mut Self::Work) {
        self.close(t, z, work);
        self.open(t, z, work);
    }
    /// Makes the step again that led to a value that is not finite, and says why it did. `first` is
    /// whether it began with `open` instead of `join`.
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

    /// [`join`](Map::join), and, if `closes`, [`close`](Map::close) of a copy: both begin at the same point, and what
    /// they compute alike is computed once.
    #[doc(hidden)]
    #[inline(always)]
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

    /// Makes the steps from number `made` to number `end`, of which the piece before the first body has been made.
    #[doc(hidden)]
    #[inline(always)]
    fn go_on<C: Times<ScalarOf<Self>>>(
        &self,
        times: &C,
        made: u64,
        end: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        // Counted down to zero, which costs one instruction less; the number of the step is only
        // computed where a system looks at the time. The body, the largest part, is compiled once.
        let mut left = end - made;
        loop {
            let k = end - left;
            self.body(times.at(k), times.at(k + 1), z, work);
            left -= 1;
            if left == 0 {
                break;
            }
            self.join(times.at(k + 1), z, work);
        }
    }

    /// Makes `n` steps after the first `made`.
    #[inline(always)]
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
        // Moved out, the carried value is a variable of this loop alone and stays in registers.
        let mut carried = z.take();
        if made == 0 {
            self.open(clock.at(0), &mut carried, work);
        } else {
            self.join(clock.at(made), &mut carried, work);
        }
        self.go_on(&clock, made, made + n, &mut carried, work);
        *z = carried;
    }

    /// One whole step from `t` to `end`.
    #[inline(always)]
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

/// Why a step led to a value that is not finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cause {
    /// A number grew beyond all bounds, or J∇H is not defined where it was asked for.
    Overflow,
    /// The exact flow of this piece left its domain, or J∇H of it is not defined there.
    Piece(&'static str),
    /// The equations of an implicit step were not solved.
    Unsolved {
        /// The last change of the iterate, in the sum norm.
        residual: f64,
        /// The number of iterations made.
        iterations: u32,
    },
}

/// The step a map is made for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<T> {
    /// Its size.
    pub h: T,
    /// The size of the step whose closing piece [`Map::join`] absorbs: `h` in a run, the stage before
    /// in a composition.
    pub before: T,
}

impl<T: Copy> Step<T> {
    /// Steps of one size.
    pub fn of(h: T) -> Self {
        Step { h, before: h }
    }
}

/// Time as a function of the number of steps: `start + k·interval`, never a running sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock<T> {
    /// The time at step 0.
    pub start: T,
    /// The time one step advances.
    pub interval: T,
}

/// The times of steps.
pub trait Times<T> {
    /// The time after so many steps.
    fn at(&self, made: u64) -> T;
}

impl<T: Real> Times<T> for Clock<T> {
    #[inline(always)]
    fn at(&self, made: u64) -> T {
        Clock::at(self, made)
    }
}

impl<T: Real> Clock<T> {
    /// The clock of one step.
    #[inline(always)]
    pub(crate) fn between(start: T, end: T) -> Self {
        let interval = end - start;
        Clock { start, interval }
    }

    /// The time after `made` steps.
    ///
    /// Pure, so that it vanishes where a system does not look at the time; exact in the number
    /// of steps up to 2⁵³.
    #[inline(always)]
    pub fn at(&self, made: u64) -> T {
        // Signed conversion is one instruction, unsigned is not.
        self.interval
            .fma(T::constant(made as i64 as f64, 0.0), self.start)
    }
}

/// One of two maps: a choice of the scheme that is made at run time, once a block of steps.
#[derive(Debug, Clone)]
pub enum Either<A, B> {
    /// The first.
    First(A),
    /// The second.
    Second(B),
}

/// Calls the same method of whichever map is there.
macro_rules! either {
    ($self:ident.$method:ident($($argument:expr),*; $work:ident)) => {
        match $self {
            Either::First(map) => map.$method($($argument),*, &mut $work.0),
            Either::Second(map) => map.$method($($argument),*, &mut $work.1),
        }
    };
}

impl<A: Map, B: Map<Carried = A::Carried>> Map for Either<A, B> {
    type Carried = A::Carried;
    /// Of the first, and of the second.
    type Work = (A::Work, B::Work);

    #[inline(always)]
    fn open(&self, t: ScalarOf<A>, z: &mut A::Carried, work: &mut Self::Work) {
        either!(self.open(t, z; work));
    }
    #[inline(always)]
    fn body(&self, t: ScalarOf<A>, end: ScalarOf<A>, z: &mut A::Carried, work: &mut Self::Work) {
        either!(self.body(t, end, z; work));
    }
    #[inline(always)]
    fn close(&self, t: ScalarOf<A>, z: &mut A::Carried, work: &mut Self::Work) {
        either!(self.close(t, z; work));
    }
    #[inline(always)]
    fn closing(&self) -> [bool; 2] {
        match self {
            Either::First(map) => map.closing(),
            Either::Second(map) => map.closing(),
        }
    }
    #[inline(always)]
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
    #[inline(always)]
    fn run(
        &self,
        clock: Clock<ScalarOf<A>>,
        made: u64,
        n: u64,
        z: &mut A::Carried,
        work: &mut Self::Work,
    ) {
        either!(self.run(clock, made, n, z; work));
    }
    #[inline(always)]
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
    #[inline(always)]
    fn go_on<C: Times<ScalarOf<A>>>(
        &self,
        times: &C,
        made: u64,
        end: u64,
        z: &mut A::Carried,
        work: &mut Self::Work,
    ) {
        either!(self.go_on(times, made, end, z; work));
    }
}
