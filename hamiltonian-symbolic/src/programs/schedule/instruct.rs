//! One node as instructions: sums and products in two-operand form, products fused into sums.
//!
//! Input: a node whose children are computed. Output: instructions appended to a block.
//! Invariant: the operands of a sum are added in their order, but that a product in front may
//! change places with the plain term after it (which rounds the same, fused).

use super::Placer;
use crate::dag::{Kind, Node};
use crate::list::IntoList;
use crate::program::{Instruction, Step, Value};
use crate::programs::factor::is_prepared;
use crate::rational::Rational;
use crate::sort::Arrange;

/// Powers up to this one are multiplied out.
const RUN: u32 = 3;

/// The term a sum starts with; `None` where it starts with its constant.
fn first_term(
    c: &Rational,
    terms: &[(Rational, Node)],
    can_fuse: &impl Fn(Node) -> bool,
) -> Option<usize> {
    let is_product = |(k, node): &(Rational, Node)| !k.is_unit() || can_fuse(*node);
    let plain = terms.get(1).filter(|next| !is_product(next));
    if is_product(&terms[0]) {
        if !c.is_zero() {
            return None;
        }
        return Some(usize::from(plain.is_some()));
    }
    // A negative plain term in front is subtracted from the positive one after it.
    let is_negative = terms[0].0 == Rational::MINUS_ONE;
    Some(usize::from(
        is_negative && plain.is_some_and(|(k, _)| k.is_one()),
    ))
}

/// The terms of a sum that are added by a fused instruction: their products are not needed by
/// themselves.
pub(crate) fn fused_terms(
    c: &Rational,
    terms: &[(Rational, Node)],
    can_fuse: &impl Fn(Node) -> bool,
) -> impl Iterator<Item = Node> {
    let first = first_term(c, terms, can_fuse);
    let rest = terms.iter().enumerate();
    rest.filter(move |(at, (k, node))| Some(*at) != first && k.is_unit() && can_fuse(*node))
        .map(|(_, (_, node))| *node)
}

/// sum ± a
fn added(is_negative: bool, a: Value, sum: Value) -> Instruction {
    match is_negative {
        true => Instruction::Sub(sum, a),
        false => Instruction::Add(sum, a),
    }
}

/// sum ± a·b
fn product_added(is_negative: bool, (a, b): (Value, Value), sum: Value) -> Instruction {
    match is_negative {
        true => Instruction::NegMulAdd(a, b, sum),
        false => Instruction::MulAdd(a, b, sum),
    }
}

