//! Steps from a tolerance.
//!
//! Input: Gauss collocation with an estimate of its error ([`Estimates`]), and a [`Tolerance`]. Output: [`Adaptive`],
//! whose steps are constant where those do as well, and vary reversibly elsewhere. Invariant: no decision depends on a
//! clock, on other lanes, or on the parts into which a run is divided.

mod density;
mod energy;
mod inspection;
mod pilot;
mod timescale;
mod tolerance;

use super::paced::{Pace, PaceShape};
use crate::errors::Error;
use crate::flows::map::{Cause, Clock, Map, Step};
use crate::schemes::scheme::{CarriedBy, Entry, Form, Listed, OneStep, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, Point, State};
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use core::sync::atomic::{AtomicUsize, Ordering};
use density::{OrbitSizes, wait};
use energy::Comparison;
pub use energy::StepConditions;
use hamiltonian_lanes::{Mask, Real};
pub use inspection::{Estimates, ToTolerance};
use inspection::{MapBy, WorkBy, later, moves};
use timescale::Derivatives;
pub use tolerance::{Estimate, Tolerance};
use tolerance::{larger, worse};

/// Gauss collocation with steps from a tolerance.
///
/// A step is refused, and repeated with a smaller size, if its estimated error is above the tolerated one. A pilot of at
/// most 32 steps from the start chooses how sizes follow each other:
///
/// - *Constant*, if the smallest of the pilot's sizes takes at most five times as many steps as varying sizes do, each of
///   which takes longer. The steps are then those of the scheme, and symplectic: exactly if the size is the step parameter
///   of the run, to rounding otherwise. After a refused step all steps are smaller.
/// - *Varying* otherwise. The density of steps ρ follows the time scale of the orbit as in [`Paced`](super::Paced), with
///   G = d ln Q/dt of
///
///   ```text
///   Q⁴ = (|q⃛|²|p̈|² + |q̈|²|p⃛|²)/(|q̈|²|ṗ|² + |q̇|²|p̈|²)
///   ```
///
///   which is ω⁴ for an oscillator and r⁻⁶ for Kepler's problem, up to a factor. These steps are reversible: the error of
///   H does not drift.
///
/// Steps that became short, for example in a collision, grow again. Constant steps are looked at after 32, 96, 224, … steps:
/// if they could be four times as long, a pilot chooses anew, and constant steps need not be shorter than the size that has
/// met the tolerance so far. A refused step that makes them less than 0.4 times as long as a
/// pilot chose them begins the series again, with 32·(k + 1) in place of 32 after k pilots. Where refused steps have made
/// varying ones less than half as long, a pilot chooses anew after as many steps. Steps whose equations take more than 40
/// iterations over `f64` are refused too: shorter ones take less time.
///
/// A step is at most three times as long as the density before it says, and the density is set anew where it has left
/// Q by a factor of four. This, a refused size, from which on the density is larger, and a pilot that changes the size end
/// reversibility there. [`Integrator::refused_steps`](crate::Integrator::refused_steps) counts all four. A few near the
/// start mean nothing. In n steps there are at most √n/4 pilots, and log₂(n/32 + 1) if no step is refused. A number that
/// grows in proportion to n means that the chosen steps do not suit the motion, and that H may drift.
///
/// H is compared at both ends of each step, if no force acts and no jumps are at given times. A step that changes H by more
/// than the tolerated errors, rounding and ∂H/∂t change it is refused. Where H may change, the slopes at both ends are
/// compared with the polynomial of the stages as well. The stages know nothing of what lies beyond the last of them: a jump
/// of the gradient, of functions such as `abs` or `if`, or a steep wall behind a place without forces. Where H itself
/// jumps, the run ends with [`StepError::Jumped`](crate::errors::StepError::Jumped). End runs at jumps in time.
///
/// A barrier between two stages that leaves H equal at both ends is not detected. A start in a place without forces has no
/// Q: the first step may then jump over a narrow barrier. Start such a run with a scheme and a step.
///
/// Time is carried as in [`Paced`](super::Paced): the clock of a run counts its step parameter, whose size does not matter
/// and whose sign is the direction. [`Integrator::to_tolerance`](crate::Integrator::to_tolerance) sets it to the first
/// step.
///
/// Source: E. Hairer, G. Söderlind, SIAM J. Sci. Comput. 26 (2005) 1838, eq. 2.8, doi:10.1137/040606995, with Q of this
/// library.
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::Adaptive;
#[doc = include_str!("../../doc/oscillator.md")]
///
/// let scheme = Adaptive::new(GaussNystrom::<8>::default(), 1e-10);
/// let mut run = Integrator::new(&Oscillator {}, scheme, State::new([1.0], [0.0]), 1.0)?;
/// let end = run.advance_until(10.0)?;
/// assert!((end.q[0] - 10.0_f64.cos()).abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptive<M> {
    scheme: M,
    tolerance: Tolerance,
}

