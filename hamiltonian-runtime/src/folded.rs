//! Functions with the numbers of a step coefficient.
//!
//! Input: a prepared system, a purpose, a coefficient. Output: [`Folded`]. Invariant: the numbers of the coefficient are
//! computed once.

use crate::machine::{Arrays, Home};
use crate::op::FunctionCode;
use crate::prepared::Prepared;
use hamiltonian_lanes::Real;
use hamiltonian_symbolic::program::Purpose;
use std::sync::Arc;

/// A function with the numbers of a step coefficient.
#[derive(Debug, Clone)]
pub(crate) struct Folded<T> {
    /// The function; `None` if there is none.
    pub(crate) function: Option<Arc<FunctionCode>>,
    pub(crate) numbers: Vec<T>,
}

impl<T: Real> Folded<T> {
    pub(crate) fn new(prepared: &Prepared<T>, purpose: Purpose, c: T) -> Self {
        Folded {
            function: prepared.code.function(purpose).cloned(),
            numbers: prepared.folded(purpose, c),
        }
    }

    #[inline(always)]
    pub(crate) fn evaluate(
        &self,
        prepared: &Prepared<T>,
        home: Home<'_, T>,
        arrays: Arrays<'_, T>,
    ) {
        if let Some(function) = &self.function {
            prepared.evaluate_in(home, function, &self.numbers, arrays, &mut []);
        }
    }
}
