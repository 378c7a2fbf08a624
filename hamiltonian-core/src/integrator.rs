//! A run: a system, a scheme, a start and a step under way.
//!
//! Input: those four. Output: states, and what observers make of them. Invariants: time is
//! t₀ + k·interval; the bits of a trajectory depend on neither blocks nor observers; a state that
//! is not finite is never shown, but found, located and reported.

use crate::error::Error;
use crate::observe::{Every, Observer, View, Watch, every, watch};
use crate::scheme::{Clock, Copies, Entry, Scheme, Stepper, Unsolved};
use crate::state::{Point, State};
use crate::system::{Dynamics, System};
use crate::vector::Vector;
use alloc::vec::Vec;
use hamiltonian_lanes::{Mask, Real};

/// Steps between two checks that everything is finite: few enough that replaying a bad block is
/// quick, enough that the check costs nothing.
const BLOCK: u64 = 1024;

/// A run: a system, a scheme, a start and a step under way.
///
/// ```
#[doc = include_str!("doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, State, schemes::StormerVerlet};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, StormerVerlet::default(), start, 0.01)?;
/// run.advance(100)?;
/// println!("q = {} at t = {}", run.state().q[0], run.state().t);
/// for state in run.states(10).take(5) {
///     println!("{}", state?.q[0]);
/// }
/// assert_eq!(run.steps(), 150);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
///
/// # Blocks
/// Whether everything is finite is checked once every 1024 steps, at the end of each call and
/// before each observation; a check every step would cost a third of a simple system's run. When
/// it is not, the block is made again step by step to find the first bad step, which the error
/// reports; the run then stands at the state before that step. No observer sees a state that is
/// not finite.
///
/// # Type
/// `R` is the scheme's stepper; [`Run`] names the type by the scheme. (With the scheme itself as
/// the parameter a wrong pairing would be reported once for every place the type appears.)
#[derive(Debug, Clone)]
pub struct Integrator<T: Real, S: System<T>, R: Stepper<Vector = S::Vector>, O = ()> {
    prepared: S::Prepared,
    entry: &'static Entry,
    stepper: R,
    /// What was carried at the beginning of the present block.
    snapshot: R::Carried,
    clock: Clock<T>,
    step: T,
    steps: u64,
    state: State<S::Vector>,
    observer: O,
}

/// The type of a run of scheme `M` on system `S` with observer `O` over the scalar `T`.
///
/// ```
#[doc = include_str!("doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, Run, State, schemes::StormerVerlet};
///
/// struct Simulation {
///     run: Run<Oscillator, StormerVerlet>,
/// }
///
/// let start = State::new([1.0], [0.0]);
/// let run = Integrator::new(&Oscillator, StormerVerlet::default(), start, 0.01)?;
/// let mut simulation = Simulation { run };
/// simulation.run.advance(3)?;
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
pub type Run<S, M, O = (), T = f64> = Integrator<T, S, <M as Scheme<T, S>>::Stepper, O>;

impl<T: Real, S: System<T>, R: Stepper<Vector = S::Vector>> Integrator<T, S, R> {
    /// A run of `scheme` on `system` from `start` with the step size `step`, which is negative to
    /// integrate backwards. Units are the caller's.
    ///
    /// # Errors
    /// [`Error::Step`] for a zero, NaN or infinite step; [`Error::Shape`] when `start` has not
    /// the system's shape; [`Error::Start`] when it is not finite; [`Error::Shell`] when the system
    /// is one in another time and it is off the shell H = 0 by more than a thousandth of the energies
    /// in it.
    pub fn new<M: Scheme<T, S, Stepper = R>>(
        system: &S,
        scheme: M,
        start: State<S::Vector>,
        step: T,
    ) -> Result<Self, Error> {
        if !step.is_finite() || step.equals(T::zero()).any() {
            return Err(Error::Step {
                step: step.to_f64(),
            });
        }
        system.check_shape(&start)?;
        if !finite(&start) {
            let (q, p) = (numbers(&start.q), numbers(&start.p));
            return Err(Error::Start {
                time: start.t.to_f64(),
                q,
                p,
            });
        }
        let prepared = system.prepare();
        if S::ON_SHELL {
            check_shell::<T, S>(&prepared, &start)?;
        }
        let stepper = scheme.prepare(&prepared, &start, step);
        let duration = T::constant(f64::from(scheme.entry().duration), 0.0);
        Ok(Integrator {
            snapshot: stepper.carried().clone(),
            clock: Clock {
                start: start.t,
                interval: step * duration,
            },
            prepared,
            entry: scheme.entry(),
            stepper,
            step,
            steps: 0,
            state: start,
            observer: (),
        })
    }

