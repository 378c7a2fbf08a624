//! Affine expressions: what indices and ranges are made of.
//!
//! Input: nodes that are affine in sizes and loop variables. Output: their exact form. Invariant:
//! coefficients never overflow (a form that would is none).

use super::Checker;
use super::expr::Frame;
use crate::ast::{ExprId, ExprKind};
use crate::checked::{Affine, IndexVariable, Kind};

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
    pub(super) fn never_negative(&self) -> bool {
        self.constant >= 0 && self.terms.iter().all(|(_, coefficient)| *coefficient >= 0)
    }

    /// Less than 0 whatever the sizes are; only sizes occur.
    pub(super) fn always_negative(&self) -> bool {
        self.constant < 0 && self.terms.iter().all(|(_, coefficient)| *coefficient <= 0)
    }
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
            Some(Kind::Number(number)) if number.is_integer() => (
                "this number is too large for an index or a range".into(),
                format!("write one up to {}", i64::MAX),
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
}
