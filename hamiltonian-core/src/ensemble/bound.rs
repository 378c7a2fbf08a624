//! The bound of schemes that advance ensembles, on every CPU level.
//!
//! Input: a scheme, a system, a rounding. Output: [`Ensembles`], which enters the level of the CPU and drives members
//! there. Invariants: a scheme that does not take the system is rejected with the message of [`Scheme`]; a level is
//! compiled only for the roundings that a program names.

use super::drive::PackScheme;
use super::drive::deviations::Deviations;
use super::host::Host;
use super::rounding::{Fused, Rounding, Unfused};
use crate::error::Error;
use crate::integrator::{Recipe, check_scheme};
use crate::map::Map;
use crate::scheme::Entry;
use crate::scheme::Scheme;
use crate::state::{Carried, State};
use crate::system::System;
use crate::system::gather::Gather;
use crate::vector::Vector;
use alloc::string::String;
use alloc::vec::Vec;
use core::marker::PhantomData;
use hamiltonian_lanes::{Cpu, KernelAt, Level, Nf, OnEveryLevel, Pack, Real, W};

/// A scheme that advances ensembles of the system `S`: every [`Scheme`] for `S` over `T` and packs of `T`.
///
/// `T` is [`Dual<f64>`](crate::Dual) for members with deviations, see [`Lyapunov`](crate::Lyapunov). Code that is
/// generic over systems and schemes needs this bound only:
///
/// ```
/// use hamiltonian::prelude::*;
///
/// fn swarm<S: System<f64>, M: Ensembles<S>>(make: impl Fn(usize) -> (S, StateOf<S>), scheme: M)
/// -> Result<Ensemble<S, M>, Error> {
///     Ensemble::new(1_000, |member| make(member.index), scheme, 0.01)
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not advance ensembles of `{S}`",
    label = "this scheme does not advance members of that system in lanes",
    note = "the scheme must take the system over `f64` and over packs of lanes; a system written by hand \
            also implements `Gather` for what it prepares"
)]
pub trait Ensembles<S: System<T>, T: Real = f64>: Scheme<T, S> {
    /// Drives the members of a host to their ends.
    #[doc(hidden)]
    fn drive<A: Rounding>(&self, host: &mut dyn Host<T, S>);
    /// Advances members with deviations to their ends.
    #[doc(hidden)]
    fn deviate<A: Rounding>(&self, all: &mut Deviations<'_, T, S>);
    /// Returns true if two systems may share a pack.
    #[doc(hidden)]
    fn fits(&self, a: &S::Prepared, b: &S::Prepared) -> bool;
    /// Returns true if all their parameters are equal.
    #[doc(hidden)]
    fn equals(&self, a: &S::Prepared, b: &S::Prepared) -> bool;
}

/// Work on members, done at one CPU level.
pub struct WorkAtLevel<'a, T, S, M, A, W> {
    scheme: &'a M,
    work: W,
    of: PhantomData<fn(T, S, A)>,
}

impl<'a, T, S, M, A, W> WorkAtLevel<'a, T, S, M, A, W> {
    fn new(scheme: &'a M, work: W) -> Self {
        let of = PhantomData;
        WorkAtLevel { scheme, work, of }
    }
}

impl<L, T, S, M, A, W> KernelAt<L> for WorkAtLevel<'_, T, S, M, A, W>
where
    L: Level,
    T: Real,
    S: System<T>,
    M: Scheme<T, S>
        + PackScheme<T, S, L::Wide>
        + PackScheme<T, S, L::Several>
        + PackScheme<T, S, Nf<L::Several>>
        + PackScheme<T, S, W2<L>>
        + PackScheme<T, S, Nf<W2<L>>>
        + PackScheme<T, S, f64>,
    A: Rounding,
    W: MemberWork<T, S>,
{
    type Output = ();
    #[inline(always)]
    fn run(self) {
        // The widths differ only in speed: more registers in lock-step hide more of the latency of a step, until its
        // numbers do not stay in registers. Two lanes gain too little for a copy of this code: such a CPU has one
        // member at a time. The conditions are constant, so the compiler emits no code for the other widths.
        if const { matches!(L::CPU, Cpu::Portable | Cpu::Sse2) } {
            self.work.at::<L, f64, M>(self.scheme);
        } else if const { numbers::<T, S, M>() <= 2 } {
            self.at::<L, L::Wide, Nf<L::Several>>();
        } else if const { numbers::<T, S, M>() <= 4 } {
            self.at::<L, L::Several, Nf<L::Several>>();
        } else {
            self.at::<L, W2<L>, Nf<W2<L>>>();
        }
    }
}

impl<T, S, M, A, W> WorkAtLevel<'_, T, S, M, A, W>
where
    T: Real,
    S: System<T>,
    A: Rounding,
    W: MemberWork<T, S>,
{
    /// Does the work in the pack of the rounding. Levels without fused products have only one.
    #[inline(always)]
    fn at<L, Fused, Unfused>(self)
    where
        L: Level,
        Fused: Pack,
        Unfused: Pack,
        M: PackScheme<T, S, Fused> + PackScheme<T, S, Unfused>,
    {
        if const { A::FUSES || !L::FUSES } {
            self.work.at::<L, Fused, M>(self.scheme);
        } else {
            self.work.at::<L, Unfused, M>(self.scheme);
        }
    }
}

/// Two registers of a level in lock-step.
type W2<L> = W<<L as Level>::Pack, 2>;

