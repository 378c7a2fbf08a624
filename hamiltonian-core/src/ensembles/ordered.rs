//! Work on several threads whose results are taken in order.
//!
//! Input: numbered jobs. Output: their results, one by one in the order of the numbers. Invariant: at most twice as
//! many jobs as threads are begun and not yet taken, so that memory is bounded.

use super::threads;
use alloc::vec::Vec;
use core::ops::ControlFlow;

/// Does `count` jobs on a number of threads and passes their results to `take` in order, until `take` breaks.
pub(crate) fn in_order<B: Send>(
    count: usize,
    number: usize,
    work: impl Fn(usize) -> B + Sync,
    mut take: impl FnMut(usize, B) -> ControlFlow<()>,
) {
    let number = number.min(count);
    #[cfg(feature = "std")]
    if number > 1 && threads::of_pool().is_none() {
        return parallel::in_order(count, number, work, take);
    }
    in_rounds(count, number, work, &mut take);
}

/// The jobs in rounds, between which results are taken. A thread of a pool must not wait for results of other threads
/// of the pool, since these may wait as well.
fn in_rounds<B: Send>(
    count: usize,
    number: usize,
    work: impl Fn(usize) -> B + Sync,
    take: &mut dyn FnMut(usize, B) -> ControlFlow<()>,
) {
    let size = if number > 1 { 2 * number } else { 1 };
    for first in (0..count).step_by(size) {
        let jobs = first..count.min(first + size);
        let mut round: Vec<(usize, Option<B>)> = jobs.map(|job| (job, None)).collect();
        threads::for_each(&mut round, number, |(job, result)| {
            *result = Some(work(*job))
        });
        for (job, result) in round {
            if result.is_none_or(|result| take(job, result).is_break()) {
                return;
            }
        }
    }
}

#[cfg(feature = "std")]
mod parallel {
    use super::super::threads::with_workers;
    use alloc::collections::BTreeMap;
    use core::ops::ControlFlow;
    use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

    struct Queue<B> {
        /// The number of the next job.
        next: usize,
        /// The number of results taken.
        taken: usize,
        done: BTreeMap<usize, B>,
        /// True if no more jobs are begun.
        stop: bool,
    }

    struct SharedQueue<B> {
        queue: Mutex<Queue<B>>,
        changed: Condvar,
    }

    impl<B> SharedQueue<B> {
        fn lock(&self) -> MutexGuard<'_, Queue<B>> {
            // A poisoned lock is usable: no change of the queue can panic half-way.
            self.queue.lock().unwrap_or_else(PoisonError::into_inner)
        }

        fn wait<'a>(&self, queue: MutexGuard<'a, Queue<B>>) -> MutexGuard<'a, Queue<B>> {
            (self.changed.wait(queue)).unwrap_or_else(PoisonError::into_inner)
        }
    }

    /// Stops all threads when dropped, so that none waits for a thread that has panicked.
    struct Stop<'a, B>(&'a SharedQueue<B>);

    impl<B> Drop for Stop<'_, B> {
        fn drop(&mut self) {
            self.0.lock().stop = true;
            self.0.changed.notify_all();
        }
    }

    pub(super) fn in_order<B: Send>(
        count: usize,
        threads: usize,
        work: impl Fn(usize) -> B + Sync,
        mut take: impl FnMut(usize, B) -> ControlFlow<()>,
    ) {
        let shared = SharedQueue {
            queue: Mutex::new(Queue {
                next: 0,
                taken: 0,
                done: BTreeMap::new(),
                stop: false,
            }),
            changed: Condvar::new(),
        };
        let worker = || {
            loop {
                let mut queue = shared.lock();
                while !queue.stop && queue.next < count && queue.next >= queue.taken + 2 * threads {
                    queue = shared.wait(queue);
                }
                if queue.stop || queue.next >= count {
                    return;
                }
                let job = queue.next;
                queue.next += 1;
                drop(queue);
                let panicked = Stop(&shared);
                let result = work(job);
                core::mem::forget(panicked);
                shared.lock().done.insert(job, result);
                shared.changed.notify_all();
            }
        };
        with_workers(threads, &worker, &mut |started| {
            if started == 0 {
                return super::in_rounds(count, 1, &work, &mut take);
            }
            let _stop = Stop(&shared);
            for job in 0..count {
                let mut queue = shared.lock();
                let result = loop {
                    if let Some(result) = queue.done.remove(&job) {
                        break result;
                    }
                    if queue.stop {
                        return;
                    }
                    queue = shared.wait(queue);
                };
                queue.taken = job + 1;
                drop(queue);
                shared.changed.notify_all();
                if take(job, result).is_break() {
                    return;
                }
            }
        });
    }
}
