//! Scalars: their functions against references, and their laws.

mod decimal;
mod double_double;
mod dual;
mod functions;
mod kepler;
mod levels;
mod packs;
mod scalars;
