//! A part of the work of a sweep.
//!
//! Input: two numbers, or the variables that a launcher sets. Output: [`Shard`], part k of n.
//! Invariant: 0 ≤ k < n. Variables that contradict each other are an error, never part 0: two processes
//! with the same part would do the same work, and one without a part all of it.

use crate::errors::{Error, ShardError};
use alloc::format;
use alloc::string::String;
use core::fmt;
use core::num::NonZeroU64;
use core::str::FromStr;

/// Part `index` of `count` equal parts of a sweep.
///
/// A sweep is divided by chunks: this part has the chunks c with c mod count = index. Processes
/// need no connection.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// let shard = Shard::new(1, 3)?;
/// assert_eq!((0..8).filter(|chunk| shard.has(*chunk)).collect::<Vec<_>>(), [1, 4, 7]);
/// assert_eq!("1/3".parse::<Shard>()?, shard);
/// assert_eq!(
///     Shard::new(2, 2).unwrap_err().to_string(),
///     "shard 2/2 does not exist\nhelp: shards of 2 are 0/2 to 1/2",
/// );
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Shard {
    index: u64,
    count: NonZeroU64,
}

impl Shard {
    /// The whole, 0/1.
    pub const WHOLE: Shard = Shard {
        index: 0,
        count: NonZeroU64::MIN,
    };

    /// Part `index`, counted from 0, of `count`.
    ///
    /// # Errors
    /// [`ShardError::Range`] unless `index < count`.
    #[inline]
    pub fn new(index: u64, count: u64) -> Result<Self, Error> {
        Ok(Self::of(index, count, None)?)
    }

    #[inline]
    fn of(index: u64, count: u64, variable: Option<&'static str>) -> Result<Self, ShardError> {
        match NonZeroU64::new(count) {
            Some(count) if index < count.get() => Ok(Shard { index, count }),
            _ => Err(ShardError::Range {
                shard: index,
                shards: count,
                variable: variable.map(Into::into),
            }),
        }
    }

    /// The part that the environment names, by the first of these sources with a variable that is
    /// set.
    ///
    /// | launcher | variables | part |
    /// |---|---|---|
    /// | any | `HAMILTONIAN_SHARD` = k/n | k/n |
    /// | Open MPI | `OMPI_COMM_WORLD_RANK`, `OMPI_COMM_WORLD_SIZE` | RANK/SIZE |
    /// | MPICH, Intel MPI, PMI | `PMI_RANK`, `PMI_SIZE` | RANK/SIZE |
    /// | Slurm, job array | `SLURM_ARRAY_TASK_ID`, `_MIN`, `_STEP`, `_COUNT` | (ID − MIN)/STEP of COUNT |
    /// | Slurm, tasks of `srun` | `SLURM_STEP_ID`, `SLURM_PROCID`, `SLURM_NTASKS` | PROCID/NTASKS |
    /// | HyperQueue | `HQ_TASK_ID`, `HAMILTONIAN_SHARDS` | ID/SHARDS |
    /// | none | none set | 0/1 |
    ///
    /// `SLURM_PROCID` alone does not name a part, because a batch script has it too. A program that
    /// is started by several launchers at once, for example by `mpirun` in each task of an array,
    /// takes `HAMILTONIAN_SHARD`.
    ///
    /// # Errors
    /// [`ShardError`] if a variable of the source is missing or has another form, if its numbers
    /// contradict each other, or if the part does not exist.
    #[cfg(feature = "std")]
    #[inline]
    pub fn from_env() -> Result<Self, Error> {
        // A value that is not Unicode has none of the forms, and must not count as unset.
        Self::from_lookup(|name| {
            std::env::var_os(name).map(|value| value.to_string_lossy().into_owned())
        })
    }

