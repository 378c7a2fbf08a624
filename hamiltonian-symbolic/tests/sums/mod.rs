//! Systems with sums, read from text and evaluated term by term, apart from the engine.
//!
//! Input: an H in the language's notation, values of sizes and arrays. Output: its value over any
//! scalar, or the same H with every sum written out over scalar coordinates. Invariant: sums are
//! added up one term after the other; nothing is simplified.

mod read;

pub use read::read;

use hamiltonian_lanes::Real;
use hamiltonian_symbolic::dag::{Dag, Node};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::rational::Rational;
use std::collections::HashMap;

/// An expression as read.
#[derive(Clone, Debug)]
pub enum Expression {
    Number(Rational),
    /// A name with indices.
    Name(String, Vec<Expression>),
    Negative(Box<Expression>),
    /// `+ - * / ^ %`, comparisons, `&& ||`
    Binary(String, Box<Expression>, Box<Expression>),
    Not(Box<Expression>),
    Call(Op, Vec<Expression>),
    Sum(Vec<(String, Expression, Expression)>, Box<Expression>),
    If(Box<Expression>, Box<Expression>, Box<Expression>),
}

/// The context that expressions are evaluated in.
pub trait Arithmetic {
    type Number: Copy;
    type Condition: Copy;
    fn constant(&mut self, value: &Rational) -> Self::Number;
    fn sum(&mut self, terms: &[Self::Number]) -> Self::Number;
    fn negative(&mut self, a: Self::Number) -> Self::Number;
    fn binary(&mut self, op: &str, a: Self::Number, b: Self::Number) -> Self::Number;
    fn power(&mut self, a: Self::Number, exponent: &Rational) -> Self::Number;
    fn call(&mut self, op: Op, a: &[Self::Number]) -> Self::Number;
    fn compare(&mut self, op: &str, a: Self::Number, b: Self::Number) -> Self::Condition;
    fn logic(&mut self, op: &str, a: Self::Condition, b: Self::Condition) -> Self::Condition;
    fn not(&mut self, a: Self::Condition) -> Self::Condition;
    fn select(&mut self, c: Self::Condition, a: Self::Number, b: Self::Number) -> Self::Number;
}

/// The values of names: arrays by column and row, sizes, and loop variables.
#[derive(Clone, Debug, Default)]
pub struct World<V> {
    pub values: HashMap<String, Vec<Vec<V>>>,
    pub sizes: HashMap<String, i64>,
    /// Of arrays whose one column has the elements row after row, their extents.
    pub axes: HashMap<String, Vec<usize>>,
    pub loops: Vec<(String, i64)>,
}

/// The number, if it is whole.
fn whole(number: &Rational) -> Option<i64> {
    number.to_small().filter(|(_, n)| *n == 1).map(|(n, _)| n)
}

impl<V: Copy> World<V> {
    fn whole(&self, name: &str) -> Option<i64> {
        let bound = self.loops.iter().rev().find(|(n, _)| n == name);
        bound
            .map(|(_, value)| *value)
            .or(self.sizes.get(name).copied())
    }

    /// The value of an index or a bound.
    pub fn integer(&self, e: &Expression) -> i64 {
        match e {
            Expression::Number(value) => whole(value).unwrap(),
            Expression::Name(name, _) => self.whole(name).unwrap(),
            Expression::Negative(a) => -self.integer(a),
            Expression::Binary(op, a, b) => {
                let (a, b) = (self.integer(a), self.integer(b));
                match op.as_str() {
                    "+" => a + b,
                    "-" => a - b,
                    "*" => a * b,
                    "%" => a.rem_euclid(b),
                    _ => panic!("{op} in an index"),
                }
            }
            _ => panic!("no index: {e:?}"),
        }
    }

    /// The value of an expression.
    pub fn evaluate<A: Arithmetic<Number = V>>(&mut self, a: &mut A, e: &Expression) -> V {
        match e {
            Expression::Number(value) => a.constant(value),
            Expression::Name(name, indices) => {
                if let Some(whole) = self.whole(name) {
                    return a.constant(&Rational::integer(whole));
                }
                let number = |index| usize::try_from(self.integer(index)).unwrap();
                let at: Vec<usize> = indices.iter().map(number).collect();
                let [row, column] = match (self.axes.get(name), at.as_slice()) {
                    (_, []) => [0, 0],
                    (_, [row]) => [*row, 0],
                    (_, [row, column]) => [*row, *column],
                    (Some(axes), at) => [axes.iter().zip(at).fold(0, |n, (m, at)| n * m + at), 0],
                    (None, _) => panic!("no extents of {name}"),
                };
                self.values[name][column][row]
            }
            Expression::Negative(x) => {
                let x = self.evaluate(a, x);
                a.negative(x)
            }
            Expression::Binary(op, x, y) => {
                if let ("^", Expression::Number(exponent)) = (op.as_str(), &**y) {
                    let x = self.evaluate(a, x);
                    return a.power(x, exponent);
                }
                let (x, y) = (self.evaluate(a, x), self.evaluate(a, y));
                a.binary(op, x, y)
            }
            Expression::Call(op, arguments) => {
                let arguments: Vec<_> = arguments.iter().map(|x| self.evaluate(a, x)).collect();
                a.call(*op, &arguments)
            }
            Expression::Sum(ranges, body) => {
                let mut terms = Vec::new();
                self.terms(a, ranges, body, &mut terms);
                a.sum(&terms)
            }
            Expression::If(condition, yes, no) => {
                let condition = self.condition(a, condition);
                let (yes, no) = (self.evaluate(a, yes), self.evaluate(a, no));
                a.select(condition, yes, no)
            }
            Expression::Not(_) => panic!("a condition for a number"),
        }
    }

