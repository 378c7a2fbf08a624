//! The run of a file.
//!
//! Input: a [`Study`]. Output: [`Tables`], and the error that ended the run early. Invariant: rows are at t₀ + k·every, never
//! a running sum.

use super::places::Word;
use super::study::{Assignment, Number, Stepping, Study};
use crate::names::elements;
use crate::{
    Coordinates, Definition, Diagnostic, FlatState, Run, RunError, RuntimeSystem, Value, Values,
};
use hamiltonian_core::private::declared_energy_at;
use hamiltonian_core::schemes::author::Dynamics;
use hamiltonian_core::{System, Table};

/// The results.
pub(super) struct Tables {
    /// t, coordinates, momenta, H, monitors, invariants and events, at the times of rows.
    pub orbit: Table,
    /// The number of its columns of coordinates.
    pub coordinates: usize,
    /// The number of each event that is crossed, 1 if its function increases, and the state.
    pub events: Table,
}

/// Coordinates, their momenta or their velocities, with their name.
struct Group<'a> {
    name: &'a str,
    is_coordinate: bool,
    of: &'a Coordinates,
}

/// The coordinates, then the momenta, or the velocities of a Lagrangian.
fn groups(all: &[Coordinates], by_velocity: bool) -> Vec<Group<'_>> {
    let coordinates = all.iter().map(|of| Group {
        name: of.name(),
        is_coordinate: true,
        of,
    });
    let others = all.iter().map(|of| Group {
        name: of
            .velocity()
            .filter(|_| by_velocity)
            .unwrap_or(of.momentum()),
        is_coordinate: false,
        of,
    });
    coordinates.chain(others).collect()
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

/// Appends the numbers of a value if it has these extents.
fn shaped(value: &Number, extents: &[usize], into: &mut Vec<f64>) -> bool {
    match (value, extents) {
        (Number::One(number), []) => {
            into.push(*number);
            true
        }
        (Number::List(list), [extent, inner @ ..]) => {
            list.len() == *extent && list.iter().all(|one| shaped(one, inner, into))
        }
        _ => false,
    }
}

/// Writes the value of a group into a state.
fn fill(group: &Group, setting: &Assignment, into: &mut [f64]) -> Result<(), Box<Diagnostic>> {
    let extents = group.of.extents();
    let mut numbers = Vec::new();
    match &setting.value {
        Number::One(number) => numbers.resize(group.of.places().len(), *number),
        list if shaped(list, extents, &mut numbers) => {}
        _ => {
            let shape = match extents {
                [] => "a number".to_owned(),
                [outer @ .., last] => {
                    let lists: String = outer.iter().map(|of| format!("{of} lists of ")).collect();
                    format!("a list of {lists}{last} numbers")
                }
            };
            let message = format!("`{}` must be {shape}", group.name);
            let help = "an array is a list, and one with two indices a list of its rows; one number is that of all elements";
            return Err(setting.word.error(message, help));
        }
    }
    for (place, number) in group.of.places().zip(numbers) {
        into[place] = number;
    }
    Ok(())
}

/// The start of a run, in the variables of the system.
fn start(study: &Study, system: &RuntimeSystem) -> Result<FlatState, Box<Diagnostic>> {
    let declared = system.declared_coordinates();
    let named = |name: &str| study.start.iter().find(|one| one.name.text == name);
    let velocities = declared.iter().filter_map(Coordinates::velocity);
    let by_velocity = velocities.into_iter().any(|name| named(name).is_some());
    let groups = groups(declared, by_velocity);
    // Beside s, the time begins where the start says.
    let has_time = system.description().fictitious_time.is_some();
    let known = || {
        let names = groups.iter().map(|group| format!("`{}`", group.name));
        names.collect::<Vec<_>>().join(", ")
    };
    for setting in &study.start {
        let is_time = has_time && setting.name.text == "t";
        if !is_time && !groups.iter().any(|group| group.name == setting.name.text) {
            let message = format!("there is no coordinate or momentum `{}`", setting.name.text);
            let help = format!("there are {}", known());
            return Err(setting.name.error(message, help));
        }
    }
    let len = declared.iter().map(|of| of.places().len()).sum();
    let (mut q, mut p) = (vec![0.0; len], vec![0.0; len]);
    for group in &groups {
        let Some(setting) = named(group.name) else {
            let first = study.start.first();
            let place = first.map_or(study.run, |setting| setting.name);
            let message = format!("`{}` has no value at the start", group.name);
            let help = format!("`start` has a value for each of {}", known());
            return Err(place.error(message, help));
        };
        fill(
            group,
            setting,
            if group.is_coordinate { &mut q } else { &mut p },
        )?;
    }
    let time = match (has_time, named("t")) {
        (false, _) => study.times.start,
        (true, None) => 0.0,
        (true, Some(setting)) => match setting.value {
            Number::One(time) => time,
            Number::List(_) => {
                return Err(setting.word.error("`t` must be a number", "write `t = 0`"));
            }
        },
    };
    let state = hamiltonian_core::State::new(q, p).at(time);
    let state = match by_velocity {
        true => system.state_from_velocity(&state),
        false => system.from_declared(&state),
    };
    let mut state =
        state.map_err(|error| study.run.error(error.to_string(), "change the start"))?;
    if has_time {
        state.t = study.times.start;
    }
    Ok(state)
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
pub(super) fn calculate(study: &Study) -> Result<(Tables, Result<(), String>), String> {
    let system = system(study)?;
    let description = system.description();
    let told = |error: Box<Diagnostic>| error.to_string();
    let clock = description.clock();
    if study.clock.text != clock {
        let message = format!("the time of this run is `{clock}`");
        let help = format!("write `run {clock} = 0..100`");
        return Err(told(study.clock.error(message, help)));
    }
    let start = start(study, &system).map_err(told)?;
    if matches!(study.steps, Stepping::Tolerance(_)) && study.times.end < study.times.start {
        let help = "run backwards with `scheme` and `step`";
        return Err(told(
            study.run.error("a run with a tolerance goes forward", help),
        ));
    }
    let mut run = begin(study, &system, start).map_err(told)?;

    let groups = groups(system.coordinates(), false);
    let elements = groups.iter().flat_map(|group| {
        let elements = elements(group.name, group.of).into_iter();
        elements.map(|(name, place)| (name, place, group.is_coordinate))
    });
    let elements: Vec<(String, usize, bool)> = elements.collect();
    let state = |state: &FlatState, row: &mut Vec<f64>| {
        row.push(state.t);
        for (_, place, is_coordinate) in &elements {
            let side = if *is_coordinate { &state.q } else { &state.p };
            row.push(side[*place]);
        }
    };
    let names = || elements.iter().map(|(name, ..)| name.clone());
    let time = || std::iter::once(clock.to_owned());
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
                let (t, q, p) = (at.t, &at.q, &at.p);
                row.push(declared_energy_at::<f64, RuntimeSystem>(&prepared, t, q, p));
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
    let coordinates = elements.iter().filter(|(.., is_coordinate)| *is_coordinate);
    let tables = Tables {
        coordinates: coordinates.count(),
        orbit,
        events,
    };
    Ok((tables, ended))
}
