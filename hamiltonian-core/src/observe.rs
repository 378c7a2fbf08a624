//! Watching a run.
//!
//! Input: states of a run, as [`View`]s. Output: the results of an [`Observer`]:
//! [`EnergyDrift`], [`Monitors`], [`Recorder`](crate::Recorder), a closure. Invariant: watching
//! changes no bit of the run.

mod follow;

#[doc(hidden)]
pub use follow::{Follower, Quantity};
pub(crate) use follow::{Track, Tracker};

use crate::checkpoint::Memory;
use crate::error::Error;
use crate::state::State;
use crate::system::{Dynamics, ObservableKind, System, declared_energy};
use crate::vector::Vector;
use alloc::vec::Vec;
use core::ops::ControlFlow;
use hamiltonian_lanes::Real;

/// A state of a run as observers see it.
pub struct View<'a, T: Real, S: System<T>> {
    /// The number of steps made.
    pub step: u64,
    /// Time, coordinates and momenta, all at the same time; finite.
    pub state: &'a State<S::Vector>,
    /// The system with its parameters worked in.
    pub prepared: &'a S::Prepared,
    /// The way to states at other times.
    pub(crate) between: &'a dyn Between<S::Vector>,
}

/// The state near the present one at another time, by a part of a step.
pub(crate) trait Between<V: Vector> {
    fn state_at(&self, t: V::Scalar) -> Result<State<V>, Error>;
    /// The state so much time after `from`, a state of the run, on the way to the next.
    fn part(&self, from: &State<V>, time: V::Scalar) -> Result<State<V>, Error>;
    /// The time between two states, one step apart: the interval itself, without the rounding of times,
    /// unless the time is carried.
    fn between(&self, from: V::Scalar, to: V::Scalar) -> V::Scalar;
    /// The time one step advances.
    fn interval(&self) -> V::Scalar;
    /// The time at which the run began, or was given another step.
    fn start(&self) -> V::Scalar;
}

impl<T: Real, S: System<T>> View<'_, T, S> {
    /// H here, as it was declared: in another time, `dt = g*ds`, without g and the momentum of time.
    pub fn energy(&self) -> T {
        declared_energy::<T, S>(self.prepared, self.state)
    }

    /// The state at a time within one step of this one, by a part of a step of the same scheme.
    ///
    /// # Errors
    /// [`Error::Far`] for another time, those of a step.
    pub fn state_at(&self, t: T) -> Result<State<S::Vector>, Error> {
        self.between.state_at(t)
    }

    /// Observable `index` of [`System::OBSERVABLES`] here.
    pub fn observable(&self, index: usize) -> T {
        self.prepared
            .observable(index, self.state.t, &self.state.q, &self.state.p)
    }

    /// The observable of that name here; `None` where there is none.
    pub fn observable_named(&self, name: &str) -> Option<T> {
        S::observable_index(name).map(|index| self.observable(index))
    }
}

/// A watcher of a run, which may end it.
///
/// It is shown the state at which it is attached, and from then on every state whose step number,
/// counted from the start of the run, is a multiple of its interval. Which states it is shown
/// depends on nothing else: not on how the run is cut into calls. A tuple of observers is an
/// observer, and so is `&mut O`; a closure is attached by
/// [`Integrator::watch`](crate::Integrator::watch).
pub trait Observer<T: Real, S: System<T>> {
    /// Steps between observations, at least 1.
    fn interval(&self) -> u64 {
        1
    }
    /// Shows it the state at which it is attached; `Break` ends the run.
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.observe(view)
    }
    /// Shows it a state whose step number is a multiple of its interval; `Break` ends the run.
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()>;
    /// Visits what it follows, if that is the drift of functions of the state and nothing else, seen after
    /// every so many steps: ensembles then follow it in lanes.
    #[doc(hidden)]
    fn follow(&mut self, _: &mut Follower<T>) -> bool {
        false
    }
    /// Writes what it remembers. An observer that remembers nothing writes its name alone.
    fn save(&self, to: &mut Memory) {
        to.begin("");
    }
    /// Reads what it wrote, instead of being attached to the run whose present state it is shown.
    ///
    /// # Errors
    /// [`CheckpointError::Other`](crate::CheckpointError::Other) where another observer wrote it,
    /// [`CheckpointError::Damaged`](crate::CheckpointError::Damaged).
    fn restore(&mut self, _view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("")
    }
    /// The end it made of the run, after a `Break`: at a state between two steps, which the run then shows
    /// as its own, or (none) at the state it was shown.
    ///
    /// # Errors
    /// The error that kept it from observing on; the run returns it.
    fn end(&self) -> Result<Option<&State<S::Vector>>, Error> {
        Ok(None)
    }
}

