//! The implicit midpoint rule.
//!
//! Input: any system. Output: [`ImplicitMidpoint`]. Invariant: a step is finished only when its
//! equations hold to rounding; otherwise it is an error.

use crate::flows::iterate::{Contraction, iterate};
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::{Scratch, VectorField};
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The implicit midpoint rule (Gauss collocation with one stage): order 2, symplectic for every
/// H, time-reversible.
///
/// ```text
/// z[n+1] = z[n] + h J∇H((z[n] + z[n+1])/2, t[n] + h/2)
/// ```
///
/// Solved by fixed-point iteration from the slope of the step before, until the change of the
/// iterate is zero or stops shrinking. Preserves dq∧dp, and every quadratic invariant. A force is
/// part of the vector field.
///
/// Source: Feng Kang, Proc. 1984 Beijing Symp. Diff. Geometry and Diff. Equations (1985) 42; E.
/// Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), eq. II.1.4 and th.
/// VI.3.5, doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, ImplicitMidpoint::default(), start, 0.1)?;
/// let end = run.advance(1_000)?;
/// // q² + p² is quadratic: preserved to rounding, a few ulps a step.
/// assert!((end.q[0].powi(2) + end.p[0].powi(2) - 1.0).abs() < 1_000.0 * 4.0 * f64::EPSILON);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImplicitMidpoint {
    /// The number of iterations after which an unsolved step is an error.
    max_iterations: u32,
}

impl Default for ImplicitMidpoint {
    /// At most 100 iterations: enough for a contraction by 0.7 to reach rounding from 1.
    fn default() -> Self {
        ImplicitMidpoint {
            max_iterations: 100,
        }
    }
}

impl ImplicitMidpoint {
    /// The number of iterations after which an unsolved step is an error; 100 by default.
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
        ImplicitMidpoint { max_iterations }
    }
}

impl Listed for ImplicitMidpoint {
    fn entry(&self) -> Entry {
        Entry {
            name: "ImplicitMidpoint",
            variant: "",
            equations: "",
            order: 2,
            duration: 1,
            needs: Needs::ANY,
            preserves: Form::OnePoint,
            source: "Hairer, Lubich, Wanner 2006, eq. II.1.4, doi:10.1007/3-540-30666-8",
        }
    }
}

symmetric!(ImplicitMidpoint);

impl<S: System> Scheme<S> for ImplicitMidpoint {
    type Carried = Pair<Point<S::Shape>, Point<S::Shape>>;
    type Map<T: Real> = Midpoint<VectorOf<S, T>, <S::Prepared<T> as Dynamics<T>>::Field>;
    fn times_of_jumps(&self, _: &Description) -> [f64; 2] {
        [0.5; 2]
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Midpoint {
            field: prepared.field(T::one()),
            h: step.h,
            half: step.h * T::constant(0.5, 0.0),
            limit: self.max_iterations,
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Pair<Point<VectorOf<S, T>>, Point<VectorOf<S, T>>> {
        let point = state.point();
        let slope = point.zeros_like();
        Pair { x: point, y: slope }
    }
}

/// The map of [`ImplicitMidpoint`]: x is the point, y the slope J∇H of the last step, which is a guess
/// for a step of any size.
#[derive(Debug, Clone)]
pub struct Midpoint<V: Vector, F> {
    field: F,
    h: V::Scalar,
    half: V::Scalar,
    limit: u32,
}

/// The fixed-point equation slope ↦ J∇H(z + h/2·slope).
struct MidpointEquation<'a, V: Vector, F> {
    map: &'a Midpoint<V, F>,
    t: V::Scalar,
    point: &'a Point<V>,
    middle: &'a mut Point<V>,
}

impl<V: Vector, F: VectorField<V>> Contraction<Point<V>> for MidpointEquation<'_, V, F> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn map(&mut self, slope: &Point<V>, next: &mut Point<V>) {
        let (t, half, field) = (self.t, self.map.half, &self.map.field);
        self.middle.copy_from(self.point);
        next.set_zero();
        let Point { q, p } = next;
        if field.has_halves() {
            // The velocities, then the forces at the coordinates that they lead to: half as many iterations.
            self.middle.p.accumulate(half, &slope.p);
            field.add_half::<false>(t, &self.middle.p, q);
            self.middle.q.accumulate(half, q);
            field.add_half::<true>(t, &self.middle.q, p);
        } else {
            self.middle.accumulate(half, slope);
            field.add(t, &self.middle.q, &self.middle.p, q, p);
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self, slope: &Point<V>) -> <V::Scalar as Real>::Size {
        // The slope counts too, because a point at the origin has size 0.
        self.point.size() / self.map.h.size() + slope.size()
    }
}

/// The scratch of [`Midpoint`].
#[derive(Debug, Clone)]
pub struct MidpointWork<V: Vector> {
    middle: Point<V>,
    next: Point<V>,
}

impl<V: Vector, F: VectorField<V>> Midpoint<V, F> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn solve(
        &self,
        t: V::Scalar,
        z: &mut Pair<Point<V>, Point<V>>,
        work: &mut MidpointWork<V>,
    ) -> Cause {
        let Pair { x: point, y: slope } = z;
        let mut equation = MidpointEquation {
            map: self,
            t: t + self.half,
            point,
            middle: &mut work.middle,
        };
        let outcome = iterate(self.limit, &mut equation, slope, &mut work.next);
        if !outcome.solved.all() {
            slope.poison(!outcome.solved);
            point.accumulate(self.h, slope);
            return outcome.cause();
        }
        point.accumulate(self.h, slope);
        Cause::Overflow
    }
}

impl<V: Vector> Scratch<Pair<Point<V>, Point<V>>> for MidpointWork<V> {
    fn like(like: &Pair<Point<V>, Point<V>>) -> Self {
        MidpointWork {
            middle: like.x.clone(),
            next: like.x.clone(),
        }
    }
}

impl<V: Vector, F: VectorField<V>> Map for Midpoint<V, F> {
    type Carried = Pair<Point<V>, Point<V>>;
    type Work = MidpointWork<V>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: V::Scalar, _: V::Scalar, z: &mut Self::Carried, work: &mut Self::Work) {
        self.solve(t, z, work);
    }

    #[cold]
    fn explain(
        &self,
        t: V::Scalar,
        _: V::Scalar,
        _: bool,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) -> Cause {
        self.solve(t, z, work)
    }
}
