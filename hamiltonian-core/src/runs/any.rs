//! Runs of different systems side by side.
//!
//! Input: a run of any type. Output: [`AnyRun`], the part of a run that does not depend on its
//! type. Invariant: numbers are `f64`: of a pack, the first lane.

use crate::errors::Error;
use crate::observers::observe::Observer;
use crate::runs::integrator::{Integrator, MapOf};
use crate::schemes::scheme::Entry;
use crate::systems::system::{Dynamics, Observable, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::string::String;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// A run of any system with any scheme, for collections of runs of different types.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::AnyRun;
///
/// let start = State::new([1.0], [0.0]);
/// let mut runs: Vec<Box<dyn AnyRun>> = vec![
///     Box::new(Integrator::new(&Oscillator {}, StormerVerlet::default(), start.clone(), 0.01)?),
///     Box::new(Integrator::new(&Oscillator {}, ImplicitMidpoint::default(), start, 0.01)?),
/// ];
/// for run in &mut runs {
///     run.advance(100)?;
///     println!("{} {}: H = {}", run.system(), run.entry().name, run.energy());
/// }
/// # Ok::<(), Error>(())
/// ```
pub trait AnyRun {
    /// The name of the system.
    fn system(&self) -> &str;
    /// The scheme's entry in the catalogue.
    fn entry(&self) -> Entry;
    /// Makes `n` steps; see [`Integrator::advance`].
    ///
    /// # Errors
    /// Those of [`Integrator::advance`].
    fn advance(&mut self, n: u64) -> Result<(), Error>;
    /// The number of steps made.
    fn steps(&self) -> u64;
    /// Returns true if an observer has ended the run.
    fn has_ended(&self) -> bool;
    /// The current time.
    fn time(&self) -> f64;
    /// The declared H at the current state.
    fn energy(&self) -> f64;
    /// The names of the coordinates, then of the momenta, in declaration order.
    fn names(&self) -> Vec<String>;
    /// Their values.
    fn values(&self) -> Vec<f64>;
    /// The names of the observables.
    fn observables(&self) -> &[Observable];
    /// The value of the observable of that name; `None` if there is none.
    fn observable(&self, name: &str) -> Option<f64>;
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> AnyRun for Integrator<T, S, R, O> {
    fn system(&self) -> &str {
        &self.prepared.description().name
    }
    fn entry(&self) -> Entry {
        Integrator::entry(self)
    }
    fn advance(&mut self, n: u64) -> Result<(), Error> {
        Integrator::advance(self, n).map(|_| ())
    }
    fn steps(&self) -> u64 {
        Integrator::steps(self)
    }
    fn has_ended(&self) -> bool {
        Integrator::has_ended(self)
    }
    fn time(&self) -> f64 {
        Integrator::time(self).to_f64()
    }
    fn energy(&self) -> f64 {
        Integrator::energy(self).to_f64()
    }
    fn names(&self) -> Vec<String> {
        let names =
            crate::observers::output::names(&self.prepared.description().groups, &self.state().q);
        let coordinates = names.iter().map(|name| name.of(&name.group.coordinate));
        let momenta = names.iter().map(|name| name.of(&name.group.momentum));
        coordinates.chain(momenta).collect()
    }
    fn values(&self) -> Vec<f64> {
        let state = self.state();
        let names = crate::observers::output::names(&self.prepared.description().groups, &state.q);
        let of = |vector: &VectorOf<S, T>| -> Vec<f64> {
            let values = names.iter().map(|name| vector.component(name.index));
            values.map(Real::to_f64).collect()
        };
        let mut values = of(&state.q);
        values.extend(of(&state.p));
        values
    }
    fn observables(&self) -> &[Observable] {
        &self.prepared.description().observables
    }
    fn observable(&self, name: &str) -> Option<f64> {
        Integrator::observable_named(self, name).map(Real::to_f64)
    }
}
