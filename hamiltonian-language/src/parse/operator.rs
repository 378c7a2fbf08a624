//! Operators between operands, and their binding.
//!
//! Input: the cursor after an operand. Output: the operator, or none if the expression ends.
//! Invariant: a wrong or missing sign (`**`, nothing at all) is reported and read as the operator
//! that is meant.
//!
//! Binding, from loose to tight: `||`, `&&`, comparisons (not associative), `+ -`, `* / %`, prefix
//! `- !`, `^` (right-associative, takes a prefix operator on its right), calls and indices.

use super::{Parser, Result};
use crate::ast::{BinaryOp, Comparison, ExprId, UnaryOp};
use crate::names;
use crate::report::Spans;
use crate::tokens::{Token, TokenKind};
use proc_macro2::{Delimiter, Span};

/// An operator that waits for its right operand.
pub(super) enum Pending {
    Unary(UnaryOp, Span),
    Binary(BinaryOp, Spans, ExprId),
}

impl Pending {
    /// The binding of the operand on its right.
    pub(super) fn right_binding(&self) -> u8 {
        match self {
            Pending::Unary(..) => 11,
            Pending::Binary(BinaryOp::Pow, ..) => 13,
            Pending::Binary(op, ..) => left_binding(*op) + 1,
        }
    }
}

/// Returns true if a value may begin with such a token.
pub(super) fn begins_operand(kind: TokenKind) -> bool {
    matches!(
        kind,
        TokenKind::Ident
            | TokenKind::Literal
            | TokenKind::Open(Delimiter::Parenthesis | Delimiter::Bracket | Delimiter::None)
    )
}

/// Returns true if a word ends the expression before it.
pub(super) fn ends_operand(token: &Token) -> bool {
    token.kind == TokenKind::Ident && matches!(token.text.as_str(), "on" | "else" | "in")
}

/// The binding of the operand on the left of an operator.
pub(super) fn left_binding(op: BinaryOp) -> u8 {
    match op {
        BinaryOp::Or => 1,
        BinaryOp::And => 3,
        BinaryOp::Compare(_) => 5,
        BinaryOp::Add | BinaryOp::Sub => 7,
        BinaryOp::Mul | BinaryOp::Div | BinaryOp::Rem => 9,
        BinaryOp::Pow => 14,
    }
}

