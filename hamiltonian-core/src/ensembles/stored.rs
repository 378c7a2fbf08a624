//! Sweeps on disk.
//!
//! Input: a sweep and a path. Output: a [`Store`] with the chunks of the sweep's shard. Invariant: a chunk
//! that is present was written by the same sweep, from the same members.

use super::Member;
use super::guard::guard;
use super::record::{Batch, Record, Status};
use super::rounding::Rounding;
use super::sweep::{EndPoint, Sweep};
use crate::errors::Error;
use crate::observers::observe::Observer;
use crate::results::store::{Attribute, ChunkData, Completeness, Layout, Rows, Store};
use crate::schemes::scheme::Scheme;
use crate::systems::hash::{Hash, hash_of};
use crate::systems::system::{Description, System};
use alloc::format;
use alloc::string::ToString;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};
use hamiltonian_lanes::Cpu;
use std::path::Path;

impl<'a, S, M, O, A> Sweep<'a, S, M, O, Record<'a, S, O>, A>
where
    S: System,
    M: Scheme<S>,
    A: Rounding,
    O: Observer<f64, S>,
{
    /// Runs the chunks of this shard that are missing in the store at `path`, writes each when it is done, and returns the
    /// chunks that are still missing, for example those of other shards.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let path = std::env::temp_dir().join("example-sweep.zarr");
    /// # let _ = std::fs::remove_dir_all(&path);
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
    /// let left = Sweep::new(100, start, ImplicitMidpoint::default(), 0.01)
    ///     .with_steps(10)
    ///     .with_shard(Shard::from_env()?)
    ///     .record(["q"], |end| [end.state.q[0]])
    ///     .store(&path)?;
    /// assert!(left.is_complete());
    /// # std::fs::remove_dir_all(path)?;
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// The store is a Zarr v3 directory, which zarr-python and xarray open, and [`Store`] reads. It is created if there is
    /// none. A sweep that was killed continues with the first missing chunk. Processes with different shards write to
    /// one store without coordination.
    ///
    /// The store has one array per column. Further arrays have each member's `status` (see [`Status`]), the `time` of
    /// its end and its number of `steps`. With [`record_at`](Sweep::record_at), columns have a second dimension `t`.
    /// With [`record_rows`](Sweep::record_rows), each chunk has a group with its rows and the `member` of each row.
    ///
    /// Unless the sweep is [`reproducible`](Sweep::reproducible), all chunks of a store must be computed on CPUs with the
    /// same instructions.
    ///
    /// # Errors
    /// [`SweepError::NoMembers`](crate::errors::SweepError::NoMembers),
    /// [`SweepError::NoEnd`](crate::errors::SweepError::NoEnd),
    /// [`SweepError::Cancelled`](crate::errors::SweepError::Cancelled); [`StoreError`](crate::errors::StoreError) if
    /// the store belongs to another sweep or to other members, and if a file cannot be written.
    pub fn store(&self, path: impl AsRef<Path>) -> Result<Completeness, Error> {
        self.check()?;
        let store = Store::open_or_create(path, &self.layout())?;
        let missing = self.missing(&store)?;
        if !missing.is_empty() {
            self.each_batch(missing, true, |batch| {
                let chunk = (batch.first / self.chunk_size()) as u64;
                store.write(chunk, &self.data(&batch))?;
                Ok(ControlFlow::Continue(()))
            })?;
        }
        store.completeness()
    }

    /// Finds the chunks of the whole sweep that are missing in the store at `path`, without running any.
    ///
    /// If there is no store, none is created. For each chunk of this shard that is present, the first member is made
    /// again and compared with the stored hash.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let path = std::env::temp_dir().join("example-complete.zarr");
    /// # let _ = std::fs::remove_dir_all(&path);
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
    /// let sweep = Sweep::new(100, start, ImplicitMidpoint::default(), 0.01)
    ///     .with_steps(10)
    ///     .with_chunk(50)
    ///     .record(["q"], |end| [end.state.q[0]]);
    /// assert_eq!(sweep.completeness(&path)?.to_string(), "2 of 2 chunks are missing: 0 to 1");
    /// sweep.store(&path)?;
    /// assert!(sweep.completeness(&path)?.is_complete());
    /// # std::fs::remove_dir_all(path)?;
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`store`](Sweep::store), except errors of writing.
    pub fn completeness(&self, path: impl AsRef<Path>) -> Result<Completeness, Error> {
        self.check()?;
        let layout = self.layout();
        let Some(store) = Store::open(path, &layout)? else {
            return Ok(Completeness {
                chunks: layout.chunks(),
                missing: core::iter::once(0..layout.chunks()).collect(),
            });
        };
        self.missing(&store)?;
        store.completeness()
    }

    /// Returns the members of the missing chunks of this shard, and checks the chunks that are present.
    fn missing(&self, store: &Store) -> Result<Vec<Range<usize>>, Error> {
        let mut missing = Vec::new();
        for members in self.chunks() {
            let chunk = (members.start / self.chunk_size()) as u64;
            if !store.present(chunk)? {
                missing.push(members);
            } else {
                store.check_first(chunk, self.hash(members.start))?;
            }
        }
        Ok(missing)
    }

    /// Makes a member again and returns its hash; 0 if it cannot be made.
    pub(crate) fn hash(&self, index: usize) -> u64 {
        let member = Member::new(index, self.seed);
        let made = guard(|| {
            let step = self
                .step_each
                .as_ref()
                .map_or(self.step, |each| each(member));
            (self.make)(member).map(|(system, start)| hash_of(&system, &start, step))
        });
        made.and_then(|hash| hash).unwrap_or(0)
    }

    /// The layout of the store.
    fn layout(&self) -> Layout {
        let record = &self.record;
        let rows = match (&record.times, record.several) {
            (Some(times), _) => Rows::At {
                name: "t".to_string(),
                values: times.clone(),
            },
            (None, true) => Rows::Any,
            (None, false) => Rows::One,
        };
        let end: Attribute = match (&record.times, &self.end) {
            (Some(_), _) => "at the last time".into(),
            (None, EndPoint::Steps(n)) => format!("{n} steps").into(),
            (None, EndPoint::Until(t)) => (*t).into(),
            (None, EndPoint::Each(_)) => "of each member".into(),
            (None, EndPoint::Unknown) => "none".into(),
        };
        let step: Attribute = match self.step_each {
            Some(_) => "of each member".into(),
            None => self.step.into(),
        };
        let arithmetic = if A::FUSES { "fused" } else { "unfused" };
        // Without fused products, all levels give the same bits.
        let level = match A::FUSES {
            true => format!("{:?}", Cpu::best()),
            false => "any".to_string(),
        };
        // The name, and the fields of the scheme if they say more.
        let described = self.erased().describe();
        let mut described: Vec<&str> = described.lines().collect();
        described.dedup();
        let system = self.first_system();
        let system = system
            .as_ref()
            .map_or(&Description::NONE, System::description);
        let mut attributes = vec![
            ("system".to_string(), (*system.name).into()),
            ("hamiltonian".to_string(), (*system.formula).into()),
            ("pieces".to_string(), system.piece_formulas("; ").into()),
            ("scheme".to_string(), described.join(": ").into()),
            ("step".to_string(), step),
            ("end".to_string(), end),
            ("seed".to_string(), self.seed.into()),
            ("arithmetic".to_string(), arithmetic.into()),
            ("level".to_string(), level.into()),
            ("version".to_string(), env!("CARGO_PKG_VERSION").into()),
        ];
        // A store of members that are changed otherwise is not continued.
        if let Some((n, _)) = &self.each {
            attributes.push(("changes".to_string(), format!("every {n} steps").into()));
        }
        let failures = ["start", "not_finite", "unsolved", "panicked", "failed"];
        Layout {
            rows,
            chunk: self.chunk_size() as u64,
            failures: failures.map(str::to_string).into(),
            attributes,
            ..Layout::new(self.count as u64, record.columns.iter().map(String::as_str))
        }
    }

    /// The arrays of a chunk.
    fn data(&self, batch: &Batch) -> ChunkData {
        let record = &self.record;
        let rows = record.times.as_ref().map_or(1, Vec::len);
        let mut data = ChunkData {
            columns: vec![Vec::new(); record.columns.len()],
            ..ChunkData::default()
        };
        let columns = record.columns.len().max(1);
        let mut all = Hash::new();
        for (k, outcome) in batch.outcomes.iter().enumerate() {
            let values = &batch.values[outcome.values.clone()];
            let any = record.several && record.times.is_none();
            for row in values.chunks_exact(columns) {
                for (column, value) in data.columns.iter_mut().zip(row) {
                    column.push(*value);
                }
                if any {
                    data.member.push((batch.first + k) as u64);
                }
            }
            if !any {
                // Rows of a member that did not reach its end are missing.
                for column in &mut data.columns {
                    column.resize((k + 1) * rows, f64::NAN);
                }
            }
            data.status.push(outcome.status as u8);
            data.time.push(outcome.time);
            data.steps.push(outcome.steps);
            all.word(outcome.hash);
        }
        let first = batch.outcomes.first().map_or(0, |outcome| outcome.hash);
        data.hashes = [first, all.0];
        data
    }
}

// The names of failures are those of `Status`.
const _: () = assert!(Status::Start as u8 == 3 && Status::Failed as u8 == 7);
