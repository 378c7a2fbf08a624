//! Paths of Rust functions, as in `fn name(…) = a::b::<T>`.
//!
//! Input: tokens. Output: the tokens of one path. Invariant: rustc can parse them as a path; anything
//! else would make the whole output unusable.

use super::{MAX_DEPTH, Parser, Result};
use crate::names;
use crate::tokens::TokenKind;
use proc_macro2::TokenStream;

impl Parser<'_> {
    /// The path of a Rust function.
    pub(super) fn rust_path(&mut self, form: &str) -> Result<TokenStream> {
        let first = self.position;
        let complete = self.eat_path(0);
        let (end, stop) = (self.position, self.here());
        while let Some(TokenKind::Ident | TokenKind::Punct(':' | '<' | '>', _)) = self.kind() {
            self.position += 1;
        }
        if self.position == first {
            return self.expected("the path of a Rust function", form);
        }
        let tokens = &self.tokens[first..self.position];
        let path: TokenStream = tokens
            .iter()
            .filter_map(|token| token.tree.clone())
            .collect();
        if !complete || self.position != end {
            let message = format!("`{path}` is not the path of a Rust function");
            return self.abort(stop, message, form);
        }
        Ok(path)
    }

    /// `a::b::<T>`, `a::b::<true>`, `::a::b` or `<T as Trait>::f`. Inside generics, at a depth above 0, `::` before
    /// generics may be left out. Returns false at the first token that does not fit.
    fn eat_path(&mut self, depth: u32) -> bool {
        if depth > MAX_DEPTH {
            return false;
        }
        if self.eat('<') {
            let implementor = self.eat_type(depth + 1);
            let of_trait = !self.eat_word(|word| word == "as")
                || !self.at_punct('<') && self.eat_path(depth + 1);
            if !(implementor && of_trait && self.eat('>') && self.eat_colons()) {
                return false;
            }
        } else {
            self.eat_colons();
        }
        loop {
            if !self.eat_word(is_segment) {
                return false;
            }
            let mut follows = self.eat_colons();
            if (follows || depth > 0) && self.eat('<') {
                let argument = self.at_punct('>') || self.eat_literal() || self.eat_type(depth + 1);
                if !(argument && self.eat('>')) {
                    return false;
                }
                follows = self.eat_colons();
            }
            if !follows {
                return true;
            }
        }
    }

    /// `_`, a path, or `dyn` and the path of a trait.
    fn eat_type(&mut self, depth: u32) -> bool {
        if self.eat_word(|word| matches!(word, "dyn" | "impl")) {
            return !self.at_punct('<') && self.eat_path(depth);
        }
        self.eat_word(|word| word == "_") || self.eat_path(depth)
    }

    /// A number, a text, `true` or `false`.
    fn eat_literal(&mut self) -> bool {
        let found = self.kind() == Some(TokenKind::Literal);
        self.position += usize::from(found);
        found || self.eat_word(|word| matches!(word, "true" | "false"))
    }

    /// Moves past `::`, if it comes next.
    fn eat_colons(&mut self) -> bool {
        let found = self.kind() == Some(TokenKind::Punct(':', true))
            && matches!(self.kind_at(1), Some(TokenKind::Punct(':', _)));
        self.position += 2 * usize::from(found);
        found
    }

    /// Moves past a word, if it comes next and passes the test.
    fn eat_word(&mut self, test: impl Fn(&str) -> bool) -> bool {
        let found = self
            .peek()
            .is_some_and(|token| token.kind == TokenKind::Ident && test(&token.text));
        self.position += usize::from(found);
        found
    }
}

/// Returns true if a word can stand between the `::` of a path.
fn is_segment(word: &str) -> bool {
    word != "_"
        && (!names::is_rust_keyword(word) || matches!(word, "crate" | "self" | "Self" | "super"))
}
