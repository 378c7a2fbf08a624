//! The exact flows of a splitting: of each piece a flow that holds its constants and the unit struct
//! that makes it, and `Split`.
//!
//! Input: a model with pieces. Output: text of the implementations. Invariant: a flow reads and
//! writes one point; where it leaves its domain, all it moves becomes NaN, which the program says.

use super::construct::over_f64;
use super::dynamics::{Emission, evaluation, zeros};
use super::holder::Receiver;
use super::layout::Slice;
use super::scan::scan;
use super::{Form, Nystrom};
use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::program::{Function, Purpose};
use hamiltonian_symbolic::split::{ExactFlow, MOST};
use std::fmt::Write;

/// The flows' names.
const FLOWS: [&str; MOST] = [
    "__Flow0", "__Flow1", "__Flow2", "__Flow3", "__Flow4", "__Flow5", "__Flow6", "__Flow7",
];
/// The names of what makes them.
const PIECES: [&str; MOST] = [
    "__Piece0", "__Piece1", "__Piece2", "__Piece3", "__Piece4", "__Piece5", "__Piece6", "__Piece7",
];

macro_rules! line {
    ($emission:expr, $($text:tt)*) => {{
        // Writing to a string does not fail.
        let _ = writeln!($emission.out, $($text)*);
    }};
}

