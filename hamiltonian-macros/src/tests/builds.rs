//! Numbers are exact until the end, and no definition hangs the macro.

use crate::backend;
use hamiltonian_language::read;
use hamiltonian_language::report::Report;
use proc_macro2::TokenStream;
use quote::quote;
use std::fmt::Write;
use std::str::FromStr;
use std::time::{Duration, Instant};

/// The emitted code, or the errors, each with the source it stands at.
pub(super) fn built(source: &str) -> Result<String, Vec<(String, String)>> {
    let stream = TokenStream::from_str(source).expect("the source has balanced brackets");
    let mut report = Report::default();
    let (_, checked) = read(stream, &mut report);
    let code = checked.and_then(|checked| backend::generate(&checked, &quote!(::h), &mut report));
    match code.and_then(|code| report.barrier(code)) {
        Some(code) => Ok(code.to_string()),
        None => Err(report
            .errors()
            .iter()
            .map(|error| {
                let (start, end) = (error.spans.start.start(), error.spans.end.end());
                let place = source.chars().skip(start.column);
                let place = place.take(end.column - start.column).collect();
                (
                    error.text().lines().next().unwrap_or_default().to_owned(),
                    place,
                )
            })
            .collect()),
    }
}

/// H as the emitted code prints it.
fn hamiltonian(right: &str) -> String {
    let code = built(&format!("H(q; p) = p^2/2 + {right}")).unwrap_or_else(|e| panic!("{e:?}"));
    let (_, text) = code.split_once("\"H(q; p) = p^2/2").expect("H is printed");
    text.split_once('"').expect("the text ends").0.to_owned()
}

fn only_error(right: &str) -> (String, String) {
    match built(&format!("H(q; p) = p^2/2 + {right}")) {
        Ok(code) => panic!("{right} is accepted: {code}"),
        Err(errors) => {
            assert_eq!(errors.len(), 1, "{errors:?}");
            errors[0].clone()
        }
    }
}

#[test]
fn numbers_are_exact_until_the_end() {
    for (right, expected) in [
        ("q*2^1025/2^1024", " + 2*q"),
        ("q*2^100000/2^99999", " + 2*q"),
        ("q*3^-100000*3^100001", " + 3*q"),
        ("q*sin(pi)", ""),
        ("q*cos(pi)", " - q"),
        ("q*sin(-pi/2)", " - q"),
        ("q*sin(7*pi/6)", " - q/2"),
        ("q*cos(2*pi/3)", " - q/2"),
        ("q*tan(3*pi/4)", " - q"),
        ("q*sin(pi/4)^2", " + q/2"),
        ("q*cos(pi/6)^2", " + 0.75*q"),
        ("q*acos(-1)/pi", " + q"),
        ("q*asin(1/2)/pi", " + q/6"),
        ("q*atan(-1)/pi", " - q/4"),
        ("q*acosh(1)", ""),
        // Not exact, so left alone.
        ("q*sin(1)", " + q*sin(1)"),
        ("q*sin(pi/5)", " + q*sin(pi/5)"),
    ] {
        assert_eq!(hamiltonian(right), expected, "{right}");
    }
}

#[test]
fn numbers_that_leave_f64_are_an_error_where_they_are_made() {
    let (large, small) = (
        "a number here is larger than any f64",
        "a number here is smaller than any f64 but not 0",
    );
    for (right, message, place) in [
        ("q*2^1025", large, "2^1025"),
        ("q*(3*2^100000) + q^2", large, "2^100000"),
        ("1e300*q*1e200", large, "1e300*q*1e200"),
        ("q*(1e-300*1e-200)", small, "(1e-300*1e-200)"),
        ("q*exp(1000)", large, "exp(1000)"),
        ("q*exp(-1000)", small, "exp(-1000)"),
        ("q*pi^-700", small, "pi^-700"),
        ("q*(1/3)^1000000", small, "(1/3)^1000000"),
        ("q*1e400", large, "1e400"),
        ("q*1e-400", small, "1e-400"),
        ("q*sqrt(exp(-1000) + exp(-1001))", small, "exp(-1000)"),
        ("q/(1e300*exp(-1000))", small, "exp(-1000)"),
        // Only the derivative makes it.
        ("1e308*q^3", large, "p^2/2 + 1e308*q^3"),
        ("q*tan(pi/2)", "`tan` of pi/2 is not a real number", "pi/2"),
    ] {
        let (text, at) = only_error(right);
        assert_eq!((text.as_str(), at.as_str()), (message, place), "{right}");
    }
}

