//! Functions written in Rust, as emitted bodies call them.
//!
//! Input: the user's paths, and the functions that are parameters. Output: one wrapper for each value and
//! derivative. Invariant: a path stands in one place only, a function generic over the scalar, so that
//! messages of rustc point at the path. A derivative without a path is that of the wrapper of one order
//! less over dual numbers.

use crate::emit::names::context::Context;
use crate::emit::statements::block;
use crate::emit::tokens::{lex, located};
use hamiltonian_language::ast::Function;
use hamiltonian_symbolic::dag::Partial;
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::{Delimiter, Group, Span, TokenStream};
use quote::quote;

/// The wrappers of all functions.
pub fn wrappers(context: Context) -> TokenStream {
    let mut out = TokenStream::new();
    let functions = context.definition.checked.functions.iter();
    for (function, number) in functions.zip(0..) {
        let arity = function.arguments.len();
        match &function.value {
            Some(path) => called(&mut out, (number, Partial::Value), arity, path),
            None => valued(&mut out, number, arity),
        }
        let first = function.first.as_ref().map(|first| &first.paths);
        let second = function.second.as_ref().map(|second| &second.paths);
        let count = arity as u16;
        let pairs = (0..count).flat_map(|i| (i..count).map(move |j| (i, j)));
        for i in 0..count {
            match first {
                Some(paths) => {
                    called(
                        &mut out,
                        (number, Partial::First(i)),
                        arity,
                        &paths[usize::from(i)],
                    );
                }
                None => differentiated(&mut out, function, number, (Partial::Value, i)),
            }
        }
        for ((i, j), at) in pairs.zip(0..) {
            match second {
                Some(paths) => called(&mut out, (number, Partial::Second(i, j)), arity, &paths[at]),
                None => differentiated(&mut out, function, number, (Partial::First(i), j)),
            }
        }
    }
    out
}

/// A call of a path.
fn called(out: &mut TokenStream, (number, part): (u16, Partial), arity: usize, path: &TokenStream) {
    let name = lex(&block::external(number, part));
    let arguments: Vec<TokenStream> = (0..arity).map(|at| lex(&format!("_x{at}"))).into_list();
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
}

/// The value of a function that is a parameter.
fn valued(out: &mut TokenStream, number: u16, arity: usize) {
    let name = block::external(number, Partial::Value);
    let (arguments, declared) = arguments(arity, "AnyReal");
    out.extend(lex(&format!(
        "#[inline(always)]\n#[allow(dead_code)]\n\
         fn {name}<AnyReal: __h::Real, F: __h::Function<{arity}>>(_f: &F, {declared}) -> AnyReal {{ \
         <F as __h::Function<{arity}>>::value(_f, [{}]) }}",
        arguments.join(", ")
    )));
}

/// The derivative of a part by argument i, over dual numbers.
fn differentiated(
    out: &mut TokenStream,
    function: &Function,
    number: u16,
    (part, i): (Partial, u16),
) {
    let arity = function.arguments.len();
    let [name, of] = [part.by(i), part].map(|part| block::external(number, part));
    let (arguments, declared) = arguments(arity, "AnyReal");
    let duals: Vec<String> = (arguments.iter().zip(0..))
        .map(|(argument, at)| match at == i {
            true => format!("__h::Dual::variable({argument})"),
            false => format!("__h::Dual::fixed({argument})"),
        })
        .into_list();
    let (generic, given, passed) = match function.value {
        Some(_) => (String::new(), "", ""),
        None => (format!(", F: __h::Function<{arity}>"), "_f: &F, ", "_f, "),
    };
    out.extend(lex(&format!(
        "#[inline(always)]\n#[allow(dead_code)]\n\
         fn {name}<AnyReal: __h::Real{generic}>({given}{declared}) -> AnyReal {{ {of}({passed}{}).eps }}",
        duals.join(", ")
    )));
}

/// The names of arguments, and their declarations over a scalar.
fn arguments(arity: usize, scalar: &str) -> (Vec<String>, String) {
    let names: Vec<String> = (0..arity).map(|at| format!("_x{at}")).into_list();
    let declared: Vec<String> = names
        .iter()
        .map(|name| format!("{name}: {scalar}"))
        .into_list();
    (names, declared.join(", "))
}
