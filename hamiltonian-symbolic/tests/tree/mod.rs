//! Random expressions, kept as plain trees beside the engine.
//!
//! Input: a seed. Output: [`Tree`], which builds itself in an arena, evaluates itself over any
//! scalar by the rules of that scalar alone, says where it is on an edge, and prints itself.
//! Invariant: nothing here simplifies; the same seed gives the same tree.

mod edges;
mod grow;

pub use edges::{Region, region};
pub use grow::grow;

use hamiltonian_lanes::{DoubleDouble, Mask, Real};
use hamiltonian_symbolic::dag::{Node, Parameter, Side};
use hamiltonian_symbolic::model::{Group, Model, ParameterDeclaration, Shape};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::rational::Rational;

/// Pairs (q, p) of scalar coordinates.
pub const PAIRS: usize = 2;
/// Scalar parameters.
pub const PARAMETERS: usize = 3;
/// All variables: q, p, t, parameters, in this order.
pub const VARIABLES: usize = 2 * PAIRS + 1 + PARAMETERS;
/// The number of t among the variables.
pub const TIME: usize = 2 * PAIRS;
const NAMES: [&str; VARIABLES] = ["x", "y", "px", "py", "t", "a", "b", "c"];

/// SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }
    pub fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// A comparison of two places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Test {
    Less(usize, usize),
    LessEqual(usize, usize),
    Equal(usize, usize),
}

/// One place of a tree; operands are earlier places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    Variable(usize),
    /// A fraction.
    Number(i64, i64),
    Pi,
    Neg(usize),
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    /// To the power of a fraction.
    Power(usize, i64, i64),
    Call(Op, usize),
    Call2(Op, usize, usize),
    /// A test (or, negated, its contrary), and two tests together.
    If(Test, bool, usize, usize),
    IfBoth(Test, Test, bool, usize, usize),
}

/// An expression: the last place is its value.
#[derive(Clone, Debug, Default)]
pub struct Tree(pub Vec<Part>);

impl Part {
    /// The operands that are numbers, tests included.
    pub fn operands(self) -> Vec<usize> {
        let of = |test: Test| match test {
            Test::Less(a, b) | Test::LessEqual(a, b) | Test::Equal(a, b) => [a, b],
        };
        match self {
            Part::Variable(_) | Part::Number(..) | Part::Pi => vec![],
            Part::Neg(a) | Part::Power(a, ..) | Part::Call(_, a) => vec![a],
            Part::Add(a, b)
            | Part::Sub(a, b)
            | Part::Mul(a, b)
            | Part::Div(a, b)
            | Part::Call2(_, a, b) => vec![a, b],
            Part::If(test, _, a, b) => [of(test), [a, b]].concat(),
            Part::IfBoth(one, two, _, a, b) => [of(one), of(two), [a, b]].concat(),
        }
    }

    /// Its value from those of all earlier places.
    pub fn value<T: Real>(self, variables: &[T], v: impl Fn(usize) -> T) -> T {
        let fraction = |n: i64, d: i64| {
            let value = DoubleDouble::lift(n) / DoubleDouble::lift(d);
            T::constant(value.hi(), value.lo())
        };
        let holds = |test: Test| match test {
            Test::Less(a, b) => v(a).lt(v(b)),
            Test::LessEqual(a, b) => v(a).le(v(b)),
            Test::Equal(a, b) => v(a).equals(v(b)),
        };
        match self {
            Part::Variable(n) => variables[n],
            Part::Number(n, d) => fraction(n, d),
            Part::Pi => T::constant(std::f64::consts::PI, hamiltonian_symbolic::PI_LOW),
            Part::Neg(a) => -v(a),
            Part::Add(a, b) => v(a) + v(b),
            Part::Sub(a, b) => v(a) - v(b),
            Part::Mul(a, b) => v(a) * v(b),
            Part::Div(a, b) => v(a) / v(b),
            Part::Power(a, n, 1) => integer_power(v(a), n),
            Part::Power(a, n, d) => v(a).pow(fraction(n, d)),
            Part::Call(op, a) => op.eval(&[v(a)]),
            Part::Call2(op, a, b) => op.eval(&[v(a), v(b)]),
            Part::If(test, negated, a, b) => {
                let mask = holds(test);
                T::select(if negated { !mask } else { mask }, v(a), v(b))
            }
            Part::IfBoth(one, two, either, a, b) => {
                let (one, two) = (holds(one), holds(two));
                let mask = if either { one | two } else { one & two };
                assert!(mask.any() == mask.all());
                T::select(mask, v(a), v(b))
            }
        }
    }
}

