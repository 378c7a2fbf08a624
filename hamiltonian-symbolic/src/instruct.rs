//! One node as instructions: sums and products in two-operand form, products fused into sums.
//!
//! Input: a node whose children are computed. Output: instructions appended to a block.
//! Invariant: the operands of a sum are added in their order, but that a product in front may
//! change places with the plain term after it (which rounds the same, fused).

use crate::dag::{Kind, Node};
use crate::factor::is_prepared;
use crate::program::{Instruction, Step, Value};
use crate::rational::Rational;
use crate::schedule::Placer;

/// Powers up to this one are multiplied out.
const RUN: u32 = 3;

/// Where a sum starts: at its constant, or at a term.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Start {
    Constant,
    Term(usize),
}

/// A term that can be added by a fused instruction.
fn is_product(terms: &[(Rational, Node)], at: usize, can_fuse: &impl Fn(Node) -> bool) -> bool {
    !terms[at].0.is_unit() || can_fuse(terms[at].1)
}

fn start_of(c: &Rational, terms: &[(Rational, Node)], can_fuse: &impl Fn(Node) -> bool) -> Start {
    if is_product(terms, 0, can_fuse) {
        if !c.is_zero() {
            return Start::Constant;
        }
        if terms.len() > 1 && !is_product(terms, 1, can_fuse) {
            return Start::Term(1);
        }
    }
    // A negative plain term in front is subtracted from the positive one after it.
    if terms[0].0 == Rational::MINUS_ONE
        && terms.len() > 1
        && terms[1].0.is_one()
        && !is_product(terms, 1, can_fuse)
    {
        return Start::Term(1);
    }
    Start::Term(0)
}

