//! Affine expressions: what indices and ranges are made of.
//!
//! Input: nodes that are affine in sizes and loop variables. Output: their exact form, and whether
//! an index stays in range. Invariants: coefficients never overflow (a form that would is none);
//! an index is called out of range only if some iteration that takes place, for sizes large enough,
//! reaches out; it is called proven only if none does whatever the sizes are.

use super::Checker;
use super::expr::Frame;
use crate::ast::{ExprId, ExprKind};
use crate::checked::{Affine, Extent, Index, IndexVariable, Kind, Loop, LoopId};

impl Affine {
    /// A number.
    pub fn constant(constant: i64) -> Affine {
        Affine {
            constant,
            terms: Vec::new(),
        }
    }

    /// A size or a loop variable.
    pub fn variable(variable: IndexVariable) -> Affine {
        Affine {
            constant: 0,
            terms: vec![(variable, 1)],
        }
    }

    /// The number, if it is one.
    pub fn to_constant(&self) -> Option<i64> {
        self.terms.is_empty().then_some(self.constant)
    }

    /// `self + factor·other`
    pub fn plus(&self, factor: i64, other: &Affine) -> Option<Affine> {
        let constant = self
            .constant
            .checked_add(factor.checked_mul(other.constant)?)?;
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut left, mut right) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            let (variable, coefficient) = match (left.peek(), right.peek()) {
                (None, None) => break,
                (Some(&&(variable, a)), None) => {
                    left.next();
                    (variable, a)
                }
                (None, Some(&&(variable, b))) => {
                    right.next();
                    (variable, factor.checked_mul(b)?)
                }
                (Some(&&(x, a)), Some(&&(y, b))) => {
                    if x <= y {
                        left.next();
                    }
                    if y <= x {
                        right.next();
                    }
                    match x.cmp(&y) {
                        std::cmp::Ordering::Less => (x, a),
                        std::cmp::Ordering::Greater => (y, factor.checked_mul(b)?),
                        std::cmp::Ordering::Equal => (x, a.checked_add(factor.checked_mul(b)?)?),
                    }
                }
            };
            if coefficient != 0 {
                terms.push((variable, coefficient));
            }
        }
        Some(Affine { constant, terms })
    }

    /// `factor·self`
    pub fn times(&self, factor: i64) -> Option<Affine> {
        Affine::default().plus(factor, self)
    }

    /// At least 0 whatever the sizes are; only sizes occur.
    fn never_negative(&self) -> bool {
        self.constant >= 0 && self.terms.iter().all(|(_, coefficient)| *coefficient >= 0)
    }

    /// Less than 0 whatever the sizes are; only sizes occur.
    pub(super) fn always_negative(&self) -> bool {
        self.constant < 0 && self.terms.iter().all(|(_, coefficient)| *coefficient <= 0)
    }
}

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
    /// An affine form over sizes and loops as it would be written.
    pub(super) fn affine_shown(&self, form: &Affine) -> String {
        let mut text = String::new();
        for (variable, coefficient) in &form.terms {
            let name = match variable {
                IndexVariable::Size(size) => &self.out.sizes[size.0 as usize].name,
                IndexVariable::Loop(id) => &self.out.loops[id.0 as usize].name,
            };
            let sign = match (text.is_empty(), *coefficient < 0) {
                (true, true) => "-",
                (true, false) => "",
                (false, true) => " - ",
                (false, false) => " + ",
            };
            let magnitude = coefficient.unsigned_abs();
            text += sign;
            if magnitude != 1 {
                text += &format!("{magnitude}*");
            }
            text += &name.to_string();
        }
        match (text.is_empty(), form.constant) {
            (true, constant) => constant.to_string(),
            (false, 0) => text,
            (false, constant) if constant < 0 => format!("{text} - {}", constant.unsigned_abs()),
            (false, constant) => format!("{text} + {constant}"),
        }
    }

    /// The affine form of a node, or an error at the innermost node that has none.
    pub(super) fn affine(&mut self, raw: ExprId, frame: &Frame) -> Option<Affine> {
        let node = frame.value(raw)?;
        if let Some(form) = &self.affines[node.0 as usize] {
            return Some(form.clone());
        }
        let ast = self.ast;
        let is_culprit = |id: ExprId| {
            frame
                .value(id)
                .is_some_and(|node| self.affines[node.0 as usize].is_none())
        };
        let mut culprit = raw;
        loop {
            let inner = match ast.nodes[culprit.0 as usize].kind {
                ExprKind::Binary(_, left, right) => [Some(left), Some(right)],
                ExprKind::Unary(_, operand) => [Some(operand), None],
                _ => [None, None],
            };
            match inner.into_iter().flatten().find(|id| is_culprit(*id)) {
                Some(id) => culprit = id,
                None => break,
            }
        }
        let name = match &ast.nodes[culprit.0 as usize].kind {
            ExprKind::Name(symbol, _) => ast.symbols.name(*symbol),
            _ => "",
        };
        let kind = frame
            .value(culprit)
            .map(|node| &self.out.nodes[node.0 as usize].kind);
        let (message, help) = match kind {
            Some(Kind::Capture(_)) => (
                format!("`{name}` is a captured value, not a size"),
                format!("write a number; sizes need the item form, with `{name}: usize`"),
            ),
            Some(Kind::Parameter(_)) if !name.is_empty() => (
                format!("`{name}` is a parameter, not a size"),
                format!("declare it as a size: `{name}: usize`"),
            ),
            _ => (
                "indices and ranges are sums of whole multiples of loop variables and sizes".into(),
                "write indices such as `i`, `i + 1`, `2*i + j`, `N - 1 - i`, `(i + 1) % N`".into(),
            ),
        };
        self.error(
            culprit,
            ast.nodes[culprit.0 as usize].spans,
            &message,
            &help,
        );
        None
    }

    /// `base[index % modulo]`, checked against the extent it goes into.
    pub(super) fn checked_index(
        &mut self,
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
            return Some(Index {
                affine,
                modulo: Some(modulo),
                proven: room.never_negative(),
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
        for (end, wrong) in [(End::Least, &least), (End::Greatest, &room)] {
            let Some(form) = wrong else { continue };
            if form.always_negative() && self.takes_place(&affine, end) {
                let reached = if end == End::Least { &least } else { &greatest };
                let reached = reached.as_ref().map(|form| self.affine_shown(form));
                let reached = reached.unwrap_or_default();
                let message = if end == End::Least {
                    format!("this index reaches {reached}, but indices begin at 0")
                } else {
                    format!("this index reaches {reached}, but the extent is {shown}")
                };
                let at = self.ast.nodes[raw.0.0 as usize].spans;
                self.error(raw.0, at, &message, &help);
                return None;
            }
        }
        let proven = least.is_some_and(|form| form.never_negative())
            && room.is_some_and(|form| form.never_negative());
        Some(Index {
            affine,
            modulo: None,
            proven,
        })
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

    /// Whether the loops around an index run at the end it was followed to: an inner loop may be
    /// empty there (`i in 0..n, j in i + 1..n` at `i = n - 1`).
    fn takes_place(&self, form: &Affine, end: End) -> bool {
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
        self.active.iter().all(|id| {
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