    /// The same run with an observer, which is shown the present state at once and from then on
    /// every state whose step number is a multiple of its [interval](Observer::interval), on
    /// every path: [`advance`](Integrator::advance), [`advance_to`](Integrator::advance_to),
    /// [`states`](Integrator::states).
    ///
    /// Several observers are a tuple. An observer is given away and got back by
    /// [`observer`](Integrator::observer), or lent as `&mut`.
    pub fn observe<O: Observer<T, S>>(self, mut observer: O) -> Integrator<T, S, R, O> {
        observer.attach(&self.view());
        self.with_observer(|()| observer)
    }
}

impl<T: Real, S: System<T>, R: Stepper<Vector = S::Vector>, O: Observer<T, S>>
    Integrator<T, S, R, O>
{
    /// The same run with a closure besides its observer, shown the present state at once and from
    /// then on every state whose step number is a multiple of `steps` (0 counts as 1).
    ///
    /// ```
    #[doc = include_str!("doc/oscillator.md")]
    /// use hamiltonian_core::{EnergyDrift, Integrator, State, schemes::StormerVerlet};
    ///
    /// let mut path = Vec::new();
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator, StormerVerlet::default(), start, 0.01)?
    ///     .observe(EnergyDrift::new())
    ///     .watch(10, |view| path.push((view.state.q[0], view.state.p[0])));
    /// run.advance(100)?;
    /// assert!(run.observer().0.max_relative() < 1e-4);
    /// assert_eq!(path.len(), 11);
    /// # Ok::<(), hamiltonian_core::Error>(())
    /// ```
    pub fn watch<F: FnMut(&View<'_, T, S>)>(
        self,
        steps: u64,
        closure: F,
    ) -> Integrator<T, S, R, (O, Every<Watch<F>>)> {
        let mut closure = every(steps, watch(closure));
        closure.attach(&self.view());
        self.with_observer(|observer| (observer, closure))
    }
    /// Makes `n` steps and returns the state after them.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::Solve`]. The run then stands at the last good state and
    /// can be asked for it.
    pub fn advance(&mut self, n: u64) -> Result<&State<S::Vector>, Error> {
        let end = self.steps.saturating_add(n);
        let interval = self.observer.interval().max(1);
        while self.steps < end {
            let due = (self.steps / interval)
                .saturating_add(1)
                .saturating_mul(interval);
            self.run_to(due.min(end))?;
            if self.steps == due {
                self.observer.observe(&View {
                    step: self.steps,
                    state: &self.state,
                    prepared: &self.prepared,
                });
            }
        }
        Ok(&self.state)
    }

    /// Makes the whole number of steps that leads to the time `t`.
    ///
    /// The step size is never changed, and a state at another time is never passed off as one at
    /// `t`: if no whole number of steps leads there, to within the rounding of `t`, the step and
    /// the start, that is an error and no step is made.
    ///
    /// # Errors
    /// [`Error::OffGrid`] with the reachable times on both sides; those of
    /// [`advance`](Integrator::advance).
    pub fn advance_to(&mut self, t: T) -> Result<&State<S::Vector>, Error> {
        /// Numbers of steps up to here are exact in `f64`.
        const MOST: f64 = (1_u64 << 53) as f64;
        let count = ((t - self.clock.start) / self.clock.interval).to_f64();
        let nearest = (count.clamp(0.0, MOST) + 0.5) as u64;
        let reached = self.clock.at(nearest);
        // t, the start and the interval are each off by half an ulp at most, and so are the
        // product and the sum in `at`; decimal steps such as 0.001 are rounded to f64 by the
        // user, whatever the scalar.
        let size =
            t.magnitude() + self.clock.start.magnitude() + (reached - self.clock.start).magnitude();
        let rounding = T::epsilon().max(f64::EPSILON) * size;
        let meets = t.is_finite() && count < MOST && (reached - t).magnitude() <= rounding;
        if !meets || nearest < self.steps {
            let behind = count < self.steps as f64;
            let before = (count.clamp(0.0, MOST) as u64).max(self.steps);
            let after = if behind { before } else { before + 1 };
            return Err(Error::OffGrid {
                target: t.to_f64(),
                before: self.clock.at(before).to_f64(),
                after: self.clock.at(after).to_f64(),
            });
        }
        self.advance(nearest - self.steps)
    }

    /// The states after `every`, 2·`every`, … further steps (0 counts as 1), without end. The
    /// first error is the last item.
    pub fn states(&mut self, every: u64) -> States<'_, T, S, R, O> {
        States {
            run: self,
            every: every.max(1),
            failed: false,
        }
    }

    /// Steps to `stop`, leaves the synchronised state there.
    fn run_to(&mut self, stop: u64) -> Result<(), Error> {
        while self.steps < stop {
            let n = BLOCK.min(stop - self.steps);
            self.snapshot.copy_from(self.stepper.carried());
            if self.stepper.run(self.steps, n).is_err() || !self.arrives(self.steps + n) {
                return Err(self.replay(n));
            }
            self.steps += n;
        }
        Ok(())
    }

    /// Writes the state after `made` steps, which the stepper has made; whether all is finite.
    fn arrives(&mut self, made: u64) -> bool {
        self.stepper
            .synchronise(made, &mut self.state.q, &mut self.state.p);
        self.state.t = self.clock.at(made);
        finite(&self.state) && self.stepper.carried().is_finite()
    }

    /// Makes the block of `n` steps again, one by one, up to the bad one, and stops before that.
    #[cold]
    fn replay(&mut self, n: u64) -> Error {
        let last = self.steps + n - 1;
        self.stepper.carried_mut().copy_from(&self.snapshot);
        loop {
            self.snapshot.copy_from(self.stepper.carried());
            let outcome = self.stepper.run(self.steps, 1);
            let good = outcome.is_ok() && self.arrives(self.steps + 1);
            // The last step is the bad one if none before it was.
            if good && self.steps < last {
                self.steps += 1;
                continue;
            }
            let error = match outcome {
                Err(Unsolved {
                    made,
                    residual,
                    iterations,
                }) => Error::Solve {
                    step: made + 1,
                    time: self.clock.at(made).to_f64(),
                    residual,
                    iterations,
                },
                Ok(()) => Error::NotFinite {
                    step: self.steps + 1,
                    time: self.state.t.to_f64(),
                    q: numbers(&self.state.q),
                    p: numbers(&self.state.p),
                },
            };
            self.stepper.carried_mut().copy_from(&self.snapshot);
            self.arrives(self.steps);
            return error;
        }
    }
}

