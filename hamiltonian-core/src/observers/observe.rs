//! Observers of a run.
//!
//! Input: states of a run, as [`View`]s. Output: the results of an [`Observer`]:
//! [`EnergyDrift`], [`Monitors`], [`Recorder`](crate::observers::Recorder), a closure. Invariant: observers
//! change no bit of the run.

mod deviation;
mod drift;
mod follow;
mod quantity;
mod section;

pub use deviation::Deviation;
pub use drift::{EnergyDrift, Monitor, Monitors};

pub(crate) use follow::LaneDrift;
#[doc(hidden)]
pub use follow::{FollowVisitor, FollowedQuantities};
#[doc(hidden)]
pub use quantity::Quantity;
pub(crate) use section::{LaneSection, MemberSection};

use crate::errors::Error;
use crate::results::checkpoint::Memory;
use crate::systems::state::State;
use crate::systems::system::{Dynamics, System, VectorOf, declared_energy};
use crate::systems::vector::Vector;
use core::ops::ControlFlow;
use hamiltonian_lanes::Real;

/// A state of a run, as an observer receives it.
pub struct View<'a, T: Real, S: System> {
    /// The number of steps made.
    pub steps: u64,
    /// Time, coordinates and momenta, all at the same time; finite.
    pub state: &'a State<VectorOf<S, T>>,
    /// The prepared system: expressions that depend only on parameters are computed.
    pub prepared: &'a S::Prepared<T>,
    /// Computes states at other times.
    pub(crate) between: &'a dyn Between<VectorOf<S, T>>,
}

/// States at other times near the current one, computed by a part of a step.
pub(crate) trait Between<V: Vector> {
    /// Returns the state at the time `t`.
    fn state_at(&self, t: V::Scalar) -> Result<State<V>, Error>;
    /// Returns the state at `time` after `from`, a state of the run, before the next one.
    fn part(&self, from: &State<V>, time: V::Scalar) -> Result<State<V>, Error>;
    /// Returns a number of steps from the current state that are sure to end before the time `t`, or 1.
    fn steps_to(&self, t: V::Scalar) -> u64;
    /// Returns the time between two states one step apart. This is the interval itself, without the rounding errors of
    /// times, unless the scheme carries the time.
    fn between(&self, from: V::Scalar, to: V::Scalar) -> V::Scalar;
    /// Returns the duration of a step.
    fn interval(&self) -> V::Scalar;
    /// Returns the time at which the run began, or at which its step was changed.
    fn start(&self) -> V::Scalar;
}

impl<T: Real, S: System> View<'_, T, S> {
    /// The declared H at this state. If the definition changes time, `dt = g*ds`, g and the momentum of time are not
    /// part of it.
    pub fn energy(&self) -> T {
        declared_energy::<T, S>(self.prepared, self.state)
    }

    /// Returns the state at a time at most one step away, computed by a shorter step of the same scheme.
    ///
    /// # Errors
    /// [`TimeError::Far`](crate::errors::TimeError::Far) for a time further away, and errors of a step.
    pub fn state_at(&self, t: T) -> Result<State<VectorOf<S, T>>, Error> {
        self.between.state_at(t)
    }

    /// Observable `index` of [`Description::observables`](crate::schemes::author::Description::observables) at this state.
    pub fn observable(&self, index: usize) -> T {
        self.prepared
            .observable(index, self.state.t, &self.state.q, &self.state.p)
    }

    /// The observable of that name at this state; `None` if there is none.
    pub fn observable_named(&self, name: &str) -> Option<T> {
        let index = self.prepared.description().observable_index(name);
        index.map(|index| self.observable(index))
    }
}

