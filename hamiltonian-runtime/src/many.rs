//! The schemes of ensembles as one type.
//!
//! Input: a splitting by its table, the midpoint rule, or Gauss' method of four stages. Output: [`Many`], whose map is one of
//! theirs. Invariant: the operations and the carried numbers are those of the scheme, so the bits are the same; core's
//! ensembles and sweeps are compiled once for all of them.

use crate::by_table::ByTable;
use crate::in_frame::InFrameMap;
use crate::prepared::{Flat, Prepared};
use crate::system::RuntimeSystem;
use crate::weights::Flows;
use hamiltonian_core::schemes::author::{
    Cause, Clock, Description, Entry, Listed, Map, Pair, Point, Scratch, Step,
};
use hamiltonian_core::schemes::inside::{Carries, Stages};
use hamiltonian_core::schemes::{Gauss, ImplicitMidpoint};
use hamiltonian_core::{Error, Scheme, State, Vector};
use hamiltonian_lanes::Real;
use std::fmt::{self, Debug, Formatter};

/// A scheme of ensembles.
#[allow(clippy::large_enum_variant)] // There is one for each ensemble.
#[derive(Clone)]
pub(crate) enum Many {
    Table(ByTable),
    ImplicitMidpoint(ImplicitMidpoint),
    Gauss4(Gauss<4>),
}

/// Calls the same function of the scheme, or of the map.
macro_rules! each {
    ($self:expr, $of:ident => $call:expr) => {
        match $self {
            Many::Table($of) => $call,
            Many::ImplicitMidpoint($of) => $call,
            Many::Gauss4($of) => $call,
        }
    };
}

impl Debug for Many {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        each!(self, scheme => scheme.fmt(f))
    }
}

impl Listed for Many {
    fn entry(&self) -> Entry {
        each!(self, scheme => scheme.entry())
    }
}

/// The carried value of all of them is that of Gauss' method. A splitting has no numbers behind the point, and the midpoint
/// rule has its slope in the place of the low words.
type Carried<T> = Carries<Flat<T>, 4>;
type ByTableMap<T> = InFrameMap<Flows<T>, T>;
type MidpointMap<T> = <ImplicitMidpoint as Scheme<RuntimeSystem>>::Map<T>;
type GaussMap<T> = <Gauss<4> as Scheme<RuntimeSystem>>::Map<T>;

/// A point without coordinates.
fn nothing<T: Real>() -> Point<Flat<T>> {
    let nothing = || Flat::from_element(0, T::zero());
    Point {
        q: nothing(),
        p: nothing(),
    }
}

/// A carried value without stages.
fn without_stages<T: Real>(x: Point<Flat<T>>, y: Point<Flat<T>>) -> Carried<T> {
    let stages = Stages([(); 4].map(|()| nothing()));
    Pair {
        x,
        y: Pair { x: stages, y },
    }
}

impl Scheme<RuntimeSystem> for Many {
    type Carried = <Gauss<4> as Scheme<RuntimeSystem>>::Carried;
    type Map<T: Real> = ManyMap<T>;

    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        each!(self, scheme => Scheme::<RuntimeSystem>::times_of_jumps(scheme, of))
    }

    fn check<T: Real>(&self, prepared: &Prepared<T>, state: &State<Flat<T>>) -> Result<(), Error> {
        each!(self, scheme => Scheme::<RuntimeSystem>::check(scheme, prepared, state))
    }

    #[inline(always)]
    fn prepare<T: Real>(&self, prepared: &Prepared<T>, step: Step<T>) -> ManyMap<T> {
        match self {
            Many::Table(scheme) => ManyMap::Table(scheme.prepare(prepared, step)),
            Many::ImplicitMidpoint(scheme) => {
                ManyMap::ImplicitMidpoint(Scheme::<RuntimeSystem>::prepare(scheme, prepared, step))
            }
            Many::Gauss4(scheme) => {
                ManyMap::Gauss4(Scheme::<RuntimeSystem>::prepare(scheme, prepared, step))
            }
        }
    }

    fn start<T: Real>(&self, prepared: &Prepared<T>, state: &State<Flat<T>>, h: T) -> Carried<T> {
        match self {
            Many::Table(_) => without_stages(state.point(), nothing()),
            Many::ImplicitMidpoint(scheme) => {
                let Pair { x, y } = Scheme::<RuntimeSystem>::start(scheme, prepared, state, h);
                without_stages(x, y)
            }
            Many::Gauss4(scheme) => Scheme::<RuntimeSystem>::start(scheme, prepared, state, h),
        }
    }
}

