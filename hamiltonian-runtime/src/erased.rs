//! Schemes of single runs without their types.
//!
//! Input: a scheme that carries a point with other numbers behind it. Output: [`AnyScheme`], whose maps have one type.
//! Invariant: the operations are those of the scheme, so the bits are the same; core's run is compiled once for all schemes,
//! and of a scheme its steps alone.

use crate::prepared::{Flat, Prepared};
use crate::system::RuntimeSystem;
use hamiltonian_core::schemes::author::{
    Carried, Cause, Clock, Description, Entry, Listed, Map, Pair, Point, ScalarOf, Scratch, Step,
};
use hamiltonian_core::{Error, Scheme, State, System, Vector};
use hamiltonian_lanes::Real;
use std::any::Any;
use std::fmt::{self, Debug, Formatter};
use std::marker::PhantomData;
use std::sync::Arc;

type Shape = <RuntimeSystem as System>::Shape;

/// The carried value of every scheme here: the point, then all other numbers.
type Words<T> = Pair<Point<Flat<T>>, Flat<T>>;

/// A carried value that is a point, or a point with other numbers behind it: its first parts are those of the point that
/// is seen, and all its steps have one duration.
pub(crate) trait PointFirst: Carried<Scalar = f64, Vector = Flat<f64>> {}

impl PointFirst for Point<Flat<f64>> {}
impl<Y: Vector<Scalar = f64>> PointFirst for Pair<Point<Flat<f64>>, Y> {}

/// A scheme of a [`RuntimeSystem`] whose runs may go to another thread.
pub(crate) trait Runs:
    Scheme<
        RuntimeSystem,
        Map<f64>: Send + Sync + 'static + Map<Carried: PointFirst, Work: Send + 'static>,
    >
{
}

impl<M> Runs for M where
    M: Scheme<
            RuntimeSystem,
            Map<f64>: Send + Sync + 'static + Map<Carried: PointFirst, Work: Send + 'static>,
        >
{
}

/// A scheme of runs over `f64`.
#[derive(Clone)]
pub(crate) struct AnyScheme(Arc<dyn Erased>);

/// The methods of a scheme over `f64`.
trait Erased: Send + Sync {
    fn entry(&self) -> Entry;
    fn debug(&self, f: &mut Formatter<'_>) -> fmt::Result;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2];
    fn check(&self, prepared: &Prepared<f64>, state: &State<Flat<f64>>) -> Result<(), Error>;
    fn prepare(&self, prepared: &Prepared<f64>, step: Step<f64>) -> AnyMap<f64>;
    fn start(&self, prepared: &Prepared<f64>, state: &State<Flat<f64>>, h: f64) -> Words<f64>;
    fn start_alone(&self, prepared: &Prepared<f64>, state: &State<Flat<f64>>, h: f64)
    -> Words<f64>;
}

/// A scheme. With `ONCE`, its step is compiled once, for one step and for a loop over them: core inlines it in both. Without
/// it, the loop is that of the map, which may be its own.
struct Typed<M, const ONCE: bool>(M);

impl<M: Runs, const ONCE: bool> Erased for Typed<M, ONCE> {
    fn entry(&self) -> Entry {
        self.0.entry()
    }
    fn debug(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        self.0.times_of_jumps(of)
    }
    fn check(&self, prepared: &Prepared<f64>, state: &State<Flat<f64>>) -> Result<(), Error> {
        self.0.check(prepared, state)
    }
    fn prepare(&self, prepared: &Prepared<f64>, step: Step<f64>) -> AnyMap<f64> {
        AnyMap(Box::new(Native::<M, ONCE> {
            map: self.0.prepare(prepared, step),
            scheme: self.0.clone(),
            prepared: prepared.clone(),
            h: step.h,
        }))
    }
    fn start(&self, prepared: &Prepared<f64>, state: &State<Flat<f64>>, h: f64) -> Words<f64> {
        words(&started(&self.0, prepared, state, h))
    }
    fn start_alone(
        &self,
        prepared: &Prepared<f64>,
        state: &State<Flat<f64>>,
        h: f64,
    ) -> Words<f64> {
        words(&self.0.start_alone(prepared, state, h))
    }
}

impl AnyScheme {
    /// A scheme by its type, with its step compiled once or with the loop of its map.
    pub(crate) fn new<const ONCE: bool>(scheme: impl Runs) -> Self {
        AnyScheme(Arc::new(Typed::<_, ONCE>(scheme)))
    }
}

impl Debug for AnyScheme {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.debug(f)
    }
}

impl Listed for AnyScheme {
    fn entry(&self) -> Entry {
        self.0.entry()
    }
}

/// A value over `T`, which is `f64`, as one over `f64`, or the reverse.
fn of_f64<A: Any, B: Any>(value: A) -> B {
    let value: Box<dyn Any> = Box::new(value);
    match value.downcast() {
        Ok(value) => *value,
        Err(_) => unreachable!("runs by name are over `f64`"),
    }
}

