//! Models from text, for tests: scalar coordinates, parameters by name.

use hamiltonian_symbolic::dag::{Node, Parameter, Side};
use hamiltonian_symbolic::model::{Group, Model, ParameterDeclaration, Shape};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::rational::Rational;

/// A model with scalar coordinates `q`, momenta `p`, all other names parameters (`t` is time).
pub fn model(q: &[&str], p: &[&str], text: &str) -> Model {
    let mut model = Model {
        name: "Test".into(),
        ..Model::default()
    };
    for (q, p) in q.iter().zip(p) {
        model.groups.push(Group::scalar(*q, *p));
    }
    let h = parse(&mut model, text);
    model.hamiltonian = Some(h);
    model
}

/// An expression over a model; unknown names become parameters.
pub fn parse(model: &mut Model, text: &str) -> Node {
    let mut parser = Parser {
        model,
        text: text.as_bytes(),
        at: 0,
    };
    let node = parser.expression(0);
    parser.skip();
    assert_eq!(parser.at, text.len(), "unparsed: {}", &text[parser.at..]);
    node
}

struct Parser<'a> {
    model: &'a mut Model,
    text: &'a [u8],
    at: usize,
}

impl Parser<'_> {
    fn skip(&mut self) {
        while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }
    fn peek(&mut self) -> u8 {
        self.skip();
        self.text.get(self.at).copied().unwrap_or(0)
    }
    fn eat(&mut self, c: u8) {
        assert_eq!(self.peek(), c, "at {}", self.at);
        self.at += 1;
    }
    fn expression(&mut self, power: u8) -> Node {
        let mut left = match self.peek() {
            b'-' => {
                self.at += 1;
                let x = self.expression(5);
                self.model.dag.neg(x)
            }
            b'(' => {
                self.at += 1;
                let x = self.expression(0);
                self.eat(b')');
                x
            }
            c if c.is_ascii_digit() => self.number(),
            _ => self.name(),
        };
        loop {
            let (op, binding) = match self.peek() {
                c @ (b'+' | b'-') => (c, 1),
                b'*' if self.text.get(self.at + 1) == Some(&b'*') => (b'^', 7),
                c @ (b'*' | b'/') => (c, 3),
                b'^' => (b'^', 7),
                _ => return left,
            };
            if binding < power {
                return left;
            }
            self.at += if self.text[self.at] == b'*' && op == b'^' {
                2
            } else {
                1
            };
            let right = self.expression(if op == b'^' { 6 } else { binding + 1 });
            let dag = &mut self.model.dag;
            left = match op {
                b'+' => dag.add(&[left, right]),
                b'-' => dag.sub(left, right),
                b'*' => dag.mul(&[left, right]),
                b'/' => dag.div(left, right),
                _ => dag.pow(left, right),
            };
        }
    }
    fn number(&mut self) -> Node {
        let start = self.at;
        while self
            .text
            .get(self.at)
            .is_some_and(|c| c.is_ascii_digit() || *c == b'.')
        {
            self.at += 1;
        }
        let text = std::str::from_utf8(&self.text[start..self.at]).unwrap();
        let value = Rational::decimal(text).unwrap();
        self.model.dag.constant(value)
    }
    fn name(&mut self) -> Node {
        let start = self.at;
        while self
            .text
            .get(self.at)
            .is_some_and(|c| c.is_ascii_alphanumeric() || *c == b'_')
        {
            self.at += 1;
        }
        let name = std::str::from_utf8(&self.text[start..self.at])
            .unwrap()
            .to_string();
        assert!(!name.is_empty(), "at {start}");
        if self.peek() == b'(' {
            let op = Op::named(&name).unwrap_or_else(|| panic!("no function {name}"));
            let mut arguments = Vec::new();
            loop {
                self.at += 1;
                arguments.push(self.expression(0));
                if self.peek() != b',' {
                    break;
                }
            }
            self.eat(b')');
            return self.model.dag.call(op, &arguments);
        }
        if name == "pi" {
            return self.model.dag.pi();
        }
        if name == "t" {
            self.model.time = Some("t".into());
            return self.model.dag.time();
        }
        for at in 0..self.model.groups.len() {
            if self.model.groups[at].coordinate == name {
                return self.model.scalar(Side::Q, at);
            }
            if self.model.groups[at].momentum == name {
                return self.model.scalar(Side::P, at);
            }
        }
        let parameters = &mut self.model.parameters;
        let known = parameters.iter().position(|known| known.name == name);
        let at = known.unwrap_or(parameters.len());
        if known.is_none() {
            let shape = Shape::Scalar;
            parameters.push(ParameterDeclaration { name, shape });
        }
        self.model.dag.parameter(Parameter(at as u16))
    }
}
