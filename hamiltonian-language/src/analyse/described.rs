//! The description of a system: its formula, its observables, its pieces, and what jumps in time.
//!
//! Input: a system of an analysis. Output: [`Described`]. Invariant: the pieces stand in the order of core's
//! `Split::pieces`.

use super::structure::{Nystrom, Text, Verdicts};
use hamiltonian_symbolic::dag::Dependence;
use hamiltonian_symbolic::model::{Model, ObservableKind};
use hamiltonian_symbolic::print;
use std::fmt::Write;

/// The facts that a run reads of a system.
#[derive(Debug)]
pub struct Described {
    /// H in the author's notation, and the force.
    pub formula: String,
    /// True if the kick jumps in time, and the same for the rest of H.
    pub jumps: [bool; 2],
    /// Monitors, invariants and events, one a component.
    pub observables: Vec<DescribedObservable>,
    /// The pieces with exact flows; none where H does not split.
    pub pieces: Vec<DescribedPiece>,
}

/// A component of an observable.
#[derive(Debug)]
pub struct DescribedObservable {
    /// Its declaration.
    pub kind: ObservableKind,
    /// Its name: `height`, or `angular_momentum[2]`.
    pub name: String,
    /// True if time is in it.
    pub timed: bool,
    /// True if it reads coordinates, and the same for momenta.
    pub reads: [bool; 2],
}

/// A piece of a splitting.
#[derive(Debug)]
pub struct DescribedPiece {
    /// Its name.
    pub name: String,
    /// Its formula.
    pub formula: String,
    /// True if it jumps at times that do not depend on the state.
    pub jumps: bool,
}

impl Described {
    /// The description of a system with a model, its proven structure and its texts.
    pub fn of(model: &Model, structure: &Verdicts, text: &Text) -> Described {
        Described {
            formula: formula(model, text),
            jumps: jumps(structure),
            observables: observables(model),
            pieces: pieces(model, structure),
        }
    }
}

fn formula(model: &Model, text: &Text) -> String {
    let mut formula = text.hamiltonian.clone();
    for force in &model.force {
        let momentum = model.groups[usize::from(force.at.group)].name(force.at.side);
        let value = print::text(model, force.value);
        let _ = write!(
            formula,
            "; force on {momentum}, column {}: {value}",
            force.at.column
        );
    }
    formula
}

fn jumps(structure: &Verdicts) -> [bool; 2] {
    let Some(jumping) = &structure.jumping else {
        return [false; 2];
    };
    match &structure.nystrom {
        _ if structure.separable.is_ok() => jumping.halves,
        Ok(Nystrom::Pieces(numbers)) => numbers.map(|number| jumping.pieces[number]),
        _ => [true; 2],
    }
}

fn pieces(model: &Model, structure: &Verdicts) -> Vec<DescribedPiece> {
    if structure.split.is_err() {
        return Vec::new();
    }
    let entry = |name: &str, formula: &str, jumps: bool| DescribedPiece {
        name: name.to_owned(),
        formula: formula.to_owned(),
        jumps,
    };
    let halves = structure.jumping.as_ref().map(|jumping| jumping.halves);
    let halves = halves.unwrap_or_default();
    let mut all: Vec<DescribedPiece> = Vec::new();
    if model.pieces.is_empty() {
        let half = |at: usize| {
            let text = &structure.halves[at];
            entry(text, text, halves[at])
        };
        all = [0, 1].map(half).into();
        if structure.is_drift_first() {
            all.reverse();
        }
    }
    let jumping = structure.jumping.as_ref();
    let jumps = |at: usize| jumping.is_some_and(|jumping| jumping.pieces[at]);
    for (at, piece) in model.pieces.iter().enumerate() {
        all.push(entry(&piece.name, &print::text(model, piece.h), jumps(at)));
    }
    if structure.is_forced_apart() {
        let force = &structure.halves[0];
        all.push(entry(force, force, jumps(model.pieces.len())));
    }
    all
}

fn observables(model: &Model) -> Vec<DescribedObservable> {
    let mut all = Vec::new();
    for observable in &model.observables {
        for (component, node) in observable.components.iter().enumerate() {
            let name = match observable.components.len() {
                1 => observable.name.clone(),
                _ => format!("{}[{component}]", observable.name),
            };
            let dependence = model.dag.dependence(*node);
            all.push(DescribedObservable {
                kind: observable.kind,
                name,
                timed: dependence.on(Dependence::TIME),
                reads: [Dependence::Q, Dependence::P].map(|half| dependence.on(half)),
            });
        }
    }
    all
}
