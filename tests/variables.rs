//! Other variables: coordinates, times, and the forces, pieces and events carried along.

#[path = "variables/friction.rs"]
mod friction;

use hamiltonian::analysis::{Branch, Section, momentum_from_energy, on_section};
use hamiltonian::errors::{SearchError, StartError};
use hamiltonian::prelude::*;
use hamiltonian::{Dual, schemes::author::Dynamics};

use crate::common::canonical::{close, equal};

hamiltonian! {
    /// A planet in the plane, with drag and an event.
    pub struct Flat { mu = 1.2, drag = 0.1, B = 0.3 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - mu/sqrt(x^2 + y^2) + B*(x*p_y - y*p_x);
    force(x, y; p_x, p_y) = [-drag*p_x, -drag*p_y + x*y];
    monitor angular_momentum = x*p_y - y*p_x;
    event crossing = x - y^2;
    split { K = (p_x^2 + p_y^2)/2 + B*(x*p_y - y*p_x); V = -mu/sqrt(x^2 + y^2) }
}

hamiltonian! {
    /// The same in polar coordinates.
    pub struct Polar { mu = 1.2, drag = 0.1, B = 0.3 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - mu/sqrt(x^2 + y^2) + B*(x*p_y - y*p_x);
    coordinates polar(x, y);
    force(x, y; p_x, p_y) = [-drag*p_x, -drag*p_y + x*y];
    monitor angular_momentum = x*p_y - y*p_x;
    event crossing = x - y^2;
    split { K = (p_x^2 + p_y^2)/2 + B*(x*p_y - y*p_x); V = -mu/sqrt(x^2 + y^2) }
}

hamiltonian! {
    /// Kepler in the time s with dt = r ds.
    pub struct Sundman { mu = 1.0, drag = 0.1 }
    let r = sqrt(x^2 + y^2);
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - mu/r;
    dt = r*ds;
    force(x, y; p_x, p_y) = [-drag*p_x, -drag*p_y];
    event pericentre = x*p_x + y*p_y;
    split { K = (p_x^2 + p_y^2)/2; V = -mu/r }
}

hamiltonian! {
    /// A driven oscillator in a time that runs with its phase.
    pub struct Driven { a = 0.3 }
    H(q; p; t) = p^2/2 + q^2/2 - a*q*cos(t);
    dt = (2 + q^2)*ds
}

hamiltonian! {
    /// A geodesic of Kerr in proper time.
    pub struct Kerr { a = 0.9, M = 1.0, E = 0.95, L = 3.0 }
    let Sigma = r^2 + a^2*cos(theta)^2;
    let Delta = r^2 - 2*M*r + a^2;
    H(r, theta; p_r, p_theta) = (Delta*p_r^2 + p_theta^2 - ((r^2 + a^2)*E - a*L)^2/Delta
        + (L - a*E*sin(theta)^2)^2/sin(theta)^2)/(2*Sigma)
}

hamiltonian! {
    /// The same in Mino's time.
    pub struct Mino { a = 0.9, M = 1.0, E = 0.95, L = 3.0 }
    let Sigma = r^2 + a^2*cos(theta)^2;
    let Delta = r^2 - 2*M*r + a^2;
    H(r, theta; p_r, p_theta) = (Delta*p_r^2 + p_theta^2 - ((r^2 + a^2)*E - a*L)^2/Delta
        + (L - a*E*sin(theta)^2)^2/sin(theta)^2)/(2*Sigma);
    dt = Sigma*ds
}

hamiltonian! {
    /// Polar coordinates, then Sundman's time.
    pub struct Both { mu = 1.0 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - mu/sqrt(x^2 + y^2);
    coordinates polar(x, y);
    dt = sqrt(x^2 + y^2)*ds
}

hamiltonian! {
    /// Bodies with a force, in Jacobi coordinates and in another time.
    pub struct Dragged { m: [3], g = 0.1 }
    H(q[3][2]; p[3][2]) = sum(i in 0..3) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..3, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates jacobi(q, m);
    dt = norm(q[1] - q[0])*ds;
    force(q; p) = -g*norm_squared(q[0])*p
}

hamiltonian! {
    /// A Lagrangian in another time, in a magnetic field.
    pub struct Charge { B = 0.5 }
    L(x, y; vx, vy; t) = (vx^2 + vy^2)/2 + B*vx*y - x^2*cos(t);
    dt = (2 + x^2)*ds
}

hamiltonian! {
    /// Forces on vectors of literal length, whose components are chosen by number.
    pub struct Pulled { B: [3] }
    H(q[3], x[2]; p[3], v[2]) = norm_squared(p)/2 + norm_squared(v)/2;
    force(q, x; p, v) = [cross(p, B) - [0, 0, 1], sum(k in 0..3) { k*v }]
}

hamiltonian! {
    /// Coordinates of mixed shape in pieces.
    pub struct Pieces<const N: usize> { n: usize, k = 0.5 }
    H(q[N], x[n], u; p[N], v[n], w) = norm_squared(p)/2 + norm_squared(v)/2 + w^2/2
        + k*u*(norm_squared(q) + norm_squared(x));
    split { Free = norm_squared(p)/2 + norm_squared(v)/2 + w^2/2;
        Bound = k*u*(norm_squared(q) + norm_squared(x)) }
}

fn planet() -> State<<[f64; 2] as hamiltonian::IntoVector<hamiltonian::shape::Array>>::Vector> {
    State::new([0.7, -0.4], [0.3, 1.1])
}

#[test]
fn forces_are_carried() {
    // A force f on p does the power f·q̇; in other coordinates it does the same.
    let (flat, polar) = (Flat::default(), Polar::default());
    let (old, new) = (planet(), polar.from_declared(&planet()));
    let power = |f: [f64; 2], v: [f64; 2]| f[0] * v[0] + f[1] * v[1];
    let f = flat.force(&old);
    close(f[0], -0.1 * 0.3);
    close(f[1], -0.1 * 1.1 + 0.7 * -0.4);
    let here = power(f.into(), flat.gradient(&old).p.into());
    let there = power(polar.force(&new).into(), polar.gradient(&new).p.into());
    close(here, there);
    // And to the momenta by the derivative of the map.
    let pushed = polar.from_declared(&State::over(
        [Dual::fixed(0.7), Dual::fixed(-0.4)],
        [Dual::new(0.3, f[0]), Dual::new(1.1, f[1])],
    ));
    for k in 0..2 {
        close(polar.force(&new)[k], pushed.p[k].eps);
    }
    // In another time: g·f, and the energy is followed by p_t.
    let sundman = Sundman::default();
    let state = sundman.on_shell(&State::new([0.7, -0.4, 0.0], [0.3, 1.1, 0.0]));
    let r = 0.7f64.hypot(0.4);
    let f = sundman.force(&state);
    close(f[0], -0.1 * 0.3 * r);
    close(f[1], -0.1 * 1.1 * r);
    close(f[2], 0.1 * (0.3 * 0.3 + 1.1 * 1.1) * r);
}

#[test]
fn forces_on_arrays() {
    let pulled = Pulled::new([0.0, 2.0, 0.0]);
    let zero = PulledVector::new([0.0; 3], [0.0; 2]);
    let p = PulledVector::new([1.0, 5.0, 3.0], [0.5, -1.0]);
    let force = pulled.force(&State { t: 0.0, q: zero, p });
    assert_eq!(force, PulledVector::new([-6.0, 0.0, 1.0], [1.5, -3.0]));
    let m = [3.0, 1.0, 0.5];
    let system = Dragged {
        m: m.into(),
        g: 0.1,
    };
    let q = [[0.1, 0.2], [1.0, 0.3], [-1.5, 0.4]];
    let p = [[0.1, -0.3], [0.2, 1.3], [-0.1, -0.4]];
    let bodies = State::new(q, p);
    let jacobi = hamiltonian::systems::coordinates::to_jacobi(&bodies, &m).unwrap();
    let state = State {
        t: 0.0,
        q: DraggedVector {
            q_jacobi: jacobi.q,
            t: 0.0,
        },
        p: DraggedVector {
            q_jacobi: jacobi.p,
            t: 0.0,
        },
    };
    let state = system.on_shell(&state);
    let declared = system.from_declared(&bodies);
    equal(&declared.q, &state.q);
    equal(&declared.p, &state.p);
    let back = system.to_declared(&state);
    equal(&back.q, &bodies.q);
    equal(&back.p, &bodies.p);
    let force = system.force(&state);
    // The map is linear: a force is carried as the momenta are.
    let factor = 0.9f64.hypot(0.1);
    let pull = -0.1 * (0.01 + 0.04) * factor;
    equal(&force.q_jacobi, &(state.p.q_jacobi * pull));
    let kinetic: f64 = (0..3)
        .map(|i| (p[i][0] * p[i][0] + p[i][1] * p[i][1]) / m[i])
        .sum();
    close(force.t, -pull * kinetic);
    close(system.energy(&state), 0.0);
}

#[test]
fn pieces_add_up() {
    let (flat, polar, sundman) = (Flat::default(), Polar::default(), Sundman::default());
    let here = planet();
    close(
        flat.energy(&here),
        flat.piece_k().energy(&here) + flat.piece_v().energy(&here),
    );
    let there = polar.from_declared(&here);
    let (k, v) = (polar.piece_k(), polar.piece_v());
    close(polar.energy(&there), k.energy(&there) + v.energy(&there));
    close(v.energy(&there), flat.piece_v().energy(&here));
    let (g, a, b) = (
        polar.gradient(&there),
        k.gradient(&there),
        v.gradient(&there),
    );
    equal(&g.q, &(a.q + b.q));
    equal(&g.p, &(a.p + b.p));
    let state = State::new([0.7, -0.4, 0.3], [0.3, 1.1, 0.9]);
    let (k, v, c) = (sundman.piece_k(), sundman.piece_v(), sundman.piece_clock());
    let g = sundman.gradient(&state);
    let (a, b, c) = (k.gradient(&state), v.gradient(&state), c.gradient(&state));
    equal(&g.q, &(a.q + b.q + c.q));
    equal(&g.p, &(a.p + b.p + c.p));
}

#[test]
fn gradients_of_events() {
    let (flat, polar) = (Flat::default(), Polar::default());
    let here = planet();
    let gradient = flat.crossing_gradient(&here);
    equal(&gradient.q, &[1.0, 0.8].into());
    equal(&gradient.p, &[0.0, 0.0].into());
    let there = polar.from_declared(&here);
    close(polar.crossing(&there), flat.crossing(&here));
    let gradient = polar.crossing_gradient(&there);
    for k in 0..4 {
        let mut q = [Dual::fixed(there.q[0]), Dual::fixed(there.q[1])];
        let mut p = [Dual::fixed(there.p[0]), Dual::fixed(there.p[1])];
        let expected = if k < 2 {
            q[k].eps = 1.0;
            gradient.q[k]
        } else {
            p[k - 2].eps = 1.0;
            gradient.p[k - 2]
        };
        close(polar.crossing(&State::over(q, p)).eps, expected);
    }
}

#[test]
fn starts_off_the_shell_are_errors() {
    let kepler = Sundman {
        drag: 0.0,
        ..Default::default()
    };
    let run = |start| Integrator::new(&kepler, RungeKutta4, start, 1e-3).map(|_| ());
    let start = State::new([0.4, 0.0, 0.0], [0.0, 2.0, 0.0]);
    let Err(Error::Start(StartError::Shell {
        momentum,
        value,
        due,
        ..
    })) = run(start.clone())
    else {
        panic!("p_t = 0 is not the shell");
    };
    assert_eq!((&*momentum, value), ("p_t", 0.0));
    close(due, 0.5);
    let mut on = kepler.on_shell(&start);
    run(on.clone()).unwrap();
    // Another run can go on where a run with an error in its energy ended.
    on.p[2] = 0.500_1;
    run(on.clone()).unwrap();
    on.p[2] = 0.51;
    assert!(matches!(
        run(on),
        Err(Error::Start(StartError::Shell { .. }))
    ));
    // At rest far out nothing but p_t and the potential is there.
    let rest = State::new([1e8, 0.0, 0.0], [0.0, 0.0, 0.0]);
    run(kepler.on_shell(&rest)).unwrap();
    assert!(matches!(
        run(rest),
        Err(Error::Start(StartError::Shell { .. }))
    ));
    // A parabola: H = 0, so that p_t is 0 on the shell.
    run(State::new([0.5, 0.0, 0.0], [0.0, 2.0, 0.0])).unwrap();
}

/// A table and a drift in another time: s and t are columns of their own, H is the declared one.
#[test]
fn runs_in_another_time_show_the_declared_energy() {
    let kepler = Sundman {
        drag: 0.0,
        ..Default::default()
    };
    let start = kepler.from_declared(&State::new([0.4, 0.0], [0.0, 2.0]));
    let mut run = Integrator::new(&kepler, Gauss::<4>::default(), start, 0.01)
        .unwrap()
        .observe((Recorder::new().with_energy(), EnergyDrift::new()));
    run.advance(100).unwrap();
    let (recorder, drift) = run.observer();
    assert_eq!(recorder.columns()[..4], ["s", "x", "y", "t"]);
    let [s, t] = ["s", "t"].map(|name| recorder.column(name).unwrap().last().unwrap());
    assert_eq!((s, t), (run.time(), run.state().q[2]));
    let declared = kepler.to_declared(run.state());
    let energy = declared.p.norm_squared() / 2.0 - 1.0 / declared.q.norm();
    close(run.energy(), energy);
    close(drift.mean(), -0.5);
    assert!(drift.max_relative() < 1e-12, "{}", drift.max_relative());
    assert_eq!(recorder.column("H").unwrap().last(), Some(run.energy()));
    // g·(h + p_t) itself is nothing but rounding.
    assert!(kepler.energy(run.state()).abs() < 1e-12);
}

#[test]
fn sundman() {
    // a = 1, e = 0.6: the period is 2π in t, and 2π in s, as dt = r ds and the mean of 1/r is 1/a.
    let period = 2.0 * std::f64::consts::PI;
    let kepler = Sundman {
        drag: 0.0,
        ..Default::default()
    };
    let start = kepler.on_shell(&State::new([0.4, 0.0, 0.0], [0.0, 2.0, 0.0]));
    close(start.p[2], 0.5);
    close(kepler.energy(&start), 0.0);
    let steps = 20_000u32;
    let mut run = Integrator::new(
        &kepler,
        RungeKutta4,
        start.clone(),
        period / f64::from(steps),
    )
    .unwrap();
    run.advance(u64::from(steps)).unwrap();
    let end = run.state();
    assert!((end.q[2] - period).abs() < 1e-11, "{}", end.q[2]);
    assert!((end.q[0] - 0.4).abs() < 1e-11 && end.q[1].abs() < 1e-10);
    assert!((end.t - period).abs() < 1e-12);
    assert!((end.p[2] - 0.5).abs() < 1e-11);
    let sundman = Sundman::default();
    let names: Vec<_> = (sundman.description().groups.iter())
        .map(|g| (&*g.coordinate, &*g.momentum))
        .collect();
    assert_eq!(names[2], ("t", "p_t"));
    close(kepler.pericentre(&start), 0.0);
    // The same start from the time and the variables of H, whose shape is theirs.
    let declared = State::new([0.4, 0.0], [0.0, 2.0]).at(3.0);
    let again = kepler.from_declared(&declared);
    assert_eq!((again.t, again.q[2]), (0.0, 3.0));
    close(again.p[2], 0.5);
    assert_eq!(kepler.to_declared(&again), declared);
}

#[test]
fn times_of_a_driven_system() {
    hamiltonian! {
        /// As it was before.
        struct Before { a = 0.3 }
        H(q; p; t) = p^2/2 + q^2/2 - a*q*cos(t)
    }
    let (driven, before) = (Driven::default(), Before::default());
    let start = driven.on_shell(&State::new([0.5, 0.2], [0.1, 0.0]));
    close(
        start.p[1],
        -before.energy(&State::new([0.5], [0.1]).at(0.2)),
    );
    let mut run = Integrator::new(&driven, RungeKutta4, start, 1e-3).unwrap();
    run.advance(1000).unwrap();
    let end = run.state().clone();
    let span = end.q[1] - 0.2;
    assert!(span > 1.0);
    let state = State::new([0.5], [0.1]).at(0.2);
    let mut run = Integrator::new(&before, RungeKutta4, state, span / 1000.0).unwrap();
    run.advance(1000).unwrap();
    assert!((run.state().q[0] - end.q[0]).abs() < 1e-10);
    assert!((run.state().p[0] - end.p[0]).abs() < 1e-10);
}

#[test]
fn mino() {
    let (kerr, mino) = (Kerr::default(), Mino::default());
    let guess = State::new([8.0, 1.4], [0.05, 0.6]);
    let start = momentum_from_energy(&kerr, &guess, 0, -0.5, Branch::Forward).unwrap();
    let again = State::new([8.0, 1.4, 0.0], [start.p[0], 0.6, 0.0]);
    let again = mino.on_shell(&again);
    close(again.p[2], 0.5);
    let mut run = Integrator::new(&mino, RungeKutta4, again, 1e-4).unwrap();
    run.advance(2000).unwrap();
    let end = run.state().clone();
    let tau = end.q[2];
    let mut run = Integrator::new(&kerr, RungeKutta4, start, tau / 2000.0).unwrap();
    run.advance(2000).unwrap();
    assert!((run.state().q[0] - end.q[0]).abs() < 1e-9);
    assert!((run.state().q[1] - end.q[1]).abs() < 1e-9);
    // H splits in Mino's time into a part of r and one of theta.
    let gradient = mino.gradient(&end);
    close(
        gradient.p[2],
        end.q[0].powi(2) + 0.81 * end.q[1].cos().powi(2),
    );
}

#[test]
fn coordinates_then_time() {
    let both = Both::default();
    let start = both.on_shell(&State::new([0.4, 0.0, 0.0], [0.0, 0.8, 0.0]));
    close(start.p[2], 0.5);
    let declared = State::new([0.4, 0.0], [0.0, 2.0]);
    assert_eq!(both.from_declared(&declared), start);
    equal(&both.to_declared(&start).p, &declared.p);
    let period = 2.0 * std::f64::consts::PI;
    let mut run = Integrator::new(&both, RungeKutta4, start, period / 20_000.0).unwrap();
    run.advance(20_000).unwrap();
    let end = run.state();
    assert!((end.q[0] - 0.4).abs() < 1e-10);
    assert!((end.q[1] - period).abs() < 1e-10);
    assert!((end.q[2] - period).abs() < 1e-10);
}

#[test]
fn starts() {
    let flat = Flat::default();
    let guess = State::new([0.7, -0.4], [0.3, 1.0]);
    let start = momentum_from_energy(&flat, &guess, 1, -0.9, Branch::Nearest).unwrap();
    close(flat.energy(&start), -0.9);
    assert_eq!((start.p[0], start.q[0]), (0.3, 0.7));
    let section = Section {
        event: 1,
        coordinate: 0,
        momentum: 1,
    };
    let start = on_section(&flat, &guess, section, -0.9, Branch::Forward).unwrap();
    close(start.q[0], 0.16);
    close(flat.energy(&start), -0.9);
    assert!(flat.gradient(&start).p[1] > 0.0);
    // Below the least value of H there is none.
    let none = momentum_from_energy(&flat, &guess, 1, -9.0, Branch::Nearest);
    assert!(matches!(
        none,
        Err(Error::Search(SearchError::NoMomentum { name, index: 1, .. })) if *name == *"p_y"
    ));
    // In another time the shell is K = 0, which fixes p_t, or any other momentum with p_t = −E.
    let sundman = Sundman::default();
    let guess = State::new([0.4, 0.0, 0.0], [0.0, 1.5, 0.5]);
    let start = momentum_from_energy(&sundman, &guess, 1, 0.0, Branch::Forward).unwrap();
    close(start.p[1], 2.0);
    let p_t = momentum_from_energy(
        &sundman,
        &State::new([0.4, 0.0, 0.0], [0.0, 2.0, 0.0]),
        2,
        0.0,
        Branch::Nearest,
    );
    close(p_t.unwrap().p[2], 0.5);
    // And over duals the start carries its derivatives: p_y ∂p_y/∂E = 1.
    let guess = State::over(
        [Dual::fixed(0.4), Dual::fixed(0.0), Dual::fixed(0.0)],
        [Dual::fixed(0.0), Dual::fixed(1.5), Dual::new(0.5, -1.0)],
    );
    let start =
        momentum_from_energy(&sundman, &guess, 1, Dual::fixed(0.0), Branch::Forward).unwrap();
    close(start.p[1].eps, 0.5);
    let prepared = System::prepare::<f64>(&sundman);
    close(
        prepared.time_derivative(0.0, &[0.4, 0.0, 0.0].into(), &[0.0, 2.0, 0.5].into()),
        0.0,
    );
}

#[test]
fn lagrangians_in_another_time() {
    let charge = Charge::default();
    let start = charge.state_from_velocity(0.3, [1.0, 2.0], [0.5, 0.6]);
    assert_eq!((start.t, start.q[2]), (0.0, 0.3));
    assert_eq!((start.p[0], start.p[1]), (1.5, 0.6));
    close(start.p[2], -(0.25 + 0.36) / 2.0 - 0.3f64.cos());
    close(charge.energy(&start), 0.0);
    let velocity = charge.velocity(&start);
    assert_eq!((velocity[0], velocity[1], velocity[2]), (0.5, 0.6, 1.0));
    // On the shell the gradient is g times the velocities.
    let gradient = charge.gradient(&start);
    equal(&gradient.p, &(velocity * 3.0));
}

#[test]
fn pieces_take_the_states_of_the_whole() {
    let whole = Pieces::<2>::new(3).unwrap();
    let state = State {
        t: 0.0,
        q: PiecesVector::new([0.1, 0.2], vec![0.3, 0.4, 0.5], 0.6),
        p: PiecesVector::new([0.7, 0.8], vec![0.9, 1.0, 1.1], 1.2),
    };
    let (free, bound) = (whole.piece_free(), whole.piece_bound());
    close(
        whole.energy(&state),
        free.energy(&state) + bound.energy(&state),
    );
    let (g, a, b) = (
        whole.gradient(&state),
        free.gradient(&state),
        bound.gradient(&state),
    );
    equal(&g.q, &b.q);
    equal(&g.p, &a.p);
}

/// In another time, p_t = −h: a changed state, or a changed system, goes on on its own shell.
#[test]
fn runs_in_another_time_can_be_changed() {
    let kepler = Sundman {
        drag: 0.0,
        ..Default::default()
    };
    let start = || kepler.from_declared(&State::new([1.0, 0.0], [0.0, 1.1]));
    let mut run = Integrator::new(&kepler, Gauss::<2>::default(), start(), 0.01).unwrap();
    run.advance(100).unwrap();
    let mut kicked = run.state().clone();
    kicked.p[1] += 0.2;
    let energy = |run: &Integrator<f64, Sundman, _>| kepler.energy(run.state());
    run.set_state(kicked.clone()).unwrap();
    let state = run.state();
    assert_eq!(
        (&state.q, state.p[0], state.p[1]),
        (&kicked.q, kicked.p[0], kicked.p[1])
    );
    assert!(energy(&run).abs() < 1e-15, "on the shell");
    assert!(kepler.energy(&kicked).abs() > 0.1, "the kick left it");
    let before = run.state().clone();
    let heavier = Sundman {
        mu: 1.3,
        ..kepler.clone()
    };
    run.set_system(&heavier).unwrap();
    assert!(heavier.energy(run.state()).abs() < 1e-15 && heavier.energy(&before).abs() > 0.1);
    // The same run, begun there.
    let mut new =
        Integrator::new(&heavier, Gauss::<2>::default(), run.state().clone(), 0.01).unwrap();
    run.advance(50).unwrap();
    new.advance(50).unwrap();
    assert!(
        (run.state().q - new.state().q)
            .iter()
            .all(|x| x.abs() < 1e-14)
    );

    let mut swarm = Ensemble::new(
        9,
        |_| (kepler.clone(), start()),
        Gauss::<2>::default(),
        0.01,
    )
    .unwrap();
    swarm.advance(10);
    swarm.update(|member, state| state.p[0] += 0.05 * member.index as f64);
    swarm.advance(10);
    for state in swarm.states() {
        assert!(kepler.energy(&state.unwrap()).abs() < 1e-4);
    }
}
