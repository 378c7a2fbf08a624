//! Statements.
//!
//! Input: the cursor after the header. Output: [`Ast::statements`](crate::ast::Ast::statements).
//! Invariant: a statement that cannot be read is left out and the next one is read.

use super::header::Attribute;
use super::{Abort, Parser, Result};
use crate::ast::{
    BinaryOp, Declarator, ExprKind, Expression, Function, Paths, Signature, Statement,
    StatementKind,
};
use crate::names;
use crate::tokens::{Token, TokenKind};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::ObservableKind;
use proc_macro2::{Delimiter, Ident, Span, TokenStream};

const KINDS: &str =
    "write `H(q; p) = …`, `let name = …`, `invariant name = …` or another statement";

impl Parser<'_> {
    /// All statements; `attributes` were already read and belong to the first one.
    pub(super) fn statements(&mut self, attributes: Vec<Attribute>) {
        let mut attributes = Some(attributes);
        while self.position < self.limit {
            let (start, limit) = (self.position, self.limit);
            if self.at_punct(';') {
                self.report.error(
                    self.here(),
                    "a statement is missing before this `;`",
                    "remove the `;`",
                );
                self.position += 1;
                continue;
            }
            self.pending.clear();
            self.remainders.clear();
            self.scope = None;
            self.condition = None;
            self.depth = 0;
            let mut before = attributes.take().unwrap_or_default();
            before.extend(self.attributes());
            if self.statement(before).is_err() {
                (self.position, self.limit, self.statement_limit) = (start, limit, limit);
                while self.position < self.limit && !self.at_punct(';') {
                    self.skip();
                }
                self.position += 1;
            }
        }
    }

    /// One statement with its separator.
    fn statement(&mut self, attributes: Vec<Attribute>) -> Result<()> {
        let Some(token) = self.peek().filter(|token| token.kind == TokenKind::Ident) else {
            return self.expected("a statement", KINDS);
        };
        let keyword = token.span;
        let word = token.text.as_str();
        let assumed = self.assumed(&attributes, word);
        let attributes: Vec<TokenStream> = attributes
            .into_iter()
            .filter(|attribute| attribute.word == "doc")
            .map(|attribute| attribute.tokens)
            .into_list();
        self.position += 1;
        let kind = match word {
            "let" => self.let_statement()?,
            "H" => self.hamiltonian()?,
            "L" => {
                let missing = "a Lagrangian names its coordinates and velocities";
                let (signature, value) = self.of_signature(word, "L(q; v)", missing)?;
                StatementKind::Lagrangian { signature, value }
            }
            "invariant" => self.observable(ObservableKind::Invariant, assumed)?,
            "monitor" => self.observable(ObservableKind::Monitor, false)?,
            "event" => self.observable(ObservableKind::Event, false)?,
            "split" => self.split(keyword, assumed)?,
            "force" => {
                let missing = "a force names the coordinates and momenta it acts on";
                let (signature, value) = self.of_signature(word, "force(q; p)", missing)?;
                StatementKind::Force { signature, value }
            }
            "fn" => self.function()?,
            "dt" => self.time()?,
            "coordinates" => self.coordinates()?,
            _ => return self.unknown_statement(token),
        };
        let closed = matches!(kind, StatementKind::Split { .. });
        self.ast.statements.push(Statement {
            attributes,
            keyword,
            kind,
        });
        self.separator(closed)
    }

    /// Returns true if `#[assume]` stands before an invariant or a split; reports it elsewhere.
    fn assumed(&mut self, attributes: &[Attribute], word: &str) -> bool {
        let mut assumed = false;
        for attribute in attributes {
            match attribute.word.as_str() {
                "doc" => {}
                "assume" if matches!(word, "invariant" | "split") => assumed = true,
                "assume" => self.report.error(
                    attribute.spans,
                    format!("`#[assume]` does not apply to `{word}`"),
                    "write it before an `invariant` or a `split`",
                ),
                "max_ops" => self.report.error(
                    attribute.spans,
                    "`#[max_ops]` belongs to a type",
                    "write it before `struct`",
                ),
                other => self.report.error(
                    attribute.spans,
                    format!("`#[{other}]` has no meaning on a statement"),
                    "remove it; docs and, on invariants and splits, `#[assume]` are possible",
                ),
            }
        }
        assumed
    }

    /// The `;` after a statement, or the end.
    fn separator(&mut self, optional: bool) -> Result<()> {
        if self.eat(';')
            || self.position == self.limit
            || optional
            || self.separator_missing == Some(self.position)
        {
            return Ok(());
        }
        match self.kind() {
            Some(TokenKind::Punct(',', _)) => self.abort(
                self.here(),
                "statements are separated by `;`",
                "write `;` instead of `,`",
            ),
            Some(TokenKind::Punct('=', _)) => self.abort(
                self.here(),
                "a second `=` in one statement",
                "write `;` between statements, `==` to compare in a condition",
            ),
            _ if self.begins_statement() => {
                let message = format!(
                    "a `;` is missing before `{}`",
                    self.tokens[self.position].shown()
                );
                self.report
                    .error(self.here(), message, "statements are separated by `;`");
                Ok(())
            }
            _ if self.at_word("on") => self.abort(
                self.here(),
                "`on` names the shell of an invariant",
                "write `invariant name = e on H = …`",
            ),
            _ => self.left_over("an operator or `;`"),
        }
    }

    /// Returns true if the cursor is at the beginning of a statement. An operator would be allowed
    /// there too.
    pub(super) fn begins_statement(&self) -> bool {
        let Some(token) = self.peek() else {
            return false;
        };
        let called_equals = self.kind_at(1) == Some(TokenKind::Open(Delimiter::Parenthesis)) && {
            let after = self.tokens[self.position + 1].close + 1;
            after < self.limit && matches!(self.tokens[after].kind, TokenKind::Punct('=', _))
        };
        match token.kind {
            TokenKind::Punct('#', _) => {
                self.kind_at(1) == Some(TokenKind::Open(Delimiter::Bracket))
            }
            TokenKind::Ident if matches!(token.text.as_str(), "H" | "L" | "dt") => {
                self.at_equals(1) || called_equals
            }
            TokenKind::Ident => {
                names::is_statement_word(&token.text) || self.at_equals(1) || called_equals
            }
            _ => false,
        }
    }

    fn unknown_statement<T>(&mut self, token: &Token) -> Result<T> {
        // The missing `;` before it was reported, with the remedy.
        if !self.is_plain(token) || self.separator_missing == Some(self.position - 1) {
            return Err(Abort);
        }
        let name = token.text.as_str();
        let span = token.span;
        // The one-letter words are near to every short name, so only a difference in case counts.
        let words = names::STATEMENTS.iter().copied();
        let word = match name {
            "h" | "Ham" | "Hamiltonian" | "hamiltonian" => Some("H"),
            "l" | "Lagrangian" | "lagrangian" => Some("L"),
            _ => names::nearest(name, words.filter(|word| word.len() > 1)),
        };
        if let Some(word) = word {
            let message = format!("`{name}` does not begin a statement");
            return self.abort(span, message, format!("write `{word}`"));
        }
        let mut arguments = "";
        if self.at_open(Delimiter::Parenthesis) {
            self.skip();
            arguments = "(…)";
        }
        if self.at_equals(0) && names::meaning(name).is_none() {
            let message = format!("`{name}` has no declaration");
            let help = format!("write `let {name}{arguments} = …`");
            return self.abort(span, message, help);
        }
        if name == "const" || name == "static" {
            return self.abort(
                span,
                format!("`{name}` declares nothing here"),
                "write `let name = …`",
            );
        }
        if !self.ast.is_item && self.ast.statements.is_empty() {
            return self.abort(
                span,
                format!("expected a statement, found `{name}`"),
                "write `H = …` before the expression",
            );
        }
        self.abort(span, format!("`{name}` does not begin a statement"), KINDS)
    }

    fn let_statement(&mut self) -> Result<StatementKind> {
        const FORM: &str = "write `let name = …` or `let name(x) = …`";
        if self.at_word("mut") {
            let span = self.here();
            return self.abort(
                span,
                "values do not change",
                "write `let name = …` without `mut`",
            );
        }
        self.refuse_word_before_hamiltonian("H = …")?;
        let name = self.declared("a name", FORM)?;
        let arguments = if self.at_open(Delimiter::Parenthesis) {
            Some(self.arguments(&name)?)
        } else {
            None
        };
        if self.at_punct(':') {
            return self.abort(
                self.here(),
                "values have no declared type here",
                format!("write `let {name} = …`"),
            );
        }
        if self.at_open(Delimiter::Bracket) {
            let index = self.peek_at(1).map_or("i", |token| token.text.as_str());
            let help =
                format!("write `let {name}({index}) = …`, and `{name}({index})` where it is used");
            return self.abort(
                self.group_spans(),
                "a `let` is no array: what depends on an index is a function of it",
                help,
            );
        }
        self.equals(&format!(
            "let {name}{}",
            if arguments.is_some() { "(…)" } else { "" }
        ))?;
        Ok(StatementKind::Let {
            name,
            arguments,
            value: self.right_side()?,
        })
    }

    /// `let H = …`, `fn H(q, p) …`, the cursor after the first word.
    fn refuse_word_before_hamiltonian(&mut self, form: &str) -> Result<()> {
        if !self.at_word("H") {
            return Ok(());
        }
        let word = &self.tokens[self.position - 1];
        let message = format!("`H` is defined without `{}`", word.shown());
        self.abort(word.span, message, format!("write `{form}`"))
    }

    /// `(a, b)`, names of arguments, each once.
    pub(super) fn arguments(&mut self, function: &Ident) -> Result<Vec<Ident>> {
        let is_parameter = self.tokens[self.position - 1].text == "fn";
        let form = format!("write `{function}(x)` or `{function}(x, y)`");
        let spans = self.group_spans();
        let arguments = self.members(&form, |parser| parser.declared("an argument", &form))?;
        if arguments.is_empty() {
            return self.abort(
                spans,
                "a function without arguments",
                match is_parameter {
                    true => format!("write `{function}: fn(x)`, or `{function}` for a number"),
                    false => format!("write `let {function} = …`"),
                },
            );
        }
        for (index, argument) in arguments.iter().enumerate() {
            if arguments[..index].contains(argument) {
                self.report.error(
                    argument.span(),
                    format!("the argument `{argument}` is given twice"),
                    "give each argument a name of its own",
                );
            }
        }
        Ok(arguments)
    }

    /// A comma-separated list in the parentheses at the cursor.
    pub(super) fn members<T>(
        &mut self,
        form: &str,
        mut member: impl FnMut(&mut Self) -> Result<T>,
    ) -> Result<Vec<T>> {
        let outer = self.enter();
        let mut members = Vec::new();
        while self.position != self.limit {
            members.push(member(self)?);
            if !self.eat(',') && self.position != self.limit {
                return self.expected("`,` or `)`", form);
            }
        }
        self.leave(outer);
        Ok(members)
    }

    fn hamiltonian(&mut self) -> Result<StatementKind> {
        if self.at_open(Delimiter::Parenthesis) {
            let (signature, value) = self.of_signature("H", "H(q; p)", "")?;
            let signature = Some(signature);
            return Ok(StatementKind::Hamiltonian { signature, value });
        }
        self.equals("H")?;
        Ok(StatementKind::Hamiltonian {
            signature: None,
            value: self.right_side()?,
        })
    }

    /// `(q; p) = value`, the cursor after the word; `missing` is the error if there is no
    /// parenthesis.
    fn of_signature(
        &mut self,
        word: &str,
        form: &str,
        missing: &str,
    ) -> Result<(Signature, Expression)> {
        if !self.at_open(Delimiter::Parenthesis) {
            let span = self.previous_span();
            return self.abort(span, missing, format!("write `{form} = …`"));
        }
        let signature = self.signature(form)?;
        self.equals(&format!("{word}(…)"))?;
        Ok((signature, self.right_side()?))
    }

    /// `(q, r[N]; p, s[N]; t)`, the cursor at the parenthesis.
    fn signature(&mut self, form: &str) -> Result<Signature> {
        let help = format!("write `{form}`");
        let spans = self.group_spans();
        let outer = self.enter();
        let mut sections = vec![Vec::new()];
        while self.position != self.limit {
            if self.eat(';') {
                sections.push(Vec::new());
                continue;
            }
            let name = self.declared("a name", &help)?;
            let sizes = self.sizes()?;
            if let Some(section) = sections.last_mut() {
                section.push(Declarator { name, sizes });
            }
            if !self.eat(',') && self.position != self.limit && !self.at_punct(';') {
                if self.at_punct(':') {
                    let message = "coordinates and momenta have no type here";
                    let help = "write a name, or `q[3]` for an array";
                    return self.abort(self.here(), message, help);
                }
                return self.expected("`,` or `;`", help);
            }
        }
        self.leave(outer);
        Ok(Signature { spans, sections })
    }

    fn observable(&mut self, kind: ObservableKind, assumed: bool) -> Result<StatementKind> {
        let word = kind.word();
        let name = self.declared("a name", &format!("write `{word} name = …`"))?;
        self.equals(&format!("{word} {name}"))?;
        let value = self.right_side()?;
        let mut shell = None;
        if kind == ObservableKind::Invariant && self.at_word("on") {
            self.position += 1;
            if !self.at_word("H") {
                return self.expected("`H` after `on`", "write `on H = …`");
            }
            self.position += 1;
            self.equals("on H")?;
            shell = Some(self.right_side()?);
        }
        Ok(StatementKind::Observable {
            kind,
            assumed,
            name,
            value,
            shell,
        })
    }

    fn split(&mut self, keyword: Span, assumed: bool) -> Result<StatementKind> {
        const FORM: &str = "write `split { A = …; B = … }`";
        if !self.at_open(Delimiter::Brace) {
            return self.abort(keyword, "`split` needs its pieces in braces", FORM);
        }
        let outer_limit = self.statement_limit;
        let outer = self.enter();
        self.statement_limit = self.limit;
        let mut pieces: Vec<(Ident, Expression)> = Vec::new();
        while self.position != self.limit {
            let name = self.declared("the name of a piece", FORM)?;
            if pieces.iter().any(|(other, _)| *other == name) {
                self.report.error(
                    name.span(),
                    format!("the piece `{name}` is given twice"),
                    "give each piece a name of its own",
                );
            }
            self.equals(&name.to_string())?;
            pieces.push((name, self.right_side()?));
            self.separator(false)?;
        }
        self.statement_limit = outer_limit;
        self.leave(outer);
        if pieces.len() < 2 {
            return self.abort(keyword, "`split` needs two pieces or more", FORM);
        }
        Ok(StatementKind::Split { assumed, pieces })
    }

    /// `name(a, …) = value[, (first, …)[, (second, …)]]`
    fn function(&mut self) -> Result<StatementKind> {
        const FORM: &str = "write `fn name(x) = value` or `fn name(x) = value, (derivative)`, with paths of Rust functions";
        self.refuse_word_before_hamiltonian("H(q; p) = …")?;
        let name = self.declared("a name", FORM)?;
        if !self.at_open(Delimiter::Parenthesis) {
            let message = format!("the arguments of `{name}` are missing");
            return self.abort(name.span(), message, FORM);
        }
        let arguments = self.arguments(&name)?;
        if self.at_open(Delimiter::Brace) {
            return self.abort(
                self.here(),
                "a function of the language has no body in braces",
                format!("write `let {name}(…) = …`"),
            );
        }
        self.equals(&format!("fn {name}(…)"))?;
        let value = self.rust_path(FORM)?;
        if ['+', '-', '*', '/', '^']
            .into_iter()
            .any(|sign| self.at_punct(sign))
        {
            return self.abort(
                self.here(),
                format!("`fn {name}` takes a Rust function by its path, and no formula"),
                format!("write `let {name}(…) = …`"),
            );
        }
        let first = if self.at_punct(',') || self.at_open(Delimiter::Parenthesis) {
            Some(self.path_list("the partial derivatives", FORM)?)
        } else {
            None
        };
        let second = if self.at_punct(',') {
            Some(self.path_list("the second partials", FORM)?)
        } else {
            None
        };
        Ok(StatementKind::Function(Function {
            name,
            arguments,
            value: Some(value),
            first,
            second,
        }))
    }

    /// `, (path, …)`
    fn path_list(&mut self, what: &str, form: &str) -> Result<Paths> {
        self.eat(',');
        if !self.at_open(Delimiter::Parenthesis) {
            return self.expected(&format!("{what} in parentheses"), form);
        }
        let spans = self.group_spans();
        let paths = self.members(form, |parser| parser.rust_path(form))?;
        Ok(Paths { spans, paths })
    }

    /// `dt = factor*ds`
    fn time(&mut self) -> Result<StatementKind> {
        const HELP: &str = "write `dt = (…)*ds`, with `ds` as the last factor";
        self.equals("dt")?;
        let value = self.right_side()?;
        let ds = self.ast.symbols.intern("ds");
        let node = |id: crate::ast::ExprId| &self.ast.nodes[id.0 as usize];
        let is_ds = |id| matches!(node(id).kind, ExprKind::Name(name, _) if name == ds);
        let spans = node(value.root).spans;
        let split = match node(value.root).kind {
            ExprKind::Binary(BinaryOp::Mul, left, right) if is_ds(right) => Some((left, right)),
            ExprKind::Binary(BinaryOp::Mul, left, right) if is_ds(left) => Some((right, left)),
            _ => None,
        };
        let Some((factor, word)) = split else {
            if matches!(node(value.root).kind, ExprKind::Error) {
                return Err(Abort);
            }
            return self.abort(
                spans,
                "the new time is not a factor of the right side",
                HELP,
            );
        };
        // The rest is the factor: neither the product nor `ds` is a value.
        self.ast.nodes[value.root.0 as usize].kind = ExprKind::Error;
        self.ast.nodes[word.0 as usize].kind = ExprKind::Error;
        Ok(StatementKind::Time {
            factor: Expression {
                nodes: value.nodes,
                root: factor,
            },
        })
    }

    fn coordinates(&mut self) -> Result<StatementKind> {
        const FORM: &str = "write `coordinates polar(x, y)`, `spherical(x, y, z)`, `jacobi(q, m)` or `heliocentric(q, m)`";
        let chart = self.declared("the name of the new coordinates", FORM)?;
        if !self.at_open(Delimiter::Parenthesis) {
            let message = format!("the coordinates that `{chart}` replaces are missing");
            return self.abort(chart.span(), message, FORM);
        }
        let arguments = self.members(FORM, |parser| {
            parser.declared("the name of a coordinate", FORM)
        })?;
        Ok(StatementKind::Coordinates { chart, arguments })
    }
}
