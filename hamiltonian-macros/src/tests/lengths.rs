//! Loops stay loops: what is emitted for a literal length is the same code whatever the length.

use crate::expand::expand;
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;
use std::str::FromStr;

/// Lattices, chains with ends, pair sums; `@` stands for the length.
const DEFINITIONS: &[&str] = &[
    "pub struct Toda {}
     H(q[@]; p[@]) = sum(i in 0..@) { p[i]^2/2 + exp(q[i] - q[(i + 1) % @]) };
     invariant total_momentum = sum(i in 0..@) { p[i] }",
    "H(q[@]; p[@]) = sum(i in 0..@) { p[i]^2/2 } + q[0]^4/4
         + sum(i in 0..@ - 1) { (q[i + 1] - q[i])^2/2 + alpha*(q[i + 1] - q[i])^3/3 }",
    "pub struct Gravity { G = 1.0, m: [@] }
     H(q[@][3]; p[@][3]) = sum(i in 0..@) { norm_squared(p[i])/(2*m[i]) }
         - G*sum(i in 0..@, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }",
    "H(u[@][@]; p[@][@]) = sum(i in 0..@, j in 0..@) { p[i][j]^2/2 + (u[(i + 1) % @][j] - u[i][j])^2/2 }",
    "L(u[@][@]; v[@][@]) = sum(i in 0..@, j in 0..@) { v[i][j]^2/2 - (u[i][(j + 1) % @] - u[i][j])^2/2 }",
    "H(q[@]; p[@]) = sqrt(1 + sum(i in 0..@) { p[i]^2 }) + sum(i in 0..@) { q[i]*q[(i + 3) % @] }",
];

/// The expansion for a length without its documentation, which counts operations: its tokens, in
/// which the length is `@` again.
fn emitted(definition: &str, length: u32) -> Vec<String> {
    let source = definition.replace('@', &length.to_string());
    let tokens = TokenStream::from_str(&source).expect("the source has balanced brackets");
    let code = expand(quote!(($crate) #tokens));
    let mut out = Vec::new();
    flatten(code, length, &mut out);
    assert!(!out.iter().any(|token| token == "compile_error"));
    out
}

fn flatten(tokens: TokenStream, length: u32, out: &mut Vec<String>) {
    let mut trees = tokens.into_iter().peekable();
    while let Some(tree) = trees.next() {
        match tree {
            TokenTree::Punct(hash) if hash.as_char() == '#' && is_doc(trees.peek()) => {
                trees.next();
            }
            TokenTree::Group(group) => {
                out.push(format!("{:?}", group.delimiter()));
                flatten(group.stream(), length, out);
                out.push("end".to_owned());
            }
            TokenTree::Literal(literal) => out.push(generalised(&literal.to_string(), length)),
            token => out.push(token.to_string()),
        }
    }
}

fn is_doc(tree: Option<&TokenTree>) -> bool {
    let Some(TokenTree::Group(group)) = tree else {
        return false;
    };
    matches!(group.stream().into_iter().next(), Some(TokenTree::Ident(name)) if name == "doc")
}

/// A literal, or a string of LaTeX, with `@` for the length, `@-1` to `@-3` for the last indices, which the
/// neighbours of the first ones have, and `@*@` for the number of elements of a lattice, if they are whole words.
fn generalised(literal: &str, length: u32) -> String {
    let word = |word: &str| match word.trim_end_matches("usize").parse() {
        Ok(value) if value == length => "@".to_owned(),
        Ok(value) if (length - 3..length).contains(&value) => format!("@-{}", length - value),
        Ok(value) if value == length * length => "@*@".to_owned(),
        Ok::<u32, _>(_) | Err(_) => word.to_owned(),
    };
    let parts = literal.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_');
    let parts = parts.map(|part| {
        let end = part.trim_end_matches(|c: char| !c.is_alphanumeric() && c != '_');
        word(end) + &part[end.len()..]
    });
    parts.collect()
}

#[test]
fn emitted_code_is_the_same_for_every_length() {
    for definition in DEFINITIONS {
        let short = emitted(definition, 23);
        assert!(short.iter().any(|token| token == "@"), "{short:?}");
        for length in [200, 1000] {
            assert_eq!(short, emitted(definition, length), "{definition}");
        }
    }
}
