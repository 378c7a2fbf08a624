//! Generators of false statements, one for each class of faults that proofs had.
//!
//! Each makes definitions whose statements are false for some parameters, or on some orbits, whatever
//! is picked. Seeds are fixed.

/// A generator that gives the same numbers everywhere (SplitMix64).
pub struct Random(pub u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
    fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len())]
    }
    /// A small positive number.
    fn number(&mut self) -> String {
        (1 + self.below(9)).to_string()
    }
    /// A function that is not constant where its argument is not, and whose sign is that of its
    /// argument's changes.
    fn monotone(&mut self, x: &str) -> String {
        let k = self.number();
        match self.below(5) {
            0 => format!("{k}*({x})"),
            1 => format!("exp({x})"),
            2 => format!("(({x}) + ({x})^3/{k})"),
            3 => format!("atan({x})"),
            _ => format!("(({x}) + {k})"),
        }
    }
}

/// A class of false statements: its name, its seed, its generator.
pub type Class = (&'static str, u64, fn(&mut Random) -> String);

pub const CLASSES: &[Class] = &[
    ("shells that orbits leave", 1, leaving_shells),
    ("shells with several components", 2, components),
    ("sets of codimension 2 on a shell", 3, thin_sets),
    ("forces under which motion stops", 4, stopping_forces),
    ("essential singularities", 5, essential_singularities),
    ("thresholds that jump", 6, jumping_thresholds),
    ("parameters that may be 0", 7, vanishing_parameters),
    ("places whose slope is a parameter", 8, vanishing_slopes),
    ("values of their own at poles", 9, own_values),
    ("conditions on constants of the motion", 10, single_levels),
    (
        "equilibria at which motion branches",
        11,
        branching_equilibria,
    ),
];

/// f·(H − e) on H = e, where dH/dt or de/dt is not 0 and f is not either.
fn leaving_shells(random: &mut Random) -> String {
    let v = random.pick(&["q^2/2", "cos(q)", "q^4", "0", "q", "exp(q)"]);
    let f = random.pick(&["1", "q", "(q + 1)", "p", "q*p", "exp(q)", "(2 + cos(p))"]);
    let k = random.number();
    let (e, of_e) = (
        random.number(),
        random.pick(&["q", "p", "q*p", "q^2", "cos(q)"]),
    );
    match random.below(4) {
        0 => {
            let g = random.pick(&["t", "t^2", "exp(t)", "q*t", "cos(t)", "p*sin(t)"]);
            format!(
                "struct A {{}} H(q; p; t) = p^2/2 + {v} + {k}*{g}; invariant i = {f}*(H - {e}) on H = {e}"
            )
        }
        1 => {
            let force = random.pick(&["-p", "-p^3", "-p*q^2", "1", "cos(q)", "p"]);
            format!(
                "struct A {{}} H(q; p) = p^2/2 + {v}; force(q; p) = {k}*({force}); invariant i = {f}*(H - {e}) on H = {e}"
            )
        }
        2 => format!(
            "struct A {{a}} H(q; p) = p^2/2 + {k}*q + q^3; invariant i = {f}*(H - {of_e}) on H = {of_e}"
        ),
        _ => format!(
            "struct A {{}} H(q; p) = p^2/2 + {k}*q + q^3; invariant i = {f}*p on H = H*{e} - {e}*H + {of_e}"
        ),
    }
}

/// A on A·B = 0: A changes where B is 0, as {A, B} is not 0.
fn components(random: &mut Random) -> String {
    let a = random.pick(&[
        "p",
        "(p + x)",
        "p*(1 + x^2)",
        "(2*p - u)",
        "(p^2 - 4)",
        "(p + x*u)",
        "p^2",
    ]);
    let k = random.number();
    let b = match random.below(5) {
        0 => format!("(q - {k})"),
        1 => format!("(q^2 - {k})"),
        2 => format!("sin({k}*q)"),
        3 => format!("(q + x - {k})"),
        _ => format!("(q*x - {k})"),
    };
    let (i, k) = (random.pick(&["", "exp", "atan", "sinh"]), random.number());
    format!("struct A {{}} H(q, x; p, u) = {k}*{a}*{b}; invariant i = {i}({a}) on H = 0")
}

/// What jumps at u = 0 = x: a set of codimension 2, but on u = 0 motion crosses x = 0.
fn thin_sets(random: &mut Random) -> String {
    let f = random.pick(&["y", "(1 + y^2)", "exp(y)", "y^3", "(2 + cos(y))"]);
    let k = random.number();
    let root = match random.below(3) {
        0 => format!("sqrt(x^2 + {k}*u^2)"),
        1 => format!("hypot(x, {k}*u)"),
        _ => format!("sqrt(x^2 + u^4*{k})"),
    };
    let jump = match random.below(4) {
        0 => format!("{root}/x"),
        1 => format!("x/{root}"),
        2 => format!("atan2(x, {k}*u)*(1 + u)"),
        _ => format!("(x + {root})/{root}"),
    };
    let i = random.monotone(&jump);
    format!("struct A {{}} H(x, y; u, v) = {k}*u*{f}; invariant i = {i} on H = 0")
}

/// Motion that stops at p = 0 after a finite time, and a clock of p that does not.
fn stopping_forces(random: &mut Random) -> String {
    let c = random.number();
    let (force, clock) = match random.below(6) {
        0 => (format!("-{c}*sign(p)"), format!("abs(p)/{c}")),
        1 => (format!("-{c}*cbrt(p)"), format!("3*cbrt(p)^2/(2*{c})")),
        2 => (
            format!("-{c}*sign(p)*sqrt(abs(p))"),
            format!("2*sqrt(abs(p))/{c}"),
        ),
        3 => (
            format!("if p < 0 {{ {c} }} else {{ -{c} }}"),
            format!("abs(p)/{c}"),
        ),
        4 => (
            format!("-{c}*p/sqrt(abs(p))"),
            format!("2*sqrt(abs(p))/{c}"),
        ),
        _ => (format!("-{c}*p/abs(p)"), format!("sqrt(p^2)/{c}")),
    };
    let kinetic = random.pick(&["p^2/2", "p^4", "p^2/2 + u^2/2", "cosh(p)", "p^2 + p*0"]);
    let i = random.monotone(&format!("{clock} + t"));
    let more = random.pick(&["", " + u", " + u^2", "*(1 + u^2)"]);
    format!(
        "struct A {{}} H(q, x; p, u; t) = {kinetic}; force(q, x; p, u; t) = [{force}, 0]; invariant i = {i}{more}"
    )
}

/// A function of 1/x, or of 1/t, with another limit on either side.
fn essential_singularities(random: &mut Random) -> String {
    let (k, at) = (
        random.number(),
        random.pick(&["", " - 1", " + 2", " - 1/3"]),
    );
    let power = random.pick(&["", "^3", "^5"]);
    let place = |x: &str| format!("{k}/({x}{at}){power}");
    let step = |random: &mut Random, x: &str| match random.below(6) {
        0 => format!("tanh({})", place(x)),
        1 => format!("erf({})", place(x)),
        2 => format!("1/(1 + exp({}))", place(x)),
        3 => format!("atan({})", place(x)),
        4 => format!("tanh({})^3", place(x)),
        _ => format!("erfc({})", place(x)),
    };
    match random.below(3) {
        0 => {
            let v = step(random, "x");
            let i = random.pick(&["H", "H^2", "exp(H)", "H + u"]);
            format!("struct A {{}} H(x, y; p, u) = (p^2 + u^2)/2 + {v}; invariant i = {i}")
        }
        1 => {
            let v = step(random, "x");
            format!(
                "struct A {{}} H(x, y; p, u) = p^2/2 + cos(y)*u^2 + {v}; invariant i = p^2/2 + {v}"
            )
        }
        _ => {
            let (force, clock) = match random.below(3) {
                0 => (format!("-1/(1 + (t{at})^2)"), format!("atan(1/(t{at}))")),
                1 => (
                    format!("-{k}/(cosh({k}/(t{at}))^2*(t{at})^2)"),
                    format!("tanh({k}/(t{at}))"),
                ),
                _ => (
                    format!("-{k}*exp(-({k}/(t{at}))^2)/(t{at})^2"),
                    format!("sqrt(pi)/2*erf({k}/(t{at}))"),
                ),
            };
            format!(
                "struct A {{}} H(q; p; t) = p^2/2; force(q; p; t) = {force}; invariant i = p - {clock}"
            )
        }
    }
}

/// A potential whose branches agree at a threshold that jumps itself.
fn jumping_thresholds(random: &mut Random) -> String {
    let (k, c) = (random.number(), random.number());
    let threshold = match random.below(5) {
        0 => format!("{k}*y/abs(y)"),
        1 => format!("{k}*sign(y)"),
        2 => format!("(if y < 0 {{ -{k} }} else {{ {k} }})"),
        3 => format!("{k}*sqrt(y^2)/y"),
        _ => format!("{k}*tanh(1/y)"),
    };
    let base = random.pick(&["0", "x^2", "cos(x)", "x*y"]);
    let order = random.pick(&["x < T", "T < x", "x <= T"]);
    let order = order.replace('T', &threshold);
    let other = match random.below(2) {
        0 => format!("{base} + {c}*(x - {threshold})"),
        _ => format!("{base} + {c}*(x - {threshold})*(x + 20)"),
    };
    let i = random.pick(&["H", "2*H + 1", "exp(H)"]);
    format!(
        "struct A {{}} H(x, y; p, u) = (p^2 + u^2)/2 + (if {order} {{ {base} }} else {{ {other} }}); invariant i = {i}"
    )
}

/// A wall that is none where a parameter is 0.
fn vanishing_parameters(random: &mut Random) -> String {
    let n = random.pick(&["2", "4", "6"]);
    let a = random.pick(&[
        "a",
        "a^2",
        "abs(a)",
        "a^4",
        "(a - 1)^2",
        "a*b",
        "(a + b)^2",
        "sqrt(abs(a))",
    ]);
    let more = random.pick(&["", "*(1 + y^2)", "*(2 + cos(y))", "*exp(y)"]);
    let place = random.pick(&["x", "(x - y)", "(x - 1)", "(x + 2*y)"]);
    let i = match random.below(6) {
        0 => format!("sign({place})"),
        1 => format!("abs({place})/{place}"),
        2 => format!("{place}/abs({place})"),
        3 => format!("(if {place} > 0 {{ 1 }} else {{ 2 }})"),
        4 => format!("sign({place})*H"),
        _ => format!("sqrt({place}^2)/{place}"),
    };
    format!(
        "struct A {{a, b}} H(x, y; p, u) = (p^2 + u^2)/2 + {a}{more}/{place}^{n}; invariant i = {i}"
    )
}

/// A jump at a place that is solved for a coordinate only where a parameter is not 0.
fn vanishing_slopes(random: &mut Random) -> String {
    let slope = random.pick(&["a", "a^2", "a*b", "(a - b)", "a^3"]);
    let rest = random.pick(&["", " + y", " - b", " + y^2 - 1", " + u"]);
    let place = format!("({slope}*x{rest})");
    let v = random.pick(&["0", "x^2", "cos(x)", "y^2 + x*y", "1/(1 + x^2)"]);
    let i = match random.below(5) {
        0 => format!("sign{place}"),
        1 => format!("abs{place}/{place}"),
        2 => format!("(if {place} < 0 {{ 1 }} else {{ 3 }})"),
        3 => format!("{place}*sqrt(1/{place}^2)"),
        _ => format!("sign{place}^2"),
    };
    let wall = random.pick(&["", "", " + a/(1 + y^2)"]);
    format!("struct A {{a, b}} H(x, y; p, u) = (p^2 + u^2)/2 + {v}{wall}; invariant i = {i}")
}

/// H is infinite on both sides of p = c, and moves p at p = c itself.
fn own_values(random: &mut Random) -> String {
    let (c, n) = (random.number(), random.pick(&["2", "4", "6"]));
    let own = random.pick(&["q", "2*q", "q^3 + q", "exp(q)", "q - 1"]);
    let k = random.number();
    let i = match random.below(5) {
        0 => format!("sign(p - {c})"),
        1 => "p".to_owned(),
        2 => format!("abs(p - {c})/(p - {c})"),
        3 => format!("(if p > {c} {{ 1 }} else {{ 2 }})"),
        _ => "p^2".to_owned(),
    };
    format!(
        "struct A {{}} H(q; p) = if p == {c} {{ {own} }} else {{ {k}/(p - {c})^{n} }}; invariant i = {i}"
    )
}

/// A branch that is taken at one value of a constant of the motion, and changes there.
fn single_levels(random: &mut Random) -> String {
    let (of, level) = match random.below(4) {
        0 => ("u".to_owned(), random.number()),
        1 => ("(x*v - y*u)".to_owned(), random.number()),
        2 => ("H".to_owned(), random.number()),
        _ => ("(u + v)".to_owned(), random.number()),
    };
    let (h, of) = match of.as_str() {
        "u" | "(u + v)" => ("(u^2 + v^2)/2", of),
        _ => ("(u^2 + v^2)/2 + (x^2 + y^2)^2", of),
    };
    let changing = random.pick(&["x", "x*y + 1", "x^2 + y", "y^3"]);
    let constant = random.pick(&["1", "H", "0", "H^2"]);
    let i = match random.below(4) {
        0 => format!("if ({of} - {level})^2 > 0 {{ {constant} }} else {{ {changing} }}"),
        1 => format!("if {of} == {level} {{ {changing} }} else {{ {constant} }}"),
        2 => format!("if abs({of} - {level}) <= 0 {{ {changing} }} else {{ {constant} }}"),
        _ => format!("{constant} + (1 - sign({of} - {level})^2)*({changing})"),
    };
    format!("struct A {{}} H(x, y; u, v) = {h}; invariant i = {i}")
}

/// A force that is not Lipschitz at an equilibrium: motion may rest there for a while and go.
fn branching_equilibria(random: &mut Random) -> String {
    let place = random.pick(&["q", "(q - 1)", "(q + 2)", "(2*q - 3)"]);
    let power = random.pick(&[
        "abs($)^(3/2)",
        "abs($)^(4/3)",
        "abs($)^(5/4)",
        "abs($)",
        "cbrt($)^4",
        "$*cbrt($)",
        "sqrt(abs($))*abs($)",
        "sqrt($^2)",
        "hypot($, 0*p)^(3/2)",
    ]);
    let hill = power.replace('$', place);
    let k = random.number();
    let distance = random.pick(&["p^2 + $^2", "abs(p) + abs($)", "p^4 + $^2", "p^2 + abs($)"]);
    let distance = distance.replace('$', place);
    let i = match random.below(6) {
        0 => format!("sign({distance})"),
        1 => format!("if {distance} > 0 {{ {k} }} else {{ 0 }}"),
        2 => format!("u*sign({distance})"),
        3 => format!("if {place} == 0 && p == 0 {{ u }} else {{ {k}*u + 1 }}"),
        4 => format!("H + sign({distance})"),
        _ => format!("(1 - sign({distance}))*exp(u)"),
    };
    let beside = random.pick(&["0", "x", "u^2/2"]);
    let beside = if i.contains('u') { "u^2/2" } else { beside };
    format!("struct A {{}} H(q, x; p, u) = p^2/2 + {beside} - {k}*{hill}; invariant i = {i}")
}