/// The observer of a run that has none, `()`: only such a run takes one.
#[diagnostic::on_unimplemented(
    message = "this run has an observer: `{Self}`",
    label = "a run takes one observer",
    note = "pass several as a tuple, `.observe((EnergyDrift::new(), Recorder::new()))`",
    note = "attach closures after it, `.watch(steps, |view| …)`"
)]
pub trait Unobserved {}

impl Unobserved for () {}

/// The value a watching closure returns: nothing, or whether the run goes on.
pub trait Verdict {
    /// Whether the run goes on.
    fn control(self) -> ControlFlow<()>;
}

impl Verdict for () {
    fn control(self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl Verdict for ControlFlow<()> {
    fn control(self) -> ControlFlow<()> {
        self
    }
}

/// `Break` if either is.
fn both(a: ControlFlow<()>, b: ControlFlow<()>) -> ControlFlow<()> {
    match a {
        ControlFlow::Continue(()) => b,
        ControlFlow::Break(()) => a,
    }
}

/// A closure as an observer, where one is needed: in a tuple that is passed on, say. What it reads of
/// a state Rust does not infer here; [`Integrator::watch`](crate::Integrator::watch) knows it.
///
/// ```
/// use hamiltonian::View;
#[doc = include_str!("doc/oscillator.md")]
///
/// let rare = every(50, watch(|view: &View<'_, f64, Oscillator>| println!("{}", view.state.q[0])));
/// let often = watch(|view: &View<'_, f64, Oscillator>| println!("{}", view.energy()));
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), State::new([1.0], [0.0]), 0.01)?
///     .observe((rare, often));
/// run.advance(100)?;
/// # Ok::<(), Error>(())
/// ```
pub fn watch<T: Real, S: System<T>, R: Verdict, F: FnMut(&View<'_, T, S>) -> R>(
    closure: F,
) -> Watch<F> {
    Watch(closure)
}

/// The observer [`watch`] makes.
#[derive(Debug, Clone)]
pub struct Watch<F>(F);

impl<T: Real, S: System<T>, R: Verdict, F: FnMut(&View<'_, T, S>) -> R> Observer<T, S>
    for Watch<F>
{
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        (self.0)(view).control()
    }
}

/// Every `steps` steps (0 counts as 1), `observer`.
///
/// ```
#[doc = include_str!("doc/oscillator.md")]
///
/// let mut drift = EnergyDrift::new();
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), State::new([1.0], [0.0]), 0.01)?
///     .observe((&mut drift, every(100, Recorder::new())));
/// run.advance(1_000)?;
/// assert_eq!(run.observer().1.inner.rows(), 11);
/// assert!(drift.max_relative() < 1e-4);
/// # Ok::<(), Error>(())
/// ```
pub fn every<O>(steps: u64, observer: O) -> Every<O> {
    Every {
        steps: steps.max(1),
        inner: observer,
    }
}

/// The observer [`every`] makes.
#[derive(Debug, Clone)]
pub struct Every<O> {
    steps: u64,
    /// The observer that is shown every so many steps.
    pub inner: O,
}

