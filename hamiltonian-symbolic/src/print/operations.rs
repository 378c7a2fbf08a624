//! Counts of operations with the loops they stand in.
//!
//! Input: a model and a function of its program. Output: one [`Count`] for operations that are done once, one
//! for each loop in which anything is done. Invariant: added up they are the operations of the
//! function, each loop body counted once.

use super::layout::Writer;
use super::text::TEXT;
use crate::count::Operations;
use crate::index::Domain;
use crate::model::Model;
use crate::program::{Function, Program};

/// The operations of one place.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Count {
    /// The loops around it: `i in 0..n, j in 0..i`; nothing outside of loops.
    pub place: String,
    /// The operations of one iteration, without those of loops inside.
    pub operations: Operations,
}

/// The operations of a function, place by place.
#[must_use]
pub fn operations(model: &Model, program: &Program, function: &Function) -> Vec<Count> {
    let writer = Writer::new(model, &TEXT, &[]);
    let head = |domain: &Domain| {
        let range = model.dag.range(*domain);
        let (start, end) = (writer.affine(&range.start), writer.affine(&range.end));
        format!("{} in {start}..{end}", writer.variable(*domain))
    };
    let mut counts = Vec::new();
    for (domain, operations) in program.operations_by_loop(function) {
        if domain.is_some() && operations.total() == 0 {
            continue;
        }
        let heads: Vec<String> = model.dag.path(domain).iter().map(head).collect();
        counts.push(Count {
            place: heads.join(", "),
            operations,
        });
    }
    counts
}
