//! For authors of schemes and of systems written by hand: the traits to implement, and the maps behind the
//! schemes.
//!
//! A **scheme** is a type with a [`Listed`] entry ([`Entry`]) and
//! [`Scheme::prepare`](crate::Scheme::prepare), which makes the [`Map`] of one step for a system and a step. A step
//! is Φ = close ∘ body ∘ open. Between two observed states only `body` is repeated. Compositions require [`OneStep`]
//! or [`Symmetric`].
//!
//! A **system** written by hand implements [`System`](crate::System) and, for its prepared values, [`Dynamics`]:
//! the gradient as a [`VectorField`] and, if it has them, kicks and drifts or exact flows as [`Piece`]s.
//! [`check_derivatives`] compares given derivatives of a function with exact ones. With [`Gather`], members of an
//! ensemble may have different parameters.
//!
//! ```
//! use hamiltonian::schemes::author::{Listed, catalogue};
//! use hamiltonian::prelude::*;
//!
//! assert_eq!(StormerVerlet::default().entry().order, 2);
//! assert!(catalogue().any(|entry| entry.name == "Tao"));
//! ```

pub use crate::derivatives::{WrongDerivative, check_derivatives};
pub use crate::flow::{Flow, Nothing, Piece, Pieces, Sandwich, Scratch, Turn, VectorField};
pub use crate::integrator::MapOf;
pub use crate::map::{Cause, Clock, Either, Map, ScalarOf, Step};
pub use crate::observed::{FieldObserved, Observed, ReadyObserved};
pub use crate::push::{Both, Coupled, SubStep};
pub use crate::scheme::{Entry, Form, Listed, Needs, OneStep, Symmetric};
pub use crate::state::{Carried, Pair, Point};
pub use crate::system::gather::{self, Gather, InLanes, Kept};
pub use crate::system::{Arithmetic, Cyclic, Dynamics, Group, Observable, ObservableKind};
pub use crate::transformed::{FieldInNewTime, InNewTime, WithTime};

pub use super::catalogue::{
    Visitor, catalogue, visit_any, visit_compensated, visit_doubled, visit_energy, visit_exact,
    visit_implicit, visit_nystrom, visit_quadratic, visit_separable, visit_split,
    visit_transformed, visit_unforced,
};
pub use super::compensated::Carrying;
pub use super::composition::{Composed, Inverted, InvertedWork};
pub use super::discrete_gradient::{EnergyKeeping, EnergyWork};
pub use super::extended::{Copies, Cross, Crossed};
pub use super::iterate::{Contraction, Outcome, iterate};
pub use super::midpoint::{Midpoint, MidpointWork};
pub use super::paced::{Pace, Pacing, PacingWork};
pub use super::processed::{
    BlanesCasasMurua8Kernel, BlanesCasasMurua8Processor, Corrector3, Corrector5, Corrector7,
    Corrector11, Corrector17, Kernel4, Kernel6, Processing, Processor4, Processor6,
};
pub use super::projection::{Averaged, Mixing, Projected, ProjectedWork};
pub use super::runge_kutta::{Classical, ClassicalWork};
pub use super::second_order::{CarriesForces, Eliminated, EliminatedWork};
pub use super::splitting::{Durations, Negated, Reversed, Splitting, Weight};
pub use super::stages::{Carries, Collocated, CollocatedWork, Stages};
pub use super::tao::{Bind, Turned};
pub use super::trajectories::{Interleaved, TwoStep};
pub use super::transformed_verlet::{VerletInNewTime, VerletWork};
pub use super::variational::{Ends, Extremal};
pub use super::zigzag::{Zigzag, ZigzagOf};
