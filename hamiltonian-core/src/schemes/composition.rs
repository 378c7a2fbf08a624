//! Compositions of one-step schemes, and adjoints.
//!
//! Input: any one-step scheme, weights. Output: [`Composition`], [`Adjoint`]. Invariant: the closing
//! piece of a stage and the opening piece of the next are one, across steps too.

use super::splitting::Weight;
use super::tables::{Coefficients, general as tables};
use crate::errors::Error;
use crate::flows::iterate::{Contraction, iterate};
use crate::flows::map::{Cause, Either, Map, ScalarOf, Step};
use crate::schemes::scheme::{Entry, Listed, OneStep, Scheme, Symmetric};
use crate::systems::flow::Scratch;
use crate::systems::state::{Point, State};
use crate::systems::system::{Description, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// A scheme made of steps of another: Φ(γₛh) ∘ … ∘ Φ(γ₂h) ∘ Φ(γ₁h).
///
/// Yoshida's weights γ = (1/(2 − ∛2), −∛2/(2 − ∛2), 1/(2 − ∛2)) turn a symmetric scheme of order 2
/// into one of order 4. A composition preserves what its scheme preserves. Schemes whose step
/// depends on earlier steps cannot be composed: [`OneStep`].
///
/// Source: H. Yoshida, Phys. Lett. A 150 (1990) 262, eq. 4.4, doi:10.1016/0375-9601(90)90092-3; E.
/// Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), sec. II.4,
/// doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Composition;
///
/// let fourth = Composition::yoshida(ImplicitMidpoint::default());
/// let mut run = Integrator::new(&Oscillator {}, fourth, State::new([1.0], [0.0]), 0.1)?;
/// assert!((run.advance(10)?.q[0] - 1.0_f64.cos()).abs() < 1e-5);
/// # Ok::<(), Error>(())
/// ```
///
/// ```compile_fail,E0277
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::{Composition, IntersectingSubTrajectories};
///
/// // (33) carries a point whose distance depends on the step.
/// let _ = Composition::yoshida(IntersectingSubTrajectories::default());
/// ```
///
/// ```compile_fail,E0277
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::{KahanLi6, SymplecticEuler};
///
/// // Its adjoint is another scheme; a table has its order with symmetric ones.
/// let _ = KahanLi6.of(SymplecticEuler::default());
/// ```
///
/// With that adjoint it is symmetric:
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::{Composition, KahanLi6, SymplecticEuler};
///
/// let _ = KahanLi6.of(Composition::with_adjoint(SymplecticEuler::default()));
/// ```
///
/// `SYMMETRIC` is false for weights given to [`new`](Composition::new) and [`of`](Composition::of),
/// because they are arbitrary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Composition<M, const S: usize, const SYMMETRIC: bool = true> {
    stages: [(M, Weight); S],
    order: u32,
    name: &'static str,
}

impl<M: OneStep, const S: usize> Composition<M, S, false> {
    /// Steps of `scheme` of the sizes `weights` in units of the step, first to last; their sum is 1.
    /// `order` is the order of the whole, `name` its name in tables. Without any stage it does not
    /// compile.
    pub fn new(scheme: M, weights: [Weight; S], order: u32, name: &'static str) -> Self {
        Self::of(weights.map(|weight| (scheme.clone(), weight)), order, name)
    }

    /// Composes schemes of one type with different settings, for example a scheme and its adjoint.
    pub fn of(stages: [(M, Weight); S], order: u32, name: &'static str) -> Self {
        Self::made(stages, order, name)
    }
}

impl<M: OneStep, const S: usize, const SYMMETRIC: bool> Composition<M, S, SYMMETRIC> {
    fn made(stages: [(M, Weight); S], order: u32, name: &'static str) -> Self {
        const { assert!(S > 0, "a composition has at least one stage") };
        Composition {
            stages,
            order,
            name,
        }
    }
}

impl<M: Symmetric, const S: usize> Composition<M, S> {
    /// The steps γₛh of a table for symmetric schemes. Its stages are γ/2 down and γ/2 up, and twice a
    /// number is exact.
    pub(super) fn of_table(scheme: M, table: &Coefficients<S>, name: &'static str) -> Self {
        let stages =
            (table.stages).map(|(down, _)| (scheme.clone(), Weight(2.0 * down.0, 2.0 * down.1)));
        Self::made(stages, table.order, name)
    }
}

