//! The header of item form: attributes, visibility, `struct Name<const N: usize> { parameters }`.
//!
//! Input: the cursor at the beginning of the definition. Output: [`Item`]. It is in the tree as
//! soon as its name was read, so that the stub has the name even after an error. Invariant: a bad
//! parameter does not hide the next one.

use super::{Parser, Result};
use crate::ast::{AXES, Expression, Header, Item, ParameterEntry, ParameterKind, Size};
use crate::report::Spans;
use crate::tokens::TokenKind;
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};

/// `#[word …]`.
pub(super) struct Attribute {
    /// All of it.
    pub tokens: TokenStream,
    /// Its first word.
    pub word: String,
    pub spans: Spans,
    /// The tokens after the first word.
    rest: (usize, usize),
}

const SIZE: &str = "write a number or the name of a size, or their product: `[3]`, `[N]`, `[n*m]`";
const STRUCT: &str = "write `pub struct Name { m = 1.0 }` and the statements after it";

impl Parser<'_> {
    /// Attributes and docs at the cursor.
    pub(super) fn attributes(&mut self) -> Vec<Attribute> {
        let mut found = Vec::new();
        while self.at_punct('#') {
            let start = self.here();
            let inner = matches!(self.kind_at(1), Some(TokenKind::Punct('!', _)));
            let length = if inner { 2 } else { 1 };
            if self.kind_at(length) != Some(TokenKind::Open(Delimiter::Bracket)) {
                break;
            }
            let mut tokens = TokenStream::new();
            tokens.extend(self.tokens[self.position].tree.clone());
            self.position += length;
            tokens.extend(self.tokens[self.position].tree.clone());
            let spans = Spans::from(start).to(self.group_spans());
            if inner {
                self.report.error(
                    spans,
                    "inner docs and attributes have no place here",
                    "write `///` or `#[…]` before the item or parameter they describe",
                );
            }
            let close = self.tokens[self.position].close;
            let word = self.tokens[self.position + 1].text.clone();
            found.push(Attribute {
                tokens,
                word,
                spans,
                rest: (self.position + 2, close),
            });
            self.position = close + 1;
        }
        found
    }

    /// Returns true if an item stands at the cursor, after its attributes.
    pub(super) fn at_item(&self) -> bool {
        ["pub", "struct", "enum", "type", "mod", "impl"]
            .iter()
            .any(|word| self.at_word(word))
            || (self.at_word("crate") && self.kind_at(1) == Some(TokenKind::Ident))
    }

    /// The header, after its attributes.
    pub(super) fn item(&mut self, attributes: Vec<Attribute>) -> Result<()> {
        let mut visibility = TokenStream::new();
        if self.at_word("pub") {
            visibility.extend(self.tokens[self.position].tree.clone());
            self.position += 1;
            if self.at_open(Delimiter::Parenthesis) {
                visibility.extend(self.tokens[self.position].tree.clone());
                self.skip();
            }
        }
        if !self.at_word("struct") {
            return self.expected("`struct`", STRUCT);
        }
        self.position += 1;
        let name = self.declared("the name of the type", STRUCT)?;
        let mut item = Item {
            header: Header {
                attributes: Vec::new(),
                max_ops: None,
                visibility,
                name,
            },
            generics: Vec::new(),
            parameters: Vec::new(),
        };
        let read = self.header(&mut item, attributes);
        self.ast.item = Some(item);
        read
    }

    /// The attributes of an item, and its sizes and parameters, which stand after its name.
    fn header(&mut self, item: &mut Item, attributes: Vec<Attribute>) -> Result<()> {
        for attribute in attributes {
            if attribute.word == "max_ops" {
                self.max_ops(item, &attribute);
            } else {
                item.header.attributes.push(attribute.tokens);
            }
        }
        if self.eat('<') {
            self.generics(item)?;
        }
        if !self.at_open(Delimiter::Brace) {
            let name = &item.header.name;
            return self.expected(
                &format!("`{{` and the parameters of `{name}`"),
                format!("write `struct {name} {{}}` if it has no parameters"),
            );
        }
        let outer = self.enter();
        self.parameters(item);
        self.leave(outer);
        Ok(())
    }

    /// `#[max_ops = 40]`, once.
    fn max_ops(&mut self, item: &mut Item, attribute: &Attribute) {
        let number = match &self.tokens[attribute.rest.0..attribute.rest.1] {
            [equals, number] if matches!(equals.kind, TokenKind::Punct('=', _)) => {
                let value = number.text.replace('_', "").parse().ok();
                value.map(|value| (value, number.span))
            }
            _ => None,
        };
        let twice = item.header.max_ops.is_some();
        if twice || number.is_none() {
            let (message, help) = if twice {
                ("`max_ops` is given twice", "keep one")
            } else {
                (
                    "`max_ops` takes a number of operations",
                    "write `#[max_ops = 40]`",
                )
            };
            self.report.error(attribute.spans, message, help);
        }
        item.header.max_ops = number.or(item.header.max_ops);
    }

    /// `const N: usize, …>`, the cursor after `<`.
    fn generics(&mut self, item: &mut Item) -> Result<()> {
        const FORM: &str = "only sizes are allowed between `<` and `>`: write `<const N: usize>`";
        loop {
            if self.eat('>') {
                return Ok(());
            }
            if !self.at_word("const") {
                return self.expected("`const`", FORM);
            }
            self.position += 1;
            let name = self.declared("the name of a size", FORM)?;
            let is_usize =
                self.at_punct(':') && self.peek_at(1).is_some_and(|token| token.text == "usize");
            if !is_usize {
                let message = format!("the size `{name}` is not declared as `usize`");
                return self.abort(name.span(), message, format!("write `const {name}: usize`"));
            }
            self.position += 2;
            if self.at_punct('=') {
                return self.abort(
                    self.here(),
                    "sizes have no default",
                    format!("write `const {name}: usize`"),
                );
            }
            item.generics.push(name);
            if !self.eat(',') && !self.at_punct('>') {
                return self.expected("`,` or `>`", FORM);
            }
        }
    }

    /// The entries between the braces, the cursor inside.
    fn parameters(&mut self, item: &mut Item) {
        while self.position < self.limit {
            let (start, limit) = (self.position, self.limit);
            match self.parameter() {
                Ok(parameter) => item.parameters.push(parameter),
                Err(_) => {
                    (self.position, self.limit) = (start, limit);
                    while self.position < self.limit && !self.at_punct(',') {
                        self.skip();
                    }
                }
            }
            self.position += 1;
        }
    }

    /// One parameter, up to its comma.
    fn parameter(&mut self) -> Result<ParameterEntry> {
        const FORM: &str =
            "write `name = 1.0`, `name`, `name: usize`, `name: [N]` or `name: fn(x)`";
        let attributes = self.attributes();
        for attribute in &attributes {
            if matches!(attribute.word.as_str(), "cfg" | "cfg_attr") {
                self.report.error(
                    attribute.spans,
                    "a parameter cannot depend on the configuration: H does not",
                    "write two definitions and choose between them by `#[cfg(…)]`",
                );
            }
        }
        if self.at_word("pub") {
            return self.abort(
                self.here(),
                "parameters are as visible as their struct",
                "remove `pub`",
            );
        }
        let name = self.declared("the name of a parameter", FORM)?;
        let kind = if self.at_equals(0) {
            self.position += 1;
            ParameterKind::Scalar(Some(self.default_value(&name, "1.0")?))
        } else if self.eat(':') {
            self.parameter_type(&name)?
        } else {
            ParameterKind::Scalar(None)
        };
        if self.position < self.limit && !self.at_punct(',') {
            let (message, help) = match self.kind() {
                Some(TokenKind::Punct(';', _)) => (
                    "parameters are separated by `,`".to_owned(),
                    "write `,` instead of `;`",
                ),
                Some(TokenKind::Punct('=', _)) => (
                    "sizes have no default".into(),
                    "remove it and give the value to `new`",
                ),
                _ => (
                    format!("expected `,` after `{name}`, {}", self.found()),
                    FORM,
                ),
            };
            return self.abort(self.here(), message, help);
        }
        let attributes = attributes
            .into_iter()
            .map(|attribute| attribute.tokens)
            .into_list();
        Ok(ParameterEntry {
            attributes,
            name,
            kind,
        })
    }

    /// The expression of numbers after `=`.
    fn default_value(&mut self, name: &Ident, form: &str) -> Result<Expression> {
        if self.position >= self.limit || self.at_punct(',') {
            return self.expected(
                &format!("a number as the default of `{name}`"),
                format!("write `{name} = {form}`, or `{name}` for a parameter without default"),
            );
        }
        self.right_side()
    }

    /// `usize`, `[s]`, `[s][s]`, `fn(a, …)`, after the colon.
    fn parameter_type(&mut self, name: &Ident) -> Result<ParameterKind> {
        if self.at_open(Delimiter::Bracket) {
            let sizes = self.sizes()?;
            let default = if self.at_equals(0) {
                self.position += 1;
                Some(self.default_value(name, "[1.0, 2.0]")?)
            } else {
                None
            };
            return Ok(ParameterKind::Array(sizes, default));
        }
        let Some(token) = self.peek().filter(|token| token.kind == TokenKind::Ident) else {
            return self.expected(
                &format!("`usize` or the extents of `{name}`"),
                format!("write `{name}: usize` for a size or `{name}: [N]` for an array"),
            );
        };
        if token.text == "usize" {
            self.position += 1;
            return Ok(ParameterKind::Size);
        }
        if token.text == "fn" {
            self.position += 1;
            if !self.at_open(Delimiter::Parenthesis) {
                let message = format!("the arguments of `{name}` are missing");
                return self.abort(name.span(), message, format!("write `{name}: fn(x)`"));
            }
            let arguments = self.arguments(name)?;
            if self.at_equals(0) {
                return self.abort(
                    self.here(),
                    "a parameter that is a function has no default",
                    "remove it and give the function to `new`",
                );
            }
            return Ok(ParameterKind::Function(arguments));
        }
        self.abort(
            token.span,
            format!(
                "`{name}` has no type of its own: `{}` is neither `usize`, nor `fn`, nor an array",
                token.text
            ),
            format!(
                "write `{name}` for a scalar, `{name} = 1.0` for one with a default, `{name}: [N]` for an array, `{name}: fn(x)` for a function"
            ),
        )
    }

    /// `[s]`, `[s][s]`, the cursor at the first bracket.
    pub(super) fn sizes(&mut self) -> Result<Vec<Size>> {
        let mut sizes = Vec::new();
        while self.at_open(Delimiter::Bracket) {
            let spans = self.group_spans();
            let outer = self.enter();
            let mut factors = vec![self.size(spans)?];
            while self.eat('*') {
                factors.push(self.size(spans)?);
            }
            if self.position != self.limit {
                let (message, help) = match self.kind() {
                    Some(TokenKind::Punct(';', _)) => (
                        "numbers have no type here".to_owned(),
                        "write `[3]`, not `[f64; 3]`",
                    ),
                    Some(TokenKind::Punct(',', _)) => (
                        "each extent has brackets of its own".into(),
                        "write `[n][3]`",
                    ),
                    _ => (
                        "a size is a number, a name, or a product of them".into(),
                        SIZE,
                    ),
                };
                return self.abort(self.here(), message, help);
            }
            self.leave(outer);
            if sizes.len() == AXES {
                return self.abort(
                    spans,
                    "arrays have at most four extents",
                    "write `[n][m][k][3]`, or several arrays",
                );
            }
            sizes.push(match factors.len() {
                1 => factors.remove(0),
                _ => Size::Product(factors),
            });
        }
        Ok(sizes)
    }

    fn size(&mut self, spans: Spans) -> Result<Size> {
        let Some(token) = self.peek() else {
            return self.abort(spans, "a size is missing", SIZE);
        };
        match (token.kind, &token.tree) {
            (TokenKind::Literal, _) => {
                let value = token.text.replace('_', "").parse::<u64>().ok();
                self.position += 1;
                match value {
                    Some(value) if value > 0 && value <= u64::from(u32::MAX) => {
                        Ok(Size::Literal(value, token.span))
                    }
                    _ => self.abort(
                        token.span,
                        format!("`{}` is not a size", token.text),
                        "write a whole number from 1 to 4294967295",
                    ),
                }
            }
            (TokenKind::Ident, Some(TokenTree::Ident(ident))) => {
                if !self.is_plain(token) {
                    return Err(super::Abort);
                }
                self.position += 1;
                Ok(Size::Name(ident.clone()))
            }
            _ => self.expected("a size", SIZE),
        }
    }
}
