//! Function bodies: short ones whole, long ones as chains of free functions.
//!
//! Input: steps. Output: the text of a body; a long one calls one function a part and hands values over
//! as arrays. Invariant: rustc sees no straight line of more than about [`LONGEST`] values in one
//! function, because its time grows faster than their number.

use super::function::{Body, BodyWriter};
use crate::emit::statements::block::{self, operand};
use crate::emit::statements::values::{Values, Wanted};
use crate::emit::steps::inline::{Binding, Inlined};
use crate::emit::steps::scan::{Scan, scan};
use crate::emit::steps::together::neighbours;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Instruction, Program, Step, Value};
use std::fmt::Write;
use std::ops::Range;

/// The longest straight line of values.
const LONGEST: usize = 1000;

/// Runs of steps of at most about [`LONGEST`] values each; a cosine stays with its sine.
fn cut(program: &Program, steps: &[Step]) -> Vec<Range<usize>> {
    let is_cosine = |step: &Step| match step {
        Step::Let(value) => matches!(program.instruction(*value), Instruction::PairedCos(_)),
        _ => false,
    };
    let mut parts = Vec::new();
    let (mut start, mut length) = (0, 0);
    for (at, step) in steps.iter().enumerate() {
        length += weight(program, step);
        if length >= LONGEST && !steps.get(at + 1).is_some_and(is_cosine) {
            parts.push(start..at + 1);
            (start, length) = (at + 1, 0);
        }
    }
    if length > 0 || parts.is_empty() {
        parts.push(start..steps.len());
    }
    parts
}

fn weight(program: &Program, step: &Step) -> usize {
    match step {
        Step::Loop(inner) => inner.body.iter().map(|step| weight(program, step)).sum(),
        Step::Let(value) if program.instruction(*value).is_number() => 0,
        _ => 1,
    }
}

impl BodyWriter<'_> {
    /// Writes a body after `let _self = …;`. Returns the texts of its `results`.
    pub fn write(&mut self, out: &mut String, body: Body) -> Vec<String> {
        let context = self.context;
        if cut(context.program, body.steps).len() > 1 {
            let steps = context.program.compact(body.steps);
            self.write_parts(out, body, &steps);
            return (body.results.iter().map(|value| operand(context, *value))).into_list();
        }
        let scan = scan(context, body.steps, body.results);
        // Preparation is done once, or once for each map.
        let together = match body.name.starts_with("prepare") {
            true => body.steps.to_vec(),
            false => neighbours(context, body.steps),
        };
        let mut slices = scan.slices;
        slices.extend(block::cleared(context, body.cleared));
        slices.extend(body.arrays);
        self.bind(out, body.receiver, slices);
        let mut inlined = Inlined::of(context, &together, body.results, &scan.reads);
        self.read(out, body.receiver, &scan.reads, &mut inlined);
        block::clear(out, context, body.cleared);
        let arithmetic = body.receiver.arithmetic();
        let inlined = block::write(out, context, arithmetic, &together, inlined);
        let text = |value: &Value| match inlined.text(*value, Binding::Whole) {
            Some(text) => text,
            None => operand(context, *value),
        };
        body.results.iter().map(text).into_list()
    }

    /// Writes a body as calls of its parts, and the parts.
    fn write_parts(&mut self, out: &mut String, body: Body, steps: &[Step]) {
        let context = self.context;
        let program = context.program;
        let parts = cut(program, steps);
        let scan = |steps, results| scan(context, steps, results);
        let mut scans: Vec<Scan> = parts
            .iter()
            .map(|part| scan(&steps[part.clone()], &[]))
            .into_list();
        scans.push(scan(&[], body.results));
        // The last part that reads a value; results are read after all parts.
        let mut last = vec![0usize; program.instructions.len()];
        for (at, scan) in scans.iter().enumerate() {
            for value in &scan.reads {
                last[value.0 as usize] = at;
            }
        }
        let mut earlier: Vec<Values> = Vec::with_capacity(parts.len());
        for (at, (part, scan)) in parts.iter().zip(&scans).enumerate() {
            let until = |value: &Value| last[value.0 as usize] > at;
            let given = Values::of(program, scan.computes.iter().copied().filter(until));
            let call = self.part(body, &steps[part.clone()], scan, &earlier, &given);
            let _ = match given.is_empty() {
                true => writeln!(out, "{call};"),
                false => writeln!(out, "let _g{at} = &{call};"),
            };
            earlier.push(given);
        }
        self.bind(out, body.receiver, body.arrays.to_vec());
        let wanted = scans.last().map_or(&[][..], |scan| &scan.reads);
        self.bind_live(out, body, wanted, &earlier);
    }

    /// Binds values that earlier parts and earlier stages computed. Returns the numbers of the parts
    /// whose live-outs were bound.
    fn bind_live(
        &self,
        out: &mut String,
        body: Body,
        wanted: &[Value],
        earlier: &[Values],
    ) -> Vec<usize> {
        let mut rest: Wanted = wanted.iter().map(|value| (*value, ())).collect();
        let (mut bound, mut none) = (Vec::new(), Inlined::default());
        for (number, live) in earlier.iter().enumerate() {
            let [numbers, masks] = [0, 1].map(|array| format!("_g{number}.{array}"));
            if live.bind(out, [&numbers, &masks], &mut rest, &mut none) {
                bound.push(number);
            }
        }
        let is_missing = |value: &Value| rest.contains_key(value);
        let earlier: Vec<Value> = wanted.iter().copied().filter(is_missing).into_list();
        self.read(out, body.receiver, &earlier, &mut none);
        bound
    }

    /// Writes a part as a function; the expression that calls it.
    fn part(
        &mut self,
        body: Body,
        steps: &[Step],
        scan: &Scan,
        earlier: &[Values],
        given: &Values,
    ) -> String {
        let mut text = String::new();
        let at = earlier.len();
        let mut slices = scan.slices.clone();
        if at == 0 {
            slices.extend(block::cleared(self.context, body.cleared));
        }
        self.bind(&mut text, body.receiver, slices);
        if at == 0 {
            block::clear(&mut text, self.context, body.cleared);
        }
        let bound = self.bind_live(&mut text, body, &scan.reads, earlier);
        let arithmetic = body.receiver.arithmetic();
        block::write(
            &mut text,
            self.context,
            arithmetic,
            steps,
            Inlined::default(),
        );
        let function = format!("__{}_{at}", body.name);
        let (mut declared, mut passed) = (String::new(), String::new());
        for (name, ty) in body.arguments {
            let _ = write!(declared, ", {name}: {ty}");
            let _ = write!(passed, ", {name}");
        }
        for number in bound {
            let _ = write!(declared, ", _g{number}: &{}", earlier[number].ty());
            let _ = write!(passed, ", _g{number}");
        }
        let result = match given.is_empty() {
            true => String::new(),
            false => {
                let _ = writeln!(text, "{}", given.make());
                format!(" -> {}", given.ty())
            }
        };
        let _ = write!(
            self.parts,
            "#[inline(always)]\n#[allow(clippy::too_many_arguments, clippy::type_complexity)]\n\
             fn {function}{}(_self: &{}{declared}){result} {{\n{text}}}\n",
            body.receiver.declaration(self.context),
            body.receiver.ty(self.context),
        );
        format!("<T as __h::Real>::out_of_line(#[inline(always)] || {function}(_self{passed}))")
    }
}
