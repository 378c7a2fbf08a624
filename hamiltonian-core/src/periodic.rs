//! Periodic orbits, by Newton's method with the tangent of the numerical map.
//!
//! Input: a system, a scheme, a guess and the condition that selects one orbit of a family. Output:
//! [`PeriodicOrbit`]. Invariant: an orbit that is returned closes to within rounding times the growth of
//! deviations; anything else is an error.

mod least_squares;

use crate::error::Error;
use crate::integrator::Integrator;
use crate::scheme::Scheme;
use crate::state::State;
use crate::system::System;
use crate::tangent::{Tangent, multipliers};
use crate::vector::Vector;
use alloc::borrow::ToOwned;
use alloc::vec::Vec;
use hamiltonian_lanes::{Dual, Real};
use least_squares::{largest, solve};
use nalgebra::{Complex, DMatrix};

/// The condition that selects one periodic orbit.
///
/// Periodic orbits of a system whose H depends on time periodically are isolated. Those of an autonomous system form
/// families, one orbit for each energy, and each point of an orbit may be its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Closing<'a> {
    /// An orbit of a system whose H depends on time with this period. It closes after this time.
    Driven {
        /// The period, or a multiple of it.
        period: f64,
    },
    /// The orbit of an autonomous system that has this period. Its energy is found.
    OfPeriod {
        /// The period.
        period: f64,
        /// The event, or another observable, that is 0 at the start.
        section: &'a str,
    },
    /// The orbit of an autonomous system that has the energy of the guess. Its period is found.
    OfEnergy {
        /// A guess of the period.
        near: f64,
        /// The event, or another observable, that is 0 at the start.
        section: &'a str,
    },
}

/// A periodic orbit of the numerical map, with the derivative of the map over one period.
///
/// Newton's method corrects the start until the orbit closes. The derivative is that of the numerical map, so the
/// method converges quadratically, to an orbit that is periodic for the scheme. A correction that makes the gap larger
/// is halved.
///
/// ```
#[doc = include_str!("doc/oscillator.md")]
///
/// // All orbits of an oscillator have the period 2π: after 6 only the origin is back.
/// let guess = State::new([0.1], [0.3]);
/// let closing = Closing::Driven { period: 6.0 };
/// let orbit = PeriodicOrbit::find(&Oscillator {}, RungeKutta4, guess, closing, 100)?;
/// assert!(orbit.start.q[0].abs() < 1e-12 && orbit.start.p[0].abs() < 1e-12);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicOrbit<V: Vector<Scalar = f64>> {
    /// The start.
    pub start: State<V>,
    /// The time after which the orbit closes.
    pub period: f64,
    /// The largest difference of a component after a period.
    pub gap: f64,
    /// The derivative of the state after a period with respect to the start, as of
    /// [`monodromy`](crate::tangents::monodromy).
    pub monodromy: DMatrix<f64>,
}

/// The largest number of corrections.
const MOST: u32 = 40;

/// The least period, in units of the guess: with a period of 0 every start meets the conditions.
const SHORTEST: f64 = 0.5;

/// The largest number of halvings of a correction.
const HALVINGS: u32 = 12;

impl<V: Vector<Scalar = f64>> PeriodicOrbit<V> {
    /// Finds the orbit near `guess` that closes after one period of `steps` steps of `scheme`. All coordinates must
    /// return to their values: an angle that grows by 2π does not.
    ///
    /// # Errors
    /// [`Error::NoPeriodicOrbit`] if the method does not converge, for example because the guess is far, or because
    /// the condition does not single out an orbit, or because the period falls below half the guess;
    /// [`Error::Unknown`] for a section that the system does not declare; those of [`Tangent::new`] and
    /// [`Tangent::advance`] at the guess.
    pub fn find<S, M>(
        system: &S,
        scheme: M,
        guess: State<V>,
        closing: Closing<'_>,
        steps: u64,
    ) -> Result<Self, Error>
    where
        S: System<f64, Vector = V> + System<Dual<f64>>,
        M: Scheme<Dual<f64>, S>,
    {
        let (section, mut period) = match closing {
            Closing::Driven { period } => (None, period),
            Closing::OfPeriod { period, section } => (Some(section), period),
            Closing::OfEnergy { near, section } => (Some(section), near),
        };
        if let Some(name) = section
            && <S as System<f64>>::observable_index(name).is_none()
        {
            let known = <S as System<f64>>::OBSERVABLES.iter();
            return Err(Error::Unknown {
                name: name.to_owned(),
                system: <S as System<f64>>::NAME,
                known: known.map(|known| known.name).collect(),
            });
        }
        let search = OrbitSearch {
            system,
            scheme,
            section,
            energy: match closing {
                Closing::OfEnergy { .. } => Some(System::<f64>::energy(system, &guess)),
                _ => None,
            },
            steps,
        };
        let (mut start, guessed) = (guess, period);
        let mut at = search.at(&start, period)?;
        for _ in 0..MOST {
            let correction = solve(&at.slopes, &at.off);
            let mut scale = 1.0;
            let mut better = None;
            for _ in 0..HALVINGS {
                let (moved, longer) = search.moved(&start, period, &correction, scale);
                // A start at which H has no value is too far away.
                if longer / guessed >= SHORTEST
                    && let Ok(there) = search.at(&moved, longer)
                    && largest(&there.off) < largest(&at.off)
                {
                    better = Some((moved, longer, there));
                    break;
                }
                scale *= 0.5;
            }
            let Some(found) = better else {
                // Only rounding is left.
                break;
            };
            (start, period, at) = found;
        }
        let size = start.q.components().chain(start.p.components());
        let size = size.fold(1.0, |size: f64, x| size.max(x.abs()));
        let growth = at.matrix.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        let off = largest(&at.off);
        // The rounding error of a step grows like a deviation, and the errors of steps add up like
        // random numbers.
        let rounding = 64.0 * f64::EPSILON * growth * Real::sqrt(steps as f64);
        if off.is_nan() || off > rounding.max(1e-12) * size {
            return Err(Error::NoPeriodicOrbit { gap: off, period });
        }
        Ok(PeriodicOrbit {
            gap: largest(&at.off[..2 * start.q.len()]),
            start,
            period,
            monodromy: at.matrix,
        })
    }

