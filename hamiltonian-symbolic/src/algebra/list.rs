//! Lists.
//!
//! Input: iterators. Output: their elements as vectors. Invariant: one loop serves every iterator over elements of a type.
//! `collect` compiles to five hundred lines for each iterator, and macros are compiled without optimisation in each user's
//! build.

/// Iterators whose elements become a list.
pub trait IntoList: Iterator {
    /// The elements, in order.
    ///
    /// ```
    /// use hamiltonian_symbolic::list::IntoList;
    ///
    /// assert_eq!([1, 2, 3].iter().map(|n| n * n).into_list(), [1, 4, 9]);
    /// ```
    fn into_list(self) -> Vec<Self::Item>;
}

impl<I: Iterator> IntoList for I {
    fn into_list(mut self) -> Vec<I::Item> {
        list(&mut || self.next())
    }
}

#[inline(never)]
fn list<T>(next: &mut dyn FnMut() -> Option<T>) -> Vec<T> {
    let mut all = Vec::new();
    while let Some(one) = next() {
        all.push(one);
    }
    all
}
