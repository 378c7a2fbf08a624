//! Words with their places in the file.
//!
//! Input: a line. Output: its words, and errors at them.

use crate::{Diagnostic, Place};

/// A part of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word<'a> {
    pub text: &'a str,
    /// The line it stands in, its number from 1 on, and the place of its first byte there.
    line: &'a str,
    number: usize,
    at: usize,
    /// The name of the file.
    file: &'a str,
}

impl<'a> Word<'a> {
    /// A whole line.
    pub fn line(line: &'a str, number: usize, file: &'a str) -> Self {
        Word {
            text: line,
            line,
            number,
            at: 0,
            file,
        }
    }

    /// The part from one byte to another, without spaces around it.
    pub fn part(&self, from: usize, to: usize) -> Word<'a> {
        let text = &self.text[from..to];
        let before = text.len() - text.trim_start().len();
        Word {
            text: text.trim(),
            at: self.at + from + before,
            ..*self
        }
    }

    /// The parts before and behind the first sign of this kind.
    pub fn split(&self, sign: &str) -> Option<(Word<'a>, Word<'a>)> {
        let at = self.text.find(sign)?;
        let behind = at + sign.len();
        Some((self.part(0, at), self.part(behind, self.text.len())))
    }

    /// The parts between the commas that are in no brackets.
    pub fn list(&self) -> Vec<Word<'a>> {
        let mut depth = 0_i32;
        let mut from = 0;
        let mut parts = Vec::new();
        for (at, sign) in self.text.char_indices() {
            match sign {
                '[' | '(' => depth += 1,
                ']' | ')' => depth -= 1,
                ',' if depth == 0 => {
                    parts.push(self.part(from, at));
                    from = at + 1;
                }
                _ => {}
            }
        }
        let last = self.part(from, self.text.len());
        if !last.text.is_empty() || !parts.is_empty() {
            parts.push(last);
        }
        parts
    }

    /// An error here.
    pub fn error(&self, message: impl Into<String>, help: impl Into<String>) -> Box<Diagnostic> {
        let column = self.line[..self.at].chars().count() + 1;
        let length = self.text.chars().count().max(1);
        Box::new(Diagnostic {
            message: message.into(),
            help: help.into(),
            place: Place {
                source: self.file.to_owned(),
                line: self.number,
                column,
            },
            end: [self.number, column + length],
            text: self.line.to_owned(),
        })
    }
}
