//! The vector field and the flows of pieces, for a step coefficient.
//!
//! Input: a prepared system and a coefficient. Output: [`Field`], [`PartFlow`], and [`Pieces`] of a splitting. Invariant:
//! the numbers of the coefficient are computed when a flow is made; nothing allocates when it moves a point.

use crate::code::Part;
use crate::folded::Folded;
use crate::machine::{Arrays, Home};
use crate::prepared::{Flat, Prepared, at};
use crate::pushing::{PartWork, Pushing};
use hamiltonian_core::Vector;
use hamiltonian_core::schemes::author::{Dynamics, Flow, Point, VectorField};
use hamiltonian_lanes::Real;
use hamiltonian_language::analyse::structure::FieldSource;
use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::program::Purpose;

/// The vector field of a system that is defined at run time, scaled by a step coefficient.
#[derive(Debug, Clone)]
pub struct Field<T: Real> {
    prepared: Prepared<T>,
    c: T,
    /// The kick and the drift, or the field.
    parts: Vec<Folded<T>>,
}

impl<T: Real> Field<T> {
    pub(crate) fn new(prepared: &Prepared<T>, c: T) -> Self {
        let purposes: &[Purpose] = match prepared.code.field {
            FieldSource::Halves => &[Purpose::Kick, Purpose::Drift],
            FieldSource::Whole => &[Purpose::VectorField],
            FieldSource::OfGradient => &[],
        };
        let parts = purposes.iter();
        let parts = parts.map(|purpose| Folded::new(prepared, *purpose, c));
        Field {
            parts: parts.collect(),
            prepared: prepared.clone(),
            c,
        }
    }
}

impl<T: Real> VectorField<Flat<T>> for Field<T> {
    #[inline(always)]
    fn add(&self, t: T, q: &Flat<T>, p: &Flat<T>, into_q: &mut Flat<T>, into_p: &mut Flat<T>) {
        if self.parts.is_empty() {
            let (mut x, mut y) = (into_q.clone(), into_p.clone());
            let _ = self.prepared.energy_and_gradient(t, q, p, &mut x, &mut y);
            into_q.accumulate(self.c, &y);
            into_p.accumulate(-self.c, &x);
        }
        for part in &self.parts {
            let arrays = Arrays {
                into_q: into_q.as_mut_slice(),
                into_p: into_p.as_mut_slice(),
                ..at(t, q, p)
            };
            part.evaluate(&self.prepared, Home::Pool(&self.prepared.pool), arrays);
        }
    }
}

/// The flow of a piece of H for a duration.
#[derive(Debug, Clone)]
pub struct PartFlow<T: Real> {
    pub(crate) prepared: Prepared<T>,
    part: Part,
    /// The side that is read, if the other one alone moves.
    one_way: Option<Side>,
    pub(crate) folded: Folded<T>,
    /// The part of a kick that reads momenta, before the rest.
    pub(crate) pushing: Option<Pushing<T>>,
}

impl<T: Real> PartFlow<T> {
    pub(crate) fn new(prepared: &Prepared<T>, part: Part, c: T) -> Self {
        PartFlow {
            prepared: prepared.clone(),
            part,
            one_way: match part {
                Part::Kick => Some(Side::Q),
                Part::Drift => Some(Side::P),
                Part::Piece(number) => prepared.code.one_way[number],
            },
            folded: Folded::new(prepared, PartFlow::<T>::purpose(part), c),
            pushing: match part {
                Part::Kick => Pushing::new(prepared, c),
                Part::Drift | Part::Piece(_) => None,
            },
        }
    }

    fn purpose(part: Part) -> Purpose {
        match part {
            Part::Kick => Purpose::Kick,
            Part::Drift => Purpose::Drift,
            Part::Piece(number) => Purpose::Piece(number as u16),
        }
    }

    /// The number of its function.
    pub(crate) fn number(&self) -> Option<usize> {
        self.prepared.code.number(PartFlow::<T>::purpose(self.part))
    }
}

impl<T: Real> Flow<Point<Flat<T>>> for PartFlow<T> {
    const NAME: &'static str = "a piece of H";
    /// The pieces know which of their flows merge.
    const MERGES: bool = false;
    type Work = PartWork<T>;

    #[inline(always)]
    fn apply(&self, t: T, x: &mut Point<Flat<T>>, work: &mut PartWork<T>) {
        if let Some(pushing) = &self.pushing {
            pushing.apply(&self.prepared, t, x, work);
        }
        let (q, p) = (&mut x.q, &mut x.p);
        let point = Arrays {
            t,
            ..Arrays::none()
        };
        let arrays = match self.one_way {
            Some(Side::Q) => Arrays {
                q: q.as_slice(),
                into_p: p.as_mut_slice(),
                ..point
            },
            Some(Side::P) => Arrays {
                p: p.as_slice(),
                into_q: q.as_mut_slice(),
                ..point
            },
            None => Arrays {
                into_q: q.as_mut_slice(),
                into_p: p.as_mut_slice(),
                ..point
            },
        };
        self.folded
            .evaluate(&self.prepared, Home::Own(&mut work.registers), arrays);
    }
}

/// The flows of pieces one after the other.
#[derive(Debug, Clone)]
pub struct Inside<T: Real>(pub(crate) Vec<PartFlow<T>>);

impl<T: Real> Flow<Point<Flat<T>>> for Inside<T> {
    const NAME: &'static str = "the inner pieces of H";
    type Work = PartWork<T>;

    #[inline(always)]
    fn apply(&self, t: T, x: &mut Point<Flat<T>>, work: &mut PartWork<T>) {
        for flow in &self.0 {
            flow.apply(t, x, work);
        }
    }
}
