//! Nothing breaks the front end: deep nesting is refused, long chains are not.

use super::{accept, read};
use std::fmt::Write;

fn nested(open: &str, inner: &str, close: &str, depth: usize) -> String {
    format!(
        "H = p^2 + {}{inner}{}",
        open.repeat(depth),
        close.repeat(depth)
    )
}

/// The only error.
fn error(source: &str) -> String {
    let (_, checked, report) = read(source);
    assert!(checked.is_none());
    let texts: Vec<String> = report.errors().iter().map(|error| error.text()).collect();
    assert_eq!(texts.len(), 1, "{texts:?}");
    texts[0].clone()
}

const DEEP: &str = "this nests deeper than 128\nhelp: name an inner part: `let part = …;`";

#[test]
fn nesting_is_accepted_up_to_the_limit() {
    accept(&nested("(", "q", ")", 128));
    accept(&nested("-", "q", "", 128));
    accept(&nested("sin(", "q", ")", 128));
    accept(&nested("q^", "q", "", 128));
    accept(&nested("1 + (2*(-", "q", "))", 42));
    accept(&nested("if q > 0 { p } else { ", "q", " }", 64));
}

#[test]
fn deeper_nesting_is_one_error() {
    for depth in [129, 600, 3000] {
        assert_eq!(error(&nested("(", "q", ")", depth)), DEEP);
        assert_eq!(error(&nested("-", "q", "", depth)), DEEP);
        assert_eq!(error(&nested("!", "q", "", depth)), DEEP);
        assert_eq!(error(&nested("sin(", "q", ")", depth)), DEEP);
        assert_eq!(error(&nested("q^", "q", "", depth)), DEEP);
        assert_eq!(error(&nested("q^-", "q", "", depth)), DEEP);
        assert_eq!(error(&nested("q[", "0", "]", depth)), DEEP);
        assert_eq!(error(&nested("[", "0", "]", depth)), DEEP);
        assert_eq!(error(&nested("sum(i in 0..3) {", "q", "}", depth)), DEEP);
        assert_eq!(
            error(&nested("if q > 0 { p } else { ", "q", " }", depth)),
            DEEP
        );
        assert_eq!(
            error(&nested("if q > 0 { p } else ", "{ q }", "", depth)),
            DEEP
        );
    }
}

#[test]
fn groups_nobody_reads_cost_no_stack() {
    let deep = format!("{}{}", "(".repeat(3000), ")".repeat(3000));
    for source in [
        format!("struct A {{ m = {deep} }} H = p^2"),
        format!("#[doc({deep})] struct A {{}} H = p^2"),
        format!("struct A<{deep}> {{}} H = p^2"),
        format!("H({deep}; p) = p^2"),
        deep.clone(),
        format!("H = p.sin{deep}"),
        format!("let f{deep} = 1; H = p^2"),
        format!("fn f(x) = {deep}; H = p^2"),
    ] {
        let _ = read(&source);
    }
}

#[test]
fn long_sums_are_accepted() {
    for (terms, term) in [(50_000, "q*p^2"), (80_000, "-2*q")] {
        let mut source = String::from("H = p^2");
        for index in 0..terms {
            write!(source, " + {term}*{index}").expect("strings can be written to");
        }
        let checked = accept(&source);
        assert!(checked.nodes.len() > terms);
    }
}

#[test]
fn many_statements_and_names_are_accepted() {
    let mut source = String::from("let a0 = q; ");
    for index in 1..2_000 {
        write!(source, "let a{index} = a{} + 1; ", index - 1).expect("strings can be written to");
    }
    accept(&format!("{source} H = p^2 + a1999"));
}

#[test]
fn a_chain_of_functions_has_a_limit() {
    let chain = |length: usize| {
        let mut source = String::from("let f0(x) = x + 1; ");
        for index in 1..length {
            write!(source, "let f{index}(x) = f{}(x) + 1; ", index - 1).expect("a string");
        }
        format!("{source} H = p^2 + f{}(q)", length - 1)
    };
    accept(&chain(128));
    assert_eq!(
        error(&chain(300)),
        "functions call each other deeper than 128\nhelp: inline the inner ones"
    );
}

#[test]
fn an_explosion_of_calls_is_one_error() {
    let mut source = String::from("let f0(x) = x*x + 1; ");
    for index in 1..60 {
        let inner = index - 1;
        write!(source, "let f{index}(x) = f{inner}(x) + f{inner}(x + 1); ").expect("a string");
    }
    assert!(
        error(&format!("{source} H = p^2 + f59(q)")).starts_with("the calls of functions expand")
    );
}

#[test]
fn errors_without_end_are_reported_in_time() {
    // Every term is wrong in a way of its own.
    let mut source = String::from("struct A {} H = p^2");
    for index in 0..5_000 {
        write!(source, " + unknown{index} + 2q + (q > 1)").expect("a string");
    }
    let (_, checked, report) = read(&source);
    assert!(checked.is_none());
    assert_eq!(report.errors().len(), 5_000);
}

#[test]
fn what_a_program_cannot_number_is_refused() {
    let list = |name: &str, count: usize| {
        let names: Vec<String> = (0..count).map(|at| format!("{name}{at}")).collect();
        names.join(", ")
    };
    let coordinates = |count| format!("H({}; {}) = p0^2", list("q", count), list("p", count));
    let parameters = |count| format!("struct A {{ {} }} H = p^2*a{}", list("a", count), count - 1);
    accept(&parameters(32_768));
    let refusal = |sort: &str, name: &str| {
        format!(
            "there are 32769 {sort}, more than 32768\nhelp: make them an array, such as `{name}[32769]`"
        )
    };
    assert_eq!(error(&coordinates(32_769)), refusal("coordinates", "q"));
    assert_eq!(error(&parameters(32_769)), refusal("parameters", "a"));
}

#[test]
fn numbers_have_as_many_digits_as_count() {
    accept(&format!("H = p^2 + 0.{}*q", "1".repeat(999)));
    let long = format!("H = p^2 + 0.{}*q", "1".repeat(10_000));
    assert_eq!(
        error(&long),
        "`0.111111111111111111…` has 10001 digits, more than 1000\nhelp: write the digits that count: an f64 keeps 17"
    );
}
