//! The loop of every splitting: down through the pieces and up again, stage by stage.
//!
//! Input: a [`Splitting`], [`Pieces`] of H on any space, a step. Output: [`Zigzag`], a one-step map.
//! Invariant: equal neighbours are one flow, within a step and across steps.
//!
//! # Time
//! If H depends on t, the outermost piece has a clock and all others together have another; each
//! clock advances when its flows move the point, and a flow reads the clock of the others. (This is the
//! autonomous splitting of A(z, t₂) + B(z, t₁) + C(z, t₁) + … with a pair of conjugate energies, so
//! tables keep their order.) Störmer–Verlet thus kicks at t and t + h and drifts at t + h/2.

use super::splitting::{Clocks, Splitting, Weight};
use crate::flows::map::{Cause, Map, Step};
use crate::systems::flow::{Flow, Pieces};
use crate::systems::state::{Carried, Point};
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use core::fmt;
use hamiltonian_lanes::{DoubleDouble, Real};

/// The map of the table `W` on the pieces `K` of a system.
pub type ZigzagOf<T, S, K, W> = Zigzag<
    Point<VectorOf<S, T>>,
    <K as Pieces<T, <S as System>::Prepared<T>>>::Outer,
    <K as Pieces<T, <S as System>::Prepared<T>>>::Inner,
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
    #[cfg_attr(not(unoptimised), inline(always))]
    fn new<T, P, K>(pieces: &K, prepared: &P, up: T, down: T) -> Self
    where
        T: Real,
        K: Pieces<T, P, Outer = F>,
        F: Flow<K::Point>,
    {
        if pieces.merges(prepared) {
            Link {
                up: pieces.outer(prepared, up + down),
                down: None,
            }
        } else {
            Link {
                up: pieces.outer(prepared, up),
                down: Some(pieces.outer(prepared, down)),
            }
        }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
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
    #[cfg_attr(not(unoptimised), inline(always))]
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

impl<T: Real, O, I> Stage<T, O, I> {
    /// The flows of a stage of the durations `down` and `up`, before one that begins with `next`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn new<P, K>(
        pieces: &K,
        prepared: &P,
        (down, up): (T, T),
        next: T,
        [inner_at, outer_at]: [T; 2],
    ) -> Self
    where
        K: Pieces<T, P, Outer = O, Inner = I>,
        O: Flow<K::Point>,
    {
        Stage {
            inner: pieces.inner(prepared, down, up),
            inner_at,
            outer: Link::new(pieces, prepared, up, next),
            outer_at,
        }
    }
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
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn new<P, K>(table: &W, pieces: &K, prepared: &P, step: Step<X::Scalar>) -> Self
    where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        Self::after(table, table, pieces, prepared, step)
    }

    /// Folds the table into the flows, for a step after one of the table `before` on the same
    /// pieces.
    #[cfg_attr(not(unoptimised), inline(always))]
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
        let zero = X::Scalar::zero();
        let mut durations = table.filled((zero, zero));
        for (to, (down, up)) in (durations.as_mut().iter_mut()).zip(table.stages().as_ref()) {
            let (down, up): (X::Scalar, X::Scalar) = (down.to(), up.to());
            *to = (down * step.h, up * step.h);
        }
        Self::with(table, pieces, prepared, step.h, durations, closing)
    }

    /// Folds the table into the flows, with durations that add up to the step exactly.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn exact<P, K>(table: &W, pieces: &K, prepared: &P, step: Step<X::Scalar>) -> Self
    where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        let zero = X::Scalar::zero();
        let mut durations = table.filled((zero, zero));
        let mut closing = zero;
        for h in [step.before, step.h] {
            closing = durations.as_ref().last().map_or(zero, |(_, up)| *up);
            let mut sums = PartialSums::new(h);
            for (to, (down, up)) in (durations.as_mut().iter_mut()).zip(table.stages().as_ref()) {
                *to = (sums.next(*down), sums.next(*up));
            }
        }
        Self::with(table, pieces, prepared, step.h, durations, closing)
    }

    /// Folds the durations of the weights into the flows.
    ///
    /// No closure makes a flow: one that is not inlined is compiled without the instructions of a level.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn with<P, K>(
        table: &W,
        pieces: &K,
        prepared: &P,
        h: X::Scalar,
        durations: W::Of<(X::Scalar, X::Scalar)>,
        closing_before: X::Scalar,
    ) -> Self
    where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        let zero = X::Scalar::zero();
        let none = (zero, zero);
        let durations = durations.as_ref();
        let opening = durations.first().unwrap_or(&none).0;
        let closing = durations.last().unwrap_or(&none).1;
        let weights = table.stages();
        let weights = weights.as_ref();
        let mut clocks = Clocks::new(weights);
        // The first stage fills the array. All are made in one place, since the flows of many pieces are much code.
        let mut stages = None;
        let mut i = 0;
        loop {
            let duration = *durations.get(i).unwrap_or(&none);
            let next = durations.get(i + 1).unwrap_or(&none).0;
            let times = clocks.next(weights, i, h);
            let stage = Stage::new(pieces, prepared, duration, next, times);
            match &mut stages {
                None => stages = Some(table.filled(stage)),
                Some(stages) => stages.as_mut()[i] = stage,
            }
            i += 1;
            if i >= durations.len()
                && let Some(stages) = stages
            {
                let joining = Link::new(pieces, prepared, closing_before, opening);
                let opening = if opening != zero {
                    Some(pieces.outer(prepared, opening))
                } else {
                    None
                };
                return Zigzag {
                    opening,
                    joining,
                    closes: closing != zero,
                    stages,
                };
            }
        }
    }

    /// One step of size `h` from `t` to `end`, with the bits of [`Map::step`] of the map that [`Zigzag::new`]
    /// prepares: each flow is made where it is applied.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn once<P, K>(
        table: &W,
        pieces: &K,
        prepared: &P,
        h: X::Scalar,
        [t, end]: [X::Scalar; 2],
        z: &mut X,
        (outer, inner): &mut (O::Work, I::Work),
    ) where
        K: Pieces<X::Scalar, P, Point = X, Outer = O, Inner = I>,
    {
        let zero = X::Scalar::zero();
        let weights = table.stages();
        let weights = weights.as_ref();
        let down = |i: usize| weights.get(i).map_or(zero, |(down, _)| down.to()) * h;
        let mut clocks = Clocks::new(weights);
        let opening = down(0);
        if opening != zero {
            pieces.outer(prepared, opening).apply(t, z, outer);
        }
        for (i, (_, up)) in weights.iter().enumerate() {
            let up = up.to::<X::Scalar>() * h;
            let times = clocks.next(weights, i, h);
            let stage = Stage::new(pieces, prepared, (down(i), up), down(i + 1), times);
            stage.inner.apply(t + stage.inner_at, z, inner);
            let is_last = i + 1 == weights.len();
            if !is_last || up != zero {
                let at = if is_last { end } else { t + stage.outer_at };
                stage.outer.apply(at, z, outer);
            }
        }
    }

    /// The flows of a step after its opening one, if they [merge](Flow::MERGES): of each stage the inner and the outer flow,
    /// each with its time after the beginning of the step. The last outer flow joins the step to the next, at its end.
    pub fn flows(&self) -> impl Iterator<Item = (&I, X::Scalar, &O, X::Scalar)> {
        let stages = self.stages.as_ref();
        stages.iter().enumerate().map(move |(i, stage)| {
            let outer = match i + 1 == stages.len() {
                true => &self.joining,
                false => &stage.outer,
            };
            (&stage.inner, stage.inner_at, &outer.up, stage.outer_at)
        })
    }

    /// The flow with which the step ends.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn last(&self) -> Option<&Link<O>> {
        match self.stages.as_ref().last() {
            Some(stage) if self.closes => Some(&stage.outer),
            _ => None,
        }
    }
}

impl<X: Carried, O: Flow<X>, I: Flow<X>, W: Splitting> Map for Zigzag<X, O, I, W> {
    type Carried = X;
    /// The scratch of the outermost flow, and that of the inner ones.
    type Work = (O::Work, I::Work);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn open(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        if let Some(opening) = &self.opening {
            opening.apply(t, z, &mut work.0);
        }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: X::Scalar, _: X::Scalar, z: &mut X, (outer, inner): &mut Self::Work) {
        let stages = self.stages.as_ref();
        for (i, stage) in stages.iter().enumerate() {
            stage.inner.apply(t + stage.inner_at, z, inner);
            if i + 1 < stages.len() {
                stage.outer.apply(t + stage.outer_at, z, outer);
            }
        }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn close(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        if let Some(closing) = self.last() {
            closing.apply(t, z, &mut work.0);
        }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn closing(&self) -> [bool; 2] {
        if self.closes { O::MOVES } else { [false; 2] }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
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
