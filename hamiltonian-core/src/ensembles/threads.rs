//! Work on several threads.
//!
//! Input: items and a closure. Output: the work done on each item. Invariants: one thread works on an item, so that
//! results depend on neither the number of threads nor their order; a caller in a rayon pool starts no threads besides
//! those of the pool. Both are the same in unoptimised code, where only the stacks are larger. Threads are started by
//! functions that are not generic, so that no program compiles them.

/// Returns the number of threads that run at once: those of the caller's rayon pool, or of the machine.
pub(crate) fn available() -> usize {
    if let Some(threads) = of_pool() {
        return threads;
    }
    #[cfg(feature = "std")]
    {
        std::thread::available_parallelism().map_or(1, core::num::NonZero::get)
    }
    #[cfg(not(feature = "std"))]
    {
        1
    }
}

/// Returns the number of threads of the rayon pool that the caller runs in.
pub(crate) fn of_pool() -> Option<usize> {
    #[cfg(feature = "rayon")]
    {
        rayon_core::current_thread_index().map(|_| rayon_core::current_num_threads())
    }
    #[cfg(not(feature = "rayon"))]
    {
        None
    }
}

/// The stack of a thread. Pages that are never touched take no memory.
#[cfg(feature = "std")]
const STACK: usize = 64 << 20;

/// Runs the worker; unoptimised code on a thread of its own, for which the caller waits. There, a frame of arithmetic
/// inlined into a level takes some megabytes, and a caller may have 1 MB (the main thread on Windows) or 2 MB (a test).
///
/// # Panics
///
/// With the panic of the worker.
#[cfg(feature = "std")]
fn on_large_stack(worker: &(dyn Fn() + Sync)) {
    if cfg!(debug_assertions) {
        with_workers(1, worker, &mut |started| {
            if started == 0 {
                worker();
            }
        });
    } else {
        worker();
    }
}

/// Runs the worker on some threads, the caller's part beside them, and joins them. The caller's part is told how many
/// threads the system has started: it may start fewer, or none. Threads are joined, so that all their memory is free
/// again on return.
///
/// # Panics
///
/// With the panic of a worker or of the caller's part.
#[cfg(feature = "std")]
pub(crate) fn with_workers(
    threads: usize,
    worker: &(dyn Fn() + Sync),
    caller: &mut dyn FnMut(usize),
) {
    std::thread::scope(|scope| {
        let spawn = |_| {
            let builder = std::thread::Builder::new().stack_size(STACK);
            builder.spawn_scoped(scope, worker).ok()
        };
        let started: Vec<_> = (0..threads).map_while(spawn).collect();
        caller(started.len());
        for thread in started {
            if let Err(panic) = thread.join() {
                std::panic::resume_unwind(panic);
            }
        }
    });
}

/// Runs the worker on several threads, or on the caller's.
#[cfg(feature = "std")]
fn on_threads(threads: usize, worker: &(dyn Fn() + Sync)) {
    if threads == 1 {
        return on_large_stack(worker);
    }
    #[cfg(feature = "rayon")]
    if let Some(pool) = of_pool() {
        return rayon_core::in_place_scope(|scope| {
            for _ in 1..threads.min(pool) {
                scope.spawn(|_| on_large_stack(worker));
            }
            on_large_stack(worker);
        });
    }
    with_workers(threads - 1, worker, &mut |_| on_large_stack(worker));
}

/// Does the work on every item. A thread that has finished an item takes the next one.
pub(crate) fn for_each<A: Send>(items: &mut [A], threads: usize, work: impl Fn(&mut A) + Sync) {
    #[cfg(feature = "std")]
    {
        let threads = threads.clamp(1, items.len().max(1));
        let next = std::sync::Mutex::new(items.iter_mut());
        let take = || {
            // A poisoned lock is usable: a thread that panicked has left the iterator intact.
            let mut next = next
                .lock()
                .unwrap_or_else(std::sync::PoisonError::into_inner);
            next.next()
        };
        let worker = || {
            while let Some(item) = take() {
                work(item);
            }
        };
        on_threads(threads, &worker);
    }
    #[cfg(not(feature = "std"))]
    {
        let _ = threads;
        items.iter_mut().for_each(work);
    }
}

#[cfg(all(test, feature = "rayon"))]
mod tests {
    use super::super::ordered::in_order;
    use super::*;
    use core::ops::ControlFlow;
    use core::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    /// Counts how many threads are in it at once.
    #[derive(Default)]
    struct Crowd {
        now: AtomicUsize,
        most: AtomicUsize,
    }

    impl Crowd {
        fn pass(&self) {
            let now = self.now.fetch_add(1, Ordering::SeqCst) + 1;
            self.most.fetch_max(now, Ordering::SeqCst);
            std::thread::sleep(Duration::from_millis(2));
            self.now.fetch_sub(1, Ordering::SeqCst);
        }
    }

    /// The most threads at once, of eight that are wanted; every item gets its work, and results are in order.
    fn most_at_once() -> [usize; 2] {
        let (each, ordered) = (Crowd::default(), Crowd::default());
        let mut items: Vec<usize> = (0..40).collect();
        for_each(&mut items, 8, |item| {
            each.pass();
            *item += 1;
        });
        assert!(items.into_iter().eq(1..41));
        let mut taken = Vec::new();
        let work = |job| {
            ordered.pass();
            job
        };
        in_order(40, 8, work, |job, result| {
            assert_eq!(job, result);
            taken.push(job);
            match job {
                32 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        });
        assert!(taken.into_iter().eq(0..33));
        [each, ordered].map(|crowd| crowd.most.into_inner())
    }

    #[test]
    fn a_caller_in_a_pool_starts_no_threads_besides() {
        for threads in [1, 2] {
            let pool = rayon_core::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("a pool");
            assert_eq!(pool.install(available), threads);
            let most = pool.install(most_at_once);
            assert!(most.iter().all(|most| *most <= threads), "{most:?}");
        }
        // Outside of a pool there are more.
        let most = most_at_once();
        assert!(most.iter().all(|most| *most > 2), "{most:?}");
    }

    #[test]
    fn a_panic_of_a_worker_reaches_the_caller() {
        let pool = rayon_core::ThreadPoolBuilder::new().num_threads(2).build();
        let pool = pool.expect("a pool");
        for threads in [1, 2, 8] {
            let run = || {
                let caught = std::panic::catch_unwind(|| {
                    for_each(&mut [0; 16], threads, |_| panic!("of a worker"));
                });
                let message = caught.map_err(|panic| panic.downcast_ref::<&str>().copied());
                assert_eq!(message, Err(Some("of a worker")));
            };
            run();
            pool.install(run);
        }
    }
}
