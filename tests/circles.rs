//! In each folder the files and subfolders use each other in no circle.
//!
//! An entry of a folder is a file with its own subfolder, or a subfolder with a `mod.rs`. Parent and
//! child may name each other; a re-exported name counts as its defining file. A page, which re-exports and
//! does nothing else, names nobody itself. The folders of the engine, of the core and of the macro's
//! emission are layers, of which each reads only those below it.

use crate::source::{CRATES, Module, Texts, is_word, texts, texts_of};
use std::collections::{BTreeMap, BTreeSet};

/// The layers of the engine, the lowest first.
const ENGINE: &[&str] = &["algebra", "proofs", "flows", "programs"];

/// The layers of the core, the lowest first.
const CORE: &[&str] = &[
    "errors",
    "systems",
    "flows",
    "loops",
    "schemes",
    "results",
    "observers",
    "runs",
    "analysis",
    "ensembles",
    "private",
];

/// The layers of the macro's emission, the lowest first.
const EMISSION: &[&str] = &[
    "tokens",
    "definition",
    "names",
    "steps",
    "statements",
    "functions",
    "types",
    "traits",
    "items",
];

/// Every path in a text that begins with `crate`, `super`, `self` or, in a `use`, a child module; with
/// the lists in braces written out.
fn paths(text: &str, module: &Module, texts: &Texts) -> Vec<Vec<String>> {
    let mut found = vec![];
    for (at, _) in text.char_indices() {
        let (before, rest) = text.split_at(at);
        if before.ends_with(|c| is_word(c) || c == ':') || !rest.starts_with(is_word) {
            continue;
        }
        let end = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
        let first = &rest[..end];
        let in_use = before.trim_end().ends_with("use");
        let mut child = module.clone();
        child.push(first.into());
        if rest[end..].starts_with("::")
            && (matches!(first, "crate" | "super" | "self") || in_use && texts.contains_key(&child))
        {
            expand(rest, &mut vec![], &mut found);
        }
    }
    found
}

/// Reads one path, or a list of them in braces, behind `before`; returns what is left of the text.
fn expand<'a>(text: &'a str, before: &mut Vec<String>, found: &mut Vec<Vec<String>>) -> &'a str {
    let text = text.trim_start();
    if let Some(mut list) = text.strip_prefix('{') {
        loop {
            list = list.trim_start().trim_start_matches(',').trim_start();
            if list.is_empty() || list.starts_with('}') {
                return list.strip_prefix('}').unwrap_or(list);
            }
            let rest = expand(list, &mut before.clone(), found);
            if rest.len() == list.len() {
                return rest;
            }
            list = rest;
        }
    }
    let end = text.find(|c| !is_word(c)).unwrap_or(text.len());
    before.push(text[..end].into());
    match text[end..].strip_prefix("::") {
        Some(rest) if rest.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == '{') => {
            expand(rest, before, found)
        }
        _ => {
            found.push(before.clone());
            // `as Other`
            let rest = &text[end..];
            let renamed = rest.trim_start().strip_prefix("as ");
            renamed.map_or(rest, |rest| rest.trim_start().trim_start_matches(is_word))
        }
    }
}

/// The module that defines what a path in `module` names.
fn definition(path: &[String], module: &Module, texts: &Texts, depth: usize) -> Module {
    let mut at = module.clone();
    let mut names = path.iter().peekable();
    while let Some(name) = names.next_if(|name| matches!(name.as_str(), "crate" | "super" | "self"))
    {
        match name.as_str() {
            "crate" => at.clear(),
            "super" => drop(at.pop()),
            _ => {}
        }
    }
    while let Some(name) = names.next() {
        let mut child = at.clone();
        child.push(name.clone());
        if texts.contains_key(&child) {
            at = child;
            continue;
        }
        // Followed through a `pub use` of the module, which may name another one.
        let text = texts.get(&at).map_or("", String::as_str);
        for (start, _) in text.match_indices("use ") {
            if depth == 0 || !text[..start].trim_end().ends_with(['b', ')']) {
                continue;
            }
            let mut exported = vec![];
            expand(&text[start + 4..], &mut vec![], &mut exported);
            if let Some(path) = exported.iter().find(|path| path.last() == Some(name)) {
                let known = matches!(path[0].as_str(), "crate" | "super" | "self");
                let mut child = at.clone();
                child.push(path[0].clone());
                if known || texts.contains_key(&child) {
                    let rest = names.cloned();
                    let path: Vec<String> = path.iter().cloned().chain(rest).collect();
                    return definition(&path, &at, texts, depth - 1);
                }
            }
        }
        break;
    }
    at
}

/// Returns true if a module only hands names on.
fn is_page(text: &str) -> bool {
    let mut statements = text.split(';').map(str::trim);
    statements.all(|statement| statement.is_empty() || statement.starts_with("pub use "))
}

/// The entries of each folder that another entry of the same folder names.
fn uses(texts: &Texts) -> BTreeMap<Module, BTreeMap<String, BTreeSet<String>>> {
    let mut graphs: BTreeMap<Module, BTreeMap<String, BTreeSet<String>>> = BTreeMap::new();
    for (module, text) in texts.iter().filter(|(_, text)| !is_page(text)) {
        for path in paths(text, module, texts) {
            let used = definition(&path, module, texts, 8);
            let common = (module.iter().zip(&used))
                .take_while(|(a, b)| a == b)
                .count();
            // Parent and child may name each other.
            if let (Some(from), Some(to)) = (module.get(common), used.get(common)) {
                let graph = graphs.entry(module[..common].to_vec()).or_default();
                graph.entry(from.clone()).or_default().insert(to.clone());
            }
        }
    }
    graphs
}

