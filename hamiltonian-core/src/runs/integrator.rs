//! A run: a system, a scheme, a start and a step.
//!
//! Input: these four. Output: states, and the results of observers. Invariants: time is t₀ +
//! k·interval; the bits of a trajectory depend on neither blocks nor observers; a state that is not
//! finite is never returned, but detected, located and reported.

mod advance;
mod change;
mod checks;
mod estimate;
mod inspect;
mod part;
#[cfg(feature = "rayon")]
mod threads;

pub use advance::States;
pub(crate) use checks::{check_change, check_scheme, check_start, check_state, check_step};
pub use estimate::ErrorEstimate;
pub(crate) use part::{Part, Recipe};

use crate::errors::Error;
use crate::flows::map::{Clock, Map, Step};
use crate::observers::observe::{Every, Observer, Unobserved, Verdict, View, Watch, every, watch};
use crate::results::checkpoint::Memory;
use crate::schemes::scheme::{CarriedBy, Entry, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, IntoStart, State};
use crate::systems::system::{Arithmetic, Description, Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::boxed::Box;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use hamiltonian_lanes::Real;
#[cfg(feature = "rayon")]
use threads::Threads;

/// A run: a system, a scheme, a step and the current state.
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
/// # Blocks
/// A run checks that its state is finite once every 1024 steps, at the end of each call and before each observation. A
/// check in every step would cost a third of a simple system's run. If the state is not finite, the run repeats the
/// block step by step and finds the first bad step, which the error reports. The state of the run is then the one before
/// that step. No observer receives a state that is not finite.
///
/// At the end of a block H must be finite too: the derivative of `ln(x)` has values where `ln(x)` has none. H is
/// evaluated there, unless the definition shows that it is finite, as polynomials, sines and cosines are. An orbit that
/// leaves the domain of H and returns within one block is not detected.
///
/// # Type
/// `R` is the scheme's map; [`Run`] names the type by the scheme. (With the scheme as the
/// parameter, rustc would report a wrong pairing at every use of the type.)
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
    pub(crate) parameters: String,
    /// The threads on which steps are made.
    #[cfg(feature = "rayon")]
    threads: Option<Threads<R>>,
    pub(crate) observer: O,
}

/// A map of a scheme for the system `S` over the scalar `T`.
pub trait MapOf<T: Real, S: System>:
    Map<Carried: Carried<Vector = VectorOf<S, T>, Scalar = T>>
{
}

impl<T: Real, S: System, R: Map<Carried: Carried<Vector = VectorOf<S, T>, Scalar = T>>> MapOf<T, S>
    for R
{
}

