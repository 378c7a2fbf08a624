//! Kicks with a force that depends on momenta.
//!
//! Input: a prepared system and a coefficient. Output: [`Pushing`], by core's flows of such kicks. Invariant: a flow
//! allocates its scratch when it is first applied.

use crate::folded::Folded;
use crate::machine::{Arrays, Home, Registers};
use crate::prepared::{Flat, Prepared, at};
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
        let home = Home::Pool(&self.prepared.pool);
        self.folded.evaluate(&self.prepared, home, arrays);
    }
}

/// The part of a kick that reads momenta.
#[derive(Debug, Clone)]
pub(crate) enum Pushing<T: Real> {
    /// An exact flow in place. The kick of the rest follows.
    Damped(Folded<T>),
    /// The exact flow of momenta that push each other.
    Coupled(Box<Coupled<Rates<T>, Rates<T>>>),
    /// A symmetric sub-step.
    Stepped(Box<SubStep<Rates<T>>>),
}

/// Scratch momenta of a series or of a sub-step.
type Momenta<T> = <SubStep<Rates<T>> as Flow<Point<Flat<T>>>>::Work;

/// The scratch of a flow.
#[derive(Debug)]
pub struct PartWork<T: Real> {
    pub(crate) registers: Registers<T>,
    momenta: Option<Momenta<T>>,
}

impl<T: Real> Scratch<Point<Flat<T>>> for PartWork<T> {
    fn like(_: &Point<Flat<T>>) -> Self {
        PartWork {
            registers: Registers::new(),
            momenta: None,
        }
    }
}

impl<T: Real> Pushing<T> {
    /// The part of the kick of a system for a coefficient; `None` if no momentum is read.
    pub(crate) fn new(prepared: &Prepared<T>, c: T) -> Option<Self> {
        let rates = |purpose| Rates::new(prepared, purpose, c);
        Some(match prepared.code.kick? {
            Kick::Plain => return None,
            Kick::Damped { .. } => Pushing::Damped(Folded::new(prepared, Purpose::Push, c)),
            Kick::Coupled => Pushing::Coupled(Box::new(Coupled {
                field: rates(Purpose::Rates),
                linear: rates(Purpose::Linear),
            })),
            Kick::SubStep => Pushing::Stepped(Box::new(SubStep(rates(Purpose::Rates)))),
        })
    }

    /// Moves the momenta; compiled once for all flows.
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
            Pushing::Damped(folded) => {
                let arrays = Arrays {
                    t,
                    into_q: x.q.as_mut_slice(),
                    into_p: x.p.as_mut_slice(),
                    ..Arrays::none()
                };
                folded.evaluate(prepared, Home::Own(&mut work.registers), arrays);
            }
            Pushing::Coupled(flow) => {
                let momenta = work.momenta.get_or_insert_with(|| Scratch::like(x));
                flow.apply(t, x, momenta);
            }
            Pushing::Stepped(flow) => {
                let momenta = work.momenta.get_or_insert_with(|| Scratch::like(x));
                flow.apply(t, x, momenta);
            }
        }
    }
}
