//! Systems, and the data at which they are evaluated.
//!
//! Input: the numbers of parameters, coordinates and momenta. Output: a
//! [`State`](crate::State), a [`System`](crate::System) prepared from its parameters, and H, its derivatives and the
//! contracts of its flows at a state. No step is made here.
//!
//! | layer | modules |
//! |---|---|
//! | vectors and states | `vector`, `uneven`, `lattice`, `fit`, `rows`, `state` |
//! | fields and flows, as traits | `flow` |
//! | systems, as traits | `system` |
//! | checks | `domain`: is H finite; `reach`: are indices in range; `derivatives`: are those by hand right |
//! | systems made of systems | `observed`, `transformed` |
//! | parameters that are functions | [`function`] |
//! | coordinates of bodies | [`coordinates`] |
//! | packs, as this crate is compiled | `compiled` |

pub(crate) mod compiled;
pub mod coordinates;
pub(crate) mod derivatives;
pub(crate) mod domain;
pub(crate) mod fit;
pub(crate) mod flow;
pub mod function;
pub(crate) mod hash;
pub(crate) mod lattice;
pub(crate) mod observed;
pub(crate) mod reach;
pub(crate) mod rows;
pub(crate) mod state;
pub(crate) mod system;
pub(crate) mod transformed;
pub(crate) mod uneven;
pub(crate) mod vector;

pub use system::{Missing, NamedPiece, ParameterText, Text};
