//! Periodic orbits, by Newton's method with the tangent of the numerical map.
//!
//! Input: a system, a scheme, a guess and the condition that selects one orbit of a family. Output:
//! [`PeriodicOrbit`]. Invariant: an orbit that is returned closes to within rounding times the growth of
//! deviations, moves, and is near the guess; anything else is an error.

mod arcs;
mod least_squares;

use crate::analysis::tangent::multipliers;
use crate::errors::{Error, SearchError, StartError};
use crate::schemes::scheme::Scheme;
use crate::systems::state::State;
use crate::systems::system::{Dynamics, System};
use crate::systems::vector::{Shape, Vector};
use alloc::vec;
use alloc::vec::Vec;
use arcs::{Nodes, Shooting};
use hamiltonian_lanes::Real;
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
/// is halved. [`OrbitSearch`] has settings.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// hamiltonian! {
///     /// A pendulum.
///     pub struct Pendulum {}
///     H(theta; p) = p^2/2 - cos(theta);
///     event turn = p
/// }
///
/// // The period grows with the amplitude; that of small oscillations is 2π.
/// let closing = Closing::OfPeriod { period: 7.0, section: "turn" };
/// let guess = State::new([1.2], [0.0]);
/// let orbit = PeriodicOrbit::find(&Pendulum {}, BlanesMoan6, guess, closing, 200)?;
/// // 4·K(sin(θ/2)), by the arithmetic-geometric mean.
/// let (mut a, mut b) = (1.0, (orbit.start.q[0]/2.0).cos());
/// for _ in 0..6 {
///     (a, b) = ((a + b)/2.0, f64::sqrt(a*b));
/// }
/// assert!((std::f64::consts::TAU/a - 7.0).abs() < 1e-7);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicOrbit<V: Vector<Scalar = f64>> {
    /// The start.
    pub start: State<V>,
    /// The time after which the orbit closes.
    pub period: f64,
    /// The largest difference of a component after a period. It is infinite if the orbit is so unstable that the state
    /// after a period has no value.
    pub gap: f64,
    /// The derivative of the state after a period with respect to the start, as of
    /// [`monodromy`](crate::analysis::monodromy).
    pub monodromy: DMatrix<f64>,
}

impl<V: Vector<Scalar = f64>> PeriodicOrbit<V> {
    /// Finds the orbit near `guess` that closes after one period of `steps` steps of `scheme`. All coordinates must
    /// return to their values: an angle that grows by 2π does not. This is [`OrbitSearch::find`] with the default
    /// settings.
    ///
    /// # Errors
    /// Those of [`OrbitSearch::find`].
    pub fn find<S, M>(
        system: &S,
        scheme: M,
        guess: State<V>,
        closing: Closing<'_>,
        steps: u64,
    ) -> Result<Self, Error>
    where
        S: System<Shape: Shape<Vector<f64> = V>>,
        M: Scheme<S>,
    {
        OrbitSearch::new(closing, steps).find(system, scheme, guess)
    }

    /// The Floquet multipliers: see [`multipliers`].
    #[must_use]
    pub fn multipliers(&self) -> Vec<Complex<f64>> {
        multipliers(&self.monodromy)
    }
}

/// A search for a periodic orbit, with settings.
///
/// The orbit is divided into arcs, the starts of which are corrected together (multiple shooting). On an unstable orbit,
/// the error of a guess grows less over an arc than over the period. At first the arcs follow the guess for half a
/// period forwards and half a period backwards, or for a period forwards if they fit together better.
///
/// With a symmetry, a half of the orbit is found first, between two points of the plane of the symmetry. This is the
/// usual way to the symmetric orbits of the restricted three-body problem:
///
/// ```
/// use hamiltonian::prelude::*;
///
/// hamiltonian! {
///     /// The circular restricted three-body problem in the rotating frame: the Earth and the Moon.
///     pub struct ThreeBody { mu = 0.01215058560962404 }
///     H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y
///         - (1 - mu)/hypot(x + mu, y) - mu/hypot(x - 1 + mu, y);
///     event axis = y
/// }
///
/// // A Lyapunov orbit around L1, from a guess to two digits.
/// let guess = State::new([0.82, 0.0], [0.0, 0.96]);
/// let closing = Closing::OfEnergy { near: 2.8, section: "axis" };
/// // (x, y, p_x, p_y) → (x, −y, −p_x, p_y) turns time round.
/// let search = OrbitSearch::new(closing, 400).with_symmetry(&[1, -1, -1, 1]);
/// let orbit = search.find(&ThreeBody::default(), Gauss::<6>::default(), guess)?;
/// assert!(orbit.start.p[0].abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitSearch<'a> {
    closing: Closing<'a>,
    steps: u64,
    arcs: usize,
    reach: f64,
    signs: Option<&'a [i8]>,
}

