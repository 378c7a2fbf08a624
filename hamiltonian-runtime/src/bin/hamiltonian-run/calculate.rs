//! The run of a file.
//!
//! Input: a [`Study`]. Output: [`Tables`], and the error that ended the run early. Invariant: rows are at t₀ + k·every, never
//! a running sum.

use crate::places::Word;
use crate::study::{Assignment, Number, Stepping, Study};
use hamiltonian_core::schemes::author::{Description, Dynamics};
use hamiltonian_core::{System, Table};
use hamiltonian_runtime::{
    Definition, Diagnostic, FlatState, Run, RunError, RuntimeSystem, Value, Values,
};

/// The results.
pub struct Tables {
    /// t, coordinates, momenta, H, monitors, invariants and events, at the times of rows.
    pub orbit: Table,
    /// The number of each event that is crossed, 1 if its function increases, and the state.
    pub events: Table,
}

/// A coordinate or momentum: its name, the place of its first number, its extents.
struct Group<'a> {
    name: &'a str,
    is_momentum: bool,
    offset: usize,
    rank: usize,
    rows: usize,
    columns: usize,
}

impl Group<'_> {
    /// The place of an element: arrays are stored column after column.
    fn place(&self, row: usize, column: usize) -> usize {
        self.offset + column * self.rows + row
    }

    /// The names of all elements, row after row, with their places.
    fn elements(&self) -> Vec<(String, usize)> {
        let name = self.name;
        let mut all = Vec::new();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let element = match self.rank {
                    0 => name.to_owned(),
                    1 => format!("{name}[{row}]"),
                    _ => format!("{name}[{row}][{column}]"),
                };
                all.push((element, self.place(row, column)));
            }
        }
        all
    }
}

/// The groups of a system: coordinates, then momenta.
fn groups(description: &Description, len: usize) -> Vec<Group<'_>> {
    let groups = &description.groups;
    let ends = groups.iter().skip(1).map(|group| group.offset).chain([len]);
    let both = groups.iter().zip(ends).map(|(group, end)| {
        let columns = group.columns.max(1);
        [(&*group.coordinate, false), (&*group.momentum, true)].map(|(name, is_momentum)| Group {
            name,
            is_momentum,
            offset: group.offset,
            rank: group.rank,
            rows: (end - group.offset) / columns,
            columns,
        })
    });
    let mut all: Vec<Group> = both.flatten().collect();
    all.sort_by_key(|group| group.is_momentum);
    all
}

/// The numbers of a list, row after row.
fn flat(number: &Number, into: &mut Vec<f64>) {
    match number {
        Number::One(number) => into.push(*number),
        Number::List(list) => list.iter().for_each(|one| flat(one, into)),
    }
}

fn system(study: &Study) -> Result<RuntimeSystem, String> {
    let definition = Definition::parse(study.definition, study.file);
    let definition = definition.map_err(|errors| errors.to_string())?;
    let mut values = Values::new();
    for setting in &study.with {
        let value = match &setting.value {
            Number::One(number) => Value::Number(*number),
            list => {
                let mut numbers = Vec::new();
                flat(list, &mut numbers);
                Value::List(numbers)
            }
        };
        values = values.with(setting.name.text, value);
    }
    let place = study.with.first().map_or(study.run, |setting| setting.name);
    let system = definition.system(values);
    system.map_err(|error| {
        let help = "`with` gives parameters and sizes their values: `with l = 2.0, m = [1, 2]`";
        place.error(error.to_string(), help).to_string()
    })
}

/// Writes the value of a group into a state.
fn fill(group: &Group, setting: &Assignment, into: &mut [f64]) -> Result<(), Box<Diagnostic>> {
    let (rows, columns) = (group.rows, group.columns);
    let name = group.name;
    let shape = match group.rank {
        0 => "a number".to_owned(),
        1 => format!("a list of {rows} numbers"),
        _ => format!("a list of {rows} lists of {columns} numbers"),
    };
    let wrong = || {
        let help = "an array is a list, and one with two indices a list of its rows; one number is that of all elements";
        setting
            .word
            .error(format!("`{name}` must be {shape}"), help)
    };
    let rows_of = |list: &'_ [Number]| list.len() == rows;
    match &setting.value {
        Number::One(number) => {
            for row in 0..rows {
                for column in 0..columns {
                    into[group.place(row, column)] = *number;
                }
            }
        }
        Number::List(list) if group.rank == 1 && rows_of(list) => {
            for (row, number) in list.iter().enumerate() {
                let Number::One(number) = number else {
                    return Err(wrong());
                };
                into[group.place(row, 0)] = *number;
            }
        }
        Number::List(list) if group.rank == 2 && rows_of(list) => {
            for (row, numbers) in list.iter().enumerate() {
                let Number::List(numbers) = numbers else {
                    return Err(wrong());
                };
                if numbers.len() != columns {
                    return Err(wrong());
                }
                for (column, number) in numbers.iter().enumerate() {
                    let Number::One(number) = number else {
                        return Err(wrong());
                    };
                    into[group.place(row, column)] = *number;
                }
            }
        }
        Number::List(_) => return Err(wrong()),
    }
    Ok(())
}