impl<M: OneStep<Adjoint = M>> Composition<M, 2> {
    /// Half a step of the scheme, then half a step of its adjoint: symmetric, of order 2.
    pub fn with_adjoint(scheme: M) -> Self {
        let adjoint = scheme.adjoint();
        let half = Weight(0.5, 0.0);
        let stages = [(scheme, half), (adjoint, half)];
        Self::made(stages, 2, "Composition with adjoint")
    }
}

impl<M: Symmetric> Composition<M, 3> {
    /// Yoshida's three steps, which make a symmetric scheme of order 2 one of order 4. A scheme that is
    /// not [`Symmetric`] is refused.
    pub fn yoshida(scheme: M) -> Self {
        let table = tables::YOSHIDA_4;
        Self::of_table(scheme, &table, table.name)
    }
}

impl<M: OneStep, const S: usize, const SYMMETRIC: bool> Listed for Composition<M, S, SYMMETRIC> {
    fn entry(&self) -> Entry {
        let of = self.stages[0].0.entry();
        Entry {
            name: self.name,
            variant: of.name,
            equations: "",
            order: self.order,
            ..of
        }
    }
}

impl<M: OneStep, const S: usize, const SYMMETRIC: bool> OneStep for Composition<M, S, SYMMETRIC> {
    type Adjoint = Composition<M::Adjoint, S, SYMMETRIC>;
    fn adjoint(&self) -> Self::Adjoint {
        let mut stages = self
            .stages
            .clone()
            .map(|(scheme, weight)| (scheme.adjoint(), weight));
        stages.reverse();
        Composition::made(stages, self.order, self.name)
    }
}

impl<M: OneStep<Adjoint = M>, const S: usize> Symmetric for Composition<M, S> {}

impl<S, M, const STAGES: usize, const SYMMETRIC: bool> Scheme<S>
    for Composition<M, STAGES, SYMMETRIC>
where
    S: System,
    M: OneStep + Scheme<S>,
{
    type Carried = M::Carried;
    type Map<T: Real> =
        Either<Composed<M::Map<T>, STAGES, true>, Composed<M::Map<T>, STAGES, false>>;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        let mut times = [f64::INFINITY, f64::NEG_INFINITY];
        let mut at = 0.0;
        for (scheme, weight) in &self.stages {
            let weight = weight.to::<f64>();
            let ends = scheme.times_of_jumps(of).map(|time| at + weight * time);
            times = [
                times[0].min(ends[0]).min(ends[1]),
                times[1].max(ends[0]).max(ends[1]),
            ];
            at += weight;
        }
        times
    }
    fn check<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
    ) -> Result<(), Error> {
        self.stages[0].0.check(prepared, state)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let (last, weight) = &self.stages[STAGES - 1];
        let mut previous = last;
        let mut before = weight.to::<T>() * step.before;
        let mut at = T::zero();
        let duration = T::constant(f64::from(last.entry().duration), 0.0);
        let stages: [_; STAGES] = core::array::from_fn(|i| {
            let (scheme, weight) = &self.stages[i];
            let weight = weight.to::<T>();
            let h = weight * step.h;
            let step_of_stage = Step { h, before };
            let joined = scheme.prepare_after(previous, prepared, step_of_stage);
            let stage = ComposedStage {
                joins: joined.is_some(),
                map: joined.unwrap_or_else(|| scheme.prepare(prepared, step_of_stage)),
                at: at * duration * step.h,
            };
            previous = scheme;
            before = h;
            at += weight;
            stage
        });
        if stages.iter().all(|stage| stage.joins) {
            Either::First(Composed { stages })
        } else {
            Either::second(Composed { stages })
        }
    }
    fn start<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> <Self::Map<T> as Map>::Carried {
        let (first, weight) = &self.stages[0];
        first.start(prepared, state, weight.to::<T>() * h)
    }
}

