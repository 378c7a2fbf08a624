//! Events: roots of functions of the state, located by the run.
//!
//! Input: the states of a run, step by step, and [`Event`]s: declared ones by name, others as closures.
//! Output: [`Located`] states in the order of the run, and the end of the run if an event ends it.
//! Invariants: the bits of the run do not change. An event is a change of sign of the function, so a start on a root is
//! no event, and neither is a function that touches 0. Each root is an event of one step only.

mod event;
mod locate;

pub use event::Event;

use crate::errors::{Error, Known, ObservableError};
use crate::observers::observe::{FollowVisitor, MemberSection, Observer, View, one_trajectory};
use crate::observers::root::{Sample, side};
use crate::results::checkpoint::Memory;
use crate::systems::state::State;
use crate::systems::system::{Dynamics, Observable, System, VectorOf};
use crate::systems::vector::{Shape, Vector};
use alloc::boxed::Box;
use alloc::collections::VecDeque;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cell::OnceCell;
use core::ops::ControlFlow;
use hamiltonian_lanes::{Mask, Real};
use locate::StepFunction;

/// A state at which an event occurred.
#[derive(Debug, Clone, PartialEq)]
pub struct Located<V: Vector> {
    /// The index of the event in the list given to [`Events::new`].
    pub event: usize,
    /// True if the function increases there, in the direction of the run.
    pub rising: bool,
    /// The state: the function is 0 to rounding.
    pub state: State<V>,
}

/// Locates events of a run: an [`Observer`].
///
/// If a function has different signs before and after a step, `Events` locates its root by shorter steps of the same
/// scheme on a copy, so the error of the state has the order of the scheme. To rounding, the function is 0 there, and
/// the state is the one that [`advance_until`](crate::Integrator::advance_until) returns for the time of the event.
/// The run itself does not change. A scheme that carries a second point begins a shorter step with a new second point.
/// The states of shorter steps are then corrected so that the whole step ends at the state of the run.
///
/// Two roots within one step are found if the values after three consecutive steps indicate them: the function has
/// approached 0 by more than half its value in the previous step, and by less than half as much in this step. More
/// roots within one step are missed; shorter steps find them. Several events in one step are in the order of time.
///
/// If the function is exactly 0 after a step, it is evaluated between the steps before and after it, so roots between
/// zeros on steps are found. Such a root is an event if the sign changes there; this is known after the next step, so a
/// root at the last state of a run is not located yet. A change of sign at a pole or a jump is no event, also if the
/// function has the value 0 at the jump: it must tend to 0 from both sides. The function `sign(x)` has no events;
/// use `x`.
///
/// An event [with an end](Event::with_end_after) ends the run, and the state of the run is then the one at the
/// event. After [`go_on`](crate::Integrator::go_on) the run continues from the end of its last step.
///
/// A Poincaré section is an event [with a direction](Event::with_direction). Hénon's trick (M. Hénon, Physica D 5 (1982)
/// 412, doi:10.1016/0167-2789(82)90034-3) makes the function the independent variable for one step. It is not
/// needed here: shorter steps have the same order, and the function is 0 to rounding.
///
/// Over [`Dual`](crate::Dual)s, derivative parts are those at the fixed time of the event.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Composition;
///
/// let events = Events::new([
///     Event::of("q = 0", |state: &StateOf<Oscillator>| state.q[0]),
///     Event::of("p = 0", |state: &StateOf<Oscillator>| state.p[0]).with_direction(1).with_end_after(2),
/// ]);
/// let scheme = Composition::yoshida(StormerVerlet::default());
/// let mut run = Integrator::new(&Oscillator {}, scheme, State::new([1.0], [0.0]), 0.01)?.observe(events);
/// run.advance(10_000)?;
/// // p = −sin t rises at π, 3π, …; until then q is 0 at π/2, 3π/2, 5π/2.
/// assert!(run.has_ended());
/// assert!((run.time() - 3.0 * std::f64::consts::PI).abs() < 1e-7);
/// assert_eq!((run.observer().count("q = 0"), run.observer().count("p = 0")), (3, 2));
/// assert!(run.observer().states("q = 0").all(|state| state.q[0].abs() < 1e-15));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// The run returns [`ObservableError::Event`] for a name that the system does not declare, for a period that is not
/// positive, and inside [`every`](crate::observers::every), since `Events` needs the state after every step. It also
/// returns the errors of the shorter steps. Over packs of lanes it does not compile, since each lane has events of
/// its own.
#[derive(Debug, Clone)]
pub struct Events<V: Vector> {
    events: Vec<Event<V>>,
    /// The history of each event's function; empty before the observer is attached.
    histories: Vec<History<V::Scalar>>,
    /// The last step and the state after it.
    before: Option<(u64, State<V>)>,
    located: Vec<Located<V>>,
    /// Located events of the last step that are not yet recorded: those after the event that ended the run.
    pending: VecDeque<Located<V>>,
    end: Option<State<V>>,
    failure: Option<Error>,
}

