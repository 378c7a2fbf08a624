//! Trajectories as tables.
//!
//! Input: states of a run. Output: [`Recorder`], a [`Table`] under the declared names. Invariant: a
//! row is t, coordinates, momenta, observables, each in declaration order, a group of rank 2 body by
//! body, or the columns selected, in their order.

use crate::errors::{Error, TableError};
use crate::observers::observe::{Observer, View, one_trajectory};
use crate::results::checkpoint::{Checkpoint, Memory};
use crate::results::table::{Table, wrapped};
use crate::systems::lattice;
use crate::systems::state::State;
use crate::systems::system::{Description, Dynamics, Group, System, VectorOf};
use crate::systems::uneven::named;
use crate::systems::vector::Vector;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::{ControlFlow, Deref};
use hamiltonian_lanes::Real;

/// Records t, coordinates, momenta, observables and, on request, H, rounded to `f64`.
///
/// Columns have the declared names: `t`, then `q`, `q[3]` or `q[3][1]` for each coordinate, the
/// momenta likewise, then the observables, then `H`. [`Recorder::of`] selects some of them. In another
/// time, `dt = g*ds`, the first column is `s`, t is the last coordinate, and `H` is the declared one. If
/// a variable has the name `t` or `s`, the first column is `t_2` or `s_2`.
///
/// A recorder is read as its [`Table`], which also writes files:
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), State::new([1.0], [0.0]), 0.5)?
///     .observe(every(2, Recorder::with_capacity(3)));
/// run.advance(4)?;
/// let recorder = run.observer().inner();
/// assert_eq!(recorder.columns(), ["t", "q", "p"]);
/// assert_eq!(recorder.column("t").unwrap().collect::<Vec<_>>(), [0.0, 1.0, 2.0]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Recorder {
    capacity: usize,
    /// The columns selected; all if there is no selection.
    selected: Option<Vec<String>>,
    /// The columns whose angles are wrapped.
    angles: Vec<String>,
    energy: bool,
    /// The source of each column.
    sources: Vec<Source>,
    table: Table,
    failure: Option<Error>,
}

/// The source of a column, and whether its values are angles to be wrapped.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Source {
    value: Value,
    angle: bool,
}

/// A number of a state; components by their flat index.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Value {
    Time,
    Coordinate(usize),
    Momentum(usize),
    Observable(usize),
    Energy,
}

impl Recorder {
    /// Creates a recorder of all columns that grows as it records.
    pub fn new() -> Self {
        Recorder::default()
    }

    /// Creates a recorder with capacity for `rows` rows, allocated when it is attached.
    pub fn with_capacity(rows: usize) -> Self {
        Recorder {
            capacity: rows,
            ..Recorder::default()
        }
    }

    /// Creates a recorder of the columns of these names, in this order: `t`, `H`, coordinates, momenta
    /// and observables. The name of an array selects all its elements. If there is no such column, the
    /// run returns [`TableError::Unknown`] at its first step.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = || State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start(), 0.5)?
    ///     .observe(Recorder::of(["H", "q"]));
    /// run.advance(1)?;
    /// assert_eq!(run.observer().row(0), Some(&[0.5, 1.0][..]));
    ///
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start(), 0.5)?
    ///     .observe(Recorder::of(["Q"]));
    /// let error = run.advance(1).unwrap_err();
    /// assert_eq!(error.to_string(), "there is no column `Q`\nhelp: did you mean `q`?");
    /// # Ok::<(), Error>(())
    /// ```
    pub fn of<N: Into<String>>(columns: impl IntoIterator<Item = N>) -> Self {
        Recorder {
            selected: Some(columns.into_iter().map(Into::into).collect()),
            ..Recorder::default()
        }
    }

    /// The same recorder with a column `H`.
    #[must_use]
    pub fn with_energy(self) -> Self {
        Recorder {
            energy: true,
            ..self
        }
    }

    /// The same recorder with the angles of a column, or of all elements of an array, wrapped into
    /// (−π, π]. If it records no such column, the run returns [`TableError::Unknown`].
    #[must_use]
    pub fn with_wrapped(mut self, column: impl Into<String>) -> Self {
        self.angles.push(column.into());
        self
    }

    /// The table recorded.
    pub fn into_table(self) -> Table {
        self.table
    }

    /// The table without rows and the sources of its columns.
    fn layout<V: Vector>(
        &self,
        system: &Description,
        q: &V,
    ) -> Result<(Table, Vec<Source>), Error> {
        let mut all = all_columns(system, q);
        let energy = ("H".to_string(), Value::Energy);
        let chosen: Vec<(String, Value)> = match &self.selected {
            None => {
                all.extend(self.energy.then_some(energy));
                all
            }
            Some(selected) => {
                // A variable `H` would stand before the energy, as it does in a full table.
                all.push(energy);
                let names: Vec<String> = all.iter().map(|(name, _)| name.clone()).collect();
                let mut chosen = Vec::new();
                for name in selected {
                    for at in columns_of(name, &names)? {
                        chosen.push(all[at].clone());
                    }
                }
                if self.energy && !chosen.iter().any(|(_, value)| *value == Value::Energy) {
                    chosen.extend(all.pop());
                }
                chosen
            }
        };
        let (names, values): (Vec<String>, Vec<Value>) = chosen.into_iter().unzip();
        let mut sources: Vec<Source> = (values.into_iter())
            .map(|value| Source {
                value,
                angle: false,
            })
            .collect();
        for name in &self.angles {
            for at in columns_of(name, &names)? {
                sources[at].angle = true;
            }
        }
        Ok((Table::new(names)?, sources))
    }
}

