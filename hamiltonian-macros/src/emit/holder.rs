//! The structs that carry prepared values into evaluations, and how a body reads from what it is
//! a method of.
//!
//! Input: the values, masks and parameter arrays that functions read. Output: struct declarations
//! and the expressions that fill and read them. Invariant: a holder has what its functions read
//! and nothing else, but all run-time sizes.

use super::block::{Context, name};
use super::generics::Generics;
use super::layout::{self, Slice};
use super::parts::{self, Wanted};
use hamiltonian_symbolic::model::Shape;
use hamiltonian_symbolic::program::Value;
use std::fmt::Write;

/// A struct of values computed before an evaluation.
#[derive(Debug)]
pub struct Holder {
    /// Its name.
    pub name: &'static str,
    values: Vec<Value>,
    masks: Vec<Value>,
    /// Parameter arrays, lifted to the state's scalar, and arrays that preparation fills.
    pub arrays: Vec<Slice>,
}

impl Holder {
    /// A holder of these values.
    pub fn new(
        context: Context,
        name: &'static str,
        values: &[Value],
        arrays: Vec<Slice>,
    ) -> Holder {
        let is_mask = |value: &Value| context.program.instruction(*value).is_mask();
        let (masks, values) = values.iter().copied().partition(is_mask);
        Holder {
            name,
            values,
            masks,
            arrays,
        }
    }

    /// The declaration.
    pub fn declare(&self, out: &mut String, context: Context, generics: &Generics) {
        let _ = write!(
            out,
            "#[doc(hidden)]\n#[allow(dead_code)]\n#[derive(__h::core::clone::Clone, __h::core::fmt::Debug)]\n\
             {} struct {}{} {{\nv: {},\n",
            generics.visibility,
            self.name,
            generics.holder_declaration(),
            match self.values.len() {
                0 => "__h::core::marker::PhantomData<T>".to_owned(),
                length => format!("[T; {length}]"),
            }
        );
        if !self.masks.is_empty() {
            let _ = writeln!(out, "m: [<T as __h::Real>::Mask; {}],", self.masks.len());
        }
        for (size, run_time) in context.is_run_time.iter().enumerate() {
            if *run_time {
                let _ = writeln!(out, "n{size}: __h::core::primitive::usize,");
            }
        }
        for &array in &self.arrays {
            let shape = shape(context, array);
            let ty = layout::storage(&shape, "T", context.indices, context.is_run_time, "__h");
            // All holders of a run share what is sized at run time.
            let _ = match layout::is_dynamic(&shape, context.is_run_time) {
                true => writeln!(out, "{}: __h::Arc<{ty}>,", field(array)),
                false => writeln!(out, "{}: {ty},", field(array)),
            };
        }
        out.push_str("}\n");
    }

    /// The expression that makes one where all its values are in scope; `array` says how an array
    /// is had.
    pub fn fill(&self, context: Context, array: impl Fn(Slice) -> String) -> String {
        let list = |values: &[Value]| {
            values
                .iter()
                .map(|v| name(*v))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let values = match self.values.len() {
            0 => "__h::core::marker::PhantomData".to_owned(),
            _ => format!("[{}]", list(&self.values)),
        };
        let mut out = format!("{} {{ v: {values}, ", self.name);
        if !self.masks.is_empty() {
            let _ = write!(out, "m: [{}], ", list(&self.masks));
        }
        for (size, run_time) in context.is_run_time.iter().enumerate() {
            if *run_time {
                let _ = write!(out, "n{size}: _n{size}, ");
            }
        }
        for &own in &self.arrays {
            let _ = write!(out, "{}: {}, ", field(own), array(own));
        }
        out.push('}');
        out
    }

    /// All values, in the order they are filled.
    pub fn values(&self) -> impl Iterator<Item = Value> + '_ {
        self.values.iter().chain(&self.masks).copied()
    }

    /// Takes the holder's arrays apart as far as they are read; what it does not have.
    fn read(&self, out: &mut String, reads: &[Value]) -> Vec<Value> {
        let mut rest: Wanted = reads.iter().map(|value| (*value, ())).collect();
        parts::bind(out, "_self.v", &self.values, &rest);
        parts::bind(out, "_self.m", &self.masks, &rest);
        for value in self.values() {
            rest.remove(&value);
        }
        let is_missing = |value: &Value| rest.contains_key(value);
        reads.iter().copied().filter(is_missing).collect()
    }
}

/// The field of an array in a holder.
pub fn field(array: Slice) -> String {
    array.name().trim_start_matches('_').to_owned()
}

/// The shape of an array that a holder has.
pub fn shape(context: Context, array: Slice) -> Shape {
    match array {
        Slice::Held(number) => {
            Shape::Vector(context.program.held[usize::from(number)].rows.clone())
        }
        Slice::Parameter(number) => context.model.parameters[usize::from(number)].shape.clone(),
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
    pub fn ty(self, generics: &Generics) -> String {
        match self {
            Receiver::System => generics.system_type(),
            Receiver::Holder(holder) => format!("{}{}", holder.name, generics.holder_arguments()),
        }
    }

    /// The generics of a free function over it.
    pub fn declaration(self, generics: &Generics) -> String {
        match self {
            Receiver::System => generics.declaration_with_scalar(),
            Receiver::Holder(_) => generics.holder_declaration(),
        }
    }

    /// Binds values computed earlier; those that it does not have.
    pub fn read(self, out: &mut String, reads: &[Value]) -> Vec<Value> {
        match self {
            Receiver::System => reads.to_vec(),
            Receiver::Holder(holder) => holder.read(out, reads),
        }
    }

    /// How a scalar parameter is read.
    pub fn scalar(self, generics: &Generics, parameter: u16) -> String {
        match self {
            Receiver::System => generics.lifted(parameter),
            Receiver::Holder(_) => {
                unreachable!("scalars are leaves of preparation: nothing later reads them")
            }
        }
    }

    /// The `let` of a run-time size.
    pub fn bind_size(self, out: &mut String, generics: &Generics, size: usize) {
        let _ = match self {
            Receiver::System => writeln!(out, "let _n{size} = *_self.{};", generics.sizes[size]),
            Receiver::Holder(_) => writeln!(out, "let _n{size} = _self.n{size};"),
        };
    }

    /// The `let` of a parameter array, or of an array that preparation filled, as a slice.
    pub fn bind_array(self, out: &mut String, generics: &Generics, array: Slice) {
        let name = array.name();
        let _ = match (self, array) {
            (Receiver::System, Slice::Parameter(number)) => writeln!(
                out,
                "let _b{number} = {};\nlet {name} = _b{number}.as_slice();",
                generics.lifted_array(number)
            ),
            _ => writeln!(out, "let {name} = _self.{}.as_slice();", field(array)),
        };
    }
}
