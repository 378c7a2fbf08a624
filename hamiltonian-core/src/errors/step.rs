//! Errors of a step.

use super::words::{Lane, Number, Numbers, Within};
use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why a step failed. The run stays at the state before that step.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// The step led to a NaN or an infinity: a number grew beyond all bounds, the exact flow of a
    /// piece left its domain, or H is not defined at the end of the step.
    #[non_exhaustive]
    NotFinite {
        /// The number of the step, counted from 1: the first whose end is not finite.
        step: u64,
        /// H at the end of the step, if only H is not finite there.
        energy: Option<f64>,
        /// The piece of H whose flow led there, if the scheme is a splitting.
        piece: Option<Box<str>>,
        /// The first lane in which it happened, if the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The time at the end of that step.
        time: f64,
        /// The coordinates there.
        q: Box<[f64]>,
        /// The momenta there.
        p: Box<[f64]>,
    },
    /// The equations of an implicit step were not solved.
    #[non_exhaustive]
    Unsolved {
        /// The number of the step, counted from 1.
        step: u64,
        /// The first lane that was not solved, if the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The time at its beginning.
        time: f64,
        /// The last change of the iterate, in the sum norm.
        residual: f64,
        /// The number of iterations made.
        iterations: u32,
    },
    /// The estimated error of a step was above the tolerance, or its ends did not fit together, for every size that moves the
    /// time, as at a collision.
    #[non_exhaustive]
    Refused {
        /// The number of the step, counted from 1.
        step: u64,
        /// The first lane that was refused, if the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time.
        clock: Box<str>,
        /// The time at its beginning.
        time: f64,
        /// The relative tolerance.
        relative: f64,
        /// The absolute tolerance.
        absolute: f64,
    },
    /// H jumps at the end of the run so far: no step to a tolerance leads across.
    #[non_exhaustive]
    Jumped {
        /// The number of the step, counted from 1.
        step: u64,
        /// The first lane that was refused, if the scalar has several.
        lane: Option<u32>,
        /// The name of the run's time.
        clock: Box<str>,
        /// The time at its beginning.
        time: f64,
        /// H before the jump.
        before: f64,
        /// H after it.
        after: f64,
    },
}

impl Display for StepError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite {
                step,
                energy: Some(energy),
                lane,
                clock,
                time,
                q,
                p,
                ..
            } => write!(
                f,
                "step {step} led to a state at which H is {energy}{}: {clock} = {}, q = {}, p = {}; \
                 end the run before it leaves the domain of H, or take shorter steps if the orbit \
                 stays inside",
                Lane(*lane),
                Number(*time),
                Numbers(q),
                Numbers(p)
            ),
            Self::NotFinite {
                step,
                energy: None,
                piece,
                lane,
                clock,
                time,
                q,
                p,
            } => write!(
                f,
                "step {step} led to a state that is not finite{}{}: {clock} = {}, q = {}, p = {}",
                Within(piece),
                Lane(*lane),
                Number(*time),
                Numbers(q),
                Numbers(p)
            ),
            Self::Unsolved {
                step,
                lane,
                clock,
                time,
                residual,
                iterations,
            } => write!(
                f,
                "step {step} from {clock} = {} was not solved{}: residual {residual:e} after \
                 {iterations} iterations; a shorter step, or more iterations, may solve it",
                Number(*time),
                Lane(*lane)
            ),
            Self::Refused {
                step,
                lane,
                clock,
                time,
                relative,
                absolute,
            } => write!(
                f,
                "step {step} from {clock} = {} was refused{}: its estimated error is above the tolerance, {relative:e} \
                 relative and {absolute:e} absolute, for every size that moves {clock}; end the run before the \
                 singularity of H, or at an event where its gradient jumps, or raise the tolerance",
                Number(*time),
                Lane(*lane)
            ),
            Self::Jumped {
                step,
                lane,
                clock,
                time,
                before,
                after,
            } => write!(
                f,
                "step {step} from {clock} = {} was refused{}: H jumps there, from {before} to {after}, and has no \
                 gradient; end the run at an event there and start another one beyond it, or make H continuous",
                Number(*time),
                Lane(*lane)
            ),
        }
    }
}

impl core::error::Error for StepError {}
