//! Expressions: a Pratt parser with its operators on a stack of its own.
//!
//! Input: the cursor at an expression. Output: its root; its nodes are appended in post-order.
//! Invariants: only groups recurse, and they count towards [`super::MAX_DEPTH`] as prefix operators
//! and powers do; chains of left-associative operators of any length cost neither stack nor depth.
//! A mistake with a clear meaning (`2q`, `**`, a missing `*`) is reported and read with that
//! meaning, so that later errors are found too.

use super::operator::{Pending, begins_operand, ends_operand, left_binding};
use super::{Parser, Result};
use crate::ast::{BinaryOp, ExprId, ExprKind, UnaryOp};
use crate::names;
use crate::report::Spans;
use crate::tokens::{Token, TokenKind};
use proc_macro2::{Delimiter, Span};

/// The token after a function.
const CALL: TokenKind = TokenKind::Open(Delimiter::Parenthesis);

impl Parser<'_> {
    /// An expression up to the first token that cannot continue it.
    pub(super) fn expression(&mut self) -> Result<ExprId> {
        let (base, depth) = (self.pending.len(), self.depth);
        let result = self.operands(base);
        self.pending.truncate(base);
        self.depth = depth;
        result
    }

    fn operands(&mut self, base: usize) -> Result<ExprId> {
        loop {
            self.prefixes()?;
            let operand = self.primary()?;
            let mut operand = self.postfixes(operand)?;
            let next = self.infix()?;
            let binding = next.map_or(0, |(op, _)| left_binding(op));
            while self.pending.len() > base {
                let waiting = &self.pending[self.pending.len() - 1];
                if waiting.right_binding() < binding {
                    break;
                }
                if let (
                    Pending::Binary(BinaryOp::Compare(_), ..),
                    Some((BinaryOp::Compare(_), span)),
                ) = (waiting, next)
                {
                    return self.abort(span, "comparisons do not chain", "write `a < b && b < c`");
                }
                operand = self.reduce(operand);
            }
            let Some((op, span)) = next else {
                return Ok(operand);
            };
            if op == BinaryOp::Pow {
                self.deeper(span.start)?;
            }
            self.pending.push(Pending::Binary(op, span, operand));
        }
    }

    /// Applies the innermost pending operator to its right operand.
    fn reduce(&mut self, operand: ExprId) -> ExprId {
        let right = self.spans(operand);
        match self.pending.pop() {
            Some(Pending::Unary(op, span)) => {
                self.depth -= 1;
                self.push(
                    ExprKind::Unary(op, operand),
                    Spans::from(span).to(right),
                    span,
                )
            }
            Some(Pending::Binary(op, span, left)) => {
                let spans = self.spans(left).to(right);
                let id = self.push(ExprKind::Binary(op, left, operand), spans, span);
                match op {
                    BinaryOp::Pow => self.depth -= 1,
                    BinaryOp::Rem => self.remainders.push(id),
                    _ => {}
                }
                id
            }
            None => operand,
        }
    }

    /// Reads prefix operators; a plus sign has no effect.
    fn prefixes(&mut self) -> Result<()> {
        while let Some(token) = self.peek() {
            let op = match token.kind {
                TokenKind::Punct('+', _) => {
                    self.position += 1;
                    continue;
                }
                TokenKind::Punct('-', _) => UnaryOp::Neg,
                TokenKind::Punct('!', _) => UnaryOp::Not,
                // `not(…)` may be a user's function.
                TokenKind::Ident
                    if token.text == "not"
                        && matches!(
                            self.kind_at(1),
                            Some(TokenKind::Ident | TokenKind::Literal)
                        )
                        && !self.peek_at(1).is_some_and(ends_operand) =>
                {
                    self.not_an_operator(token, "!( … )");
                    UnaryOp::Not
                }
                _ => break,
            };
            self.deeper(token.span)?;
            self.pending.push(Pending::Unary(op, token.span));
            self.position += 1;
        }
        Ok(())
    }

    fn primary(&mut self) -> Result<ExprId> {
        let Some(token) = self.peek() else {
            return self.operand_missing();
        };
        match token.kind {
            TokenKind::Ident => self.word(token),
            TokenKind::Literal => Ok(self.number_node()),
            TokenKind::Open(Delimiter::Parenthesis | Delimiter::None) => {
                let spans = self.group_spans();
                let id = self.group("a value", |parser| parser.expression())?;
                self.ast.nodes[id.0 as usize].spans = spans;
                Ok(id)
            }
            TokenKind::Open(Delimiter::Brace) => self.abort(
                token.span,
                "braces do not group",
                "write `( … )`; braces hold the body of a `sum` and the branches of an `if`",
            ),
            TokenKind::Open(Delimiter::Bracket) => {
                let spans = self.group_spans();
                let items = self.list("[a, b, c]")?;
                if items.is_empty() {
                    return self.abort(spans, "a vector without components", "write `[a, b, c]`");
                }
                Ok(self.push(ExprKind::Vector(items), spans, spans.start))
            }
            TokenKind::Punct('.', _) if self.kind_at(1) == Some(TokenKind::Literal) => {
                let digits = self.tokens[self.position + 1].text.clone();
                let spans = Spans::from(token.span).to(self.tokens[self.position + 1].span);
                self.report.error(
                    spans,
                    format!("`.{digits}` does not begin with a digit"),
                    format!("write `0.{digits}`"),
                );
                self.position += 2;
                Ok(self.push(ExprKind::Error, spans, token.span))
            }
            TokenKind::Punct('|', _) => self.abort(
                token.span,
                "bars do not mean the absolute value",
                "write `abs(x)`",
            ),
            TokenKind::Punct('&', _) => self.abort(
                token.span,
                "references mean nothing here: names are captured by value",
                "leave out the `&`",
            ),
            TokenKind::Punct(..) | TokenKind::Close(_) => self.operand_missing(),
        }
    }

    fn operand_missing(&mut self) -> Result<ExprId> {
        let before = self
            .position
            .checked_sub(1)
            .map(|index| &self.tokens[index]);
        match (self.peek(), before) {
            (Some(token), _) if token.kind != TokenKind::Punct(';', false) => {
                let message = format!(
                    "expected a number, a name or `(`, found `{}`",
                    token.shown()
                );
                self.abort(
                    token.span,
                    message,
                    "write a value on each side of an operator",
                )
            }
            (_, Some(before)) => {
                let message = format!("a value is missing after `{}`", before.shown());
                self.abort(
                    before.span,
                    message,
                    "write a value, or remove the operator",
                )
            }
            (_, None) => self.abort(self.here(), "an expression is missing", "write one"),
        }
    }

    /// A name, a call, `if`, `sum`, or a word that cannot stand here.
    fn word(&mut self, token: &Token) -> Result<ExprId> {
        let span = token.span;
        let name = token.text.as_str();
        if self.refused.contains(&name) && self.kind_at(1) != Some(CALL) {
            // Its declaration was reported.
            self.position += 1;
            return Ok(self.push(ExprKind::Error, Spans::from(span), span));
        }
        match name {
            "if" => return self.conditional(),
            "sum" => return self.sum(),
            "prod" | "product" | "Π" if self.peek_at(3).is_some_and(|next| next.text == "in") => {
                return self.abort(
                    span,
                    format!("`{name}`: the language has no product over a range"),
                    "write the factors with `*`; of positive ones, `exp(sum(i in 0..N) { ln(…) })`",
                );
            }
            "else" => {
                return self.abort(span, "`else` without `if`", "write `if c { a } else { b }`");
            }
            "let" => {
                return self.abort(
                    span,
                    "`let` cannot be used inside an expression",
                    "write it as a statement of its own: `let name = …;`",
                );
            }
            _ => {}
        }
        if names::is_statement_word(name) && name != "H" && name != "L" && name != "dt" {
            return self.abort(
                span,
                format!("`{name}` begins a statement and is not a value"),
                "choose another name, or write it as a statement of its own",
            );
        }
        let receiver = matches!(self.kind_at(1), Some(TokenKind::Punct('.' | ':', _)));
        let is_keyword = names::is_foreign(name) && !receiver;
        let plain = !is_keyword && self.is_plain(token);
        if is_keyword {
            self.keyword(token, "and not a value")?;
        }
        self.position += 1;
        if matches!(self.kind(), Some(TokenKind::Punct(':', true)))
            && matches!(self.kind_at(1), Some(TokenKind::Punct(':', _)))
        {
            return Ok(self.path(span));
        }
        let call = self.at_open(Delimiter::Parenthesis);
        if !plain {
            if call {
                self.skip();
            }
            return Ok(self.push(ExprKind::Error, Spans::from(span), span));
        }
        if self.at_punct('^') && names::function(name).is_some() && !names::is_hidden(name) {
            return Ok(self.powered_function(token));
        }
        let symbol = self.ast.symbols.intern(name);
        if !call {
            return Ok(self.push(ExprKind::Name(symbol, self.scope), Spans::from(span), span));
        }
        let spans = Spans::from(span).to(self.group_spans());
        let shown =
            names::function(name).map_or_else(|| format!("{name}(a, b)"), |f| f.signature());
        let arguments = self.list(&shown)?;
        Ok(self.push(ExprKind::Call(symbol, self.scope, arguments), spans, span))
    }

    /// A keyword of Rust inside an expression. The tokens after `for` and similar keywords are not
    /// read.
    pub(super) fn keyword(&mut self, token: &Token, what: &str) -> Result<()> {
        let name = &token.text;
        let (help, is_clause) = match name.as_str() {
            "for" | "while" | "loop" => ("write `sum(i in 0..N) { … }` to add terms", true),
            "match" => ("write `if c { a } else { b }`", true),
            "where" => ("name values above, `let name = …;`", true),
            "as" => ("leave it out: numbers have no type", true),
            _ => ("choose another name", false),
        };
        let message = format!("`{name}` is a keyword of Rust {what}");
        if is_clause && self.kind_at(1).is_some_and(begins_operand) {
            return self.abort(token.span, message, help);
        }
        self.report
            .error(token.span, message, "choose another name");
        Ok(())
    }

    /// `sin^2(q)`: refused, the cursor after the function.
    fn powered_function(&mut self, function: &Token) -> ExprId {
        self.position += 1;
        let power = match self.kind() {
            Some(TokenKind::Literal | TokenKind::Ident) => self.tokens[self.position].text.as_str(),
            _ => "n",
        };
        if self.kind().is_some() {
            self.skip();
        }
        let name = &function.text;
        let spans = Spans::from(function.span).to(self.previous_span());
        self.report.error(
            spans,
            format!("`{name}^{power}` is not a function: write the power after the argument"),
            format!("write `{name}(x)^{power}`"),
        );
        if self.at_open(Delimiter::Parenthesis) {
            self.skip();
        }
        self.push(ExprKind::Error, spans, function.span)
    }

    /// `std::f64::consts::PI`: refused, the cursor after the first word.
    fn path(&mut self, start: Span) -> ExprId {
        let mut last = "";
        while let Some(token) = self.peek() {
            match token.kind {
                TokenKind::Ident => last = token.text.as_str(),
                TokenKind::Punct(':', _) => {}
                _ => break,
            }
            self.position += 1;
        }
        let spans = Spans::from(start).to(self.previous_span());
        let help = match last {
            "PI" => "write `pi`".to_owned(),
            _ if names::function(last).is_some() => format!("write `{last}`"),
            _ if self.ast.is_item => "declare a Rust function by `fn name(x) = path, (path)`, a \
                                      constant as a parameter"
                .into(),
            _ => "bind it before the macro, `let name = …;`, and write `name`".into(),
        };
        self.report.error(spans, "a path is not a value here", help);
        if self.at_open(Delimiter::Parenthesis) {
            self.skip();
        }
        self.push(ExprKind::Error, spans, start)
    }

    /// Indices, and the fields and methods of Rust, which are refused.
    fn postfixes(&mut self, mut base: ExprId) -> Result<ExprId> {
        while let Some(token) = self.peek() {
            match token.kind {
                TokenKind::Open(Delimiter::Bracket) => base = self.index(base)?,
                TokenKind::Punct('.', joint) => {
                    if joint && matches!(self.kind_at(1), Some(TokenKind::Punct('.', _))) {
                        break;
                    }
                    base = self.dot(base)?;
                }
                _ => break,
            }
        }
        Ok(base)
    }

    /// `base[index]`, the cursor at the bracket.
    fn index(&mut self, base: ExprId) -> Result<ExprId> {
        let group = self.group_spans();
        let spans = self.spans(base).to(group);
        let waiting = self.remainders.len();
        let array = match self.ast.nodes[base.0 as usize].kind {
            ExprKind::Name(symbol, _) => self.ast.symbols.name(symbol).to_owned(),
            _ => "q".into(),
        };
        let root = self.group("one index", |parser| {
            if parser.position == parser.limit {
                let help = format!("write `{array}[i]`");
                return parser.abort(group, "an index is missing", help);
            }
            let index = parser.expression()?;
            if parser.at_punct(',') {
                return parser.abort(
                    parser.here(),
                    "each index has brackets of its own",
                    format!("write `{array}[i][j]`"),
                );
            }
            Ok(index)
        })?;
        let (mut index, mut modulo) = (root, None);
        for id in self.remainders.split_off(waiting) {
            let node = &self.ast.nodes[id.0 as usize];
            match node.kind {
                ExprKind::Binary(BinaryOp::Rem, left, right) if id == root => {
                    (index, modulo) = (left, Some(right));
                    // The operands are separated: the remainder itself is not a value.
                    self.ast.nodes[id.0 as usize].kind = ExprKind::Error;
                }
                _ => self.report.error(
                    node.at,
                    "`%` binds like `*`, but must be the outermost operation of an index",
                    format!("write `{array}[(i + 1) % N]`"),
                ),
            }
        }
        Ok(self.push(
            ExprKind::Index {
                base,
                index,
                modulo,
            },
            spans,
            group.start,
        ))
    }

    /// `q.sin()`, `q.powi(2)`, `a.b`: refused, the cursor at the dot.
    fn dot(&mut self, base: ExprId) -> Result<ExprId> {
        let before = &self.tokens[self.position - 1];
        let receiver = match before.kind {
            TokenKind::Ident | TokenKind::Literal => before.text.clone(),
            _ => "…".into(),
        };
        let receiver = receiver.strip_suffix('.').unwrap_or(&receiver).to_owned();
        let Some(member) = self
            .peek_at(1)
            .filter(|token| token.kind != TokenKind::Punct(';', false))
        else {
            let span = self.here();
            return self.abort(span, "a `.` that belongs to nothing", "remove it");
        };
        let word = member.text.as_str();
        let start = self.spans(base).start;
        self.position += 2;
        if !matches!(member.kind, TokenKind::Ident) {
            let (message, help) = if before.kind == TokenKind::Literal {
                let message = format!("`{receiver}.{}` is not a number", member.shown());
                (message, "write a decimal number".to_owned())
            } else {
                let message = format!("`.{}` after a value means nothing", member.shown());
                (message, format!("write `{receiver}[0]` for a component"))
            };
            return self.abort(Spans::from(start).to(member.span), message, help);
        }
        let spans = Spans::from(start).to(member.span);
        if self.at_open(Delimiter::Parenthesis) {
            let argument = self.peek_at(1).map_or("", |token| token.text.as_str());
            // `Math.pow(q, 2)`, `Math.atan2(y, x)`
            let is_of_two = matches!(self.kind_at(2), Some(TokenKind::Punct(',', _)));
            let help = match (word, argument) {
                ("pow", base) if is_of_two => format!("write `{base}^n`"),
                ("pow" | "powi" | "powf", "") => format!("write `{receiver}^n`"),
                ("pow" | "powi" | "powf", power) => format!("write `{receiver}^{power}`"),
                _ => {
                    let known = names::synonym(word).unwrap_or(word);
                    match names::function(known).map(|entry| entry.arguments) {
                        Some([_, _]) if is_of_two => format!("write `{known}({argument}, …)`"),
                        Some([_, second]) => format!("write `{known}({receiver}, {second})`"),
                        // `Math.cos(q)`
                        Some([_]) if !argument.is_empty() => match self.kind_at(2) {
                            Some(TokenKind::Close(_)) => format!("write `{known}({argument})`"),
                            _ => format!("write `{known}(…)`"),
                        },
                        None if known != word => {
                            format!("write `{}`", known.replace('x', &receiver))
                        }
                        _ => format!("write `{known}({receiver})`"),
                    }
                }
            };
            let end = self.group_spans().end;
            self.skip();
            self.report.error(
                Spans::from(start).to(end),
                format!("`{receiver}.{word}(…)`: write a function before its argument"),
                help,
            );
        } else {
            let help = if self.ast.is_item {
                format!("make it a parameter of its own and write `{word}`")
            } else {
                format!(
                    "bind it before the macro, `let {word} = {receiver}.{word};`, and write `{word}`"
                )
            };
            self.report.error(
                spans,
                format!("`{receiver}.{word}`: fields are not captured"),
                help,
            );
        }
        Ok(self.push(ExprKind::Error, spans, start))
    }
}
