//! Straight code in a frame: the flow of a piece, with its loops unrolled.
//!
//! Input: the evaluation of a flow. Output: operations on registers alone, [`Framed`]. Invariant: the operations that the
//! stage of the flow makes, in their order, so that the bits are the same.
//!
//! The point has registers of its own, so that nothing loads or stores between two flows.

use crate::allocate::{Layout, allocate};
use crate::flatten::{Builder, Kind, Setting, Unrolled};
use crate::interleave::{interleave, packed};
use crate::machine::LONG;
use crate::op::{Change, Framed, From, Held, Op, PHASE, Register, Stage, To};
use crate::registers::FRAME;
use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::program::{Instruction, Loop, Step, Value};

/// The most operations of a flow.
const LONGEST: usize = 4096;

/// The length of code that a CPU foresees as it is.
const FORESEEN: usize = 100;

/// The most operations that one overtakes, as long as there are registers.
const WINDOWS: [usize; 3] = [256, 64, 1];

/// The code of a flow before its registers are numbered, with the value of the program that each operation computes.
pub(crate) struct Straight {
    stage: Stage,
    sites: Vec<Option<Value>>,
}

/// The code of a flow before its registers are numbered, or `None` if it is too long.
pub(crate) fn straight(
    setting: Setting,
    kind: Kind,
    steps: &[Step],
    coefficients: &[Value],
    read: &[Value],
) -> Option<Straight> {
    let mut builder = Builder::new(setting, kind, coefficients);
    builder.read = read.to_vec();
    builder.unrolled = Some(Unrolled::default());
    builder.steps(steps).ok()?;
    // The numbers of the step coefficient are those of the stage.
    if builder.read != read {
        return None;
    }
    let (mut stage, unrolled) = (builder.stage, builder.unrolled?);
    // A frame has no functions with data.
    if stage.ops.iter().any(|op| matches!(op, Op::External(..))) {
        return None;
    }
    stage.coefficients = read.len();
    let mut sites = unrolled.sites;
    drop_copies(&mut stage.ops, &mut sites);
    Some(Straight { stage, sites })
}

/// Numbers the registers of flows, as far as there are enough: those of the point first, then what each flow holds, then
/// values, which all flows share.
pub(crate) fn frames(width: usize, flows: Vec<Option<Straight>>) -> Vec<Option<Framed>> {
    let mut next = 2 * width;
    let mut layouts = Vec::new();
    for flow in flows {
        layouts.push(flow.map(|flow| {
            let held = next;
            let coefficients = held + flow.stage.held.len();
            next = coefficients + flow.stage.coefficients;
            (flow, held, coefficients)
        }));
    }
    let number = |(flow, held, coefficients): (Straight, usize, usize)| {
        let layout = Layout {
            held,
            coefficients,
            phase: 0,
            values: next,
        };
        let Straight { stage, sites } = flow;
        let is_laid = stage.ops.len() > FORESEEN;
        WINDOWS.iter().find_map(|window| {
            let mut stage = stage.clone();
            let mut groups = Vec::new();
            if is_laid {
                let laid = interleave(&stage.ops, &sites, *window);
                (stage.ops, groups) = (laid.ops, laid.groups);
            }
            allocate(&mut stage, layout, &groups);
            let fits = stage.registers <= FRAME[0] && stage.masks <= FRAME[1];
            fits.then(|| Framed {
                reads_time: stage.ops.iter().any(|op| matches!(op, Op::Time(_))),
                ops: packed(&stage.ops, &groups),
                is_laid,
                registers: stage.registers,
                held: stage.held,
                first_held: held,
                first_coefficient: coefficients,
                coefficients: stage.coefficients,
            })
        })
    };
    layouts
        .into_iter()
        .map(|one| one.and_then(number))
        .collect()
}

/// Removes copies that nothing reads.
fn drop_copies(ops: &mut Vec<Op>, sites: &mut Vec<Option<Value>>) {
    let mut reads: Map<Register, usize> = Map::default();
    for op in ops.iter() {
        let mut op = *op;
        crate::allocate::registers(&mut op, &mut |register, _| {
            *reads.entry(*register).or_default() += 1;
        });
    }
    // The first is the one that is written.
    let is_read = |op: &Op| match op {
        Op::Copy(to, _) => *to >= PHASE || reads.get(to) != Some(&1),
        _ => true,
    };
    let mut kept = ops.iter().map(is_read);
    sites.retain(|_| kept.next() == Some(true));
    ops.retain(is_read);
}

