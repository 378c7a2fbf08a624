//! Generators of definitions with walls, poles and functions in Rust, and lists of single ones.
//!
//! Input: random numbers. Output: definitions as text. Invariant: none says if its statement is true.

use crate::common::{parse, system};
use crate::random_text::Random;
use hamiltonian_symbolic::dag::{Column, Side};
use hamiltonian_symbolic::index::Index;
use hamiltonian_symbolic::model::{Model, VectorEntry};

/// A definition with a statement.
#[derive(Clone, Debug)]
pub struct Definition {
    signature: &'static str,
    pub h: String,
    pub invariant: String,
}

impl Definition {
    /// Its model: the size is `N`, the parameter `k`, the function `V`.
    pub fn model(&self, h: &str) -> Model {
        system(self.signature, "N", "k V/1", h)
    }

    /// The sizes to try: with an element of its own 1 is the smallest.
    pub fn sizes(&self) -> &'static [usize] {
        let text = format!("{} {}", self.h, self.invariant);
        let is_read = text.contains("[0]");
        match (text.contains('N'), is_read) {
            (false, _) => &[1],
            (true, true) => &[1, 2, 3],
            (true, false) => &[0, 1, 2, 3],
        }
    }
}

/// A function of z whose value changes with its sign.
fn side(random: &mut Random, z: &str) -> String {
    let form = random.pick(&[
        "sign($)",
        "abs($)/($)",
        "($)*sqrt(1/($)^2)",
        "(if $ > 0 { 2 } else { 1 })",
        "(if 0 <= $ { H } else { 2*H })",
        "sign($)*H",
        "(if $ < 0 { 1 } else { 0 })",
    ]);
    form.replace('$', z)
}

/// `H` written out.
fn with_energy(invariant: &str, h: &str) -> String {
    invariant.replace('H', &format!("({h})"))
}

/// A wall at z in a loop, and the sign of z.
pub fn wall(random: &mut Random) -> Definition {
    const RANGES: &[&str] = &[
        "i in 0..N",
        "i in 1..N",
        "i in 0..N - 1",
        "i in 0..N, j in 0..i",
        "i in 0..N, j in i + 1..N",
        "i in 0..N, j in 0..i, l in 0..j",
        "i in 0..N, j in 1..N",
        "i in 0..3",
        "i in 0..1",
        "i in 1..3, j in 0..i",
        "i in 0..3, j in 0..i",
        "i in 1..1",
    ];
    const BODIES: &[&str] = &[
        "(1/abs(Z) + B^2)^2",
        "(1/(Z) + B)^2",
        "1/(Z)^2",
        "(1 + B^2)/(Z)^2",
        "B^2/(Z)^2",
        "(2 + sin(B))/abs(Z)^3",
        "1/(Z)^4 - 1/(Z)^2 + B",
        "1/(Z)^2 - cos(Z)/(Z)^2 + B^2",
        "k^2/(Z)^2",
        "sqrt(1/(Z)^2 + B^2)",
        "cosh(1/(Z))",
        "1/(Z)",
        "(1/(Z)^2 + B^2)*(1 + B^2)",
        "if B > 0 { 1/(Z)^2 } else { 2/(Z)^2 + B^2 }",
    ];
    let range = random.pick(RANGES);
    let is_nested = range.contains('j');
    let own = match is_nested {
        true => random.pick(&["q[i] - q[j]", "q[i]", "q[j]", "x - q[j]", "p[j]"]),
        false => random.pick(&["q[i]", "x - q[i]", "q[i] - 1", "p[i]"]),
    };
    let in_loop = random.below(2) == 0;
    let z = match in_loop {
        true => own,
        false => random.pick(&["x", "x - 1", "q[0]", "u", "x - q[0]", "q[0] + 1"]),
    };
    // Literal ranges read no more elements than there are.
    let range = match in_loop && range.contains('3') {
        true => "i in 1..N, j in 0..i",
        false => range,
    };
    let range = if in_loop && range == "i in 0..1" {
        "i in 0..N"
    } else {
        range
    };
    let own = match range.contains("..3") || range.contains("..1") || range.contains("1..1") {
        true => random.pick(&["u", "i*x", "x"]),
        false if range.contains('j') => random.pick(&["q[j]", "p[i]", "x", "u + q[i]"]),
        false => random.pick(&["q[i]", "p[i]", "u", "x"]),
    };
    let body = random.pick(BODIES).replace('Z', z).replace('B', own);
    let more = random.pick(&["", " + x^2", " + cos(x)", " + sum(i in 0..N) { q[i]^2/2 }"]);
    let h =
        format!("u^2/2 + x^2/8 + sum(i in 0..N) {{ p[i]^2/2 }} + sum({range}) {{ {body} }}{more}");
    let statement = side(random, z);
    let invariant = match in_loop {
        false => statement,
        true if random.below(3) > 0 => format!("sum({range}) {{ {statement} }}"),
        true if z.contains("[j]") => format!("sum(i in 0..N, j in 0..i) {{ {statement} }}"),
        true => format!("sum(i in 0..N) {{ {statement} }}"),
    };
    Definition {
        signature: "x, q[N]; u, p[N]",
        invariant: with_energy(&invariant, &h),
        h,
    }
}

