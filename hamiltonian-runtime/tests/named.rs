//! Runs whose scheme has a name: the table of schemes, errors, events, saved runs, cancellation.
//!
//! Input: definitions as text. Output: a panic with what differs. Invariant: no scheme is compiled here.

use crate::allocator::allocations;
use hamiltonian::prelude::State;
use hamiltonian::schemes::author::{Needs, catalogue};
use hamiltonian_runtime::{
    Definition, NamedSweep, Run, RunError, RuntimeSystem, Swarm, Values, schemes,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn made(text: &str) -> RuntimeSystem {
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let system = definition.system(Values::new());
    system.unwrap_or_else(|error| panic!("{error}"))
}

fn spring() -> RuntimeSystem {
    made("H(q; p) = p^2/2 + q^2/2; event node = q")
}

fn start() -> hamiltonian_runtime::FlatState {
    State::new(vec![1.0], vec![0.0])
}

/// A plain name, without the number of stages.
fn plain(name: &str) -> String {
    let name = name.replace(' ', "");
    name.trim_end_matches(|sign: char| sign.is_ascii_digit())
        .to_owned()
}

#[test]
fn every_scheme_of_the_catalogue_has_a_name() {
    let names: Vec<String> = schemes().map(|scheme| scheme.name).collect();
    for entry in catalogue() {
        // Its systems have another type.
        if entry.name == "TransformedVerlet" {
            continue;
        }
        let has_stages = ["Gauss", "GaussNystrom", "MomentumVariational"].contains(&entry.name);
        let due = match has_stages {
            true => plain(entry.name),
            false => entry.to_string().replace(' ', ""),
        };
        let has = names
            .iter()
            .any(|name| *name == due || has_stages && plain(name) == due);
        assert!(has, "{due} of {names:?}");
    }
    let mut sorted = names.clone();
    sorted.sort();
    sorted.dedup();
    assert_eq!(sorted.len(), names.len(), "two schemes have one name");
}

/// The names of the table in the README are there, and in ensembles those that it says.
#[test]
fn the_table_of_the_readme_is_true() {
    let mut rows = 0;
    for line in include_str!("../README.md").lines() {
        let cells: Vec<&str> = line.split('|').collect();
        let [_, _, examples, in_swarms @ (" yes " | " no "), _] = cells[..] else {
            continue;
        };
        rows += 1;
        for name in examples.split('`').skip(1).step_by(2) {
            let found = schemes()
                .find(|scheme| scheme.name == name || scheme.name.split('(').next() == Some(name));
            let found = found.unwrap_or_else(|| panic!("there is no `{name}`"));
            assert_eq!(found.in_ensembles, in_swarms == " yes ", "{name}");
        }
    }
    assert_eq!(rows, 8);
}

/// Every scheme is right to its order on a spring: one step of half the size has an error smaller by about 2^(order + 1).
#[test]
fn every_scheme_runs_and_follows_the_orbit() {
    let spring = spring();
    for scheme in schemes() {
        let step = 0.02 / f64::from(scheme.entry.duration);
        let mut run = Run::new(&spring, &scheme.name, start(), step)
            .unwrap_or_else(|error| panic!("{}: {error}", scheme.name));
        run.advance_to(2.0)
            .unwrap_or_else(|error| panic!("{}: {error}", scheme.name));
        let error = (run.q()[0] - 2.0_f64.cos()).abs();
        let due = match scheme.entry.order {
            1 => 3e-2,
            2 => 1e-3,
            3 => 1e-5,
            4 => 1e-5,
            _ => 1e-9,
        };
        assert!(error < due, "{}: {error:e}", scheme.name);
        assert_eq!(run.entry(), scheme.entry);
        assert_eq!(run.crossings().count(), 1, "{}", scheme.name);
    }
}

/// Code without loops, and with them. A block may allocate when a scheme enters its lanes, its steps may not.
#[test]
fn steps_allocate_nothing() {
    let chain = "struct Chain { n: usize }
        H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 - cos(q[i]) + (q[(i + 1) % n] - q[i])^2/2 }";
    let chain = Definition::parse(chain, "text")
        .unwrap()
        .system([("n", 40)])
        .unwrap();
    for (system, n) in [(made("H(q; p) = p^2/2 - cos(q)"), 1), (chain, 40)] {
        let begin = |scheme: &str| {
            let start = State::new(vec![0.5; n], vec![0.1; n]);
            let mut run = Run::new(&system, scheme, start, 0.01).unwrap();
            run.advance(20).unwrap();
            run
        };
        assert!(allocations(|| drop(begin("Strang"))) > 0);
        let splittings = ["StormerVerlet", "BlanesMoan6", "Srkn11b", "Processed6"];
        for scheme in
            splittings
                .into_iter()
                .chain(["RungeKutta4", "Tao", "Gauss8", "GaussNystrom8"])
        {
            let mut run = begin(scheme);
            let made = [20, 60].map(|steps| allocations(|| run.advance(steps).unwrap()));
            assert_eq!(made[0], made[1], "{scheme} with {n} coordinates");
            if splittings.contains(&scheme) {
                assert_eq!(made, [0, 0], "{scheme} with {n} coordinates");
            }
        }
    }
}