impl Builder<'_> {
    fn unrolled(&mut self) -> &mut Unrolled {
        self.unrolled.get_or_insert_default()
    }

    /// The register of an element of the point, or of the arrays of parameters.
    pub(crate) fn in_frame(&mut self, from: From, place: u32) -> Result<Register, String> {
        let width = self.setting.places.len as Register;
        match from {
            From::Q | From::Written(To::Q) => Ok(PHASE + place),
            From::P | From::Written(To::P) => Ok(PHASE + width + place),
            From::Data => Ok(self.held(Held::Data(place))),
            _ => Err("an array that a flow does not have".to_owned()),
        }
    }

    /// Changes an element of the point. What was read from it before keeps its value.
    pub(crate) fn change_in_frame(
        &mut self,
        to: To,
        place: u32,
        change: Change,
        [a, b]: [Register; 2],
    ) -> Result<(), String> {
        let element = self.in_frame(From::Written(to), place)?;
        let readers = self.numbers.iter();
        let readers = readers.filter(|(_, register)| **register == element);
        let readers: Vec<Value> = readers.map(|(value, _)| *value).collect();
        if !readers.is_empty() {
            let copy = self.register();
            self.push(Op::Copy(copy, element));
            for value in readers {
                self.numbers.insert(value, copy);
            }
        }
        self.push(match change {
            Change::Set => Op::Copy(element, a),
            Change::Add => Op::Add(element, element, a),
            Change::Sub => Op::Sub(element, element, a),
            Change::AddProduct => Op::MulAdd(element, a, b, element),
            Change::SubProduct => Op::NegMulAdd(element, a, b, element),
        });
        Ok(())
    }

    /// The register of a number that depends on sizes and on variables of loops alone.
    pub(crate) fn count(&mut self, of: &Instruction) -> Result<Register, String> {
        let value = match of {
            Instruction::Variable(domain) => self.form(&Affine::variable(*domain))?.constant,
            Instruction::Extent(size) => self.form(&Affine::size(*size))?.constant,
            Instruction::Count(start, end) => {
                (self.form(end)?.constant - self.form(start)?.constant).max(0)
            }
            other => return Err(format!("no count ({other:?})")),
        };
        Ok(self.held(Held::Constant(value as f64, 0.0)))
    }

    /// Adds a term to a sum, or to one of its partial sums.
    pub(crate) fn add_term(&mut self, sum: Value, term: Value) -> Result<(), String> {
        let term = self.number(term)?;
        let to = self.register();
        let unrolled = self.unrolled();
        let k = unrolled.iteration % 8;
        let partials = unrolled.partials.as_mut();
        if let Some(partials) = partials.and_then(|all| all.get_mut(&sum)) {
            let before = core::mem::replace(&mut partials[k], to);
            self.push(Op::Add(to, before, term));
        } else {
            let before = self.number(sum)?;
            self.push(Op::Add(to, before, term));
            self.numbers.insert(sum, to);
        }
        Ok(())
    }

    /// The iterations of a loop one after the other.
    pub(crate) fn unroll(&mut self, of: &Loop) -> Result<(), String> {
        let start = self.form(&of.start)?.constant;
        let end = self.form(&of.end)?.constant;
        let zero = self.held(Held::Constant(0.0, 0.0));
        for sum in &of.accumulators {
            self.numbers.insert(*sum, zero);
        }
        let is_innermost = !of.body.iter().any(|step| matches!(step, Step::Loop(_)));
        let has_trees = is_innermost && self.kind != Kind::InPlace && end - start >= LONG;
        let sums = of.body.iter().filter(|_| has_trees);
        let sums = sums.filter_map(|step| match step {
            Step::Accumulate(sum, _) => Some((*sum, [zero; 8])),
            _ => None,
        });
        let partials = has_trees.then(|| sums.collect());
        let around = core::mem::replace(&mut self.unrolled().partials, partials);
        let cosines = self.cosines.clone();
        for variable in start..end {
            let unrolled = self.unrolled();
            unrolled.variables.insert(of.domain, variable);
            unrolled.iteration = (variable - start) as usize;
            self.cosines = cosines.clone();
            self.steps(&of.body)?;
            if self.stage.ops.len() > LONGEST {
                return Err("a long flow".to_owned());
            }
        }
        let partials = core::mem::replace(&mut self.unrolled().partials, around);
        for (sum, s) in partials.iter().flat_map(Map::iter) {
            self.add_tree(*sum, *s)?;
        }
        Ok(())
    }

    /// Adds the tree of partial sums to a sum.
    fn add_tree(&mut self, sum: Value, s: [Register; 8]) -> Result<(), String> {
        let mut add = |a: Register, b: Register| {
            let to = self.register();
            self.push(Op::Add(to, a, b));
            to
        };
        let even = [add(s[0], s[4]), add(s[2], s[6])];
        let even = add(even[0], even[1]);
        let odd = [add(s[1], s[5]), add(s[3], s[7])];
        let odd = add(odd[0], odd[1]);
        let tree = add(even, odd);
        let before = self.number(sum)?;
        let to = self.register();
        self.push(Op::Add(to, before, tree));
        self.numbers.insert(sum, to);
        Ok(())
    }
}