/// Returns true if a part of a text is an expression that a minus may stand before.
fn is_whole(text: &str) -> bool {
    let count = |c: char| text.matches(c).count();
    count('(') == count(')') && !text.contains(" + ") && !text.contains(" - ")
}

/// A wall at the zeros of an expression with poles, and a condition on its sign.
pub fn condition(random: &mut Random) -> Definition {
    const PLACES: &[&str] = &[
        "1 - 1/x",
        "1 - 2/x",
        "x - 1/x",
        "1 - 1/x^2",
        "1 - 1/x^3",
        "1 + 1/(x - 1)",
        "(x - 1)/(x + 1)",
        "1/x - 1/(x - 3)",
        "1/x + 1/(x - 2)",
        "x^2 - 1",
        "x - 1",
        "1/x",
        "2 - 1/abs(x)",
        "1 - x/(x^2 + y^2)",
        "1 - (x + y)/(x^2 + y^2)",
        "1/x - y",
        "x*y - 1",
        "y - 1/x",
        "1/y - x",
        "tan(x) - 1",
        "1 - u/x",
        "1 - 1/u",
        "ln(abs(x))",
        "exp(1/x) - 2",
        "1/(1 - 1/x)",
        "x/y - 1",
        "1 - 1/(x*y)",
    ];
    const WALLS: &[&str] = &[
        "1/(Z)^2",
        "2/abs(Z)",
        "(2 + cos(y))/(Z)^2",
        "1/(Z)^2 - cos(Z)/(Z)^2",
        "(1 + v^2)/(Z)^4",
        "y^2/(Z)^2",
        "1/(Z)^4 - 1/(Z)^2",
        "k^2/(Z)^2",
        "sqrt(1 + 1/(Z)^2)",
        "ln(abs(Z))^2",
        "1/(Z)",
    ];
    let z = random.pick(PLACES);
    let wall = random.pick(WALLS).replace('Z', z);
    let more = random.pick(&[
        "",
        "",
        " + 1/x^2",
        " + 1/x^2 + 1/y^2",
        " + 1/(x - 1)^2",
        " + x^2/2 + y^2/2",
        " + 1/u^2",
        " - 1/y^2",
    ]);
    let kinetic = random.pick(&[
        "(u^2 + v^2)/2",
        "u^2/2 + v^2",
        "sqrt(1 + u^2 + v^2)",
        "u^4 + v^2/2",
    ]);
    let h = format!("{kinetic} + {wall}{more}");
    let invariant = match z.split_once(" - ") {
        Some((a, b)) if is_whole(a) && is_whole(b) && random.below(2) == 0 => {
            let form = random.pick(&[
                "(if A > B { 1 } else { 0 })",
                "(if A <= B { 1 } else { 2 })",
                "(if A < B && B > -50 { 1 } else { 0 })",
                "(if A > B || A < B { sign(A - B) } else { 0 })",
                "(if !(A >= B) { H } else { 2 })",
            ]);
            // Words of the form stand before those of the sides.
            form.replace('A', &format!("({a})"))
                .replace('B', &format!("({b})"))
        }
        _ => side(random, &format!("({z})")),
    };
    Definition {
        signature: "x, y; u, v",
        invariant: with_energy(&invariant, &h),
        h,
    }
}

/// Functions for V, smooth.
pub const FUNCTIONS: &[&str] = &[
    "sin(X) + 0.3",
    "X^2 - 1",
    "X^3 - X",
    "exp(X) - 2",
    "X",
    "cos(2*X)",
    "X/(1 + X^2)",
    "1 + X^2",
];

/// Functions for V with poles and steps.
pub const ROUGH: &[&str] = &[
    "1/X",
    "1/(X - 0.5)",
    "(X - 1)/X",
    "if X > 0.2 { 1 } else { -1 }",
    "tan(X)",
    "sign(X)*2 + X",
];

