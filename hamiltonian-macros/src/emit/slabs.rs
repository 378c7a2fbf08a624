//! Outer loops in slabs, which threads take.
//!
//! Input: an outermost loop with loops inside. Output: a call of core with the loop over a range of rows, if
//! each iteration changes elements of its own row of a lattice alone. Invariant: inside, a column that is
//! written begins with the first row of the range.

use super::block::Writer;
use super::context::Access;
use super::index::variable;
use super::layout::{Layout, Slice};
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::program::{Loop, Step, Target};
use std::fmt::Write;

impl Writer<'_> {
    /// Writes a loop in slabs; whether that was done.
    pub(super) fn in_slabs(&mut self, outer: &Loop) -> bool {
        let has_loops = outer.body.iter().any(|step| matches!(step, Step::Loop(_)));
        if !has_loops
            || self.context.access != Access::Apart
            || self.context.layout == Layout::Scalars
            || !self.has_threads()
            || !outer.accumulators.is_empty()
            || outer.start.as_constant() != Some(0)
        {
            return false;
        }
        let mut columns = Vec::new();
        if self.rows(outer.domain, &outer.body, &mut columns).is_none() || columns.is_empty() {
            return false;
        }
        let d = outer.domain.0;
        let names: Vec<String> = columns.iter().map(|(slice, _)| slice.name()).collect();
        let given: Vec<String> = (columns.iter())
            .map(|(slice, row)| format!("(&mut {}[..], {row})", slice.name()))
            .collect();
        line!(
            self,
            "__h::rows({}, {}, [{}], #[inline(always)] move |_r{d}, [{}]| {{",
            self.context.indices.saturating(&outer.end),
            self.arithmetic,
            given.join(", "),
            names.join(", "),
        );
        for (slice, row) in &columns {
            line!(self, "let _b{} = _r{d}.start * {row};", slice.name());
        }
        self.slabs = columns.into_iter().map(|(slice, _)| slice).collect();
        line!(self, "for {} in _r{d} {{", variable(outer.domain));
        self.steps(&outer.body);
        line!(self, "}}\n}});");
        self.slabs.clear();
        true
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
        match self.slabs.contains(slice) {
            true => format!("{number} - _b{}", slice.name()),
            false => number,
        }
    }

    /// Returns true if the loops may be computed on threads.
    fn has_threads(&self) -> bool {
        self.arithmetic.starts_with("_self")
    }
}
