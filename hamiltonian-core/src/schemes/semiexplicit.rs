//! The scheme on two copies that a multiplier projects to one point at every step.
//!
//! Input: a system without forces and a table of weights. Output: [`Semiexplicit`]. Invariant: a step begins with both
//! copies displaced from the point by opposite multipliers, and ends with one point; in between is the splitting of
//! H(q, p̃) + H(q̃, p).

use super::extended::Copies;
use super::projection::{Inner, inner};
use super::splitting::Splitting;
use super::stages::Stages;
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme, Symmetric};
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, Pair, Point, State};
use crate::systems::system::{System, Unforced, VectorOf};
use crate::systems::vector::{Vector, dot};
use hamiltonian_lanes::{Mask, Real};

/// The symmetric projection of Jayawardana and Ohsawa: symplectic in the original phase space for
/// every H, of the order of the table; explicit but for one multiplier.
///
/// With Ψ the splitting of H(q, p̃) + H(q̃, p) by the table `M`, the multiplier μ is found such that
/// both copies end at one point:
///
/// ```text
/// (a, b) = Ψ(z[n] + μ, z[n] − μ);   a + μ = b − μ = z[n+1]
/// ```
///
/// Solved by Broyden's method from the multipliers of the last two steps, until the defect
/// a − b + 2μ is rounding; some two to six applications of Ψ a step. Preserves dq∧dp, and all
/// quadratic invariants of H; time-reversible for symmetric tables.
///
/// Source: B. Jayawardana, T. Ohsawa, Math. Comp. 92 (2023) 251, eqs. 10 and 11, doi:10.1090/mcom/3778;
/// T. Ohsawa, SIAM J. Numer. Anal. 61 (2023) 1293, doi:10.1137/22M1517718.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::{Semiexplicit, Suzuki4};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, Semiexplicit::<Suzuki4>::default(), start, 0.1)?;
/// let end = run.advance(1_000)?;
/// // A quadratic H is preserved to rounding.
/// assert!((end.q[0].powi(2) + end.p[0].powi(2) - 1.0).abs() < 1_000.0 * 8.0 * f64::EPSILON);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Semiexplicit<M> {
    /// The splitting of the doubled space.
    table: M,
    /// A step that is not solved after so many iterations is an error.
    max_iterations: u32,
}

impl<M: Default> Default for Semiexplicit<M> {
    /// At most 50 iterations.
    fn default() -> Self {
        Semiexplicit::new(M::default())
    }
}

impl<M> Semiexplicit<M> {
    /// Returns the scheme with at most 50 iterations.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// use hamiltonian::schemes::{Semiexplicit, Suzuki4};
    ///
    /// let scheme = Semiexplicit::new(Suzuki4).with_max_iterations(50);
    /// assert_eq!(Semiexplicit::default(), scheme);
    /// ```
    #[must_use]
    pub fn new(table: M) -> Self {
        Semiexplicit {
            table,
            max_iterations: 50,
        }
    }

    /// The number of iterations after which an unsolved step is an error; 50 by default.
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
        Semiexplicit {
            max_iterations,
            ..self
        }
    }
}

impl<M: Splitting> Listed for Semiexplicit<M> {
    fn entry(&self) -> Entry {
        let of = self.table.entry();
        Entry {
            name: "Semiexplicit",
            variant: of.name,
            needs: Needs::UNFORCED,
            preserves: Form::OnePoint,
            source: "Jayawardana, Ohsawa 2023, eqs. 10 and 11, doi:10.1090/mcom/3778",
            ..of
        }
    }
}

symmetric!(Semiexplicit<M>, M: Splitting + Symmetric);