/// A wall, a potential or a factor that a function in Rust makes.
pub fn function(random: &mut Random) -> Definition {
    let argument = random.pick(&["x", "x - y", "x + 0.3", "2*x"]);
    let v = format!("V({argument})");
    let (term, statement) = match random.below(7) {
        0 | 1 => {
            let wall = random.pick(&[
                "1/V^2",
                "1/abs(V)",
                "(1 + v^2)/V^2",
                "1/V^4 + V",
                "(1/V)^2*(2 + cos(y))",
            ]);
            (wall.replace('V', &v), side(random, &v))
        }
        2 => (format!("{v}^2"), "H".to_owned()),
        3 => (format!("{v}*(1 + v^2)"), "H^2".to_owned()),
        4 => {
            let sum = random.pick(&[
                "sum(i in 0..N) { 1/V^2 }",
                "sum(i in 0..3) { (1/V + i*v)^2 }",
            ]);
            (sum.replace('V', &v), side(random, &v))
        }
        5 => (
            "V(x^2 + y^2)".to_owned(),
            random.pick(&["x*v - y*u", "sign(x*v - y*u)"]).to_owned(),
        ),
        _ => (
            "V(x - y) + (x + y)^2".to_owned(),
            "((u - v)^2/4 + V(x - y))".to_owned(),
        ),
    };
    let h = format!("(u^2 + v^2)/2 + {term}");
    Definition {
        signature: "x, y; u, v",
        invariant: with_energy(&statement, &h),
        h,
    }
}

/// The text with V written out.
pub fn with_functions(text: &str, function: Option<&str>) -> String {
    let Some(function) = function else {
        return text.to_owned();
    };
    let Some(at) = text.find("V(") else {
        return text.to_owned();
    };
    let mut depth = 0;
    let mut end = at;
    for (place, c) in text.char_indices().skip_while(|(place, _)| *place <= at) {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            end = place;
            break;
        }
    }
    let value = function.replace('X', &text[at + 1..=end]);
    let rest = with_functions(&text[end + 1..], Some(function));
    format!("{}({value}){rest}", &text[..at])
}

/// A force on the first momenta, separated by semicolons.
pub fn force(model: &mut Model, force: &str) {
    let values = force.split(';').filter(|value| !value.is_empty());
    for (group, value) in values.enumerate() {
        let value = parse(model, value);
        model.force.push(VectorEntry {
            at: Column::first(Side::P, group as u16),
            row: Index::constant(0),
            value,
        });
    }
}

type Wrong = (&'static str, [&'static str; 5], &'static str);

