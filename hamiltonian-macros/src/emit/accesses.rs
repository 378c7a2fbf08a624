//! Elements that a loop reaches with its own variable.
//!
//! Input: a loop. Output: the indices that wrap in it, and the columns that run along with its variable.
//! Invariant: a column that is written runs along only if it is written at one index alone.

use super::context::{Access, Context};
use super::layout::Slice;
use hamiltonian_symbolic::index::{Affine, Domain, Index, Loops};
use hamiltonian_symbolic::program::{Instruction, Loop, Step};

/// The elements that a loop's body reaches with the loop's own variable.
#[derive(Default)]
pub(super) struct Accesses {
    /// Indices that wrap as the variable moves by one, with its factor 1 or −1.
    pub(super) wrapped: Vec<(Index, i64)>,
    /// Columns read, or written at this one index only, that run along with the variable.
    pub(super) cuts: Vec<(Slice, Index)>,
}

impl Accesses {
    /// Returns true if the loop counts from 0 and columns run along with it element by element.
    pub(super) fn is_plain(&self, inner: &Loop) -> bool {
        let along =
            |(_, index): &(Slice, Index)| *index == Index::plain(Affine::variable(inner.domain));
        self.wrapped.is_empty()
            && inner.start.as_constant() == Some(0)
            && self.cuts.iter().all(along)
    }

    /// The name of the start of a wrapped index in a segment.
    pub(super) fn start_of(&self, domain: Domain, index: &Index) -> Option<String> {
        let at = self.wrapped.iter().position(|(known, _)| known == index)?;
        Some(start_name(domain, at, index))
    }

    /// Returns true if an index wraps.
    pub(super) fn wraps(&self) -> bool {
        !self.wrapped.is_empty()
    }

    /// Those of a loop; none where iterations read and write one point, which has no parts to cut.
    pub(super) fn of(context: Context, inner: &Loop) -> Accesses {
        let mut finder = Finder {
            context,
            domain: inner.domain,
            accesses: Accesses::default(),
            stores: Vec::new(),
        };
        if context.access == Access::Apart {
            finder.walk(&inner.body, Loops::default());
        }
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
    /// Columns written, each with its index, and whether all stores have that index and it moves by
    /// one with the loop variable.
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

    /// Notes the indices of an element that wrap in this loop. Whether it moves by one element of its
    /// column with the loop variable, in the body of this very loop.
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

/// The name of the start of a wrapped index in a segment: its place on the last axis, which the rows
/// before it are added to.
pub(super) fn start_name(domain: Domain, at: usize, index: &Index) -> String {
    let word = if index.outer.is_some() { 'o' } else { 'w' };
    format!("_{word}{}_{at}", domain.0)
}
