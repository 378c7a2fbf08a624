//! A run whose scheme has a name.
//!
//! Input: a system, the name of a scheme or a tolerance, a start. Output: [`Run`]. Invariant: it is core's `Integrator`, so its
//! bits are those of a run whose scheme is a type.

use crate::error::RunError;
use crate::prepared::Flat;
use crate::schemes::any;
use crate::system::RuntimeSystem;
use crate::watching::{Hook, Watching};
use hamiltonian_core::observers::{Event, Events};
use hamiltonian_core::schemes::author::{Carried, Entry, Map, MapOf, Needs, ObservableKind};
use hamiltonian_core::schemes::{Adaptive, Estimates, Gauss, GaussNystrom, Tolerance};
use hamiltonian_core::{Checkpoint, Error, Integrator, Scheme, State, System};
use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

/// The state of a system that is defined at run time.
pub type FlatState = State<Flat<f64>>;

/// A crossing of an event.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Crossing<'a> {
    /// The name of the event.
    pub event: &'a str,
    /// True if the function of the event increases there, in the direction of the run.
    pub rising: bool,
    /// The state: the function is 0 to rounding.
    pub state: &'a FlatState,
}

/// One trajectory of a system that is defined at run time, by a scheme that is named by a text.
///
/// The state is flat: [`RuntimeSystem`] says in which order. The run locates the events that the definition declares.
///
/// ```
/// use hamiltonian::State;
/// use hamiltonian_runtime::{Definition, Run};
///
/// let text = "struct Pendulum { l = 1.0, g = 9.81 }
///     H(theta; p) = p^2/(2*l^2) - g*l*cos(theta);
///     event bottom = theta";
/// let pendulum = Definition::parse(text, "pendulum.txt")?.system([("l", 2.0)])?;
/// let start = State::new(vec![0.5], vec![0.0]);
///
/// let mut run = Run::new(&pendulum, "GaussNystrom4", start, 0.1)?;
/// run.advance_to(10.0)?;
/// assert_eq!(run.steps(), 100);
/// assert_eq!(run.crossings().count(), 7);
/// for crossing in run.crossings() {
///     println!("{} at t = {}", crossing.event, crossing.state.t);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Run {
    steps: Box<dyn Steps>,
    origin: Origin,
    hook: Arc<Hook>,
    /// The names of the events, in the order of the observer.
    events: Vec<String>,
}

/// What a run takes its scheme from.
#[derive(Debug, Clone, PartialEq)]
enum Origin {
    Scheme(String),
    Tolerance(Tolerance),
}

/// The names of the events that a system declares.
fn events(system: &RuntimeSystem) -> Vec<String> {
    let observables = system.description().observables.iter();
    let events = observables.filter(|one| one.kind == ObservableKind::Event);
    events.map(|event| event.name.to_string()).collect()
}