/// A stage of a composition, with its map.
struct ComposedStage<M: Map> {
    map: M,
    /// True if its `join` closes the stage before; else that closes and this one opens.
    joins: bool,
    /// The time of its beginning, relative to the beginning of the step.
    at: ScalarOf<M>,
}

/// The map of a [`Composition`]; `JOINED` if every stage joins the one before, so that steps need
/// no test.
pub struct Composed<M: Map, const S: usize, const JOINED: bool> {
    stages: [ComposedStage<M>; S],
}

impl<M: Map, const S: usize, const JOINED: bool> Composed<M, S, JOINED> {
    /// The time at the end of stage `i` of the step from `t` to `end`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn end_of(&self, i: usize, t: ScalarOf<M>, end: ScalarOf<M>) -> ScalarOf<M> {
        match self.stages.get(i + 1) {
            Some(next) => t + next.at,
            None => end,
        }
    }

    /// The closing piece of the stage before, then the opening one of stage `i`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn join_stage(&self, i: usize, t: ScalarOf<M>, z: &mut M::Carried, work: &mut M::Work) {
        let stage = &self.stages[i];
        if JOINED || stage.joins {
            stage.map.join(t, z, work);
        } else {
            let before = if i == 0 { S - 1 } else { i - 1 };
            self.stages[before].map.close(t, z, work);
            stage.map.open(t, z, work);
        }
    }
}

impl<M: Map, const S: usize, const JOINED: bool> Map for Composed<M, S, JOINED> {
    type Carried = M::Carried;
    type Work = M::Work;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn open(&self, t: ScalarOf<M>, z: &mut M::Carried, work: &mut M::Work) {
        self.stages[0].map.open(t, z, work);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: ScalarOf<M>, end: ScalarOf<M>, z: &mut M::Carried, work: &mut Self::Work) {
        for (i, stage) in self.stages.iter().enumerate() {
            let begin = t + stage.at;
            if i > 0 {
                self.join_stage(i, begin, z, work);
            }
            stage.map.body(begin, self.end_of(i, t, end), z, work);
        }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn close(&self, t: ScalarOf<M>, z: &mut M::Carried, work: &mut M::Work) {
        self.stages[S - 1].map.close(t, z, work);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn closing(&self) -> [bool; 2] {
        self.stages[S - 1].map.closing()
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn join(&self, t: ScalarOf<M>, z: &mut M::Carried, work: &mut M::Work) {
        self.join_stage(0, t, z, work);
    }

    #[cold]
    fn explain(
        &self,
        t: ScalarOf<M>,
        end: ScalarOf<M>,
        first: bool,
        z: &mut M::Carried,
        work: &mut Self::Work,
    ) -> Cause {
        if !first && !self.stages[0].joins {
            self.stages[S - 1].map.close(t, z, work);
        }
        for (i, stage) in self.stages.iter().enumerate() {
            let (begin, end) = (t + stage.at, self.end_of(i, t, end));
            let opens = !stage.joins || (first && i == 0);
            let mut after = z.clone();
            if opens {
                stage.map.open(begin, &mut after, work);
            } else {
                stage.map.join(begin, &mut after, work);
            }
            stage.map.body(begin, end, &mut after, work);
            let next = self.stages.get(i + 1);
            let mut closed = after.clone();
            if next.is_none_or(|next| !next.joins) {
                stage.map.close(end, &mut closed, work);
            }
            if !closed.is_finite() {
                return stage.map.explain(begin, end, opens, z, work);
            }
            *z = if next.is_some() { closed } else { after };
        }
        Cause::Overflow
    }
}

/// The adjoint Φ*ₕ = (Φ₋ₕ)⁻¹ of any scheme that carries the point alone, its equations solved by
/// fixed-point iteration.
///
/// [`OneStep::adjoint`] returns the adjoint in closed form, if there is one.
///
/// Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), def. II.3.1,
/// doi:10.1007/3-540-30666-8.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Adjoint<M>(pub M);

/// The number of iterations after which an unsolved step is an error.
const LIMIT: u32 = 100;

impl<M: OneStep> Listed for Adjoint<M> {
    fn entry(&self) -> Entry {
        Entry {
            variant: "adjoint",
            ..self.0.entry()
        }
    }
}

impl<M: OneStep> OneStep for Adjoint<M> {
    type Adjoint = M;
    fn adjoint(&self) -> M {
        self.0.clone()
    }
}

impl<S, M> Scheme<S> for Adjoint<M>
where
    S: System,
    M: OneStep + Scheme<S, Carried = Point<S::Shape>>,
{
    type Carried = Point<S::Shape>;
    type Map<T: Real> = Inverted<M::Map<T>>;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        let [first, last] = self.0.times_of_jumps(of);
        [1.0 - last, 1.0 - first]
    }
    fn check<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
    ) -> Result<(), Error> {
        self.0.check(prepared, state)
    }
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Inverted {
            back: self.0.prepare(prepared, Step::of(-step.h)),
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}

/// The map of an [`Adjoint`].
pub struct Inverted<M: Map> {
    /// Φ₋ₕ.
    back: M,
}

/// x ↦ x + (z − Φ₋ₕ(x)).
struct Inversion<'a, M: Map> {
    map: &'a Inverted<M>,
    /// The beginning of the step.
    t: ScalarOf<M>,
    end: ScalarOf<M>,
    target: &'a M::Carried,
    image: &'a mut M::Carried,
    work: &'a mut M::Work,
}

impl<M: Map> Contraction<M::Carried> for Inversion<'_, M> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn map(&mut self, x: &M::Carried, next: &mut M::Carried) {
        self.image.copy_from(x);
        self.map.back.step(self.end, self.t, self.image, self.work);
        next.copy_from(x);
        next.accumulate(ScalarOf::<M>::one(), self.target);
        next.accumulate(-ScalarOf::<M>::one(), self.image);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self, x: &M::Carried) -> <ScalarOf<M> as Real>::Size {
        x.size()
    }
}

