//! An iteration as data: its arithmetic, and a table of what it stores and sums.
//!
//! Input: what the macro writes for an innermost loop. Output: [`Body`]. Invariant: the stores of an iteration are in the
//! order in which the loop makes them.

use super::LONG;
use hamiltonian_lanes::Real;

/// How an element is changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// `= a`
    Set,
    /// `+= a`
    Add,
    /// `−= a`
    Sub,
    /// `+= a·b`, fused where the scalar fuses
    AddProduct,
    /// `−= a·b`, fused where the scalar fuses
    SubProduct,
}

impl Change {
    /// Returns true if the element before is part of the new one.
    pub(super) const fn reads(self) -> bool {
        !matches!(self, Change::Set)
    }
}

/// A store of an iteration to a column.
#[derive(Debug, Clone, Copy)]
pub struct ColumnStore {
    /// The number of the column that is written.
    pub(super) column: usize,
    /// How its element is changed.
    pub(super) change: Change,
    /// The results that change it: `a` and, for a product, `b`.
    pub(super) by: [usize; 2],
    /// True if another store of the iteration reaches other elements of the column.
    pub(super) is_shared: bool,
    /// The number of the ring that its element moves in, if it wraps.
    pub(super) ring: Option<usize>,
}

impl ColumnStore {
    /// The only store to a column.
    #[must_use]
    pub const fn to(column: usize, change: Change, by: [usize; 2]) -> ColumnStore {
        ColumnStore {
            column,
            change,
            by,
            is_shared: false,
            ring: None,
        }
    }
    /// One of the stores to several elements of a column.
    #[must_use]
    pub const fn among(column: usize, change: Change, by: [usize; 2]) -> ColumnStore {
        ColumnStore {
            column,
            change,
            by,
            is_shared: true,
            ring: None,
        }
    }
    /// The same store to an element that moves in a ring.
    #[must_use]
    pub const fn in_ring(self, ring: usize) -> ColumnStore {
        ColumnStore {
            ring: Some(ring),
            ..self
        }
    }
}

/// The number of a sum, and that of the result that is added to it.
pub type AddedTo = (usize, usize);

/// The number of a read, and that of the ring that its element moves in.
pub type InRing = (usize, usize);

/// The number of a read, and that of the store that changes its element.
pub type OfStore = (usize, usize);

/// The arithmetic of one iteration: of `G` numbers that are the same in all of them, `R` elements that are
/// read, and the number of the iteration where it counts as a real.
pub trait Body<const G: usize, const R: usize, const W: usize> {
    /// True if the number of the iteration is read.
    const COUNTS: bool = false;
    /// The least number of iterations that are faster in lanes, without sums.
    const LEAST: usize = LONG;
    /// The reads whose elements move in rings.
    const RINGS: &'static [InRing] = &[];
    /// The reads of elements that the iteration itself changes later. Their columns are those of the stores, each of
    /// which changes an element of its own.
    const OWN: &'static [OfStore] = &[];
    /// The stores, in order.
    const STORES: &'static [ColumnStore] = &[];
    /// The sums that results are added to, in order.
    const SUMS: &'static [AddedTo] = &[];

    /// The results.
    fn compute<T: Real>(given: [T; G], read: [T; R], number: T) -> [T; W];
}

/// An element after a store.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn changed<T: Real>(change: Change, place: T, [a, b]: [T; 2]) -> T {
    match change {
        Change::Set => a,
        Change::Add => place + a,
        Change::Sub => place - a,
        Change::AddProduct => a.fma(b, place),
        Change::SubProduct => (-a).fma(b, place),
    }
}

/// The store that changes the element of a read, if the iteration itself does.
pub(super) const fn store_of(own: &[OfStore], read: usize) -> Option<usize> {
    let mut k = 0;
    while k < own.len() {
        if own[k].0 == read {
            return Some(own[k].1);
        }
        k += 1;
    }
    None
}

/// Returns true if the element that a store changes is read.
pub(super) const fn is_read(stores: &[ColumnStore], own: &[OfStore], store: usize) -> bool {
    let mut k = 0;
    while k < own.len() {
        if stores[own[k].1].column == stores[store].column {
            return true;
        }
        k += 1;
    }
    stores[store].change.reads()
}

/// Returns true if results of any store wait.
pub(super) const fn has_shared(stores: &[ColumnStore]) -> bool {
    let mut s = 0;
    while s < stores.len() {
        if stores[s].is_shared {
            return true;
        }
        s += 1;
    }
    false
}

/// Returns true if no earlier store is to the same column.
pub(super) const fn is_first_of_column(stores: &[ColumnStore], at: usize) -> bool {
    let mut s = 0;
    while s < at {
        if stores[s].column == stores[at].column {
            return false;
        }
        s += 1;
    }
    true
}
