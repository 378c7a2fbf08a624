//! Errors by phase: a field of one name has one type, variants may grow, and each phase becomes an [`Error`].

use crate::common::systems::pendulum;
use hamiltonian_core::errors::{
    CheckpointError, InputError, KnotError, ObservableError, SearchError, ShardError, StartError,
    StepError, StoreError, SweepError, TableError, TimeError,
};
use hamiltonian_core::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error as _;

/// The facts about variants in the source of an enum.
#[derive(Debug, Default, PartialEq)]
struct Variants {
    /// The types of the fields of each name.
    fields: BTreeMap<String, BTreeSet<String>>,
    /// The number of variants with fields of their own, or without any.
    count: usize,
    /// Variants to which no field can be added.
    closed: Vec<String>,
}

impl Variants {
    /// Reads the enums of a source that rustfmt has formatted. Variants that contain a phase are left out.
    fn read(&mut self, source: &str) {
        let mut lines = source.lines();
        while lines.any(|line| line.starts_with("pub enum ")) {
            let mut before = "";
            for line in lines.by_ref().take_while(|line| *line != "}") {
                let own = line.trim();
                let is_variant = line.starts_with("    ") && own.starts_with(char::is_uppercase);
                if is_variant && !own.contains('(') {
                    self.count += 1;
                    if before != "#[non_exhaustive]" {
                        self.closed
                            .push(own.trim_end_matches([' ', '{', ',']).into());
                    }
                }
                if let (Some(field), true) = (own.strip_suffix(','), line.starts_with("        "))
                    && let Some((name, of)) = field.split_once(": ")
                    && !own.starts_with("//")
                {
                    self.fields
                        .entry(name.into())
                        .or_default()
                        .insert(of.into());
                }
                before = own;
            }
        }
    }

    /// The names whose fields have different types.
    fn mixed(&self) -> Vec<&str> {
        let several = self.fields.iter().filter(|(_, types)| types.len() > 1);
        several.map(|(name, _)| name.as_str()).collect()
    }
}

#[test]
fn a_field_of_one_name_has_one_type_and_every_variant_may_grow() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/errors");
    let mut found = Variants::default();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let text = std::fs::read_to_string(entry.expect("a file").path());
        found.read(&text.expect("a source"));
    }
    assert!(found.count >= 50, "{found:?}");
    assert!(found.fields.len() >= 50, "{found:?}");
    assert!(found.mixed().is_empty(), "{:?}", found.mixed());
    assert!(found.closed.is_empty(), "{:?}", found.closed);
    // Names belong to the error.
    let borrowed = found.fields.values().flatten().find(|of| of.contains('&'));
    assert_eq!(borrowed, None);
}

#[test]
fn mixed_types_and_closed_variants_are_found() {
    let mut found = Variants::default();
    found.read(
        "pub enum A {\n    /// One: two,\n    #[non_exhaustive]\n    One {\n        /// Its step: 2,\n        step: u64,\n    },\n    \
         Two {\n        step: f64,\n        time: f64,\n    },\n    Whole(B),\n    Three,\n}\npub enum B {\n    \
         #[non_exhaustive]\n    Four,\n}\n",
    );
    assert_eq!((found.count, found.mixed()), (4, vec!["step"]));
    assert_eq!(found.closed, ["Two", "Three"]);
}

/// The facts about each phase.
fn is_phase<E: Into<Error> + std::error::Error + Clone + PartialEq + Send + Sync + 'static>() {}

#[test]
fn every_phase_becomes_an_error() {
    is_phase::<InputError>();
    is_phase::<KnotError>();
    is_phase::<StartError>();
    is_phase::<StepError>();
    is_phase::<TimeError>();
    is_phase::<ObservableError>();
    is_phase::<SearchError>();
    is_phase::<SweepError>();
    is_phase::<ShardError>();
    is_phase::<CheckpointError>();
    is_phase::<TableError>();
    is_phase::<StoreError>();
    // Results of `Error` are returned from every step.
    assert!(size_of::<Error>() <= 112, "{}", size_of::<Error>());
}

/// A reporter that prints an error and its sources prints no message twice, but for the member that it names.
#[test]
fn messages_are_those_of_the_phase() {
    let start = |member: Member| {
        let q = [0.0, f64::NAN][member.index];
        (pendulum(true), State::new([q], [0.0]))
    };
    let mut swarm = Ensemble::new(2, start, StormerVerlet::default(), 0.1).expect("two members");
    swarm.advance(1);
    let error = swarm
        .state_of(1)
        .expect("two members")
        .expect_err("a bad start");
    let text = "the start is not finite: t = 0, q = [NaN], p = [0.0]";
    assert_eq!(error.to_string(), format!("member 1: {text}"));
    let source = error.source().expect("the error of the member");
    assert_eq!(source.to_string(), text);
    assert!(source.source().is_none());
    let Some(Error::Start(phase)) = source.downcast_ref::<Error>() else {
        panic!("{source}");
    };
    assert_eq!(
        (phase.to_string(), format!("{phase:?}")),
        (text.into(), text.into())
    );

    let knots = Spline::natural(&[0.0], &[1.0]).expect_err("one knot");
    assert_eq!(Error::from(knots.clone()), Error::Knots(knots));
}