#[test]
fn names_are_found_and_wrong_ones_refused() {
    let spring = spring();
    for name in [
        "Gauss8",
        "Gauss::<8>",
        "Gauss<8>",
        "StormerVerlet (drift-kick-drift)",
        "Pihajoki",
    ] {
        assert!(Run::new(&spring, name, start(), 0.1).is_ok(), "{name}");
    }
    let refused = |name: &str| {
        Run::new(&spring, name, start(), 0.1)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        refused("gauss8"),
        "there is no scheme `gauss8`: the nearest name is `Gauss8`"
    );
    assert_eq!(
        refused("Gauss7"),
        "there is no scheme `Gauss7`: the nearest name is `Gauss2`"
    );
    assert_eq!(
        refused("leapfrog"),
        "there is no scheme `leapfrog`: `schemes()` lists all, for example `StormerVerlet` and `Gauss8`"
    );
}

#[test]
fn a_scheme_that_does_not_fit_has_the_text_of_the_compile_error() {
    let coupled = made("H(q; p) = (q^2 + 1)*(p^2 + 1)/2");
    let error = Run::new(&coupled, "Yoshida6", start(), 0.1);
    assert!(error.is_ok(), "it splits");
    let error = Run::new(&coupled, "StormerVerlet", start(), 0.1).unwrap_err();
    let text = "H is not separable: the term `0.5*q^2*p^2` couples q and p; `StormerVerlet` needs H = T(p) + V(q): ";
    assert!(error.to_string().starts_with(text), "{error}");
    let of_swarm = |scheme| {
        let coupled = std::slice::from_ref(&coupled);
        Swarm::new(coupled, scheme, &[1.0, 2.0], &[0.0; 2], 0.0, 0.1).unwrap_err()
    };
    assert_eq!(of_swarm("StormerVerlet"), error);
    assert!(
        of_swarm("Tao")
            .to_string()
            .starts_with("ensembles do not have `Tao`")
    );
}

#[test]
fn a_tolerance_takes_the_scheme_of_the_structure() {
    let of = |text: &str| Run::to_tolerance(&made(text), start(), 1e-10).unwrap();
    assert_eq!(of("H(q; p) = p^2/2 + q^2/2").entry().name, "Adaptive");
    let mut run = of("H(q; p) = p^2/2 + q^2/2");
    let (states, done) = run.states_at(&[0.5, 1.0, 20.0]);
    assert_eq!(done, Ok(()));
    for state in &states {
        assert!((state.q[0] - state.t.cos()).abs() < 1e-9);
    }
    assert_eq!(run.refused_steps(), 0);
    // The scheme for a quadratic T requires it.
    assert_ne!(run.entry().needs, Needs::ANY);
    let other = of("H(q; p) = (q^2 + 1)*(p^2 + 1)/2");
    assert_eq!(other.entry().needs, Needs::ANY);
    assert!(Run::to_tolerance(&spring(), start(), -1.0).is_err());
}

#[test]
fn events_are_located_and_saved() {
    let spring = spring();
    let mut run = Run::new(&spring, "GaussNystrom4", start(), 0.1).unwrap();
    run.advance(40).unwrap();
    let mut resumed = Run::resume(&spring, &run.save()).unwrap();
    for run in [&mut run, &mut resumed] {
        run.advance(60).unwrap();
        let times: Vec<f64> = run.crossings().map(|crossing| crossing.state.t).collect();
        assert_eq!(times.len(), 3);
        for (k, time) in times.iter().enumerate() {
            let due = std::f64::consts::PI * (k as f64 + 0.5);
            assert!((time - due).abs() < 1e-9, "{time} for {due}");
        }
        assert!(run.crossings().all(|crossing| crossing.event == "node"));
    }
    assert_eq!(run.state(), resumed.state());
    let of_tolerance = Run::to_tolerance(&spring, start(), 1e-9).unwrap();
    assert!(Run::resume(&spring, &of_tolerance.save()).is_ok());
    for bytes in [&b""[..], b"scheme Gauss8", b"tolerance 1\n", b"no\nthing"] {
        assert!(Run::resume(&spring, bytes).is_err());
    }
    let other = made("H(q; p) = p^2/2 + q^2; event node = q");
    assert!(matches!(
        Run::resume(&other, &run.save()),
        Err(RunError::Run(_))
    ));
}

