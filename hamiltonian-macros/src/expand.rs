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
    if let Some((conditions, definition)) = conditional(&definition) {
        return quote!(#(#conditions)* #root::hamiltonian! { #definition });
    }
    let mut report = Report::default();
    let (ast, checked) = front(definition, &mut report);
    let code = checked.map(|checked| backend::generate(&checked, &root, &mut report));
    match code.and_then(|code| report.barrier(code)) {
        Some(code) if ast.item.is_some() => code,
        // In the place of an item rustc refuses the block and names the macro it comes from, which is
        // all that can be said there: a macro does not know where it stands.
        Some(value) => quote!(#root::__an_item_needs_pub_struct_Name_first! { #value }),
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
        if is_condition(&attribute) {
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

/// `#[cfg(…)]`, whose inside may come from another macro.
fn is_condition(attribute: &TokenStream) -> bool {
    let mut inside = attribute.clone().into_iter().nth(1);
    while let Some(TokenTree::Group(group)) = inside {
        inside = group.stream().into_iter().next();
    }
    matches!(inside, Some(TokenTree::Ident(word)) if word == "cfg")
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
