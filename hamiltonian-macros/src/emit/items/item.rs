//! Item form: the struct with its docs and methods.
//!
//! Input: a definition and its header. Output: its tokens. Invariant: fields are public where they
//! can be anything; sizes set at run time and the arrays that depend on them are private and of a
//! type that nothing else makes, so that lengths that `new` checked stay right.

use super::vectors;
use crate::emit::functions::externals;
use crate::emit::names::context::Context;
use crate::emit::names::index::Indices;
use crate::emit::tokens::{allowances, documented, is_doc, lex, located, piece_type};
use crate::emit::traits::{dynamics, markers, observables};
use crate::emit::types::{construct, declared, mixed, reach, record};
use hamiltonian_language::analyse::surface::piece_method;
use hamiltonian_language::ast::Header;
use hamiltonian_language::checked::{Field, SizeDeclaration};
use hamiltonian_language::names::listed;
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};
use std::fmt::Write;

/// The depth of the signatures of methods in implementations; in their bodies nothing is wrong.
const SIGNATURES: usize = 1;

/// The tokens of a type.
pub fn generate(context: Context, item: &Header) -> TokenStream {
    let root = context.definition.root;
    let name = context.definition.type_name(item);
    let declaration = declaration(context, item, &name);
    let [mut text, functions, gradient] = dynamics::implementations(context);
    text.push_str(&markers::implementations(context));
    for context in declared::mixed(context) {
        text.push_str(&mixed::implementations(context));
        if record::IS_ON {
            text.push_str(&record::vector(context));
        }
    }
    // Pieces come from the whole system.
    if record::IS_ON && context.definition.piece.is_none() {
        text.push_str(&record::system(context));
    }
    let implementations = located(lex(&text), name.span(), SIGNATURES);
    let functions = lex(&functions);
    let externals = externals::wrappers(context);
    let inherent = inherent(context, item, &gradient);
    let checks = reach::compiled(context);
    quote! {
        #declaration
        #[allow(clippy::approx_constant)]
        const _: () = {
            use #root::private as __h;
            #externals
            #implementations
            #functions
            #checks
            #inherent
        };
    }
}