impl Emission<'_> {
    /// The flows of the model's pieces, and the splitting into them.
    pub(super) fn pieces(&mut self) {
        let count = self.context.model.pieces.len();
        if count == 0 {
            return;
        }
        for number in 0..count {
            self.piece(number);
        }
        let names = self.context.model.pieces.iter();
        let mut names: Vec<String> = names.map(|piece| piece.name.clone()).collect();
        let mut pieces = PIECES[..count].to_vec();
        let structure = &self.definition.structure;
        if structure.kick.is_some() && structure.separable.is_err() {
            pieces.push("__KickPiece");
            names.push(structure.halves[0].clone());
        }
        self.split(&pieces, &names);
    }

    /// `Split`
    pub(super) fn split(&mut self, pieces: &[&str], names: &[String]) {
        let tuple = format!("({},)", pieces.join(", "));
        line!(
            self,
            "#[automatically_derived]\nimpl{declaration} __h::Split<T> for {system} {{\n\
             type Pieces = {tuple};\nconst PIECES: Self::Pieces = {tuple};\n\
             const NAMES: &'static [&'static __h::core::primitive::str] = &{names:?};\n}}",
            declaration = self.generics.declaration_with_scalar(),
            system = self.generics.system_type(),
        );
        // Over one scalar only, so that `Name::NAMES` is decided.
        if let Form::Item(_) = self.definition.form {
            let (constants, system) = over_f64(self.generics);
            line!(
                self,
                "impl{constants} {system} {{\n/// The pieces of H with exact flows, the outermost first.\n\
                 {visibility} const NAMES: &'static [&'static __h::core::primitive::str] = \
                 <Self as __h::Split<__h::core::primitive::f64>>::NAMES;\n}}",
                visibility = self.generics.visibility,
            );
        }
    }

    /// `Nystrom`, of V and T or of two of the model's pieces.
    pub(super) fn nystrom(&mut self) {
        let [kick, quadratic] = match self.definition.structure.nystrom {
            Ok(Nystrom::Halves) => ["__KickPiece", "__DriftPiece"],
            Ok(Nystrom::Pieces(numbers)) => numbers.map(|number| PIECES[number]),
            Err(_) => return,
        };
        line!(
            self,
            "#[automatically_derived]\nimpl{declaration} __h::Nystrom<T> for {system} {{\n\
             type Kick = {kick};\ntype Quadratic = {quadratic};\n\
             const KICK: {kick} = {kick};\nconst QUADRATIC: {quadratic} = {quadratic};\n}}",
            declaration = self.generics.declaration_with_scalar(),
            system = self.generics.system_type(),
        );
    }

    /// The unit struct that makes a flow.
    pub(super) fn maker(&mut self, purpose: Purpose, flow: &'static str, name: &str) {
        self.begin_piece(name, &format!("{flow}{}", self.generics.holder_arguments()));
        self.coefficients(purpose, flow);
        line!(self, "}}\n}}");
    }

    /// A unit struct that makes a flow of a type, up to the body that does.
    pub(super) fn begin_piece(&mut self, name: &str, flow: &str) {
        let generics = self.generics;
        let (declaration, arguments) = (generics.holder_declaration(), generics.holder_arguments());
        line!(
            self,
            "#[doc(hidden)]\n\
             #[derive(__h::core::clone::Clone, __h::core::marker::Copy, __h::core::fmt::Debug)]\n\
             {visibility} struct {name};\n\
             #[automatically_derived]\n\
             impl{declaration} __h::Piece<T, __Prepared{arguments}> for {name} {{\n\
             type Point = __h::Point<{vector}>;\ntype Flow = {flow};\n\
             #[inline(always)]\n\
             fn flow(&self, _prepared: &__Prepared{arguments}, _c: T) -> {flow} {{\n\
             let _self = _prepared;",
            visibility = generics.visibility,
            vector = self.vector,
        );
    }

    fn piece(&mut self, number: usize) {
        let purpose = Purpose::Piece(number as u16);
        let flow = FLOWS[number];
        let Some((function, holder)) = self
            .context
            .program
            .function(purpose)
            .zip(self.holder(purpose, flow))
        else {
            return;
        };
        holder.declare(&mut self.out, self.context, self.generics);
        let piece = &self.context.model.pieces[number];
        line!(
            self,
            "#[automatically_derived]\nimpl{declaration} __h::Flow<__h::Point<{vector}>> for \
             {flow}{arguments} {{\n\
             const NAME: &'static __h::core::primitive::str = {name:?};\ntype Work = ();{merges}",
            declaration = self.generics.holder_declaration(),
            arguments = self.generics.holder_arguments(),
            vector = self.vector,
            name = piece.name,
            merges = match piece.flow.merges() {
                true => "",
                false => "\nconst MERGES: __h::core::primitive::bool = false;",
            },
        );
        let receiver = Receiver::Holder(&holder);
        self.motion("apply", receiver, function, false);
        if !piece.flow.merges() {
            self.motion("apply_reversed", receiver, function, true);
        }
        line!(self, "}}");
        let components = match piece.flow {
            ExactFlow::Exponential => self.context.model.components(),
            _ => None,
        };
        let Some(components) = components else {
            self.maker(purpose, flow, PIECES[number]);
            return;
        };
        let made = format!("{flow}{}", self.generics.holder_arguments());
        let ty = format!("__h::Exponential<{made}, T, {components}>");
        self.begin_piece(PIECES[number], &ty);
        line!(self, "let _rates = {{\nlet _c = <{ty}>::raised(_c);");
        self.coefficients(purpose, flow);
        let zeros = zeros(self.context, self.generics);
        line!(
            self,
            "}};\n__h::Exponential::new(&_rates, &__h::Point {{ q: {zeros}, p: {zeros} }})\n}}\n}}"
        );
    }

    /// The method that moves a point.
    fn motion(&mut self, method: &str, receiver: Receiver, function: &Function, reversed: bool) {
        line!(
            self,
            "#[inline(always)]\n\
             fn {method}(&self, _t: T, _x: &mut __h::Point<{}>, _: &mut ()) {{\nlet _self = self;",
            self.vector,
        );
        let inputs: &[(&'static str, &str)] = match self.one_way(function) {
            Some(Side::Q) => {
                line!(self, "let (_q, _op) = (&_x.q, &mut _x.p);");
                &[("_q", "&"), ("_op", "&mut ")]
            }
            Some(Side::P) => {
                line!(self, "let (_p, _oq) = (&_x.p, &mut _x.q);");
                &[("_p", "&"), ("_oq", "&mut ")]
            }
            None => {
                line!(self, "let (_oq, _op) = (&mut _x.q, &mut _x.p);");
                &[("_oq", "&mut "), ("_op", "&mut ")]
            }
        };
        let mut arguments = vec![("_t", "T".to_owned())];
        for (name, reference) in inputs {
            arguments.push((name, format!("{reference}{}", self.vector)));
        }
        self.bodies.context.in_place = self.one_way(function).is_none();
        self.bodies.context.reversed = reversed;
        let text = evaluation(&mut self.bodies, method, receiver, &arguments, function);
        self.bodies.context.in_place = false;
        self.bodies.context.reversed = false;
        line!(self, "{text}}}");
    }

    /// The side that is read, where nothing of it is written and all that is written is of the
    /// other: a kick or a drift, whose loops need not see what they write.
    fn one_way(&self, function: &Function) -> Option<Side> {
        let slices = scan(self.context, &function.evaluation, &function.results).slices;
        let touched = |side: Side| {
            let reads = |slice: &Slice| matches!(slice, Slice::Input(of) if of.side == side);
            let writes = |slice: &Slice| matches!(slice, Slice::Output(of) if of.side == side);
            (slices.iter().any(reads), slices.iter().any(writes))
        };
        match (touched(Side::Q), touched(Side::P)) {
            ((_, false), (false, true)) => Some(Side::Q),
            ((false, true), (_, false)) => Some(Side::P),
            _ => None,
        }
    }
}
