//! The order of a long straight line in which little is alive at a time.
//!
//! Input: steps in an order in which every value is computed before it is read. Output: the same
//! steps in another such order, in which a value is read soon after it is computed. Invariant:
//! loops keep their places, updates of one output keep their order, a cosine follows its sine;
//! since every operation has the operands it had, no bit of a result changes.

use super::scan::{for_operands, for_update, is_number};
use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::program::{Instruction, Program, Step, Target, Update, Value};

/// Orders the steps between loops.
pub fn compact(program: &Program, steps: &[Step]) -> Vec<Step> {
    let mut ordered = Vec::with_capacity(steps.len());
    for run in steps.chunk_by(|a, b| !is_loop(a) && !is_loop(b)) {
        match run {
            [single] => ordered.push(single.clone()),
            _ => Run::of(program, run).write(&mut ordered),
        }
    }
    ordered
}

fn is_loop(step: &Step) -> bool {
    matches!(step, Step::Loop(_))
}

/// What must be done together: one step, or a sine with its cosine.
#[derive(Debug, Default)]
struct Unit {
    steps: Vec<usize>,
    /// Units of the run whose values it reads, each once.
    needs: Vec<usize>,
    /// Units of the run that read its values or come after it for another reason.
    users: Vec<usize>,
    /// How many values it makes.
    makes: usize,
}

/// A straight line as a graph.
struct Run<'a> {
    steps: &'a [Step],
    units: Vec<Unit>,
    /// For each unit, how many of its users are not done.
    waiting: Vec<usize>,
    /// For each unit, how many of its needs are not done.
    missing: Vec<usize>,
    done: Vec<bool>,
    order: Vec<usize>,
}

impl<'a> Run<'a> {
    fn of(program: &Program, steps: &'a [Step]) -> Run<'a> {
        let mut units: Vec<Unit> = Vec::with_capacity(steps.len());
        let mut makers: Map<Value, usize> = Map::default();
        let mut writers: Map<Target, usize> = Map::default();
        for (at, step) in steps.iter().enumerate() {
            let mut needs = Vec::new();
            let mut need = |value: Value| needs.extend(makers.get(&value).copied());
            match step {
                Step::Let(value) => match program.instruction(*value) {
                    // Its sine's unit is the last one: the two are adjacent.
                    Instruction::PairedCos(sine) if makers.contains_key(sine) => {
                        let unit = makers[sine];
                        units[unit].steps.push(at);
                        units[unit].makes += 1;
                        makers.insert(*value, unit);
                        continue;
                    }
                    instruction => {
                        for_operands(instruction, &mut need);
                        makers.insert(*value, units.len());
                    }
                },
                Step::Store(target, _, _, update) => {
                    for_update(update, &mut need);
                    if !matches!(update, Update::Set(_)) {
                        needs.extend(writers.insert(*target, units.len()));
                    }
                }
                Step::Accumulate(to, value) => {
                    need(*to);
                    need(*value);
                }
                Step::Loop(_) => {}
            }
            needs.sort_unstable();
            needs.dedup();
            let unit = units.len();
            for &other in &needs {
                units[other].users.push(unit);
            }
            let makes = match step {
                Step::Let(value) => usize::from(!is_number(program.instruction(*value))),
                _ => 0,
            };
            units.push(Unit {
                steps: vec![at],
                needs,
                users: Vec::new(),
                makes,
            });
        }
        Run {
            steps,
            waiting: units.iter().map(|unit| unit.users.len()).collect(),
            missing: units.iter().map(|unit| unit.needs.len()).collect(),
            done: vec![false; units.len()],
            order: Vec::with_capacity(units.len()),
            units,
        }
    }

    /// From the ends of the line down to what they need, and from there at once on to whatever
    /// leaves no more alive than there was.
    fn write(mut self, ordered: &mut Vec<Step>) {
        for end in 0..self.units.len() {
            if self.units[end].users.is_empty() {
                self.reach(end);
            }
        }
        for unit in self.order {
            let steps = &self.units[unit].steps;
            ordered.extend(steps.iter().map(|step| self.steps[*step].clone()));
        }
    }

    /// Does a unit after all it needs.
    fn reach(&mut self, end: usize) {
        let mut path = vec![(end, 0)];
        while let Some((unit, next)) = path.pop() {
            if self.done[unit] {
                continue;
            }
            match self.units[unit].needs.get(next) {
                Some(&need) => {
                    path.push((unit, next + 1));
                    path.push((need, 0));
                }
                None => self.finish(unit),
            }
        }
    }

    /// Does a unit whose needs are done, and the users that pay for themselves.
    fn finish(&mut self, unit: usize) {
        let mut ready = vec![unit];
        while let Some(unit) = ready.pop() {
            if std::mem::replace(&mut self.done[unit], true) {
                continue;
            }
            self.order.push(unit);
            for &need in &self.units[unit].needs {
                self.waiting[need] -= 1;
            }
            for &user in self.units[unit].users.iter().rev() {
                self.missing[user] -= 1;
                if self.missing[user] == 0 && self.pays(user) {
                    ready.push(user);
                }
            }
        }
    }

    /// Whether a unit ends as many values as it makes, or more.
    fn pays(&self, unit: usize) -> bool {
        let Unit { needs, makes, .. } = &self.units[unit];
        let ended = needs.iter().filter(|need| self.waiting[**need] == 1);
        ended.map(|need| self.units[*need].makes).sum::<usize>() >= *makes
    }
}
