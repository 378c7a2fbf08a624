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

/// Values that a part hands on: numbers in one array, masks in another.
#[derive(Debug)]
struct LiveOuts {
    numbers: Vec<Value>,
    masks: Vec<Value>,
}

impl LiveOuts {
    fn of(program: &Program, values: impl Iterator<Item = Value>) -> LiveOuts {
        let (masks, numbers) = values.partition(|value| program.instruction(*value).is_mask());
        LiveOuts { numbers, masks }
    }
    fn is_empty(&self) -> bool {
        self.numbers.is_empty() && self.masks.is_empty()
    }
    fn has(&self, wanted: &Wanted) -> bool {
        let mut values = self.numbers.iter().chain(&self.masks);
        values.any(|value| wanted.contains_key(value))
    }
    fn make(&self) -> String {
        format!("([{}], [{}])", names(&self.numbers), names(&self.masks))
    }
    fn ty(&self) -> String {
        let (numbers, masks) = (self.numbers.len(), self.masks.len());
        format!("([T; {numbers}], [<T as __h::Real>::Mask; {masks}])")
    }
    /// Binds those of its values that are wanted.
    fn bind(&self, out: &mut String, name: &str, wanted: &Wanted) {
        bind(out, &format!("{name}.0"), &self.numbers, wanted);
        bind(out, &format!("{name}.1"), &self.masks, wanted);
    }
}

/// Binds the `wanted` elements of the array of `values` that stands in `place`.
pub fn bind(out: &mut String, place: &str, values: &[Value], wanted: &Wanted) {
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
        // The last part that reads a value; what is returned is read after all.
        let mut last = vec![0usize; program.instructions.len()];
        for (at, scan) in scans.iter().enumerate() {
            for value in &scan.reads {
                last[value.0 as usize] = at;
            }
        }
        let mut earlier: Vec<LiveOuts> = Vec::with_capacity(parts.len());
        for (at, (part, scan)) in parts.iter().zip(&scans).enumerate() {
            let until = |value: &Value| last[value.0 as usize] > at;
            let given = LiveOuts::of(program, scan.computes.iter().copied().filter(until));
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

    /// Binds what was computed by earlier parts and by earlier stages. Returns the
    /// numbers of the parts whose live-outs were bound.
    fn bind_live(
        &self,
        out: &mut String,
        body: Body,
        wanted: &[Value],
        earlier: &[LiveOuts],
    ) -> Vec<usize> {
        let mut rest: Wanted = wanted.iter().map(|value| (*value, ())).collect();
        let mut bound = Vec::new();
        for (number, live) in earlier.iter().enumerate() {
            if live.has(&rest) {
                live.bind(out, &format!("_g{number}"), &rest);
                for value in live.numbers.iter().chain(&live.masks) {
                    rest.remove(value);
                }
                bound.push(number);
            }
        }
        let earlier: Vec<Value> = wanted
            .iter()
            .copied()
            .filter(|value| rest.contains_key(value))
            .collect();
        self.read(out, body.receiver, &earlier);
        bound
    }

    /// Writes a part as a function; the expression that calls it.
    fn part(
        &mut self,
        body: Body,
        steps: &[Step],
        scan: &Scan,
        earlier: &[LiveOuts],
        given: &LiveOuts,
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
