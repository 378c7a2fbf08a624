//! Sweeps whose scheme and columns have names.
//!
//! Input: systems, starts, the name of a scheme, names of columns. Output: a Zarr store. Invariant: it is core's `Sweep`
//! without fused products, so a row has the bits of a single [`Run`](crate::Run), and a store continues where it ended.

use crate::error::RunError;
use crate::many::Many;
use crate::names::elements;
use crate::prepared::Flat;
use crate::schemes::many;
use crate::swarm::Starts;
use crate::system::RuntimeSystem;
use hamiltonian_core::observers::{EnergyDrift, Every, every};
use hamiltonian_core::results::Completeness;
use hamiltonian_core::{End, Error, Member, State, Sweep, System};
use std::fmt::{self, Debug, Formatter};
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// The quantity in a column.
#[derive(Debug, Clone, PartialEq)]
enum Column {
    Time,
    Q(usize),
    P(usize),
    Energy,
    /// The largest relative change of H since the start, at the whole steps.
    Drift,
    Observable(String),
}

/// Members of one definition that run to an end, each with a row of numbers in a Zarr store.
///
/// | column | number |
/// |---|---|
/// | a coordinate or momentum, such as `x` or `q[0][2]` | its value |
/// | `t` | the time |
/// | `H` | the declared H |
/// | `drift` | max ǀH − H₀ǀ/ǀH₀ǀ over the steps |
/// | a monitor, an invariant or an event | its value |
///
/// ```
/// use hamiltonian_runtime::{Definition, NamedSweep, Values};
///
/// let spring = [Definition::parse("H(x; p) = p^2/2 + x^2/2", "spring.txt")?.system(Values::new())?];
/// let path = std::env::temp_dir().join("example-named-sweep.zarr");
/// # let _ = std::fs::remove_dir_all(&path);
/// let q: Vec<f64> = (0..100).map(f64::from).collect();
/// let sweep = NamedSweep::new(&spring, "BlanesMoan4", &q, &[0.0; 100], 0.0, 0.1)
///     .record(["x", "drift"])
///     .with_end(20.0);
/// assert!(sweep.store(&path)?.is_complete());
/// # std::fs::remove_dir_all(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct NamedSweep<'a> {
    scheme: String,
    starts: Starts<'a>,
    step: f64,
    end: Option<f64>,
    times: Option<Vec<f64>>,
    columns: Vec<String>,
    threads: Option<usize>,
    cancel: Option<&'a AtomicBool>,
    progress: Option<Box<dyn Fn(usize, usize) + Send + Sync + 'a>>,
}

impl<'a> NamedSweep<'a> {
    /// Describes a sweep of the scheme of this name, over members as those of [`Swarm::new`](crate::Swarm::new). It still
    /// needs columns, and an end or times.
    #[must_use]
    pub fn new(
        systems: &'a [RuntimeSystem],
        scheme: &str,
        q: &'a [f64],
        p: &'a [f64],
        t: f64,
        step: f64,
    ) -> Self {
        NamedSweep {
            scheme: scheme.to_owned(),
            starts: Starts { systems, q, p, t },
            step,
            end: None,
            times: None,
            columns: Vec::new(),
            threads: None,
            cancel: None,
            progress: None,
        }
    }

    /// Sets the columns.
    #[must_use]
    pub fn record<N: Into<String>>(mut self, columns: impl IntoIterator<Item = N>) -> Self {
        self.columns = columns.into_iter().map(Into::into).collect();
        self
    }

    /// Sets the time at which members end, which need not be a whole number of steps away.
    #[must_use]
    pub fn with_end(mut self, t: f64) -> Self {
        self.end = Some(t);
        self
    }

    /// Records a row at each of these times, in the direction of the run, instead of one at the end. The columns of the store
    /// then have a second dimension, `t`.
    #[must_use]
    pub fn at(mut self, times: impl IntoIterator<Item = f64>) -> Self {
        self.times = Some(times.into_iter().collect());
        self
    }

