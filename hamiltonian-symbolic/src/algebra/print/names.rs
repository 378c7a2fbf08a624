//! Names of loop variables, which the arena does not keep.
//!
//! Input: the names a model declares, the loops around a place. Output: a name for each loop.
//! Invariant: a name is neither declared in the model nor a word of the language, and differs from
//! the names of the loops around it.

use crate::index::Domain;
use crate::list::IntoList;
use crate::model::Model;
use crate::op::Op;

const CANDIDATES: &[&str] = &["i", "j", "k", "l", "m", "n", "a", "b", "c", "d"];

/// The loops around the place that is being written, each with its name.
#[derive(Debug)]
pub(super) struct LoopNames<'a> {
    model: &'a Model,
    bound: Vec<(Domain, String)>,
}

impl<'a> LoopNames<'a> {
    pub(super) fn new(model: &'a Model, bound: &[(Domain, &str)]) -> LoopNames<'a> {
        LoopNames {
            model,
            bound: bound
                .iter()
                .map(|(d, name)| (*d, (*name).to_owned()))
                .into_list(),
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
            None => {
                let depth = self.model.dag.path(Some(domain)).len();
                self.free().nth(depth - 1).unwrap_or_default()
            }
        }
    }

    fn fresh(&self) -> String {
        let is_bound = |name: &String| self.bound.iter().any(|(_, other)| other == name);
        let mut names = self.free();
        names.find(|name| !is_bound(name)).unwrap_or_default()
    }

    /// Names that neither the model nor the language uses, without end.
    fn free(&self) -> impl Iterator<Item = String> {
        let short = CANDIDATES.iter().map(|name| (*name).to_owned());
        let numbered = (1u32..).map(|at| format!("i{at}"));
        let names = short.chain(numbered);
        names.filter(|name| !is_taken(self.model, name))
    }
}

/// Returns true if the model or the language uses a name.
pub(crate) fn is_taken(model: &Model, name: &str) -> bool {
    model.declares(name) || name == "pi" || Op::named(name).is_some()
}
