//! Steps of splittings that are made in a frame.
//!
//! Input: the flows of a splitting, and a map whose steps they are. Output: [`InFrameMap`], the same map, whose steps are those
//! of a [`Cycle`] where the flows are short, and [`InFrame`], a processed scheme by the table of its kernel. Invariant: the
//! flows in their order, so the bits are those of the map.

use crate::cycle::{Cycle, CycleFrame};
use crate::prepared::{Flat, Prepared};
use crate::system::{RuntimePieces, RuntimeSystem};
use crate::weights::{Flows, Weights};
use hamiltonian_core::schemes::author::{
    Cause, Clock, Description, Entry, Listed, Map, Point, Step,
};
use hamiltonian_core::{Error, Scheme, State, System};
use hamiltonian_lanes::Real;
use std::fmt::{self, Debug, Formatter};

/// A processed scheme, with the table of its kernel.
#[derive(Clone)]
pub(crate) struct InFrame<M> {
    pub(crate) scheme: M,
    pub(crate) kernel: Weights,
}

impl<M: Debug> Debug for InFrame<M> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.scheme.fmt(f)
    }
}

impl<M: Listed> Listed for InFrame<M> {
    fn entry(&self) -> Entry {
        self.scheme.entry()
    }
}

impl<M> Scheme<RuntimeSystem> for InFrame<M>
where
    M: Scheme<RuntimeSystem, Carried = Point<<RuntimeSystem as System>::Shape>>,
{
    type Carried = Point<<RuntimeSystem as System>::Shape>;
    type Map<T: Real> = InFrameMap<M::Map<T>, T>;

    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        self.scheme.times_of_jumps(of)
    }

    fn check<T: Real>(&self, prepared: &Prepared<T>, state: &State<Flat<T>>) -> Result<(), Error> {
        self.scheme.check(prepared, state)
    }

    fn prepare<T: Real>(&self, prepared: &Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let flows = self.kernel.flows(&RuntimePieces::All, prepared, step);
        InFrameMap {
            cycle: Cycle::new(flows.flows()),
            map: self.scheme.prepare(prepared, step),
        }
    }

    fn start<T: Real>(
        &self,
        prepared: &Prepared<T>,
        state: &State<Flat<T>>,
        h: T,
    ) -> Point<Flat<T>> {
        self.scheme.start(prepared, state, h)
    }
}

/// A map, with its steps as one code where they are short.
#[derive(Debug)]
pub(crate) struct InFrameMap<K, T: Real> {
    map: K,
    cycle: Option<Cycle<T>>,
}

impl<T: Real> InFrameMap<Flows<T>, T> {
    /// The map of a splitting.
    pub(crate) fn of(flows: Flows<T>) -> Self {
        InFrameMap {
            cycle: Cycle::new(flows.flows()),
            map: flows,
        }
    }
}

impl<T: Real, K: Map<Carried = Point<Flat<T>>>> Map for InFrameMap<K, T> {
    type Carried = Point<Flat<T>>;
    /// The scratch of the map, and the frame.
    type Work = (K::Work, CycleFrame<T>);

    #[inline(always)]
    fn open(&self, t: T, z: &mut Point<Flat<T>>, work: &mut Self::Work) {
        self.map.open(t, z, &mut work.0);
    }
    /// Compiled once, for one step and for a loop over them.
    #[inline(always)]
    fn body(&self, t: T, end: T, z: &mut Point<Flat<T>>, work: &mut Self::Work) {
        T::out_of_line(
            #[inline(always)]
            || self.map.body(t, end, z, &mut work.0),
        );
    }
    #[inline(always)]
    fn close(&self, t: T, z: &mut Point<Flat<T>>, work: &mut Self::Work) {
        self.map.close(t, z, &mut work.0);
    }
    #[inline(always)]
    fn closing(&self) -> [bool; 2] {
        self.map.closing()
    }
    #[inline(always)]
    fn join(&self, t: T, z: &mut Point<Flat<T>>, work: &mut Self::Work) {
        self.map.join(t, z, &mut work.0);
    }
    #[cold]
    fn explain(
        &self,
        t: T,
        end: T,
        first: bool,
        z: &mut Point<Flat<T>>,
        work: &mut Self::Work,
    ) -> Cause {
        self.map.explain(t, end, first, z, &mut work.0)
    }
    #[inline(always)]
    fn go_on(
        &self,
        clock: Clock<T>,
        made: u64,
        end: u64,
        z: &mut Point<Flat<T>>,
        work: &mut Self::Work,
    ) {
        if let Some(cycle) = &self.cycle {
            return cycle.go_on(|k| clock.at(k), (made, end), z, &mut work.1);
        }
        for k in made..end {
            if k > made {
                self.join(clock.at(k), z, work);
            }
            self.body(clock.at(k), clock.at(k + 1), z, work);
        }
    }
}