/// The values of a function after the last two steps, and its last sign that is not 0.
#[derive(Debug, Clone, Copy, PartialEq)]
struct History<T> {
    /// The index of an observable; `None` for a closure.
    observable: Option<usize>,
    /// The value after the last step.
    value: T,
    /// The change in the last step; 0 if it is unknown.
    change: T,
    /// The last sign that is not 0; 0 if there is none.
    side: i8,
    /// The number of events so far.
    count: u64,
}

impl<T: Real> History<T> {
    /// Accepts the value after the next step.
    fn advance<V: Vector<Scalar = T>>(&mut self, event: &Event<V>, value: T) {
        let unwrapped = event.unwrapped(self.value, value);
        self.change = unwrapped - self.value;
        self.value = event.difference(value);
        match side(self.value) {
            0 if value.is_finite() => {}
            side => self.side = side,
        }
    }
}

/// Returns the reason and remedy for an event whose name is unknown, with the names that are known.
fn unknown(name: &str, known: &[Observable]) -> String {
    let known: Vec<&str> = known.iter().map(|one| &*one.name).collect();
    let text = "the system declares none of this name";
    match known.is_empty() {
        true => format!("{text}\nhelp: declare it, `event {name} = …`"),
        false => format!("{text}{}", Known("it declares", &known)),
    }
}

impl<V: Vector> Events<V> {
    /// Creates an observer of these events.
    pub fn new(events: impl IntoIterator<Item = Event<V>>) -> Self {
        Events {
            events: events.into_iter().collect(),
            histories: Vec::new(),
            before: None,
            located: Vec::new(),
            pending: VecDeque::new(),
            end: None,
            failure: None,
        }
    }

    /// All located events, in the order of the run.
    pub fn located(&self) -> &[Located<V>] {
        &self.located
    }

    /// The states at the events of that name, in the order of the run; none if no event has this name.
    pub fn states(&self, name: &str) -> impl Iterator<Item = &State<V>> {
        let of_name = move |located: &&Located<V>| self.events[located.event].name == name;
        (self.located.iter().filter(of_name)).map(|located| &located.state)
    }

    /// The number of located events of that name.
    pub fn count(&self, name: &str) -> u64 {
        let events = self.events.iter().zip(&self.histories);
        let of_name = events.filter(|(event, _)| event.name == name);
        of_name.map(|(_, history)| history.count).sum()
    }

    /// Returns the value of an event's function at a state.
    fn value<S: System<Shape: Shape<Vector<V::Scalar> = V>>>(
        event: &Event<V>,
        observable: Option<usize>,
        prepared: &S::Prepared<V::Scalar>,
        state: &State<V>,
    ) -> V::Scalar {
        match (&event.function, observable) {
            (Some(function), _) => function(state),
            (None, Some(index)) => prepared.observable(index, state.t, &state.q, &state.p),
            (None, None) => V::Scalar::zero(),
        }
    }

