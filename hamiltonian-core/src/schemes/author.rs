//! For authors of schemes and of systems written by hand: the traits to implement, and what their methods take.
//!
//! A **scheme** is a type with a [`Listed`] entry ([`Entry`]) and
//! [`Scheme::prepare`](crate::Scheme::prepare), which makes the [`Map`] of one step for a system and a step. A step
//! is Φ = close ∘ body ∘ open. Between two observed states only `body` is repeated. Compositions require [`OneStep`]
//! or [`Symmetric`].
//!
//! A **system** written by hand implements [`System`](crate::System) and, for its prepared values, [`Dynamics`]:
//! the gradient as a [`VectorField`] and, if it has them, kicks and drifts or exact flows as [`Piece`]s.
//! [`check_derivatives`] compares given derivatives of a function with exact ones.
//!
//! ```
//! use hamiltonian::schemes::author::{Listed, catalogue};
//! use hamiltonian::prelude::*;
//!
//! assert_eq!(StormerVerlet::default().entry().order, 2);
//! assert!(catalogue().any(|entry| entry.name == "Tao"));
//! ```

pub use crate::flows::map::{Cause, Clock, Map, ScalarOf, Step};
pub use crate::runs::integrator::MapOf;
pub use crate::schemes::scheme::{CarriedBy, Entry, Form, Listed, Needs, OneStep, Symmetric};
pub use crate::systems::derivatives::{WrongDerivative, check_derivatives};
pub use crate::systems::flow::{Flow, Nothing, Piece, Pieces, Scratch, VectorField};
pub use crate::systems::observed::Observed;
pub use crate::systems::state::{Carried, CarriedShape, Pair, Point};
pub use crate::systems::system::gather::{self, InLanes, InPack, Kept};
pub use crate::systems::system::{
    Arithmetic, Description, Dynamics, Group, Observable, ObservableKind,
};
pub use crate::systems::transformed::WithTime;
pub use crate::systems::vector::{Over, Shape};

pub use super::catalogue::catalogue;
pub use super::splitting::{Durations, Reversed, Splitting, Weight};
pub use super::variational::Ends;
pub use super::zigzag::{Zigzag, ZigzagOf};
pub use crate::flows::iterate::{Contraction, Outcome, iterate};