/// The struct, and that of its coordinates where it has one.
fn declaration(context: Context, item: &Header, name: &Ident) -> TokenStream {
    let (definition, visibility) = (context.definition, &item.visibility);
    let (checked, root) = (definition.checked, definition.root);
    let is_const = |size: &&SizeDeclaration| !size.run_time;
    let constants = checked.sizes.iter().filter(is_const).map(|size| &size.name);
    let constants: Vec<&Ident> = constants.into_list();
    // The scalar of the parameters as readers see it: `P`, unless a const generic has the name.
    let mut scalar = context.generics.scalars.first().cloned();
    if let Some(scalar) = &mut scalar {
        while constants.iter().any(|size| *size == scalar) {
            scalar.push('_');
        }
    }
    let mut parameters = quote! { #(const #constants: __h::core::primitive::usize,)* };
    for bounded in context.generics.bounded_functions() {
        let bounded = with_root(lex(&bounded), root);
        parameters.extend(quote! { #bounded, });
    }
    if let Some(scalar) = &scalar {
        let scalar = lex(scalar);
        parameters.extend(quote! { #scalar = __h::core::primitive::f64 });
    }
    let parameters = (!parameters.is_empty()).then(|| quote! { < #parameters > });
    // Const generics have the user's names here.
    let sizes: Vec<String> = checked
        .sizes
        .iter()
        .map(|size| size.name.to_string())
        .into_list();
    let indices = Indices { sizes: &sizes };
    let renamed = Context { indices, ..context };
    let scalar = scalar.as_deref().unwrap_or_default();
    let fields = checked
        .fields
        .iter()
        .map(|field| struct_field(renamed, item, scalar, *field));
    let attributes = match definition.piece {
        Some(piece) => {
            let text = format!(" The piece `{piece}` of the split of [`{}`].", item.name);
            quote! { #[doc = #text] }
        }
        None => {
            let attributes = &item.attributes;
            quote! { #(#attributes)* }
        }
    };
    let docs = docs(context, item, name);
    let sizes = checked.sizes.iter().map(|size| &size.name);
    let functions = checked.functions.iter().map(|function| &function.name);
    let functions = functions.take(context.generics.functions.len());
    let names = sizes.chain(checked.parameters.iter().map(|p| &p.name));
    let names = names.chain(functions);
    let allow = allowances(&names.into_list());
    let mut vectors = TokenStream::new();
    for mixed in declared::mixed(context) {
        let doc = match mixed.suffix == context.suffix {
            true => format!(" Coordinates, or momenta, of [`{name}`]."),
            false => format!(
                " Coordinates, or momenta, in the variables that [`{name}`] was declared in."
            ),
        };
        let derives = with_root(lex(&mixed::derives(mixed)), root);
        // Another type of the name is an error here.
        let text = with_root(
            located(lex(&mixed::declaration(mixed)), name.span(), 0),
            root,
        );
        vectors.extend(quote! {
            #[doc = #doc]
            #derives
            #text
        });
    }
    let before = located(quote!(#visibility struct), name.span(), 0);
    let parameters = located(
        with_root(quote!(#parameters), root),
        name.span(),
        usize::MAX,
    );
    let fields = located(quote!({ #(#fields)* }), name.span(), 0);
    quote! {
        #attributes
        #docs
        #allow
        #[derive(#root::private::Clone, #root::private::fmt::Debug)]
        #before #name #parameters #fields
        #vectors
    }
}

fn struct_field(context: Context, item: &Header, scalar: &str, field: Field) -> TokenStream {
    let definition = context.definition;
    let root = definition.root;
    match field {
        Field::Size(size) => {
            let size = &definition.checked.sizes[usize::from(size.0)];
            let (name, attributes) = (&size.name, &size.attributes);
            quote! { #(#attributes)* #name: #root::private::SetByNew<#root::private::core::primitive::usize>, }
        }
        Field::Function(at) => {
            let at = at.0 as usize;
            let (function, visibility) = (&definition.checked.functions[at], &item.visibility);
            let (name, ty) = (&function.name, lex(&context.generics.functions[at].0));
            let text = format!(" The function `{name}({})`.", listed(&function.arguments));
            let docs = documented(&definition.checked.function_docs[at], &text);
            quote! { #docs #visibility #name: #ty, }
        }
        Field::Parameter(number) => {
            let parameter = &definition.checked.parameters[number.0 as usize];
            let (name, visibility) = (&parameter.name, &item.visibility);
            let shape = &context.model.parameters[number.0 as usize].shape;
            let ty = with_root(lex(&context.field(shape, scalar)), root);
            let docs = documented(&parameter.attributes, &format!(" Parameter `{name}` of H."));
            if context.is_dynamic(shape) {
                quote! { #docs #name: #root::private::SetByNew<#ty>, }
            } else {
                quote! { #docs #visibility #name: #ty, }
            }
        }
    }
}

/// `__h`, which is known inside of the implementations only, replaced by the private module of the
/// facade.
fn with_root(tokens: TokenStream, root: &TokenStream) -> TokenStream {
    let mut out = TokenStream::new();
    for token in tokens {
        match token {
            TokenTree::Ident(ident) if ident == "__h" => out.extend(quote! { #root::private }),
            TokenTree::Group(group) => {
                let inner = with_root(group.stream(), root);
                out.extend([TokenTree::Group(Group::new(group.delimiter(), inner))]);
            }
            token => out.extend([token]),
        }
    }
    out
}

/// Rows of a table, and lines of equations, that stand open in the docs.
const LONG_TABLE: usize = 12;

/// Characters of H as text that stand open in the docs.
const LONG_TEXT: usize = 600;

/// Markdown that rustdoc shows on demand.
fn collapsed(doc: &mut String, summary: &str, markdown: &str) {
    let _ = write!(
        doc,
        "\n<details><summary>{summary}</summary>\n\n{markdown}\n\n</details>\n"
    );
}

/// A formula in a block of its own, which is scrolled where it is wider than the page.
fn formula(doc: &mut String, math: &str) {
    let _ = write!(
        doc,
        "\n<div style=\"overflow:auto hidden;padding:.3em 0 .8em\">\n<math display=\"block\">\n{math}\n</math>\n</div>\n"
    );
}

/// H, its facts, Hamilton's equations and their operations, as docs.
fn docs(context: Context, item: &Header, name: &Ident) -> TokenStream {
    let text = &context.definition.text;
    let mut doc = String::new();
    if !item.attributes.iter().any(is_doc) && context.definition.piece.is_none() {
        let _ = writeln!(doc, "The Hamiltonian system `{name}`.\n");
    }
    doc.push_str("\n# Hamiltonian\n");
    if !text.math.is_empty() {
        formula(&mut doc, &text.math);
    }
    let written = format!("```text\n{}\n```", text.hamiltonian);
    if text.hamiltonian.chars().count() > LONG_TEXT {
        collapsed(&mut doc, "H as text", &written);
    } else {
        let _ = write!(doc, "\n{written}\n");
    }
    for fact in &text.facts {
        let _ = write!(doc, "\n{fact}\n");
    }
    if !text.equations.is_empty() {
        doc.push_str("\n# Equations of motion\n");
        let lines = format!("```text\n{}\n```", text.equations.join("\n"));
        if text.math_equations.is_empty() && text.equations.len() > LONG_TABLE {
            collapsed(&mut doc, "Each variable", &lines);
        } else if text.math_equations.is_empty() {
            let _ = write!(doc, "\n{lines}\n");
        } else {
            let rows = &text.math_equations;
            let mut math = String::new();
            formula(
                &mut math,
                &format!("<mtable displaystyle=\"true\">\n{rows}</mtable>"),
            );
            match text.equations.len() > LONG_TABLE {
                true => collapsed(&mut doc, "Each variable", &math),
                false => doc.push_str(&math),
            }
            collapsed(&mut doc, "As text", &lines);
        }
    }
    if !context.model.force.is_empty() {
        doc.push_str(
            "\nThe declared force is in these equations. Schemes integrate it, and the method `force` returns it.\n",
        );
    }
    if !text.latex.is_empty() {
        doc.push_str("\n# LaTeX\n");
        let mut lines = format!("```text\n{}\n", text.latex);
        for line in &text.latex_equations {
            let _ = writeln!(lines, "{line}");
        }
        lines.push_str("```");
        collapsed(&mut doc, "H and its equations", &lines);
    }
    if !text.operations.is_empty() {
        doc.push_str(
            "\n# Operations\n\nThe operations of one evaluation. Expressions of parameters alone are computed once a run and \
             are not counted. A fused multiply–add counts as two operations, the sine and cosine of one angle as one.\n",
        );
        let table = text.operations.join("\n");
        // A row for each loop: many of them hide what follows.
        if text.operations.len() > LONG_TABLE {
            collapsed(&mut doc, "Each loop", &table);
        } else {
            let _ = write!(doc, "\n{table}\n");
        }
    }
    if context.has_run_time_sizes() {
        doc.push_str("\n# Panics\n\nEvaluation panics on a state that does not have the shape of the system. A run checks its start.\n`check_shape` checks any state and returns an error.\n");
    }
    quote! { #[doc = #doc] }
}

/// Constants, the getters of private fields, observables, derivatives by parameters.
fn inherent(context: Context, item: &Header, gradient: &str) -> TokenStream {
    let generics = context.generics;
    let (header, of_values) = (lex(&generics.header()), lex(&generics.header_of_values()));
    let visibility = &item.visibility;
    let methods = observables::methods(context, visibility);
    let vectors = vectors::methods(context, visibility);
    let pieces = pieces(context, item);
    let new = construct::new(context, item);
    let defaults = construct::with_defaults(context, item);
    let getters = construct::getters(context, item);
    let (checked, arrays) = (
        construct::checked(context),
        construct::with_arrays(context, item),
    );
    let derivatives = (!generics.scalars.is_empty()).then(|| {
        let state = lex(&context.vector());
        let (result, body) = (lex(&generics.system_type_over("T")), lex(gradient));
        quote! {
            /// ∂H/∂(each parameter) at a state, in the fields of the same type.
            #[must_use]
            #visibility fn parameter_gradient<T: __h::Real>(&self, state: &__h::State<#state>) -> #result {
                #body
            }
        }
    });
    let of_values = block(
        of_values,
        quote! { #defaults #checked #arrays #getters #pieces },
    );
    let of_any = block(header, quote! { #methods #vectors #derivatives });
    quote! { #new #of_values #of_any }
}

/// The methods under a header, if there are any.
fn block(header: TokenStream, methods: TokenStream) -> Option<TokenStream> {
    (!methods.is_empty()).then(|| quote! { #header { #methods } })
}

/// The pieces of a split as systems with the same parameters.
fn pieces(context: Context, item: &Header) -> TokenStream {
    let (definition, visibility) = (context.definition, &item.visibility);
    let checked = definition.checked;
    let field = |field: &Field| match *field {
        Field::Size(size) => &checked.sizes[usize::from(size.0)].name,
        Field::Parameter(number) => &checked.parameters[number.0 as usize].name,
        Field::Function(at) => &checked.functions[at.0 as usize].name,
    };
    let fields: Vec<&Ident> = checked.fields.iter().map(field).into_list();
    let arguments = context.generics.arguments();
    let mut out = TokenStream::new();
    for (name, _) in definition.pieces {
        let ty = piece_type(item, name);
        let method = format_ident!("{}", piece_method(&name.to_string()), span = name.span());
        let result = lex(&format!("{ty}{arguments}"));
        let text = format!(" The piece `{name}` of the split as a system of its own.");
        out.extend(quote! {
            #[doc = #text]
            #[must_use]
            #visibility fn #method(&self) -> #result {
                #ty { #(#fields: __h::core::clone::Clone::clone(&self.#fields),)* }
            }
        });
    }
    out
}
