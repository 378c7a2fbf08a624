//! LaTeX.
//!
//! Input: a node. Output: fragments for the writer. Invariant: plain LaTeX with amsmath; names of
//! Greek letters become the letters; trailing digits and words after `_` become subscripts.

use super::layout::{Fragment, Level, Power, Style, Writer, fraction};
use crate::dag::{Dag, Kind, Node, Partial};
use crate::model::External;
use crate::op::Op;
use crate::product::Product;
use crate::rational::Rational;

pub(super) const LATEX: Style = Style {
    pi: "\\pi",
    open: "\\left(",
    close: "\\right)",
    relations: [" < ", " \\le ", " = "],
    opposites: [" \\ge ", " > ", " \\ne "],
    not: "\\lnot ",
    and: " \\land ",
    or: " \\lor ",
    ellipsis: "\\dots",
    modulo: "\\bmod",
    times: " ",
    loop_level: Level::Sum,
    body_level: Level::Product,
    loop_end: "",
    last: -1,
    loop_head,
    number,
    is_fraction,
    indexed,
    call: |writer, op, x| call(writer, op, x, None),
    call_level,
    external,
    select,
    product,
};

const GREEK: &[&str] = &[
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi",
    "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi",
    "Omega",
];

/// A declared name with indices: `theta` is θ, `p_x` and `q1` have subscripts, longer words are
/// upright.
fn indexed(name: &str, indices: &[String]) -> String {
    let mut parts = name.split('_').filter(|part| !part.is_empty());
    let Some(head) = parts.next() else {
        return format!("\\mathrm{{{}}}", name.replace('_', "\\_"));
    };
    let mut subscripts = Vec::new();
    let (head, digits) = trailing_digits(head);
    subscripts.extend(digits);
    for part in parts {
        let (word, digits) = trailing_digits(part);
        subscripts.push(format!("{}{}", letter(word), digits.unwrap_or_default()));
    }
    subscripts.extend(indices.iter().cloned());
    let head = letter(head);
    if subscripts.is_empty() {
        head
    } else {
        format!("{head}_{{{}}}", subscripts.join(","))
    }
}

/// `q1` is `q` and `1`; a number by itself stays.
fn trailing_digits(word: &str) -> (&str, Option<String>) {
    let stem = word.trim_end_matches(|c: char| c.is_ascii_digit());
    if stem.is_empty() || stem.len() == word.len() {
        (word, None)
    } else {
        (stem, Some(word[stem.len()..].to_owned()))
    }
}

fn letter(word: &str) -> String {
    if GREEK.contains(&word) {
        format!("\\{word}")
    } else if word.chars().count() > 1 && !word.chars().all(|c| c.is_ascii_digit()) {
        format!("\\mathrm{{{word}}}")
    } else {
        word.to_owned()
    }
}

/// Returns true if a number is written as a fraction.
fn is_fraction(value: &Rational) -> bool {
    match value.to_small() {
        Some((_, 1)) => false,
        Some((_, d)) if d <= 9 => true,
        _ => value.to_text().contains('/'),
    }
}

/// A number.
fn number(value: &Rational) -> String {
    if is_fraction(value) {
        let sign = if value.is_negative() { "-" } else { "" };
        let (n, d) = parts(&value.abs());
        return format!("{sign}\\frac{{{n}}}{{{d}}}");
    }
    decimal(&value.to_text())
}

fn decimal(text: &str) -> String {
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!("{mantissa} \\cdot 10^{{{exponent}}}"),
        None => text.to_owned(),
    }
}

/// Numerator and denominator of a fraction.
fn parts(value: &Rational) -> (String, String) {
    match value.to_small() {
        Some((n, d)) => (n.to_string(), d.to_string()),
        None => {
            let text = value.to_text();
            text.split_once('/').map_or_else(
                || (decimal(&text), "1".to_owned()),
                |(n, d)| (n.to_owned(), d.to_owned()),
            )
        }
    }
}