/// The number of points at which the width of an orbit is measured.
const POINTS: usize = 64;

/// An orbit that is narrower than this part of the guessed orbit is a point, or is about to become one.
const POINT: f64 = 1.0 / 32.0;

/// A path through a point: the points where arcs begin, the width of coordinates and of momenta, the gap after a
/// period.
struct Path {
    nodes: Vec<Vec<f64>>,
    widths: [f64; 2],
    gap: f64,
}

impl<'a> OrbitSearch<'a> {
    /// Creates a search for an orbit that closes after `steps` steps, in up to eight arcs.
    #[must_use]
    pub fn new(closing: Closing<'a>, steps: u64) -> Self {
        OrbitSearch {
            closing,
            steps,
            arcs: 8,
            reach: 0.5,
            signs: None,
        }
    }

    /// Sets the number of arcs, which is at most that of steps. A scheme that carries a second point begins each arc
    /// with a new one.
    #[must_use]
    pub fn with_arcs(self, arcs: usize) -> Self {
        OrbitSearch { arcs, ..self }
    }

    /// Sets the largest distance between the start of the orbit and the guess, in units of the width of the guessed
    /// orbit. The default is ½.
    #[must_use]
    pub fn with_reach(self, reach: f64) -> Self {
        OrbitSearch { reach, ..self }
    }

    /// Declares a symmetry that turns time round: H does not change if each coordinate, then each momentum, is
    /// multiplied by its sign, 1 or −1. The signs of a coordinate and of its momentum differ. The start and the point
    /// after half a period lie where the components with the sign −1 are 0; in the guess they are set to 0.
    #[must_use]
    pub fn with_symmetry(self, signs: &'a [i8]) -> Self {
        OrbitSearch {
            signs: Some(signs),
            ..self
        }
    }