impl Placer<'_> {
    /// The instructions of a node.
    pub(crate) fn instruct(&mut self, steps: &mut Vec<Step>, node: Node, kind: &Kind) -> Value {
        let instruction = match kind {
            Kind::Constant(value) => Instruction::Constant(value.clone()),
            Kind::Pi => Instruction::Pi,
            Kind::Scalar(parameter) => Instruction::Scalar(*parameter),
            Kind::Time => Instruction::Time,
            Kind::Coefficient => Instruction::Coefficient,
            Kind::StandIn(what) => Instruction::StandIn(*what),
            Kind::Variable(domain) => Instruction::Variable(*domain),
            Kind::Extent(size) => Instruction::Extent(*size),
            Kind::Count(domain) => {
                let range = self.dag.range(*domain);
                Instruction::Count(range.start.clone(), range.end.clone())
            }
            Kind::Element(array, row, column) => {
                Instruction::Load(*array, row.clone(), column.as_deref().cloned())
            }
            Kind::Sum(c, terms) => return self.sum(steps, c, terms),
            Kind::Product(k, factors) => return self.product(steps, k, factors),
            Kind::Call(op, x) => {
                Instruction::Call(*op, x.iter().map(|n| self.value(*n)).into_list())
            }
            Kind::External(function, part, x) => Instruction::External(
                *function,
                *part,
                x.iter().map(|n| self.value(*n)).into_list(),
            ),
            // The accumulator was defined when its loop was placed.
            Kind::Reduce(..) => return self.value(node),
            Kind::Compare(relation, a, b) => {
                Instruction::Compare(*relation, self.value(*a), self.value(*b))
            }
            Kind::Not(a) => Instruction::Not(self.value(*a)),
            Kind::And(a, b) => Instruction::And(self.value(*a), self.value(*b)),
            Kind::Or(a, b) => Instruction::Or(self.value(*a), self.value(*b)),
            Kind::Select(c, a, b) => {
                Instruction::Select(self.value(*c), self.value(*a), self.value(*b))
            }
        };
        self.push(steps, instruction)
    }

    fn constant(&mut self, steps: &mut Vec<Step>, value: Rational) -> Value {
        self.push(steps, Instruction::Constant(value))
    }

    fn sum(&mut self, steps: &mut Vec<Step>, c: &Rational, terms: &[(Rational, Node)]) -> Value {
        let first = first_term(c, terms, &|node| !self.is_computed(node));
        let mut rest: Vec<&(Rational, Node)> = terms.iter().into_list();
        let mut sum = match first.map(|at| rest.remove(at)) {
            None => self.constant(steps, c.clone()),
            Some((k, node)) => {
                let value = self.value(*node);
                let is_negative = *k == Rational::MINUS_ONE;
                match rest.first() {
                    // −a + b·c is one instruction.
                    Some(&&(ref next, product))
                        if first == Some(0)
                            && is_negative
                            && next.is_one()
                            && !self.is_computed(product) =>
                    {
                        rest.remove(0);
                        let (_, (x, y)) = self.split_product(steps, product);
                        self.push(steps, Instruction::MulSub(x, y, value))
                    }
                    _ if k.is_one() => value,
                    _ if is_negative => self.push(steps, Instruction::Neg(value)),
                    _ => {
                        let factor = self.constant(steps, k.clone());
                        self.push(steps, Instruction::Mul(factor, value))
                    }
                }
            }
        };
        for (k, node) in rest {
            let is_negative = k.is_negative();
            let instruction = if !k.is_unit() {
                let value = self.value(*node);
                let factor = self.constant(steps, k.abs());
                product_added(is_negative, (factor, value), sum)
            } else if self.is_computed(*node) {
                added(is_negative, self.value(*node), sum)
            } else {
                let (is_flipped, operands) = self.split_product(steps, *node);
                product_added(is_negative != is_flipped, operands, sum)
            };
            sum = self.push(steps, instruction);
        }
        if first.is_some() && !c.is_zero() {
            let constant = self.constant(steps, c.abs());
            sum = self.push(steps, added(c.is_negative(), constant, sum));
        }
        sum
    }

    /// The sign of a product (true if it is negative), and the two operands of its last multiplication.
    pub(crate) fn split_product(
        &mut self,
        steps: &mut Vec<Step>,
        node: Node,
    ) -> (bool, (Value, Value)) {
        let Kind::Product(k, factors) = self.dag.kind(node).clone() else {
            let one = self.constant(steps, Rational::ONE);
            return (false, (self.value(node), one));
        };
        let mut list = self.factors(steps, &k, &factors);
        let operands = match list.pop() {
            Some((last, n)) if n > RUN && !list.is_empty() => {
                let last = self.powers(steps, &[(last, n)]);
                (self.powers(steps, &list), last)
            }
            Some((base, n)) if n > RUN && n % 2 == 0 => {
                let half = self.powers(steps, &[(base, n / 2)]);
                (half, half)
            }
            Some((last, n)) => {
                list.push((last, n - 1));
                (self.powers(steps, &list), last)
            }
            None => {
                let one = self.constant(steps, Rational::ONE);
                (one, one)
            }
        };
        (k.is_negative(), operands)
    }

    /// |k| and the factors as powers of values, in the order of multiplication.
    fn factors(
        &mut self,
        steps: &mut Vec<Step>,
        k: &Rational,
        factors: &[(Node, i32)],
    ) -> Vec<(Value, u32)> {
        let mut list = Vec::with_capacity(factors.len() + 1);
        if !k.is_unit() {
            list.push((self.constant(steps, k.abs()), 1));
        }
        for (node, n) in self.early_first(factors) {
            list.push((self.value(node), n.unsigned_abs()));
        }
        list
    }

    /// The factors of a product in the order of multiplication: a value that an outer block or
    /// few operations make known comes first, so that the product waits for its last factor only.
    fn early_first(&self, factors: &[(Node, i32)]) -> Vec<(Node, i32)> {
        let mut ordered = factors.to_vec();
        ordered.arrange_by_key(|(node, _)| {
            let depth = self.dag.depth(self.dag.home(*node));
            let height = self.dag.height(*node);
            (
                depth,
                if is_prepared(self.dag, *node) {
                    0
                } else {
                    1 + height
                },
            )
        });
        ordered
    }

    pub(crate) fn product(
        &mut self,
        steps: &mut Vec<Step>,
        k: &Rational,
        factors: &[(Node, i32)],
    ) -> Value {
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, n)| *n > 0);
        let above = self.factors(steps, k, &above);
        let below = self.factors(steps, &Rational::ONE, &below);
        let value = if below.is_empty() {
            self.powers(steps, &above)
        } else {
            let below = self.powers(steps, &below);
            if above.is_empty() {
                self.push(steps, Instruction::Recip(below))
            } else {
                let above = self.powers(steps, &above);
                self.push(steps, Instruction::Div(above, below))
            }
        };
        if k.is_negative() {
            self.push(steps, Instruction::Neg(value))
        } else {
            value
        }
    }

    /// The product of powers; those above [`RUN`] by squaring.
    fn powers(&mut self, steps: &mut Vec<Step>, list: &[(Value, u32)]) -> Value {
        let mut product: Option<Value> = None;
        for &(base, n) in list {
            if n <= RUN {
                for _ in 0..n {
                    product = Some(self.times(steps, product, base));
                }
                continue;
            }
            let (mut square, mut left) = (base, n);
            loop {
                if left % 2 == 1 {
                    product = Some(self.times(steps, product, square));
                }
                left /= 2;
                if left == 0 {
                    break;
                }
                square = self.push(steps, Instruction::Mul(square, square));
            }
        }
        match product {
            Some(product) => product,
            None => self.constant(steps, Rational::ONE),
        }
    }

    fn times(&mut self, steps: &mut Vec<Step>, product: Option<Value>, value: Value) -> Value {
        match product {
            Some(product) => self.push(steps, Instruction::Mul(product, value)),
            None => value,
        }
    }
}
