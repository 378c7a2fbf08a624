//! Expression form: a block whose value is the system.
//!
//! Input: a definition and the names it captures. Output: `{ struct …; impl …; Value { … } }`.
//! Invariant: the captured names are the only tokens of the user's in it, and they stand in the
//! one expression at its end.

use super::vectors;
use crate::emit::functions::externals;
use crate::emit::names::context::Context;
use crate::emit::tokens::lex;
use crate::emit::traits::{dynamics, markers, observables};
use crate::emit::types::{declared, mixed, reach};
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::TokenStream;
use quote::quote;

/// The tokens of a value.
pub fn generate(context: Context) -> TokenStream {
    let (definition, generics) = (context.definition, context.generics);
    let (root, captures) = (definition.root, &definition.checked.captures);
    let name = lex(&generics.name);
    let fields: Vec<TokenStream> = (0..captures.len())
        .map(|at| lex(&format!("c{at}")))
        .into_list();
    let scalars = generics.scalars.iter().map(|scalar| lex(scalar));
    let scalars: Vec<TokenStream> = scalars.into_list();
    let parameters = (!scalars.is_empty()).then(|| quote! { <#(#scalars),*> });
    let mut text = String::new();
    for context in declared::mixed(context) {
        text.push_str(&mixed::derives(context));
        text.push_str(&mixed::declaration(context));
        text.push_str(&mixed::implementations(context));
    }
    let [implementations, functions, _] = dynamics::implementations(context);
    text.push_str(&implementations);
    text.push_str(&functions);
    text.push_str(&markers::implementations(context));
    let implementations = lex(&text);
    let externals = externals::wrappers(context);
    let inherent = inherent(context);
    let checks = reach::compiled(context);
    quote! {
        {
            #[derive(#root::private::Clone, #root::private::fmt::Debug)]
            struct #name #parameters { #(#fields: #scalars,)* }
            #[allow(clippy::approx_constant)]
            const _: () = {
                use #root::private as __h;
                #externals
                #implementations
                #checks
                #inherent
            };
            #name { #(#fields: #root::private::captured(#captures)),* }
        }
    }
}

/// Observables as methods, and the way to coordinates of mixed shape, whose type has no name
/// outside.
fn inherent(context: Context) -> TokenStream {
    let visibility = quote! { pub };
    let mut methods = observables::methods(context, &visibility);
    methods.extend(vectors::methods(context, &visibility));
    for mixed in declared::mixed(context) {
        let method = match mixed.suffix == context.suffix {
            true => "vector",
            false => "declared_vector",
        };
        methods.extend(lex(&mixed::constructors(mixed, method)));
    }
    if methods.is_empty() {
        return methods;
    }
    let header = lex(&context.generics.header());
    quote! { #header { #methods } }
}
