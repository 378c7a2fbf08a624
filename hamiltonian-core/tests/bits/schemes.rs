//! Every scheme of the catalogue has the bits that are recorded next to the version of saved runs.

use crate::common::walk::{Sample, everywhere};
use crate::recorded;
use hamiltonian_core::prelude::*;
use hamiltonian_core::{Scheme, schemes::walk::Visitor};
use std::collections::BTreeMap;

/// Makes a saved run of each scheme.
#[derive(Default)]
struct Saves(BTreeMap<String, Checkpoint>);

impl<S: Sample<f64>> Visitor<S> for Saves {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let name = format!("{} on {}", scheme.entry(), S::sample().description().name);
        let run = Integrator::new(&S::sample(), scheme, S::begin(), 0.01);
        let mut run = run.expect("the start is good");
        run.advance(50).expect("the run stays finite");
        let previous = self.0.insert(name.clone(), run.checkpoint());
        assert_eq!(previous, None, "{name} is made twice");
    }
}

#[test]
fn schemes_have_the_recorded_bits() {
    let mut saves = Saves::default();
    everywhere(&mut saves);
    let words = (saves.0.iter()).map(|(name, saved)| (name.clone(), recorded::word(saved)));
    let any = saves.0.values().next().expect("many runs");
    recorded::check("bits/schemes.txt", any, &words.collect());
}
