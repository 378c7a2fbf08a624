//! The definition as it was written: statements over one arena of expressions.
//!
//! Input: none (built by `parse`). Output: [`Ast`]. Only `check` reads it, and resolves it into
//! [`crate::checked::Checked`]. Invariants:
//!
//! - A node's children, and the nodes its meaning depends on, have smaller indices than the node, so
//!   that every pass over expressions is a forward loop and depth costs no stack. A
//!   [`ExprKind::Bind`] stands after the bounds of its loop variable and before the body of the sum.
//! - The nodes of one [`Expression`] are contiguous.
//! - The `%` of an index is [`ExprKind::Index::modulo`], that of numbers [`BinaryOp::Rem`]; `ds` was taken out of `dt = g*ds`.
//! - No identifier is raw, `_`, or holds a `·`.
//!
//! Decisions where the description of the language leaves a choice:
//!
//! - A `let` uses only names defined above it; `H` may be used below its definition, and anywhere in
//!   invariants, monitors, events, forces and pieces, which may also precede it.
//! - Arguments of a `let` function hide outer names and have the shapes of the arguments of the
//!   call, so that `let d(i) = q[i + 1] - q[i]` works; a loop variable hides nothing.
//! - `invariant name = e on H = shell`; `#[assume]` and docs stand before a statement.
//! - Under a Lagrangian the momentum of `x` is called `p_x`, unless the name is taken.
//! - A force repeats the signature and has one component a group: one expression for one group,
//!   `[f, g]` for more.
//! - Observables have names of their own: a monitor may be called as a `let`, not as a method.
//! - Prefix `+` is allowed; a default may have a sign; `%` must be the outermost operation of an
//!   index.
//! - A number that would underflow f64 to 0 is refused like one that overflows.

use crate::report::Spans;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::ObservableKind;
use hamiltonian_symbolic::rational::Rational;
use proc_macro2::{Ident, Span, TokenStream};
use std::collections::BTreeMap;
use std::ops::Range;

/// The most axes of an array.
pub const AXES: usize = 4;

/// A whole definition.
#[derive(Debug, Default)]
pub struct Ast {
    /// True if it began like an item.
    pub is_item: bool,
    /// The header of item form, as soon as its name was read; `None` in expression form.
    pub item: Option<Item>,
    /// The statements in source order.
    pub statements: Vec<Statement>,
    /// All expressions.
    pub nodes: Vec<Expr>,
    /// All loop variables, each a scope of its own.
    pub scopes: Vec<LoopVariable>,
    /// All names.
    pub symbols: Symbols,
}

/// `#[…] pub struct Name`.
#[derive(Debug, Clone)]
pub struct Header {
    /// Attributes and docs that pass through to the struct, each with its `#`.
    pub attributes: Vec<TokenStream>,
    /// `#[max_ops = 40]`, with the span of the number.
    pub max_ops: Option<(u64, Span)>,
    /// `pub`, `pub(crate)` or nothing; for the fields too.
    pub visibility: TokenStream,
    /// The name of the type.
    pub name: Ident,
}

/// `#[…] pub struct Name<const N: usize> { … }`.
#[derive(Debug)]
pub struct Item {
    /// Before the sizes and parameters.
    pub header: Header,
    /// `const N: usize`.
    pub generics: Vec<Ident>,
    /// The entries between the braces.
    pub parameters: Vec<ParameterEntry>,
}

/// One entry between the braces of the struct.
#[derive(Debug)]
pub struct ParameterEntry {
    /// Attributes and docs, each with its `#`.
    pub attributes: Vec<TokenStream>,
    /// The name, as the field is called.
    pub name: Ident,
    /// Scalar, size or array, with a default where it has one.
    pub kind: ParameterKind,
}

/// The declared kind of a parameter.
#[derive(Debug)]
pub enum ParameterKind {
    /// `name` or `name = -1.5`
    Scalar(Option<Expression>),
    /// `name: usize`
    Size,
    /// `name: [s]`, `name: [s][s]` or `name: [2] = [1.0, 2.0]`
    Array(Vec<Size>, Option<Expression>),
    /// `name: fn(a, …)`
    Function(Vec<Ident>),
}

/// A size where an array is declared.
#[derive(Debug, Clone)]
pub enum Size {
    /// `3`
    Literal(u64, Span),
    /// `N` or `n`
    Name(Ident),
    /// `n*m`
    Product(Vec<Size>),
}

