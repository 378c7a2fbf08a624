//! Exact splittings: H as a sum of few pieces, each with a flow in closed form.
//!
//! Input: a model. Output: the flow of a piece ([`exact_flow`]). Invariant: an exact flow is proven to be one: a piece is an
//! instance of a row of [`ROWS`], or is made of such by rules that are theorems.

mod formula;
mod growth;
mod motion;
mod rows;
mod solve;
mod space;

pub use motion::{Motion, Move};
pub use rows::{ROWS, Row, row};

use crate::dag::Node;
use crate::model::Model;

/// A flow in closed form.
#[derive(Clone, Debug)]
pub struct ExactFlow {
    /// What moves in the time of the step coefficient.
    pub motion: Motion,
    /// The names of the rows it is made of; none for a piece that is linear in time.
    pub rows: Vec<&'static str>,
}

/// The exact flow of one expression; expressions that were made are in the model's arena.
pub fn exact_flow(model: &mut Model, h: Node) -> Option<ExactFlow> {
    let mut space = space::Space::new(model, &[h])?;
    let c = space.dag().coefficient();
    let found = solve::flow(&mut space, h, c)?;
    model.dag = space.model.dag;
    Some(ExactFlow {
        motion: found.motion,
        rows: found.rows,
    })
}
