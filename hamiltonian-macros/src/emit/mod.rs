//! From a scheduled program to tokens.
//!
//! Input: [`Definition`]: a model, its program, what was proven about it, and the tokens the user
//! wrote. Output: the tokens of the type (or the value), of everything it implements, and of its
//! documentation. Invariants:
//!
//! - Emitted code names nothing of the user's but what the user wrote: paths begin with the
//!   private module of the facade, which is called `__h` inside; locals begin with an underscore,
//!   so that no constant of the user's can turn a binding into a pattern.
//! - Bodies are written as text and lexed once, which costs a tenth of building them token by
//!   token; what the user wrote (names, attributes, paths) keeps its own tokens and spans.
//! - The same definition gives the same tokens.

mod block;
mod construct;
mod declared;
mod derived;
mod dynamics;
mod expression;
mod externals;
mod function;
mod generics;
mod holder;
mod index;
mod item;
mod kicks;
mod layout;
mod markers;
mod mixed;
mod number;
mod observables;
mod parts;
mod pieces;
mod reach;
mod scan;
mod vectors;

#[cfg(test)]
mod tests;

pub use declared::Declared;
pub use number::closed;
pub use vectors::{VectorItem, VectorUse};

use crate::ast::Function;
use crate::checked::Reach;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::program::{Program, Purpose};
use proc_macro2::{Ident, TokenStream};

/// All that emission reads.
#[derive(Debug)]
pub struct Definition<'a> {
    /// The path of the facade: `$crate`.
    pub root: TokenStream,
    /// The mathematics.
    pub model: &'a Model,
    /// The instructions.
    pub program: &'a Program,
    /// The user's tokens.
    pub form: Form,
    /// The proven structure.
    pub structure: Structure,
    /// The printed text.
    pub text: Text,
    /// Functions written in Rust, in the model's order.
    pub functions: &'a [Function],
    /// Monitors, invariants and events, in the model's order.
    pub observables: Vec<ObservableItem>,
    /// Vector functions, in the model's order.
    pub vectors: Vec<VectorItem>,
    /// The variables it was declared in, where it is integrated in others.
    pub declared: Option<&'a Declared>,
    /// The systems of a split's pieces: (name of the piece, name of its type).
    pub pieces: Vec<(Ident, Ident)>,
    /// The questions that only sizes decide.
    pub reaches: &'a [Reach],
}

/// Item form or expression form.
#[derive(Debug)]
pub enum Form {
    /// `pub struct Name { … }`
    Item(Item),
    /// A value; the names it captures are the parameters of the model.
    Expression(Vec<Ident>),
}

/// The header of item form.
#[derive(Debug)]
pub struct Item {
    /// Attributes and docs that pass through.
    pub attributes: Vec<TokenStream>,
    /// `pub`, `pub(crate)` or nothing.
    pub visibility: TokenStream,
    /// The name of the type.
    pub name: Ident,
    /// The type whose states it takes: the whole system, where this is a piece of it.
    pub whole: Option<Ident>,
    /// Sizes in the model's order: const generics first.
    pub sizes: Vec<SizeItem>,
    /// Parameters in the model's order.
    pub parameters: Vec<ParameterItem>,
    /// Run-time sizes and parameters in the order of the fields.
    pub fields: Vec<Field>,
}

/// A size.
#[derive(Debug)]
pub struct SizeItem {
    /// The name of the const generic or field.
    pub name: Ident,
    /// A field set at run time; a const generic otherwise.
    pub run_time: bool,
    /// Docs.
    pub attributes: Vec<TokenStream>,
}

/// A parameter.
#[derive(Debug)]
pub struct ParameterItem {
    /// The name of the field.
    pub name: Ident,
    /// Docs.
    pub attributes: Vec<TokenStream>,
    /// Its default, number by number: expressions of the scalar `T`.
    pub default: Option<Vec<String>>,
}

/// A field of the struct.
#[derive(Debug, Clone, Copy)]
pub enum Field {
    /// A run-time size, by its number in the model.
    Size(usize),
    /// A parameter, by its number in the model.
    Parameter(usize),
}

