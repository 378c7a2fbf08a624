//! The order of a long straight line in which few values are alive at a time.
//!
//! Input: steps in an order in which every value is computed before it is read. Output: the same
//! steps in another such order. Steps that free at least as many values as they define come first.
//! Invariant: loops keep their places, updates of one output keep their order, a cosine follows its
//! sine; since every operation has the operands it had, no bit of a result changes.

use crate::dag::Map;
use crate::program::{Instruction, Program, Step, Target, Value};
use crate::sort::Arrange;

impl Program {
    /// Orders the steps between loops.
    #[must_use]
    pub fn compact(&self, steps: &[Step]) -> Vec<Step> {
        let mut ordered = Vec::with_capacity(steps.len());
        for line in steps.chunk_by(|a, b| !is_loop(a) && !is_loop(b)) {
            let mut graph = Graph::of(self, line);
            for unit in 0..graph.units.len() {
                graph.perform(unit);
            }
            ordered.extend(graph.order.into_iter().map(|at| line[at].clone()));
        }
        ordered
    }
}

fn is_loop(step: &Step) -> bool {
    matches!(step, Step::Loop(_))
}

/// Steps done together: one, or a sine and its cosine.
#[derive(Default)]
struct Bundle {
    steps: Vec<usize>,
    /// Values of the line that it reads, each once.
    reads: Vec<usize>,
    /// Values it makes.
    makes: Vec<usize>,
    is_done: bool,
}

/// A value of the line, or the state of an output between two updates.
struct LineValue {
    by: usize,
    readers: Vec<usize>,
    /// The number of readers that are not done.
    waiting: usize,
}

/// A straight line as a graph.
#[derive(Default)]
struct Graph {
    units: Vec<Bundle>,
    values: Vec<LineValue>,
    order: Vec<usize>,
}

impl Graph {
    fn of(program: &Program, line: &[Step]) -> Graph {
        let mut graph = Graph::default();
        let mut known: Map<Value, usize> = Map::default();
        let mut outputs: Map<Target, usize> = Map::default();
        for (at, step) in line.iter().enumerate() {
            let mut reads: Vec<usize> = Vec::new();
            let mut read = |value: Value| reads.extend(known.get(&value));
            let unit = graph.units.len();
            match step {
                Step::Let(value) => {
                    let instruction = program.instruction(*value);
                    instruction.for_operands(&mut read);
                    if let (Instruction::PairedCos(_), [sine]) = (instruction, reads.as_slice()) {
                        let unit = graph.values[*sine].by;
                        graph.units[unit].steps.push(at);
                        known.insert(*value, graph.make(unit));
                        continue;
                    }
                    graph.add(at, reads);
                    if !instruction.is_number() {
                        known.insert(*value, graph.make(unit));
                    }
                }
                Step::Store(target, _, _, update) => {
                    update.for_operands(&mut read);
                    reads.extend(outputs.get(target));
                    graph.add(at, reads);
                    outputs.insert(*target, graph.make(unit));
                }
                Step::Accumulate(..) | Step::Loop(_) => graph.add(at, reads),
            }
        }
        graph
    }

    /// Adds a unit of one step.
    fn add(&mut self, step: usize, mut reads: Vec<usize>) {
        reads.arrange();
        reads.dedup();
        for &value in &reads {
            self.values[value].readers.push(self.units.len());
            self.values[value].waiting += 1;
        }
        self.units.push(Bundle {
            steps: vec![step],
            reads,
            ..Bundle::default()
        });
    }

    /// A new value of a unit.
    fn make(&mut self, by: usize) -> usize {
        let value = self.values.len();
        self.units[by].makes.push(value);
        self.values.push(LineValue {
            by,
            readers: Vec::new(),
            waiting: 0,
        });
        value
    }

    /// Performs a unit whose operands are computed, and then each that ends as many values as it
    /// makes.
    fn perform(&mut self, first: usize) {
        let mut candidates = vec![first];
        while let Some(unit) = candidates.pop() {
            if self.units[unit].is_done || unit != first && !self.pays(unit) {
                continue;
            }
            let Bundle {
                steps,
                reads,
                makes,
                is_done,
            } = &mut self.units[unit];
            *is_done = true;
            self.order.append(steps);
            let (reads, makes) = (std::mem::take(reads), std::mem::take(makes));
            for value in reads {
                let value = &mut self.values[value];
                value.waiting -= 1;
                if value.waiting == 1 {
                    let is_left = |reader: &&usize| !self.units[**reader].is_done;
                    candidates.extend(value.readers.iter().find(is_left));
                }
            }
            for value in makes.into_iter().rev() {
                candidates.extend(self.values[value].readers.iter().rev());
            }
        }
    }

    /// Returns true if a unit can be done now and ends as many values as it makes, or more.
    fn pays(&self, unit: usize) -> bool {
        let Bundle { reads, makes, .. } = &self.units[unit];
        let is_there = |value: &usize| self.units[self.values[*value].by].is_done;
        let ended = reads
            .iter()
            .filter(|value| self.values[**value].waiting == 1);
        reads.iter().all(is_there) && ended.count() >= makes.len()
    }
}
