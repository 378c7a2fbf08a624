//! Indicators of chaos of many starts.
//!
//! Input: a system and a start for each index, a scheme, a step. Output: the Lyapunov exponents, MEGNO or GALI of each
//! member. Invariant: neither the number of threads nor the other members change a bit of a member.

use super::bound;
use super::drive::deviations::{DeviatedMember, Deviations, Indicator};
use super::guard::guard;
use super::ordered::in_order;
use super::rounding::{Fused, Rounding, Unfused};
use super::threads;
use super::{MakeMember, Member};
use crate::analysis::tangent::{aslant, check_deviations, lifted, towards};
use crate::errors::{Error, StartError, SweepError};
use crate::runs::integrator::{check_scheme, check_start, check_step, duration};
use crate::schemes::scheme::Scheme;
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::ops::{ControlFlow, Range};
use core::sync::atomic::AtomicBool;
use hamiltonian_lanes::Dual;

/// A number and its derivative.
type D = Dual<f64>;

/// Computes Lyapunov exponents, MEGNO or GALI of many starts, in the lanes of packs and on threads.
///
/// | method | result for each member | the same for one run |
/// |---|---|---|
/// | [`collect`](Lyapunov::collect) | exponents, in units of 1/time | [`Tangent::lyapunov`](crate::analysis::Tangent::lyapunov) |
/// | [`megno`](Lyapunov::megno) | tends to 2 for regular motion, grows like λt/2 for chaos | [`megno`](crate::analysis::megno()) |
/// | [`gali`](Lyapunov::gali) | roughly constant for regular motion, falls like exp(−Σ(λ₁ − λᵢ)t) for chaos | [`Tangent::gali`](crate::analysis::Tangent::gali) |
///
/// Each deviation is computed by a run over [`Dual`](crate::Dual)s.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
/// let all = Lyapunov::new(20, start, ImplicitMidpoint::default(), 0.1)
///     .with_deviations(2)
///     .with_steps(1_000)
///     .collect()?;
/// for exponents in all {
///     // Orbits of an oscillator neither approach nor leave each other.
///     assert!(exponents?.iter().all(|rate| rate.abs() < 1e-3));
/// }
/// # Ok::<(), Error>(())
/// ```
///
/// # Reproducibility
/// As for an [`Ensemble`](crate::Ensemble#reproducibility), results depend by default on the CPU, but not on the number of
/// threads or on other members. With [`reproducible`](Lyapunov::reproducible), each member has the bits of a single
/// [`Tangent`](crate::analysis::Tangent) on every CPU.
pub struct Lyapunov<'a, S: System, M, A = Fused> {
    count: usize,
    make: MakeMember<'a, S>,
    scheme: M,
    step: f64,
    steps: u64,
    every: u64,
    deviations: usize,
    threads: usize,
    rounding: PhantomData<A>,
    cancel: Option<&'a AtomicBool>,
    progress: Option<Box<dyn Fn(usize, usize) + Send + Sync + 'a>>,
}

impl<'a, S: System, M: Scheme<S>> Lyapunov<'a, S, M> {
    /// Describes a computation for `count` members with the step `step`; [`with_steps`](Lyapunov::with_steps) sets its length.
    /// `make` makes the system and the start of a member, on any thread.
    pub fn new(
        count: usize,
        make: impl Fn(Member) -> (S, State<VectorOf<S>>) + Send + Sync + 'a,
        scheme: M,
        step: f64,
    ) -> Self {
        Self::try_new(count, move |member| Ok(make(member)), scheme, step)
    }

    /// Describes a computation as [`new`](Lyapunov::new) does, with a closure that returns a `Result`. Its error becomes
    /// that of the member.
    pub fn try_new(
        count: usize,
        make: impl Fn(Member) -> Result<(S, State<VectorOf<S>>), Error> + Send + Sync + 'a,
        scheme: M,
        step: f64,
    ) -> Self {
        Lyapunov {
            count,
            make: Box::new(make),
            scheme,
            step,
            steps: 0,
            every: 10,
            deviations: 1,
            threads: threads::available(),
            rounding: PhantomData,
            cancel: None,
            progress: None,
        }
    }
}

