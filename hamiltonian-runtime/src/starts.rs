//! States in the variables in which a definition is written, and starts from velocities.
//!
//! Input: a state of a system, or of its definition. Output: the other one. Invariant: bits are those of the methods of a
//! compiled definition.

use crate::error::RunError;
use crate::prepared::{Flat, Prepared, at};
use crate::system::RuntimeSystem;
use crate::variables::Coordinates;
use hamiltonian_core::{State, System, private};
use hamiltonian_lanes::Real;
use hamiltonian_symbolic::model::VectorUse;

/// Returns an error for a state of another length.
fn check<T: Real>(state: &State<Flat<T>>, expected: usize) -> Result<(), RunError> {
    for (what, found) in [("coordinates", state.q.len()), ("momenta", state.p.len())] {
        if found != expected {
            return Err(RunError::Length {
                what,
                expected,
                found,
            });
        }
    }
    Ok(())
}

impl<T: Real> Prepared<T> {
    /// The vectors of a function with this use; `None` if there is no such function.
    fn vectors(&self, usage: VectorUse, t: T, q: &Flat<T>, p: &Flat<T>) -> Option<[Flat<T>; 2]> {
        let purpose = self.code.vector(usage)?;
        let zeros = || Flat::from_element(self.code.places.len, T::zero());
        let [mut into_q, mut into_p] = [zeros(), zeros()];
        let mut arrays = at(t, q, p);
        (arrays.into_q, arrays.into_p) = (into_q.as_mut_slice(), into_p.as_mut_slice());
        self.call(purpose, &[], arrays);
        Some([into_q, into_p])
    }
}

impl RuntimeSystem {
    /// The coordinates of the system, in the order of its states.
    #[must_use]
    pub fn coordinates(&self) -> &[Coordinates] {
        &self.code.coordinates
    }

    /// The coordinates that the definition declares. They are [`coordinates`](Self::coordinates), unless the definition has
    /// the statement `coordinates …` or `dt = …`.
    #[must_use]
    pub fn declared_coordinates(&self) -> &[Coordinates] {
        match &self.code.declared {
            Some(declared) => &declared.coordinates,
            None => self.coordinates(),
        }
    }

    /// True if the system is integrated in other variables than those that the definition declares.
    #[must_use]
    pub fn has_own_variables(&self) -> bool {
        self.code.declared.is_some()
    }

    /// H of the definition at a state of the system. With `dt = g*ds`, `energy` is that of the system: g·(H + p_t).
    ///
    /// # Errors
    /// [`RunError::Length`] for a state of another shape.
    pub fn declared_energy<T: Real>(&self, state: &State<Flat<T>>) -> Result<T, RunError> {
        check(state, self.degrees_of_freedom())?;
        let State { t, q, p } = state;
        Ok(private::declared_energy_at::<T, Self>(
            &self.prepare(),
            *t,
            q,
            p,
        ))
    }

    /// The state of the system from one in the declared variables: in the coordinates of `coordinates …`; with `dt = g*ds`,
    /// with the time as the last coordinate, on the shell and at s = 0. The same state if the variables are the same.
    ///
    /// # Errors
    /// [`RunError::Length`] for a state of another shape.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// use hamiltonian_runtime::{Definition, Run, Values};
    ///
    /// let text = "struct Sundman {}
    ///     H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2);
    ///     dt = sqrt(x^2 + y^2)*ds";
    /// let system = Definition::parse(text, "sundman.txt")?.system(Values::new())?;
    ///
    /// // At the pericentre of an orbit of eccentricity 0.9.
    /// let start = State::new(vec![0.1, 0.0], vec![0.0, 19f64.sqrt()]);
    /// let period = 2.0*std::f64::consts::PI;
    /// let mut run = Run::new(&system, "RungeKutta4", system.from_declared(&start)?, period/1000.0)?;
    /// run.advance(1000)?;
    /// let end = system.to_declared(run.state())?;
    /// assert!((end.t - period).abs() < 1e-6 && (end.q[0] - 0.1).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[allow(clippy::wrong_self_convention)] // The name of the method of a compiled definition.
    pub fn from_declared<T: Real>(
        &self,
        state: &State<Flat<T>>,
    ) -> Result<State<Flat<T>>, RunError> {
        let Some(declared) = &self.code.declared else {
            check(state, self.degrees_of_freedom())?;
            return Ok(state.clone());
        };
        check(state, declared.len)?;
        let [mut q, mut p] = [self.zeros::<T>(), self.zeros::<T>()];
        declared.enter(state.q.as_slice(), q.as_mut_slice());
        declared.enter(state.p.as_slice(), p.as_mut_slice());
        let changed = self
            .prepare()
            .vectors(VectorUse::FromDeclared, state.t, &q, &p);
        let [q, p] = changed.unwrap_or([q, p]);
        let t = state.t;
        let mut state = State { t, q, p };
        let Some(time) = declared.time else {
            return Ok(state);
        };
        state.q[time] = t;
        state.t = T::zero();
        self.on_shell(&state)
    }

