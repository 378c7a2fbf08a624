//! Formulas as text over named nodes: flows and charts stand in the source as they stand on paper.
//!
//! Input: statements `name = expression;` and the nodes of names. Output: the nodes of all names.
//! Invariant: the text is ours, never a user's; one that does not read gives `None`, and the tests
//! read every formula there is.

use crate::dag::{Dag, Map, Node};
use crate::op::Op;
use crate::rational::Rational;

/// Names with their nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names(Map<String, Node>);

impl Names {
    /// Names with their nodes.
    pub(crate) fn of(entries: &[(&str, Node)]) -> Names {
        let entries = entries
            .iter()
            .map(|(name, node)| ((*name).to_owned(), *node));
        Names(entries.collect())
    }
    /// Gives a name its node.
    pub(crate) fn set(&mut self, name: &str, node: Node) {
        self.0.insert(name.to_owned(), node);
    }
    /// A name's node.
    pub(crate) fn get(&self, name: &str) -> Option<Node> {
        self.0.get(name).copied()
    }
    /// Reads statements in turn; each may use the names before it.
    pub(crate) fn read(&mut self, dag: &mut Dag, text: &str) -> Option<()> {
        for statement in text.split(';').filter(|s| !s.trim().is_empty()) {
            let (name, expression) = statement.split_once('=')?;
            let node = self.one(dag, expression)?;
            self.set(name.trim(), node);
        }
        Some(())
    }
    /// Reads one expression.
    pub(crate) fn one(&self, dag: &mut Dag, text: &str) -> Option<Node> {
        let mut reader = Reader {
            dag,
            names: self,
            text: text.as_bytes(),
            at: 0,
        };
        let node = reader.relation()?;
        (reader.peek() == 0).then_some(node)
    }
}

struct Reader<'a> {
    dag: &'a mut Dag,
    names: &'a Names,
    text: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    /// The next character that is no space; 0 at the end.
    fn peek(&mut self) -> u8 {
        while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
        self.text.get(self.at).copied().unwrap_or(0)
    }
    fn takes(&mut self, c: u8) -> bool {
        let found = self.peek() == c;
        self.at += usize::from(found);
        found
    }
    fn relation(&mut self) -> Option<Node> {
        let first = self.sum()?;
        if self.takes(b'<') {
            let second = self.sum()?;
            return Some(self.dag.less(first, second));
        }
        Some(first)
    }
    fn sum(&mut self) -> Option<Node> {
        let mut terms = vec![(Rational::ONE, self.product()?)];
        loop {
            if self.takes(b'+') {
                terms.push((Rational::ONE, self.product()?));
            } else if self.takes(b'-') {
                terms.push((Rational::MINUS_ONE, self.product()?));
            } else if terms.len() == 1 {
                return Some(terms[0].1);
            } else {
                return Some(self.dag.linear(&Rational::ZERO, &terms));
            }
        }
    }
    fn product(&mut self) -> Option<Node> {
        let mut factors = vec![self.power(1)?];
        loop {
            if self.takes(b'*') {
                factors.push(self.power(1)?);
            } else if self.takes(b'/') {
                factors.push(self.power(-1)?);
            } else {
                return Some(self.dag.product(&Rational::ONE, &factors));
            }
        }
    }
    fn power(&mut self, sign: i32) -> Option<(Node, i32)> {
        if self.takes(b'-') {
            let (node, n) = self.power(1)?;
            let power = self.dag.powi(node, n);
            return Some((self.dag.neg(power), sign));
        }
        let base = self.atom()?;
        let exponent = if self.takes(b'^') { self.number()? } else { 1 };
        Some((base, sign.checked_mul(exponent)?))
    }
    fn number(&mut self) -> Option<i32> {
        self.peek();
        let start = self.at;
        while self.text.get(self.at).is_some_and(u8::is_ascii_digit) {
            self.at += 1;
        }
        std::str::from_utf8(&self.text[start..self.at])
            .ok()?
            .parse()
            .ok()
    }
    fn atom(&mut self) -> Option<Node> {
        if self.takes(b'(') {
            let inner = self.relation()?;
            return self.takes(b')').then_some(inner);
        }
        if self.peek().is_ascii_digit() {
            let value = self.number()?;
            return Some(self.dag.integer(i64::from(value)));
        }
        let start = self.at;
        let is_part = |c: &u8| c.is_ascii_alphanumeric() || *c == b'_';
        while self.text.get(self.at).is_some_and(is_part) {
            self.at += 1;
        }
        let name = std::str::from_utf8(&self.text[start..self.at]).ok()?;
        if !self.takes(b'(') {
            return match name {
                "pi" => Some(self.dag.pi()),
                _ => self.names.get(name),
            };
        }
        let mut arguments = vec![self.relation()?];
        while self.takes(b',') {
            arguments.push(self.relation()?);
        }
        if !self.takes(b')') {
            return None;
        }
        match (name, arguments.as_slice()) {
            ("pick", &[condition, yes, no]) => Some(self.dag.select(condition, yes, no)),
            _ => {
                let op = Op::named(name)?;
                (op.row().arguments.len() == arguments.len()).then(|| self.dag.call(op, &arguments))
            }
        }
    }
}
