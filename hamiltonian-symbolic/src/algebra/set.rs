//! Sets of numbered things of one kind, each the bits of a word.
//!
//! Input: members, which have numbers below 64. Output: [`Set`]. Invariant: sets of different kinds do not
//! mix.

use std::marker::PhantomData;
use std::ops::{BitAnd, BitOr, BitOrAssign};

/// The most members of a set.
pub const MEMBERS: usize = u64::BITS as usize;

/// A possible member of a set: a value with a number below [`MEMBERS`].
pub trait Member: Copy {
    /// Its number.
    fn number(self) -> u32;
    /// The one with this number.
    fn numbered(number: u32) -> Self;
}

/// A set.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Set<T>(u64, PhantomData<T>);

impl<T> Default for Set<T> {
    fn default() -> Set<T> {
        Set(0, PhantomData)
    }
}

impl<T: Member> Set<T> {
    /// The set of one member.
    #[must_use]
    pub fn of(member: T) -> Set<T> {
        Set(1 << member.number(), PhantomData)
    }
    /// Returns true if it has no member.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
    /// The number of members.
    #[must_use]
    pub fn len(self) -> usize {
        self.0.count_ones() as usize
    }
    /// Returns true if it has a member.
    #[must_use]
    pub fn has(self, member: T) -> bool {
        self.0 >> member.number() & 1 == 1
    }
    /// Returns true if two sets have a member in common.
    #[must_use]
    pub fn meets(self, other: Set<T>) -> bool {
        self.0 & other.0 != 0
    }
    /// Returns true if another set has all members.
    #[must_use]
    pub fn is_within(self, other: Set<T>) -> bool {
        self.0 & !other.0 == 0
    }
    /// The members that another set does not have.
    #[must_use]
    pub fn without(self, other: Set<T>) -> Set<T> {
        Set(self.0 & !other.0, PhantomData)
    }
    /// The members, by their numbers.
    pub fn members(self) -> impl Iterator<Item = T> + Clone {
        let next = |left: &u64| Some(left & (left - 1)).filter(|left| *left != 0);
        let lefts = std::iter::successors(Some(self.0).filter(|all| *all != 0), next);
        lefts.map(|left| T::numbered(left.trailing_zeros()))
    }
}

impl<T> BitOr for Set<T> {
    type Output = Set<T>;
    fn bitor(self, other: Set<T>) -> Set<T> {
        Set(self.0 | other.0, PhantomData)
    }
}

impl<T> BitOrAssign for Set<T> {
    fn bitor_assign(&mut self, other: Set<T>) {
        self.0 |= other.0;
    }
}

impl<T> BitAnd for Set<T> {
    type Output = Set<T>;
    fn bitand(self, other: Set<T>) -> Set<T> {
        Set(self.0 & other.0, PhantomData)
    }
}

impl<T: Member> FromIterator<T> for Set<T> {
    fn from_iter<I: IntoIterator<Item = T>>(members: I) -> Set<T> {
        let sets = members.into_iter().map(Set::of);
        sets.fold(Set::default(), |all, one| all | one)
    }
}
