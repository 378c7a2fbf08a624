//! Points of phase space, and a gradient at one.
//!
//! Input: coordinates and momenta in any form [`IntoVector`] takes. Output: [`State`], [`Point`],
//! [`Gradient`]. Invariant: coordinates and momenta have one type; that they have one shape too
//! is checked where a run begins.

use crate::errors::{Error, InputError};
use crate::systems::fit::Fit;
use crate::systems::vector::{IntoVector, Over, Shape, Vector};
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// Time, coordinates and momenta.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// let pendulum = State::new([0.7], [0.0]).at(2.0);
/// assert_eq!((pendulum.t, pendulum.q[0], pendulum.p[0]), (2.0, 0.7, 0.0));
///
/// // Two bodies in space, one row a body.
/// let bodies = State::new([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], [[0.0; 3]; 2]);
/// assert_eq!(bodies.q[(1, 0)], -1.0);
/// ```
///
/// Numbers are stored as [`Vector`] says, matrices column after column. [`to_vec`](State::to_vec),
/// [`write_to`](State::write_to) and [`from_slice`](State::from_slice) have the order of the declaration.
#[derive(Debug, Clone, PartialEq)]
pub struct State<V: Vector> {
    /// Time.
    pub t: V::Scalar,
    /// Coordinates.
    pub q: V,
    /// Momenta, conjugate to `q` component by component.
    pub p: V,
}

impl<V: Vector<Scalar: Plain>> State<V> {
    /// Creates the state (q, p) at t = 0, over `f64`.
    ///
    /// Arrays, arrays of rows, `Vec`s and nalgebra's vectors are taken; see [`IntoVector`]. Over other
    /// scalars, and in code that is generic over them, it is [`State::over`].
    pub fn new<M, A: IntoVector<M, Vector = V>>(q: A, p: A) -> Self {
        State::over(q, p)
    }
}

impl<V: Vector> State<V> {
    /// Creates the state (q, p) at t = 0 over any scalar.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// let varied = State::over([Dual::variable(0.7)], [Dual::fixed(0.0)]);
    /// assert_eq!(varied.q[0].eps, 1.0);
    ///
    /// fn at_rest<T: Real>(angle: T) -> T {
    ///     State::over([angle], [T::zero()]).q[0]
    /// }
    /// assert_eq!(at_rest(0.5), 0.5);
    /// ```
    pub fn over<M, A: IntoVector<M, Vector = V>>(q: A, p: A) -> Self {
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

/// A start for a system whose coordinates are a `V`: a [`State`] over that scalar, of that shape or of a list that has
/// its length.
///
/// Sizes in the type take `Vec`s, and sizes that are set at run time take arrays:
///
/// ```
/// use hamiltonian::prelude::*;
///
/// hamiltonian! {
///     /// Two masses on a spring.
///     pub struct Two {}
///     H(q[2]; p[2]) = norm_squared(p)/2 + (q[0] - q[1])^2/2
/// }
/// let begin = |q: &[f64]| {
///     let start = State::new(q, &vec![0.0; q.len()]);
///     Integrator::new(&Two {}, StormerVerlet::default(), start, 0.01)
/// };
/// assert!(begin(&[0.5, -0.5]).is_ok());
/// let error = begin(&[0.5, -0.5, 1.0]).err().map(|error| error.to_string());
/// assert_eq!(error.as_deref(), Some("`q` must have 2 components, found 3"));
/// ```
#[diagnostic::on_unimplemented(
    message = "the start does not have the shape of the system's coordinates",
    label = "expected a start of another shape",
    note = "coordinates `q[n]` take an array, a slice or a `Vec`, `State::new([0.5, 1.0], [0.0, 0.0])`; `q[n][3]` takes rows, `State::new(vec![[0.0; 3]; 2], vec![[0.0; 3]; 2])`; with more extents each element is a list of such lists"
)]
pub trait IntoStart<V: Vector> {
    /// The state, given the names of its coordinates and momenta for an error.
    ///
    /// # Errors
    /// [`InputError::Shape`] or [`InputError::Row`] if a list whose length the compiler does not know has another
    /// length than the type.
    fn into_start(self, names: [&str; 2]) -> Result<State<V>, Error>;
}

#[diagnostic::do_not_recommend]
impl<V: Vector, W: Fit<V, Scalar = V::Scalar>> IntoStart<V> for State<W> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn into_start(self, [q, p]: [&str; 2]) -> Result<State<V>, Error> {
        Ok(State {
            t: self.t,
            q: self.q.fit(q)?,
            p: self.p.fit(p)?,
        })
    }
}