impl<T: Real, S: System<T>, O: Observer<T, S>> Observer<T, S> for Every<O> {
    fn interval(&self) -> u64 {
        self.steps.saturating_mul(self.inner.interval().max(1))
    }
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.inner.attach(view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.inner.observe(view)
    }
    fn save(&self, to: &mut Memory) {
        self.inner.save(to);
    }
    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        self.inner.restore(view, from)
    }
    fn end(&self) -> Result<Option<&State<S::Vector>>, Error> {
        self.inner.end()
    }
    fn follow(&mut self, with: &mut Follower<T>) -> bool {
        self.inner.follow(with)
    }
}

impl<T: Real, S: System<T>, O: Observer<T, S> + ?Sized> Observer<T, S> for &mut O {
    fn interval(&self) -> u64 {
        (**self).interval()
    }
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        (**self).attach(view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        (**self).observe(view)
    }
    fn save(&self, to: &mut Memory) {
        (**self).save(to);
    }
    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        (**self).restore(view, from)
    }
    fn end(&self) -> Result<Option<&State<S::Vector>>, Error> {
        (**self).end()
    }
    fn follow(&mut self, with: &mut Follower<T>) -> bool {
        (**self).follow(with)
    }
}

impl<T: Real, S: System<T>> Observer<T, S> for () {
    fn interval(&self) -> u64 {
        u64::MAX
    }
    fn observe(&mut self, _: &View<'_, T, S>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
    fn save(&self, _: &mut Memory) {}
    fn restore(&mut self, _: &View<'_, T, S>, _: &mut Memory) -> Result<(), Error> {
        Ok(())
    }
    fn follow(&mut self, _: &mut Follower<T>) -> bool {
        true
    }
}

/// The greatest common divisor, so that every member of a tuple is reached; `u64::MAX`, the
/// interval of `()`, divides nothing and is passed over.
fn common(a: u64, b: u64) -> u64 {
    let (mut a, mut b) = (a.max(1), b.max(1));
    if a == u64::MAX || b == u64::MAX {
        return a.min(b);
    }
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

macro_rules! tuple {
    ($($observer:ident $index:tt),+) => {
        impl<T: Real, S: System<T>, $($observer: Observer<T, S>),+> Observer<T, S>
            for ($($observer,)+)
        {
            fn interval(&self) -> u64 {
                let mut interval = u64::MAX;
                $(interval = common(interval, self.$index.interval());)+
                interval
            }
            fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
                let mut control = ControlFlow::Continue(());
                $(control = both(control, self.$index.attach(view));)+
                control
            }
            fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
                let mut control = ControlFlow::Continue(());
                $(if view.step % self.$index.interval().max(1) == 0 {
                    control = both(control, self.$index.observe(view));
                })+
                control
            }
            fn save(&self, to: &mut Memory) {
                $(self.$index.save(to);)+
            }
            fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
                $(self.$index.restore(view, from)?;)+
                Ok(())
            }
            fn end(&self) -> Result<Option<&State<S::Vector>>, Error> {
                let mut end = None;
                $(end = end.or(self.$index.end()?);)+
                Ok(end)
            }
            fn follow(&mut self, with: &mut Follower<T>) -> bool {
                let interval = <Self as Observer<T, S>>::interval(self);
                let same = |of: u64| of == interval || of == u64::MAX;
                $(if !same(self.$index.interval()) || !self.$index.follow(with) {
                    return false;
                })+
                true
            }
        }
    };
}

tuple!(A 0);
tuple!(A 0, B 1);
tuple!(A 0, B 1, C 2);
tuple!(A 0, B 1, C 2, D 3);
tuple!(A 0, B 1, C 2, D 3, E 4);
tuple!(A 0, B 1, C 2, D 3, E 4, F 5);