    /// Evaluates the functions at the first state.
    fn begin<S: System<Shape: Shape<Vector<V::Scalar> = V>>>(
        &mut self,
        view: &View<'_, V::Scalar, S>,
    ) -> Result<(), Error> {
        // A step back gives the previous values. At a boundary of the domain it may fail.
        let back = V::Scalar::zero() - view.between.interval();
        let before = view.between.part(view.state, back).ok();
        let system = view.prepared.description();
        self.histories.clear();
        for (number, event) in self.events.iter().enumerate() {
            let observable = system.observable_index(&event.name);
            if event.function.is_none() && observable.is_none() {
                return Err(self.error(number, unknown(&event.name, &system.observables)));
            }
            if event
                .period
                .is_some_and(|period| side(period) <= 0 || !period.is_finite())
            {
                return Err(self.error(number, "its period is not positive and finite"));
            }
            let at = |state| Self::value::<S>(event, observable, view.prepared, state);
            let value = event.difference(at(view.state));
            let before = before
                .as_ref()
                .map(|before| event.difference(value - at(before)));
            self.histories.push(History {
                observable,
                value,
                change: (before.filter(|change| change.is_finite())).unwrap_or(V::Scalar::zero()),
                side: side(value),
                count: 0,
            });
        }
        Ok(())
    }

    fn error(&self, event: usize, reason: impl Into<Box<str>>) -> Error {
        let name = self.events.get(event).map(|event| event.name.clone());
        ObservableError::Event {
            name: name.unwrap_or_default().into(),
            reason: reason.into(),
        }
        .into()
    }

    /// Locates the events of a step from `before` to the current state, in the order of time.
    fn step<S: System<Shape: Shape<Vector<V::Scalar> = V>>>(
        &mut self,
        view: &View<'_, V::Scalar, S>,
        before: &State<V>,
    ) -> Result<(), Error> {
        let time = view.between.between(before.t, view.state.t);
        let (zero, one) = (V::Scalar::zero(), V::Scalar::one());
        // A part of a step begins from a state, without further values that a scheme carries. Therefore the part that
        // is a whole step may not end at the current state; for schemes that carry only the state, the difference is
        // due to rounding. It is added in proportion to the time, so that a whole step ends at the current state.
        let missed = OnceCell::new();
        let part = |theta: V::Scalar| -> Result<State<V>, Error> {
            let mut state = view.between.part(before, theta * time)?;
            if missed.get().is_none() {
                let whole = view.between.part(before, time)?;
                let _ = missed.set(whole);
            }
            let whole = missed.get().unwrap_or(view.state);
            correct(&mut state.q, theta, &view.state.q, &whole.q);
            correct(&mut state.p, theta, &view.state.p, &whole.p);
            Ok(state)
        };
        let mut found: Vec<(V::Scalar, Located<V>)> = Vec::new();
        for (number, (event, history)) in self.events.iter().zip(&mut self.histories).enumerate() {
            let at = |state: &State<V>| {
                Self::value::<S>(event, history.observable, view.prepared, state)
            };
            // Angles are unwrapped from the previous value, so that they do not jump.
            let from = history.value;
            let here = at(view.state);
            let end = event.unwrapped(from, here);
            let mut in_step = StepFunction {
                function: |theta| Ok(event.unwrapped(from, at(&part(theta)?))),
                rounding: |theta| {
                    let state = part(theta)?;
                    let change = |moved: &State<V>| event.difference(at(moved) - at(&state));
                    Ok(rounding(&state, change))
                },
                ends: [(zero, from), (one, end)].map(|(at, value)| Sample { at, value }),
                was: history.side,
                change: history.change,
                slope: event.direction.signum(),
            };
            let (roots, side) = in_step.roots()?;
            for root in roots {
                let located = Located {
                    event: number,
                    rising: root.rising,
                    state: part(root.at)?,
                };
                found.push((root.at, located));
            }
            history.advance(event, here);
            if let Some(side) = side {
                history.side = side;
            }
        }
        // The sort is stable: simultaneous events are in the order of the list of events.
        found.sort_by(|a, b| a.0.to_f64().total_cmp(&b.0.to_f64()));
        self.pending
            .extend(found.into_iter().map(|(_, located)| located));
        Ok(())
    }

