//! The implementations of `System`, `Dynamics` and `VectorField`, and of `Separable` and `Split` where
//! they were proven.
//!
//! Input: a definition. Output: the text of the implementations and of the structs that hold
//! prepared values. Invariant: every method that a trait requires is there; one whose program is
//! missing is a compile error where it is first used.

use super::description;
use super::observables;
use crate::emit::functions::derived;
use crate::emit::functions::function::{Body, BodyWriter};
use crate::emit::functions::holder::{Holder, Receiver, shape};
use crate::emit::names::context::Context;
use crate::emit::names::generics::Generics;
use crate::emit::names::layout::Slice;
use crate::emit::steps::scan::scan;
use crate::emit::types::construct::{as_slice, set_by_new};
use crate::emit::types::reach;
use hamiltonian_language::analyse::structure::GradientSource;
use hamiltonian_symbolic::dag::Array;
use hamiltonian_symbolic::halves::are_apart;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::{ParameterDeclaration, Shape, VectorUse};

use hamiltonian_symbolic::program::{Function, Instruction, Purpose, Step, Target, Update, Value};
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::sort::Arrange;
use std::fmt::Write;

/// Everything a definition implements that is the same in both forms, the free functions that long bodies call, and
/// the body of the derivatives of H by its parameters.
pub fn implementations(context: Context) -> [String; 3] {
    let mut emission = Emission {
        context,
        prepared: prepared(context),
        bodies: BodyWriter {
            context,
            parts: String::new(),
        },
        vector: context.generics.vector_type_over("__V", "T"),
        out: String::new(),
    };
    emission.alias();
    emission.system();
    emission.prepared.declare(&mut emission.out, context);
    emission.dynamics();
    if !emission.is_in_halves() {
        emission.field(Purpose::VectorField);
    }
    emission.kick();
    emission.drift();
    emission.pieces();
    emission.structures();
    emission.extras();
    let function = context.program.function(Purpose::ParameterGradient);
    let gradient = function.map(|function| emission.parameter_gradient(function));
    let gradient = gradient.unwrap_or_default();
    [emission.out, emission.bodies.parts, gradient]
}

/// The prepared system: the values preparation computes and the parameter arrays that functions read.
fn prepared(context: Context) -> Holder {
    let program = context.program;
    let stages = program
        .functions
        .iter()
        .flat_map(|f| [&f.coefficient, &f.evaluation]);
    let slices = stages.flat_map(|steps| scan(context, steps, &[]).slices);
    let name = "__Prepared".to_owned();
    Holder::prepared(context, name, &program.prepared, slices.into_list())
}

/// The text of the implementations as far as it is written.
pub(super) struct Emission<'a> {
    pub(super) context: Context<'a>,
    pub(super) prepared: Holder,
    pub(super) bodies: BodyWriter<'a>,
    /// The type of coordinates and of momenta.
    pub(super) vector: String,
    pub(super) out: String,
}

impl<'a> Emission<'a> {
    /// A short name for the type of coordinates and momenta.
    fn alias(&mut self) {
        let context = self.context;
        let declaration = context.generics.declared(["T".to_owned()]);
        line!(self, "type __V{declaration} = {};", context.vector());
    }

