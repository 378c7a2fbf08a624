//! Saving and resuming a run.
//!
//! Input: a run, or a [`Checkpoint`]. Output: the other. Invariant: a checkpoint of another system,
//! of other parameters or of another scheme is refused.

use crate::errors::{CheckpointError, Error};
use crate::flows::map::Clock;
use crate::flows::map::Map;
use crate::observers::observe::Observer;
use crate::results::checkpoint::{Checkpoint, Memory};
use crate::runs::integrator::Recipe;
use crate::runs::integrator::{Integrator, MapOf, formula};
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::systems::state::State;
use crate::systems::system::{Arithmetic, Dynamics, ParameterText, System};
use crate::systems::vector::Vector;
use alloc::borrow::ToOwned;
use hamiltonian_lanes::Real;

/// An observer ended the run.
const ENDED: u64 = 1;
/// Products fuse in lanes.
const FUSED: u64 = 2;
/// Lanes are not used.
const SCALAR: u64 = 4;

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Returns a checkpoint of the run and of the data of its observers, for [`resume`](Integrator::resume). Closures have
    /// no data.
    ///
    /// [`Checkpoint::save`] writes it to a file, and [`Checkpoint::to_bytes`] returns the bytes of that file.
    /// [`with_checkpoints`](Integrator::with_checkpoints) saves a run as it advances.
    pub fn checkpoint(&self) -> Checkpoint {
        let mut numbers = Memory::default();
        for scalar in [self.clock.start, self.step] {
            numbers.scalar(scalar);
        }
        for component in self.carried.components() {
            numbers.scalar(component);
        }
        let Arithmetic { lanes, fused, .. } = self.prepared.arithmetic();
        let flags = [(self.ended, ENDED), (fused, FUSED), (!lanes, SCALAR)];
        let flags = flags.map(|(set, flag)| if set { flag } else { 0 });
        let flags = flags.iter().sum();
        let mut observers = Memory::default();
        self.observer.save(&mut observers);
        Checkpoint {
            system: formula(self.prepared.description(), &self.state.q),
            pieces: self.prepared.description().piece_formulas("\n"),
            parameters: self.parameters.write(),
            scheme: self.recipe.describe(),
            scalar: core::any::type_name::<T>().to_owned(),
            counts: [
                self.steps,
                self.began,
                self.clock.first.magnitude() as u64,
                flags,
            ],
            numbers,
            observers,
        }
    }
}

#[cfg(feature = "std")]
impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Saves the run to `path` after every `every` steps (0 counts as 1), counted from its start, after observers have
    /// received the state. A file is replaced when the new one is complete.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let path = std::env::temp_dir().join("oscillator.saved");
    /// let scheme = StormerVerlet::default();
    /// let mut run = Integrator::new(&Oscillator {}, scheme, State::new([1.0], [0.0]), 0.01)?
    ///     .with_checkpoints(1_000, &path);
    /// run.advance(2_500)?;
    ///
    /// let mut again = Integrator::resume(&Oscillator {}, scheme, Checkpoint::load(&path)?)?;
    /// assert_eq!(again.steps(), 2_000);
    /// assert_eq!(again.advance(500)?, run.state());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// This method returns none. If the file cannot be written, [`advance`](Integrator::advance)
    /// returns [`CheckpointError::File`] after the step, and the run can continue.
    #[must_use]
    pub fn with_checkpoints(mut self, every: u64, path: impl AsRef<std::path::Path>) -> Self {
        self.saving = Some((every.max(1), path.as_ref().to_path_buf()));
        self
    }
}