impl Run {
    /// Creates a run of the scheme of this name from `start` with the step size `step`, which is negative to integrate
    /// backwards. [`schemes`](crate::schemes) lists the names.
    ///
    /// # Errors
    /// [`RunError::UnknownScheme`]; those of [`Integrator::new`], among them
    /// [`StartError::Structure`](hamiltonian_core::errors::StartError::Structure) for a scheme that requires a structure
    /// that H does not have, with the text of the compile error.
    ///
    /// ```
    /// use hamiltonian::State;
    /// use hamiltonian_runtime::{Definition, Run, Values};
    ///
    /// let coupled = Definition::parse("H(q; p) = (q^2 + 1)*(p^2 + 1)/2", "coupled.txt")?.system(Values::new())?;
    /// let refused = |scheme| Run::new(&coupled, scheme, State::new(vec![1.0], vec![0.0]), 0.1).unwrap_err().to_string();
    /// assert!(refused("StormerVerlet").starts_with("H is not separable: the term `0.5*q^2*p^2` couples q and p"));
    /// assert_eq!(refused("StormerVerlt"), "there is no scheme `StormerVerlt`: the nearest name is `StormerVerlet`");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        system: &RuntimeSystem,
        scheme: &str,
        start: FlatState,
        step: f64,
    ) -> Result<Run, RunError> {
        let begin = BeginRun {
            system,
            from: Basis::Start(start, step),
            hook: Arc::default(),
        };
        Run::of(begin, Origin::Scheme(scheme.to_owned()))
    }

    /// Creates a run with steps from a tolerance, as [`Integrator::to_tolerance`] does: by `GaussNystrom8` if T is
    /// quadratic and there is no force, by `Gauss8` otherwise. A number is a relative tolerance.
    ///
    /// # Errors
    /// Those of [`Integrator::to_tolerance`].
    ///
    /// ```
    /// use hamiltonian::State;
    /// use hamiltonian_runtime::{Definition, Run, Values};
    ///
    /// let spring = Definition::parse("H(q; p) = p^2/2 + q^2/2", "spring.txt")?.system(Values::new())?;
    /// let mut run = Run::to_tolerance(&spring, State::new(vec![1.0], vec![0.0]), 1e-10)?;
    /// assert!((run.advance_until(20.0)?.q[0] - 20.0_f64.cos()).abs() < 1e-9);
    /// assert!(run.steps() < 30);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_tolerance(
        system: &RuntimeSystem,
        start: FlatState,
        tolerance: impl Into<Tolerance>,
    ) -> Result<Run, RunError> {
        let begin = BeginRun {
            system,
            from: Basis::Tolerated(start),
            hook: Arc::default(),
        };
        Run::of(begin, Origin::Tolerance(tolerance.into()))
    }

    /// Returns the run as bytes, for [`resume`](Run::resume): core's [`Checkpoint`] after a line with the scheme.
    #[must_use]
    pub fn save(&self) -> Vec<u8> {
        let mut bytes = match &self.origin {
            Origin::Scheme(name) => format!("scheme {name}\n"),
            Origin::Tolerance(Tolerance { relative, absolute }) => {
                format!("tolerance {relative:e} {absolute:e}\n")
            }
        }
        .into_bytes();
        bytes.extend(self.steps.checkpoint().to_bytes());
        bytes
    }

    /// Resumes a saved run of the same system with the same bits.
    ///
    /// # Errors
    /// [`RunError::NotSaved`], and those of [`Integrator::resume`].
    ///
    /// ```
    /// use hamiltonian::State;
    /// use hamiltonian_runtime::{Definition, Run, Values};
    ///
    /// let spring = Definition::parse("H(q; p) = p^2/2 + q^2/2", "spring.txt")?.system(Values::new())?;
    /// let mut run = Run::new(&spring, "BlanesMoan4", State::new(vec![1.0], vec![0.0]), 0.1)?;
    /// run.advance(10)?;
    /// let mut again = Run::resume(&spring, &run.save())?;
    /// run.advance(10)?;
    /// again.advance(10)?;
    /// assert_eq!(run.state(), again.state());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn resume(system: &RuntimeSystem, bytes: &[u8]) -> Result<Run, RunError> {
        let end = bytes.iter().position(|byte| *byte == b'\n');
        let end = end.ok_or(RunError::NotSaved)?;
        let line = std::str::from_utf8(&bytes[..end]).map_err(|_| RunError::NotSaved)?;
        let origin = Origin::read(line).ok_or(RunError::NotSaved)?;
        let checkpoint = Checkpoint::from_bytes(&bytes[end + 1..])?;
        let begin = BeginRun {
            system,
            from: Basis::Saved(checkpoint),
            hook: Arc::default(),
        };
        Run::of(begin, origin)
    }

    fn of(begin: BeginRun<'_>, origin: Origin) -> Result<Run, RunError> {
        let (hook, events) = (begin.hook.clone(), events(begin.system));
        let steps = match &origin {
            Origin::Scheme(name) => begin.begin(any(name)?)?,
            Origin::Tolerance(tolerance) => begin.tolerated(*tolerance)?,
        };
        Ok(Run {
            steps,
            origin,
            hook,
            events,
        })
    }

    /// Asks `cancel` every few steps, at most 1024, whether to stop: a call that advances the run then returns
    /// [`RunError::Interrupted`], and the run stands at the state after the last step.
    #[must_use]
    pub fn with_cancel(self, cancel: impl Fn() -> bool + Send + Sync + 'static) -> Run {
        self.hook.set(cancel);
        self
    }

    /// Makes `steps` steps.
    ///
    /// # Errors
    /// [`RunError::Interrupted`] and those of [`Integrator::advance`].
    pub fn advance(&mut self, steps: u64) -> Result<(), RunError> {
        let made = self.steps.advance(steps);
        self.checked(made)
    }

    /// Advances the run to the time `t`, which is a whole number of steps from the current time.
    ///
    /// # Errors
    /// [`RunError::Interrupted`] and those of [`Integrator::advance_to`].
    pub fn advance_to(&mut self, t: f64) -> Result<(), RunError> {
        let made = self.steps.advance_to(t);
        self.checked(made)
    }

    /// Advances the run by the whole steps up to `t`, any later time, and returns the state at `t`.
    ///
    /// # Errors
    /// [`RunError::Interrupted`] and those of [`Integrator::advance_until`].
    pub fn advance_until(&mut self, t: f64) -> Result<FlatState, RunError> {
        let made = self.steps.advance_until(t);
        self.checked(made)
    }

    /// Advances the run and returns its states at the times, which are in the order of the run; after an error, those
    /// before it.
    ///
    /// # Errors
    /// In the second place, those of [`advance_until`](Run::advance_until).
    pub fn states_at(&mut self, times: &[f64]) -> (Vec<FlatState>, Result<(), RunError>) {
        let mut states = Vec::with_capacity(times.len());
        for t in times {
            match self.advance_until(*t) {
                Ok(state) => states.push(state),
                Err(error) => return (states, Err(error)),
            }
        }
        (states, Ok(()))
    }

    /// Turns an end by the cancel hook into an error, from which the run goes on.
    fn checked<A>(&mut self, made: Result<A, Error>) -> Result<A, RunError> {
        let made = made?;
        if self.hook.take() {
            self.steps.go_on();
            return Err(RunError::Interrupted);
        }
        Ok(made)
    }

    /// Returns the state at a time at most one step before or after the current one. The run does not change.
    ///
    /// # Errors
    /// Those of [`Integrator::state_at`].
    pub fn state_at(&self, t: f64) -> Result<FlatState, RunError> {
        Ok(self.steps.state_at(t)?)
    }

    /// The current state.
    #[must_use]
    pub fn state(&self) -> &FlatState {
        self.steps.state()
    }

    /// The coordinates.
    #[must_use]
    pub fn q(&self) -> &[f64] {
        self.state().q.as_slice()
    }

    /// The momenta.
    #[must_use]
    pub fn p(&self) -> &[f64] {
        self.state().p.as_slice()
    }

    /// The time.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.state().t
    }

    /// The number of steps made.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps.steps()
    }

    /// The step size; with a tolerance, the first one.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.steps.step()
    }

    /// How often a size of a step was refused in a run with a tolerance; otherwise 0.
    #[must_use]
    pub fn refused_steps(&self) -> u64 {
        self.steps.refused_steps()
    }

    /// H at the current state.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.steps.energy()
    }

    /// The monitor, invariant or event of this name at the current state; `None` if there is none.
    #[must_use]
    pub fn observable(&self, name: &str) -> Option<f64> {
        self.steps.observable(name)
    }

    /// The facts about the scheme.
    #[must_use]
    pub fn entry(&self) -> Entry {
        self.steps.entry()
    }

    /// The crossings of the declared events so far, in the order of the run.
    pub fn crossings(&self) -> impl ExactSizeIterator<Item = Crossing<'_>> {
        let located = match self.steps.events() {
            Some(events) => events.located(),
            None => &[],
        };
        located.iter().map(|located| Crossing {
            event: &self.events[located.event],
            rising: located.rising,
            state: &located.state,
        })
    }
}

