//! Tokens → statements and expressions as written.
//!
//! Input: [`Tokens`]. Output: [`Ast`]; everything read before an error is kept for the stub.
//! Invariants: at most one error for one mistake; after an error that makes a statement unreadable,
//! the next statement is still read; [`MAX_DEPTH`] bounds recursion, and everything that nests
//! (groups, prefix operators, powers) counts.

mod block;
mod expr;
mod header;
mod number;
mod operator;
mod path;
mod statement;

use crate::ast::{Ast, Expr, ExprId, ExprKind, Expression, LoopVariableId};
use crate::names;
use crate::report::{Report, Spans};
use crate::tokens::{Token, TokenKind, Tokens};
use proc_macro2::{Delimiter, Ident, Span};

/// The greatest depth of expressions.
pub const MAX_DEPTH: u32 = 128;

/// The statement cannot be read further; the error has been reported.
#[derive(Debug)]
pub(crate) struct Abort;

type Result<T> = std::result::Result<T, Abort>;

/// Reads a whole definition.
pub fn parse(tokens: &Tokens, report: &mut Report) -> Ast {
    let mut parser = Parser {
        tokens: &tokens.list,
        position: 0,
        limit: tokens.list.len(),
        statement_limit: tokens.list.len(),
        separator_missing: None,
        depth: 0,
        scope: None,
        condition: None,
        pending: Vec::new(),
        remainders: Vec::new(),
        refused: Vec::new(),
        ast: Ast::default(),
        report,
    };
    parser.definition();
    parser.ast
}

/// The cursor, and the tree read so far.
struct Parser<'a> {
    tokens: &'a [Token],
    /// The next token.
    position: usize,
    /// One past the last token of the innermost group.
    limit: usize,
    /// One past the last token of the group that contains the statements.
    statement_limit: usize,
    /// The token before which a missing `;` was reported.
    separator_missing: Option<usize>,
    depth: u32,
    /// The innermost loop variable in scope.
    scope: Option<LoopVariableId>,
    /// The limit of the group in which the condition of an `if` is being read.
    condition: Option<usize>,
    /// Operators that wait for their right operand.
    pending: Vec<operator::Pending>,
    /// Nodes of `%` that are not yet the outermost of an index.
    remainders: Vec<ExprId>,
    /// Words of the language that a statement tried to declare.
    refused: Vec<&'a str>,
    ast: Ast,
    report: &'a mut Report,
}

impl<'a> Parser<'a> {
    fn definition(&mut self) {
        if self.tokens.is_empty() {
            self.report.error(
                Span::call_site(),
                "there is no Hamiltonian here",
                "write `H = p^2/2 + q^2/2`",
            );
            return;
        }
        let attributes = self.attributes();
        if self.at_item() {
            self.ast.is_item = true;
            if self.item(attributes).is_err() {
                return;
            }
            if self.position == self.limit {
                let name = self.ast.item.as_ref().map(|item| item.header.name.clone());
                if let Some(name) = name {
                    self.report.error(
                        name.span(),
                        format!("`{name}` has no Hamiltonian: nothing follows the braces"),
                        "write `H(q; p) = …` after the closing brace",
                    );
                }
                return;
            }
            self.statements(Vec::new());
        } else {
            self.statements(attributes);
        }
    }