/// The largest change of a function of the state since the observer was attached.
///
/// Differences are taken in the run's scalar, then rounded to `f64`.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation<T> {
    pub(crate) start: T,
    pub(crate) count: u64,
    pub(crate) max: f64,
    pub(crate) sum_of_sizes: f64,
    pub(crate) sum: f64,
}

impl<T: Real> Deviation<T> {
    pub(crate) fn new(start: T) -> Self {
        Deviation {
            start,
            count: 0,
            max: 0.0,
            sum_of_sizes: 0.0,
            sum: 0.0,
        }
    }

    fn record(&mut self, value: T) {
        let change = (value - self.start).to_f64();
        let size = if change < 0.0 { -change } else { change };
        self.count += 1;
        // A NaN stays, which `f64::max` would drop.
        if size > self.max || size.is_nan() {
            self.max = size;
        }
        self.sum_of_sizes += size;
        self.sum += change;
    }

    pub(crate) fn save(&self, to: &mut Memory) {
        to.scalar(self.start);
        to.count(self.count);
        for number in [self.max, self.sum_of_sizes, self.sum] {
            to.number(number);
        }
    }

    pub(crate) fn restored(from: &mut Memory) -> Result<Self, Error> {
        Ok(Deviation {
            start: from.read_scalar()?,
            count: from.read_count()?,
            max: from.read_number()?,
            sum_of_sizes: from.read_number()?,
            sum: from.read_number()?,
        })
    }

    /// The value f₀ at the start.
    pub fn start(&self) -> T {
        self.start
    }

    /// The number of states seen.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// max |f − f₀|.
    pub fn max_absolute(&self) -> f64 {
        self.max
    }

    /// max |f/f₀ − 1|; infinite or NaN when f₀ = 0.
    pub fn max_relative(&self) -> f64 {
        self.max / self.scale()
    }

    /// The mean of |f − f₀|.
    pub fn mean_absolute(&self) -> f64 {
        self.sum_of_sizes / self.count as f64
    }

    /// The mean of |f/f₀ − 1|; infinite or NaN when f₀ = 0.
    pub fn mean_relative(&self) -> f64 {
        self.mean_absolute() / self.scale()
    }

    /// The mean of f.
    pub fn mean(&self) -> f64 {
        self.start.to_f64() + self.sum / self.count as f64
    }

    /// |f₀|.
    fn scale(&self) -> f64 {
        Real::abs(self.start.to_f64())
    }
}

/// Fails to compile over packs of lanes: what an observer makes of one trajectory would be that of lane 0.
#[inline(always)]
pub(crate) fn one_trajectory<T: Real>() {
    const {
        assert!(
            T::LANES == 1,
            "this observer follows one trajectory, and a pack holds several: an `Ensemble` has an observer \
             for each of its members"
        );
    }
}

/// The drift of H, see [`Deviation`]; in another time, `dt = g*ds`, that of the declared H.
///
/// For a system that depends on time H is no invariant, and this is no error.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EnergyDrift<T = f64> {
    drift: Option<Deviation<T>>,
}

impl<T: Real> EnergyDrift<T> {
    /// An observer that has seen nothing.
    pub fn new() -> Self {
        EnergyDrift { drift: None }
    }

    /// The extremes seen; `None` before it is attached.
    pub fn drift(&self) -> Option<&Deviation<T>> {
        self.drift.as_ref()
    }

    /// max |ΔH/H₀|; NaN before it is attached and where H₀ = 0.
    pub fn max_relative(&self) -> f64 {
        self.drift
            .as_ref()
            .map_or(f64::NAN, Deviation::max_relative)
    }

    /// The mean of |ΔH/H₀|; NaN before it is attached and where H₀ = 0.
    pub fn mean_relative(&self) -> f64 {
        self.drift
            .as_ref()
            .map_or(f64::NAN, Deviation::mean_relative)
    }

    /// The mean of H; NaN before it is attached.
    pub fn mean(&self) -> f64 {
        self.drift.as_ref().map_or(f64::NAN, Deviation::mean)
    }
}

