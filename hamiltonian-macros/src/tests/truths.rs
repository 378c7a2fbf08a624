//! Statements of mechanics, true and false: the true ones are proven, of the false ones none.
//!
//! `truths/true.txt` and `truths/false.txt` hold a definition a case, after a line of four `=` with its
//! source or its fault. Of a false case each statement is to be refused; of those in `truths/disproven.txt`, by a point.

mod faults;

use super::read;
use faults::{CLASSES, Random};
use hamiltonian_language::analyse::proofs::prove;
use hamiltonian_language::lower::lower;

/// The errors of a definition up to its proofs, and the number of statements in it.
fn judged(source: &str) -> (Vec<String>, usize) {
    let (_, checked, mut report) = read(source);
    let mut count = 0;
    if let Some(checked) = checked
        && let Some(mut lowered) = lower(&checked, &mut report)
    {
        count = checked.observables.len();
        prove(&checked, &mut lowered, &mut report);
    }
    let errors = report.errors().iter().map(|error| error.text()).collect();
    (errors, count)
}

/// The cases of a file: what stands beside the mark, and the definition.
fn cases(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let cases = text.split("\n====").skip(1);
    cases.map(|case| {
        case.trim()
            .split_once('\n')
            .expect("a case has a definition")
    })
}

#[test]
fn true_statements_are_proven() {
    let mut refused = Vec::new();
    for (source, definition) in cases(include_str!("truths/true.txt")) {
        let (errors, count) = judged(definition);
        if count == 0 || !errors.is_empty() {
            refused.push(format!("{source}: {errors:#?} of {count} statements"));
        }
    }
    assert!(refused.is_empty(), "{}", refused.join("\n"));
}

/// What is listed as undecided is so: a rule that proves it takes it off the list.
#[test]
fn undecided_statements_are_listed() {
    for (source, definition) in cases(include_str!("truths/undecided.txt")) {
        let (errors, _) = judged(definition);
        let is_open = |error: &String| error.starts_with("it is n");
        assert!(!errors.is_empty(), "{source}: it is proven");
        assert!(errors.iter().all(is_open), "{source}: {errors:#?}");
    }
}

#[test]
fn false_statements_are_not_proven() {
    let mut accepted = Vec::new();
    for (fault, definition) in cases(include_str!("truths/false.txt")) {
        let (errors, count) = judged(definition);
        let is_verdict = |error: &&String| error.contains("conserved") || error.contains("shell");
        let verdicts = errors.iter().filter(is_verdict).count();
        if count == 0 || verdicts != count {
            accepted.push(format!("{fault}: {errors:#?} of {count} statements"));
        }
    }
    assert!(accepted.is_empty(), "{}", accepted.join("\n"));
}

#[test]
fn false_statements_are_disproven() {
    let mut open = Vec::new();
    for (case, definition) in cases(include_str!("truths/disproven.txt")) {
        let (errors, _) = judged(definition);
        if !(matches!(errors.as_slice(), [error] if error.contains(" is not conserved"))) {
            open.push(format!("{case}: {errors:#?}"));
        }
    }
    assert!(open.is_empty(), "{}", open.join("\n"));
}

/// Definitions of each class of faults: 100, with `HAMILTONIAN_HEAVY=1` 400.
#[test]
fn of_generated_false_statements_none_is_proven() {
    let is_heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    let count = if is_heavy { 400 } else { 100 };
    let mut accepted: Vec<String> = Vec::new();
    for (class, seed, definition) in CLASSES {
        let mut random = Random(*seed);
        for _ in 0..count {
            let definition = definition(&mut random);
            let (errors, statements) = judged(&definition);
            let is_verdict =
                |error: &String| error.contains("conserved") || error.contains("orbits leave");
            assert!(
                statements == 1 && errors.iter().all(is_verdict),
                "{class}: {definition}: {errors:?}"
            );
            if errors.is_empty() {
                accepted.push(format!("{class}: {definition}"));
            }
        }
    }
    assert!(accepted.is_empty(), "{accepted:#?}");
}
