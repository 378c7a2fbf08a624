//! Gauss collocation of q̈ = −M⁻¹∂V/∂q.
//!
//! Input: H = ½ pᵀM⁻¹p + V(q, t). Output: [`GaussNystrom`]. Invariant: the steps are those of
//! [`Gauss`](super::Gauss), to rounding.

mod beside;

use super::bundles::{
    Abreast, Apart, Equations, StageLayout, Width, bundles, of_the_guess, product, replace, solve,
    spread, sum,
};
use super::collocation::{Collocation, multiples, whole_ulps};
use super::compensated::carry;
use super::staged::{Inspect, StagedMap};
use super::stages::{Stages, extrapolation};
use crate::flows::iterate::Outcome;
use crate::flows::map::{Cause, Clock, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::gather::{Kept, in_lanes};
use crate::systems::system::{
    Description, Dynamics, QuadraticKinetic, Separable, System, Unforced, VectorOf,
};
use crate::systems::vector::Vector;
use beside::NystromStepsBeside;
use core::fmt;
use hamiltonian_lanes::{DoubleDouble, Mask, Real};

/// Gauss collocation with S = `STAGES` stages for a quadratic T, in its second-order form: order 2S,
/// symplectic, time-reversible.
///
/// ```text
/// Lᵢ = −∂V/∂q(q[n] + cᵢh M⁻¹p[n] + h² M⁻¹ Σ (A²)ᵢⱼ Lⱼ, t[n] + cᵢh)
/// p[n+1] = p[n] + h Σ bᵢ Lᵢ,   q[n+1] = q[n] + h M⁻¹(p[n] + h Σ bᵢ(1 − cᵢ) Lᵢ)
/// ```
///
/// These are the steps of [`Gauss`](super::Gauss) with the velocities eliminated: half the unknowns, and a
/// fixed-point iteration that contracts with h² instead of h.
/// It begins with the forces of the step before, extrapolated, and ends as [`Gauss`](super::Gauss)' does; its
/// stages lie in lanes as well. The low words that rounding takes from
/// `z[n+1]` are carried. Where the fixed point fails, as for steps longer than the fastest motion, the step
/// is an error: [`Gauss`](super::Gauss) has Newton's method.
///
/// Source: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I (1993), section
/// II.14, doi:10.1007/978-3-540-78862-1; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration
/// (2006), section VIII.6, doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, GaussNystrom::<4>::default(), start, 0.5)?;
/// assert!((run.advance(20)?.q[0] - 10.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct GaussNystrom<const STAGES: usize> {
    pub(super) coefficients: Collocation<STAGES>,
    max_iterations: u32,
}

impl<const S: usize> Default for GaussNystrom<S> {
    /// At most 100 iterations.
    fn default() -> Self {
        GaussNystrom::<S>::default()
    }
}

impl<const STAGES: usize> GaussNystrom<STAGES> {
    /// Returns the scheme with at most 100 iterations of each method, as [`Default`] does.
    #[must_use]
    // If the number of stages is missing, rustc asks for it only if `default` is an inherent method.
    #[allow(clippy::should_implement_trait)]
    pub fn default() -> Self {
        GaussNystrom {
            coefficients: Collocation::gauss(),
            max_iterations: 100,
        }
    }

    /// The number of iterations of the fixed point, and then of Newton's method, after which an unsolved step is an error;
    /// 100 by default.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// assert_eq!(GaussNystrom::<2>::default(), GaussNystrom::<2>::default().with_max_iterations(100));
    /// ```
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
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
            variant: super::gauss::stages(S),
            equations: "",
            order: 2 * S as u32,
            duration: 1,
            needs: Needs::SEPARABLE
                .and(Needs::QUADRATIC_KINETIC)
                .and(Needs::UNFORCED),
            preserves: Form::OnePoint,
            source: "Hairer, Norsett, Wanner 1993, section II.14, doi:10.1007/978-3-540-78862-1",
        }
    }
}

symmetric!(GaussNystrom<S>, const S: usize);

/// The value [`GaussNystrom`] carries: the point; ∂V/∂q at the stages of the last step; the low words of the
/// point.
pub type CarriesForces<V, const S: usize> = Pair<Point<V>, Pair<Stages<V, S>, Point<V>>>;

/// No short fraction.
const GOLDEN: f64 = 0.381_966_011_250_105_15;