/// A power by repeated multiplication, so that the base may be of any sign.
fn integer_power<T: Real>(x: T, n: i64) -> T {
    let product = (0..n.abs()).fold(T::one(), |product, _| product * x);
    if n < 0 { T::one() / product } else { product }
}

impl Tree {
    /// The values of all places.
    pub fn values<T: Real>(&self, variables: &[T]) -> Vec<T> {
        let mut values: Vec<T> = Vec::with_capacity(self.0.len());
        for part in &self.0 {
            let value = part.value(variables, |at| values[at]);
            values.push(value);
        }
        values
    }
    /// The value.
    pub fn value<T: Real>(&self, variables: &[T]) -> T {
        *self.values(variables).last().unwrap()
    }
    /// The value where operations that leave their domain give some function of the variables instead, the same for
    /// the same operation on the same operands: what holds for every function shows. `variables` are the point's.
    pub fn licensed_value<T: Real>(&self, point: &[f64], variables: &[T]) -> T {
        let mut numbers: Vec<f64> = Vec::with_capacity(self.0.len());
        let mut values: Vec<T> = Vec::with_capacity(self.0.len());
        for (at, part) in self.0.iter().enumerate() {
            let mut number = part.value(point, |at| numbers[at]);
            let mut value = part.value(variables, |at| values[at]);
            if number.is_nan() {
                let seed = self
                    .text_of(at)
                    .bytes()
                    .fold(7, |h, b| Random(h ^ u64::from(b)).next());
                let mut random = Random(seed);
                number = 0.5 + random.unit();
                value = T::constant(number, 0.0);
                for (x, here) in variables.iter().zip(point) {
                    let slope = T::constant(random.unit() - 0.5, 0.0);
                    value += slope * (*x - T::constant(*here, 0.0));
                }
            }
            numbers.push(number);
            values.push(value);
        }
        *values.last().unwrap()
    }
    /// Returns true if an operation leaves its domain at a point, whatever becomes of its value.
    pub fn leaves_domain(&self, point: &[f64]) -> bool {
        self.values(point).iter().any(|value| value.is_nan())
    }
    /// Returns true if functions of exponentials occur.
    pub fn has_exponentials(&self) -> bool {
        let is_one = |part: &Part| {
            matches!(
                part,
                Part::Call(Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh | Op::Tanh, _)
            )
        };
        self.0.iter().any(is_one)
    }
    /// Returns true if a variable occurs.
    pub fn mentions(&self, variable: usize) -> bool {
        self.0.contains(&Part::Variable(variable))
    }

    /// The model whose H this is.
    pub fn model(&self) -> Model {
        let mut model = Model {
            name: "Random".into(),
            time: Some(NAMES[TIME].into()),
            ..Model::default()
        };
        for pair in 0..PAIRS {
            model
                .groups
                .push(Group::scalar(NAMES[pair], NAMES[PAIRS + pair]));
        }
        for parameter in 0..PARAMETERS {
            model.parameters.push(ParameterDeclaration {
                name: NAMES[TIME + 1 + parameter].into(),
                shape: Shape::Scalar,
            });
        }
        let mut nodes: Vec<Node> = Vec::new();
        for part in &self.0 {
            let node = build(&mut model, *part, &nodes);
            nodes.push(node);
        }
        model.hamiltonian = nodes.last().copied();
        model
    }

    /// True for each place that depends on q, p or t.
    fn varies(&self) -> Vec<bool> {
        let mut varies: Vec<bool> = Vec::with_capacity(self.0.len());
        for part in &self.0 {
            let own = matches!(part, Part::Variable(at) if *at <= TIME);
            let operands = part.operands();
            varies.push(own || operands.into_iter().any(|at| varies[at]));
        }
        varies
    }

    /// Operations of one evaluation of the expression as written, shared places once: a quotient
    /// counts as a reciprocal and a product, powers as multiplication trees, what depends on
    /// parameters alone as nothing.
    pub fn operations(&self) -> usize {
        let varies = self.varies();
        let count = |part: &Part| match *part {
            Part::Variable(_) | Part::Number(..) | Part::Pi | Part::Neg(_) => 0,
            Part::Add(..) | Part::Sub(..) | Part::Mul(..) => 1,
            Part::Div(a, b) => {
                usize::from(varies[b]) + usize::from(self.0[a] != Part::Number(1, 1))
            }
            Part::Power(_, n, d) => {
                let m = n.unsigned_abs() as usize;
                let chain = m.ilog2() as usize + m.count_ones() as usize - 1;
                chain + usize::from(n < 0) + usize::from(d == 2 || d == 3)
            }
            Part::Call(Op::Abs | Op::Sign | Op::Floor | Op::Round, _)
            | Part::Call2(Op::Min | Op::Max, ..) => 0,
            Part::Call(..) | Part::Call2(..) => 1,
            Part::If(..) | Part::IfBoth(..) => 0,
        };
        let parts = self.0.iter().zip(&varies);
        parts
            .filter(|(_, varies)| **varies)
            .map(|(part, _)| count(part))
            .sum()
    }

