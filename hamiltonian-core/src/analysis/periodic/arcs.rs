//! Newton's method for an orbit in several arcs.
//!
//! Input: the points where arcs begin, the period, and the conditions. Output: points at which every arc ends where the
//! next begins. Invariant: the derivatives are those of the numerical map. Corrections of all points follow from that
//! of the first, so the equations have the size of one state.
//!
//! Numbers are in units of the width of the guessed orbit, one unit for coordinates and one for momenta.
//!
//! Source: J. Stoer, R. Bulirsch, *Introduction to Numerical Analysis* (2002), section 7.3.5,
//! doi:10.1007/978-0-387-21738-3.

use super::least_squares::solve;
use crate::analysis::tangent::{Tangent, lifted};
use crate::errors::Error;
use crate::runs::integrator::Integrator;
use crate::schemes::scheme::Scheme;
use crate::systems::state::{Gradient, State};
use crate::systems::system::System;
use crate::systems::vector::{Shape, Vector};
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::{Dual, Real};
use nalgebra::DMatrix;

/// The largest number of corrections.
const MAX_CORRECTIONS: u32 = 40;

/// The largest number of halvings of a correction.
const HALVINGS: u32 = 12;

/// The least and the largest period, in units of the guess: with a period of 0 every start meets the conditions.
const PERIODS: [f64; 2] = [0.5, 2.0];

/// The rounding of sums, in units of ε times the size of their terms.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// An error that is always accepted, relative to the size of the numbers.
const LEAST: f64 = 1e-12;

/// The points where arcs begin, coordinates before momenta, and the period.
#[derive(Clone)]
pub(super) struct Nodes {
    pub(super) points: Vec<Vec<f64>>,
    pub(super) period: f64,
}

/// The conditions on an orbit, or on the half of one.
pub(super) struct Shooting<'a, S, M, V: Vector> {
    pub(super) system: &'a S,
    pub(super) scheme: &'a M,
    /// A state of the right shape, at the time of the start.
    pub(super) like: &'a State<V>,
    pub(super) section: Option<&'a str>,
    pub(super) energy: Option<f64>,
    /// The number of steps, in arcs of nearly equal length.
    pub(super) steps: u64,
    pub(super) arcs: usize,
    /// The unit of each component.
    pub(super) units: &'a [f64],
    /// The components that are 0 at both ends of half an orbit, if the orbit is found by its half.
    pub(super) odd: Option<&'a [bool]>,
}

/// A condition that is not met: by how much, and what rounding explains.
struct Condition {
    off: f64,
    rounding: f64,
}

/// The conditions at some nodes, with derivatives.
pub(super) struct Shot {
    conditions: Vec<Condition>,
    /// For each arc: the derivative of its end by its start and by the period, and its gap to the next start.
    arcs: Vec<(DMatrix<f64>, Vec<f64>, Vec<f64>)>,
    /// The derivative of the last end by the first start.
    pub(super) product: DMatrix<f64>,
    /// The equations for the corrections of the first start and of the period.
    slopes: DMatrix<f64>,
    right: Vec<f64>,
    /// The largest gap in the caller's units.
    pub(super) gap: f64,
}

impl Shot {
    /// The largest condition that is not met; NaN if any is.
    fn worst(&self) -> f64 {
        (self.conditions.iter()).fold(0.0, |worst, condition| {
            Real::max(worst, condition.off.abs())
        })
    }

    /// Returns true if rounding explains all gaps.
    pub(super) fn is_met(&self) -> bool {
        (self.conditions.iter()).all(|condition| condition.off.abs() <= condition.rounding)
    }
}

/// The components of a vector over duals.
fn values<V: Vector<Scalar = Dual<f64>>>(state: &State<V>) -> impl Iterator<Item = Dual<f64>> {
    state.q.components().chain(state.p.components())
}

