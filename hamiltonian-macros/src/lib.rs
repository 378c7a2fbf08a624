//! The `hamiltonian!` macro: tokens in, tokens out.
//!
//! Users reach it through the facade's wrapper, which forwards `$crate` so that emitted code finds
//! the library under whatever name it was imported.
//!
//! tokens → a checked definition (`hamiltonian_language`) → its mathematics, proven and split (`backend`)
//! → code (`emit`); `expand` drives, `fallback` stands in for a wrong definition.

mod backend;
mod emit;
mod expand;
mod fallback;
#[cfg(test)]
mod tests;
mod unused;

/// Expands a definition; its first token is the path of the library in parentheses.
#[doc(hidden)]
#[proc_macro]
pub fn hamiltonian_impl(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand::expand(input.into()).into()
}
