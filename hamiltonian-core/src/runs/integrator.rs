//! A run: a system, a scheme, a start and a step.
//!
//! Input: these four. Output: states, and the results of observers. Invariants: time is t₀ +
//! k·duration, never a running sum; the bits of a trajectory depend on neither blocks nor observers; a state that is not
//! finite is never returned, but detected, located and reported.

use crate::errors::Error;
use crate::flows::map::{Clock, Map, Step};
use crate::observers::observe::{self, Every, Observer, Unobserved, Verdict, View, Watch};
use crate::results::checkpoint::Memory;
use crate::schemes::scheme::{CarriedBy, Entry, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, IntoStart, State};
use crate::systems::system::{Description, Dynamics, ParameterText, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::boxed::Box;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use hamiltonian_lanes::Real;
#[cfg(feature = "rayon")]
use threads::Threads;

/// Integrates one trajectory: a run of a scheme on a system, with a step size and the current state.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
/// run.advance(100)?;
/// println!("q = {} at t = {}", run.state().q[0], run.state().t);
/// for state in run.states(10).take(5) {
///     println!("{}", state?.q[0]);
/// }
/// assert_eq!(run.steps(), 150);
/// # Ok::<(), Error>(())
/// ```
///
/// | task | method |
/// |---|---|
/// | make a number of steps | [`advance`](Integrator::advance) |
/// | make the steps to a time | [`advance_to`](Integrator::advance_to) a multiple of the step, [`advance_until`](Integrator::advance_until) any time |
/// | use states in a loop | [`states`](Integrator::states), [`states_at`](Integrator::states_at) |
/// | record values in each step | [`observe`](Integrator::observe), [`watch`](Integrator::watch) |
/// | change the run between two steps | [`set_state`](Integrator::set_state), [`set_system`](Integrator::set_system), [`change_step`](Integrator::change_step) |
/// | estimate the error | [`estimate_error`](Integrator::estimate_error) |
/// | save the run and continue it | [`checkpoint`](Integrator::checkpoint) or [`with_checkpoints`](Integrator::with_checkpoints), [`resume`](Integrator::resume) |
/// | compute faster | `with_threads`, [`fused`](Integrator::fused); many runs: [`Ensemble`](crate::Ensemble) |
///
/// # Type
/// `T` is the scalar (`f64`, unless another is named), `S` the system, `R` the map of the scheme and `O` the observer.
/// [`Run`] names the type by the scheme, for example for a field of a struct. With the scheme as a parameter, rustc
/// would report a scheme that does not fit the system at every use of the type.
///
/// # Reproducibility
/// A run has the same bits on every CPU and for every number of threads. [Fused](Integrator::fused) runs, which round a
/// product and a sum once, have the bits of their CPU.
///
/// # Values that are not finite
/// A run checks that its state and H are finite once every 1024 steps, at the end of each call and before each
/// observation. A check in every step would cost a third of a simple system's run. If a value is not finite, the run
/// repeats these steps one by one, and the error reports the first bad one. The state of the run is then the one before
/// that step. No observer receives a state that is not finite.
///
/// H is evaluated, since its derivatives may be finite where it is not: `1/x` is the derivative of `ln(x)`, also for
/// x < 0. It is not evaluated if the definition shows that it is finite, as polynomials, sines and cosines are. An orbit
/// that leaves the domain of H and returns between two checks is not detected. `watch(1, |_| ())` makes a check after
/// every step.
pub struct Integrator<T: Real, S: System, R: MapOf<T, S>, O = ()> {
    pub(crate) prepared: S::Prepared<T>,
    pub(crate) recipe: Arc<dyn Recipe<T, S, R>>,
    pub(crate) entry: Entry,
    map: R,
    work: R::Work,
    pub(crate) carried: R::Carried,
    /// The carried value at the beginning of the current block.
    snapshot: R::Carried,
    /// A copy with its closing piece: the observed state.
    shown: R::Carried,
    pub(crate) clock: Clock<T>,
    pub(crate) step: T,
    /// The number of the step at which the clock began.
    pub(crate) began: u64,
    pub(crate) steps: u64,
    pub(crate) state: State<VectorOf<S, T>>,
    pub(crate) ended: bool,
    /// The memory of the observers of a saved run, until they are attached.
    pub(crate) memory: Memory,
    /// The error that prevents further steps: an attached observer is not the saved one, or cannot
    /// continue.
    pub(crate) refused: Option<Error>,
    /// The file of checkpoints, and the number of steps between them.
    #[cfg(feature = "std")]
    pub(crate) saving: Option<(u64, std::path::PathBuf)>,
    /// The parameters with their values, by which a saved run is recognised.
    pub(crate) parameters: ParameterText,
    /// The threads on which steps are made.
    #[cfg(feature = "rayon")]
    threads: Option<Threads<R>>,
    pub(crate) observer: O,
}

/// A map of a scheme for the system `S` over the scalar `T`: it carries values of the system's shape. Functions that are
/// generic over [`Integrator`](crate::Integrator) name it as a bound; every such map implements it.
pub trait MapOf<T: Real, S: System>:
    Map<Carried: Carried<Vector = VectorOf<S, T>, Scalar = T>>
{
}

impl<T: Real, S: System, R: Map<Carried: Carried<Vector = VectorOf<S, T>, Scalar = T>>> MapOf<T, S>
    for R
{
}

/// The type of a run of the scheme `M` on the system `S`, with the observer `O`, over the scalar `T`.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// struct Simulation {
///     run: Run<Oscillator, StormerVerlet>,
/// }
///
/// let start = State::new([1.0], [0.0]);
/// let run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
/// let mut simulation = Simulation { run };
/// simulation.run.advance(3)?;
/// # Ok::<(), Error>(())
/// ```
pub type Run<S, M, O = (), T = f64> = Integrator<T, S, <M as Scheme<S>>::Map<T>, O>;

impl<T: Real, S: System, R: MapOf<T, S>> Integrator<T, S, R> {
    /// Creates a run of `scheme` on `system` from `start` with the step size `step`. A negative step integrates
    /// backwards.
    ///
    /// Time begins at 0, or at the time of the start, `State::new(q, p).at(t)`. After k steps it is t₀ + k·`step`, never
    /// a running sum.
    ///
    /// # Errors
    /// [`StartError::Step`](crate::errors::StartError::Step) for a zero, NaN or infinite step;
    /// [`InputError::Shape`](crate::errors::InputError::Shape), [`InputError::Extent`](crate::errors::InputError::Extent)
    /// and [`InputError::Row`](crate::errors::InputError::Row) if `start` does not have the system's shape;
    /// [`StartError::NotFinite`](crate::errors::StartError::NotFinite) if it is not finite;
    /// [`StartError::Values`](crate::errors::StartError::Values) if H or a derivative of it is not finite there;
    /// [`StartError::Shell`](crate::errors::StartError::Shell) for a time-transformed system (`dt = g*ds`,
    /// [`TimeTransformed`](crate::TimeTransformed)) if the start is off the shell H = 0 by more than a thousandth of the
    /// energies in it;
    /// [`StartError::Jumps`](crate::errors::StartError::Jumps) for a scheme that evaluates H(t) at the ends of steps,
    /// if H jumps; those of [`Scheme::check`].
    pub fn new<M: Scheme<S, Map<T> = R>>(
        system: &S,
        scheme: M,
        start: impl IntoStart<VectorOf<S, T>>,
        step: T,
    ) -> Result<Self, Error>
    where
        R: Map<Carried = CarriedBy<M, S, T>>,
    {
        let start = start.into_start(system.description().first_names())?;
        check_step(step)?;
        let prepared = check_start(system, &start)?;
        check_scheme(&scheme, &prepared, &start)?;
        Ok(Self::begin(system, prepared, scheme, start, step))
    }

    /// Makes the run after all checks.
    pub(crate) fn begin<M: Scheme<S, Map<T> = R>>(
        system: &S,
        prepared: S::Prepared<T>,
        scheme: M,
        start: State<VectorOf<S, T>>,
        step: T,
    ) -> Self
    where
        R: Map<Carried = CarriedBy<M, S, T>>,
    {
        let carried = scheme.start(&prepared, &start, step);
        Self::begin_with(system, prepared, scheme, start, step, carried)
    }

    /// Makes the run from a carried value.
    pub(crate) fn begin_with<M: Scheme<S, Map<T> = R>>(
        system: &S,
        prepared: S::Prepared<T>,
        scheme: M,
        start: State<VectorOf<S, T>>,
        step: T,
        carried: R::Carried,
    ) -> Self {
        let entry = scheme.entry();
        let map = scheme.prepare(&prepared, Step::of(step));
        Integrator {
            work: Scratch::like(&carried),
            map,
            snapshot: carried.clone(),
            shown: carried.clone(),
            carried,
            clock: Clock::new(start.t, step * duration(&entry)),
            parameters: system.parameter_text(),
            prepared,
            recipe: Arc::new(scheme),
            entry,
            step,
            began: 0,
            steps: 0,
            state: start,
            ended: false,
            memory: Memory::default(),
            refused: None,
            #[cfg(feature = "std")]
            saving: None,
            #[cfg(feature = "rayon")]
            threads: None,
            observer: (),
        }
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Attaches an observer. It receives the current state at once, and then every state whose step number is a multiple
    /// of its [interval](Observer::interval), whichever method makes the steps.
    ///
    /// Call it once. To attach several observers, pass a tuple, `.observe((EnergyDrift::new(), Recorder::new()))`.
    /// [`watch`](Integrator::watch) comes after it. The run owns the observer, and
    /// [`observer`](Integrator::observer) returns a reference to it; `&mut O` is an observer too.
    pub fn observe<N: Observer<T, S>>(mut self, mut observer: N) -> Integrator<T, S, R, N>
    where
        O: Unobserved,
    {
        self.attach(&mut observer);
        self.with_observer(|_| observer)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Attaches a closure. It receives the current state at once, and then every state whose step number is a multiple of
    /// `every` (0 counts as 1).
    ///
    /// The closure returns `()`, or a [`ControlFlow<()>`](core::ops::ControlFlow) whose `Break` ends the run. Call
    /// `watch` any number of times, with or without an observer: [`observer`](Integrator::observer) is then the pair of
    /// the previous observer and the closure.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let mut path = Vec::new();
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?
    ///     .observe(EnergyDrift::new())
    ///     .watch(10, |view| path.push((view.state.q[0], view.state.p[0])));
    /// run.advance(100)?;
    /// assert!(run.observer().0.max_relative() < 1e-4);
    /// assert_eq!(path.len(), 11);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn watch<V: Verdict, F: FnMut(&View<'_, T, S>) -> V>(
        mut self,
        every: u64,
        closure: F,
    ) -> Integrator<T, S, R, (O, Every<Watch<F>>)> {
        let mut closure = observe::every(every, observe::watch(closure));
        self.attach(&mut closure);
        self.with_observer(|observer| (observer, closure))
    }
}

// The documentation shows the methods above, then those of these modules, in this order. `new` and `observe` are above
// because rustc's messages about their bounds then name the type, not the module.
mod long;
mod tolerance;

mod advance;
mod until;

mod inspect;

mod attached;

mod change;

mod estimate;
mod options;

mod checks;
mod part;
#[cfg(feature = "rayon")]
mod threads;

pub(crate) use checks::{check_change, check_scheme, check_start, check_state, check_step};
pub use estimate::ErrorEstimate;
pub(crate) use part::{LastStep, Part, Recipe};
pub use until::States;

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Replaces the current state by a saved one.
    pub(crate) fn restore(&mut self, clock: Clock<T>, began: u64, steps: u64) {
        self.clock = clock;
        self.began = began;
        self.steps = steps;
        self.arrives(steps);
    }

    /// Parts of a step from the current state.
    pub(crate) fn part(&self) -> Part<'_, T, S, R> {
        let made = self.steps - self.began;
        Part {
            prepared: &self.prepared,
            recipe: &*self.recipe,
            state: &self.state,
            step: self.step,
            clock: self.clock,
            duration: self.carried.duration(self.clock.interval),
            last: LastStep::of(
                &self.map,
                &self.carried,
                None,
                self.clock,
                made,
                self.state.t,
            ),
        }
    }

    /// Parts of a step from the current state, in the scratch of the run.
    fn part_in_place(&mut self) -> Part<'_, T, S, R> {
        let made = self.steps - self.began;
        let (carried, work) = (&self.carried, Some(&mut self.work));
        Part {
            prepared: &self.prepared,
            recipe: &*self.recipe,
            state: &self.state,
            step: self.step,
            clock: self.clock,
            duration: carried.duration(self.clock.interval),
            last: LastStep::of(&self.map, carried, work, self.clock, made, self.state.t),
        }
    }

    /// The current state as observers receive it.
    fn view<'a>(&'a self, part: &'a Part<'a, T, S, R>) -> View<'a, T, S> {
        View {
            steps: self.steps,
            state: &self.state,
            prepared: &self.prepared,
            between: part,
        }
    }
}

