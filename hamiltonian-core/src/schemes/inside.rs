//! The maps behind the schemes, which tests and benches of this repository name.
//!
//! A scheme's author names what is in [`author`](super::author).

pub use crate::flows::map::Either;
pub use crate::flows::push::{Both, Coupled, SubStep};
pub use crate::systems::flow::{Sandwich, Turn};
pub use crate::systems::observed::{FieldObserved, ReadyObserved};
pub use crate::systems::transformed::{FieldInNewTime, InNewTime};

pub use super::adaptive::{Estimate, Following, FollowingWork};
pub use super::compensated::Carrying;
pub use super::composition::{Composed, Inverted, InvertedWork};
pub use super::discrete_gradient::{EnergyKeeping, EnergyWork};
pub use super::extended::{Copies, Cross, Crossed};
pub use super::midpoint::{Midpoint, MidpointWork};
pub use super::paced::{Pace, Pacing, PacingWork};
pub use super::processed::{
    BlanesCasasMurua8Kernel, BlanesCasasMurua8Processor, Corrector3, Corrector5, Corrector7,
    Corrector11, Corrector17, Kernel4, Kernel6, ProcessedMap, Processor4, Processor6,
};
pub use super::projection::{Averaged, Mixing};
pub use super::runge_kutta::{Classical, ClassicalWork};
pub use super::second_order::{CarriesForces, Eliminated, EliminatedWork};
pub use super::semiexplicit::{Projected, ProjectedWork};
pub use super::stages::{Carries, Collocated, CollocatedWork, Stages};
pub use super::tao::{Bind, Turned};
pub use super::trajectories::{Interleaved, TwoStep};
pub use super::transformed_verlet::{VerletInNewTime, VerletWork};
pub use super::variational::Extremal;