/// The map of one of them.
#[allow(clippy::large_enum_variant)] // There is one for each pack.
pub(crate) enum ManyMap<T: Real> {
    Table(ByTableMap<T>),
    ImplicitMidpoint(MidpointMap<T>),
    Gauss4(GaussMap<T>),
}

/// The scratch of each, made by the first call that needs it.
pub(crate) struct ManyWork<T: Real> {
    table: Option<<ByTableMap<T> as Map>::Work>,
    midpoint: Option<<MidpointMap<T> as Map>::Work>,
    gauss: Option<<GaussMap<T> as Map>::Work>,
}

impl<T: Real> Scratch<Carried<T>> for ManyWork<T> {
    fn like(_: &Carried<T>) -> Self {
        ManyWork {
            table: None,
            midpoint: None,
            gauss: None,
        }
    }
}

/// Calls a method of the map with its carried value and its scratch, in a function of its own: each is compiled once for all
/// drivers over a scalar.
macro_rules! on {
    ($self:ident, $z:ident, $work:ident, ($map:ident, $own:ident, $scratch:ident) => $call:expr) => {
        T::out_of_line(
            #[inline(always)]
            || on!(@here $self, $z, $work, ($map, $own, $scratch) => $call),
        )
    };
    (@here $self:ident, $z:ident, $work:ident, ($map:ident, $own:ident, $scratch:ident) => $call:expr) => {
        match $self {
            ManyMap::Table($map) => {
                let $own = &mut $z.x;
                let $scratch = $work.table.get_or_insert_with(|| Scratch::like($own));
                $call
            }
            ManyMap::ImplicitMidpoint($map) => {
                let mut whole = Pair {
                    x: $z.x.take(),
                    y: $z.y.y.take(),
                };
                let $own = &mut whole;
                let $scratch = $work.midpoint.get_or_insert_with(|| Scratch::like($own));
                let result = $call;
                ($z.x, $z.y.y) = (whole.x, whole.y);
                result
            }
            ManyMap::Gauss4($map) => {
                let $own = &mut *$z;
                let $scratch = $work.gauss.get_or_insert_with(|| Scratch::like($own));
                $call
            }
        }
    };
}

impl<T: Real> Map for ManyMap<T> {
    type Carried = Carried<T>;
    type Work = ManyWork<T>;

    #[inline(always)]
    fn open(&self, t: T, z: &mut Carried<T>, work: &mut ManyWork<T>) {
        on!(self, z, work, (map, own, scratch) => map.open(t, own, scratch));
    }
    #[inline(always)]
    fn body(&self, t: T, end: T, z: &mut Carried<T>, work: &mut ManyWork<T>) {
        on!(self, z, work, (map, own, scratch) => map.body(t, end, own, scratch));
    }
    #[inline(always)]
    fn close(&self, t: T, z: &mut Carried<T>, work: &mut ManyWork<T>) {
        on!(self, z, work, (map, own, scratch) => map.close(t, own, scratch));
    }
    #[inline(always)]
    fn closing(&self) -> [bool; 2] {
        match self {
            ManyMap::Table(map) => map.closing(),
            ManyMap::ImplicitMidpoint(map) => map.closing(),
            ManyMap::Gauss4(map) => map.closing(),
        }
    }
    #[inline(always)]
    fn join(&self, t: T, z: &mut Carried<T>, work: &mut ManyWork<T>) {
        on!(self, z, work, (map, own, scratch) => map.join(t, own, scratch));
    }
    #[cold]
    fn explain(
        &self,
        t: T,
        end: T,
        first: bool,
        z: &mut Carried<T>,
        work: &mut ManyWork<T>,
    ) -> Cause {
        on!(self, z, work, (map, own, scratch) => map.explain(t, end, first, own, scratch))
    }
    #[inline(always)]
    fn has_parts(&self) -> bool {
        match self {
            ManyMap::Table(map) => map.has_parts(),
            ManyMap::ImplicitMidpoint(map) => map.has_parts(),
            ManyMap::Gauss4(map) => map.has_parts(),
        }
    }
    #[inline(always)]
    fn part(&self, t: T, by: T, last: T, z: &mut Carried<T>, work: &mut ManyWork<T>) {
        on!(self, z, work, (map, own, scratch) => map.part(t, by, last, own, scratch));
    }
    #[inline(always)]
    fn go_on(
        &self,
        clock: Clock<T>,
        made: u64,
        end: u64,
        z: &mut Carried<T>,
        work: &mut ManyWork<T>,
    ) {
        on!(self, z, work, (map, own, scratch) => map.go_on(clock, made, end, own, scratch));
    }
}
