//! Steps as Rust statements.
//!
//! Input: the steps of a program. Output: text of statements over a scalar `T`: one `let` an instruction, and loops as
//! loops or as types that core runs. Invariant: each element gets its operations in the order of the program.
//!
//! `block` writes every step. The other files give its `Writer` methods, one file a kind of loop.

pub mod block;
pub mod calls;
pub mod iteration;
pub mod join;
pub mod pairs;
pub mod slabs;
pub mod stretch;
pub mod values;
pub mod whole;
