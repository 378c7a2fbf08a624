//! The stages of an implicit step: points at the nodes of a quadrature, coupled by the polynomial
//! through them.
//!
//! Input: nodes, weights, matrices. Output: [`Collocated`], the map of [`Gauss`](super::Gauss) and
//! [`Variational`](super::Variational). Invariant: a step is finished only when its equations hold to
//! rounding; otherwise it is an error.
//!
//! The points are `Qᵢ = q + Σ αᵢⱼΔqⱼ` and `Pᵢ = p + Σ βᵢⱼΔpⱼ`. Where the polynomial passes through as many
//! nodes as it has coefficients, the unknowns are the slopes J∇H at the points, Δ their integrals by the
//! quadrature, and the equations are a fixed point. Otherwise ([`Modes`]) the unknowns in place of the
//! slopes of q are the coefficients of the polynomial dq/dt and of the part of Pᵢ that is orthogonal
//! to such polynomials, and dq/dt = ∂H/∂p at the nodes is left to Newton's method.

mod guess;
mod map;
mod newton;
mod slopes;

use super::bundles::Apart;
use super::compensated::carry;
use crate::flows::iterate::{Contraction, Outcome, iterate};
use crate::flows::map::Cause;
use crate::systems::flow::VectorField;
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::Dynamics;
use crate::systems::system::gather::Kept;
use crate::systems::vector::{Over, Shape, Vector};
use core::ops::Range;
pub(super) use guess::{extrapolation, of_fixed_point};
use hamiltonian_lanes::{Mask, Real};
use newton::{Entries, LinearSystem};
use slopes::{Tableau, finish};

/// One vector a stage, as one vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Stages<X, const S: usize>(pub [X; S]);

impl<X: Shape, const S: usize> Shape for Stages<X, S> {
    type Vector<T: Real> = Stages<X::Vector<T>, S>;
}