/// The type of a run of scheme `M` on system `S` with observer `O` over the scalar `T`.
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
    /// # Errors
    /// [`StartError::Step`](crate::errors::StartError::Step) for a zero, NaN or infinite step;
    /// [`InputError::Shape`](crate::errors::InputError::Shape) if `start` does not have the system's shape;
    /// [`StartError::NotFinite`](crate::errors::StartError::NotFinite) if it is not finite;
    /// [`StartError::Values`](crate::errors::StartError::Values) if H or a derivative of it is not finite there;
    /// [`StartError::Shell`](crate::errors::StartError::Shell) for a system in another time if the start is off the
    /// shell H = 0 by more than a thousandth of the energies in it;
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
        let entry = scheme.entry();
        let carried = scheme.start(&prepared, &start, step);
        let map = scheme.prepare(&prepared, Step::of(step));
        Integrator {
            work: Scratch::like(&carried),
            map,
            snapshot: carried.clone(),
            shown: carried.clone(),
            carried,
            clock: Clock::new(start.t, step * duration(&entry)),
            parameters: parameters(system),
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
    /// Attaches an observer. It receives the current state at once, and then every state whose step
    /// number is a multiple of its [interval](Observer::interval), for all ways of making steps:
    /// [`advance`](Integrator::advance), [`advance_to`](Integrator::advance_to),
    /// [`states`](Integrator::states).
    ///
    /// Call it once. To attach several observers, pass a tuple, `.observe((EnergyDrift::new(),
    /// Recorder::new()))`; [`watch`](Integrator::watch) comes after it. The run owns the observer,
    /// and [`observer`](Integrator::observer) returns a reference to it; `&mut O` is an observer
    /// too.
    pub fn observe<N: Observer<T, S>>(mut self, mut observer: N) -> Integrator<T, S, R, N>
    where
        O: Unobserved,
    {
        self.attach(&mut observer);
        self.with_observer(|_| observer)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Attaches a closure besides the observer. It receives the current state at once, and then
    /// every state whose step number is a multiple of `steps` (0 counts as 1).
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
        steps: u64,
        closure: F,
    ) -> Integrator<T, S, R, (O, Every<Watch<F>>)> {
        let mut closure = every(steps, watch(closure));
        self.attach(&mut closure);
        self.with_observer(|observer| (observer, closure))
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Turns the lanes of the CPU's registers off, or on again, as by default. In lanes, several
    /// stages of implicit schemes and iterations of loops over arrays are computed at a time;
    /// systems written by hand stay scalar. The bits are the same, unless the run is
    /// [`fused`](Integrator::fused).
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let run = |lanes| {
    ///     let start = State::new([1.0], [0.0]);
    ///     let mut run = Integrator::new(&Oscillator {}, Gauss::<8>::default(), start, 0.5)?.with_lanes(lanes);
    ///     run.advance(100).cloned()
    /// };
    /// assert_eq!(run(true)?, run(false)?);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn with_lanes(self, lanes: bool) -> Self {
        let now = self.prepared.arithmetic();
        self.computed(Arithmetic { lanes, ..now })
    }

    /// Turns on fused products in lanes, `a·b + c` rounded once: 20 to 50 % faster on CPUs that
    /// have them. The bits then differ from those of other CPUs, of a run without
    /// [`with_lanes`](Integrator::with_lanes), and of the member of an ensemble.
    #[must_use]
    pub fn fused(self) -> Self {
        let now = self.prepared.arithmetic();
        self.computed(Arithmetic { fused: true, ..now })
    }

    /// Sets the number of threads (0 counts as 1); the default is one. The bits do not depend on
    /// it. A step that costs less than about 10 μs is not faster on several threads.
    ///
    /// Threads share the loops over arrays of forces, drifts and fields that take 16384 iterations
    /// or more: rows of a lattice whose iterations change elements of their own row alone, and
    /// chains. Polynomials of neighbours, such as `(u[(i + 1) % n][j] - u[i][j])^2`, count as
    /// changes of the own row. Threads also share the forces of sums over the pairs of 4096 points
    /// or more, `sum(i in 0..n, j in 0..i)` or `sum(i in 0..n, j in i + 1..n)`, if each iteration
    /// changes elements i and j alone. Sums over a whole array, such as energies, and all else of a
    /// step run on one thread; so do all loops without [`with_lanes`](Integrator::with_lanes), and chains with
    /// neighbours in a [`fused`](Integrator::fused) run. An ensemble has threads of its own, and
    /// each of its members one.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// hamiltonian! {
    ///     /// A chain of pendulums with springs.
    ///     pub struct Chain { n: usize }
    ///     H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 - cos(q[i]) + (q[(i + 1) % n] - q[i])^2/2 }
    /// }
    ///
    /// let end = |threads| {
    ///     let start = State::new(vec![0.5; 40_000], vec![0.0; 40_000]);
    ///     let system = Chain::new(40_000)?;
    ///     let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.1)?.with_threads(threads);
    ///     run.advance(10).cloned()
    /// };
    /// assert_eq!(end(1)?, end(2)?);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// Called in a rayon pool, it starts no threads: the run has those of the pool, at most so many. If the operating
    /// system cannot start threads, the run has one. A saved run is resumed on one.
    #[cfg(feature = "rayon")]
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self
    where
        R: Map<Work: Send> + Sync,
    {
        self.threads = Threads::new(threads);
        let now = self.prepared.arithmetic();
        let threads = self.threads.as_ref().map_or(1, Threads::number);
        self.computed(Arithmetic { threads, ..now })
    }

    /// Changes the arithmetic of the run.
    pub(crate) fn computed(mut self, arithmetic: Arithmetic) -> Self {
        self.prepared.set_arithmetic(arithmetic);
        self.map = self.recipe.prepare(&self.prepared, Step::of(self.step));
        self
    }

    /// Replaces the current state by a saved one.
    pub(crate) fn restore(&mut self, clock: Clock<T>, began: u64, steps: u64) {
        self.clock = clock;
        self.began = began;
        self.steps = steps;
        self.arrives(steps);
    }

    /// Passes the current state to a new observer, or restores its saved data.
    fn attach<N: Observer<T, S>>(&mut self, observer: &mut N) {
        if self.memory.is_empty() {
            if observer.attach(&self.view(&self.part())).is_break() {
                self.end(observer.end().map(Option::<&_>::cloned));
            }
            return;
        }
        let mut memory = core::mem::take(&mut self.memory);
        let restored = observer.restore(&self.view(&self.part()), &mut memory);
        self.memory = memory;
        match restored {
            Ok(()) if self.ended => self.end(observer.end().map(Option::<&_>::cloned)),
            Ok(()) => {}
            Err(error) => self.refused = Some(error),
        }
    }

    /// Ends the run at a state between two steps, or at the current one.
    fn end(&mut self, end: Result<Option<State<VectorOf<S, T>>>, Error>) {
        self.ended = true;
        match end {
            Ok(Some(state)) => self.state = state,
            Ok(None) => {}
            Err(error) => self.refused = Some(error),
        }
    }

    /// Returns true if an observer has ended the run. It makes no further steps until
    /// [`go_on`](Integrator::go_on) is called.
    pub fn has_ended(&self) -> bool {
        self.ended
    }

    /// Continues a run that an observer has ended: from the end of its last step, if the run ended
    /// before it.
    pub fn go_on(&mut self) {
        self.ended = false;
        self.arrives(self.steps);
    }

    /// Parts of a step from the current state.
    pub(crate) fn part(&self) -> Part<'_, T, S, R> {
        Part {
            prepared: &self.prepared,
            recipe: &*self.recipe,
            state: &self.state,
            step: self.step,
            clock: self.clock,
            duration: self.carried.duration(self.clock.interval),
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

    /// Replaces the observer by one that is made from it.
    fn with_observer<N>(self, make: impl FnOnce(O) -> N) -> Integrator<T, S, R, N> {
        Integrator {
            prepared: self.prepared,
            recipe: self.recipe,
            entry: self.entry,
            map: self.map,
            work: self.work,
            carried: self.carried,
            snapshot: self.snapshot,
            shown: self.shown,
            clock: self.clock,
            step: self.step,
            began: self.began,
            steps: self.steps,
            state: self.state,
            ended: self.ended,
            memory: self.memory,
            refused: self.refused,
            #[cfg(feature = "std")]
            saving: self.saving,
            parameters: self.parameters,
            #[cfg(feature = "rayon")]
            threads: self.threads,
            observer: make(self.observer),
        }
    }
}

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
            // Two runs would overwrite each other's file.
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
        f.debug_struct("Integrator")
            .field("system", &self.prepared.description().name)
            .field("scheme", &self.recipe.describe())
            .field("step", &self.step)
            .field("steps", &self.steps)
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

/// The parameters of a system with their values.
pub(crate) fn parameters<S: System>(system: &S) -> String {
    // Capacity for a few, so that short runs spend no time on growth.
    let mut parameters = String::with_capacity(64);
    // Writing to a string does not fail.
    let _ = system.describe_parameters(&mut parameters);
    parameters
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
