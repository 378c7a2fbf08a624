//! Saved runs.
//!
//! Input: a run. Output: a [`Checkpoint`], and a file. Invariants: a run that continues from a
//! checkpoint has the bits of the uninterrupted run; a file contains its origin and a checksum, and
//! is written atomically.
//!
//! # The file
//! `HAMILTON`, the version of the format, then words of eight bytes, little-endian: texts (their length
//! in bytes, then the bytes, padded with zeros), counts, and floating-point numbers by their bits. The
//! last word is a checksum of all before it.

use crate::errors::{CheckpointError, Error};
use crate::systems::state::State;
use crate::systems::vector::Vector;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// The state of a run and of its observers at one step.
///
/// [`Integrator::checkpoint`](crate::Integrator::checkpoint) makes one,
/// [`Integrator::resume`](crate::Integrator::resume) goes on from it. With the feature `serde` it is written as the bytes of
/// its file.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let scheme = StormerVerlet::default();
/// let mut run = Integrator::new(&Oscillator {}, scheme, State::new([1.0], [0.0]), 0.01)?
///     .observe(EnergyDrift::new());
/// run.advance(50)?;
/// let saved = run.checkpoint().to_bytes();
/// run.advance(50)?;
///
/// let mut again = Integrator::resume(&Oscillator {}, scheme, Checkpoint::from_bytes(&saved)?)?
///     .observe(EnergyDrift::new());
/// again.advance(50)?;
/// assert_eq!(again.state(), run.state());
/// assert_eq!(again.observer(), run.observer());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    /// The text of H and the shape of its coordinates.
    pub(crate) system: String,
    /// The formulas of the pieces in their order, each on a line.
    pub(crate) pieces: String,
    /// Names and values of the parameters.
    pub(crate) parameters: String,
    /// The scheme with its choices.
    pub(crate) scheme: String,
    /// The type of the numbers.
    pub(crate) scalar: String,
    /// Steps, the step at which the scheme started, the number of steps between the start of the clock and that step, and
    /// flags: ended by an observer (1), fused (2), without lanes (4).
    pub(crate) counts: [u64; 4],
    /// The time at which the clock began, the step, then all that is carried.
    pub(crate) numbers: Memory,
    /// The memory of the observers, in their order.
    pub(crate) observers: Memory,
}

const MAGIC: &[u8; 8] = b"HAMILTON";
/// Version 2: implicit schemes add their stages in another order, sums of 32 terms or more are
/// trees, sums over the pairs of 4096 points or more are computed in tiles, a run has flags for its
/// arithmetic, and matrices among the parameters are written row after row. Version 3: the state of a run may have been
/// changed. Version 4: the formulas of the pieces are apart from that of H, in their order. Version 5: parameters of an H with
/// loops may be multiplied in another order, a part of a Gauss step begins at the polynomial of the step, and each member of
/// an ensemble has a count of steps. Version 6: `ImplicitMidpoint` and `Gauss` compute forces from new velocities if H is separable.
/// Version 7: runs to a tolerance compare H at the ends of steps where it may jump, and add up their time scale in another order.
/// Version 8: they compare the ends of all steps, and find the time scale from other forces.
const VERSION: u64 = 8;

impl Checkpoint {
    /// The number of steps made.
    pub fn steps(&self) -> u64 {
        self.counts[0]
    }