/// Checks that a slice has as many elements as a state.
fn has_length(expected: usize, found: usize) -> Result<(), InputError> {
    match expected == found {
        true => Ok(()),
        false => Err(InputError::Shape {
            name: "state".into(),
            expected,
            found,
        }),
    }
}

/// The scalar of [`State::new`] and of the constructors that the macro emits: `f64` and nothing else.
///
/// It has one implementation, by which rustc finds the type of numbers that nothing else gives a type.
#[diagnostic::on_unimplemented(
    message = "states are made of numbers of type `f64`, found `{Self}`",
    label = "expected `f64` here",
    note = "over another scalar, and in code that is generic over scalars, write `over` for `new`, as in `State::over(q, p)`, and `state_from_velocity_over`"
)]
pub trait Plain: Real + sealed::Sealed {}

impl Plain for f64 {}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
}

/// Coordinates and momenta without a time, as a scheme carries them from step to step.
///
/// It is a [`Vector`] itself, its parts those of `q`, then those of `p`.
#[derive(Debug, Clone, PartialEq)]
pub struct Point<V> {
    /// Coordinates.
    pub q: V,
    /// Momenta.
    pub p: V,
}

/// Two vectors over one scalar as one: the parts of `x`, then those of `y`.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair<X, Y> {
    /// The first.
    pub x: X,
    /// The second.
    pub y: Y,
}

impl<H: Shape> Shape for Point<H> {
    type Vector<T: Real> = Point<H::Vector<T>>;
}

impl<V: Vector> Vector for Point<V> {
    type Scalar = V::Scalar;
    type Shape = Point<V::Shape>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn zeros_over<U: Real>(&self) -> Point<Over<V, U>> {
        Point {
            q: self.q.zeros_over(),
            p: self.p.zeros_over(),
        }
    }
    const PARTS: usize = 2 * V::PARTS;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, k: usize) -> &[V::Scalar] {
        if k < V::PARTS {
            self.q.part(k)
        } else {
            self.p.part(k - V::PARTS)
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
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
    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        Point {
            q: self.q.take(),
            p: self.p.take(),
        }
    }
    // Field by field: the compiler does not see through the numbers of parts.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_from(&mut self, other: &Self) {
        self.q.copy_from(&other.q);
        self.p.copy_from(&other.p);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn is_finite(&self) -> bool {
        self.q.is_finite() & self.p.is_finite()
    }
}

impl<X: Shape, Y: Shape> Shape for Pair<X, Y> {
    type Vector<T: Real> = Pair<X::Vector<T>, Y::Vector<T>>;
}

