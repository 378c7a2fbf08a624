//! Affine expressions: the values of indices and ranges.
//!
//! Input: nodes that are affine in sizes and loop variables. Output: their exact form. Invariant:
//! if a coefficient would overflow, there is no form.

use super::Checker;
use super::expr::Frame;
use crate::ast::{BinaryOp, ExprId, ExprKind};
use crate::checked::{NodeId, NodeKind};
use hamiltonian_symbolic::index::{Affine, Domain, Size};
use hamiltonian_symbolic::list::IntoList;

/// The help for an index of no known form.
const INDICES: &str = "write indices such as `i`, `i + 1`, `2*i + j`, `N - 1 - i`, `(i + 1) % N`";

impl Checker<'_> {
    /// An affine form over sizes and loops as it would be written.
    pub(super) fn affine_shown(&self, form: &Affine) -> String {
        let mut text = String::new();
        let name = |size: &Size| self.out.sizes[size.0 as usize].name.to_string();
        let product = |sizes: &[Size]| sizes.iter().map(name).into_list().join("*");
        let sizes = form.sizes.iter().map(|(size, k)| (name(size), *k));
        let products = form.products.iter().map(|(sizes, k)| (product(sizes), *k));
        let variable =
            |&(id, k): &(Domain, i64)| (self.out.loops[id.0 as usize].name.to_string(), k);
        let variables = form.loops.iter().map(variable);
        for (name, coefficient) in sizes.chain(products).chain(variables) {
            let sign = match (text.is_empty(), coefficient < 0) {
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
            text += &name;
        }
        match (text.is_empty(), form.constant) {
            (true, constant) => constant.to_string(),
            (false, 0) => text,
            (false, constant) if constant < 0 => format!("{text} - {}", constant.unsigned_abs()),
            (false, constant) => format!("{text} + {constant}"),
        }
    }

    /// The same as an operand of `%`.
    pub(super) fn operand_shown(&self, form: &Affine) -> String {
        let text = self.affine_shown(form);
        match text.contains([' ', '*']) {
            true => format!("({text})"),
            false => text,
        }
    }

    /// The affine form of a node, or an error at the innermost node that has none. `help` is for a product of a loop
    /// variable and a size.
    pub(super) fn affine(&mut self, raw: ExprId, frame: &Frame, help: &str) -> Option<Affine> {
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
        let form = |node: &NodeId| self.affines[node.0 as usize].as_ref();
        let (message, help) = match kind {
            Some(NodeKind::Capture(_)) => (
                format!("`{name}` is a captured value, not a size"),
                format!("write a number; sizes need the item form, with `{name}: usize`"),
            ),
            Some(NodeKind::Parameter(_)) if !name.is_empty() => (
                format!("`{name}` is a parameter, not a size"),
                format!("declare it as a size: `{name}: usize`"),
            ),
            Some(NodeKind::Number(number)) if number.is_integer() => (
                "this number is too large for an index or a range".into(),
                format!("write one up to {}", i64::MAX),
            ),
            Some(NodeKind::Binary(op @ (BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul), a, b))
                if [a, b].iter().all(|side| form(side).is_some()) =>
            {
                let forms = [a, b].map(form).into_iter().flatten();
                let has_number = forms.clone().any(|form| form.as_constant().is_some());
                let help = match forms.filter(|form| !form.loops.is_empty()).count() {
                    1 if *op == BinaryOp::Mul && !has_number => help,
                    2 if *op == BinaryOp::Mul => INDICES,
                    _ => return self.fitting(culprit, None),
                };
                let message =
                    "a loop variable in an index or a range is multiplied by numbers alone";
                (message.into(), help.into())
            }
            _ => (
                "indices and ranges are sums of whole multiples of loop variables and sizes".into(),
                INDICES.into(),
            ),
        };
        self.error_over(culprit, message, help);
        None
    }
}
