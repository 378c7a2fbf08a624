//! The language of `hamiltonian!`: from tokens to a checked definition, and to its mathematics.
//!
//! tokens → [`ast`] ([`parse`]) → [`checked`] ([`check`]) → [`Lowered`](lower::Lowered) ([`lower`]).
//! [`analyse`] goes on to the [`Analysis`](analyse::Analysis): proofs, final variables, pieces with exact flows, and the
//! programs of each system. Each stage reports all of its errors in a [`report`]; the next stage runs only if there were none.
//! Spans are those of `proc_macro2`, so the language works in a macro and in any other program.
//!
//! ```
//! use hamiltonian_language::{lower::lower, read, report::Report};
//! use hamiltonian_symbolic::print;
//!
//! let mut report = Report::default();
//! let text = "pub struct Quartic { k = 2 } H(q; p) = p^2/2 + k*q^4";
//! let (_, checked) = read(text.parse()?, &mut report);
//! let lowered = lower(&checked.expect("a definition without errors"), &mut report);
//! let mut model = lowered.expect("it has mathematics").model;
//! let h = model.hamiltonian.expect("it has an H");
//! assert_eq!(print::text(&model, h), "p^2/2 + k*q^4");
//!
//! // An error has a message with a remedy, at the tokens it concerns.
//! let (_, checked) = read("pub struct Wrong {} H(q; p) = p^2/2 + k*q^4".parse()?, &mut report);
//! assert!(checked.is_none());
//! assert!(report.errors()[0].message.contains("`k`"));
//! # Ok::<(), proc_macro2::LexError>(())
//! ```
#![forbid(unsafe_code)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

pub mod analyse;
pub mod ast;
pub mod check;
pub mod checked;
pub mod lower;
pub mod names;
pub mod parse;
pub mod report;
pub mod tokens;

use ast::Ast;
use checked::Checked;
use proc_macro2::TokenStream;
use report::Report;
use tokens::Tokens;

/// Parses and checks a definition. The tree contains everything that could be read. The checked
/// definition is `None` if there are errors; these are in the report.
pub fn read(definition: TokenStream, report: &mut Report) -> (Ast, Option<Checked>) {
    let tokens = Tokens::flatten(definition);
    let ast = parse::parse(&tokens, report);
    if report.barrier(()).is_none() {
        return (ast, None);
    }
    let checked = check::check(&ast, report);
    let checked = report.barrier(checked);
    (ast, checked)
}
