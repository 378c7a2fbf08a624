//! The drift of functions of the state.
//!
//! Input: states of a run. Output: the largest and the mean change of H ([`EnergyDrift`]) and of the observables
//! ([`Monitors`]). Invariant: only sums and maxima are stored.

use super::deviation::Deviation;
use super::follow::FollowVisitor;
use super::quantity::Quantity;
use super::{Observer, View, one_trajectory};
use crate::errors::Error;
use crate::results::checkpoint::Memory;
use crate::systems::system::{Dynamics, ObservableKind, System, Text};
use alloc::vec::Vec;
use core::ops::ControlFlow;
use hamiltonian_lanes::Real;

/// The drift of the declared H, see [`Deviation`].
///
/// If H depends on time, it is not conserved, and its drift is not an error of the scheme.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EnergyDrift<T = f64> {
    drift: Option<Deviation<T>>,
}

impl<T: Real> EnergyDrift<T> {
    /// Creates an observer of the drift of H.
    pub fn new() -> Self {
        EnergyDrift { drift: None }
    }

    /// The drift; `None` before the observer is attached.
    pub fn drift(&self) -> Option<&Deviation<T>> {
        self.drift.as_ref()
    }

    /// max |ΔH/H₀|; NaN before the observer is attached, and infinite or NaN if H₀ = 0.
    pub fn max_relative(&self) -> f64 {
        self.drift
            .as_ref()
            .map_or(f64::NAN, Deviation::max_relative)
    }

    /// The mean of |ΔH/H₀|; NaN before the observer is attached, and infinite or NaN if H₀ = 0.
    pub fn mean_relative(&self) -> f64 {
        self.drift
            .as_ref()
            .map_or(f64::NAN, Deviation::mean_relative)
    }

    /// The mean of H; NaN before the observer is attached.
    pub fn mean(&self) -> f64 {
        self.drift.as_ref().map_or(f64::NAN, Deviation::mean)
    }
}

impl<T: Real, S: System> Observer<T, S> for EnergyDrift<T> {
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        one_trajectory::<T>();
        self.drift = None;
        <Self as Observer<T, S>>::observe(self, view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        let energy = view.energy();
        self.drift
            .get_or_insert_with(|| Deviation::new(energy))
            .record(energy);
        ControlFlow::Continue(())
    }
    fn change(&mut self, from: &View<'_, T, S>, to: &View<'_, T, S>) {
        if let Some(drift) = &mut self.drift {
            drift.shift(to.energy() - from.energy());
        }
    }
    fn save(&self, to: &mut Memory) {
        to.begin("EnergyDrift");
        to.count(u64::from(self.drift.is_some()));
        if let Some(drift) = &self.drift {
            drift.save(to);
        }
    }
    fn follow(&mut self, visitor: &mut FollowVisitor<'_, T>) -> bool {
        visitor.drift(Quantity::Energy, &mut self.drift);
        true
    }
    fn restore(&mut self, _: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("EnergyDrift")?;
        self.drift = match from.read_count()? {
            0 => None,
            _ => Some(Deviation::restored(from)?),
        };
        Ok(())
    }
}

/// The drift of every observable of the system: its monitors, invariants and events.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Monitors<T = f64> {
    monitors: Vec<Monitor<T>>,
}

/// The drift of one observable in [`Monitors`].
#[derive(Debug, Clone, PartialEq)]
pub struct Monitor<T> {
    /// The declared name; for a component of a vector, with its index in brackets.
    pub name: Text,
    /// The kind of declaration: monitor, invariant or event.
    pub kind: ObservableKind,
    /// The drift.
    pub drift: Deviation<T>,
}

impl<T: Real> Monitors<T> {
    /// Creates an observer of the drifts of all observables.
    pub fn new() -> Self {
        Monitors {
            monitors: Vec::new(),
        }
    }

    /// All observables in declaration order; empty before the observer is attached.
    pub fn all(&self) -> &[Monitor<T>] {
        &self.monitors
    }

    /// The drift of the observable of that name.
    pub fn get(&self, name: &str) -> Option<&Deviation<T>> {
        self.monitors
            .iter()
            .find(|monitor| monitor.name == name)
            .map(|monitor| &monitor.drift)
    }
}

impl<T: Real, S: System> Observer<T, S> for Monitors<T> {
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        one_trajectory::<T>();
        self.monitors = (0..)
            .zip(view.prepared.description().observables.iter())
            .map(|(index, observable)| Monitor {
                name: observable.name.clone(),
                kind: observable.kind,
                drift: Deviation::new(view.observable(index)),
            })
            .collect();
        <Self as Observer<T, S>>::observe(self, view)
    }
    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        for (index, monitor) in self.monitors.iter_mut().enumerate() {
            monitor.drift.record(view.observable(index));
        }
        ControlFlow::Continue(())
    }
    fn change(&mut self, from: &View<'_, T, S>, to: &View<'_, T, S>) {
        for (index, monitor) in self.monitors.iter_mut().enumerate() {
            let change = to.observable(index) - from.observable(index);
            monitor.drift.shift(change);
        }
    }
    fn save(&self, to: &mut Memory) {
        to.begin("Monitors");
        to.count(self.monitors.len() as u64);
        for monitor in &self.monitors {
            monitor.drift.save(to);
        }
    }
    fn follow(&mut self, visitor: &mut FollowVisitor<'_, T>) -> bool {
        for (index, observable) in visitor.system.observables.iter().enumerate() {
            let mut drift = self.monitors.get(index).map(|one| one.drift.clone());
            visitor.drift(Quantity::Observable(index), &mut drift);
            let Some(drift) = drift else { continue };
            match self.monitors.get_mut(index) {
                Some(monitor) => monitor.drift = drift,
                None => self.monitors.push(Monitor {
                    name: observable.name.clone(),
                    kind: observable.kind,
                    drift,
                }),
            }
        }
        true
    }
    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("Monitors")?;
        let count = from.read_count()?;
        self.monitors = (view.prepared.description().observables.iter())
            .take(usize::try_from(count).unwrap_or(usize::MAX))
            .map(|observable| {
                Ok(Monitor {
                    name: observable.name.clone(),
                    kind: observable.kind,
                    drift: Deviation::restored(from)?,
                })
            })
            .collect::<Result<_, Error>>()?;
        Ok(())
    }
}
