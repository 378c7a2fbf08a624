//! Sums over pairs in tiles, for threads.
//!
//! Input: an outermost loop. Output: for a loop over pairs, a call of core with the work on a row of a tile, and the
//! plain loop for few rows. Invariant: in the work, a written column begins with the first column of the row in the
//! tile, and the element of the row itself is a reference.

use super::block::Writer;
use crate::emit::names::context::Access;
use crate::emit::names::layout::Slice;
use crate::emit::steps::accesses::Accesses;
use hamiltonian_symbolic::index::{Affine, Index};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::pairs::{LEAST, Pairs, Triangle, pairs};
use hamiltonian_symbolic::program::Loop;
use std::fmt::Write;

impl Writer<'_> {
    /// Writes a loop over pairs in tiles; returns false for other loops.
    pub(super) fn in_tiles(&mut self, loops: &[&Loop]) -> bool {
        let [outer] = loops else { return false };
        if self.context.access != Access::Apart {
            return false;
        }
        let extent = outer.end.as_constant();
        if extent.is_some_and(|extent| extent < LEAST as i64) {
            return false;
        }
        let Some(pairs) = pairs(outer, self.context.program) else {
            return false;
        };
        // Both forms of the loop share the type of the arithmetic.
        let found = Accesses::of(self.context, pairs.inner);
        if let Some(stretch) = self.stretch(pairs.inner, &found) {
            self.body(&stretch, pairs.inner.domain);
            self.body = Some(stretch.name);
        }
        let count = self.context.indices.saturating(&outer.end);
        match extent {
            Some(_) => self.tiles(outer, &pairs, &count),
            None => {
                line!(self, "if {count} >= __h::TILED {{");
                self.tiles(outer, &pairs, &count);
                line!(self, "}} else {{");
                self.whole(loops, None);
                line!(self, "}}");
            }
        }
        self.body = None;
        true
    }

    fn tiles(&mut self, outer: &Loop, pairs: &Pairs, count: &str) {
        let slice = |target| Slice::write(self.context.layout, target);
        let slices: Vec<Slice> = pairs.targets.iter().copied().map(slice).into_list();
        let list = |text: &dyn Fn(&str) -> String| {
            let texts: Vec<String> = slices.iter().map(|slice| text(&slice.name())).into_list();
            texts.join(", ")
        };
        let triangle = match pairs.triangle {
            Triangle::Below => "Below",
            Triangle::Above => "Above",
        };
        let (row, column) = (outer.domain.0, pairs.inner.domain.0);
        line!(
            self,
            "__h::pairs({count}, __h::Triangle::{triangle}, {}, [{}], #[inline(always)] move |_y{row}| {{",
            self.arithmetic,
            list(&|name| format!("&mut {name}[..]")),
        );
        line!(
            self,
            "let __h::TileRow {{ number: _i{row}, columns: _r{column}, is_first: _o{row}, own: _own, others: _others }} = _y{row};\n\
             let [{}] = _own;\nlet [{}] = _others;",
            list(&|name| format!("_y{name}")),
            list(&str::to_owned),
        );
        for slice in &slices {
            line!(self, "let _b{} = _r{column}.start;", slice.name());
        }
        let own = Index::plain(Affine::variable(outer.domain));
        let known = self.slices.len();
        for slice in &slices {
            let element = format!("*_y{}", slice.name());
            self.slices.push((*slice, own.clone(), element));
        }
        self.slabs = slices
            .into_iter()
            .map(|slice| (slice, String::new()))
            .into_list();
        self.tile = Some(pairs.inner.domain);
        for (at, step) in outer.body.iter().enumerate() {
            let is_once = pairs.once.contains(&at);
            if is_once {
                line!(self, "if _o{row} {{");
            }
            self.steps(std::slice::from_ref(step));
            if is_once {
                line!(self, "}}");
            }
        }
        self.tile = None;
        self.slabs.clear();
        self.slices.truncate(known);
        line!(self, "}});");
    }
}
