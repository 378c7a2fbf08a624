//! The definitions of the repository.
//!
//! Input: files of examples, tests, benchmarks and the book. Output: the definitions in them, as text.

use proc_macro2::{TokenStream, TokenTree};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The path of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The definitions of all calls of `hamiltonian!` in examples, tests, benchmarks and the book, and those that the tests of the
/// macro accept, each once.
pub fn definitions() -> Vec<String> {
    let folders = ["examples", "tests", "benches", "book/src"].map(|folder| root().join(folder));
    let mut found = of_files(folders.iter().flat_map(|folder| files(folder, true)));
    let mut known = HashSet::new();
    found.retain(|text| known.insert(text.clone()));
    found
}

/// Those of the files that are directly in the folders of examples and tests, where no expression is made at random.
pub fn written_definitions() -> Vec<String> {
    let folders = ["examples", "tests"].map(|folder| root().join(folder));
    of_files(folders.iter().flat_map(|folder| files(folder, false)))
}

/// The definitions of files, and those that the tests of the macro accept.
fn of_files(files: impl Iterator<Item = PathBuf>) -> Vec<String> {
    let mut found = Vec::new();
    for file in files {
        let text = || fs::read_to_string(&file).expect("it can be read");
        match file.extension().and_then(|extension| extension.to_str()) {
            Some("rs") => calls(text().parse().expect("it is Rust"), &mut found),
            Some("md") => {
                for listing in listings(&text()) {
                    calls(listing.parse().expect("it is Rust"), &mut found);
                }
            }
            _ => {}
        }
    }
    let accepted = root().join("hamiltonian-macros/src/tests/accepted.rs");
    let accepted = fs::read_to_string(accepted).expect("it can be read");
    literals(accepted.parse().expect("it is Rust"), &mut found);
    found
}

/// The files of a folder, and with `is_deep` of those in it, in the order of their names.
fn files(folder: &Path, is_deep: bool) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("it can be listed");
    let mut entries: Vec<PathBuf> = entries
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    entries.sort();
    let each = entries.into_iter().map(|path| match path.is_dir() {
        true if is_deep => files(&path, true),
        true => Vec::new(),
        false => vec![path],
    });
    each.flatten().collect()
}

/// The Rust listings of a page, with their hidden lines.
fn listings(page: &str) -> Vec<String> {
    let mut listings = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let inside = lines.by_ref().take_while(|line| !line.starts_with("```"));
            let inside: Vec<&str> = inside
                .map(|line| line.strip_prefix("# ").unwrap_or(line))
                .collect();
            if line.starts_with("```rust") {
                listings.push(inside.join("\n"));
            }
        }
    }
    listings
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
