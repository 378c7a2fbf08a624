//! A progress bar (feature `progress`).
//!
//! Input: the number of steps of a run. Output: [`Progress`], an observer that moves a bar.
//! Invariant: like every observer, it does not affect the run.

use crate::errors::Error;
use crate::observers::observe::{Observer, View};
use crate::results::checkpoint::Memory;
use crate::systems::system::System;
use core::ops::ControlFlow;
use hamiltonian_lanes::Real;
use indicatif::ProgressBar;

/// A progress bar over a number of steps, counted from the step at which it is attached. It moves about a thousand times.
///
/// The bar is full less than a thousandth before the last step. If the run ends earlier, the bar stays as it is. The bar
/// of a resumed run continues. [`Progress::with_bar`] takes a [`ProgressBar`] with a target and a style of your own.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?
///     .observe(Progress::new(100_000));
/// run.advance(100_000)?;
/// assert!(run.observer().bar().is_finished());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Progress {
    bar: ProgressBar,
    steps: u64,
    interval: u64,
    /// The step at which it was attached.
    first: u64,
}

impl Progress {
    /// Creates a bar over `steps` steps, on the standard error if that is a terminal.
    pub fn new(steps: u64) -> Self {
        Self::with_bar(steps, ProgressBar::new(steps))
    }

    /// Creates an observer that moves a bar of your own.
    pub fn with_bar(steps: u64, bar: ProgressBar) -> Self {
        bar.set_length(steps);
        Progress {
            bar,
            steps,
            interval: (steps / 1000).max(1),
            first: 0,
        }
    }

    /// The bar.
    pub fn bar(&self) -> &ProgressBar {
        &self.bar
    }

    /// Moves the bar to the position of the run.
    fn place(&self, step: u64) {
        let made = step.saturating_sub(self.first);
        if self.steps.saturating_sub(made) >= self.interval {
            self.bar.set_position(made);
        } else if !self.bar.is_finished() {
            self.bar.finish();
        }
    }
}

impl<T: Real, S: System> Observer<T, S> for Progress {
    fn interval(&self) -> u64 {
        self.interval
    }
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.first = view.steps;
        self.bar.reset();
        ControlFlow::Continue(())
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.place(view.steps);
        ControlFlow::Continue(())
    }
    fn save(&self, to: &mut Memory) {
        to.begin("Progress");
        to.count(self.first);
    }
    fn restore(&mut self, _: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("Progress")?;
        self.first = from.read_count()?;
        Ok(())
    }
}
