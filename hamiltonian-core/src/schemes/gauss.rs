//! Gauss collocation with any number of stages.
//!
//! Input: any system. Output: [`Gauss`]. Invariant: a step is finished only when its equations hold
//! to rounding; otherwise it is an error.

use super::collocation::Collocation;
use super::compensated::carry;
use super::iterate::{Contraction, iterate};
use super::newton::Linear;
use crate::flow::VectorField;
use crate::map::{Cause, Map, Step};
use crate::scheme::{Entry, Form, Listed, Needs, OneStep, Scheme};
use crate::state::{Pair, Point, State};
use crate::system::{Dynamics, System};
use crate::vector::Vector;
use core::fmt;
use hamiltonian_lanes::{DoubleDouble, Mask, Real};

/// Gauss collocation with `S` stages: order 2S, symplectic for every H, time-reversible.
///
/// ```text
/// Fᵢ = J∇H(z[n] + h Σ aᵢⱼ Fⱼ, t[n] + cᵢh);   z[n+1] = z[n] + h Σ bᵢ Fᵢ
/// ```
///
/// with Gauss' nodes c, weights b and aᵢⱼ = ∫₀^cᵢ ℓⱼ, for any S, from [`Collocation`]. Solved by
/// fixed-point iteration from the slopes of the step before, extrapolated, until the change of the
/// iterate is zero or stops shrinking; where that fails, as for steps longer than the fastest motion,
/// by Newton's method with the Hessian of H (up to 256 unknowns: all components of all stages). aᵢⱼ enters as bⱼμᵢⱼ with μᵢⱼ + μⱼᵢ = 1 exactly, so that dq∧dp
/// and quadratic invariants drift by rounding alone, and the low words that rounding takes from
/// `z[n+1]` are carried to the next step (compensated summation). A force is part of the vector field. With one
/// stage it is the [`ImplicitMidpoint`](super::ImplicitMidpoint) rule.
///
/// Which S: an evaluation of J∇H is made S times an iteration. Two stages serve errors of 1e-6, four to
/// six those of 1e-12, eight and more `DoubleDouble`.
///
/// Source: J. C. Butcher, Math. Comp. 18 (1964) 50, doi:10.1090/S0025-5718-1964-0159424-9; E. Hairer,
/// C. Lubich, G. Wanner, Geometric Numerical Integration (2006), sections II.1.3 and VIII.6,
/// doi:10.1007/3-540-30666-8; M. Antoñana, J. Makazaga, A. Murua, Numer. Algorithms 76 (2017) 861,
/// doi:10.1007/s11075-017-0287-z.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, State, schemes::Gauss};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, Gauss::<4>::default(), start, 0.5)?;
/// assert!((run.advance(20)?.q[0] - 10.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct Gauss<const S: usize> {
    coefficients: Collocation<S>,
    max_iterations: u32,
}

impl<const S: usize> Default for Gauss<S> {
    /// At most 100 iterations.
    fn default() -> Self {
        Gauss {
            coefficients: Collocation::gauss(),
            max_iterations: 100,
        }
    }
}

impl<const S: usize> Gauss<S> {
    /// A step that is not solved after so many iterations is an error.
    #[must_use]
    pub fn at_most(self, max_iterations: u32) -> Self {
        Gauss {
            max_iterations,
            ..self
        }
    }
}

/// The coefficients follow from S.
impl<const S: usize> fmt::Debug for Gauss<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Gauss")
            .field("stages", &S)
            .field("max_iterations", &self.max_iterations)
            .finish()
    }
}

impl<const S: usize> Listed for Gauss<S> {
    fn entry(&self) -> Entry {
        const STAGES: [&str; 17] = [
            "",
            "1 stage",
            "2 stages",
            "3 stages",
            "4 stages",
            "5 stages",
            "6 stages",
            "7 stages",
            "8 stages",
            "9 stages",
            "10 stages",
            "11 stages",
            "12 stages",
            "13 stages",
            "14 stages",
            "15 stages",
            "16 stages",
        ];
        Entry {
            name: "Gauss",
            variant: STAGES.get(S).copied().unwrap_or("more than 16 stages"),
            equations: "",
            order: 2 * S as u32,
            duration: 1,
            needs: Needs::Any,
            preserves: Form::OnePoint,
            source: "Hairer, Lubich, Wanner 2006, section II.1.3, doi:10.1007/3-540-30666-8",
        }
    }
}

impl<const S: usize> OneStep for Gauss<S> {
    type Adjoint = Self;
    fn adjoint(&self) -> Self {
        *self
    }
}

/// One vector a stage, as one vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Stages<X, const S: usize>(pub [X; S]);

impl<X: Vector, const S: usize> Vector for Stages<X, S> {
    type Scalar = X::Scalar;
    const PARTS: usize = S * X::PARTS;
    #[inline(always)]
    fn part(&self, k: usize) -> &[X::Scalar] {
        self.0[k / X::PARTS].part(k % X::PARTS)
    }
    #[inline(always)]
    fn part_mut(&mut self, k: usize) -> &mut [X::Scalar] {
        self.0[k / X::PARTS].part_mut(k % X::PARTS)
    }
    fn zeros_like(&self) -> Self {
        Stages(core::array::from_fn(|i| self.0[i].zeros_like()))
    }
    #[inline(always)]
    fn take(&mut self) -> Self {
        Stages(core::array::from_fn(|i| self.0[i].take()))
    }
}

