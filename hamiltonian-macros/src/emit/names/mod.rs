//! Names, places and numbers as text.
//!
//! Input: the generics, groups, parameters and indices of a definition. Output: [`Context`](context::Context), which all text
//! of the definition is written from, and the text of types, slices, indices and numbers. Invariant: no operation of
//! a program is written here.

pub mod context;
pub mod generics;
pub mod index;
pub mod layout;
pub mod number;
pub mod storage;
