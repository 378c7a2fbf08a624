//! Definitions as large and as deep as nobody writes them: an error of ours or success, never a
//! crash of the compiler.
//!
//! `HAMILTONIAN_HEAVY=1` adds a sum just below the largest that is accepted.

use crate::cargo::{Package, workspace, write};
use std::fmt::Write;
use std::fs;

/// A right side of `H = p^2/2 + …` and the only error it gives, if any.
struct Case {
    name: &'static str,
    expression: String,
    error: Option<&'static str>,
}

const DEEP: Option<&str> = Some("error: this nests deeper than 128");

fn nested(open: &str, inner: &str, close: &str, depth: usize) -> String {
    format!("{}{inner}{}", open.repeat(depth), close.repeat(depth))
}

/// `sin(1*q) + sin(2*q) + …`: with the gradient five operations a term.
fn waves(terms: usize) -> String {
    let mut sum = String::from("sin(q)");
    for k in 2..=terms {
        write!(sum, " + sin({k}*q)").expect("strings can be written to");
    }
    sum
}

fn powers(terms: usize) -> String {
    let mut sum = String::from("q");
    for k in 1..terms {
        write!(sum, " - {k}*q^{}", k % 9 + 1).expect("strings can be written to");
    }
    sum
}

fn cases() -> Vec<Case> {
    let case = |name, expression, error| Case {
        name,
        expression,
        error,
    };
    let mut cases = vec![
        case("parentheses", nested("(", "q", ")", 600), DEEP),
        case("minuses", nested("-", "q", "", 3_000), DEEP),
        case("calls", nested("sin(", "q", ")", 500), DEEP),
        case("chained_powers", nested("q^", "2", "", 600), DEEP),
        case("nested_groups", nested("(", "q", ")", 3_000), DEEP),
        case("nested_indices", nested("q[", "0", "]", 3_000), DEEP),
        case(
            "nested_braces",
            nested("{", "q", "}", 3_000),
            Some("error: braces do not group"),
        ),
        case("deepest_parentheses", nested("(", "q", ")", 128), None),
        case("deepest_calls", nested("sin(", "q", ")", 128), None),
        case("deepest_powers", nested("q^", "2", "", 128), None),
        case("alike_50_000", powers(50_000), None),
        case(
            "different_50_000",
            waves(50_000),
            Some("operations, more than 32768"),
        ),
        case("different_300", waves(300), None),
    ];
    if crate::is_heavy() {
        cases.push(case("different_6_500", waves(6_500), None));
    }
    cases
}

#[test]
fn nothing_breaks_the_compiler() {
    let workspace = workspace("limits", &[Package::new("limits", "")]);
    let programs = workspace.path.join("limits/src/bin");
    fs::create_dir_all(&programs).expect("the target directory can be written to");
    for old in fs::read_dir(&programs).expect("it was made").flatten() {
        let name = old.file_name().into_string().unwrap_or_default();
        if !cases()
            .iter()
            .any(|case| name == format!("{}.rs", case.name))
        {
            fs::remove_file(old.path()).expect("the target directory can be written to");
        }
    }
    let cases = cases();
    for case in &cases {
        let source = format!(
            "fn main() {{\n    let _ = hamiltonian::hamiltonian! {{\n        H = p^2/2 + {}\n    }};\n}}\n",
            case.expression
        );
        write(&programs.join(format!("{}.rs", case.name)), &source);
    }
    let said = workspace
        .cargo(&["check", "--keep-going", "--message-format=short"])
        .text;
    for crash in ["signal", "panicked", "overflow", "internal compiler error"] {
        assert!(!said.contains(crash), "{crash}:\n{said}");
    }
    for case in &cases {
        let place = format!("/{}.rs:", case.name);
        let errors: Vec<&str> = said.lines().filter(|line| line.contains(&place)).collect();
        let is_due = match (errors.as_slice(), case.error) {
            ([], None) => true,
            ([error], Some(due)) => error.contains(due),
            _ => false,
        };
        assert!(is_due, "{}: {errors:#?}", case.name);
    }
}