/// A constant that leaves the range of `f64` only before simplification is accepted.
#[test]
fn numbers_that_return_to_f64_are_accepted() {
    for (right, expected) in [
        ("q*1e400/1e399", " + 10*q"),
        ("q*(1e-400*1e399)", " + 0.1*q"),
        ("q*exp(710)/exp(709)", " + q*exp(1)"),
        ("q*exp(1000)*exp(-1000)", " + q"),
        ("q*ln(exp(1000))", " + 1000*q"),
        ("q*sqrt(1e400)/1e200", " + q"),
        ("q*pi^700/pi^700", " + q"),
        ("q*3^1000000*(1/3)^1000000", " + q"),
        ("q*(1 + exp(-1000))", " + q*(exp(-1000) + 1)"),
        ("q*cosh(exp(-1000))", " + q*cosh(exp(-1000))"),
    ] {
        assert_eq!(hamiltonian(right), expected, "{right}");
    }
}

#[test]
fn repeated_squaring_ends() {
    let squared = |first: &str, levels: usize| {
        let mut source = format!("struct S {{ m = 2.0 }} let a0 = {first}; ");
        for level in 1..=levels {
            let _ = write!(source, "let a{level} = a{0}*a{0}; ", level - 1);
        }
        format!("{source} H(q; p) = p^2/2 + q*a{levels}")
    };
    let powers = |first: &str, levels: usize| {
        let (open, close) = ("(".repeat(levels), "^2)".repeat(levels));
        format!("H(q; p) = p^2/2 + q*{open}{first}{close}")
    };
    let mixed = |levels: usize| {
        let mut source = String::from("let a0 = sin(q); ");
        for level in 1..=levels {
            let _ = write!(source, "let a{level} = a{0}*a{0}*sin(a{0}); ", level - 1);
        }
        format!("{source} H(q; p) = p^2/2 + a{levels}")
    };
    for levels in [5, 60] {
        for (source, is_number) in [
            (squared("q", levels), false),
            (squared("m", levels), false),
            (squared("(q + 1)", levels), false),
            (squared("1.5", levels), true),
            (squared("pi", levels), true),
            (powers("q", levels), false),
            (powers("3", levels), true),
            (mixed(levels), false),
        ] {
            let start = Instant::now();
            let result = built(&source);
            assert!(start.elapsed() < Duration::from_secs(20), "{source}");
            match result {
                Ok(_) => assert!(!is_number || levels == 5, "{source}"),
                Err(errors) => {
                    assert!(is_number && levels > 5, "{errors:?}");
                    assert_eq!(errors[0].0, "a number here is larger than any f64");
                }
            }
        }
    }
}

/// The operations of a function as the documentation counts them.
fn operations(source: &str, function: &str) -> u32 {
    let code = built(source).unwrap_or_else(|e| panic!("{e:?}"));
    let (_, row) = code
        .split_once(&format!("| `{function}` |"))
        .expect("the operations are counted");
    let row = row.split("\\n").next().expect("the row ends");
    let mut cells = row.split('|').filter_map(|cell| cell.trim().parse().ok());
    cells.next_back().expect("the row has a sum")
}

#[test]
fn elements_named_one_by_one_cost_what_scalars_cost() {
    for count in [3, 6, 20, 50] {
        let list = |name: &str| {
            let names: Vec<String> = (0..count).map(|at| format!("{name}{at}")).collect();
            names
        };
        let (q, p) = (list("q"), list("p"));
        let kinetic: Vec<String> = p.iter().map(|p| format!("{p}^2")).collect();
        let scalars = format!(
            "struct A {{}} H({}; {}) = {} + ({})/2",
            q.join(", "),
            p.join(", "),
            q.join("*"),
            kinetic.join(" + "),
        );
        let product: Vec<String> = (0..count).map(|at| format!("q[{at}]")).collect();
        let kinetic: Vec<String> = (0..count).map(|at| format!("p[{at}]^2")).collect();
        let array = format!(
            "struct A {{}} H(q[{count}]; p[{count}]) = {} + ({})/2",
            product.join("*"),
            kinetic.join(" + "),
        );
        for function in ["energy", "gradient", "energy_and_gradient"] {
            let (a, b) = (operations(&array, function), operations(&scalars, function));
            assert_eq!(a, b, "{function} of {count}");
            // A product and its derivatives, and the kinetic energy with its halves.
            assert!(a <= 3 * count + 2 * count + 2, "{function} of {count}: {a}");
        }
    }
}