    fn system(&mut self) {
        let (context, generics) = (self.context, self.context.generics);
        self.out.push_str(&description::constant(context));
        line!(
            self,
            "#[automatically_derived]\nimpl{} __h::System for {} {{\n\
             type Shape = {};\n__h::gathers!({});\n{}{}",
            generics.declaration(),
            generics.system_type(),
            generics.vector_type_over("__V", "()"),
            self.prepared.ty(context),
            duals(generics),
            self.parameters(),
        );
        line!(
            self,
            "#[inline(always)]\nfn prepare<T: __h::Real>(&self) -> Self::Prepared<T> {{"
        );
        let start = self.out.len();
        self.out.push_str(&reach::asserted(context));
        let results = self.prepared.values().into_list();
        let arguments = self.held();
        let read: Vec<Slice> = (self.prepared.arrays.iter().copied())
            .filter(|array| matches!(array, Slice::Read(Array::Parameter(_))))
            .into_list();
        let body = Body {
            name: "prepare",
            receiver: Receiver::System,
            arguments: &arguments,
            steps: &context.program.prepare,
            cleared: &[],
            results: &results,
            arrays: &read,
        };
        let results = self.bodies.write(&mut self.out, body);
        let fill = self.prepared.fill_prepared(context, &results, |array| {
            let place = match array {
                Slice::Read(Array::Hoisted(number)) => format!("_made.{number}"),
                _ => format!("_b{}", array.name().trim_start_matches("_a")),
            };
            match context.is_on_heap(&shape(context, array)) {
                true => format!("__h::Arc::new({place})"),
                false => place,
            }
        });
        let text = with_self(&(self.out.split_off(start) + &fill));
        line!(self, "{text}\n}}");
        let mut sizes = String::new();
        Receiver::System.bind_sizes(&mut sizes, context);
        let zeros = with_self(&(sizes + &context.zeros()));
        line!(
            self,
            "fn zeros<T: __h::Real>(&self) -> {} {{\n{zeros}\n}}\n}}",
            self.vector
        );
    }

    /// The arrays that preparation fills.
    fn held(&mut self) -> Vec<(&'static str, String)> {
        let context = self.context;
        let array = |number| {
            let shape = shape(context, Slice::Read(Array::Hoisted(number)));
            (context.storage(&shape, "T"), context.zero(&shape))
        };
        let count = context.program.hoisted.len() as u16;
        if count > 0 {
            Receiver::System.bind_sizes(&mut self.out, context);
        }
        filled(&mut self.out, (0..count).map(array))
    }

    fn dynamics(&mut self) {
        let (context, generics) = (self.context, self.context.generics);
        line!(
            self,
            "#[automatically_derived]\nimpl{} __h::Dynamics<T> for {} {{\n\
             type Vector = {};",
            generics.holder_declaration(),
            self.prepared.ty(context),
            self.vector,
        );
        let (q, p) = ("_oq", "_op");
        let has_hessian = context.program.function(Purpose::HessianVector).is_some();
        for (name, purpose, more, returns) in [
            ("energy", Purpose::Energy, &[][..], true),
            ("gradient_q", Purpose::GradientQ, &[q], false),
            ("gradient_p", Purpose::GradientP, &[p], false),
            ("gradient", Purpose::Gradient, &[q, p], false),
            (
                "energy_and_gradient",
                Purpose::EnergyAndGradient,
                &[q, p],
                true,
            ),
            ("time_derivative", Purpose::TimeDerivative, &[], true),
            (
                "hessian_vector",
                Purpose::HessianVector,
                &["_vq", "_vp", q, p],
                false,
            ),
        ] {
            // Core's own gradient is one half after the other.
            let halves = [Purpose::GradientQ, Purpose::GradientP];
            match purpose {
                Purpose::Gradient if are_apart(context.program, purpose, halves) => {}
                Purpose::Gradient | Purpose::GradientQ | Purpose::GradientP
                    if context.definition.gradient != GradientSource::Written => {}
                Purpose::HessianVector if !has_hessian => {}
                Purpose::TimeDerivative if is_timeless(context) => {}
                _ => self.method(name, purpose, more, returns),
            }
        }
        if !context.model.observables.is_empty() {
            line!(
                self,
                "#[inline(always)]\nfn observable(&self, _index: __h::usize, _t: T, _q: &{vector}, _p: &{vector}) -> T {{\n\
                 {}\n}}",
                observables::dispatch(context.model),
                vector = self.vector,
            );
        }
        let mut vectors = context.model.vectors.iter();
        if let Some(at) = vectors.position(|vector| vector.usage == VectorUse::Force) {
            line!(
                self,
                "#[inline(always)]\nfn force(&self, _t: T, _q: &Self::Vector, _p: &Self::Vector, \
                 _op: &mut Self::Vector) {{\nself.v{at}(_t, _q, _p, _op);\n}}"
            );
        }
        let field = self.field_kind();
        // What it prepares is the same for every scalar of the parameters.
        let (_, system) = generics.over_f64();
        let zero = match is_timeless(context) {
            true => ", timeless",
            false => "",
        };
        let gradient = match context.definition.gradient {
            GradientSource::Written => "",
            GradientSource::Halves => ", gradient_by_halves",
            GradientSource::Field => ", gradient_by_field",
        };
        let hessian = match has_hessian {
            true => "",
            false => ", hessian_by_gradient",
        };
        line!(
            self,
            "__h::computed_as_chosen!(T of {system}, {field}{zero}{gradient}{hessian});\n}}"
        );
    }

