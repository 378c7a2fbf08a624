//! Loops over arrays, in lanes and on threads.
//!
//! Input: the body of one iteration, written by the macro, and the range of its loop. Output: the same
//! numbers as by iterations one after the other, to the bit.

pub(crate) mod calls;
pub(crate) mod pairs;
pub(crate) mod slabs;
pub(crate) mod stretch;
