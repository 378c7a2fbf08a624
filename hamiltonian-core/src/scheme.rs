//! What a scheme is: a table entry that, given a system, a start and a step, becomes a stepper.
//!
//! Input: a prepared system. Output: [`Scheme::prepare`] → [`Stepper`]. Invariants: a stepper
//! neither allocates nor dispatches inside a step; what it carries from step to step depends on
//! the number of steps made and on nothing else, so that the bits of a trajectory are the same
//! however it is cut into blocks and whoever observes it.

use crate::state::{Point, State};
use crate::system::System;
use crate::vector::Vector;
use core::fmt::Debug;
use hamiltonian_lanes::Real;

/// The 2-form a step preserves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// dq∧dp of the state itself: the scheme is symplectic.
    OnePoint,
    /// dq_a∧dp_b + dq_b∧dp_a of two points a and b that the scheme carries, and not dq∧dp of
    /// the one that is seen.
    TwoPoint,
    /// None: the scheme is no geometric one.
    Nothing,
}

/// What a scheme asks of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Needs {
    /// Nothing: any H(q, p, t).
    Any,
    /// H = T(p, t) + V(q, t), [`Separable`](crate::Separable).
    Separable,
}

/// What is known about a scheme: one line of the [catalogue](crate::schemes::catalogue).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// The type's name.
    pub name: &'static str,
    /// The choice made in it, in words; empty where there is none.
    pub variant: &'static str,
    /// The numbers of its equations in the paper; empty where it is not there.
    pub equations: &'static str,
    /// The error of a trajectory is O(Δt^order).
    pub order: u32,
    /// The time one step advances, in units of the step size Δt.
    pub duration: u32,
    /// What it asks of a system.
    pub needs: Needs,
    /// The form it preserves.
    pub preserves: Form,
    /// Author, year, equation, DOI.
    pub source: &'static str,
}

/// A scheme with a line in the catalogue.
pub trait Listed: Clone + Debug {
    /// That line.
    fn entry(&self) -> &'static Entry;
}

/// A scheme for the system `S` over the scalar `T`.
///
/// What a scheme needs of a system is the bound of its implementation, so a wrong pairing is a
/// compile error where the run is made.
pub trait Scheme<T: Real, S: System<T>>: Listed {
    /// The scheme with the system's flows and all coefficients folded in.
    type Stepper: Stepper<Vector = S::Vector>;
    /// Folds the step into the flows and makes the extra starting values. This may allocate.
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper;
}

/// A scheme under way.
pub trait Stepper: Clone + Debug {
    /// Coordinates and momenta.
    type Vector: Vector;
    /// All that the scheme carries from step to step; copying it is a snapshot of the run.
    type Carried: Vector<Scalar = <Self::Vector as Vector>::Scalar>;

    /// What is carried after the steps made so far.
    fn carried(&self) -> &Self::Carried;
    /// The same, to put a snapshot back.
    fn carried_mut(&mut self) -> &mut Self::Carried;
    /// Makes `n` steps after the first `made`.
    ///
    /// # Errors
    /// [`Unsolved`] from implicit schemes; what is carried is then undefined.
    fn run(&mut self, made: u64, n: u64) -> Result<(), Unsolved>;
    /// Writes the state after `made` steps into `q` and `p`. What is carried does not change: a
    /// scheme that carries momenta of another time completes copies of them.
    fn synchronise(&mut self, made: u64, q: &mut Self::Vector, p: &mut Self::Vector);
}

/// A stepper that carries two copies of the state.
pub trait Copies: Stepper {
    /// The copy that [`Stepper::synchronise`] does not show, as of its last call.
    fn copy(&self) -> Point<Self::Vector>;
}

/// An implicit step that was not solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unsolved {
    /// The number of steps made before it.
    pub made: u64,
    /// The last change of the iterate, in the maximum norm.
    pub residual: f64,
    /// The number of iterations made.
    pub iterations: u32,
}

/// Time as a function of the number of steps: `start + k·interval`, never a running sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock<T> {
    /// The time at step 0.
    pub start: T,
    /// The time one step advances.
    pub interval: T,
}

impl<T: Real> Clock<T> {
    /// The time after `made` steps.
    ///
    /// Pure, so that it vanishes where a system does not look at the time; exact in the number
    /// of steps up to 2⁵³.
    #[inline(always)]
    pub fn at(&self, made: u64) -> T {
        // Signed conversion is one instruction, unsigned is not.
        self.interval
            .fma(T::constant(made as i64 as f64, 0.0), self.start)
    }
}
