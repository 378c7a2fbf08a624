//! The generator: trees from seeds, and the files the macro reads them from.

use super::interpret::Interpreted;
use crate::tree::{PAIRS, Part, Random, TIME, Test, Tree, grow};
use core::ops::Range;
use hamiltonian_symbolic::dag::{Kind, Node, Stage};
use hamiltonian_symbolic::op::Op;
use std::fmt::Write;

/// The number of points each is evaluated at.
pub const TESTS: usize = 16;

/// The first `count` trees, each with the function of `compiled.rs` that evaluates it. Every third one is made
/// a sum T(p, t) + V(q, t), all others couple. An H without momenta, which the language refuses, is
/// left out, and so is a number that is none.
pub fn trees(count: usize) -> Vec<(Tree, &'static str)> {
    let mut random = Random(0x5EED);
    let mut trees = Vec::new();
    while trees.len() < count {
        let (mut tree, _) = grow(&mut random);
        let splits = trees.len() % 3 == 0;
        if splits {
            let (potential, _) = grow(&mut random);
            tree = sum(&on_side(&tree, PAIRS), &on_side(&potential, 0));
        }
        tree = in_source_order(&tree);
        if tree.text().len() >= 2000 || has_bad_number(&tree) {
            continue;
        }
        let interpreted = Interpreted::of(&tree);
        if interpreted.has_momentum() && interpreted.is_separable() == splits {
            trees.push((tree, if splits { "separable" } else { "any" }));
        }
    }
    trees
}

/// Returns true if a part of it that is a number has no value: `atanh(2)`, or a division by 0.
fn has_bad_number(tree: &Tree) -> bool {
    let model = tree.model();
    let roots: Vec<_> = model.hamiltonian.into_iter().collect();
    let is_number = |node: Node| {
        model.dag.stage(node) == Stage::Constant && model.dag.variables(node).is_empty()
    };
    let is_zero = |node: Node| {
        let number = model.dag.number(node);
        number.is_some_and(|number| number.value == 0.0)
    };
    let is_bad = |node: Node| match model.dag.kind(node) {
        Kind::Product(_, factors) => (factors.iter()).any(|(factor, n)| *n < 0 && is_zero(*factor)),
        Kind::Call(Op::Modulo | Op::Remainder, x) if is_zero(x[1]) => true,
        _ => {
            is_number(node)
                && model
                    .dag
                    .number(node)
                    .is_none_or(|number| number.value.is_nan())
        }
    };
    model.dag.reachable(&roots).into_iter().any(is_bad)
}

/// The same expression, its places in the order in which the text names them: the order of
/// contributions to a derivative is that of the source.
fn in_source_order(tree: &Tree) -> Tree {
    let mut parts = Vec::new();
    let mut places = vec![None; tree.0.len()];
    let mut open = vec![(tree.0.len() - 1, false)];
    while let Some((at, is_seen)) = open.pop() {
        let operands = tree.0[at].operands();
        if places[at].is_some() {
            continue;
        }
        if is_seen {
            places[at] = Some(parts.len());
            let moved = |at: usize| places[at].expect("operands come first");
            parts.push(with_places(tree.0[at], moved));
        } else {
            open.push((at, true));
            open.extend(operands.into_iter().rev().map(|operand| (operand, false)));
        }
    }
    Tree(parts)
}

/// The tree with coordinates and momenta all on the side that begins at `start`.
fn on_side(tree: &Tree, start: usize) -> Tree {
    let parts = tree.0.iter().map(|part| match *part {
        Part::Variable(at) if at < TIME => Part::Variable(start + at % PAIRS),
        part => part,
    });
    Tree(parts.collect())
}

/// The sum of two trees.
fn sum(a: &Tree, b: &Tree) -> Tree {
    let by = a.0.len();
    let moved = b.0.iter().map(|part| with_places(*part, |at| at + by));
    let mut parts: Vec<_> = a.0.iter().copied().chain(moved).collect();
    parts.push(Part::Add(by - 1, parts.len() - 1));
    Tree(parts)
}

/// The part with its operands at other places.
fn with_places(part: Part, m: impl Fn(usize) -> usize) -> Part {
    let test = |test| match test {
        Test::Less(a, b) => Test::Less(m(a), m(b)),
        Test::LessEqual(a, b) => Test::LessEqual(m(a), m(b)),
        Test::Equal(a, b) => Test::Equal(m(a), m(b)),
    };
    match part {
        Part::Variable(_) | Part::Number(..) | Part::Pi => part,
        Part::Neg(a) => Part::Neg(m(a)),
        Part::Add(a, b) => Part::Add(m(a), m(b)),
        Part::Sub(a, b) => Part::Sub(m(a), m(b)),
        Part::Mul(a, b) => Part::Mul(m(a), m(b)),
        Part::Div(a, b) => Part::Div(m(a), m(b)),
        Part::Power(a, n, d) => Part::Power(m(a), n, d),
        Part::Call(op, a) => Part::Call(op, m(a)),
        Part::Call2(op, a, b) => Part::Call2(op, m(a), m(b)),
        Part::If(c, negated, a, b) => Part::If(test(c), negated, m(a), m(b)),
        Part::IfBoth(c, d, either, a, b) => Part::IfBoth(test(c), test(d), either, m(a), m(b)),
    }
}

/// The text of a file with the expressions of these numbers.
pub fn file(name: &str, numbers: Range<usize>) -> String {
    let mut text = format!(
        "//! Random expressions for the macro. Made by `generate.rs`; not to be edited.\n\n\
         // Not every random expression reads every parameter.\n\
         #![allow(unused_variables)]\n\n\
         use hamiltonian::hamiltonian;\n\n\
         /// The name of this file.\n\
         pub const FILE: &str = {name:?};\n\n\
         /// The numbers of the expressions in it.\n\
         pub const NUMBERS: core::ops::Range<usize> = {numbers:?};\n"
    );
    let trees = trees(numbers.end);
    let here = || numbers.clone().zip(&trees[numbers.clone()]);
    for (number, (tree, _)) in here() {
        let h = tree.text();
        // Writing to a string does not fail.
        let _ = write!(
            text,
            "\nhamiltonian! {{\n    pub struct E{number} {{ a, b, c }}\n    H(x, y; px, py; t) = {h}\n}}\n"
        );
    }
    text.push_str("\ncrate::compiled::list! {\n");
    for (number, (_, kind)) in here() {
        let _ = writeln!(text, "    {number} E{number} {kind}");
    }
    text.push_str("}\n");
    text
}
