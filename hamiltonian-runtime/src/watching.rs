//! The observer of a run by name: events, and the question whether to stop.
//!
//! Input: the states of a run. Output: located events; the end of the run if a hook asks for it. Invariant: the hook changes
//! no bit of a run that goes on.

use crate::prepared::Flat;
use crate::system::RuntimeSystem;
use hamiltonian_core::observers::{Events, Memory};

use hamiltonian_core::{Error, Observer, State, View};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A function that says whether to stop.
type Cancel = Arc<dyn Fn() -> bool + Send + Sync>;

/// A cancel hook, and whether it has stopped the current call.
#[derive(Default)]
pub(crate) struct Hook {
    cancel: Mutex<Option<Cancel>>,
    stopped: AtomicBool,
}

impl Hook {
    /// The steps between two questions, for this many degrees of freedom: few of long steps.
    pub(crate) fn interval(degrees_of_freedom: usize) -> u64 {
        (16_384 / degrees_of_freedom.max(1) as u64).clamp(1, 1024)
    }

    pub(crate) fn set(&self, cancel: impl Fn() -> bool + Send + Sync + 'static) {
        *self.cancel.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::new(cancel));
    }

    /// True if there is a function to ask.
    pub(crate) fn is_set(&self) -> bool {
        let cancel = self.cancel.lock().unwrap_or_else(PoisonError::into_inner);
        cancel.is_some()
    }

    /// Asks whether to stop.
    pub(crate) fn stops(&self) -> bool {
        let cancel = self.cancel.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(cancel) = cancel.clone() else {
            return false;
        };
        let stops = cancel();
        if stops {
            self.stopped.store(true, Ordering::Relaxed);
        }
        stops
    }

    /// Returns true, once, if the hook has stopped the call.
    pub(crate) fn take(&self) -> bool {
        self.stopped.swap(false, Ordering::Relaxed)
    }
}

/// Locates events, and ends the run if the hook asks for it.
pub(crate) struct Watching {
    pub(crate) events: Option<Events<Flat<f64>>>,
    pub(crate) hook: Arc<Hook>,
    /// The steps between two questions to the hook.
    pub(crate) every: u64,
}

type Seen<'a> = View<'a, f64, RuntimeSystem>;

impl Observer<f64, RuntimeSystem> for Watching {
    fn interval(&self) -> u64 {
        match self.events {
            Some(_) => 1,
            None => self.every,
        }
    }
    fn attach(&mut self, view: &Seen<'_>) -> ControlFlow<()> {
        match &mut self.events {
            Some(events) => events.attach(view),
            None => ControlFlow::Continue(()),
        }
    }
    fn observe(&mut self, view: &Seen<'_>) -> ControlFlow<()> {
        if let Some(events) = &mut self.events {
            events.observe(view)?;
        }
        match view.steps.is_multiple_of(self.every) && self.hook.stops() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
    fn change(&mut self, from: &Seen<'_>, to: &Seen<'_>) {
        if let Some(events) = &mut self.events {
            events.change(from, to);
        }
    }
    fn save(&self, to: &mut Memory) {
        if let Some(events) = &self.events {
            Observer::<f64, RuntimeSystem>::save(events, to);
        }
    }
    fn restore(&mut self, view: &Seen<'_>, from: &mut Memory) -> Result<(), Error> {
        match &mut self.events {
            Some(events) => events.restore(view, from),
            None => Ok(()),
        }
    }
    fn end(&self) -> Result<Option<&State<Flat<f64>>>, Error> {
        match &self.events {
            Some(events) => Observer::<f64, RuntimeSystem>::end(events),
            None => Ok(None),
        }
    }
}
