//! The order of a long straight line in which little is alive at a time.
//!
//! Input: steps in an order in which every value is computed before it is read. Output: the same
//! steps in another such order, in which a value is read soon after it is computed. Invariant:
//! loops keep their places, updates of one output keep their order, a cosine follows its sine;
//! since every operation has the operands it had, no bit of a result changes.

use crate::dag::Map;
use crate::program::{Instruction, Program, Step, Target, Value};
use std::cmp::Reverse;

impl Program {
    /// Orders the steps between loops.
    #[must_use]
    pub fn compact(&self, steps: &[Step]) -> Vec<Step> {
        let mut ordered = Vec::with_capacity(steps.len());
        for run in steps.chunk_by(|a, b| !is_loop(a) && !is_loop(b)) {
            match run {
                [single] => ordered.push(single.clone()),
                _ => Run::of(self, run).write(&mut ordered),
            }
        }
        ordered
    }
}

fn is_loop(step: &Step) -> bool {
    matches!(step, Step::Loop(_))
}

/// Values computed together: one step, or a sine with its cosine.
#[derive(Debug)]
struct Unit {
    steps: Vec<usize>,
    /// Values of the run that it reads, each once, the highest first.
    reads: Vec<usize>,
    /// The unit that comes before it although it reads nothing of it.
    after: Option<usize>,
    /// Units that are not done and that it waits for.
    missing: usize,
    /// Values it makes.
    makes: Vec<usize>,
    /// The longest way down to a unit that reads nothing.
    height: usize,
    done: bool,
}

/// A value of the run.
#[derive(Debug)]
struct Made {
    by: usize,
    readers: Vec<usize>,
    /// The number of readers that are not done.
    waiting: usize,
}

/// A straight line as a graph.
struct Run<'a> {
    steps: &'a [Step],
    units: Vec<Unit>,
    values: Vec<Made>,
    /// Units by the unit they come after.
    followers: Map<usize, usize>,
    order: Vec<usize>,
}

impl<'a> Run<'a> {
    fn of(program: &Program, steps: &'a [Step]) -> Run<'a> {
        let mut run = Run {
            steps,
            units: Vec::with_capacity(steps.len()),
            values: Vec::with_capacity(steps.len()),
            followers: Map::default(),
            order: Vec::with_capacity(steps.len()),
        };
        let mut known: Map<Value, usize> = Map::default();
        let mut writers: Map<Target, usize> = Map::default();
        for (at, step) in steps.iter().enumerate() {
            if let Step::Let(value) = step {
                let instruction = program.instruction(*value);
                if let Instruction::PairedCos(sine) = instruction
                    && let Some(sine) = known.get(sine)
                {
                    let unit = run.values[*sine].by;
                    run.units[unit].steps.push(at);
                    known.insert(*value, run.make(unit));
                    continue;
                }
            }
            let mut reads = Vec::new();
            for_reads(program, step, |value| reads.extend(known.get(&value)));
            let after = match step {
                Step::Store(target, ..) => writers.insert(*target, run.units.len()),
                _ => None,
            };
            let unit = run.add(at, reads, after);
            if let Step::Let(value) = step
                && !program.instruction(*value).is_number()
            {
                known.insert(*value, run.make(unit));
            }
        }
        run
    }

    /// A new unit of one step.
    fn add(&mut self, step: usize, mut reads: Vec<usize>, after: Option<usize>) -> usize {
        let unit = self.units.len();
        let height = |value: &usize| self.units[self.values[*value].by].height;
        // The longest way is reached first: a running sum before its next term.
        reads.sort_unstable_by_key(|value| (Reverse(height(value)), *value));
        reads.dedup();
        let height = reads.first().map_or(0, |value| height(value) + 1);
        for &value in &reads {
            self.values[value].readers.push(unit);
            self.values[value].waiting += 1;
        }
        if let Some(before) = after {
            self.followers.insert(before, unit);
        }
        self.units.push(Unit {
            steps: vec![step],
            missing: reads.len() + usize::from(after.is_some()),
            reads,
            after,
            makes: Vec::new(),
            height,
            done: false,
        });
        unit
    }

    /// A new value of a unit.
    fn make(&mut self, by: usize) -> usize {
        self.units[by].makes.push(self.values.len());
        self.values.push(Made {
            by,
            readers: Vec::new(),
            waiting: 0,
        });
        self.values.len() - 1
    }

    /// From the ends of the line down to what they need, and from there at once on to whatever
    /// leaves no more alive than there was.
    fn write(mut self, ordered: &mut Vec<Step>) {
        let is_read = |value: &usize| !self.values[*value].readers.is_empty();
        let is_end = |unit: &usize| !self.units[*unit].makes.iter().any(is_read);
        let ends: Vec<usize> = (0..self.units.len()).filter(is_end).collect();
        for end in ends {
            self.reach(end);
        }
        for unit in self.order {
            let steps = &self.units[unit].steps;
            ordered.extend(steps.iter().map(|step| self.steps[*step].clone()));
        }
    }

    /// Does a unit after all it waits for.
    fn reach(&mut self, end: usize) {
        let mut path = vec![(end, 0)];
        while let Some((unit, next)) = path.pop() {
            let Unit { reads, after, .. } = &self.units[unit];
            if self.units[unit].done {
                continue;
            }
            let need = match reads.get(next) {
                Some(value) => Some(self.values[*value].by),
                None => after.filter(|_| next == reads.len()),
            };
            match need {
                Some(need) => path.extend([(unit, next + 1), (need, 0)]),
                None => self.finish(unit),
            }
        }
    }

    /// Does a unit that waits for nothing, and whatever then pays for itself.
    fn finish(&mut self, unit: usize) {
        let mut candidates = Vec::new();
        self.perform(unit, &mut candidates);
        while let Some(unit) = candidates.pop() {
            if !self.units[unit].done && self.units[unit].missing == 0 && self.pays(unit) {
                self.perform(unit, &mut candidates);
            }
        }
    }

    /// Does a unit; those that may pay for themselves now are candidates.
    fn perform(&mut self, unit: usize, candidates: &mut Vec<usize>) {
        self.units[unit].done = true;
        self.order.push(unit);
        for at in 0..self.units[unit].reads.len() {
            let value = &mut self.values[self.units[unit].reads[at]];
            value.waiting -= 1;
            if value.waiting == 1 {
                let last = value
                    .readers
                    .iter()
                    .find(|reader| !self.units[**reader].done);
                candidates.extend(last);
            }
        }
        if let Some(&follower) = self.followers.get(&unit) {
            self.units[follower].missing -= 1;
            candidates.push(follower);
        }
        for at in (0..self.units[unit].makes.len()).rev() {
            for &reader in self.values[self.units[unit].makes[at]].readers.iter().rev() {
                self.units[reader].missing -= 1;
                candidates.push(reader);
            }
        }
    }

    /// Whether a unit ends as many values as it makes, or more.
    fn pays(&self, unit: usize) -> bool {
        let Unit { reads, makes, .. } = &self.units[unit];
        let ended = reads
            .iter()
            .filter(|value| self.values[**value].waiting == 1);
        ended.count() >= makes.len()
    }
}

/// Calls `visit` with each value a step reads.
fn for_reads(program: &Program, step: &Step, visit: impl FnMut(Value)) {
    match step {
        Step::Let(value) => program.instruction(*value).for_operands(visit),
        Step::Store(_, _, _, update) => update.for_operands(visit),
        Step::Accumulate(..) | Step::Loop(_) => {}
    }
}
