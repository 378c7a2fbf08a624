//! Loops of flat code.
//!
//! Input: a loop of a program, its range. Output: the operations at its beginning and at its end, around those of its body.
//! Invariant: sums of many iterations are trees, unless a point is moved in place.

use crate::flatten::{Builder, Kind};
use crate::machine;
use crate::op::{DEPTH, Form, LoopCode, Op, Register};
use hamiltonian_symbolic::index::Domain;
use hamiltonian_symbolic::program::{Loop, Step};

/// The range of a loop: at most up to a number.
#[derive(Clone)]
pub(crate) struct Bounds {
    pub(crate) start: Form,
    pub(crate) end: Form,
    pub(crate) most: Option<i64>,
}

impl Builder<'_> {
    pub(crate) fn nest(&mut self, of: &Loop) -> Result<(), String> {
        let (start, end) = (self.form(&of.start)?, self.form(&of.end)?);
        if let Some(pairs) = self.pairs(of, end.constant) {
            return self.tiles(of, &pairs, end.constant);
        }
        let bounds = Bounds {
            start,
            end,
            most: None,
        };
        self.ranged(of, bounds, machine::LONG)
    }

    /// A loop over a range. Its sums are trees if it has this many iterations.
    pub(crate) fn ranged(&mut self, of: &Loop, bounds: Bounds, long: i64) -> Result<(), String> {
        let mut zero = Vec::new();
        for sum in &of.accumulators {
            let register = self.register();
            self.numbers.insert(*sum, register);
            zero.push(register);
        }
        let is_innermost = !of.body.iter().any(|step| matches!(step, Step::Loop(_)));
        let has_trees = is_innermost && self.kind != Kind::InPlace;
        let mut trees: Vec<(Register, Register)> = Vec::new();
        for step in of.body.iter().filter(|_| has_trees) {
            if let Step::Accumulate(sum, _) = step {
                let sum = self.number(*sum)?;
                if !trees.iter().any(|(known, _)| *known == sum) {
                    trees.push((sum, self.next[0]));
                    self.next[0] += 8;
                }
            }
        }
        let number = self.open(of.domain, bounds, zero, (trees, long))?;
        self.steps(&of.body)?;
        self.close(number);
        Ok(())
    }

    /// A loop without sums around other code.
    pub(crate) fn around(
        &mut self,
        domain: Domain,
        bounds: Bounds,
        inside: impl FnOnce(&mut Self) -> Result<(), String>,
    ) -> Result<(), String> {
        let number = self.open(domain, bounds, Vec::new(), (Vec::new(), machine::LONG))?;
        inside(self)?;
        self.close(number);
        Ok(())
    }

    /// The beginning of a loop; returns its number.
    fn open(
        &mut self,
        domain: Domain,
        bounds: Bounds,
        zero: Vec<Register>,
        (trees, long): (Vec<(Register, Register)>, i64),
    ) -> Result<usize, String> {
        let level = self.loops.len();
        if level >= DEPTH {
            return Err(format!("more than {DEPTH} loops inside each other"));
        }
        let number = self.stage.loops.len();
        let Bounds { start, end, most } = bounds;
        self.stage.loops.push(LoopCode {
            level,
            start,
            end,
            most: most.unwrap_or(i64::MAX),
            zero,
            trees: trees.clone(),
            step: 1,
            long,
            body: 0,
            after: 0,
        });
        self.push(Op::Loop(number as u32));
        self.stage.loops[number].body = self.stage.ops.len();
        self.loops.push((domain, trees));
        Ok(number)
    }

    fn close(&mut self, number: usize) {
        self.loops.pop();
        self.push(Op::End(number as u32));
        self.stage.loops[number].after = self.stage.ops.len();
    }
}