impl<T: Real, S: System<T>, R: Stepper<Vector = S::Vector>, O> Integrator<T, S, R, O> {
    /// The present state: time, coordinates and momenta, all at the same time.
    pub fn state(&self) -> &State<S::Vector> {
        &self.state
    }

    /// The present time.
    pub fn time(&self) -> T {
        self.state.t
    }

    /// The number of steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The step size.
    pub fn step(&self) -> T {
        self.step
    }

    /// The time one step advances: the step size, but twice that for
    /// [`ConsecutiveSubTrajectories`](crate::schemes::ConsecutiveSubTrajectories).
    pub fn interval(&self) -> T {
        self.clock.interval
    }

    /// H at the present state.
    pub fn energy(&self) -> T {
        use crate::system::Dynamics;
        self.prepared
            .energy(self.state.t, &self.state.q, &self.state.p)
    }

    /// The system with its parameters worked in.
    pub fn prepared(&self) -> &S::Prepared {
        &self.prepared
    }

    /// The scheme's entry in the catalogue.
    pub fn entry(&self) -> &'static Entry {
        self.entry
    }

    /// The present state as observers see it.
    fn view(&self) -> View<'_, T, S> {
        View {
            step: self.steps,
            state: &self.state,
            prepared: &self.prepared,
        }
    }

    /// The same run with what is made of its observer.
    fn with_observer<N>(self, make: impl FnOnce(O) -> N) -> Integrator<T, S, R, N> {
        Integrator {
            prepared: self.prepared,
            entry: self.entry,
            stepper: self.stepper,
            snapshot: self.snapshot,
            clock: self.clock,
            step: self.step,
            steps: self.steps,
            state: self.state,
            observer: make(self.observer),
        }
    }

    /// The observer.
    pub fn observer(&self) -> &O {
        &self.observer
    }

    /// Ends the run: the observer.
    pub fn into_observer(self) -> O {
        self.observer
    }
}

