//! The structs that carry prepared values into evaluations, and the reads of a body from the type it
//! is a method of.
//!
//! Input: the values, masks and parameter arrays that functions read. Output: struct declarations
//! and the expressions that fill and read them. Invariant: a holder has the values its functions
//! read and nothing else, but all run-time sizes and functions.

use super::block::names;
use super::context::Context;
use super::layout::Slice;
use super::values::{Values, Wanted};
use hamiltonian_symbolic::dag::{Array, Parameter};
use hamiltonian_symbolic::model::Shape;
use hamiltonian_symbolic::program::Value;
use std::fmt::Write;

/// A struct of values computed before an evaluation.
#[derive(Debug)]
pub struct Holder {
    /// Its name.
    pub name: String,
    values: Values,
    /// Parameter arrays, lifted to the state's scalar, and arrays that preparation fills.
    pub arrays: Vec<Slice>,
    /// True if it says how work on the system is computed.
    pub arithmetic: bool,
}

impl Holder {
    /// A holder of these values, and of the arrays among these slices.
    pub fn new(context: Context, name: String, values: &[Value], mut slices: Vec<Slice>) -> Holder {
        slices.retain(|slice| matches!(slice, Slice::Read(Array::Parameter(_) | Array::Held(_))));
        slices.sort_unstable();
        slices.dedup();
        Holder {
            name,
            values: Values::of(context.program, values.iter().copied()),
            arrays: slices,
            arithmetic: false,
        }
    }

    /// The same with the choice of how work on the system is computed.
    pub fn with_arithmetic(self) -> Holder {
        Holder {
            arithmetic: true,
            ..self
        }
    }

    /// Its type over `T`.
    pub fn ty(&self, context: Context) -> String {
        context.generics.holder_type(&self.name)
    }

    /// The declaration.
    pub fn declare(&self, out: &mut String, context: Context) {
        let generics = context.generics;
        let _ = write!(
            out,
            "#[doc(hidden)]\n#[allow(dead_code)]\n#[derive(__h::core::clone::Clone, __h::core::fmt::Debug)]\n\
             {} struct {}{} {{\nv: {},\n",
            generics.visibility,
            self.name,
            generics.holder_declaration(),
            match self.values.numbers.len() {
                0 => "__h::core::marker::PhantomData<T>".to_owned(),
                length => format!("[T; {length}]"),
            }
        );
        let masks = &self.values.masks;
        if !masks.is_empty() {
            let _ = writeln!(out, "m: [<T as __h::Real>::Mask; {}],", masks.len());
        }
        if self.arithmetic {
            out.push_str("arithmetic: __h::Arithmetic,\n");
        }
        for size in context.run_time_sizes() {
            let _ = writeln!(out, "n{size}: __h::core::primitive::usize,");
        }
        for (at, (ty, _)) in generics.functions.iter().enumerate() {
            let _ = writeln!(out, "f{at}: {ty},");
        }
        for &array in &self.arrays {
            let shape = shape(context, array);
            let ty = context.storage(&shape, "T");
            // All holders of a run share arrays that are sized at run time.
            let _ = match context.is_dynamic(&shape) {
                true => writeln!(out, "{}: __h::Arc<{ty}>,", field(array)),
                false => writeln!(out, "{}: {ty},", field(array)),
            };
        }
        out.push_str("}\n");
    }

    /// The expression that makes one where all its values are in scope; `array` is the expression of
    /// an array and `arithmetic` that of the arithmetic.
    pub fn fill(
        &self,
        context: Context,
        arithmetic: &str,
        array: impl Fn(Slice) -> String,
    ) -> String {
        let values = match self.values.numbers.len() {
            0 => "__h::core::marker::PhantomData".to_owned(),
            _ => format!("[{}]", names(&self.values.numbers)),
        };
        let mut out = format!("{} {{ v: {values}, ", self.name);
        if !self.values.masks.is_empty() {
            let _ = write!(out, "m: [{}], ", names(&self.values.masks));
        }
        if self.arithmetic {
            let _ = write!(out, "arithmetic: {arithmetic}, ");
        }
        for size in context.run_time_sizes() {
            let _ = write!(out, "n{size}: _n{size}, ");
        }
        for at in 0..context.generics.functions.len() {
            let _ = write!(out, "f{at}: __h::core::clone::Clone::clone(_f{at}), ");
        }
        for &own in &self.arrays {
            let _ = write!(out, "{}: {}, ", field(own), array(own));
        }
        out.push('}');
        out
    }

