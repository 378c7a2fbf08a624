//! The implementations of `System`, `Dynamics` and `VectorField`, and of `Separable` and `Split` where
//! they were proven.
//!
//! Input: a definition. Output: the text of the implementations and of the structs that hold
//! prepared values. Invariant: every method a trait asks for is there; one whose program is
//! missing is a compile error where it is first used.

use super::block::Context;
use super::construct::set_by_new;
use super::function::{Bodies, Body, results};
use super::generics::{Generics, list};
use super::holder::{Holder, Receiver, field, shape};
use super::layout::{self, Layout, Slice};
use super::mixed;
use super::scan::scan;
use super::{Definition, Form, derived, observables, reach, vectors};
use hamiltonian_symbolic::model::{Model, Shape};
use hamiltonian_symbolic::print;
use hamiltonian_symbolic::program::{Function, Purpose};
use std::fmt::Write;

/// The type of coordinates and of momenta over `scalar`; paths begin with `root`.
pub fn vector(context: Context, generics: &Generics, scalar: &str, root: &str) -> String {
    match context.layout {
        Layout::Scalars => format!("{root}::SVector<{scalar}, {}>", context.model.groups.len()),
        Layout::Array => {
            let shape = context.model.groups[0].shape.of_parameter();
            layout::storage(&shape, scalar, context.indices, context.is_run_time, root)
        }
        Layout::Mixed => mixed::ty(context, generics, scalar),
    }
}

/// The expression of the zero vector, where run-time sizes are called as in bodies.
pub fn zeros(context: Context, generics: &Generics) -> String {
    let filled = |shape: &Shape<u16>| {
        layout::filled(
            &shape.of_parameter(),
            "T::constant(0.0, 0.0)",
            context.indices,
            context.is_run_time,
            "__h",
        )
    };
    match context.layout {
        Layout::Scalars => {
            let n = context.model.groups.len();
            format!("__h::SVector::<T, {n}>::from_element(T::constant(0.0, 0.0))")
        }
        Layout::Array => filled(&context.model.groups[0].shape),
        Layout::Mixed => {
            let fields: Vec<String> = context
                .model
                .groups
                .iter()
                .map(|g| format!("{}: {}", g.coordinate, filled(&g.shape)))
                .collect();
            format!(
                "{} {{ {} }}",
                mixed::name(context, generics),
                fields.join(", ")
            )
        }
    }
}

/// Everything a definition implements that is the same in both forms, and the free functions that
/// long bodies call.
pub fn implementations(
    definition: &Definition,
    context: Context,
    generics: &Generics,
) -> (String, String) {
    let mut emission = Emission {
        definition,
        context,
        generics,
        prepared: prepared(context),
        bodies: Bodies {
            context,
            generics,
            parts: String::new(),
        },
        vector: format!("__Vector{}", generics.holder_arguments()),
        out: String::new(),
    };
    emission.alias();
    emission.system();
    emission
        .prepared
        .declare(&mut emission.out, context, generics);
    emission.dynamics();
    emission.flow(Purpose::VectorField);
    emission.kick();
    emission.separable();
    emission.pieces();
    emission.nystrom();
    emission.extras();
    (emission.out, emission.bodies.parts)
}

/// The prepared system: the values preparation computes and the parameter arrays that functions read.
fn prepared(context: Context) -> Holder {
    let program = context.program;
    let mut arrays = Vec::new();
    for function in &program.functions {
        for steps in [&function.coefficient, &function.evaluation] {
            for slice in scan(context, steps, &[]).slices {
                if let Slice::Parameter(_) | Slice::Held(_) = slice {
                    arrays.push(slice);
                }
            }
        }
    }
    arrays.sort_unstable();
    arrays.dedup();
    Holder::new(context, "__Prepared", &program.prepared, arrays)
}

pub(super) struct Emission<'a> {
    pub(super) definition: &'a Definition<'a>,
    pub(super) context: Context<'a>,
    pub(super) generics: &'a Generics,
    prepared: Holder,
    pub(super) bodies: Bodies<'a>,
    pub(super) vector: String,
    pub(super) out: String,
}

