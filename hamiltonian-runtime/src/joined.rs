//! The flows of a step as one code.
//!
//! Input: the flows of a step in frames. Output: [`Joined`], which [`Cycles`] keeps for all scalars and parameters. Invariant:
//! the operations of the flows, each after those whose results it reads, so the bits are theirs.
//!
//! A flow of few operations takes less time than to find it and to lay its coefficients.

use crate::allocate::registers;
use crate::chain::{CHAINED, chained, forwarded, renamed};
use crate::op::{Framed, Op, Register};
use crate::registers::FRAME;
use std::sync::{Arc, Mutex, PoisonError};

/// The most operations of such a code, which should stay in the nearest cache.
const LONGEST: usize = 1024;

/// The number of steps that are one code where they are short.
pub(crate) const SEVERAL: u64 = 4;
/// The most operations of a step of which so many are.
const SHORT: usize = 64;

/// A flow of the step.
#[derive(Clone, Copy)]
pub(crate) struct Joins<'a> {
    /// The number of its function.
    pub(crate) number: usize,
    pub(crate) framed: Option<&'a Framed>,
    /// The number of its coefficients that other flows of the function do not share.
    pub(crate) coefficients: usize,
}

/// The flows of a step as one code, which has a register for each coefficient of each flow.
#[derive(Debug)]
pub(crate) struct Joined {
    /// Several steps, if they are short.
    pub(crate) several: Vec<Op>,
    pub(crate) one: Vec<Op>,
    /// The step without the flow that joins it to the next.
    pub(crate) last: Vec<Op>,
    /// The first register of the coefficients of each flow.
    pub(crate) coefficients: Vec<usize>,
}

/// The numbers of the functions of a step, and their code, if there is one.
type Known = (Vec<usize>, Option<Arc<Joined>>);

/// The codes of the steps of a system, by the numbers of the functions of their flows.
#[derive(Debug, Default)]
pub(crate) struct Cycles(Mutex<Vec<Known>>);

/// They follow from the code of the system.
impl PartialEq for Cycles {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Cycles {
    /// The code of flows that move points of this width. `None` for code that is long, that reads the time, or that needs more
    /// registers than a frame has.
    pub(crate) fn of(&self, width: usize, flows: &[Joins<'_>]) -> Option<Arc<Joined>> {
        let numbers: Vec<usize> = flows.iter().map(|flow| flow.number).collect();
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, joined)) = known.iter().find(|(of, _)| *of == numbers) {
            return joined.clone();
        }
        let joined = join(width, flows).map(Arc::new);
        known.push((numbers, joined.clone()));
        joined
    }
}

fn join(width: usize, flows: &[Joins<'_>]) -> Option<Joined> {
    let (mut ops, mut coefficients) = (Vec::new(), Vec::new());
    let (mut free, mut of_last_step, mut is_laid) = (0, 0, false);
    for flow in flows {
        free = free.max(flow.framed?.registers);
    }
    for flow in flows {
        of_last_step = ops.len();
        let (framed, count) = (flow.framed?, flow.coefficients);
        is_laid |= framed.is_laid;
        if framed.reads_time || free + count > FRAME[0] || ops.len() + framed.ops.len() > LONGEST {
            return None;
        }
        let first = framed.first_coefficient;
        for op in &framed.ops {
            let mut op = *op;
            registers(&mut op, &mut |register, class| {
                let at = *register as usize;
                if class == 0 && (first..first + count).contains(&at) {
                    *register = (free + at - first) as Register;
                }
            });
            ops.push(op);
        }
        coefficients.push(free);
        free += count;
    }
    let is_short = ops.len() <= CHAINED && !is_laid;
    let laid = |ops: &[Op]| match is_short {
        true => forwarded(&chained(&renamed(ops, 2 * width, free))),
        false => ops.to_vec(),
    };
    let several = match is_short && ops.len() <= SHORT {
        true => laid(&ops.repeat(SEVERAL as usize)),
        false => Vec::new(),
    };
    Some(Joined {
        several,
        one: laid(&ops),
        last: laid(&ops[..of_last_step]),
        coefficients,
    })
}