impl<T: Real, S: System<T>, const STAGES: usize> Scheme<T, S> for Gauss<STAGES> {
    type Map = Collocated<T, S::Prepared, STAGES>;
    fn prepare(&self, prepared: &S::Prepared, step: Step<T>) -> Self::Map {
        let constant = |x: DoubleDouble| T::constant(x.hi(), x.lo());
        Collocated {
            field: prepared.field(T::one()),
            dynamics: prepared.clone(),
            h: step.h,
            times: self.coefficients.nodes.map(|c| constant(c) * step.h),
            weights: self.coefficients.weights.map(|b| constant(b) * step.h),
            integrals: self.coefficients.symplectic(),
            guess: extrapolation(&self.coefficients, step),
            limit: self.max_iterations,
        }
    }
    fn start(
        &self,
        _: &S::Prepared,
        state: &State<S::Vector>,
        _: T,
    ) -> <Self::Map as Map>::Carried {
        let point = state.point();
        let slope = point.zeros_like();
        Pair {
            x: point,
            y: Pair {
                y: slope.clone(),
                x: Stages(core::array::from_fn(|_| slope.clone())),
            },
        }
    }
}

/// The matrix that takes the slopes at the stages of the step before to guesses for this one's: the
/// slopes' polynomial, without its terms of degree 8 and more, whose extrapolation would be rounding;
/// their mean where the steps are too different.
fn extrapolation<T: Real, const S: usize>(method: &Collocation<S>, step: Step<T>) -> [[T; S]; S] {
    const TERMS: usize = 8;
    const FAR: f64 = 1.5;
    let constant = |x: DoubleDouble| T::constant(x.hi(), x.lo());
    let number = |x: usize| T::constant(x as f64, 0.0);
    let ratio = step.h / step.before;
    let terms = if ratio.magnitude() <= FAR {
        TERMS.min(S)
    } else {
        1
    };
    // Legendre's polynomials of x on [−1, 1]: Pₖ and Pₖ₋₁.
    let next = |k: usize, x: T, (value, before): (T, T)| {
        let next = (number(2 * k + 1) * x * value - number(k) * before) / number(k + 1);
        (next, value)
    };
    let two = number(2);
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let there = two * constant(method.nodes[j]) - T::one();
            // One step on, in units of the step before.
            let here = T::one() + two * constant(method.nodes[i]) * ratio;
            let (mut at_j, mut at_i) = ((T::one(), T::zero()), (T::one(), T::zero()));
            let mut sum = T::zero();
            for k in 0..terms {
                sum += number(2 * k + 1) * at_j.0 * at_i.0;
                at_j = next(k, there, at_j);
                at_i = next(k, here, at_i);
            }
            constant(method.weights[j]) * sum
        })
    })
}

/// What [`Gauss`] carries: the point; the slopes J∇H at the stages of the last step, which make a guess
/// for a step of any size; the low words of the point.
pub type Carries<V, const S: usize> = Pair<Point<V>, Pair<Stages<Point<V>, S>, Point<V>>>;

/// The map of [`Gauss`].
#[derive(Debug, Clone)]
pub struct Collocated<T: Real, P: Dynamics<T>, const S: usize> {
    field: P::Field,
    dynamics: P,
    h: T,
    /// cᵢh.
    times: [T; S],
    /// bᵢh.
    weights: [T; S],
    /// μᵢⱼ.
    integrals: [[T; S]; S],
    guess: [[T; S]; S],
    limit: u32,
}

/// The scratch of [`Collocated`].
#[derive(Debug, Clone)]
pub struct CollocatedWork<V: Vector, const S: usize> {
    stage: Point<V>,
    increments: Stages<Point<V>, S>,
    next: Stages<Point<V>, S>,
    guess: Stages<Point<V>, S>,
    linear: Linear<V>,
}

/// F ↦ J∇H(z + h Σ aᵢⱼFⱼ).
struct Slopes<'a, T: Real, P: Dynamics<T>, const S: usize> {
    map: &'a Collocated<T, P, S>,
    t: T,
    point: &'a Point<P::Vector>,
    stage: &'a mut Point<P::Vector>,
    increments: &'a mut Stages<Point<P::Vector>, S>,
}