macro_rules! line {
    ($emission:expr, $($text:tt)*) => {{
        // Writing to a string does not fail.
        let _ = writeln!($emission.out, $($text)*);
    }};
}

impl<'a> Emission<'a> {
    /// A short name for the type of coordinates and momenta.
    fn alias(&mut self) {
        let sizes = self.generics.constants_declared();
        line!(
            self,
            "type __Vector{} = {};",
            list(sizes.chain(["T".to_owned()])),
            vector(self.context, self.generics, "T", "__h")
        );
    }

    fn system(&mut self) {
        let (context, generics) = (self.context, self.generics);
        line!(
            self,
            "#[automatically_derived]\nimpl{} __h::System<T> for {} {{\n\
             type Vector = {};\ntype Prepared = __Prepared{};\n\
             const NAME: &'static __h::core::primitive::str = {:?};\n\
             const GROUPS: &'static [__h::Group] = &[{}];\n\
             const OBSERVABLES: &'static [__h::Observable] = &[{}];{}\n\
             const FORMULA: &'static __h::core::primitive::str = {:?};\n{}",
            generics.declaration_with_scalar(),
            generics.system_type(),
            self.vector,
            generics.holder_arguments(),
            context.model.name,
            groups(context.model, context.layout),
            observables::entries(context.model),
            context.model.evolution.as_ref().map_or(String::new(), |time| format!(
                "\nconst FICTITIOUS_TIME: __h::core::option::Option<&'static __h::core::primitive::str> = \
                 __h::core::option::Option::Some({time:?});"
            )),
            self.formula(),
            self.parameters(),
        );
        line!(
            self,
            "#[inline(always)]\nfn prepare(&self) -> Self::Prepared {{\nlet _self = self;"
        );
        self.out
            .push_str(&reach::asked(self.definition.reaches, context));
        let results: Vec<_> = self.prepared.values().collect();
        let arguments = self.held();
        let read: Vec<Slice> = (self.prepared.arrays.iter().copied())
            .filter(|array| matches!(array, Slice::Parameter(_)))
            .collect();
        let body = Body {
            name: "prepare",
            receiver: Receiver::System,
            arguments: &arguments,
            steps: &context.program.prepare,
            cleared: &[],
            results: &results,
            arrays: &read,
        };
        self.bodies.write(&mut self.out, body);
        let fill = self.prepared.fill(context, |array| {
            let place = match array {
                Slice::Held(number) => format!("_made.{number}"),
                _ => format!("_b{}", field(array).trim_start_matches('a')),
            };
            match layout::is_dynamic(&shape(context, array), context.is_run_time) {
                true => format!("__h::Arc::new({place})"),
                false => place,
            }
        });
        line!(self, "{fill}\n}}");
        line!(
            self,
            "#[inline]\nfn zeros(&self) -> Self::Vector {{\nlet _self = self;"
        );
        for (size, run_time) in context.is_run_time.iter().enumerate() {
            if *run_time {
                Receiver::System.bind_size(&mut self.out, generics, size);
            }
        }
        line!(self, "{}\n}}\n}}", zeros(context, generics));
    }

    /// The arrays that preparation fills, as an argument of its parts; made as `_made`.
    fn held(&mut self) -> Vec<(&'static str, String)> {
        let context = self.context;
        if context.program.held.is_empty() {
            return Vec::new();
        }
        let (mut types, mut values) = (String::new(), String::new());
        for number in 0..context.program.held.len() {
            let shape = shape(context, Slice::Held(number as u16));
            let (indices, is_run_time) = (context.indices, context.is_run_time);
            let ty = layout::storage(&shape, "T", indices, is_run_time, "__h");
            let zero = "T::constant(0.0, 0.0)";
            let value = layout::filled(&shape, zero, indices, is_run_time, "__h");
            types.push_str(&format!("{ty}, "));
            values.push_str(&format!("{value}, "));
        }
        for (size, run_time) in context.is_run_time.iter().enumerate() {
            if *run_time {
                Receiver::System.bind_size(&mut self.out, self.generics, size);
            }
        }
        line!(self, "let mut _made = ({values});\nlet _held = &mut _made;");
        vec![("_held", format!("&mut ({types})"))]
    }

