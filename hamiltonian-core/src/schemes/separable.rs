//! Splittings of H = T(p, t) + V(q, t) into drift and kick.
//!
//! Input: a [`Separable`] system. Output: [`StormerVerlet`], [`SymplecticEuler`]. Invariant: each
//! is a [`Table`] and the half that is moved first; the loop is [`Splitting`]'s.

use super::splitting::{Drifting, Kicking, Splitting, Table, Weight};
use crate::scheme::{Clock, Entry, Form, Listed, Needs, Scheme, Stepper, Unsolved};
use crate::state::{Pair, State};
use crate::system::{Drift, Kick, Separable, System};
use crate::vector::Vector;
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
/// Source: L. Verlet, Phys. Rev. 159 (1967) 98, eq. 4, doi:10.1103/PhysRev.159.98; E. Hairer,
/// C. Lubich, G. Wanner, Acta Numerica 12 (2003) 399, eqs. 1.5 and 1.6,
/// doi:10.1017/S0962492902000144.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, State, schemes::StormerVerlet};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, StormerVerlet::default(), start, 0.01)?;
/// let end = run.advance(100)?;
/// // The error of 100 steps is near h²t/24 = 4e-6.
/// assert!((end.q[0] - 1.0_f64.cos()).abs() < 5e-6);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StormerVerlet {
    /// Kick, drift, kick: (27d–f).
    #[default]
    KickDriftKick,
    /// Drift, kick, drift: (27a–c).
    DriftKickDrift,
}

/// Half of the first piece, the whole of the second, half of the first.
pub(super) const LEAPFROG: Table<1> = Table {
    opening: Weight(0.5, 0.0),
    stages: [(Weight(1.0, 0.0), Weight(0.5, 0.0))],
};

impl Listed for StormerVerlet {
    fn entry(&self) -> &'static Entry {
        const KICK_FIRST: Entry = Entry {
            name: "StormerVerlet",
            variant: "kick-drift-kick",
            equations: "27d-f",
            order: 2,
            duration: 1,
            needs: Needs::Separable,
            preserves: Form::OnePoint,
            source: "Verlet 1967, eq. 4, doi:10.1103/PhysRev.159.98",
        };
        match self {
            StormerVerlet::KickDriftKick => &KICK_FIRST,
            StormerVerlet::DriftKickDrift => &Entry {
                variant: "drift-kick-drift",
                equations: "27a-c",
                ..KICK_FIRST
            },
        }
    }
}

impl<T: Real, S: Separable<T>> Scheme<T, S> for StormerVerlet {
    type Stepper = Alternation<S::Vector, S::Kick, S::Drift, 1>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        match self {
            StormerVerlet::KickDriftKick => {
                Alternation::kick_first::<S>(&LEAPFROG, prepared, start, step)
            }
            StormerVerlet::DriftKickDrift => {
                Alternation::drift_first::<S>(&LEAPFROG, prepared, start, step)
            }
        }
    }
}

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
/// use hamiltonian_core::{Integrator, State, schemes::SymplecticEuler};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, SymplecticEuler::default(), start, 0.01)?;
/// // One step: p = −0.01, q = 1 − 0.01².
/// assert_eq!(run.advance(1)?.q[0], 1.0 - 0.01 * 0.01);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SymplecticEuler {
    /// Kick, then drift.
    #[default]
    KickDrift,
    /// Drift, then kick.
    DriftKick,
}

/// The whole of the first piece, the whole of the second.
pub(super) const EULER: Table<1> = Table {
    opening: Weight(1.0, 0.0),
    stages: [(Weight(1.0, 0.0), Weight(0.0, 0.0))],
};

impl Listed for SymplecticEuler {
    fn entry(&self) -> &'static Entry {
        const KICK_FIRST: Entry = Entry {
            name: "SymplecticEuler",
            variant: "kick-drift",
            equations: "",
            order: 1,
            duration: 1,
            needs: Needs::Separable,
            preserves: Form::OnePoint,
            source: "Ruth 1983, doi:10.1109/TNS.1983.4332919",
        };
        match self {
            SymplecticEuler::KickDrift => &KICK_FIRST,
            SymplecticEuler::DriftKick => &Entry {
                variant: "drift-kick",
                ..KICK_FIRST
            },
        }
    }
}

