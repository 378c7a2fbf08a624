//! A search for statements that are proven and false, in the two classes in which there were some:
//! powers at negative numbers, and jumps through poles, near and far.
//!
//! Statements are made by rules that hold at positive numbers, or by functions with two sides. What
//! is proven must be so in numbers, at points of every sign, for exponents that are whole and for
//! others.

use crate::common::{cases, parse, system};
use crate::random_text::Random;
use hamiltonian_symbolic::Ball;
use hamiltonian_symbolic::bracket::is_invariant;
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::loops::{Sample, sample};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};

impl Random {
    /// Two expressions that are equal where all that is raised to a power is positive.
    fn equals(&mut self, depth: usize) -> (String, String) {
        if depth == 0 {
            let leaf = self.pick(&["q", "q", "q", "a", "b", "2", "3"]).to_owned();
            return (leaf.clone(), leaf);
        }
        let (x, x2) = self.equals(depth - 1);
        let (y, y2) = self.equals(depth - 1);
        let e = self.pick(&[
            "a", "b", "2*a", "a + 1", "a - b", "3", "1/2", "1/3", "5/4", "-1", "2",
        ]);
        let f = self.pick(&["b", "a", "2", "1/2", "b + 2", "-b"]);
        match self.below(17) {
            0 => (
                format!("(({x})^({e}))^({f})"),
                format!("({x2})^(({e})*({f}))"),
            ),
            1 => (format!("abs({x})^({e})"), format!("({x2})^({e})")),
            2 => (format!("abs(({x})^({e}))"), format!("({x2})^({e})")),
            3 => (
                format!("({x})^({e})*({x2})^({f})"),
                format!("({x2})^(({e}) + ({f}))"),
            ),
            4 => (
                format!("(({x})*({y}))^({e})"),
                format!("({x2})^({e})*({y2})^({e})"),
            ),
            5 => (format!("exp(({e})*ln({x}))"), format!("({x2})^({e})")),
            6 => (format!("exp(({e})*ln(abs({x})))"), format!("({x2})^({e})")),
            7 => (format!("sqrt(({x})^2)"), x2),
            8 => (format!("sqrt({x})^2"), x2),
            9 => (format!("1/({x})^({e})"), format!("({x2})^(-({e}))")),
            10 => (format!("cbrt({x})^3"), x2),
            11 => (format!("(({x})^2)^({e})"), format!("({x2})^(2*({e}))")),
            12 => (format!("ln(({x})^({e}))"), format!("({e})*ln(abs({x2}))")),
            13 => (format!("({x})*sign({x})"), x2),
            14 => (format!("({x}) + ({y})"), format!("({y2}) + ({x2})")),
            15 => (format!("({x})*({y})"), format!("({y2})*({x2})")),
            _ => (format!("({x})^({e})"), format!("({x2})^({e})")),
        }
    }

    /// A function of q that is constant on each side of a place.
    fn step(&mut self) -> String {
        let place = self.pick(&["0", "1", "100000", "a", "-1/3", "10^9", "b*2"]);
        let k = self.pick(&["1", "2", "-3", "(1 + p^2)", "a"]);
        let w = match self.below(5) {
            0 => format!("({k}*(q - {place}))"),
            1 => format!("(q - {place})^2"),
            2 => format!("({k}*(q - {place})^3)"),
            3 => format!("(q^2 - ({place})^2)"),
            _ => format!("(q - {place})"),
        };
        let c = self.pick(&["1", "2", "-1", "p", "1/2"]);
        let step = match self.below(13) {
            0 => format!("(atan({w}) + atan(1/{w}))"),
            1 => format!("abs({w})/{w}"),
            2 => format!("sqrt({w}^2)/{w}"),
            3 => format!("(max({w}, 0) - max(-{w}, 0))/{w}"),
            4 => format!("(max({w}, 0) + max(-{w}, 0))/{w}"),
            5 => format!("{w}*exp(-ln(abs({w})))"),
            6 => format!("{w}*sqrt(1/{w}^2)"),
            7 => format!("sign({w})"),
            8 => format!("(if {w} < 0 {{ 1 }} else {{ 2 }})"),
            9 => format!("hypot({w}, {w})/{w}"),
            10 => format!("(atan(1/{w}^2) + atan({w}^2))"),
            11 => format!("sign({w})^2"),
            _ => format!("(atan(2/{w}) + atan({w}/2))"),
        };
        format!("{c}*{step}")
    }
}