    /// The Floquet multipliers: see [`multipliers`].
    #[must_use]
    pub fn multipliers(&self) -> Vec<Complex<f64>> {
        multipliers(&self.monodromy)
    }
}

/// The constants of the search for a periodic orbit.
struct OrbitSearch<'a, S, M> {
    system: &'a S,
    scheme: M,
    section: Option<&'a str>,
    energy: Option<f64>,
    steps: u64,
}

/// The conditions at a start: the gap of each, and its derivatives.
struct At {
    /// The gap of each component, then that of the section and that of the energy.
    off: Vec<f64>,
    slopes: DMatrix<f64>,
    /// The derivative of the return.
    matrix: DMatrix<f64>,
}

impl<S, M, V> OrbitSearch<'_, S, M>
where
    V: Vector<Scalar = f64>,
    S: System<f64, Vector = V> + System<Dual<f64>>,
    M: Scheme<Dual<f64>, S>,
{
    fn at(&self, start: &State<V>, period: f64) -> Result<At, Error> {
        let n = 2 * start.q.len();
        let step = period / self.steps as f64;
        let mut tangent = Tangent::new(self.system, self.scheme.clone(), start.clone(), step, n)?;
        tangent.advance(self.steps)?;
        let matrix = tangent.matrix();
        let end = tangent.state();
        let ends = end.q.components().chain(end.p.components());
        let starts = start.q.components().chain(start.p.components());
        let mut off: Vec<f64> = ends
            .zip(starts)
            .map(|(end, start)| end.re - start)
            .collect();
        let columns = n + usize::from(self.energy.is_some());
        let rows = n + usize::from(self.section.is_some()) + usize::from(self.energy.is_some());
        let mut slopes = DMatrix::from_element(rows, columns, 0.0);
        for i in 0..n {
            for j in 0..n {
                slopes[(i, j)] = matrix[(i, j)] - f64::from(u8::from(i == j));
            }
        }
        if let Some(name) = self.section {
            let value = System::<f64>::observable_named(self.system, name, start);
            off.push(value.unwrap_or(f64::NAN));
            let gradient = System::<f64>::observable_gradient(self.system, name, start);
            let gradient = gradient
                .iter()
                .flat_map(|g| g.q.components().chain(g.p.components()));
            for (j, slope) in gradient.enumerate() {
                slopes[(n, j)] = slope;
            }
        }
        if let Some(energy) = self.energy {
            off.push(System::<f64>::energy(self.system, start) - energy);
            let gradient = System::<f64>::gradient(self.system, start);
            for (j, slope) in (gradient.q.components().chain(gradient.p.components())).enumerate() {
                slopes[(rows - 1, j)] = slope;
            }
            for (i, slope) in self.by_period(start, period)?.into_iter().enumerate() {
                slopes[(i, n)] = slope;
            }
        }
        Ok(At {
            off,
            slopes,
            matrix,
        })
    }

    /// The derivative of the state after a period with respect to the period, with equal steps.
    fn by_period(&self, start: &State<V>, period: f64) -> Result<Vec<f64>, Error> {
        let zeros = || System::<Dual<f64>>::zeros(self.system);
        let mut lifted = State {
            t: Dual::fixed(start.t),
            q: zeros(),
            p: zeros(),
        };
        for (to, from) in [(&mut lifted.q, &start.q), (&mut lifted.p, &start.p)] {
            for index in 0..from.len() {
                *to.component_mut(index) = Dual::fixed(from.component(index));
            }
        }
        let steps = self.steps as f64;
        let step = Dual::new(period / steps, 1.0 / steps);
        let mut run = Integrator::new(self.system, self.scheme.clone(), lifted, step)?;
        let end = run.advance(self.steps)?;
        let ends = end.q.components().chain(end.p.components());
        Ok(ends.map(|number| number.eps).collect())
    }

    /// The start and the period minus a part of the correction.
    fn moved(
        &self,
        start: &State<V>,
        period: f64,
        correction: &[f64],
        scale: f64,
    ) -> (State<V>, f64) {
        let (mut moved, count) = (start.clone(), start.q.len());
        for index in 0..count {
            *moved.q.component_mut(index) -= scale * correction[index];
            *moved.p.component_mut(index) -= scale * correction[count + index];
        }
        let longer = correction.get(2 * count).map_or(0.0, |by| scale * by);
        (moved, period - longer)
    }
}