#[test]
fn a_run_is_interrupted_and_goes_on() {
    let spring = spring();
    let asked = Arc::new(AtomicUsize::new(0));
    let count = asked.clone();
    let cancel = move || count.fetch_add(1, Ordering::Relaxed) == 2;
    let mut run = Run::new(&spring, "StormerVerlet", start(), 0.01)
        .unwrap()
        .with_cancel(cancel);
    assert_eq!(run.advance(10_000), Err(RunError::Interrupted));
    assert_eq!(run.steps(), 3 * 1024);
    run.advance(10_000 - 3 * 1024).unwrap();
    let mut due = Run::new(&spring, "StormerVerlet", start(), 0.01).unwrap();
    due.advance(10_000).unwrap();
    assert_eq!(run.state(), due.state());
    let cancel = |_: &str| true;
    let mut swarm =
        Swarm::new(&[spring], "StormerVerlet", &[1.0; 8], &[0.0; 8], 0.0, 0.01).unwrap();
    swarm = swarm.with_cancel(move || cancel(""));
    assert_eq!(swarm.advance_to(100.0), Err(RunError::Interrupted));
    assert!(swarm.steps() > 0 && swarm.steps() < 10_000);
}

#[test]
fn wrong_lengths_are_refused() {
    let spring = spring();
    let swarm = |q: &[f64], p: &[f64]| {
        Swarm::new(std::slice::from_ref(&spring), "Strang", q, p, 0.0, 0.1)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        swarm(&[1.0; 3], &[1.0; 2]),
        "there must be 3 momenta, found 2"
    );
    assert_eq!(
        swarm(&[], &[]),
        "an ensemble has at least one member, found 0"
    );
    let none = Swarm::new(&[], "Strang", &[], &[], 0.0, 0.1).unwrap_err();
    assert_eq!(none.to_string(), "there must be 1 systems, found 0");
    let run = Run::new(&spring, "Strang", State::new(vec![1.0; 2], vec![0.0]), 0.1);
    assert!(run.is_err());
}

#[test]
fn members_are_saved_and_recorded_by_name() {
    let text = "struct Spring { k = 1.0 } H(q; p) = p^2/2 + k*q^2/2; invariant twice = p^2 + k*q^2";
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let system = |k: f64| definition.system([("k", k)]).expect("a number");
    let springs = [system(1.0), system(4.0)];
    let (q, p) = ([1.0, 2.0], [0.5; 2]);
    let mut swarm = Swarm::new(&springs, "BlanesMoan4", &q, &p, 1.0, 0.1).expect("starts");
    swarm.advance(30).expect("no hook");
    let saved = swarm.save();
    let again =
        |systems: &[RuntimeSystem], bytes: &[u8]| Swarm::resume(systems, &q, &p, 1.0, bytes);
    let mut resumed = again(&springs, &saved).expect("the same members");
    assert_eq!((resumed.t(), resumed.step()), (swarm.t(), 0.1));
    swarm.advance(30).expect("no hook");
    resumed.advance(30).expect("no hook");
    assert_eq!(resumed.states(), swarm.states());
    // Other members, and other bytes.
    assert!(again(&[system(1.0), system(5.0)], &saved).is_err());
    for bytes in [
        &b"scheme BlanesMoan4\n"[..],
        b"ensemble",
        b"ensemble BlanesMoan4 x\n",
    ] {
        assert_eq!(again(&springs, bytes).err(), Some(RunError::NotSaved));
    }

    // The rows of a sweep are the states of the members.
    let path = std::env::temp_dir().join(format!("named-{}.zarr", std::process::id()));
    let sweep = |columns: &[&str]| {
        NamedSweep::new(&springs, "BlanesMoan4", &q, &p, 1.0, 0.1)
            .record(columns.iter().copied())
            .with_end(7.0)
    };
    let names = ["q", "p", "t", "H", "twice", "drift"];
    let stored = sweep(&names).store(&path).expect("a folder");
    assert!(stored.is_complete());
    let value = |name: &str| {
        let bytes = std::fs::read(path.join(name).join("c").join("0")).expect("one chunk");
        let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().expect("eight bytes"));
        bytes[..16]
            .chunks_exact(8)
            .map(number)
            .collect::<Vec<f64>>()
    };
    let states = swarm.states();
    assert_eq!(
        [value("q"), value("p"), value("t")],
        [states.q, states.p, states.t]
    );
    for (energy, twice) in value("H").iter().zip(value("twice")) {
        assert!((2.0 * energy - twice).abs() < 1e-12);
    }
    assert!(
        value("drift")
            .iter()
            .all(|drift| (1e-16..1e-4).contains(drift))
    );
    std::fs::remove_dir_all(&path).expect("it was written");
    let refused = sweep(&["r"]).store(&path).unwrap_err().to_string();
    assert_eq!(
        refused,
        "there is nothing named `r` to record; there are `t`, `H`, `drift`, `q`, `p`, `twice`"
    );
    assert!(!path.exists());
}
