//! What the code of the macro states of a definition: its markers, and its description.
//!
//! Input: emitted code, the description of a system at run time. Output: both as text of the macro. Invariant: statements
//! are read from the code itself, the last of its systems, which is that of the whole H.

use hamiltonian::schemes::author::{Description, Needs};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::BTreeMap;

/// The statements on a system.
#[derive(Debug, PartialEq)]
pub struct Statements {
    /// Of each marker nothing if it is proven, or the message, the label and the note of the compile error.
    markers: BTreeMap<String, Option<[String; 3]>>,
    /// The description without the places of coordinates.
    description: String,
}

/// The markers of systems. A time-transformed system has a type of its own.
fn markers() -> impl Iterator<Item = &'static str> {
    let all = Needs::ALL.iter().map(|(_, marker)| *marker);
    all.filter(|marker| *marker != "TimeTransformed")
}

/// The tokens one after the other, groups between their delimiters.
fn flat(code: TokenStream, into: &mut Vec<String>) {
    for tree in code {
        if let TokenTree::Group(group) = &tree {
            let [open, close] = match group.delimiter() {
                Delimiter::Parenthesis => ["(", ")"],
                Delimiter::Brace => ["{", "}"],
                Delimiter::Bracket => ["[", "]"],
                Delimiter::None => ["", ""],
            };
            into.push(open.to_owned());
            flat(group.stream(), into);
            into.push(close.to_owned());
        } else {
            into.push(tree.to_string());
        }
    }
}

/// Tokens as one text.
fn tokens(text: &str) -> String {
    let mut all = Vec::new();
    flat(text.parse().expect("it is Rust"), &mut all);
    all.join(" ")
}

impl Statements {
    /// Those of emitted code.
    pub fn of_code(code: TokenStream) -> Statements {
        let mut all = Vec::new();
        flat(code, &mut all);
        let start = all.iter().rposition(|token| token == "described");
        let all = &all[start.expect("a system is described")..];
        let after = |at: usize, words: &str| {
            let mut words = words.split(' ').enumerate();
            words.all(|(k, word)| all.get(at + k).is_some_and(|token| token == word))
        };
        let until = |at: usize, end: &str| {
            let count = all[at..].iter().position(|token| token == end);
            at..at + count.expect("it ends")
        };
        let mut proven = BTreeMap::new();
        let mut reasons: BTreeMap<&str, [String; 3]> = BTreeMap::new();
        for at in 0..all.len() {
            if after(at, "on_unimplemented ( message =") {
                // message = "…", label = "…", note = "…", note = "…"
                let texts = [4, 8, 12].map(|k| all[at + k].clone());
                let name = until(at, "trait").end + 1;
                reasons.insert(&all[name], texts);
            }
            for marker in markers() {
                if after(at, &format!("__h : : {marker} for")) {
                    let head = &all[until(at, "{")];
                    // … where for<'a> &'a Name: Bound
                    let condition = head.iter().rposition(|token| token == "where");
                    let bound = condition.and_then(|_| head.iter().rfind(|token| *token != ","));
                    let reason = bound.map(|bound| reasons[bound.as_str()].clone());
                    proven.insert(marker.to_owned(), reason);
                }
            }
            let list = match () {
                () if after(at, "known !") => {
                    let first = until(at, ";").end + 1;
                    until(first, ";")
                }
                () if after(at, "halves !") => {
                    let end = until(at, ";").start.max(until(at, ")").end);
                    let colon = all[at..end].iter().rposition(|token| token == ":");
                    at + colon.expect("it has a list")..end
                }
                () => continue,
            };
            for word in &all[list] {
                let word = if word == "DriftFirst" { "Split" } else { word };
                if markers().any(|marker| marker == word) {
                    proven.insert(word.to_owned(), None);
                }
            }
        }
        // described ! { … ; [groups] … }
        let first = until(0, ";");
        let (mut depth, mut last) = (1, first.end + 2);
        while depth > 0 {
            depth += i32::from(all[last] == "[") - i32::from(all[last] == "]");
            last += 1;
        }
        let rest = &all[until(last, "}")];
        let description = [&all[3..first.end], rest].concat().join(" ");
        Statements {
            markers: proven,
            description,
        }
    }

    /// Those of a system at run time.
    pub fn of_system(description: &Description) -> Statements {
        let reason = |marker: &str| {
            let mut missing = description.missing.iter();
            let missing = missing.find(|missing| missing.marker == marker)?;
            let texts = [&missing.message, &missing.label, &missing.note];
            // Braces would be placeholders.
            Some(texts.map(|text| format!("{:?}", text.replace('{', "{{").replace('}', "}}"))))
        };
        let proven = markers().map(|marker| (marker.to_owned(), reason(marker)));
        let option = |value: Option<String>| match value {
            Some(value) => format!("__h::Option::Some({value})"),
            None => "__h::Option::None".to_owned(),
        };
        let time = description.fictitious_time.as_ref();
        let time = option(time.map(|time| format!("__h::Cow::Borrowed({time:?})")));
        let growth = option(description.growth.map(|power| power.to_string()));
        let observables = description.observables.iter().map(|of| {
            format!(
                "__h::observable(__h::ObservableKind::{:?}, {:?}, {}, {:?})",
                of.kind, of.name, of.depends_on_time, of.reads,
            )
        });
        let pieces = description.pieces.iter();
        let pieces =
            pieces.map(|of| format!("__h::piece({:?}, {:?}, {})", of.name, of.formula, of.jumps));
        let text = format!(
            "{:?}, {:?}, {}, {}, {growth}, {:?}, {time} [{}] [{}] [{}]",
            description.name,
            description.formula,
            description.is_forced,
            description.is_autonomous,
            description.jumps,
            observables.collect::<Vec<_>>().join(", "),
            { description.cyclic.iter() }
                .map(|name| format!("{name:?}"))
                .collect::<Vec<_>>()
                .join(", "),
            pieces.collect::<Vec<_>>().join(", "),
        );
        Statements {
            markers: proven.collect(),
            description: tokens(&text),
        }
    }
}
