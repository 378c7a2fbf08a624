//! Independent calls of one function, one beside the other.
//!
//! Input: the steps of a body. Output: the same steps in an order in which calls of one function that do not need each
//! other's values are neighbours, as core's `each` computes them. Invariant: a step stays behind those whose values it
//! uses; none moves past a loop, nor past a store where a body reads what it writes.

use crate::emit::names::context::{Access, Context};
use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::op::{Op, TOGETHER};
use hamiltonian_symbolic::program::{Instruction, Program, Step, Value};

/// The most calls that core computes together.
const MAX_CALLS: usize = 8;

/// Calls of one function that are neighbours.
#[derive(Debug)]
pub struct Calls {
    /// The names of core's type and of the method.
    pub function: String,
    /// Their values, with the cosine of a sine.
    pub values: Vec<(Value, Option<Value>)>,
    /// Their arguments.
    pub arguments: Vec<Value>,
    /// The number of steps that they are.
    pub steps: usize,
}

/// The calls of one function at the beginning of some steps, if they are several.
pub fn first(program: &Program, steps: &[Step]) -> Option<Calls> {
    let (function, ..) = call(program, steps)?;
    let mut calls = Calls {
        function: match function {
            Some(op) => format!("{op:?} {}", op.row().name),
            None => "SinCos sin_cos".to_owned(),
        },
        values: Vec::new(),
        arguments: Vec::new(),
        steps: 0,
    };
    let mut own = Vec::new();
    while let Some((of, value, argument)) = call(program, &steps[calls.steps..])
        && of == function
        && calls.values.len() < MAX_CALLS
        && !own.contains(&argument)
    {
        calls.arguments.push(argument);
        let cosine = match &steps[calls.steps..] {
            [_, Step::Let(cosine), ..] if of.is_none() => Some(*cosine),
            _ => None,
        };
        own.extend([Some(value), cosine].into_iter().flatten());
        calls.steps += 1 + usize::from(cosine.is_some());
        calls.values.push((value, cosine));
    }
    (calls.values.len() > 1).then_some(calls)
}

/// Returns true if some steps have few calls that are computed together, so that rustc has time to write them out.
pub fn few(program: &Program, mut steps: &[Step]) -> bool {
    const FEW: usize = 2;
    let mut count = 0;
    while !steps.is_empty() {
        let calls = first(program, steps);
        count += usize::from(calls.is_some());
        steps = &steps[calls.map_or(1, |calls| calls.steps)..];
    }
    count <= FEW
}

/// A call that may have neighbours, in the first step: its function, its value and its argument. No function is sine and
/// cosine, which are two steps.
fn call(program: &Program, steps: &[Step]) -> Option<(Option<Op>, Value, Value)> {
    let Some(Step::Let(value)) = steps.first() else {
        return None;
    };
    match program.instruction(*value) {
        Instruction::PairedSin(angle) => match steps.get(1) {
            Some(Step::Let(next))
                if *program.instruction(*next) == Instruction::PairedCos(*value) =>
            {
                Some((None, *value, *angle))
            }
            _ => None,
        },
        Instruction::Call(op, arguments) if TOGETHER.contains(op) => {
            Some((Some(*op), *value, arguments[0]))
        }
        _ => None,
    }
}

/// The steps in that order.
pub fn neighbours(context: Context, steps: &[Step]) -> Vec<Step> {
    let is_fixed = |step: &Step| match step {
        Step::Loop(_) | Step::Accumulate(..) => true,
        Step::Store(..) => context.access != Access::Apart,
        Step::Let(_) => false,
    };
    let parts = steps.split_inclusive(is_fixed);
    parts
        .flat_map(|part| Order::of(context.program, part))
        .into_list()
}

/// The function of a call, and the number of calls before it on the longest way there.
type CallKind = (Option<Op>, usize);

struct Order<'a> {
    program: &'a Program,
    steps: &'a [Step],
    /// The step that computes a value.
    at: Map<Value, usize>,
    /// For each call its neighbours: calls of its function with as many calls before them.
    neighbours: Map<usize, Vec<usize>>,
    is_placed: Vec<bool>,
    out: Vec<Step>,
}

impl Order<'_> {
    fn of(program: &Program, steps: &[Step]) -> Vec<Step> {
        let mut order = Order {
            program,
            steps,
            at: Map::default(),
            neighbours: Map::default(),
            is_placed: vec![false; steps.len()],
            out: Vec::with_capacity(steps.len()),
        };
        let mut depths = vec![0usize; steps.len()];
        let mut groups: Vec<(CallKind, Vec<usize>)> = Vec::new();
        for (place, step) in steps.iter().enumerate() {
            let Step::Let(value) = step else { continue };
            order.at.insert(*value, place);
            let before = order.before(place).into_iter();
            let is_call = |at: usize| usize::from(call(program, &steps[at..]).is_some());
            depths[place] = before.map(|at| depths[at] + is_call(at)).max().unwrap_or(0);
            if let Some((function, ..)) = call(program, &steps[place..]) {
                let key = (function, depths[place]);
                match groups.iter_mut().find(|(known, _)| *known == key) {
                    Some((_, group)) => group.push(place),
                    None => groups.push((key, vec![place])),
                }
            }
        }
        for (_, group) in groups {
            let each = group.iter().map(|place| (*place, group.clone()));
            order.neighbours.extend(each);
        }
        (0..steps.len()).for_each(|place| order.place(place));
        order.out
    }

    /// The steps that a step needs.
    fn before(&self, place: usize) -> Vec<usize> {
        let mut before = Vec::new();
        let mut add = |value: Value| before.extend(self.at.get(&value).copied());
        match &self.steps[place] {
            Step::Let(value) => self.program.instruction(*value).for_operands(add),
            Step::Store(_, _, _, update) => update.for_operands(add),
            Step::Accumulate(to, value) => [*to, *value].into_iter().for_each(&mut add),
            Step::Loop(_) => {}
        }
        before
    }

    /// Places a step behind those that it needs, a call with its neighbours.
    fn place(&mut self, place: usize) {
        if self.is_placed[place] {
            return;
        }
        let group = self.neighbours.get(&place).cloned().unwrap_or(vec![place]);
        for at in &group {
            self.is_placed[*at] = true;
        }
        for at in group.iter().flat_map(|at| self.before(*at)).into_list() {
            self.place(at);
        }
        for at in group {
            self.out.push(self.steps[at].clone());
            // A cosine stays with its sine.
            if let Some((None, ..)) = call(self.program, &self.steps[at..]) {
                self.is_placed[at + 1] = true;
                self.out.push(self.steps[at + 1].clone());
            }
        }
    }
}
