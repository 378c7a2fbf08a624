//! Flat token trees, so that no later stage recurses over them.
//!
//! Input: a token stream. Output: [`Tokens`], one entry a token and two a group. Invariants: the
//! opening entry of a group has the index of the closing one; groups without delimiters (fragments
//! of `macro_rules!`) of one token, and those that hold an attribute or a visibility, are replaced
//! by their contents; the others stay, and the expression parser reads them as parentheses.

use proc_macro2::{Delimiter, Span, TokenStream, TokenTree, token_stream};

/// All tokens of a definition.
#[derive(Debug)]
pub struct Tokens {
    /// In source order.
    pub list: Vec<Token>,
}

/// One token.
#[derive(Debug)]
pub struct Token {
    /// Word, literal, punctuation, or one end of a group.
    pub kind: TokenKind,
    /// Its place.
    pub span: Span,
    /// The text of identifiers and literals; empty for others.
    pub text: String,
    /// The index of the closing entry, for opening ones.
    pub close: usize,
    /// The token itself, a whole group for opening entries; `None` for closing ones.
    pub tree: Option<TokenTree>,
}

/// The kind of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TokenKind {
    /// A word.
    Ident,
    /// A number, string or character.
    Literal,
    /// A punctuation character and whether the next one touches it.
    Punct(char, bool),
    /// The opening of a group.
    Open(Delimiter),
    /// The closing of a group.
    Close(Delimiter),
}

impl Token {
    /// The token as the user sees it.
    pub fn shown(&self) -> String {
        match self.kind {
            TokenKind::Ident | TokenKind::Literal => self.text.clone(),
            TokenKind::Punct(character, _) => character.to_string(),
            TokenKind::Open(Delimiter::Parenthesis) => "(".into(),
            TokenKind::Open(Delimiter::Bracket) => "[".into(),
            TokenKind::Open(Delimiter::Brace) => "{".into(),
            TokenKind::Close(Delimiter::Parenthesis) => ")".into(),
            TokenKind::Close(Delimiter::Bracket) => "]".into(),
            TokenKind::Close(Delimiter::Brace) => "}".into(),
            TokenKind::Open(Delimiter::None) | TokenKind::Close(Delimiter::None) => "…".into(),
        }
    }
}

/// A group that is being flattened.
struct Level {
    rest: token_stream::IntoIter,
    /// Its opening entry; `None` if it is replaced by its contents.
    group: Option<(usize, Delimiter, Span)>,
}

impl Tokens {
    /// Flattens a token stream.
    pub fn flatten(stream: TokenStream) -> Tokens {
        let mut list: Vec<Token> = Vec::new();
        let mut levels = vec![Level {
            rest: stream.into_iter(),
            group: None,
        }];
        while let Some(level) = levels.last_mut() {
            let Some(tree) = level.rest.next() else {
                if let Some((open, delimiter, span)) = level.group {
                    list[open].close = list.len();
                    list.push(Token {
                        kind: TokenKind::Close(delimiter),
                        span,
                        text: String::new(),
                        close: 0,
                        tree: None,
                    });
                }
                levels.pop();
                continue;
            };
            let (kind, span, text) = match &tree {
                TokenTree::Group(group) => {
                    let rest = group.stream().into_iter();
                    if group.delimiter() == Delimiter::None && is_transparent(group.stream()) {
                        levels.push(Level { rest, group: None });
                        continue;
                    }
                    let opened = (list.len(), group.delimiter(), group.span_close());
                    levels.push(Level {
                        rest,
                        group: Some(opened),
                    });
                    (
                        TokenKind::Open(group.delimiter()),
                        group.span_open(),
                        String::new(),
                    )
                }
                TokenTree::Ident(ident) => (TokenKind::Ident, ident.span(), ident.to_string()),
                TokenTree::Literal(literal) => {
                    (TokenKind::Literal, literal.span(), literal.to_string())
                }
                TokenTree::Punct(punct) => {
                    let joint = punct.spacing() == proc_macro2::Spacing::Joint;
                    (
                        TokenKind::Punct(punct.as_char(), joint),
                        punct.span(),
                        String::new(),
                    )
                }
            };
            list.push(Token {
                kind,
                span,
                text,
                close: 0,
                tree: Some(tree),
            });
        }
        Tokens { list }
    }
}

/// Returns true if the first word of an attribute, `#[word …]`, is this one. The inside may come from another
/// macro.
pub fn is_attribute(attribute: &TokenStream, word: &str) -> bool {
    let tokens = Tokens::flatten(attribute.clone()).list;
    let mut words = tokens.iter().filter(|token| token.kind == TokenKind::Ident);
    words.next().is_some_and(|first| first.text == word)
}

fn is_transparent(stream: TokenStream) -> bool {
    let mut trees = stream.into_iter();
    match trees.next() {
        None => true,
        Some(TokenTree::Ident(word)) if word == "pub" => true,
        Some(TokenTree::Punct(punct)) if punct.as_char() == '#' => true,
        Some(_) => trees.next().is_none(),
    }
}
