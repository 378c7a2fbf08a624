//! The vector field, and the pieces V and T, with a force or without.
//!
//! Input: a definition. Output: text of the bodies of fields, kicks and drifts.
//! Invariant: a kick reads no coordinate it moves and moves momenta alone.

use super::dynamics::Emission;
use hamiltonian_language::analyse::structure::{FieldSource, Kick};
use hamiltonian_symbolic::program::Purpose;
use std::fmt::Write;

/// The kind of a field, a kick or a drift: a type of core.
fn kind(purpose: Purpose) -> &'static str {
    match purpose {
        Purpose::Push => "__h::Push",
        Purpose::Rates => "__h::Rates",
        Purpose::Linear => "__h::Linear",
        Purpose::Kick => "__h::Kick",
        Purpose::Drift => "__h::Drift",
        _ => "__h::Whole",
    }
}

impl Emission<'_> {
    /// The kind of the piece V.
    pub(super) fn kick_kind(&self) -> &'static str {
        match self.context.definition.structure.kick {
            Some(Kick::Damped { rest: true }) => "__h::Damped",
            Some(Kick::Damped { rest: false }) => "__h::Moves<__h::Push>",
            Some(Kick::Coupled) => "__h::Pushed",
            Some(Kick::SubStep) => "__h::Stepped",
            Some(Kick::Plain) | None => "__h::Shifts<__h::Kick>",
        }
    }

    /// The type of a piece of a kind.
    pub(super) fn emitted(&self, kind: &str) -> String {
        format!("__h::Emitted<{}, {kind}>", self.prepared.ty(self.context))
    }

    /// The kind of the vector field.
    pub(super) fn field_kind(&self) -> &'static str {
        match self.context.definition.field {
            FieldSource::Halves => "__h::Halves",
            FieldSource::Whole => kind(Purpose::VectorField),
            FieldSource::OfGradient => "__h::OfGradient",
        }
    }

    /// Returns true if the kick followed by the drift is the vector field, without shared work.
    pub(super) fn is_in_halves(&self) -> bool {
        self.context.definition.field == FieldSource::Halves
    }

    /// The body of a vector field.
    pub(super) fn field(&mut self, purpose: Purpose) {
        let Some((function, holder)) = self.held_by(purpose, format!("{purpose:?}")) else {
            return;
        };
        self.open_body("FieldBody", kind(purpose), function, &holder, "");
        self.evaluated("add", &holder, &["_q", "_p", "_oq", "_op"], function);
        line!(self, "}}");
    }

    /// The pieces of the kick.
    pub(super) fn kick(&mut self) {
        let structure = &self.context.definition.structure;
        let Some(kick) = structure.kick else {
            return;
        };
        for purpose in kick.purposes() {
            match purpose {
                Purpose::Rates | Purpose::Linear => self.field(*purpose),
                _ => self.flow(*purpose, kind(*purpose), &structure.halves[0], true),
            }
        }
    }

    /// The piece T.
    pub(super) fn drift(&mut self) {
        let structure = &self.context.definition.structure;
        if structure.separable.is_ok() {
            let drift = kind(Purpose::Drift);
            self.flow(Purpose::Drift, drift, &structure.halves[1], true);
        }
    }
}
