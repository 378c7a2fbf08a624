//! Jacobi and heliocentric coordinates of bodies whose number is known at run time.
//!
//! Input: a state of n bodies, `[n]` or `[n][c]`, and their masses. Output: the state in the other
//! coordinates, row by row. Invariant: the maps are linear and canonical, and `from_…` undoes
//! `to_…` up to rounding. In a definition, `coordinates jacobi(q, m)` for a literal
//! number of bodies, and `coordinates heliocentric(q, m)` for any, transform H too, by the same
//! formulas.
//!
//! ```
//! use hamiltonian::systems::coordinates::{from_jacobi, to_jacobi};
//! use hamiltonian::prelude::*;
//!
//! let bodies = State::new(vec![0.0, 1.0, 4.0], vec![-0.5, 1.0, 0.5]);
//! let masses = [3.0, 1.0, 4.0];
//! let jacobi = to_jacobi(&bodies, &masses)?;
//! // The centre of mass and the total momentum; positions relative to the centre so far.
//! assert_eq!(jacobi.q.as_slice(), [2.125, 1.0, 3.75]);
//! assert_eq!(jacobi.p[0], 1.0);
//! assert_eq!(from_jacobi(&jacobi, &masses)?, bodies);
//! # Ok::<(), Error>(())
//! ```

use crate::errors::{Error, InputError};
use crate::systems::state::State;
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use hamiltonian_lanes::{Parameter, Real};
use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix};

/// Jacobi coordinates, with M_i = m_0 + … + m_i: row 0 is the centre of mass and the total
/// momentum, row i ≥ 1 is Q_i = q_i − Σ_{k<i} m_k q_k/M_{i−1} and
/// P_i = (M_{i−1} p_i − m_i Σ_{k<i} p_k)/M_i.
///
/// Source: Wisdom & Holman, AJ 102, 1528 (1991), doi:10.1086/115978.
///
/// # Errors
/// [`InputError::Shape`] if the numbers of masses and rows differ, or if there are no rows;
/// [`InputError::Masses`].
pub fn to_jacobi<T, R, C, P>(
    state: &State<OMatrix<T, R, C>>,
    masses: &[P],
) -> Result<State<OMatrix<T, R, C>>, Error>
where
    T: Real,
    R: Dim,
    C: Dim,
    P: Parameter,
    DefaultAllocator: Allocator<R, C>,
    OMatrix<T, R, C>: Vector<Scalar = T>,
{
    let (masses, sums) = summed::<T, P>(state.q.nrows(), masses)?;
    let mut new = state.clone();
    for_columns(&mut new, masses.len(), |q, p| {
        // Σ_{k<i} m_k q_k and Σ_{k<i} p_k.
        let (mut moment, mut momentum) = (masses[0] * q[0], p[0]);
        for i in 1..q.len() {
            let own = masses[i] * q[i];
            q[i] -= moment / sums[i - 1];
            let before = momentum;
            momentum += p[i];
            moment += own;
            p[i] = (sums[i - 1] * p[i] - masses[i] * before) / sums[i];
        }
        q[0] = moment / sums[q.len() - 1];
        p[0] = momentum;
    });
    Ok(new)
}

/// The bodies from their Jacobi coordinates; see [`to_jacobi`].
///
/// # Errors
/// As [`to_jacobi`].
pub fn from_jacobi<T, R, C, P>(
    state: &State<OMatrix<T, R, C>>,
    masses: &[P],
) -> Result<State<OMatrix<T, R, C>>, Error>
where
    T: Real,
    R: Dim,
    C: Dim,
    P: Parameter,
    DefaultAllocator: Allocator<R, C>,
    OMatrix<T, R, C>: Vector<Scalar = T>,
{
    let (masses, sums) = summed::<T, P>(state.q.nrows(), masses)?;
    let mut old = state.clone();
    for_columns(&mut old, masses.len(), |q, p| {
        // The centre of mass and the momentum of bodies 0 … i, from the last i down.
        let (mut centre, mut momentum) = (q[0], p[0]);
        for i in (1..q.len()).rev() {
            let share = masses[i] / sums[i];
            centre -= share * q[i];
            q[i] += centre;
            p[i] += share * momentum;
            momentum -= p[i];
        }
        q[0] = centre;
        p[0] = momentum;
    });
    Ok(old)
}

/// Canonical heliocentric coordinates: row 0 is the position of body 0 and the total momentum, row
/// i ≥ 1 is Q_i = q_i − q_0 and P_i = p_i, barycentric if the total momentum is 0. No masses are
/// needed.
///
/// Source: Laskar & Robutel, Celest. Mech. Dyn. Astron. 62, 193 (1995), doi:10.1007/BF00692088
/// (Poincaré's variables).
#[must_use]
pub fn to_heliocentric<T, R, C>(state: &State<OMatrix<T, R, C>>) -> State<OMatrix<T, R, C>>
where
    T: Real,
    R: Dim,
    C: Dim,
    DefaultAllocator: Allocator<R, C>,
    OMatrix<T, R, C>: Vector<Scalar = T>,
{
    let mut new = state.clone();
    for_columns(&mut new, state.q.nrows(), |q, p| {
        for i in 1..q.len() {
            q[i] -= q[0];
            p[0] += p[i];
        }
    });
    new
}

/// The bodies from their heliocentric coordinates; see [`to_heliocentric`].
#[must_use]
pub fn from_heliocentric<T, R, C>(state: &State<OMatrix<T, R, C>>) -> State<OMatrix<T, R, C>>
where
    T: Real,
    R: Dim,
    C: Dim,
    DefaultAllocator: Allocator<R, C>,
    OMatrix<T, R, C>: Vector<Scalar = T>,
{
    let mut old = state.clone();
    for_columns(&mut old, state.q.nrows(), |q, p| {
        for i in 1..q.len() {
            q[i] += q[0];
            p[0] -= p[i];
        }
    });
    old
}

/// The masses of all bodies, and their partial sums.
fn summed<T: Real, P: Parameter>(
    bodies: usize,
    masses: &[P],
) -> Result<(Vec<T>, Vec<T>), InputError> {
    if bodies == 0 || masses.len() != bodies {
        return Err(InputError::Shape {
            name: "masses".into(),
            expected: bodies.max(1),
            found: masses.len(),
        });
    }
    let masses: Vec<T> = masses.iter().map(|m| m.into_real()).collect();
    let mut sums = Vec::with_capacity(bodies);
    let mut sum = T::zero();
    for (body, mass) in masses.iter().enumerate() {
        sum += *mass;
        let size = sum.to_f64();
        if !(size > 0.0 && size.is_finite()) {
            return Err(InputError::Masses { body, sum: size });
        }
        sums.push(sum);
    }
    Ok((masses, sums))
}

/// Calls `map` with each column of coordinates and of momenta.
fn for_columns<V: Vector>(
    state: &mut State<V>,
    rows: usize,
    map: impl Fn(&mut [V::Scalar], &mut [V::Scalar]),
) {
    let (q, p) = (state.q.part_mut(0), state.p.part_mut(0));
    let rows = rows.max(1);
    for (q, p) in q.chunks_exact_mut(rows).zip(p.chunks_exact_mut(rows)) {
        map(q, p);
    }
}
