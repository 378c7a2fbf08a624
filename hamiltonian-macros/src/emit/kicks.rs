//! The vector field, and the pieces V and T, with a force or without.
//!
//! Input: a definition. Output: text of the fields with their holders, of the pieces that kick and
//! drift, and of `Separable`. Invariant: a kick reads no coordinate it moves and moves momenta alone.

use super::Kick;
use super::dynamics::{Emission, declared};
use super::{derived, markers};
use hamiltonian_symbolic::program::Purpose;
use std::fmt::Write;

/// The pieces V and T.
pub const HALVES: [&str; 2] = ["__KickPiece", "__DriftPiece"];

/// The holder of a field, a kick or a drift.
fn holder(purpose: Purpose) -> &'static str {
    match purpose {
        Purpose::Push => "__Push",
        Purpose::Rates => "__Rates",
        Purpose::Linear => "__Linear",
        Purpose::Kick => "__Kick",
        Purpose::Drift => "__Drift",
        _ => "__Field",
    }
}

impl Emission<'_> {
    /// A vector field: its holder with its evaluation.
    pub(super) fn field(&mut self, purpose: Purpose) {
        let (context, name) = (self.context, holder(purpose));
        let Some((function, holder)) = self.held_by(purpose, name) else {
            self.out
                .push_str(&derived::flow(context.generics, &self.vector));
            return;
        };
        holder.declare(&mut self.out, context);
        let arguments = self.arguments(&["_q", "_p", "_oq", "_op"]);
        let text = self.evaluation(name, Some(&holder), &arguments, function);
        line!(
            self,
            "#[automatically_derived]\nimpl{} __h::VectorField<{}> for {} {{\n\
             #[inline(always)]\nfn add(&self, {}) {{\nlet _self = self;\n{text}}}\n}}",
            context.generics.holder_declaration(),
            self.vector,
            holder.ty(context),
            declared(&arguments),
        );
    }

    /// The piece that kicks.
    pub(super) fn kick(&mut self) {
        let structure = &self.context.definition.structure;
        let Some(kick) = structure.kick else {
            return;
        };
        let (mut types, mut values) = (Vec::new(), Vec::new());
        for purpose in kick.purposes() {
            let name = holder(*purpose);
            match purpose {
                Purpose::Rates | Purpose::Linear => self.field(*purpose),
                _ => self.flow(*purpose, name, &structure.halves[0], true),
            }
            types.push(self.context.generics.holder_type(name));
            values.push(self.made(*purpose, name));
        }
        let (types, values) = (types.join(", "), values.as_slice());
        let (ty, value) = match (kick, values) {
            (Kick::Coupled, [field, linear]) => (
                format!("__h::Coupled<{types}>"),
                format!("__h::Coupled {{ field: {{ {field} }}, linear: {{ {linear} }} }}"),
            ),
            (_, [damped, rest]) => (
                format!("__h::Both<{types}>"),
                format!("__h::Both({{ {damped} }}, {{ {rest} }})"),
            ),
            (Kick::SubStep, _) => (
                format!("__h::SubStep<{types}>"),
                format!("__h::SubStep({{ {} }})", values.concat()),
            ),
            _ => (types, values.concat()),
        };
        self.maker(HALVES[0], &ty, &value);
    }

    /// The piece T, and `Separable`.
    pub(super) fn separable(&mut self) {
        let (context, structure) = (self.context, &self.context.definition.structure);
        let pieces = structure.separable.as_ref().map(|()| {
            self.flow(Purpose::Drift, "__Drift", &structure.halves[1], true);
            let drift = self.made(Purpose::Drift, "__Drift");
            let ty = context.generics.holder_type("__Drift");
            self.maker(HALVES[1], &ty, &drift);
            HALVES.map(str::to_owned)
        });
        let pieces = pieces.as_ref().map(<[String; 2]>::as_slice);
        let pieces = pieces.map_err(|reason| ("__HIsSeparable", *reason));
        markers::of_pieces(
            &mut self.out,
            context,
            "Separable",
            &["Kick", "Drift"],
            pieces,
            "",
        );
    }
}