impl Debug for Run {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("Run")
            .field("origin", &self.origin)
            .field("step", &self.step())
            .field("steps", &self.steps())
            .field("state", self.state())
            .finish_non_exhaustive()
    }
}

impl Origin {
    /// Reads the first line of a saved run.
    fn read(line: &str) -> Option<Origin> {
        if let Some(name) = line.strip_prefix("scheme ") {
            return Some(Origin::Scheme(name.to_owned()));
        }
        let mut numbers = line.strip_prefix("tolerance ")?.split(' ');
        let mut number = || numbers.next()?.parse().ok();
        Some(Origin::Tolerance(Tolerance {
            relative: number()?,
            absolute: number()?,
        }))
    }
}

/// What a run begins from.
enum Basis {
    Start(FlatState, f64),
    Tolerated(FlatState),
    Saved(Checkpoint),
}

/// A run before its scheme is known.
struct BeginRun<'a> {
    system: &'a RuntimeSystem,
    from: Basis,
    hook: Arc<Hook>,
}

impl BeginRun<'_> {
    fn begin<M>(self, scheme: M) -> Result<Box<dyn Steps>, Error>
    where
        M: Scheme<RuntimeSystem, Map<f64>: Send + Map<Carried: Send, Work: Send>>,
    {
        let BeginRun { system, from, hook } = self;
        let run = match from {
            Basis::Start(start, step) => Integrator::new(system, scheme, start, step)?,
            Basis::Tolerated(start) => {
                // As `Integrator::to_tolerance` does: the step is the first one of the pilot.
                let prepared = system.prepare();
                let carried = scheme.start(&prepared, &start, 1.0);
                let step = carried.duration(1.0).unwrap_or(1.0);
                Integrator::new(system, scheme, start, step)?
            }
            Basis::Saved(checkpoint) => Integrator::resume(system, scheme, checkpoint)?,
        };
        let events = events(system);
        let events =
            (!events.is_empty()).then(|| Events::new(events.iter().map(|name| Event::named(name))));
        let every = Hook::interval(system.degrees_of_freedom());
        Ok(Box::new(run.observe(Watching {
            events,
            hook,
            every,
        })))
    }

    /// The run with steps from a tolerance, by the scheme that the structure of H has.
    fn tolerated(self, tolerance: Tolerance) -> Result<Box<dyn Steps>, Error> {
        #[inline(never)]
        fn by<M: Estimates<RuntimeSystem> + Default>(
            begin: BeginRun<'_>,
            tolerance: Tolerance,
        ) -> Result<Box<dyn Steps>, Error>
        where
            Adaptive<M>: Scheme<RuntimeSystem, Map<f64>: Send + Map<Carried: Send, Work: Send>>,
        {
            begin.begin(Adaptive::new(M::default(), tolerance))
        }
        let needs = Needs::SEPARABLE
            .and(Needs::QUADRATIC_KINETIC)
            .and(Needs::UNFORCED);
        match self.system.has(needs) {
            true => by::<GaussNystrom<8>>(self, tolerance),
            false => by::<Gauss<8>>(self, tolerance),
        }
    }
}

