//! Construction: `Default`, `new`, and the getters of what only `new` sets.
//!
//! Input: a header. Output: their tokens. Invariants: a system that `new` made has arrays of the
//! lengths its sizes say, and no index of its definition leaves them; no call needs the scalar of
//! the parameters spelt out.

use super::block::Context;
use super::generics::{Generics, list};
use super::item::located;
use super::number::over;
use super::{Definition, Field, Item, ParameterItem, allowances, layout, lex, reach};
use hamiltonian_symbolic::model::Shape;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use std::fmt::Write;

/// Where every parameter has a default: `Default`, over f64 only, and `with_defaults` over any scalar.
/// A `Default` over any scalar would leave the scalar of `Name::default()` open, and the fields of
/// `Name { l: 2.0, ..Default::default() }` without methods such as `sqrt`.
pub fn default(item: &Item, context: Context, generics: &Generics) -> String {
    if context.is_run_time.contains(&true) || item.parameters.iter().any(|p| p.default.is_none()) {
        return String::new();
    }
    let fields = |scalar: Option<&str>| -> String {
        let values = item
            .parameters
            .iter()
            .enumerate()
            .map(|(number, parameter)| {
                let value = default_of(item, context, number, scalar);
                format!("{}: {value}, ", parameter.name)
            });
        values.collect()
    };
    let (constants, system) = over_f64(generics);
    let mut text = format!(
        "#[automatically_derived]\nimpl{constants} __h::core::default::Default for {system} {{\n\
         fn default() -> Self {{ Self {{ {} }} }}\n}}\n",
        fields(None)
    );
    if let Some(scalar) = generics.scalars.first() {
        let _ = write!(
            text,
            "impl{} {} {{\n\
             /// The system with the default of every parameter, each rounded once to the scalar type of \
             the parameters. `Default` is the same over `f64`.\n\
             #[must_use]\n{} fn with_defaults() -> Self {{ Self {{ {} }} }}\n}}\n",
            generics.declaration(),
            generics.system_type(),
            generics.visibility,
            fields(Some(scalar))
        );
    }
    text
}

/// The default of a parameter that has one; over `f64` where no scalar is named.
fn default_of(item: &Item, context: Context, number: usize, scalar: Option<&str>) -> String {
    let numbers = item.parameters[number].default.iter().flatten();
    let numbers: Vec<String> = numbers.map(|text| over(text, scalar)).collect();
    match context.model.parameters[number].shape {
        Shape::Scalar => numbers.concat(),
        _ => format!("__h::core::convert::From::from([{}])", numbers.join(", ")),
    }
}

/// The value of a field that only `new` sets.
pub fn set_by_new(value: &str) -> String {
    format!("__h::SetByNew::new({value})")
}