    /// The implementation of `Gather` for the prepared system.
    pub fn gather(&self, out: &mut String, context: Context) {
        let generics = context.generics;
        let mut fields = String::new();
        let mut equal = String::new();
        match self.values.numbers.len() {
            0 => fields.push_str("v: __h::core::marker::PhantomData, "),
            _ => {
                fields.push_str("v: __h::numbers::<T, __P, _, _>(_of, |_one| &_one.v), ");
                equal.push_str(" && self.v == _other.v");
            }
        }
        if !self.values.masks.is_empty() {
            fields.push_str("m: __h::masks::<T, __P, _, _>(_of, |_one| &_one.m), ");
            equal.push_str(" && __h::same_masks::<T, _>(&self.m, &_other.m)");
        }
        if self.arithmetic {
            fields.push_str("arithmetic: _of[0].arithmetic, ");
        }
        let mut fit = Vec::new();
        for size in context.run_time_sizes() {
            let _ = write!(fields, "n{size}: _of[0].n{size}, ");
            fit.push(format!("self.n{size} == _other.n{size}"));
        }
        for (at, (ty, arity)) in generics.functions.iter().enumerate() {
            let _ = write!(
                fields,
                "f{at}: __h::core::clone::Clone::clone(&_of[0].f{at}), "
            );
            let print = format!("<{ty} as __h::Function<{arity}>>::fingerprint");
            fit.push(format!("{print}(&self.f{at}) == {print}(&_other.f{at})"));
        }
        for &array in &self.arrays {
            let (name, shape) = (field(array), shape(context, array));
            let ty = context.storage(&shape, "T");
            let gathered = |of: &str| format!("__h::vectors::<{ty}, __P, _>(_of, |_one| {of})");
            let _ = match context.is_dynamic(&shape) {
                true => write!(
                    fields,
                    "{name}: __h::Arc::new({}), ",
                    gathered(&format!("&*_one.{name}"))
                ),
                false => write!(fields, "{name}: {}, ", gathered(&format!("&_one.{name}"))),
            };
            let _ = write!(equal, " && self.{name} == _other.{name}");
        }
        let fit = match fit.is_empty() {
            true => "true".to_owned(),
            false => fit.join(" && "),
        };
        let _ = writeln!(
            out,
            "#[automatically_derived]\nimpl{} __h::Gather<T> for {} {{\n\
             type Over<__U: __h::Real> = {};\n\
             #[inline(always)]\nfn gather<__P: __h::Pack>(_of: &[&Self]) -> Self::Over<T::Over<__P>> {{\n\
             {} {{ {fields} }}\n}}\n\
             fn fits(&self, _other: &Self) -> __h::core::primitive::bool {{ {fit} }}\n\
             fn equals(&self, _other: &Self) -> __h::core::primitive::bool {{ self.fits(_other){equal} }}\n}}",
            generics.holder_declaration(),
            self.ty(context),
            generics.holder_type_over(&self.name, "__U"),
            self.name,
        );
    }

    /// All values, in the order they are filled.
    pub fn values(&self) -> impl Iterator<Item = Value> + '_ {
        self.values.all()
    }
}

/// The field of an array in a holder.
pub fn field(array: Slice) -> String {
    array.name().trim_start_matches('_').to_owned()
}

/// The shape of an array that a holder has; a matrix is stored as its transpose.
pub fn shape(context: Context, array: Slice) -> Shape {
    match array {
        Slice::Read(Array::Held(number)) => {
            Shape::Vector(context.program.held[usize::from(number)].rows.clone())
        }
        Slice::Read(Array::Parameter(Parameter(number))) => {
            match &context.model.parameters[usize::from(number)].shape {
                // Row after row, so that a loop over columns moves on by one.
                Shape::Matrix(rows, columns) => Shape::Matrix(columns.clone(), rows.clone()),
                shape => shape.clone(),
            }
        }
        _ => unreachable!("a holder has no parts of vectors"),
    }
}

/// The type a body is a method of; the body calls it `_self`.
#[derive(Debug, Clone, Copy)]
pub enum Receiver<'a> {
    /// The user's type.
    System,
    /// A holder.
    Holder(&'a Holder),
}

impl Receiver<'_> {
    /// Its type.
    pub fn ty(self, context: Context) -> String {
        match self {
            Receiver::System => context.generics.system_type(),
            Receiver::Holder(holder) => holder.ty(context),
        }
    }

    /// The generics of a free function over it.
    pub fn declaration(self, context: Context) -> String {
        match self {
            Receiver::System => context.generics.declaration_with_scalar(),
            Receiver::Holder(_) => context.generics.holder_declaration(),
        }
    }

    /// The expression of how work is computed. A system does not say how it is prepared.
    pub fn arithmetic(self) -> &'static str {
        match self {
            Receiver::Holder(holder) if holder.arithmetic => "_self.arithmetic",
            _ => "__h::core::default::Default::default()",
        }
    }

    /// Binds values computed earlier; returns those that it does not have.
    pub fn read(self, out: &mut String, reads: &[Value]) -> Vec<Value> {
        let Receiver::Holder(holder) = self else {
            return reads.to_vec();
        };
        let mut rest: Wanted = reads.iter().map(|value| (*value, ())).collect();
        holder.values.bind(out, ["_self.v", "_self.m"], &mut rest);
        let is_missing = |value: &Value| rest.contains_key(value);
        reads.iter().copied().filter(is_missing).collect()
    }

    /// The `let`s of the run-time sizes.
    pub fn bind_sizes(self, out: &mut String, context: Context) {
        for size in context.run_time_sizes() {
            let name = &context.definition.checked.sizes[size].name;
            let _ = match self {
                Receiver::System => writeln!(out, "let _n{size} = *_self.{name};"),
                Receiver::Holder(_) => writeln!(out, "let _n{size} = _self.n{size};"),
            };
        }
    }

    /// The `let`s of the functions that are parameters.
    pub fn bind_functions(self, out: &mut String, context: Context) {
        let functions = context.definition.checked.functions.iter();
        let parameters = functions.filter(|function| function.value.is_none());
        for (at, function) in parameters.enumerate() {
            let _ = match self {
                Receiver::System => writeln!(out, "let _f{at} = &_self.{};", function.name),
                Receiver::Holder(_) => writeln!(out, "let _f{at} = &_self.f{at};"),
            };
        }
    }

    /// The `let` of a parameter array, or of an array that preparation filled, as a slice.
    pub fn bind_array(self, out: &mut String, context: Context, array: Slice) {
        let name = array.name();
        let _ = match (self, array) {
            (Receiver::System, Slice::Read(Array::Parameter(Parameter(number)))) => writeln!(
                out,
                "let _b{number} = {};\nlet {name} = _b{number}.as_slice();",
                match context.model.parameters[usize::from(number)].shape {
                    Shape::Matrix(..) => context.generics.lifted_rows(number),
                    _ => context.generics.lifted_array(number),
                }
            ),
            _ => writeln!(out, "let {name} = _self.{}.as_slice();", field(array)),
        };
    }
}
