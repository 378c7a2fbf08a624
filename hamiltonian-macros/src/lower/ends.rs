//! The ends of arrays in what a Lagrangian became.
//!
//! Input: the lowered definition, after everything that solves indices (brackets, proofs). Output:
//! the same, safe to read. Momenta of a Lagrangian such as Σ vᵢ qᵢ₋₁ read a neighbour under a
//! condition, and emitted code reads both branches. Invariant: other definitions stay as they are.

use super::Lowered;
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::loops::guarded;

/// Makes all expressions safe to read; `None` where the momentum of an element has a loop that would
/// start below 0.
pub fn guard(lowered: &mut Lowered) -> Option<()> {
    let Some(legendre) = &lowered.legendre else {
        return Some(());
    };
    let model = &mut lowered.model;
    let derived = &lowered.derived;
    let is_written = |node: Node| derived.is_written(node);
    let mut is_safe = true;
    for momentum in &legendre.momenta {
        is_safe &= guarded(model, momentum.value, &is_written)? == momentum.value;
    }
    if is_safe {
        return Some(());
    }
    let mut observables = std::mem::take(&mut model.observables);
    let mut vectors = std::mem::take(&mut model.vectors);
    let places = (model.hamiltonian.iter().copied())
        .chain(observables.iter().flat_map(|o| o.components.clone()))
        .chain(vectors.iter().flat_map(|v| &v.entries).map(|e| e.value))
        .chain(lowered.split.iter().copied())
        .chain(lowered.force.iter().map(|entry| entry.value))
        .chain(lowered.factor);
    let values: Vec<_> = places.collect();
    let mut images = Vec::with_capacity(values.len());
    for value in values {
        images.push(guarded(model, value, &is_written)?);
    }
    let places = (model.hamiltonian.iter_mut())
        .chain(observables.iter_mut().flat_map(|o| &mut o.components))
        .chain((vectors.iter_mut().flat_map(|v| &mut v.entries)).map(|e| &mut e.value))
        .chain(&mut lowered.split)
        .chain(lowered.force.iter_mut().map(|entry| &mut entry.value))
        .chain(&mut lowered.factor);
    for (place, image) in places.zip(images) {
        *place = image;
    }
    (model.observables, model.vectors) = (observables, vectors);
    Some(())
}
