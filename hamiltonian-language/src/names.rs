//! The words of the language: functions, constants, statement words.
//!
//! Input: a name. Output: its meaning, or the known name nearest to it. Invariant: every word
//! stands here once, except elementary functions, which are in the engine's operation table.
//! Parser, checker and messages read these tables.

use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::op::Op;

/// A function of the language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Builtin {
    /// Scalars → a scalar, described by its row in the operation table.
    Elementary(Op),
    /// The Poisson bracket: scalars → a scalar.
    Bracket,
    /// Vectors of equal extent → a scalar.
    Dot,
    /// A vector → a scalar.
    Norm,
    /// A vector → a scalar.
    NormSquared,
    /// `[3]`, `[3]` → `[3]`
    Cross,
}

/// A function with its name and arguments.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The function.
    pub function: Builtin,
    /// Its name.
    pub name: &'static str,
    /// Its arguments as they are written.
    pub arguments: &'static [&'static str],
}

/// The functions that are not elementary.
const OTHERS: [Entry; 5] = {
    const fn entry(
        function: Builtin,
        name: &'static str,
        arguments: &'static [&'static str],
    ) -> Entry {
        Entry {
            function,
            name,
            arguments,
        }
    }
    [
        entry(Builtin::Dot, "dot", &["a", "b"]),
        entry(Builtin::Norm, "norm", &["a"]),
        entry(Builtin::NormSquared, "norm_squared", &["a"]),
        entry(Builtin::Cross, "cross", &["a", "b"]),
        entry(Builtin::Bracket, "bracket", &["a", "b"]),
    ]
};

/// All functions of the language: the operation table, and those that are not elementary.
pub fn functions() -> impl Iterator<Item = Entry> {
    // A remainder ≥ 0 is written `x % y`.
    let called = Op::all().iter().filter(|op| **op != Op::Modulo);
    let elementary = called.map(|op| Entry {
        function: Builtin::Elementary(*op),
        name: op.row().name,
        arguments: op.row().arguments,
    });
    elementary.chain(OTHERS)
}

impl Entry {
    /// As it is written: `atan2(y, x)`.
    pub fn signature(&self) -> String {
        format!("{}({})", self.name, self.arguments.join(", "))
    }
}

/// The constants.
pub const CONSTANTS: &[&str] = &["pi"];

/// Words that begin a statement.
pub const STATEMENTS: &[&str] = &[
    "let",
    "H",
    "L",
    "invariant",
    "monitor",
    "event",
    "split",
    "force",
    "fn",
    "dt",
    "coordinates",
];

/// Words inside expressions and statements that cannot name anything either.
const RESERVED: &[&str] = &["ds", "sum", "if", "else", "in", "on"];

/// Functions that a name of the definition hides: definitions used these names before they were functions.
const HIDDEN: &[&str] = &["floor", "round", "remainder"];

/// Names of functions and constants in other languages.
const SYNONYMS: &[(&str, &str)] = &[
    ("log", "ln"),
    ("log10", "ln(x)/ln(10)"),
    ("log2", "ln(x)/ln(2)"),
    ("log1p", "ln_1p"),
    ("expm1", "exp_m1"),
    ("arcsin", "asin"),
    ("arccos", "acos"),
    ("arctan", "atan"),
    ("arctan2", "atan2"),
    ("arsinh", "asinh"),
    ("arcsinh", "asinh"),
    ("arcosh", "acosh"),
    ("arccosh", "acosh"),
    ("artanh", "atanh"),
    ("arctanh", "atanh"),
    ("tg", "tan"),
    ("sh", "sinh"),
    ("ch", "cosh"),
    ("th", "tanh"),
    ("fabs", "abs"),
    ("sgn", "sign"),
    ("mod", "x % y"),
    ("fmod", "x % y"),
    ("rem", "remainder"),
    ("rint", "round"),
    ("ceil", "-floor(-x)"),
    ("signum", "sign"),
    ("power", "pow"),
    ("powi", "pow"),
    ("powf", "pow"),
    ("root", "sqrt"),
    ("sqr", "x^2"),
    ("square", "x^2"),
    ("length", "norm"),
    ("magnitude", "norm"),
    ("norm2", "norm_squared"),
    ("inner", "dot"),
    ("poisson", "bracket"),
    ("not", "!(x)"),
    ("PI", "pi"),
    ("Pi", "pi"),
    ("π", "pi"),
];

