//! Functions with the numbers of a step coefficient.
//!
//! Input: a prepared system, a purpose, a coefficient. Output: [`Folded`]. Invariant: the numbers of the coefficient are
//! computed once.

use crate::machine::Arrays;
use crate::op::FunctionCode;
use crate::prepared::Prepared;
use crate::registers::{Home, Registers};
use hamiltonian_lanes::Real;
use hamiltonian_symbolic::program::Purpose;
use std::sync::Arc;

/// A function with the numbers of a step coefficient.
#[derive(Debug, Clone)]
pub(crate) struct Folded<T> {
    /// The function; `None` if there is none.
    pub(crate) function: Option<Arc<FunctionCode>>,
    /// Its number, which is there with it.
    number: Option<usize>,
    pub(crate) numbers: Vec<T>,
}

impl<T: Real> Folded<T> {
    pub(crate) fn new(prepared: &Prepared<T>, purpose: Purpose, c: T) -> Self {
        Folded {
            function: prepared.code.function(purpose).cloned(),
            number: prepared.code.number(purpose),
            numbers: prepared.folded(purpose, c),
        }
    }

    #[inline(always)]
    pub(crate) fn evaluate(&self, prepared: &Prepared<T>, arrays: Arrays<'_, T>) {
        if let Some(number) = self.number {
            prepared.evaluate(number, &self.numbers, arrays, &mut []);
        }
    }

    /// The same in these registers.
    #[inline(always)]
    pub(crate) fn evaluate_in(
        &self,
        registers: &mut Registers<T>,
        prepared: &Prepared<T>,
        arrays: Arrays<'_, T>,
    ) {
        if let Some(function) = &self.function {
            let home = Home::Own(registers);
            prepared.evaluate_in(home, function, &self.numbers, arrays, &mut []);
        }
    }
}
