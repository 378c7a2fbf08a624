//! A double pendulum with sliders, for a page.
//!
//! Input: the ratio of the masses, the ratio of the lengths, seconds. Output: the angles of both rods, and the largest
//! relative change of H since the pendulum was let go. The functions are exported to JavaScript, which draws.

use hamiltonian::prelude::*;
use std::cell::RefCell;

hamiltonian! {
    /// Two rods in a plane, one hanging from the other; angles are measured from the downward vertical.
    pub struct DoublePendulum { m = 1.0, l = 1.0, g = 9.81 }
    L(a, b; v_a, v_b) = (1 + m)*v_a^2/2 + m*l^2*v_b^2/2 + m*l*v_a*v_b*cos(a - b)
        + (1 + m)*g*cos(a) + m*g*l*cos(b)
}

/// Steps in a second.
const STEPS: f64 = 240.0;

type Swing = Run<DoublePendulum, Gauss<4>, EnergyDrift>;

thread_local! {
    static SWING: RefCell<Option<Swing>> = const { RefCell::new(None) };
}

/// Lets go a pendulum at rest whose lower mass is m times and whose lower rod l times the upper one. Returns false if
/// the numbers are refused.
#[unsafe(no_mangle)]
pub extern "C" fn let_go(m: f64, l: f64, a: f64, b: f64) -> bool {
    let system = DoublePendulum {
        m,
        l,
        ..Default::default()
    };
    let start = State::new([a, b], [0.0, 0.0]);
    let run = Integrator::new(&system, Gauss::default(), start, 1.0 / STEPS);
    let run = run.ok().map(|run| run.observe(EnergyDrift::new()));
    let is_running = run.is_some();
    SWING.set(run);
    is_running
}

/// Advances by whole steps, as many as fit into the seconds. Returns the number of steps; 0 after an error.
#[unsafe(no_mangle)]
pub extern "C" fn advance(seconds: f64) -> u32 {
    SWING.with_borrow_mut(|swing| {
        let steps = (seconds * STEPS) as u32;
        let run = swing.as_mut().map(|run| run.advance(steps.into()).is_ok());
        run.map_or(0, |is_fine| if is_fine { steps } else { 0 })
    })
}

/// The angle of the upper rod (0) or of the lower one (1).
#[unsafe(no_mangle)]
pub extern "C" fn angle(rod: u32) -> f64 {
    SWING.with_borrow(|swing| {
        let state = swing.as_ref().map(Integrator::state);
        state.map_or(f64::NAN, |state| state.q[rod.min(1) as usize])
    })
}

/// The largest relative change of H.
#[unsafe(no_mangle)]
pub extern "C" fn drift() -> f64 {
    SWING.with_borrow(|swing| {
        let drift = swing.as_ref().map(|run| run.observer().max_relative());
        drift.unwrap_or(f64::NAN)
    })
}