    /// The arguments of an evaluation: t, and vectors that are read or written.
    pub(super) fn arguments(&self, vectors: &[&'static str]) -> Vec<(&'static str, String)> {
        let vector = |name: &&'static str| {
            let mutable = if name.starts_with("_o") { "mut " } else { "" };
            (*name, format!("&{mutable}{}", self.vector))
        };
        let time = ("_t", "T".to_owned());
        [time]
            .into_iter()
            .chain(vectors.iter().map(vector))
            .into_list()
    }

    /// A method of prepared systems at a point.
    fn method(&mut self, name: &str, purpose: Purpose, more: &[&'static str], returns: bool) {
        let arguments = self.arguments(&[&["_q", "_p"], more].concat());
        let result = if returns { " -> T" } else { "" };
        let body = match self.context.program.function(purpose) {
            Some(function) => {
                let (text, results) = self.evaluation(name, None, &arguments, function);
                let body = with_self(&(text + &results.concat()));
                match loops(&function.evaluation) {
                    0 => body,
                    _ => apart(&body),
                }
            }
            None => derived::body(purpose),
        };
        let list = declared(&arguments);
        line!(
            self,
            "#[inline(always)]\nfn {name}(&self, {list}){result} {{\n{body}\n}}"
        );
    }

    /// The body of a function's evaluation, as a method of a holder or of the prepared system, and its results.
    pub(super) fn evaluation(
        &mut self,
        name: &str,
        holder: Option<&Holder>,
        arguments: &[(&'static str, String)],
        function: &Function,
    ) -> (String, Vec<String>) {
        let mut text = String::new();
        let body = Body {
            name,
            receiver: Receiver::Holder(holder.unwrap_or(&self.prepared)),
            arguments,
            steps: &function.evaluation,
            cleared: &function.cleared,
            results: &function.results,
            arrays: &[],
        };
        let results = self.bodies.write(&mut text, body);
        (text, results)
    }

    /// The function of a purpose with the holder of the values and arrays that it reads.
    pub(super) fn held_by(&self, purpose: Purpose, name: String) -> Option<(&'a Function, Holder)> {
        let function = self.context.program.function(purpose)?;
        let scan = scan(self.context, &function.evaluation, &function.results);
        let holder = self.prepared.with_values(self.context, name, &scan.reads);
        Some((function, holder))
    }

    /// The body that makes the holder of a function from prepared values and the coefficient.
    pub(super) fn made(&mut self, function: &Function, holder: &Holder) -> String {
        let results = holder.values().into_list();
        let mut text = String::new();
        let body = Body {
            name: &format!("prepare{}", holder.name),
            receiver: Receiver::Holder(&self.prepared),
            arguments: &[("_c", "T".to_owned())],
            steps: &function.coefficient,
            cleared: &[],
            results: &results,
            arrays: &[],
        };
        let results = self.bodies.write(&mut text, body);
        text + &holder.fill(&results)
    }

    /// The method that writes the values of the parameters.
    fn parameters(&self) -> String {
        let context = self.context;
        let mut lines = Vec::new();
        for size in context.run_time_sizes() {
            let name = &context.definition.checked.sizes[size].name;
            lines.push(format!(
                "__h::core::writeln!(_out, \"{name} = {{}}\", *self.{name})"
            ));
        }
        for (at, parameter) in context.model.parameters.iter().enumerate() {
            let (at, name) = (at as u16, &parameter.name);
            let field = context.generics.field(at);
            let value = match parameter.shape {
                Shape::Scalar => format!("_self.{field}"),
                Shape::Matrix(..) => format!("_self.{field}.transpose()"),
                _ => context.of_parameter(at),
            };
            let (array, value) = match parameter.shape {
                Shape::Scalar => (String::new(), value.as_str()),
                _ => (format!("let _b = &{value};\n"), "_b"),
            };
            let whole = as_slice(&parameter.shape, value);
            lines.push(format!(
                "{array}__h::describe_parameter(_out, \"{name}\", {whole})"
            ));
        }
        for (at, (ty, arity)) in context.generics.functions.iter().enumerate() {
            let name = &context.definition.checked.functions[at].name;
            lines.push(format!(
                "__h::core::writeln!(_out, \"{name} = function {{:016x}}\", \
                 <{ty} as __h::Function<{arity}>>::fingerprint(&self.{name}))"
            ));
        }
        if lines.is_empty() {
            return String::new();
        }
        let body = with_self(&lines.join("?;\n"));
        format!(
            "fn describe_parameters(&self, _out: &mut dyn __h::Write) -> __h::fmt::Result {{\n{body}\n}}\n\
             fn parameter_text(&self) -> __h::ParameterText {{ __h::ParameterText::of(__h::Clone::clone(self)) }}\n"
        )
    }

    /// Inherent methods of prepared systems: observables, and functions with vector values.
    fn extras(&mut self) {
        let context = self.context;
        if context.model.observables.is_empty() && context.model.vectors.is_empty() {
            return;
        }
        line!(
            self,
            "impl{} {} {{",
            context.generics.holder_declaration(),
            self.prepared.ty(context)
        );
        for (at, observable) in context.model.observables.iter().enumerate() {
            let purpose = Purpose::Observable(at as u16);
            let Some(function) = context.program.function(purpose) else {
                continue;
            };
            let arguments = self.arguments(&["_q", "_p"]);
            let name = format!("o{at}");
            let (text, results) = self.evaluation(&name, None, &arguments, function);
            let body = with_self(&format!("{text}[{}]", results.join(", ")));
            let body = match loops(&function.evaluation) {
                0 => body,
                _ => apart(&body),
            };
            line!(
                self,
                "#[inline(always)]\nfn {name}(&self, {}) -> [T; {}] {{\n{body}\n}}",
                declared(&arguments),
                observable.components.len(),
            );
        }
        for (at, vector) in context.model.vectors.iter().enumerate() {
            let outputs: &[&'static str] = match vector.usage.sides() {
                (true, true) => &["_oq", "_op"],
                (true, false) => &["_oq"],
                _ => &["_op"],
            };
            let name = format!("v{at}");
            self.method(&name, Purpose::Vector(at as u16), outputs, false);
        }
        line!(self, "}}");
    }

    /// ∂H/∂(parameters), which have one scalar: the result is the user's type over it. Numbers are results of the body;
    /// it writes arrays.
    fn parameter_gradient(&mut self, function: &Function) -> String {
        let context = self.context;
        let parameters = &context.model.parameters;
        let mut function = function.clone();
        let number = |step: &Step| match step {
            Step::Store(Target::Parameter(at), _, _, Update::Set(value)) => {
                let is_number = parameters[usize::from(at.0)].shape == Shape::Scalar;
                is_number.then_some((at.0, *value))
            }
            _ => None,
        };
        let mut numbers = function.evaluation.iter().filter_map(number).into_list();
        numbers.arrange();
        function.results = numbers.into_iter().map(|(_, value)| value).into_list();
        function.evaluation.retain(|step| number(step).is_none());
        let mut arguments = self.arguments(&["_q", "_p"]);
        let array = |parameter: &ParameterDeclaration| match &parameter.shape {
            Shape::Scalar => ("()".to_owned(), "()".to_owned()),
            shape => (context.field(shape, "T"), context.zero_field(shape)),
        };
        let mut made = String::new();
        arguments.extend(filled(&mut made, parameters.iter().map(array)));
        let (text, results) = self.evaluation("parameters", None, &arguments, &function);
        let mut results = results.into_iter();
        let (mut sizes, mut fields) = (String::new(), String::new());
        Receiver::Holder(&self.prepared).bind_sizes(&mut sizes, context);
        for size in context.run_time_sizes() {
            let name = &context.definition.checked.sizes[size].name;
            let _ = write!(fields, "{name}: {}, ", set_by_new(&format!("_n{size}")));
        }
        for at in 0..context.generics.functions.len() {
            let name = &context.definition.checked.functions[at].name;
            let _ = write!(
                fields,
                "{name}: __h::Clone::clone(&{}), ",
                self.prepared.function(context, at)
            );
        }
        for (at, parameter) in (0..).zip(parameters) {
            let value = match &parameter.shape {
                Shape::Scalar => results.next().unwrap_or_default(),
                shape if context.is_dynamic(shape) => set_by_new(&format!("_made.{at}")),
                _ => format!("_made.{at}"),
            };
            let _ = write!(fields, "{}: {value}, ", context.generics.field(at));
        }
        format!(
            "let _self = &<Self as __h::System>::prepare::<T>(self);\n\
             let (_t, _q, _p) = (state.t, &state.q, &state.p);\n\
             {sizes}{made}{text}{} {{ {fields} }}",
            context.generics.name,
        )
    }
}

/// Makes arrays as `_made`, each of a type and a value, and returns them as an argument of the body that fills them.
/// Numbers among them are `()`.
fn filled(
    out: &mut String,
    arrays: impl Iterator<Item = (String, String)>,
) -> Vec<(&'static str, String)> {
    let (types, values): (Vec<_>, Vec<_>) = arrays.unzip();
    if types.iter().all(|ty| ty == "()") {
        return Vec::new();
    }
    let values = values.join(", ");
    let _ = writeln!(out, "let mut _made = ({values},);\nlet _held = &mut _made;");
    vec![("_held", format!("&mut ({},)", types.join(", ")))]
}

/// Returns true if the derivative of H by time is the constant 0.
fn is_timeless(context: Context) -> bool {
    let function = context.program.function(Purpose::TimeDerivative);
    let is_zero = |value: &Value| match context.program.instruction(*value) {
        Instruction::Constant(constant) => *constant == Rational::ZERO,
        _ => false,
    };
    function.is_some_and(|function| function.results.iter().all(is_zero))
}

/// Returns how deep loops are nested in steps.
pub(super) fn loops(steps: &[Step]) -> usize {
    let depth = |step: &Step| match step {
        Step::Loop(inner) => 1 + loops(&inner.body),
        _ => 0,
    };
    steps.iter().map(depth).max().unwrap_or(0)
}

/// A body as a function of its own, of which a program has one copy. The call is short beside the loops.
pub(super) fn apart(body: &str) -> String {
    format!("<T as __h::Real>::out_of_line(#[inline(always)] || {{\n{body}\n}})")
}

/// The body of a method: `_self` is the receiver, as parts that are free functions call it.
pub(super) fn with_self(body: &str) -> String {
    let mut parts = body.split("_self");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let is_inside = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '"');
        let is_word = !out.ends_with(is_inside)
            && !part.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        out.push_str(if is_word { "self" } else { "_self" });
        out.push_str(part);
    }
    out
}

/// `name: type, …`
pub(super) fn declared(arguments: &[(&'static str, String)]) -> String {
    let arguments = arguments.iter().map(|(name, ty)| format!("{name}: {ty}"));
    arguments.into_list().join(", ")
}

/// `System::DUALS`, the most that the scalar of a parameter has.
fn duals(generics: &Generics) -> String {
    let of = |scalar: &String| format!("<{scalar} as __h::Parameter>::DUALS");
    match &generics.scalars[..] {
        [] => String::new(),
        [one] => format!("const DUALS: __h::core::primitive::u32 = {};\n", of(one)),
        many => {
            let all: Vec<String> = many.iter().map(of).into_list();
            let all = all.join(", ");
            format!("const DUALS: __h::core::primitive::u32 = __h::deepest(&[{all}]);\n")
        }
    }
}