/// A clone continues from the same state with the same observers. It has no
/// [`with_checkpoints`](Integrator::with_checkpoints): two runs would overwrite each other's file.
impl<T: Real, S: System, R: MapOf<T, S>, O: Clone> Clone for Integrator<T, S, R, O> {
    fn clone(&self) -> Self {
        let map = self.recipe.prepare(&self.prepared, Step::of(self.step));
        Integrator {
            prepared: self.prepared.clone(),
            recipe: Arc::clone(&self.recipe),
            entry: self.entry,
            work: Scratch::like(&self.carried),
            map,
            carried: self.carried.clone(),
            snapshot: self.snapshot.clone(),
            shown: self.shown.clone(),
            clock: self.clock,
            step: self.step,
            began: self.began,
            steps: self.steps,
            state: self.state.clone(),
            ended: self.ended,
            memory: self.memory.clone(),
            refused: self.refused.clone(),
            #[cfg(feature = "std")]
            saving: None,
            parameters: self.parameters.clone(),
            #[cfg(feature = "rayon")]
            threads: self.threads.clone(),
            observer: self.observer.clone(),
        }
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O: fmt::Debug> fmt::Debug for Integrator<T, S, R, O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields = f.debug_struct("Integrator");
        fields
            .field("system", &self.prepared.description().name)
            .field("scheme", &self.recipe.describe())
            .field("step", &self.step)
            .field("steps", &self.steps);
        if let Some(duration) = self.carried.duration(self.clock.interval) {
            let sizes = match self.carried.is_constant() {
                true => "constant",
                false => "varying",
            };
            fields
                .field("sizes", &sizes)
                .field("duration", &duration)
                .field("refused_steps", &self.refused_steps());
        }
        fields
            .field("state", &self.state)
            .field("observer", &self.observer)
            .finish_non_exhaustive()
    }
}

/// The name of a system, H, and the number of components, which identify a saved run.
pub(crate) fn formula<V: Vector>(system: &Description, q: &V) -> String {
    let Description { name, formula, .. } = system;
    alloc::format!("{name}: {formula} (coordinates: {})", q.len())
}

/// The first of the parameters that is NaN or infinite, with its value: `m[1] = NaN`.
fn parameter_without_value(parameters: &str) -> Option<Box<str>> {
    let mut lines = parameters.lines();
    let line = lines.find(|line| {
        let words = line.split(|c: char| !c.is_alphanumeric()).skip(1);
        words.into_iter().any(|word| word == "NaN" || word == "inf")
    });
    line.map(Box::from)
}

/// The time that a step advances, in units of its size.
pub(crate) fn duration<T: Real>(entry: &Entry) -> T {
    T::constant(f64::from(entry.duration), 0.0)
}

/// The components as `f64`.
pub(crate) fn numbers<V: Vector>(vector: &V) -> Vec<f64> {
    vector.components().map(Real::to_f64).collect()
}