impl<T: Real, P: Dynamics<T>, const S: usize> Slopes<'_, T, P, S> {
    /// The point at stage `i`, from the increments.
    #[inline(always)]
    fn stage(&mut self, i: usize) {
        // The small numbers first.
        self.stage.set_zero();
        for (integral, increment) in self.map.integrals[i].iter().zip(&self.increments.0) {
            self.stage.accumulate(*integral, increment);
        }
        self.stage.accumulate(T::one(), self.point);
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize> Contraction<Stages<Point<P::Vector>, S>>
    for Slopes<'_, T, P, S>
{
    #[inline(always)]
    fn map(
        &mut self,
        slopes: &Stages<Point<P::Vector>, S>,
        next: &mut Stages<Point<P::Vector>, S>,
    ) {
        self.map.increments(slopes, self.increments);
        for i in 0..S {
            self.stage(i);
            let Point { q, p } = &mut next.0[i];
            q.set_zero();
            p.set_zero();
            let t = self.t + self.map.times[i];
            self.map.field.add(t, &self.stage.q, &self.stage.p, q, p);
        }
    }
    #[inline(always)]
    fn scale(&self, slopes: &Stages<Point<P::Vector>, S>) -> T::Size {
        // The slopes count too: a point at the origin has no size of its own.
        let stages = T::Size::constant(S as f64, 0.0);
        stages * self.point.size() / self.map.h.size() + slopes.size()
    }
}

/// F ↦ F + (1 − hA⊗J∇²H)⁻¹(J∇H(z + h Σ aᵢⱼFⱼ) − F), a step of Newton's method. Of a force the
/// derivative is left out.
struct Newton<'a, 'b, T: Real, P: Dynamics<T>, const S: usize> {
    slopes: Slopes<'a, T, P, S>,
    linear: &'b mut Linear<P::Vector>,
}

impl<T: Real, P: Dynamics<T>, const S: usize> Contraction<Stages<Point<P::Vector>, S>>
    for Newton<'_, '_, T, P, S>
{
    fn map(
        &mut self,
        slopes: &Stages<Point<P::Vector>, S>,
        next: &mut Stages<Point<P::Vector>, S>,
    ) {
        self.slopes.map(slopes, next);
        next.accumulate(-T::one(), slopes);
        let map = self.slopes.map;
        for i in 0..S {
            self.slopes.stage(i);
            let (t, row) = (self.slopes.t + map.times[i], &map.integrals[i]);
            let a = |j: usize| row[j] * map.weights[j];
            self.linear
                .linearise(&map.dynamics, t, self.slopes.stage, i, S, a);
        }
        self.linear.solve(next);
        next.accumulate(T::one(), slopes);
    }
    fn scale(&self, slopes: &Stages<Point<P::Vector>, S>) -> T::Size {
        self.slopes.scale(slopes)
    }
}

/// Newton's method doubles digits: so many steps are enough, or none.
const NEWTON: u32 = 30;

impl<T: Real, P: Dynamics<T>, const S: usize> Collocated<T, P, S> {
    /// bⱼhFⱼ.
    #[inline(always)]
    fn increments(
        &self,
        slopes: &Stages<Point<P::Vector>, S>,
        increments: &mut Stages<Point<P::Vector>, S>,
    ) {
        for j in 0..S {
            increments.0[j].copy_from(&slopes.0[j]);
            increments.0[j].scale(self.weights[j]);
        }
    }

    #[inline]
    fn solve(
        &self,
        t: T,
        z: &mut Carries<P::Vector, S>,
        work: &mut CollocatedWork<P::Vector, S>,
    ) -> Cause {
        let Pair {
            x: point,
            y: Pair { x: slopes, y: low },
        } = z;
        for (guess, row) in work.guess.0.iter_mut().zip(&self.guess) {
            guess.set_zero();
            for (factor, slope) in row.iter().zip(&slopes.0) {
                guess.accumulate(*factor, slope);
            }
        }
        slopes.copy_from(&work.guess);
        let mut equations = Slopes {
            map: self,
            t,
            point,
            stage: &mut work.stage,
            increments: &mut work.increments,
        };
        let mut outcome = iterate(self.limit, &mut equations, slopes, &mut work.next);
        if !outcome.solved.all() && work.linear.fits() {
            let fixed = outcome.solved;
            // Over so long a step the last one's slopes say nothing: all stages at the point.
            work.guess.set_zero();
            let mut newton = Newton {
                slopes: equations,
                linear: &mut work.linear,
            };
            outcome = iterate(NEWTON, &mut newton, &mut work.guess, &mut work.next);
            // Lanes that were solved know nothing of those that were not.
            slopes.copy_where(!fixed, &work.guess);
            outcome.solved = outcome.solved | fixed;
        }
        let solved = outcome.solved.all();
        if !solved {
            slopes.poison(!outcome.solved);
        }
        self.increments(slopes, &mut work.increments);
        for increment in &work.increments.0 {
            low.accumulate(T::one(), increment);
        }
        carry(point, low);
        if solved {
            Cause::Overflow
        } else {
            outcome.cause()
        }
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize> Map for Collocated<T, P, S> {
    type Carried = Carries<P::Vector, S>;
    type Work = CollocatedWork<P::Vector, S>;

    fn work(&self, like: &Self::Carried) -> Self::Work {
        let stages = || like.y.x.clone();
        CollocatedWork {
            stage: like.x.clone(),
            increments: stages(),
            next: stages(),
            guess: stages(),
            linear: Linear::new(&like.x, S),
        }
    }

    #[inline(always)]
    fn body(&self, t: T, _: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.solve(t, z, work);
    }

    #[cold]
    fn explain(&self, t: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        self.solve(t, z, work)
    }
}