impl<M: Map> Inverted<M> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn solve(
        &self,
        t: ScalarOf<M>,
        end: ScalarOf<M>,
        z: &mut M::Carried,
        work: &mut InvertedWork<M>,
    ) -> Cause {
        work.target.copy_from(z);
        let mut inversion = Inversion {
            map: self,
            t,
            end,
            target: &work.target,
            image: &mut work.image,
            work: &mut work.inner,
        };
        let outcome = iterate(LIMIT, &mut inversion, z, &mut work.next);
        z.poison(!outcome.solved);
        match outcome.solved.all() {
            true => Cause::Overflow,
            false => outcome.cause(),
        }
    }
}

/// The scratch of [`Inverted`].
pub struct InvertedWork<M: Map> {
    target: M::Carried,
    image: M::Carried,
    next: M::Carried,
    inner: M::Work,
}

impl<M: Map> Scratch<M::Carried> for InvertedWork<M> {
    fn like(like: &M::Carried) -> Self {
        InvertedWork {
            target: like.clone(),
            image: like.clone(),
            next: like.clone(),
            inner: M::Work::like(like),
        }
    }
}

impl<M: Map> Map for Inverted<M> {
    type Carried = M::Carried;
    type Work = InvertedWork<M>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: ScalarOf<M>, end: ScalarOf<M>, z: &mut M::Carried, work: &mut Self::Work) {
        self.solve(t, end, z, work);
    }

    #[cold]
    fn explain(
        &self,
        t: ScalarOf<M>,
        end: ScalarOf<M>,
        _: bool,
        z: &mut M::Carried,
        work: &mut Self::Work,
    ) -> Cause {
        let (target, mut x) = (z.clone(), z.clone());
        let cause = self.solve(t, end, z, work);
        if cause == Cause::Overflow {
            return cause;
        }
        // If Φ₋ₕ itself left its domain at an iterate, that is the cause.
        for _ in 0..LIMIT {
            let mut image = x.clone();
            let inner = (self.back).explain(end, t, true, &mut image, &mut work.inner);
            if !image.is_finite() {
                return match inner {
                    Cause::Piece(piece) => Cause::Piece(piece),
                    _ => cause,
                };
            }
            x.accumulate(ScalarOf::<M>::one(), &target);
            x.accumulate(-ScalarOf::<M>::one(), &image);
        }
        cause
    }
}
