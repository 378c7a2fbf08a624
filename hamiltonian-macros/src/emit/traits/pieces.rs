//! The exact flows of a splitting, and `Split`.
//!
//! Input: a model with pieces. Output: text of the bodies, one a piece, and of the traits that name the pieces.
//! Invariant: a flow reads and writes one point; outside of its domain all it moves becomes NaN, by the program.

use super::dynamics::{Emission, declared, loops, with_self};
use super::markers;
use crate::emit::functions::holder::Holder;
use crate::emit::names::context::Access;
use hamiltonian_language::analyse::structure::{Nystrom, Reason};
use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::ExactFlow;
use hamiltonian_symbolic::program::{Function, Program, Purpose};
use std::fmt::Write;

/// The value of a piece.
pub const PIECE: &str = "__h::Emitted::PIECE";

impl Emission<'_> {
    /// The flows of the model's pieces.
    pub(super) fn pieces(&mut self) {
        let mut is_matrix = false;
        for (number, piece) in self.context.model.pieces.iter().enumerate() {
            let kind = format!("__h::Numbered<{number}>");
            let purpose = Purpose::Piece(number as u16);
            self.flow(purpose, &kind, &piece.name, piece.flow.merges());
            is_matrix |= self.rows(number).is_some();
        }
        if is_matrix {
            line!(
                self,
                "impl{} __h::Origin<T> for {} {{\nfn origin() -> {} {{ {} }}\n}}",
                self.context.generics.holder_declaration(),
                self.prepared.ty(self.context),
                self.vector,
                self.context.zeros(),
            );
        }
    }

    /// The number of rows of the matrix of a piece, if its flow is one.
    fn rows(&self, number: usize) -> Option<usize> {
        match self.context.model.pieces[number].flow {
            ExactFlow::Exponential => self.context.model.components(),
            _ => None,
        }
    }

    /// The type of one of the model's pieces.
    fn numbered(&self, number: usize) -> String {
        let kind = format!("__h::Numbered<{number}>");
        let function = (self.context.program).function(Purpose::Piece(number as u16));
        self.emitted(&match (self.rows(number), function) {
            (Some(rows), _) => format!("__h::Matrices<{kind}, {rows}>"),
            (None, Some(function)) if self.context.program.one_way(function).is_some() => {
                format!("__h::Shifts<{kind}>")
            }
            _ => format!("__h::Moves<{kind}>"),
        })
    }

    /// `Separable`, `Split` and `Nystrom`: of V and T, or of the model's pieces, with the kick of a force.
    pub(super) fn structures(&mut self) {
        let context = self.context;
        let (structure, own) = (&context.definition.structure, &context.model.pieces);
        let kick = self.kick_kind();
        let halves = [kick, "__h::Shifts<__h::Drift>"].map(|kind| self.emitted(kind));
        let split = match structure.is_drift_first() {
            true => "DriftFirst",
            false => "Split",
        };
        let of_halves = [
            ("Separable", structure.separable.is_ok()),
            (split, structure.split.is_ok() && own.is_empty()),
            ("Nystrom", matches!(structure.nystrom, Ok(Nystrom::Halves))),
        ];
        let of_halves: Vec<&str> = (of_halves.into_iter())
            .filter_map(|(name, is_there)| is_there.then_some(name))
            .into_list();
        if !of_halves.is_empty() {
            line!(
                self,
                "__h::halves!([impl{}] {}, {}, {kick}: {});",
                context.generics.declaration(),
                context.generics.system_type(),
                self.prepared.ty(context),
                of_halves.join(" "),
            );
        }
        let mut own: Vec<String> = (0..own.len()).map(|at| self.numbered(at)).into_list();
        let kicked = structure.nystrom.as_ref().map(|nystrom| match nystrom {
            Nystrom::Halves => halves.clone(),
            Nystrom::Pieces(numbers) => numbers.map(|number| own[number].clone()),
        });
        if structure.is_forced_apart() {
            own.push(halves[0].clone());
        }
        let values = format!("({})", format!("{PIECE}, ").repeat(own.len()));
        let tuple = [format!("({},)", own.join(", "))];
        let mut of_pieces = |name, types: &[&str], pieces, bound| {
            let name_of_halves = if name == "Split" { split } else { name };
            if !of_halves.contains(&name_of_halves) {
                let pieces: Result<markers::Pieces, &Reason> = pieces;
                let pieces = pieces.map_err(|reason| (bound, reason));
                markers::of_pieces(&mut self.out, context, name, types, pieces);
            }
        };
        let separable = structure.separable.as_ref();
        let separable = separable.map(|()| (&halves[..], PIECE));
        of_pieces("Separable", &["Kick", "Drift"], separable, "__HIsSeparable");
        let split = structure
            .split
            .as_ref()
            .map(|()| (&tuple[..], values.as_str()));
        of_pieces("Split", &["Pieces"], split, "__HIsSplit");
        let kicked = kicked.as_ref();
        let kicked = kicked.map(|pieces| (&pieces[..], PIECE));
        let kicked = kicked.map_err(|reason| *reason);
        of_pieces(
            "Nystrom",
            &["Kick", "Quadratic"],
            kicked,
            "__HIsKickedQuadratic",
        );
    }

    /// The bodies of an exact flow.
    pub(super) fn flow(&mut self, purpose: Purpose, kind: &str, label: &str, merges: bool) {
        let name = format!("{purpose:?}").replace(['(', ')'], "");
        let Some((function, holder)) = self.held_by(purpose, name) else {
            return;
        };
        let mut constants = format!("const NAME: &'static __h::str = {label:?};\n");
        if !merges {
            constants.push_str("const MERGES: __h::bool = false;\n");
        }
        // A flow that is a matrix is made of the whole point.
        let rows = match purpose {
            Purpose::Piece(number) => self.rows(usize::from(number)),
            _ => None,
        };
        if let (Some(from), None) = (self.context.program.one_way(function), rows) {
            let kicks = from == Side::Q;
            if !kicks {
                constants.push_str("const KICKS: __h::bool = false;\n");
            }
            self.open_body("Shift", kind, function, &holder, &constants);
            let vectors = if kicks { ["_q", "_op"] } else { ["_p", "_oq"] };
            self.evaluated("add", &holder, &vectors, function);
        } else {
            self.open_body("FlowBody", kind, function, &holder, &constants);
            self.bodies.context.access = Access::InPlace;
            self.evaluated("apply", &holder, &["_oq", "_op"], function);
            if !merges {
                self.bodies.context.access = Access::Reversed;
                self.evaluated("apply_reversed", &holder, &["_oq", "_op"], function);
            }
            self.bodies.context.access = Access::Apart;
        }
        line!(self, "}}");
    }

    /// The head of the bodies of a kind, and the body from prepared values and the coefficient to what is held.
    pub(super) fn open_body(
        &mut self,
        name: &str,
        kind: &str,
        function: &Function,
        holder: &Holder,
        constants: &str,
    ) {
        let made = with_self(&self.made(function, holder));
        // The loop over a chain may take less time than some calls.
        let shared = match loops(&function.evaluation) {
            2.. => Some("All"),
            _ => is_long(self.context.program, function).then_some("InPacks"),
        };
        let shared =
            shared.map(|of| format!("const SHARED: __h::SharedCode = __h::SharedCode::{of};\n"));
        let shared = shared.unwrap_or_default();
        line!(
            self,
            "#[automatically_derived]\nimpl{} __h::{name}<{kind}, T> for {} {{\n\
             {constants}{shared}type Held = {};\n#[inline(always)]\nfn fold(&self, _c: T) -> Self::Held {{\n{made}\n}}",
            self.context.generics.holder_declaration(),
            self.prepared.ty(self.context),
            holder.held(),
        );
    }

    /// The body of an evaluation over what is held.
    pub(super) fn evaluated(
        &mut self,
        method: &str,
        holder: &Holder,
        vectors: &[&'static str],
        function: &Function,
    ) {
        let name = format!("{}_{method}", holder.name);
        let data = format!("&{}", self.context.generics.holder_type("__D"));
        let mut arguments = vec![("_d", data)];
        arguments.extend(self.arguments(vectors));
        let (text, _) = self.evaluation(&name, Some(holder), &arguments, function);
        let list = declared(&arguments);
        line!(
            self,
            "#[inline(always)]\nfn {method}(_self: &Self::Held, {list}) {{\n{text}}}"
        );
    }
}

/// Returns true if the code of a function is so long that a call is short beside it.
fn is_long(program: &Program, function: &Function) -> bool {
    const LONG: usize = 250;
    // The instructions of an elementary function, about.
    const FUNCTION: usize = 30;
    let operations = program.operations(function);
    operations.total() + (FUNCTION - 1) * operations.functions >= LONG
}
