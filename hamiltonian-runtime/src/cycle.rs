//! The flows of a step, one after the other in a frame.
//!
//! Input: the flows of a splitting, each with its time. Output: [`Cycle`], which makes many steps. Invariant: the
//! operations of the flows in their order, so the bits are theirs; the point stays in the registers of a [`CycleFrame`] from
//! step to step, and what flows hold is loaded once.

use crate::flow::{Inside, PartFlow};
use crate::frame::in_frame;
use crate::joined::{Joined, Joins, SEVERAL};
use crate::op::FunctionCode;
use crate::prepared::{Flat, Prepared};
use crate::registers::{FRAME, Frame};
use hamiltonian_core::schemes::author::{Point, Scratch};
use hamiltonian_lanes::Real;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// When a flow is applied.
#[derive(Debug, Clone, Copy)]
enum At<T> {
    /// This long after the beginning of the step.
    After(T),
    /// At its end.
    End,
}

/// A flow of the cycle.
#[derive(Debug, Clone)]
struct Call<T> {
    function: Arc<FunctionCode>,
    /// The number of the function.
    number: usize,
    at: At<T>,
    /// The numbers of the step coefficient, if other flows of the function have others.
    coefficients: Vec<T>,
}

impl<T> Call<T> {
    /// The function, its number, and that of its coefficients.
    fn joins(&self) -> Joins<'_> {
        Joins {
            number: self.number,
            framed: self.function.framed.as_ref(),
            coefficients: self.coefficients.len(),
        }
    }
}

/// The flows of a step: first those of its body, last the one that joins it to the next step.
#[derive(Debug, Clone)]
pub(crate) struct Cycle<T: Real> {
    calls: Vec<Call<T>>,
    /// All of them as one code, where they are short.
    joined: Option<Arc<Joined>>,
    /// Registers from these on, with the numbers that stay in them.
    held: Vec<(usize, Vec<T>)>,
    /// By which a frame knows whether it has these numbers.
    id: u64,
}

/// Registers of the runs of a [`Cycle`], allocated by the first step that needs them.
#[derive(Debug, Clone)]
pub struct CycleFrame<T: Real>(Option<Kept<T>>);

#[derive(Debug, Clone)]
struct Kept<T: Real> {
    frame: Frame<T>,
    /// The cycle whose numbers are loaded.
    id: u64,
}

impl<T: Real> Scratch<Point<Flat<T>>> for CycleFrame<T> {
    fn like(_: &Point<Flat<T>>) -> Self {
        CycleFrame(None)
    }
}

impl<T: Real> CycleFrame<T> {
    /// The registers, with the numbers of a cycle.
    #[inline(always)]
    fn of(&mut self, cycle: &Cycle<T>) -> &mut Kept<T> {
        if self.0.as_ref().is_none_or(|kept| kept.id != cycle.id) {
            self.load(cycle);
        }
        self.0.get_or_insert_with(Kept::new)
    }

    #[cold]
    fn load(&mut self, cycle: &Cycle<T>) {
        let kept = self.0.get_or_insert_with(Kept::new);
        for (first, numbers) in &cycle.held {
            kept.frame.numbers[*first..][..numbers.len()].copy_from_slice(numbers);
        }
        kept.id = cycle.id;
    }
}

impl<T: Real> Kept<T> {
    #[cold]
    fn new() -> Self {
        Kept {
            frame: Frame::new(),
            // The number of no cycle.
            id: 0,
        }
    }
}

