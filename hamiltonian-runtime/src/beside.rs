//! Flows that are not one function: kicks with a force that depends on momenta, and matrix exponentials.
//!
//! Input: a prepared system and a coefficient. Output: [`Beside`], by core's flows of such kicks, or by a [`Matrix`].
//! Invariant: a flow allocates its scratch when it is first applied.

use crate::folded::Folded;
use crate::machine::Arrays;
use crate::matrix::Matrix;
use crate::prepared::{Flat, Prepared, at};
use crate::registers::Registers;
use hamiltonian_core::private::{Coupled, SubStep};
use hamiltonian_core::schemes::author::{Flow, Point, Scratch, VectorField};
use hamiltonian_lanes::Real;
use hamiltonian_language::analyse::structure::Kick;
use hamiltonian_symbolic::program::Purpose;

/// The rates of momenta at fixed coordinates, times a coefficient.
#[derive(Debug, Clone)]
pub(crate) struct Rates<T: Real> {
    prepared: Prepared<T>,
    folded: Folded<T>,
}

impl<T: Real> Rates<T> {
    fn new(prepared: &Prepared<T>, purpose: Purpose, c: T) -> Self {
        Rates {
            prepared: prepared.clone(),
            folded: Folded::new(prepared, purpose, c),
        }
    }
}

impl<T: Real> VectorField<Flat<T>> for Rates<T> {
    #[inline(always)]
    fn add(&self, t: T, q: &Flat<T>, p: &Flat<T>, into_q: &mut Flat<T>, into_p: &mut Flat<T>) {
        let arrays = Arrays {
            into_q: into_q.as_mut_slice(),
            into_p: into_p.as_mut_slice(),
            ..at(t, q, p)
        };
        self.folded.evaluate(&self.prepared, arrays);
    }
}

/// What moves a point before the function of a flow does.
#[derive(Debug, Clone)]
pub(crate) enum Beside<T: Real> {
    /// An exact flow in place. The kick of the rest follows.
    Damped(Folded<T>),
    /// The exact flow of momenta that push each other.
    Coupled(Box<Coupled<Rates<T>, Rates<T>>>),
    /// A symmetric sub-step.
    Stepped(Box<SubStep<Rates<T>>>),
    /// The flow of a quadratic form. No function follows.
    Exponential(Matrix<T>),
}

/// Scratch momenta of a series or of a sub-step.
type Momenta<T> = <SubStep<Rates<T>> as Flow<Point<Flat<T>>>>::Work;

/// The scratch of a flow.
#[derive(Debug)]
pub struct PartWork<T: Real> {
    pub(crate) registers: Registers<T>,
    momenta: Option<Momenta<T>>,
    /// A point of one vector, and its image.
    phase: [Vec<T>; 2],
}

impl<T: Real> Scratch<Point<Flat<T>>> for PartWork<T> {
    fn like(_: &Point<Flat<T>>) -> Self {
        PartWork {
            registers: Registers::new(),
            momenta: None,
            phase: [Vec::new(), Vec::new()],
        }
    }
}

impl<T: Real> Beside<T> {
    /// The part of the kick of a system that reads momenta, for a coefficient; `None` if no momentum is read.
    pub(crate) fn of_kick(prepared: &Prepared<T>, c: T) -> Option<Self> {
        let rates = |purpose| Rates::new(prepared, purpose, c);
        Some(match prepared.code.kick? {
            Kick::Plain => return None,
            Kick::Damped { .. } => Beside::Damped(Folded::new(prepared, Purpose::Push, c)),
            Kick::Coupled => Beside::Coupled(Box::new(Coupled {
                field: rates(Purpose::Rates),
                linear: rates(Purpose::Linear),
            })),
            Kick::SubStep => Beside::Stepped(Box::new(SubStep(rates(Purpose::Rates)))),
        })
    }

    /// Moves the point; compiled once for all flows.
    #[inline(always)]
    pub(crate) fn apply(
        &self,
        prepared: &Prepared<T>,
        t: T,
        x: &mut Point<Flat<T>>,
        work: &mut PartWork<T>,
    ) {
        T::out_of_line(
            #[inline(always)]
            || self.apply_here(prepared, t, x, work),
        );
    }

    #[inline(always)]
    fn apply_here(
        &self,
        prepared: &Prepared<T>,
        t: T,
        x: &mut Point<Flat<T>>,
        work: &mut PartWork<T>,
    ) {
        match self {
            Beside::Damped(folded) => {
                let arrays = Arrays {
                    t,
                    into_q: x.q.as_mut_slice(),
                    into_p: x.p.as_mut_slice(),
                    ..Arrays::none()
                };
                folded.evaluate_in(&mut work.registers, prepared, arrays);
            }
            Beside::Coupled(flow) => {
                let momenta = work.momenta.get_or_insert_with(|| Scratch::like(x));
                flow.apply(t, x, momenta);
            }
            Beside::Stepped(flow) => {
                let momenta = work.momenta.get_or_insert_with(|| Scratch::like(x));
                flow.apply(t, x, momenta);
            }
            Beside::Exponential(matrix) => matrix.apply(x, &mut work.phase),
        }
    }
}
