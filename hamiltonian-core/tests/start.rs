//! Starts on surfaces, against values from elsewhere and against H itself; coordinates of bodies.

use crate::common::systems::{Formula, Hand, HenonHeiles, Paper34, Relativistic};
use hamiltonian_core::VectorOf;
use hamiltonian_core::analysis::{
    Branch, Section, coordinate_on_event, momentum_from_energy, on_section,
};
use hamiltonian_core::errors::{InputError, ObservableError, SearchError, StartError};
use hamiltonian_core::systems::coordinates::{
    from_heliocentric, from_jacobi, to_heliocentric, to_jacobi,
};
use hamiltonian_core::{
    DoubleDouble, Dual, Error, Real, State, System, Vector,
    schemes::author::{Group, Observable, ObservableKind},
};

fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

/// A charge around a black hole in a magnetic field β:
/// H = −E²r/(2(r−2)) + (L − βr²sin²θ/2)²/(2r²sin²θ) + p_θ²/(2r²) + ½p_r²(1 − 2/r).
#[derive(Debug, Clone)]
struct Schwarzschild {
    beta: f64,
}

impl Formula<2> for Schwarzschild {
    const NAME: &'static str = "Schwarzschild";
    const GROUPS: &'static [Group] = &[
        Group::scalar("r", "p_r", 0),
        Group::scalar("theta", "p_theta", 1),
    ];
    const OBSERVABLES: &'static [Observable] = &[
        Observable::new(ObservableKind::Event, "equator"),
        Observable::new(ObservableKind::Event, "outward"),
        Observable::new(ObservableKind::Event, "never"),
        Observable::new(ObservableKind::Event, "pole"),
        Observable::new(ObservableKind::Event, "jump"),
    ];
    fn energy<T: Real>(&self, _: T, [r, theta]: &[T; 2], [p_r, p_theta]: &[T; 2]) -> T {
        let (two, half) = (number::<T>(2.0), number::<T>(0.5));
        let e = number::<T>(0.995);
        let (r, p_r, p_theta) = (*r, *p_r, *p_theta);
        let s2 = theta.sin() * theta.sin();
        let turning = number::<T>(4.6) - number::<T>(self.beta) * half * r * r * s2;
        half * (p_r * p_r * (T::one() - two / r) + p_theta * p_theta / (r * r))
            + half * turning * turning / (r * r * s2)
            - half * e * e * r / (r - two)
    }
    fn observable<T: Real>(&self, index: usize, _: T, q: &[T; 2], p: &[T; 2]) -> T {
        match index {
            0 => q[1].cos(),
            // Depends on the momentum that is solved for.
            1 => q[0] * number(0.2) - p[1],
            2 => q[0] * q[0] + T::one(),
            3 => T::one() / (q[0] - number(3.1)) + number(40.0),
            _ => number(if q[0].to_f64() < 10.7 { -0.01 } else { 1.0 }),
        }
    }
}

fn schwarzschild(beta: f64) -> Hand<Schwarzschild, 2> {
    Hand(Schwarzschild { beta })
}

fn guess<T: Real>(p_theta: f64) -> State<VectorOf<Hand<Schwarzschild, 2>, T>> {
    let half_pi = T::constant(core::f64::consts::FRAC_PI_2, 6.123233995736766e-17);
    State::over([number(11.0), half_pi], [T::zero(), number(p_theta)])
}

const MINUS_HALF: f64 = -0.5;

#[test]
fn the_momentum_around_a_black_hole_has_the_reference_values() {
    for (beta, expected) in [(0.0, 2.062449325976816), (8.9e-4, 2.178571077150628)] {
        let system = schwarzschild(beta);
        for start in [0.0, 0.1, 2.0, 2.5, 1e3, 1e9] {
            let found =
                momentum_from_energy(&system, &guess(start), 1, MINUS_HALF, Branch::Nearest)
                    .unwrap();
            // H is of order 1 and rounds there.
            assert!(
                (found.p[1] - expected).abs() < 2e-14,
                "{} from {start}",
                found.p[1]
            );
            assert_eq!((found.q, found.p[0]), (guess::<f64>(0.0).q, 0.0));
            assert!((system.energy(&found) + 0.5).abs() < 1e-15);
        }
        let other =
            momentum_from_energy(&system, &guess(3.0), 1, MINUS_HALF, Branch::Backward).unwrap();
        assert!((other.p[1] + expected).abs() < 2e-14);
        let near =
            momentum_from_energy(&system, &guess(-1.0), 1, MINUS_HALF, Branch::Nearest).unwrap();
        assert!((near.p[1] + expected).abs() < 2e-14);
    }
}