impl<'a, S: System, M: Scheme<S>, A: Rounding> Lyapunov<'a, S, M, A> {
    /// Sets the number of steps.
    #[must_use]
    pub fn with_steps(mut self, n: u64) -> Self {
        self.steps = n;
        self
    }

    /// Sets the number of steps after which deviations are made orthonormal, or for GALI normalised (0 counts as 1).
    /// The default is 10 steps. About once per time unit is often enough.
    #[must_use]
    pub fn with_interval(mut self, every: u64) -> Self {
        self.every = every.max(1);
        self
    }

    /// Sets the number of exponents that [`collect`](Lyapunov::collect) returns, the greatest first. The default is 1.
    /// An exponent does not depend on how many smaller ones are computed.
    #[must_use]
    pub fn with_deviations(mut self, k: usize) -> Self {
        self.deviations = k;
        self
    }

    /// Sets the number of threads (0 counts as 1). By default it is the number that the machine runs at once. A caller
    /// in a rayon pool gets those of the pool, and no others.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Does not fuse products and sums, so that each member has the bits of its single
    /// [`Tangent`](crate::analysis::Tangent) on every CPU.
    #[must_use]
    pub fn reproducible(self) -> Lyapunov<'a, S, M, Unfused> {
        Lyapunov {
            count: self.count,
            make: self.make,
            scheme: self.scheme,
            step: self.step,
            steps: self.steps,
            every: self.every,
            deviations: self.deviations,
            threads: self.threads,
            rounding: PhantomData,
            cancel: self.cancel,
            progress: self.progress,
        }
    }

    /// Stops with [`SweepError::Cancelled`] once the flag is set, for example by a handler of Ctrl-C.
    #[must_use]
    pub fn with_cancel(mut self, flag: &'a AtomicBool) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Calls a closure after each chunk of members with the number of finished members and the number of all.
    #[must_use]
    pub fn with_progress(mut self, closure: impl Fn(usize, usize) + Send + Sync + 'a) -> Self {
        self.progress = Some(Box::new(closure));
        self
    }

    /// Computes the exponents of each member, or its error, in the order of the index.
    ///
    /// # Errors
    /// [`SweepError::NoMembers`], [`StartError::NoSteps`], [`StartError::Step`], [`SweepError::Cancelled`]. A member
    /// that fails has [`SweepError::Member`] in its place, with an error of its start, [`StartError::Deviations`] or
    /// an error of its steps.
    pub fn collect(&self) -> Result<Vec<Result<Vec<f64>, Error>>, Error> {
        self.compute(Indicator::Rates, self.deviations)
    }

    /// Computes the MEGNO of each member, or its error, in the order of the index.
    ///
    /// MEGNO costs as much as one exponent, and distinguishes regular motion from chaos earlier: regular members are
    /// near 2 in any units.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
    /// let all = Lyapunov::new(20, start, ImplicitMidpoint::default(), 0.1).with_steps(1_000);
    /// for megno in all.megno()? {
    ///     // Orbits of an oscillator neither approach nor leave each other.
    ///     assert!(megno?.abs() < 0.1);
    /// }
    /// for gali in all.gali(2)? {
    ///     assert!(gali? > 0.9);
    /// }
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`collect`](Lyapunov::collect).
    pub fn megno(&self) -> Result<Vec<Result<f64, Error>>, Error> {
        self.one(Indicator::Megno, 1)
    }

    /// Computes GALI of the first `k` deviations of each member after all steps, or its error, in the order of the
    /// index.
    ///
    /// Deviations are normalised [`with_interval`](Lyapunov::with_interval) so many steps, but not after the last step.
    ///
    /// # Errors
    /// Those of [`collect`](Lyapunov::collect).
    pub fn gali(&self, k: usize) -> Result<Vec<Result<f64, Error>>, Error> {
        self.one(Indicator::Gali, k)
    }

    /// Computes an indicator that is one number.
    fn one(&self, indicator: Indicator, count: usize) -> Result<Vec<Result<f64, Error>>, Error> {
        let all = self.compute(indicator, count)?.into_iter();
        Ok(all.map(|numbers| Ok(numbers?[0])).collect())
    }

    /// Computes an indicator of each member from `count` deviations.
    fn compute(
        &self,
        indicator: Indicator,
        count: usize,
    ) -> Result<Vec<Result<Vec<f64>, Error>>, Error> {
        /// The largest number of members in a chunk, which one thread computes.
        const CHUNK: usize = 640;
        if self.count == 0 {
            return Err(SweepError::NoMembers.into());
        }
        if self.steps == 0 {
            return Err(StartError::NoSteps.into());
        }
        check_step(self.step)?;
        // A multiple of the lanes of most packs, so that no lane is idle.
        let size = (self.count / 64).next_multiple_of(64).clamp(64, CHUNK);
        let chunk = |job: usize| {
            let first = job * size;
            self.chunk(indicator, count, first..self.count.min(first + size))
        };
        let mut all = Vec::with_capacity(self.count);
        let mut result = Ok(());
        in_order(self.count.div_ceil(size), self.threads, chunk, |_, some| {
            let Some(some) = some else {
                result = Err(SweepError::Cancelled {
                    done: all.len(),
                    of: self.count,
                }
                .into());
                return ControlFlow::Break(());
            };
            all.extend(some);
            if let Some(progress) = &self.progress {
                progress(all.len(), self.count);
            }
            ControlFlow::Continue(())
        });
        result.map(|()| all)
    }

    /// Computes an indicator of some members; `None` if the flag is set.
    fn chunk(
        &self,
        indicator: Indicator,
        count: usize,
        indices: Range<usize>,
    ) -> Option<Vec<Result<Vec<f64>, Error>>> {
        let mut all: Deviations<'_, D, S> = Deviations {
            members: Vec::with_capacity(indices.len()),
            indicator,
            count,
            step: Dual::fixed(self.step),
            interval: Dual::fixed(self.step * duration::<f64>(&self.scheme.entry())),
            steps: self.steps,
            every: self.every,
            cancel: self.cancel,
        };
        // The errors of members that cannot start.
        let mut errors = Vec::new();
        for index in indices.clone() {
            match self.begin(index, (indicator, count), all.members.first()) {
                Ok(member) => {
                    all.members.push(member);
                    errors.push(None);
                }
                Err(error) => errors.push(Some(error)),
            }
        }
        bound::deviate::<D, S, M, A>(&self.scheme, &mut all);
        if all.is_cancelled() {
            return None;
        }
        let mut results = all.members.into_iter().map(|member| member.result);
        let numbers = indices.zip(errors).map(|(index, error)| {
            let of_member = match error {
                Some(error) => Err(error),
                None => results.next().unwrap_or_else(|| Ok(Vec::new())),
            };
            of_member.map_err(|error| SweepError::member(index, error))
        });
        Some(numbers.collect())
    }

    /// Makes a member at its start. It must fit the other members.
    fn begin(
        &self,
        index: usize,
        (indicator, count): (Indicator, usize),
        other: Option<&DeviatedMember<D, S>>,
    ) -> Result<DeviatedMember<D, S>, Error> {
        let (system, start) = guard(|| (self.make)(Member::new(index, 0))).and_then(|made| made)?;
        let lifted = lifted::<f64, S>(&system, &start)?;
        check_deviations(count, lifted.q.len())?;
        let prepared = check_start::<D, S>(&system, &lifted)?;
        let fits = |other: &DeviatedMember<D, S>| S::fits(&other.prepared, &prepared);
        if !other.is_none_or(fits) {
            let system = (*system.description().name).into();
            return Err(SweepError::OtherSizes { system }.into());
        }
        let mut words = Vec::new();
        for deviation in 0..count {
            let start = match indicator {
                Indicator::Megno => aslant(&lifted),
                _ => towards(&lifted, deviation),
            };
            check_scheme(&self.scheme, &prepared, &start)?;
            let carried = self.scheme.start(&prepared, &start, Dual::fixed(self.step));
            words.reserve_exact(count * carried.len());
            words.extend(carried.components());
        }
        Ok(DeviatedMember {
            prepared,
            words,
            start: lifted,
            result: Ok(Vec::new()),
        })
    }
}

impl<S: System, M: fmt::Debug, A> fmt::Debug for Lyapunov<'_, S, M, A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lyapunov")
            .field("system", &core::any::type_name::<S>())
            .field("scheme", &self.scheme)
            .field("members", &self.count)
            .field("step", &self.step)
            .field("steps", &self.steps)
            .field("deviations", &self.deviations)
            .finish_non_exhaustive()
    }
}
