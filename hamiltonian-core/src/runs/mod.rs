//! One run: a system, a scheme, a start and a step.
//!
//! Input: these four, and observers. Output: states, and the run itself, which can be saved and resumed.

pub(crate) mod any;
pub(crate) mod failed;
pub(crate) mod integrator;
pub(crate) mod resume;
