//! The exact flows of a splitting: of each piece a flow that holds its constants and the unit struct
//! that makes it, and `Split`.
//!
//! Input: a model with pieces. Output: text of the implementations. Invariant: a flow reads and
//! writes one point; outside of its domain all it moves becomes NaN, by the program.

use super::Nystrom;
use super::context::Access;
use super::dynamics::Emission;
use super::holder::Holder;
use super::kicks::HALVES;
use super::layout::Slice;
use super::markers;
use super::scan::scan;
use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::model::ExactFlow;
use hamiltonian_symbolic::program::{Function, Purpose};
use std::fmt::Write;

impl Emission<'_> {
    /// The flows of the model's pieces.
    pub(super) fn pieces(&mut self) {
        for number in 0..self.context.model.pieces.len() {
            self.piece(number);
        }
    }

    /// `Split`, into the model's pieces with the kick of a force, or into V and T.
    pub(super) fn split(&mut self) {
        let (context, generics) = (self.context, self.context.generics);
        let (structure, own) = (&context.definition.structure, &context.model.pieces);
        let mut pieces: Vec<String> = (0..own.len()).map(|at| format!("__Piece{at}")).collect();
        let mut names: Vec<String> = own.iter().map(|piece| piece.name.clone()).collect();
        if own.is_empty() {
            pieces = HALVES.map(str::to_owned).to_vec();
            names = structure.halves.to_vec();
        } else if structure.kick.is_some() && structure.separable.is_err() {
            pieces.push(HALVES[0].to_owned());
            names.push(structure.halves[0].clone());
        }
        let tuple = [format!("({},)", pieces.join(", "))];
        let (verdict, names) = match &structure.split {
            Ok(()) => (Ok(&tuple[..]), names),
            Err(reason) => (Err(("__HIsSplit", reason)), Vec::new()),
        };
        let list =
            format!("const NAMES: &'static [&'static __h::core::primitive::str] = &{names:?};\n");
        markers::of_pieces(&mut self.out, context, "Split", &["Pieces"], verdict, &list);
        // Over one scalar only, so that `Name::NAMES` is decided.
        if verdict.is_ok() && context.definition.checked.item.is_some() {
            let (constants, system) = generics.over_f64();
            line!(
                self,
                "impl{constants} {system} {{\n/// The pieces of H with exact flows, the outermost first.\n\
                 {visibility} const NAMES: &'static [&'static __h::core::primitive::str] = \
                 <Self as __h::Split<__h::core::primitive::f64>>::NAMES;\n}}",
                visibility = generics.visibility,
            );
        }
    }

    /// `Nystrom`, of V and T or of two of the model's pieces.
    pub(super) fn nystrom(&mut self) {
        let context = self.context;
        let pieces = context.definition.structure.nystrom.as_ref();
        let pieces = pieces.map(|nystrom| match nystrom {
            Nystrom::Halves => HALVES.map(str::to_owned),
            Nystrom::Pieces(numbers) => numbers.map(|number| format!("__Piece{number}")),
        });
        let pieces = pieces.as_ref().map(<[String; 2]>::as_slice);
        let pieces = pieces.map_err(|reason| ("__HIsKickedQuadratic", *reason));
        markers::of_pieces(
            &mut self.out,
            context,
            "Nystrom",
            &["Kick", "Quadratic"],
            pieces,
            "",
        );
    }

    /// The unit struct `name` that makes a flow of a type by `body`.
    pub(super) fn maker(&mut self, name: &str, flow: &str, body: &str) {
        let generics = self.context.generics;
        let prepared = self.prepared.ty(self.context);
        line!(
            self,
            "#[doc(hidden)]\n\
             #[derive(__h::core::clone::Clone, __h::core::marker::Copy, __h::core::fmt::Debug)]\n\
             {visibility} struct {name};\n\
             #[automatically_derived]\n\
             impl{declaration} __h::Piece<T, {prepared}> for {name} {{\n\
             type Point = __h::Point<{vector}>;\ntype Flow = {flow};\n\
             #[inline(always)]\n\
             fn flow(&self, _prepared: &{prepared}, _c: T) -> {flow} {{\n\
             let _self = _prepared;\n{body}\n}}\n}}",
            declaration = generics.holder_declaration(),
            visibility = generics.visibility,
            vector = self.vector,
        );
    }

    fn piece(&mut self, number: usize) {
        let (context, purpose) = (self.context, Purpose::Piece(number as u16));
        let (flow, maker) = (format!("__Flow{number}"), format!("__Piece{number}"));
        let piece = &context.model.pieces[number];
        self.flow(purpose, &flow, &piece.name, piece.flow.merges());
        let made = self.made(purpose, &flow);
        let ty = context.generics.holder_type(&flow);
        let components = match piece.flow {
            ExactFlow::Exponential => context.model.components(),
            _ => None,
        };
        let Some(components) = components else {
            return self.maker(&maker, &ty, &made);
        };
        let ty = format!("__h::Exponential<{ty}, T, {components}>");
        let zeros = context.zeros();
        let body = format!(
            "let _rates = {{\nlet _c = <{ty}>::raised(_c);\n{made}\n}};\n\
             __h::Exponential::new(&_rates, &__h::Point {{ q: {zeros}, p: {zeros} }})"
        );
        self.maker(&maker, &ty, &body);
    }

    /// An exact flow: its holder with its evaluation.
    pub(super) fn flow(&mut self, purpose: Purpose, name: &str, label: &str, merges: bool) {
        let context = self.context;
        let Some((function, holder)) = self.held_by(purpose, name) else {
            return;
        };
        holder.declare(&mut self.out, context);
        line!(
            self,
            "#[automatically_derived]\nimpl{} __h::Flow<__h::Point<{}>> for {} {{\n\
             const NAME: &'static __h::core::primitive::str = {label:?};\ntype Work = ();",
            context.generics.holder_declaration(),
            self.vector,
            holder.ty(context),
        );
        if !merges {
            line!(self, "const MERGES: __h::core::primitive::bool = false;");
        }
        if let Some(side) = self.one_way(function) {
            let moves = [side == Side::P, side == Side::Q];
            line!(
                self,
                "const MOVES: [__h::core::primitive::bool; 2] = {moves:?};"
            );
        }
        self.motion("apply", &holder, function, Access::InPlace);
        if !merges {
            self.motion("apply_reversed", &holder, function, Access::Reversed);
        }
        line!(self, "}}");
    }

    /// The method that moves a point.
    fn motion(&mut self, method: &str, holder: &Holder, function: &Function, access: Access) {
        let (access, [from, to], parts) = match self.one_way(function) {
            Some(Side::Q) => (Access::Apart, ["_q", "_op"], "&_x.q, &mut _x.p"),
            Some(Side::P) => (Access::Apart, ["_p", "_oq"], "&_x.p, &mut _x.q"),
            None => (access, ["_oq", "_op"], "&mut _x.q, &mut _x.p"),
        };
        let arguments = self.arguments(&[from, to]);
        let name = format!("{}_{method}", holder.name);
        self.bodies.context.access = access;
        let text = self.evaluation(&name, Some(holder), &arguments, function);
        self.bodies.context.access = Access::Apart;
        line!(
            self,
            "#[inline(always)]\n\
             fn {method}(&self, _t: T, _x: &mut __h::Point<{}>, _: &mut ()) {{\nlet _self = self;\n\
             let ({from}, {to}) = ({parts});\n{text}}}",
            self.vector,
        );
    }

    /// The side that is read, where nothing of it is written and all that is written is of the
    /// other: a kick or a drift, whose loops need not see their own stores.
    fn one_way(&self, function: &Function) -> Option<Side> {
        let slices = scan(self.context, &function.evaluation, &function.results).slices;
        let touched = |side: Side| {
            let of_side = |slice: &&Slice| slice.part().is_some_and(|(_, of)| of.side == side);
            let own = || slices.iter().filter(of_side);
            (
                own().any(|slice| !slice.is_written()),
                own().any(|slice| slice.is_written()),
            )
        };
        match (touched(Side::Q), touched(Side::P)) {
            ((_, false), (false, true)) => Some(Side::Q),
            ((false, true), (_, false)) => Some(Side::P),
            _ => None,
        }
    }
}
