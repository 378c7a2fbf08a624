//! Gauss collocation of q̈ = −M⁻¹∂V/∂q.
//!
//! Input: H = ½ pᵀM⁻¹p + V(q, t). Output: [`GaussNystrom`]. Invariant: the steps are those of
//! [`Gauss`](super::Gauss), to rounding.

use super::collocation::{Collocation, constant};
use super::compensated::carry;
use super::iterate::{Contraction, iterate};
use super::stages::{Stages, extrapolation};
use crate::flow::Scratch;
use crate::map::{Cause, Map, Step};
use crate::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::state::{Pair, Point, State};
use crate::system::{Dynamics, QuadraticKinetic, Separable, System, Unforced};
use crate::vector::Vector;
use core::fmt;
use hamiltonian_lanes::{DoubleDouble, Mask, Real};

/// Gauss collocation with `S` stages where T is quadratic, in its second-order form: order 2S,
/// symplectic, time-reversible.
///
/// ```text
/// Lᵢ = −∂V/∂q(q[n] + cᵢh M⁻¹p[n] + h² M⁻¹ Σ (A²)ᵢⱼ Lⱼ, t[n] + cᵢh)
/// p[n+1] = p[n] + h Σ bᵢ Lᵢ,   q[n+1] = q[n] + h M⁻¹(p[n] + h Σ bᵢ(1 − cᵢ) Lᵢ)
/// ```
///
/// These are the steps of [`Gauss`](super::Gauss) with the velocities eliminated: half the unknowns, and a
/// fixed-point iteration that contracts with h² instead of h.
/// It begins with the forces of the step before, extrapolated. The low words that rounding takes from
/// `z[n+1]` are carried. Where the fixed point fails, as for steps longer than the fastest motion, the step
/// is an error: [`Gauss`](super::Gauss) has Newton's method.
///
/// Source: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I (1993), section
/// II.14, doi:10.1007/978-3-540-78862-1; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration
/// (2006), section VIII.6, doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// # impl hamiltonian_core::QuadraticKinetic for Oscillator {}
/// use hamiltonian_core::{Integrator, State, schemes::GaussNystrom};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, GaussNystrom::<4>::default(), start, 0.5)?;
/// assert!((run.advance(20)?.q[0] - 10.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct GaussNystrom<const S: usize> {
    coefficients: Collocation<S>,
    max_iterations: u32,
}

impl<const S: usize> Default for GaussNystrom<S> {
    /// At most 100 iterations.
    fn default() -> Self {
        GaussNystrom {
            coefficients: Collocation::gauss(),
            max_iterations: 100,
        }
    }
}

impl<const S: usize> GaussNystrom<S> {
    /// A step that is not solved after so many iterations is an error; 100 unless said here.
    #[must_use]
    pub fn at_most(self, max_iterations: u32) -> Self {
        GaussNystrom {
            max_iterations,
            ..self
        }
    }
}

/// The coefficients follow from S.
impl<const S: usize> fmt::Debug for GaussNystrom<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GaussNystrom")
            .field("stages", &S)
            .field("max_iterations", &self.max_iterations)
            .finish()
    }
}

impl<const S: usize> Listed for GaussNystrom<S> {
    fn entry(&self) -> Entry {
        Entry {
            name: "GaussNystrom",
            variant: "",
            equations: "",
            order: 2 * S as u32,
            duration: 1,
            needs: Needs::QuadraticKinetic,
            preserves: Form::OnePoint,
            source: "Hairer, Norsett, Wanner 1993, section II.14, doi:10.1007/978-3-540-78862-1",
        }
    }
}

symmetric!(GaussNystrom<S>, const S: usize);

/// The value [`GaussNystrom`] carries: the point; the forces at the stages of the last step; the low words of
/// the point.
pub type CarriesForces<V, const S: usize> = Pair<Point<V>, Pair<Stages<V, S>, Point<V>>>;

impl<T, S, const STAGES: usize> Scheme<T, S> for GaussNystrom<STAGES>
where
    T: Real,
    S: System<T> + Separable<T> + QuadraticKinetic + Unforced,
{
    type Map = Eliminated<T, S::Prepared, STAGES>;
    fn prepare(&self, prepared: &S::Prepared, step: Step<T>) -> Self::Map {
        let Collocation {
            nodes,
            weights,
            integrals,
            ..
        } = self.coefficients;
        let h = step.h;
        let one = DoubleDouble::from(1.0);
        let times = |of: DoubleDouble| constant::<T>(of) * h;
        // aᵢₖaₖⱼ with aᵢⱼ = μᵢⱼbⱼ.
        let double = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let mut sum = DoubleDouble::from(0.0);
                for k in 0..STAGES {
                    sum += integrals[i][k] * weights[k] * integrals[k][j] * weights[j];
                }
                constant::<T>(sum) * h
            })
        });
        Eliminated {
            dynamics: prepared.clone(),
            h,
            times: nodes.map(times),
            weights: weights.map(times),
            double,
            ends: core::array::from_fn(|i| times(weights[i] * (one - nodes[i]))),
            guess: extrapolation(&self.coefficients, step),
            limit: self.max_iterations,
        }
    }
    fn start(
        &self,
        _: &S::Prepared,
        state: &State<S::Vector>,
        _: T,
    ) -> CarriesForces<S::Vector, STAGES> {
        let point = state.point();
        let low = point.zeros_like();
        let forces = Stages(core::array::from_fn(|_| low.p.clone()));
        Pair {
            x: point,
            y: Pair { x: forces, y: low },
        }
    }
}