    /// The state in the declared variables from one of the system. Its `t` is the time that the definition declares. The
    /// same state if the variables are the same.
    ///
    /// # Errors
    /// [`RunError::Length`] for a state of another shape.
    ///
    /// ```
    /// use hamiltonian::State;
    /// use hamiltonian_runtime::{Definition, Values};
    ///
    /// let text = "struct Planet {}
    ///     H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2);
    ///     coordinates polar(x, y)";
    /// let planet = Definition::parse(text, "planet.txt")?.system(Values::new())?;
    /// assert_eq!(planet.coordinates()[1].name(), "phi");
    ///
    /// let start = planet.from_declared(&State::new(vec![0.0, 0.5], vec![-1.5, 0.0]))?;
    /// assert_eq!((start.q[0], start.p[1]), (0.5, 0.75));
    /// assert_eq!(planet.to_declared(&start)?.q[1], 0.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_declared<T: Real>(&self, state: &State<Flat<T>>) -> Result<State<Flat<T>>, RunError> {
        check(state, self.degrees_of_freedom())?;
        let Some(declared) = &self.code.declared else {
            return Ok(state.clone());
        };
        let prepared = self.prepare();
        let changed = prepared.vectors(VectorUse::ToDeclared, state.t, &state.q, &state.p);
        let [q, p] = changed.unwrap_or_else(|| [state.q.clone(), state.p.clone()]);
        let zeros = || Flat::from_element(declared.len, T::zero());
        let mut new = State {
            t: declared.time.map_or(state.t, |time| state.q[time]),
            q: zeros(),
            p: zeros(),
        };
        declared.leave(q.as_slice(), new.q.as_mut_slice());
        declared.leave(p.as_slice(), new.p.as_mut_slice());
        Ok(new)
    }

    /// The state with p_t = −H, in a system with another time; the same state in any other system.
    ///
    /// # Errors
    /// [`RunError::Length`] for a state of another shape.
    pub fn on_shell<T: Real>(&self, state: &State<Flat<T>>) -> Result<State<Flat<T>>, RunError> {
        check(state, self.degrees_of_freedom())?;
        let mut state = state.clone();
        let prepared = self.prepare();
        let momenta = prepared.vectors(VectorUse::OnShell, state.t, &state.q, &state.p);
        if let Some([_, p]) = momenta {
            state.p = p;
        }
        Ok(state)
    }

    /// The start of a Lagrangian system from velocities: those in the place of the momenta of `state`, in the declared
    /// variables.
    ///
    /// # Errors
    /// [`RunError::NoLagrangian`] for a definition of H, [`RunError::Length`] for a state of another shape.
    ///
    /// ```
    /// use hamiltonian::State;
    /// use hamiltonian_runtime::{Definition, Values};
    ///
    /// let text = "struct Pendulum { l = 2.0, g = 9.81 } L(theta; v) = l^2*v^2/2 + g*l*cos(theta)";
    /// let pendulum = Definition::parse(text, "pendulum.txt")?.system(Values::new())?;
    /// let start = pendulum.state_from_velocity(&State::new(vec![0.5], vec![1.5]))?;
    /// assert_eq!(start.p[0], 6.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn state_from_velocity<T: Real>(
        &self,
        state: &State<Flat<T>>,
    ) -> Result<State<Flat<T>>, RunError> {
        if self.code.vector(VectorUse::ConjugateMomentum).is_none() {
            return Err(RunError::NoLagrangian);
        }
        let time = state.t;
        let mut state = self.from_declared(state)?;
        let prepared = self.prepare();
        let momenta = prepared.vectors(VectorUse::ConjugateMomentum, time, &state.q, &state.p);
        if let Some([_, p]) = momenta {
            state.p = p;
        }
        self.on_shell(&state)
    }
}