    /// Finds the orbit near `guess`. All coordinates must return to their values: an angle that grows by 2π does not.
    ///
    /// # Errors
    /// [`SearchError::NoPeriodicOrbit`] if the method does not converge, for example because the guess is far,
    /// because the condition does not single out an orbit, or because the period leaves the range from half to twice
    /// the guess; [`SearchError::PointOrbit`] if the orbit is an equilibrium; [`SearchError::FarOrbit`] if it is too
    /// far from the guess; [`SearchError::Symmetry`] for signs that are no symmetry;
    /// [`ObservableError::Unknown`](crate::errors::ObservableError::Unknown) for a section that the system does not
    /// declare; those of [`Tangent::new`](crate::analysis::Tangent::new) and
    /// [`Tangent::advance`](crate::analysis::Tangent::advance) at the guess.
    ///
    /// With [`Closing::Driven`], a point is accepted if ∂H/∂t is not 0 along the guess, or if the guess is that point.
    pub fn find<S, M, V>(
        &self,
        system: &S,
        scheme: M,
        guess: State<V>,
    ) -> Result<PeriodicOrbit<V>, Error>
    where
        V: Vector<Scalar = f64>,
        S: System<Shape: Shape<Vector<f64> = V>>,
        M: Scheme<S>,
    {
        system.check_shape::<f64>(&guess)?;
        let (section, period) = match self.closing {
            Closing::Driven { period } => (None, period),
            Closing::OfPeriod { period, section } => (Some(section), period),
            Closing::OfEnergy { near, section } => (Some(section), near),
        };
        if let Some(name) = section
            && system.description().observable_index(name).is_none()
        {
            return Err(system.description().unknown(name).into());
        }
        if self.steps == 0 {
            return Err(StartError::NoSteps.into());
        }
        let size = 2 * guess.q.len();
        let odd = self.odd(size)?;
        let original: Vec<f64> = guess.q.components().chain(guess.p.components()).collect();
        let mut start = original.clone();
        for (x, _) in start.iter_mut().zip(&odd).filter(|(_, is_odd)| **is_odd) {
            *x = 0.0;
        }
        let ones = vec![1.0; size];
        let mut shooting = Shooting {
            system,
            scheme: &scheme,
            like: &guess,
            section,
            energy: match self.closing {
                Closing::OfEnergy { .. } => Some(system.energy::<f64>(&guess)),
                _ => None,
            },
            steps: self.steps,
            arcs: self
                .arcs
                .clamp(1, usize::try_from(self.steps).unwrap_or(usize::MAX)),
            units: &ones,
            odd: None,
        };
        let mut path = shooting.path_through(&start, period)?;
        let guessed = path.widths;
        self.check_symmetry(&shooting, &odd, &path, period)?;
        let is_driven = matches!(self.closing, Closing::Driven { .. }) && {
            let prepared = system.prepare::<f64>();
            let is_at_rest = guessed == [0.0; 2];
            let changes = |(arc, point): (usize, &Vec<f64>)| {
                let part = arc as f64 / path.nodes.len() as f64;
                let state = shooting.state(point, 1, part * period);
                prepared.time_derivative(state.t, &state.q, &state.p) != 0.0
            };
            is_at_rest || path.nodes.iter().enumerate().any(changes)
        };
        if guessed == [0.0; 2] && !is_driven {
            return Err(SearchError::PointOrbit { distance: 0.0 }.into());
        }
        let units: Vec<f64> = (0..size)
            .map(|i| match guessed[usize::from(2 * i >= size)] {
                0.0 => 1.0,
                width => width,
            })
            .collect();
        shooting.units = &units;
        let distance = |point: &[f64]| {
            let pairs = point.iter().zip(&original);
            pairs.fold(0.0, |most, (x, from)| Real::max(most, (x - from).abs()))
        };
        let is_point = |path: &Path| {
            !is_driven && (0..2).all(|half| path.widths[half] <= POINT * guessed[half])
        };
        // The error where the method does not converge, perhaps because it tends to a point.
        let missed = |nodes: &Nodes, gap: f64| {
            let path = shooting.path_through(&nodes.points[0], nodes.period);
            match path.is_ok_and(|path| is_point(&path)) {
                true => SearchError::PointOrbit {
                    distance: distance(&nodes.points[0]),
                },
                false => SearchError::NoPeriodicOrbit {
                    gap,
                    period: nodes.period,
                },
            }
        };
        let mut nodes = Nodes {
            points: Vec::new(),
            period,
        };
        if self.signs.is_some() {
            let half = Shooting {
                steps: self.steps.div_ceil(2),
                arcs: shooting.arcs.div_ceil(2),
                odd: Some(&odd),
                ..shooting
            };
            let first = path.nodes[..half.arcs].to_vec();
            let (found, shot) = half.converge(Nodes {
                points: first,
                period,
            })?;
            if !shot.is_met() {
                return Err(missed(&found, shot.gap).into());
            }
            path = shooting.path_through(&found.points[0], found.period)?;
            nodes.period = found.period;
        }
        nodes.points = path.nodes;
        let (nodes, shot) = shooting.converge(nodes)?;
        if !shot.is_met() {
            return Err(missed(&nodes, shot.gap).into());
        }
        let found = &nodes.points[0];
        let path = shooting.path_through(found, nodes.period)?;
        let distance = distance(found);
        if is_point(&path) {
            return Err(SearchError::PointOrbit { distance }.into());
        }
        let mut squares = [0.0; 2];
        for (i, (x, from)) in found.iter().zip(&original).enumerate() {
            let by = (x - from) / units[i];
            squares[usize::from(2 * i >= size)] += by * by;
        }
        let widths = Real::sqrt(squares[0].max(squares[1]));
        if guessed != [0.0; 2] && (widths > self.reach || widths.is_nan()) {
            return Err(SearchError::FarOrbit {
                distance,
                widths,
                period: nodes.period,
            }
            .into());
        }
        let mut monodromy = shot.product;
        for i in 0..size {
            for j in 0..size {
                monodromy[(i, j)] *= units[i] / units[j];
            }
        }
        Ok(PeriodicOrbit {
            start: shooting.state(found, 0, 0.0),
            period: nodes.period,
            gap: path.gap,
            monodromy,
        })
    }

    /// The components that the symmetry changes.
    fn odd(&self, size: usize) -> Result<Vec<bool>, SearchError> {
        let Some(signs) = self.signs else {
            return Ok(vec![false; size]);
        };
        let (q, p) = signs.split_at(signs.len() / 2);
        let is_pair = |(q, p): (&i8, &i8)| q.abs() == 1 && *p == -q;
        match signs.len() == size && q.iter().zip(p).all(is_pair) {
            true => Ok(signs.iter().map(|sign| *sign < 0).collect()),
            false => Err(SearchError::Symmetry { change: None }),
        }
    }