/// Drives the members of a host to their ends.
pub struct DriveMembers<'a, T: Real, S: System<T>>(&'a mut dyn Host<T, S>);

/// Advances members with deviations to their ends.
pub struct DeviateMembers<'a, 'r, T: Real, S: System<T>>(&'a mut Deviations<'r, T, S>);

/// Work on members in the lanes of one pack type.
pub trait MemberWork<T: Real, S: System<T>> {
    /// Does the work inside the level `L` of the pack.
    fn at<L: Level, P: Pack, M: PackScheme<T, S, P>>(self, scheme: &M);
}

impl<T: Real, S: System<T>> MemberWork<T, S> for DriveMembers<'_, T, S> {
    #[inline(always)]
    fn at<L: Level, P: Pack, M: PackScheme<T, S, P>>(self, scheme: &M) {
        scheme.drive::<L>(self.0);
    }
}

impl<T: Real, S: System<T>> MemberWork<T, S> for DeviateMembers<'_, '_, T, S> {
    #[inline(always)]
    fn at<L: Level, P: Pack, M: PackScheme<T, S, P>>(self, scheme: &M) {
        scheme.deviate::<L>(self.0);
    }
}

/// The numbers of a step: those that it carries and its scratch.
const fn numbers<T: Real, S: System<T>, M: Scheme<T, S>>() -> usize {
    let size = size_of::<<M::Map as Map>::Carried>() + size_of::<<M::Map as Map>::Work>();
    size.div_ceil(size_of::<f64>())
}

impl<S, M, T> Ensembles<S, T> for M
where
    T: Real,
    S: System<T, Prepared: Gather<T>>,
    M: Scheme<T, S>,
    for<'a> WorkAtLevel<'a, T, S, M, Fused, DriveMembers<'a, T, S>>: OnEveryLevel<Output = ()>,
    for<'a, 'r> WorkAtLevel<'a, T, S, M, Fused, DeviateMembers<'a, 'r, T, S>>:
        OnEveryLevel<Output = ()>,
    for<'a> WorkAtLevel<'a, T, S, M, Unfused, DriveMembers<'a, T, S>>: OnEveryLevel<Output = ()>,
    for<'a, 'r> WorkAtLevel<'a, T, S, M, Unfused, DeviateMembers<'a, 'r, T, S>>:
        OnEveryLevel<Output = ()>,
{
    // The conditions are constant: the other rounding is not compiled.
    fn drive<A: Rounding>(&self, host: &mut dyn Host<T, S>) {
        if const { A::FUSES } {
            WorkAtLevel::<T, S, M, Fused, _>::new(self, DriveMembers(host)).dispatch();
        } else {
            WorkAtLevel::<T, S, M, Unfused, _>::new(self, DriveMembers(host)).dispatch();
        }
    }
    fn deviate<A: Rounding>(&self, all: &mut Deviations<'_, T, S>) {
        if const { A::FUSES } {
            WorkAtLevel::<T, S, M, Fused, _>::new(self, DeviateMembers(all)).dispatch();
        } else {
            WorkAtLevel::<T, S, M, Unfused, _>::new(self, DeviateMembers(all)).dispatch();
        }
    }
    fn fits(&self, a: &S::Prepared, b: &S::Prepared) -> bool {
        a.fits(b)
    }
    fn equals(&self, a: &S::Prepared, b: &S::Prepared) -> bool {
        a.equals(b)
    }
}

/// The operations of a scheme that starts of ensembles of `S` require, with its type erased.
pub(crate) trait ErasedScheme<S: System<f64>>: Send + Sync {
    /// See [`Ensembles::fits`].
    fn fits(&self, a: &S::Prepared, b: &S::Prepared) -> bool;
    /// See [`Ensembles::equals`].
    fn equals(&self, a: &S::Prepared, b: &S::Prepared) -> bool;
    /// Checks a start, and appends the scheme's carried value at it to `words`.
    fn begin(
        &self,
        prepared: &S::Prepared,
        start: &State<S::Vector>,
        step: f64,
        words: &mut Vec<f64>,
    ) -> Result<(), Error>;
    /// Returns true if steps of this size differ in duration.
    fn varies(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: f64) -> bool;
    /// Returns the scheme's entry in the catalogue.
    fn entry(&self) -> Entry;
    /// Returns the scheme's description, with all its options.
    fn describe(&self) -> String;
}

impl<S: System<f64>, M: Ensembles<S>> ErasedScheme<S> for M {
    fn fits(&self, a: &S::Prepared, b: &S::Prepared) -> bool {
        Ensembles::<S>::fits(self, a, b)
    }
    fn equals(&self, a: &S::Prepared, b: &S::Prepared) -> bool {
        Ensembles::<S>::equals(self, a, b)
    }
    fn begin(
        &self,
        prepared: &S::Prepared,
        start: &State<S::Vector>,
        step: f64,
        words: &mut Vec<f64>,
    ) -> Result<(), Error> {
        check_scheme(self, prepared, start)?;
        words.extend(self.start(prepared, start, step).components());
        Ok(())
    }
    fn varies(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: f64) -> bool {
        self.start(prepared, start, step).duration(step).is_some()
    }
    fn entry(&self) -> Entry {
        crate::scheme::Listed::entry(self)
    }
    fn describe(&self) -> String {
        Recipe::<f64, S, M::Map>::describe(self)
    }
}