impl<S, M, V> Shooting<'_, S, M, V>
where
    V: Vector<Scalar = f64>,
    S: System<Shape: Shape<Vector<f64> = V>>,
    M: Scheme<S>,
{
    /// The number of steps before an arc.
    fn before(&self, arc: usize) -> u64 {
        (u128::from(self.steps) * arc as u128 / self.arcs as u128) as u64
    }

    /// The part of the period that the arcs take.
    fn part(&self) -> f64 {
        if self.odd.is_some() { 0.5 } else { 1.0 }
    }

    /// A point as a state after `made` steps.
    pub(super) fn state(&self, point: &[f64], made: u64, step: f64) -> State<V> {
        let mut state = self.like.clone();
        let count = state.q.len();
        for (index, x) in point.iter().enumerate() {
            match index.checked_sub(count) {
                None => *state.q.component_mut(index) = *x,
                Some(index) => *state.p.component_mut(index) = *x,
            }
        }
        state.t += made as f64 * step;
        state
    }

    /// The points after these numbers of steps, in order, or an error.
    pub(super) fn path(
        &self,
        point: &[f64],
        step: f64,
        counts: impl Iterator<Item = u64>,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let start = lifted::<f64, S>(self.system, &self.state(point, 0, step))?;
        let step = Dual::fixed(step);
        let mut run = Integrator::new(self.system, self.scheme.clone(), start, step)?;
        let points = counts.map(|count| {
            let state = run.advance(count - run.steps())?;
            Ok(values(state).map(|x| x.re).collect())
        });
        points.collect()
    }

    /// Corrects the points and the period until only rounding is left.
    ///
    /// # Errors
    /// Those of the arcs at the first points.
    pub(super) fn converge(&self, mut nodes: Nodes) -> Result<(Nodes, Shot), Error> {
        let guessed = nodes.period;
        let mut shot = self.shoot(&nodes)?;
        let mut is_last = false;
        for _ in 0..MAX_CORRECTIONS {
            let corrections = self.corrections(&shot);
            let halvings = if is_last { 1 } else { HALVINGS };
            let mut scale = 1.0;
            let mut better = None;
            for _ in 0..halvings {
                let moved = self.moved(&nodes, &corrections, scale);
                let is_near = (PERIODS[0]..=PERIODS[1]).contains(&(moved.period / guessed));
                // A point at which H has no value is too far away.
                if is_near
                    && let Ok(there) = self.shoot(&moved)
                    && there.worst() < shot.worst()
                {
                    better = Some((moved, there));
                    break;
                }
                scale *= 0.5;
            }
            let Some(found) = better else {
                break;
            };
            (nodes, shot) = found;
            if is_last {
                break;
            }
            is_last = shot.is_met();
        }
        Ok((nodes, shot))
    }

    /// The conditions at some points.
    fn shoot(&self, nodes: &Nodes) -> Result<Shot, Error> {
        let units = self.units;
        let size = units.len();
        let step = self.part() * nodes.period / self.steps as f64;
        // The size of coordinates and of momenta, for the rounding of a gap.
        let largest = |range: core::ops::Range<usize>| {
            let all = nodes.points.iter().flat_map(|point| &point[range.clone()]);
            all.fold(units[range.start], |most: f64, x| most.max(x.abs()))
        };
        let sizes = [largest(0..size / 2), largest(size / 2..size)];
        let mut shot = Shot {
            conditions: Vec::new(),
            arcs: Vec::new(),
            product: DMatrix::identity(size, size),
            slopes: DMatrix::from_element(0, 0, 0.0),
            right: Vec::new(),
            gap: 0.0,
        };
        let (mut by_period, mut rest) = (vec![0.0; size], vec![0.0; size]);
        for arc in 0..self.arcs {
            let (begin, end) = (self.before(arc), self.before(arc + 1));
            let start = self.state(&nodes.points[arc], begin, step);
            let mut tangent =
                Tangent::new(self.system, self.scheme.clone(), start.clone(), step, size)?;
            tangent.advance(end - begin)?;
            let mut matrix = tangent.matrix();
            for i in 0..size {
                for j in 0..size {
                    matrix[(i, j)] *= units[j] / units[i];
                }
            }
            let changes = match self.energy {
                Some(_) => self.by_period(&start, nodes.period, end - begin)?,
                None => vec![0.0; size],
            };
            let is_final = arc + 1 == self.arcs;
            let mut gaps = vec![0.0; size];
            for (i, x) in values(tangent.state()).enumerate() {
                let aim = match self.odd {
                    Some(odd) if is_final && odd[i] => 0.0,
                    Some(_) if is_final => continue,
                    _ => nodes.points[(arc + 1) % self.arcs][i],
                };
                let gap = x.re - aim;
                gaps[i] = gap / units[i];
                shot.gap = Real::max(shot.gap, gap.abs());
                shot.conditions.push(Condition {
                    off: gaps[i],
                    rounding: sizes[usize::from(2 * i >= size)] / units[i],
                });
            }
            let through = |vector: &[f64], plus: &[f64]| {
                let sum =
                    |i: usize| (0..size).fold(plus[i], |sum, j| sum + matrix[(i, j)] * vector[j]);
                (0..size).map(sum).collect::<Vec<f64>>()
            };
            by_period = through(&by_period, &changes);
            rest = through(&rest, &gaps);
            shot.product = &matrix * &shot.product;
            shot.arcs.push((matrix, changes, gaps));
        }
        // The rounding error of a step grows like a deviation, and the errors of steps add up like random numbers.
        let growth = shot
            .product
            .iter()
            .fold(1.0, |size: f64, x| size.max(x.abs()));
        let relative = ROUNDING * growth * Real::sqrt(self.steps as f64);
        for condition in &mut shot.conditions {
            condition.rounding *= relative.max(LEAST);
        }
        self.equations(&mut shot, nodes, &by_period, &rest);
        Ok(shot)
    }

    /// The components of the first start that are corrected.
    fn free(&self) -> impl Iterator<Item = usize> {
        let odd = self.odd;
        (0..self.units.len()).filter(move |i| odd.is_none_or(|odd| !odd[*i]))
    }

    /// Writes the equations for the corrections of the first start and of the period.
    fn equations(&self, shot: &mut Shot, nodes: &Nodes, by_period: &[f64], rest: &[f64]) {
        let size = self.units.len();
        let closing: Vec<usize> = (0..size)
            .filter(|i| self.odd.is_none_or(|odd| odd[*i]))
            .collect();
        let free: Vec<usize> = self.free().collect();
        let with_period = usize::from(self.energy.is_some());
        let rows = closing.len() + usize::from(self.section.is_some()) + with_period;
        let mut slopes = DMatrix::from_element(rows, free.len() + with_period, 0.0);
        for (row, i) in closing.iter().enumerate() {
            for (column, j) in free.iter().enumerate() {
                let own = f64::from(u8::from(self.odd.is_none() && i == j));
                slopes[(row, column)] = shot.product[(*i, *j)] - own;
            }
            if with_period > 0 {
                slopes[(row, free.len())] = by_period[*i];
            }
            shot.right.push(-rest[*i]);
        }
        let start = self.state(&nodes.points[0], 0, 0.0);
        // Values and gradients of the section and of H: in units of a length, by the gradient at the start.
        let section = self.section.and_then(|name| {
            let value = self.system.observable_named::<f64>(name, &start)?;
            let gradient = self.system.observable_gradient::<f64>(name, &start)?;
            Some((value, 0.0, gradient))
        });
        let energy = self.energy.map(|energy| {
            let value = self.system.energy::<f64>(&start) - energy;
            (value, energy, self.system.gradient::<f64>(&start))
        });
        for (row, (value, level, gradient)) in
            (closing.len()..).zip(section.into_iter().chain(energy))
        {
            let Gradient { q, p } = &gradient;
            let gradient: Vec<f64> = q.components().chain(p.components()).collect();
            let scaled = |i: usize| gradient[i] * self.units[i];
            let square = (0..size).fold(0.0, |sum, i| sum + scaled(i) * scaled(i));
            let length = if square > 0.0 {
                Real::sqrt(square)
            } else {
                1.0
            };
            for (column, i) in free.iter().enumerate() {
                slopes[(row, column)] = scaled(*i) / length;
            }
            shot.right.push(-value / length);
            let terms = gradient.iter().zip(&nodes.points[0]);
            let terms = terms.fold(level.abs(), |sum, (slope, x)| sum + (slope * x).abs());
            shot.conditions.push(Condition {
                off: value / length,
                rounding: ROUNDING * terms / length + LEAST,
            });
        }
        shot.slopes = slopes;
    }

    /// The derivative of the end of an arc with respect to the logarithm of the period.
    fn by_period(&self, start: &State<V>, period: f64, steps: u64) -> Result<Vec<f64>, Error> {
        let start = lifted::<f64, S>(self.system, start)?;
        let each = self.part() / self.steps as f64;
        let step = Dual::new(each * period, each * period);
        let mut run = Integrator::new(self.system, self.scheme.clone(), start, step)?;
        let changes = values(run.advance(steps)?).zip(self.units);
        Ok(changes.map(|(x, unit)| x.eps / unit).collect())
    }

    /// The corrections of all points, and that of the period in units of it.
    fn corrections(&self, shot: &Shot) -> (Vec<Vec<f64>>, f64) {
        let found = solve(&shot.slopes, &shot.right);
        let mut first = vec![0.0; self.units.len()];
        let mut rest = found.into_iter();
        for (i, by) in self.free().zip(&mut rest) {
            first[i] = by;
        }
        let longer = rest.next().unwrap_or(0.0);
        let mut all = vec![first];
        for (matrix, by_period, gaps) in &shot.arcs[..self.arcs - 1] {
            let before = &all[all.len() - 1];
            let sum = |i: usize| {
                let known = gaps[i] + longer * by_period[i];
                (0..before.len()).fold(known, |sum, j| sum + matrix[(i, j)] * before[j])
            };
            let next = (0..before.len()).map(sum).collect();
            all.push(next);
        }
        (all, longer)
    }

    /// The points and the period with a part of the corrections.
    fn moved(&self, nodes: &Nodes, (all, longer): &(Vec<Vec<f64>>, f64), scale: f64) -> Nodes {
        let mut moved = nodes.clone();
        for (point, corrections) in moved.points.iter_mut().zip(all) {
            for ((x, by), unit) in point.iter_mut().zip(corrections).zip(self.units) {
                *x += scale * by * unit;
            }
        }
        moved.period *= 1.0 + scale * longer;
        moved
    }
}
