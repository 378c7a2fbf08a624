//! This library by tolerances alone, on the problems of the comparison with heyoka.
//!
//! Prints each problem with its reference, then the results, one JSON object a line. References are made in
//! double-double (106 bits) to a tolerance of 1e-18, and once more to 1e-17: `uncertainty` is the difference. With a
//! name as argument only that problem is treated.

#[path = "../problems.rs"]
mod problems;
#[path = "../support.rs"]
mod support;

use hamiltonian::prelude::*;
use hamiltonian::schemes::{Adaptive, ToTolerance};
use hamiltonian::{Scheme, Vector};
use problems::*;
use std::f64::consts::{FRAC_PI_2, TAU};
use support::*;

/// A start over any scalar, whose numbers are those of `f64`.
fn wide<S: System>(system: &S, start: &StateOf<S>) -> StateOf<S, DoubleDouble> {
    let mut wide = State {
        t: DoubleDouble::from(start.t),
        q: system.zeros::<DoubleDouble>(),
        p: system.zeros::<DoubleDouble>(),
    };
    for i in 0..start.q.len() {
        *wide.q.component_mut(i) = start.q.component(i).into();
        *wide.p.component_mut(i) = start.p.component(i).into();
    }
    wide
}

/// The results of all tolerances, unfused and fused.
fn follow<S>(
    only: Option<&str>,
    name: &str,
    system: &S,
    parameters: &[(&str, String)],
    rows: usize,
    start: StateOf<S>,
    end: f64,
) where
    S: ToTolerance,
    Adaptive<S::Scheme>: Scheme<S>,
{
    if only.is_some_and(|only| only != name) {
        return;
    }
    let reference = |tolerance: f64| {
        let scheme = Adaptive::new(S::Scheme::default(), tolerance);
        let start = wide(system, &start);
        let run = Integrator::new(system, scheme, start, DoubleDouble::from(1.0));
        let mut run = run.expect("a good start");
        numbers(&run.advance_until(end.into()).expect("good steps"))
    };
    let fine = reference(1e-18);
    describe(&Problem {
        name,
        parameters,
        rows,
        end,
        start: &numbers(&start),
        reference: &fine,
        uncertainty: difference(&reference(1e-17), &fine),
    });
    for fused in [false, true] {
        for digits in 2..=16 {
            let tolerance = 10.0_f64.powi(-digits);
            let solve = || {
                let run = Integrator::to_tolerance(system, start.clone(), tolerance);
                let mut run = run.map(|run| if fused { run.fused() } else { run })?;
                let state = run.advance_until(end)?;
                Ok::<_, Error>((state, run.steps()))
            };
            let (state, steps) = match solve() {
                Ok(end) => end,
                Err(error) => {
                    eprintln!("{name}: 1e-{digits}: {error}");
                    continue;
                }
            };
            let error = apart(&numbers(&state), &fine);
            let seconds = time(|| drop(solve()));
            let setting = format!("tol 1e-{digits}, {steps} steps");
            row(name, "tolerance", fused, &setting, error, None, seconds);
        }
    }
}

/// Twice the words of double-double, in eight stages, on the stack.
const STACK: usize = 1 << 28;

fn main() {
    let thread = std::thread::Builder::new().stack_size(STACK);
    let solving = thread.spawn(solve_all).expect("a thread starts");
    solving.join().expect("every problem is solved");
}

fn solve_all() {
    let only = std::env::args().nth(1);
    let only = only.as_deref();
    // At the pericentre of an orbit with a = 1.
    let kepler = |e: f64| State::new([1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()]);
    for (name, e, periods) in [
        ("kepler", 0.6, 1000.0),
        ("encounter", 0.9, 100.0),
        ("grazing", 0.99, 20.0),
    ] {
        follow(only, name, &Kepler {}, &[], 2, kepler(e), periods * TAU);
    }
    let start = State::new([0.12, 0.23], [0.31, -0.17]);
    follow(only, "henon_heiles", &HenonHeiles {}, &[], 2, start, 1e4);
    let start = State::new([1.5], [0.0]);
    follow(only, "pendulum", &Pendulum {}, &[], 1, start, 1e4);
    let start = State::new([-3.0], [0.0]);
    follow(only, "coupled", &Coupled {}, &[], 1, start, 1e4);
    let masses = PLANETS.map(|(mass, ..)| mass);
    let start = State::new(
        PLANETS.map(|(_, q, _)| q),
        PLANETS.map(|(mass, _, v)| v.map(|v| mass * v)),
    );
    let parameters = [("G", list([2.95912208286e-4])), ("m", list(masses))];
    follow(
        only,
        "planets",
        &Planets::new(masses),
        &parameters,
        6,
        start,
        365_250.0,
    );
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    let parameters = [("E", list([0.995])), ("L", list([4.6]))];
    follow(
        only,
        "black_hole",
        &BlackHole::default(),
        &parameters,
        2,
        start,
        1e4,
    );
    // E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I (1993), section II.0: one period,
    // with p = v + (−y, x).
    let start = State::new([0.994, 0.0], [0.0, 0.994 - 2.001_585_106_379_082_5]);
    let parameters = [("mu", list([0.012277471]))];
    follow(
        only,
        "arenstorf",
        &Restricted::default(),
        &parameters,
        2,
        start,
        17.065_216_560_157_963,
    );
    // A. Chenciner, R. Montgomery, Ann. Math. 152 (2000) 881, doi:10.2307/2661357: 100 periods.
    let [x, y, u, v] = [0.97000436, -0.24308753, -0.93240737, -0.86473146];
    let masses = [1.0; 3];
    let start = State::new(
        [[x, y], [-x, -y], [0.0, 0.0]],
        [[-u / 2.0, -v / 2.0], [-u / 2.0, -v / 2.0], [u, v]],
    );
    let bodies = ThreeBodies::new(masses);
    let parameters = [("m", list(masses))];
    follow(
        only,
        "figure_eight",
        &bodies,
        &parameters,
        3,
        start,
        632.591398,
    );
    // Chosen before they were measured.
    let masses = [3.0, 4.0, 5.0];
    let start = State::new([[1.0, 3.0], [-2.0, -1.0], [1.0, -1.0]], [[0.0, 0.0]; 3]);
    let bodies = ThreeBodies::new(masses);
    let parameters = [("m", list(masses))];
    follow(only, "burrau", &bodies, &parameters, 3, start, 10.0);
    let start = State::new([1.0, 0.5], [0.0, 0.0]);
    follow(
        only,
        "double_pendulum",
        &DoublePendulum {},
        &[],
        2,
        start,
        50.0,
    );
    let start = State::new([1.0, 0.0], [0.1, 0.15]);
    follow(only, "dipole", &Dipole {}, &[], 2, start, 1e3);
    let start = State::new([1.0], [0.0]);
    follow(only, "duffing", &Duffing {}, &[], 1, start, 100.0);
    let start = State::new([1.0], [1.0]);
    follow(only, "volterra", &Volterra {}, &[], 1, start, 1e3);
    let start = State::new([2.0], [0.0]);
    follow(only, "atoms", &Atoms {}, &[], 1, start, 1e3);
}
