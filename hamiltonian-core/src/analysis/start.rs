//! Starts on an energy surface: one momentum from H = E, one coordinate from an event.
//!
//! Each function takes a state as a guess and returns it with one momentum, or one momentum and one coordinate,
//! replaced. The root is bracketed before it is refined, so the state lies on the surface to rounding error. The other
//! components are those of the guess.
//!
//! ```
//! use hamiltonian::analysis::{Branch, momentum_from_energy};
#![doc = include_str!("../doc/oscillator.md")]
//!
//! let guess = State::new([0.6], [0.0]);
//! let start = momentum_from_energy(&Oscillator {}, &guess, 0, 0.5, Branch::Forward)?;
//! assert_eq!(start.p[0], 0.8);
//! // Beyond the turning point there is no such momentum.
//! let beyond = State::new([1.5], [0.0]);
//! assert!(momentum_from_energy(&Oscillator {}, &beyond, 0, 0.5, Branch::Forward).is_err());
//! # Ok::<(), Error>(())
//! ```

mod search;

use crate::errors::{Error, ObservableError, SearchError};
use crate::runs::integrator::check_state;
use crate::systems::state::State;
use crate::systems::system::{Description, Dynamics, Group, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};
use search::{EnergySample, FINEST, MomentumSearch, polished};

/// The choice among several momenta with H = E.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Branch {
    /// The momentum nearest to the guess; the larger of two at the same distance.
    #[default]
    Nearest,
    /// The nearest momentum with q̇ = ∂H/∂p ≥ 0: its coordinate increases.
    Forward,
    /// The nearest momentum with q̇ = ∂H/∂p ≤ 0.
    Backward,
}

/// A surface of section, on which an event is 0 and H = E. Coordinates and momenta are given as flat indices
/// ([`Vector::component`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Section {
    /// The index in [`Description::observables`] of the event, or another observable, that is 0.
    pub event: usize,
    /// The coordinate that is solved for from the event.
    pub coordinate: usize,
    /// The momentum that is solved for from H = E.
    pub momentum: usize,
}

/// The state with momentum `momentum` (a flat index) such that H = `energy`; the state's own value
/// is the guess.
///
/// H may be any smooth function of this momentum. All roots are found if H is convex, concave or
/// monotone in it (quadratic, relativistic, geodesic), otherwise those next to the guess. Over
/// duals the result has derivatives. A minimum that touches E to rounding counts as a root.
///
/// # Errors
/// [`SearchError::NoMomentum`] if H = E for no value (beyond a turning point), with the value of H nearest to E;
/// [`InputError::Shape`](crate::errors::InputError::Shape), [`SearchError::Component`],
/// [`StartError::NotFinite`](crate::errors::StartError::NotFinite).
pub fn momentum_from_energy<T: Real, S: System>(
    system: &S,
    state: &State<VectorOf<S, T>>,
    momentum: usize,
    energy: T,
    branch: Branch,
) -> Result<State<VectorOf<S, T>>, Error> {
    check_state(system, state)?;
    check_component(momentum, state.p.len())?;
    let prepared = system.prepare();
    let mut found = state.clone();
    let value = solve_momentum(
        &prepared,
        &found,
        &mut system.zeros(),
        momentum,
        energy,
        branch,
    )
    .map_err(|closest| no_momentum::<T, S>(system.description(), momentum, energy, &closest))?;
    *found.p.component_mut(momentum) = value;
    Ok(found)
}

/// The state with coordinate `coordinate` (a flat index) such that observable `event` is 0: the
/// zero nearest to the state's own value, found by its change of sign.
///
/// # Errors
/// [`SearchError::NoCrossing`] if none was found; [`ObservableError::Index`],
/// [`InputError::Shape`](crate::errors::InputError::Shape), [`SearchError::Component`],
/// [`StartError::NotFinite`](crate::errors::StartError::NotFinite).
pub fn coordinate_on_event<T: Real, S: System>(
    system: &S,
    state: &State<VectorOf<S, T>>,
    event: usize,
    coordinate: usize,
) -> Result<State<VectorOf<S, T>>, Error> {
    check_state(system, state)?;
    let count = system.description().observables.len();
    if event >= count {
        return Err(ObservableError::Index {
            index: event,
            count,
        }
        .into());
    }
    check_component(coordinate, state.q.len())?;
    let prepared = system.prepare();
    let mut at = state.clone();
    let value = crossing(state.q.component(coordinate), |x| {
        *at.q.component_mut(coordinate) = x;
        prepared.observable(event, at.t, &at.q, &at.p)
    })
    .map_err(|value| no_crossing::<T, S>(system.description(), event, coordinate, state, value))?;
    *at.q.component_mut(coordinate) = value;
    Ok(at)
}

