//! The driver: stages with barriers between them.
//!
//! Input: `(root) tokens…`, where root is the path of the library as the wrapper macro writes it.
//! Output: code, or all errors of the first stage that has any, with a stub.

use crate::{backend, fallback, unused};
use hamiltonian_language::ast::Ast;
use hamiltonian_language::read;
use hamiltonian_language::report::Report;
use hamiltonian_language::tokens::is_attribute;
use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};
use quote::quote;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Expands one call of the macro.
pub fn expand(input: TokenStream) -> TokenStream {
    let (root, definition) = forwarded(input);
    if let Some((conditions, definition)) = conditional(&definition) {
        return quote!(#(#conditions)* #root::hamiltonian! { #definition });
    }
    let mut ast = Ast::default();
    let mut report = Report::default();
    let stages = || {
        let checked;
        (ast, checked) = read(definition.clone(), &mut report);
        backend::generate(&checked?, &root, &mut report)
    };
    let code = caught(stages).unwrap_or_else(|fault| {
        report.internal(Span::call_site(), &fault);
        None
    });
    if code.is_none() && report.is_empty() {
        report.internal(
            Span::call_site(),
            "it ends without code and without an error",
        );
    }
    match code.and_then(|code| report.barrier(code)) {
        Some(mut code) if ast.item.is_some() => {
            code.extend(unused::warnings(&ast, definition));
            code
        }
        // In the place of an item rustc refuses the block and names the macro it comes from. A macro cannot find
        // out whether it is in the place of an item or of an expression.
        Some(value) => quote!(#root::__an_item_needs_pub_struct_Name_first! { #value }),
        None => fallback::stub(&ast, &report),
    }
}

/// The result of stages that do not panic, or the words of the panic. Their half-made work
/// is read no more, but for the tree and the report, which are whole after each statement.
fn caught<T>(stages: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(stages)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        text.unwrap_or_else(|| "a panic without words".to_owned())
    })
}

/// `#[cfg(…)]` before a type stands before everything that is made of it: such a definition becomes
/// a call without the condition, under the condition.
fn conditional(definition: &TokenStream) -> Option<(Vec<TokenStream>, TokenStream)> {
    let mut conditions = Vec::new();
    let mut rest = Vec::new();
    let mut trees = definition.clone().into_iter().peekable();
    while let Some(TokenTree::Punct(hash)) = trees.peek()
        && hash.as_char() == '#'
    {
        let attribute: TokenStream = trees.by_ref().take(2).collect();
        if is_attribute(&attribute, "cfg") {
            conditions.push(attribute);
        } else {
            rest.push(attribute);
        }
    }
    let is_item = match trees.peek() {
        Some(TokenTree::Ident(word)) => word == "struct" || word == "pub",
        Some(TokenTree::Group(fragment)) => fragment.delimiter() == Delimiter::None,
        _ => false,
    };
    rest.push(trees.collect());
    (is_item && !conditions.is_empty()).then(|| (conditions, rest.into_iter().collect()))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error_that_asks_for_a_report() {
        let list: Vec<u8> = Vec::new();
        let fault = caught(|| list[1]).unwrap_err();
        assert_eq!(
            fault,
            "index out of bounds: the len is 0 but the index is 1"
        );
        let mut report = Report::default();
        report.internal(Span::call_site(), &fault);
        assert!(report.barrier(()).is_none());
        assert_eq!(
            report.errors()[0].text(),
            "internal error of `hamiltonian!`: index out of bounds: the len is 0 but the index is 1\nhelp: the definition is not to blame: please report it together with this message"
        );
    }
}