fn call_level(op: Op) -> Level {
    match op {
        Op::Pow | Op::Exp => Level::Power,
        Op::Modulo => Level::Sum,
        _ => Level::Atom,
    }
}

fn takes_power(op: Op) -> bool {
    matches!(
        op,
        Op::Sin | Op::Cos | Op::Tan | Op::Sinh | Op::Cosh | Op::Tanh
    )
}

/// `\sum_{i=0}^{N-1} `
fn loop_head(name: &str, start: &str, last: &str) -> String {
    format!("\\sum_{{{name}={start}}}^{{{last}}} ")
}

/// Cases, a condition behind each value.
fn select(c: Node, yes: Node, no: Node) -> Vec<Fragment> {
    vec![
        Fragment::Static("\\begin{cases} "),
        Fragment::Node(yes, Level::Loose),
        Fragment::Static(" & \\text{if } "),
        Fragment::Node(c, Level::Loose),
        Fragment::Static(" \\\\ "),
        Fragment::Node(no, Level::Loose),
        Fragment::Static(" & \\text{otherwise} \\end{cases}"),
    ]
}

/// A function, to a power that stands after its name.
fn call(writer: &Writer<'_>, op: Op, x: &[Node], power: Option<i32>) -> Vec<Fragment> {
    let within = |open, close| {
        let argument = Fragment::Node(x[0], Level::Loose);
        vec![Fragment::Static(open), argument, Fragment::Static(close)]
    };
    match op {
        Op::Pow => vec![
            Fragment::Node(x[0], Level::Atom),
            Fragment::Static("^{"),
            Fragment::Node(x[1], Level::Loose),
            Fragment::Static("}"),
        ],
        Op::Exp => within("e^{", "}"),
        Op::Sqrt => within("\\sqrt{", "}"),
        Op::Cbrt => within("\\sqrt[3]{", "}"),
        Op::Abs => within("\\left|", "\\right|"),
        Op::Floor => within("\\lfloor ", " \\rfloor"),
        Op::Modulo => vec![
            Fragment::Node(x[0], Level::Unary),
            Fragment::Static(" \\bmod "),
            Fragment::Node(x[1], Level::Unary),
        ],
        _ => {
            let name = op.row().latex;
            let name = power.map_or_else(|| name.to_owned(), |n| format!("{name}^{{{n}}}"));
            if x.len() == 1 && is_name(writer.dag(), x[0]) {
                let mut fragments = within("(", ")");
                fragments.insert(0, Fragment::Owned(name));
                return fragments;
            }
            writer.listed(name, x)
        }
    }
}

fn is_name(dag: &Dag, node: Node) -> bool {
    matches!(
        dag.kind(node),
        Kind::Scalar(_) | Kind::Time | Kind::Element(..) | Kind::Pi | Kind::Variable(_)
    )
}

/// A function in Rust, or a derivative of it.
fn external(of: &External, part: Partial) -> String {
    let name = indexed(&of.name, &[]);
    let argument = |at: u16| indexed(&of.arguments[usize::from(at)], &[]);
    let partial = |above: &str, below: String| format!("\\frac{{{above} {name}}}{{{below}}}");
    match (part, of.arguments.len()) {
        (Partial::Value, _) => name,
        (Partial::First(_), 1) => format!("{name}'"),
        (Partial::Second(..), 1) => format!("{name}''"),
        (Partial::First(i), _) => partial("\\partial", format!("\\partial {}", argument(i))),
        (Partial::Second(i, j), _) if i == j => {
            partial("\\partial^{2}", format!("\\partial {}^{{2}}", argument(i)))
        }
        (Partial::Higher { order, .. }, 1) => format!("{name}^{{({order})}}"),
        (Partial::Higher { order, .. }, _) => format!("\\partial^{{{order}}} {name}"),
        (Partial::Second(i, j), _) => partial(
            "\\partial^{2}",
            format!("\\partial {} \\, \\partial {}", argument(i), argument(j)),
        ),
    }
}

