//! Sorting.
//!
//! Input: slices. Output: the same elements in order; equal ones keep their places. Invariant: one sort of the standard
//! library, of positions, serves every type. It compiles to two thousand lines for each type and comparison, and macros
//! are compiled without optimisation in each user's build.

use std::cmp::Ordering;

/// Sorts slices of any type.
pub trait Arrange<T> {
    /// Sorts by a comparison.
    fn arrange_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering);

    /// Sorts by keys.
    fn arrange_by_key<K: Ord>(&mut self, mut key: impl FnMut(&T) -> K) {
        self.arrange_by(|a, b| key(a).cmp(&key(b)));
    }

    /// Sorts from the least to the greatest.
    ///
    /// ```
    /// use hamiltonian_symbolic::sort::Arrange;
    ///
    /// let mut words = ["q", "p", "H"];
    /// words.arrange();
    /// assert_eq!(words, ["H", "p", "q"]);
    /// ```
    fn arrange(&mut self)
    where
        T: Ord,
    {
        self.arrange_by(T::cmp);
    }
}

impl<T> Arrange<T> for [T] {
    fn arrange_by(&mut self, mut compare: impl FnMut(&T, &T) -> Ordering) {
        let places = places(self.len(), &mut |a, b| compare(&self[a], &self[b]));
        follow(places, &mut |a, b| self.swap(a, b));
    }
}

/// The places that elements come from, in their new order; nothing for elements in order, which most lists are.
fn places(count: usize, compare: &mut dyn FnMut(usize, usize) -> Ordering) -> Vec<usize> {
    if (1..count).all(|next| compare(next - 1, next).is_le()) {
        return Vec::new();
    }
    let mut places: Vec<usize> = (0..count).collect();
    places.sort_by(|a, b| compare(*a, *b));
    places
}

/// Moves elements to their new places, one cycle of the permutation after another.
fn follow(mut places: Vec<usize>, swap: &mut dyn FnMut(usize, usize)) {
    for start in 0..places.len() {
        let mut to = start;
        loop {
            let from = places[to];
            places[to] = to;
            if from == start {
                break;
            }
            swap(to, from);
            to = from;
        }
    }
}
