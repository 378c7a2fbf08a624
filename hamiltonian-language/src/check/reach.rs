//! Bounds of indices: in range, out of range, or in range for some sizes only.
//!
//! Input: indices and ranges as affine forms. Output: an error, or a [`Reach`] if the sizes decide;
//! the emitted code checks it once they are known. Invariants: an index is out of range only if,
//! for all sufficiently large sizes, an iteration of its own loops leaves the range. It is proven
//! only if no iteration does, for any sizes. All other indices have a [`Reach`]. The own loops of
//! an index are those whose variables it contains: emitted code reads an element wherever they run,
//! even if a loop inside them is empty.

use super::Checker;
use super::MANY_SIZES;
use super::expr::Frame;
use crate::ast::ExprId;
use crate::checked::{Bound, Extent, Loop, NodeId, NodeKind, Reach, Variable};
use hamiltonian_symbolic::index::{Affine, Domain, End, Index};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::ranges::Ranges;
use proc_macro2::Ident;

/// The help for an index that counts rows.
const EXTENTS: &str =
    "write an extent for each index: `w[n][m]` and `w[i][j]` instead of `w[n*m]` and `w[i*m + j]`";

impl Checker<'_> {
    /// `base[index % modulo]`, checked against the extent it goes into.
    pub(super) fn checked_index(
        &mut self,
        base: NodeId,
        raw: (ExprId, Option<ExprId>),
        frame: &Frame,
        extent: Extent,
    ) -> Option<Index> {
        let affine = self.affine(raw.0, frame, EXTENTS)?;
        let [least, greatest] = self.ends(raw.0, &affine)?;
        self.fits(raw.0, &affine)?;
        let modulo = match raw.1 {
            None => None,
            Some(right) => Some(self.modulus(right, frame)?),
        };
        let size = extent.affine();
        let shown = self.extent_shown(extent);
        let divisor = self.operand_shown(&size);
        if let (Some(modulo), Some(right)) = (modulo, raw.1) {
            let room = size.checked_plus(-1, &modulo.affine())?;
            let last = modulo.affine().checked_plus(-1, &Affine::constant(1))?;
            if room.is_always_negative() {
                let last = self.affine_shown(&last);
                self.error_over(
                    right,
                    format!("this index reaches {last}, but the extent is {shown}"),
                    format!("write `% {divisor}`"),
                );
                return None;
            }
            let modulo = modulo.affine();
            // Some loop of the index has no iteration where the modulus is 0.
            let runs = |id: &Domain| self.is_within(&Affine::variable(*id), &modulo);
            let is_positive = modulo.constant > 0 || self.own_loops(&affine).iter().any(runs);
            let proven = room.is_never_negative() && is_positive;
            let modulo = Some(modulo);
            let index = Index {
                affine,
                modulo,
                outer: None,
            };
            if !proven {
                // Only the modulus matters for the index, if the index is computed at all.
                self.needs(base, raw.0, &index, last, extent);
            }
            return Some(index);
        }
        let room = self.fitting(raw.0, greatest.room_below(&size))?;
        let last = match extent {
            Extent::Literal(value) => (value - 1).to_string(),
            _ => format!("{shown} - 1"),
        };
        let help = if !affine.loops.is_empty() {
            format!(
                "indices run from 0 to {last}: change the range of the loop, or go round by `% {divisor}`"
            )
        } else {
            format!("indices run from 0 to {last}")
        };
        let own = self.own_loops(&affine);
        for (end, form, reached) in [
            (End::Least, &least, &least),
            (End::Greatest, &room, &greatest),
        ] {
            if form.is_always_negative() && self.takes_place(&affine, end, &own) {
                let reached = self.affine_shown(reached);
                let message = if end == End::Least {
                    format!("this index reaches {reached}, but indices begin at 0")
                } else {
                    format!("this index reaches {reached}, but the extent is {shown}")
                };
                let note = if self.takes_place(&affine, end, &self.active) {
                    ""
                } else {
                    "; the index is checked in every iteration of its loops, even where an inner loop is empty"
                };
                self.error_over(raw.0, message, format!("{help}{note}"));
                return None;
            }
        }
        let proven = least.is_never_negative() && room.is_never_negative();
        let index = Index::plain(affine);
        if !proven {
            self.needs(base, raw.0, &index, index.affine.clone(), extent);
        }
        Some(index)
    }

    /// Records the condition that `form` is within the extent in the own loops of `index`, which is
    /// written in the brackets after `base`.
    fn needs(&mut self, base: NodeId, raw: ExprId, index: &Index, form: Affine, extent: Extent) {
        self.note(Reach {
            shown: format!("{}[{}]", self.base_shown(base), self.index_shown(index)),
            span: self.ast.nodes[raw.0 as usize].spans.start,
            loops: self.with_bounds(self.own_loops(&index.affine)),
            form,
            limit: Bound::Extent(extent),
        });
    }

    fn with_bounds(&self, loops: Vec<Domain>) -> Vec<(Domain, [Affine; 2])> {
        let ranges = loops
            .into_iter()
            .map(|id| (id, self.bounds(id).map(Affine::clone)));
        ranges.into_list()
    }

    /// Records a condition on the sizes, once.
    pub(super) fn note(&mut self, reach: Reach) {
        // The same index is often written many times; instances of a function have loops of their
        // own.
        let is_same = |other: &Reach| {
            (&other.loops, &other.form, other.limit) == (&reach.loops, &reach.form, reach.limit)
                && other.shown == reach.shown
        };
        if !self.out.reaches.iter().any(is_same) {
            self.out.reaches.push(reach);
        }
    }

    /// `i + 1`, `(i + 1) % N`
    fn index_shown(&self, index: &Index) -> String {
        let written = self.affine_shown(&index.affine);
        match index
            .modulo
            .as_ref()
            .map(|modulo| self.operand_shown(modulo))
        {
            None => written,
            Some(modulo) => format!("{} % {modulo}", self.operand_shown(&index.affine)),
        }
    }

    /// The name of the indexed value, as far as it has one.
    fn base_shown(&self, base: NodeId) -> String {
        match &self.out.nodes[base.0 as usize].kind {
            NodeKind::Phase(variable, group) => {
                let names = &self.out.groups[group.0 as usize];
                let name = match variable {
                    Variable::Coordinate => Some(&names.coordinate),
                    Variable::Momentum => Some(&names.momentum),
                    Variable::Velocity => names.velocity.as_ref(),
                    Variable::NewCoordinate | Variable::NewMomentum => None,
                };
                let name = name
                    .map(Ident::to_string)
                    .or_else(|| self.new_name(*group, *variable));
                name.expect("a group has a name for what is read of it")
            }
            NodeKind::Parameter(parameter) => {
                self.out.parameters[parameter.0 as usize].name.to_string()
            }
            NodeKind::Index { base, index } => {
                format!("{}[{}]", self.base_shown(*base), self.index_shown(index))
            }
            _ => "(…)".to_owned(),
        }
    }

    /// `name in lower..upper`: a range that neither runs backwards nor begins below 0. `None` if
    /// its values need more than 64 bits.
    pub(super) fn checked_range(
        &mut self,
        raw: ExprId,
        name: &str,
        bounds: (ExprId, ExprId),
        forms: [&Affine; 2],
    ) -> Option<()> {
        let [least, _] = self.ends(bounds.0, forms[0])?;
        self.ends(bounds.1, forms[1])?;
        self.fits(bounds.0, forms[0])?;
        self.fits(bounds.1, forms[1])?;
        let width = forms[1].checked_plus(-1, forms[0]);
        let width = self.fitting(raw, width)?;
        if self.runs_forwards(raw, bounds, forms, &width) {
            self.begins_at_0(bounds.0, name, forms, &width, &least);
        }
        Some(())
    }

    /// Refuses a range that ends before its start for all sizes. `0..0` is empty and allowed.
    fn runs_forwards(
        &mut self,
        raw: ExprId,
        bounds: (ExprId, ExprId),
        [lower, upper]: [&Affine; 2],
        width: &Affine,
    ) -> bool {
        if !width.loops.is_empty() || !width.is_always_negative() {
            return true;
        }
        let written = |id: ExprId| self.ast.nodes[id.0 as usize].spans;
        let at = written(bounds.0).to(written(bounds.1));
        let (start, end) = (self.affine_shown(lower), self.affine_shown(upper));
        let message = format!("the range `{start}..{end}` ends before it starts");
        let help =
            format!("write the smaller one first, as in `{end}..{start}`; the end is not included");
        self.error_in(raw, at, message, help);
        false
    }

    /// Checks that the first value is not negative where the loops around it run.
    fn begins_at_0(
        &mut self,
        raw: ExprId,
        name: &str,
        [lower, upper]: [&Affine; 2],
        width: &Affine,
        least: &Affine,
    ) {
        if least.is_never_negative() {
            return;
        }
        let own = self.own_loops(lower);
        if least.is_always_negative() && self.takes_place(lower, End::Least, &own) {
            let message = format!(
                "this range begins at {}, but ranges begin at 0 or above",
                self.affine_shown(least)
            );
            let shifted = match lower.as_constant() {
                Some(first) => format!("{name} - {}", first.unsigned_abs()),
                None => format!("{} + {name}", self.affine_shown(lower)),
            };
            let length = self.affine_shown(width);
            let help = format!("write `{name} in 0..{length}`, and `({shifted})` for `{name}`");
            self.error_over(raw, message, help);
            return;
        }
        let (first, end) = (self.affine_shown(lower), self.affine_shown(upper));
        self.note(Reach {
            shown: format!("{name} in {first}..{end}"),
            span: self.ast.nodes[raw.0 as usize].spans.start,
            loops: self.with_bounds(own),
            form: lower.clone(),
            limit: Bound::Nothing,
        });
    }

    /// The size to the right of `%`.
    fn modulus(&mut self, raw: ExprId, frame: &Frame) -> Option<Extent> {
        let form = self.affines[frame.value(raw)?.0 as usize].as_ref();
        let extent = form.and_then(Extent::of);
        let is_long = form.is_some_and(|form| {
            matches!(form.products[..], [(_, 1..)])
                && form.constant == 0
                && form.sizes.is_empty()
                && form.loops.is_empty()
        });
        if extent.is_none() {
            let (message, help) = if is_long {
                (
                    MANY_SIZES,
                    "declare a size for the product, such as `k: usize`",
                )
            } else {
                (
                    "the right side of `%` is not a size",
                    "write `% N` with a size or a number",
                )
            };
            self.error_over(raw, message, help);
        }
        self.fits(raw, &extent?.affine())?;
        extent
    }

    /// The least and the greatest value of a form over the loops around it, in terms of sizes.
    fn ends(&mut self, raw: ExprId, form: &Affine) -> Option<[Affine; 2]> {
        let [least, greatest] = [End::Least, End::Greatest].map(|end| self.extreme(form, end));
        Some([self.fitting(raw, least)?, self.fitting(raw, greatest)?])
    }

    /// Refuses a form that needs coefficients of more than 64 bits.
    pub(super) fn fitting(&mut self, raw: ExprId, form: Option<Affine>) -> Option<Affine> {
        if form.is_none() {
            let message = "values of this index or range need more than 64 bits";
            self.error_over(raw, message, "write smaller factors or shorter ranges");
        }
        form
    }
}

impl Ranges for Checker<'_> {
    fn bounds(&self, id: Domain) -> [&Affine; 2] {
        let Loop { lower, upper, .. } = &self.out.loops[id.0 as usize];
        [lower, upper]
    }
}