#[test]
fn a_longer_scalar_is_solved_to_its_own_digits() {
    let system = schwarzschild(0.0);
    let energy = DoubleDouble::from(MINUS_HALF);
    let found = momentum_from_energy(
        &system,
        &guess::<DoubleDouble>(2.0),
        1,
        energy,
        Branch::Nearest,
    )
    .unwrap();
    assert!((found.p[1].to_f64() - 2.062449325976816).abs() < 1e-14);
    let error = (system.energy(&found) - energy).to_f64();
    assert!(error.abs() < 1e-30, "{error:e}");
}

#[test]
fn over_duals_the_start_carries_its_derivative() {
    // dp/dE = 1/(∂H/∂p)
    let system = schwarzschild(0.0);
    let energy = Dual::variable(MINUS_HALF);
    let found = momentum_from_energy(
        &system,
        &guess::<Dual<f64>>(2.0),
        1,
        energy,
        Branch::Nearest,
    )
    .unwrap();
    let expected = 121.0 / found.p[1].re;
    assert!((found.p[1].eps - expected).abs() < 1e-11 * expected);
}

/// The value and the sign of the velocity of a root, from many guesses.
fn check_roots<H: Formula<1>>(formula: H, q: f64, energy: f64, roots: [f64; 2]) {
    let system = Hand(formula);
    for at in [-1e6, -3.0, -0.5, 0.0, 1e-9, 0.7, 3.0, 1e6] {
        for (branch, expected) in [(Branch::Backward, roots[0]), (Branch::Forward, roots[1])] {
            let found =
                momentum_from_energy(&system, &State::new([q], [at]), 0, energy, branch).unwrap();
            let error = (found.p[0] - expected).abs();
            assert!(
                error < 1e-14 * (1.0 + expected.abs()) / expected.abs().min(1.0),
                "{branch:?} from {at}: {} for {expected}",
                found.p[0]
            );
        }
        let expected = if at < 0.0 { roots[0] } else { roots[1] };
        let found =
            momentum_from_energy(&system, &State::new([q], [at]), 0, energy, Branch::Nearest)
                .unwrap();
        assert!(
            (found.p[0] - expected).abs() < 1e-6,
            "{} from {at}",
            found.p[0]
        );
    }
}

#[test]
fn hamiltonians_that_are_not_quadratic_are_solved() {
    // √(1 + p²) = 1 + E′, so p = ±√(E′(2 + E′)).
    let potential = -1.0;
    for kinetic in [0.5_f64, 1e-6, 1e3] {
        let p = (kinetic * (2.0 + kinetic)).sqrt();
        let energy = 1.0 + kinetic + potential;
        let got = ((energy - potential).powi(2) - 1.0).sqrt();
        assert!((got - p).abs() < 1e-9);
        check_roots(Relativistic, 0.0, energy, [-got, got]);
    }
    // ½(q² + 1)(p² + 1), and a root on the guess itself.
    check_roots(Paper34, 1.0, 5.0, [-2.0, 2.0]);
    let system = Hand(Paper34);
    let on = State::new([1.0], [2.0]);
    let same = momentum_from_energy(&system, &on, 0, 5.0, Branch::Nearest).unwrap();
    assert_eq!(same.p[0], 2.0);
    let other = momentum_from_energy(&system, &on, 0, 5.0, Branch::Backward).unwrap();
    assert!((other.p[0] + 2.0).abs() < 1e-14);
}

/// Shapes in p that are not even: linear, concave, shifted, with an edge.
#[derive(Debug, Clone)]
struct Shape(u8);

