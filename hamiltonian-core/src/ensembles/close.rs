//! States of lanes, written out of line: a row for each component.
//!
//! Input: the carried values of the lanes. Output: the closed states. Invariant: the carried values are not
//! changed.

use crate::flows::map::{Clock, Map};
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, Point};
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use hamiltonian_lanes::{Kernel, Level, Pack, Real};

/// Closes a copy of the carried value and writes it to rows of lanes: coordinates, momenta, the time and
/// the duration of a step.
pub(crate) struct Close<'a, R: Map<Carried: Carried<Scalar = T::Over<P>>>, T: Real, P: Pack> {
    pub(crate) map: &'a R,
    pub(crate) clock: Clock<T::Over<P>>,
    /// Steps since the clock began. A number that is negative as an `i64` is a step before.
    pub(crate) made: u64,
    pub(crate) carried: &'a R::Carried,
    pub(crate) shown: &'a mut R::Carried,
    pub(crate) rows: &'a mut Vec<T>,
}

impl<R, T, P> Kernel for Close<'_, R, T, P>
where
    R: Map<Carried: Carried<Scalar = T::Over<P>>>,
    T: Real,
    P: Pack,
{
    /// True if the duration of a step is carried; and the lanes in which the state is finite.
    type Output = (bool, <T::Over<P> as Real>::Mask);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> Self::Output {
        let t = self.clock.at(self.made);
        self.shown.copy_from(self.carried);
        let mut work = R::Work::like(self.carried);
        self.map.close(t, self.shown, &mut work);
        let (clock, made) = (self.clock, self.made);
        let (carried, shown, rows) = (self.carried, &*self.shown, self.rows);
        let write = WriteRows::<'_, _, T, P> {
            clock,
            made,
            carried,
            shown,
            rows,
        };
        let carries_duration = write.write();
        let finite = shown.finite() & carried.finite() & shown.time(t).finite();
        (carries_duration, finite)
    }
}

/// Writes a closed copy of the carried value to rows of lanes, as [`Close`] does.
pub(crate) struct WriteRows<'a, C: Carried<Scalar = T::Over<P>>, T: Real, P: Pack> {
    pub(crate) clock: Clock<T::Over<P>>,
    pub(crate) made: u64,
    pub(crate) carried: &'a C,
    pub(crate) shown: &'a C,
    pub(crate) rows: &'a mut Vec<T>,
}

impl<C: Carried<Scalar = T::Over<P>>, T: Real, P: Pack> WriteRows<'_, C, T, P> {
    /// Returns true if the duration of a step is carried.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn write(self) -> bool {
        let lanes = P::LANES as usize;
        let Point { q, p } = self.shown.point();
        self.rows.resize((2 * q.len() + 2) * lanes, T::zero());
        let mut rows = self.rows.chunks_exact_mut(lanes);
        for vector in [q, p] {
            for (c, row) in (0..vector.len()).zip(&mut rows) {
                T::scatter::<P>(vector.component(c), row);
            }
        }
        let duration = self.carried.duration(self.clock.interval);
        let last = [Some(self.shown.time(self.clock.at(self.made))), duration];
        for (number, row) in last.into_iter().flatten().zip(rows) {
            T::scatter::<P>(number, row);
        }
        duration.is_some()
    }
}

impl<C, T, P> Kernel for WriteRows<'_, C, T, P>
where
    C: Carried<Scalar = T::Over<P>>,
    T: Real,
    P: Pack,
{
    /// True if the duration of a step is carried.
    type Output = bool;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> bool {
        self.write()
    }
}
