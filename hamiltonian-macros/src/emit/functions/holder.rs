//! Holders: the types that carry prepared values into evaluations, and the expressions by which bodies read them.
//!
//! Input: the values, masks and parameter arrays that functions read. Output: their type, and the
//! expressions that fill and read it. Invariant: a holder has exactly the values that its functions read,
//! and all run-time sizes and functions.

use crate::emit::names::context::Context;
use crate::emit::names::layout::Slice;
use crate::emit::statements::values::{Values, Wanted};
use crate::emit::steps::inline::Inlined;
use hamiltonian_symbolic::dag::{Array, Parameter};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::Shape;
use hamiltonian_symbolic::program::Value;
use hamiltonian_symbolic::sort::Arrange;
use std::fmt::Write;

/// The values computed before an evaluation, core's `Held`, and the data of the prepared system that is read with them.
#[derive(Debug)]
pub struct Holder {
    /// The name of its functions' parts, and of the prepared system.
    pub name: String,
    values: Values,
    /// Parameter arrays, lifted to the state's scalar, and arrays that preparation fills.
    pub arrays: Vec<Slice>,
    /// True for the prepared system, a struct around the held values.
    is_prepared: bool,
}

/// Data of a holder that is not computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Datum {
    /// The arithmetic of loops.
    Arithmetic,
    /// A size that is set at run time.
    Size(usize),
    /// A function that is a parameter.
    Function(usize),
    Array(Slice),
}

/// A list as nested pairs.
fn pairs(list: &[String]) -> String {
    let pair = |rest: String, one: &String| format!("({one}, {rest})");
    list.iter().rev().fold("()".to_owned(), pair)
}

impl Holder {
    /// The prepared system: a holder of these values, and of the arrays among these slices.
    pub fn prepared(
        context: Context,
        name: String,
        values: &[Value],
        mut slices: Vec<Slice>,
    ) -> Holder {
        slices
            .retain(|slice| matches!(slice, Slice::Read(Array::Parameter(_) | Array::Hoisted(_))));
        slices.arrange();
        slices.dedup();
        Holder {
            name,
            values: Values::of(context.program, values.iter().copied()),
            arrays: slices,
            is_prepared: true,
        }
    }

    /// A holder of these values beside the data of the prepared system.
    pub fn with_values(&self, context: Context, name: String, values: &[Value]) -> Holder {
        Holder {
            name,
            values: Values::of(context.program, values.iter().copied()),
            arrays: self.arrays.clone(),
            is_prepared: false,
        }
    }

    /// Its type over `T`.
    pub fn ty(&self, context: Context) -> String {
        match self.is_prepared {
            true => context.generics.holder_type(&self.name),
            false => self.held(),
        }
    }

    /// The type of the held values.
    pub fn held(&self) -> String {
        match self.counts() {
            (numbers, 0) => format!("__h::Held<T, {numbers}>"),
            (numbers, masks) => format!("__h::Held<T, {numbers}, {masks}>"),
        }
    }

    /// The numbers of held numbers and masks.
    fn counts(&self) -> (usize, usize) {
        (self.values.numbers.len(), self.values.masks.len())
    }

    /// The type of the data.
    fn data_type(&self, context: Context) -> String {
        let ty = |datum: &Datum| match *datum {
            Datum::Arithmetic => "__h::Arithmetic".to_owned(),
            Datum::Size(_) => "__h::usize".to_owned(),
            Datum::Function(at) => {
                let (ty, arity) = &context.generics.functions[at];
                format!("__h::Given<{ty}, {arity}>")
            }
            Datum::Array(array) => {
                let shape = shape(context, array);
                let ty = context.storage(&shape, "T");
                // All holders of a run share arrays that are on the heap.
                match context.is_on_heap(&shape) {
                    true => format!("__h::Arc<{ty}>"),
                    false => ty,
                }
            }
        };
        let data: Vec<String> = self.data(context).iter().map(ty).into_list();
        pairs(&data)
    }

    fn data(&self, context: Context) -> Vec<Datum> {
        let functions = 0..context.generics.functions.len();
        ([Datum::Arithmetic].into_iter())
            .chain(context.run_time_sizes().map(Datum::Size))
            .chain(functions.map(Datum::Function))
            .chain(self.arrays.iter().copied().map(Datum::Array))
            .into_list()
    }

