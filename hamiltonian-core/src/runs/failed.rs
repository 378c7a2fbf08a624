//! The place of a failed step, without its cause ([`StepError`] has both).

use crate::errors::StepError;
use crate::flows::map::Cause;
use alloc::boxed::Box;
use alloc::vec::Vec;

/// The place of a failed step: an error without its cause.
pub(crate) struct Failed {
    /// The number of the step, counted from 1.
    pub(crate) step: u64,
    /// The first lane in which it failed, if the scalar has several.
    pub(crate) lane: Option<u32>,
    /// The name of the run's time.
    pub(crate) clock: Box<str>,
    /// The time at its beginning.
    pub(crate) begin: f64,
    /// The time at its end.
    pub(crate) end: f64,
    /// The coordinates at its end.
    pub(crate) q: Vec<f64>,
    /// The momenta at its end.
    pub(crate) p: Vec<f64>,
    /// H at its end, if only H is not finite there.
    pub(crate) energy: Option<f64>,
}

impl Failed {
    /// The error of a step with this cause.
    pub(crate) fn because(self, cause: Cause) -> StepError {
        let Failed {
            step, lane, clock, ..
        } = self;
        // All numbers of the step are finite.
        let cause = match self.energy {
            Some(_) => Cause::Overflow,
            None => cause,
        };
        match cause {
            Cause::Unsolved {
                residual,
                iterations,
            } => StepError::Unsolved {
                step,
                lane,
                clock,
                time: self.begin,
                residual,
                iterations,
            },
            Cause::Refused { relative, absolute } => StepError::Refused {
                step,
                lane,
                clock,
                time: self.begin,
                relative,
                absolute,
            },
            Cause::Jumped { before, after } => StepError::Jumped {
                step,
                lane,
                clock,
                time: self.begin,
                before,
                after,
            },
            Cause::Overflow | Cause::Piece(_) => StepError::NotFinite {
                step,
                energy: self.energy,
                piece: match cause {
                    Cause::Piece(name) => Some(name.into()),
                    _ => None,
                },
                lane,
                clock,
                time: self.end,
                q: self.q.into(),
                p: self.p.into(),
            },
        }
    }
}
