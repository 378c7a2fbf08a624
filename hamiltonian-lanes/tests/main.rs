//! Scalars: their functions against references, and their laws.

mod decimal;
mod double_double;
mod dual;
mod levels;
mod packs;
mod scalars;