/// Whether term `at` of a sum is added by a fused instruction, so that its product is not needed
/// by itself.
pub(crate) fn fuses(
    c: &Rational,
    terms: &[(Rational, Node)],
    at: usize,
    can_fuse: &impl Fn(Node) -> bool,
) -> bool {
    terms[at].0.is_unit()
        && start_of(c, terms, can_fuse) != Start::Term(at)
        && can_fuse(terms[at].1)
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
            Kind::Variable(domain) => Instruction::Variable(*domain),
            Kind::Extent(size) => Instruction::Extent(*size),
            Kind::Count(domain) => {
                let range = self.dag.range(*domain);
                Instruction::Count(range.start.clone(), range.end.clone())
            }
            Kind::Element(array, row, column) => {
                Instruction::Load(*array, row.clone(), column.clone())
            }
            Kind::Sum(c, terms) => return self.sum(steps, c, terms),
            Kind::Product(k, factors) => return self.product(steps, k, factors),
            Kind::Call(op, x) => Instruction::Call(*op, x.iter().map(|n| self.value(*n)).collect()),
            Kind::External(function, part, x) => {
                Instruction::External(*function, *part, x.iter().map(|n| self.value(*n)).collect())
            }
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
        let fusable: Vec<bool> = (0..terms.len())
            .map(|at| !self.is_computed(terms[at].1))
            .collect();
        let can_fuse = |node: Node| {
            terms
                .iter()
                .position(|(_, n)| *n == node)
                .is_some_and(|at| fusable[at])
        };
        let start = start_of(c, terms, &can_fuse);
        let mut constant_left = !c.is_zero();
        let mut sum = match start {
            Start::Constant => {
                constant_left = false;
                self.constant(steps, c.clone())
            }
            Start::Term(at) => {
                let (k, node) = &terms[at];
                match terms.get(1) {
                    // −a + b·c is one instruction.
                    Some((next, product))
                        if at == 0 && *k == Rational::MINUS_ONE && next.is_one() && fusable[1] =>
                    {
                        let a = self.value(*node);
                        let (x, y) = self.split_product(steps, *product);
                        let sum = self.push(steps, Instruction::MulSub(x, y, a));
                        return self.rest_of_sum(
                            steps,
                            sum,
                            c,
                            constant_left,
                            terms,
                            &fusable,
                            &[0, 1],
                        );
                    }
                    _ => {}
                }
                let value = if fusable[at] {
                    self.computed_product(steps, *node)
                } else {
                    self.value(*node)
                };
                if k.is_one() {
                    value
                } else if *k == Rational::MINUS_ONE {
                    self.push(steps, Instruction::Neg(value))
                } else {
                    let factor = self.constant(steps, k.clone());
                    self.push(steps, Instruction::Mul(factor, value))
                }
            }
        };
        let done: &[usize] = match start {
            Start::Constant => &[],
            Start::Term(0) => &[0],
            Start::Term(_) => &[1],
        };
        sum = self.rest_of_sum(steps, sum, c, constant_left, terms, &fusable, done);
        sum
    }

    #[allow(clippy::too_many_arguments)]
    fn rest_of_sum(
        &mut self,
        steps: &mut Vec<Step>,
        start: Value,
        c: &Rational,
        constant_left: bool,
        terms: &[(Rational, Node)],
        fusable: &[bool],
        done: &[usize],
    ) -> Value {
        let mut sum = start;
        for (at, (k, node)) in terms.iter().enumerate() {
            if done.contains(&at) {
                continue;
            }
            let negative = k.is_negative();
            if !k.is_unit() {
                let value = self.value(*node);
                let factor = self.constant(steps, k.abs());
                sum = self.push(
                    steps,
                    if negative {
                        Instruction::NegMulAdd(factor, value, sum)
                    } else {
                        Instruction::MulAdd(factor, value, sum)
                    },
                );
            } else if fusable[at] {
                let flipped = self.is_negated_product(*node);
                let (a, b) = self.split_product(steps, *node);
                sum = self.push(
                    steps,
                    if negative != flipped {
                        Instruction::NegMulAdd(a, b, sum)
                    } else {
                        Instruction::MulAdd(a, b, sum)
                    },
                );
            } else {
                let value = self.value(*node);
                sum = self.push(
                    steps,
                    if negative {
                        Instruction::Sub(sum, value)
                    } else {
                        Instruction::Add(sum, value)
                    },
                );
            }
        }
        if constant_left {
            let constant = self.constant(steps, c.abs());
            sum = self.push(
                steps,
                if c.is_negative() {
                    Instruction::Sub(sum, constant)
                } else {
                    Instruction::Add(sum, constant)
                },
            );
        }
        sum
    }

    fn is_negated_product(&self, node: Node) -> bool {
        matches!(self.dag.kind(node), Kind::Product(k, _) if k.is_negative())
    }

    fn computed_product(&mut self, steps: &mut Vec<Step>, node: Node) -> Value {
        match self.dag.kind(node).clone() {
            Kind::Product(k, factors) => self.product(steps, &k, &factors),
            _ => self.value(node),
        }
    }

    /// The two operands of a product's last multiplication (the sign is the caller's).
    pub(crate) fn split_product(&mut self, steps: &mut Vec<Step>, node: Node) -> (Value, Value) {
        let Kind::Product(k, factors) = self.dag.kind(node).clone() else {
            let value = self.value(node);
            let one = self.constant(steps, Rational::ONE);
            return (value, one);
        };
        let mut list: Vec<(Value, u32)> = Vec::new();
        if !k.is_unit() {
            list.push((self.constant(steps, k.abs()), 1));
        }
        for (node, n) in self.early_first(&factors) {
            list.push((self.value(node), n.unsigned_abs()));
        }
        match list.pop() {
            Some((last, n @ 1..=RUN)) => {
                list.push((last, n - 1));
                (self.powers(steps, &list), last)
            }
            Some((last, n)) if !list.is_empty() => {
                let last = self.powers(steps, &[(last, n)]);
                (self.powers(steps, &list), last)
            }
            Some((base, n)) if n % 2 == 0 => {
                let half = self.powers(steps, &[(base, n / 2)]);
                (half, half)
            }
            Some((base, n)) => (self.powers(steps, &[(base, n - 1)]), base),
            None => {
                let one = self.constant(steps, Rational::ONE);
                (one, one)
            }
        }
    }

    /// The factors of a product in the order of multiplication: what an outer block or few
    /// operations make known comes first, so that the product waits for its last factor only.
    fn early_first(&self, factors: &[(Node, i32)]) -> Vec<(Node, i32)> {
        let mut ordered = factors.to_vec();
        ordered.sort_by_key(|(node, _)| {
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
        let (mut above, mut below) = (Vec::new(), Vec::new());
        if !k.is_unit() {
            above.push((self.constant(steps, k.abs()), 1));
        }
        for (node, n) in self.early_first(factors) {
            let side = if n > 0 { &mut above } else { &mut below };
            side.push((self.value(node), n.unsigned_abs()));
        }
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
