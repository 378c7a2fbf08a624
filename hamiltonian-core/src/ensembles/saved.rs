//! Checkpoints of ensembles.
//!
//! Input: an ensemble, or a [`Checkpoint`]. Output: a checkpoint of the ensemble, or the ensemble that continues
//! from it. Invariant: a checkpoint of other members, of another scheme or of another step is refused.

use super::Member;
use super::chunk::Finished;
use super::in_memory::Ensemble;
use super::rounding::{Rounding, Unfused};
use crate::errors::{CheckpointError, Error, SweepError};
use crate::observers::observe::Observer;
use crate::results::checkpoint::{Checkpoint, Memory};
use crate::schemes::scheme::Scheme;
use crate::systems::hash::Hash;
use crate::systems::state::State;
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::fmt::Write;

/// The status of a saved member: it continues, has failed, or was ended by its observer.
const ON: u64 = 0;
const FAILED: u64 = 1;
const ENDED: u64 = 2;

impl<S: System, M: Scheme<S>, O, A: Rounding> Ensemble<S, M, O, A> {
    /// Returns the text of the system and the number of members.
    fn formula(&self) -> String {
        let Description { name, formula, .. } = self.description().unwrap_or(&Description::NONE);
        format!("{name}: {formula} ({} members)", self.len())
    }

    /// Returns the formulas of the pieces.
    fn pieces(&self) -> String {
        let described = self.description();
        described.map_or(String::new(), |system| system.piece_formulas("\n"))
    }

    /// Returns the description of the first member that could start, which is that of all.
    pub(super) fn description(&self) -> Option<&Description> {
        let mut prepared = self
            .chunks
            .iter()
            .filter_map(|chunk| chunk.prepared.first());
        prepared.next().map(Dynamics::description)
    }

    /// Returns a hash of all parameters and of the times at which members start.
    fn members_hash(&self) -> String {
        let mut hash = Hash::new();
        for chunk in &self.chunks {
            // Writing to a hash does not fail.
            let _ = write!(hash, "{:?} {:?}", chunk.prepared, chunk.starts);
        }
        format!("hash of all members: {:016x}", hash.0)
    }
}

impl<S: System, M: Scheme<S>, O: Observer<f64, S>, A: Rounding> Ensemble<S, M, O, A> {
    /// Returns a checkpoint of the ensemble and of the data of its observers, for [`resume`](Ensemble::resume).
    /// [`Checkpoint::save`] writes it to a file.
    pub fn checkpoint(&self) -> Checkpoint {
        let mut numbers = Memory::default();
        numbers.number(self.common.step);
        numbers.count(u64::from(A::FUSES));
        let mut observers = Memory::default();
        for chunk in &self.chunks {
            for word in &chunk.words {
                numbers.number(*word);
            }
            numbers.count(chunk.began.len() as u64);
            for steps in &chunk.began {
                numbers.count(*steps);
            }
            numbers.count(chunk.steps.len() as u64);
            for steps in &chunk.steps {
                numbers.count(*steps);
            }
            for (key, observer) in chunk.observers.iter().enumerate() {
                match chunk.finished.get(&key) {
                    None => numbers.count(ON),
                    Some(Finished::Failed(error, steps)) => {
                        numbers.count(FAILED);
                        numbers.text(&error.to_string());
                        numbers.count(*steps);
                    }
                    Some(Finished::Ended(state, steps)) => {
                        numbers.count(ENDED);
                        numbers.state(state);
                        numbers.count(*steps);
                    }
                }
                if !matches!(chunk.finished.get(&key), Some(Finished::Failed(..))) {
                    observer.save(&mut observers);
                }
            }
        }
        Checkpoint {
            system: self.formula(),
            pieces: self.pieces(),
            parameters: self.members_hash(),
            scheme: self.erased().describe(),
            scalar: core::any::type_name::<f64>().to_owned(),
            counts: [self.common.steps, 0, 0, 0],
            numbers,
            observers,
        }
    }
}