/// Receives the states of a run, and may end it.
///
/// An observer receives the state at which it is attached. From then on it receives every state whose step number,
/// counted from the start of the run, is a multiple of its interval. This does not depend on the calls of `advance`
/// that make the steps. A tuple of observers is an observer, and so is `&mut O`.
/// [`Integrator::watch`](crate::Integrator::watch) attaches a closure.
pub trait Observer<T: Real, S: System> {
    /// Steps between observations, at least 1.
    fn interval(&self) -> u64 {
        1
    }
    /// Receives the state at which the observer is attached; `Break` ends the run.
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.observe(view)
    }
    /// Receives a state whose step number is a multiple of the interval; `Break` ends the run.
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()>;
    /// Receives a change of the run between two steps, by [`Integrator::set_state`] or [`Integrator::set_system`]: the
    /// run was at `from` and goes on from `to`, which has the same time. The provided method does nothing.
    ///
    /// [`Integrator::set_state`]: crate::Integrator::set_state
    /// [`Integrator::set_system`]: crate::Integrator::set_system
    fn change(&mut self, _from: &View<'_, T, S>, _to: &View<'_, T, S>) {}
    /// Lists the functions of the state that the observer follows, or accepts their drifts from the visitor. Returns
    /// true if the observer needs only drifts, at multiples of its interval, and changes of signs. Ensembles then
    /// follow them in lanes.
    #[doc(hidden)]
    fn follow(&mut self, _: &mut FollowVisitor<'_, T>) -> bool {
        false
    }
    /// Receives the state after a step in which a sign may have changed, if lanes follow signs for this observer.
    /// Before that it receives at least the two previous states with `signs_kept`, since no sign changed in their
    /// steps.
    #[doc(hidden)]
    fn pass(&mut self, _view: &View<'_, T, S>, _signs_kept: bool) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
    /// Writes the data of the observer to a saved run. An observer without data writes its name alone.
    fn save(&self, to: &mut Memory) {
        to.begin("");
    }
    /// Reads what [`save`](Observer::save) wrote. For a resumed run this replaces [`attach`](Observer::attach); the
    /// view is the current state of the run.
    ///
    /// # Errors
    /// [`CheckpointError::Other`](crate::errors::CheckpointError::Other) if another observer wrote it,
    /// [`CheckpointError::Damaged`](crate::errors::CheckpointError::Damaged).
    fn restore(&mut self, _view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("")
    }
    /// The state at which the observer ended the run, after a `Break`: a state between two steps, which becomes the
    /// state of the run, or `None` for the state that it received last.
    ///
    /// # Errors
    /// The error because of which the observer cannot continue; the run returns it.
    fn end(&self) -> Result<Option<&State<VectorOf<S, T>>>, Error> {
        Ok(None)
    }
}

/// Implemented for `()`, the observer of a run without one: `observe` can be called once.
#[diagnostic::on_unimplemented(
    message = "this run has an observer: `{Self}`",
    label = "a run takes one observer",
    note = "pass several as a tuple, `.observe((EnergyDrift::new(), Recorder::new()))`; for the members of an ensemble or a sweep `.observe(|_| (EnergyDrift::new(), Recorder::new()))`",
    note = "attach closures to a single run after it, `.watch(every, |view| …)`"
)]
pub trait Unobserved {}

impl Unobserved for () {}

/// The return value of a closure given to [`watch`]: `()`, or a [`ControlFlow`] that may end the run.
pub trait Verdict {
    /// Returns `Break` if the run ends.
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

/// Returns `Break` if either is.
fn first_break(a: ControlFlow<()>, b: ControlFlow<()>) -> ControlFlow<()> {
    match a {
        ControlFlow::Continue(()) => b,
        ControlFlow::Break(()) => a,
    }
}

/// Makes an observer from a closure, for example for a tuple of observers.
///
/// The closure needs the type of its argument, `&View<'_, f64, MySystem>`, which Rust does not infer here. In
/// [`Integrator::watch`](crate::Integrator::watch) it does.
///
/// ```
/// use hamiltonian::View;
#[doc = include_str!("../doc/oscillator.md")]
///
/// let rare = every(50, watch(|view: &View<'_, f64, Oscillator>| println!("{}", view.state.q[0])));
/// let often = watch(|view: &View<'_, f64, Oscillator>| println!("{}", view.energy()));
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), State::new([1.0], [0.0]), 0.01)?
///     .observe((rare, often));
/// run.advance(100)?;
/// # Ok::<(), Error>(())
/// ```
pub fn watch<T: Real, S: System, R: Verdict, F: FnMut(&View<'_, T, S>) -> R>(
    closure: F,
) -> Watch<F> {
    Watch(closure)
}

