//! Diagnostics: faults with their places and remedies.
//!
//! Input: errors of one stage, in the order in which they are found. Output: `compile_error!`
//! tokens, each at the tokens it concerns. Invariant: a report loses no error, and contains no
//! error twice at the same place.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

/// From the first to the last token of a piece of source (stable Rust cannot join spans).
#[derive(Debug, Clone, Copy)]
pub struct Spans {
    /// The first token.
    pub start: Span,
    /// The last token.
    pub end: Span,
}

impl Spans {
    /// From one piece to another.
    pub fn to(self, end: impl Into<Spans>) -> Spans {
        Spans {
            start: self.start,
            end: end.into().end,
        }
    }
}

impl From<Span> for Spans {
    fn from(span: Span) -> Spans {
        Spans {
            start: span,
            end: span,
        }
    }
}

/// One error.
#[derive(Debug, Clone)]
pub struct Diagnostic {
    /// The fault: one line, lower case, code in backticks.
    pub message: String,
    /// The remedy.
    pub help: String,
    /// The narrowest tokens that are wrong.
    pub spans: Spans,
}

impl Diagnostic {
    /// The text that rustc shows.
    pub fn text(&self) -> String {
        format!("{}\nhelp: {}", self.message, self.help)
    }

    /// `::core::compile_error! { "text" }` on the spans. Braces, so that it may stand as an item,
    /// as a statement and as an expression.
    pub fn to_compile_error(&self) -> TokenStream {
        let Spans { start, end } = self.spans;
        let punct = |character, spacing, span| {
            let mut punct = Punct::new(character, spacing);
            punct.set_span(span);
            TokenTree::Punct(punct)
        };
        let mut text = Literal::string(&self.text());
        text.set_span(end);
        let mut body = Group::new(
            Delimiter::Brace,
            TokenStream::from(TokenTree::Literal(text)),
        );
        body.set_span(end);
        TokenStream::from_iter([
            punct(':', Spacing::Joint, start),
            punct(':', Spacing::Alone, start),
            TokenTree::Ident(Ident::new("core", start)),
            punct(':', Spacing::Joint, start),
            punct(':', Spacing::Alone, start),
            TokenTree::Ident(Ident::new("compile_error", start)),
            punct('!', Spacing::Alone, start),
            TokenTree::Group(body),
        ])
    }
}

/// The errors of one definition.
#[derive(Debug, Default)]
pub struct Report {
    errors: Vec<Diagnostic>,
}

impl Report {
    /// Adds an error: the fault and the remedy.
    pub fn error(
        &mut self,
        spans: impl Into<Spans>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.errors.push(Diagnostic {
            message: message.into(),
            help: help.into(),
            spans: spans.into(),
        });
    }

    /// Adds an internal error, with the request to report it.
    pub fn internal(&mut self, spans: impl Into<Spans>, fault: &str) {
        self.error(
            spans,
            format!("internal error of `hamiltonian!`: {fault}"),
            "the definition is not to blame: please report it together with this message",
        );
    }

    /// Returns true if there is no error so far.
    pub fn is_empty(&self) -> bool {
        self.errors.is_empty()
    }

    /// The errors in the order in which they were found.
    pub fn errors(&self) -> &[Diagnostic] {
        &self.errors
    }

    /// The barrier between two stages: the result of a stage, if it reported no error.
    pub fn barrier<T>(&self, result: T) -> Option<T> {
        self.is_empty().then_some(result)
    }
}
