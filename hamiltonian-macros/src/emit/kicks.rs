//! The vector field, and the flows of V and T, with a force or without.
//!
//! Input: a definition. Output: text of the holders with their evaluation, of the pieces, and of
//! `Separable`. Invariant: a kick reads no coordinate it moves and moves momenta alone.

use super::dynamics::{Emission, evaluation};
use super::holder::Receiver;
use super::{Kick, derived};
use hamiltonian_symbolic::program::Purpose;
use std::fmt::Write;

macro_rules! line {
    ($emission:expr, $($text:tt)*) => {{
        // Writing to a string does not fail.
        let _ = writeln!($emission.out, $($text)*);
    }};
}

/// The holder of a field, a kick or a drift, with its inputs and outputs.
fn signature(
    purpose: Purpose,
) -> (
    &'static str,
    &'static [&'static str],
    &'static [&'static str],
) {
    match purpose {
        Purpose::Push => ("__Push", &[], &["_oq", "_op"]),
        Purpose::Rates => ("__Rates", &["_q", "_p"], &["_oq", "_op"]),
        Purpose::Linear => ("__Linear", &["_q", "_p"], &["_oq", "_op"]),
        Purpose::Kick => ("__Kick", &["_q"], &["_op"]),
        Purpose::Drift => ("__Drift", &["_p"], &["_oq"]),
        _ => ("__Field", &["_q", "_p"], &["_oq", "_op"]),
    }
}

impl Emission<'_> {
    /// The holder of a field, a kick or a drift with its evaluation.
    pub(super) fn flow(&mut self, purpose: Purpose) {
        let (name, inputs, outputs) = signature(purpose);
        let generics = self.generics;
        let Some((function, holder)) = self
            .context
            .program
            .function(purpose)
            .zip(self.holder(purpose, name))
        else {
            self.out.push_str(&derived::flow(generics, &self.vector));
            return;
        };
        holder.declare(&mut self.out, self.context, generics);
        let mut arguments = vec![("_t", "T".to_owned())];
        for name in inputs.iter().chain(outputs).copied() {
            let mutable = if name.starts_with("_o") { "mut " } else { "" };
            arguments.push((name, format!("&{mutable}{}", self.vector)));
        }
        let list: Vec<String> = arguments
            .iter()
            .map(|(name, ty)| format!("{name}: {ty}"))
            .collect();
        let (declaration, holders) = (generics.holder_declaration(), generics.holder_arguments());
        let vector = &self.vector;
        let piece = match purpose {
            Purpose::Push => Some((0, "let (_oq, _op) = (&mut _x.q, &mut _x.p);")),
            Purpose::Kick => Some((0, "let (_q, _op) = (&_x.q, &mut _x.p);")),
            Purpose::Drift => Some((1, "let (_p, _oq) = (&_x.p, &mut _x.q);")),
            _ => None,
        };
        let parts = match piece {
            None => {
                line!(
                    self,
                    "#[automatically_derived]\nimpl{declaration} __h::VectorField<{vector}> for \
                     {name}{holders} {{\n#[inline(always)]\nfn add(&self, {}) {{",
                    list.join(", "),
                );
                ""
            }
            Some((number, parts)) => {
                line!(
                    self,
                    "#[automatically_derived]\nimpl{declaration} __h::Flow<__h::Point<{vector}>> for \
                     {name}{holders} {{\n\
                     const NAME: &'static __h::core::primitive::str = {:?};\ntype Work = ();\n\
                     #[inline(always)]\n\
                     fn apply(&self, _t: T, _x: &mut __h::Point<{vector}>, _: &mut ()) {{",
                    self.definition.structure.halves[number],
                );
                parts
            }
        };
        let receiver = Receiver::Holder(&holder);
        // A damped kick reads the momenta it writes, each before it is written.
        self.bodies.context.in_place = purpose == Purpose::Push;
        let text = evaluation(&mut self.bodies, name, receiver, &arguments, function);
        self.bodies.context.in_place = false;
        line!(self, "let _self = self;\n{parts}\n{text}");
        line!(self, "}}\n}}");
    }

    /// The piece that kicks.
    pub(super) fn kick(&mut self) {
        let Some(kick) = self.definition.structure.kick else {
            return;
        };
        let purposes = kick.purposes();
        for purpose in purposes {
            self.flow(*purpose);
        }
        let (before, between, after) = match kick {
            Kick::Plain | Kick::Damped { rest: false } => ("", "", ""),
            Kick::Damped { rest: true } => ("__h::Both({", "}, {", "})"),
            Kick::Coupled => ("__h::Coupled { field: {", "}, linear: {", "} }"),
            Kick::SubStep => ("__h::SubStep({", "", "})"),
        };
        let holder = |purpose: &Purpose| {
            let (name, ..) = signature(*purpose);
            format!("{name}{}", self.generics.holder_arguments())
        };
        let holders: Vec<String> = purposes.iter().map(holder).collect();
        let ty = match kick {
            Kick::Plain | Kick::Damped { rest: false } => holders.concat(),
            Kick::Damped { rest: true } => format!("__h::Both<{}>", holders.join(", ")),
            Kick::Coupled => format!("__h::Coupled<{}>", holders.join(", ")),
            Kick::SubStep => format!("__h::SubStep<{}>", holders.concat()),
        };
        self.begin_piece("__KickPiece", &ty);
        line!(self, "{before}");
        for (at, purpose) in purposes.iter().enumerate() {
            if at > 0 {
                line!(self, "{between}");
            }
            self.coefficients(*purpose, signature(*purpose).0);
        }
        line!(self, "{after}\n}}\n}}");
    }

    /// The piece T, and the splitting into V and T.
    pub(super) fn separable(&mut self) {
        if self.definition.structure.separable.is_err() {
            return;
        }
        self.flow(Purpose::Drift);
        self.maker(Purpose::Drift, "__Drift", "__DriftPiece");
        line!(
            self,
            "#[automatically_derived]\nimpl{declaration} __h::Separable<T> for {system} {{\n\
             type Kick = __KickPiece;\ntype Drift = __DriftPiece;\n\
             const KICK: __KickPiece = __KickPiece;\nconst DRIFT: __DriftPiece = __DriftPiece;\n}}",
            declaration = self.generics.declaration_with_scalar(),
            system = self.generics.system_type(),
        );
        if self.context.model.pieces.is_empty() {
            let halves = self.definition.structure.halves.clone();
            self.split(&["__KickPiece", "__DriftPiece"], &halves);
        }
    }
}