    fn dynamics(&mut self) {
        line!(
            self,
            "#[automatically_derived]\nimpl{} __h::Dynamics<T> for __Prepared{} {{\n\
             type Vector = {};\ntype Field = __Field{};",
            self.generics.holder_declaration(),
            self.generics.holder_arguments(),
            self.vector,
            self.generics.holder_arguments(),
        );
        self.method("energy", Purpose::Energy, &[], true);
        self.method("gradient_q", Purpose::GradientQ, &["_oq"], false);
        self.method("gradient_p", Purpose::GradientP, &["_op"], false);
        self.method("gradient", Purpose::Gradient, &["_oq", "_op"], false);
        self.method(
            "energy_and_gradient",
            Purpose::EnergyAndGradient,
            &["_oq", "_op"],
            true,
        );
        self.method("time_derivative", Purpose::TimeDerivative, &[], true);
        self.method(
            "hessian_vector",
            Purpose::HessianVector,
            &["_vq", "_vp", "_oq", "_op"],
            false,
        );
        line!(
            self,
            "#[inline]\nfn observable(&self, _index: __h::core::primitive::usize, _t: T, _q: &Self::Vector, \
             _p: &Self::Vector) -> T {{\n{}\n}}",
            observables::dispatch(self.context.model),
        );
        let mut vectors = self.definition.vectors.iter();
        if let Some(at) = vectors.position(|item| item.usage == vectors::VectorUse::Force) {
            line!(
                self,
                "#[inline(always)]\nfn force(&self, _t: T, _q: &Self::Vector, _p: &Self::Vector, \
                 _op: &mut Self::Vector) {{\nself.v{at}(_t, _q, _p, _op);\n}}"
            );
        }
        line!(
            self,
            "#[inline(always)]\nfn field(&self, _c: T) -> Self::Field {{\nlet _self = self;"
        );
        self.coefficients(Purpose::VectorField, "__Field");
        line!(self, "}}\n}}");
    }

