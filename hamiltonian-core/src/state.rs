//! Points of phase space, and a gradient at one.
//!
//! Input: coordinates and momenta in any form [`IntoVector`] takes. Output: [`State`], [`Point`],
//! [`Gradient`]. Invariant: coordinates and momenta have one type; that they have one shape too
//! is checked where a run begins.

use crate::vector::{IntoVector, Vector};
use hamiltonian_lanes::Real;

/// Time, coordinates and momenta.
///
/// ```
/// use hamiltonian_core::State;
///
/// let pendulum = State::new([0.7], [0.0]).at(2.0);
/// assert_eq!((pendulum.t, pendulum.q[0], pendulum.p[0]), (2.0, 0.7, 0.0));
///
/// // Two bodies in space, one row a body.
/// let bodies = State::new([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], [[0.0; 3]; 2]);
/// assert_eq!(bodies.q[(1, 0)], -1.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct State<V: Vector> {
    /// Time.
    pub t: V::Scalar,
    /// Coordinates.
    pub q: V,
    /// Momenta, conjugate to `q` component by component.
    pub p: V,
}

impl<V: Vector> State<V> {
    /// The state (q, p) at t = 0.
    ///
    /// Arrays, arrays of rows, `Vec`s and nalgebra's vectors are taken; see [`IntoVector`].
    pub fn new<M, A: IntoVector<M, Vector = V>>(q: A, p: A) -> Self {
        State {
            t: V::Scalar::zero(),
            q: q.into_vector(),
            p: p.into_vector(),
        }
    }

    /// The same point at another time.
    #[must_use]
    pub fn at(mut self, t: V::Scalar) -> Self {
        self.t = t;
        self
    }
}

/// Coordinates and momenta without a time, as a scheme carries them from step to step.
///
/// It is a [`Vector`] itself, its parts those of `q`, then those of `p`.
#[derive(Debug, Clone, PartialEq)]
pub struct Point<V: Vector> {
    /// Coordinates.
    pub q: V,
    /// Momenta.
    pub p: V,
}

/// Two vectors over one scalar as one: the parts of `x`, then those of `y`.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair<X: Vector, Y: Vector<Scalar = X::Scalar>> {
    /// The first.
    pub x: X,
    /// The second.
    pub y: Y,
}

impl<V: Vector> Vector for Point<V> {
    type Scalar = V::Scalar;
    const PARTS: usize = 2 * V::PARTS;
    #[inline(always)]
    fn part(&self, k: usize) -> &[V::Scalar] {
        if k < V::PARTS {
            self.q.part(k)
        } else {
            self.p.part(k - V::PARTS)
        }
    }
    #[inline(always)]
    fn part_mut(&mut self, k: usize) -> &mut [V::Scalar] {
        if k < V::PARTS {
            self.q.part_mut(k)
        } else {
            self.p.part_mut(k - V::PARTS)
        }
    }
    fn zeros_like(&self) -> Self {
        Point {
            q: self.q.zeros_like(),
            p: self.p.zeros_like(),
        }
    }
    #[inline(always)]
    fn take(&mut self) -> Self {
        Point {
            q: self.q.take(),
            p: self.p.take(),
        }
    }
}

impl<X: Vector, Y: Vector<Scalar = X::Scalar>> Vector for Pair<X, Y> {
    type Scalar = X::Scalar;
    const PARTS: usize = X::PARTS + Y::PARTS;
    #[inline(always)]
    fn part(&self, k: usize) -> &[X::Scalar] {
        if k < X::PARTS {
            self.x.part(k)
        } else {
            self.y.part(k - X::PARTS)
        }
    }
    #[inline(always)]
    fn part_mut(&mut self, k: usize) -> &mut [X::Scalar] {
        if k < X::PARTS {
            self.x.part_mut(k)
        } else {
            self.y.part_mut(k - X::PARTS)
        }
    }
    fn zeros_like(&self) -> Self {
        Pair {
            x: self.x.zeros_like(),
            y: self.y.zeros_like(),
        }
    }
    #[inline(always)]
    fn take(&mut self) -> Self {
        Pair {
            x: self.x.take(),
            y: self.y.take(),
        }
    }
}

impl<V: Vector> State<V> {
    /// The point without its time.
    pub fn point(&self) -> Point<V> {
        Point {
            q: self.q.clone(),
            p: self.p.clone(),
        }
    }
}

/// A value carried from step to step: a [`Vector`] that shows a point of phase space.
///
/// Most carry the [`Point`] itself; others a [`Pair`] of it with a second point, with slopes for
/// the next guess, or with a multiplier.
pub trait Carried: Vector {
    /// Coordinates and momenta.
    type Vector: Vector<Scalar = Self::Scalar>;
    /// The point that is seen.
    fn point(&self) -> &Point<Self::Vector>;
    /// The time of that point where the run's clock stands at `clock`: that time itself, unless the
    /// time is carried.
    #[inline(always)]
    fn time(&self, clock: Self::Scalar) -> Self::Scalar {
        clock
    }
    /// About how long a step of the parameter `interval` takes from here where the time is carried.
    fn duration(&self, _interval: Self::Scalar) -> Option<Self::Scalar> {
        None
    }
}

impl<V: Vector> Carried for Point<V> {
    type Vector = V;
    #[inline(always)]
    fn point(&self) -> &Point<V> {
        self
    }
}

impl<V: Vector, Y: Vector<Scalar = V::Scalar>> Carried for Pair<Point<V>, Y> {
    type Vector = V;
    #[inline(always)]
    fn point(&self) -> &Point<V> {
        &self.x
    }
}

/// ∂H/∂q and ∂H/∂p.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient<V> {
    /// ∂H/∂q.
    pub q: V,
    /// ∂H/∂p.
    pub p: V,
}
