//! Derivatives of the numerical map, periodic orbits, and starts on a surface.
//!
//! Input: a run or a guess of a start. Output: Lyapunov exponents, Floquet multipliers, periodic orbits
//! ([`Tangent`], [`OrbitSearch`]), and states with a given energy or on a section ([`momentum_from_energy`],
//! [`on_section`]).

pub(crate) mod periodic;
pub(crate) mod start;
pub(crate) mod tangent;

pub use periodic::{Closing, OrbitSearch, PeriodicOrbit};
pub use start::{Branch, Section, coordinate_on_event, momentum_from_energy, on_section};
pub use tangent::{Tangent, megno, monodromy, multipliers, symplectic_defect};
