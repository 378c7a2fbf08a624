//! Warnings about names that nothing reads.
//!
//! Input: a definition in item form and its tokens. Output: a function that nothing calls, with an
//! argument for each parameter, size and `let` whose name occurs once, at its span. Invariant: a
//! macro cannot warn, and rustc's own lint `unused_variables` does it at that argument; `allow`
//! before the type or the parameter, and an underscore before the name, silence it as in Rust.

use hamiltonian_language::ast::{Ast, StatementKind};
use hamiltonian_language::tokens::{TokenKind, Tokens, is_attribute};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::HashMap;

/// The function, or nothing where every name is read.
pub fn warnings(ast: &Ast, definition: TokenStream) -> TokenStream {
    let Some(item) = &ast.item else {
        return TokenStream::new();
    };
    let mut occurrences: HashMap<String, usize> = HashMap::new();
    for token in Tokens::flatten(definition).list {
        if token.kind == TokenKind::Ident {
            *occurrences.entry(token.text).or_default() += 1;
        }
    }
    let occurs_once = |name: &Ident| occurrences.get(&name.to_string()) == Some(&1);
    let parameters = item.parameters.iter().map(|p| (&p.name, &p.attributes[..]));
    let sizes = item.generics.iter().map(|name| (name, &[][..]));
    let lets = ast.statements.iter().filter_map(|s| match &s.kind {
        StatementKind::Let { name, .. } => Some((name, &[][..])),
        _ => None,
    });
    let unread = parameters.chain(sizes).chain(lets);
    let arguments = unread
        .filter(|(name, _)| occurs_once(name))
        .map(|(name, attributes)| {
            let allowed = allowances(attributes);
            quote! { #(#allowed)* #name: (), }
        });
    let arguments: TokenStream = arguments.collect();
    if arguments.is_empty() {
        return arguments;
    }
    let allowed = allowances(&item.header.attributes);
    quote! {
        const _: () = {
            // No constant is in scope here, so an argument may have the name of one.
            mod unread {
                #(#allowed)*
                #[allow(non_snake_case, clippy::too_many_arguments)]
                fn _unread(#arguments) {}
            }
        };
    }
}

/// The attributes that are `#[allow(…)]`.
fn allowances(attributes: &[TokenStream]) -> impl Iterator<Item = &TokenStream> {
    let attributes = attributes.iter();
    attributes.filter(|attribute| is_attribute(attribute, "allow"))
}
