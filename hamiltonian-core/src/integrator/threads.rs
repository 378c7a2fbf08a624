//! The threads of a run.
//!
//! Input: a number of threads, and steps. Output: the steps, made on one of the threads, which the loops of
//! `slabs` share. Invariant: a run that starts no threads makes the same steps by itself.

use super::advance::Steps;
use crate::map::Map;
use alloc::sync::Arc;

/// The threads of a run, and its steps among them.
pub(crate) struct Threads<R: Map> {
    pool: Arc<rayon_core::ThreadPool>,
    /// [`Steps::make`] on one of the threads. The bounds here state that the map is `Sync`.
    make: fn(&rayon_core::ThreadPool, Steps<'_, R>) -> bool,
}

impl<R: Map> Clone for Threads<R> {
    fn clone(&self) -> Self {
        Threads {
            pool: Arc::clone(&self.pool),
            make: self.make,
        }
    }
}

impl<R: Map<Work: Send> + Sync> Threads<R> {
    /// Starts the threads; returns `None` for fewer than two, or if the system cannot start them.
    pub(crate) fn new(number: usize) -> Option<Self> {
        // As for members of ensembles: memory that is not written is not used.
        const STACK: usize = 64 << 20;
        if number < 2 {
            return None;
        }
        let builder = rayon_core::ThreadPoolBuilder::new()
            .num_threads(number)
            .stack_size(STACK);
        Some(Threads {
            pool: Arc::new(builder.build().ok()?),
            make: |pool, steps| pool.install(|| steps.make()),
        })
    }
}

impl<R: Map> Threads<R> {
    /// Their number.
    pub(crate) fn number(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Makes the steps on the threads. Returns true if everything is finite after them.
    pub(crate) fn make(&self, steps: Steps<'_, R>) -> bool {
        (self.make)(&self.pool, steps)
    }
}
