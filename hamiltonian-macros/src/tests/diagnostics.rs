//! Every diagnostic: its words, its place, and the stage that finds it.
//!
//! `refused` holds a file for each stage. A case is a definition with each error between `⟦` and
//! `⟧`, a line `--`, and the texts of the errors in their order. A line of four `=` stands before
//! each case, with a remark behind it or none. `HAMILTONIAN_RECORD=1` writes down the errors as they
//! are now: read the difference before you keep it.

use super::{Stage, refuse, unmarked};
use hamiltonian_language::report::Diagnostic;
use proc_macro2::LineColumn;
use std::fs;
use std::path::PathBuf;

const SEPARATOR: &str = "\n====";

struct Case {
    remark: String,
    marked: String,
    texts: String,
}

fn file(stage: Stage) -> PathBuf {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/src/tests/refused");
    PathBuf::from(directory).join(format!("{stage:?}.txt").to_lowercase())
}

fn cases(stage: Stage) -> Vec<Case> {
    let text = fs::read_to_string(file(stage)).expect("each stage has a file");
    let text = format!("\n{}", text.replace("\r\n", "\n"));
    let case = |case: &str| {
        let (remark, rest) = case.split_once('\n').expect("a case has lines");
        let (marked, texts) = rest.split_once("\n--\n").expect("a case has errors");
        Case {
            remark: remark.trim().to_owned(),
            marked: marked.to_owned(),
            texts: texts.trim_end().to_owned(),
        }
    };
    text.split(SEPARATOR).skip(1).map(case).collect()
}

fn record(stage: Stage, cases: &[Case]) {
    let case = |case: &Case| {
        let head = format!("==== {}", case.remark);
        format!("{}\n{}\n--\n{}\n", head.trim_end(), case.marked, case.texts)
    };
    let text: String = cases.iter().map(case).collect();
    fs::write(file(stage), text).expect("the sources can be written to");
}

/// The source with its errors marked.
fn marked(source: &str, errors: &[Diagnostic]) -> String {
    let mut marks: Vec<(LineColumn, char)> = Vec::new();
    for error in errors {
        let (start, end) = (error.spans.start.start(), error.spans.end.end());
        if start != end {
            marks.extend([(start, '⟦'), (end, '⟧')]);
        }
    }
    // Pieces that end somewhere end before others begin there.
    marks.sort_by_key(|&(place, mark)| (place.line, place.column, mark == '⟦'));
    let mut marks = marks.into_iter().peekable();
    let (mut text, mut here) = (String::new(), LineColumn { line: 1, column: 0 });
    for character in source.chars().chain(['\0']) {
        while let Some((_, mark)) = marks.next_if(|(place, _)| *place <= here) {
            text.push(mark);
        }
        text.push(character);
        here = match character {
            '\n' => LineColumn {
                line: here.line + 1,
                column: 0,
            },
            _ => LineColumn {
                column: here.column + 1,
                ..here
            },
        };
    }
    text.trim_end_matches('\0').to_owned()
}

fn check(stage: Stage) {
    let mut wrong = Vec::new();
    let mut found = Vec::new();
    for case in cases(stage) {
        let (plain, _) = unmarked(&case.marked);
        let (refused_by, errors) = refuse(&plain);
        let texts: Vec<String> = errors.iter().map(Diagnostic::text).collect();
        let new = Case {
            remark: case.remark,
            marked: marked(&plain, &errors),
            texts: texts.join("\n"),
        };
        if refused_by != Some(stage) || new.marked != case.marked || new.texts != case.texts {
            wrong.push(format!("{refused_by:?}: {}\n--\n{}", new.marked, new.texts));
        }
        found.push(new);
    }
    assert!(found.len() > 50, "{} cases", found.len());
    if std::env::var_os("HAMILTONIAN_RECORD").is_some_and(|value| value == "1") {
        record(stage, &found);
    } else {
        let number = wrong.len();
        assert!(number == 0, "{number} differ:\n{}", wrong.join("\n====\n"));
    }
}

#[test]
fn of_the_parser() {
    check(Stage::Parse);
}

#[test]
fn of_the_checker() {
    check(Stage::Check);
}

#[test]
fn of_the_back_end() {
    check(Stage::Prove);
}

/// Beside an invariant that jumps and a split that is undecided.
#[test]
fn definitions_near_an_error_are_accepted() {
    for source in [
        "pub struct OneSided { k = 1.0 }
         H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + if x > 0 { k*x^2/2 } else { 0 };
         invariant along = p_y;
         invariant energy_across = p_x^2/2 + if x > 0 { k*x^2/2 } else { 0 }",
        "pub struct Analytic {}
         fn f(x) = sin, (cos);
         H = p^2/2 + f(q)/q^2;
         invariant twice = p^2 + 2*f(q)/q^2",
        "pub struct Short {}
         H(q[3]; p[3]) = norm_squared(p)/2 + sum(i in 0..3, j in 0..i) { cos(q[i] - q[j]) };
         split {
             Kinetic = norm_squared(p)/2;
             Pairs = cos(q[0] - q[1]) + cos(q[1] - q[2]) + cos(q[2] - q[0])
         }",
        "pub struct Assumed<const N: usize> {}
         H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in 0..N) { q[i]*q[(i + 1) % N] };
         #[assume]
         split {
             Kinetic = norm_squared(p)/2;
             Chain = sum(i in 0..N - 1) { q[i]*q[i + 1] } + q[N - 1]*q[0]
         }",
    ] {
        let (stage, errors) = refuse(source);
        assert_eq!(stage, None, "{errors:?}");
    }
}

/// Beside a piece without an exact flow: what the help lists has one.
#[test]
fn pieces_of_the_forms_that_the_help_lists_are_accepted() {
    for (piece, has_flow) in [
        ("q^-2*p^3", true),
        ("(1 + 2*q + 3*q^2)*p", true),
        ("exp(2*q)*p", true),
        ("(1 + 2*cos(q) + sin(q))*p", true),
        ("sinh(q)*p", true),
        ("(1 + 2*q + 3*q^2)*p^2", true),
        ("(1/q^2 + 2 + 3*q^2)*p^2", true),
        ("(q^2 + 2*q^3 + 3*q^4)*p^2", true),
        ("(q + q^3)*p", false),
        ("(1 + q^3)*p^2", false),
        ("p^2/(1 + q^2)", false),
    ] {
        let source =
            format!("pub struct S {{}} H = {piece} + q^4; split {{ A = {piece}; B = q^4 }}");
        let (stage, errors) = refuse(&source);
        let expected = (!has_flow).then_some(Stage::Prove);
        assert_eq!(stage, expected, "{piece}: {errors:?}");
    }
}