/// False statements that were proven.
pub const WRONG: &[Wrong] = &[
    (
        "a sum that is empty for N = 1",
        [
            "q[N]; p[N]",
            "N",
            "",
            "sum(i in 0..N) { p[i]^2/2 } + sum(i in 1..N) { (1/abs(q[0]) + p[i]^2)^2 }",
            "sign(q[0])",
        ],
        "",
    ),
    (
        "an inner sum that is empty for i = 0",
        [
            "q[n]; p[n]",
            "n",
            "",
            "sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..i) { (1/q[i] + q[j])^2 }",
            "sum(i in 0..n) { sign(q[i]) }",
        ],
        "",
    ),
    (
        "a condition whose side has a pole",
        [
            "q; p",
            "",
            "",
            "p^2/2 + 1/(1 - 1/q)^2",
            "if 1 - 1/q > 0 { 1 } else { 0 }",
        ],
        "",
    ),
    (
        "a condition whose side has a pole on a line in the plane",
        [
            "x, y; u, v",
            "",
            "",
            "(u^2 + v^2)/2 + 1/(1 - x/(x^2 + y^2))^2",
            "sign(1 - x/(x^2 + y^2))",
        ],
        "",
    ),
    (
        "infinities that cancel",
        ["q; p", "", "", "p^2/2 + 1/q^2 - cos(q)/q^2", "sign(q)"],
        "",
    ),
    (
        "charges -1, 4, 4 that move freely through each other",
        [
            "q[3]; p[3]",
            "",
            "",
            "sum(i in 0..3) { p[i]^2/2 } - 1/abs(q[0] - q[1]) - 1/abs(q[0] - q[2]) + 4/abs(q[1] - q[2])",
            "sign(q[0] - q[1])",
        ],
        "",
    ),
    (
        "infinities of one sign move what that of the other does not: x = t, y = 2*t is free",
        [
            "x, y; u, v",
            "",
            "",
            "(u^2 + v^2)/2 + 1/x^2 + 1/(x - y)^2 - 8/y^2",
            "sign(x)",
        ],
        "",
    ),
    (
        "an infinity times 0: with y = z = 0 the motion is free",
        [
            "x, y, z; u, v, w",
            "",
            "",
            "(u^2 + v^2 + w^2)/2 + (y^2 + z^2)/x^2",
            "sign(x)",
        ],
        "",
    ),
    (
        "a kink beside a pole whose coefficient may be 0",
        [
            "q; p",
            "",
            "k",
            "p^2/2 - abs(q) + k/abs(q)",
            "sign(p^2 + q^2)",
        ],
        "",
    ),
    (
        "a kink beside a pole that is 0 where y is: x branches",
        [
            "x, y; u, v",
            "",
            "",
            "(u^2 + v^2)/2 + y^2/abs(x) - abs(x)",
            "sign(x^2 + y^2 + u^2 + v^2)",
        ],
        "",
    ),
    (
        "a kink of H under a force on another pair",
        [
            "q, x; p, u",
            "",
            "",
            "p^2/2 + u^2/2 - abs(q)",
            "sign(p^2 + q^2)",
        ],
        "0*q;-u",
    ),
    (
        "a step and a sign at one place do not cancel",
        [
            "x, y; p, u",
            "",
            "",
            "p^2/2 + u*(sign(x) - if 0 < x { 1 } else { 0 })",
            "p",
        ],
        "",
    ),
    (
        "two thresholds that differ on the step, where an orbit rests",
        [
            "x, y; p, u",
            "",
            "",
            "(p^2 + u^2)/2 + (if x < 0 { y } else { 0 }) - if x <= 0 { y } else { 0 }",
            "u",
        ],
        "",
    ),
    (
        "a sign and a threshold that differ on the step",
        [
            "x, y; p, u",
            "",
            "",
            "(p^2 + u^2)/2 + y*(1 + sign(x)) - if 0 < x { 2*y } else { 0 }",
            "u",
        ],
        "",
    ),
    (
        "signs that cancel in an open set",
        [
            "x, y, z; p, u, w",
            "",
            "",
            "(p^2 + u^2 + w^2)/2 + 1/x^2 + 1/y^2",
            "sign((sign(x) + sign(y))^2 + z^2)",
        ],
        "",
    ),
    (
        "on the level L = 0 orbits go through the centre",
        [
            "x, y; u, v",
            "",
            "",
            "(u^2 + v^2 + x^2 + y^2)/2",
            "if x*v - y*u == 0 { x/sqrt(x^2 + y^2) } else { 0 }",
        ],
        "",
    ),
];

/// True statements next to them, and the reason.
pub const RIGHT: &[(&str, [&str; 5])] = &[
    (
        "a sum that is never empty",
        [
            "x; u",
            "",
            "",
            "u^2/2 + sum(i in 0..3) { (1/x^2 + i)^2 }",
            "sign(x)",
        ],
    ),
    (
        "each iteration has its wall",
        [
            "q[n]; p[n]",
            "n",
            "",
            "sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..i) { 4/(q[i] - q[j])^12 - 4/(q[i] - q[j])^6 }",
            "sum(i in 0..n, j in 0..i) { sign(q[i] - q[j]) }",
        ],
    ),
    (
        "the pole of the side is a wall, too",
        [
            "q; p",
            "",
            "",
            "p^2/2 + 1/(1 - 1/q)^2 + 1/q^2",
            "if 1 - 1/q > 0 { 1 } else { 0 }",
        ],
    ),
    (
        "a weaker infinity does not cancel",
        ["q; p", "", "a", "p^2/2 + 1/q^2 + a/q", "sign(q)"],
    ),
    (
        "another pair's infinity does not cancel",
        [
            "x, y; u, v",
            "",
            "",
            "(u^2 + v^2)/2 + 1/x^2 - 1/y^2",
            "sign(x)",
        ],
    ),
    (
        "the divisor has a step of H",
        [
            "x, y; p, u",
            "",
            "",
            "(p^2 + u^2)/2 + 1/(3 + sign(x - y))",
            "p + u",
        ],
    ),
    (
        "a level keeps its sign",
        [
            "x, y; u, v",
            "",
            "",
            "(u^2 + v^2 + x^2 + y^2)/2",
            "sign(x*v - y*u)*(x*v - y*u)",
        ],
    ),
];
