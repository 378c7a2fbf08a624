//! The loop of every splitting: down through the pieces and up again, stage by stage.
//!
//! Input: a [`Splitting`], [`Pieces`] of H on any space, a step. Output: [`Zigzag`], a one-step map.
//! Invariant: equal neighbours are one flow, within a step and across steps.
//!
//! # Time
//! If H depends on t, the outermost piece has a clock and all others together have another; each
//! clock advances when its flows move the point, and a flow sees the clock of the others. (This is the
//! autonomous splitting of A(z, t₂) + B(z, t₁) + C(z, t₁) + … with a pair of conjugate energies, so
//! tables keep their order.) Störmer–Verlet thus kicks at t and t + h and drifts at t + h/2.

use super::splitting::{Splitting, Weight};
use crate::flow::{Flow, Pieces};
use crate::map::{Cause, Map, Step};
use crate::state::{Carried, Point};
use crate::system::System;
use crate::vector::Vector;
use core::fmt;
use hamiltonian_lanes::{DoubleDouble, Real};

/// The map of the table `W` on the pieces `K` of a system.
pub type ZigzagOf<T, S, K, W> = Zigzag<
    Point<<S as System<T>>::Vector>,
    <K as Pieces<T, <S as System<T>>::Prepared>>::Outer,
    <K as Pieces<T, <S as System<T>>::Prepared>>::Inner,
    W,
>;

/// The outermost flow between two stages: one flow if it merges, two if it is a loop.
#[derive(Debug, Clone)]
struct Link<F> {
    /// The flow of the previous stage, merged with that of the next if possible.
    up: F,
    down: Option<F>,
}

impl<F> Link<F> {
    #[inline(always)]
    fn new<X: Vector>(flow: impl Fn(X::Scalar) -> F, up: X::Scalar, down: X::Scalar) -> Self
    where
        F: Flow<X>,
    {
        if F::MERGES {
            Link {
                up: flow(up + down),
                down: None,
            }
        } else {
            Link {
                up: flow(up),
                down: Some(flow(down)),
            }
        }
    }

    #[inline(always)]
    fn apply<X: Vector>(&self, t: X::Scalar, x: &mut X, work: &mut F::Work)
    where
        F: Flow<X>,
    {
        self.up.apply_reversed(t, x, work);
        if !F::MERGES
            && let Some(down) = &self.down
        {
            down.apply(t, x, work);
        }
    }

    /// Moves the point in a function of its own; returns the piece's name if the point is not
    /// finite.
    #[cold]
    #[inline(never)]
    fn blame<X: Vector>(&self, t: X::Scalar, x: &mut X, work: &mut F::Work) -> Option<&'static str>
    where
        F: Flow<X>,
    {
        self.apply(t, x, work);
        (!x.is_finite()).then_some(F::NAME)
    }
}

/// Durations as differences of partial sums, each rounded to a multiple of an ulp of 4h at least:
/// sums of them are exact, the last is h, and the rounding of the weights does not change the rate
/// of any motion.
struct PartialSums<T> {
    h: T,
    weights: DoubleDouble,
    reached: T,
}

impl<T: Real> PartialSums<T> {
    fn new(h: T) -> Self {
        PartialSums {
            h,
            weights: DoubleDouble::from(0.0),
            reached: T::zero(),
        }
    }

    /// The duration of the next weight.
    fn next(&mut self, weight: Weight) -> T {
        // The rounding of the last digits of a table.
        const ROUNDING: f64 = 1e-28;
        if weight == Weight(0.0, 0.0) {
            return T::zero();
        }
        self.weights += weight.to::<DoubleDouble>();
        let before = self.reached;
        let is_whole = (self.weights - DoubleDouble::from(1.0)).hi().abs() < ROUNDING;
        self.reached = if is_whole {
            self.h
        } else {
            // The sum, of a few h at most, loses the digits below those of 4h.
            let far = T::constant(8.0, 0.0) * self.h;
            let sum = T::constant(self.weights.hi(), self.weights.lo()) * self.h;
            (sum + far) - far
        };
        self.reached - before
    }
}

/// One stage with its weights folded into the flows.
#[derive(Debug, Clone)]
struct Stage<T, O, I> {
    inner: I,
    /// The time of the outermost clock after the beginning of the step.
    inner_at: T,
    /// The flow between this stage and the next; in the last stage, the closing flow.
    outer: Link<O>,
    /// The time of the other clock.
    outer_at: T,
}

/// A splitting for a given step.
pub struct Zigzag<X: Vector, O, I, W: Splitting> {
    /// `None` if its duration is 0.
    opening: Option<O>,
    joining: Link<O>,
    closes: bool,
    stages: W::Of<Stage<X::Scalar, O, I>>,
}

