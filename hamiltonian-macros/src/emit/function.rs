//! Functions of a program as function bodies, cut into pieces where they are long.
//!
//! Input: steps, what they read from, what they return. Output: the text of a body, and free
//! functions for its pieces. Invariant: rustc sees no straight line of more than about
//! [`LONGEST`] values in one function, because its time grows faster than their number.

use super::block::{self, Context, name, operand};
use super::generics::Generics;
use super::holder::Receiver;
use super::layout::{self, Slice};
use super::scan::{Scan, is_mask, scan};
use hamiltonian_symbolic::model::Shape;
use hamiltonian_symbolic::program::{Instruction, Program, Step, Target, Value};
use std::fmt::Write;
use std::ops::Range;

/// The longest straight line of values.
const LONGEST: usize = 500;

/// A function to be written.
#[derive(Debug, Clone, Copy)]
pub struct Body<'a> {
    /// Its name: pieces are called after it.
    pub name: &'a str,
    /// What it is a method of.
    pub receiver: Receiver<'a>,
    /// Its arguments after `self`: names and types.
    pub arguments: &'a [(&'static str, String)],
    /// What it does.
    pub steps: &'a [Step],
    /// Outputs that are set to 0 first.
    pub cleared: &'a [Target],
    /// Values it ends with; they are in scope where `tail` stands.
    pub results: &'a [Value],
    /// Parameter arrays that are bound as slices although no step reads them.
    pub arrays: &'a [u16],
}

/// Writes bodies, and gathers their pieces.
#[derive(Debug)]
pub struct Bodies<'a> {
    /// What they are written from.
    pub context: Context<'a>,
    /// The generics of the definition.
    pub generics: &'a Generics,
    /// The pieces of long ones: free functions.
    pub pieces: String,
}

impl Bodies<'_> {
    /// Writes a body after `let _self = …;`. All `results` are in scope at its end.
    pub fn write(&mut self, out: &mut String, body: Body) {
        let context = self.context;
        let parts = cut(context.program, body.steps);
        if parts.len() <= 1 {
            let scan = scan(context.program, context.layout, body.steps, body.results);
            let mut slices = scan.slices;
            slices.extend(block::cleared(context, body.cleared));
            slices.extend(body.arrays.iter().map(|array| Slice::Parameter(*array)));
            self.bind(out, body.receiver, slices);
            self.read(out, body.receiver, &scan.reads, &[]);
            block::clear(out, context, body.cleared);
            self.steps(out, body.receiver, body.steps);
            return;
        }
        self.write_pieces(out, body, &parts);
    }

    fn steps(&self, out: &mut String, receiver: Receiver, steps: &[Step]) {
        let scalar = |parameter| receiver.scalar(self.generics, parameter);
        block::write(out, self.context, &scalar, steps);
    }

    /// Binds sizes and slices.
    fn bind(&self, out: &mut String, receiver: Receiver, mut slices: Vec<Slice>) {
        let context = self.context;
        slices.sort_unstable();
        slices.dedup();
        for (size, run_time) in context.is_run_time.iter().enumerate() {
            if *run_time {
                receiver.bind_size(out, self.generics, size);
            }
        }
        layout::bind(
            out,
            &slices,
            context.model,
            context.layout,
            context.indices,
            context.is_run_time,
        );
        for slice in &slices {
            match slice {
                Slice::Parameter(array) => receiver.bind_array(out, self.generics, *array),
                Slice::Derivative(number) => {
                    let field = self.generics.field(*number);
                    let access = match context.model.parameters[usize::from(*number)].shape {
                        Shape::Scalar => "",
                        _ => ".as_mut_slice()",
                    };
                    let name = slice.name();
                    let _ = match access {
                        "" => writeln!(out, "let {name} = &mut _d.{field};"),
                        _ => writeln!(out, "let {name} = _d.{field}{access};"),
                    };
                }
                _ => {}
            }
        }
    }

    /// Binds values computed earlier: by an earlier stage, an earlier piece, or, where they cost
    /// nothing, again.
    fn read(
        &self,
        out: &mut String,
        receiver: Receiver,
        reads: &[Value],
        slots: &[Option<String>],
    ) {
        for &value in reads {
            let slot = slots.get(value.0 as usize).and_then(Clone::clone);
            match slot.or_else(|| receiver.read(value)) {
                Some(text) => {
                    let _ = writeln!(out, "let {} = {text};", name(value));
                }
                None => self.steps(out, receiver, &[Step::Let(value)]),
            }
        }
    }

    fn write_pieces(&mut self, out: &mut String, body: Body, parts: &[Range<usize>]) {
        let context = self.context;
        let program = context.program;
        let mut scans: Vec<Scan> = parts
            .iter()
            .map(|part| scan(program, context.layout, &body.steps[part.clone()], &[]))
            .collect();
        scans.push(scan(program, context.layout, &[], body.results));
        // The last part that reads a value.
        let mut last = vec![0usize; program.instructions.len()];
        for (at, scan) in scans.iter().enumerate() {
            for value in &scan.reads {
                last[value.0 as usize] = at;
            }
        }
        // Leaves are read again; everything else that is read later gets a slot.
        let mut slots = Slots::default();
        let mut homes: Vec<Option<String>> = vec![None; program.instructions.len()];
        for (at, scan) in scans.iter().enumerate() {
            slots.release(at);
            for &value in &scan.computes {
                let until = last[value.0 as usize];
                if until > at && !is_leaf(program.instruction(value)) {
                    let mask = is_mask(program.instruction(value));
                    homes[value.0 as usize] = Some(slots.take(mask, until));
                }
            }
        }
        let scratch = format!(
            "_s: &mut [T; {}], _m: &mut [<T as __h::Real>::Mask; {}]",
            slots.numbers.len(),
            slots.masks.len()
        );
        let _ = writeln!(
            out,
            "let _s = &mut [T::constant(0.0, 0.0); {}];\n\
             let _m = &mut [<<T as __h::Real>::Mask as __h::Mask>::splat(false); {}];",
            slots.numbers.len(),
            slots.masks.len()
        );
        let names: String = body
            .arguments
            .iter()
            .map(|(name, _)| format!("{name}, "))
            .collect();
        for (at, (part, scan)) in parts.iter().zip(&scans).enumerate() {
            let steps = &body.steps[part.clone()];
            let mut text = String::new();
            let mut slices = scan.slices.clone();
            for value in &scan.reads {
                if let Instruction::Load(array, ..) = program.instruction(*value) {
                    slices.push(Slice::read(context.layout, *array));
                }
            }
            if at == 0 {
                slices.extend(block::cleared(context, body.cleared));
            }
            self.bind(&mut text, body.receiver, slices);
            self.read(&mut text, body.receiver, &scan.reads, &homes);
            if at == 0 {
                block::clear(&mut text, context, body.cleared);
            }
            self.steps(&mut text, body.receiver, steps);
            for value in &scan.computes {
                if let Some(slot) = &homes[value.0 as usize] {
                    let _ = writeln!(text, "{slot} = {};", name(*value));
                }
            }
            let arguments: String = body
                .arguments
                .iter()
                .map(|(name, ty)| format!("{name}: {ty}, "))
                .collect();
            let _ = write!(
                self.pieces,
                "#[inline(never)]\n#[allow(clippy::too_many_arguments)]\nfn __{}_{at}{}(_self: &{}, {arguments}{scratch}) {{\n{text}}}\n",
                body.name,
                body.receiver.declaration(self.generics),
                body.receiver.ty(self.generics),
            );
            let _ = writeln!(out, "__{}_{at}(_self, {names}_s, _m);", body.name);
        }
        let mut slices: Vec<Slice> = body
            .arrays
            .iter()
            .map(|array| Slice::Parameter(*array))
            .collect();
        let tail = scans
            .last()
            .map(|scan| scan.reads.clone())
            .unwrap_or_default();
        for value in &tail {
            if let Instruction::Load(array, ..) = program.instruction(*value) {
                slices.push(Slice::read(context.layout, *array));
            }
        }
        self.bind(out, body.receiver, slices);
        self.read(out, body.receiver, &tail, &homes);
    }
}