/// The start of a run.
fn start(study: &Study, groups: &[Group], len: usize) -> Result<FlatState, Box<Diagnostic>> {
    let known = || {
        let names: Vec<String> = groups
            .iter()
            .map(|group| format!("`{}`", group.name))
            .collect();
        names.join(", ")
    };
    for setting in &study.start {
        if !groups.iter().any(|group| group.name == setting.name.text) {
            let message = format!("there is no coordinate or momentum `{}`", setting.name.text);
            return Err(setting
                .name
                .error(message, format!("there are {}", known())));
        }
    }
    let (mut q, mut p) = (vec![0.0; len], vec![0.0; len]);
    for group in groups {
        let setting = study.start.iter().find(|one| one.name.text == group.name);
        let Some(setting) = setting else {
            let place = study
                .start
                .first()
                .map_or(study.run, |setting| setting.name);
            let message = format!("`{}` has no value at the start", group.name);
            let help = format!("`start` has a value for each of {}", known());
            return Err(place.error(message, help));
        };
        fill(
            group,
            setting,
            if group.is_momentum { &mut p } else { &mut q },
        )?;
    }
    Ok(hamiltonian_core::State::new(q, p).at(study.times.start))
}

fn begin(study: &Study, system: &RuntimeSystem, start: FlatState) -> Result<Run, Box<Diagnostic>> {
    let is_forward = study.times.start < study.times.end;
    let (run, place): (Result<Run, RunError>, Word) = match &study.steps {
        Stepping::Tolerance(tolerance) => (Run::to_tolerance(system, start, *tolerance), study.run),
        Stepping::Scheme(scheme, step) => {
            let step = if is_forward { *step } else { -*step };
            (Run::new(system, scheme.text, start, step), *scheme)
        }
    };
    run.map_err(|error| {
        let help = match error {
            RunError::UnknownScheme { .. } => "`hamiltonian-run --schemes` lists all names",
            _ => "change the start, the step or the scheme",
        };
        place.error(error.to_string(), help)
    })
}

/// Runs a file: the tables up to an error of a step, and that error.
pub fn calculate(study: &Study) -> Result<(Tables, Result<(), String>), String> {
    let system = system(study)?;
    let description = system.description();
    let len = system.degrees_of_freedom();
    let groups = groups(description, len);
    let told = |error: Box<Diagnostic>| error.to_string();
    let start = start(study, &groups, len).map_err(told)?;
    if matches!(study.steps, Stepping::Tolerance(_)) && study.times.end < study.times.start {
        let help = "run backwards with `scheme` and `step`";
        return Err(told(
            study.run.error("a run with a tolerance goes forward", help),
        ));
    }
    let mut run = begin(study, &system, start).map_err(told)?;

    let elements: Vec<(String, usize, bool)> = groups
        .iter()
        .flat_map(|group| {
            let elements = group.elements().into_iter();
            elements.map(|(name, place)| (name, place, group.is_momentum))
        })
        .collect();
    let state = |state: &FlatState, row: &mut Vec<f64>| {
        row.push(state.t);
        for (_, place, is_momentum) in &elements {
            row.push(if *is_momentum {
                state.p[*place]
            } else {
                state.q[*place]
            });
        }
    };
    let names = || elements.iter().map(|(name, ..)| name.clone());
    let time = || std::iter::once("t".to_owned());
    let observables = description.observables.iter();
    let observables = observables.map(|observable| observable.name.to_string());
    let energy = std::iter::once("H".to_owned());
    let columns: Vec<String> = time()
        .chain(names())
        .chain(energy)
        .chain(observables)
        .collect();
    let failed = |error: hamiltonian_core::Error| error.to_string();
    let mut orbit = Table::new(columns).map_err(failed)?;
    let columns = std::iter::once("rising".to_owned())
        .chain(time())
        .chain(names());
    let mut events = Table::with_index("event", columns).map_err(failed)?;

    let prepared = system.prepare::<f64>();
    let length = (study.times.end - study.times.start).abs();
    // A last row that rounding moves behind the end is there.
    let count = (length / study.every * (1.0 + 4.0 * f64::EPSILON)).floor() as u64;
    let every = if study.times.start < study.times.end {
        study.every
    } else {
        -study.every
    };
    let mut ended = Ok(());
    for k in 0..=count {
        let t = study.times.start + k as f64 * every;
        match run.advance_until(t) {
            Ok(at) => {
                let mut row = Vec::with_capacity(orbit.columns().len());
                state(&at, &mut row);
                row.push(prepared.energy(at.t, &at.q, &at.p));
                let number = description.observables.len();
                row.extend((0..number).map(|index| prepared.observable(index, at.t, &at.q, &at.p)));
                orbit.push(&row).map_err(failed)?;
            }
            Err(error) => {
                ended = Err(format!(
                    "error: {error}\nnote: the rows before it are written"
                ));
                break;
            }
        }
    }
    let declared = description.observables.iter();
    let declared =
        declared.filter(|one| one.kind == hamiltonian_core::schemes::author::ObservableKind::Event);
    let declared: Vec<&str> = declared.map(|one| &*one.name).collect();
    for crossing in run.crossings() {
        let number = declared.iter().position(|name| *name == crossing.event);
        let mut row = vec![
            number.unwrap_or_default() as f64,
            f64::from(u8::from(crossing.rising)),
        ];
        state(crossing.state, &mut row);
        events.push(&row).map_err(failed)?;
    }
    Ok((Tables { orbit, events }, ended))
}
