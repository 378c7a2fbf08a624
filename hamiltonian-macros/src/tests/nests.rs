//! Loops that choose components are unrolled wherever they stand among loops that stay: the sum
//! is the one written term by term.

use super::accept;
use hamiltonian_language::lower;
use hamiltonian_language::report::Report;
use hamiltonian_symbolic::loops::unroll;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use std::ops::Range;

/// The values of loop variables by their names.
type Values<'a> = &'a dyn Fn(char) -> i64;

/// A loop as it is written, and the values it runs through inside others.
struct Loop {
    name: char,
    range: &'static str,
    values: fn(Values) -> Range<i64>,
}

const COLUMN: Loop = Loop {
    name: 'c',
    range: "0..3",
    values: |_| 0..3,
};

const ROW: Loop = Loop {
    name: 'i',
    range: "0..4",
    values: |_| 0..4,
};

/// A nest of sums, each around the next, over a body in which loop variables are written `$i`.
struct Nest<'a> {
    sums: Vec<&'a [Loop]>,
    body: &'static str,
}

impl Nest<'_> {
    fn loops(&self) -> Vec<&Loop> {
        self.sums.iter().flat_map(|loops| loops.iter()).collect()
    }

    fn as_sums(&self) -> String {
        let mut text = self.body.replace('$', "");
        for loops in self.sums.iter().rev() {
            let ranges = loops.iter().map(|l| format!("{} in {}", l.name, l.range));
            let ranges: Vec<String> = ranges.collect();
            text = format!("sum({}) {{ {text} }}", ranges.join(", "));
        }
        text
    }

    fn term_by_term(&self) -> String {
        let mut places: Vec<Vec<(char, i64)>> = vec![Vec::new()];
        for one in self.loops() {
            let next = places.iter().flat_map(|place| {
                let known = |name| place.iter().find(|(n, _)| *n == name).map_or(0, |e| e.1);
                (one.values)(&known).map(|value| {
                    let mut place = place.clone();
                    place.push((one.name, value));
                    place
                })
            });
            places = next.collect();
        }
        let terms = places.iter().map(|place| {
            let mut text = self.body.to_owned();
            for (name, value) in place {
                text = text.replace(&format!("${name}"), &value.to_string());
            }
            text
        });
        terms.collect::<Vec<_>>().join(" + ")
    }
}

/// Both texts are the same polynomial once loops are unrolled.
#[track_caller]
fn same(sums: &str, terms: &str) {
    let source =
        format!("H(q[4][3]; p[4][3]) = p[0][0]^2; monitor difference = ({sums}) - ({terms})");
    let checked = accept(&source);
    let mut report = Report::default();
    let lowered = lower::lower(&checked, &mut report);
    let texts: Vec<String> = report.errors().iter().map(|error| error.text()).collect();
    let model = lowered
        .unwrap_or_else(|| panic!("{sums}\n{}", texts.join("\n")))
        .model;
    let difference = model.observables[0].components[0];
    assert!(
        model.dag.variables(difference).is_empty(),
        "{sums} has open loops"
    );
    let written = unroll(&model, &[]).expect("all indices are in range");
    let difference = written.observables[0].components[0];
    assert_eq!(is_zero(&written, difference), Proof::Zero, "{sums}");
}

#[track_caller]
fn check(sums: Vec<&[Loop]>, body: &'static str) {
    let nest = Nest { sums, body };
    same(&nest.as_sums(), &nest.term_by_term());
}

#[test]
fn a_written_loop_may_stand_around_one_that_stays() {
    check(vec![&[COLUMN, ROW]], "p[$i][$c]^2");
    check(vec![&[ROW, COLUMN]], "p[$i][$c]^2");
    check(vec![&[COLUMN], &[ROW]], "q[$i][$c]*p[$i][$c]");
    check(vec![&[COLUMN, ROW]], "cross(q[$i], p[0])[$c]*p[$i][$c]^2");
    check(vec![&[COLUMN, ROW]], "[q[0][0], p[1][1], 2][$c]*$i");
}

#[test]
fn a_written_loop_may_stand_between_loops_that_stay() {
    let pair = || Loop {
        name: 'j',
        range: "0..i",
        values: |of| 0..of('i'),
    };
    check(vec![&[ROW, COLUMN, pair()]], "q[$i][$c]*p[$j][$c]");
    check(vec![&[COLUMN, ROW, pair()]], "q[$i][$c]*p[$j][$c]*$c");
    check(vec![&[ROW, pair(), COLUMN]], "q[$i][$c]*p[$j][$c] + $i*$j");
    check(vec![&[ROW], &[COLUMN], &[pair()]], "p[$j][$c]^2");
}

#[test]
fn the_range_of_a_loop_may_need_the_number_of_a_written_one() {
    let below = || Loop {
        name: 'k',
        range: "0..c + 1",
        values: |of| 0..of('c') + 1,
    };
    // Its own range does not need the number, but that of the loop around it does.
    let inside = || Loop {
        name: 'j',
        range: "0..k",
        values: |of| 0..of('k'),
    };
    check(vec![&[COLUMN, below()]], "p[$k][$c]^2");
    check(vec![&[COLUMN], &[below()]], "p[$k][$c]^2");
    check(vec![&[COLUMN, ROW, below()]], "p[$k][$c]^2*q[$i][0]");
    check(vec![&[ROW, COLUMN, below()]], "p[$k][$c]*q[$i][0]");
    check(vec![&[COLUMN, below(), ROW]], "p[$k][$c]*q[$i][$c]*$k");
    check(vec![&[COLUMN, below(), inside()]], "q[$j][0] + p[$j][$c]^2");
    check(vec![&[COLUMN, below(), inside()]], "q[$j][0]*p[0][$c]");
    // Another written loop that ends where the first is.
    let fewer = || Loop {
        name: 'd',
        range: "c..3",
        values: |of| of('c')..3,
    };
    check(
        vec![&[COLUMN, ROW, fewer(), below()]],
        "q[$i][$c]*p[$k][$d]",
    );
}

/// The only error of lowering.
#[track_caller]
fn refused(source: &str) -> String {
    let checked = accept(source);
    let mut report = Report::default();
    assert!(lower::lower(&checked, &mut report).is_none());
    let texts: Vec<String> = report.errors().iter().map(|error| error.text()).collect();
    assert_eq!(texts.len(), 1, "{texts:?}");
    texts[0].clone()
}

#[test]
fn a_written_loop_has_a_range_in_numbers_that_is_not_too_long() {
    let named =
        "struct A<const N: usize> {} H(q[N]; p[N]) = sum(i in 0..N) { [p[0], q[0]][i % 2] }";
    assert!(
        refused(named).starts_with("a loop that chooses components must have a literal range\n")
    );
    let long = [
        "sum(i in 0..300000) { [p, q][i % 2] }",
        "sum(i in 0..600, j in 0..i + 600) { [p, q][(i + j) % 2] }",
    ];
    for sum in long {
        let start =
            "loops that choose components are unrolled, and here they run more than 262144 times\n";
        assert!(refused(&format!("H(q; p) = {sum}")).starts_with(start));
    }
}

#[test]
fn a_sum_over_a_written_loop_may_be_an_operand() {
    same(
        "sum(c in 0..3) { (sum(i in 0..2) { p[i][c] })^2 }",
        "(p[0][0] + p[1][0])^2 + (p[0][1] + p[1][1])^2 + (p[0][2] + p[1][2])^2",
    );
}