impl<M> Adaptive<M> {
    /// Returns the scheme with steps from this tolerance. See [`Tolerance`] for its norm.
    #[must_use]
    pub fn new(scheme: M, tolerance: impl Into<Tolerance>) -> Self {
        Adaptive {
            scheme,
            tolerance: tolerance.into(),
        }
    }
}

impl<M: OneStep> Listed for Adaptive<M> {
    fn entry(&self) -> Entry {
        let of = self.scheme.entry();
        Entry {
            name: "Adaptive",
            variant: of.variant,
            preserves: Form::Nothing,
            source: "Hairer, Söderlind 2005, eq. 2.8, doi:10.1137/040606995",
            ..of
        }
    }
}

/// The numbers that [`Adaptive`] carries beside the scheme's: ρ, G, t; the number of refused steps; ρ in the last step; for
/// constant steps the largest ρ, 0 for others; the low word of t; ρ/Q as it is due, and as it was found first, 0 before
/// there is a Q; the number of steps until a pilot may choose anew, 0 if none will, and that from the time before to it; the
/// number of pilots that did.
const NUMBERS: usize = 12;

/// The value that [`Adaptive`] carries.
type Follows<C> = Pace<C, NUMBERS>;

/// The largest ρ of a single step of a given size, which is not refused.
const ALONE: f64 = f64::MAX;

impl<S, M> Scheme<S> for Adaptive<M>
where
    S: System,
    M: Estimates<S>,
{
    type Carried = PaceShape<M::Carried, NUMBERS>;
    type Map<T: Real> = Following<T, S, M>;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        self.scheme.times_of_jumps(of)
    }
    fn check<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
    ) -> Result<(), Error> {
        self.tolerance.check()?;
        self.scheme.check(prepared, state)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Following {
            map: self.scheme.prepare(prepared, Step::of(step.h)),
            field: prepared.field(T::one()),
            estimate: self.scheme.estimate(self.tolerance),
            tolerance: self.tolerance,
            comparison: Comparison::of(prepared),
            parameter: step.h,
            number: MAPS.fetch_add(1, Ordering::Relaxed),
        }
    }
    fn start<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Follows<CarriedBy<M, S, T>> {
        let map = Scheme::<S>::prepare(self, prepared, Step::of(h));
        let of = self.scheme.start(prepared, state, h);
        pilot::start(&map, state.t, of, T::zero())
    }
    fn start_alone<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Follows<CarriedBy<M, S, T>> {
        let [zero, one] = [T::zero(), T::one()];
        Pace {
            of: self.scheme.start_alone(prepared, state, h),
            numbers: [
                one,
                zero,
                state.t,
                zero,
                one,
                T::constant(ALONE, 0.0),
                zero,
                zero,
                zero,
                zero,
                zero,
                zero,
            ],
        }
    }
}

/// The map of [`Adaptive`].
pub struct Following<T: Real, S: System, M: Estimates<S>> {
    /// The map for the step parameter.
    map: MapBy<M, S, T>,
    field: <S::Prepared<T> as Dynamics<T>>::Field,
    estimate: Estimate<T>,
    tolerance: Tolerance,
    comparison: Comparison<S::Prepared<T>>,
    parameter: T,
    /// No other map has it.
    number: usize,
}

