//! The words of both notations.
//!
//! Input: a notation. Output: [`Words`]. Invariant: expressions that both notations write in the
//! same order differ in these words alone.

use super::Notation;
use super::layout::Level;
use crate::dag::Relation;

/// The words between the parts of an expression.
#[derive(Debug)]
pub(super) struct Words {
    pub(super) pi: &'static str,
    /// Parentheses, of arguments too.
    pub(super) open: &'static str,
    pub(super) close: &'static str,
    /// a < b, a ≤ b, a = b
    relations: [&'static str; 3],
    /// a ≥ b, a > b, a ≠ b
    opposites: [&'static str; 3],
    pub(super) not: &'static str,
    pub(super) and: &'static str,
    pub(super) or: &'static str,
    /// The least precedence of the body of a sum over a loop, and the word that ends it.
    pub(super) body: Level,
    pub(super) end: &'static str,
    /// The sign of an omission.
    pub(super) ellipsis: &'static str,
    pub(super) modulo: &'static str,
    /// Between a number and the name of a loop or a size.
    pub(super) times: &'static str,
}

impl Words {
    pub(super) fn relation(&self, relation: Relation) -> &'static str {
        self.relations[relation as usize]
    }
    pub(super) fn opposite(&self, relation: Relation) -> &'static str {
        self.opposites[relation as usize]
    }
}

const TEXT: Words = Words {
    pi: "pi",
    open: "(",
    close: ")",
    relations: [" < ", " <= ", " == "],
    opposites: [" >= ", " > ", " != "],
    not: "!",
    and: " && ",
    or: " || ",
    body: Level::Loose,
    end: " }",
    ellipsis: "…",
    modulo: "%",
    times: "*",
};

const LATEX: Words = Words {
    pi: "\\pi",
    open: "\\left(",
    close: "\\right)",
    relations: [" < ", " \\le ", " = "],
    opposites: [" \\ge ", " > ", " \\ne "],
    not: "\\lnot ",
    and: " \\land ",
    or: " \\lor ",
    body: Level::Product,
    end: "",
    ellipsis: "\\dots",
    modulo: "\\bmod",
    times: " ",
};

impl Notation {
    pub(super) fn words(self) -> &'static Words {
        match self {
            Notation::Text => &TEXT,
            Notation::Latex => &LATEX,
        }
    }
}