/// The places of the column of that name, or of all elements of the array of that name.
fn columns_of(name: &str, known: &[String]) -> Result<Vec<usize>, Error> {
    let position =
        |is: &dyn Fn(&String) -> bool| (0..known.len()).filter(|at| is(&known[*at])).collect();
    let mut places: Vec<usize> = position(&|column| column == name);
    places.truncate(1);
    if places.is_empty() {
        let element =
            |column: &String| (column.strip_prefix(name)).is_some_and(|rest| rest.starts_with('['));
        places = position(&element);
    }
    match places.is_empty() {
        true => Err(TableError::unknown(name, known).into()),
        false => Ok(places),
    }
}

/// All columns but H with their sources: time, coordinates, momenta, observables.
fn all_columns<V: Vector>(system: &Description, q: &V) -> Vec<(String, Value)> {
    let names = names(&system.groups, q);
    let mut all = Vec::with_capacity(2 + 2 * names.len() + system.observables.len());
    for name in &names {
        all.push((
            name.of(&name.group.coordinate),
            Value::Coordinate(name.index),
        ));
    }
    for name in &names {
        all.push((name.of(&name.group.momentum), Value::Momentum(name.index)));
    }
    for (index, observable) in system.observables.iter().enumerate() {
        all.push((observable.name.to_string(), Value::Observable(index)));
    }
    let time = system.clock();
    let mut free = time.to_string();
    for number in 2.. {
        if all.iter().all(|(name, _)| *name != free) {
            break;
        }
        free = format!("{time}_{number}");
    }
    all.insert(0, (free, Value::Time));
    all
}

impl Deref for Recorder {
    type Target = Table;

    /// The table, without columns before the recorder is attached.
    fn deref(&self) -> &Table {
        &self.table
    }
}

impl<T: Real, S: System> Observer<T, S> for Recorder {
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        one_trajectory::<T>();
        match self.layout(view.prepared.description(), &view.state.q) {
            Ok((table, sources)) => (self.table, self.sources) = (table, sources),
            Err(error) => {
                self.failure = Some(error);
                return ControlFlow::Break(());
            }
        }
        self.failure = None;
        self.table.reserve(self.capacity);
        <Self as Observer<T, S>>::observe(self, view)
    }

    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        for source in &self.sources {
            let value = match source.value {
                Value::Time => view.state.t,
                Value::Coordinate(index) => view.state.q.component(index),
                Value::Momentum(index) => view.state.p.component(index),
                Value::Observable(index) => view.observable(index),
                Value::Energy => view.energy(),
            };
            let value = value.to_f64();
            self.table
                .push_value(if source.angle { wrapped(value) } else { value });
        }
        ControlFlow::Continue(())
    }

    fn save(&self, to: &mut Memory) {
        to.begin("Recorder");
        to.text(&described(&self.table, &self.sources));
        to.count(self.table.values().len() as u64);
        for value in self.table.values() {
            to.number(*value);
        }
    }

    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("Recorder")?;
        (self.table, self.sources) = self.layout(view.prepared.description(), &view.state.q)?;
        let saved = from.read_text()?;
        // An observer at given times attaches it later.
        if !saved.is_empty() {
            let given = described(&self.table, &self.sources);
            Checkpoint::same("list of columns", &saved, &given)?;
        }
        self.table.set_values(from.read_list(Memory::read_number)?);
        Ok(())
    }

    fn end(&self) -> Result<Option<&State<VectorOf<S, T>>>, Error> {
        self.failure.clone().map_or(Ok(None), Err)
    }
}

/// The columns on one line, which identify a saved recorder.
fn described(table: &Table, sources: &[Source]) -> String {
    let mut text = String::new();
    for (name, source) in table.columns().iter().zip(sources) {
        let comma = if text.is_empty() { "" } else { ", " };
        let angle = if source.angle { " (wrapped)" } else { "" };
        text.push_str(&format!("{comma}{name}{angle}"));
    }
    text
}

/// One component of a group.
pub(crate) struct Name<'a> {
    pub(crate) group: &'a Group,
    /// Its indices, each in brackets.
    indices: String,
    /// Its flat index in the [`Vector`].
    pub(crate) index: usize,
}

impl Name<'_> {
    /// The component of the coordinate or momentum of that name.
    pub(crate) fn of(&self, name: &str) -> String {
        format!("{name}{}", self.indices)
    }
}

/// The components of all groups in declaration order; `vector` tells run-time sizes.
pub(crate) fn names<'a, V: Vector>(groups: &'a [Group], vector: &V) -> Vec<Name<'a>> {
    let mut names = Vec::with_capacity(vector.len());
    for group in groups {
        let before: usize = (0..group.part).map(|k| vector.part(k).len()).sum();
        let len = vector.part(group.part).len();
        // A scalar group is one component of its part; another group reaches to the next one of its part.
        let behind = groups.iter().filter(|next| next.part == group.part);
        let behind = behind
            .map(|next| next.offset)
            .filter(|next| *next > group.offset);
        let rows = if group.rank == 0 {
            1
        } else {
            (behind.min().unwrap_or(len) - group.offset) / group.columns
        };
        let extents = vector.extents(group.part);
        if !extents.is_empty() {
            for number in 0..len {
                names.push(Name {
                    group,
                    indices: lattice::element("", extents, number),
                    index: before + number,
                });
            }
            continue;
        }
        for row in 0..rows {
            for column in 0..group.columns {
                let index = before + group.offset + row + rows * column;
                names.push(Name {
                    group,
                    indices: named("", &[row, column][..group.rank]),
                    index,
                });
            }
        }
    }
    names
}
