//! The threads of a run.
//!
//! Input: a number of threads, and steps. Output: the steps, made on one of the threads, which the loops of
//! `slabs` share. Invariants: a run that starts no threads makes the same steps by itself; within a rayon pool, the
//! threads are those of the pool.

use super::advance::Steps;
use crate::flows::map::Map;
use alloc::sync::Arc;

/// The threads of a run, and its steps among them.
pub(crate) struct Threads<R: Map> {
    /// `None` if they are those of the caller's pool.
    pool: Option<Arc<rayon_core::ThreadPool>>,
    number: usize,
    /// [`Steps::make`] on one of the threads. The bounds here state that the map is `Sync`.
    make: fn(Option<&rayon_core::ThreadPool>, Steps<'_, R>) -> bool,
}

impl<R: Map> Clone for Threads<R> {
    fn clone(&self) -> Self {
        Threads {
            pool: self.pool.clone(),
            number: self.number,
            make: self.make,
        }
    }
}

impl<R: Map<Work: Send> + Sync> Threads<R> {
    /// Starts the threads, outside of a rayon pool; returns `None` for fewer than two, or if the system cannot start
    /// them.
    pub(crate) fn new(number: usize) -> Option<Self> {
        // As for members of ensembles: memory that is not written is not used.
        const STACK: usize = 64 << 20;
        let of_pool = rayon_core::current_thread_index().map(|_| rayon_core::current_num_threads());
        let number = number.min(of_pool.unwrap_or(number));
        if number < 2 {
            return None;
        }
        let pool = if of_pool.is_none() {
            let builder = rayon_core::ThreadPoolBuilder::new()
                .num_threads(number)
                .stack_size(STACK);
            Some(Arc::new(builder.build().ok()?))
        } else {
            None
        };
        Some(Threads {
            pool,
            number,
            make: |pool, steps| match pool {
                Some(pool) => pool.install(|| steps.make()),
                None => steps.make(),
            },
        })
    }
}

impl<R: Map> Threads<R> {
    /// Their number.
    pub(crate) fn number(&self) -> usize {
        self.number
    }

    /// Makes the steps on the threads. Returns true if everything is finite after them.
    pub(crate) fn make(&self, steps: Steps<'_, R>) -> bool {
        (self.make)(self.pool.as_deref(), steps)
    }
}
