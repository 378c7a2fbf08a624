//! Loops: `i in lower..upper`.
//!
//! Input: a scope and its bounds. Output: the loop of its variable. Invariant: the name of the
//! variable is new; `reach` checks the range.

use super::Checker;
use super::expr::Frame;
use super::lookup::Found;
use crate::ast::{ExprId, LoopVariableId, Symbol};
use crate::checked::Loop;
use hamiltonian_symbolic::index::Domain;

/// The help for a range to a product.
const LOOPS: &str =
    "write a loop for each factor: `sum(a in 0..m, b in 0..i)` instead of `sum(k in 0..m*i)`";

impl Checker<'_> {
    /// Begins a loop, `i in lower..upper`, and binds its variable.
    pub(super) fn bind(
        &mut self,
        raw: ExprId,
        scope: LoopVariableId,
        bounds: (ExprId, ExprId),
        frame: &Frame,
    ) {
        let name = &self.ast.scopes[scope.0 as usize].name;
        let symbol = self.ast.scopes[scope.0 as usize].symbol;
        self.loop_name_is_new(raw, scope, symbol, frame);
        let bounds_known = [bounds.0, bounds.1].map(|end| self.affine(end, frame, LOOPS));
        // If the range is erroneous there is no loop, but the name is known.
        self.scope_loops[scope.0 as usize] = None;
        let [Some(lower), Some(upper)] = bounds_known else {
            return;
        };
        let range = self.checked_range(raw, &name.to_string(), bounds, [&lower, &upper]);
        if range.is_none() {
            return;
        }
        let id = Domain(self.out.loops.len() as u32);
        self.out.loops.push(Loop {
            name: name.clone(),
            lower,
            upper,
        });
        self.scope_loops[scope.0 as usize] = Some(id);
        self.active.push(id);
    }

    fn loop_name_is_new(
        &mut self,
        raw: ExprId,
        scope: LoopVariableId,
        symbol: Symbol,
        frame: &Frame,
    ) {
        let around = self.ast.scopes[scope.0 as usize].parent;
        let what = match self.find(symbol, around, frame) {
            None => None,
            Some(Found::Loop(_)) => Some("a loop variable around this one"),
            Some(found) => Some(self.found_shown(found)),
        };
        if let Some(what) = what {
            let name = self.ast.symbols.name(symbol);
            let message = format!("`{name}` is used twice: it is {what} already");
            self.error(raw, message, "choose another loop variable");
        }
    }
}
