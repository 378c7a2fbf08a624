//! Splittings of H = T(p, t) + V(q, t) into drift and kick.
//!
//! Input: a [`Separable`] system. Output: [`StormerVerlet`], [`SymplecticEuler`]. Invariant: each
//! is a [`Splitting`] and the piece that moves first; the loop is [`Zigzag`]'s.

use super::splitting::{Durations, Splitting, Weight};
use super::strang::Strang;
use super::zigzag::{Zigzag, ZigzagOf};
use crate::flows::map::{Choice, Either, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, OneStep, Scheme};
use crate::systems::state::{Point, State};
use crate::systems::system::{Description, Dynamics, Separable, System, VectorOf};
use core::fmt::{self, Debug};
use core::marker::PhantomData;
use hamiltonian_lanes::Real;

/// Störmer–Verlet (leapfrog): order 2, symplectic, time-reversible; equations (27).
///
/// (27d–f), kick–drift–kick, one ∂V/∂q a step:
///
/// ```text
/// p ← p − h/2 ∂V/∂q(q, t);   q ← q + h ∂T/∂p(p, t + h/2);   p ← p − h/2 ∂V/∂q(q, t + h)
/// ```
///
/// (27a–c), drift–kick–drift, is the same with the roles exchanged:
///
/// ```text
/// q ← q + h/2 ∂T/∂p(p, t);   p ← p − h ∂V/∂q(q, t + h/2);   q ← q + h/2 ∂T/∂p(p, t + h)
/// ```
///
/// The last piece of a step and the first of the next are one. Preserves dq∧dp.
///
/// If V jumps at times that do not depend on the state, and T does not, steps begin with the drift in either setting;
/// if only T jumps, with the kick.
///
/// Source: L. Verlet, Phys. Rev. 159 (1967) 98, eq. 4, doi:10.1103/PhysRev.159.98; E. Hairer,
/// C. Lubich, G. Wanner, Acta Numerica 12 (2003) 399, eqs. 1.5 and 1.6,
/// doi:10.1017/S0962492902000144.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
/// let end = run.advance(100)?;
/// // The error of 100 steps is near h²t/24 = 4e-6.
/// assert!((end.q[0] - 1.0_f64.cos()).abs() < 5e-6);
/// # Ok::<(), Error>(())
/// ```
///
/// The order is part of the type, so that a program contains the one that it names.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct StormerVerlet<const KICK_FIRST: bool = true>(());

/// The order kick, drift, kick.
impl Default for StormerVerlet {
    fn default() -> Self {
        StormerVerlet::KickDriftKick
    }
}

#[expect(
    non_upper_case_globals,
    reason = "they are used as the variants of an enum"
)]
impl StormerVerlet {
    /// Kick, drift, kick: (27d–f). This is the default.
    pub const KickDriftKick: Self = StormerVerlet(());
}

#[expect(
    non_upper_case_globals,
    reason = "they are used as the variants of an enum"
)]
impl StormerVerlet<false> {
    /// Drift, kick, drift: (27a–c).
    pub const DriftKickDrift: Self = StormerVerlet(());
}

/// The name of the order.
impl<const KICK_FIRST: bool> Debug for StormerVerlet<KICK_FIRST> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match KICK_FIRST {
            true => "KickDriftKick",
            false => "DriftKickDrift",
        })
    }
}

impl<const KICK_FIRST: bool> Listed for StormerVerlet<KICK_FIRST> {
    fn entry(&self) -> Entry {
        let (variant, equations) = match KICK_FIRST {
            true => ("kick-drift-kick", "27d-f"),
            false => ("drift-kick-drift", "27a-c"),
        };
        Entry {
            name: "StormerVerlet",
            variant,
            equations,
            order: 2,
            duration: 1,
            needs: Needs::SEPARABLE,
            preserves: Form::OnePoint,
            source: "Verlet 1967, eq. 4, doi:10.1103/PhysRev.159.98",
        }
    }
}

/// Returns true if a step begins with the kick: a piece that jumps in time is not first.
const fn is_kick_first(kick_first: bool, jumps: [bool; 2]) -> bool {
    match jumps {
        [true, false] => false,
        [false, true] => true,
        _ => kick_first,
    }
}

/// The order of [`StormerVerlet`] on `S`, as far as types decide it.
#[derive(Debug, Clone)]
pub struct OrderOn<S, const KICK_FIRST: bool>(PhantomData<S>);

impl<S: System, const KICK_FIRST: bool> Choice for OrderOn<S, KICK_FIRST> {
    const IS_FIRST: Option<bool> = match S::JUMPS {
        Some(jumps) => Some(is_kick_first(KICK_FIRST, jumps)),
        None => None,
    };
}