    /// Sets the number of threads (0 counts as 1); by default as many as the machine runs at once.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Stops with [`SweepError::Cancelled`](hamiltonian_core::errors::SweepError::Cancelled) once the flag is set. Chunks that
    /// are done stay in the store.
    #[must_use]
    pub fn with_cancel(mut self, flag: &'a AtomicBool) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Calls a closure after each chunk of members with the number of finished members and the number of all.
    #[must_use]
    pub fn with_progress(mut self, closure: impl Fn(usize, usize) + Send + Sync + 'a) -> Self {
        self.progress = Some(Box::new(closure));
        self
    }

    /// Runs the members that are missing in the store at `path`, and writes each chunk when it is done; see
    /// [`Sweep::store`].
    ///
    /// # Errors
    /// [`RunError::UnknownColumn`], [`RunError::UnknownScheme`], [`RunError::SingleRuns`], [`RunError::Length`], and those of
    /// [`Sweep::store`].
    pub fn store(self, path: impl AsRef<Path>) -> Result<Completeness, RunError> {
        self.store_at(path.as_ref())
    }

    /// The same without a type parameter, so that this crate compiles all sweeps, and not each crate that calls it.
    fn store_at(self, path: &Path) -> Result<Completeness, RunError> {
        let count = self.starts.count()?;
        let columns = columns(&self.starts.systems[0], &self.columns)?;
        let scheme = many(&self.scheme)?;
        let store = StoreSweep {
            sweep: self,
            count,
            columns,
            path,
        };
        Ok(store.run(scheme)?)
    }
}

impl Debug for NamedSweep<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("NamedSweep")
            .field("scheme", &self.scheme)
            .field("step", &self.step)
            .field("end", &self.end)
            .field("times", &self.times)
            .field("columns", &self.columns)
            .finish_non_exhaustive()
    }
}

/// The quantities of these names.
fn columns(system: &RuntimeSystem, names: &[String]) -> Result<Vec<Column>, RunError> {
    let mut known = vec![
        ("t".to_owned(), Column::Time),
        ("H".to_owned(), Column::Energy),
        ("drift".to_owned(), Column::Drift),
    ];
    for of in system.coordinates() {
        let of_q = elements(of.name(), of).into_iter();
        known.extend(of_q.map(|(name, place)| (name, Column::Q(place))));
        let of_p = elements(of.momentum(), of).into_iter();
        known.extend(of_p.map(|(name, place)| (name, Column::P(place))));
    }
    let observables = system.description().observables.iter();
    known.extend(observables.map(|one| {
        (
            one.name.to_string(),
            Column::Observable(one.name.to_string()),
        )
    }));
    let found = |name: &String| {
        // A name that the definition declares comes before a name that every system has.
        let column = known.iter().rev().find(|(known, _)| known == name);
        column
            .map(|(_, column)| column.clone())
            .ok_or_else(|| RunError::UnknownColumn {
                name: name.clone(),
                known: known.iter().map(|(name, _)| name.clone()).collect(),
            })
    };
    names.iter().map(found).collect()
}

/// A sweep before its scheme is known.
struct StoreSweep<'a, 'p> {
    sweep: NamedSweep<'a>,
    count: usize,
    columns: Vec<Column>,
    path: &'p Path,
}

impl StoreSweep<'_, '_> {
    fn run(self, scheme: Many) -> Result<Completeness, Error> {
        let StoreSweep {
            sweep,
            count,
            columns,
            path,
        } = self;
        let starts = sweep.starts;
        let make = move |member: Member| starts.member(member.index);
        // One type of observer: an interval that no run reaches observes nothing.
        let interval = if columns.contains(&Column::Drift) {
            1
        } else {
            u64::MAX
        };
        let observer = move |_| every(interval, EnergyDrift::new());
        let number = move |column: &Column, end: &End<'_, RuntimeSystem, Every<EnergyDrift>>| {
            let State { t, q, p }: &State<Flat<f64>> = end.state;
            match column {
                Column::Time => *t,
                Column::Q(place) => q[*place],
                Column::P(place) => p[*place],
                Column::Energy => end.energy(),
                Column::Drift => end.observer.inner().max_relative(),
                Column::Observable(name) => end.observable_named(name).unwrap_or(f64::NAN),
            }
        };
        let mut all = Sweep::new(count, make, scheme, sweep.step)
            .observe(observer)
            .reproducible();
        if let Some(end) = sweep.end {
            all = all.with_end(end);
        }
        if let Some(threads) = sweep.threads {
            all = all.with_threads(threads);
        }
        if let Some(flag) = sweep.cancel {
            all = all.with_cancel(flag);
        }
        if let Some(closure) = sweep.progress {
            all = all.with_progress(closure);
        }
        let record = move |end: &End<'_, RuntimeSystem, Every<EnergyDrift>>,
                           numbers: &mut Vec<f64>| {
            numbers.extend(columns.iter().map(|column| number(column, end)));
        };
        all.record_columns(&sweep.columns, sweep.times, record)
            .store(path)
    }
}
