//! The surface of section of the Hénon–Heiles system, filled by clicks.
//!
//! Input: an energy, points (y, p_y) of the section x = 0. Output: the points at which each orbit crosses the section
//! upwards, and the largest relative change of H of all orbits.

use hamiltonian::VectorOf;
use hamiltonian::observers::{Event, Events};
use hamiltonian::prelude::*;
use hamiltonian::analysis::{Branch, Section, on_section};
use std::cell::RefCell;

hamiltonian! {
    /// The Hénon–Heiles system.
    pub struct HenonHeiles {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3;
    event section = x
}

/// The size of a step, for errors of H near rounding.
const STEP: f64 = 0.25;
/// Steps of an orbit before the next one has its turn.
const TURN: u64 = 64;
/// The most points of one orbit.
const POINTS: u64 = 4000;

type Orbit = Run<HenonHeiles, GaussNystrom<8>, (EnergyDrift, Events<VectorOf<HenonHeiles>>)>;

thread_local! {
    static ORBITS: RefCell<Vec<Orbit>> = const { RefCell::new(Vec::new()) };
    static POINT: RefCell<[f64; 2]> = const { RefCell::new([0.0; 2]) };
}

/// Removes all orbits.
#[unsafe(no_mangle)]
pub extern "C" fn clear() {
    ORBITS.take();
}

/// Starts an orbit of an energy on the section. Returns false if no orbit of this energy goes through the point.
#[unsafe(no_mangle)]
pub extern "C" fn begin(energy: f64, y: f64, p_y: f64) -> bool {
    let section = Section {
        event: 0,
        coordinate: 0,
        momentum: 0,
    };
    let guess = State::new([0.0, y], [0.5, p_y]);
    let start = on_section(&HenonHeiles {}, &guess, section, energy, Branch::Forward);
    let run = start
        .and_then(|start| Integrator::new(&HenonHeiles {}, GaussNystrom::default(), start, STEP));
    let observers = || {
        (
            EnergyDrift::new(),
            Events::new([Event::named("section").with_direction(1)]),
        )
    };
    let run = run.map(|run| run.observe(observers()));
    let is_orbit = run.is_ok();
    ORBITS.with_borrow_mut(|orbits| orbits.extend(run));
    is_orbit
}

/// The number of orbits.
#[unsafe(no_mangle)]
pub extern "C" fn orbits() -> u32 {
    ORBITS.with_borrow(|orbits| orbits.len() as u32)
}

/// Advances an orbit by one turn. Returns the number of its points so far.
#[unsafe(no_mangle)]
pub extern "C" fn advance(orbit: u32) -> u32 {
    ORBITS.with_borrow_mut(|orbits| {
        let Some(run) = orbits.get_mut(orbit as usize) else {
            return 0;
        };
        let count = |run: &Orbit| run.observer().1.count("section");
        if count(run) < POINTS && run.advance(TURN).is_err() {
            // The points that it has stay.
            return count(run) as u32;
        }
        count(run) as u32
    })
}

/// Coordinate 0 (y) or 1 (p_y) of a point of an orbit; NaN if there is none.
#[unsafe(no_mangle)]
pub extern "C" fn point(orbit: u32, number: u32, coordinate: u32) -> f64 {
    ORBITS.with_borrow(|orbits| {
        let events = orbits
            .get(orbit as usize)
            .map(|run| run.observer().1.located());
        let located = events.and_then(|located| located.get(number as usize));
        located.map_or(f64::NAN, |located| match coordinate {
            0 => located.state.q[1],
            _ => located.state.p[1],
        })
    })
}

/// The largest relative change of H of all orbits.
#[unsafe(no_mangle)]
pub extern "C" fn drift() -> f64 {
    ORBITS.with_borrow(|orbits| {
        let drifts = orbits.iter().map(|run| run.observer().0.max_relative());
        drifts.fold(0.0, f64::max)
    })
}