/// The number of maps made.
static MAPS: AtomicUsize = AtomicUsize::new(0);

/// The scratch of [`Following`].
pub struct FollowingWork<C: Carried, M, W> {
    /// The map for a step of `by` times the parameter, of the map with the number `of`.
    map: Option<M>,
    of: usize,
    by: C::Scalar,
    inner: W,
    before: C,
    after: C,
    derivatives: Derivatives<C::Vector>,
    scratch: [Point<C::Vector>; 2],
    /// H before and after the last attempt that was refused for a jump; 0 if a later one was refused for its error.
    jump: [C::Scalar; 2],
}

impl<C: Carried, M, W: Scratch<C>> Scratch<Follows<C>> for FollowingWork<C, M, W> {
    fn like(like: &Follows<C>) -> Self {
        FollowingWork {
            map: None,
            of: 0,
            by: C::Scalar::one(),
            inner: W::like(&like.of),
            before: like.of.clone(),
            after: like.of.clone(),
            derivatives: Derivatives::like(like.of.point()),
            scratch: [(); 2].map(|()| like.of.point().zeros_like()),
            jump: [C::Scalar::zero(); 2],
        }
    }
}

/// The scratch of the map for a system and a scheme.
type WorkOf<T, S, M> = FollowingWork<CarriedBy<M, S, T>, MapBy<M, S, T>, WorkBy<M, S, T>>;

/// A number without its derivatives: sizes of steps are no functions of the start.
#[cfg_attr(not(unoptimised), inline(always))]
fn fixed<T: Real>(x: T) -> T {
    if T::LANES == 1 {
        T::constant(x.to_f64(), 0.0)
    } else {
        x.with_derivative(T::zero())
    }
}

/// x^(1/16), near the exponent 2/37 with which a size follows from an error that is proportional to h^18.5.
#[cfg_attr(not(unoptimised), inline(always))]
fn root<T: Real>(x: T) -> T {
    x.sqrt().sqrt().sqrt().sqrt()
}

/// The estimated error that sizes aim at, in units of the tolerated one.
const AIM: f64 = 0.25;
/// The factor of the density in a step across a jump after which a pilot chooses anew.
const CUT: f64 = 16.0;
/// The largest density with constant steps, in units of the first; a pilot may soon choose anew after denser ones.
const DENSEST: f64 = 2.5;
/// The most attempts at a step.
const ATTEMPTS: u32 = 60;