impl<X: Vector, const S: usize> Vector for Stages<X, S> {
    type Scalar = X::Scalar;
    type Shape = Stages<X::Shape, S>;
    fn zeros_over<U: Real>(&self) -> Stages<Over<X, U>, S> {
        Stages(core::array::from_fn(|i| self.0[i].zeros_over()))
    }
    const PARTS: usize = S * X::PARTS;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, k: usize) -> &[X::Scalar] {
        self.0[k / X::PARTS].part(k % X::PARTS)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part_mut(&mut self, k: usize) -> &mut [X::Scalar] {
        self.0[k / X::PARTS].part_mut(k % X::PARTS)
    }
    fn zeros_like(&self) -> Self {
        Stages(core::array::from_fn(|i| self.0[i].zeros_like()))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        Stages(core::array::from_fn(|i| self.0[i].take()))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_from(&mut self, other: &Self) {
        for (to, from) in self.0.iter_mut().zip(&other.0) {
            to.copy_from(from);
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn is_finite(&self) -> bool {
        let mut finite = true;
        for stage in &self.0 {
            finite &= stage.is_finite();
        }
        finite
    }
}

/// The value a step with stages carries: the point; the unknowns of the last step, for
/// [`Gauss`](super::Gauss) the slopes J∇H at the stages, which make a guess for a step of any size; the
/// low words of the point.
pub type Carries<V, const S: usize> = Pair<Point<V>, Pair<Stages<Point<V>, S>, Point<V>>>;

/// The carried value at a start.
pub(super) fn at_rest<V: Vector, const S: usize>(state: &State<V>) -> Carries<V, S> {
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

/// The unknowns of q where they are no slopes: coefficients of polynomials.
#[derive(Debug, Clone)]
pub(super) struct Modes<T, const S: usize> {
    /// `values[i][j]`: polynomial j at node i.
    pub(super) values: [[T; S]; S],
    /// Those that dq/dt is a sum of; the others are parts of the momenta.
    pub(super) velocities: Range<usize>,
}

/// The map of [`Gauss`](super::Gauss) and of [`Variational`](super::Variational). With `HALVES`, an iteration computes
/// the velocities, then the forces at the coordinates that they lead to, if H is separable.
#[derive(Debug, Clone)]
pub struct Collocated<T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> {
    pub(super) field: P::Field,
    pub(super) dynamics: P,
    pub(super) h: T,
    /// cᵢh.
    pub(super) times: [T; S],
    /// bᵢh, with which Δp is made of slopes.
    pub(super) weights: [T; S],
    /// The same for Δq: h alone where the unknowns are modes.
    pub(super) spans: [T; S],
    /// α.
    pub(super) coordinates: [[T; S]; S],
    /// β.
    pub(super) momenta: [[T; S]; S],
    pub(super) modes: Option<Modes<T, S>>,
    /// [`of_fixed_point`].
    pub(super) matrices: [[[[T; S]; S]; 2]; 2],
    /// The most iterations of the fixed point, and of Newton's method.
    pub(super) limits: [u32; 2],
    /// True if the slopes are a guess for the step itself, see [`StagedMap::make_part`](super::staged::StagedMap::make_part).
    pub(super) is_part: bool,
}

/// The scratch of [`Collocated`].
#[derive(Debug, Clone)]
pub struct CollocatedWork<V: Vector, const S: usize> {
    stage: Point<V>,
    pub(super) increments: Stages<Point<V>, S>,
    next: Stages<Point<V>, S>,
    guess: Stages<Point<V>, S>,
    linear: LinearSystem<V>,
    kept: Kept,
}

impl<V: Vector, const S: usize> CollocatedWork<V, S> {
    pub(super) fn new(point: &Point<V>, stages: &Stages<Point<V>, S>) -> Self {
        CollocatedWork {
            stage: point.clone(),
            increments: stages.clone(),
            next: stages.clone(),
            guess: stages.clone(),
            linear: LinearSystem::new(point, S),
            kept: Kept::default(),
        }
    }
}

/// Unknowns ↦ J∇H at the stages.
pub(super) struct Slopes<'a, T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> {
    map: &'a Collocated<T, P, S, HALVES>,
    t: T,
    point: &'a Point<P::Vector>,
    /// The velocity along the straight line between two coordinates that are given.
    line: Option<&'a P::Vector>,
    pub(super) stage: &'a mut Point<P::Vector>,
    increments: &'a mut Stages<Point<P::Vector>, S>,
}

impl<T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> Slopes<'_, T, P, S, HALVES> {
    /// The point at stage `i`, from the increments and the unknowns they were made of.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn stage(&mut self, i: usize, unknowns: &Stages<Point<P::Vector>, S>) {
        // The small numbers first.
        self.stage.set_zero();
        for (j, increment) in self.increments.0.iter().enumerate() {
            let (a, b) = (self.map.coordinates[i][j], self.map.momenta[i][j]);
            self.stage.q.accumulate(a, &increment.q);
            self.stage.p.accumulate(b, &increment.p);
        }
        if let Some(modes) = &self.map.modes {
            for j in (0..S).filter(|j| !modes.velocities.contains(j)) {
                let value = modes.values[i][j];
                self.stage.p.accumulate(value, &unknowns.0[j].q);
            }
        }
        if let Some(line) = self.line {
            self.stage.q.accumulate(self.map.times[i], line);
        }
        self.stage.accumulate(T::one(), self.point);
    }

    /// `into −=` dq/dt of the polynomial at stage `i`.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn less_velocity(
        &self,
        i: usize,
        unknowns: &Stages<Point<P::Vector>, S>,
        into: &mut P::Vector,
    ) {
        match &self.map.modes {
            None => into.accumulate(-T::one(), &unknowns.0[i].q),
            Some(modes) => {
                for j in modes.velocities.clone() {
                    into.accumulate(-modes.values[i][j], &unknowns.0[j].q);
                }
            }
        }
        if let Some(line) = self.line {
            into.accumulate(-T::one(), line);
        }
    }

    /// J∇H at all stages.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn at_stages(
        &mut self,
        unknowns: &Stages<Point<P::Vector>, S>,
        slopes: &mut Stages<Point<P::Vector>, S>,
    ) {
        self.map.increments(unknowns, self.increments);
        for (i, slope) in slopes.0.iter_mut().enumerate() {
            self.stage(i, unknowns);
            slope.set_zero();
            let t = self.t + self.map.times[i];
            let Point { q, p } = &*self.stage;
            (self.map.field).add(t, q, p, &mut slope.q, &mut slope.p);
        }
    }
}