    /// The arguments of an evaluation: t, q, p and vectors that are read or written.
    fn arguments(&self, more: &[&'static str]) -> Vec<(&'static str, String)> {
        let mut arguments = vec![("_t", "T".to_owned())];
        for name in ["_q", "_p"].iter().chain(more) {
            let mutable = if name.starts_with("_o") { "mut " } else { "" };
            arguments.push((name, format!("&{mutable}{}", self.vector)));
        }
        arguments
    }

    /// A method of prepared systems.
    fn method(&mut self, name: &str, purpose: Purpose, more: &[&'static str], returns: bool) {
        let arguments = self.arguments(more);
        let list: Vec<String> = arguments
            .iter()
            .map(|(name, ty)| format!("{name}: {ty}"))
            .collect();
        let result = if returns { " -> T" } else { "" };
        line!(
            self,
            "#[inline(always)]\nfn {name}(&self, {}){result} {{",
            list.join(", ")
        );
        let receiver = Receiver::Holder(&self.prepared);
        match self.context.program.function(purpose) {
            Some(function) => {
                let text = evaluation(&mut self.bodies, name, receiver, &arguments, function);
                let results = if returns {
                    results(self.context, &function.results)
                } else {
                    String::new()
                };
                line!(self, "let _self = self;\n{text}{results}");
            }
            None => line!(self, "{}", derived::body(purpose)),
        }
        line!(self, "}}");
    }

    /// The values a function reads from its own holder, in order.
    pub(super) fn holder(&self, purpose: Purpose, name: &'static str) -> Option<Holder> {
        let function = self.context.program.function(purpose)?;
        let scan = scan(self.context, &function.evaluation, &function.results);
        let is_array = |slice: &Slice| matches!(slice, Slice::Parameter(_) | Slice::Held(_));
        let arrays = scan.slices.iter().copied().filter(is_array);
        Some(Holder::new(
            self.context,
            name,
            &scan.reads,
            arrays.collect(),
        ))
    }

    /// The body that makes the holder of a function from prepared values and the coefficient.
    pub(super) fn coefficients(&mut self, purpose: Purpose, name: &'static str) {
        let Some(function) = self.context.program.function(purpose) else {
            line!(self, "{}", derived::FLOW);
            return;
        };
        let Some(holder) = self.holder(purpose, name) else {
            return;
        };
        let results: Vec<_> = holder.values().collect();
        let mut text = String::new();
        let part = format!("prepare{name}");
        let body = Body {
            name: &part,
            receiver: Receiver::Holder(&self.prepared),
            arguments: &[("_c", "T".to_owned())],
            steps: &function.coefficient,
            cleared: &[],
            results: &results,
            arrays: &[],
        };
        self.bodies.write(&mut text, body);
        let fill = holder.fill(self.context, |array| {
            format!("_self.{}.clone()", field(array))
        });
        line!(self, "{text}{fill}");
    }

    /// H, the force and the pieces as text: what a saved run is of.
    fn formula(&self) -> String {
        let model = self.context.model;
        let mut formula = self.definition.text.hamiltonian.clone();
        for force in &model.force {
            let momentum = model.groups[usize::from(force.at.group)].name(force.at.side);
            let value = print::text(model, force.value);
            let _ = write!(
                formula,
                "; force on {momentum}, column {}: {value}",
                force.at.column
            );
        }
        for piece in &model.pieces {
            let _ = write!(formula, "; piece {}", piece.name);
        }
        formula
    }

    /// The method that writes the values of the parameters.
    fn parameters(&self) -> String {
        let generics = self.generics;
        let mut lines = String::new();
        for (size, run_time) in self.context.is_run_time.iter().enumerate() {
            if *run_time {
                let name = &generics.sizes[size];
                let _ = writeln!(
                    lines,
                    "__h::core::writeln!(_out, \"{name} = {{}}\", *self.{name})?;"
                );
            }
        }
        for (at, parameter) in self.context.model.parameters.iter().enumerate() {
            let (at, name) = (at as u16, &parameter.name);
            let (value, whole) = match parameter.shape {
                Shape::Scalar => (format!("[{}]", generics.lifted(at)), "0, 1, &_b"),
                Shape::Vector(_) => (generics.lifted_array(at), "1, _b.nrows(), _b.as_slice()"),
                Shape::Matrix(..) => (generics.lifted_array(at), "2, _b.nrows(), _b.as_slice()"),
            };
            let _ = writeln!(
                lines,
                "let _b = {value};\n__h::describe_parameter(_out, \"{name}\", {whole})?;"
            );
        }
        if lines.is_empty() {
            return lines;
        }
        format!(
            "fn describe_parameters(&self, _out: &mut dyn __h::core::fmt::Write) -> __h::core::fmt::Result {{\n\
             let _self = self;\n{lines}__h::core::result::Result::Ok(())\n}}\n"
        )
    }

    /// Inherent methods of prepared systems: observables, and derivatives by parameters.
    fn extras(&mut self) {
        line!(
            self,
            "impl{} __Prepared{} {{",
            self.generics.holder_declaration(),
            self.generics.holder_arguments()
        );
        for (at, observable) in self.context.model.observables.iter().enumerate() {
            let Some(function) = self
                .context
                .program
                .function(Purpose::Observable(at as u16))
            else {
                continue;
            };
            let arguments = self.arguments(&[]);
            let list: Vec<String> = arguments
                .iter()
                .map(|(name, ty)| format!("{name}: {ty}"))
                .collect();
            let name = format!("o{at}");
            let receiver = Receiver::Holder(&self.prepared);
            let text = evaluation(&mut self.bodies, &name, receiver, &arguments, function);
            line!(
                self,
                "#[inline(always)]\nfn {name}(&self, {}) -> [T; {}] {{\nlet _self = self;\n{text}[{}]\n}}",
                list.join(", "),
                observable.components.len(),
                results(self.context, &function.results),
            );
        }
        for (at, vector) in self.context.model.vectors.iter().enumerate() {
            let outputs: &[&'static str] = match vector.sides {
                (true, true) => &["_oq", "_op"],
                (true, false) => &["_oq"],
                _ => &["_op"],
            };
            let name = format!("v{at}");
            self.method(&name, Purpose::Vector(at as u16), outputs, false);
        }
        if let Some(function) = self.parameter_gradient() {
            let ty = self.generics.system_type_over(&["T".to_owned()]);
            let mut arguments = self.arguments(&[]);
            let list: Vec<String> = arguments
                .iter()
                .map(|(name, ty)| format!("{name}: {ty}"))
                .collect();
            arguments.push(("_d", format!("&mut {ty}")));
            let receiver = Receiver::Holder(&self.prepared);
            let text = evaluation(
                &mut self.bodies,
                "parameters",
                receiver,
                &arguments,
                function,
            );
            let mut sizes = String::new();
            let mut fields = String::new();
            for (size, run_time) in self.context.is_run_time.iter().enumerate() {
                if *run_time {
                    receiver.bind_size(&mut sizes, self.generics, size);
                    let value = set_by_new(&format!("_n{size}"));
                    let _ = write!(fields, "{}: {value}, ", self.generics.sizes[size]);
                }
            }
            for (at, parameter) in self.context.model.parameters.iter().enumerate() {
                let mut zero = layout::filled(
                    &parameter.shape,
                    "T::constant(0.0, 0.0)",
                    self.context.indices,
                    self.context.is_run_time,
                    "__h",
                );
                if layout::is_dynamic(&parameter.shape, self.context.is_run_time) {
                    zero = set_by_new(&zero);
                }
                let _ = write!(fields, "{}: {zero}, ", self.generics.field(at as u16));
            }
            line!(
                self,
                "#[inline]\nfn parameters(&self, {}) -> {ty} {{\nlet _self = self;\n{sizes}\
                 let mut _result = {} {{ {fields} }};\nlet _d = &mut _result;\n{text}_result\n}}",
                list.join(", "),
                self.generics.name,
            );
        }
        line!(self, "}}");
    }

    /// ∂H/∂(parameters), where they have one scalar: the result is the user's type over it.
    fn parameter_gradient(&self) -> Option<&'a Function> {
        match &self.definition.form {
            Form::Item(item) if !item.parameters.is_empty() => {
                self.context.program.function(Purpose::ParameterGradient)
            }
            _ => None,
        }
    }
}

pub(super) fn evaluation(
    bodies: &mut Bodies,
    name: &str,
    receiver: Receiver,
    arguments: &[(&'static str, String)],
    function: &Function,
) -> String {
    let mut text = String::new();
    let body = Body {
        name,
        receiver,
        arguments,
        steps: &function.evaluation,
        cleared: &function.cleared,
        results: &function.results,
        arrays: &[],
    };
    bodies.write(&mut text, body);
    text
}

/// The entries of `System::GROUPS`.
fn groups(model: &Model, layout: Layout) -> String {
    let mut out = String::new();
    for (at, group) in model.groups.iter().enumerate() {
        let columns = group.shape.columns();
        let rank = match &group.shape {
            Shape::Scalar => 0,
            Shape::Vector(_) => 1,
            Shape::Matrix(..) => 2,
        };
        let (part, offset) = match layout {
            Layout::Scalars => (0, at),
            Layout::Array => (0, 0),
            Layout::Mixed => (at, 0),
        };
        let _ = write!(
            out,
            "__h::Group {{ coordinate: {:?}, momentum: {:?}, rank: {rank}, part: {part}, offset: {offset}, columns: {columns} }}, ",
            group.coordinate, group.momentum
        );
    }
    out
}