    /// Records located events, up to an event that ends the run.
    fn record(&mut self) -> ControlFlow<()> {
        while let Some(located) = self.pending.pop_front() {
            let number = located.event;
            self.histories[number].count += 1;
            let ends = self.events[number].ends_after == Some(self.histories[number].count);
            self.end = ends.then(|| located.state.clone());
            self.located.push(located);
            if ends {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    fn fail(&mut self, error: Error) -> ControlFlow<()> {
        self.failure = Some(error);
        ControlFlow::Break(())
    }

    /// Accepts the state after a step without events.
    fn skip<S: System<Shape: Shape<Vector<V::Scalar> = V>>>(
        &mut self,
        view: &View<'_, V::Scalar, S>,
    ) {
        for (event, history) in self.events.iter().zip(&mut self.histories) {
            let value = Self::value::<S>(event, history.observable, view.prepared, view.state);
            history.advance(event, value);
        }
        match &mut self.before {
            Some((step, state)) => {
                *step = view.steps;
                state.clone_from(view.state);
            }
            none => *none = Some((view.steps, view.state.clone())),
        }
    }
}

/// The largest change of a function where the state is changed in its last digits.
fn rounding<V: Vector>(state: &State<V>, change: impl Fn(&State<V>) -> V::Scalar) -> f64 {
    /// Units in the last place.
    const ULPS: f64 = 64.0;
    /// 2⁶⁴ divided by the golden ratio: the signs of the changes are bits of its multiples.
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let mut multiple = 0_u64;
    let mut moved = state.clone();
    (0..8).fold(0.0, |largest: f64, _| {
        let mut factor = || {
            multiple = multiple.wrapping_add(GOLDEN);
            let by = ULPS * V::Scalar::epsilon();
            V::Scalar::constant(1.0, if multiple >> 63 == 0 { by } else { -by })
        };
        moved.t = factor() * state.t;
        for (to, from) in [(&mut moved.q, &state.q), (&mut moved.p, &state.p)] {
            for index in 0..to.len() {
                *to.component_mut(index) = factor() * from.component(index);
            }
        }
        largest.max(change(&moved).magnitude())
    })
}

/// Adds the fraction `part` of the difference between an end and the point reached.
fn correct<V: Vector>(to: &mut V, part: V::Scalar, end: &V, reached: &V) {
    for index in 0..to.len() {
        let missed = end.component(index) - reached.component(index);
        let component = to.component_mut(index);
        *component = part.fma(missed, *component);
    }
}

impl<T: Real, S: System> Observer<T, S> for Events<VectorOf<S, T>> {
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        one_trajectory::<T>();
        self.before = Some((view.steps, view.state.clone()));
        match self.begin(view) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => self.fail(error),
        }
    }

    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        let Some((step, mut before)) = self.before.take() else {
            return <Self as Observer<T, S>>::attach(self, view);
        };
        // A run that ended between two steps may have been restarted at that state, with another step.
        let is_there = |end: &State<VectorOf<S, T>>| end.t.equals(view.between.start()).all();
        if let Some(end) = self.end.take().filter(is_there) {
            // Roots of other events at this state are yet to come; later ones are located again.
            self.pending
                .retain(|located| located.state.t.equals(end.t).all());
            for (number, (event, history)) in
                self.events.iter().zip(&mut self.histories).enumerate()
            {
                let mut roots = self.located.last().into_iter().chain(&self.pending);
                let value = Self::value::<S>(event, history.observable, view.prepared, &end);
                (history.value, history.change) = (event.difference(value), T::zero());
                history.side = side(history.value);
                if let Some(root) = roots.find(|located| located.event == number) {
                    history.value = T::zero();
                    history.side = if root.rising { 1 } else { -1 };
                }
            }
            before = end;
        }
        let made = match view.steps == step + 1 {
            true => self.step(view, &before),
            false => Err(self.error(0, "its observer does not receive every step")),
        };
        before.clone_from(view.state);
        self.before = Some((view.steps, before));
        match made {
            Ok(()) => self.record(),
            Err(error) => self.fail(error),
        }
    }