/// Values of an expression of q, at p = 1/2 and given parameters; NaN where a part of it is not defined
/// either, though C's `pow` says that NaN⁰ is 1.
fn values(model: &mut Model, node: Node, parameters: [f64; 2], at: &[f64]) -> Vec<f64> {
    let [q, p, a, b] = ["q", "p", "k[0]", "k[1]"].map(|leaf| parse(model, leaf));
    let parts = model.dag.reachable(&[node]);
    let value = |at: &f64| {
        let given = [(q, *at), (p, 0.5), (a, parameters[0]), (b, parameters[1])];
        let given = given.map(|(node, value)| (node, Ball::exact(value)));
        let (values, _) = sample(model, &parts, &[], Sample::default(), &given).unwrap();
        let value = values[parts.len() - 1];
        let is_defined = values.iter().all(|part| !part.value.is_nan());
        if is_defined && value.error < 1e-6 * (1.0 + value.value.abs()) {
            value.value
        } else {
            f64::NAN
        }
    };
    at.iter().map(value).collect()
}

fn parameters(random: &mut Random) -> [f64; 2] {
    const VALUES: [f64; 10] = [-2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 3.0, 0.75, 1.5, 5.0];
    [0, 1].map(|_| VALUES[random.below(VALUES.len())])
}

/// `a` and `b` are elements of an array, so that they can be given values.
fn with_parameters(source: &str) -> String {
    let is_word = |c: char| c.is_alphanumeric();
    let chars: Vec<char> = source.chars().collect();
    let alone = |at: usize| {
        let mut around = chars[at.saturating_sub(1)..chars.len().min(at + 2)].iter();
        around.by_ref().filter(|c| is_word(**c)).count() == 1
    };
    let each = chars.iter().enumerate().map(|(at, c)| match c {
        'a' if alone(at) => "k[0]".to_owned(),
        'b' if alone(at) => "k[1]".to_owned(),
        c => c.to_string(),
    });
    each.collect()
}

#[test]
fn powers_at_negative_numbers() {
    let mut random = Random(11);
    let (mut proven, mut tried) = (0, 0);
    for _ in 0..cases(500, 20_000) {
        let depth = 1 + random.below(3);
        let (one, other) = random.equals(depth);
        let (one, other) = (with_parameters(&one), with_parameters(&other));
        let mut model = system("q; p", "", "k[2]", &format!("p^2/2 + {one}"));
        let claim = parse(&mut model, &format!("p^2/2 + {other}"));
        let difference = parse(&mut model, &format!("({one}) - ({other})"));
        let is_conserved = is_invariant(&model, claim, None).is_proven();
        let is_zero = is_zero(&model, difference) == Proof::Zero;
        tried += 1;
        proven += usize::from(is_conserved);
        if !is_conserved && !is_zero {
            continue;
        }
        for _ in 0..6 {
            let parameters = parameters(&mut random);
            let sides = [[0.3, 1.7, 2.25], [-0.3, -1.7, -2.25]];
            let sides = sides.map(|at| values(&mut model, difference, parameters, &at));
            for side in &sides {
                let finite: Vec<f64> = side.iter().copied().filter(|v| v.is_finite()).collect();
                let is_same =
                    |v: &f64, w: f64| (v - w).abs() <= 1e-7 * (1.0 + v.abs().max(w.abs()));
                assert!(
                    !is_zero || finite.iter().all(|v| is_same(v, 0.0)),
                    "{one} = {other} at {parameters:?}: {finite:?}"
                );
                assert!(
                    !is_conserved || finite.iter().all(|v| is_same(v, finite[0])),
                    "p^2/2 + {one} keeps p^2/2 + {other} at {parameters:?}: {finite:?}"
                );
            }
        }
    }
    assert!(5 * proven > tried, "{proven} proven of {tried}");
}

#[test]
fn jumps_near_and_far() {
    let mut random = Random(12);
    let (mut proven, mut tried) = (0, 0);
    for _ in 0..cases(500, 20_000) {
        let mut claim = random.step();
        for _ in 0..random.below(3) {
            claim = format!("{claim} + {}", random.step());
        }
        let claim = with_parameters(&claim);
        let mut model = system("q; p", "", "k[2]", "p^2/2");
        let node = parse(&mut model, &claim);
        tried += 1;
        if !is_invariant(&model, node, None).is_proven() {
            continue;
        }
        proven += 1;
        for _ in 0..4 {
            let parameters = parameters(&mut random);
            let at = [
                -2e9, -2e5, -11.3, -2.9, -0.4, -0.2, 0.1, 0.75, 1.1, 3.1, 11.9, 99_999.0,
                100_001.0, 3e5, 2e9,
            ];
            let found = values(&mut model, node, parameters, &at);
            let finite: Vec<f64> = found.into_iter().filter(|v| v.is_finite()).collect();
            assert!(
                finite.iter().all(|v| (v - finite[0]).abs() < 1e-3),
                "{claim} at {parameters:?}: {finite:?}"
            );
        }
    }
    assert!(20 * proven > tried, "{proven} proven of {tried}");
}
