//! The array elements that a loop accesses with its own variable.
//!
//! Input: a loop. Output: its periodic indices, and the columns that advance with its variable.
//! Invariant: a written column is included only if all its stores have the same index.

use crate::emit::names::context::Context;
use crate::emit::names::layout::Slice;
use hamiltonian_symbolic::index::{Affine, Domain, Index, Loops};
use hamiltonian_symbolic::program::{Instruction, Loop, Step};

/// The elements that the body of a loop accesses with the variable of the loop.
#[derive(Default)]
pub(in crate::emit) struct Accesses {
    /// Periodic indices, each with the factor 1 or −1 of the variable.
    pub(in crate::emit) wrapped: Vec<(Index, i64)>,
    /// Columns that advance with the variable, with their index: read ones, and written ones with this index alone.
    pub(in crate::emit) cuts: Vec<(Slice, Index)>,
}

impl Accesses {
    /// Returns true if the loop begins at 0 and the index of each column is the variable itself.
    pub(in crate::emit) fn is_plain(&self, inner: &Loop) -> bool {
        let along =
            |(_, index): &(Slice, Index)| *index == Index::plain(Affine::variable(inner.domain));
        self.wrapped.is_empty()
            && inner.start.as_constant() == Some(0)
            && self.cuts.iter().all(along)
    }

    /// Returns true if there is a periodic index.
    pub(in crate::emit) fn wraps(&self) -> bool {
        !self.wrapped.is_empty()
    }

    /// Finds the accesses of a loop.
    pub(in crate::emit) fn of(context: Context, inner: &Loop) -> Accesses {
        let mut finder = Finder {
            context,
            domain: inner.domain,
            accesses: Accesses::default(),
            stores: Vec::new(),
        };
        finder.walk(&inner.body, Loops::default());
        let mut accesses = finder.accesses;
        for (slice, index, steps) in finder.stores {
            if steps {
                accesses.cut(slice, index);
            }
        }
        accesses
    }

    fn cut(&mut self, slice: Slice, index: Index) {
        let cut = (slice, index);
        if !self.cuts.contains(&cut) {
            self.cuts.push(cut);
        }
    }
}

struct Finder<'a> {
    context: Context<'a>,
    domain: Domain,
    accesses: Accesses,
    /// Written columns, each with its index; the flag is true if all its stores have that index, and the index
    /// increases by one with the loop variable.
    stores: Vec<(Slice, Index, bool)>,
}

impl Finder<'_> {
    fn walk(&mut self, steps: &[Step], inner: Loops) {
        for step in steps {
            match step {
                Step::Let(value) => {
                    let program = self.context.program;
                    if let Instruction::Load(array, row, column) = program.instruction(*value) {
                        let number = self.context.number(*array, row, column.as_ref());
                        if self.index(&number, inner) {
                            self.accesses.cut(self.context.read(*array), number);
                        }
                    }
                }
                Step::Store(target, row, column, _) => {
                    let slice = Slice::write(self.context.layout, *target);
                    let along = self.element(row, column.as_ref(), inner);
                    match self.stores.iter_mut().find(|(s, ..)| *s == slice) {
                        Some((_, index, steps)) => *steps &= index == row && along,
                        None => self.stores.push((slice, row.clone(), along)),
                    }
                }
                Step::Accumulate(..) => {}
                Step::Loop(l) => self.walk(&l.body, inner | Loops::of(l.domain)),
            }
        }
    }

    /// Records the periodic indices of an element. Returns true if it advances by one element of its column with the
    /// loop variable, in the body of this loop itself.
    fn element(&mut self, row: &Index, column: Option<&Index>, inner: Loops) -> bool {
        let along = self.index(row, inner);
        if let Some(column) = column {
            self.index(column, inner);
        }
        along && column.is_none()
    }

    fn index(&mut self, index: &Index, inner: Loops) -> bool {
        let variables = index.variables();
        if variables.meets(inner) || !variables.has(self.domain) {
            return false;
        }
        let outer = index.outer.as_ref();
        if outer.is_some_and(|outer| outer.index.variables().has(self.domain)) {
            return false;
        }
        let factor = index.affine.factor(self.domain);
        if let Some(modulo) = &index.modulo {
            if factor.abs() != 1 || modulo.factor(self.domain) != 0 {
                return false;
            }
            let wrapped = (index.clone(), factor);
            if !self.accesses.wrapped.contains(&wrapped) {
                self.accesses.wrapped.push(wrapped);
            }
        }
        factor == 1
    }
}

/// The name of the start of a periodic index in a segment: the place on the last axis, plus the number of
/// elements in the rows before.
pub(in crate::emit) fn start_name(domain: Domain, at: usize, index: &Index) -> String {
    let word = if index.outer.is_some() { 'o' } else { 'w' };
    format!("_{word}{}_{at}", domain.0)
}
