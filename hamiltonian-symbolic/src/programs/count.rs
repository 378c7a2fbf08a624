//! The operations of a program as a reader counts them.
//!
//! Input: a function of a [`Program`]. Output: its [`Operations`], together or loop by loop, and with the
//! loops as text. Invariant: the whole is the sum of its loops, each body counted once.

use crate::index::Domain;
use crate::list::IntoList;
use crate::model::Model;
use crate::op::Op;
use crate::print;
use crate::program::{Function, Instruction, Program, Step, Update};

/// Operations of one evaluation: negation, choice and |x| are free, a fused multiply–add is two,
/// sine and cosine of one angle are one.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Operations {
    /// Additions, subtractions and multiplications.
    pub arithmetic: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
    /// Other elementary functions, and functions written in Rust.
    pub functions: usize,
}

impl Operations {
    /// All of them.
    #[must_use]
    pub fn total(self) -> usize {
        self.arithmetic + self.divisions + self.roots + self.functions
    }

    fn add(&mut self, other: Operations) {
        self.arithmetic += other.arithmetic;
        self.divisions += other.divisions;
        self.roots += other.roots;
        self.functions += other.functions;
    }

    fn count(&mut self, instruction: &Instruction) {
        match instruction {
            Instruction::Add(..) | Instruction::Sub(..) | Instruction::Mul(..) => {
                self.arithmetic += 1;
            }
            Instruction::MulAdd(..) | Instruction::MulSub(..) | Instruction::NegMulAdd(..) => {
                self.arithmetic += 2;
            }
            Instruction::Div(..) | Instruction::Recip(..) => self.divisions += 1,
            Instruction::Call(Op::Sqrt, _) => self.roots += 1,
            Instruction::Call(
                Op::Abs | Op::Sign | Op::Min | Op::Max | Op::Floor | Op::Round,
                _,
            ) => {}
            Instruction::Call(..) | Instruction::PairedSin(_) | Instruction::External(..) => {
                self.functions += 1
            }
            _ => {}
        }
    }
}

impl Program {
    /// The operations of one evaluation, each loop body counted once.
    #[must_use]
    pub fn operations(&self, function: &Function) -> Operations {
        let mut all = Operations::default();
        for (_, operations) in self.operations_by_loop(function) {
            all.add(operations);
        }
        all
    }

    /// The operations of one evaluation outside of loops, which come first, and of one iteration of
    /// each loop without those of the loops inside it. Nests over the same loop count as one.
    #[must_use]
    pub fn operations_by_loop(&self, function: &Function) -> Vec<(Option<Domain>, Operations)> {
        let mut found = vec![(None, Operations::default())];
        self.count(None, &function.evaluation, &mut found);
        found
    }

    fn count(
        &self,
        domain: Option<Domain>,
        steps: &[Step],
        found: &mut Vec<(Option<Domain>, Operations)>,
    ) {
        let mut own = Operations::default();
        let at = found.iter().position(|(known, _)| *known == domain);
        let at = at.unwrap_or_else(|| {
            found.push((domain, own));
            found.len() - 1
        });
        for step in steps {
            match step {
                Step::Let(value) => own.count(self.instruction(*value)),
                Step::Accumulate(..) => own.arithmetic += 1,
                Step::Store(_, _, _, update) => match update {
                    Update::Set(_) => {}
                    Update::Add(_) | Update::Sub(_) => own.arithmetic += 1,
                    Update::AddProduct(..) | Update::SubProduct(..) => own.arithmetic += 2,
                },
                Step::Loop(l) => self.count(Some(l.domain), &l.body, found),
            }
        }
        found[at].1.add(own);
    }
}

/// The operations of one place.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Count {
    /// The loops around it: `i in 0..n, j in 0..i`; nothing outside of loops.
    pub place: String,
    /// The operations of one iteration, without those of loops inside.
    pub operations: Operations,
}

/// The operations of a function, place by place.
#[must_use]
pub fn operations(model: &Model, program: &Program, function: &Function) -> Vec<Count> {
    let mut counts = Vec::new();
    for (domain, operations) in program.operations_by_loop(function) {
        if domain.is_some() && operations.total() == 0 {
            continue;
        }
        let loops = model.dag.path(domain);
        let heads: Vec<String> = loops.iter().map(|d| print::range(model, *d)).into_list();
        counts.push(Count {
            place: heads.join(", "),
            operations,
        });
    }
    counts
}
