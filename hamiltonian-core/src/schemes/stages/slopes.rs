//! The fixed point of the slopes of all stages, `Fᵢ = J∇H(z + Σ αᵢⱼ bⱼh Fⱼ, t + cᵢh)`, in any layout.
//!
//! Input: the numbers of a method, a vector field, the point. Output: the slopes, and the step they make.
//! Invariant: the bits do not depend on the [`StageLayout`].

use super::{Carries, Collocated, Stages};
use crate::flows::iterate::Outcome;
use crate::flows::map::Clock;
use crate::schemes::bundles::{
    Abreast, Beside, Equations, LEVELS, StageLayout, Width, bundles, copy, in_bundles,
    lay_in_bundles, load, product, replace, resize, solve, spread, store, sum,
};
use crate::schemes::compensated::carry;
use crate::schemes::staged::Inspect;
use crate::systems::flow::VectorField;
use crate::systems::state::Point;
use crate::systems::system::Dynamics;
use crate::systems::system::gather::{InLanes, Kept};
use crate::systems::vector::{Over, Vector};
use core::marker::PhantomData;
use hamiltonian_lanes::{Cpu, Level, Mask, Pack, Real};

/// The tableau of a Runge–Kutta method for steps of one size, in bundles of stages.
pub(super) struct Tableau<'a, T, R, const S: usize, const HALVES: bool> {
    /// The step.
    pub(super) h: T,
    /// cᵢh.
    pub(super) times: &'a [R; S],
    /// bᵢh.
    pub(super) weights: &'a [R; S],
    /// α for the coordinates and for the momenta; before them those of the guess, for the slopes of the step
    /// before. In one array, so that they are read where they are: of two, compilers copy one.
    pub(super) matrices: &'a [[[[R; S]; S]; 2]; 2],
}

/// Slopes ↦ J∇H at the points they lead to.
struct FirstOrder<
    'a,
    T: Real,
    L: StageLayout<T>,
    F,
    V: Vector<Scalar = T>,
    X,
    const S: usize,
    const HALVES: bool,
> {
    tableau: &'a Tableau<'a, T, L::Bundle, S, HALVES>,
    field: &'a F,
    t: L::Bundle,
    point: &'a Point<V>,
    of: PhantomData<X>,
}

impl<T, L, F, V, X, const S: usize, const HALVES: bool> Equations<T, L, S>
    for FirstOrder<'_, T, L, F, V, X, S, HALVES>
