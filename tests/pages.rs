//! The pages of the API that everybody opens stay short: the root, and what an author of a scheme needs.
//!
//! Items are counted in the source, by their `pub use`, `pub mod`, `pub type` and macros.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The text of a file.
fn text(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// The public names of a page.
fn names(file: &str) -> BTreeSet<String> {
    names_of(&text(file))
}

/// The public names of a page's source; globs, hidden items and traits without a name are left out.
fn names_of(text: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut hidden = false;
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line == "#[doc(hidden)]" {
            hidden = true;
            continue;
        }
        // Attributes and comments stand between the one that hides and the item.
        if line.starts_with('#') || line.starts_with('/') {
            continue;
        }
        let item = std::mem::take(&mut hidden);
        let Some(declared) = line
            .strip_prefix("pub ")
            .or(line.strip_prefix("macro_rules! "))
        else {
            continue;
        };
        if item {
            continue;
        }
        let mut declared = declared.to_owned();
        if declared.starts_with("use ") {
            while !declared.ends_with(';') {
                declared.push_str(lines.next().expect("the item ends"));
            }
            let list = match declared.split_once('{') {
                Some((_, list)) => list.trim_end_matches("};"),
                None => declared
                    .trim_end_matches(';')
                    .rsplit("::")
                    .next()
                    .unwrap_or_default(),
            };
            let last = |name: &str| name.rsplit(" as ").next().unwrap_or(name).trim().to_owned();
            names.extend(list.split(',').map(last));
        } else {
            let rest = ["mod ", "type ", "fn ", "struct ", "trait "];
            let rest = rest.iter().find_map(|kind| declared.strip_prefix(kind));
            let name = rest.unwrap_or(&declared);
            let is_name = |c: char| c.is_alphanumeric() || c == '_';
            names.insert(name.chars().take_while(|c| is_name(*c)).collect());
        }
    }
    names.retain(|name| !matches!(name.as_str(), "" | "*" | "_"));
    names
}

#[test]
fn the_root_has_at_most_sixty_items() {
    let mut all = names("src/lib.rs");
    all.extend(names("hamiltonian-core/src/lib.rs"));
    // Items of every kind are found, and the hidden one is not.
    for name in [
        "prelude",
        "Integrator",
        "StateOf",
        "lanes",
        "gallery",
        "hamiltonian",
    ] {
        assert!(all.contains(name), "{name} in {all:?}");
    }
    assert!(!all.contains("private"), "{all:?}");
    assert!(all.len() <= 60, "{} items: {all:?}", all.len());
}

/// The names that a glob brings into each program.
#[test]
fn the_prelude_has_at_most_sixty_names() {
    let mut all = BTreeSet::new();
    for file in ["src/lib.rs", "hamiltonian-core/src/lib.rs"] {
        let text = text(file);
        let (_, prelude) = text.split_once("pub mod prelude {\n").expect("a prelude");
        let (prelude, _) = prelude.split_once("\n}").expect("its end");
        let lines = prelude
            .lines()
            .map(|line| line.strip_prefix("    ").unwrap_or(line));
        all.extend(names_of(&lines.collect::<Vec<_>>().join("\n")));
    }
    for name in [
        "hamiltonian",
        "Integrator",
        "StormerVerlet",
        "Mask",
        "Progress",
    ] {
        assert!(all.contains(name), "{name} in {all:?}");
    }
    assert!(!all.contains("EveryParameterHasADefault"), "{all:?}");
    assert!(all.len() <= 60, "{} names: {all:?}", all.len());
}

/// Types of a scheme's own, such as scratch, are nothing that another scheme's author names.
#[test]
fn an_author_of_schemes_has_one_page() {
    let all = names("hamiltonian-core/src/schemes/author.rs");
    for name in [
        "Map",
        "Entry",
        "Step",
        "Splitting",
        "Listed",
        "Zigzag",
        "catalogue",
    ] {
        assert!(all.contains(name), "{name} in {all:?}");
    }
    assert!(all.len() <= 50, "{} items: {all:?}", all.len());
    let own = |name: &String| {
        let has = |part: &&str| name.contains(*part);
        [
            "Work",
            "Kernel",
            "Processor",
            "Corrector",
            "Mean",
            "Visitor",
            "visit_",
        ]
        .iter()
        .any(has)
    };
    assert_eq!(all.iter().find(|name| own(name)), None);
}
