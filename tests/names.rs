//! A name of a type has one meaning in a crate: no two of its types share it.
//!
//! Types are structs, enums, unions, traits and aliases, in any module. Those of tests, of bodies of functions and those
//! that a `macro_rules` makes do not count.

use crate::source::{CRATES, Module, Texts, is_word, texts, texts_of};
use std::collections::{BTreeMap, BTreeSet};

/// Names that several types of a crate share, each with the reason.
const EXCEPTIONS: [(&str, &str, &str); 2] = [
    (
        "hamiltonian-lanes",
        "AtHand",
        "one alias for each architecture",
    ),
    (
        "hamiltonian-lanes",
        "One",
        "the single number of a level, one for each architecture",
    ),
];

/// The types that a module declares at its top level, and in modules that it contains.
#[derive(Default)]
struct Declared {
    types: Vec<String>,
    /// The modules with files of their own that only tests have.
    of_tests: Vec<String>,
}

/// The names and the other characters of a code.
fn tokens(code: &str) -> Vec<&str> {
    let mut found = vec![];
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let end = match is_word(first) {
            true => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        found.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    found
}

/// Reads what the code of a file declares.
fn declared(code: &str) -> Declared {
    let mut found = Declared::default();
    // For each open bracket, true if it is that of a module.
    let mut open: Vec<bool> = vec![];
    let mut is_of_tests = false;
    let tokens = tokens(code);
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let next = |ahead| tokens.get(at + ahead).copied().unwrap_or_default();
        let is_item = open.iter().all(|is_module| *is_module);
        match *token {
            "#" if is_item && (next(1), next(2)) == ("[", "cfg") => {
                let end = tokens[at..].iter().position(|token| *token == "]");
                let attribute = &tokens[at..at + end.unwrap_or_default()];
                is_of_tests |= attribute.contains(&"test");
                at += attribute.len();
            }
            "mod" if is_item && next(2) == "{" => {
                open.push(!is_of_tests);
                at += 2;
            }
            "mod" if is_item && is_of_tests => found.of_tests.push(next(1).into()),
            "struct" | "enum" | "union" | "trait" | "type"
                if is_item && !is_of_tests && next(1).starts_with(char::is_uppercase) =>
            {
                found.types.push(next(1).into());
            }
            "{" | "(" | "[" => open.push(false),
            "}" | ")" | "]" => drop(open.pop()),
            _ => {}
        }
        if open.iter().all(|is_module| *is_module) && matches!(*token, "}" | ";") {
            is_of_tests = false;
        }
        at += 1;
    }
    found
}

/// The names that several types of a crate share, with their modules.
fn shared(texts: &Texts) -> BTreeMap<String, Vec<String>> {
    let mut of_tests: BTreeSet<Module> = BTreeSet::new();
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    // A module stands before those that it contains.
    for (module, code) in texts {
        if (1..=module.len()).any(|length| of_tests.contains(&module[..length])) {
            continue;
        }
        let found = declared(code);
        of_tests.extend(found.of_tests.into_iter().map(|name| {
            let mut path = module.clone();
            path.push(name);
            path
        }));
        for name in found.types {
            places.entry(name).or_default().push(module.join("/"));
        }
    }
    places.retain(|_, places| places.len() > 1);
    places
}

/// Shared names without an exception, and exceptions that are not needed.
fn faults(name: &str, texts: &Texts, exceptions: &[(&str, &str, &str)]) -> Vec<String> {
    let shared = shared(texts);
    let excepted: BTreeSet<&str> = (exceptions.iter())
        .filter(|(of, _, _)| *of == name)
        .map(|(_, shared, _)| *shared)
        .collect();
    let twice = shared
        .iter()
        .filter(|(name, _)| !excepted.contains(name.as_str()))
        .map(|(name, places)| format!("`{name}` is declared in {}", places.join(", ")));
    let idle = (excepted.iter())
        .filter(|name| !shared.contains_key(**name))
        .map(|name| format!("`{name}` needs no exception"));
    twice.chain(idle).collect()
}

#[test]
fn no_two_types_of_a_crate_share_a_name() {
    let found: Vec<_> = CRATES
        .iter()
        .map(|name| (name, faults(name, &texts_of(name), &EXCEPTIONS)))
        .filter(|(_, faults)| !faults.is_empty())
        .collect();
    assert!(found.is_empty(), "{found:#?}");
    for (name, _, _) in EXCEPTIONS {
        assert!(CRATES.contains(&name), "there is no crate {name}");
    }
}

#[test]
fn types_are_read() {
    let core = &texts_of("hamiltonian-core");
    let types: BTreeSet<String> = core
        .values()
        .flat_map(|code| declared(code).types)
        .collect();
    for name in ["Integrator", "Error", "System", "StateOf", "StepScratch"] {
        assert!(types.contains(name), "{name} is not read");
    }
}

#[test]
fn shared_names_are_found() {
    let one = [("a", "pub struct Row<T>(T);"), ("b", "use crate::a::Row;")];
    assert!(faults("x", &texts(&one), &[]).is_empty());
    for other in [
        "struct Row;",
        "pub(crate) enum Row { A }",
        "mod inner { pub(super) trait Row { fn f(&self) {} } }",
        "fn f() { let _ = '{'; } type Row = [u8; 2];",
        "#[cfg(feature = \"std\")] union Row { a: u8 }",
        "#[cfg(test)] mod tests { fn f() {} } struct Row;",
    ] {
        let both = texts(&[("a", "pub struct Row<T>(T);"), ("b/c", other)]);
        assert_eq!(
            faults("x", &both, &[]),
            ["`Row` is declared in a, b/c"],
            "{other}"
        );
        assert!(faults("x", &both, &[("x", "Row", "")]).is_empty());
        assert_eq!(faults("x", &both, &[("y", "Row", "")]).len(), 1);
    }
}

#[test]
fn names_inside_of_items_and_of_tests_are_free() {
    for other in [
        "fn f() { struct Row; }",
        "impl Map for A { type Row = u8; }",
        "trait A { type Row; }",
        "macro_rules! rows { () => { struct Row; }; }",
        "#[cfg(test)] mod tests { struct Row; }",
        "#[cfg(all(test, unix))] struct Row;",
        "const A: &str = \"struct Row;\"; // struct Row;",
    ] {
        let both = texts(&[("a", "struct Row;"), ("b", other)]);
        assert!(faults("x", &both, &[]).is_empty(), "{other}");
    }
    let files = texts(&[
        ("", "mod a; #[cfg(test)] mod tests;"),
        ("a", "struct Row;"),
        ("tests", "mod inner; struct Row;"),
        ("tests/inner", "struct Row;"),
    ]);
    assert!(faults("x", &files, &[]).is_empty());
}

#[test]
fn an_exception_that_is_not_needed_is_found() {
    let one = texts(&[("a", "struct Row;")]);
    assert_eq!(
        faults("x", &one, &[("x", "Row", "")]),
        ["`Row` needs no exception"]
    );
    assert!(faults("x", &one, &[("y", "Row", "")]).is_empty());
}