/// The operands of a list of results.
pub fn results(context: Context, results: &[Value]) -> String {
    let texts: Vec<String> = results
        .iter()
        .map(|value| operand(context, *value))
        .collect();
    texts.join(", ")
}

/// Whether an instruction costs nothing and needs nothing.
fn is_leaf(instruction: &Instruction) -> bool {
    matches!(
        instruction,
        Instruction::Scalar(_)
            | Instruction::Time
            | Instruction::Coefficient
            | Instruction::Extent(_)
            | Instruction::Count(..)
            | Instruction::Load(..)
    )
}

/// Runs of steps of at most about [`LONGEST`] values each; a cosine stays with its sine.
fn cut(program: &Program, steps: &[Step]) -> Vec<Range<usize>> {
    let is_cosine = |step: &Step| match step {
        Step::Let(value) => matches!(program.instruction(*value), Instruction::PairedCos(_)),
        _ => false,
    };
    let mut parts = Vec::new();
    let (mut start, mut length) = (0, 0);
    for (at, step) in steps.iter().enumerate() {
        length += weight(step);
        if length >= LONGEST && !steps.get(at + 1).is_some_and(is_cosine) {
            parts.push(start..at + 1);
            (start, length) = (at + 1, 0);
        }
    }
    if start < steps.len() {
        parts.push(start..steps.len());
    }
    parts
}

fn weight(step: &Step) -> usize {
    match step {
        Step::Loop(inner) => inner.body.iter().map(weight).sum(),
        _ => 1,
    }
}

/// Places in the scratch arrays that pieces hand values over in.
#[derive(Default)]
struct Slots {
    /// Until which part each number's place is taken.
    numbers: Vec<usize>,
    /// The same for masks.
    masks: Vec<usize>,
    free_numbers: Vec<usize>,
    free_masks: Vec<usize>,
}

impl Slots {
    /// Frees the places that no part from `now` on reads.
    fn release(&mut self, now: usize) {
        for (taken, free) in [
            (&mut self.numbers, &mut self.free_numbers),
            (&mut self.masks, &mut self.free_masks),
        ] {
            for (at, until) in taken.iter_mut().enumerate() {
                if *until <= now {
                    *until = usize::MAX;
                    free.push(at);
                }
            }
        }
    }

    fn take(&mut self, mask: bool, until: usize) -> String {
        let (array, taken, free) = if mask {
            ("_m", &mut self.masks, &mut self.free_masks)
        } else {
            ("_s", &mut self.numbers, &mut self.free_numbers)
        };
        let at = free.pop().unwrap_or_else(|| {
            taken.push(0);
            taken.len() - 1
        });
        taken[at] = until;
        format!("{array}[{at}]")
    }
}