/// `new`: sizes, then what has no default, in the order of the fields; the rest gets its default.
/// Where no argument tells the scalar of the parameters it is f64, as in `Default`.
pub fn new(
    definition: &Definition,
    item: &Item,
    context: Context,
    generics: &Generics,
) -> TokenStream {
    let scalar = generics.scalars.first().map_or("P", String::as_str);
    let is_told = item.parameters.iter().any(|p| p.default.is_none());
    // A constant of the user's may have the name of a parameter in capitals, and an argument may
    // not have a constant's.
    let argument = |name: &Ident| match name.to_string() {
        text if text.starts_with(char::is_uppercase) => {
            Ident::new(&format!("_{text}"), Span::call_site())
        }
        _ => name.clone(),
    };
    let (mut kinds, mut arguments, mut lets) =
        (TokenStream::new(), TokenStream::new(), TokenStream::new());
    let (mut names, mut fields) = (Vec::new(), String::new());
    let (mut checks, mut numbers) = (String::new(), String::new());
    for field in &item.fields {
        if let Field::Size(number) = field {
            let name = &item.sizes[*number].name;
            let (local, given) = (lex(&format!("_n{number}")), argument(name));
            arguments.extend(quote! { #given: __h::core::primitive::usize, });
            lets.extend(quote! { let #local = #given; });
            names.push(name);
            let _ = write!(fields, "{name}: {}, ", set_by_new(&format!("_n{number}")));
        }
    }
    for field in &item.fields {
        let Field::Parameter(number) = field else {
            continue;
        };
        let parameter = &item.parameters[*number];
        let name = &parameter.name;
        let shape = &context.model.parameters[*number].shape;
        if parameter.default.is_some() {
            let value = default_of(item, context, *number, is_told.then_some(scalar));
            let _ = write!(fields, "{name}: {value}, ");
            continue;
        }
        names.push(name);
        let value = format!("_a{number}");
        let _ = match layout::is_dynamic(shape, context.is_run_time) {
            true => write!(fields, "{name}: {}, ", set_by_new(&value)),
            false => write!(fields, "{name}: {value}, "),
        };
        let (local, given) = (lex(&format!("_a{number}")), argument(name));
        let ty = lex(&layout::storage(
            shape,
            scalar,
            context.indices,
            context.is_run_time,
            "__h",
        ));
        // A matrix with columns set at run time is no vector of coordinates.
        if *shape == Shape::Scalar || layout::has_dynamic_columns(shape, context.is_run_time) {
            arguments.extend(quote! { #given: #ty, });
            lets.extend(quote! { let #local = #given; });
        } else {
            let (kind, from) = (lex(&format!("K{number}")), lex(&format!("V{number}")));
            let bound = quote! { #kind, #from: __h::IntoVector<#kind, Vector = #ty>, };
            // Errors of an argument show its declaration.
            kinds.extend(located(bound, name.span(), 0));
            arguments.extend(quote! { #given: #from, });
            lets.extend(quote! { let #local = __h::IntoVector::into_vector(#given); });
        }
        let whole = match shape {
            Shape::Scalar => format!("0, 1, &[_a{number}]"),
            Shape::Vector(_) => format!("1, _a{number}.nrows(), _a{number}.as_slice()"),
            Shape::Matrix(..) => format!("2, _a{number}.nrows(), _a{number}.as_slice()"),
        };
        let _ = writeln!(numbers, "__h::check_parameter(\"{name}\", {whole})?;");
        if layout::is_dynamic(shape, context.is_run_time) {
            let (rows, columns) = layout::extents(shape, context.indices);
            let _ = writeln!(
                checks,
                "if _a{number}.nrows() != {rows} || _a{number}.ncols() != {columns} {{\n\
                 return __h::core::result::Result::Err(__h::Error::Shape {{ name: {:?}, \
                 expected: ({rows}) * ({columns}), found: _a{number}.len() }});\n}}",
                name.to_string(),
            );
        }
    }
    if names.is_empty() {
        return TokenStream::new();
    }
    checks.push_str(&numbers);
    let mut allow = allowances(&names);
    if names.len() > 7 {
        // How many parameters a system has is not a matter of style.
        allow.extend(quote! { #[allow(clippy::too_many_arguments)] });
    }
    let visibility = &item.visibility;
    let questions = reach::constructed(definition.reaches, context);
    let more = if questions.is_empty() {
        TokenStream::new()
    } else {
        quote! { #[doc = " `Error::Index` or `Error::Range` if an index of H leaves its array for these sizes."] }
    };
    // Sizes that do not fit explain arrays that do not.
    let checks = lex(&(questions + &checks));
    let system = lex(&format!("Self {{ {fields} }}"));
    let kinds = if kinds.is_empty() {
        kinds
    } else {
        quote! { < #kinds > }
    };
    // Errors of a call show the type's declaration.
    let new = Ident::new("new", item.name.span());
    let sets = defaults_set(item, &names, context.is_run_time.contains(&true))
        .map(|text| quote! { #[doc = #text] });
    let method = if context.is_run_time.contains(&true) {
        quote! {
            /// The system of these sizes and parameters: the sizes first, then the parameters without a
            /// default, in the order of their declaration.
            #sets
            ///
            /// # Errors
            /// `Error::Shape` if an array does not have the number of components that its sizes say,
            /// `Error::Parameter` if a number given is NaN.
            #more
            #allow
            #visibility fn #new #kinds (#arguments) -> __h::core::result::Result<Self, __h::Error> {
                #lets
                #checks
                __h::core::result::Result::Ok(#system)
            }
        }
    } else {
        quote! {
            /// The system with these parameters: those without a default, in the order of their
            /// declaration.
            #sets
            #allow
            #[must_use]
            #visibility fn #new #kinds (#arguments) -> Self {
                #lets
                #system
            }
        }
    };
    let (declared, system) = if is_told {
        (generics.declaration(), generics.system_type())
    } else {
        over_f64(generics)
    };
    let header = lex(&format!("impl{declared} {system}"));
    quote! { #header { #method } }
}

/// How the parameters with a default, which are no arguments of `new`, are set.
fn defaults_set(item: &Item, arguments: &[&Ident], is_fallible: bool) -> Option<String> {
    let with_default = |p: &&ParameterItem| p.default.is_some();
    let names: Vec<String> = item
        .parameters
        .iter()
        .filter(with_default)
        .map(|p| p.name.to_string())
        .collect();
    let first = names.first()?;
    let (arguments, name) = (
        arguments
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>(),
        &item.name,
    );
    let new = format!(
        "{name}::new({}){}",
        arguments.join(", "),
        if is_fallible { "?" } else { "" }
    );
    Some(format!(
        " The defaults of `{}` are no arguments: `{name} {{ {first}: …, ..{new} }}` sets another value.",
        names.join("`, `")
    ))
}

/// `<const N0: usize>` and `Name<N0, f64>`, for what tells no scalar.
pub fn over_f64(generics: &Generics) -> (String, String) {
    let scalars = generics.scalars.iter();
    let scalars: Vec<_> = scalars
        .map(|_| "__h::core::primitive::f64".to_owned())
        .collect();
    let constants = list(generics.constants_declared());
    (constants, generics.system_type_over(&scalars))
}

/// The fields that only `new` sets.
pub fn getters(item: &Item, context: Context, generics: &Generics) -> TokenStream {
    let visibility = &item.visibility;
    let mut out = TokenStream::new();
    for field in &item.fields {
        match field {
            Field::Size(number) => {
                let size = &item.sizes[*number];
                let (name, allow) = (&size.name, allowances(&[&size.name]));
                let docs = if size.attributes.is_empty() {
                    let text = format!(" The size `{name}`.");
                    quote! { #[doc = #text] }
                } else {
                    let attributes = &size.attributes;
                    quote! { #(#attributes)* }
                };
                out.extend(quote! {
                    #docs #allow #[must_use]
                    #visibility fn #name(&self) -> __h::core::primitive::usize { *self.#name }
                });
            }
            Field::Parameter(number) => {
                let shape = &context.model.parameters[*number].shape;
                if !layout::is_dynamic(shape, context.is_run_time) {
                    continue;
                }
                let parameter = &item.parameters[*number];
                let (name, allow) = (&parameter.name, allowances(&[&parameter.name]));
                let scalar = generics.scalars.first().map_or("P", String::as_str);
                let ty = lex(&layout::storage(
                    shape,
                    scalar,
                    context.indices,
                    context.is_run_time,
                    "__h",
                ));
                let text = format!(" Parameter `{name}`.");
                let attributes = &parameter.attributes;
                let docs = if attributes.is_empty() {
                    quote! { #[doc = #text] }
                } else {
                    quote! { #(#attributes)* }
                };
                out.extend(quote! {
                    #docs #allow #[must_use]
                    #visibility fn #name(&self) -> &#ty { &self.#name }
                });
            }
        }
    }
    out
}
