//! Many steps, and searches of many cases, in code that is optimised. `.ci/run` has these tests.

#[allow(dead_code, unused_imports)]
#[path = "../common/mod.rs"]
mod common;
mod drift;
mod orbits;
#[path = "../tangent.rs"]
mod tangent;
