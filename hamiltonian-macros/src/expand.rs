//! The driver: stages with barriers between them.
//!
//! Input: `(root) tokens…`, where root is the path of the library as the wrapper macro knows it.
//! Output: code, or all errors of the first stage that has any, with a stub.

use crate::ast::Ast;
use crate::checked::Checked;
use crate::report::Report;
use crate::tokens::Tokens;
use crate::{backend, check, fallback, parse};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::quote;

/// Expands one call of the macro.
pub fn expand(input: TokenStream) -> TokenStream {
    let (root, definition) = forwarded(input);
    let mut report = Report::default();
    let (ast, checked) = front(definition, &mut report);
    let code = checked.map(|checked| backend::generate(&checked, &root, &mut report));
    match code.and_then(|code| report.barrier(code)) {
        Some(code) => code,
        None => fallback::stub(&ast, &report),
    }
}

/// Tokens → tree → checked tree. The tree is there, as far as it was read, whatever was wrong.
pub fn front(definition: TokenStream, report: &mut Report) -> (Ast, Option<Checked>) {
    let tokens = Tokens::flatten(definition);
    let ast = parse::parse(&tokens, report);
    if report.barrier(()).is_none() {
        return (ast, None);
    }
    let checked = check::check(&ast, report);
    let checked = report.barrier(checked);
    (ast, checked)
}

/// Separates the path of the library, `($crate)`, from the definition.
fn forwarded(input: TokenStream) -> (TokenStream, TokenStream) {
    let mut trees = input.into_iter();
    match trees.next() {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis => {
            (group.stream(), trees.collect())
        }
        first => (
            quote!(::hamiltonian),
            first.into_iter().chain(trees).collect(),
        ),
    }
}
