//! The questions of the search, each within a budget of its own.
//!
//! Input: a question on an expression. Output: its answer, or none and the limit at which it ended. Invariant: what was
//! found after the budget was spent is no answer.

use super::Space;
use crate::dag::{Dag, Node};
use crate::flows::limits::{COMPARISONS, EXPRESSIONS, Limit, PRODUCTS};

/// What is left to a question.
pub(super) struct QuestionBudget {
    /// The number of comparisons.
    pub(super) tests: usize,
    /// The number of products in the normal form.
    pub(super) products: usize,
    /// The largest size of the arena.
    last: usize,
}

impl QuestionBudget {
    /// A whole one, beside an arena.
    pub(super) fn new(dag: &Dag) -> QuestionBudget {
        QuestionBudget {
            tests: COMPARISONS,
            products: PRODUCTS,
            last: dag.len() + EXPRESSIONS,
        }
    }
}

impl Space {
    /// The answer to a question on an expression, within a budget of its own; `None` where that is spent.
    pub(crate) fn question<T>(
        &mut self,
        of: Node,
        answer: impl FnOnce(&mut Space) -> Option<T>,
    ) -> Option<T> {
        self.budget = QuestionBudget::new(&self.model.dag);
        let found = answer(self);
        // Expressions made after the limits may hold anything.
        let Some(limit) = self.spent() else {
            return found;
        };
        self.ended = self.ended.or(Some(limit));
        self.meets(limit, of);
        None
    }
    /// The limit at which the budget is spent.
    fn spent(&self) -> Option<Limit> {
        match self.budget {
            QuestionBudget { tests: 0, .. } => Some(Limit::Comparisons),
            QuestionBudget { products: 0, .. } => Some(Limit::Products),
            QuestionBudget { last, .. } if self.model.dag.len() > last => Some(Limit::Expressions),
            _ => None,
        }
    }
    /// Returns true if the question has spent its budget.
    pub(crate) fn is_spent(&self) -> bool {
        self.spent().is_some()
    }
    /// Returns true if the search for a flow of an expression ended at a limit.
    pub(crate) fn ends_at(&self, node: Node) -> bool {
        self.met.contains_key(&node)
    }
    /// The limit that was met at an expression; otherwise the first that any question met.
    pub(crate) fn limit(&self, node: Node) -> Option<Limit> {
        self.met.get(&node).copied().or(self.ended)
    }
    /// Notes that a limit ended the search for a flow of an expression.
    pub(crate) fn meets(&mut self, limit: Limit, node: Node) {
        self.met.insert(node, limit);
    }
}
