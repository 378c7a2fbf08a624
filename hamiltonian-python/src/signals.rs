//! Ctrl-C while the interpreter's lock is released.
//!
//! Input: the question of a run whether to stop. Output: yes, if a signal handler has raised an exception, which is kept.

use pyo3::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The shortest time between two calls of the interpreter, whose lock another thread may hold.
const PAUSE: Duration = Duration::from_millis(50);

/// The exception of a signal handler, such as `KeyboardInterrupt`.
#[derive(Clone, Default)]
pub struct Signals {
    raised: Arc<Mutex<Option<PyErr>>>,
}

impl Signals {
    /// A hook that asks the interpreter for signals, at most twenty times a second.
    pub fn hook(&self) -> impl Fn() -> bool + Send + Sync + use<> {
        let raised = self.raised.clone();
        let last = Mutex::new(Instant::now());
        move || {
            // A callback has failed.
            if raised
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .is_some()
            {
                return true;
            }
            let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
            if last.elapsed() < PAUSE {
                return false;
            }
            *last = Instant::now();
            match Python::attach(|py| py.check_signals()) {
                Ok(()) => false,
                Err(error) => {
                    *raised.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                    true
                }
            }
        }
    }

    /// Keeps an exception of a callback.
    pub fn keep(&self, error: PyErr) {
        *self.raised.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    }

    /// The exception, once.
    pub fn take(&self) -> Option<PyErr> {
        self.raised
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take()
    }
}