/// A monitor, an invariant or an event.
#[derive(Debug)]
pub struct ObservableItem {
    /// The name of the method.
    pub name: Ident,
    /// Docs.
    pub attributes: Vec<TokenStream>,
}

/// The proven structure of H.
#[derive(Debug)]
pub struct Structure {
    /// H = T(p, t) + V(q, t)
    pub separable: Result<(), Reason>,
    /// H is a sum of pieces with exact flows: those of the model, or V and T.
    pub split: Result<(), Reason>,
    /// V and T in the author's notation, where H is separable.
    pub halves: [String; 2],
    /// T = ½ pᵀM⁻¹p with constant M
    pub quadratic_kinetic: Result<(), Reason>,
    /// A kick V(q, t) and a piece at most quadratic in the momenta.
    pub nystrom: Result<Nystrom, Reason>,
    /// No force acts.
    pub unforced: Result<(), Reason>,
    /// The flows of all pieces are exact.
    pub exact: Result<(), Reason>,
    /// How V is kicked, with the force, or the force alone beside pieces of H; none where neither is.
    pub kick: Option<Kick>,
    /// H does not depend on t
    pub autonomous: Result<(), Reason>,
    /// Coordinates that do not appear in H.
    pub cyclic: Vec<String>,
}

/// Where the kick and the piece at most quadratic in the momenta are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nystrom {
    /// V and T.
    Halves,
    /// The model's pieces of these numbers.
    Pieces([usize; 2]),
}

/// The functions that make up the kick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kick {
    /// The kick alone: without a force, or with one that does not depend on momenta.
    Plain,
    /// The part that reads momenta, and where `rest` the kick after it.
    Damped {
        /// Whether there is a part that reads none.
        rest: bool,
    },
    /// Exact by a series over the rates of momenta and their linear part: momenta push each other.
    Coupled,
    /// A symmetric sub-step over the rates of momenta.
    SubStep,
}

impl Kick {
    /// The purposes of the functions that a kick is made of.
    #[must_use]
    pub fn purposes(self) -> &'static [Purpose] {
        match self {
            Kick::Plain => &[Purpose::Kick],
            Kick::Damped { rest: false } => &[Purpose::Push],
            Kick::Damped { rest: true } => &[Purpose::Push, Purpose::Kick],
            Kick::Coupled => &[Purpose::Rates, Purpose::Linear],
            Kick::SubStep => &[Purpose::Rates],
        }
    }
}

/// Why a structure is not there, as rustc says it where a scheme asks for it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reason {
    /// The property of H in the way, with the term at fault.
    pub message: String,
    /// The missing property.
    pub label: String,
    /// The alternative.
    pub note: String,
}

/// H and Hamilton's equations as people read them.
#[derive(Debug, Default)]
pub struct Text {
    /// `H(q; p) = …`
    pub hamiltonian: String,
    /// Hamilton's equations, one a line.
    pub equations: Vec<String>,
    /// H in LaTeX.
    pub latex: String,
    /// Hamilton's equations in LaTeX, one a line.
    pub latex_equations: Vec<String>,
    /// Facts of H, one sentence a line.
    pub facts: Vec<String>,
    /// A table of the operations of value and gradient, one row a line.
    pub operations: Vec<String>,
}

/// The tokens of a definition.
pub fn generate(definition: &Definition) -> TokenStream {
    match &definition.form {
        Form::Item(item) => item::generate(definition, item),
        Form::Expression(captures) => expression::generate(definition, captures),
    }
}

/// Text as tokens. All text that is emitted is made here, so it lexes.
fn lex(text: &str) -> TokenStream {
    // rustc's own lexer, asked directly: through proc-macro2 the text is lexed twice.
    let tokens = if proc_macro::is_available() {
        let tokens = text.parse::<proc_macro::TokenStream>();
        tokens.map(TokenStream::from).ok()
    } else {
        text.parse().ok()
    };
    tokens.expect("the emitted code lexes")
}

/// Attributes that allow what the user's own names may do to lints.
fn allowances(names: &[&Ident]) -> TokenStream {
    let snake = |name: &&Ident| name.to_string().chars().all(|c| !c.is_uppercase());
    if names.iter().all(snake) {
        TokenStream::new()
    } else {
        quote::quote! { #[allow(non_snake_case)] }
    }
}
