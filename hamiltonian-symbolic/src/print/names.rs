//! Names of loop variables, which the arena does not keep.
//!
//! Input: the names a model declares, the loops around a place. Output: a name for each loop.
//! Invariant: a name is neither declared in the model nor a word of the language, and differs from
//! the names of the loops around it.

use crate::index::Domain;
use crate::model::Model;
use crate::op::Op;

const CANDIDATES: &[&str] = &["i", "j", "k", "l", "m", "n", "a", "b", "c", "d"];

/// The loops around the place that is being written, each with its name.
#[derive(Debug)]
pub(super) struct Scope<'a> {
    model: &'a Model,
    bound: Vec<(Domain, String)>,
}

impl<'a> Scope<'a> {
    pub(super) fn new(model: &'a Model, bound: &[(Domain, &str)]) -> Scope<'a> {
        Scope {
            model,
            bound: bound
                .iter()
                .map(|(d, name)| (*d, (*name).to_owned()))
                .collect(),
        }
    }

    /// Enters a loop.
    pub(super) fn enter(&mut self, domain: Domain) {
        let name = self.fresh();
        self.bound.push((domain, name));
    }

    /// Leaves the innermost loop.
    pub(super) fn leave(&mut self) {
        self.bound.pop();
    }

    /// The name of a loop's variable: the innermost binding counts.
    pub(super) fn name(&self, domain: Domain) -> String {
        match self.bound.iter().rev().find(|(d, _)| *d == domain) {
            Some((_, name)) => name.clone(),
            // Not inside its loop: the adjoint of an array element, say.
            None => self.nth_free(self.model.dag.path(Some(domain)).len() - 1),
        }
    }

    fn fresh(&self) -> String {
        let mut at = 0;
        loop {
            let name = self.nth_free(at);
            if self.bound.iter().all(|(_, other)| *other != name) {
                return name;
            }
            at += 1;
        }
    }

    fn nth_free(&self, n: usize) -> String {
        let mut left = n;
        for name in CANDIDATES {
            if !is_taken(self.model, name) {
                if left == 0 {
                    return (*name).to_owned();
                }
                left -= 1;
            }
        }
        let mut at = 1usize;
        loop {
            let name = format!("i{at}");
            if !is_taken(self.model, &name) {
                if left == 0 {
                    return name;
                }
                left -= 1;
            }
            at += 1;
        }
    }
}

/// Whether the model or the language uses a name.
pub(super) fn is_taken(model: &Model, name: &str) -> bool {
    model.declares(name) || name == "pi" || Op::named(name).is_some()
}
