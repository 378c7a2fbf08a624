//! Reading expressions, precedence climbing over words and signs.

use super::Expression;
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::rational::Rational;

/// The expression a text stands for.
pub fn read(text: &str) -> Expression {
    let mut reader = Reader {
        words: words(text),
        at: 0,
    };
    let e = reader.expression(0);
    assert_eq!(reader.at, reader.words.len(), "{text}");
    e
}

fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut last = ' ';
    for c in text.chars() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let joins = (word(c) && word(last))
            || matches!(
                (last, c),
                ('.', '.') | ('<' | '>' | '=', '=') | ('&', '&') | ('|', '|')
            )
            // A decimal point between digits.
            || (c == '.' && last.is_ascii_digit())
            || (c.is_ascii_digit()
                && last == '.'
                && words.last().is_some_and(|w| w.starts_with(|d: char| d.is_ascii_digit())));
        match words.last_mut() {
            Some(open) if joins && !open.is_empty() => open.push(c),
            _ if c.is_whitespace() => {}
            _ => words.push(c.into()),
        }
        last = c;
    }
    // `0..n` was read as a number with two points.
    words
        .into_iter()
        .flat_map(|w| match w.split_once("..") {
            Some((start, end)) => [start, "..", end].map(str::to_owned).to_vec(),
            None => vec![w],
        })
        .filter(|w| !w.is_empty())
        .collect()
}

struct Reader {
    words: Vec<String>,
    at: usize,
}

impl Reader {
    fn peek(&self) -> &str {
        self.words.get(self.at).map_or("", String::as_str)
    }
    fn next(&mut self) -> String {
        self.at += 1;
        self.words[self.at - 1].clone()
    }
    fn expect(&mut self, word: &str) {
        let found = self.next();
        assert_eq!(found, word, "{:?}", self.words);
    }

    fn expression(&mut self, least: u8) -> Expression {
        let mut left = match self.peek() {
            "-" => {
                self.next();
                Expression::Negative(Box::new(self.expression(60)))
            }
            "!" => {
                self.next();
                Expression::Not(Box::new(self.expression(60)))
            }
            _ => self.primary(),
        };
        loop {
            let (binding, right) = match self.peek() {
                "||" => (10, 11),
                "&&" => (20, 21),
                "<" | "<=" | ">" | ">=" | "==" => (30, 31),
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
            left = Expression::Binary(op, Box::new(left), Box::new(b));
        }
    }

    fn primary(&mut self) -> Expression {
        let word = self.next();
        if word == "(" {
            let inner = self.expression(0);
            self.expect(")");
            return inner;
        }
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            return Expression::Number(Rational::decimal(&word).unwrap());
        }
        if word == "sum" {
            return self.sum();
        }
        if word == "if" {
            let condition = self.expression(0);
            let yes = self.block();
            self.expect("else");
            let no = self.block();
            return Expression::If(Box::new(condition), Box::new(yes), Box::new(no));
        }
        if self.peek() == "(" {
            let mut arguments = Vec::new();
            while self.next() != ")" {
                arguments.push(self.expression(0));
                if self.peek() == ")" {
                    self.next();
                    break;
                }
            }
            return Expression::Call(Op::named(&word).unwrap(), arguments);
        }
        let mut indices = Vec::new();
        while self.peek() == "[" {
            self.next();
            indices.push(self.expression(0));
            self.expect("]");
        }
        Expression::Name(word, indices)
    }

    fn block(&mut self) -> Expression {
        self.expect("{");
        let inner = self.expression(0);
        self.expect("}");
        inner
    }

    fn sum(&mut self) -> Expression {
        let mut ranges = Vec::new();
        self.expect("(");
        loop {
            let name = self.next();
            self.expect("in");
            let start = self.expression(0);
            self.expect("..");
            let end = self.expression(0);
            ranges.push((name, start, end));
            if self.next() == ")" {
                break;
            }
        }
        Expression::Sum(ranges, Box::new(self.block()))
    }
}
