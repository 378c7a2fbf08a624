//! The entry of an ensemble into the level of the CPU, and into the pack that is fastest there.
//!
//! Input: a scheme, members, a rounding. Output: the members at their ends. Invariant: a level is compiled only for the
//! roundings that a program names.

use super::drive;
use super::drive::deviations::{self, Deviations};
use super::host::Host;
use super::rounding::Rounding;
use crate::errors::Error;
use crate::flows::map::Map;
use crate::runs::integrator::{Recipe, check_scheme};
use crate::schemes::scheme::{CarriedBy, Entry, Listed, Scheme};
use crate::systems::compiled::Compiled;
use crate::systems::state::{Carried, State};
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use alloc::string::String;
use alloc::vec::Vec;
use core::marker::PhantomData;
use hamiltonian_lanes::{Cpu, Kernel, Level, Nf, Pack, Real, W, dispatch};

/// Drives the members of a host to their ends, whose observers are of the type `O`.
pub(super) fn drive<T: Real, S: System, M: Scheme<S>, O, A: Rounding>(
    scheme: &M,
    host: &mut dyn Host<T, S>,
) {
    // Lanes follow drifts and signs, which an observer keeps. One without data, such as `()`, has none; interpreted systems
    // have one copy of the code for all observers.
    if const { size_of::<O>() > 0 || S::INTERPRETED } {
        dispatch(WorkOnMembers::<T, S, M, A, _>::new(
            scheme,
            DriveMembers::<T, S, true>(host),
        ));
    } else {
        dispatch(WorkOnMembers::<T, S, M, A, _>::new(
            scheme,
            DriveMembers::<T, S, false>(host),
        ));
    }
}

/// Advances members with deviations to their ends.
pub(super) fn deviate<T: Real, S: System, M: Scheme<S>, A: Rounding>(
    scheme: &M,
    all: &mut Deviations<'_, T, S>,
) {
    dispatch(WorkOnMembers::<T, S, M, A, _>::new(
        scheme,
        DeviateMembers(all),
    ));
}

/// Work on members in the lanes of one pack type.
trait MemberWork<T: Real, S: System> {
    /// Does the work inside the level `L` of the pack.
    fn at<L: Level, P: Pack, M: Scheme<S>>(self, scheme: &M);
}

/// Drives the members of a host to their ends.
struct DriveMembers<'a, T: Real, S: System, const FOLLOWS: bool>(&'a mut dyn Host<T, S>);

impl<T: Real, S: System, const FOLLOWS: bool> MemberWork<T, S> for DriveMembers<'_, T, S, FOLLOWS> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn at<L: Level, P: Pack, M: Scheme<S>>(self, scheme: &M) {
        drive::drive::<L, T, S, P, M, FOLLOWS>(scheme, self.0);
    }
}

/// Advances members with deviations to their ends.
struct DeviateMembers<'a, 'r, T: Real, S: System>(&'a mut Deviations<'r, T, S>);

impl<T: Real, S: System> MemberWork<T, S> for DeviateMembers<'_, '_, T, S> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn at<L: Level, P: Pack, M: Scheme<S>>(self, scheme: &M) {
        deviations::advance::<L, T, S, P, M>(scheme, self.0);
    }
}

/// Work on members as a kernel that chooses the pack of its level.
struct WorkOnMembers<'a, T, S, M, A, W> {
    scheme: &'a M,
    work: W,
    of: PhantomData<fn(T, S, A)>,
}

impl<'a, T, S, M, A, W> WorkOnMembers<'a, T, S, M, A, W> {
    fn new(scheme: &'a M, work: W) -> Self {
        let of = PhantomData;
        WorkOnMembers { scheme, work, of }
    }
}

/// Two registers of a level in lock-step.
type W2<L> = W<<L as Level>::Pack, 2>;

impl<T, S, M, A, W> Kernel for WorkOnMembers<'_, T, S, M, A, W>
where
    T: Real,
    S: System,
    M: Scheme<S>,
    A: Rounding,
    W: MemberWork<T, S>,
{
    type Output = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) {
        // The widths differ only in speed: more registers in lock-step hide more of the latency of a step, until its
        // numbers do not stay in registers. Two lanes gain too little for a copy of this code: such a CPU has one
        // member at a time. An operation on dual numbers is several, so that starting it takes less of an interpreter's time:
        // wide packs are a tenth faster there, and twice the code. The conditions are constant, so the compiler emits no code
        // for the other widths.
        if const { matches!(L::CPU, Cpu::Portable | Cpu::Sse2) } {
            self.work.at::<L, f64, M>(self.scheme);
        } else if const { S::INTERPRETED && T::DUALS == 0 } {
            self.at::<L, L::Several, Nf<L::Several>>();
        } else if const { numbers::<T, S, M>() <= 2 } {
            self.at::<L, L::Wide, Nf<L::Several>>();
        } else if const { numbers::<T, S, M>() <= 4 } {
            self.at::<L, L::Several, Nf<L::Several>>();
        } else {
            self.at::<L, W2<L>, Nf<W2<L>>>();
        }
    }
}

impl<T, S, M, A, W> WorkOnMembers<'_, T, S, M, A, W>
where
    T: Real,
    S: System,
    M: Scheme<S>,
    A: Rounding,
    W: MemberWork<T, S>,
{
    /// Does the work in the pack of the rounding. Levels without fused products have only one.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn at<L: Level, Fused: Pack, Unfused: Pack>(self) {
        if const { A::FUSES || !L::FUSES } {
            self.work.at::<L, Compiled<Fused>, M>(self.scheme);
        } else {
            self.work.at::<L, Compiled<Unfused>, M>(self.scheme);
        }
    }
}

/// The numbers of a step: those that it carries and its scratch.
const fn numbers<T: Real, S: System, M: Scheme<S>>() -> usize {
    let size = size_of::<CarriedBy<M, S, T>>() + size_of::<<M::Map<T> as Map>::Work>();
    size.div_ceil(size_of::<f64>())
}

/// The operations of a scheme that starts of ensembles of `S` require, with its type erased.
pub(crate) trait ErasedScheme<S: System>: Send + Sync {
    /// Checks a start, and appends the scheme's carried value at it to `words`.
    fn begin(
        &self,
        prepared: &S::Prepared<f64>,
        start: &State<VectorOf<S>>,
        step: f64,
        words: &mut Vec<f64>,
    ) -> Result<(), Error>;
    /// Returns true if steps of this size differ in duration.
    fn varies(&self, prepared: &S::Prepared<f64>, start: &State<VectorOf<S>>, step: f64) -> bool;
    /// Returns the scheme's entry in the catalogue.
    fn entry(&self) -> Entry;
    /// Returns the scheme's description, with all its options.
    fn describe(&self) -> String;
}

impl<S: System, M: Scheme<S>> ErasedScheme<S> for M {
    fn begin(
        &self,
        prepared: &S::Prepared<f64>,
        start: &State<VectorOf<S>>,
        step: f64,
        words: &mut Vec<f64>,
    ) -> Result<(), Error> {
        check_scheme::<f64, S, M>(self, prepared, start)?;
        words.extend(self.start(prepared, start, step).components());
        Ok(())
    }
    fn varies(&self, prepared: &S::Prepared<f64>, start: &State<VectorOf<S>>, step: f64) -> bool {
        self.start(prepared, start, step).duration(step).is_some()
    }
    fn entry(&self) -> Entry {
        Listed::entry(self)
    }
    fn describe(&self) -> String {
        Recipe::<f64, S, M::Map<f64>>::describe(self)
    }
}