    /// Returns the bytes of the file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut memory = Memory::default();
        let Checkpoint {
            system,
            pieces,
            parameters,
            scheme,
            scalar,
            ..
        } = self;
        for text in [system, pieces, parameters, scheme, scalar] {
            memory.text(text);
        }
        for count in self.counts {
            memory.count(count);
        }
        for part in [&self.numbers, &self.observers] {
            memory.count(part.words.len() as u64);
            memory.words.extend(&part.words);
        }
        let mut bytes = Vec::with_capacity(8 * (memory.words.len() + 3));
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        for word in &memory.words {
            bytes.extend(word.to_le_bytes());
        }
        let checksum = checksum(&bytes);
        bytes.extend(checksum.to_le_bytes());
        bytes
    }

    /// Reads a checkpoint from the bytes of a file.
    ///
    /// # Errors
    /// [`CheckpointError::Foreign`], [`CheckpointError::Newer`], [`CheckpointError::Older`],
    /// [`CheckpointError::Damaged`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let damaged = |reason: &str| Error::from(CheckpointError::damaged(reason));
        let Some(rest) = bytes.strip_prefix(MAGIC) else {
            return Err(CheckpointError::Foreign.into());
        };
        let words = |bytes: &[u8]| -> Vec<u64> {
            let words = bytes.as_chunks::<8>().0;
            words.iter().map(|word| u64::from_le_bytes(*word)).collect()
        };
        let words = words(rest);
        let (Some(version), true) = (words.first(), bytes.len().is_multiple_of(8)) else {
            return Err(damaged("it is cut off"));
        };
        if *version > VERSION {
            return Err(CheckpointError::Newer {
                version: *version,
                readable: VERSION,
            }
            .into());
        }
        if *version < VERSION {
            return Err(CheckpointError::Older {
                version: *version,
                readable: VERSION,
            }
            .into());
        }
        let Some((last, content)) = words[1..].split_last() else {
            return Err(damaged("it is cut off"));
        };
        if checksum(&bytes[..bytes.len() - 8]) != *last {
            return Err(damaged("its checksum is wrong"));
        }
        let mut memory = Memory {
            words: content.to_vec(),
            read: 0,
        };
        let from = &mut memory;
        let checkpoint = Checkpoint {
            system: from.read_text()?,
            pieces: from.read_text()?,
            parameters: from.read_text()?,
            scheme: from.read_text()?,
            scalar: from.read_text()?,
            counts: [
                from.read_count()?,
                from.read_count()?,
                from.read_count()?,
                from.read_count()?,
            ],
            numbers: from.read_memory()?,
            observers: from.read_memory()?,
        };
        match memory.is_empty() {
            true => Ok(checkpoint),
            false => Err(damaged("it is too long")),
        }
    }

    /// Writes the file: first under another name, then renamed, so that at any moment either the
    /// old or the new file exists, complete. A process that is killed while it writes leaves the
    /// temporary file, `….<number of the process>.part`, which may be deleted.
    ///
    /// # Errors
    /// [`CheckpointError::File`].
    #[cfg(feature = "std")]
    pub fn save(&self, path: impl AsRef<std::path::Path>) -> Result<(), Error> {
        use std::io::Write;
        let path = path.as_ref();
        let mut beside = path.as_os_str().to_owned();
        beside.push(alloc::format!(".{}.part", std::process::id()));
        let write = || -> std::io::Result<()> {
            let mut file = std::fs::File::create(&beside)?;
            file.write_all(&self.to_bytes())?;
            file.sync_all()?;
            drop(file);
            std::fs::rename(&beside, path)
        };
        write().map_err(|error| {
            // The temporary file is of no use. An error of its removal would add nothing to this
            // error.
            let _ = std::fs::remove_file(&beside);
            file_error(path, &error)
        })
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`CheckpointError::File`], those of [`from_bytes`](Checkpoint::from_bytes).
    #[cfg(feature = "std")]
    pub fn load(path: impl AsRef<std::path::Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|error| file_error(path, &error))?;
        Checkpoint::from_bytes(&bytes)
    }

    /// Returns an error if a part differs from that of the resuming program, with the first lines
    /// that differ.
    pub(crate) fn same(what: &'static str, saved: &str, given: &str) -> Result<(), Error> {
        let Some((saved, given)) = differing(saved, given) else {
            return Ok(());
        };
        Err(CheckpointError::Other {
            what: what.into(),
            saved: saved.into(),
            given: given.into(),
        }
        .into())
    }
}

/// The first line that differs, of each text; `None` if they are equal.
pub(crate) fn differing<'a>(saved: &'a str, given: &'a str) -> Option<(&'a str, &'a str)> {
    let (mut saved, mut given) = (saved.lines(), given.lines());
    loop {
        match (saved.next(), given.next()) {
            (None, None) => return None,
            (one, other) if one == other => {}
            (one, other) => return Some((one.unwrap_or("nothing"), other.unwrap_or("nothing"))),
        }
    }
}

#[cfg(feature = "std")]
fn file_error(path: &std::path::Path, error: &std::io::Error) -> Error {
    use alloc::string::ToString;
    CheckpointError::File {
        path: path.display().to_string().into(),
        message: error.to_string().into(),
    }
    .into()
}

/// FNV-1a of 64 bits (G. Fowler, L. C. Noll, K.-P. Vo, 1991).
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// Numbers and texts one after the other: the memory of observers is written to it and read from it
/// in the same order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Memory {
    words: Vec<u64>,
    read: usize,
}

impl Memory {
    /// Begins the data of one observer, with the name of its type.
    pub fn begin(&mut self, name: &str) {
        self.text(name);
    }

    /// Reads that name.
    ///
    /// # Errors
    /// [`CheckpointError::Other`] if it is another one, or if no further observer was saved.
    pub fn expect(&mut self, name: &str) -> Result<(), Error> {
        // If nothing is left, fewer observers were saved.
        match self.is_empty() {
            true => Checkpoint::same("observer", "", name),
            false => self.expect_text("observer", name),
        }
    }

    /// Refuses data that no observer has read: a saved observer is missing.
    pub(crate) fn refuse_rest(&self) -> Result<(), Error> {
        if self.is_empty() {
            return Ok(());
        }
        let name = self.clone().read_text()?;
        let saved = if name.is_empty() { "a closure" } else { &name };
        Checkpoint::same("observer", saved, "")
    }