/// The state on a surface of section: its event is 0 and H = `energy`. The coordinate is solved
/// for first, then the momentum; an event that depends on that momentum makes them one equation,
/// with the momentum solved for inside.
///
/// # Errors
/// Those of [`momentum_from_energy`] and [`coordinate_on_event`].
pub fn on_section<T: Real, S: System>(
    system: &S,
    state: &State<VectorOf<S, T>>,
    section: Section,
    energy: T,
    branch: Branch,
) -> Result<State<VectorOf<S, T>>, Error> {
    let Section {
        event,
        coordinate,
        momentum,
    } = section;
    check_component(momentum, state.p.len())?;
    let placed = coordinate_on_event(system, state, event, coordinate)?;
    let prepared = system.prepare();
    let value = |s: &State<VectorOf<S, T>>| prepared.observable(event, s.t, &s.q, &s.p);
    let solved = momentum_from_energy(system, &placed, momentum, energy, branch);
    if let Ok(solved) = &solved
        && value(solved).equals(value(&placed)).all()
    {
        return Ok(solved.clone());
    }
    let mut scratch = system.zeros();
    let mut at = state.clone();
    let found = crossing(state.q.component(coordinate), |x| {
        *at.q.component_mut(coordinate) = x;
        let p = solve_momentum(&prepared, &at, &mut scratch, momentum, energy, branch);
        match p {
            Ok(p) => {
                *at.p.component_mut(momentum) = p;
                prepared.observable(event, at.t, &at.q, &at.p)
            }
            Err(_) => T::constant(f64::NAN, 0.0),
        }
    });
    match found {
        Ok(x) => {
            *at.q.component_mut(coordinate) = x;
            momentum_from_energy(system, &at, momentum, energy, branch)
        }
        Err(value) => {
            // If there is no momentum at the event, the error is the missing momentum.
            solved?;
            let system = system.description();
            Err(no_crossing::<T, S>(system, event, coordinate, state, value).into())
        }
    }
}

/// The momentum, or the sample nearest to H = E.
fn solve_momentum<T: Real, D: Dynamics<T>>(
    prepared: &D,
    state: &State<D::Vector>,
    slopes: &mut D::Vector,
    momentum: usize,
    energy: T,
    branch: Branch,
) -> Result<T, EnergySample<T>> {
    let mut p = state.p.clone();
    let mut at = |x: T| {
        *p.component_mut(momentum) = x;
        let f = prepared.energy(state.t, &state.q, &p) - energy;
        prepared.gradient_p(state.t, &state.q, &p, slopes);
        EnergySample {
            x,
            f,
            slope: slopes.component(momentum),
        }
    };
    // The size of the terms of H, estimated by q·∂H/∂q and p·∂H/∂p of the other components.
    let mut moved = state.clone();
    let (mut dq, mut dp) = (state.q.zeros_like(), state.p.zeros_like());
    let mut size = |x: T| {
        *moved.p.component_mut(momentum) = x;
        prepared.gradient(moved.t, &moved.q, &moved.p, &mut dq, &mut dp);
        *dp.component_mut(momentum) = T::zero();
        let mut size = 2.0 * energy.magnitude();
        for (at, slope) in [(&moved.q, &dq), (&moved.p, &dp)] {
            for (x, slope) in at.components().zip(slope.components()) {
                size += (x * slope).magnitude();
            }
        }
        size
    };
    let guess = at(state.p.component(momentum));
    if !guess.f.is_finite() {
        return Err(guess);
    }
    let mut search = MomentumSearch {
        at: &mut at,
        size: &mut size,
        roots: [None; 5],
        closest: guess,
    };
    if guess.f.equals(T::zero()).all() {
        search.push(guess);
    }
    search.walk(guess, T::one());
    search.walk(guess, -T::one());
    let fits = |root: &EnergySample<T>| match branch {
        Branch::Nearest => true,
        Branch::Forward => !is_negative(root.slope),
        Branch::Backward => !is_negative(-root.slope),
    };
    let mut best: Option<EnergySample<T>> = None;
    for root in search.roots.iter().flatten().filter(|root| fits(root)) {
        let distance = |root: &EnergySample<T>| Real::abs((root.x - guess.x).to_f64());
        let closer = best.is_none_or(|best| {
            let (new, old) = (distance(root), distance(&best));
            new < old || (new == old && best.x.lt(root.x).all())
        });
        if closer {
            best = Some(*root);
        }
    }
    let closest = search.closest;
    best.map(|root| polished(root, &mut at)).ok_or(closest)
}

