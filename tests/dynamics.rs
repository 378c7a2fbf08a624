//! Events of definitions, located by a run; how orbits depend on their starts and on parameters.

use crate::common::is_heavy;
use hamiltonian::errors::{ObservableError, StartError};
use hamiltonian::prelude::*;

hamiltonian! {
    /// The Hénon–Heiles system.
    pub struct HenonHeiles {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3;
    event meridian = x
}

hamiltonian! {
    /// The restricted problem of three bodies in the frame that turns, in two pieces: without bodies,
    /// and what they pull.
    pub struct Arenstorf { mu = 0.012277471 }
    let r_earth = hypot(x + mu, y);
    let r_moon = hypot(x - (1 - mu), y);
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y - (1 - mu)/r_earth - mu/r_moon;
    split {
        free = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y;
        pull = -(1 - mu)/r_earth - mu/r_moon;
    }
    event axis = y
}

/// The regular orbit of which 306 upward crossings were confirmed in quadruple precision.
fn regular() -> StateOf<HenonHeiles> {
    State::new(
        [0.0, 0.2587703282931232],
        [-0.2525875586263492, -0.2178423952983717],
    )
}

#[test]
fn henon_heiles_crosses_the_meridian_306_times() {
    let new = || Integrator::new(&HenonHeiles {}, BlanesMoan6, regular(), 0.1).unwrap();
    let mut run = new().observe(Events::new([Event::named("meridian").with_direction(1)]));
    run.advance_to(2000.0).unwrap();
    let events = run.observer();
    assert_eq!(events.count("meridian"), 306);
    let mut plain = new();
    for state in events.states("meridian") {
        assert!(state.q[0].abs() <= 1e-15 && state.p[0] > 0.0, "{state:?}");
        // The orbit of the scheme itself crosses within 1e-12 of that time.
        let before = plain.advance_until(state.t - 1e-12).unwrap();
        let after = plain.advance_until(state.t + 1e-12).unwrap();
        assert!(before.q[0] < 0.0 && after.q[0] > 0.0, "{state:?}");
    }
    // Nobody asked, as far as the run is concerned.
    assert_eq!(run.state(), plain.advance_to(2000.0).unwrap());
}

hamiltonian! {
    /// H has no value at x < 0, and its derivative none at x = 0.
    pub struct Root { mu = 1.0 }
    H(x; p) = p^2/2 + mu*sqrt(x)
}

/// A run begins where H and its derivatives have values; the error names which, and the parameter
/// that is to blame where one is.
#[test]
fn starts_without_values_are_refused() {
    let refused = |mu, x| {
        let run = Integrator::new(&Root { mu }, RungeKutta4, State::new([x], [0.0]), 0.1);
        run.map_or_else(|error| error.to_string(), |_| String::new())
    };
    assert_eq!(refused(1.0, 1.0), "");
    let at = |x: &str, rest: &str| format!(" at the start t = 0, q = [{x}], p = [0.0]: {rest}");
    let place = "choose a start and parameters at which H and its first derivatives are finite";
    assert_eq!(refused(1.0, -1.0), format!("H is NaN{}", at("-1.0", place)));
    assert_eq!(
        refused(1.0, 0.0),
        format!("∂H/∂x is inf{}", at("0.0", place))
    );
    let parameter = "the parameter `mu = NaN` must be finite";
    assert_eq!(
        refused(f64::NAN, 1.0),
        format!("H is NaN{}", at("1.0", parameter))
    );
    let parameter = "the parameter `mu = inf` must be finite";
    assert_eq!(
        refused(f64::INFINITY, 1.0),
        format!("H is inf{}", at("1.0", parameter))
    );
}

#[test]
fn exponents_over_no_steps_are_an_error() {
    let start = State::new([1.0], [0.0]);
    let root = Root::default();
    let mut tangent = Tangent::new(&root, StormerVerlet::default(), start, 0.1, 1).unwrap();
    assert!(matches!(
        tangent.lyapunov(0, 1),
        Err(Error::Start(StartError::NoSteps { .. }))
    ));
    assert!(tangent.lyapunov(1, 0).unwrap()[0].is_finite());
}

#[test]
fn arenstorfs_orbit_closes() {
    let period = 17.065_216_560_157_964;
    let (x, v) = (0.994, -2.001_585_106_379_082_4);
    let start: StateOf<Arenstorf> = State::new([x, 0.0], [0.0, v + x]);
    const STEPS: u64 = 10_000;
    let step = period / STEPS as f64;
    let axis = Event::named("axis").with_direction(-1);
    let system = Arenstorf::default();
    let run = Integrator::new(&system, Gauss::<8>::default(), start.clone(), step);
    let mut run = run.unwrap().observe(Events::new([axis]));
    let end = run.advance(STEPS).unwrap();
    // κ = 2e6, and a pull of 340 on the spot: momenta are off by 170 times as much as coordinates. Gauss'
    // low words keep rounding from the sum of 80 000 stages.
    let (q, p) = ((end.q - start.q).norm(), (end.p - start.p).norm());
    println!("off by {q:.1e}, momenta by {p:.1e}");
    assert!(q <= 1e-8 && p <= 1e-8, "{q:e} {p:e}");
    run.advance(STEPS / 1000).unwrap();
    let end = run.observer().states("axis").last().unwrap();
    let (q, p) = ((end.q - start.q).norm(), (end.p - start.p).norm());
    println!(
        "at the axis, {:.1e} off in time: {q:.1e}, {p:.1e}",
        end.t - period
    );
    assert!(
        q <= 1e-8 && p <= 1e-8 && (end.t - period).abs() <= 1e-8,
        "{q:e} {p:e}"
    );
    // Exact flows without low words close the coordinates, and not the momenta.
    let mut run = Integrator::new(&system, KahanLi8, start.clone(), step / 2.0).unwrap();
    let end = run.advance(2 * STEPS).unwrap();
    let (q, p) = ((end.q - start.q).norm(), (end.p - start.p).norm());
    println!("Kahan–Li: {q:.1e}, {p:.1e}");
    assert!(q <= 1e-8 && p > 1e-8, "{q:e} {p:e}");
}

hamiltonian! {
    /// A pendulum.
    pub struct Swing { g = 1.0, l = 1.0 }
    H(theta; p) = p^2/(2*l^2) - g*l*cos(theta)
}

/// With respect to a parameter: a run over dual numbers in which it is the variable.
#[test]
fn sensitivities_to_parameters() {
    let end = |l: f64| {
        let start = State::new([0.5], [0.1]);
        let mut run = Integrator::new(&Swing { g: 9.81, l }, BlanesMoan6, start, 1e-2).unwrap();
        run.advance(300).unwrap().q[0]
    };
    let swing = Swing {
        g: Dual::fixed(9.81),
        l: Dual::variable(2.0),
    };
    let start = State::over([Dual::fixed(0.5)], [Dual::fixed(0.1)]);
    let mut run = Integrator::new(&swing, BlanesMoan6, start, Dual::fixed(1e-2)).unwrap();
    let theta = run.advance(300).unwrap().q[0];
    assert_eq!(theta.re, end(2.0));
    let d = 1e-4;
    let difference = (8.0 * (end(2.0 + d) - end(2.0 - d))
        - (end(2.0 + 2.0 * d) - end(2.0 - 2.0 * d)))
        / (12.0 * d);
    assert!(
        (theta.eps - difference).abs() < 1e-10,
        "{} {difference}",
        theta.eps
    );
    assert!(theta.eps.abs() > 0.1);
}

hamiltonian! {
    /// Kepler's problem in the time s with dt = r ds, in logarithms.
    pub struct Logarithmic {}
    H(x, y, time; p_x, p_y, p_t) = ln((p_x^2 + p_y^2)/2 + p_t) + ln(x^2 + y^2)/2;
    monitor energy_of_kepler = (p_x^2 + p_y^2)/2 - 1/hypot(x, y)
}

hamiltonian! {
    /// Kepler's problem.
    pub struct Kepler {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/hypot(x, y)
}

hamiltonian! {
    /// An oscillator, seen by a light that goes round.
    pub struct Lit {}
    H(q; p; t) = (p^2 + q^2)/2;
    monitor place = 1 + q^2;
    monitor light = 2 + q*sin(t)
}

#[test]
fn monitor_functions_are_of_coordinates_and_momenta_alone() {
    assert!(TimeTransformed::by(Lit {}, "place").is_ok());
    // At q = 0 the light does not change.
    let timed = TimeTransformed::by(Lit {}, "light").expect_err("time is in it");
    let Error::Observable(ObservableError::Timed { name, system, .. }) = timed else {
        panic!("{timed}");
    };
    assert_eq!((&*name, &*system), ("light", "Lit"));
    let unknown = TimeTransformed::by(Lit {}, "plaice").expect_err("there is none");
    assert_eq!(
        unknown.to_string(),
        "`Lit` declares no monitor, invariant or event `plaice`\nhelp: it declares `place`, `light`"
    );
    let Error::Observable(ObservableError::Unknown { known, .. }) = unknown else {
        panic!("{unknown}");
    };
    assert_eq!(&*known, &["place".into(), "light".into()]);
}

/// The place on the ellipse of eccentricity .9 at a time, from the farthest point.
fn on_ellipse(t: f64) -> [f64; 2] {
    let e = 0.9_f64;
    let mut anomaly = t + core::f64::consts::PI;
    for _ in 0..60 {
        let (sin, cos) = anomaly.sin_cos();
        anomaly -= (anomaly - e * sin - t - core::f64::consts::PI) / (1.0 - e * cos);
    }
    [anomaly.cos() - e, (1.0 - e * e).sqrt() * anomaly.sin()]
}

/// Steps that are short where the orbit is fast, by a symplectic scheme that stays explicit.
#[test]
fn symplectic_variable_steps_by_a_change_of_time() {
    let tau = core::f64::consts::TAU;
    let (q, p) = ([-1.9, 0.0], [0.0, -(0.1_f64 / 1.9).sqrt()]);
    let shell = 0.5;
    let new = |step: f64| {
        let start = State::new([q[0], q[1], 0.0], [p[0], p[1], shell]);
        Integrator::new(&Logarithmic {}, BlanesMoan6, start, step).unwrap()
    };
    // The error after five periods, by steps a period.
    let off = |x: f64, y: f64, t: f64| {
        let [a, b] = on_ellipse(t);
        (x - a).hypot(y - b)
    };
    let variable = |steps: u64| {
        let mut run = new(tau / steps as f64);
        let State { q, .. } = run.advance(5 * steps).unwrap();
        off(q[0], q[1], q[2])
    };
    let fixed = |steps: u64| {
        let start = State::new(q, p);
        let step = tau / steps as f64;
        let mut run = Integrator::new(&Kepler {}, BlanesMoan6, start, step).unwrap();
        let State { q, t, .. } = run.advance(5 * steps).unwrap();
        off(q[0], q[1], *t)
    };
    let goal = 1e-8;
    let needed = |error: &dyn Fn(u64) -> f64| {
        (0..)
            .map(|k| 25 << k)
            .find(|steps| error(*steps) < goal)
            .unwrap()
    };
    let (few, many) = (needed(&variable), needed(&fixed));
    println!("to {goal:e}: {few} steps a period, fixed ones {many}");
    assert!(10 * few <= many, "{few} {many}");

    // The largest |ΔH| of each tenth, over 10⁵ periods. The golden section in the step brings every place
    // of the orbit, whose period in s is 2π, among the steps.
    let periods = if is_heavy() { 100_000 } else { 1_000 };
    let golden = (5_f64.sqrt() - 1.0) / 2.0;
    let mut run = new(tau / (50.0 + golden));
    let energy = -0.5;
    let mut tenths = [0.0_f64; 10];
    for tenth in &mut tenths {
        for _ in 0..5 * periods {
            run.advance(1).unwrap();
            let found = run.observable_named("energy_of_kepler").unwrap();
            *tenth = tenth.max((found - energy).abs());
        }
    }
    println!("{tenths:?}");
    assert!(
        tenths.iter().all(|tenth| *tenth <= 1.02 * tenths[0]),
        "{tenths:?}"
    );
}