impl Parser<'_> {
    /// Reads the operator at the cursor; `None` if the expression ends.
    pub(super) fn infix(&mut self) -> Result<Option<(BinaryOp, Spans)>> {
        let Some(token) = self.peek() else {
            return Ok(None);
        };
        let span = token.span;
        let then = |parser: &Self, character| matches!(parser.kind_at(1), Some(TokenKind::Punct(found, _)) if found == character);
        let (op, length) = match token.kind {
            TokenKind::Punct('+', _) => (BinaryOp::Add, 1),
            TokenKind::Punct('-', _) => (BinaryOp::Sub, 1),
            TokenKind::Punct('*', true) if then(self, '*') => {
                let spans = Spans::from(span).to(self.tokens[self.position + 1].span);
                self.report
                    .error(spans, "`**` is not an operator", "write `^` for a power");
                (BinaryOp::Pow, 2)
            }
            TokenKind::Punct('*', _) => (BinaryOp::Mul, 1),
            TokenKind::Punct('/', _) => (BinaryOp::Div, 1),
            TokenKind::Punct('%', _) => (BinaryOp::Rem, 1),
            TokenKind::Punct('^', _) => (BinaryOp::Pow, 1),
            TokenKind::Punct('<', true) if then(self, '=') => {
                (BinaryOp::Compare(Comparison::LessEqual), 2)
            }
            TokenKind::Punct('>', true) if then(self, '=') => {
                (BinaryOp::Compare(Comparison::GreaterEqual), 2)
            }
            TokenKind::Punct('=', true) if then(self, '=') => {
                (BinaryOp::Compare(Comparison::Equal), 2)
            }
            TokenKind::Punct('!', true) if then(self, '=') => {
                (BinaryOp::Compare(Comparison::NotEqual), 2)
            }
            TokenKind::Punct('<', _) => (BinaryOp::Compare(Comparison::Less), 1),
            TokenKind::Punct('>', _) => (BinaryOp::Compare(Comparison::Greater), 1),
            TokenKind::Punct(character @ ('&' | '|'), joint) => {
                let is_double = joint && then(self, character);
                if !is_double {
                    self.report.error(
                        span,
                        format!("`{character}` is not an operator"),
                        format!("write `{character}{character}` between conditions"),
                    );
                }
                let op = match character {
                    '&' => BinaryOp::And,
                    _ => BinaryOp::Or,
                };
                (op, 1 + usize::from(is_double))
            }
            TokenKind::Ident
                if matches!(token.text.as_str(), "and" | "or") && self.operand_follows() =>
            {
                let (op, sign) = match token.text.as_str() {
                    "and" => (BinaryOp::And, "&&"),
                    _ => (BinaryOp::Or, "||"),
                };
                self.not_an_operator(token, sign);
                (op, 1)
            }
            TokenKind::Ident
            | TokenKind::Literal
            | TokenKind::Open(Delimiter::Parenthesis | Delimiter::None) => {
                if token.kind == TokenKind::Ident && names::is_foreign(&token.text) {
                    self.keyword(token, "and means nothing here")?;
                }
                return Ok(self.missing_operator(token));
            }
            TokenKind::Punct('#', _) if self.limit == self.statement_limit => {
                return Ok(self.missing_operator(token));
            }
            _ => return Ok(None),
        };
        let end = self.tokens[self.position + length - 1].span;
        self.position += length;
        Ok(Some((op, Spans::from(span).to(end))))
    }

    /// Returns true if a value begins after the token at the cursor, with a sign before it or none.
    fn operand_follows(&self) -> bool {
        self.kind_at(1).is_some_and(|kind| {
            begins_operand(kind) || matches!(kind, TokenKind::Punct('+' | '-' | '!', _))
        })
    }

    /// `and`, `or` and `not` of other languages.
    pub(super) fn not_an_operator(&mut self, word: &Token, sign: &str) {
        self.report.error(
            word.span,
            format!("`{}` is not an operator", word.text),
            format!("write `{sign}`"),
        );
    }

    /// Two values side by side, or two statements.
    fn missing_operator(&mut self, token: &Token) -> Option<(BinaryOp, Spans)> {
        let name = token.text.as_str();
        if ends_operand(token) {
            return None;
        }
        let before = &self.tokens[self.position - 1];
        if self.limit == self.statement_limit && self.begins_statement() {
            let help = if token.kind != TokenKind::Ident || names::is_statement_word(name) {
                "statements are separated by `;`".to_owned()
            } else {
                format!("write `; let {name}` if it is a statement of its own")
            };
            let message = format!("a `;` is missing before `{}`", token.shown());
            self.report.error(token.span, message, help);
            self.separator_missing = Some(self.position);
            return None;
        }
        if self.condition == Some(self.limit) {
            return None;
        }
        let shown = |token: &Token| match token.kind {
            TokenKind::Ident | TokenKind::Literal => Some(token.text.clone()),
            TokenKind::Open(_) | TokenKind::Close(_) => Some("(…)".into()),
            TokenKind::Punct(..) => None,
        };
        let function = names::function(&before.text).filter(|f| f.arguments.len() == 1);
        let (message, help) = match (shown(before), shown(token)) {
            (Some(left), Some(right)) if function.is_some() => (
                format!("`{left}` needs parentheses around its argument"),
                format!("write `{left}({right})`"),
            ),
            (Some(left), Some(right)) if left != "(…)" || right != "(…)" => (
                format!("an operator is missing between `{left}` and `{right}`"),
                format!("write `{left}*{right}`"),
            ),
            _ => (
                format!("an operator is missing before `{}`", token.shown()),
                "write `*` between the factors of a product".to_owned(),
            ),
        };
        self.report.error(token.span, message, help);
        Some((BinaryOp::Mul, token.span.into()))
    }
}