impl<T: Real, S: System<T>, R: Stepper<Vector = S::Vector>, O> Integrator<T, S, R, O>
where
    R: Copies,
{
    /// The second copy (q̃, p̃) at the present time; the first is [`state`](Integrator::state).
    pub fn copy(&self) -> Point<S::Vector> {
        self.stepper.copy()
    }

    /// How far the two copies are apart: the Euclidean norm of (q − q̃, p − p̃).
    pub fn copy_distance(&self) -> f64 {
        let Point { q, p } = self.copy();
        let mut sum = T::zero();
        for (here, there) in [(&self.state.q, &q), (&self.state.p, &p)] {
            for (a, b) in here.components().zip(there.components()) {
                sum = (a - b).fma(a - b, sum);
            }
        }
        Real::sqrt(sum.to_f64())
    }
}

/// The iterator of [`Integrator::states`].
#[derive(Debug)]
pub struct States<'a, T: Real, S: System<T>, R: Stepper<Vector = S::Vector>, O> {
    run: &'a mut Integrator<T, S, R, O>,
    every: u64,
    failed: bool,
}

impl<T: Real, S: System<T>, R: Stepper<Vector = S::Vector>, O: Observer<T, S>> Iterator
    for States<'_, T, S, R, O>
{
    type Item = Result<State<S::Vector>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let state = self.run.advance(self.every).cloned();
        self.failed = state.is_err();
        Some(state)
    }
}

/// Whether time, coordinates and momenta are finite.
fn finite<V: Vector>(state: &State<V>) -> bool {
    state.t.is_finite() && state.q.is_finite() && state.p.is_finite()
}

/// An error where H = g·(h + p_t) is not 0: p_t, the last momentum, is not −h. It is held against
/// Σ p ∂H/∂p, in which g·p_t is one term, and by so little that where a run with errors in its energy
/// ended another can go on.
fn check_shell<T: Real, S: System<T>>(
    prepared: &S::Prepared,
    start: &State<S::Vector>,
) -> Result<(), Error> {
    let (mut slopes, mut velocities) = (start.q.clone(), start.p.clone());
    let h = prepared.energy_and_gradient(start.t, &start.q, &start.p, &mut slopes, &mut velocities);
    let (momenta, velocities) = (numbers(&start.p), numbers(&velocities));
    let terms = momenta.iter().zip(&velocities);
    let scale: f64 = terms.map(|(p, velocity)| (p * velocity).abs()).sum();
    let (Some(given), Some(factor)) = (momenta.last(), velocities.last()) else {
        return Ok(());
    };
    if h.to_f64().abs() <= 1e-3 * scale {
        return Ok(());
    }
    Err(Error::Shell {
        momentum: S::GROUPS.last().map_or("", |group| group.momentum),
        given: *given,
        due: given - h.to_f64() / factor,
    })
}

/// The components as `f64`.
fn numbers<V: Vector>(vector: &V) -> Vec<f64> {
    vector.components().map(Real::to_f64).collect()
}