/// The same of a reference.
fn ref_of_f64<A: Any, B: Any>(value: &A) -> &B {
    let value: &dyn Any = value;
    match value.downcast_ref() {
        Some(value) => value,
        None => unreachable!("runs by name are over `f64`"),
    }
}

impl Scheme<RuntimeSystem> for AnyScheme {
    type Carried = Pair<Point<Shape>, Shape>;
    type Map<T: Real> = AnyMap<T>;

    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        self.0.times_of_jumps(of)
    }

    fn check<T: Real>(&self, prepared: &Prepared<T>, state: &State<Flat<T>>) -> Result<(), Error> {
        self.0.check(ref_of_f64(prepared), ref_of_f64(state))
    }

    fn prepare<T: Real>(&self, prepared: &Prepared<T>, step: Step<T>) -> AnyMap<T> {
        of_f64(self.0.prepare(ref_of_f64(prepared), of_f64(step)))
    }

    fn start<T: Real>(&self, prepared: &Prepared<T>, state: &State<Flat<T>>, h: T) -> Words<T> {
        let state = ref_of_f64(state);
        of_f64(self.0.start(ref_of_f64(prepared), state, of_f64(h)))
    }

    fn start_alone<T: Real>(
        &self,
        prepared: &Prepared<T>,
        state: &State<Flat<T>>,
        h: T,
    ) -> Words<T> {
        let state = ref_of_f64(state);
        of_f64(self.0.start_alone(ref_of_f64(prepared), state, of_f64(h)))
    }
}

/// The parts behind the point.
fn rest<C: Vector>() -> std::ops::Range<usize> {
    2..C::PARTS
}

/// All numbers of a carried value.
fn words<C: PointFirst>(from: &C) -> Words<f64> {
    let others: Vec<f64> = rest::<C>().flat_map(|k| from.part(k)).copied().collect();
    Pair {
        x: from.point().clone(),
        y: others.into(),
    }
}

/// Reads them back.
fn load<C: PointFirst>(from: &Words<f64>, to: &mut C) {
    to.part_mut(0).copy_from_slice(from.x.q.as_slice());
    to.part_mut(1).copy_from_slice(from.x.p.as_slice());
    let mut others = from.y.as_slice();
    for k in rest::<C>() {
        let part = to.part_mut(k);
        let (some, behind) = others.split_at(part.len());
        part.copy_from_slice(some);
        others = behind;
    }
}

/// Writes them.
fn store<C: PointFirst>(from: &C, to: &mut Words<f64>) {
    to.x.q.as_mut_slice().copy_from_slice(from.part(0));
    to.x.p.as_mut_slice().copy_from_slice(from.part(1));
    let mut others = to.y.as_mut_slice();
    for k in rest::<C>() {
        let part = from.part(k);
        let (some, behind) = others.split_at_mut(part.len());
        some.copy_from_slice(part);
        others = behind;
    }
}

/// The methods of a map.
trait MapOver<T: Real>: Send + Sync {
    fn open(&self, t: T, z: &mut Words<T>, work: &mut AnyWork<T>);
    fn body(&self, span: [T; 2], z: &mut Words<T>, work: &mut AnyWork<T>);
    fn close(&self, t: T, z: &mut Words<T>, work: &mut AnyWork<T>);
    fn join(&self, t: T, z: &mut Words<T>, work: &mut AnyWork<T>);
    /// Makes the steps after the first number, as many as the second.
    fn run(&self, clock: Clock<T>, of: [u64; 2], z: &mut Words<T>, work: &mut AnyWork<T>);
    fn explain(&self, span: [T; 2], first: bool, z: &mut Words<T>, work: &mut AnyWork<T>) -> Cause;
    fn has_parts(&self) -> bool;
    fn part(&self, t: T, of: [T; 2], z: &mut Words<T>, work: &mut AnyWork<T>);
}

/// A map of a scheme.
pub(crate) struct AnyMap<T: Real>(Box<dyn MapOver<T>>);

/// The carried value and the scratch of a map in their own types, allocated by the first call that needs them.
pub(crate) struct AnyWork<T>(Option<Box<dyn Any + Send>>, PhantomData<T>);

impl<T: Real> Scratch<Words<T>> for AnyWork<T> {
    fn like(_: &Words<T>) -> Self {
        AnyWork(None, PhantomData)
    }
}

impl<T: Real> Map for AnyMap<T> {
    type Carried = Words<T>;
    type Work = AnyWork<T>;

    fn open(&self, t: T, z: &mut Words<T>, work: &mut AnyWork<T>) {
        self.0.open(t, z, work);
    }
    fn body(&self, t: T, end: T, z: &mut Words<T>, work: &mut AnyWork<T>) {
        self.0.body([t, end], z, work);
    }
    fn close(&self, t: T, z: &mut Words<T>, work: &mut AnyWork<T>) {
        self.0.close(t, z, work);
    }
    fn join(&self, t: T, z: &mut Words<T>, work: &mut AnyWork<T>) {
        self.0.join(t, z, work);
    }
    fn explain(&self, t: T, end: T, first: bool, z: &mut Words<T>, work: &mut AnyWork<T>) -> Cause {
        self.0.explain([t, end], first, z, work)
    }
    fn has_parts(&self) -> bool {
        self.0.has_parts()
    }
    fn part(&self, t: T, by: T, last: T, z: &mut Words<T>, work: &mut AnyWork<T>) {
        self.0.part(t, [by, last], z, work);
    }
    fn run(&self, clock: Clock<T>, made: u64, n: u64, z: &mut Words<T>, work: &mut AnyWork<T>) {
        self.0.run(clock, [made, n], z, work);
    }
}