    /// [`Shard::from_env`] on other variables: `lookup` returns the value of a name.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// let set = [("PMI_RANK", "3"), ("PMI_SIZE", "8")];
    /// let lookup = |name: &str| set.iter().find(|(n, _)| *n == name).map(|(_, v)| v.to_string());
    /// assert_eq!(Shard::from_lookup(lookup)?.to_string(), "3/8");
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Shard::from_env`].
    pub fn from_lookup(lookup: impl Fn(&str) -> Option<String>) -> Result<Self, Error> {
        Ok(first_source(&Variables(&lookup))?)
    }

    /// The number of the part, counted from 0.
    #[inline]
    pub fn index(&self) -> u64 {
        self.index
    }

    /// The number of parts.
    #[inline]
    pub fn count(&self) -> u64 {
        self.count.get()
    }

    /// Returns true if a chunk belongs to this part.
    #[inline]
    pub fn has(&self, chunk: u64) -> bool {
        chunk % self.count == self.index
    }
}

impl Default for Shard {
    #[inline]
    fn default() -> Self {
        Shard::WHOLE
    }
}

/// `k/n`.
impl fmt::Display for Shard {
    #[inline]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

/// Reads `k/n`.
impl FromStr for Shard {
    type Err = Error;

    #[inline]
    fn from_str(text: &str) -> Result<Self, Error> {
        Ok(parsed(text, None)?)
    }
}

/// The part `k/n`.
#[inline]
fn parsed(text: &str, variable: Option<&'static str>) -> Result<Shard, ShardError> {
    let (index, count) = (text.split_once('/'))
        .and_then(|(index, count)| Some((whole(index)?, whole(count)?)))
        .ok_or_else(|| ShardError::Form {
            variable: variable.map(Into::into),
            text: text.into(),
            form: "`k/n`, for example `0/4`".into(),
        })?;
    Shard::of(index, count, variable)
}

/// Reads a number of decimal digits: `u64::from_str` would accept a sign.
#[inline]
fn whole(text: &str) -> Option<u64> {
    let digits = text.bytes().all(|byte| byte.is_ascii_digit());
    digits.then(|| text.parse().ok()).flatten()
}

/// The environment.
struct Variables<'a>(&'a dyn Fn(&str) -> Option<String>);

impl Variables<'_> {
    #[inline]
    fn text(&self, name: &str) -> Option<String> {
        (self.0)(name)
    }

    /// A number; `None` if it is not set.
    #[inline]
    fn number(&self, name: &'static str) -> Result<Option<u64>, ShardError> {
        let Some(text) = self.text(name) else {
            return Ok(None);
        };
        match whole(&text) {
            Some(number) => Ok(Some(number)),
            None => Err(ShardError::Form {
                variable: Some(name.into()),
                text: text.into(),
                form: "a number of decimal digits".into(),
            }),
        }
    }

    /// The number that a variable must have because another one is set.
    #[inline]
    fn besides(&self, name: &'static str, variable: &'static str) -> Result<u64, ShardError> {
        self.number(name)?.ok_or_else(|| ShardError::Missing {
            present: variable.into(),
            missing: name.into(),
            remedy: "start the program by its launcher, or set `HAMILTONIAN_SHARD=k/n`".into(),
        })
    }

    /// Both numbers of a source; `None` if neither is set.
    #[inline]
    fn pair(&self, rank: &'static str, size: &'static str) -> Result<Option<Shard>, ShardError> {
        match (self.text(rank), self.text(size)) {
            (None, None) => Ok(None),
            (Some(_), _) => {
                let size = self.besides(size, rank)?;
                let index = self.besides(rank, rank)?;
                Shard::of(index, size, Some(rank)).map(Some)
            }
            (None, Some(_)) => self.besides(rank, size).map(|_| None),
        }
    }
}

#[inline]
fn first_source(env: &Variables<'_>) -> Result<Shard, ShardError> {
    const GIVEN: &str = "HAMILTONIAN_SHARD";
    if let Some(text) = env.text(GIVEN) {
        return parsed(&text, Some(GIVEN));
    }
    let ranks = [
        ("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
        ("PMI_RANK", "PMI_SIZE"),
    ];
    for (rank, size) in ranks {
        if let Some(shard) = env.pair(rank, size)? {
            return Ok(shard);
        }
    }
    for source in [slurm_array, slurm_step, hyperqueue] {
        if let Some(shard) = source(env)? {
            return Ok(shard);
        }
    }
    Ok(Shard::WHOLE)
}

/// The task of a job array of Slurm: (ID − MIN)/STEP of COUNT.
#[inline]
fn slurm_array(env: &Variables<'_>) -> Result<Option<Shard>, ShardError> {
    const ID: &str = "SLURM_ARRAY_TASK_ID";
    const MIN: &str = "SLURM_ARRAY_TASK_MIN";
    const MAX: &str = "SLURM_ARRAY_TASK_MAX";
    const STEP: &str = "SLURM_ARRAY_TASK_STEP";
    const COUNT: &str = "SLURM_ARRAY_TASK_COUNT";
    let Some(id) = env.number(ID)? else {
        return Ok(None);
    };
    let min = env.besides(MIN, ID)?;
    let step = env.besides(STEP, ID)?;
    let count = env.besides(COUNT, ID)?;
    let contradiction = |one: (&str, u64), other: (&str, u64), reason: &str| {
        Err(ShardError::Contradiction {
            one: format!("{}={}", one.0, one.1).into(),
            other: format!("{}={}", other.0, other.1).into(),
            reason: reason.into(),
        })
    };
    if id < min {
        return contradiction((ID, id), (MIN, min), "a task lies before the first");
    }
    if step == 0 || !(id - min).is_multiple_of(step) {
        return contradiction(
            (ID, id),
            (STEP, step),
            "no whole number of steps lead there",
        );
    }
    // An array such as 1,2,5 has no equal steps; all its tasks detect this from the last one.
    if let Some(max) = env.number(MAX)? {
        let tasks = max.checked_sub(min).map(|range| range / step + 1);
        if tasks != Some(count) {
            let reason = "the tasks are not evenly spaced";
            return contradiction((MAX, max), (COUNT, count), reason);
        }
    }
    Shard::of((id - min) / step, count, Some(ID)).map(Some)
}

/// A task of `srun`; only these have a step.
#[inline]
fn slurm_step(env: &Variables<'_>) -> Result<Option<Shard>, ShardError> {
    /// Steps from here on are those of batch scripts and shells, in which one process runs
    /// (`SLURM_INTERACTIVE_STEP` and above in slurm.h).
    const NO_TASKS: u64 = 0xffff_fff0;
    const STEP: &str = "SLURM_STEP_ID";
    const NTASKS: &str = "SLURM_NTASKS";
    const OF_STEP: &str = "SLURM_STEP_NUM_TASKS";
    let Some(step) = env.number(STEP)? else {
        return Ok(None);
    };
    if step >= NO_TASKS {
        return Ok(None);
    }
    let index = env.besides("SLURM_PROCID", STEP)?;
    let (tasks, of_step) = (env.number(NTASKS)?, env.number(OF_STEP)?);
    if let (Some(tasks), Some(of_step)) = (tasks, of_step)
        && tasks != of_step
    {
        return Err(ShardError::Contradiction {
            one: format!("{NTASKS}={tasks}").into(),
            other: format!("{OF_STEP}={of_step}").into(),
            reason: "a step has one number of tasks".into(),
        });
    }
    let count = match of_step {
        Some(count) => count,
        None => env.besides(NTASKS, STEP)?,
    };
    Shard::of(index, count, Some("SLURM_PROCID")).map(Some)
}

/// A task of HyperQueue; the user sets the number of tasks.
#[inline]
fn hyperqueue(env: &Variables<'_>) -> Result<Option<Shard>, ShardError> {
    const ID: &str = "HQ_TASK_ID";
    const SHARDS: &str = "HAMILTONIAN_SHARDS";
    let missing = |present: &str, missing: &str, remedy: &str| {
        Err(ShardError::Missing {
            present: present.into(),
            missing: missing.into(),
            remedy: remedy.into(),
        })
    };
    match (env.number(ID)?, env.number(SHARDS)?) {
        (None, None) => Ok(None),
        (Some(id), Some(count)) => Shard::of(id, count, Some(ID)).map(Some),
        (Some(_), None) => {
            let remedy = "submit with `--array 0-{n-1} --env HAMILTONIAN_SHARDS=n`";
            missing(ID, SHARDS, remedy)
        }
        (None, Some(_)) => {
            let remedy = "set `HAMILTONIAN_SHARD=k/n` outside of HyperQueue";
            missing(SHARDS, ID, remedy)
        }
    }
}
