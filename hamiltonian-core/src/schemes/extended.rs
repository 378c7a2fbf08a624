//! Splittings in the phase space of two copies, (q, q̃, p, p̃): explicit for every H.
//!
//! Input: a system without forces. Output: [`Pihajoki`], and [`Cross`], the two pieces of
//! H(q, p̃) + H(q̃, p) for every splitting of the doubled space. Invariant: each piece is a flow of H
//! whose arguments are one half of each copy; the loop is [`Zigzag`]'s.

use super::strang::Strang;
use super::zigzag::Zigzag;
use crate::flows::map::{Either, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::{Flow, Piece, Pieces, VectorField};
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::{Dynamics, System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// Two copies (q, p) and (q̃, p̃) of a point; the first is the observed one.
pub type Copies<V> = Pair<Point<V>, Point<V>>;

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
/// Preserves dq∧dp + dq̃∧dp̃ in the extended space, which is *not* dq∧dp of the state that is seen: **the
/// copies part**, on H = ½(q²+1)(p²+1) from (−3, 0) by 2.7 at t = 4. Watch
/// [`Integrator::copy_distance`](crate::Integrator::copy_distance). (Pihajoki's mixing maps are
/// not in the paper's equations, nor here.)
///
/// Source: P. Pihajoki, Celest. Mech. Dyn. Astron. 121 (2015) 211,
/// doi:10.1007/s10569-014-9597-9.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Pihajoki;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, Pihajoki::default(), start, 0.01)?;
/// run.advance(100)?;
/// // On a separable system the copies are the two Störmer–Verlets, O(h²) apart.
/// assert!(run.copy_distance() < 1e-4);
/// # Ok::<(), Error>(())
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
    fn entry(&self) -> Entry {
        const COORDINATE_FIRST: Entry = Entry {
            name: "Pihajoki",
            variant: "coordinate first",
            equations: "29",
            order: 2,
            duration: 1,
            needs: Needs::UNFORCED,
            preserves: Form::TwoCopies,
            source: "Pihajoki 2015, doi:10.1007/s10569-014-9597-9",
        };
        match self {
            Pihajoki::CoordinateFirst => COORDINATE_FIRST,
            Pihajoki::MomentumFirst => Entry {
                variant: "momentum first",
                equations: "30",
                ..COORDINATE_FIRST
            },
        }
    }
}

symmetric!(Pihajoki);

/// H(q, p̃), which moves q̃ and p, where `FIRST`; else H(q̃, p), which moves q and p̃.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cross<const FIRST: bool>;

/// The flow of a [`Cross`].
#[derive(Debug, Clone)]
pub struct Crossed<F, const FIRST: bool>(F);

impl<V: Vector, F: VectorField<V>, const FIRST: bool> Flow<Copies<V>> for Crossed<F, FIRST> {
    const NAME: &'static str = if FIRST { "H(q, p̃)" } else { "H(q̃, p)" };
    type Work = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: V::Scalar, z: &mut Copies<V>, _: &mut ()) {
        let Pair { x, y } = z;
        if FIRST {
            self.0.add(t, &x.q, &y.p, &mut y.q, &mut x.p);
        } else {
            self.0.add(t, &y.q, &x.p, &mut x.q, &mut y.p);
        }
    }
}

impl<T: Real, P: Dynamics<T>, const FIRST: bool> Piece<T, P> for Cross<FIRST> {
    type Point = Copies<P::Vector>;
    type Flow = Crossed<P::Field, FIRST>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn flow(&self, prepared: &P, c: T) -> Self::Flow {
        Crossed(prepared.field(c))
    }
}

/// The map of a table on H(q, p̃) + H(q̃, p), with `A` outermost.
pub(super) type Doubled<T, S, A, B, W> = Zigzag<
    Copies<VectorOf<S, T>>,
    <(A, B) as Pieces<T, <S as System>::Prepared<T>>>::Outer,
    <(A, B) as Pieces<T, <S as System>::Prepared<T>>>::Inner,
    W,
>;

impl<S: System + Unforced> Scheme<S> for Pihajoki {
    type Carried = Copies<S::Shape>;
    type Map<T: Real> = Either<
        Doubled<T, S, Cross<false>, Cross<true>, Strang>,
        Doubled<T, S, Cross<true>, Cross<false>, Strang>,
    >;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let (first, second) = (Cross::<true>, Cross::<false>);
        match self {
            Pihajoki::CoordinateFirst => {
                Either::First(Zigzag::new(&Strang, &(second, first), prepared, step))
            }
            Pihajoki::MomentumFirst => {
                Either::second(Zigzag::new(&Strang, &(first, second), prepared, step))
            }
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Copies<VectorOf<S, T>> {
        Pair {
            x: state.point(),
            y: state.point(),
        }
    }
}
