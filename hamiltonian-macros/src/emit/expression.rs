//! Expression form: a block whose value is the system.
//!
//! Input: a definition and the names it captures. Output: `{ struct …; impl …; Value { … } }`.
//! Invariant: the captured names are the only tokens of the user's in it, and they stand in the
//! one expression at its end.

use super::block::Context;
use super::generics::Generics;
use super::{
    Definition, declared, dynamics, externals, item, layout, lex, markers, mixed, observables,
    reach, vectors,
};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// The tokens of a value.
pub fn generate(definition: &Definition, captures: &[Ident]) -> TokenStream {
    let generics = Generics::of(definition);
    let parts = item::Parts::of(definition, &generics);
    let context = parts.context(definition);
    let root = &definition.root;
    let name = &generics.name;
    let fields: String = generics
        .scalars
        .iter()
        .enumerate()
        .map(|(at, scalar)| format!("c{at}: {scalar}, "))
        .collect();
    let scalars = if captures.is_empty() {
        String::new()
    } else {
        format!("<{}>", generics.scalars.join(", "))
    };
    let declaration = lex(&format!("struct {name}{scalars} {{ {fields} }}"));
    let mut text = String::new();
    let own = (context.layout == layout::Layout::Mixed).then_some(context);
    for context in own.into_iter().chain(declared::mixed(definition, context)) {
        text.push_str(&mixed::derives(context, "__h"));
        text.push_str(&mixed::declaration(context, &generics, "__h"));
        text.push_str(&mixed::implementations(context, &generics));
    }
    let (implementations, functions) = dynamics::implementations(definition, context, &generics);
    text.push_str(&implementations);
    text.push_str(&functions);
    text.push_str(&markers::implementations(&definition.structure, &generics));
    text.push_str(&item::display(definition, &generics));
    let implementations = lex(&text);
    let externals = externals::wrappers(definition);
    let inherent = inherent(definition, context, &generics);
    let questions = reach::compiled(definition.reaches, context, &generics);
    let value = lex(name);
    let names = (0..captures.len()).map(|at| lex(&format!("c{at}")));
    quote! {
        {
            #[derive(#root::private::core::clone::Clone, #root::private::core::fmt::Debug)]
            #declaration
            #[allow(clippy::approx_constant)]
            const _: () = {
                use #root::private as __h;
                #externals
                #implementations
                #questions
                #inherent
            };
            #value { #(#names: #captures),* }
        }
    }
}

/// Observables as methods, and the way to coordinates of mixed shape, whose type has no name
/// outside.
fn inherent(definition: &Definition, context: Context, generics: &Generics) -> TokenStream {
    let visibility = quote! { pub };
    let mut methods = observables::methods(definition, context, generics, &visibility);
    methods.extend(vectors::methods(definition, context, generics, &visibility));
    let mixed = context.layout == layout::Layout::Mixed;
    if methods.is_empty() && !mixed {
        return TokenStream::new();
    }
    let header = lex(&format!(
        "impl{} {}",
        generics.declaration(),
        generics.system_type()
    ));
    let mut vectors = String::new();
    if mixed {
        vectors.push_str(&mixed::constructor(context, generics, "vector"));
    }
    if let Some(declared) = declared::mixed(definition, context) {
        vectors.push_str(&mixed::constructor(declared, generics, "declared_vector"));
    }
    let vectors = lex(&vectors);
    quote! { #header { #methods #vectors } }
}
