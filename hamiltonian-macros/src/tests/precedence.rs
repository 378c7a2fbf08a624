//! Precedence of operators, and that numbers are kept exactly.

use super::{accept, read};
use hamiltonian_language::ast::{Ast, BinaryOp, ExprId, ExprKind, StatementKind, UnaryOp};
use hamiltonian_symbolic::rational::Rational;

/// The expression of the first statement in fully bracketed prefix form.
fn form(source: &str) -> String {
    let (ast, _, report) = read(&format!("H = {source}"));
    let texts: Vec<String> = report.errors().iter().map(|error| error.text()).collect();
    match &ast.statements.first().map(|statement| &statement.kind) {
        Some(StatementKind::Hamiltonian { value, .. }) => shown(&ast, value.root),
        _ => texts.join("\n"),
    }
}

fn shown(ast: &Ast, id: ExprId) -> String {
    match &ast.nodes[id.0 as usize].kind {
        ExprKind::Number(number) => number.to_text(),
        ExprKind::Name(symbol, _) => ast.symbols.name(*symbol).to_owned(),
        ExprKind::Unary(UnaryOp::Neg, a) => format!("(neg {})", shown(ast, *a)),
        ExprKind::Unary(UnaryOp::Not, a) => format!("(not {})", shown(ast, *a)),
        ExprKind::Binary(op, a, b) => {
            format!(
                "({} {} {})",
                BinaryOp::symbol(*op),
                shown(ast, *a),
                shown(ast, *b)
            )
        }
        ExprKind::Call(symbol, _, items) => {
            let items: Vec<String> = items.iter().map(|item| shown(ast, *item)).collect();
            format!("({} {})", ast.symbols.name(*symbol), items.join(" "))
        }
        ExprKind::Index {
            base,
            index,
            modulo: None,
        } => {
            format!("(at {} {})", shown(ast, *base), shown(ast, *index))
        }
        ExprKind::Index {
            base,
            index,
            modulo: Some(modulo),
        } => {
            format!(
                "(at {} {} {})",
                shown(ast, *base),
                shown(ast, *index),
                shown(ast, *modulo)
            )
        }
        ExprKind::If {
            condition,
            then,
            otherwise,
        } => format!(
            "(if {} {} {})",
            shown(ast, *condition),
            shown(ast, *then),
            shown(ast, *otherwise)
        ),
        other => format!("{other:?}"),
    }
}

#[test]
fn operators_bind_as_in_mathematics() {
    let cases = [
        ("-q^2", "(neg (^ q 2))"),
        ("2^3^2", "(^ 2 (^ 3 2))"),
        ("q^-1", "(^ q (neg 1))"),
        ("q^-1^2", "(^ q (neg (^ 1 2)))"),
        ("q^-1*p", "(* (^ q (neg 1)) p)"),
        ("-q*p", "(* (neg q) p)"),
        ("q*-p", "(* q (neg p))"),
        ("q - -p", "(- q (neg p))"),
        ("q - p - 1", "(- (- q p) 1)"),
        ("q/p/2*q", "(* (/ (/ q p) 2) q)"),
        ("q + p*2^q", "(+ q (* p (^ 2 q)))"),
        ("(q + p)*2", "(* (+ q p) 2)"),
        ("+q - +p", "(- q p)"),
        ("--q", "(neg (neg q))"),
        ("sin(q)^2", "(^ (sin q) 2)"),
        ("-sin(q)^2", "(neg (^ (sin q) 2))"),
        ("q[1]^2", "(^ (at q 1) 2)"),
        ("q[i][2]", "(at (at q i) 2)"),
        ("q[(i + 1) % 3]", "(at q (+ i 1) 3)"),
        ("q[((i) % 3)]", "(at q i 3)"),
        ("p^2/2*m", "(* (/ (^ p 2) 2) m)"),
        (
            "if q < 1 && p >= 2 || !(q == p) { 1 } else { 2 }",
            "(if (|| (&& (< q 1) (>= p 2)) (not (== q p))) 1 2)",
        ),
        (
            "if -q + 1 <= p*2 { 1 } else if q != 0 { 2 } else { 3 } + 1",
            "(+ (if (<= (+ (neg q) 1) (* p 2)) 1 (if (!= q 0) 2 3)) 1)",
        ),
        ("atan2(q, p + 1)", "(atan2 q (+ p 1))"),
        ("max(q, p,)", "(max q p)"),
    ];
    for (source, expected) in cases {
        assert_eq!(form(source), expected, "{source}");
    }
}

#[test]
fn numbers_are_kept_exactly() {
    let long = [1_234_567_890_123_456_789, 10_000_000_000, 1, 1_000].map(Rational::integer);
    let [long, shift, more, thousand] = long;
    let cases = [
        ("0.000", Rational::ZERO),
        ("0e99999999999999999999", Rational::ZERO),
        ("1_000", Rational::integer(1000)),
        ("0.1", Rational::new(1, 10)),
        ("1.50", Rational::new(3, 2)),
        ("2.", Rational::integer(2)),
        ("1e-3", Rational::new(1, 1000)),
        ("12.5E+2", Rational::integer(1250)),
        (
            "12345678901234567890000000001.001",
            long.mul(&shift).add(&more).add(&thousand.recip().unwrap()),
        ),
    ];
    for (text, exact) in cases {
        let (ast, _, report) = read(&format!("H = p^2 + {text}"));
        assert!(report.is_empty(), "{text}");
        let mut numbers = ast.nodes.iter().map(|node| &node.kind);
        let is_exact =
            |kind: &ExprKind| matches!(kind, ExprKind::Number(number) if *number == exact);
        assert!(numbers.any(is_exact), "{text}");
    }
}

#[test]
fn the_largest_and_smallest_numbers_are_accepted() {
    accept("H = 1.7e308*p^2 + 5e-324*q + 0.1e-322");
}