    fn terms<A: Arithmetic<Number = V>>(
        &mut self,
        a: &mut A,
        ranges: &[(String, Expression, Expression)],
        body: &Expression,
        terms: &mut Vec<V>,
    ) {
        let Some(((name, start, end), inner)) = ranges.split_first() else {
            terms.push(self.evaluate(a, body));
            return;
        };
        for value in self.integer(start)..self.integer(end) {
            self.loops.push((name.clone(), value));
            self.terms(a, inner, body, terms);
            self.loops.pop();
        }
    }

    fn condition<A: Arithmetic<Number = V>>(&mut self, a: &mut A, e: &Expression) -> A::Condition {
        match e {
            Expression::Not(x) => {
                let x = self.condition(a, x);
                a.not(x)
            }
            Expression::Binary(op, x, y) if op == "&&" || op == "||" => {
                let (x, y) = (self.condition(a, x), self.condition(a, y));
                a.logic(op, x, y)
            }
            Expression::Binary(op, x, y) => {
                let (x, y) = (self.evaluate(a, x), self.evaluate(a, y));
                a.compare(op, x, y)
            }
            _ => panic!("no condition: {e:?}"),
        }
    }
}

/// Numbers of a scalar type.
pub struct Numbers<T>(pub std::marker::PhantomData<T>);

impl<T: Real> Arithmetic for Numbers<T> {
    type Number = T;
    type Condition = T::Mask;
    fn constant(&mut self, value: &Rational) -> T {
        let (hi, lo) = value.to_words();
        T::constant(hi, lo)
    }
    fn sum(&mut self, terms: &[T]) -> T {
        terms.iter().fold(T::zero(), |sum, x| sum + *x)
    }
    fn negative(&mut self, a: T) -> T {
        -a
    }
    fn binary(&mut self, op: &str, a: T, b: T) -> T {
        match op {
            "+" => a + b,
            "-" => a - b,
            "*" => a * b,
            "/" => a / b,
            "^" => a.pow(b),
            _ => panic!("{op} of numbers"),
        }
    }
    fn power(&mut self, a: T, exponent: &Rational) -> T {
        match whole(exponent) {
            Some(n) => {
                let product = (0..n.abs()).fold(T::one(), |product, _| product * a);
                if n < 0 { T::one() / product } else { product }
            }
            None => {
                let exponent = self.constant(exponent);
                a.pow(exponent)
            }
        }
    }
    fn call(&mut self, op: Op, a: &[T]) -> T {
        op.eval(a)
    }
    fn compare(&mut self, op: &str, a: T, b: T) -> T::Mask {
        match op {
            "<" => a.lt(b),
            "<=" => a.le(b),
            ">" => b.lt(a),
            ">=" => b.le(a),
            _ => a.equals(b),
        }
    }
    fn logic(&mut self, op: &str, a: T::Mask, b: T::Mask) -> T::Mask {
        if op == "&&" { a & b } else { a | b }
    }
    fn not(&mut self, a: T::Mask) -> T::Mask {
        !a
    }
    fn select(&mut self, c: T::Mask, a: T, b: T) -> T {
        T::select(c, a, b)
    }
}

/// Expressions of an arena.
impl Arithmetic for Dag {
    type Number = Node;
    type Condition = Node;
    fn constant(&mut self, value: &Rational) -> Node {
        Dag::constant(self, value.clone())
    }
    fn sum(&mut self, terms: &[Node]) -> Node {
        self.add(terms)
    }
    fn negative(&mut self, a: Node) -> Node {
        self.neg(a)
    }
    fn binary(&mut self, op: &str, a: Node, b: Node) -> Node {
        match op {
            "+" => self.add(&[a, b]),
            "-" => self.sub(a, b),
            "*" => self.mul(&[a, b]),
            "/" => self.div(a, b),
            _ => self.pow(a, b),
        }
    }
    fn power(&mut self, a: Node, exponent: &Rational) -> Node {
        let exponent = Dag::constant(self, exponent.clone());
        self.pow(a, exponent)
    }
    fn call(&mut self, op: Op, a: &[Node]) -> Node {
        Dag::call(self, op, a)
    }
    fn compare(&mut self, op: &str, a: Node, b: Node) -> Node {
        match op {
            "<" => self.less(a, b),
            "<=" => self.less_equal(a, b),
            ">" => self.less(b, a),
            ">=" => self.less_equal(b, a),
            _ => self.equal(a, b),
        }
    }
    fn logic(&mut self, op: &str, a: Node, b: Node) -> Node {
        if op == "&&" {
            self.and(a, b)
        } else {
            self.or(a, b)
        }
    }
    fn not(&mut self, a: Node) -> Node {
        Dag::not(self, a)
    }
    fn select(&mut self, c: Node, a: Node, b: Node) -> Node {
        Dag::select(self, c, a, b)
    }
}
