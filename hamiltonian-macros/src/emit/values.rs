//! Values that one function hands to another: an earlier stage, or an earlier part of a long body.
//!
//! Input: values of a program. Output: the arrays they are handed on in, and the patterns that take
//! these apart. Invariant: arrays are taken apart by patterns, which cost rustc a hundredth of what as
//! many indices do.

use super::block::{name, names};
use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::program::{Program, Value};
use std::fmt::Write;

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

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.all().next().is_none()
    }

    /// The expression of the two arrays.
    pub fn make(&self) -> String {
        format!("([{}], [{}])", names(&self.numbers), names(&self.masks))
    }

    /// Its type.
    pub fn ty(&self) -> String {
        let (numbers, masks) = (self.numbers.len(), self.masks.len());
        format!("([T; {numbers}], [<T as __h::Real>::Mask; {masks}])")
    }

    /// Binds its values that are wanted, which are no longer wanted then, out of the two arrays. Whether
    /// there are any.
    pub fn bind(&self, out: &mut String, [numbers, masks]: [&str; 2], wanted: &mut Wanted) -> bool {
        bind(out, numbers, &self.numbers, wanted);
        bind(out, masks, &self.masks, wanted);
        let before = wanted.len();
        let own: Wanted = self.all().map(|value| (value, ())).collect();
        wanted.retain(|value| !own.contains_key(value));
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
