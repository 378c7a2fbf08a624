//! What the engine does, on mathematics written as text.

mod bracket;
mod common;
mod derivatives;
mod equations;
mod expressions;
mod jumps;
mod legendre;
mod limits;
mod loops;
mod nests;
mod normal_form;
mod operations;
mod print;
mod programs;
mod random_text;
mod readable;
mod replace;
mod soundness;
mod structure;
mod sums;
mod systems;
mod tape;
mod time;
mod transform;
mod tree;