/// The observer that [`watch`] makes.
#[derive(Debug, Clone)]
pub struct Watch<F>(F);

impl<T: Real, S: System, R: Verdict, F: FnMut(&View<'_, T, S>) -> R> Observer<T, S> for Watch<F> {
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        (self.0)(view).control()
    }
}

/// Makes an observer that passes on the state at which it is attached and each state whose step number is a multiple of
/// `steps` (0 counts as 1).
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let mut drift = EnergyDrift::new();
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), State::new([1.0], [0.0]), 0.01)?
///     .observe((&mut drift, every(100, Recorder::new())));
/// run.advance(1_000)?;
/// assert_eq!(run.observer().1.inner().rows(), 11);
/// assert!(drift.max_relative() < 1e-4);
/// # Ok::<(), Error>(())
/// ```
pub fn every<O>(steps: u64, observer: O) -> Every<O> {
    Every {
        steps: steps.max(1),
        inner: observer,
    }
}

/// The observer that [`every`] makes.
#[derive(Debug, Clone)]
pub struct Every<O> {
    steps: u64,
    inner: O,
}

impl<O> Every<O> {
    /// The observer inside.
    pub fn inner(&self) -> &O {
        &self.inner
    }

    /// Returns the observer inside.
    pub fn into_inner(self) -> O {
        self.inner
    }
}

impl<T: Real, S: System, O: Observer<T, S>> Observer<T, S> for Every<O> {
    fn interval(&self) -> u64 {
        self.steps.saturating_mul(self.inner.interval().max(1))
    }
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.inner.attach(view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.inner.observe(view)
    }
    fn change(&mut self, from: &View<'_, T, S>, to: &View<'_, T, S>) {
        self.inner.change(from, to);
    }
    fn save(&self, to: &mut Memory) {
        self.inner.save(to);
    }
    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        self.inner.restore(view, from)
    }
    fn end(&self) -> Result<Option<&State<VectorOf<S, T>>>, Error> {
        self.inner.end()
    }
    fn follow(&mut self, visitor: &mut FollowVisitor<'_, T>) -> bool {
        // Signs are compared after every step.
        self.inner.follow(visitor) && (self.steps == 1 || !visitor.has_sections())
    }
    fn pass(&mut self, view: &View<'_, T, S>, signs_kept: bool) -> ControlFlow<()> {
        self.inner.pass(view, signs_kept)
    }
}

impl<T: Real, S: System, O: Observer<T, S> + ?Sized> Observer<T, S> for &mut O {
    fn interval(&self) -> u64 {
        (**self).interval()
    }
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        (**self).attach(view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        (**self).observe(view)
    }
    fn change(&mut self, from: &View<'_, T, S>, to: &View<'_, T, S>) {
        (**self).change(from, to);
    }
    fn save(&self, to: &mut Memory) {
        (**self).save(to);
    }
    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        (**self).restore(view, from)
    }
    fn end(&self) -> Result<Option<&State<VectorOf<S, T>>>, Error> {
        (**self).end()
    }
    fn follow(&mut self, visitor: &mut FollowVisitor<'_, T>) -> bool {
        (**self).follow(visitor)
    }
    fn pass(&mut self, view: &View<'_, T, S>, signs_kept: bool) -> ControlFlow<()> {
        (**self).pass(view, signs_kept)
    }
}

impl<T: Real, S: System> Observer<T, S> for () {
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
    fn follow(&mut self, _: &mut FollowVisitor<'_, T>) -> bool {
        true
    }
}