/// The methods of a run without the type of its scheme.
trait Steps: Send {
    fn advance(&mut self, n: u64) -> Result<(), Error>;
    fn advance_to(&mut self, t: f64) -> Result<(), Error>;
    fn advance_until(&mut self, t: f64) -> Result<FlatState, Error>;
    fn go_on(&mut self);
    fn state_at(&self, t: f64) -> Result<FlatState, Error>;
    fn state(&self) -> &FlatState;
    fn steps(&self) -> u64;
    fn step(&self) -> f64;
    fn refused_steps(&self) -> u64;
    fn energy(&self) -> f64;
    fn observable(&self, name: &str) -> Option<f64>;
    fn entry(&self) -> Entry;
    fn events(&self) -> Option<&Events<Flat<f64>>>;
    fn checkpoint(&self) -> Checkpoint;
}

impl<R> Steps for Integrator<f64, RuntimeSystem, R, Watching>
where
    R: MapOf<f64, RuntimeSystem> + Map<Carried: Send, Work: Send> + Send,
{
    fn advance(&mut self, n: u64) -> Result<(), Error> {
        self.advance(n).map(|_| ())
    }
    fn advance_to(&mut self, t: f64) -> Result<(), Error> {
        self.advance_to(t).map(|_| ())
    }
    fn advance_until(&mut self, t: f64) -> Result<FlatState, Error> {
        self.advance_until(t)
    }
    fn go_on(&mut self) {
        self.go_on();
    }
    fn state_at(&self, t: f64) -> Result<FlatState, Error> {
        self.state_at(t)
    }
    fn state(&self) -> &FlatState {
        self.state()
    }
    fn steps(&self) -> u64 {
        self.steps()
    }
    fn step(&self) -> f64 {
        self.step()
    }
    fn refused_steps(&self) -> u64 {
        self.refused_steps()
    }
    fn energy(&self) -> f64 {
        self.energy()
    }
    fn observable(&self, name: &str) -> Option<f64> {
        self.observable_named(name)
    }
    fn entry(&self) -> Entry {
        self.entry()
    }
    fn events(&self) -> Option<&Events<Flat<f64>>> {
        self.observer().events.as_ref()
    }
    fn checkpoint(&self) -> Checkpoint {
        self.checkpoint()
    }
}
