//! Construction: `Default`, `new`, and the getters of the fields that only `new` sets.
//!
//! Input: a header. Output: their tokens. Invariants: a system that `new` made has arrays of the
//! lengths its sizes say, and no index of its definition leaves them; no call needs the scalar of
//! the parameters spelt out.

use super::reach;
use crate::emit::names::context::Context;
use crate::emit::tokens::{allowances, documented, lex, located};
use hamiltonian_language::ast::Header;
use hamiltonian_language::checked::{Extent, Field, Parameter, Type};
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::Shape;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use std::fmt::Write;

/// Returns true if every parameter has a default, and nothing else must be given.
pub fn is_all_defaults(context: Context) -> bool {
    let has_functions = !context.generics.functions.is_empty();
    !context.has_run_time_sizes() && !has_functions && !context.definition.defaults.contains(&None)
}

/// `with_defaults` over any scalar. A `Default` over any scalar would leave the scalar of `Name::default()` open, and the
/// fields of `Name { l: 2.0, ..Default::default() }` without methods such as `sqrt`.
pub fn with_defaults(context: Context, item: &Header) -> Option<TokenStream> {
    let all = is_all_defaults(context);
    let scalar = context.generics.scalars.first().filter(|_| all)?;
    let parameters = context.definition.checked.parameters.iter().enumerate();
    let fields = parameters.map(|(number, parameter)| {
        let value = default_of(context, number, scalar);
        format!("{}: {value}, ", parameter.name)
    });
    let method = format!(
        "/// The system with the default of every parameter, each rounded once to the scalar type of \
         the parameters. `Default` is the same over `f64`.\n\
         #[must_use]\n{} fn with_defaults() -> Self {{ Self {{ {} }} }}\n",
        context.generics.visibility,
        fields.collect::<String>()
    );
    let name = context.definition.type_name(item);
    Some(located(lex(&method), name.span(), 0))
}

/// The default of a parameter that has one, over a scalar.
fn default_of(context: Context, number: usize, scalar: &str) -> String {
    let numbers = context.definition.defaults[number].iter().flatten();
    let constant = format!("<{scalar} as __h::Real>::constant");
    let numbers: Vec<String> = numbers
        .map(|text| text.replace("T::constant", &constant))
        .into_list();
    let array = |numbers: &[String]| format!("[{}]", numbers.join(", "));
    let value = match context.definition.checked.parameters[number].ty {
        Type::Matrix(_, Extent::Literal(columns)) => {
            // An array of arrays is a list of columns to the matrices that are emitted.
            let columns = columns as usize;
            let column = |at: usize| {
                let column = numbers.iter().skip(at).step_by(columns).cloned();
                array(&column.into_list())
            };
            array(&(0..columns).map(column).into_list())
        }
        Type::Vector(_) => array(&numbers),
        Type::Array(_) => {
            // From the innermost lists to the whole.
            let extents = context.model.parameters[number].shape.axes().iter().rev();
            let extents = extents.filter_map(Affine::as_constant);
            let lists = extents.fold(numbers, |parts, extent| {
                parts.chunks(extent as usize).map(array).into_list()
            });
            return lists.concat();
        }
        _ => return numbers.concat(),
    };
    format!("__h::core::convert::From::from({value})")
}

/// The value of a field that only `new` sets.
pub fn set_by_new(value: &str) -> String {
    format!("__h::SetByNew::new({value})")
}

/// The type of a field that only `new` sets.
pub fn set_by_new_type(ty: &str) -> String {
    format!("__h::SetByNew<{ty}>")
}

