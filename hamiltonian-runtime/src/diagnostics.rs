//! Errors of a definition, with their places in its text.
//!
//! Input: the report of the language. Output: [`Diagnostics`], which prints each error with its line. Invariant: message
//! and help are those of the macro `hamiltonian!`.

use hamiltonian_language::report::{self, Spans};
use proc_macro2::{LineColumn, Span};
use std::fmt::{self, Display, Formatter};

/// A place in the text of a definition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The name of the text, such as that of its file.
    pub source: String,
    /// The line, from 1 on.
    pub line: usize,
    /// The column of the first character, from 1 on.
    pub column: usize,
}

/// `source:line:column`
impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.source, self.line, self.column)
    }
}

/// One error of a definition: the fault, its place and the remedy.
///
/// It prints the message, the place, the line with a caret below each character at fault, and the help.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The fault: one line, lower case, code in backticks.
    pub message: String,
    /// The remedy.
    pub help: String,
    /// The place of the fault.
    pub place: Place,
    /// The line of the place, and behind the last character at fault.
    pub end: [usize; 2],
    /// The text of the line.
    pub text: String,
}

impl Diagnostic {
    /// An error at some tokens of a text.
    pub(crate) fn new(message: &str, help: &str, spans: Spans, text: &str, source: &str) -> Self {
        let place = place(spans.start, source);
        let LineColumn { line, column } = spans.end.end();
        Diagnostic {
            message: message.to_owned(),
            help: help.to_owned(),
            end: [line, column + 1],
            text: (text.lines().nth(place.line - 1).unwrap_or_default()).to_owned(),
            place,
        }
    }
}

impl Display for Diagnostic {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Place { line, column, .. } = self.place;
        let margin = " ".repeat(line.to_string().len());
        let length = self.text.chars().count();
        let end = match self.end {
            [last, end] if last == line => end,
            _ => length + 1,
        };
        let carets = "^".repeat(end.saturating_sub(column).max(1));
        // A tab is kept, so that the caret stands below its character.
        let before = self.text.chars().take(column - 1);
        let before: String = before.map(|c| if c == '\t' { c } else { ' ' }).collect();
        writeln!(f, "error: {}", self.message)?;
        writeln!(f, "{margin}--> {}", self.place)?;
        writeln!(f, "{margin} |")?;
        writeln!(f, "{line} | {}", self.text)?;
        writeln!(f, "{margin} | {before}{carets}")?;
        write!(f, "{margin} = help: {}", self.help)
    }
}

/// The errors of a definition: all that the first stage with errors has found.
///
/// ```
/// use hamiltonian_runtime::Definition;
///
/// let errors = Definition::parse("H(q; p) = p^2/2 + sin(q", "pendulum.txt").unwrap_err();
/// assert_eq!(errors.list()[0].place.to_string(), "pendulum.txt:1:22");
/// let errors = Definition::parse("H(q; p) = p^2/2 + q[1]", "spring.txt").unwrap_err();
/// println!("{errors}");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostics(pub(crate) Vec<Diagnostic>);

impl Diagnostics {
    /// The errors in the order in which they were found; at least one.
    #[must_use]
    pub fn list(&self) -> &[Diagnostic] {
        &self.0
    }

    /// The errors of a report on a text.
    pub(crate) fn of(errors: &[report::Diagnostic], text: &str, source: &str) -> Self {
        let one = |error: &report::Diagnostic| {
            Diagnostic::new(&error.message, &error.help, error.spans, text, source)
        };
        Diagnostics(errors.iter().map(one).collect())
    }
}

/// Each error, with an empty line between two.
impl Display for Diagnostics {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (number, error) in self.0.iter().enumerate() {
            let between = if number > 0 { "\n\n" } else { "" };
            write!(f, "{between}{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

/// The place of a token.
pub(crate) fn place(span: Span, source: &str) -> Place {
    let LineColumn { line, column } = span.start();
    Place {
        source: source.to_owned(),
        line: line.max(1),
        column: column + 1,
    }
}
