//! The questions of the search, each within a budget of its own.
//!
//! Input: a question. Output: its answer, or none and the limit at which it ended. Invariant: questions are not nested,
//! and what was found after a budget was spent is no answer.

use super::Space;
use crate::dag::{Dag, Map, Node};
use crate::flows::limits::{
    ALL_EXPRESSIONS, ALL_PRODUCTS, COMPARISON, COMPARISONS, EXPRESSIONS, Limit, PRODUCTS,
};

/// The questions of a search: the one that is answered, and the limits that others met.
pub(super) struct Questions {
    open: Option<Question>,
    /// The number of products of all questions before.
    products: usize,
    /// The size of the arena before all.
    start: usize,
    /// The limits that were met at an expression alone.
    met: Map<Node, Limit>,
    /// The expressions of whose flows the search ended at a limit.
    ended: Vec<(Node, Limit)>,
}

/// A question that is answered, with its use of the budget.
struct Question {
    /// The expression whose flow is sought.
    of: Option<Node>,
    /// The number of comparisons.
    comparisons: usize,
    /// The number of products in the normal form.
    products: usize,
    /// True if a comparison would have taken more.
    lacks_products: bool,
    /// The size of the arena at its beginning.
    start: usize,
}

impl Questions {
    pub(super) fn new(dag: &Dag) -> Questions {
        Questions {
            open: None,
            products: 0,
            start: dag.len(),
            met: Map::default(),
            ended: Vec::new(),
        }
    }
}

impl Space {
    /// The answer to a question on an expression, within a budget of its own; `None` also where that is spent.
    pub(crate) fn question<T>(
        &mut self,
        of: Node,
        answer: impl FnOnce(&mut Space) -> Option<T>,
    ) -> Option<T> {
        let (found, limit) = self.answered(Some(of), answer);
        if let Some(limit) = limit {
            // It ended the question, not a long comparison before.
            let ended = &mut self.questions.ended;
            ended.retain(|(other, _)| *other != of);
            ended.push((of, limit));
        }
        found
    }
    /// Returns true if something is proven, within a budget of its own.
    pub(crate) fn proves(&mut self, is_proven: impl FnOnce(&mut Space) -> bool) -> bool {
        let answer = |space: &mut Space| is_proven(space).then_some(());
        self.answered(None, answer).0.is_some()
    }
    fn answered<T>(
        &mut self,
        of: Option<Node>,
        answer: impl FnOnce(&mut Space) -> Option<T>,
    ) -> (Option<T>, Option<Limit>) {
        assert!(
            self.questions.open.is_none(),
            "a question within a question"
        );
        let start = self.model.dag.len();
        if self.questions.products > ALL_PRODUCTS {
            return (None, Some(Limit::AllProducts));
        }
        if start - self.questions.start > ALL_EXPRESSIONS {
            return (None, Some(Limit::AllExpressions));
        }
        self.questions.open = Some(Question {
            of,
            comparisons: 0,
            products: 0,
            lacks_products: false,
            start,
        });
        let found = answer(self);
        let limit = self.spent();
        let used = self.questions.open.take().map_or(0, |open| open.products);
        self.questions.products += used;
        // Expressions made after the limits may hold anything.
        (found.filter(|_| limit.is_none()), limit)
    }
    /// The limit at which the budget is spent.
    fn spent(&self) -> Option<Limit> {
        let open = self.questions.open.as_ref()?;
        match () {
            () if open.comparisons > COMPARISONS => Some(Limit::Comparisons),
            () if open.lacks_products => Some(Limit::Products),
            () => (self.model.dag.len() - open.start > EXPRESSIONS).then_some(Limit::Expressions),
        }
    }
    /// Returns true if the question has spent its budget.
    pub(crate) fn is_spent(&self) -> bool {
        self.spent().is_some()
    }
    /// The answer to a comparison that may take a number of products, `None` where that would spend the budget or no
    /// question is open.
    pub(super) fn compared<T>(
        &mut self,
        compare: impl FnOnce(&mut Space, &mut usize) -> T,
        is_long: impl FnOnce(&T) -> bool,
    ) -> Option<T> {
        let open = self.questions.open.as_mut()?;
        open.comparisons += 1;
        let own = COMPARISON.min(PRODUCTS - open.products);
        if self.is_spent() {
            return None;
        }
        let mut left = own;
        let answer = compare(self, &mut left);
        let open = self.questions.open.as_mut()?;
        open.products += own - left;
        if is_long(&answer) {
            if own < COMPARISON {
                open.lacks_products = true;
                return None;
            }
            let ended = open.of.map(|of| (of, Limit::Comparison));
            self.questions.ended.extend(ended);
        }
        Some(answer)
    }
    /// Returns true if the search for a flow of an expression ended at a limit.
    pub(crate) fn ends_at(&self, node: Node) -> bool {
        self.questions.ended.iter().any(|(of, _)| *of == node)
    }
    /// The limit that was met at an expression; otherwise the first that was met at one with its variables.
    pub(crate) fn limit(&mut self, node: Node) -> Option<Limit> {
        if let Some(limit) = self.questions.met.get(&node) {
            return Some(*limit);
        }
        let own = self.set(node);
        let ended = self.questions.ended.clone().into_iter();
        let mut ended = ended.filter(|(of, _)| own.is_within(self.set(*of)));
        ended.next().map(|(_, limit)| limit)
    }
    /// Notes that a limit ended the search for a flow of an expression, unless the budget did so before.
    pub(crate) fn meets(&mut self, limit: Limit, node: Node) {
        if !self.is_spent() {
            self.questions.met.insert(node, limit);
        }
    }
}
