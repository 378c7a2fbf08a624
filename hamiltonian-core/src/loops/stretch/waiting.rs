//! Results that wait until all earlier stores of their elements are done.
//!
//! Input: the results of a block of iterations. Output: the columns they are stored in. Invariant: each
//! element is changed in the order of the iterations.
//!
//! # Example: a stretch with two stores
//! The force of a chain of springs, with the tension `d[i]` between the sites i and i + 1:
//!
//! ```text
//! for i in 0..n { f[i] -= d[i]; f[i + 1] += d[i] }
//! ```
//!
//! Iteration k − 1 adds `d[k−1]` to `f[k]`, and iteration k then subtracts `d[k]`. One after the other gives
//! (f\[k\] + d\[k−1\]) − d\[k\], and lanes must give the same bits. Four lanes compute d\[4\], …, d\[7\] at once. If they
//! subtracted these from f\[4\], …, f\[7\] at once, only f\[4\] would have received its d\[3\] before. So the results wait for
//! a block. The stores have the offsets 0 and 1. In descending order of offsets, the block first adds d\[3\], …, d\[6\] to
//! f\[4\], …, f\[7\], where d\[3\] is kept from the block before, and then subtracts d\[4\], …, d\[7\]. Each f\[k\] has met its two
//! changes in the order of the iterations. f\[8\] still lacks d\[7\], which is kept for the next block.

use super::{
    BLOCK, CARRY, ColumnStore, OfStore, REACH, STRIDE, changed, is_first_of_column, is_read,
};
use hamiltonian_lanes::{Pack, Real};

/// Results of a block of iterations on their way to columns that several stores of an iteration reach.
///
/// The further ahead a store reaches, the earlier the iteration that reaches a given element. So each
/// element is changed by the stores in descending order of their offsets, all at once where the offsets
/// are close to each other; results of the block before are kept for that. A store that reaches no element
/// of another one does not wait.
pub(super) struct Waiting<T, const S: usize, const W: usize> {
    pub(super) results: [[T; CARRY + BLOCK]; W],
    offsets: [usize; S],
    /// The stores, by descending offset.
    order: [usize; S],
    /// For each store its group: the first one of those that reach common elements, in order; `NONE` if it
    /// does not wait.
    pub(super) group: [usize; S],
    /// For each group the next element to be changed.
    next: [usize; S],
    /// For each group the least and the largest offset.
    ends: [[usize; 2]; S],
    /// True if the elements that iterations after the last one would change too are left to them.
    is_followed: bool,
}

/// The group of a store that does not wait.
pub(super) const NONE: usize = usize::MAX;

impl<T: Real, const S: usize, const W: usize> Waiting<T, S, W> {
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn new(
        stores: &[ColumnStore],
        offsets: [usize; S],
        length: usize,
        is_followed: bool,
    ) -> Self {
        let mut order = [0; S];
        let mut s = 0;
        while s < S {
            let mut place = s;
            while place > 0 && offsets[order[place - 1]] < offsets[s] {
                order[place] = order[place - 1];
                place -= 1;
            }
            order[place] = s;
            s += 1;
        }
        let mut group = [NONE; S];
        let mut ends = [[0; 2]; S];
        let mut k = 0;
        while k < S {
            let s = order[k];
            // The next store below it joins its group if both reach common elements.
            let mut below = k + 1;
            while below < S && stores[order[below]].column != stores[s].column {
                below += 1;
            }
            if stores[s].is_shared && below < S && offsets[s] - offsets[order[below]] < length {
                if group[s] == NONE {
                    group[s] = s;
                    ends[s] = [offsets[s]; 2];
                }
                let first = group[s];
                group[order[below]] = first;
                ends[first][0] = offsets[order[below]];
            }
            k += 1;
        }
        let mut next = [0; S];
        let mut s = 0;
        while s < S {
            next[s] = ends[s][0];
            s += 1;
        }
        Waiting {
            results: [[T::zero(); CARRY + BLOCK]; W],
            offsets,
            order,
            group,
            next,
            ends,
            is_followed,
        }
    }