/// Returns the interval that reaches both observers of a tuple: the greatest common divisor. `u64::MAX`, the interval
/// of `()`, is ignored.
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
        impl<T: Real, S: System, $($observer: Observer<T, S>),+> Observer<T, S>
            for ($($observer,)+)
        {
            fn interval(&self) -> u64 {
                let mut interval = u64::MAX;
                $(interval = common(interval, self.$index.interval());)+
                interval
            }
            fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
                let mut control = ControlFlow::Continue(());
                $(control = first_break(control, self.$index.attach(view));)+
                control
            }
            fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
                let mut control = ControlFlow::Continue(());
                $(if view.steps % self.$index.interval().max(1) == 0 {
                    control = first_break(control, self.$index.observe(view));
                })+
                control
            }
            fn change(&mut self, from: &View<'_, T, S>, to: &View<'_, T, S>) {
                $(self.$index.change(from, to);)+
            }
            fn save(&self, to: &mut Memory) {
                $(self.$index.save(to);)+
            }
            fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
                $(self.$index.restore(view, from)?;)+
                Ok(())
            }
            fn end(&self) -> Result<Option<&State<VectorOf<S, T>>>, Error> {
                let mut end = None;
                $(end = end.or(self.$index.end()?);)+
                Ok(end)
            }
            fn follow(&mut self, visitor: &mut FollowVisitor<'_, T>) -> bool {
                let interval = <Self as Observer<T, S>>::interval(self);
                let same = |of: u64| of == interval || of == u64::MAX;
                $(if !same(self.$index.interval()) || !self.$index.follow(visitor) {
                    return false;
                })+
                true
            }
            fn pass(&mut self, view: &View<'_, T, S>, signs_kept: bool) -> ControlFlow<()> {
                let mut control = ControlFlow::Continue(());
                $(control = first_break(control, self.$index.pass(view, signs_kept));)+
                control
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

/// Fails to compile over packs of lanes, of which an observer would only evaluate lane 0.
///
/// This compiles:
/// ```
/// # use hamiltonian::{lanes::{Pack, W}, prelude::*};
#[doc = include_str!("../doc/oscillator.md")]
/// type Four = W<f64, 4>;
/// let [one, zero, h] = [1.0, 0.0, 0.1].map(|x| Four::load(&[x; 4], x));
/// let start = State::over([one], [zero]);
/// let run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, h)?;
/// # let mut run = run;
/// run.advance(1)?;
/// # Ok::<(), Error>(())
/// ```
/// With each of these observers it does not:
/// ```compile_fail
/// # use hamiltonian::{lanes::{Pack, W}, prelude::*};
#[doc = include_str!("../doc/oscillator.md")]
/// type Four = W<f64, 4>;
/// let [one, zero, h] = [1.0, 0.0, 0.1].map(|x| Four::load(&[x; 4], x));
/// let start = State::over([one], [zero]);
/// let run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, h)?;
/// let mut run = run.observe(Events::new([Event::of("q", |state: &State<_>| state.q[0])]));
/// run.advance(1)?;
/// # Ok::<(), Error>(())
/// ```
/// ```compile_fail
/// # use hamiltonian::{lanes::{Pack, W}, prelude::*};
#[doc = include_str!("../doc/oscillator.md")]
/// type Four = W<f64, 4>;
/// let [one, zero, h] = [1.0, 0.0, 0.1].map(|x| Four::load(&[x; 4], x));
/// let start = State::over([one], [zero]);
/// let run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, h)?;
/// let mut run = run.observe(Recorder::new());
/// run.advance(1)?;
/// # Ok::<(), Error>(())
/// ```
/// ```compile_fail
/// # use hamiltonian::{lanes::{Pack, W}, prelude::*};
#[doc = include_str!("../doc/oscillator.md")]
/// type Four = W<f64, 4>;
/// let [one, zero, h] = [1.0, 0.0, 0.1].map(|x| Four::load(&[x; 4], x));
/// let start = State::over([one], [zero]);
/// let run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, h)?;
/// let mut run = run.observe(EnergyDrift::new());
/// run.advance(1)?;
/// # Ok::<(), Error>(())
/// ```
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn one_trajectory<T: Real>() {
    const {
        assert!(
            T::LANES == 1,
            "this observer follows one trajectory, and a pack holds several: an `Ensemble` has an observer \
             for each of its members"
        );
    }
}
