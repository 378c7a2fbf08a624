//! Tables of weights: the coefficients of splittings.
//!
//! Input: published numbers. Output: [`Splitting`]: for each stage the durations `(down, up)` in units of
//! the step. Invariant: the durations of a table sum to one, down and up together; those of a processor
//! to zero.

use crate::schemes::scheme::{Listed, OneStep};
use hamiltonian_lanes::Real;

/// A coefficient in two words, `.0 + .1`, exact to 106 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weight(pub f64, pub f64);

impl Weight {
    /// Returns the weight as any scalar.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn to<T: Real>(self) -> T {
        T::constant(self.0, self.1)
    }

    /// Returns −w, exactly.
    #[must_use]
    pub const fn negated(self) -> Weight {
        Weight(-self.0, -self.1)
    }

    /// Returns half of it, exactly.
    #[must_use]
    pub const fn half(self) -> Weight {
        Weight(0.5 * self.0, 0.5 * self.1)
    }
}

/// The durations of a stage: the pieces 1…k for `down`, then k…1 for `up`.
///
/// Every splitting into two pieces a₁ b₁ a₂ b₂ … is such a table (d₁ = a₁, d₁ + u₁ = b₁,
/// u₁ + d₂ = a₂, …), every composition of a first-order map and its adjoint (down the first, up the
/// second), and every symmetric composition of Strang's splitting (down = up = γ/2).
pub type Durations = (Weight, Weight);

/// The weights of a splitting. With arrays as [`Of`](Splitting::Of), the number of stages is known at compile time.
///
/// Durations sum to one, those of the processor of a [`Processed`](super::Processed) scheme to zero.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no table of coefficients of a splitting",
    label = "expected a splitting such as `Strang`, `BlanesMoan4` or `KahanLi8`",
    note = "a table of your own implements `Splitting`, see the recipes"
)]
pub trait Splitting: Listed + Copy {
    /// An array with one element a stage.
    type Of<U>: AsRef<[U]> + AsMut<[U]>;
    /// The durations of the stages.
    fn stages(&self) -> Self::Of<Durations>;
    /// An array of as many elements as there are stages, with `value` in each.
    fn filled<U: Clone>(&self, value: U) -> Self::Of<U>;
    /// The first and the last time at which a step evaluates the pieces that jump, in units of the step: the first
    /// piece, and the others. A scheme of the table returns them from
    /// [`times_of_jumps`](crate::Scheme::times_of_jumps).
    fn times_on(&self, jumping: [bool; 2]) -> [f64; 2] {
        let weights = self.stages();
        let weights = weights.as_ref();
        let down = |i: usize| weights.get(i).map_or(0.0, |(down, _)| down.to::<f64>());
        let mut clocks = Clocks::new(weights);
        let mut times = [f64::INFINITY, f64::NEG_INFINITY];
        let mut evaluates = |piece: usize, duration: f64, at: f64| {
            if jumping[piece] && duration != 0.0 {
                times = [times[0].min(at), times[1].max(at)];
            }
        };
        evaluates(0, down(0), 0.0);
        for (i, (_, up)) in weights.iter().enumerate() {
            let [inner, outer] = clocks.next(weights, i, 1.0);
            evaluates(1, 1.0, inner);
            evaluates(0, up.to::<f64>().abs() + down(i + 1).abs(), outer);
        }
        times
    }
}

/// The two clocks in units of the step, at the beginning of a stage.
pub(super) struct Clocks<T> {
    outer: T,
    inner: T,
}

impl<T: Real> Clocks<T> {
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn new(weights: &[Durations]) -> Self {
        Clocks {
            outer: weights.first().map_or(T::zero(), |(down, _)| down.to()),
            inner: T::zero(),
        }
    }

    /// The times of the inner flows of stage `i` and of the flow after it.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn next(&mut self, weights: &[Durations], i: usize, h: T) -> [T; 2] {
        let zero = T::zero();
        let (down, up) = weights
            .get(i)
            .map_or((zero, zero), |(down, up)| (down.to(), up.to()));
        let next = weights.get(i + 1).map_or(zero, |(down, _)| down.to());
        let inner_at = self.outer * h;
        self.inner += down + up;
        self.outer += up + next;
        [inner_at, self.inner * h]
    }
}

/// The table of the adjoint scheme: backwards, with the durations of each stage exchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Reversed<W>(pub W);

impl<W: Splitting> Listed for Reversed<W> {
    fn entry(&self) -> crate::schemes::scheme::Entry {
        crate::schemes::scheme::Entry {
            variant: "adjoint",
            ..self.0.entry()
        }
    }
}

impl<W: Splitting> Splitting for Reversed<W> {
    type Of<U> = W::Of<U>;
    fn stages(&self) -> W::Of<Durations> {
        let mut stages = self.0.stages();
        stages.as_mut().reverse();
        for (down, up) in stages.as_mut() {
            core::mem::swap(down, up);
        }
        stages
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn filled<U: Clone>(&self, value: U) -> W::Of<U> {
        self.0.filled(value)
    }
}

impl<W: Splitting> OneStep for Reversed<W>
where
    W: OneStep,
{
    type Adjoint = W;
    fn adjoint(&self) -> W {
        self.0
    }
}

/// The table with every duration negated: the step −h. `Reversed(Negated(table))` is the inverse of `table`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Negated<W>(pub W);

impl<W: Splitting> Listed for Negated<W> {
    fn entry(&self) -> crate::schemes::scheme::Entry {
        crate::schemes::scheme::Entry {
            variant: "adjoint",
            ..self.0.entry()
        }
    }
}

impl<W: Splitting> Splitting for Negated<W> {
    type Of<U> = W::Of<U>;
    fn stages(&self) -> W::Of<Durations> {
        let mut stages = self.0.stages();
        for (down, up) in stages.as_mut() {
            (*down, *up) = (down.negated(), up.negated());
        }
        stages
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn filled<U: Clone>(&self, value: U) -> W::Of<U> {
        self.0.filled(value)
    }
}
