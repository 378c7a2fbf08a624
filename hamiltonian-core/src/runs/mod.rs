//! One run: a system, a scheme, a start and a step.
//!
//! What enters: these four, and observers. What leaves: states, and the run itself, which can be saved and resumed.

pub(crate) mod any;
pub(crate) mod failed;
pub(crate) mod integrator;
pub(crate) mod resume;