    /// The expression of the held values, in a body.
    fn root(&self) -> &'static str {
        match self.is_prepared {
            true => "_self.0",
            false => "_self",
        }
    }

    /// The expression of a datum, in a body.
    fn place(&self, context: Context, datum: Datum) -> String {
        let mut data = self.data(context).into_iter();
        let at = data.position(|known| known == datum);
        let rest = ".1".repeat(at.expect("a body reads what is held"));
        match self.is_prepared {
            true => format!("_self.0.data{rest}.0"),
            false => format!("_d{rest}.0"),
        }
    }

    /// The expression of a function that is a parameter, in a body.
    pub fn function(&self, context: Context, at: usize) -> String {
        format!("{}.0", self.place(context, Datum::Function(at)))
    }

    /// The declaration of the prepared system with its data.
    pub fn declare(&self, out: &mut String, context: Context) {
        let generics = context.generics;
        let (declaration, name) = (generics.holder_declaration(), &self.name);
        let (numbers, masks) = self.counts();
        let _ = writeln!(
            out,
            "type __D{} = __h::DataOf<T, {}>;\n\
             __h::prepared!([{} struct {name}] [{declaration}] [{}] {}; {numbers}, {masks});",
            generics.holder_declaration_without_bounds(),
            generics.holder_type(name),
            generics.visibility,
            generics.holder_arguments(),
            self.data_type(context),
        );
    }

    /// The expression that makes one of the texts of its values.
    pub fn fill(&self, values: &[String]) -> String {
        let [numbers, masks] = self.lists(values);
        format!("__h::Held::new([{numbers}], [{masks}], ())")
    }

    /// The expression that makes the prepared system of the texts of its values; `array` is the expression of an array.
    pub fn fill_prepared(
        &self,
        context: Context,
        values: &[String],
        array: impl Fn(Slice) -> String,
    ) -> String {
        let value = |datum: &Datum| match *datum {
            Datum::Arithmetic => "__h::Default::default()".to_owned(),
            Datum::Size(size) => format!("_n{size}"),
            Datum::Function(at) => format!("__h::Given(__h::Clone::clone(_f{at}))"),
            Datum::Array(own) => array(own),
        };
        let data: Vec<String> = self.data(context).iter().map(value).into_list();
        let ([numbers, masks], data) = (self.lists(values), pairs(&data));
        format!(
            "let _v = [{numbers}];\n{}(__h::Held::new(_v, [{masks}], {data}))",
            self.name
        )
    }

    fn lists(&self, values: &[String]) -> [String; 2] {
        let (numbers, masks) = values.split_at(self.values.numbers.len());
        [numbers, masks].map(|texts| texts.join(", "))
    }

    /// All values, in the order they are filled.
    pub fn values(&self) -> impl Iterator<Item = Value> + '_ {
        self.values.all()
    }
}

/// The shape of an array that a holder has; a matrix is stored as its transpose.
pub fn shape(context: Context, array: Slice) -> Shape {
    match array {
        Slice::Read(Array::Hoisted(number)) => {
            Shape::Vector(context.program.hoisted[usize::from(number)].rows.clone())
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
            Receiver::Holder(holder) if holder.is_prepared => "_self.0.data.0",
            Receiver::Holder(_) => "_d.0",
            Receiver::System => "__h::Default::default()",
        }
    }

    /// Binds values computed earlier; returns those that it does not have.
    pub fn read(self, out: &mut String, reads: &[Value], inlined: &mut Inlined) -> Vec<Value> {
        let Receiver::Holder(holder) = self else {
            return reads.to_vec();
        };
        let mut rest: Wanted = reads.iter().map(|value| (*value, ())).collect();
        let [numbers, masks] = ["v", "m"].map(|field| format!("{}.{field}", holder.root()));
        (holder.values).bind(out, [&numbers, &masks], &mut rest, inlined);
        let is_missing = |value: &Value| rest.contains_key(value);
        reads.iter().copied().filter(is_missing).into_list()
    }

    /// The `let`s of the run-time sizes.
    pub fn bind_sizes(self, out: &mut String, context: Context) {
        for size in context.run_time_sizes() {
            let name = &context.definition.checked.sizes[size].name;
            let _ = match self {
                Receiver::System => writeln!(out, "let _n{size} = *_self.{name};"),
                Receiver::Holder(holder) => {
                    let place = holder.place(context, Datum::Size(size));
                    writeln!(out, "let _n{size} = {place};")
                }
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
                Receiver::Holder(holder) => {
                    let place = holder.function(context, at);
                    writeln!(out, "let _f{at} = &{place};")
                }
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
                    _ => context.lifted(number),
                }
            ),
            (Receiver::Holder(holder), _) => {
                let place = holder.place(context, Datum::Array(array));
                writeln!(out, "let {name} = {place}.as_slice();")
            }
            (Receiver::System, _) => unreachable!("preparation reads parameters alone"),
        };
    }
}
