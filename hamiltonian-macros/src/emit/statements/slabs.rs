//! Outer loops in slabs, which threads take.
//!
//! Input: an outermost loop with loops inside, or several fused ones. Output: a call of core with the loop over a range of
//! rows, if each iteration changes elements of its own row of a lattice alone. Invariant: inside, a written column begins
//! with the first row of the range.

use super::block::Writer;
use crate::emit::names::context::Access;
use crate::emit::names::layout::{Layout, Slice};
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Loop, Step, Target};
use std::fmt::Write;

impl Writer<'_> {
    /// Writes loops in slabs, if they allow it. Returns true if they do.
    pub(super) fn in_slabs(&mut self, loops: &[&Loop]) -> bool {
        let mut columns = Vec::new();
        let are_rows = loops.iter().all(|outer| {
            outer.body.iter().any(|step| matches!(step, Step::Loop(_)))
                && outer.accumulators.is_empty()
                && (outer.start.as_constant() == Some(0) || loops.len() > 1)
                && self.rows(outer.domain, &outer.body, &mut columns).is_some()
        });
        if !are_rows
            || columns.is_empty()
            || self.context.access != Access::Apart
            || self.context.layout == Layout::Scalars
            || !self.has_threads()
        {
            return false;
        }
        let d = loops[0].domain.0;
        let names: Vec<String> = columns.iter().map(|(slice, _)| slice.name()).into_list();
        let given: Vec<String> = (columns.iter())
            .map(|(slice, row)| format!("(&mut {}[..], {row})", slice.name()))
            .into_list();
        line!(
            self,
            "__h::rows({}, {}, [{}], #[inline(always)] move |_r{d}, [{}]| {{",
            self.last_row(loops),
            self.arithmetic,
            given.join(", "),
            names.join(", "),
        );
        self.slabs = columns;
        self.whole(loops, Some(loops[0].domain));
        line!(self, "}});");
        self.slabs.clear();
        true
    }

    /// The number of rows up to the last one that a loop reaches.
    fn last_row(&self, loops: &[&Loop]) -> String {
        let ends = loops
            .iter()
            .map(|outer| self.context.indices.saturating(&outer.end));
        let all = ends.reduce(|text, end| format!("({text}).max({end})"));
        all.unwrap_or_default()
    }

    /// The columns that steps write and the number of elements of a row of each. `None` if they write
    /// elements of other rows than that of the outermost loop's variable.
    fn rows(
        &self,
        domain: Domain,
        steps: &[Step],
        columns: &mut Vec<(Slice, String)>,
    ) -> Option<()> {
        for step in steps {
            match step {
                Step::Let(_) | Step::Accumulate(..) => {}
                Step::Loop(inner) => self.rows(domain, &inner.body, columns)?,
                Step::Store(target @ Target::Phase(_), row, None, _) => {
                    let slice = Slice::write(self.context.layout, *target);
                    let length = self.row(domain, row)?;
                    match columns.iter().find(|(known, _)| *known == slice) {
                        Some((_, known)) if *known != length => return None,
                        Some(_) => {}
                        None => columns.push((slice, length)),
                    }
                }
                Step::Store(..) => return None,
            }
        }
        Some(())
    }

    /// The number of elements of a row of the axes after the first one, if an element is of the row with the
    /// number of the loop's variable.
    fn row(&self, domain: Domain, element: &Index) -> Option<String> {
        let mut extents = Vec::new();
        let mut index = element;
        while let Some(outer) = &index.outer {
            extents.push(self.context.indices.modulus(&outer.extent));
            index = &outer.index;
        }
        let is_own = index.modulo.is_none() && index.affine == Affine::variable(domain);
        (is_own && !extents.is_empty()).then(|| format!("({})", extents.join(" * ")))
    }

    /// The number of an element of a column that is written, in the slab that is there.
    pub(super) fn within(&self, slice: &Slice, number: String) -> String {
        match self.slabs.iter().any(|(slab, _)| slab == slice) {
            true => format!("{number} - _b{}", slice.name()),
            false => number,
        }
    }

    /// Returns true if the loops may be computed on threads.
    pub(super) fn has_threads(&self) -> bool {
        self.arithmetic.ends_with(".0")
    }
}