impl<T: Real> Cycle<T> {
    /// The cycle of stages, each with the inner and the outer flow and their times after the beginning of the step; the last
    /// outer flow is applied at its end. `None` if a flow has no code in a frame.
    pub(crate) fn new<'a>(
        stages: impl Iterator<Item = (&'a Inside<T>, T, &'a PartFlow<T>, T)>,
    ) -> Option<Self>
    where
        T: 'a,
    {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        let mut calls: Vec<Call<T>> = Vec::new();
        let (mut width, mut cycles) = (0, None);
        let mut held: Vec<(usize, Vec<T>)> = Vec::new();
        for (inner, inner_at, outer, outer_at) in stages {
            // A body has a flow.
            inner.0.first()?;
            let inner = inner.0.iter().map(|flow| (flow, inner_at));
            for (flow, at) in inner.chain([(outer, outer_at)]) {
                if flow.beside.is_some() || flow.backward.is_some() {
                    return None;
                }
                let function = flow.folded.function.clone()?;
                let framed = function.framed.as_ref()?;
                let number = flow.number()?;
                let of: &Prepared<T> = &flow.prepared;
                width = of.code.places.len;
                cycles = Some(&of.code.cycles);
                if !calls.iter().any(|call| call.number == number) {
                    held.push((framed.first_held, of.held[number].framed.clone()));
                }
                let first = flow.folded.numbers.len().checked_sub(framed.coefficients)?;
                calls.push(Call {
                    number,
                    at: At::After(at),
                    coefficients: flow.folded.numbers[first..].to_vec(),
                    function: function.clone(),
                });
            }
        }
        calls.last_mut()?.at = At::End;
        // Those of the only flow of a function stay.
        for at in 0..calls.len() {
            let number = calls[at].number;
            if calls.iter().filter(|call| call.number == number).count() == 1 {
                let first = calls[at].function.framed.as_ref()?.first_coefficient;
                held.push((first, std::mem::take(&mut calls[at].coefficients)));
            }
        }
        let id = NEXT.fetch_add(1, Ordering::Relaxed);
        let joined = cycles?.of(width, &calls.iter().map(Call::joins).collect::<Vec<_>>());
        if let Some(joined) = &joined {
            let all = calls.iter().map(|call| call.coefficients.clone());
            held.extend(joined.coefficients.iter().copied().zip(all));
        }
        Some(Cycle {
            calls,
            joined,
            held,
            id,
        })
    }

    /// Makes steps up to number `end`, the last one without the flow that joins it to the next.
    #[inline(always)]
    pub(crate) fn go_on(
        &self,
        times: impl Fn(u64) -> T,
        (made, end): (u64, u64),
        z: &mut Point<Flat<T>>,
        frame: &mut CycleFrame<T>,
    ) {
        T::out_of_line(
            #[inline(always)]
            || self.go_on_here(times, (made, end), z, frame),
        );
    }

    #[inline(always)]
    fn go_on_here(
        &self,
        times: impl Fn(u64) -> T,
        (made, end): (u64, u64),
        z: &mut Point<Flat<T>>,
        frame: &mut CycleFrame<T>,
    ) {
        // The loop ends behind a step.
        if made >= end {
            return;
        }
        let frame = &mut frame.of(self).frame;
        let width = z.q.len();
        let numbers = &mut frame.numbers;
        numbers[..width].copy_from_slice(z.q.as_slice());
        numbers[width..2 * width].copy_from_slice(z.p.as_slice());
        let mut k = made;
        let mut next = 0;
        loop {
            let is_last = k + 1 == end;
            let (ops, t, is_made);
            let mut steps = 1;
            if let Some(joined) = &self.joined {
                ops = match is_last {
                    true => &joined.last,
                    false if end - k > SEVERAL && !joined.several.is_empty() => {
                        steps = SEVERAL;
                        &joined.several
                    }
                    false => &joined.one,
                };
                (t, is_made) = (T::zero(), true);
            } else {
                let call = &self.calls[next];
                let Some(framed) = &call.function.framed else {
                    break;
                };
                for (to, from) in (frame.numbers[framed.first_coefficient % FRAME[0]..].iter_mut())
                    .zip(&call.coefficients)
                {
                    *to = *from;
                }
                t = match (framed.reads_time, call.at) {
                    (false, _) => T::zero(),
                    (true, At::After(at)) => times(k) + at,
                    (true, At::End) => times(k + 1),
                };
                ops = &framed.ops;
                next += 1;
                is_made = next == self.calls.len() - usize::from(is_last);
            }
            in_frame(ops, t, frame);
            if is_made {
                next = 0;
                k += steps;
                if k == end {
                    break;
                }
            }
        }
        let numbers = &frame.numbers;
        z.q.as_mut_slice().copy_from_slice(&numbers[..width]);
        z.p.as_mut_slice()
            .copy_from_slice(&numbers[width..2 * width]);
    }
}
