//! The language's own notation.
//!
//! Input: a node. Output: fragments for the writer. Invariant: read back, the text is the expression.

use super::layout::{Fragment, Level, Power, Style, Writer, fraction};
use crate::dag::{Dag, Kind, Node, Partial};
use crate::model::External;
use crate::op::Op;
use crate::product::Product;
use crate::rational::Rational;

pub(super) const TEXT: Style = Style {
    pi: "pi",
    open: "(",
    close: ")",
    relations: [" < ", " <= ", " == "],
    opposites: [" >= ", " > ", " != "],
    not: "!",
    and: " && ",
    or: " || ",
    ellipsis: "…",
    modulo: "%",
    times: "*",
    loop_level: Level::Unary,
    body_level: Level::Loose,
    loop_end: " }",
    last: 0,
    loop_head,
    number: Rational::to_text,
    is_fraction,
    indexed,
    call,
    call_level,
    external,
    select,
    product,
};

fn is_fraction(value: &Rational) -> bool {
    value.to_text().contains('/')
}

/// `q[2][0]`
fn indexed(name: &str, indices: &[String]) -> String {
    let append = |text, index| format!("{text}[{index}]");
    indices.iter().fold(name.to_owned(), append)
}

fn call_level(op: Op) -> Level {
    match op {
        Op::Pow => Level::Power,
        // It binds like a product; parentheses set it apart from signs and factors.
        Op::Modulo => Level::Sum,
        _ => Level::Atom,
    }
}

/// `sum(i in 0..N) { `
fn loop_head(name: &str, start: &str, end: &str) -> String {
    format!("sum({name} in {start}..{end}) {{ ")
}

/// `if c { yes } else { no }`
fn select(c: Node, yes: Node, no: Node) -> Vec<Fragment> {
    vec![
        Fragment::Static("if "),
        Fragment::Node(c, Level::Loose),
        Fragment::Static(" { "),
        Fragment::Node(yes, Level::Loose),
        Fragment::Static(" } else { "),
        Fragment::Node(no, Level::Loose),
        Fragment::Static(" }"),
    ]
}

/// A function of the language.
fn call(writer: &Writer<'_>, op: Op, x: &[Node]) -> Vec<Fragment> {
    match op {
        Op::Pow => vec![
            Fragment::Node(x[0], Level::Atom),
            Fragment::Static("^"),
            exponent(writer.dag(), x[1]),
        ],
        Op::Modulo => vec![
            Fragment::Node(x[0], Level::Unary),
            Fragment::Static(" % "),
            Fragment::Node(x[1], Level::Unary),
        ],
        _ => writer.listed(op.row().name.to_owned(), x),
    }
}

/// A function in Rust, or a derivative of it, which the language has no way to say: `f'(x)` of one
/// argument, `(∂f/∂y)(x, y)` of several.
fn external(of: &External, part: Partial) -> String {
    let name = &of.name;
    let argument = |at: u16| &of.arguments[usize::from(at)];
    match (part, of.arguments.len()) {
        (Partial::Value, _) => name.clone(),
        (Partial::First(_), 1) => format!("{name}'"),
        (Partial::Second(..), 1) => format!("{name}''"),
        (Partial::First(i), _) => format!("(∂{name}/∂{})", argument(i)),
        (Partial::Second(i, j), _) if i == j => format!("(∂²{name}/∂{}²)", argument(i)),
        (Partial::Higher { order, .. }, 1) => format!("{name}{}", "'".repeat(order.into())),
        (Partial::Higher { order, .. }, _) => format!("(∂^{order} {name})"),
        (Partial::Second(i, j), _) => format!("(∂²{name}/∂{}∂{})", argument(i), argument(j)),
    }
}

/// The right of `^` takes a sign and further powers.
fn exponent(dag: &Dag, node: Node) -> Fragment {
    match dag.kind(node) {
        Kind::Constant(value) if !is_fraction(value) => Fragment::Owned(value.to_text()),
        _ => Fragment::Node(node, Level::Power),
    }
}

/// `k·Π` with k ≥ 0: `0.5*q^2*p^2`, `p^2/2`, `p^2/(2*m*l^2)`.
fn product(writer: &Writer<'_>, product: &Product) -> Vec<Fragment> {
    let (dag, k) = (writer.dag(), &product.coefficient);
    let (above, below) = fraction(&product.factors);
    let text = k.to_text();
    let is_decimal = !text.contains('/');
    let (numerator, denominator) = match k.to_small() {
        Some((n, 1)) => (n.to_string(), String::new()),
        // A decimal reads better than a fraction of large numbers, a fraction than a long decimal.
        Some((n, d)) => {
            let is_short = match (above.len(), below.len()) {
                (_, 1..) => d <= 9,
                (0 | 1, 0) => n == 1 && d <= 64 && d % 10 != 0,
                (_, 0) => text.len() > 6,
            };
            if is_short || !is_decimal {
                (n.to_string(), d.to_string())
            } else {
                (text, String::new())
            }
        }
        None => match text.split_once('/') {
            Some((n, d)) => (n.to_owned(), d.to_owned()),
            None => (text, String::new()),
        },
    };
    let mut fragments = Vec::new();
    if numerator != "1" || above.is_empty() {
        fragments.push(Fragment::Owned(numerator));
    }
    factors_of(dag, &above, &mut fragments);
    if below.is_empty() && denominator.is_empty() {
        return fragments;
    }
    let count = below.len() + usize::from(!denominator.is_empty());
    fragments.push(Fragment::Static(if count > 1 { "/(" } else { "/" }));
    let mut divisor = Vec::new();
    if !denominator.is_empty() {
        divisor.push(Fragment::Owned(denominator));
    }
    factors_of(dag, &below, &mut divisor);
    fragments.append(&mut divisor);
    if count > 1 {
        fragments.push(Fragment::Static(")"));
    }
    fragments
}

fn factors_of(dag: &Dag, factors: &[Power], fragments: &mut Vec<Fragment>) {
    for &(node, n) in factors {
        if !fragments.is_empty() {
            fragments.push(Fragment::Static("*"));
        }
        if n == 1 {
            // A number here is one the constructors could not multiply in.
            let level = if matches!(dag.kind(node), Kind::Constant(_)) {
                Level::Atom
            } else {
                Level::Unary
            };
            fragments.push(Fragment::Node(node, level));
        } else {
            fragments.push(Fragment::Node(node, Level::Atom));
            fragments.push(Fragment::Owned(format!("^{n}")));
        }
    }
}