impl<S: System, R: MapOf<f64, S>> Integrator<f64, S, R> {
    /// Resumes a saved run with the same bits, from [`Checkpoint::load`] or [`Checkpoint::from_bytes`]. The step size, the
    /// state and the number of steps come from the checkpoint.
    ///
    /// Pass the system and the scheme of the saved run; after [`set_system`](Integrator::set_system), the system that
    /// was set. Attach the same observers in the same order by [`observe`](Integrator::observe) and
    /// [`watch`](Integrator::watch): their data are restored. If an observer differs, [`advance`](Integrator::advance)
    /// returns an error. Call `with_threads` and [`with_checkpoints`](Integrator::with_checkpoints) again, since
    /// checkpoints do not contain them.
    ///
    /// Another process of the same binary computes the same bits, a [`fused`](Integrator::fused) run on the same kind of
    /// CPU. Another binary resumes the run too, if all that is compared is equal; its last bits may differ.
    ///
    /// Scalars other than `f64` need [`resume_over`](Integrator::resume_over), because rustc cannot infer the scalar.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let scheme = StormerVerlet::default();
    /// let mut run = Integrator::new(&Oscillator {}, scheme, State::new([1.0], [0.0]), 0.01)?;
    /// let saved = run.checkpoint();
    /// run.advance(10)?;
    /// let mut again = Integrator::resume(&Oscillator {}, scheme, saved)?;
    /// assert_eq!(again.advance(10)?, run.state());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`CheckpointError::Other`] for another system, another parameter, scheme or scalar;
    /// [`CheckpointError::Damaged`] for numbers that do not fit.
    pub fn resume<M: Scheme<S, Map<f64> = R>>(
        system: &S,
        scheme: M,
        checkpoint: Checkpoint,
    ) -> Result<Self, Error>
    where
        R: Map<Carried = CarriedBy<M, S>>,
    {
        Self::resume_over(system, scheme, checkpoint)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>> Integrator<T, S, R> {
    /// Resumes a saved run over any scalar, as [`resume`](Integrator::resume) does over `f64`:
    /// `Integrator::<DoubleDouble, _, _>::resume_over(…)`.
    ///
    /// # Errors
    /// Those of [`resume`](Integrator::resume).
    pub fn resume_over<M: Scheme<S, Map<T> = R>>(
        system: &S,
        scheme: M,
        checkpoint: Checkpoint,
    ) -> Result<Self, Error>
    where
        R: Map<Carried = CarriedBy<M, S, T>>,
    {
        let zeros = system.zeros();
        Checkpoint::same(
            "system",
            &checkpoint.system,
            &formula(system.description(), &zeros),
        )?;
        let pieces = system.description().piece_formulas("\n");
        Checkpoint::same("piece", &checkpoint.pieces, &pieces)?;
        let parameters = ParameterText::of_now(system);
        Checkpoint::same("parameter", &checkpoint.parameters, &parameters)?;
        let described = Recipe::<T, S, R>::describe(&scheme);
        Checkpoint::same("scheme", &checkpoint.scheme, &described)?;
        let scalar = core::any::type_name::<T>();
        Checkpoint::same("scalar", &checkpoint.scalar, scalar)?;

        let mut numbers = checkpoint.numbers;
        let start: T = numbers.read_scalar()?;
        let step = numbers.read_scalar()?;
        let template = State {
            t: start,
            q: zeros.clone(),
            p: zeros,
        };
        let mut run = Integrator::begin(system, system.prepare(), scheme, template, step);
        for index in 0..run.carried.len() {
            *run.carried.component_mut(index) = numbers.read_scalar()?;
        }
        let [steps, began, first, flags] = checkpoint.counts;
        if !numbers.is_empty() || began > steps || first > began {
            return Err(CheckpointError::damaged("the numbers do not fit").into());
        }
        let clock = Clock {
            start,
            interval: run.clock.interval,
            first: T::constant(first as f64, 0.0),
        };
        let mut run = run.computed(Arithmetic {
            lanes: flags & SCALAR == 0,
            fused: flags & FUSED != 0,
            ..Arithmetic::default()
        });
        run.restore(clock, began, steps);
        run.ended = flags & ENDED != 0;
        run.memory = checkpoint.observers;
        Ok(run)
    }
}
