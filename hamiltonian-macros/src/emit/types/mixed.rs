//! Coordinates of mixed shape: a generated struct with one field a group.
//!
//! Input: the groups. Output: text of the struct, its constructor and its `Vector`. Invariant: a
//! group is one part, in declaration order.

use crate::emit::names::context::{Context, ZERO};
use hamiltonian_symbolic::model::{Group, Shape};
use std::fmt::Write;

/// The traits the struct derives: it is `Copy` where static vectors are.
pub fn derives(context: Context) -> String {
    let is_static = |group: &Group| !context.is_on_heap(&group.shape.of_parameter());
    let copy = match context.groups.iter().all(is_static) {
        true => "__h::Copy, ",
        false => "",
    };
    format!("#[derive({copy}__h::Clone, __h::fmt::Debug, __h::PartialEq)]\n")
}

/// The declaration without attributes and docs: `pub struct NameVector<T> { … }`
pub fn declaration(context: Context) -> String {
    let visibility = &context.generics.visibility;
    let mut fields = String::new();
    for group in context.groups {
        let ty = context.group_storage(group, "T");
        let doc = format!(
            " `{}` of coordinates, `{}` of momenta.",
            group.coordinate, group.momentum
        );
        let _ = writeln!(
            fields,
            "#[doc = {doc:?}]\n{visibility} {}: {ty},",
            group.coordinate
        );
    }
    format!(
        "{visibility} struct {}{} {{\n{fields}}}",
        context.mixed_name(),
        context.generics.declared(["T".to_owned()]),
    )
}

/// The arguments of a constructor, an array in any form `IntoVector` takes.
struct Arguments {
    /// Generic parameters, with their brackets.
    kinds: String,
    /// Arguments with their types.
    arguments: String,
    /// The fields of the struct.
    fields: String,
}

fn arguments(context: Context) -> Arguments {
    let (mut kinds, mut arguments, mut fields) = (Vec::new(), Vec::new(), Vec::new());
    for (at, group) in context.groups.iter().enumerate() {
        let field = &group.coordinate;
        if group.shape == Shape::Scalar {
            arguments.push(format!("_{at}: T"));
            fields.push(format!("{field}: _{at}"));
        } else {
            let storage = context.group_storage(group, "T");
            kinds.push(format!(
                "K{at}, V{at}: __h::IntoVector<K{at}, Vector = {storage}>"
            ));
            arguments.push(format!("_{at}: V{at}"));
            fields.push(format!("{field}: __h::IntoVector::into_vector(_{at})"));
        }
    }
    Arguments {
        kinds: kinds.join(", "),
        arguments: arguments.join(", "),
        fields: fields.join(", "),
    }
}

/// The methods that make coordinates, for expression form, where the struct has no name outside: over `f64`, and over
/// any scalar.
pub fn constructors(context: Context, method: &str) -> String {
    let Arguments {
        kinds,
        arguments,
        fields,
    } = arguments(context);
    let (ty, name) = (context.mixed_type(), context.mixed_name());
    let one = |method: &str, bound: &str| {
        format!(
            "pub fn {method}<T: __h::Real{bound}, {kinds}>(&self, {arguments}) -> {ty} {{ {name} {{ {fields} }} }}\n"
        )
    };
    one(method, " + __h::Plain") + &one(&format!("{method}_over"), "")
}

