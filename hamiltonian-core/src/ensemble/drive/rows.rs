//! Numbers of lanes and what is prepared for them, out of line.
//!
//! Input: numbers of members, or those of lanes. Output: the other. Invariant: this code is as long as a pack is
//! wide, so that each function of it occurs once in a pack type, and is called.

use crate::map::Step;
use crate::scheme::Scheme;
use crate::system::System;
use crate::system::gather::{Gather, VectorOver};
use crate::vector::Vector;
use core::marker::PhantomData;
use hamiltonian_lanes::{KernelAt, Level, Pack, Real};

/// A number of each member in its lane.
#[inline(always)]
pub(in crate::ensemble) fn gathered<L: Level, T: Real, P: Pack>(numbers: &[T]) -> T::Over<P> {
    let pack = PhantomData::<P>;
    L::enter_at(Gathered { numbers, pack })
}

struct Gathered<'a, T, P> {
    numbers: &'a [T],
    pack: PhantomData<P>,
}

impl<L: Level, T: Real, P: Pack> KernelAt<L> for Gathered<'_, T, P> {
    type Output = T::Over<P>;
    #[inline(always)]
    fn run(self) -> T::Over<P> {
        T::gather::<P>(self.numbers)
    }
}

/// The number of each lane.
#[inline(always)]
pub(in crate::ensemble) fn scatter<L: Level, T: Real, P: Pack>(from: &T::Over<P>, into: &mut [T]) {
    L::enter_at(Scatter::<T, P> { from, into });
}

struct Scatter<'a, T: Real, P: Pack> {
    from: &'a T::Over<P>,
    into: &'a mut [T],
}

impl<L: Level, T: Real, P: Pack> KernelAt<L> for Scatter<'_, T, P> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        T::scatter::<P>(*self.from, self.into);
    }
}

/// The lanes of a carried value from rows, one a component.
#[inline(always)]
pub(in crate::ensemble) fn load<L, T, P, V>(rows: &[T], to: &mut V)
where
    L: Level,
    T: Real,
    P: Pack,
    V: Vector<Scalar = T::Over<P>>,
{
    let mut rows = rows.chunks_exact(P::LANES as usize);
    for k in 0..V::PARTS {
        for (component, row) in to.part_mut(k).iter_mut().zip(&mut rows) {
            *component = gathered::<L, T, P>(row);
        }
    }
}

/// The lanes of a carried value into rows.
#[inline(always)]
pub(in crate::ensemble) fn store<L, T, P, V>(from: &V, rows: &mut [T])
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

/// The systems of the lanes as one, and the map for the steps of the lanes.
pub(in crate::ensemble) struct Prepare<'a, T: Real, S: System<T>, P, M> {
    scheme: &'a M,
    systems: &'a [&'a S::Prepared],
    steps: &'a [T],
    pack: PhantomData<P>,
}

impl<'a, T: Real, S: System<T>, P, M> Prepare<'a, T, S, P, M> {
    pub(in crate::ensemble) fn new(
        scheme: &'a M,
        systems: &'a [&'a S::Prepared],
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

impl<L, T, S, P, M> KernelAt<L> for Prepare<'_, T, S, P, M>
where
    L: Level,
    T: Real,
    P: Pack,
    S: System<T, Prepared: Gather<T>>
        + System<
            T::Over<P>,
            Vector = VectorOver<<S as System<T>>::Vector, P>,
            Prepared = <<S as System<T>>::Prepared as Gather<T>>::Over<T::Over<P>>,
        >,
    M: Scheme<T::Over<P>, S>,
{
    type Output = (<S as System<T::Over<P>>>::Prepared, M::Map);

    #[inline(always)]
    fn run(self) -> Self::Output {
        let prepared = <S as System<T>>::Prepared::gather::<P>(self.systems);
        let step = Step::of(T::gather::<P>(self.steps));
        let map = self.scheme.prepare(&prepared, step);
        (prepared, map)
    }
}