/// Keywords of Rust, which cannot be names of fields or variables in emitted code.
#[rustfmt::skip]
const RUST_KEYWORDS: &[&str] = &[
    "as", "async", "await", "break", "const", "continue", "crate", "dyn", "else", "enum", "extern", "false", "fn",
    "for", "gen", "if", "impl", "in", "let", "loop", "match", "mod", "move", "mut", "pub", "ref", "return", "self",
    "Self", "static", "struct", "super", "trait", "true", "type", "unsafe", "use", "where", "while", "abstract",
    "become", "box", "do", "final", "macro", "override", "priv", "try", "typeof", "unsized", "virtual", "yield",
];

/// Methods of every system, which an observable of the same name would hide.
#[rustfmt::skip]
const METHODS: &[&str] = &[
    "energy", "gradient", "description", "prepare", "zeros", "new", "default", "with_defaults", "clone", "fmt", "velocity", "conjugate_momentum",
    "observable", "flow", "kick", "drift", "hessian_vector", "time_derivative", "check_shape",
];

/// The function of a name.
pub fn function(name: &str) -> Option<Entry> {
    functions().find(|entry| entry.name == name)
}

/// Returns true if a declared or captured name hides the function of that name.
pub fn is_hidden(name: &str) -> bool {
    HIDDEN.contains(&name)
}

/// The meaning of a reserved word.
pub fn meaning(name: &str) -> Option<&'static str> {
    if name == "H" {
        Some("the Hamiltonian")
    } else if function(name).is_some() && !is_hidden(name) {
        Some("a function of the language")
    } else if CONSTANTS.contains(&name) {
        Some("a constant of the language")
    } else if RESERVED.contains(&name) || is_statement_word(name) && name != "L" {
        // `L` may be a name, for example of an angular momentum: a statement that defines a
        // Lagrangian has a signature.
        Some("a word of the language")
    } else {
        None
    }
}

/// Returns true if a word begins a statement.
pub fn is_statement_word(name: &str) -> bool {
    STATEMENTS.contains(&name)
}

/// Returns true if a word is a keyword of Rust but not of the language.
pub fn is_foreign(word: &str) -> bool {
    is_rust_keyword(word) && !is_statement_word(word) && !matches!(word, "if" | "else" | "in")
}

/// Returns true if Rust reserves a word.
pub fn is_rust_keyword(name: &str) -> bool {
    RUST_KEYWORDS.contains(&name)
}

/// Returns true if every system has a method of this name.
pub fn is_method(name: &str) -> bool {
    METHODS.contains(&name)
}

/// The name in this language of a function that others call `name`.
pub fn synonym(name: &str) -> Option<&'static str> {
    SYNONYMS
        .iter()
        .find(|(other, _)| *other == name)
        .map(|(_, known)| *known)
}

/// The names with commas between them.
pub fn listed(names: impl IntoIterator<Item = impl ToString>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| name.to_string()).into_list();
    names.join(", ")
}

/// The candidate nearest to a name: equal except for case, or at most one edit per three letters
/// away. The first of equally near ones.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters: Vec<char> = name.chars().into_list();
    let allowed = if letters.len() < 2 {
        0
    } else {
        (letters.len() / 3).max(1)
    };
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        if candidate == name {
            continue;
        }
        let distance = if candidate.to_lowercase() == name.to_lowercase() {
            0
        } else {
            let other: Vec<char> = candidate.chars().into_list();
            if other.len().abs_diff(letters.len()) > allowed || letters.len() > 64 {
                continue;
            }
            edits(&letters, &other)
        };
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The number of insertions, deletions, replacements and swaps of neighbours between two words.
fn edits(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=b.len()).into_list();
    for i in 1..=a.len() {
        let mut next = vec![i];
        for j in 1..=b.len() {
            let replaced = row[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(row[j] + 1).min(next[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(before[j - 2] + 1);
            }
            next.push(least);
        }
        before = std::mem::replace(&mut row, next);
    }
    row[b.len()]
}
