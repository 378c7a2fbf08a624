//! Splittings in the phase space of two copies, (q, q̃, p, p̃): explicit for every H.
//!
//! Input: any system. Output: [`Pihajoki`]. Invariant: the crossed points x and y hold one half
//! of each copy, so that H(x) + H(y) splits into two flows; the loop is [`Splitting`]'s.

use super::separable::LEAPFROG;
use super::splitting::{Flowing, Splitting};
use crate::scheme::{Clock, Copies, Entry, Form, Listed, Needs, Scheme, Stepper, Unsolved};
use crate::state::{Pair, Point, State};
use crate::system::{Dynamics, Flow, System};
use crate::vector::Vector;
use hamiltonian_lanes::Real;

/// Pihajoki's leapfrog in extended phase space (the paper's PSVM): order 2, explicit for every H;
/// equations (29) and (30).
///
/// With H₁ = H(q, p̃, t), H₂ = H(q̃, p, t) and both copies equal at the start, (29) is
///
/// ```text
/// q ← q + h/2 ∂H₂/∂p;   p̃ ← p̃ − h/2 ∂H₂/∂q̃
/// q̃ ← q̃ + h ∂H₁/∂p̃;    p ← p − h ∂H₁/∂q
/// q ← q + h/2 ∂H₂/∂p;   p̃ ← p̃ − h/2 ∂H₂/∂q̃
/// ```
///
/// and (30) the same with the copies exchanged. The last line of a step and the first of the next
/// are one. On a separable system (q, p) of (29) is drift–kick–drift Störmer–Verlet bit for bit,
/// that of (30) kick–drift–kick.
///
/// Preserves dq∧dp + dq̃∧dp̃ in the extended space, which is *not* dq∧dp of what is seen: **the
/// copies part**, on H = ½(q²+1)(p²+1) from (−3, 0) by 2.7 at t = 4. Watch
/// [`Integrator::copy_distance`](crate::Integrator::copy_distance). (Pihajoki's mixing maps are
/// not in the paper's equations, nor here.)
///
/// Source: P. Pihajoki, Celest. Mech. Dyn. Astron. 121 (2015) 211,
/// doi:10.1007/s10569-014-9597-9.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, State, schemes::Pihajoki};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, Pihajoki::default(), start, 0.01)?;
/// run.advance(100)?;
/// // On a separable system the copies are the two Störmer–Verlets, O(h²) apart.
/// assert!(run.copy_distance() < 1e-4);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pihajoki {
    /// (29): q is moved before p.
    #[default]
    CoordinateFirst,
    /// (30): p is moved before q.
    MomentumFirst,
}

impl Listed for Pihajoki {
    fn entry(&self) -> &'static Entry {
        const COORDINATE_FIRST: Entry = Entry {
            name: "Pihajoki",
            variant: "coordinate first",
            equations: "29",
            order: 2,
            duration: 1,
            needs: Needs::Any,
            preserves: Form::TwoPoint,
            source: "Pihajoki 2015, doi:10.1007/s10569-014-9597-9",
        };
        match self {
            Pihajoki::CoordinateFirst => &COORDINATE_FIRST,
            Pihajoki::MomentumFirst => &Entry {
                variant: "momentum first",
                equations: "30",
                ..COORDINATE_FIRST
            },
        }
    }
}

impl<T: Real, S: System<T>> Scheme<T, S> for Pihajoki {
    type Stepper = Doubled<S::Vector, <S::Prepared as Dynamics<T>>::Flow>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        let point = Point {
            q: start.q.clone(),
            p: start.p.clone(),
        };
        let flow = |c| Flowing(prepared.flow(c));
        Doubled {
            first: *self,
            splitting: Splitting::new(
                &LEAPFROG,
                Clock {
                    start: start.t,
                    interval: step,
                },
                0.0,
                Pair {
                    x: point.clone(),
                    y: point,
                },
                flow,
                flow,
            ),
        }
    }
}

/// The stepper of [`Pihajoki`].
///
/// The crossed point that is moved first is x. For (29) x = (q, p̃) and y = (q̃, p); for (30)
/// x = (q̃, p) and y = (q, p̃).
#[derive(Debug, Clone)]
pub struct Doubled<V: Vector, F: Flow<V>> {
    first: Pihajoki,
    splitting: Splitting<Point<V>, Point<V>, Flowing<F>, Flowing<F>, 1>,
}

impl<V: Vector, F: Flow<V>> Stepper for Doubled<V, F> {
    type Vector = V;
    type Carried = Pair<Point<V>, Point<V>>;

    #[inline(always)]
    fn carried(&self) -> &Self::Carried {
        self.splitting.carried()
    }

    #[inline(always)]
    fn carried_mut(&mut self) -> &mut Self::Carried {
        self.splitting.carried_mut()
    }

    #[inline(always)]
    fn run(&mut self, made: u64, n: u64) -> Result<(), Unsolved> {
        self.splitting.run(made, n);
        Ok(())
    }

    #[inline(always)]
    fn synchronise(&mut self, made: u64, q: &mut V, p: &mut V) {
        let (x, y) = self.splitting.synchronise(made);
        let (with_q, with_p) = match self.first {
            Pihajoki::CoordinateFirst => (x, y),
            Pihajoki::MomentumFirst => (y, x),
        };
        q.copy_from(&with_q.q);
        p.copy_from(&with_p.p);
    }
}

impl<V: Vector, F: Flow<V>> Copies for Doubled<V, F> {
    fn copy(&self) -> Point<V> {
        let (x, y) = self.splitting.synchronised();
        let (with_q, with_p) = match self.first {
            Pihajoki::CoordinateFirst => (y, x),
            Pihajoki::MomentumFirst => (x, y),
        };
        Point {
            q: with_q.q.clone(),
            p: with_p.p.clone(),
        }
    }
}
