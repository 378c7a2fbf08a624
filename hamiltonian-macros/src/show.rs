//! The code of the definitions in a Rust file: `cargo run -p hamiltonian-macros --example show --
//! examples/toda.rs` prints the code that the macro emits for each.
//!
//! The stages are compiled into this program as they are into the macro, which cannot be called
//! from outside of rustc. With `--number k` only the k-th definition is expanded, for the budgets of
//! instructions ([`expanded`]). The number of systems is printed then, and "searched" where exact
//! flows of its pieces were sought. With `--time` the time that each takes is printed.

extern crate proc_macro;

mod backend;
mod emit;
mod expand;
mod fallback;
mod unused;

use hamiltonian_symbolic::list::IntoList;
use proc_macro2::{TokenStream, TokenTree};
use std::process::ExitCode;
use std::str::FromStr;
use std::time::Instant;

/// The task to do with the definitions.
enum Task {
    /// The code of each is printed.
    Print,
    /// The k-th one is expanded.
    Expand(usize),
    /// The shortest of five times each took, in milliseconds, is printed.
    Time,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).into_list();
    let words: Vec<&str> = arguments.iter().map(String::as_str).into_list();
    let task = match words[..] {
        [_] => Some(Task::Print),
        [_, "--time"] => Some(Task::Time),
        [_, "--number", number] => number.parse().ok().map(Task::Expand),
        _ => None,
    };
    let Some(task) = task else {
        eprintln!("usage: show FILE [--number K | --time]");
        return ExitCode::FAILURE;
    };
    match read(words[0]).and_then(|definitions| perform(task, definitions)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{}: {reason}", words[0]);
            ExitCode::FAILURE
        }
    }
}

fn perform(task: Task, definitions: Vec<TokenStream>) -> Result<(), String> {
    match task {
        Task::Print => {
            for definition in definitions {
                println!("{}", pretty(expanded(definition)));
            }
        }
        Task::Expand(number) => match definitions.into_iter().nth(number) {
            Some(definition) => {
                let code = expanded(definition).to_string();
                // One for each implementation of `System`.
                println!("{} systems", code.matches("const GROUPS").count());
                let said = ["exact flows", "The flow of all of H"];
                if said.iter().any(|words| code.contains(words)) {
                    println!("searched");
                }
            }
            None => return Err(format!("there is no definition number {number}")),
        },
        Task::Time => {
            for definition in definitions {
                let times = (0..5).map(|_| {
                    let (definition, start) = (definition.clone(), Instant::now());
                    drop(expanded(definition));
                    start.elapsed()
                });
                let shortest = times.min().unwrap_or_default();
                println!("{:.1}", 1e3 * shortest.as_secs_f64());
            }
        }
    }
    Ok(())
}

/// The inside of every `hamiltonian! { … }` of a file.
fn read(path: &str) -> Result<Vec<TokenStream>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let tokens = TokenStream::from_str(&text).map_err(|error| error.to_string())?;
    let mut definitions = Vec::new();
    find(tokens, &mut definitions);
    Ok(definitions)
}

fn find(tokens: TokenStream, definitions: &mut Vec<TokenStream>) {
    let trees: Vec<TokenTree> = tokens.into_iter().into_list();
    for (at, tree) in trees.iter().enumerate() {
        let TokenTree::Group(group) = tree else {
            continue;
        };
        let is_call = at >= 2
            && matches!(&trees[at - 2], TokenTree::Ident(name) if name == "hamiltonian")
            && matches!(&trees[at - 1], TokenTree::Punct(mark) if mark.as_char() == '!');
        if is_call {
            definitions.push(group.stream());
        } else {
            find(group.stream(), definitions);
        }
    }
}

/// One definition's whole way through the macro.
#[inline(never)]
fn expanded(definition: TokenStream) -> TokenStream {
    expand::expand(definition)
}

/// Emitted code as a formatted file; an expression stands in a function.
fn pretty(code: TokenStream) -> String {
    let file = syn::parse2(code.clone())
        .or_else(|_| syn::parse2(quote::quote!(fn value() { #code })))
        .map(|file| prettyplease::unparse(&file));
    file.unwrap_or_else(|_| code.to_string())
}