/// A map, with the scheme, the system and the step from which its carried value is made.
struct Native<M: Runs, const ONCE: bool> {
    map: M::Map<f64>,
    scheme: M,
    prepared: Prepared<f64>,
    h: f64,
}

/// The carried value of the maps of a scheme, and their scratch.
type CarriedOf<M> = <<M as Scheme<RuntimeSystem>>::Map<f64> as Map>::Carried;
type WorkOf<M> = <<M as Scheme<RuntimeSystem>>::Map<f64> as Map>::Work;

/// A start in a function of its own: some schemes make a step in it.
#[inline(never)]
fn started<M: Runs>(
    scheme: &M,
    prepared: &Prepared<f64>,
    state: &State<Flat<f64>>,
    h: f64,
) -> CarriedOf<M> {
    scheme.start(prepared, state, h)
}

/// A step in a function of its own.
#[inline(never)]
fn once<M: Map>(map: &M, [t, end]: [ScalarOf<M>; 2], z: &mut M::Carried, work: &mut M::Work) {
    map.body(t, end, z, work);
}

impl<M: Runs, const ONCE: bool> Native<M, ONCE> {
    /// The scratch, with the carried value that these words are.
    fn own<'a>(
        &self,
        z: &Words<f64>,
        work: &'a mut AnyWork<f64>,
    ) -> &'a mut (CarriedOf<M>, WorkOf<M>) {
        let own = work.0.get_or_insert_with(|| {
            let Point { q, p } = z.x.clone();
            // For its shape.
            let state = State { t: 0.0, q, p };
            let carried = started(&self.scheme, &self.prepared, &state, self.h);
            let scratch = WorkOf::<M>::like(&carried);
            Box::new((carried, scratch))
        });
        let Some(own) = own.downcast_mut::<(CarriedOf<M>, WorkOf<M>)>() else {
            unreachable!("a run has one scheme");
        };
        load(z, &mut own.0);
        own
    }

    /// Calls a method of the map on that carried value.
    fn on<A>(
        &self,
        z: &mut Words<f64>,
        work: &mut AnyWork<f64>,
        call: impl FnOnce(&M::Map<f64>, &mut CarriedOf<M>, &mut WorkOf<M>) -> A,
    ) -> A {
        let (carried, work) = self.own(z, work);
        let result = call(&self.map, carried, work);
        store(carried, z);
        result
    }
}

impl<M: Runs, const ONCE: bool> MapOver<f64> for Native<M, ONCE> {
    fn open(&self, t: f64, z: &mut Words<f64>, work: &mut AnyWork<f64>) {
        self.on(z, work, |map, z, work| map.open(t, z, work));
    }
    fn body(&self, [t, end]: [f64; 2], z: &mut Words<f64>, work: &mut AnyWork<f64>) {
        self.on(z, work, |map, z, work| match ONCE {
            true => once(map, [t, end], z, work),
            false => map.body(t, end, z, work),
        });
    }
    fn close(&self, t: f64, z: &mut Words<f64>, work: &mut AnyWork<f64>) {
        self.on(z, work, |map, z, work| map.close(t, z, work));
    }
    fn join(&self, t: f64, z: &mut Words<f64>, work: &mut AnyWork<f64>) {
        self.on(z, work, |map, z, work| map.join(t, z, work));
    }
    fn run(
        &self,
        clock: Clock<f64>,
        [made, n]: [u64; 2],
        z: &mut Words<f64>,
        work: &mut AnyWork<f64>,
    ) {
        if !ONCE {
            return self.on(z, work, |map, z, work| map.run(clock, made, n, z, work));
        }
        self.on(z, work, |map, z, work| {
            for k in made..made + n {
                let t = clock.at(k);
                match k {
                    0 => map.open(t, z, work),
                    _ => map.join(t, z, work),
                }
                once(map, [t, clock.at(k + 1)], z, work);
            }
        });
    }
    fn explain(
        &self,
        [t, end]: [f64; 2],
        first: bool,
        z: &mut Words<f64>,
        work: &mut AnyWork<f64>,
    ) -> Cause {
        self.on(z, work, |map, z, work| map.explain(t, end, first, z, work))
    }
    fn has_parts(&self) -> bool {
        self.map.has_parts()
    }
    fn part(&self, t: f64, [by, last]: [f64; 2], z: &mut Words<f64>, work: &mut AnyWork<f64>) {
        self.on(z, work, |map, z, work| map.part(t, by, last, z, work));
    }
}
