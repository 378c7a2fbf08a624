//! Trajectories as tables.
//!
//! Input: states of a run. Output: [`Recorder`], rows of numbers under the declared names, and
//! CSV. Invariant: a row is t, coordinates, momenta, observables, each in declaration order, a
//! group of rank 2 body by body.

use crate::checkpoint::{Checkpoint, Memory};
use crate::error::Error;
use crate::observe::{Observer, View};
use crate::system::{Group, System, clock};
use crate::vector::Vector;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::ControlFlow;
use hamiltonian_lanes::Real;

/// Records t, coordinates, momenta, observables and on request H, rounded to `f64`.
///
/// Columns have the declared names: `t`, then `q`, `q[3]` or `q[3][1]` for each coordinate, the
/// momenta likewise, then the observables, then `H`. In another time, `dt = g*ds`, the first column is
/// `s`, t is the last coordinate, and `H` is the declared one. Where a variable has the name `t` or `s`,
/// the first column is `t_2` or `s_2`.
///
/// ```
#[doc = include_str!("doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, Recorder, State, every, schemes::StormerVerlet};
///
/// let mut run = Integrator::new(&Oscillator, StormerVerlet::default(), State::new([1.0], [0.0]), 0.5)?
///     .observe(every(2, Recorder::with_capacity(3)));
/// run.advance(4)?;
/// let recorder = &run.observer().inner;
/// assert_eq!(recorder.columns(), ["t", "q", "p"]);
/// assert_eq!(recorder.column("t").unwrap().collect::<Vec<_>>(), [0.0, 1.0, 2.0]);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Recorder {
    capacity: usize,
    columns: Vec<String>,
    /// For each coordinate of a row, its flat index.
    order: Vec<usize>,
    energy: bool,
    values: Vec<f64>,
}

impl Recorder {
    /// A recorder that grows as it records.
    pub fn new() -> Self {
        Recorder::default()
    }

    /// A recorder with room for so many rows, which it takes when it is attached.
    pub fn with_capacity(rows: usize) -> Self {
        Recorder {
            capacity: rows,
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

    /// The names of the columns; none before it is attached.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.values
            .len()
            .checked_div(self.columns.len())
            .unwrap_or(0)
    }

    /// Row `index`, in the order of [`Recorder::columns`].
    pub fn row(&self, index: usize) -> Option<&[f64]> {
        self.values
            .chunks_exact(self.columns.len().max(1))
            .nth(index)
    }

    /// All rows, in the order of time.
    pub fn iter(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.columns.len().max(1))
    }

    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<impl Iterator<Item = f64>> {
        let index = self.columns.iter().position(|column| column == name)?;
        Some(self.iter().map(move |row| row[index]))
    }

    /// Writes a header and the rows as comma-separated values, each number in the fewest digits
    /// that read back to the same bits.
    ///
    /// # Errors
    /// Those of the writer.
    #[cfg(feature = "std")]
    pub fn write_csv(&self, mut to: impl std::io::Write) -> std::io::Result<()> {
        // A name has a comma in it in no case: names are identifiers and indices.
        writeln!(to, "{}", self.columns.join(","))?;
        for row in self.iter() {
            for (index, value) in row.iter().enumerate() {
                let comma = if index == 0 { "" } else { "," };
                write!(to, "{comma}{value:?}")?;
            }
            writeln!(to)?;
        }
        to.flush()
    }
}

impl<T: Real, S: System<T>> Observer<T, S> for Recorder {
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        let names = names(S::GROUPS, &view.state.q);
        self.order = names.iter().map(|name| name.index).collect();
        self.columns = Vec::with_capacity(2 + 2 * names.len() + S::OBSERVABLES.len());
        self.columns
            .extend(names.iter().map(|name| name.of(name.group.coordinate)));
        self.columns
            .extend(names.iter().map(|name| name.of(name.group.momentum)));
        self.columns.extend(
            S::OBSERVABLES
                .iter()
                .map(|observable| observable.name.to_string()),
        );
        let time = clock::<T, S>();
        let mut free = time.to_string();
        for number in 2.. {
            if !self.columns.contains(&free) {
                break;
            }
            free = format!("{time}_{number}");
        }
        self.columns.insert(0, free);
        if self.energy {
            self.columns.push("H".to_string());
        }
        self.values = Vec::with_capacity(self.capacity.saturating_mul(self.columns.len()));
        <Self as Observer<T, S>>::observe(self, view)
    }

    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        self.values.push(view.state.t.to_f64());
        self.values.extend(
            self.order
                .iter()
                .map(|i| view.state.q.component(*i).to_f64()),
        );
        self.values.extend(
            self.order
                .iter()
                .map(|i| view.state.p.component(*i).to_f64()),
        );
        self.values
            .extend((0..S::OBSERVABLES.len()).map(|i| view.observable(i).to_f64()));
        if self.energy {
            self.values.push(view.energy().to_f64());
        }
        ControlFlow::Continue(())
    }

    fn save(&self, to: &mut Memory) {
        to.begin("Recorder");
        to.count(u64::from(self.energy));
        to.count(self.columns.len() as u64);
        for column in &self.columns {
            to.text(column);
        }
        to.count(self.order.len() as u64);
        for index in &self.order {
            to.count(*index as u64);
        }
        to.count(self.values.len() as u64);
        for value in &self.values {
            to.number(*value);
        }
    }

    fn restore(&mut self, _: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("Recorder")?;
        let column = |energy| if energy { "H" } else { "none" };
        let saved = column(from.read_count()? != 0);
        Checkpoint::same("column of the energy", saved, column(self.energy))?;
        self.columns = from.read_list(Memory::read_text)?;
        self.order = from.read_list(|from| Ok(from.read_count()? as usize))?;
        self.values = from.read_list(Memory::read_number)?;
        Ok(())
    }
}

/// One component of a group.
pub(crate) struct Name {
    pub(crate) group: Group,
    row: usize,
    column: usize,
    /// Its flat index in the [`Vector`].
    pub(crate) index: usize,
}

impl Name {
    /// The component of the coordinate or momentum of that name.
    pub(crate) fn of(&self, name: &str) -> String {
        element(name, self.group.rank, self.row, self.column)
    }
}

/// The name of an element of an array of that rank: `m`, `m[2]`, `K[0][1]`.
pub(crate) fn element(name: &str, rank: usize, row: usize, column: usize) -> String {
    match rank {
        0 => name.to_string(),
        1 => format!("{name}[{row}]"),
        _ => format!("{name}[{row}][{column}]"),
    }
}

/// The components of all groups in declaration order; `vector` tells run-time sizes.
pub(crate) fn names<V: Vector>(groups: &[Group], vector: &V) -> Vec<Name> {
    let mut names = Vec::with_capacity(vector.len());
    for group in groups {
        let before: usize = (0..group.part).map(|k| vector.part(k).len()).sum();
        let len = vector.part(group.part).len();
        // A scalar group is one component of its part; the part of another group is all its own.
        let rows = if group.rank == 0 {
            1
        } else {
            (len - group.offset) / group.columns
        };
        for row in 0..rows {
            for column in 0..group.columns {
                let index = before + group.offset + row + rows * column;
                names.push(Name {
                    group: *group,
                    row,
                    column,
                    index,
                });
            }
        }
    }
    names
}
