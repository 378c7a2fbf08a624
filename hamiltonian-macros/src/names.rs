//! The words of the language: functions, constants, statement words.
//!
//! Input: a name. Output: what the language means by it, or the known name nearest to it.
//! Invariant: every word stands here once; parser, checker and messages read this table.

/// A function of the language. S is a scalar, V a vector; V, V of equal extent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[rustfmt::skip]
pub enum Builtin {
    Sin, Cos, Tan, Asin, Acos, Atan, Atan2,
    Sinh, Cosh, Tanh, Asinh, Acosh, Atanh,
    Exp, ExpM1, Ln, Ln1p, Sqrt, Cbrt, Hypot, Pow,
    Abs, Sign, Min, Max,
    Dot, Norm, NormSquared, Cross,
    Bracket,
}

/// What the arguments of a function are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// S, … → S
    Scalars,
    /// V, … → S
    Vectors,
    /// `[3]`, `[3]` → `[3]`
    Space,
}

/// A function with what is said of it.
#[derive(Debug)]
pub struct Entry {
    /// The function.
    pub function: Builtin,
    /// Its name.
    pub name: &'static str,
    /// Its arguments as they are written.
    pub arguments: &'static [&'static str],
    /// What they are.
    pub domain: Domain,
    /// What it is.
    pub doc: &'static str,
}

const fn entry(
    function: Builtin,
    name: &'static str,
    arguments: &'static [&'static str],
    domain: Domain,
    doc: &'static str,
) -> Entry {
    Entry {
        function,
        name,
        arguments,
        domain,
        doc,
    }
}

/// All functions of the language.
#[rustfmt::skip]
pub const FUNCTIONS: &[Entry] = {
    use Domain::{Scalars, Space, Vectors};
    &[
        entry(Builtin::Sin, "sin", &["x"], Scalars, "sine"),
        entry(Builtin::Cos, "cos", &["x"], Scalars, "cosine"),
        entry(Builtin::Tan, "tan", &["x"], Scalars, "tangent"),
        entry(Builtin::Asin, "asin", &["x"], Scalars, "inverse sine, in [-π/2, π/2]"),
        entry(Builtin::Acos, "acos", &["x"], Scalars, "inverse cosine, in [0, π]"),
        entry(Builtin::Atan, "atan", &["x"], Scalars, "inverse tangent, in (-π/2, π/2)"),
        entry(Builtin::Atan2, "atan2", &["y", "x"], Scalars, "angle of the point (x, y), in (-π, π]"),
        entry(Builtin::Sinh, "sinh", &["x"], Scalars, "hyperbolic sine"),
        entry(Builtin::Cosh, "cosh", &["x"], Scalars, "hyperbolic cosine"),
        entry(Builtin::Tanh, "tanh", &["x"], Scalars, "hyperbolic tangent"),
        entry(Builtin::Asinh, "asinh", &["x"], Scalars, "inverse hyperbolic sine"),
        entry(Builtin::Acosh, "acosh", &["x"], Scalars, "inverse hyperbolic cosine"),
        entry(Builtin::Atanh, "atanh", &["x"], Scalars, "inverse hyperbolic tangent"),
        entry(Builtin::Exp, "exp", &["x"], Scalars, "exponential"),
        entry(Builtin::ExpM1, "exp_m1", &["x"], Scalars, "exp(x) - 1, accurate near 0"),
        entry(Builtin::Ln, "ln", &["x"], Scalars, "natural logarithm"),
        entry(Builtin::Ln1p, "ln_1p", &["x"], Scalars, "ln(1 + x), accurate near 0"),
        entry(Builtin::Sqrt, "sqrt", &["x"], Scalars, "square root"),
        entry(Builtin::Cbrt, "cbrt", &["x"], Scalars, "cube root"),
        entry(Builtin::Hypot, "hypot", &["x", "y"], Scalars, "sqrt(x^2 + y^2)"),
        entry(Builtin::Pow, "pow", &["x", "y"], Scalars, "x^y"),
        entry(Builtin::Abs, "abs", &["x"], Scalars, "absolute value"),
        entry(Builtin::Sign, "sign", &["x"], Scalars, "-1, 0 or 1; sign(0) = 0"),
        entry(Builtin::Min, "min", &["x", "y"], Scalars, "the smaller of two"),
        entry(Builtin::Max, "max", &["x", "y"], Scalars, "the larger of two"),
        entry(Builtin::Dot, "dot", &["a", "b"], Vectors, "scalar product"),
        entry(Builtin::Norm, "norm", &["a"], Vectors, "length of a vector"),
        entry(Builtin::NormSquared, "norm_squared", &["a"], Vectors, "squared length of a vector"),
        entry(Builtin::Cross, "cross", &["a", "b"], Space, "vector product in space"),
        entry(Builtin::Bracket, "bracket", &["a", "b"], Scalars, "Poisson bracket {a, b}"),
    ]
};

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

/// Words that cannot name anything. `L` is not among them: it begins a statement only where a
/// signature follows, and inductances and angular momenta are called so.
const RESERVED: &[&str] = &[
    "let",
    "H",
    "invariant",
    "monitor",
    "event",
    "split",
    "force",
    "fn",
    "dt",
    "ds",
    "coordinates",
    "sum",
    "if",
    "else",
    "in",
    "on",
];

/// The function of a name.
pub fn function(name: &str) -> Option<&'static Entry> {
    FUNCTIONS.iter().find(|entry| entry.name == name)
}