impl<T: Real, S: System, M: Estimates<S>> Following<T, S, M> {
    /// The conditions on a step.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn conditions<'a>(
        &'a self,
        scratch: &'a mut [Point<VectorOf<S, T>>; 2],
    ) -> StepConditions<'a, T, S> {
        StepConditions {
            estimate: &self.estimate,
            field: &self.field,
            comparison: &self.comparison,
            scratch,
        }
    }

    /// The copy of the map, whose size is `made` times that of the map with the number `of`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copied<'a>(
        &self,
        map: &'a mut Option<MapBy<M, S, T>>,
        (of, made): (&mut usize, &mut T),
    ) -> &'a mut MapBy<M, S, T> {
        // The scratch may have been that of another map, with other parameters.
        if *of != self.number {
            *map = None;
            (*of, *made) = (self.number, T::one());
        }
        map.get_or_insert_with(|| M::copy(&self.map))
    }

    /// Makes one step of h = `by`·parameter. Returns h.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn attempt(&self, by: T, t: T, of: &mut CarriedBy<M, S, T>, work: &mut WorkOf<T, S, M>) -> T {
        let h = self.parameter * by;
        let map = self.copied(&mut work.map, (&mut work.of, &mut work.by));
        if !by.equals(work.by).all() {
            M::resize(&self.map, by, map);
            work.by = by;
        }
        map.step(t, t + h, of, &mut work.inner);
        h
    }

    /// The estimated error of the step of size h that led here, in units of the tolerated one.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn error(&self, h: T, of: &CarriedBy<M, S, T>, work: &WorkOf<T, S, M>) -> T {
        M::error::<T, true>(&self.estimate, h, work.before.point(), of)
    }

    /// Makes up to `n` steps of a single run in lanes, until one is refused. Returns their number, 0 if there are no lanes,
    /// and whether there is one that was refused, after which the value carried then is.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn quickly(
        &self,
        n: u64,
        z: &mut Follows<CarriedBy<M, S, T>>,
        work: &mut WorkOf<T, S, M>,
    ) -> (u64, bool) {
        let [_, _, t, _, _, limit, low, ..] = z.numbers;
        if T::LANES > 1 || T::constant(ALONE, 0.0).le(limit).any() {
            return (0, false);
        }
        let (density, leaps) = self.density(&z.numbers);
        if leaps.any() {
            return (0, false);
        }
        let is_constant = T::zero().lt(limit).all();
        let n = z.steps_to_pilot().map_or(n, |left| n.min(left));
        let copy = self.copied(&mut work.map, (&mut work.of, &mut work.by));
        let mut sizes = OrbitSizes {
            map: self,
            numbers: &mut z.numbers,
            derivatives: &mut work.derivatives,
            density,
            size: fixed(density.recip()),
            is_constant,
        };
        let steps = (self.parameter, [t, low], n);
        let mut conditions = self.conditions(&mut work.scratch);
        let before = &mut work.before;
        let maps = [&self.map, &*copy];
        let (made, is_refused) = M::steps(
            &mut conditions,
            maps,
            steps,
            &mut sizes,
            &mut z.of,
            before,
            &mut work.inner,
        );
        if made > 0 {
            if is_constant {
                z.numbers[4] = density;
            }
            self.count(made, z, work);
        }
        (made, is_refused)
    }

    /// Counts `made` steps, and looks whether a pilot must choose anew after the number of steps at which it may.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn count(&self, made: u64, z: &mut Follows<CarriedBy<M, S, T>>, work: &mut WorkOf<T, S, M>) {
        let (zero, left) = (T::zero(), z.numbers[9]);
        let counts = zero.lt(left);
        if counts.any() {
            let next = left - T::constant(made as f64, 0.0);
            z.numbers[9] = T::select(counts, next, left);
            let due = counts & next.le(zero);
            if due.any() {
                pilot::again(self, due, z, work);
            }
        }
    }

    /// Makes one step, by as many attempts as it takes. If `is_attempted`, the value carried is that after the first.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn make(
        &self,
        is_attempted: bool,
        z: &mut Follows<CarriedBy<M, S, T>>,
        work: &mut WorkOf<T, S, M>,
    ) {
        let [zero, one] = [T::zero(), T::one()];
        let [before, _, t, mut refused, _, limit, low, ..] = z.numbers;
        if T::constant(ALONE, 0.0).le(limit).any() {
            self.map
                .step(t, t + self.parameter, &mut z.of, &mut work.inner);
            [z.numbers[2], z.numbers[6]] = later([t, low], self.parameter);
            return;
        }
        let is_constant = T::zero().lt(limit);
        let (mut density, leaps) = self.density(&z.numbers);
        refused += T::select(leaps, one, zero);
        if !is_attempted {
            work.before.copy_from(&z.of);
        }
        work.jump = [zero; 2];
        let energy = self
            .conditions(&mut work.scratch)
            .energy(t, work.before.point());
        let mut changed = T::Mask::splat(false);
        let mut open = T::Mask::splat(true);
        let mut attempts = 0;
        loop {
            let by = fixed(density.recip());
            let h = match is_attempted && attempts == 0 {
                true => self.parameter * by,
                false => self.attempt(by, t, &mut z.of, work),
            };
            attempts += 1;
            let from = work.before.point();
            let met = M::error::<T, false>(&self.estimate, h, from, &z.of).le(one);
            let mut conditions = self.conditions(&mut work.scratch);
            let [end, _] = later([t, low], h);
            let energies = [energy, conditions.energy(end, z.of.point())];
            let change = M::change(&mut conditions, (h, t), from, &z.of, energies);
            let same = change.le(one);
            let met = met & same;
            if attempts == 1 && met.all() {
                break;
            }
            let error = worse(self.error(h, &z.of, work), change);
            // This is false for NaN, of a step that was not solved.
            let fine = met | error.le(one);
            let mut refuses = open & !fine;
            if refuses.any() {
                // Where the step before has failed, there is nothing to try.
                refuses = refuses & work.before.finite();
            }
            if !refuses.any() {
                break;
            }
            let mut jumps = refuses & !same;
            if jumps.any() {
                let ends = [work.before.point(), z.of.point()];
                jumps = jumps
                    & self
                        .conditions(&mut work.scratch)
                        .jumps((h, t), ends, energies);
            }
            for (to, energy) in work.jump.iter_mut().zip(energies) {
                *to = T::select(refuses, T::select(jumps, energy, zero), *to);
            }
            work.after.copy_where(open & fine, &z.of);
            open = refuses;
            changed = changed | refuses;
            if attempts == ATTEMPTS {
                z.of.poison(refuses);
                break;
            }
            let smaller = density / pilot::shrink(error, attempts);
            density = T::select(refuses, fixed(smaller), density);
            refused += T::select(refuses, one, zero);
            z.of.copy_from(&work.before);
        }
        if attempts > 1 {
            z.of.copy_where(!open, &work.after);
        }
        let h = self.parameter * fixed(density.recip());
        // Steps that no longer move the time end at a singularity.
        let moves = moves(t, h);
        if !moves.all() {
            z.of.poison(!moves);
        }
        [z.numbers[2], z.numbers[6]] = later([t, low], h);
        z.numbers[3] = refused;
        let (point, derivatives) = (z.of.point(), &mut work.derivatives);
        self.follow(density, changed, &mut z.numbers, point, derivatives);
        // Beyond a jump a step is not as short as in it, and differences over it may be rounding.
        let is_cut = changed & (before * T::constant(CUT, 0.0)).lt(density);
        if is_cut.any() {
            wait(&mut z.numbers, is_cut);
        }
        let lost = changed & is_constant & limit.lt(density);
        if lost.any() {
            let denser = density * T::constant(DENSEST, 0.0);
            z.numbers[5] = T::select(lost, denser, limit);
            wait(&mut z.numbers, lost);
        }
        self.count(1, z, work);
    }
}