    /// The token `ahead` of the next one, inside the innermost group.
    fn peek_at(&self, ahead: usize) -> Option<&'a Token> {
        let index = self.position + ahead;
        if index < self.limit {
            self.tokens.get(index)
        } else {
            None
        }
    }

    fn peek(&self) -> Option<&'a Token> {
        self.peek_at(0)
    }

    fn kind_at(&self, ahead: usize) -> Option<TokenKind> {
        self.peek_at(ahead).map(|token| token.kind)
    }

    fn kind(&self) -> Option<TokenKind> {
        self.kind_at(0)
    }

    fn at_punct(&self, character: char) -> bool {
        matches!(self.kind(), Some(TokenKind::Punct(found, _)) if found == character)
    }

    /// Moves past a punctuation character, if it is the next token.
    fn eat(&mut self, character: char) -> bool {
        let found = self.at_punct(character);
        self.position += usize::from(found);
        found
    }

    /// Returns true at a single `=`, which does not begin `==`.
    fn at_equals(&self, ahead: usize) -> bool {
        match self.kind_at(ahead) {
            Some(TokenKind::Punct('=', joint)) => {
                !(joint
                    && matches!(
                        self.kind_at(ahead + 1),
                        Some(TokenKind::Punct('=' | '>', _))
                    ))
            }
            _ => false,
        }
    }

    fn at_word(&self, word: &str) -> bool {
        self.peek()
            .is_some_and(|token| token.kind == TokenKind::Ident && token.text == word)
    }

    fn at_open(&self, delimiter: Delimiter) -> bool {
        self.kind() == Some(TokenKind::Open(delimiter))
    }

    /// The span of the next token; at the end of a group that of its last token.
    fn here(&self) -> Span {
        match self.peek() {
            Some(token) => token.span,
            None => self.previous_span(),
        }
    }

    fn previous_span(&self) -> Span {
        match self
            .position
            .checked_sub(1)
            .and_then(|index| self.tokens.get(index))
        {
            Some(token) => token.span,
            None => Span::call_site(),
        }
    }

    /// Moves past one token, or one whole group.
    fn skip(&mut self) {
        if let Some(token) = self.peek() {
            self.position = if matches!(token.kind, TokenKind::Open(_)) {
                token.close
            } else {
                self.position
            };
            self.position += 1;
        }
    }

    /// Enters the group at the cursor; the returned limit goes to [`Parser::leave`].
    fn enter(&mut self) -> SavedLimit {
        let outer = SavedLimit {
            limit: self.limit,
            close: self.tokens[self.position].close,
        };
        self.limit = outer.close;
        self.position += 1;
        outer
    }

    fn leave(&mut self, outer: SavedLimit) {
        self.position = outer.close + 1;
        self.limit = outer.limit;
    }

    /// From the opening of the group at the cursor to its closing.
    fn group_spans(&self) -> Spans {
        let open = &self.tokens[self.position];
        Spans::from(open.span).to(self.tokens[open.close].span)
    }

    /// The next token, for messages.
    fn found(&self) -> String {
        match self.peek() {
            Some(token) => format!("found `{}`", token.shown()),
            None => "found the end".into(),
        }
    }

    fn abort<T>(
        &mut self,
        spans: impl Into<Spans>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Result<T> {
        self.report.error(spans, message, help);
        Err(Abort)
    }

    /// Ends a statement whose next token is not the expected one.
    fn expected<T>(&mut self, expected: &str, help: impl Into<String>) -> Result<T> {
        let message = format!("expected {expected}, {}", self.found());
        self.abort(self.here(), message, help)
    }

    /// Enters one level, or ends the statement if it nests too deep.
    fn deeper(&mut self, span: Span) -> Result<()> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return self.abort(
                span,
                format!("this nests deeper than {MAX_DEPTH}"),
                "name an inner part: `let part = …;`",
            );
        }
        Ok(())
    }

    /// A name that is being declared. A word of the language or of Rust is reported and returned,
    /// so that parsing continues.
    fn declared(&mut self, what: &str, help: &str) -> Result<Ident> {
        let Some(token) = self.peek().filter(|token| token.kind == TokenKind::Ident) else {
            return self.expected(what, help);
        };
        self.position += 1;
        if self.is_plain(token) {
            let name = token.text.as_str();
            if let Some(meaning) = names::meaning(name) {
                self.refused.push(name);
                self.report.error(
                    token.span,
                    format!("`{name}` is {meaning} and cannot be redeclared"),
                    "choose another name",
                );
            } else if names::is_rust_keyword(name) {
                self.report.error(
                    token.span,
                    format!("`{name}` is a keyword of Rust and cannot be a name"),
                    "choose another name",
                );
            }
        }
        self.ast.symbols.intern(&token.text);
        match &token.tree {
            Some(proc_macro2::TokenTree::Ident(ident)) => Ok(ident.clone()),
            _ => Ok(Ident::new("_", token.span)),
        }
    }

    /// Reports words that are identifiers to Rust but not names in mathematics.
    fn is_plain(&mut self, token: &Token) -> bool {
        let name = token.text.as_str();
        if name.contains(['·', '\u{387}']) {
            self.report.error(
                token.span,
                format!("`{name}` is one name to Rust: `·` is a letter"),
                format!("write `{}`", name.replace(['·', '\u{387}'], "*")),
            );
            return false;
        }
        if let Some(plain) = name.strip_prefix("r#") {
            self.report.error(
                token.span,
                format!("the raw identifier `{name}` cannot be a name"),
                format!("choose another name, such as `{plain}_`"),
            );
            return false;
        }
        if name == "_" {
            self.report
                .error(token.span, "`_` is not a name", "give it a name");
            return false;
        }
        true
    }

    /// The `=` before a right side.
    fn equals(&mut self, left: &str) -> Result<()> {
        if self.at_equals(0) {
            self.position += 1;
            return Ok(());
        }
        let two = match (self.kind(), self.kind_at(1)) {
            (
                Some(TokenKind::Punct(a @ ('=' | ':' | '+' | '-' | '*' | '/'), true)),
                Some(TokenKind::Punct('=', _)),
            ) => Some(format!("found `{a}=`")),
            (Some(TokenKind::Punct('=', true)), Some(TokenKind::Punct('>', _))) => {
                Some("found `=>`".into())
            }
            _ => None,
        };
        let mut spans = Spans::from(self.here());
        if two.is_some() {
            spans.end = self.tokens[self.position + 1].span;
        }
        let found = two.unwrap_or_else(|| self.found());
        let help = match self.kind() {
            Some(TokenKind::Open(Delimiter::Bracket | Delimiter::Brace)) if left == "H" => {
                "write `H(q; p) = …`".into()
            }
            _ => format!("write `{left} = …`"),
        };
        self.abort(spans, format!("expected `=` after `{left}`, {found}"), help)
    }

    fn push(&mut self, kind: ExprKind, spans: Spans, at: impl Into<Spans>) -> ExprId {
        let (id, at) = (ExprId(self.ast.nodes.len() as u32), at.into());
        self.ast.nodes.push(Expr { kind, spans, at });
        id
    }

    fn spans(&self, id: ExprId) -> Spans {
        self.ast.nodes[id.0 as usize].spans
    }

    /// A right side: an expression with its nodes.
    fn right_side(&mut self) -> Result<Expression> {
        if self.position == self.limit || self.at_punct(';') {
            let span = self.previous_span();
            return self.abort(span, "an expression is missing after `=`", "write one");
        }
        let first = self.ast.nodes.len() as u32;
        let root = self.expression()?;
        Ok(Expression {
            nodes: first..self.ast.nodes.len() as u32,
            root,
        })
    }
}

/// The state [`Parser::leave`] goes back to.
struct SavedLimit {
    limit: usize,
    close: usize,
}
