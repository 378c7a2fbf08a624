//! Values that one function hands to another: an earlier stage, or an earlier part of a long body.
//!
//! Input: values of a program. Output: the arrays they are handed on in, and the patterns that take
//! these apart. Invariant: arrays are taken apart by patterns, which cost rustc a hundredth of what as
//! many indices do.

use super::block::{name, names};
use crate::emit::steps::inline::{Binding, Inlined};
use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::list::IntoList;
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

    /// Binds its values that are wanted, which are no longer wanted then, out of the two arrays. A few that are used once
    /// stand where they are used. Returns true if there are any.
    pub fn bind(
        &self,
        out: &mut String,
        arrays: [&str; 2],
        wanted: &mut Wanted,
        inlined: &mut Inlined,
    ) -> bool {
        const FEW: usize = 2;
        for (array, values) in arrays.into_iter().zip([&self.numbers, &self.masks]) {
            let is_wanted = |at: &usize| wanted.contains_key(&values[*at]);
            let mut own: Vec<usize> = (0..values.len()).filter(is_wanted).into_list();
            let element = |at: usize| format!("{array}[{at}]");
            if own.len() <= FEW {
                own.retain(|at| !inlined.take(values[*at], Binding::Atom, &element(*at)));
            }
            let (Some(&first), Some(&last)) = (own.first(), own.last()) else {
                continue;
            };
            let name = |at: usize| match own.binary_search(&at) {
                Ok(_) => name(values[at]),
                Err(_) => "_".to_owned(),
            };
            let names: Vec<String> = (first..=last).map(name).into_list();
            let pattern = names.join(", ");
            let _ = match names.len() {
                1 => writeln!(out, "let {pattern} = {};", element(first)),
                length if length == values.len() => writeln!(out, "let [{pattern}] = {array};"),
                _ => writeln!(out, "let [{pattern}] = *__h::window(&{array}, {first});"),
            };
        }
        let before = wanted.len();
        let own: Wanted = self.all().map(|value| (value, ())).collect();
        wanted.retain(|value| !own.contains_key(value));
        wanted.len() < before
    }
}