impl<T: Real, S: System<T>> Observer<T, S> for EnergyDrift<T> {
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        one_trajectory::<T>();
        self.drift = None;
        <Self as Observer<T, S>>::observe(self, view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        let energy = view.energy();
        self.drift
            .get_or_insert_with(|| Deviation::new(energy))
            .record(energy);
        ControlFlow::Continue(())
    }
    fn save(&self, to: &mut Memory) {
        to.begin("EnergyDrift");
        to.count(u64::from(self.drift.is_some()));
        if let Some(drift) = &self.drift {
            drift.save(to);
        }
    }
    fn follow(&mut self, with: &mut Follower<T>) -> bool {
        with.drift(Quantity::Energy, &mut self.drift);
        true
    }
    fn restore(&mut self, _: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("EnergyDrift")?;
        self.drift = match from.read_count()? {
            0 => None,
            _ => Some(Deviation::restored(from)?),
        };
        Ok(())
    }
}

/// The drift of every observable of the system: its monitors, invariants and events.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Monitors<T = f64> {
    monitors: Vec<Monitor<T>>,
}

/// One line of [`Monitors`].
#[derive(Debug, Clone, PartialEq)]
pub struct Monitor<T> {
    /// The declared name, with the component in brackets for vectors.
    pub name: &'static str,
    /// Its declaration.
    pub kind: ObservableKind,
    /// The extremes seen.
    pub drift: Deviation<T>,
}

impl<T: Real> Monitors<T> {
    /// An observer that has seen nothing.
    pub fn new() -> Self {
        Monitors {
            monitors: Vec::new(),
        }
    }

    /// All observables in declaration order; empty before it is attached.
    pub fn all(&self) -> &[Monitor<T>] {
        &self.monitors
    }

    /// The drift of the observable of that name.
    pub fn get(&self, name: &str) -> Option<&Deviation<T>> {
        self.monitors
            .iter()
            .find(|monitor| monitor.name == name)
            .map(|monitor| &monitor.drift)
    }
}

impl<T: Real, S: System<T>> Observer<T, S> for Monitors<T> {
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        one_trajectory::<T>();
        self.monitors = (0..)
            .zip(S::OBSERVABLES)
            .map(|(index, observable)| Monitor {
                name: observable.name,
                kind: observable.kind,
                drift: Deviation::new(view.observable(index)),
            })
            .collect();
        <Self as Observer<T, S>>::observe(self, view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        for (index, monitor) in self.monitors.iter_mut().enumerate() {
            monitor.drift.record(view.observable(index));
        }
        ControlFlow::Continue(())
    }
    fn save(&self, to: &mut Memory) {
        to.begin("Monitors");
        to.count(self.monitors.len() as u64);
        for monitor in &self.monitors {
            monitor.drift.save(to);
        }
    }
    fn follow(&mut self, with: &mut Follower<T>) -> bool {
        for (index, observable) in S::OBSERVABLES.iter().enumerate() {
            let mut drift = self.monitors.get(index).map(|one| one.drift.clone());
            with.drift(Quantity::Observable(index), &mut drift);
            let Some(drift) = drift else { continue };
            match self.monitors.get_mut(index) {
                Some(monitor) => monitor.drift = drift,
                None => self.monitors.push(Monitor {
                    name: observable.name,
                    kind: observable.kind,
                    drift,
                }),
            }
        }
        true
    }
    fn restore(&mut self, _: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("Monitors")?;
        let count = from.read_count()?;
        self.monitors = (S::OBSERVABLES.iter())
            .take(usize::try_from(count).unwrap_or(usize::MAX))
            .map(|observable| {
                Ok(Monitor {
                    name: observable.name,
                    kind: observable.kind,
                    drift: Deviation::restored(from)?,
                })
            })
            .collect::<Result<_, Error>>()?;
        Ok(())
    }
}