impl Formula<1> for Shape {
    const NAME: &'static str = "Shape";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    fn energy<T: Real>(&self, _: T, _: &[T; 1], [p]: &[T; 1]) -> T {
        let p = *p;
        match self.0 {
            0 => number::<T>(3.0) * p + T::one(),
            1 => number::<T>(2.0) - (p - number(5.0)) * (p - number(5.0)),
            2 => (p - number(100.0)) * (p - number(100.0)) - number(1e-4),
            3 => -(T::one() - p * p).sqrt(),
            _ => p.exp(),
        }
    }
}

#[test]
fn linear_concave_shifted_and_bounded_hamiltonians_are_solved() {
    let solve = |shape: u8, at: f64, energy: f64, branch| {
        momentum_from_energy(
            &Hand(Shape(shape)),
            &State::new([0.0], [at]),
            0,
            energy,
            branch,
        )
        .map(|state| state.p[0])
    };
    let close = |found: Result<f64, Error>, expected: f64| {
        let found = found.unwrap();
        assert!((found - expected).abs() < 1e-9, "{found}, {expected}");
    };
    for at in [-1e3, 0.0, 1e3] {
        close(solve(0, at, 7.0, Branch::Nearest), 2.0);
        close(solve(0, at, 7.0, Branch::Forward), 2.0);
        assert!(matches!(
            solve(0, at, 7.0, Branch::Backward),
            Err(Error::Search(SearchError::NoMomentum { .. }))
        ));
        // The increasing side of a concave one is the smaller root.
        close(solve(1, at, 1.0, Branch::Forward), 4.0);
        close(solve(1, at, 1.0, Branch::Backward), 6.0);
        close(solve(4, at.min(500.0), 2.0, Branch::Nearest), 2f64.ln());
        assert!(solve(4, at.min(500.0), -1.0, Branch::Nearest).is_err());
    }
    // Two roots 0.02 apart, far from the guess.
    for at in [0.0, 99.0, 1e5] {
        close(solve(2, at, 0.0, Branch::Backward), 99.99);
        close(solve(2, at, 0.0, Branch::Forward), 100.01);
    }
    // Defined for |p| ≤ 1 only.
    close(solve(3, 0.0, -0.25, Branch::Forward), 0.9375f64.sqrt());
    close(solve(3, 0.0, -0.25, Branch::Backward), -(0.9375f64.sqrt()));
    close(
        solve(3, 0.0, -1e-3, Branch::Forward),
        (1.0 - 1e-6f64).sqrt(),
    );
}

#[test]
fn beyond_a_turning_point_the_error_has_the_values() {
    let system = schwarzschild(0.0);
    // At r = 11 the least H is at p_θ = 0.
    let least: f64 = system.energy(&guess(0.0));
    for at in [0.0, 1.5, -40.0] {
        match momentum_from_energy(&system, &guess(at), 1, least - 0.01, Branch::Nearest) {
            Err(Error::Search(SearchError::NoMomentum {
                name,
                index,
                required,
                closest,
                at,
                ..
            })) => {
                assert_eq!((&*name, index), ("p_theta", 1));
                assert_eq!(required, least - 0.01);
                assert!((closest - least).abs() < 1e-12, "{closest} {least}");
                assert!(at.abs() < 1e-4);
            }
            other => panic!("{other:?}"),
        }
        // On it there is one.
        let found = momentum_from_energy(&system, &guess(at), 1, least, Branch::Nearest).unwrap();
        assert!(found.p[1].abs() < 1e-6);
    }
    let message = momentum_from_energy(&system, &guess(0.0), 1, -1e3, Branch::Nearest)
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("no `p_theta` (component 1) gives H = -1000:"),
        "{message}"
    );
}