    /// The text, in the language's notation.
    pub fn text(&self) -> String {
        self.text_of(self.0.len() - 1)
    }

    fn text_of(&self, at: usize) -> String {
        let t = |at: usize| self.text_of(at);
        let test = |test: Test| match test {
            Test::Less(a, b) => format!("{} < {}", t(a), t(b)),
            Test::LessEqual(a, b) => format!("{} <= {}", t(a), t(b)),
            Test::Equal(a, b) => format!("{} == {}", t(a), t(b)),
        };
        match self.0[at] {
            Part::Variable(n) => NAMES[n].into(),
            // −1^2 is −(1^2).
            Part::Number(n, 1) if n < 0 => format!("({n})"),
            Part::Number(n, 1) => n.to_string(),
            Part::Number(n, d) => format!("({n}/{d})"),
            Part::Pi => "pi".into(),
            Part::Neg(a) => format!("(-{})", t(a)),
            Part::Add(a, b) => format!("({} + {})", t(a), t(b)),
            Part::Sub(a, b) => format!("({} - {})", t(a), t(b)),
            Part::Mul(a, b) => format!("({}*{})", t(a), t(b)),
            Part::Div(a, b) => format!("({}/{})", t(a), t(b)),
            Part::Power(a, n, 1) => format!("({}^{n})", t(a)),
            Part::Power(a, n, d) => format!("({}^({n}/{d}))", t(a)),
            Part::Call(op, a) => format!("{}({})", op.row().name, t(a)),
            Part::Call2(Op::Modulo, a, b) => format!("({} % {})", t(a), t(b)),
            Part::Call2(op, a, b) => format!("{}({}, {})", op.row().name, t(a), t(b)),
            Part::If(c, negated, a, b) => {
                let not = if negated { "!" } else { "" };
                format!("(if {not}({}) {{ {} }} else {{ {} }})", test(c), t(a), t(b))
            }
            Part::IfBoth(c, d, either, a, b) => {
                let word = if either { "||" } else { "&&" };
                let (c, d) = (test(c), test(d));
                format!("(if ({c}) {word} ({d}) {{ {} }} else {{ {} }})", t(a), t(b))
            }
        }
    }
}

fn build(model: &mut Model, part: Part, n: &[Node]) -> Node {
    if let Part::Variable(at) = part {
        return match at {
            _ if at < PAIRS => model.scalar(Side::Q, at),
            _ if at < 2 * PAIRS => model.scalar(Side::P, at - PAIRS),
            TIME => model.dag.time(),
            _ => model.dag.parameter(Parameter((at - TIME - 1) as u16)),
        };
    }
    let dag = &mut model.dag;
    let holds = |dag: &mut hamiltonian_symbolic::dag::Dag, test: Test| match test {
        Test::Less(a, b) => dag.less(n[a], n[b]),
        Test::LessEqual(a, b) => dag.less_equal(n[a], n[b]),
        Test::Equal(a, b) => dag.equal(n[a], n[b]),
    };
    match part {
        Part::Variable(_) => unreachable!(),
        Part::Number(num, den) => dag.constant(Rational::new(num, den)),
        Part::Pi => dag.pi(),
        Part::Neg(a) => dag.neg(n[a]),
        Part::Add(a, b) => dag.add(&[n[a], n[b]]),
        Part::Sub(a, b) => dag.sub(n[a], n[b]),
        Part::Mul(a, b) => dag.mul(&[n[a], n[b]]),
        Part::Div(a, b) => dag.div(n[a], n[b]),
        Part::Power(a, num, den) => {
            let exponent = dag.constant(Rational::new(num, den));
            dag.pow(n[a], exponent)
        }
        Part::Call(op, a) => dag.call(op, &[n[a]]),
        Part::Call2(op, a, b) => dag.call(op, &[n[a], n[b]]),
        Part::If(test, negated, a, b) => {
            let mut condition = holds(dag, test);
            if negated {
                condition = dag.not(condition);
            }
            dag.select(condition, n[a], n[b])
        }
        Part::IfBoth(one, two, either, a, b) => {
            let (one, two) = (holds(dag, one), holds(dag, two));
            let condition = if either {
                dag.or(one, two)
            } else {
                dag.and(one, two)
            };
            dag.select(condition, n[a], n[b])
        }
    }
}