impl Size {
    /// The product of its numbers.
    pub fn number(&self) -> u64 {
        match self {
            Size::Literal(value, _) => *value,
            Size::Name(_) => 1,
            Size::Product(factors) => {
                let numbers = factors.iter().map(Size::number);
                numbers.fold(1, u64::saturating_mul)
            }
        }
    }
    /// Its names.
    pub fn names(&self) -> Vec<&Ident> {
        match self {
            Size::Literal(..) => Vec::new(),
            Size::Name(name) => vec![name],
            Size::Product(factors) => factors.iter().flat_map(Size::names).into_list(),
        }
    }
    /// The place of the number, the name or the product.
    pub fn spans(&self) -> Spans {
        match self {
            Size::Literal(_, span) => (*span).into(),
            Size::Name(name) => name.span().into(),
            Size::Product(factors) => {
                let [first, .., last] = &factors[..] else {
                    unreachable!("a product has two factors or more")
                };
                first.spans().to(last.spans())
            }
        }
    }
}

/// One statement.
#[derive(Debug)]
pub struct Statement {
    /// Docs that pass through to the function the statement makes, each with its `#`.
    pub attributes: Vec<TokenStream>,
    /// The first word of the statement.
    pub keyword: Span,
    /// Its meaning.
    pub kind: StatementKind,
}

/// The meaning of a statement.
#[derive(Debug)]
pub enum StatementKind {
    /// `let name = value`; `let name(a, …) = value`
    Let {
        /// The name it defines.
        name: Ident,
        /// The arguments of a function; `None` for a value.
        arguments: Option<Vec<Ident>>,
        /// The right side.
        value: Expression,
    },
    /// `H = value`; `H(q; p) = value`; `H(q; p; t) = value`
    Hamiltonian {
        /// `None` is short for `(q; p)`.
        signature: Option<Signature>,
        /// The right side.
        value: Expression,
    },
    /// `L(q; v) = value`; `L(q; v; t) = value`
    Lagrangian {
        /// Coordinates and velocities.
        signature: Signature,
        /// The right side.
        value: Expression,
    },
    /// `invariant name = value [on H = shell]`; `monitor name = value`; `event name = value`
    Observable {
        /// One of the three.
        kind: ObservableKind,
        /// `#[assume]` stands before it.
        assumed: bool,
        /// The name it defines.
        name: Ident,
        /// The right side.
        value: Expression,
        /// The energy of the shell on which an invariant is claimed.
        shell: Option<Expression>,
    },
    /// `split { A = …; B = …; … }`
    Split {
        /// `#[assume]` stands before it.
        assumed: bool,
        /// The pieces.
        pieces: Vec<(Ident, Expression)>,
    },
    /// `force(q; p) = value`
    Force {
        /// Coordinates and momenta again, so that the formula reads by itself.
        signature: Signature,
        /// The right side: one expression, or `[f1, f2, …]`.
        value: Expression,
    },
    /// A Rust function.
    Function(Function),
    /// `dt = factor*ds`
    Time {
        /// dt/ds.
        factor: Expression,
    },
    /// `coordinates polar(x, y)`
    Coordinates {
        /// `polar`, `spherical`, …
        chart: Ident,
        /// Names of coordinates and, for `jacobi` and `heliocentric`, of the masses.
        arguments: Vec<Ident>,
    },
}

/// `fn name(a, …) = value[, (first, …)[, (second, …)]]`, or a parameter `name: fn(a, …)`: scalars to a
/// scalar. Derivatives that are not given are those of dual numbers.
#[derive(Debug, Clone)]
pub struct Function {
    /// The name it defines.
    pub name: Ident,
    /// Its arguments, at least one.
    pub arguments: Vec<Ident>,
    /// The path of the function; `None` for a parameter, whose value the field of its name gives.
    pub value: Option<TokenStream>,
    /// The partial derivatives, one an argument.
    pub first: Option<Paths>,
    /// The second partials: the upper triangle row by row (xx, xy, yy), `n(n+1)/2` of them.
    pub second: Option<Paths>,
}

/// `(path, …)`
#[derive(Debug, Clone)]
pub struct Paths {
    /// The parentheses.
    pub spans: Spans,
    /// The paths of Rust functions.
    pub paths: Vec<TokenStream>,
}

/// `(coordinates; momenta or velocities; time)`.
#[derive(Debug)]
pub struct Signature {
    /// The parentheses.
    pub spans: Spans,
    /// The sections between the semicolons, as many as were written.
    pub sections: Vec<Vec<Declarator>>,
}

/// `q`, `q[N]`, `q[N][3]` in a signature.
#[derive(Debug)]
pub struct Declarator {
    /// The name, without sizes.
    pub name: Ident,
    /// The sizes in the brackets.
    pub sizes: Vec<Size>,
}

/// A contiguous run of nodes with its root.
#[derive(Debug, Clone)]
pub struct Expression {
    /// All nodes of the expression.
    pub nodes: Range<u32>,
    /// The whole expression.
    pub root: ExprId,
}