/// The largest value at a zero, relative to the values around it.
const SMALL: f64 = 1.0 / 1024.0;

/// The zero of `f` nearest to `x`, by its change of sign; the value at `x` if none is found.
fn crossing<T: Real>(x: T, mut f: impl FnMut(T) -> T) -> Result<T, T> {
    let start = f(x);
    if start.equals(T::zero()).all() {
        return Ok(x);
    }
    // The last finite sample on each side.
    let mut last = [(x, start); 2];
    let mut step = Real::abs(x.to_f64()).max(1.0) / 64.0;
    let mut reach = step;
    // 4/3 to the 100th: from 1/64 to some 10¹¹.
    for _ in 0..100 {
        for (side, sign) in last.iter_mut().zip([1.0, -1.0]) {
            let at = x + T::constant(sign * reach, 0.0);
            let value = f(at);
            let (from, before) = *side;
            *side = (at, value);
            if !value.is_finite() || !before.is_finite() {
                continue;
            }
            if value.equals(T::zero()).all() {
                return Ok(at);
            }
            if is_negative(value) != is_negative(before) {
                let (zero, left) = narrowed(from, before, at, value, &mut f);
                // At a pole the values grow as the bracket shrinks, at a jump they stay.
                if left <= SMALL * before.magnitude().max(value.magnitude()) {
                    return Ok(zero);
                }
            }
        }
        step *= 4.0 / 3.0;
        reach += step;
    }
    Err(start)
}

/// The zero between a and b, where f has different signs, and the smaller value at the ends of the
/// last bracket: the Illinois form of false position (Dowell & Jarratt, BIT 11, 168 (1971),
/// doi:10.1007/BF01934364), bisection if that is slow.
fn narrowed<T: Real>(a: T, fa: T, b: T, fb: T, f: &mut impl FnMut(T) -> T) -> (T, f64) {
    let (mut a, mut fa, mut b, mut fb) = (a, fa, b, fb);
    // The value at `a` that the secant uses.
    let mut weighed = fa;
    for round in 0..FINEST {
        let between = |x: T| (a.lt(x).all() && x.lt(b).all()) || (b.lt(x).all() && x.lt(a).all());
        let secant = b - fb * (b - a) / (fb - weighed);
        let half = a + (b - a) * T::constant(0.5, 0.0);
        let x = if round % 4 != 3 && between(secant) {
            secant
        } else {
            half
        };
        if !between(x) {
            break;
        }
        let value = f(x);
        if value.equals(T::zero()).all() {
            return (x, 0.0);
        }
        if !value.is_finite() {
            return (x, f64::INFINITY);
        }
        if is_negative(value) == is_negative(fb) {
            weighed *= T::constant(0.5, 0.0);
        } else {
            (a, fa) = (b, fb);
            weighed = fa;
        }
        (b, fb) = (x, value);
    }
    if fa.magnitude() < fb.magnitude() {
        (a, fa.magnitude())
    } else {
        (b, fb.magnitude())
    }
}

fn is_negative<T: Real>(x: T) -> bool {
    x.lt(T::zero()).all()
}

fn check_component(index: usize, count: usize) -> Result<(), SearchError> {
    if index < count {
        Ok(())
    } else {
        Err(SearchError::Component { index, count })
    }
}

fn no_momentum<T: Real, S: System>(
    system: &Description,
    momentum: usize,
    energy: T,
    closest: &EnergySample<T>,
) -> SearchError {
    SearchError::NoMomentum {
        name: name::<VectorOf<S, T>>(system, momentum, |group| &group.momentum).into(),
        index: momentum,
        required: energy.to_f64(),
        closest: (closest.f + energy).to_f64(),
        at: closest.x.to_f64(),
    }
}

fn no_crossing<T: Real, S: System>(
    system: &Description,
    event: usize,
    coordinate: usize,
    state: &State<VectorOf<S, T>>,
    value: T,
) -> SearchError {
    SearchError::NoCrossing {
        event: (system.observables.get(event))
            .map_or("", |o| &o.name)
            .into(),
        name: name::<VectorOf<S, T>>(system, coordinate, |group| &group.coordinate).into(),
        index: coordinate,
        from: state.q.component(coordinate).to_f64(),
        value: value.to_f64(),
    }
}

/// The name of the group a component of a system with one part belongs to; empty where the
/// components are in several parts.
fn name<V: Vector>(system: &Description, index: usize, name: impl Fn(&Group) -> &str) -> &str {
    if V::PARTS > 1 {
        return "";
    }
    (system.groups.iter())
        .rev()
        .find(|group| group.offset <= index)
        .map_or("", name)
}