impl<X: Vector, O: Flow<X>, I: Flow<X>, W: Splitting> Zigzag<X, O, I, W> {
    /// Folds the table into the flows of the pieces.
    #[inline(always)]
    pub fn new<P, K>(table: &W, pieces: &K, prepared: &P, step: Step<X::Scalar>) -> Self
    where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        Self::after(table, table, pieces, prepared, step)
    }

    /// Folds the table into the flows, for a step after one of the table `before` on the same
    /// pieces.
    #[inline(always)]
    pub fn after<P, K>(
        before: &W,
        table: &W,
        pieces: &K,
        prepared: &P,
        step: Step<X::Scalar>,
    ) -> Self
    where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        let before = before.stages();
        let closing = (before.as_ref().last()).map_or(X::Scalar::zero(), |(_, up)| up.to());
        let closing = closing * step.before;
        let duration = |weight: Weight| weight.to::<X::Scalar>() * step.h;
        Self::with(table, pieces, prepared, step.h, duration, closing)
    }

    /// Folds the table into the flows, with durations that add up to the step exactly.
    #[inline(always)]
    pub(super) fn exact<P, K>(table: &W, pieces: &K, prepared: &P, step: Step<X::Scalar>) -> Self
    where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        let mut sums = PartialSums::new(step.before);
        let mut closing = X::Scalar::zero();
        for (down, up) in table.stages().as_ref() {
            sums.next(*down);
            closing = sums.next(*up);
        }
        let mut sums = PartialSums::new(step.h);
        let duration = |weight: Weight| sums.next(weight);
        Self::with(table, pieces, prepared, step.h, duration, closing)
    }

    /// Folds the durations of the weights into the flows; `duration` is called in the order of the
    /// table.
    #[inline(always)]
    fn with<P, K>(
        table: &W,
        pieces: &K,
        prepared: &P,
        h: X::Scalar,
        mut duration: impl FnMut(Weight) -> X::Scalar,
        closing_before: X::Scalar,
    ) -> Self
    where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        let zero = X::Scalar::zero();
        let outer = |c| pieces.outer(prepared, c);
        let durations = W::map(table.stages(), |(down, up)| (duration(down), duration(up)));
        let durations = durations.as_ref();
        let opening = durations.first().map_or(zero, |(down, _)| *down);
        let closing = durations.last().map_or(zero, |(_, up)| *up);
        let weights = table.stages();
        let first = (weights.as_ref().first()).map_or(zero, |(down, _)| down.to::<X::Scalar>());
        let mut outer_time = first;
        let mut inner_time = zero;
        let mut following = weights.as_ref().iter().skip(1);
        let mut lasting = durations.iter();
        let stages = W::map(table.stages(), |(down, up)| {
            let (down, up) = (down.to::<X::Scalar>(), up.to::<X::Scalar>());
            let next = following
                .next()
                .map_or(zero, |(down, _)| down.to::<X::Scalar>());
            let inner_at = outer_time * h;
            inner_time += down + up;
            outer_time += up + next;
            let (down, up) = lasting.next().map_or((zero, zero), |durations| *durations);
            let next = lasting.as_slice().first().map_or(zero, |(down, _)| *down);
            Stage {
                inner: pieces.inner(prepared, down, up),
                inner_at,
                outer: Link::new::<X>(outer, up, next),
                outer_at: inner_time * h,
            }
        });
        Zigzag {
            opening: (opening != zero).then(|| outer(opening)),
            joining: Link::new::<X>(outer, closing_before, opening),
            closes: closing != zero,
            stages,
        }
    }

    /// The flow with which the step ends.
    #[inline(always)]
    fn last(&self) -> Option<&Link<O>> {
        match self.stages.as_ref().last() {
            Some(stage) if self.closes => Some(&stage.outer),
            _ => None,
        }
    }
}

impl<X: Carried, O: Flow<X>, I: Flow<X>, W: Splitting> Map for Zigzag<X, O, I, W> {
    type Carried = X;
    /// The clock of the outermost flow, and that of the inner ones.
    type Work = (O::Work, I::Work);

    #[inline(always)]
    fn open(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        if let Some(opening) = &self.opening {
            opening.apply(t, z, &mut work.0);
        }
    }

    #[inline(always)]
    fn body(&self, t: X::Scalar, _: X::Scalar, z: &mut X, (outer, inner): &mut Self::Work) {
        let stages = self.stages.as_ref();
        for (i, stage) in stages.iter().enumerate() {
            stage.inner.apply(t + stage.inner_at, z, inner);
            if i + 1 < stages.len() {
                stage.outer.apply(t + stage.outer_at, z, outer);
            }
        }
    }

    #[inline(always)]
    fn close(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        if let Some(closing) = self.last() {
            closing.apply(t, z, &mut work.0);
        }
    }

    #[inline(always)]
    fn closing(&self) -> [bool; 2] {
        if self.closes { O::MOVES } else { [false; 2] }
    }

    #[inline(always)]
    fn join(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        self.joining.apply(t, z, &mut work.0);
    }

    #[cold]
    fn explain(
        &self,
        t: X::Scalar,
        end: X::Scalar,
        first: bool,
        z: &mut X,
        work: &mut Self::Work,
    ) -> Cause {
        let stages = self.stages.as_ref();
        let Some(last) = stages.last() else {
            return Cause::Overflow;
        };
        let mut blamed = match &self.opening {
            Some(opening) if first => opening.blame(t, z, &mut work.0),
            None if first => None,
            _ => self.joining.blame(t, z, &mut work.0),
        };
        for stage in stages {
            blamed = blamed.or_else(|| stage.inner.blame(t + stage.inner_at, z, &mut work.1));
            if blamed.is_none() && !core::ptr::eq(stage, last) {
                blamed = stage.outer.blame(t + stage.outer_at, z, &mut work.0);
            }
        }
        let at_the_end = || self.last()?.blame(end, z, &mut work.0);
        match blamed.or_else(at_the_end) {
            Some(piece) => Cause::Piece(piece),
            None => Cause::Overflow,
        }
    }
}

impl<X: Vector, O: fmt::Debug, I: fmt::Debug, W: Splitting> fmt::Debug for Zigzag<X, O, I, W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Zigzag")
            .field("opening", &self.opening)
            .field("joining", &self.joining)
            .field("stages", &self.stages.as_ref())
            .finish()
    }
}