/// The map of [`GaussNystrom`].
#[derive(Debug, Clone)]
pub struct Eliminated<T: Real, P: Dynamics<T>, const S: usize> {
    dynamics: P,
    h: T,
    /// cᵢh.
    times: [T; S],
    /// bᵢh.
    weights: [T; S],
    /// (A²)ᵢⱼh.
    double: [[T; S]; S],
    /// bᵢ(1 − cᵢ)h.
    ends: [T; S],
    guess: [[T; S]; S],
    limit: u32,
}

/// The scratch of [`Eliminated`].
#[derive(Debug, Clone)]
pub struct EliminatedWork<V: Vector, const S: usize> {
    stage: V,
    impulse: V,
    moved: V,
    velocity: V,
    next: Stages<V, S>,
    guess: Stages<V, S>,
}

/// L ↦ −∂V/∂q.
struct Forces<'a, T: Real, P: Dynamics<T>, const S: usize> {
    map: &'a Eliminated<T, P, S>,
    t: T,
    point: &'a Point<P::Vector>,
    /// M⁻¹p.
    velocity: &'a P::Vector,
    stage: &'a mut P::Vector,
    impulse: &'a mut P::Vector,
    moved: &'a mut P::Vector,
}

impl<T: Real, P: Dynamics<T>, const S: usize> Contraction<Stages<P::Vector, S>>
    for Forces<'_, T, P, S>
{
    #[inline(always)]
    fn map(&mut self, forces: &Stages<P::Vector, S>, next: &mut Stages<P::Vector, S>) {
        let Point { q, p } = self.point;
        let map = self.map;
        for i in 0..S {
            let t = self.t + map.times[i];
            self.impulse.set_zero();
            for (factor, force) in map.double[i].iter().zip(&forces.0) {
                self.impulse.accumulate(*factor, force);
            }
            map.dynamics.gradient_p(t, q, self.impulse, self.moved);
            self.stage.set_zero();
            self.stage.accumulate(map.h, self.moved);
            self.stage.accumulate(map.times[i], self.velocity);
            self.stage.accumulate(T::one(), q);
            map.dynamics.gradient_q(t, self.stage, p, &mut next.0[i]);
            next.0[i].scale(-T::one());
        }
    }
    #[inline(always)]
    fn scale(&self, forces: &Stages<P::Vector, S>) -> T::Size {
        let stages = T::Size::constant(S as f64, 0.0);
        let h = self.map.h.size();
        stages * (self.point.q.size() / (h * h) + self.point.p.size() / h) + forces.size()
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize> Eliminated<T, P, S> {
    #[inline]
    fn solve(
        &self,
        t: T,
        z: &mut CarriesForces<P::Vector, S>,
        work: &mut EliminatedWork<P::Vector, S>,
    ) -> Cause {
        let Pair {
            x: point,
            y: Pair { x: forces, y: low },
        } = z;
        for (guess, row) in work.guess.0.iter_mut().zip(&self.guess) {
            guess.set_zero();
            for (factor, force) in row.iter().zip(&forces.0) {
                guess.accumulate(*factor, force);
            }
        }
        forces.copy_from(&work.guess);
        self.dynamics
            .gradient_p(t, &point.q, &point.p, &mut work.velocity);
        let mut equations = Forces {
            map: self,
            t,
            point,
            velocity: &work.velocity,
            stage: &mut work.stage,
            impulse: &mut work.impulse,
            moved: &mut work.moved,
        };
        let outcome = iterate(self.limit, &mut equations, forces, &mut work.next);
        let solved = outcome.solved.all();
        if !solved {
            forces.poison(!outcome.solved);
        }
        work.impulse.set_zero();
        for (j, force) in forces.0.iter().enumerate() {
            work.impulse.accumulate(self.ends[j], force);
            low.p.accumulate(self.weights[j], force);
        }
        self.dynamics
            .gradient_p(t, &point.q, &work.impulse, &mut work.moved);
        low.q.accumulate(self.h, &work.moved);
        low.q.accumulate(self.h, &work.velocity);
        carry(point, low);
        if solved {
            Cause::Overflow
        } else {
            outcome.cause()
        }
    }
}

impl<V: Vector, const S: usize> Scratch<CarriesForces<V, S>> for EliminatedWork<V, S> {
    fn like(like: &CarriesForces<V, S>) -> Self {
        let vector = || like.x.q.clone();
        EliminatedWork {
            stage: vector(),
            impulse: vector(),
            moved: vector(),
            velocity: vector(),
            next: like.y.x.clone(),
            guess: like.y.x.clone(),
        }
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize> Map for Eliminated<T, P, S> {
    type Carried = CarriesForces<P::Vector, S>;
    type Work = EliminatedWork<P::Vector, S>;

    #[inline(always)]
    fn body(&self, t: T, _: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.solve(t, z, work);
    }

    #[cold]
    fn explain(&self, t: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        self.solve(t, z, work)
    }
}