/// The implementations.
pub fn implementations(context: Context) -> String {
    let visibility = &context.generics.visibility;
    let ty = context.mixed_type();
    let name = context.mixed_name();
    let over = context.generics.vector_type_over(&name, "__U");
    let shape = context.generics.vector_type_over(&name, "()");
    let constants = context.generics.declared([]);
    let declaration = context.generics.vector_declaration();
    let groups = context.groups;
    let Arguments {
        kinds,
        arguments,
        fields,
    } = arguments(context);
    let (mut parts, mut parts_mut, mut columns) = (String::new(), String::new(), String::new());
    let (mut extents, mut uneven) = (String::new(), String::new());
    let (mut zeros, mut zeros_over, mut takes) = (String::new(), String::new(), String::new());
    for (at, group) in groups.iter().enumerate() {
        let field = &group.coordinate;
        // The last part serves every further number: there is none.
        let pattern = if at + 1 == groups.len() {
            "_".to_owned()
        } else {
            at.to_string()
        };
        if group.shape == Shape::Scalar {
            let _ = writeln!(
                parts,
                "{pattern} => __h::core::slice::from_ref(&self.{field}),"
            );
            let _ = writeln!(
                parts_mut,
                "{pattern} => __h::core::slice::from_mut(&mut self.{field}),"
            );
            let _ = write!(zeros, "{field}: {ZERO}, ");
            let _ = write!(zeros_over, "{field}: <__U as __h::Real>::zero(), ");
            let _ = write!(takes, "{field}: self.{field}, ");
        } else {
            let _ = writeln!(parts, "{pattern} => self.{field}.as_slice(),");
            let _ = writeln!(columns, "{at} => __h::Vector::columns(&self.{field}, 0),");
            if !group.shape.axes().is_empty() {
                let _ = writeln!(extents, "{at} => __h::Vector::extents(&self.{field}, 0),");
                let _ = writeln!(uneven, "{at} => __h::Vector::uneven(&self.{field}, 0),");
            }
            let _ = writeln!(parts_mut, "{pattern} => self.{field}.as_mut_slice(),");
            let _ = write!(zeros, "{field}: __h::Vector::zeros_like(&self.{field}), ");
            let _ = write!(
                zeros_over,
                "{field}: __h::Vector::zeros_over::<__U>(&self.{field}), "
            );
            let _ = write!(takes, "{field}: __h::Vector::take(&mut self.{field}), ");
        }
    }
    if !extents.is_empty() {
        extents = format!(
            "fn extents(&self, _k: __h::usize) -> &[__h::usize] {{ match _k {{ {extents} _ => &[] }} }}\n"
        );
        uneven = format!(
            "fn uneven(&self, _k: __h::usize) -> __h::Option<&__h::Uneven> {{ match _k {{ {uneven} _ => __h::Option::None }} }}\n"
        );
    }
    format!(
        "#[automatically_derived]\nimpl{constants} __h::Shape for {shape} {{\n\
         type Vector<__U: __h::Real> = {over};\n}}\n\
         #[automatically_derived]\nimpl{declaration} __h::Vector for {ty} {{\n\
         type Scalar = T;\nconst PARTS: __h::usize = {};\n\
         #[inline(always)]\nfn part(&self, _k: __h::usize) -> &[T] {{ match _k {{ {parts} }} }}\n\
         #[inline(always)]\nfn part_mut(&mut self, _k: __h::usize) -> &mut [T] {{ match _k {{ {parts_mut} }} }}\n\
         fn columns(&self, _k: __h::usize) -> __h::usize {{ match _k {{ {columns} _ => 1 }} }}\n\
         {extents}{uneven}\
         fn zeros_like(&self) -> Self {{ Self {{ {zeros} }} }}\n\
         type Shape = {shape};\n\
         #[inline(always)]\nfn zeros_over<__U: __h::Real>(&self) -> {over} {{ {name} {{ {zeros_over} }} }}\n\
         #[inline(always)]\nfn take(&mut self) -> Self {{ Self {{ {takes} }} }}\n}}\n\
         impl{declaration} {ty} {{\n\
         /// The groups in declaration order, over `f64`. Arrays are taken in any form of `IntoVector`.\n\
         #[must_use]\n{visibility} fn new<{kinds}>({arguments}) -> Self where T: __h::Plain {{ Self {{ {fields} }} }}\n\
         /// The groups in declaration order, over any scalar.\n\
         #[must_use]\n{visibility} fn over<{kinds}>({arguments}) -> Self {{ Self {{ {fields} }} }}\n}}\n",
        groups.len(),
    )
}