/// Entries of a graph that are on a circle.
fn on_circles(graph: &BTreeMap<String, BTreeSet<String>>) -> Vec<String> {
    let reached = |start: &String| {
        let (mut seen, mut ahead) = (BTreeSet::new(), vec![start]);
        while let Some(next) = ahead.pop() {
            for used in graph.get(next).into_iter().flatten() {
                if seen.insert(used) {
                    ahead.push(used);
                }
            }
        }
        seen
    };
    let names = graph.keys();
    names
        .filter(|name| reached(name).contains(name))
        .cloned()
        .collect()
}

fn circles(texts: &Texts) -> Vec<String> {
    let found = uses(texts).into_iter().filter_map(|(folder, graph)| {
        let names = on_circles(&graph);
        (!names.is_empty()).then(|| format!("{}: {}", folder.join("/"), names.join(", ")))
    });
    found.collect()
}

/// The modules of a folder that are in no layer, and uses of a layer by one below it.
fn against_layers(texts: &Texts, folder: &Module, layers: &[&str]) -> Vec<String> {
    let level = |name: &String| layers.iter().position(|layer| layer == name);
    let inside = texts.keys().filter_map(|module| {
        let rest = module.strip_prefix(folder.as_slice())?;
        rest.first()
    });
    let outside = inside.filter(|name| level(name).is_none()).cloned();
    let graph = uses(texts).remove(folder).unwrap_or_default();
    let uses = (graph.iter()).flat_map(|(from, used)| used.iter().map(move |to| (from, to)));
    let upward = uses.filter(|(from, to)| level(from) < level(to));
    let upward = upward.map(|(from, to)| format!("{from} uses {to}"));
    outside.chain(upward).collect()
}

#[test]
fn no_folder_names_itself_in_a_circle() {
    for name in CRATES {
        let found = circles(&texts_of(name));
        assert!(found.is_empty(), "{name}: {found:#?}");
    }
}

#[test]
fn layers_read_those_below_them() {
    let folders = [
        ("hamiltonian-symbolic", vec![], ENGINE),
        ("hamiltonian-core", vec![], CORE),
        ("hamiltonian-macros", vec!["emit".to_owned()], EMISSION),
    ];
    for (name, folder, layers) in folders {
        let crate_texts = texts_of(name);
        let found = against_layers(&crate_texts, &folder, layers);
        assert!(found.is_empty(), "{name}: {found:#?}");
        // Each layer but the lowest is seen to read another one.
        let graph = (uses(&crate_texts).remove(&folder)).expect("layers use layers");
        let readers: BTreeSet<&str> = graph.keys().map(String::as_str).collect();
        assert_eq!(readers, layers[1..].iter().copied().collect(), "{name}");
    }
}

#[test]
fn a_use_of_a_layer_above_is_found() {
    let root = "mod algebra; mod flows; pub use algebra::dag; pub use flows::split;";
    let with = |dag, other| {
        let crate_texts = texts(&[
            ("", root),
            ("algebra", "pub mod dag;"),
            ("algebra/dag", dag),
            ("flows", "pub mod split;"),
            ("flows/split", "use crate::dag::Dag;"),
            (other, ""),
        ]);
        against_layers(&crate_texts, &vec![], ENGINE)
    };
    assert!(with("", "programs").is_empty());
    assert_eq!(
        with("use crate::split::find;", "programs"),
        ["algebra uses flows"]
    );
    assert_eq!(with("", "printing"), ["printing"]);
    // In a folder: a file of a lower layer, and a file beside the layers.
    let within = |lex, other| {
        let crate_texts = texts(&[
            ("", "mod emit; mod backend;"),
            ("backend", "use crate::emit::items::Item;"),
            ("emit", "mod items; pub use items::Item;"),
            ("emit/tokens", lex),
            ("emit/items", ""),
            ("emit/items/item", "use crate::emit::tokens::lex;"),
            (other, ""),
        ]);
        against_layers(&crate_texts, &vec!["emit".to_owned()], EMISSION)
    };
    assert!(within("", "emit/names").is_empty());
    assert_eq!(
        within("use super::items::item::Item;", "emit/names"),
        ["tokens uses items"]
    );
    assert_eq!(within("", "emit/printing"), ["printing"]);
}

#[test]
fn circles_are_found() {
    let one_way = texts(&[("", ""), ("a", "use crate::b::B;"), ("b", "pub struct B;")]);
    assert!(circles(&one_way).is_empty());
    let direct = texts(&[
        ("", ""),
        ("a", "use super::b::{B, C as D};"),
        ("b", "crate::a::f()"),
    ]);
    assert_eq!(circles(&direct), [": a, b"]);
    // By a name that the root hands on, and by a file of a subfolder.
    let hidden = texts(&[
        ("", "mod a; mod b; pub use b::{x, B};"),
        ("a", ""),
        ("a/inner", "use crate::{B};"),
        ("b", "use super::a::A;"),
    ]);
    assert_eq!(circles(&hidden), [": a, b"]);
    // A page names nobody, and what it hands on counts as its defining file.
    let page = |through: &'static str| {
        texts(&[
            ("", ""),
            ("a", through),
            ("b", "use super::a::A;"),
            ("c", "pub use crate::a::A; pub use crate::b::B;"),
        ])
    };
    assert!(circles(&page("use crate::c::A;")).is_empty());
    assert_eq!(circles(&page("use crate::c::B;")), [": a, b"]);
    // Parent and child.
    let family = texts(&[
        ("", "use a::A;"),
        ("a", "use inner::B;"),
        ("a/inner", "use super::A;"),
    ]);
    assert!(circles(&family).is_empty());
}