/// A step of Newton's method for the equations `J∇H(Qᵢ, Pᵢ, tᵢ) = (dq/dt, dp/dt)ᵢ`. Of a force the
/// derivative is left out.
struct Newton<'a, 'b, T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> {
    slopes: Slopes<'a, T, P, S, HALVES>,
    linear: &'b mut LinearSystem<P::Vector>,
}

impl<T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool>
    Contraction<Stages<Point<P::Vector>, S>> for Newton<'_, '_, T, P, S, HALVES>
{
    // In one function of the level, since it is long and called twice.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn map(
        &mut self,
        unknowns: &Stages<Point<P::Vector>, S>,
        next: &mut Stages<Point<P::Vector>, S>,
    ) {
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || self.map_here(unknowns, next),
        );
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self, unknowns: &Stages<Point<P::Vector>, S>) -> T::Size {
        let Slopes { map, point, .. } = &self.slopes;
        // The unknowns count too: a point at the origin has no size of its own.
        let stages = T::Size::constant(S as f64, 0.0);
        stages * point.size() / map.h.size() + unknowns.size()
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> Newton<'_, '_, T, P, S, HALVES> {
    /// One iteration, for [`map`](Contraction::map).
    #[cfg_attr(not(unoptimised), inline(always))]
    fn map_here(
        &mut self,
        unknowns: &Stages<Point<P::Vector>, S>,
        next: &mut Stages<Point<P::Vector>, S>,
    ) {
        self.slopes.at_stages(unknowns, next);
        let map = self.slopes.map;
        for (i, residual) in next.0.iter_mut().enumerate() {
            self.slopes.less_velocity(i, unknowns, &mut residual.q);
            residual.p.accumulate(-T::one(), &unknowns.0[i].p);
        }
        for i in 0..S {
            self.slopes.stage(i, unknowns);
            let t = self.slopes.t + map.times[i];
            self.linear.linearise(
                &map.dynamics,
                t,
                self.slopes.stage,
                i,
                S,
                #[cfg_attr(not(unoptimised), inline(always))]
                |j| map.entries(i, j),
            );
        }
        self.linear.solve(next);
        next.accumulate(T::one(), unknowns);
    }
}

impl<T: Real, P: Dynamics<T>, const S: usize, const HALVES: bool> Collocated<T, P, S, HALVES> {
    /// Makes `to` the map for steps `by` times as long, to rounding.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn resize(&self, by: T, to: &mut Self) {
        to.h = self.h * by;
        for i in 0..S {
            to.times[i] = self.times[i] * by;
            to.weights[i] = self.weights[i] * by;
            to.spans[i] = self.spans[i] * by;
        }
    }

    /// Lets the fixed point fail after so many iterations, without Newton's method.
    pub(super) fn restrict(&mut self, limit: u32) {
        self.limits = [self.limits[0].min(limit), 0];
    }

    /// Δq and Δp of the unknowns.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn increments(
        &self,
        unknowns: &Stages<Point<P::Vector>, S>,
        increments: &mut Stages<Point<P::Vector>, S>,
    ) {
        for j in 0..S {
            increments.0[j].copy_from(&unknowns.0[j]);
            increments.0[j].q.scale(self.spans[j]);
            increments.0[j].p.scale(self.weights[j]);
        }
    }

    /// The dependence of the point at stage `i`, and of dq/dt there, on the unknowns of stage `j`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn entries(&self, i: usize, j: usize) -> Entries<T> {
        let (zero, one) = (T::zero(), T::one());
        let (across, velocity) = match &self.modes {
            None => (zero, if i == j { one } else { zero }),
            Some(modes) if modes.velocities.contains(&j) => (zero, modes.values[i][j]),
            Some(modes) => (modes.values[i][j], zero),
        };
        Entries {
            coordinate: self.coordinates[i][j] * self.spans[j],
            momentum: self.momenta[i][j] * self.weights[j],
            across,
            velocity,
        }
    }

    /// Solves for the unknowns by Newton's method alone, from where they are, and leaves their
    /// increments in the scratch. `look` is shown the equations, solved.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn solve_between(
        &self,
        t: T,
        point: &Point<P::Vector>,
        line: Option<&P::Vector>,
        unknowns: &mut Stages<Point<P::Vector>, S>,
        work: &mut CollocatedWork<P::Vector, S>,
        look: impl FnOnce(&mut Slopes<'_, T, P, S, HALVES>, &Stages<Point<P::Vector>, S>),
    ) -> Outcome<T> {
        let slopes = Slopes {
            map: self,
            t,
            point,
            line,
            stage: &mut work.stage,
            increments: &mut work.increments,
        };
        let mut newton = Newton {
            slopes,
            linear: &mut work.linear,
        };
        let outcome = iterate(self.limits[1], &mut newton, unknowns, &mut work.next);
        self.increments(unknowns, newton.slopes.increments);
        look(&mut newton.slopes, unknowns);
        outcome
    }

    /// The most iterations of the fixed point, and whether the first has the guess for the step itself.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn fixed_point_limit(&self) -> (u32, bool) {
        (self.limits[0], self.is_part)
    }

    fn tableau(&self) -> Tableau<'_, T, T, S, HALVES> {
        Tableau {
            h: self.h,
            times: &self.times,
            weights: &self.weights,
            matrices: &self.matrices,
        }
    }

    /// The rest of a step: Newton's method in lanes where the fixed point failed, and the new point.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn complete(
        &self,
        t: T,
        mut outcome: Outcome<T>,
        z: &mut Carries<P::Vector, S>,
        work: &mut CollocatedWork<P::Vector, S>,
    ) -> Cause {
        let Pair {
            x: point,
            y: Pair {
                x: unknowns,
                y: low,
            },
        } = z;
        let has_newton = self.limits[1] > 0 && self.modes.is_none() && work.linear.fits();
        if has_newton && !outcome.solved.all() {
            T::out_of_line(
                #[cfg_attr(not(unoptimised), inline(always))]
                || self.newton(t, &mut outcome, point, unknowns, work),
            );
        }
        let solved = outcome.solved.all();
        if !solved {
            unknowns.poison(!outcome.solved);
        }
        if self.modes.is_some() {
            // The integrals over the step of all polynomials but the first vanish.
            self.increments(unknowns, &mut work.increments);
            low.q.accumulate(T::one(), &work.increments.0[0].q);
            for increment in &work.increments.0 {
                low.p.accumulate(T::one(), &increment.p);
            }
            carry(point, low);
        } else {
            finish::<T, Apart, _, _, S>(&self.weights, &unknowns.0, point, low);
        }
        if solved {
            Cause::Overflow
        } else {
            outcome.cause()
        }
    }

    /// Newton's method for the lanes that the fixed point has not solved.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn newton(
        &self,
        t: T,
        outcome: &mut Outcome<T>,
        point: &Point<P::Vector>,
        slopes: &mut Stages<Point<P::Vector>, S>,
        work: &mut CollocatedWork<P::Vector, S>,
    ) {
        let fixed = outcome.solved;
        // Over so long a step the last one's slopes say nothing: all stages at the point.
        work.guess.set_zero();
        let mut newton = Newton {
            slopes: Slopes {
                map: self,
                t,
                point,
                line: None,
                stage: &mut work.stage,
                increments: &mut work.increments,
            },
            linear: &mut work.linear,
        };
        *outcome = iterate(self.limits[1], &mut newton, &mut work.guess, &mut work.next);
        // The result of a lane does not depend on other lanes: those that the fixed point solved keep its values.
        slopes.copy_where(!fixed, &work.guess);
        outcome.solved = outcome.solved | fixed;
    }
}