/// `k·Π` with k ≥ 0: one fraction, unless a sum stands above the line beside numbers only below
/// it.
fn product(writer: &Writer<'_>, product: &Product) -> Vec<Fragment> {
    let (dag, k) = (writer.dag(), &product.coefficient);
    let (above, below) = fraction(&product.factors);
    let (n, d) =
        if is_fraction(k) || !below.is_empty() && k.to_small().is_some_and(|(_, d)| d <= 64) {
            parts(k)
        } else {
            (number(k), "1".to_owned())
        };
    let is_large = |node: Node| {
        matches!(
            dag.kind(node),
            Kind::Sum(..) | Kind::Reduce(..) | Kind::Select(..)
        )
    };
    let mut fragments = Vec::new();
    if below.is_empty() && d == "1" {
        line(writer, &n, &above, false, &mut fragments);
    } else if below.is_empty() && above.iter().any(|(node, _)| is_large(*node)) {
        fragments.push(Fragment::Owned(format!("\\frac{{{n}}}{{{d}}} ")));
        line(writer, "1", &above, false, &mut fragments);
    } else {
        fragments.push(Fragment::Static("\\frac{"));
        line(writer, &n, &above, true, &mut fragments);
        fragments.push(Fragment::Static("}{"));
        line(writer, &d, &below, true, &mut fragments);
        fragments.push(Fragment::Static("}"));
    }
    fragments
}

/// One side of a fraction, or all of a product without one. Sums over loops go last, where they
/// need no parentheses; a sum needs none where it is alone and `enclosed` by the fraction.
fn line(
    writer: &Writer<'_>,
    number: &str,
    factors: &[Power],
    enclosed: bool,
    fragments: &mut Vec<Fragment>,
) {
    let dag = writer.dag();
    let mut any = false;
    if number != "1" || factors.is_empty() {
        fragments.push(Fragment::Owned(number.to_owned()));
        any = true;
    }
    let is_loop = |(node, n): &Power| *n == 1 && matches!(dag.kind(*node), Kind::Reduce(..));
    let (loops, others): (Vec<_>, Vec<_>) = factors.iter().partition(|factor| is_loop(factor));
    let count = others.len() + loops.len();
    for (at, (node, n)) in others.into_iter().chain(loops).enumerate() {
        if any {
            fragments.push(Fragment::Static(if starts_with_digit(dag, node) {
                " \\cdot "
            } else {
                " "
            }));
        }
        any = true;
        match dag.kind(node) {
            Kind::Call(Op::Sqrt, x) if n > 1 => {
                fragments.push(Fragment::Node(x[0], Level::Atom));
                fragments.push(Fragment::Owned(if n % 2 == 0 {
                    format!("^{{{}}}", n / 2)
                } else {
                    format!("^{{{n}/2}}")
                }));
            }
            Kind::Call(op, x) if n > 1 && takes_power(*op) => {
                fragments.append(&mut call(writer, *op, x, Some(n)))
            }
            Kind::Reduce(..) if n == 1 && at + 1 == count => {
                fragments.push(Fragment::Node(node, Level::Sum))
            }
            _ if n == 1 => {
                let alone = enclosed && count == 1 && number == "1";
                fragments.push(Fragment::Node(
                    node,
                    if alone { Level::Sum } else { Level::Unary },
                ));
            }
            _ => {
                fragments.push(Fragment::Node(node, Level::Atom));
                fragments.push(Fragment::Owned(format!("^{{{n}}}")));
            }
        }
    }
}

fn starts_with_digit(dag: &Dag, node: Node) -> bool {
    match dag.kind(node) {
        Kind::Constant(_) => true,
        Kind::Call(Op::Pow, x) => matches!(dag.kind(x[0]), Kind::Constant(_)),
        _ => false,
    }
}