impl<S: System, M: Scheme<S>> Ensemble<S, M> {
    /// Continues a saved ensemble. `make` makes the same systems and starts as before, the step size and the states come
    /// from the checkpoint. The bits are the same on a CPU with the same instructions; on every CPU, if the ensemble was
    /// [`reproducible`](Ensemble::reproducible) and [`resume_reproducible`](Ensemble::resume_reproducible) continues it.
    ///
    /// [`observe`](Ensemble::observe) attaches observers as before, and restores the data that they saved. Call
    /// [`with_threads`](Ensemble::with_threads) again. A member that had failed has the error [`SweepError::Before`]. A
    /// member whose closure returned an error to [`try_new`](Ensemble::try_new) may panic here: both are its failure.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
    /// let mut swarm = Ensemble::new(20, start, ImplicitMidpoint::default(), 0.01)?;
    /// swarm.advance(50);
    /// let saved = swarm.checkpoint().to_bytes();
    /// swarm.advance(50);
    ///
    /// let saved = Checkpoint::from_bytes(&saved)?;
    /// let mut again = Ensemble::resume(20, start, ImplicitMidpoint::default(), saved)?;
    /// again.advance(50);
    /// assert!(again.states().eq(swarm.states()));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`CheckpointError::Other`] if the system, the number of members, a parameter, the time of a start, the scheme or
    /// the rounding differs; [`CheckpointError::Damaged`] if the checkpoint does not have the numbers of these members;
    /// those of [`new`](Ensemble::new). If an observer differs, its member fails with [`CheckpointError::Other`].
    pub fn resume(
        count: usize,
        make: impl FnMut(Member) -> (S, State<VectorOf<S>>),
        scheme: M,
        checkpoint: Checkpoint,
    ) -> Result<Self, Error> {
        let step = checkpoint.numbers.clone().read_number()?;
        Self::new(count, make, scheme, step)?.restored(checkpoint)
    }

    /// Continues a saved [`reproducible`](Ensemble::reproducible) ensemble, as [`resume`](Ensemble::resume) does others.
    ///
    /// # Errors
    /// Those of [`resume`](Ensemble::resume); [`CheckpointError::Other`] if the ensemble was not reproducible.
    pub fn resume_reproducible(
        count: usize,
        make: impl FnMut(Member) -> (S, State<VectorOf<S>>),
        scheme: M,
        checkpoint: Checkpoint,
    ) -> Result<Ensemble<S, M, (), Unfused>, Error> {
        let step = checkpoint.numbers.clone().read_number()?;
        let swarm = Self::new(count, make, scheme, step)?.reproducible();
        swarm.restored(checkpoint)
    }
}

impl<S: System, M: Scheme<S>, A: Rounding> Ensemble<S, M, (), A> {
    /// The saved members in place of those at their starts.
    fn restored(self, checkpoint: Checkpoint) -> Result<Self, Error> {
        let mut swarm = self;
        let mut numbers = checkpoint.numbers;
        numbers.read_number()?;
        let name = |fuses| if fuses { "fused" } else { "unfused" };
        let saved = name(numbers.read_count()? != 0);
        Checkpoint::same("system", &checkpoint.system, &swarm.formula())?;
        Checkpoint::same("piece", &checkpoint.pieces, &swarm.pieces())?;
        Checkpoint::same("parameter", &checkpoint.parameters, &swarm.members_hash())?;
        Checkpoint::same("scheme", &checkpoint.scheme, &swarm.erased().describe())?;
        Checkpoint::same("arithmetic", saved, name(A::FUSES))?;
        swarm.common.steps = checkpoint.counts[0];
        for chunk in &mut swarm.chunks {
            for word in &mut chunk.words {
                *word = numbers.read_number()?;
            }
            for steps in [&mut chunk.began, &mut chunk.steps] {
                *steps = match numbers.read_count()? {
                    0 => Vec::new(),
                    count if count == chunk.count as u64 => {
                        let steps = (0..count).map(|_| numbers.read_count());
                        steps.collect::<Result<_, Error>>()?
                    }
                    _ => return Err(damaged()),
                };
            }
            for key in 0..chunk.count {
                let finished = match (numbers.read_count()?, &swarm.common.template) {
                    (ON, _) => continue,
                    (FAILED, _) => {
                        let message = numbers.read_text()?.into();
                        Finished::Failed(
                            SweepError::Before { message }.into(),
                            numbers.read_count()?,
                        )
                    }
                    (ENDED, Some(template)) => {
                        let state = numbers.read_state(template)?;
                        Finished::Ended(Box::new(state), numbers.read_count()?)
                    }
                    _ => return Err(damaged()),
                };
                // If the start failed again, its error is there already.
                chunk.finished.entry(key).or_insert(finished);
            }
        }
        if !numbers.is_empty() {
            return Err(damaged());
        }
        swarm.memory = checkpoint.observers;
        Ok(swarm)
    }
}

fn damaged() -> Error {
    CheckpointError::damaged("the numbers do not fit").into()
}
