//! Every diagnostic: its words and its place.

use super::{read, refused::CASES, unmarked};
use crate::report::Diagnostic;
use proc_macro2::LineColumn;

fn place(error: &Diagnostic) -> (LineColumn, LineColumn) {
    (error.spans.start.start(), error.spans.end.end())
}

/// The source with its errors marked, and their words, as the table has them.
fn shown(source: &str, errors: &[Diagnostic]) -> String {
    let mut marks: Vec<(LineColumn, bool)> = Vec::new();
    for error in errors {
        let (start, end) = place(error);
        if start != end {
            marks.push((start, true));
            marks.push((end, false));
        }
    }
    let mut text = String::new();
    for (number, line) in source.lines().enumerate() {
        let letters: Vec<char> = line.chars().collect();
        for column in 0..=letters.len() {
            let here = LineColumn {
                line: number + 1,
                column,
            };
            text.extend(
                marks
                    .iter()
                    .filter(|mark| mark.0 == here && !mark.1)
                    .map(|_| '⟧'),
            );
            text.extend(
                marks
                    .iter()
                    .filter(|mark| mark.0 == here && mark.1)
                    .map(|_| '⟦'),
            );
            text.extend(letters.get(column));
        }
        text.push('\n');
    }
    let texts: Vec<String> = errors.iter().map(Diagnostic::text).collect();
    format!("{}\n---\n{}", text.trim_end_matches('\n'), texts.join("\n"))
}

#[test]
fn every_diagnostic_has_its_words_and_its_place() {
    let mut wrong = Vec::new();
    for (source, expected) in CASES {
        let (plain, _) = unmarked(source);
        let (_, _, report) = read(&plain);
        let found = shown(&plain, report.errors());
        if found != format!("{source}\n---\n{expected}") {
            wrong.push(found);
        }
    }
    assert!(
        wrong.is_empty(),
        "{} differ:\n{}",
        wrong.len(),
        wrong.join("\n=====\n")
    );
}