/// `new`: sizes, then functions, then the parameters without a default, each in the order of the fields; the
/// rest gets its default. The scalar of the parameters is f64 if no argument determines it, as in `Default`.
pub fn new(context: Context, item: &Header) -> TokenStream {
    let (definition, generics) = (context.definition, context.generics);
    let is_told = definition.defaults.contains(&None);
    let scalar = generics.scalars.first().filter(|_| is_told);
    let scalar = scalar.map_or("__h::core::primitive::f64", String::as_str);
    let (mut kinds, mut arguments, mut lets) =
        (TokenStream::new(), TokenStream::new(), TokenStream::new());
    let (mut names, mut fields) = (Vec::new(), String::new());
    for size in context.run_time_sizes() {
        let name = &definition.checked.sizes[size].name;
        let (local, given) = (lex(&format!("_n{size}")), argument(name));
        arguments.extend(quote! { #given: __h::core::primitive::usize, });
        lets.extend(quote! { let #local = #given; });
        names.push(name);
        let _ = write!(fields, "{name}: {}, ", set_by_new(&format!("_n{size}")));
    }
    for (at, (ty, _)) in generics.functions.iter().enumerate() {
        let name = &definition.checked.functions[at].name;
        let (local, given, ty) = (lex(&format!("_g{at}")), argument(name), lex(ty));
        arguments.extend(quote! { #given: #ty, });
        lets.extend(quote! { let #local = #given; });
        names.push(name);
        let _ = write!(fields, "{name}: _g{at}, ");
    }
    for (number, parameter) in definition.checked.parameters.iter().enumerate() {
        let name = &parameter.name;
        let shape = &context.model.parameters[number].shape;
        if definition.defaults[number].is_some() {
            let value = default_of(context, number, scalar);
            let _ = write!(fields, "{name}: {value}, ");
            continue;
        }
        names.push(name);
        let value = format!("_a{number}");
        let (local, given) = (lex(&value), argument(name));
        let ty = lex(&context.field(shape, scalar));
        if *shape == Shape::Scalar || context.typed_axes(shape).is_some() {
            arguments.extend(quote! { #given: #ty, });
            lets.extend(quote! { let #local = #given; });
        } else {
            let (kind, from) = (lex(&format!("K{number}")), lex(&format!("V{number}")));
            // A `new` without a `Result` takes lengths that the compiler checks.
            let (bound, made) = match context.has_run_time_sizes() {
                true => {
                    let text = name.to_string();
                    (
                        quote! { #kind, #from: __h::ListOf<#kind, #ty>, },
                        quote! { __h::ListOf::fit(#given, #text)? },
                    )
                }
                false => (
                    quote! { #kind, #from: __h::ArrayOf<#kind, #ty>, },
                    quote! { __h::ArrayOf::into_array(#given) },
                ),
            };
            // Errors of an argument show its declaration.
            kinds.extend(located(bound, name.span(), 0));
            arguments.extend(quote! { #given: #from, });
            lets.extend(quote! { let #local = #made; });
        }
        let field = match context.is_dynamic(shape) {
            true => set_by_new(&value),
            false => value,
        };
        let _ = write!(fields, "{name}: {field}, ");
    }
    if names.is_empty() {
        return TokenStream::new();
    }
    let mut allow = allowances(&names);
    if names.len() > 7 {
        // The number of parameters of a system is not a matter of style.
        allow.extend(quote! { #[allow(clippy::too_many_arguments)] });
    }
    let visibility = &item.visibility;
    let system = lex(&format!("Self {{ {fields} }}"));
    let kinds = (!kinds.is_empty()).then(|| quote! { < #kinds > });
    // Errors of a call show the type's declaration.
    let new = format_ident!("new", span = definition.type_name(item).span());
    let sets = defaults_set(context, item, &names).map(|text| quote! { #[doc = #text] });
    let method = if context.has_run_time_sizes() {
        let groups = context.groups.iter().filter_map(|g| context.room(g));
        let [products, bounds] = reach::constructed(context);
        let room = products + &groups.collect::<String>();
        let more = (!bounds.is_empty()).then(|| {
            quote! { #[doc = " `InputError::Index` or `InputError::Range` if an index of H leaves its array for these sizes."] }
        });
        let memory = (!room.is_empty()).then(|| {
            quote! { #[doc = " `InputError::Memory` if arrays of these sizes do not fit into memory."] }
        });
        quote! {
            /// The system of these sizes and parameters: the sizes first, then functions, then the parameters
            /// without a default, in the order of their declaration.
            #sets
            ///
            /// # Errors
            /// `InputError::Shape` if an array does not have the number of components that its sizes say,
            /// `InputError::Parameter` if a number given is NaN.
            #more
            #memory
            #allow
            #visibility fn #new #kinds (#arguments) -> __h::core::result::Result<Self, __h::Error> {
                #lets
                #system.__checked()
            }
        }
    } else {
        quote! {
            /// The system with these parameters: functions first, then those without a default, in the order of
            /// their declaration.
            #sets
            #allow
            #[must_use]
            #visibility fn #new #kinds (#arguments) -> Self {
                #lets
                #system
            }
        }
    };
    let header = if is_told {
        generics.header_of_values()
    } else {
        let (constants, system) = generics.over_f64();
        format!("impl{constants} {system}")
    };
    let header = lex(&header);
    quote! { #header { #method } }
}

/// The checks of a system whose sizes are set at run time. Sizes that do not fit explain arrays that do not, and indices
/// are in range up to sizes that do.
pub fn checked(context: Context) -> TokenStream {
    if !context.has_run_time_sizes() {
        return TokenStream::new();
    }
    let sizes = context.run_time_sizes().map(|size| {
        let name = &context.definition.checked.sizes[size].name;
        format!("let _n{size} = *self.{name};\n")
    });
    let groups = context.groups.iter().filter_map(|g| context.room(g));
    let [products, bounds] = reach::constructed(context);
    let room = products + &groups.collect::<String>();
    let (mut extents, mut numbers) = (String::new(), String::new());
    for (number, parameter) in context.definition.checked.parameters.iter().enumerate() {
        if context.definition.defaults[number].is_some() {
            continue;
        }
        let (name, value) = (&parameter.name, format!("self.{}", parameter.name));
        let shape = &context.model.parameters[number].shape;
        if let Shape::Lattice(_, axes) = shape {
            let (axes, given) = (context.axes(axes), context.stored(shape, &value));
            let _ = writeln!(
                extents,
                "__h::check_lattice(\"{name}\", {axes}, &{given})?;"
            );
            continue;
        }
        let (rows, given) = match shape {
            Shape::Matrix(..) => (format!("let _b = {value}.transpose();\n"), "_b"),
            _ => (String::new(), value.as_str()),
        };
        let whole = as_slice(shape, given);
        let _ = writeln!(numbers, "{rows}__h::check_parameter(\"{name}\", {whole})?;");
        if context.is_dynamic(shape) {
            let (rows, columns) = context.extents(shape);
            let _ = writeln!(
                extents,
                "__h::check_extents({:?}, [{rows}, {columns}], [{value}.nrows(), {value}.ncols()])?;",
                reach::declared(&name.to_string(), parameter.ty, context),
            );
        }
    }
    let sizes: String = sizes.collect();
    lex(&format!(
        "fn __checked(self) -> __h::Result<Self, __h::Error> {{ \
         {sizes}{room}{bounds}{extents}{numbers} __h::Result::Ok(self) }}"
    ))
}

/// `with_NAME` for each array, but where the definition has something else of that name.
pub fn with_arrays(context: Context, item: &Header) -> TokenStream {
    let (definition, visibility) = (context.definition, &item.visibility);
    let mut out = TokenStream::new();
    // Pieces come from the whole system.
    if definition.piece.is_some() {
        return out;
    }
    let scalar = context.generics.scalars.first().map_or("", String::as_str);
    let has_others = definition.checked.fields.len() > 1;
    let others = has_others.then(|| quote! { , ..self });
    for (number, parameter) in definition.checked.parameters.iter().enumerate() {
        let (name, shape) = (&parameter.name, &context.model.parameters[number].shape);
        let method = format_ident!("with_{}", name, span = name.span());
        if *shape == Shape::Scalar || is_taken(context, &method) {
            continue;
        }
        let (text, ty) = (name.to_string(), lex(&context.field(shape, scalar)));
        let argument = argument(name);
        let allow = allowances(&[name]);
        out.extend(match context.is_dynamic(shape) {
            true => {
                let doc = format!(" The same system with another `{name}` of the same extents, from an array, a slice or a `Vec`.");
                let value = lex(&set_by_new("_a"));
                quote! {
                    #[doc = #doc]
                    ///
                    /// # Errors
                    /// Those of `new`.
                    #allow
                    #visibility fn #method<K, V: __h::ListOf<K, #ty>>(self, #argument: V) -> __h::Result<Self, __h::Error> {
                        let _a = __h::ListOf::fit(#argument, #text)?;
                        Self { #name: #value #others }.__checked()
                    }
                }
            }
            false => {
                let doc = format!(
                    " The same system with another `{name}`: `Self` for an array, a `Result` for a slice or a `Vec`, whose length is checked at run time."
                );
                quote! {
                    #[doc = #doc]
                    #allow
                    #[must_use]
                    #visibility fn #method<K, V: __h::ListOf<K, #ty>>(self, #argument: V) -> V::Outcome<Self> {
                        __h::ListOf::set(#argument, #text, |_a| Self { #name: _a #others })
                    }
                }
            }
        });
    }
    out
}

/// Returns true if a definition has a method of that name already: an observable, the getter of a field, or
/// `with_defaults`.
fn is_taken(context: Context, method: &Ident) -> bool {
    let checked = context.definition.checked;
    let sizes = checked.sizes.iter().map(|size| &size.name);
    let parameters = checked.parameters.iter().map(|parameter| &parameter.name);
    let mut observables = context.model.observables.iter();
    method == "with_defaults"
        || sizes.chain(parameters).any(|name| name == method)
        || observables.any(|observable| method == observable.name.as_str())
}

/// The name of the argument for a field. A constant of the user's may have the name of a parameter in capitals, and an
/// argument may not have a constant's.
fn argument(name: &Ident) -> TokenStream {
    match name.to_string() {
        text if text.starts_with(char::is_uppercase) => lex(&format!("_{text}")),
        _ => quote! { #name },
    }
}

/// The way to set the parameters with a default, which are no arguments of `new`.
fn defaults_set(context: Context, item: &Header, arguments: &[&Ident]) -> Option<String> {
    let parameters = context.definition.checked.parameters.iter();
    let has_default = |p: &&Parameter| p.default.is_some();
    let names: Vec<String> = parameters
        .filter(has_default)
        .map(|p| p.name.to_string())
        .into_list();
    let (first, name) = (names.first()?, context.definition.type_name(item));
    let arguments: Vec<String> = arguments.iter().map(ToString::to_string).into_list();
    let question = if context.has_run_time_sizes() {
        "?"
    } else {
        ""
    };
    let new = format!("{name}::new({}){question}", arguments.join(", "));
    Some(format!(
        " The defaults of `{}` are no arguments: `{name} {{ {first}: …, ..{new} }}` sets another value.",
        names.join("`, `")
    ))
}

/// The fields that only `new` sets.
pub fn getters(context: Context, item: &Header) -> TokenStream {
    let (visibility, checked) = (&item.visibility, context.definition.checked);
    let mut out = TokenStream::new();
    for field in &checked.fields {
        let (name, attributes, text, result, value) = match *field {
            Field::Size(size) => {
                let size = &checked.sizes[usize::from(size.0)];
                (
                    &size.name,
                    &size.attributes,
                    format!(" The size `{}`.", size.name),
                    quote! { __h::core::primitive::usize },
                    quote! { * },
                )
            }
            // Public fields have no getter.
            Field::Function(_) => continue,
            Field::Parameter(number) => {
                let shape = &context.model.parameters[number.0 as usize].shape;
                if !context.is_dynamic(shape) {
                    continue;
                }
                let parameter = &checked.parameters[number.0 as usize];
                let scalar = context.generics.scalars.first();
                let ty = lex(&context.storage(shape, scalar.map_or("P", String::as_str)));
                (
                    &parameter.name,
                    &parameter.attributes,
                    format!(" Parameter `{}`.", parameter.name),
                    quote! { &#ty },
                    quote! { & },
                )
            }
        };
        let (docs, allow) = (documented(attributes, &text), allowances(&[name]));
        out.extend(quote! {
            #docs #allow #[must_use]
            #visibility fn #name(&self) -> #result { #value self.#name }
        });
    }
    out
}

/// The extents of a parameter and its numbers, of `name`: a number, an array, or the transpose of a matrix.
pub fn as_slice(shape: &Shape, name: &str) -> String {
    match shape {
        Shape::Scalar => format!("&[], &[{name}]"),
        Shape::Vector(_) => format!("&[{name}.nrows()], {name}.as_slice()"),
        Shape::Matrix(..) => format!("&[{name}.ncols(), {name}.nrows()], {name}.as_slice()"),
        Shape::Lattice(..) => format!("&{name}.extents(), {name}.as_slice()"),
    }
}
