//! The ends of arrays in the Hamiltonian of a Lagrangian.
//!
//! Input: the lowered definition, after everything that solves indices (brackets, proofs). Output:
//! the definition, with indices that are safe to read. Momenta of a Lagrangian such as Σ vᵢ qᵢ₋₁
//! read a neighbour under a condition, and emitted code reads both branches. Invariant: other
//! definitions stay as they are.

use super::Lowered;
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::loops::guarded;

/// Makes all expressions safe to read; `None` if the momentum of an element has a loop that would
/// start below 0.
pub fn guard(lowered: &mut Lowered) -> Option<()> {
    if lowered.legendre.is_none() {
        return Some(());
    }
    let model = &mut lowered.model;
    let derived = &lowered.derived;
    let is_written = |node: Node| derived.is_written(node);
    let mut roots = model.roots();
    for root in &mut roots {
        *root = guarded(model, *root, &is_written)?;
    }
    model.set_roots(&roots);
    Some(())
}
