//! Processed schemes whose kernel is made in a frame.
//!
//! Input: a processed scheme, and the table of its kernel. Output: [`InFrame`], the same scheme, whose steps are those of a
//! [`Cycle`]. Invariant: the flows of the kernel in their order, so the bits are those of the scheme.

use crate::by_table::Weights;
use crate::cycle::{Cycle, CycleFrame};
use crate::erased::once;
use crate::flow::{Inside, PartFlow};
use crate::prepared::{Flat, Prepared};
use crate::system::{RuntimePieces, RuntimeSystem};
use hamiltonian_core::schemes::author::{
    Cause, Clock, Description, Entry, Listed, Map, Point, Step, Zigzag,
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
        let flows: Zigzag<Point<Flat<T>>, PartFlow<T>, Inside<T>, Weights> =
            Zigzag::new(&self.kernel, &RuntimePieces::All, prepared, step);
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

/// The map of a processed scheme, with the steps of its kernel as one code where they are short.
#[derive(Debug)]
pub(crate) struct InFrameMap<K, T: Real> {
    map: K,
    cycle: Option<Cycle<T>>,
}

impl<T: Real, K: Map<Carried = Point<Flat<T>>>> Map for InFrameMap<K, T> {
    type Carried = Point<Flat<T>>;
    /// The scratch of the map, and the frame.
    type Work = (K::Work, CycleFrame<T>);

    fn open(&self, t: T, z: &mut Point<Flat<T>>, work: &mut Self::Work) {
        self.map.open(t, z, &mut work.0);
    }
    fn body(&self, t: T, end: T, z: &mut Point<Flat<T>>, work: &mut Self::Work) {
        once(&self.map, [t, end], z, &mut work.0);
    }
    fn close(&self, t: T, z: &mut Point<Flat<T>>, work: &mut Self::Work) {
        self.map.close(t, z, &mut work.0);
    }
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