impl<X: Vector, Y: Vector<Scalar = X::Scalar>> Vector for Pair<X, Y> {
    type Scalar = X::Scalar;
    type Shape = Pair<X::Shape, Y::Shape>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn zeros_over<U: Real>(&self) -> Pair<Over<X, U>, Over<Y, U>> {
        Pair {
            x: self.x.zeros_over(),
            y: self.y.zeros_over(),
        }
    }
    const PARTS: usize = X::PARTS + Y::PARTS;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, k: usize) -> &[X::Scalar] {
        if k < X::PARTS {
            self.x.part(k)
        } else {
            self.y.part(k - X::PARTS)
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
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
    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        Pair {
            x: self.x.take(),
            y: self.y.take(),
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_from(&mut self, other: &Self) {
        self.x.copy_from(&other.x);
        self.y.copy_from(&other.y);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn is_finite(&self) -> bool {
        self.x.is_finite() & self.y.is_finite()
    }
}

/// The places of the elements of a vector in the order of the declaration: group after group, each row
/// after row. A part without extents is stored column after column.
fn places<V: Vector>(vector: &V) -> impl Iterator<Item = (usize, usize)> {
    (0..V::PARTS).flat_map(|k| {
        let columns = match vector.extents(k) {
            [] => vector.columns(k).max(1),
            _ => 1,
        };
        let rows = vector.part(k).len() / columns;
        (0..rows * columns).map(move |at| (k, at / columns + rows * (at % columns)))
    })
}

impl<V: Vector> State<V> {
    /// Coordinates, then momenta, each in the order of the declaration: `q[0][0], q[0][1], …, q[1][0], …`,
    /// group after group. The time is left out.
    ///
    /// Storage has another order, column after column: see [`Vector`].
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let bodies = State::new([[1.0, 2.0], [3.0, 4.0]], [[0.0; 2]; 2]);
    /// assert_eq!(bodies.to_vec()[..4], [1.0, 2.0, 3.0, 4.0]);
    /// assert_eq!(bodies.q.as_slice(), [1.0, 3.0, 2.0, 4.0]);
    /// ```
    #[must_use]
    pub fn to_vec(&self) -> Vec<V::Scalar> {
        let elements = |vector: &'_ V| -> Vec<V::Scalar> {
            places(vector).map(|(k, at)| vector.part(k)[at]).collect()
        };
        let mut all = elements(&self.q);
        all.extend(elements(&self.p));
        all
    }

    /// [`to_vec`](State::to_vec) into a slice, without allocating.
    ///
    /// # Errors
    /// [`InputError::Shape`] if the slice has another number of elements.
    pub fn write_to(&self, into: &mut [V::Scalar]) -> Result<(), Error> {
        let expected = self.q.len() + self.p.len();
        has_length(expected, into.len())?;
        let mut into = into.iter_mut();
        for vector in [&self.q, &self.p] {
            for ((k, at), to) in places(vector).zip(&mut into) {
                *to = vector.part(k)[at];
            }
        }
        Ok(())
    }

    /// The state at t = 0 with these coordinates, then momenta, in the order of [`to_vec`](State::to_vec).
    /// The shape is that of a vector of the system, as `zeros` makes it.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// let bodies = State::new([[1.0, 2.0], [3.0, 4.0]], [[5.0, 6.0]; 2]);
    /// assert_eq!(State::from_slice(&bodies.q, &bodies.to_vec())?, bodies);
    /// assert!(State::from_slice(&bodies.q, &[1.0; 7]).is_err());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`InputError::Shape`] if the slice has another number of elements.
    pub fn from_slice(shape: &V, values: &[V::Scalar]) -> Result<Self, Error> {
        has_length(2 * shape.len(), values.len())?;
        let mut state = State {
            t: V::Scalar::zero(),
            q: shape.zeros_like(),
            p: shape.zeros_like(),
        };
        let mut values = values.iter();
        for vector in [&mut state.q, &mut state.p] {
            for ((k, at), value) in places(shape).zip(&mut values) {
                vector.part_mut(k)[at] = *value;
            }
        }
        Ok(state)
    }

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
    #[cfg_attr(not(unoptimised), inline(always))]
    fn time(&self, clock: Self::Scalar) -> Self::Scalar {
        clock
    }
    /// About how long a step of the parameter `interval` takes from here where the time is carried.
    fn duration(&self, _interval: Self::Scalar) -> Option<Self::Scalar> {
        None
    }
    /// Returns true if all steps that are not refused have one duration.
    fn is_constant(&self) -> bool {
        true
    }
    /// The number of steps of the parameter `interval` that are sure to end within `time` from here where the time is
    /// carried, or 1.
    fn steps_within(&self, _interval: Self::Scalar, _time: Self::Scalar) -> u64 {
        1
    }
    /// Goes on with a step parameter `by` times as large, by steps of the same size, where the time is carried.
    fn rescale(&mut self, _by: Self::Scalar) {}
    /// How often the size of a step was refused or set anew; 0 for schemes that choose none. In several lanes, the number
    /// of the first.
    fn refused(&self) -> u64 {
        0
    }
}

impl<V: Vector> Carried for Point<V> {
    type Vector = V;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn point(&self) -> &Point<V> {
        self
    }
}

impl<V: Vector, Y: Vector<Scalar = V::Scalar>> Carried for Pair<Point<V>, Y> {
    type Vector = V;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn point(&self) -> &Point<V> {
        &self.x
    }
}

/// The shape of what a scheme carries for a system of the shape `H`: a [`Carried`] over each scalar. It is named as
/// vectors are, with the shape in their place: `Point<S::Shape>`, `Pair<Point<S::Shape>, S::Shape>`.
pub trait CarriedShape<H: Shape>: 'static {
    /// What is carried over a scalar.
    type Of<T: Real>: Carried<Scalar = T, Vector = H::Vector<T>>;
}

impl<H: Shape> CarriedShape<H> for Point<H> {
    type Of<T: Real> = Point<H::Vector<T>>;
}

impl<H: Shape, Y: Shape> CarriedShape<H> for Pair<Point<H>, Y> {
    type Of<T: Real> = Pair<Point<H::Vector<T>>, Y::Vector<T>>;
}

/// ∂H/∂q and ∂H/∂p.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient<V> {
    /// ∂H/∂q.
    pub q: V,
    /// ∂H/∂p.
    pub p: V,
}