where
    T: Real,
    L: StageLayout<T>,
    F: VectorField<X>,
    V: Vector<Scalar = T>,
    X: Vector<Scalar = L::Bundle>,
{
    type Unknowns = Point<X>;
    /// If forces and velocities depend on one half of phase space each, the velocities are computed from the momenta at
    /// the stages, then the forces from the coordinates that these velocities lead to. One iteration then shrinks the
    /// error as two do that compute both at once. (Two nodes of a trapezoid, of which one is the point itself, gain
    /// nothing by it: members took up to twice as long. `HALVES` is the scheme's.)
    #[cfg_attr(not(unoptimised), inline(always))]
    fn groups(&self) -> usize {
        if HALVES && S > 1 && self.field.has_halves() {
            2
        } else {
            1
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn points(
        &self,
        group: usize,
        matrices: usize,
        slopes: &[Point<X>; S],
        points: &mut [Point<X>; S],
    ) {
        // One unknown is its own guess: the same factors in every iteration.
        let matrices = &self.tableau.matrices[if S == 1 { 1 } else { matrices }];
        let parts = match (self.groups(), group) {
            (1, _) => 0..2 * X::PARTS,
            (_, 0) => X::PARTS..2 * X::PARTS,
            _ => 0..X::PARTS,
        };
        for k in parts {
            let matrix = &matrices[usize::from(k >= X::PARTS)];
            for i in 0..self.point.part(k).len() {
                let base = L::splat(self.point.part(k)[i]);
                if S == 1 {
                    // The factors of a single stage are multiplied before the iteration; α = ½ is exact.
                    let half_step = matrix[0][0] * self.tableau.weights[0];
                    points[0].part_mut(k)[i] = half_step * slopes[0].part(k)[i] + base;
                    continue;
                }
                let few = spread::<T, L, _, 1, S>([self.tableau.weights], slopes, k, i);
                for bundle in 0..bundles::<T, L, S>() {
                    // The small numbers first.
                    let increment = product::<T, L, S>(&matrix[bundle], &few);
                    points[bundle].part_mut(k)[i] = increment + base;
                }
            }
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn improve(
        &mut self,
        (group, bundle): (usize, usize),
        solved: T::Mask,
        point: &mut Point<X>,
        slopes: &mut Point<X>,
        next: &mut Point<X>,
    ) -> <L::Bundle as Real>::Size {
        let t = self.t + self.tableau.times[bundle];
        match (self.groups(), group) {
            (1, _) => {
                clear(next);
                let Point { q, p } = &mut *next;
                self.field.add(t, &point.q, &point.p, q, p);
                replace::<T, L, _>(solved, next, slopes)
            }
            (_, 0) => {
                clear(&mut next.q);
                self.field.add_half::<false>(t, &point.p, &mut next.q);
                replace::<T, L, _>(solved, &next.q, &mut slopes.q)
            }
            _ => {
                clear(&mut next.p);
                self.field.add_half::<true>(t, &point.q, &mut next.p);
                replace::<T, L, _>(solved, &next.p, &mut slopes.p)
            }
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self) -> T::Size {
        self.point.size() / self.tableau.h.size()
    }
}

/// From −0, x + (−0) = x to the bit; if c is known to be 1, the compiler removes the sum.
#[cfg_attr(not(unoptimised), inline(always))]
fn clear<X: Vector>(slopes: &mut X) {
    for k in 0..X::PARTS {
        for slope in slopes.part_mut(k) {
            *slope = -X::Scalar::zero();
        }
    }
}

/// Solves for the slopes of the step from `t`, from those of the step before.
#[allow(clippy::too_many_arguments)]
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn fixed_point<T, L, F, V, X, const S: usize, const HALVES: bool>(
    limit: (u32, bool),
    tableau: &Tableau<'_, T, L::Bundle, S, HALVES>,
    field: &F,
    t: T,
    point: &Point<V>,
    slopes: &mut [Point<X>; S],
    points: &mut [Point<X>; S],
    next: &mut Point<X>,
) -> Outcome<T>
where
    T: Real,
    L: StageLayout<T>,
    F: VectorField<X>,
    V: Vector<Scalar = T>,
    X: Vector<Scalar = L::Bundle>,
{
    let mut equations = FirstOrder::<T, L, F, V, X, S, HALVES> {
        tableau,
        field,
        t: L::splat(t),
        point,
        of: PhantomData,
    };
    solve(limit, &mut equations, slopes, points, next)
}

/// Adds Σ bᵢhFᵢ to the point and its low words.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn finish<T, L, V, X, const S: usize>(
    weights: &[L::Bundle; S],
    slopes: &[Point<X>; S],
    point: &mut Point<V>,
    low: &mut Point<V>,
) where
    T: Real,
    L: StageLayout<T>,
    V: Vector<Scalar = T>,
    X: Vector<Scalar = L::Bundle>,
{
    for k in 0..Point::<V>::PARTS {
        for i in 0..low.part(k).len() {
            let few = spread::<T, L, _, 1, S>([weights], slopes, k, i);
            low.part_mut(k)[i] += sum::<T, L, S>(&few);
        }
    }
    carry(point, low);
}

/// The scratch of steps: slopes, points, a slope.
pub(super) struct StepScratch<X: Vector, const S: usize> {
    pub(super) slopes: Stages<Point<X>, S>,
    pub(super) points: Stages<Point<X>, S>,
    pub(super) next: Point<X>,
}

/// Makes up to `n` steps after the first `made`, until one is not solved or not accepted. Returns the number of steps made and
/// the outcome of the last.
///
/// The scratch, the point and its low words should be variables of the caller alone, so that they may stay in
/// registers. Where steps are looked at, their sizes are in units of the tableau's, and the slopes of the step before are
/// kept in `before`.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn steps<T, L, F, V, X, W, const S: usize, const HALVES: bool>(
    limit: (u32, bool),
    tableau: &Tableau<'_, T, L::Bundle, S, HALVES>,
    field: &F,
    (clock, made, n): (Clock<T>, u64, u64),
    (scratch, before): (&mut StepScratch<X, S>, &mut [Point<X>; S]),
    (point, low): (&mut Point<V>, &mut Point<V>),
    inspection: &mut W,
) -> (u64, Outcome<T>)
where
    T: Real,
    L: StageLayout<T>,
    F: VectorField<X>,
    V: Vector<Scalar = T>,
    X: Vector<Scalar = L::Bundle>,
    W: Inspect<T, V, S>,
{
    let (mut left, mut outcome) = (n, Outcome::unsolved());
    let (mut times, mut weights) = (*tableau.times, *tableau.weights);
    let (mut h, mut size) = (tableau.h, T::constant(f64::NAN, 0.0));
    let of_map = tableau;
    while left > 0 && !inspection.ends() {
        if W::LOOKS && !inspection.size().equals(size).all() {
            size = inspection.size();
            h = of_map.h * size;
            resize(L::splat(size), of_map.times, &mut times);
            resize(L::splat(size), of_map.weights, &mut weights);
        }
        let sized = Tableau {
            h,
            times: &times,
            weights: &weights,
            matrices: of_map.matrices,
        };
        let tableau = if W::LOOKS { &sized } else { of_map };
        let t = inspection.begins(clock, made + (n - left));
        if W::LOOKS {
            copy::<T, L, _, S>(&scratch.slopes.0, before);
            inspection.keep(point, low);
        }
        outcome = fixed_point::<T, L, _, _, _, S, HALVES>(
            limit,
            tableau,
            field,
            t,
            point,
            &mut scratch.slopes.0,
            &mut scratch.points.0,
            &mut scratch.next,
        );
        let mut accepted = outcome.solved.all();
        if accepted {
            finish::<T, L, _, _, S>(tableau.weights, &scratch.slopes.0, point, low);
            accepted = inspection.accepts::<L, _>(point, &scratch.slopes.0);
        }
        if !accepted {
            inspection.refuse::<L, _>(before);
            break;
        }
        left -= 1;
    }
    (n - left, outcome)
}

/// Steps whose stages lie beside each other, until one is not solved or not accepted.
pub(super) struct StepsBeside<
    'a,
    T: Real,
    P: Dynamics<T>,
    W,
    const S: usize,
    const WIDTH: usize,
    const HALVES: bool,
> {
    pub(super) map: &'a Collocated<T, P, S, HALVES>,
    /// See [`StagedMap::steps_beside`](crate::schemes::staged::StagedMap::steps_beside).
    pub(super) sized: &'a Collocated<T, P, S, HALVES>,
    pub(super) clock: Clock<T>,
    /// The steps made before.
    pub(super) made: u64,
    pub(super) n: u64,
    pub(super) z: &'a mut Carries<P::Vector, S>,
    pub(super) inspection: &'a mut W,
}

impl<T, Q, W, const S: usize, const WIDTH: usize, const HALVES: bool> InLanes<T, Q::Vector>
    for StepsBeside<'_, T, Q, W, S, WIDTH, HALVES>
where
    T: Real,
    Q: Dynamics<T>,
    W: Inspect<T, Q::Vector, S>,
    Abreast<WIDTH>: Width,
{
    /// The number of steps made. The value carried is that after a step that was not accepted; that before one that was not
    /// solved, but for its slopes, which are NaN where steps are looked at.
    type Output = u64;
    type Pack<L: Level> = <Abreast<WIDTH> as Width>::Pack<L>;
    const LEVELS: [Cpu; 2] = LEVELS;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<P, D>(self, system: &D, kept: &mut Kept) -> u64
    where
        P: Pack,
        D: Dynamics<T::Over<P>, Vector = Over<Q::Vector, T::Over<P>>> + 'static,
    {
        let StepsBeside {
            map,
            sized,
            clock,
            made,
            n,
            z,
            inspection,
        } = self;
        let times = in_bundles::<T, Beside<P, WIDTH>, S>(&sized.times);
        let weights = in_bundles::<T, Beside<P, WIDTH>, S>(&sized.weights);
        let field = system.field(T::Over::<P>::one());
        // The matrices too: a run of single steps would spend its time on clearing them.
        let (scratch, before, matrices) = kept.get(
            |_| true,
            || {
                let zero = z.x.zeros_over::<T::Over<P>>();
                let stages = Stages(core::array::from_fn(|_| zero.clone()));
                let scratch = StepScratch::<D::Vector, S> {
                    slopes: stages.clone(),
                    points: stages.clone(),
                    next: zero,
                };
                (scratch, stages, [[[[T::Over::<P>::zero(); S]; S]; 2]; 2])
            },
        );
        for (to, from) in matrices
            .as_flattened_mut()
            .iter_mut()
            .zip(map.matrices.as_flattened())
        {
            lay_in_bundles::<T, Beside<P, WIDTH>, S>(from, to);
        }
        let tableau = Tableau {
            h: sized.h,
            times: &times,
            weights: &weights,
            matrices,
        };
        // Moved out, they are variables of this loop alone and may stay in registers.
        let mut here = StepScratch {
            slopes: scratch.slopes.take(),
            points: scratch.points.take(),
            next: scratch.next.take(),
        };
        let (mut point, mut low) = (z.x.take(), z.y.y.take());
        load::<T, Beside<P, WIDTH>, _, _, S>(&z.y.x.0, &mut here.slopes.0);
        let (steps, outcome) = steps::<T, Beside<P, WIDTH>, _, _, _, _, S, HALVES>(
            map.fixed_point_limit(),
            &tableau,
            &field,
            (clock, made, n),
            (&mut here, &mut before.0),
            (&mut point, &mut low),
            inspection,
        );
        store::<T, Beside<P, WIDTH>, _, _, S>(&here.slopes.0, &mut z.y.x.0);
        if W::LOOKS && !outcome.solved.all() {
            z.y.x.poison(T::Mask::splat(true));
        }
        (z.x, z.y.y) = (point, low);
        *scratch = here;
        steps
    }
}
