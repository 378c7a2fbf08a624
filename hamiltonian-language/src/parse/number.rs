//! Numbers: plain decimals, exactly.
//!
//! Input: a literal token. Output: a node with the exact number. Invariant: a literal that is not a
//! plain decimal number in the range of f64 is reported and becomes [`ExprKind::Error`].

use super::Parser;
use crate::ast::{ExprId, ExprKind};
use crate::report::Spans;
use crate::tokens::{Token, TokenKind};
use hamiltonian_symbolic::rational::Rational;
use proc_macro2::Delimiter;

/// Suffixes by which Rust gives a number a type.
const TYPES: &[&str] = &[
    "f64", "f32", "f16", "f128", "i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32",
    "u64", "u128", "usize",
];

/// The largest number of digits. The longest exact decimal of an f64 has 767.
const MOST_DIGITS: usize = 1000;

/// The largest power of ten in a literal.
const LARGEST_EXPONENT: i64 = 2000;

impl Parser<'_> {
    /// The literal at the cursor as an operand.
    pub(super) fn number_node(&mut self) -> ExprId {
        let token = &self.tokens[self.position];
        let divided = self.position > 0
            && self.tokens[self.position - 1].kind == TokenKind::Punct('/', false);
        self.position += 1;
        let kind = match self.number(token, divided) {
            Some(number) => ExprKind::Number(number),
            None => {
                // `2sin(x)`: the parentheses belong to the function inside the literal.
                if token
                    .text
                    .ends_with(|c: char| c.is_alphabetic() || c == '_')
                    && self.at_open(Delimiter::Parenthesis)
                {
                    self.skip();
                }
                ExprKind::Error
            }
        };
        self.push(kind, Spans::from(token.span), token.span)
    }

    /// The value of a literal, or an error. `divided`: a `/` stands before it.
    pub(super) fn number(&mut self, token: &Token, divided: bool) -> Option<Rational> {
        let text = token.text.as_str();
        let span = token.span;
        if !text.starts_with(|c: char| c.is_ascii_digit()) {
            self.report.error(
                span,
                format!("{text} is not a number"),
                "write a decimal number",
            );
            return None;
        }
        if let Some((radix, digits)) = radix(text) {
            let value = u128::from_str_radix(&digits.replace('_', ""), radix).ok();
            let help = match value {
                Some(value) => format!("write `{value}`"),
                None => "write it in decimal".into(),
            };
            self.report
                .error(span, format!("`{text}` is not a decimal number"), help);
            return None;
        }
        let (digits, suffix) = split_suffix(text);
        if TYPES.contains(&suffix) {
            self.report.error(
                span,
                format!("`{text}` has a type, but numbers are exact here and have none"),
                format!("write `{digits}`"),
            );
            return None;
        }
        if !suffix.is_empty() {
            let call = if self.at_open(Delimiter::Parenthesis) {
                "(…)"
            } else {
                ""
            };
            let product = format!("{digits}*{suffix}{call}");
            let help = if divided {
                format!(
                    "write `({product})` to divide by the product, `{product}` to multiply by `{suffix}{call}` afterwards"
                )
            } else {
                format!("write `{product}`")
            };
            self.report
                .error(span, format!("`{text}` is not a product"), help);
            return None;
        }
        let plain = digits.replace('_', "");
        let count = plain.bytes().filter(u8::is_ascii_digit).count();
        if count > MOST_DIGITS {
            let start: String = plain.chars().take(20).collect();
            self.report.error(
                span,
                format!("`{start}…` has {count} digits, more than {MOST_DIGITS}"),
                "write the digits that count: an f64 keeps 17",
            );
            return None;
        }
        let Ok(rounded) = plain.parse::<f64>() else {
            self.report.error(
                span,
                format!("`{text}` is not a decimal number"),
                "write a decimal number",
            );
            return None;
        };
        let exponent = plain.split(['e', 'E']).nth(1);
        let is_long = |text: &str| !text.parse().is_ok_and(|n: i64| n.abs() <= LARGEST_EXPONENT);
        // Simplification may bring a number into the range of f64.
        let is_out = exponent.is_some_and(is_long);
        if rounded.is_infinite() && is_out {
            self.report.error(
                span,
                format!("`{text}` is larger than any f64"),
                "write a number up to 1.7e308",
            );
            return None;
        }
        let mantissa = plain.split(['e', 'E']).next();
        if mantissa.is_some_and(|digits| digits.bytes().all(|digit| matches!(digit, b'0' | b'.'))) {
            return Some(Rational::ZERO);
        }
        if rounded == 0.0 && is_out {
            self.report.error(
                span,
                format!("`{text}` is smaller than any f64 but not 0"),
                "write `0`, or a number from 1e-323",
            );
            return None;
        }
        let number = Rational::decimal(&plain);
        if number.is_none() {
            let fault = format!("`{text}` is not read exactly");
            self.report.internal(span, &fault);
        }
        number
    }
}

fn radix(text: &str) -> Option<(u32, &str)> {
    let radix = match text.get(..2)? {
        "0x" => 16,
        "0o" => 8,
        "0b" => 2,
        _ => return None,
    };
    Some((radix, &text[2..]))
}

/// `"2.5e3q"` → `("2.5e3", "q")`.
fn split_suffix(text: &str) -> (&str, &str) {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while at < bytes.len() && (bytes[at].is_ascii_digit() || bytes[at] == b'_') {
            at += 1;
        }
        at
    };
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
            end = digits(end + 1 + sign);
        }
    }
    let (number, suffix) = text.split_at(end);
    (number.trim_end_matches('_'), suffix)
}
