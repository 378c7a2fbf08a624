//! The definitions of the repository.
//!
//! Input: files of examples and tests. Output: the definitions in them, as text.

use proc_macro2::{TokenStream, TokenTree};
use std::fs;
use std::path::{Path, PathBuf};

/// The path of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The definitions of all calls of `hamiltonian!` in examples and tests, and those that the tests of the macro accept.
pub fn definitions() -> Vec<String> {
    let mut found = Vec::new();
    let folders = ["examples", "tests"].map(|folder| root().join(folder));
    let entries = folders
        .iter()
        .flat_map(|folder| fs::read_dir(folder).expect("it can be listed"));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("it can be listed").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect();
    files.sort();
    for file in files {
        let text = fs::read_to_string(&file).expect("it can be read");
        calls(text.parse().expect("it is Rust"), &mut found);
    }
    let accepted = root().join("hamiltonian-macros/src/tests/accepted.rs");
    let accepted = fs::read_to_string(accepted).expect("it can be read");
    literals(accepted.parse().expect("it is Rust"), &mut found);
    found
}

/// The insides of the calls of `hamiltonian!`.
fn calls(tokens: TokenStream, found: &mut Vec<String>) {
    let mut before = [String::new(), String::new()];
    for tree in tokens {
        if let TokenTree::Group(group) = &tree {
            if before == ["hamiltonian", "!"] {
                let text = group.span().source_text().expect("it was read from text");
                let inside = text[1..text.len() - 1].to_owned();
                if !inside.contains('$') {
                    found.push(inside);
                }
            } else {
                calls(group.stream(), found);
            }
        }
        let [_, last] = before;
        before = [last, tree.to_string()];
    }
}

/// The texts that are definitions.
fn literals(tokens: TokenStream, found: &mut Vec<String>) {
    for tree in tokens {
        match tree {
            TokenTree::Group(group) => literals(group.stream(), found),
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                let inside = text
                    .strip_prefix('"')
                    .and_then(|text| text.strip_suffix('"'));
                let is_definition = |text: &&str| {
                    let is_given =
                        text.contains("H =") || text.contains("H(") || text.contains("L(");
                    is_given && text.contains('=') && !text.contains(['\\', '$', '`'])
                };
                found.extend(inside.filter(is_definition).map(str::to_owned));
            }
            TokenTree::Ident(_) | TokenTree::Punct(_) => {}
        }
    }
}

/// Different numbers between ½ and 1½.
pub fn numbers(seed: usize) -> impl FnMut() -> f64 {
    let mut state = seed as u64 + 1;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        0.5 + (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}
