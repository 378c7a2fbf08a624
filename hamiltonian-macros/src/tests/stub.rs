//! The code in the place of a wrong definition, and the way of definitions to the front end.

use super::unmarked;
use crate::expand::expand;
use hamiltonian_language::report::Report;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::quote;
use std::str::FromStr;

fn expanded(source: &str) -> String {
    let tokens = TokenStream::from_str(source).expect("the source has balanced brackets");
    expand(quote!(($crate) #tokens)).to_string()
}

#[test]
fn expressions_end_in_their_last_error() {
    let one = expanded("H = 2q");
    assert!(one.starts_with(":: core :: compile_error !"), "{one}");
    let two = expanded("H = 2q + 3p");
    assert!(two.starts_with("{ :: core :: compile_error !"), "{two}");
    assert_eq!(two.matches("compile_error").count(), 2);
}

#[test]
fn items_become_an_alias_with_their_fields() {
    let code = expanded(
        "/// Docs.
         #[derive(Clone)] #[max_ops = 3]
         pub(crate) struct A<const N: usize> { m = 1.0, n: usize, w: [N], m = 2.0 } H = 2q",
    );
    assert!(code.contains("pub (crate) m : __P"), "{code}");
    assert!(
        code.contains("pub (crate) type A < const N : usize , __P = f64 , > = __A"),
        "{code}"
    );
    assert!(code.contains("doc =") && !code.contains("derive") && !code.contains("max_ops"));
    assert_eq!(code.matches("pub (crate) m").count(), 1);
    // Without a name there is nothing to stand in for; without parameters no scalar.
    assert!(!expanded("pub struct {} H = p^2").contains("__"));
    assert!(!expanded("struct A {} H = q").contains("__P"));
    // Keywords cannot stand where they stood.
    assert!(!expanded("struct type {} H = p^2").contains("__"));
    assert!(!expanded("struct A<const type: usize> { move, m } H = p^2").contains("type :"));
}

#[test]
fn fragments_of_other_macros_are_values() {
    let fragment = |source: &str| {
        let stream = TokenStream::from_str(source).expect("the source has balanced brackets");
        TokenTree::Group(Group::new(Delimiter::None, stream))
    };
    let (value, visibility, nothing) = (fragment("q + 1"), fragment("pub(crate)"), fragment(""));
    let (name, attribute) = (fragment("Name"), fragment("#[doc = \"a\"]"));
    for tokens in [
        quote!(H = p^2/2 + 2*#value),
        quote!(#attribute #visibility struct #name { m = 1 } H = p^2/m),
        quote!(#nothing struct #name { m = 1 } H = p^2/m),
    ] {
        let mut report = Report::default();
        let (_, checked) = hamiltonian_language::read(tokens, &mut report);
        assert!(checked.is_some(), "{:?}", report.errors());
    }
}

#[test]
fn marks_are_taken_out() {
    let (plain, marks) = unmarked("a⟦b⟧c");
    assert_eq!(
        (plain.as_str(), marks[0].0.column, marks[0].1.column),
        ("abc", 1, 2)
    );
}