    fn change(&mut self, _: &View<'_, T, S>, to: &View<'_, T, S>) {
        if self.failure.is_some() {
            return;
        }
        let counts: Vec<_> = self.histories.iter().map(|history| history.count).collect();
        match self.begin(to) {
            Ok(()) => {
                for (history, count) in self.histories.iter_mut().zip(counts) {
                    history.count = count;
                }
            }
            Err(error) => self.failure = Some(error),
        }
        self.before = Some((to.steps, to.state.clone()));
        self.end = None;
        self.pending.clear();
    }

    fn follow(&mut self, visitor: &mut FollowVisitor<'_, T>) -> bool {
        // Lanes do not evaluate closures. The previous values at the first state are found by a step back, when the
        // observer is attached.
        let is_named = self.events.iter().all(|event| event.function.is_none());
        if !is_named || self.failure.is_some() || self.histories.len() != self.events.len() {
            return false;
        }
        for (event, history) in self.events.iter().zip(&self.histories) {
            let Some(observable) = history.observable else {
                return false;
            };
            visitor.section(MemberSection {
                observable,
                period: event.period,
                value: history.value,
                change: history.change,
                ends: event.ends_after.is_some(),
            });
        }
        true
    }

    fn pass(&mut self, view: &View<'_, T, S>, signs_kept: bool) -> ControlFlow<()> {
        if signs_kept {
            self.skip(view);
            return ControlFlow::Continue(());
        }
        <Self as Observer<T, S>>::observe(self, view)
    }

    fn save(&self, to: &mut Memory) {
        to.begin("Events");
        to.count(self.histories.len() as u64);
        for (event, history) in self.events.iter().zip(&self.histories) {
            to.text(&event.text());
            to.scalar(history.value);
            to.scalar(history.change);
            to.number(f64::from(history.side));
            to.count(history.count);
        }
        let before = self.before.as_ref();
        to.count(before.map_or(0, |(step, _)| *step));
        to.option(before.map(|(_, state)| state));
        to.option(self.end.as_ref());
        for list in [self.located.len(), self.pending.len()] {
            to.count(list as u64);
        }
        for located in self.located.iter().chain(&self.pending) {
            to.count(located.event as u64);
            to.count(u64::from(located.rising));
            to.state(&located.state);
        }
    }

    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("Events")?;
        self.begin(view)?;
        from.expect_count("number of events", self.histories.len())?;
        for (event, history) in self.events.iter().zip(&mut self.histories) {
            from.expect_text("event", &event.text())?;
            history.value = from.read_scalar()?;
            history.change = from.read_scalar()?;
            history.side = from.read_number()? as i8;
            history.count = from.read_count()?;
        }
        let step = from.read_count()?;
        self.before = from.read_option(view.state)?.map(|state| (step, state));
        self.end = from.read_option(view.state)?;
        let lists = [from.read_count()?, from.read_count()?];
        let mut read = |count: u64| {
            let one = |_| {
                Ok(Located {
                    event: from.read_index(self.events.len())?,
                    rising: from.read_count()? != 0,
                    state: from.read_state(view.state)?,
                })
            };
            (0..count).map(one).collect::<Result<Vec<_>, Error>>()
        };
        self.located = read(lists[0])?;
        self.pending = read(lists[1])?.into();
        Ok(())
    }

    fn end(&self) -> Result<Option<&State<VectorOf<S, T>>>, Error> {
        match &self.failure {
            Some(error) => Err(error.clone()),
            None => Ok(self.end.as_ref()),
        }
    }
}
