//! Loops of one run in slabs, on several threads.
//!
//! Input: a loop whose iterations change elements of their own. Output: those changes. Invariant: an element
//! is changed on one thread, in the order of the iterations, so that bits depend on neither the number of
//! threads nor the slabs.

use crate::systems::system::Arithmetic;
use core::ops::Range;
use hamiltonian_lanes::Real;

/// The least number of elements of a slab: some microseconds of work, as many as it takes to hand one over.
pub(crate) const SLAB: usize = 8192;

/// Calls both functions, on two threads if another thread of the pool is idle.
pub(crate) fn on_two_threads(a: &mut (dyn FnMut() + Send), b: &mut (dyn FnMut() + Send)) {
    #[cfg(feature = "rayon")]
    rayon_core::join(a, b);
    #[cfg(not(feature = "rayon"))]
    {
        a();
        b();
    }
}

/// The number of slabs of so many elements: some for each thread, which takes the next one when it is done with
/// one. Outside of the threads of a run there is one.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn slabs(arithmetic: Arithmetic, elements: usize) -> usize {
    match arithmetic.threads > 1 && arithmetic.lanes && elements >= 2 * SLAB {
        true => several(arithmetic.threads, elements),
        false => 1,
    }
}

#[inline(never)]
fn several(threads: usize, elements: usize) -> usize {
    #[cfg(feature = "rayon")]
    if rayon_core::current_thread_index().is_some() {
        return (elements / SLAB).min(4 * threads);
    }
    let _ = (threads, elements);
    1
}

/// The iterations of an outer loop in slabs. Iteration `i` changes elements `i·k..(i + 1)·k` of a column that
/// comes with `k`, and no others. `work` is given a range of iterations and the elements that are theirs.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn rows<T: Real, const C: usize>(
    count: usize,
    arithmetic: Arithmetic,
    columns: [(&mut [T], usize); C],
    work: impl Fn(Range<usize>, [&mut [T]; C]) + Copy + Sync,
) {
    let elements = columns.first().map_or(0, |(_, row)| count * row);
    let slabs = match T::WIDENS {
        true => slabs(arithmetic, elements),
        false => 1,
    };
    if slabs < 2 {
        work(0..count, columns.map(|(column, _)| column));
    } else {
        // A copy: what is borrowed here would not stay in registers above.
        let copy = work;
        cut(0..count, slabs.min(count), columns, &copy);
    }
}

/// The body of a loop: it receives a range of iterations and their elements.
type SlabBody<'a, T, const C: usize> = dyn Fn(Range<usize>, [&mut [T]; C]) + Sync + 'a;

/// Some iterations in so many slabs.
#[inline(never)]
fn cut<T: Real, const C: usize>(
    range: Range<usize>,
    slabs: usize,
    columns: [(&mut [T], usize); C],
    work: &SlabBody<'_, T, C>,
) {
    if slabs < 2 {
        return work(range, columns.map(|(column, _)| column));
    }
    let half = slabs / 2;
    let ahead = range.len() * half / slabs;
    let middle = range.start + ahead;
    let mut halves = columns.map(|(column, row)| {
        let (a, b) = column.split_at_mut(ahead * row);
        [(a, row), (b, row)]
    });
    let mut half_of = |at: usize| {
        let taken = halves.each_mut().map(|half| {
            let (column, row) = &mut half[at];
            (core::mem::take(column), *row)
        });
        Some(taken)
    };
    let (mut first, mut second) = (half_of(0), half_of(1));
    on_two_threads(
        &mut || {
            if let Some(columns) = first.take() {
                cut(range.start..middle, half, columns, work);
            }
        },
        &mut || {
            if let Some(columns) = second.take() {
                cut(middle..range.end, slabs - half, columns, work);
            }
        },
    );
}
