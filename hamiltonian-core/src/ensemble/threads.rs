//! Work on several threads.
//!
//! Input: items and a closure. Invariant: one thread works on an item, so that results depend on neither the number of
//! threads nor their order.

/// Returns the number of threads that the machine runs at once.
pub(crate) fn available() -> usize {
    #[cfg(feature = "std")]
    {
        std::thread::available_parallelism().map_or(1, core::num::NonZero::get)
    }
    #[cfg(not(feature = "std"))]
    {
        1
    }
}

/// True if members advance on the thread of the caller as well. In unoptimised code they do not: a frame of
/// arithmetic inlined into a level takes some megabytes there, and a caller may have 1 MB (the main thread on Windows)
/// or 2 MB (a test).
const ON_CALLER: bool = cfg!(any(not(debug_assertions), not(feature = "std")));

/// Runs the worker on some threads with stacks for unoptimised code, the caller's part beside them, and joins them.
/// Stack pages that are never touched take no memory. The caller's part is told how many threads the system has
/// started: it may start fewer, or none. Threads are joined, so that all their memory is free again on return.
///
/// # Panics
///
/// With the panic of a worker or of the caller's part.
#[cfg(feature = "std")]
pub(crate) fn beside<A>(
    threads: usize,
    worker: impl Fn() + Sync,
    caller: impl FnOnce(usize) -> A,
) -> A {
    const STACK: usize = 64 << 20;
    std::thread::scope(|scope| {
        let spawn = |_| {
            let builder = std::thread::Builder::new().stack_size(STACK);
            builder.spawn_scoped(scope, &worker).ok()
        };
        let started: Vec<_> = (0..threads).map_while(spawn).collect();
        let made = caller(started.len());
        for thread in started {
            if let Err(panic) = thread.join() {
                std::panic::resume_unwind(panic);
            }
        }
        made
    })
}

/// Does the work on every item. A thread that has finished an item takes the next one.
pub(crate) fn for_each<A: Send>(items: &mut [A], threads: usize, work: impl Fn(&mut A) + Sync) {
    let threads = threads.clamp(1, items.len().max(1));
    if threads == 1 && ON_CALLER {
        items.iter_mut().for_each(work);
        return;
    }
    #[cfg(feature = "std")]
    {
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
        beside(threads - usize::from(ON_CALLER), worker, |started| {
            if ON_CALLER || started == 0 {
                worker();
            }
        });
    }
    #[cfg(not(feature = "std"))]
    items.iter_mut().for_each(work);
}
