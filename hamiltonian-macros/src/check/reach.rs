//! Where indices lead: in range, out of range, or in range for some sizes only.
//!
//! Input: indices and ranges as affine forms. Output: an error, or a [`Reach`] where only the sizes
//! decide, which the emitted code asks once they are known. Invariants: an index is called out of
//! range only if some iteration of its own loops that takes place, for sizes large enough, reaches
//! out; it is called proven only if none does whatever the sizes are; of anything between there is a
//! [`Reach`]. An index's own loops are those it is made of: emitted code reads an element wherever
//! they run, even if a loop inside of them is empty.

use super::Checker;
use super::expr::Frame;
use crate::ast::ExprId;
use crate::checked::{Affine, Extent, Index, IndexVariable, Kind, Loop, LoopId, NodeId, Reach};
use proc_macro2::Span;

/// An extent as an affine form.
fn extent_form(extent: Extent) -> Option<Affine> {
    match extent {
        Extent::Literal(value) => i64::try_from(value).ok().map(Affine::constant),
        Extent::Size(size) => Some(Affine::variable(IndexVariable::Size(size))),
    }
}

/// Which end of its range an index is followed to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Least,
    Greatest,
}

impl Checker<'_> {
    /// `base[index % modulo]`, checked against the extent it goes into.
    pub(super) fn checked_index(
        &mut self,
        base: NodeId,
        raw: (ExprId, Option<ExprId>),
        frame: &Frame,
        extent: Extent,
    ) -> Option<Index> {
        let affine = self.affine(raw.0, frame)?;
        let modulo = match raw.1 {
            None => None,
            Some(right) => Some(self.modulus(right, frame)?),
        };
        let size = extent_form(extent)?;
        let shown = self.extent_shown(extent);
        let span = self.ast.nodes[raw.0.0 as usize].spans.start;
        if let (Some(modulo), Some(right)) = (modulo, raw.1) {
            let room = size.plus(-1, &extent_form(modulo)?)?;
            if room.always_negative() {
                let last = self.affine_shown(&extent_form(modulo)?.plus(-1, &Affine::constant(1))?);
                self.error(
                    raw.0,
                    self.ast.nodes[right.0 as usize].spans,
                    &format!("this index reaches {last}, but the extent is {shown}"),
                    &format!("write `% {shown}`"),
                );
                return None;
            }
            let proven = room.never_negative() && self.runs_over(&affine, modulo);
            if !proven {
                let written = self.wrapped_shown(&affine, modulo);
                // Of the whole index nothing but the modulus matters, where it is computed at all.
                let last = extent_form(modulo)?.plus(-1, &Affine::constant(1))?;
                self.needs((base, span), &written, &affine, last, extent);
            }
            return Some(Index {
                affine,
                modulo: Some(modulo),
                proven,
            });
        }
        let least = self.follow(&affine, End::Least);
        let greatest = self.follow(&affine, End::Greatest);
        let room = greatest
            .as_ref()
            .and_then(|greatest| size.plus(-1, &Affine::constant(1))?.plus(-1, greatest));
        let last = match extent {
            Extent::Literal(value) => (value - 1).to_string(),
            Extent::Size(_) => format!("{shown} - 1"),
        };
        let help = if affine
            .terms
            .iter()
            .any(|(variable, _)| matches!(variable, IndexVariable::Loop(_)))
        {
            format!(
                "indices run from 0 to {last}: change the range of the loop, or go round by `% {shown}`"
            )
        } else {
            format!("indices run from 0 to {last}")
        };
        let own = self.own_loops(&affine);
        for (end, form, reached) in [
            (End::Least, &least, &least),
            (End::Greatest, &room, &greatest),
        ] {
            let (Some(form), Some(reached)) = (form, reached) else {
                continue;
            };
            if form.always_negative() && self.takes_place(&affine, end, &own) {
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
                let at = self.ast.nodes[raw.0.0 as usize].spans;
                self.error(raw.0, at, &message, &format!("{help}{note}"));
                return None;
            }
        }
        let proven = least.is_some_and(|form| form.never_negative())
            && room.is_some_and(|form| form.never_negative());
        if !proven {
            let written = self.affine_shown(&affine);
            self.needs((base, span), &written, &affine, affine.clone(), extent);
        }
        Some(Index {
            affine,
            modulo: None,
            proven,
        })
    }

    /// Notes that `form` is to stay within the extent in the own loops of `index`, which is
    /// `written` into the brackets after `base`.
    fn needs(
        &mut self,
        (base, span): (NodeId, Span),
        written: &str,
        index: &Affine,
        form: Affine,
        extent: Extent,
    ) {
        let shown = format!("{}[{written}]", self.base_shown(base));
        self.note(Reach {
            shown,
            span,
            loops: self.own_loops(index),
            form,
            extent: Some(extent),
        });
    }

    /// Notes a question, once.
    pub(super) fn note(&mut self, reach: Reach) {
        // The same index is often written many times; instances of a function have loops of their
        // own.
        let is_same = |other: &Reach| {
            (&other.loops, &other.form, other.extent) == (&reach.loops, &reach.form, reach.extent)
                && other.shown == reach.shown
        };
        if !self.out.reaches.iter().any(is_same) {
            self.out.reaches.push(reach);
        }
    }

    /// `(i + 1) % N`
    fn wrapped_shown(&self, affine: &Affine, modulo: Extent) -> String {
        let (written, modulo) = (self.affine_shown(affine), self.extent_shown(modulo));
        if written.contains([' ', '*']) {
            format!("({written}) % {modulo}")
        } else {
            format!("{written} % {modulo}")
        }
    }

    /// The name of the indexed value, as far as it has one.
    fn base_shown(&self, base: NodeId) -> String {
        match &self.out.nodes[base.0 as usize].kind {
            Kind::Coordinate(group) => self.out.groups[group.0 as usize].coordinate.to_string(),
            Kind::Momentum(group) => self.out.groups[group.0 as usize].momentum.to_string(),
            Kind::NewCoordinate(group) | Kind::NewMomentum(group) => {
                let momentum = matches!(self.out.nodes[base.0 as usize].kind, Kind::NewMomentum(_));
                let name = self.new_name(*group, momentum);
                name.expect("a chart made it")
            }
            Kind::Velocity(group) => {
                let velocity = &self.out.groups[group.0 as usize].velocity;
                velocity.as_ref().expect("it is named").to_string()
            }
            Kind::Parameter(parameter) => {
                self.out.parameters[parameter.0 as usize].name.to_string()
            }
            Kind::Index { base, index } => {
                let written = match index.modulo {
                    Some(modulo) => self.wrapped_shown(&index.affine, modulo),
                    None => self.affine_shown(&index.affine),
                };
                format!("{}[{written}]", self.base_shown(*base))
            }
            _ => "(…)".to_owned(),
        }
    }

    /// `name in lower..upper`: a range that neither runs backwards nor begins below 0.
    pub(super) fn checked_range(
        &mut self,
        raw: ExprId,
        name: &str,
        bounds: (ExprId, ExprId),
        forms: [&Affine; 2],
    ) {
        if self.runs_forwards(raw, bounds, forms) {
            self.begins_at_0(bounds.0, name, forms);
        }
    }

    /// A range whose end lies before its start whatever the sizes are is a mistake; `0..0` is empty
    /// and nothing else.
    fn runs_forwards(
        &mut self,
        raw: ExprId,
        bounds: (ExprId, ExprId),
        [lower, upper]: [&Affine; 2],
    ) -> bool {
        let is_backwards = |width: Affine| {
            let is_size = |(variable, _): &_| matches!(variable, IndexVariable::Size(_));
            width.always_negative() && width.terms.iter().all(is_size)
        };
        if !upper.plus(-1, lower).is_some_and(is_backwards) {
            return true;
        }
        let written = |id: ExprId| self.ast.nodes[id.0 as usize].spans;
        let at = written(bounds.0).to(written(bounds.1));
        let (start, end) = (self.affine_shown(lower), self.affine_shown(upper));
        let message = format!("the range `{start}..{end}` ends before it starts");
        let help =
            format!("write the smaller one first, as in `{end}..{start}`; the end is not included");
        self.error(raw, at, &message, &help);
        false
    }

    /// The first value is not to be negative, where the loops around it run.
    fn begins_at_0(&mut self, raw: ExprId, name: &str, [lower, upper]: [&Affine; 2]) {
        let least = self.follow(lower, End::Least);
        if least.as_ref().is_some_and(Affine::never_negative) {
            return;
        }
        let own = self.own_loops(lower);
        if let Some(least) = least.filter(Affine::always_negative)
            && self.takes_place(lower, End::Least, &own)
        {
            let message = format!(
                "this range begins at {}, but ranges begin at 0 or above",
                self.affine_shown(&least)
            );
            let shifted = match lower.to_constant() {
                Some(first) => format!("{name} - {}", first.unsigned_abs()),
                None => format!("{} + {name}", self.affine_shown(lower)),
            };
            let length = upper.plus(-1, lower);
            let length = length.map_or("…".to_owned(), |length| self.affine_shown(&length));
            let help = format!("write `{name} in 0..{length}`, and `({shifted})` for `{name}`");
            let at = self.ast.nodes[raw.0 as usize].spans;
            self.error(raw, at, &message, &help);
            return;
        }
        let (first, end) = (self.affine_shown(lower), self.affine_shown(upper));
        self.note(Reach {
            shown: format!("{name} in {first}..{end}"),
            span: self.ast.nodes[raw.0 as usize].spans.start,
            loops: own,
            form: lower.clone(),
            extent: None,
        });
    }

    /// Whether some loop of the index has no iteration where the modulus is 0.
    fn runs_over(&self, index: &Affine, modulus: Extent) -> bool {
        let Extent::Size(size) = modulus else {
            return true;
        };
        self.own_loops(index).iter().any(|id| {
            let Loop { lower, upper, .. } = &self.out.loops[id.0 as usize];
            let size = Affine::variable(IndexVariable::Size(size));
            let beyond = upper.plus(-1, &size);
            lower.never_negative() && beyond.is_some_and(|b| b.terms.is_empty() && b.constant <= 0)
        })
    }

    /// The loops an affine form is made of, with those that their ranges are made of, outermost
    /// first.
    fn own_loops(&self, form: &Affine) -> Vec<LoopId> {
        let mut own: Vec<LoopId> = Vec::new();
        let mut forms = vec![form];
        while let Some(form) = forms.pop() {
            for (variable, _) in &form.terms {
                let IndexVariable::Loop(id) = variable else {
                    continue;
                };
                if !own.contains(id) {
                    own.push(*id);
                    let Loop { lower, upper, .. } = &self.out.loops[id.0 as usize];
                    forms.extend([lower, upper]);
                }
            }
        }
        // A loop's range mentions only loops with smaller ids.
        own.sort_unstable();
        own
    }

    /// The size to the right of `%`.
    fn modulus(&mut self, raw: ExprId, frame: &Frame) -> Option<Extent> {
        let form = self.affines[frame.value(raw)?.0 as usize].as_ref();
        let extent = form.and_then(|form| match (form.constant, form.terms.as_slice()) {
            (value, []) => u64::try_from(value)
                .ok()
                .filter(|value| *value > 0)
                .map(Extent::Literal),
            (0, [(IndexVariable::Size(size), 1)]) => Some(Extent::Size(*size)),
            _ => None,
        });
        if extent.is_none() {
            let at = self.ast.nodes[raw.0 as usize].at;
            self.error(
                raw,
                at,
                "the right side of `%` is not a size",
                "write `% N` with a size or a number",
            );
        }
        extent
    }

    /// The least or greatest value of an index over the loops around it, in terms of sizes.
    fn follow(&self, form: &Affine, end: End) -> Option<Affine> {
        let mut form = form.clone();
        // A loop's bounds mention only loops with smaller ids, and loops sort last.
        while let Some(&(IndexVariable::Loop(id), coefficient)) = form.terms.last() {
            let value = self.end_of(id, coefficient, end)?;
            let without = Affine {
                constant: form.constant,
                terms: form.terms[..form.terms.len() - 1].to_vec(),
            };
            form = without.plus(coefficient, &value)?;
        }
        Some(form)
    }

    /// The end of a loop at which a term with this coefficient is least or greatest.
    fn end_of(&self, id: LoopId, coefficient: i64, end: End) -> Option<Affine> {
        let Loop { lower, upper, .. } = &self.out.loops[id.0 as usize];
        if (coefficient > 0) == (end == End::Greatest) {
            upper.plus(-1, &Affine::constant(1))
        } else {
            Some(lower.clone())
        }
    }

    /// Whether `loops` run at the end an index was followed to: an inner loop may be empty there
    /// (`i in 0..n, j in i + 1..n` at `i = n - 1`).
    fn takes_place(&self, form: &Affine, end: End, loops: &[LoopId]) -> bool {
        let mut chosen: Vec<(LoopId, Affine)> = Vec::new();
        let mut rest = form.clone();
        while let Some(&(IndexVariable::Loop(id), coefficient)) = rest.terms.last() {
            let Some(value) = self.end_of(id, coefficient, end) else {
                return false;
            };
            rest.terms.pop();
            let Some(next) = rest.plus(coefficient, &value) else {
                return false;
            };
            rest = next;
            chosen.push((id, value));
        }
        let substitute = |form: &Affine| -> Option<Affine> {
            let mut form = form.clone();
            while let Some(&(IndexVariable::Loop(id), coefficient)) = form.terms.last() {
                let value = match chosen.iter().find(|(other, _)| *other == id) {
                    Some((_, value)) => value,
                    None => &self.out.loops[id.0 as usize].lower,
                };
                form.terms.pop();
                form = form.plus(coefficient, value)?;
            }
            Some(form)
        };
        loops.iter().all(|id| {
            let Loop { lower, upper, .. } = &self.out.loops[id.0 as usize];
            // Empty whatever the sizes are: upper − lower − 1 < 0.
            let last = upper
                .plus(-1, lower)
                .and_then(|width| width.plus(-1, &Affine::constant(1)));
            last.and_then(|last| substitute(&last))
                .is_some_and(|last| !last.always_negative())
        })
    }
}
