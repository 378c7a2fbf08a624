//! Every refused definition of the macro's tests is refused at run time, with the same words at the same places.

use crate::common::root;
use hamiltonian_runtime::Definition;
use std::fs;

/// A refused definition, the places of its errors, and their texts.
struct Case {
    plain: String,
    places: Vec<[usize; 2]>,
    texts: String,
}

/// The text without its marks, and the places of the opening ones.
fn unmarked(marked: &str) -> (String, Vec<[usize; 2]>) {
    let (mut plain, mut places) = (String::new(), Vec::new());
    let (mut line, mut column) = (1, 1);
    for character in marked.chars() {
        match character {
            '⟦' => places.push([line, column]),
            '⟧' => {}
            '\n' => {
                plain.push(character);
                (line, column) = (line + 1, 1);
            }
            _ => {
                plain.push(character);
                column += 1;
            }
        }
    }
    (plain, places)
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for stage in ["parse", "check", "prove"] {
        let file = root().join(format!("hamiltonian-macros/src/tests/refused/{stage}.txt"));
        let text = format!("\n{}", fs::read_to_string(file).expect("there is one"));
        for case in text.split("\n====").skip(1) {
            let (_, rest) = case.split_once('\n').expect("a case has lines");
            let (marked, texts) = rest.split_once("\n--\n").expect("a case has errors");
            let (plain, places) = unmarked(marked);
            cases.push(Case {
                plain,
                places,
                texts: texts.trim_end().to_owned(),
            });
        }
    }
    cases
}

#[test]
fn refused_definitions_have_the_errors_of_the_macro() {
    let cases = cases();
    assert!(cases.len() > 300, "{} cases", cases.len());
    let mut wrong = Vec::new();
    for case in &cases {
        let Err(errors) = Definition::parse(&case.plain, "text") else {
            wrong.push(format!("accepted: {}", case.plain));
            continue;
        };
        let list = errors.list().iter();
        let texts: Vec<String> = list
            .map(|error| format!("{}\nhelp: {}", error.message, error.help))
            .collect();
        let is_marked = errors.list().iter().all(|error| {
            let at = [error.place.line, error.place.column];
            case.places.is_empty() || case.places.contains(&at) || at == [1, 1]
        });
        if texts.join("\n") != case.texts || !is_marked {
            wrong.push(format!("{}\n{errors}", case.plain));
        }
    }
    let number = wrong.len();
    assert!(number == 0, "{number} differ:\n{}", wrong.join("\n====\n"));
}

#[test]
fn an_error_is_shown_with_its_line() {
    let text = "struct Spring { k = 1 }\n\tH(q; p) = p^2/2 + kk*q^2;\n";
    let errors = Definition::parse(text, "spring.txt").unwrap_err();
    let shown = "error: unknown name `kk`\n --> spring.txt:2:20\n  |\n\
                 2 | \tH(q; p) = p^2/2 + kk*q^2;\n  | \t                  ^^\n";
    let found = errors.to_string();
    assert!(found.contains("--> spring.txt:2:20\n"), "{found}");
    let lines: Vec<&str> = found.lines().collect();
    let expected: Vec<&str> = shown.lines().collect();
    assert_eq!(lines[2..5], expected[2..5], "{found}");
}

#[test]
fn what_is_no_text_of_the_language_is_an_error() {
    for text in [
        "",
        "H = (p",
        "H = p^2 + \"",
        "}",
        "H = p^2 +",
        "é",
        "H = 1e999*p^2",
    ] {
        let errors = Definition::parse(text, "text").unwrap_err();
        assert!(!errors.list().is_empty(), "{text}");
        assert!(!errors.to_string().contains("internal"), "{text}: {errors}");
    }
}