    /// Returns an error if H changes under the symmetry at a point of the guess, at the opposite time.
    fn check_symmetry<S, M, V>(
        &self,
        shooting: &Shooting<'_, S, M, V>,
        odd: &[bool],
        path: &Path,
        period: f64,
    ) -> Result<(), SearchError>
    where
        V: Vector<Scalar = f64>,
        S: System<Shape: Shape<Vector<f64> = V>>,
        M: Scheme<S>,
    {
        /// The largest change of H, relative to the sizes of its terms.
        const LEAST: f64 = 1e-9;
        if self.signs.is_none() {
            return Ok(());
        }
        for (arc, point) in path.nodes.iter().enumerate() {
            let flip = |(x, is_odd): (&f64, &bool)| if *is_odd { -x } else { *x };
            let image: Vec<f64> = point.iter().zip(odd).map(flip).collect();
            let after = arc as f64 / path.nodes.len() as f64 * period;
            let [here, there] = [(point, after), (&image, -after)]
                .map(|(point, after)| shooting.state(point, 1, after));
            let [before, changed] =
                [&here, &there].map(|state| shooting.system.energy::<f64>(state));
            let slopes = shooting.system.gradient::<f64>(&here);
            let slopes = slopes.q.components().chain(slopes.p.components());
            let size = slopes
                .zip(point)
                .fold(before.abs(), |sum, (slope, x)| sum + (slope * x).abs());
            let change = changed - before;
            if change.is_nan() || change.abs() > LEAST * size {
                return Err(SearchError::Symmetry {
                    change: Some(change),
                });
            }
        }
        Ok(())
    }
}

impl<S, M, V> Shooting<'_, S, M, V>
where
    V: Vector<Scalar = f64>,
    S: System<Shape: Shape<Vector<f64> = V>>,
    M: Scheme<S>,
{
    /// Follows a point for half a period forwards and half a period backwards, or for a period forwards if its ends are
    /// nearer to each other.
    fn path_through(&self, start: &[f64], period: f64) -> Result<Path, Error> {
        let step = period / self.steps as f64;
        let each = POINTS.div_ceil(self.arcs);
        let count = each * self.arcs;
        let before = |k: usize| (u128::from(self.steps) * k as u128 / count as u128) as u64;
        let middle = count / 2;
        let half = self.path(start, step, (1..=middle).map(before))?;
        let forwards = self.path(start, step, (1..=count).map(before));
        let backwards = (middle..count).rev().map(|k| self.steps - before(k));
        let backwards = self.path(start, -step, backwards);
        let apart = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b).zip(self.units);
            pairs.fold(0.0, |most, ((a, b), unit)| {
                Real::max(most, ((a - b) / unit).abs())
            })
        };
        let gap = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .fold(0.0, |most, (a, b)| Real::max(most, (a - b).abs()))
        };
        let mut points = vec![start.to_vec()];
        let mut closes = f64::INFINITY;
        match (forwards, backwards) {
            (Err(error), Err(_)) => return Err(error),
            (Ok(forwards), backwards) => {
                let end = &forwards[count - 1];
                closes = gap(end, start);
                match backwards {
                    Ok(mut backwards)
                        if apart(&backwards[count - middle - 1], &half[middle - 1])
                            < apart(end, start) =>
                    {
                        backwards.pop();
                        points.extend(half);
                        points.extend(backwards.into_iter().rev());
                    }
                    _ => points.extend(forwards.into_iter().take(count - 1)),
                }
            }
            (Err(_), Ok(mut backwards)) => {
                backwards.pop();
                points.extend(half);
                points.extend(backwards.into_iter().rev());
            }
        }
        let size = start.len();
        let widths = [0..size / 2, size / 2..size].map(|range| {
            let squares = range.fold(0.0, |sum, i| {
                let all = points.iter().map(|point| point[i]);
                let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                    (Real::min(low, x), Real::max(high, x))
                });
                sum + (high - low) * (high - low)
            });
            Real::sqrt(squares)
        });
        let nodes = points.into_iter().step_by(each).collect();
        Ok(Path {
            nodes,
            widths,
            gap: closes,
        })
    }
}