impl<S, const STAGES: usize> Scheme<S> for GaussNystrom<STAGES>
where
    S: System + Separable + QuadraticKinetic + Unforced,
{
    type Carried = CarriesForces<S::Shape, STAGES>;
    type Map<T: Real> = Eliminated<T, S::Prepared<T>, STAGES>;
    fn times_of_jumps(&self, _: &Description) -> [f64; 2] {
        self.coefficients.ends()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let h = step.h;
        let (times, double) = self.coefficients.symplectic_double(h);
        let weights = multiples(&self.coefficients.weights, -h);
        let guess = extrapolation(&self.coefficients, step);
        let first = whole_ulps(DoubleDouble::from(GOLDEN), h);
        Eliminated {
            dynamics: prepared.clone(),
            h,
            times,
            double: [of_the_guess(&double, &weights, &guess), double],
            weights,
            ends: times.map(|time| h - time),
            drifts: [first, h - first],
            limit: self.max_iterations,
            is_part: false,
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> CarriesForces<VectorOf<S, T>, STAGES> {
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
    /// −bᵢh.
    weights: [T; S],
    /// νᵢⱼh = (A²)ᵢⱼh/bⱼ with νᵢⱼh − νⱼᵢh = cᵢh − cⱼh exactly; before it that of the guess, for ∂V/∂q of the
    /// step before.
    double: [[[T; S]; S]; 2],
    /// h − cᵢh exactly.
    ends: [T; S],
    /// Two durations whose sum is h exactly: where h is a short decimal fraction, hM⁻¹p is
    /// often halfway between two numbers, but for the rounding of h, and so rounded to one side.
    drifts: [T; 2],
    limit: u32,
    /// True if the forces are a guess for the step itself, see [`StagedMap::make_part`].
    is_part: bool,
}

/// The scratch of [`Eliminated`].
#[derive(Debug, Clone)]
pub struct EliminatedWork<V: Vector, const S: usize> {
    bundles: BundleScratch<V, S>,
    sums: Sums<V>,
    kept: Kept,
}

/// The scratch of a step over bundles of stages.
#[derive(Debug, Clone)]
struct BundleScratch<X: Vector, const S: usize> {
    points: Stages<X, S>,
    free: Stages<X, S>,
    moved: X,
    next: X,
}

impl<X: Vector, const S: usize> BundleScratch<X, S> {
    fn new(zero: &X) -> Self {
        let stages = Stages(core::array::from_fn(|_| zero.clone()));
        BundleScratch {
            points: stages.clone(),
            free: stages,
            moved: zero.clone(),
            next: zero.clone(),
        }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        BundleScratch {
            points: self.points.take(),
            free: self.free.take(),
            moved: self.moved.take(),
            next: self.next.take(),
        }
    }
}

/// The scratch of a step over the scalar.
#[derive(Debug, Clone)]
struct Sums<V> {
    /// M⁻¹p.
    velocity: V,
    impulse: V,
    moved: V,
}

/// The tableau of a Nyström method for steps of one size, in bundles of stages.
struct NystromTableau<'a, T, R, const S: usize> {
    h: T,
    times: &'a [R; S],
    weights: &'a [R; S],
    /// In one array, so that they are read where they are: of two, compilers copy one.
    double: &'a [[[R; S]; S]; 2],
    ends: &'a [R; S],
    drifts: [T; 2],
}

/// ∂V/∂q at the stages ↦ ∂V/∂q at the points they lead to.
struct SecondOrder<'a, T: Real, L: StageLayout<T>, D, V: Vector, X, const S: usize> {
    tableau: &'a NystromTableau<'a, T, L::Bundle, S>,
    dynamics: &'a D,
    t: L::Bundle,
    point: &'a Point<V>,
    /// q + cᵢhM⁻¹p.
    free: &'a [X; S],
    moved: &'a mut X,
}

impl<T, L, D, V, X, const S: usize> Equations<T, L, S> for SecondOrder<'_, T, L, D, V, X, S>
where
    T: Real,
    L: StageLayout<T>,
    D: Dynamics<L::Bundle, Vector = X>,
    V: Vector<Scalar = T>,
    X: Vector<Scalar = L::Bundle>,
{
    type Unknowns = X;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn points(&self, _: usize, matrix: usize, gradients: &[X; S], points: &mut [X; S]) {
        let matrix = &self.tableau.double[matrix];
        for k in 0..X::PARTS {
            for i in 0..points[0].part(k).len() {
                let few = spread::<T, L, _, 1, S>([self.tableau.weights], gradients, k, i);
                for (point, bundle) in points[..bundles::<T, L, S>()].iter_mut().zip(matrix) {
                    point.part_mut(k)[i] = product::<T, L, S>(bundle, &few);
                }
            }
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn improve(
        &mut self,
        (_, bundle): (usize, usize),
        solved: T::Mask,
        impulse: &mut X,
        gradients: &mut X,
        next: &mut X,
    ) -> <L::Bundle as Real>::Size {
        let t = self.t + self.tableau.times[bundle];
        let free = &self.free[bundle];
        self.dynamics.gradient_p(t, free, impulse, self.moved);
        self.moved.accumulate(L::Bundle::one(), free);
        self.dynamics.gradient_q(t, self.moved, impulse, next);
        replace::<T, L, _>(solved, next, gradients)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self) -> T::Size {
        let h = self.tableau.h.size();
        (self.point.q.size() / h + self.point.p.size()) / h
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize> Eliminated<T, P, S> {
    /// Solves for ∂V/∂q at the stages of the step from `t`, from those of the step before.
    #[allow(clippy::too_many_arguments)]
    #[cfg_attr(not(unoptimised), inline(always))]
    fn fixed_point<L, D>(
        &self,
        tableau: &NystromTableau<'_, T, L::Bundle, S>,
        dynamics: &D,
        t: T,
        point: &Point<P::Vector>,
        gradients: &mut [D::Vector; S],
        scratch: &mut BundleScratch<D::Vector, S>,
        sums: &mut Sums<P::Vector>,
    ) -> Outcome<T>
    where
        L: StageLayout<T>,
        D: Dynamics<L::Bundle>,
    {
        let Point { q, p } = point;
        self.dynamics.gradient_p(t, q, p, &mut sums.velocity);
        let BundleScratch {
            points,
            free,
            moved,
            next,
        } = scratch;
        for k in 0..P::Vector::PARTS {
            for i in 0..q.part(k).len() {
                let q = L::splat(q.part(k)[i]);
                let velocity = L::splat(sums.velocity.part(k)[i]);
                for bundle in 0..bundles::<T, L, S>() {
                    free.0[bundle].part_mut(k)[i] = tableau.times[bundle].fma(velocity, q);
                }
            }
        }
        let mut equations = SecondOrder::<T, L, D, _, _, S> {
            tableau,
            dynamics,
            t: L::splat(t),
            point,
            free: &free.0,
            moved,
        };
        solve(
            (self.limit, self.is_part),
            &mut equations,
            gradients,
            &mut points.0,
            next,
        )
    }

    /// Moves the point and its low words.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn finish<L, X>(
        &self,
        tableau: &NystromTableau<'_, T, L::Bundle, S>,
        t: T,
        gradients: &[X; S],
        point: &mut Point<P::Vector>,
        low: &mut Point<P::Vector>,
        sums: &mut Sums<P::Vector>,
    ) where
        L: StageLayout<T>,
        X: Vector<Scalar = L::Bundle>,
    {
        for k in 0..P::Vector::PARTS {
            for i in 0..low.p.part(k).len() {
                let factors = [tableau.weights, tableau.ends];
                let few = spread::<T, L, _, 2, S>(factors, gradients, k, i);
                sums.impulse.part_mut(k)[i] = sum::<T, L, S>(&few);
                let few = spread::<T, L, _, 1, S>([tableau.weights], gradients, k, i);
                low.p.part_mut(k)[i] += sum::<T, L, S>(&few);
            }
        }
        self.dynamics
            .gradient_p(t, &point.q, &sums.impulse, &mut sums.moved);
        low.q.accumulate(T::one(), &sums.moved);
        for duration in tableau.drifts {
            low.q.accumulate(duration, &sums.velocity);
        }
        carry(point, low);
    }

    /// Makes `to` the map for steps `by` times as long, to rounding.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn resize(&self, by: T, to: &mut Self) {
        to.h = self.h * by;
        for i in 0..S {
            to.times[i] = self.times[i] * by;
            to.weights[i] = self.weights[i] * by;
            to.ends[i] = self.ends[i] * by;
            for j in 0..S {
                to.double[0][i][j] = self.double[0][i][j] * by;
                to.double[1][i][j] = self.double[1][i][j] * by;
            }
        }
        to.drifts[0] = self.drifts[0] * by;
        to.drifts[1] = self.drifts[1] * by;
    }

    /// Lets the fixed point fail after so many iterations.
    pub(super) fn restrict(&mut self, limit: u32) {
        self.limit = self.limit.min(limit);
    }

    fn tableau(&self) -> NystromTableau<'_, T, T, S> {
        NystromTableau {
            h: self.h,
            times: &self.times,
            weights: &self.weights,
            double: &self.double,
            ends: &self.ends,
            drifts: self.drifts,
        }
    }

    /// The rest of a step: the new point.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn complete(
        &self,
        t: T,
        outcome: Outcome<T>,
        z: &mut CarriesForces<P::Vector, S>,
        sums: &mut Sums<P::Vector>,
    ) -> Cause {
        let Pair { x: point, y } = z;
        let solved = outcome.solved.all();
        if !solved {
            y.x.poison(!outcome.solved);
        }
        self.finish::<Apart, _>(&self.tableau(), t, &y.x.0, point, &mut y.y, sums);
        if solved {
            Cause::Overflow
        } else {
            outcome.cause()
        }
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize> StagedMap<S> for Eliminated<T, P, S> {
    type Unknowns = P::Vector;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn unknowns(z: &mut CarriesForces<P::Vector, S>) -> &mut [P::Vector; S] {
        &mut z.y.x.0
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn multiples(&self) -> (T, &[T; S], &[T; S]) {
        (self.h, &self.times, &self.weights)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part_of_size(&self, by: T) -> Self {
        let mut part = self.clone();
        self.resize(by, &mut part);
        part.is_part = true;
        part
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_unknowns(
        &self,
        by: T,
        t: T,
        z: &mut CarriesForces<P::Vector, S>,
        work: &mut EliminatedWork<P::Vector, S>,
    ) {
        let (Pair { x: point, y }, sums) = (z, &mut work.sums);
        self.dynamics
            .gradient_p(t, &point.q, &point.p, &mut sums.velocity);
        let [weights, ends] = [self.weights, self.ends].map(|all| all.map(|x| x * by));
        let tableau = NystromTableau {
            weights: &weights,
            ends: &ends,
            drifts: self.drifts.map(|duration| duration * by),
            ..self.tableau()
        };
        self.finish::<Apart, _>(&tableau, t, &y.x.0, point, &mut y.y, sums);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn steps_beside<const WIDTH: usize, W: Inspect<T, P::Vector, S>>(
        &self,
        sized: &Self,
        (clock, made, n): (Clock<T>, u64, u64),
        z: &mut CarriesForces<P::Vector, S>,
        work: &mut EliminatedWork<P::Vector, S>,
        inspection: &mut W,
    ) -> Option<u64>
    where
        Abreast<WIDTH>: Width,
    {
        let steps = NystromStepsBeside::<_, _, _, S, WIDTH> {
            map: self,
            sized,
            clock,
            made,
            n,
            z,
            sums: &mut work.sums,
            inspection,
        };
        in_lanes(&self.dynamics, &mut work.kept, steps)
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn complete_unsolved(
        &self,
        t: T,
        z: &mut CarriesForces<P::Vector, S>,
        work: &mut EliminatedWork<P::Vector, S>,
    ) {
        self.complete(t, Outcome::unsolved(), z, &mut work.sums);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn solve(
        &self,
        t: T,
        z: &mut CarriesForces<P::Vector, S>,
        work: &mut EliminatedWork<P::Vector, S>,
    ) -> Cause {
        // Compiled once for steps and for the repetition of a step.
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || {
                let (bundles, sums) = (&mut work.bundles, &mut work.sums);
                let gradients = &mut z.y.x.0;
                let outcome = self.fixed_point::<Apart, _>(
                    &self.tableau(),
                    &self.dynamics,
                    t,
                    &z.x,
                    gradients,
                    bundles,
                    sums,
                );
                self.complete(t, outcome, z, sums)
            },
        )
    }
}

impl<V: Vector, const S: usize> Scratch<CarriesForces<V, S>> for EliminatedWork<V, S> {
    fn like(like: &CarriesForces<V, S>) -> Self {
        let vector = || like.x.q.clone();
        EliminatedWork {
            bundles: BundleScratch::new(&like.x.q),
            sums: Sums {
                velocity: vector(),
                impulse: vector(),
                moved: vector(),
            },
            kept: Kept::default(),
        }
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize> Map for Eliminated<T, P, S> {
    type Carried = CarriesForces<P::Vector, S>;
    type Work = EliminatedWork<P::Vector, S>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: T, end: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.go_on(Clock::between(t, end), 0, 1, z, work);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn go_on(
        &self,
        clock: Clock<T>,
        made: u64,
        end: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || self.steps(clock, made, end - made, z, work),
        );
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_parts(&self) -> bool {
        true
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, t: T, by: T, last: T, z: &mut Self::Carried, work: &mut Self::Work) {
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || self.make_part(t, by, last, z, work),
        );
    }
    #[cold]
    fn explain(&self, t: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        self.solve(t, z, work)
    }
}
