//! Contents of brackets: groups, lists, the branches of an `if`, the body of a `sum`.
//!
//! Input: the cursor at the opening, or at the word before it. Output: the root of the contents,
//! the cursor after the closing. Invariant: every group counts towards [`super::MAX_DEPTH`] while
//! it is read.

use super::{Abort, Parser, Result};
use crate::ast::{ExprId, ExprKind, LoopVariable, LoopVariableId};
use crate::report::Spans;
use crate::tokens::{Token, TokenKind};
use proc_macro2::Delimiter;

impl Parser<'_> {
    /// A whole group that contains one expression, the cursor at its opening.
    pub(super) fn group<T>(
        &mut self,
        what: &str,
        inner: impl FnOnce(&mut Self) -> Result<T>,
    ) -> Result<T> {
        let opening = &self.tokens[self.position];
        self.deeper(opening.span)?;
        let outer = self.enter();
        if self.position == self.limit && opening.kind != TokenKind::Open(Delimiter::Bracket) {
            let spans = Spans::from(opening.span).to(self.tokens[outer.close].span);
            return self.abort(spans, "there is nothing inside", format!("write {what}"));
        }
        let result = inner(self)?;
        if self.position != self.limit {
            return self.left_over(what);
        }
        self.leave(outer);
        self.depth -= 1;
        Ok(result)
    }

    /// A comma-separated list of expressions, the cursor at its opening.
    pub(super) fn list(&mut self, shown: &str) -> Result<Vec<ExprId>> {
        self.deeper(self.here())?;
        let outer = self.enter();
        let mut items = Vec::new();
        while self.position != self.limit {
            items.push(self.expression()?);
            if self.at_punct(';') {
                let span = self.here();
                return self.abort(
                    span,
                    "`;` does not separate the members of a list",
                    format!("write `{shown}`"),
                );
            }
            if !self.eat(',') && self.position != self.limit {
                return self.left_over("`,` or the end of the list");
            }
        }
        self.leave(outer);
        self.depth -= 1;
        Ok(items)
    }

    /// A token after an expression that cannot continue it.
    pub(super) fn left_over<T>(&mut self, expected: &str) -> Result<T> {
        let Some(token) = self.peek() else {
            return Err(Abort);
        };
        let (message, help) = match token.kind {
            TokenKind::Punct('=', _) => (
                "`=` does not compare".to_owned(),
                "write `==` in a condition",
            ),
            TokenKind::Punct(',', _) => (
                "a list is not a value".into(),
                "write `[a, b]` for a vector",
            ),
            TokenKind::Punct(';', _) => (
                "a `;` inside an expression".into(),
                "write statements at the top level, outside of brackets",
            ),
            TokenKind::Punct('!', _) => (
                "`!` is allowed only before a condition".into(),
                "there is no factorial; write the number",
            ),
            TokenKind::Punct('?', _) => (
                "`?` does not choose between values".into(),
                "write `if c { a } else { b }`",
            ),
            TokenKind::Ident if token.text == "in" => (
                "unexpected loop variable".into(),
                "write `sum(i in 0..N) { … }`",
            ),
            TokenKind::Punct('.', true) => {
                ("unexpected range".into(), "write `sum(i in 0..N) { … }`")
            }
            TokenKind::Open(Delimiter::Brace) => (
                "braces do not stand here".into(),
                "write `( … )`, or `sum(i in 0..N) { … }`",
            ),
            _ => (
                format!("expected {expected}, found `{}`", token.shown()),
                "remove it",
            ),
        };
        self.abort(token.span, message, help)
    }

    /// `if c { a } else if d { b } else { e }`, the cursor at `if`.
    pub(super) fn conditional(&mut self) -> Result<ExprId> {
        const FORM: &str = "write `if c { a } else { b }`";
        let depth = self.depth;
        let mut branches = Vec::new();
        let otherwise = loop {
            let at = self.here();
            self.deeper(at)?;
            self.position += 1;
            if self.at_open(Delimiter::Brace) {
                return self.abort(at, "the condition of `if` is missing", FORM);
            }
            let outer = self.condition.replace(self.limit);
            let condition = self.expression();
            self.condition = outer;
            let condition = condition?;
            if !self.at_open(Delimiter::Brace) {
                if self.at_equals(0) {
                    return self.left_over("`{`");
                }
                return self.expected("`{` after the condition", FORM);
            }
            let then = self.group("one value", |parser| parser.expression())?;
            branches.push((at, condition, then));
            if !self.at_word("else") {
                return self.abort(at, "`if` without `else`: both branches need a value", FORM);
            }
            self.position += 1;
            if self.at_word("if") {
                continue;
            }
            if !self.at_open(Delimiter::Brace) {
                return self.expected("`{` after `else`", FORM);
            }
            break self.group("one value", |parser| parser.expression())?;
        };
        self.depth = depth;
        let end = self.previous_span();
        let mut value = otherwise;
        for (at, condition, then) in branches.into_iter().rev() {
            let kind = ExprKind::If {
                condition,
                then,
                otherwise: value,
            };
            value = self.push(kind, Spans::from(at).to(end), at);
        }
        Ok(value)
    }

    /// `sum(i in a..b, j in c..d) { body }`, the cursor at `sum`.
    pub(super) fn sum(&mut self) -> Result<ExprId> {
        const FORM: &str = "write `sum(i in 0..N) { … }`";
        let at = self.here();
        let outer_scope = self.scope;
        self.position += 1;
        if !self.at_open(Delimiter::Parenthesis) {
            return self.abort(at, "`sum` needs a loop variable and its range", FORM);
        }
        let parentheses = self.group_spans();
        self.deeper(at)?;
        let scopes = self.members(FORM, |parser| parser.binder(FORM))?;
        if scopes.is_empty() {
            return self.abort(
                parentheses,
                "`sum` needs a loop variable and its range",
                FORM,
            );
        }
        if !self.at_open(Delimiter::Brace) {
            let message = "the body of a `sum` needs braces";
            return self.abort(Spans::from(at).to(parentheses), message, FORM);
        }
        let body = self.group("one value", |parser| parser.expression())?;
        self.depth -= 1;
        self.scope = outer_scope;
        let spans = Spans::from(at).to(self.previous_span());
        Ok(self.push(ExprKind::Sum { scopes, body }, spans, at))
    }

    /// `i in a..b`; from here on `i` is in scope.
    fn binder(&mut self, form: &str) -> Result<LoopVariableId> {
        let is_loop = matches!(self.kind(), Some(TokenKind::Ident))
            && self.peek_at(1).is_some_and(|token| token.text == "in");
        if !is_loop {
            let span = self.here();
            let compares =
                |token: &Token| matches!(token.kind, TokenKind::Punct('<' | '>' | '=' | '!', _));
            let has_condition = self.tokens[self.position..self.limit].iter().any(compares);
            let form = match has_condition {
                true => {
                    "a sum has no condition: `j in 0..i` takes each pair once, `if c { a } else { 0 }` in the body chooses terms"
                }
                false => form,
            };
            return self.abort(span, "expected a loop variable and its range", form);
        }
        let name = self.declared("a loop variable", form)?;
        self.position += 1;
        let lower = self.bound("where it begins", form)?;
        if self.kind() != Some(TokenKind::Punct('.', true)) {
            return self.expected("`..` in a range", form);
        }
        let dots = Spans::from(self.here()).to(self.tokens[self.position + 1].span);
        self.position += 2;
        if self.at_punct('=') || self.at_punct('.') {
            let dots = Spans {
                end: self.here(),
                ..dots
            };
            return self.abort(
                dots,
                "ranges exclude their end",
                "write `..n + 1` to include `n`",
            );
        }
        let upper = self.bound("where it ends", form)?;
        let symbol = self.ast.symbols.intern(&name.to_string());
        let scope = LoopVariableId(self.ast.scopes.len() as u32);
        let span = name.span();
        self.ast.scopes.push(LoopVariable {
            parent: self.scope,
            name,
            symbol,
        });
        self.scope = Some(scope);
        self.push(
            ExprKind::Bind {
                scope,
                lower,
                upper,
            },
            Spans::from(span),
            span,
        );
        Ok(scope)
    }

    fn bound(&mut self, what: &str, form: &str) -> Result<ExprId> {
        let ends = match self.kind() {
            None | Some(TokenKind::Punct(',', _)) => true,
            Some(TokenKind::Punct('.', joint)) => joint,
            _ => false,
        };
        if ends {
            let span = self.previous_span();
            return self.abort(span, format!("the range does not say {what}"), form);
        }
        self.expression()
    }
}