impl<S: Separable, const KICK_FIRST: bool> Scheme<S> for StormerVerlet<KICK_FIRST> {
    type Carried = Point<S::Shape>;
    type Map<T: Real> = Either<
        ZigzagOf<T, S, (S::Kick<T>, S::Drift<T>), Strang>,
        ZigzagOf<T, S, (S::Drift<T>, S::Kick<T>), Strang>,
        OrderOn<S, KICK_FIRST>,
    >;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        let [kick, drift] = of.jumps;
        match is_kick_first(KICK_FIRST, of.jumps) {
            true => Strang.times_on([kick, drift]),
            false => Strang.times_on([drift, kick]),
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        // No code is compiled for an order that the type excludes.
        if const { !OrderOn::<S, KICK_FIRST>::MAY_BE_SECOND }
            || const { OrderOn::<S, KICK_FIRST>::MAY_BE_FIRST }
                && is_kick_first(KICK_FIRST, prepared.description().jumps)
        {
            let pieces = (S::kick::<T>(), S::drift::<T>());
            Either::First(Zigzag::new(&Strang, &pieces, prepared, step))
        } else {
            let pieces = (S::drift::<T>(), S::kick::<T>());
            Either::second(Zigzag::new(&Strang, &pieces, prepared, step))
        }
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

symmetric!(StormerVerlet<KICK_FIRST>, const KICK_FIRST: bool);

/// Symplectic Euler: order 1, symplectic; one kick and one drift a step.
///
/// Kick first: `p ← p − h ∂V/∂q(q, t)`, then `q ← q + h ∂T/∂p(p, t + h)`. Drift first:
/// `q ← q + h ∂T/∂p(p, t)`, then `p ← p − h ∂V/∂q(q, t + h)`. Each is the other's adjoint.
/// Preserves dq∧dp.
///
/// Source: R. de Vogelaere, report 4, Univ. of Notre Dame (1956); R. Ruth, IEEE Trans. Nucl. Sci.
/// 30 (1983) 2669, doi:10.1109/TNS.1983.4332919.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::SymplecticEuler;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, SymplecticEuler::default(), start, 0.01)?;
/// // One step: p = −0.01, q = 1 − 0.01².
/// assert_eq!(run.advance(1)?.q[0], 1.0 - 0.01 * 0.01);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SymplecticEuler {
    /// Kick, then drift.
    #[default]
    KickDrift,
    /// Drift, then kick.
    DriftKick,
}

impl Listed for SymplecticEuler {
    fn entry(&self) -> Entry {
        const KICK_FIRST: Entry = Entry {
            name: "SymplecticEuler",
            variant: "kick-drift",
            equations: "",
            order: 1,
            duration: 1,
            needs: Needs::SEPARABLE,
            preserves: Form::OnePoint,
            source: "Ruth 1983, doi:10.1109/TNS.1983.4332919",
        };
        match self {
            SymplecticEuler::KickDrift => KICK_FIRST,
            SymplecticEuler::DriftKick => Entry {
                variant: "drift-kick",
                ..KICK_FIRST
            },
        }
    }
}

impl OneStep for SymplecticEuler {
    type Adjoint = Self;
    fn adjoint(&self) -> Self {
        match self {
            SymplecticEuler::KickDrift => SymplecticEuler::DriftKick,
            SymplecticEuler::DriftKick => SymplecticEuler::KickDrift,
        }
    }
}

/// The drift is outermost: composed with its adjoint, kick–drift ends with the piece with which the
/// adjoint begins, and both are one flow.
impl Splitting for SymplecticEuler {
    type Of<U> = [U; 1];
    #[cfg_attr(not(unoptimised), inline(always))]
    fn stages(&self) -> [Durations; 1] {
        const NONE: Weight = Weight(0.0, 0.0);
        const WHOLE: Weight = Weight(1.0, 0.0);
        match self {
            SymplecticEuler::KickDrift => [(NONE, WHOLE)],
            SymplecticEuler::DriftKick => [(WHOLE, NONE)],
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn filled<U: Clone>(&self, value: U) -> [U; 1] {
        [value]
    }
}

impl<S: Separable> Scheme<S> for SymplecticEuler {
    type Carried = Point<S::Shape>;
    type Map<T: Real> = ZigzagOf<T, S, (S::Drift<T>, S::Kick<T>), Self>;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        let [kick, drift] = of.jumps;
        self.times_on([drift, kick])
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Zigzag::new(self, &(S::drift::<T>(), S::kick::<T>()), prepared, step)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare_after<T: Real>(
        &self,
        before: &Self,
        prepared: &S::Prepared<T>,
        step: Step<T>,
    ) -> Option<Self::Map<T>> {
        let pieces = (S::drift::<T>(), S::kick::<T>());
        Some(Zigzag::after(before, self, &pieces, prepared, step))
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
