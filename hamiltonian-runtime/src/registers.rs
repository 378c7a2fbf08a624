//! The registers of flat code.
//!
//! Input: a scalar. Output: [`Registers`], a [`Pool`] of them, and [`Frame`]. Invariant: they are allocated once; of short code
//! and of a frame there are fixed numbers of them.

use crate::op::Stage;
use hamiltonian_lanes::{Mask, Real};
use std::sync::{Arc, Mutex, PoisonError};

/// The registers of a frame, and those of conditions: powers of two, as those of short code.
pub(crate) const FRAME: [usize; 2] = [256, 16];

/// The registers of short code without loops, a power of two so that a masked number of a register is one of them, and those
/// of conditions.
pub(crate) const SHORT: [usize; 2] = [32, 8];

/// Registers that are kept from call to call, so that they are neither allocated nor cleared.
#[derive(Debug, Clone)]
pub struct Registers<T: Real> {
    pub(crate) numbers: Box<[T; SHORT[0]]>,
    pub(crate) masks: Box<[T::Mask; SHORT[1]]>,
    /// Those of longer code.
    pub(crate) long: (Vec<T>, Vec<T::Mask>),
    /// Those of code in a frame, with the numbers of the functions whose numbers they hold.
    frame: Option<(Frame<T>, Vec<usize>)>,
}

/// The registers of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Frame<T: Real> {
    pub(crate) numbers: Box<[T; FRAME[0]]>,
    pub(crate) masks: Box<[T::Mask; FRAME[1]]>,
}

impl<T: Real> Frame<T> {
    #[cold]
    pub(crate) fn new() -> Self {
        let numbers = vec![T::zero(); FRAME[0]].into_boxed_slice();
        let masks = vec![T::Mask::splat(false); FRAME[1]].into_boxed_slice();
        let (Ok(numbers), Ok(masks)) = (numbers.try_into(), masks.try_into()) else {
            unreachable!("as many as were made a line before")
        };
        Frame { numbers, masks }
    }
}

impl<T: Real> Registers<T> {
    pub(crate) fn new() -> Self {
        Registers {
            numbers: Box::new([T::zero(); SHORT[0]]),
            masks: Box::new([T::Mask::splat(false); SHORT[1]]),
            long: (Vec::new(), Vec::new()),
            frame: None,
        }
    }

    /// The frame, with the numbers of the functions whose numbers it holds.
    #[inline(always)]
    pub(crate) fn framed(&mut self) -> &mut (Frame<T>, Vec<usize>) {
        self.frame.get_or_insert_with(|| (Frame::new(), Vec::new()))
    }

    /// As many as longer code has.
    #[cold]
    pub(crate) fn grow(&mut self, stage: &Stage) {
        let (numbers, masks) = &mut self.long;
        numbers.resize(numbers.len().max(stage.registers), T::zero());
        masks.resize(masks.len().max(stage.masks), T::Mask::splat(false));
    }
}

/// Registers for evaluations that have none of their own.
#[derive(Debug)]
pub(crate) struct Pool<T: Real>(Arc<Mutex<Vec<Registers<T>>>>);

impl<T: Real> Pool<T> {
    pub(crate) fn new() -> Self {
        Pool(Arc::new(Mutex::new(Vec::new())))
    }

    #[cold]
    pub(crate) fn take(&self) -> Registers<T> {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        kept.unwrap_or_else(Registers::new)
    }

    #[cold]
    pub(crate) fn give(&self, registers: Registers<T>) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push(registers);
    }
}

impl<T: Real> Clone for Pool<T> {
    fn clone(&self) -> Self {
        Pool(self.0.clone())
    }
}

/// Where the registers of a call are.
pub(crate) enum Home<'a, T: Real> {
    /// Those of a flow.
    Own(&'a mut Registers<T>),
    /// On the stack for short code, otherwise taken from a pool.
    Pool(&'a Pool<T>),
}