impl<S: System + Unforced, M: Splitting> Scheme<S> for Semiexplicit<M> {
    type Carried = Pair<Point<S::Shape>, Stages<Point<S::Shape>, 2>>;
    type Map<T: Real> = Projected<Inner<T, S, M>>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Projected {
            inner: inner::<T, S, M>(&self.table, prepared, step.h),
            limit: self.max_iterations,
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Pair<Point<VectorOf<S, T>>, Stages<Point<VectorOf<S, T>>, 2>> {
        let point = state.point();
        let none = point.zeros_like();
        Pair {
            x: point,
            y: Stages([none.clone(), none]),
        }
    }
}

/// The map of [`Semiexplicit`]: carries the multipliers of the last step and of the one before.
#[derive(Debug, Clone)]
pub struct Projected<M> {
    inner: M,
    limit: u32,
}

/// So many updates of the Jacobian; those after them would be rounding.
const UPDATES: usize = 6;

/// The scratch of [`Projected`].
#[derive(Debug, Clone)]
pub struct ProjectedWork<V: Vector, W> {
    inner: W,
    copies: Copies<V>,
    multiplier: Point<V>,
    end: Point<V>,
    step: Point<V>,
    /// The steps of Broyden's method, s₀ first, and 1/|s|² of each.
    steps: Stages<Point<V>, UPDATES>,
    inverse_squares: [V::Scalar; UPDATES],
}

impl<V: Vector, M: Map<Carried = Copies<V>>> Projected<M> {
    /// Broyden's method for μ, with the inverse Jacobian of the defect as products of the steps
    /// (C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations, 1995, section 7.3,
    /// doi:10.1137/1.9781611970944). It starts as ¼, the one for h = 0. A lane that is solved is not
    /// touched any more.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn solve(
        &self,
        t: V::Scalar,
        end: V::Scalar,
        z: &mut <Self as Map>::Carried,
        work: &mut ProjectedWork<V, M::Work>,
    ) -> Cause {
        type Size<V> = <<V as Vector>::Scalar as Real>::Size;
        let one = V::Scalar::one();
        let half = V::Scalar::constant(0.5, 0.0);
        let size = |x: f64| Size::<V>::constant(x, 0.0);
        let Pair {
            x: point,
            y: Stages([last, before]),
        } = z;
        // As if the multipliers went on along a line.
        let guess = &mut work.multiplier;
        guess.copy_from(last);
        guess.scale(V::Scalar::constant(2.0, 0.0));
        guess.accumulate(-one, before);
        let scale = point.size();
        let epsilon = V::Scalar::epsilon();
        let floor = size(ROUNDING * epsilon) * scale;
        let goal = size(epsilon) * scale;
        let worth = size(WORTH * epsilon) * scale;
        let mut solved = <<V::Scalar as Real>::Mask as Mask>::splat(false);
        let mut defect = size(f64::INFINITY);
        let mut residual = defect;
        let mut iterations = 0;
        let mut stored = 0;
        while iterations < self.limit {
            let Pair { x: a, y: b } = &mut work.copies;
            a.copy_from(point);
            a.accumulate(one, &work.multiplier);
            b.copy_from(point);
            b.accumulate(-one, &work.multiplier);
            (self.inner).step(t, end, &mut work.copies, &mut work.inner);
            iterations += 1;
            // The defect, and the mean of a + μ and b − μ.
            let Pair { x: a, y: b } = &mut work.copies;
            work.step.copy_from(a);
            work.step.accumulate(-one, b);
            work.step
                .accumulate(V::Scalar::constant(2.0, 0.0), &work.multiplier);
            a.scale(half);
            a.accumulate(half, b);
            work.end.copy_where(!solved, a);
            let now = work.step.size();
            residual = Size::<V>::select(solved, residual, now);
            let stalled = (size(STALLED) * defect).le(now) & now.lt(floor);
            let lost = !now.equals(now);
            solved = solved | now.le(goal) | stalled;
            if (solved | lost).all() {
                break;
            }
            defect = now;
            // −B·defect
            let z = &mut work.step;
            z.scale(V::Scalar::constant(-0.25, 0.0));
            let steps = &mut work.steps.0;
            for j in 1..stored {
                let factor = dot(&steps[j - 1], z) * work.inverse_squares[j - 1];
                z.accumulate(factor, &steps[j]);
            }
            if stored > 0 && stored < UPDATES {
                let shrink = dot(&steps[stored - 1], z) * work.inverse_squares[stored - 1];
                z.scale(one / (one - shrink));
            }
            if stored < UPDATES {
                // Steps as small as rounding say nothing about the Jacobian.
                let square = dot(z, z);
                let inverse =
                    V::Scalar::select(worth.lt(z.size()), one / square, V::Scalar::zero());
                work.inverse_squares[stored] = inverse;
                steps[stored].copy_from(z);
                stored += 1;
            }
            before.copy_from(&work.multiplier);
            before.accumulate(one, z);
            work.multiplier.copy_where(!solved, before);
        }
        before.copy_from(last);
        last.copy_from(&work.multiplier);
        point.copy_from(&work.end);
        if solved.all() {
            return Cause::Overflow;
        }
        point.poison(!solved);
        let lane = (!solved).first().unwrap_or(0);
        Cause::Unsolved {
            residual: residual.lane(lane),
            iterations,
        }
    }
}

/// A defect that no longer shrinks is rounding if it is at most this many ε of the point.
const ROUNDING: f64 = 1024.0;

/// A defect larger than this part of the one before does not shrink: rounding has its own limit, to
/// which it may come down for ever.
const STALLED: f64 = 0.9;

/// A step of this many ε of the point still says something about the Jacobian.
const WORTH: f64 = 1e4;

impl<V, W> Scratch<Pair<Point<V>, Stages<Point<V>, 2>>> for ProjectedWork<V, W>
where
    V: Vector,
    W: Scratch<Copies<V>>,
{
    fn like(like: &Pair<Point<V>, Stages<Point<V>, 2>>) -> Self {
        let point = || like.point().clone();
        let copies = Pair {
            x: point(),
            y: point(),
        };
        ProjectedWork {
            inner: W::like(&copies),
            copies,
            multiplier: point(),
            end: point(),
            step: point(),
            steps: Stages(core::array::from_fn(|_| point())),
            inverse_squares: [V::Scalar::zero(); UPDATES],
        }
    }
}

impl<V: Vector, M: Map<Carried = Copies<V>>> Map for Projected<M> {
    type Carried = Pair<Point<V>, Stages<Point<V>, 2>>;
    type Work = ProjectedWork<V, M::Work>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: V::Scalar, end: V::Scalar, z: &mut Self::Carried, work: &mut Self::Work) {
        self.solve(t, end, z, work);
    }

    #[cold]
    fn explain(
        &self,
        t: V::Scalar,
        end: V::Scalar,
        _: bool,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) -> Cause {
        let mut copies = Pair {
            x: z.x.clone(),
            y: z.x.clone(),
        };
        match self.solve(t, end, z, work) {
            Cause::Overflow => Cause::Overflow,
            // If the splitting itself leaves its domain, that is the cause.
            unsolved => match (self.inner).explain(t, end, true, &mut copies, &mut work.inner) {
                Cause::Piece(piece) if !copies.is_finite() => Cause::Piece(piece),
                _ => unsolved,
            },
        }
    }
}
