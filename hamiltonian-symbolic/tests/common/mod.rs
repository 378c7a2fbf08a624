//! A small reader of the language, so that tests are written in the notation they are about.
//!
//! Input: declarations and expressions as text. Output: a [`Model`] and nodes of its arena. It
//! panics on unknown words; the real front end is the macro's.

use hamiltonian_symbolic::Ball;
use hamiltonian_symbolic::dag::{Array, Column, Node, Parameter, Side};
use hamiltonian_symbolic::index::{Affine, Domain, Index, Size};
use hamiltonian_symbolic::loops::{Sample, sample};
use hamiltonian_symbolic::model::{External, Group, Model, ParameterDeclaration, Shape};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::program::Purpose;
use hamiltonian_symbolic::rational::Rational;

/// The macro asks for these functions of a separable H, in this order. Of another H it asks for the first eight and
/// the last.
pub const PURPOSES: [Purpose; 11] = [
    Purpose::Energy,
    Purpose::EnergyAndGradient,
    Purpose::TimeDerivative,
    Purpose::HessianVector,
    Purpose::GradientQ,
    Purpose::GradientP,
    Purpose::Gradient,
    Purpose::VectorField,
    Purpose::Kick,
    Purpose::Drift,
    Purpose::ParameterGradient,
];

/// A model from a signature like `q[n][3], s; p[n][3], u; t`, names of sizes, and parameters like
/// `G m[n] a`. Sizes named `f/2` in `externals` are Rust functions with their arity.
pub fn model(signature: &str, sizes: &str, parameters: &str) -> Model {
    let mut model = Model {
        name: "Test".into(),
        ..Model::default()
    };
    model.sizes = sizes.split_whitespace().map(str::to_owned).collect();
    for declaration in parameters.split_whitespace() {
        if let Some((name, arity)) = declaration.split_once('/') {
            model.externals.push(External {
                name: name.into(),
                arguments: ["x", "y", "z"][..arity.parse().unwrap()]
                    .iter()
                    .map(|name| (*name).to_owned())
                    .collect(),
            });
            continue;
        }
        let (name, shape) = declared(&model, declaration);
        model.parameters.push(ParameterDeclaration { name, shape });
    }
    let mut parts = signature.split(';');
    let (q, p) = (parts.next().unwrap(), parts.next().unwrap());
    model.time = parts.next().map(|t| t.trim().to_owned());
    for (q, p) in q.split(',').zip(p.split(',')) {
        let (coordinate, shape) = declared(&model, q.trim());
        let (momentum, _) = declared(&model, p.trim());
        let shape = match shape {
            Shape::Scalar => Shape::Scalar,
            Shape::Vector(rows) => Shape::Vector(rows),
            Shape::Matrix(rows, columns) => {
                Shape::Matrix(rows, columns.as_constant().unwrap() as u16)
            }
            Shape::Lattice(elements, axes) => Shape::Lattice(elements, axes),
        };
        model.groups.push(Group {
            coordinate,
            momentum,
            velocity: None,
            shape,
        });
    }
    model
}

/// The number of `all` cases that a test takes: a part, or with `HAMILTONIAN_HEAVY=1` every one.
pub fn cases(part: usize, all: usize) -> usize {
    let is_heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    if is_heavy { all } else { part }
}

/// A model with its H.
pub fn system(signature: &str, sizes: &str, parameters: &str, h: &str) -> Model {
    let mut model = model(signature, sizes, parameters);
    let node = parse(&mut model, h);
    model.hamiltonian = Some(node);
    model
}

fn declared(model: &Model, text: &str) -> (String, Shape) {
    let mut pieces = text.split('[');
    let name = pieces.next().unwrap().to_owned();
    let extents: Vec<Affine> = pieces
        .map(|extent| {
            let extent = extent.trim_end_matches(']');
            match extent.parse() {
                Ok(n) => Affine::constant(n),
                Err(_) => Affine::size(Size(
                    model.sizes.iter().position(|s| s == extent).unwrap() as u16
                )),
            }
        })
        .collect();
    let shape = match extents.as_slice() {
        [] => Shape::Scalar,
        [rows] => Shape::Vector(rows.clone()),
        [rows, columns] => Shape::Matrix(rows.clone(), columns.clone()),
        extents => {
            let mut all = extents.iter();
            let elements = all.try_fold(Affine::constant(1), |n, m| n.checked_times(m));
            Shape::Lattice(elements.unwrap(), extents.to_vec())
        }
    };
    (name, shape)
}

/// An expression.
pub fn parse(model: &mut Model, text: &str) -> Node {
    let tokens = tokens(text);
    let mut parser = Parser {
        model,
        tokens,
        at: 0,
        scopes: Vec::new(),
    };
    let node = parser.expression(0);
    assert_eq!(
        parser.at,
        parser.tokens.len(),
        "unread: {:?}",
        &parser.tokens[parser.at..]
    );
    node
}

fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < chars.len() {
        let c = chars[at];
        let start = at;
        at += 1;
        if c.is_whitespace() {
            continue;
        }
        if c.is_alphabetic() || c == '_' {
            while at < chars.len() && (chars[at].is_alphanumeric() || chars[at] == '_') {
                at += 1;
            }
        } else if c.is_ascii_digit() {
            while at < chars.len()
                && (chars[at].is_ascii_digit()
                    || (chars[at] == '.' && chars.get(at + 1).is_some_and(char::is_ascii_digit)))
            {
                at += 1;
            }
            if at + 1 < chars.len() && chars[at] == 'e' {
                at += 2;
                while at < chars.len() && chars[at].is_ascii_digit() {
                    at += 1;
                }
            }
        } else if at < chars.len()
            && ["..", "<=", ">=", "==", "!=", "&&", "||"]
                .contains(&format!("{c}{}", chars[at]).as_str())
        {
            at += 1;
        }
        tokens.push(chars[start..at].iter().collect());
    }
    tokens
}

struct Parser<'a> {
    model: &'a mut Model,
    tokens: Vec<String>,
    at: usize,
    scopes: Vec<(String, Domain)>,
}

impl Parser<'_> {
    fn peek(&self) -> &str {
        self.tokens.get(self.at).map_or("", String::as_str)
    }
    fn next(&mut self) -> String {
        self.at += 1;
        self.tokens[self.at - 1].clone()
    }
    fn expect(&mut self, token: &str) {
        let found = self.next();
        assert_eq!(found, token, "in {:?}", self.tokens);
    }

    fn expression(&mut self, least: u8) -> Node {
        let mut left = match self.peek() {
            "-" => {
                self.next();
                let operand = self.expression(60);
                self.model.dag.neg(operand)
            }
            "!" => {
                self.next();
                let operand = self.expression(60);
                self.model.dag.not(operand)
            }
            _ => self.primary(),
        };
        loop {
            let (binding, right) = match self.peek() {
                "||" => (10, 11),
                "&&" => (20, 21),
                "<" | "<=" | ">" | ">=" | "==" | "!=" => (30, 31),
                "+" | "-" => (40, 41),
                "*" | "/" | "%" => (50, 51),
                "^" => (71, 60),
                _ => return left,
            };
            if binding < least {
                return left;
            }
            let op = self.next();
            let b = self.expression(right);
            let (a, dag) = (left, &mut self.model.dag);
            left = match op.as_str() {
                "||" => dag.or(a, b),
                "&&" => dag.and(a, b),
                "<" => dag.less(a, b),
                "<=" => dag.less_equal(a, b),
                ">" => dag.less(b, a),
                ">=" => dag.less_equal(b, a),
                "==" => dag.equal(a, b),
                "!=" => {
                    let equal = dag.equal(a, b);
                    dag.not(equal)
                }
                "+" => dag.add(&[a, b]),
                "-" => dag.sub(a, b),
                "*" => dag.mul(&[a, b]),
                "/" => dag.div(a, b),
                "%" => dag.call(Op::Modulo, &[a, b]),
                _ => dag.pow(a, b),
            };
        }
    }

    fn primary(&mut self) -> Node {
        let token = self.next();
        let first = token.chars().next().unwrap();
        if token == "(" {
            let inner = self.expression(0);
            self.expect(")");
            return inner;
        }
        if first.is_ascii_digit() {
            let value = Rational::decimal(&token).unwrap();
            return self.model.dag.constant(value);
        }
        match token.as_str() {
            "sum" => return self.sum(),
            "if" => {
                let condition = self.expression(0);
                let mut branches = Vec::new();
                for _ in 0..2 {
                    self.expect("{");
                    branches.push(self.expression(0));
                    self.expect("}");
                    if branches.len() == 1 {
                        self.expect("else");
                    }
                }
                return self.model.dag.select(condition, branches[0], branches[1]);
            }
            "pi" => return self.model.dag.pi(),
            _ => {}
        }
        if self.peek() == "(" {
            self.next();
            let mut arguments = vec![self.expression(0)];
            while self.peek() == "," {
                self.next();
                arguments.push(self.expression(0));
            }
            self.expect(")");
            if let Some(function) = self.model.externals.iter().position(|e| e.name == token) {
                return self.model.dag.external(
                    function as u16,
                    hamiltonian_symbolic::dag::Partial::Value,
                    &arguments,
                );
            }
            let op = Op::named(&token).unwrap_or_else(|| panic!("no function {token}"));
            return self.model.dag.call(op, &arguments);
        }
        let mut indices = Vec::new();
        while self.peek() == "[" {
            self.next();
            let affine = self.affine();
            let index = if self.peek() == "%" {
                self.next();
                let modulo = self.affine();
                Index::wrapped(affine, modulo)
            } else {
                Index::plain(affine)
            };
            indices.push(index);
            self.expect("]");
        }
        self.named(&token, indices)
    }

    fn named(&mut self, name: &str, mut indices: Vec<Index>) -> Node {
        if let Some((_, domain)) = self.scopes.iter().rev().find(|(n, _)| n == name) {
            return self.model.dag.variable(*domain);
        }
        for side in [Side::Q, Side::P] {
            let found = self.model.groups.iter().position(|g| {
                name == if side == Side::Q {
                    &g.coordinate
                } else {
                    &g.momentum
                }
            });
            if let Some(group) = found {
                let column = if indices.len() == 2 {
                    indices[1].affine.as_constant().unwrap() as u16
                } else {
                    0
                };
                let row = if indices.is_empty() {
                    Index::constant(0)
                } else {
                    indices.remove(0)
                };
                return self.model.dag.element(
                    Array::Phase(Column {
                        side,
                        group: group as u16,
                        column,
                    }),
                    row,
                    None,
                );
            }
        }
        if let Some(at) = self.model.parameters.iter().position(|p| p.name == name) {
            let parameter = Parameter(at as u16);
            let axes = self.model.parameters[at].shape.axes().iter();
            let mut axes = axes.skip(1).cloned();
            let mut indices = indices.into_iter();
            let Some(mut row) = indices.next() else {
                return self.model.dag.parameter(parameter);
            };
            let mut column = None;
            for index in indices {
                match axes.next() {
                    Some(extent) => row = row.row_of(extent, index),
                    None => column = Some(index),
                }
            }
            let array = Array::Parameter(parameter);
            return self.model.dag.element(array, row, column);
        }
        if let Some(at) = self.model.sizes.iter().position(|s| s == name) {
            return self.model.dag.extent(Size(at as u16));
        }
        if self.model.time.as_deref() == Some(name) {
            return self.model.dag.time();
        }
        panic!("no name {name}")
    }

    fn sum(&mut self) -> Node {
        let mut domains = Vec::new();
        self.expect("(");
        loop {
            let name = self.next();
            self.expect("in");
            let start = self.affine();
            self.expect("..");
            let end = self.affine();
            let domain = self
                .model
                .dag
                .domain(self.scopes.last().map(|s| s.1), start, end);
            self.scopes.push((name, domain));
            domains.push(domain);
            if self.next() == ")" {
                break;
            }
        }
        self.expect("{");
        let mut body = self.expression(0);
        self.expect("}");
        for domain in domains.into_iter().rev() {
            self.scopes.pop();
            body = self.model.dag.reduce(domain, body);
        }
        body
    }

    fn affine(&mut self) -> Affine {
        let mut sum = Affine::default();
        let mut sign = 1;
        loop {
            if self.peek() == "-" {
                self.next();
                sign = -sign;
            }
            let term = self.affine_factor();
            let term = if self.peek() == "*" {
                self.next();
                let other = self.affine_factor();
                match (term.as_constant(), other.as_constant()) {
                    (Some(k), _) => Affine::default().plus(k, &other),
                    (_, Some(k)) => Affine::default().plus(k, &term),
                    _ => panic!("not affine"),
                }
            } else {
                term
            };
            sum = sum.plus(sign, &term);
            match self.peek() {
                "+" => sign = 1,
                "-" => sign = -1,
                _ => return sum,
            }
            self.next();
        }
    }

    fn affine_factor(&mut self) -> Affine {
        let token = self.next();
        if token == "(" {
            let inner = self.affine();
            self.expect(")");
            return inner;
        }
        if let Ok(n) = token.parse() {
            return Affine::constant(n);
        }
        if let Some((_, domain)) = self.scopes.iter().rev().find(|(n, _)| *n == token) {
            return Affine::variable(*domain);
        }
        let size = self
            .model
            .sizes
            .iter()
            .position(|s| *s == token)
            .unwrap_or_else(|| panic!("no size {token}"));
        Affine::size(Size(size as u16))
    }
}

/// The value of each node where elements have the given values.
pub fn values(model: &Model, nodes: &[Node], given: &[(Node, f64)]) -> Vec<f64> {
    let given = given
        .iter()
        .map(|(node, value)| (*node, Ball::exact(*value)));
    let given: Vec<(Node, Ball)> = given.collect();
    let (values, _) = sample(model, nodes, &[], Sample::default(), &given).unwrap();
    values.iter().map(|v| v.value).collect()
}
