//! Text and the user's tokens as tokens of the output.
//!
//! Input: emitted text, names and attributes of the user. Output: their tokens, with the spans that rustc shows.

use hamiltonian_language::ast::Header;
use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};
use quote::{format_ident, quote};

/// Text as tokens. All text that is emitted is made here, so it lexes.
pub fn lex(text: &str) -> TokenStream {
    // rustc's own lexer, called directly: through proc-macro2 the text is lexed twice.
    let tokens = if proc_macro::is_available() {
        let tokens = text.parse::<proc_macro::TokenStream>();
        tokens.map(TokenStream::from).ok()
    } else {
        text.parse().ok()
    };
    tokens.expect("the emitted code lexes")
}

/// Attributes that allow the lints which the user's own names may raise.
pub fn allowances(names: &[&Ident]) -> TokenStream {
    let snake = |name: &&Ident| name.to_string().chars().all(|c| !c.is_uppercase());
    if names.iter().all(snake) {
        TokenStream::new()
    } else {
        quote! { #[allow(non_snake_case)] }
    }
}

/// Returns true for a doc comment, and for `#[doc = …]`.
pub fn is_doc(attribute: &TokenStream) -> bool {
    let inside = attribute.clone().into_iter().find_map(|token| match token {
        TokenTree::Group(group) => group.stream().into_iter().next(),
        _ => None,
    });
    matches!(inside, Some(TokenTree::Ident(name)) if name == "doc")
}

/// The user's attributes, with this text as documentation if they have none.
pub fn documented(attributes: &[TokenStream], text: &str) -> TokenStream {
    match attributes.iter().any(is_doc) {
        true => quote! { #(#attributes)* },
        false => quote! { #[doc = #text] #(#attributes)* },
    }
}

/// Tokens that rustc is to show at the name of the type instead of at the whole definition, with
/// the insides of groups down to some depth.
pub fn located(tokens: TokenStream, name: Span, depth: usize) -> TokenStream {
    let span = Span::call_site().located_at(name);
    let moved = tokens.into_iter().map(|mut token| {
        if let TokenTree::Group(group) = &token
            && depth > 0
        {
            let inner = located(group.stream(), name, depth - 1);
            token = Group::new(group.delimiter(), inner).into();
        }
        token.set_span(span);
        token
    });
    moved.collect()
}

/// The name of the type of a piece.
pub fn piece_type(item: &Header, piece: &Ident) -> Ident {
    format_ident!("{}{}", item.name, piece, span = piece.span())
}