/// The code grows with H: past `LARGE` nodes the gradient stands in for the functions
/// that it is made of, and every one is still there.
#[test]
fn a_large_h_is_written_out_fewer_times() {
    let sines = |terms: usize| {
        let mut source = "H(q; p) = p^2/2".to_owned();
        for k in 2..terms + 2 {
            let _ = write!(source, " + p*sin({k}*q)");
        }
        let code = built(&source).unwrap_or_else(|e| panic!("{e:?}"));
        for method in ["gradient_q", "gradient_p", "gradient"] {
            assert!(code.contains(&format!("fn {method} (& self")), "{method}");
        }
        let is_made = code.contains(" , __h :: OfGradient ,");
        (code.matches(". sin").count() / terms, is_made)
    };
    let ((small, is_made), (large, is_made_of_large)) = (sines(200), sines(400));
    assert!(!is_made && is_made_of_large);
    assert!(
        2 * large <= small,
        "{large} sines a term, {small} where H is small"
    );
}

/// The conditions under which the emitted code has its traits, those that never hold among them, and what its pieces are.
fn traits(source: &str) -> Vec<String> {
    let code = built(source).unwrap_or_else(|errors| panic!("{source}: {errors:?}"));
    let words = code.split(|c: char| !c.is_alphanumeric() && c != '_');
    let is_trait = |word: &&str| {
        let never = word.strip_prefix("__");
        never.is_some_and(|name| name.starts_with(char::is_uppercase))
            || ["Shifts", "Moves", "Kick", "Nystrom"].contains(word)
    };
    let mut traits: Vec<String> = words.filter(is_trait).map(str::to_owned).collect();
    traits.sort();
    traits
}

/// Another order of terms, factors and coordinates, other names, a parameter that nothing reads, and an added constant
/// keep the traits.
#[test]
fn systems_that_are_written_in_other_ways_have_the_same_traits() {
    const SAME: &[&[&str]] = &[
        // Nyström methods take V and T.
        &[
            "struct A { k } H(x, y; u, v) = (u^2 + v^2)/2 + k*x^2*y - y^3/3",
            "struct A { b, a } H(n, m; q, p) = -n^3/3 + m^2*n*b + (q^2 + p^2)/2",
            "struct A { k } H(x, y; u, v) = 2.5 + v^2/2 + u^2/2 - 1/3*y^3 + y*k*x^2",
        ],
        // They take pieces of an H that is not separable: a turn with free flight, and V.
        &[
            "struct A { m } H(x, y; u, v) = (u^2 + v^2)/2 + y*u - x*v - m/hypot(x, y + 1)",
            "struct A { n, m } H(b, a; d, c) = b*c - m/hypot(a, b + 1) + (c^2 + d^2)/2 - d*a",
            "struct A { m } H(x, y; u, v) = 1 - v*x + u*y + v^2/2 + u^2/2 - 1/hypot(x, y + 1)*m",
        ],
        // The paper's (34), split otherwise, and one whose momenta are not quadratic.
        &[
            "struct A { k } H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1) + k*q",
            "struct A { k, l } H(a; b) = a*k + (b^2 + 1)*(1 + a^2)*0.5 + 7",
        ],
        &[
            "struct A { } H(q; p) = cosh(p) - cos(q)",
            "struct A { s } H(a; b) = 3 - cos(a) + cosh(b)",
        ],
        // A cyclic coordinate, and the time.
        &[
            "struct A { k } H(r, f; p, l; t) = p^2/2 + l^2/(2*r^2) - k*cos(t)/r",
            "struct A { c, k } H(f, r; l, p; s) = -cos(s)/r*k + l^2/r^2/2 + p^2/2 + 4",
        ],
        // Damping.
        &[
            "struct A { g } H(q; p) = p^2/2 - cos(q); force(q; p) = -g*p",
            "struct A { h, g } H(a; b) = 1 - cos(a) + b^2/2; force(a; b) = -b*g",
        ],
    ];
    let mut different = Vec::new();
    for same in SAME {
        let first = traits(same[0]);
        for other in &same[1..] {
            assert_eq!(first, traits(other), "{other}");
        }
        if !different.contains(&first) {
            different.push(first);
        }
    }
    // Each of these systems has a structure of its own.
    assert_eq!(different.len(), SAME.len(), "{different:#?}");
}