impl<T: Real, S: System, M: Estimates<S>> Map for Following<T, S, M> {
    type Carried = Follows<CarriedBy<M, S, T>>;
    type Work = WorkOf<T, S, M>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run(&self, _: Clock<T>, _: u64, n: u64, z: &mut Self::Carried, work: &mut Self::Work) {
        let mut left = n;
        while left > 0 {
            let (made, is_refused) = self.quickly(left, z, work);
            left -= made;
            if is_refused || made == 0 {
                self.make(is_refused, z, work);
                left -= 1;
            }
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, _: T, _: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.make(false, z, work);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_parts(&self) -> bool {
        self.map.has_parts()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn last_step(&self, z: &Self::Carried) -> T {
        fixed(z.numbers[4].recip())
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, t: T, by: T, last: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.map.part(t, by, last, &mut z.of, &mut work.inner);
    }

    /// A step whose end is not finite was refused at every size that moves the time; a single step was that of the scheme.
    #[cold]
    fn explain(&self, _: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        let [_, _, t, _, _, limit, ..] = z.numbers;
        if T::constant(ALONE, 0.0).le(limit).any() {
            let end = t + self.parameter;
            return self.map.explain(t, end, true, &mut z.of, &mut work.inner);
        }
        self.body(t, t, z, work);
        let [before, after] = work.jump.map(Real::to_f64);
        if before != after {
            return Cause::Jumped { before, after };
        }
        Cause::Refused {
            relative: self.tolerance.relative,
            absolute: self.tolerance.absolute,
        }
    }
}
