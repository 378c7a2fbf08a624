//! The code of the crates, for tests that read it.
//!
//! Input: the files of a crate. Output: the code of each module, without comments and without what stands in quotes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The crates below the facade.
pub const CRATES: [&str; 7] = [
    "hamiltonian-real",
    "hamiltonian-lanes",
    "hamiltonian-core",
    "hamiltonian-symbolic",
    "hamiltonian-language",
    "hamiltonian-macros",
    "hamiltonian-runtime",
];

/// The path of a module, from the root of its crate.
pub type Module = Vec<String>;

/// The code of every module of a crate.
pub type Texts = BTreeMap<Module, String>;

/// The modules of a crate of the workspace.
pub fn texts_of(name: &str) -> Texts {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let mut texts = Texts::new();
    read(&root.join(name).join("src"), &vec![], &mut texts);
    assert!(texts.len() > 5, "{name}: nothing was read");
    texts
}

/// Modules written down: a path and its text.
pub fn texts(modules: &[(&str, &str)]) -> Texts {
    let named = |path: &str| -> Module {
        let names = path.split('/').filter(|name| !name.is_empty());
        names.map(String::from).collect()
    };
    let texts = modules.iter().map(|(path, text)| (named(path), code(text)));
    texts.collect()
}

/// Reads the modules below a folder, whose own module is `at`.
fn read(folder: &Path, at: &Module, texts: &mut Texts) {
    for entry in fs::read_dir(folder).expect("it can be listed") {
        let path = entry.expect("it can be listed").path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let mut module = at.clone();
        if path.is_dir() {
            module.push(name.into());
            read(&path, &module, texts);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            if !matches!(&*name, "lib" | "main" | "mod") {
                module.push(name.into());
            }
            let text = fs::read_to_string(&path).expect("it can be read");
            texts.insert(module, code(&text));
        }
    }
}

/// Returns true for a character of a name.
pub fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// A text without its comments and without what stands in quotes. Lines stay.
fn code(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        let length = match next {
            '/' | '"' | '\'' | 'r' => left_out(rest, code.ends_with(is_word)),
            _ => 0,
        };
        if length == 0 {
            code.push(next);
            rest = &rest[next.len_utf8()..];
        } else {
            let (out, after) = rest.split_at(length);
            code.push(' ');
            code.extend(out.chars().filter(|c| *c == '\n'));
            rest = after;
        }
    }
    code
}

/// The length of the comment or literal at the beginning of a text; 0 if there is none.
fn left_out(text: &str, follows_word: bool) -> usize {
    let until = |end: &str, from: usize| text[from..].find(end).map(|at| from + at + end.len());
    if text.starts_with("//") {
        return text.find('\n').unwrap_or(text.len());
    }
    if text.starts_with("/*") {
        return until("*/", 2).unwrap_or(text.len());
    }
    if text.starts_with('"') {
        return quoted(text, '"').unwrap_or(text.len());
    }
    if text.starts_with('\'') {
        // A lifetime has no second quote after its first character.
        let length = quoted(text, '\'').unwrap_or(0);
        let is_character = text[..length].chars().count() == 3 || text.starts_with("'\\");
        return if is_character { length } else { 0 };
    }
    let hashes = text[1..].chars().take_while(|c| *c == '#').count();
    if follows_word || !text[1 + hashes..].starts_with('"') {
        return 0;
    }
    let end = format!("\"{}", "#".repeat(hashes));
    until(&end, 2 + hashes).unwrap_or(text.len())
}

/// The length of a literal between two quotes, in which a backslash escapes the next character.
fn quoted(text: &str, quote: char) -> Option<usize> {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            _ if c == quote => return Some(at + c.len_utf8()),
            _ => {}
        }
    }
    None
}

#[test]
fn comments_and_literals_are_left_out() {
    let kept = |text| {
        let code = code(text);
        code.split_whitespace()
            .map(String::from)
            .collect::<Vec<_>>()
    };
    assert_eq!(kept("a // b\nc /* d\n e */ f"), ["a", "c", "f"]);
    assert_eq!(kept(r#"a("b // \" {", c)"#), ["a(", ",", "c)"]);
    assert_eq!(kept("x = r#\"{ \" }\"#; y"), ["x", "=", ";", "y"]);
    assert_eq!(kept("'{' '\\'' b'\"' &'a str, 'a'"), ["b", "&'a", "str,"]);
    assert_eq!(kept("for r in bar\"{\""), ["for", "r", "in", "bar"]);
    assert_eq!(code("a /* \n */ b // c\nd").lines().count(), 3);
}
