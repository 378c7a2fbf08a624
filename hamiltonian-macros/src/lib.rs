//! The `hamiltonian!` macro: tokens in, tokens out.
//!
//! Users reach it through the facade's wrapper, which forwards `$crate` so that emitted code finds
//! the library under whatever name it was imported.
//!
//! tokens → `ast` (`parse`) → `checked` (`check`) → code (`backend`); `expand` drives, `report`
//! collects the errors, `fallback` stands in for a wrong definition.

#[allow(dead_code)]
mod ast;
mod backend;
mod check;
#[allow(dead_code)]
mod checked;
mod emit;
mod expand;
mod fallback;
mod lower;
#[allow(dead_code)]
mod names;
mod parse;
mod report;
#[cfg(test)]
mod tests;
mod tokens;
mod unused;

/// Expands a definition; its first token is the path of the library in parentheses.
#[doc(hidden)]
#[proc_macro]
pub fn hamiltonian_impl(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand::expand(input.into()).into()
}