#[test]
fn a_section_is_an_event_and_an_energy() {
    let system = schwarzschild(0.0);
    let section = Section {
        event: 0,
        coordinate: 1,
        momentum: 1,
    };
    let away = State::new([11.0, 1.1], [0.0, 0.5]);
    let found = on_section(&system, &away, section, MINUS_HALF, Branch::Forward).unwrap();
    assert!((found.q[1] - core::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!((found.p[1] - 2.062449325976816).abs() < 2e-14);
    // The nearest zero, not the first.
    let away = State::new([11.0, 4.0], [0.0, 0.5]);
    let found = coordinate_on_event(&system, &away, 0, 1).unwrap();
    assert!((found.q[1] - 1.5 * core::f64::consts::PI).abs() < 1e-14);
    assert_eq!(found.p, away.p);

    // Hénon–Heiles at E = 1/8 on x = 0: p_x from the rest.
    let system = Hand(HenonHeiles);
    let start = State::new([0.0, 0.1], [0.0, 0.2]);
    let found = momentum_from_energy(&system, &start, 0, 0.125, Branch::Forward).unwrap();
    let expected = (0.25f64 - 0.01 - 0.04 + 2e-3 / 3.0).sqrt();
    assert!((found.p[0] - expected).abs() < 1e-15);
}

#[test]
fn an_event_that_depends_on_the_momentum_is_solved_with_it() {
    let system = schwarzschild(0.0);
    let section = Section {
        event: 1,
        coordinate: 0,
        momentum: 1,
    };
    let away = State::new([10.0, 1.5], [0.0, 0.5]);
    let found = on_section(&system, &away, section, MINUS_HALF, Branch::Forward).unwrap();
    assert!((0.2 * found.q[0] - found.p[1]).abs() < 1e-13);
    assert!((system.energy(&found) + 0.5).abs() < 1e-14);
}

#[test]
fn what_is_not_there_is_an_error() {
    let system = schwarzschild(0.0);
    let start = guess::<f64>(1.0);
    assert!(matches!(
        momentum_from_energy(&system, &start, 2, MINUS_HALF, Branch::Nearest),
        Err(Error::Search(SearchError::Component {
            index: 2,
            count: 2,
            ..
        }))
    ));
    assert!(matches!(
        coordinate_on_event(&system, &start, 9, 0),
        Err(Error::Observable(ObservableError::Index {
            index: 9,
            count: 5,
            ..
        }))
    ));
    let broken = State::new([f64::NAN, 1.0], [0.0, 0.0]);
    assert!(matches!(
        momentum_from_energy(&system, &broken, 1, MINUS_HALF, Branch::Nearest),
        Err(Error::Start(StartError::NotFinite { .. }))
    ));
    match coordinate_on_event(&system, &start, 2, 0) {
        Err(Error::Search(SearchError::NoCrossing {
            event,
            name,
            from,
            value,
            ..
        })) => assert_eq!((&*event, &*name, from, value), ("never", "r", 11.0, 122.0)),
        other => panic!("{other:?}"),
    }
    // A pole is no zero: 1/(r − 3.1) = −40 is passed over for no other.
    let near = State::new([3.2, 1.0], [0.0, 0.0]);
    let found = coordinate_on_event(&system, &near, 3, 0).unwrap();
    assert!((found.q[0] - 3.075).abs() < 1e-12, "{}", found.q[0]);
    // Neither is a jump.
    assert!(matches!(
        coordinate_on_event(&system, &start, 4, 0),
        Err(Error::Search(SearchError::NoCrossing { event, .. })) if *event == *"jump"
    ));
    // No momentum where the event is.
    let section = Section {
        event: 0,
        coordinate: 1,
        momentum: 1,
    };
    assert!(matches!(
        on_section(&system, &start, section, -1e3, Branch::Nearest),
        Err(Error::Search(SearchError::NoMomentum { .. }))
    ));
}

/// n bodies in the plane with numbers of no particular kind.
fn bodies(
    n: usize,
) -> (
    State<
        hamiltonian_core::private::OMatrix<
            f64,
            hamiltonian_core::private::Dyn,
            hamiltonian_core::private::Const<2>,
        >,
    >,
    Vec<f64>,
) {
    let wave = |k: usize| (1.7 * k as f64 + 0.3).sin();
    let q: Vec<[f64; 2]> = (0..n).map(|i| [wave(4 * i), wave(4 * i + 1)]).collect();
    let p: Vec<[f64; 2]> = (0..n).map(|i| [wave(4 * i + 2), wave(4 * i + 3)]).collect();
    (
        State::new(q, p),
        (0..n).map(|i| 0.5 + wave(i).abs()).collect(),
    )
}

#[test]
fn maps_of_bodies_have_their_inverses() {
    for n in [1, 2, 3, 7, 40] {
        let (start, masses) = bodies(n);
        let there = to_jacobi(&start, &masses).unwrap();
        let back = from_jacobi(&there, &masses).unwrap();
        assert!(back.q.distance(&start.q) < 1e-14 && back.p.distance(&start.p) < 1e-14);
        if n > 1 {
            assert!(there.q.distance(&start.q) > 0.1);
        }
        let there = to_heliocentric(&start);
        let back = from_heliocentric(&there);
        assert!(back.q.distance(&start.q) < 1e-14 && back.p.distance(&start.p) < 1e-14);
        // The kinetic energy is diagonal in Jacobi's: Σ P²/2μ.
        let jacobi = to_jacobi(&start, &masses).unwrap();
        let (mut before, mut after, mut sum) = (0.0, 0.0, 0.0);
        let total: f64 = masses.iter().sum();
        for (i, mass) in masses.iter().enumerate() {
            let reduced = if i == 0 {
                total
            } else {
                1.0 / (1.0 / mass + 1.0 / sum)
            };
            sum += mass;
            for c in 0..2 {
                before += start.p[(i, c)].powi(2) / (2.0 * mass);
                after += jacobi.p[(i, c)].powi(2) / (2.0 * reduced);
            }
        }
        assert!((before - after).abs() < 1e-13 * before, "{before} {after}");
    }
}

#[test]
fn maps_of_bodies_are_canonical() {
    type Bodies = State<hamiltonian_core::private::SVector<Dual<f64>, 3>>;
    type Map = fn(&Bodies, &[f64; 3]) -> Bodies;
    let masses = [2.0, 0.5, 1.25];
    let maps: [Map; 4] = [
        |s, m| to_jacobi(s, m).unwrap(),
        |s, m| from_jacobi(s, m).unwrap(),
        |s, _| to_heliocentric(s),
        |s, _| from_heliocentric(s),
    ];
    // Masses that are not the map's own: (q of one, p of the other) is not canonical.
    let mixed: Map = |s, m| State {
        p: to_heliocentric(s).p,
        ..to_jacobi(s, m).unwrap()
    };
    let defect = |map: Map| {
        let columns: Vec<Vec<f64>> = (0..6)
            .map(|at| {
                let mut x = [0.3, -1.1, 0.8, 0.2, 0.9, -0.4].map(Dual::fixed);
                x[at].eps = 1.0;
                let state = State::over([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
                let image = map(&state, &masses);
                image
                    .q
                    .components()
                    .chain(image.p.components())
                    .map(|c| c.eps)
                    .collect()
            })
            .collect();
        let mut worst: f64 = 0.0;
        for a in 0..6 {
            for b in 0..6 {
                let form: f64 = (0..3)
                    .map(|k| columns[a][k] * columns[b][3 + k] - columns[a][3 + k] * columns[b][k])
                    .sum();
                let expected = f64::from(u8::from(b == a + 3)) - f64::from(u8::from(a == b + 3));
                worst = worst.max((form - expected).abs());
            }
        }
        worst
    };
    for map in maps {
        assert!(defect(map) < 1e-15, "{}", defect(map));
    }
    assert!(defect(mixed) > 0.1);
}

#[test]
fn bodies_that_do_not_fit_are_errors() {
    let (start, mut masses) = bodies(3);
    assert!(matches!(
        to_jacobi(&start, &masses[..2]),
        Err(Error::Input(InputError::Shape { .. }))
    ));
    assert!(matches!(
        to_jacobi(&start, &masses[..0]),
        Err(Error::Input(InputError::Shape { .. }))
    ));
    masses[0] = 0.0;
    assert!(matches!(
        to_jacobi(&start, &masses),
        Err(Error::Input(InputError::Masses {
            body: 0,
            sum: 0.0,
            ..
        }))
    ));
}
