//! Strang's splitting of H into pieces with exact flows.
//!
//! Input: a [`Split`] system. Output: [`Strang`]. Invariant: the scheme is a [`Splitting`]; the loop is
//! [`Zigzag`]'s.

use super::splitting::{Durations, Splitting, Weight};
use super::zigzag::{Zigzag, ZigzagOf};
use crate::flows::map::Step;
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::state::{Point, State};
use crate::systems::system::{Description, Split, VectorOf};
use hamiltonian_lanes::Real;

/// Strang's splitting: the flows of all pieces for half a step, down, and up again; order 2,
/// symplectic, time-reversible, explicit for every H that splits.
///
/// ```text
/// z ← φ₁(h/2) ∘ … ∘ φₖ(h/2) ∘ φₖ(h/2) ∘ … ∘ φ₁(h/2) z
/// ```
///
/// Equal neighbours are one flow, across steps too. On a separable system it is Störmer–Verlet
/// (27d–f), bit for bit. Preserves dq∧dp.
///
/// Source: G. Strang, SIAM J. Numer. Anal. 5 (1968) 506, eq. 7, doi:10.1137/0705041.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, Strang, start, 0.01)?;
/// // The error of 100 steps is near h²t/24 = 4e-6.
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 5e-6);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Strang;

impl Listed for Strang {
    fn entry(&self) -> Entry {
        Entry {
            name: "Strang",
            variant: "",
            equations: "",
            order: 2,
            duration: 1,
            needs: Needs::SPLIT,
            preserves: Form::OnePoint,
            source: "Strang 1968, doi:10.1137/0705041",
        }
    }
}

impl Splitting for Strang {
    type Of<U> = [U; 1];
    #[cfg_attr(not(unoptimised), inline(always))]
    fn stages(&self) -> [Durations; 1] {
        [(Weight(0.5, 0.0), Weight(0.5, 0.0))]
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn filled<U: Clone>(&self, value: U) -> [U; 1] {
        [value]
    }
}

symmetric!(Strang);

impl<S: Split> Scheme<S> for Strang {
    type Carried = Point<S::Shape>;
    type Map<T: Real> = ZigzagOf<T, S, S::Pieces<T>, Self>;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        self.times_on(of.jumping_pieces())
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Zigzag::new(self, &S::pieces::<T>(), prepared, step)
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}
