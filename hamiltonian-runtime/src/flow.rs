//! The vector field and the flows of pieces, for a step coefficient.
//!
//! Input: a prepared system and a coefficient. Output: [`Field`], [`PartFlow`], and [`Pieces`] of a splitting. Invariant:
//! the numbers of the coefficient are computed when a flow is made; nothing allocates when it moves a point.

use crate::beside::{Beside, PartWork};
use crate::code::Part;
use crate::folded::Folded;
use crate::machine::Arrays;
use crate::matrix::Matrix;
use crate::op::FunctionCode;
use crate::prepared::{Flat, Prepared, at};
use crate::registers::Home;
use hamiltonian_core::Vector;
use hamiltonian_core::private::raised;
use hamiltonian_core::schemes::author::{Dynamics, Flow, Point, Scratch, VectorField};
use hamiltonian_lanes::Real;
use hamiltonian_language::analyse::structure::FieldSource;
use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::program::Purpose;
use std::sync::Arc;

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
        match &*self.parts {
            [whole] => {
                let arrays = Arrays {
                    into_q: into_q.as_mut_slice(),
                    into_p: into_p.as_mut_slice(),
                    ..at(t, q, p)
                };
                whole.evaluate(&self.prepared, arrays);
            }
            _ => {
                self.add_half::<true>(t, q, into_p);
                self.add_half::<false>(t, p, into_q);
            }
        }
    }
    #[inline(always)]
    fn has_halves(&self) -> bool {
        self.parts.len() == 2
    }
    #[inline(always)]
    fn add_half<const KICKS: bool>(&self, t: T, from: &Flat<T>, into: &mut Flat<T>) {
        let (from, into) = (from.as_slice(), into.as_mut_slice());
        let none = Arrays {
            t,
            ..Arrays::none()
        };
        let (part, arrays) = match (&*self.parts, KICKS) {
            ([kick, _], true) => (
                kick,
                Arrays {
                    q: from,
                    into_p: into,
                    ..none
                },
            ),
            ([_, drift], false) => (
                drift,
                Arrays {
                    p: from,
                    into_q: into,
                    ..none
                },
            ),
            _ => return,
        };
        part.evaluate(&self.prepared, arrays);
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
    /// What moves the point before.
    pub(crate) beside: Option<Beside<T>>,
    /// The function with loops from their last iteration to the first, if their terms do not commute.
    pub(crate) backward: Option<Arc<FunctionCode>>,
}

impl<T: Real> PartFlow<T> {
    pub(crate) fn new(prepared: &Prepared<T>, part: Part, c: T) -> Self {
        let mut flow = PartFlow::of_function(prepared, part, c);
        match part {
            Part::Kick => flow.beside = Beside::of_kick(prepared, c),
            Part::Piece(number) if prepared.code.flows[number].is_exponential => {
                let rates = PartFlow::of_function(prepared, part, raised(c));
                let mut work = None;
                let matrix = Matrix::new(prepared.code.places.len, |point| {
                    let work = work.get_or_insert_with(|| PartWork::like(point));
                    rates.apply(T::zero(), point, work);
                });
                flow.beside = Some(Beside::Exponential(matrix));
                flow.folded.function = None;
            }
            Part::Drift | Part::Piece(_) => {}
        }
        flow
    }

    /// What the function of a part does.
    fn of_function(prepared: &Prepared<T>, part: Part, c: T) -> Self {
        let of_piece = match part {
            Part::Piece(number) => Some(&prepared.code.flows[number]),
            Part::Kick | Part::Drift => None,
        };
        PartFlow {
            prepared: prepared.clone(),
            part,
            one_way: match part {
                Part::Kick => Some(Side::Q),
                Part::Drift => Some(Side::P),
                Part::Piece(_) => of_piece.and_then(|flow| flow.one_way),
            },
            folded: Folded::new(prepared, PartFlow::<T>::purpose(part), c),
            beside: None,
            backward: of_piece.and_then(|flow| flow.backward.clone()),
        }
    }

    /// The flow with loops from their last iteration to the first.
    pub(crate) fn reversed(mut self) -> Self {
        if self.backward.is_some() {
            std::mem::swap(&mut self.folded.function, &mut self.backward);
        }
        self
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
        self.apply_by(self.folded.function.as_ref(), t, x, work);
    }

    #[inline(always)]
    fn apply_reversed(&self, t: T, x: &mut Point<Flat<T>>, work: &mut PartWork<T>) {
        let function = self.backward.as_ref().or(self.folded.function.as_ref());
        self.apply_by(function, t, x, work);
    }
}

impl<T: Real> PartFlow<T> {
    #[inline(always)]
    fn apply_by(
        &self,
        function: Option<&Arc<FunctionCode>>,
        t: T,
        x: &mut Point<Flat<T>>,
        work: &mut PartWork<T>,
    ) {
        if let Some(beside) = &self.beside {
            beside.apply(&self.prepared, t, x, work);
        }
        let Some(function) = function else {
            return;
        };
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
        let (home, numbers) = (Home::Own(&mut work.registers), &self.folded.numbers);
        let prepared = &self.prepared;
        prepared.evaluate_in(home, function, numbers, arrays, &mut []);
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