/// The index of an expression node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct ExprId(pub u32);

/// An expression node.
#[derive(Debug)]
pub struct Expr {
    /// The operation, with its operands.
    pub kind: ExprKind,
    /// From its first to its last token, parentheses around it included.
    pub spans: Spans,
    /// The narrowest token that represents it: its operator, name or number.
    pub at: Spans,
}

/// The kind of an expression node.
#[derive(Debug)]
pub enum ExprKind {
    /// An expression with a reported error, or one without a meaning of its own. It causes no
    /// further error.
    Error,
    /// A number.
    Number(Rational),
    /// A name, with the innermost loop variable around it.
    Name(Symbol, Option<LoopVariableId>),
    /// `-a`, `!a`
    Unary(UnaryOp, ExprId),
    /// `a + b` and so on
    Binary(BinaryOp, ExprId, ExprId),
    /// `f(a, …)`; `bracket(a, b)` too
    Call(Symbol, Option<LoopVariableId>, Vec<ExprId>),
    /// `base[index]`, `base[index % modulo]`
    Index {
        /// The indexed value.
        base: ExprId,
        /// Left of `%`.
        index: ExprId,
        /// Right of `%`.
        modulo: Option<ExprId>,
    },
    /// `[a, b, c]`
    Vector(Vec<ExprId>),
    /// `i in lower..upper`: binds a loop variable for the nodes up to its [`ExprKind::Sum`].
    Bind {
        /// The loop variable.
        scope: LoopVariableId,
        /// The first value.
        lower: ExprId,
        /// One past the last value.
        upper: ExprId,
    },
    /// `sum(i in a..b, j in c..d) { body }`
    Sum {
        /// Its loop variables, outermost first.
        scopes: Vec<LoopVariableId>,
        /// The summand.
        body: ExprId,
    },
    /// `if condition { then } else { otherwise }`
    If {
        /// The condition.
        condition: ExprId,
        /// The value where it holds.
        then: ExprId,
        /// The value where it does not.
        otherwise: ExprId,
    },
}

/// Prefix operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-`
    Neg,
    /// `!`
    Not,
}

/// Infix operators. `%` exists only between the parser's operand stack and the index it ends in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BinaryOp {
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
    /// `^`
    Pow,
    /// `%`
    Rem,
    /// `<`, `<=`, `>`, `>=`, `==`, `!=`
    Compare(Comparison),
    /// `&&`
    And,
    /// `||`
    Or,
}

/// Comparisons.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
    /// `==`
    Equal,
    /// `!=`
    NotEqual,
}

impl BinaryOp {
    /// As it is written.
    pub fn symbol(self) -> &'static str {
        match self {
            BinaryOp::Add => "+",
            BinaryOp::Sub => "-",
            BinaryOp::Mul => "*",
            BinaryOp::Div => "/",
            BinaryOp::Pow => "^",
            BinaryOp::Rem => "%",
            BinaryOp::Compare(Comparison::Less) => "<",
            BinaryOp::Compare(Comparison::LessEqual) => "<=",
            BinaryOp::Compare(Comparison::Greater) => ">",
            BinaryOp::Compare(Comparison::GreaterEqual) => ">=",
            BinaryOp::Compare(Comparison::Equal) => "==",
            BinaryOp::Compare(Comparison::NotEqual) => "!=",
            BinaryOp::And => "&&",
            BinaryOp::Or => "||",
        }
    }
}

/// One loop variable of a sum.
#[derive(Debug)]
pub struct LoopVariable {
    /// The innermost loop variable around this one.
    pub parent: Option<LoopVariableId>,
    /// The loop variable.
    pub name: Ident,
    /// The loop variable, interned.
    pub symbol: Symbol,
}

/// The index of a loop variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopVariableId(pub u32);

/// A name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// All names of a definition, including those that are only declared.
#[derive(Debug, Default)]
pub struct Symbols {
    names: Vec<String>,
    index: BTreeMap<String, Symbol>,
}

impl Symbols {
    /// The symbol of a name.
    pub fn intern(&mut self, name: &str) -> Symbol {
        if let Some(symbol) = self.index.get(name) {
            return *symbol;
        }
        let symbol = Symbol(self.names.len() as u32);
        self.names.push(name.to_owned());
        self.index.insert(name.to_owned(), symbol);
        symbol
    }

    /// The symbol of a name that occurs.
    pub fn find(&self, name: &str) -> Option<Symbol> {
        self.index.get(name).copied()
    }

    /// The name of a symbol.
    pub fn name(&self, symbol: Symbol) -> &str {
        &self.names[symbol.0 as usize]
    }

    /// The number of symbols; each symbol is smaller.
    pub fn count(&self) -> usize {
        self.names.len()
    }
}
