//! Long bodies as chains of free functions.
//!
//! Input: steps. Output: the text of a body that calls one function a part and hands values over
//! as arrays, and the functions. Invariant: rustc sees no straight line of more than about
//! [`LONGEST`] values in one function, because its time grows faster than their number; arrays are
//! taken apart by patterns, which cost it a hundredth of what as many indices do.

use super::block::{self, name, names};
use super::function::{Bodies, Body};
use super::scan::{Scan, scan};
use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::program::{Instruction, Program, Step, Value};
use std::fmt::Write;
use std::ops::Range;

/// The longest straight line of values.
const LONGEST: usize = 1000;

/// Runs of steps of at most about [`LONGEST`] values each; a cosine stays with its sine.
pub fn cut(program: &Program, steps: &[Step]) -> Vec<Range<usize>> {
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

/// A set of values.
pub type Wanted = Map<Value, ()>;

/// Values that are handed on: numbers in one array, masks in another.
#[derive(Debug)]
pub struct Values {
    /// The numbers.
    pub numbers: Vec<Value>,
    /// The masks.
    pub masks: Vec<Value>,
}

impl Values {
    /// Sorts values into the two arrays.
    pub fn of(program: &Program, values: impl Iterator<Item = Value>) -> Values {
        let (masks, numbers) = values.partition(|value| program.instruction(*value).is_mask());
        Values { numbers, masks }
    }

    /// All values, in the order of the arrays.
    pub fn all(&self) -> impl Iterator<Item = Value> + '_ {
        self.numbers.iter().chain(&self.masks).copied()
    }

    fn is_empty(&self) -> bool {
        self.all().next().is_none()
    }

    fn make(&self) -> String {
        format!("([{}], [{}])", names(&self.numbers), names(&self.masks))
    }

    fn ty(&self) -> String {
        let (numbers, masks) = (self.numbers.len(), self.masks.len());
        format!("([T; {numbers}], [<T as __h::Real>::Mask; {masks}])")
    }

    /// Binds its values that are wanted, which are no longer wanted then, out of the two arrays. Whether
    /// there are any.
    pub fn bind(&self, out: &mut String, [numbers, masks]: [&str; 2], wanted: &mut Wanted) -> bool {
        bind(out, numbers, &self.numbers, wanted);
        bind(out, masks, &self.masks, wanted);
        let before = wanted.len();
        for value in self.all() {
            wanted.remove(&value);
        }
        wanted.len() < before
    }
}

/// Binds the `wanted` elements of the array of `values` that stands in `place`.
fn bind(out: &mut String, place: &str, values: &[Value], wanted: &Wanted) {
    let is_wanted = |value: &Value| wanted.contains_key(value);
    let (Some(first), Some(last)) = (
        values.iter().position(is_wanted),
        values.iter().rposition(is_wanted),
    ) else {
        return;
    };
    let element = |value: &Value| match is_wanted(value) {
        true => name(*value),
        false => "_".to_owned(),
    };
    let names: Vec<String> = values[first..=last].iter().map(element).collect();
    let pattern = names.join(", ");
    let _ = match names.len() {
        1 => writeln!(out, "let {pattern} = {place}[{first}];"),
        length if length == values.len() => writeln!(out, "let [{pattern}] = {place};"),
        _ => writeln!(out, "let [{pattern}] = *__h::window(&{place}, {first});"),
    };
}

impl Bodies<'_> {
    /// Writes a body as calls of its parts, and the parts.
    pub(super) fn write_parts(&mut self, out: &mut String, body: Body, steps: &[Step]) {
        let context = self.context;
        let program = context.program;
        let parts = cut(program, steps);
        let scan = |steps, results| scan(context, steps, results);
        let mut scans: Vec<Scan> = parts
            .iter()
            .map(|part| scan(&steps[part.clone()], &[]))
            .collect();
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
        let mut bound = Vec::new();
        for (number, live) in earlier.iter().enumerate() {
            let arrays = [format!("_g{number}.0"), format!("_g{number}.1")];
            if live.bind(out, arrays.each_ref().map(String::as_str), &mut rest) {
                bound.push(number);
            }
        }
        let is_missing = |value: &Value| rest.contains_key(value);
        let earlier: Vec<Value> = wanted.iter().copied().filter(is_missing).collect();
        self.read(out, body.receiver, &earlier);
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
        block::write(&mut text, self.context, steps);
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
        format!("<T as __h::Real>::out_of_line(|| {function}(_self{passed}))")
    }
}
