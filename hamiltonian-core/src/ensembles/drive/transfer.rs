//! Conversion between values of members and of lanes, out of line.
//!
//! Input: values of members, or of lanes. Output: values of lanes, or of members. Invariant: each function is compiled
//! once per pack type and never inlined, since the length of its code is proportional to the width of the
//! pack.

use super::{CarriedIn, MapIn, MaskIn};
use crate::flows::map::Step;
use crate::schemes::scheme::Scheme;
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use core::marker::PhantomData;
use hamiltonian_lanes::{Kernel, Level, Mask, Pack, Real};

/// Writes a number of each member to its lane of an existing pack. A returned pack would be copied register by
/// register at every call.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::ensembles) fn gather<L: Level, T: Real, P: Pack>(
    numbers: &[T],
    into: &mut T::Over<P>,
) {
    L::enter(GatherNumbers::<T, P> { numbers, into });
}

/// A number of each member, written to its lane at a level.
struct GatherNumbers<'a, T: Real, P: Pack> {
    numbers: &'a [T],
    into: &'a mut T::Over<P>,
}

impl<T: Real, P: Pack> Kernel for GatherNumbers<'_, T, P> {
    type Output = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) {
        *self.into = T::gather::<P>(self.numbers);
    }
}

/// Returns the lane mask of the flags.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::ensembles) fn lanes_of<L: Level, T: Real, P: Pack>(flags: &[bool]) -> MaskIn<T, P> {
    let of = PhantomData::<(T, P)>;
    L::enter(LanesOf { flags, of })
}

struct LanesOf<'a, T, P> {
    flags: &'a [bool],
    of: PhantomData<(T, P)>,
}

impl<T: Real, P: Pack> Kernel for LanesOf<'_, T, P> {
    type Output = MaskIn<T, P>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> MaskIn<T, P> {
        gathered::<L, T, P>(&as_numbers(self.flags)).equals(<T::Over<P> as Real>::one())
    }
}

/// Returns 1 for each flag that is set.
#[inline(never)]
fn as_numbers<T: Real>(flags: &[bool]) -> Vec<T> {
    let number = |flag: &bool| if *flag { T::one() } else { T::zero() };
    flags.iter().map(number).collect()
}

/// Returns a pack with a number of each member. In a kernel this is a call, where [`Real::gather`] is written out.
#[cfg_attr(not(unoptimised), inline(always))]
fn gathered<L: Level, T: Real, P: Pack>(numbers: &[T]) -> T::Over<P> {
    let mut pack = T::Over::<P>::default();
    gather::<L, T, P>(numbers, &mut pack);
    pack
}

/// Writes the flag of each lane to a slice.
pub(super) struct FlagsOf<'a, M> {
    pub(super) mask: &'a M,
    pub(super) flags: &'a mut [bool],
}

impl<M: Mask> Kernel for FlagsOf<'_, M> {
    type Output = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) {
        for (lane, flag) in self.flags.iter_mut().enumerate() {
            *flag = self.mask.lane(lane as u32);
        }
    }
}

/// Writes the number of each lane to a slice.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::ensembles) fn scatter<L: Level, T: Real, P: Pack>(from: &T::Over<P>, into: &mut [T]) {
    L::enter(Scatter::<T, P> { from, into });
}

struct Scatter<'a, T: Real, P: Pack> {
    from: &'a T::Over<P>,
    into: &'a mut [T],
}

impl<T: Real, P: Pack> Kernel for Scatter<'_, T, P> {
    type Output = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) {
        T::scatter::<P>(*self.from, self.into);
    }
}

/// Loads the lanes of a carried value from rows, one per component.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::ensembles) fn load<L, T, P, V>(rows: &[T], to: &mut V)
where
    L: Level,
    T: Real,
    P: Pack,
    V: Vector<Scalar = T::Over<P>>,
{
    let mut rows = rows.chunks_exact(P::LANES as usize);
    for k in 0..V::PARTS {
        for (component, row) in to.part_mut(k).iter_mut().zip(&mut rows) {
            gather::<L, T, P>(row, component);
        }
    }
}

/// Stores the lanes of a carried value into rows, one per component.
#[cfg_attr(not(unoptimised), inline(always))]
pub(in crate::ensembles) fn store<L, T, P, V>(from: &V, rows: &mut [T])
where
    L: Level,
    T: Real,
    P: Pack,
    V: Vector<Scalar = T::Over<P>>,
{
    let mut rows = rows.chunks_exact_mut(P::LANES as usize);
    for k in 0..V::PARTS {
        for (component, row) in from.part(k).iter().zip(&mut rows) {
            scatter::<L, T, P>(component, row);
        }
    }
}

/// Combines the systems of the lanes into one, and makes the map of its steps.
pub(in crate::ensembles) struct Prepare<'a, T: Real, S: System, P, M> {
    scheme: &'a M,
    systems: &'a [&'a S::Prepared<T>],
    steps: &'a [T],
    pack: PhantomData<P>,
}

impl<'a, T: Real, S: System, P, M> Prepare<'a, T, S, P, M> {
    pub(in crate::ensembles) fn new(
        scheme: &'a M,
        systems: &'a [&'a S::Prepared<T>],
        steps: &'a [T],
    ) -> Self {
        let pack = PhantomData;
        Prepare {
            scheme,
            systems,
            steps,
            pack,
        }
    }
}

impl<T, S, P, M> Kernel for Prepare<'_, T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    type Output = (S::Prepared<T::Over<P>>, MapIn<T, S, P, M>);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> Self::Output {
        let prepared = S::gather::<T, P>(self.systems);
        let step = Step::of(gathered::<L, T, P>(self.steps));
        let map = self.scheme.prepare(&prepared, step);
        (prepared, map)
    }
}

/// Makes the carried value of a scheme at a state that is the same in all lanes.
pub(in crate::ensembles) struct Begin<'a, T: Real, S: System, P: Pack, M> {
    scheme: &'a M,
    prepared: &'a S::Prepared<T::Over<P>>,
    state: &'a State<VectorOf<S, T>>,
    steps: &'a [T],
}

impl<'a, T: Real, S: System, P: Pack, M> Begin<'a, T, S, P, M> {
    pub(in crate::ensembles) fn new(
        scheme: &'a M,
        prepared: &'a S::Prepared<T::Over<P>>,
        state: &'a State<VectorOf<S, T>>,
        steps: &'a [T],
    ) -> Self {
        Begin {
            scheme,
            prepared,
            state,
            steps,
        }
    }
}

impl<T, S, P, M> Kernel for Begin<'_, T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    type Output = CarriedIn<T, S, P, M>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> Self::Output {
        let State { t, q, p } = self.state;
        let mut start = State {
            t: t.spread::<P>(),
            q: q.zeros_over(),
            p: p.zeros_over(),
        };
        for (to, from) in [(&mut start.q, q), (&mut start.p, p)] {
            for k in 0..<VectorOf<S, T> as Vector>::PARTS {
                for (to, from) in to.part_mut(k).iter_mut().zip(from.part(k)) {
                    *to = from.spread::<P>();
                }
            }
        }
        let h = gathered::<L, T, P>(self.steps);
        self.scheme.start(self.prepared, &start, h)
    }
}
