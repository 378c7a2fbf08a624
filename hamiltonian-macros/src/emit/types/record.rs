//! Parameters and coordinates for serde, where the library has its feature `serde`.
//!
//! Input: the fields of a definition. Output: text of a call of core's `record`, which has the implementations.
//! Invariant: a system that is read is checked as by `new`.

use super::construct::set_by_new_type;
use crate::emit::names::context::Context;
use hamiltonian_language::checked::Field;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::Shape;
use std::fmt::Write;

/// True if the library has its feature `serde`. Snapshots of emitted code are without it.
pub const IS_ON: bool = cfg!(all(feature = "serde", not(test)));

/// A list of generic parameters or arguments without its brackets.
fn inside(list: &str) -> &str {
    let list = list.strip_prefix('<').unwrap_or(list);
    list.strip_suffix('>').unwrap_or(list)
}

/// The parameters of a system as a struct with named fields.
pub fn system(context: Context) -> String {
    let (generics, checked) = (context.generics, context.definition.checked);
    let scalar = generics.scalars.first().map_or("", String::as_str);
    let mut fields = String::new();
    for field in &checked.fields {
        let _ = match *field {
            Field::Size(size) => {
                let name = &checked.sizes[usize::from(size.0)].name;
                write!(fields, "{name}: list {}, ", set_by_new_type("__h::usize"))
            }
            Field::Function(at) => {
                let at = at.0 as usize;
                let (name, ty) = (&checked.functions[at].name, &generics.functions[at].0);
                write!(fields, "{name}: number {ty}, ")
            }
            Field::Parameter(number) => {
                let name = &checked.parameters[number.0 as usize].name;
                let shape = &context.model.parameters[number.0 as usize].shape;
                let ty = context.field(shape, scalar);
                let (kind, ty) = match (shape, context.typed_axes(shape)) {
                    (Shape::Scalar, _) => ("number", ty),
                    (_, Some(axes)) if axes.len() == 3 => ("three", ty),
                    (_, Some(_)) => ("four", ty),
                    _ if context.is_dynamic(shape) => ("list", set_by_new_type(&ty)),
                    _ => ("list", ty),
                };
                write!(fields, "{name}: {kind} {ty}, ")
            }
        };
    }
    let functions = generics.functions.iter().map(|(name, _)| name.as_str());
    let known: Vec<&str> = functions
        .chain(generics.scalars.iter().map(String::as_str))
        .into_list();
    let check = match context.has_run_time_sizes() {
        true => "Self::__checked",
        false => "",
    };
    format!(
        "__h::record!([{}] [{}] {}, {:?}, [{}], [{check}] {{ {fields} }});\n",
        inside(&generics.declaration_of_values()),
        inside(&generics.arguments()),
        generics.system_type(),
        generics.name,
        known.join(", "),
    )
}

/// Coordinates of mixed shape as a struct with named fields.
pub fn vector(context: Context) -> String {
    let mut fields = String::new();
    for group in context.groups {
        let kind = match group.shape {
            Shape::Scalar => "number",
            _ => "list",
        };
        let ty = context.group_storage(group, "T");
        let _ = write!(fields, "{}: {kind} {ty}, ", group.coordinate);
    }
    let ty = context.mixed_type();
    format!(
        "__h::record!(vector [{}] [{}] {ty}, {:?}, [T], [] {{ {fields} }});\n",
        inside(&context.generics.vector_declaration()),
        inside(ty.strip_prefix(&context.mixed_name()).unwrap_or_default()),
        context.mixed_name(),
    )
}