    /// Reads a text that must be `given`.
    ///
    /// # Errors
    /// [`CheckpointError::Other`] with `what` if it is another one.
    pub(crate) fn expect_text(&mut self, what: &'static str, given: &str) -> Result<(), Error> {
        let saved = self.read_text()?;
        Checkpoint::same(what, &saved, given)
    }

    /// Reads a count that must be `given`.
    ///
    /// # Errors
    /// [`CheckpointError::Other`] with `name` if it is another one.
    pub(crate) fn expect_count(&mut self, name: &'static str, given: usize) -> Result<(), Error> {
        let saved = self.read_count()?;
        Checkpoint::same(name, &saved.to_string(), &given.to_string())
    }

    /// Returns true if all was read.
    pub fn is_empty(&self) -> bool {
        self.read == self.words.len()
    }

    /// Writes a count.
    pub fn count(&mut self, count: u64) {
        self.words.push(count);
    }

    /// Writes a number, by its bits.
    pub fn number(&mut self, number: f64) {
        self.words.push(number.to_bits());
    }

    /// Writes a scalar, word by word.
    pub fn scalar<T: Real>(&mut self, scalar: T) {
        scalar.write_words(&mut |word| self.number(word));
    }

    /// Writes a state.
    pub fn state<V: Vector>(&mut self, state: &State<V>) {
        self.scalar(state.t);
        for component in state.q.components().chain(state.p.components()) {
            self.scalar(component);
        }
    }

    /// Writes a state, if there is one, after a flag.
    pub(crate) fn option<V: Vector>(&mut self, state: Option<&State<V>>) {
        self.count(u64::from(state.is_some()));
        state.into_iter().for_each(|state| self.state(state));
    }

    /// Writes a text.
    pub fn text(&mut self, text: &str) {
        self.count(text.len() as u64);
        for chunk in text.as_bytes().chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.words.push(u64::from_le_bytes(word));
        }
    }

    /// Reads a count.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] where nothing is left.
    pub fn read_count(&mut self) -> Result<u64, Error> {
        let word = self.words.get(self.read).copied();
        self.read += usize::from(word.is_some());
        word.ok_or_else(|| CheckpointError::damaged("it is too short").into())
    }

    /// Reads a number.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] where nothing is left.
    pub fn read_number(&mut self) -> Result<f64, Error> {
        Ok(f64::from_bits(self.read_count()?))
    }

    /// Reads a scalar.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] where nothing is left.
    pub fn read_scalar<T: Real>(&mut self) -> Result<T, Error> {
        let mut outcome = Ok(());
        let scalar = T::read_words(&mut || match self.read_number() {
            Ok(word) => word,
            Err(error) => {
                outcome = Err(error);
                0.0
            }
        });
        outcome.map(|()| scalar)
    }

    /// Reads a state of the shape of another.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] where nothing is left.
    pub fn read_state<V: Vector>(&mut self, like: &State<V>) -> Result<State<V>, Error> {
        let mut state = like.clone();
        state.t = self.read_scalar()?;
        for vector in [&mut state.q, &mut state.p] {
            for index in 0..vector.len() {
                *vector.component_mut(index) = self.read_scalar()?;
            }
        }
        Ok(state)
    }

    /// Reads a state, if there is one.
    pub(crate) fn read_option<V: Vector>(
        &mut self,
        like: &State<V>,
    ) -> Result<Option<State<V>>, Error> {
        match self.read_count()? {
            0 => Ok(None),
            _ => self.read_state(like).map(Some),
        }
    }

    /// Reads an index below `len`.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] if it is not below.
    pub(crate) fn read_index(&mut self, len: usize) -> Result<usize, Error> {
        let index = usize::try_from(self.read_count()?).ok();
        let damaged = || CheckpointError::damaged("an index is out of range").into();
        (index.filter(|index| *index < len)).ok_or_else(damaged)
    }

    /// Reads a text.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] where there is none.
    pub fn read_text(&mut self) -> Result<String, Error> {
        let damaged = || Error::from(CheckpointError::damaged("a text is not one"));
        let length = self.read_count()?;
        let left = 8 * (self.words.len() - self.read) as u64;
        if length > left {
            return Err(damaged());
        }
        let mut bytes = Vec::with_capacity(length as usize);
        while (bytes.len() as u64) < length {
            bytes.extend(self.read_count()?.to_le_bytes());
        }
        bytes.truncate(length as usize);
        String::from_utf8(bytes).map_err(|_| damaged())
    }

    /// Reads a count and as many elements.
    ///
    /// # Errors
    /// Those of reading an element.
    pub fn read_list<U>(
        &mut self,
        mut element: impl FnMut(&mut Self) -> Result<U, Error>,
    ) -> Result<Vec<U>, Error> {
        let count = self.read_count()?;
        (0..count).map(|_| element(self)).collect()
    }

    fn read_memory(&mut self) -> Result<Memory, Error> {
        Ok(Memory {
            words: self.read_list(Memory::read_count)?,
            read: 0,
        })
    }
}
