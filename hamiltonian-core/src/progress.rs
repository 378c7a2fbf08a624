//! A progress bar (feature `progress`).
//!
//! Input: the number of steps a run is to make. Output: [`Progress`], an observer that moves a bar.
//! Invariant: it is shown states as every observer is, and changes no bit of the run.

use crate::checkpoint::Memory;
use crate::error::Error;
use crate::observe::{Observer, View};
use crate::system::System;
use core::ops::ControlFlow;
use hamiltonian_lanes::Real;
use indicatif::ProgressBar;

/// A progress bar over so many steps from where it is attached, moved about a thousand times.
///
/// It is finished less than a thousandth before the last of them. The bar of a run that ends before is
/// left as it stands; that of a saved run goes on where it stood. Its target and style are those of
/// the [`ProgressBar`] it is made of, [`Progress::with_bar`].
///
/// ```
#[doc = include_str!("doc/oscillator.md")]
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
    /// A bar over `steps` steps, on the standard error where that is a terminal.
    pub fn new(steps: u64) -> Self {
        Self::with_bar(steps, ProgressBar::new(steps))
    }

    /// The same with a bar of one's own.
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

    /// Moves it to where the run stands.
    fn place(&self, step: u64) {
        let made = step.saturating_sub(self.first);
        if self.steps.saturating_sub(made) >= self.interval {
            self.bar.set_position(made);
        } else if !self.bar.is_finished() {
            self.bar.finish();
        }
    }
}

impl<T: Real, S: System<T>> Observer<T, S> for Progress {
    fn interval(&self) -> u64 {
        self.interval
    }
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.first = view.step;
        self.bar.reset();
        ControlFlow::Continue(())
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.place(view.step);
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
