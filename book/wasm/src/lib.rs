//! The pendulum of the README for WebAssembly: functions that a page or another host calls.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum { m = 1.0, l = 2.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

const STEP: f64 = 1e-3;

/// The angle after so many steps, from 0.5 at rest; NaN if the run fails.
#[unsafe(no_mangle)]
pub extern "C" fn angle(steps: u32) -> f64 {
    let start = State::new([0.5], [0.0]);
    let run = Integrator::new(&Pendulum::default(), StormerVerlet::default(), start, STEP);
    let angle = run.and_then(|mut run| Ok(run.advance(u64::from(steps))?.q[0]));
    angle.unwrap_or(f64::NAN)
}

/// The number of members of an ensemble, all with this start, whose bits are those of [`angle`]. A target without
/// threads advances them on the caller's.
#[unsafe(no_mangle)]
pub extern "C" fn members(count: u32, steps: u32) -> u32 {
    let member = |_: Member| (Pendulum::default(), State::new([0.5], [0.0]));
    let scheme = StormerVerlet::default();
    let Ok(ensemble) = Ensemble::new(count as usize, member, scheme, STEP) else {
        return 0;
    };
    let mut ensemble = ensemble.reproducible();
    ensemble.advance(u64::from(steps));
    let due = angle(steps).to_bits();
    let is_due = |end: &Result<StateOf<Pendulum>, Error>| {
        end.as_ref().is_ok_and(|end| end.q[0].to_bits() == due)
    };
    ensemble.states().filter(is_due).count() as u32
}
