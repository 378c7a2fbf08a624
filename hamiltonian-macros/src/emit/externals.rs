//! Functions written in Rust, as emitted bodies call them.
//!
//! Input: the user's paths. Output: one wrapper a path. Invariant: a path stands in one place only,
//! a function generic over the scalar, so that messages of rustc point at the path.

use super::block;
use super::context::Context;
use super::{lex, located};
use hamiltonian_symbolic::dag::Part;
use proc_macro2::{Delimiter, Group, Span, TokenStream};
use quote::quote;

/// The wrappers of all functions.
pub fn wrappers(context: Context) -> TokenStream {
    let mut out = TokenStream::new();
    let functions = context.definition.checked.functions.iter().enumerate();
    for (number, function) in functions {
        let (number, arity) = (number as u16, function.arguments.len() as u16);
        let mut wrap = |part: Part, path: &TokenStream| {
            let name = lex(&block::external(number, part));
            let arguments: Vec<TokenStream> =
                (0..arity).map(|at| lex(&format!("_x{at}"))).collect();
            let at = path.clone().into_iter().last();
            let at = at.map_or_else(Span::call_site, |token| token.span());
            let scalar = located(quote!(AnyReal), at, 0);
            let call = located(quote!(#(#arguments),*), at, 0);
            let mut call = Group::new(Delimiter::Parenthesis, call);
            call.set_span(at);
            out.extend(quote! {
                #[inline(always)]
                #[allow(dead_code)]
                fn #name<#scalar: __h::Real>(#(#arguments: #scalar),*) -> #scalar { #path #call }
            });
        };
        wrap(Part::Value, &function.value);
        for (i, path) in function.first.paths.iter().enumerate() {
            wrap(Part::First(i as u16), path);
        }
        let pairs = (0..arity).flat_map(|i| (i..arity).map(move |j| (i, j)));
        for ((i, j), path) in pairs.zip(function.second.iter().flat_map(|second| &second.paths)) {
            wrap(Part::Second(i, j), path);
        }
    }
    out
}
