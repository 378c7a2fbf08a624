//! Rows of a periodic lattice are written once where the force of a bond is a short polynomial.

use crate::expand::expand;
use proc_macro2::TokenStream;
use quote::quote;
use std::str::FromStr;

/// The number of emitted stores that share their rows with others, for a potential of bonds.
fn shared(bond: &str) -> usize {
    let source = format!(
        "pub struct Field {{ n: usize, m: usize }}
         let V(r) = {bond};
         H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {{ p[i][j]^2/2 - cos(u[i][j])
             + V(u[(i + 1) % n][j] - u[i][j]) + V(u[(i - 1) % n][(j + 2) % m] - u[i][j]) }}"
    );
    let tokens = TokenStream::from_str(&source).expect("the source has balanced brackets");
    let code = expand(quote!(($crate) #tokens)).to_string();
    assert!(!code.contains("compile_error"), "{code}");
    code.matches("ColumnStore :: among").count()
}

#[test]
fn cheap_bonds_are_computed_at_both_ends() {
    assert_eq!(shared("r^2/2"), 0);
    assert_eq!(shared("r^2/2 + r^4/4"), 0);
}

#[test]
fn functions_and_quotients_are_computed_once() {
    assert!(shared("exp(r)") > 0);
    assert!(shared("1/(2 + r^2)") > 0);
}