    /// Returns true if results of any store wait.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn is_any(&self) -> bool {
        let mut s = 0;
        while s < S {
            if self.group[s] != NONE {
                return true;
            }
            s += 1;
        }
        false
    }

    /// Returns true if the store does not wait, the element that it changes is read, and it is the first one to change
    /// it.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn is_taken_back(&self, stores: &[ColumnStore], own: &[OfStore], s: usize) -> bool {
        is_read(stores, own, s)
            && match stores[s].is_shared {
                true => self.group[s] == NONE,
                false => is_first_of_column(stores, s),
            }
    }

    /// Stores the results of iterations `at..end`.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn store_due<P: Pack, const C: usize>(
        &mut self,
        stores: &[ColumnStore],
        columns: &mut [&mut [T]; C],
        at: usize,
        end: usize,
        is_last: bool,
    ) {
        let mut g = 0;
        while g < S {
            let [least, most] = self.ends[g];
            if self.group[g] != g {
                // It waits with another one, or not at all.
            } else if most - least <= REACH {
                let column = &mut *columns[stores[g].column];
                self.together::<P>(stores, column, g, at, end, is_last);
            } else {
                for s in self.order {
                    if self.group[s] == g {
                        let column = &mut *columns[stores[s].column];
                        self.one_store::<P>(&stores[s], column, self.offsets[s] + at, end - at);
                    }
                }
            }
            g += 1;
        }
        let mut w = 0;
        while w < W {
            self.results[w].copy_within(end - at..end - at + CARRY, 0);
            w += 1;
        }
    }

    /// All stores of a group, element by element.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn together<P: Pack>(
        &mut self,
        stores: &[ColumnStore],
        column: &mut [T],
        g: usize,
        at: usize,
        end: usize,
        is_last: bool,
    ) {
        let [least, most] = self.ends[g];
        // Elements that iterations before the first one would reach have fewer changes.
        while self.next[g] < most && (is_last || self.next[g] < least + end) {
            self.element(stores, column, g, at, end);
        }
        let mut element = self.next[g];
        while element + STRIDE <= least + end {
            let places = &mut column[element..element + STRIDE];
            let mut value = T::gather::<P>(places);
            let mut k = 0;
            while k < S {
                let s = self.order[k];
                let store = &stores[s];
                if self.group[s] == g {
                    let place = element - self.offsets[s] + CARRY - at;
                    let a = T::gather::<P>(&self.results[store.by[0]][place..place + STRIDE]);
                    let b = T::gather::<P>(&self.results[store.by[1]][place..place + STRIDE]);
                    value = changed(store.change, value, [a, b]);
                }
                k += 1;
            }
            T::scatter::<P>(value, places);
            element += STRIDE;
        }
        self.next[g] = element;
        let last = if self.is_followed { least } else { most } + end;
        while is_last && self.next[g] < last {
            self.element(stores, column, g, at, end);
        }
    }

    /// The next element of a group, by itself.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn element(
        &mut self,
        stores: &[ColumnStore],
        column: &mut [T],
        g: usize,
        at: usize,
        end: usize,
    ) {
        let element = self.next[g];
        for s in self.order {
            let (store, offset) = (&stores[s], self.offsets[s]);
            if self.group[s] == g && element >= offset && element - offset < end {
                let place = element - offset + CARRY - at;
                let by = [
                    self.results[store.by[0]][place],
                    self.results[store.by[1]][place],
                ];
                column[element] = changed(store.change, column[element], by);
            }
        }
        self.next[g] = element + 1;
    }

    /// One store of a column.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn one_store<P: Pack>(
        &self,
        store: &ColumnStore,
        column: &mut [T],
        offset: usize,
        count: usize,
    ) {
        let places = &mut column[offset..offset + count];
        let [a, b] = store.by.map(|by| &self.results[by][CARRY..CARRY + count]);
        let mut k = 0;
        while k < count {
            let end = count.min(k + STRIDE);
            let by = [T::gather::<P>(&a[k..end]), T::gather::<P>(&b[k..end])];
            let old = T::gather::<P>(&places[k..end]);
            T::scatter::<P>(changed(store.change, old, by), &mut places[k..end]);
            k = end;
        }
    }
}
