//! The front end: accepted and refused definitions, the words of refusals, and that nothing breaks it.

mod accepted;
mod builds;
mod diagnostics;
mod docs;
mod emitted;
mod lengths;
mod limits;
mod nests;
mod pieces;
mod precedence;
mod stencils;
mod stub;
mod truths;

use crate::backend;
use hamiltonian_language::ast::Ast;
use hamiltonian_language::checked::Checked;
use hamiltonian_language::report::{Diagnostic, Report};
use hamiltonian_language::tokens::Tokens;
use hamiltonian_language::{check, parse, read as front};
use proc_macro2::{LineColumn, TokenStream};
use quote::quote;
use std::str::FromStr;

/// The tree and, if nothing is wrong, the checked tree.
fn read(source: &str) -> (Ast, Option<Checked>, Report) {
    let stream = TokenStream::from_str(source).expect("the source has balanced brackets");
    let mut report = Report::default();
    let (ast, checked) = front(stream, &mut report);
    (ast, checked, report)
}

/// A definition without errors.
fn accept(source: &str) -> Checked {
    let (_, checked, report) = read(source);
    let texts: Vec<String> = report.errors().iter().map(|error| error.text()).collect();
    checked.unwrap_or_else(|| panic!("{source}\n{}", texts.join("\n")))
}

/// The stages between whose barriers errors are gathered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    Parse,
    Check,
    Prove,
}

/// The first stage that refuses a definition, and its errors.
fn refuse(source: &str) -> (Option<Stage>, Vec<Diagnostic>) {
    let stream = TokenStream::from_str(source).expect("the source has balanced brackets");
    let mut report = Report::default();
    let errors = |stage, report: &Report| (Some(stage), report.errors().to_vec());
    let ast = parse::parse(&Tokens::flatten(stream), &mut report);
    if !report.is_empty() {
        return errors(Stage::Parse, &report);
    }
    let checked = check::check(&ast, &mut report);
    if !report.is_empty() {
        return errors(Stage::Check, &report);
    }
    let code = backend::generate(&checked, &quote!(::hamiltonian), &mut report);
    if !report.is_empty() {
        return errors(Stage::Prove, &report);
    }
    assert!(code.is_some(), "neither code nor an error");
    (None, Vec::new())
}

/// The places of marked pieces of a source once the marks are taken out.
fn unmarked(source: &str) -> (String, Vec<(LineColumn, LineColumn)>) {
    let (mut plain, mut open, mut marks) = (String::new(), Vec::new(), Vec::new());
    let (mut line, mut column) = (1, 0);
    for character in source.chars() {
        let here = LineColumn { line, column };
        match character {
            '⟦' => open.push(here),
            '⟧' => marks.push((open.pop().expect("marks are balanced"), here)),
            _ => {
                plain.push(character);
                column += 1;
                if character == '\n' {
                    (line, column) = (line + 1, 0);
                }
            }
        }
    }
    (plain, marks)
}
