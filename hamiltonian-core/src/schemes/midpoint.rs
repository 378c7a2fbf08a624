//! The implicit midpoint rule.
//!
//! Input: any system. Output: [`ImplicitMidpoint`]. Invariant: a step is finished only when its
//! equations hold to rounding; otherwise it is an error.

use crate::scheme::{Clock, Entry, Form, Listed, Needs, Scheme, Stepper, Unsolved};
use crate::state::{Pair, Point, State};
use crate::system::{Dynamics, Flow, System};
use crate::vector::Vector;
use hamiltonian_lanes::Real;

/// The implicit midpoint rule (Gauss collocation with one stage): order 2, symplectic for every
/// H, time-reversible.
///
/// ```text
/// z[n+1] = z[n] + h J∇H((z[n] + z[n+1])/2, t[n] + h/2)
/// ```
///
/// Solved by fixed-point iteration from the increment of the step before, until the change of the
/// iterate is zero or stops shrinking. Preserves dq∧dp, and every quadratic invariant.
///
/// Source: Feng Kang, Proc. 1984 Beijing Symp. Diff. Geometry and Diff. Equations (1985) 42; E.
/// Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), eq. II.1.4 and th.
/// VI.3.5, doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, State, schemes::ImplicitMidpoint};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, ImplicitMidpoint::default(), start, 0.1)?;
/// let end = run.advance(1_000)?;
/// // q² + p² is quadratic: preserved to rounding, a few ulps a step.
/// assert!((end.q[0].powi(2) + end.p[0].powi(2) - 1.0).abs() < 1_000.0 * 4.0 * f64::EPSILON);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImplicitMidpoint {
    /// A step that is not solved after so many iterations is an error.
    pub max_iterations: u32,
}

impl Default for ImplicitMidpoint {
    /// At most 100 iterations: enough for a contraction by 0.7 to reach rounding from 1.
    fn default() -> Self {
        ImplicitMidpoint {
            max_iterations: 100,
        }
    }
}

impl Listed for ImplicitMidpoint {
    fn entry(&self) -> &'static Entry {
        &Entry {
            name: "ImplicitMidpoint",
            variant: "",
            equations: "",
            order: 2,
            duration: 1,
            needs: Needs::Any,
            preserves: Form::OnePoint,
            source: "Hairer, Lubich, Wanner 2006, eq. II.1.4, doi:10.1007/3-540-30666-8",
        }
    }
}

impl<T: Real, S: System<T>> Scheme<T, S> for ImplicitMidpoint {
    type Stepper = Midpoint<S::Vector, <S::Prepared as Dynamics<T>>::Flow>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        let point = Point {
            q: start.q.clone(),
            p: start.p.clone(),
        };
        let zero = point.zeros_like();
        Midpoint {
            clock: Clock {
                start: start.t,
                interval: step,
            },
            flow: prepared.flow(step),
            max_iterations: self.max_iterations,
            middle: zero.clone(),
            next: zero.clone(),
            carried: Pair { x: point, y: zero },
        }
    }
}

/// The stepper of [`ImplicitMidpoint`]: x is the point, y the last increment.
#[derive(Debug, Clone)]
pub struct Midpoint<V: Vector, F: Flow<V>> {
    clock: Clock<V::Scalar>,
    flow: F,
    max_iterations: u32,
    middle: Point<V>,
    next: Point<V>,
    carried: Pair<Point<V>, Point<V>>,
}

/// A change that no longer shrinks is rounding if it is at most this many ε of the point:
/// evaluations of J∇H may lose three decimal digits by cancellation.
const ROUNDING: f64 = 1024.0;

impl<V: Vector, F: Flow<V>> Midpoint<V, F> {
    #[inline(always)]
    fn step(&mut self, made: u64) -> Result<(), Unsolved> {
        let half = V::Scalar::constant(0.5, 0.0);
        let t = self.clock.at(made) + self.clock.interval * half;
        let Pair {
            x: point,
            y: increment,
        } = &mut self.carried;
        let size = point.magnitude();
        let mut before = f64::INFINITY;
        let mut iterations = 0;
        loop {
            self.middle.copy_from(point);
            self.middle.accumulate(half, increment);
            self.next.set_zero();
            let Point { q, p } = &mut self.next;
            self.flow.flow(t, &self.middle.q, &self.middle.p, q, p);
            let change = self.next.distance(increment);
            increment.copy_from(&self.next);
            iterations += 1;
            // The increment counts too: a point at the origin has no size of its own.
            let rounding = ROUNDING * V::Scalar::epsilon() * (size + increment.magnitude());
            if change == 0.0 || (change <= rounding && change >= before) {
                point.accumulate(V::Scalar::one(), increment);
                return Ok(());
            }
            if change.is_nan() || iterations >= self.max_iterations {
                return Err(Unsolved {
                    made,
                    residual: change,
                    iterations,
                });
            }
            before = change;
        }
    }
}

impl<V: Vector, F: Flow<V>> Stepper for Midpoint<V, F> {
    type Vector = V;
    type Carried = Pair<Point<V>, Point<V>>;

    #[inline(always)]
    fn carried(&self) -> &Self::Carried {
        &self.carried
    }

    #[inline(always)]
    fn carried_mut(&mut self) -> &mut Self::Carried {
        &mut self.carried
    }

    #[inline(always)]
    fn run(&mut self, made: u64, n: u64) -> Result<(), Unsolved> {
        for k in made..made + n {
            self.step(k)?;
        }
        Ok(())
    }

    #[inline(always)]
    fn synchronise(&mut self, _: u64, q: &mut V, p: &mut V) {
        q.copy_from(&self.carried.x.q);
        p.copy_from(&self.carried.x.p);
    }
}