impl<T: Real, S: Separable<T>> Scheme<T, S> for SymplecticEuler {
    type Stepper = Alternation<S::Vector, S::Kick, S::Drift, 1>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        match self {
            SymplecticEuler::KickDrift => {
                Alternation::kick_first::<S>(&EULER, prepared, start, step)
            }
            SymplecticEuler::DriftKick => {
                Alternation::drift_first::<S>(&EULER, prepared, start, step)
            }
        }
    }
}

/// The stepper of every splitting into kick and drift.
#[derive(Debug, Clone)]
pub enum Alternation<V: Vector, K: Kick<V>, D: Drift<V>, const STAGES: usize> {
    /// p is moved first; x is p, y is q.
    KickFirst(Splitting<V, V, Kicking<K>, Drifting<D>, STAGES>),
    /// q is moved first; x is q, y is p.
    DriftFirst(Splitting<V, V, Drifting<D>, Kicking<K>, STAGES>),
}

impl<V: Vector, K: Kick<V>, D: Drift<V>, const STAGES: usize> Alternation<V, K, D, STAGES> {
    /// The table with a kick as its opening piece.
    pub fn kick_first<S>(
        table: &Table<STAGES>,
        prepared: &<S as System<V::Scalar>>::Prepared,
        start: &State<V>,
        step: V::Scalar,
    ) -> Self
    where
        S: Separable<V::Scalar, Vector = V, Kick = K, Drift = D>,
    {
        Alternation::KickFirst(Splitting::new(
            table,
            Clock {
                start: start.t,
                interval: step,
            },
            0.0,
            Pair {
                x: start.p.clone(),
                y: start.q.clone(),
            },
            |c| Kicking(S::kick(prepared, c)),
            |c| Drifting(S::drift(prepared, c)),
        ))
    }

    /// The table with a drift as its opening piece.
    pub fn drift_first<S>(
        table: &Table<STAGES>,
        prepared: &<S as System<V::Scalar>>::Prepared,
        start: &State<V>,
        step: V::Scalar,
    ) -> Self
    where
        S: Separable<V::Scalar, Vector = V, Kick = K, Drift = D>,
    {
        Alternation::DriftFirst(Splitting::new(
            table,
            Clock {
                start: start.t,
                interval: step,
            },
            0.0,
            Pair {
                x: start.q.clone(),
                y: start.p.clone(),
            },
            |c| Drifting(S::drift(prepared, c)),
            |c| Kicking(S::kick(prepared, c)),
        ))
    }
}

impl<V: Vector, K: Kick<V>, D: Drift<V>, const STAGES: usize> Stepper
    for Alternation<V, K, D, STAGES>
{
    type Vector = V;
    type Carried = Pair<V, V>;

    #[inline(always)]
    fn carried(&self) -> &Pair<V, V> {
        match self {
            Alternation::KickFirst(splitting) => splitting.carried(),
            Alternation::DriftFirst(splitting) => splitting.carried(),
        }
    }

    #[inline(always)]
    fn carried_mut(&mut self) -> &mut Pair<V, V> {
        match self {
            Alternation::KickFirst(splitting) => splitting.carried_mut(),
            Alternation::DriftFirst(splitting) => splitting.carried_mut(),
        }
    }

    #[inline(always)]
    fn run(&mut self, made: u64, n: u64) -> Result<(), Unsolved> {
        match self {
            Alternation::KickFirst(splitting) => splitting.run(made, n),
            Alternation::DriftFirst(splitting) => splitting.run(made, n),
        }
        Ok(())
    }

    #[inline(always)]
    fn synchronise(&mut self, made: u64, q: &mut V, p: &mut V) {
        let (from_q, from_p) = match self {
            Alternation::KickFirst(splitting) => {
                let (x, y) = splitting.synchronise(made);
                (y, x)
            }
            Alternation::DriftFirst(splitting) => splitting.synchronise(made),
        };
        q.copy_from(from_q);
        p.copy_from(from_p);
    }
}
