//! Periodic orbits against known ones, from rough guesses, near equilibria and other orbits.
//!
//! Input: random oscillators whose periods are elliptic integrals, and random restricted problems of three bodies.
//! Output: orbits and errors. No orbit may be wrong: each is followed anew, by another scheme in shorter steps.

mod others;

use crate::common::difference;
use crate::common::random::{Random, cases};
use crate::common::systems::{Formula, Hand, HenonHeiles};
use core::f64::consts::{PI, TAU};
use hamiltonian_core::errors::SearchError;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::author::{Group, Observable, ObservableKind};
use hamiltonian_core::{Error, Real};

fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

const fn event(name: &'static str) -> Observable {
    Observable::new(ObservableKind::Event, name)
}

/// One type for two systems, since a search is compiled for each type.
#[derive(Debug, Clone)]
enum Oscillator {
    /// H = p²/2 + a·q²/2 + b·q⁴/4.
    Duffing { a: f64, b: f64 },
    /// H = p²/2 − a·cos q.
    Pendulum { a: f64 },
    /// H = p²/2 + k·q²/2 − a·q·cos t.
    Driven { a: f64, k: f64 },
}

impl Formula<1> for Oscillator {
    const NAME: &'static str = "Oscillator";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    const OBSERVABLES: &'static [Observable] = &[event("turn")];
    fn energy<T: Real>(&self, t: T, [q]: &[T; 1], [p]: &[T; 1]) -> T {
        let square = *q * *q;
        let potential = match self {
            Oscillator::Duffing { a, b } => {
                square * (number::<T>(0.5 * a) + number::<T>(0.25 * b) * square)
            }
            Oscillator::Pendulum { a } => number::<T>(-a) * q.cos(),
            Oscillator::Driven { a, k } => {
                number::<T>(0.5 * k) * square - number::<T>(*a) * *q * t.cos()
            }
        };
        number::<T>(0.5) * *p * *p + potential
    }
    fn gradient<T: Real>(&self, t: T, [q]: &[T; 1], [p]: &[T; 1]) -> ([T; 1], [T; 1]) {
        let force = match self {
            Oscillator::Duffing { a, b } => *q * (number::<T>(*a) + number::<T>(*b) * *q * *q),
            Oscillator::Pendulum { a } => number::<T>(*a) * q.sin(),
            Oscillator::Driven { a, k } => number::<T>(*k) * *q - number::<T>(*a) * t.cos(),
        };
        ([force], [*p])
    }
    fn observable<T: Real>(&self, _: usize, _: T, _: &[T; 1], p: &[T; 1]) -> T {
        p[0]
    }
}

impl Oscillator {
    /// The period of the orbit through (x, 0): 4K(m)/Ω with Ω² = a + b·x² and m = b·x²/(2Ω²), or Ω² = a and
    /// m = sin²(x/2).
    fn period(&self, x: f64) -> f64 {
        let (square, v) = match self {
            Oscillator::Duffing { a, b } => {
                let square = a + b * x * x;
                (square, (1.0 - b * x * x / (2.0 * square)).sqrt())
            }
            Oscillator::Pendulum { a } => (*a, (x / 2.0).cos()),
            Oscillator::Driven { .. } => (1.0, 1.0),
        };
        let (mut u, mut v) = (1.0, v);
        for _ in 0..8 {
            (u, v) = ((u + v) / 2.0, (u * v).sqrt());
        }
        TAU / (u * square.sqrt())
    }
}

/// The one orbit of a driven oscillator that has the period of its force is q = a·cos t/(k − 1).
#[test]
fn driven_oscillators_follow_their_force() {
    let (mut found, mut refused) = (0, 0);
    for seed in 0..cases(300, 10_000) {
        let mut random = Random(40_000 + seed);
        let periods = 1 + random.below(2);
        // Between resonances.
        let k = (random.below(4) as f64 + random.between(0.1, 0.9)).powi(2)
            / (periods * periods) as f64;
        let a = random.between(0.1, 2.0);
        let begin = random.between(-4.0, 4.0);
        let state = |by: [f64; 2]| {
            let size = a / (k - 1.0);
            let (q, p) = (size * begin.cos(), -size * begin.sin());
            State::new([q + by[0] * size], [p + by[1] * size]).at(begin)
        };
        let off = [(); 2].map(|()| random.between(-1.5, 1.5));
        let closing = Closing::Driven {
            period: TAU * periods as f64,
        };
        let search = OrbitSearch::new(closing, 60 * periods);
        let system = Hand(Oscillator::Driven { a, k });
        let place = format!("seed {seed}: {system:?}, {off:?}, {closing:?}");
        match search.find(&system, Gauss::<3>::default(), state(off)) {
            Ok(orbit) => {
                found += 1;
                let known = state([0.0; 2]);
                let by = difference(&orbit.start, &known);
                assert!(
                    by < 1e-4 * (1.0 + (a / (k - 1.0)).abs()),
                    "{by} {place}: {orbit:?}"
                );
                assert!(orbit.start.t == begin, "{place}");
            }
            // Further from the guess than half of its width.
            Err(Error::Search(SearchError::FarOrbit { widths, .. })) => {
                refused += 1;
                assert!(widths > 0.5, "{place}");
            }
            Err(error) => panic!("{place}: {error}"),
        }
    }
    assert!(found > 150 && refused > 10, "{found} {refused}");
}

/// The start of an orbit has its period, from guesses that are off by up to a fifth.
#[test]
fn oscillators_have_the_periods_of_elliptic_integrals() {
    let (mut found, mut refused) = (0, 0);
    for seed in 0..cases(300, 10_000) {
        let mut random = Random(seed);
        let a = random.between(0.5, 2.0);
        let b = random.between(-1.0, 1.0);
        // Inside the separatrix, if there is one.
        let (oscillator, most) = match seed % 5 {
            0 => (Oscillator::Pendulum { a }, PI),
            _ if b < 0.0 => (Oscillator::Duffing { a, b }, (a / -b).sqrt().min(2.0)),
            _ => (Oscillator::Duffing { a, b }, 2.0),
        };
        let x = most * random.between(0.2, 0.8);
        let period = oscillator.period(x);
        let off = |random: &mut Random| x * random.between(-0.2, 0.2);
        let guess = State::new([x + off(&mut random)], [off(&mut random)]);
        let system = Hand(oscillator.clone());
        let energy = System::energy(&system, &guess);
        let is_by_energy = seed.is_multiple_of(2);
        let section = "turn";
        let closing = match is_by_energy {
            true => Closing::OfEnergy {
                near: period,
                section,
            },
            false => Closing::OfPeriod { period, section },
        };
        let mut search = OrbitSearch::new(closing, 160);
        if seed.is_multiple_of(3) {
            // Turns time round.
            search = search.with_symmetry(&[1, -1]);
        }
        match search.find(&system, Gauss::<3>::default(), guess.clone()) {
            Ok(orbit) => {
                found += 1;
                let place = format!("seed {seed}: {orbit:?}, {system:?}, {guess:?}, {closing:?}");
                let (q, p) = (orbit.start.q[0], orbit.start.p[0]);
                assert!(p.abs() < 1e-11, "{place}");
                let known = oscillator.period(q);
                assert!(
                    (orbit.period - known).abs() < 1e-5 * known,
                    "{known} {place}"
                );
                match is_by_energy {
                    true => {
                        let change = System::energy(&system, &orbit.start) - energy;
                        assert!(change.abs() < 1e-12 * (1.0 + energy.abs()), "{place}");
                    }
                    false => assert!(
                        orbit.period == period && (q - x).abs() < 1e-3 * x,
                        "{place}"
                    ),
                }
            }
            Err(
                Error::Search(SearchError::NoPeriodicOrbit { .. })
                | Error::Search(SearchError::FarOrbit { .. })
                | Error::Search(SearchError::PointOrbit { .. }),
            ) => {
                refused += 1;
            }
            Err(error) => panic!("seed {seed}: {error}"),
        }
    }
    assert!(refused * 20 < found, "{found} {refused}");
}

/// Without an orbit of this period, the search ends at the equilibrium, which is refused.
#[test]
fn equilibria_are_refused() {
    let mut count = 0;
    for seed in 0..cases(300, 10_000) {
        let mut random = Random(10_000 + seed);
        let (a, b) = (random.between(0.5, 2.0), random.between(0.2, 1.0));
        let sign = if seed.is_multiple_of(2) { 1.0 } else { -1.0 };
        let duffing = Oscillator::Duffing { a, b: sign * b };
        // A hardening oscillator has no period above that of small oscillations, a softening one none below.
        let period = TAU / a.sqrt() * (1.0 + sign * random.between(0.01, 0.2));
        let x = random.between(0.01, 0.3);
        let guess = State::new([x], [random.between(-0.1, 0.1) * x]);
        let closing = Closing::OfPeriod {
            period,
            section: "turn",
        };
        let system = Hand(duffing);
        let result = PeriodicOrbit::find(&system, RungeKutta4, guess, closing, 80);
        match result {
            Err(Error::Search(SearchError::PointOrbit { distance, .. })) => {
                count += 1;
                assert!(
                    distance > 0.5 * x && distance < 2.0 * x,
                    "seed {seed}: {distance}"
                );
            }
            Err(Error::Search(SearchError::NoPeriodicOrbit { .. })) => {}
            other => panic!("seed {seed}: {other:?}"),
        }
    }
    assert!(count > 250, "{count}");
}

/// The restricted problem of three bodies in the turning frame.
#[derive(Debug, Clone)]
struct Restricted {
    mu: f64,
}

/// One type for three systems, since a search is compiled for each type.
#[derive(Debug, Clone)]
enum Planar {
    Restricted(Restricted),
    /// H = p²/2 − 1/r.
    Kepler,
    HenonHeiles,
}

impl Formula<2> for Planar {
    const NAME: &'static str = "Planar";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p_x", 0), Group::scalar("y", "p_y", 1)];
    const OBSERVABLES: &'static [Observable] = &[event("axis")];
    fn energy<T: Real>(&self, t: T, q: &[T; 2], p: &[T; 2]) -> T {
        let ([x, y], [px, py]) = (*q, *p);
        let mu = match self {
            Planar::Restricted(Restricted { mu }) => mu,
            Planar::Kepler => {
                return number::<T>(0.5) * (px * px + py * py) - T::one() / (x * x + y * y).sqrt();
            }
            Planar::HenonHeiles => return HenonHeiles.energy(t, q, p),
        };
        let (mu, other) = (number::<T>(*mu), number::<T>(1.0 - mu));
        let (first, second) = (x + mu, x - other);
        number::<T>(0.5) * (px * px + py * py) + y * px
            - x * py
            - other / (first * first + y * y).sqrt()
            - mu / (second * second + y * y).sqrt()
    }
    fn gradient<T: Real>(&self, t: T, q: &[T; 2], p: &[T; 2]) -> ([T; 2], [T; 2]) {
        let ([x, y], [px, py]) = (*q, *p);
        let mu = match self {
            Planar::Restricted(Restricted { mu }) => mu,
            Planar::Kepler => {
                let square = x * x + y * y;
                let cubed = square * square.sqrt();
                return ([x / cubed, y / cubed], *p);
            }
            Planar::HenonHeiles => return HenonHeiles.gradient(t, q, p),
        };
        let (mu, other) = (number::<T>(*mu), number::<T>(1.0 - mu));
        let (first, second) = (x + mu, x - other);
        let cubed = |dx: T| {
            let square = dx * dx + y * y;
            square * square.sqrt()
        };
        let (near, far) = (mu / cubed(second), other / cubed(first));
        let dq = [far * first + near * second - py, (far + near) * y + px];
        (dq, [px + y, py - x])
    }
    fn observable<T: Real>(&self, _: usize, _: T, q: &[T; 2], _: &[T; 2]) -> T {
        q[1]
    }
}

/// (x, y, p_x, p_y) → (x, −y, −p_x, p_y).
const MIRROR: [i8; 4] = [1, -1, -1, 1];

impl Restricted {
    /// The collinear point between the bodies, or beyond the smaller one.
    fn point(&self, is_between: bool) -> f64 {
        let other = 1.0 - self.mu;
        let force = |x: f64| {
            let (first, second) = (x + self.mu, x - other);
            x - other * first / first.abs().powi(3) - self.mu * second / second.abs().powi(3)
        };
        let (mut low, mut high) = match is_between {
            true => (0.5 - self.mu, other - 1e-6),
            false => (other + 1e-6, 2.0),
        };
        for _ in 0..200 {
            let middle = (low + high) / 2.0;
            if force(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low + high) / 2.0
    }

    /// The linear guess of a Lyapunov orbit that begins at a distance from a point, and its period (V. Szebehely,
    /// *Theory of Orbits*, 1967, section 5.2.2).
    fn lyapunov(&self, point: f64, distance: f64) -> (State<SVector<f64, 2>>, f64) {
        let (first, second) = ((point + self.mu).abs(), (point - 1.0 + self.mu).abs());
        let c = (1.0 - self.mu) / first.powi(3) + self.mu / second.powi(3);
        let square = (2.0 - c + (9.0 * c * c - 8.0 * c).sqrt()) / 2.0;
        let frequency = square.sqrt();
        let speed = -distance * (square + 1.0 + 2.0 * c) / 2.0;
        let x = point + distance;
        (State::new([x, 0.0], [0.0, x + speed]), TAU / frequency)
    }

    /// The velocity for which the orbit that begins at (x, 0) crosses the axis at right angles, near a velocity, and
    /// twice the time until then: secants on runs that an event ends.
    fn by_halves(&self, x: f64, near: f64) -> (f64, f64) {
        let system = Hand(Planar::Restricted(self.clone()));
        let crossing = |p_y: f64| {
            let start = State::new([x, 0.0], [0.0, p_y]);
            let axis = Events::new([Event::named("axis").with_end_after(1)]);
            let mut run = Integrator::new(&system, Gauss::<4>::default(), start, 0.004)
                .expect("a good start")
                .observe(axis);
            let end = run.advance(2_000).expect("finite");
            (end.p[0], 2.0 * end.t)
        };
        let (mut a, mut b) = (near, near + 1e-6 * (near - x));
        let (mut fa, mut fb) = (crossing(a).0, crossing(b).0);
        for _ in 0..20 {
            if fb == fa {
                break;
            }
            (a, b) = (b, b - fb * (b - a) / (fb - fa));
            (fa, fb) = (fb, crossing(b).0);
        }
        (b, crossing(b).1)
    }
}

/// The orbits round L1 of the Earth and the Moon, from the linear guess, against half a period that ends at an event.
#[test]
fn lyapunov_orbits_of_three_amplitudes_are_found() {
    let restricted = Restricted {
        mu: 0.01215058560962404,
    };
    let point = restricted.point(true);
    assert!((point - 0.836_915_125_772_357).abs() < 1e-12);
    let system = Hand(Planar::Restricted(restricted.clone()));
    for distance in [-1e-4, -1e-3, -1e-2, 1e-4, 1e-3, 1e-2] {
        let (guess, near) = restricted.lyapunov(point, distance);
        let energy = System::energy(&system, &guess);
        let section = "axis";
        let closing = Closing::OfEnergy { near, section };
        let scheme = Gauss::<4>::default();
        let whole = PeriodicOrbit::find(&system, scheme, guess.clone(), closing, 600);
        let halves = OrbitSearch::new(closing, 600).with_symmetry(&MIRROR);
        let halves = halves.find(&system, scheme, guess.clone());
        for orbit in [whole.expect("it is found"), halves.expect("it is found")] {
            let (q, p) = (orbit.start.q, orbit.start.p);
            // Near the guess, with its energy.
            assert!(
                (q[0] - guess.q[0]).abs() < 0.15 * distance.abs(),
                "{orbit:?}"
            );
            assert!((System::energy(&system, &orbit.start) - energy).abs() < 1e-14);
            // The independent orbit with this start.
            let (p_y, period) = restricted.by_halves(q[0], p[1]);
            assert!(
                (p[1] - p_y).abs() < 1e-10 && p[0].abs() < 1e-10,
                "{p_y} {orbit:?}"
            );
            assert!((orbit.period - period).abs() < 1e-6, "{period} {orbit:?}");
            // One pair of multipliers is 1, the other large.
            let largest = orbit
                .multipliers()
                .iter()
                .fold(0.0, |most: f64, mu| most.max(mu.re));
            assert!((2_000.0..3_500.0).contains(&largest), "{largest}");
            // Small orbits have the linear period, up to the square of the amplitude.
            let relative = (orbit.period / near - 1.0) / (distance * distance);
            assert!((60.0..95.0).contains(&relative), "{relative}");
        }
        // No orbit has the linear period: the equilibrium is refused.
        let closing = Closing::OfPeriod {
            period: near,
            section,
        };
        let error = PeriodicOrbit::find(&system, scheme, guess, closing, 600).unwrap_err();
        let is_refused = matches!(
            error,
            Error::Search(SearchError::PointOrbit { .. })
                | Error::Search(SearchError::NoPeriodicOrbit { .. })
        );
        assert!(is_refused, "{error}");
    }
}

type Place = State<SVector<f64, 2>>;

/// The end of an orbit after its period by another scheme in shorter steps, and its width.
fn followed(system: &Hand<Planar, 2>, orbit: &PeriodicOrbit<SVector<f64, 2>>) -> (Place, f64) {
    let fine = 2_000;
    let step = orbit.period / fine as f64;
    let scheme = Gauss::<2>::default();
    let mut run = Integrator::new(system, scheme, orbit.start.clone(), step).expect("finite");
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for _ in 0..40 {
        let q = run.advance(fine / 40).expect("finite").q;
        for i in 0..2 {
            (low[i], high[i]) = (low[i].min(q[i]), high[i].max(q[i]));
        }
    }
    let width = (high[0] - low[0]).hypot(high[1] - low[1]);
    (run.state().clone(), width)
}

/// Random masses, both points, amplitudes and guesses: whatever is found is an orbit near the guess.
#[test]
fn no_orbit_of_the_restricted_problem_is_wrong() {
    let (mut found, mut by_arcs, mut refused) = (0, [0; 2], 0);
    for seed in 0..cases(300, 3_000) {
        let mut random = Random(20_000 + seed);
        let mu = 10f64.powf(random.between(-3.0, -0.5));
        let restricted = Restricted { mu };
        let system = Hand(Planar::Restricted(restricted.clone()));
        let is_between = random.below(2) == 0;
        let point = restricted.point(is_between);
        let unit = (point - 1.0 + mu).abs();
        let distance = unit
            * 10f64.powf(random.between(-4.0, -0.9))
            * if random.below(2) == 0 { 1.0 } else { -1.0 };
        let (mut guess, mut near) = restricted.lyapunov(point, distance);
        guess.q[0] += 0.1 * distance * random.between(-1.0, 1.0);
        guess.p[1] += 0.1 * distance * random.between(-1.0, 1.0);
        guess.p[0] += 0.1 * distance * random.between(-1.0, 1.0);
        near *= random.between(0.95, 1.05);
        let energy = System::energy(&system, &guess);
        let section = "axis";
        let is_by_energy = random.below(3) > 0;
        let closing = match is_by_energy {
            true => Closing::OfEnergy { near, section },
            false => Closing::OfPeriod {
                period: near * random.between(1.0, 1.1),
                section,
            },
        };
        for (kind, arcs) in [1, 8].into_iter().enumerate() {
            let mut search = OrbitSearch::new(closing, 200).with_arcs(arcs);
            if seed.is_multiple_of(3) {
                search = search.with_symmetry(&MIRROR);
            }
            let orbit = match search.find(&system, RungeKutta4, guess.clone()) {
                Ok(orbit) => orbit,
                Err(error) => {
                    let is_orbit = matches!(
                        error,
                        Error::Search(SearchError::PointOrbit { .. })
                            | Error::Search(SearchError::FarOrbit { .. })
                    );
                    refused += u32::from(is_orbit);
                    continue;
                }
            };
            found += 1;
            by_arcs[kind] += 1;
            let place = format!("seed {seed}, {arcs} arcs: {orbit:?}, {guess:?}, {closing:?}");
            let (end, width) = followed(&system, &orbit);
            let from = |state: &Place| {
                let by = state.q - orbit.start.q;
                by[0].hypot(by[1])
            };
            // RK4's own error grows with the largest multiplier.
            let growth = orbit
                .monodromy
                .iter()
                .fold(1.0, |most: f64, x| most.max(x.abs()));
            assert!(
                from(&end) < 1e-3 * width + 1e-9 * growth,
                "{} {width} {place}",
                from(&end)
            );
            assert!(width > 0.5 * distance.abs() * 0.05, "{width} {place}");
            // No further from the guess than half of about its width, seven times the distance.
            assert!(from(&guess) < 7.0 * distance.abs(), "{place}");
            if is_by_energy {
                assert!(
                    (System::energy(&system, &orbit.start) - energy).abs() < 1e-11,
                    "{place}"
                );
            }
        }
    }
    assert!(
        found > 300 && by_arcs[1] > by_arcs[0],
        "{found} {by_arcs:?}"
    );
    // Points, mostly, which a search without these checks would return.
    assert!(refused > 10, "{refused}");
}

/// Errors of signs that are no symmetry, and of orbits that are far.
#[test]
fn symmetries_are_checked_and_far_orbits_refused() {
    let restricted = Restricted { mu: 0.0121 };
    let system = Hand(Planar::Restricted(restricted.clone()));
    let (guess, near) = restricted.lyapunov(restricted.point(true), 1e-3);
    let closing = Closing::OfEnergy {
        near,
        section: "axis",
    };
    let find = |signs: &[i8]| {
        let search = OrbitSearch::new(closing, 200).with_symmetry(signs);
        search.find(&system, RungeKutta4, guess.clone())
    };
    assert!(find(&MIRROR).is_ok());
    for signs in [&[1, -1, -1][..], &[1, -1, 1, -1], &[1, 2, -1, -2], &[]] {
        assert!(matches!(
            find(signs),
            Err(Error::Search(SearchError::Symmetry { change: None, .. }))
        ));
    }
    // q → q, p → −p turns time round only without a magnetic field.
    let error = find(&[1, 1, -1, -1]).unwrap_err();
    assert!(
        matches!(
            error,
            Error::Search(SearchError::Symmetry {
                change: Some(_),
                ..
            })
        ),
        "{error}"
    );

    // An orbit that is further away than is wanted.
    let duffing = Oscillator::Duffing { a: 1.0, b: 1.0 };
    let (x, section) = (1.5, "turn");
    let closing = Closing::OfPeriod {
        period: duffing.period(x),
        section,
    };
    let find = |reach: f64| {
        let search = OrbitSearch::new(closing, 100).with_reach(reach);
        search.find(
            &Hand(duffing.clone()),
            Gauss::<2>::default(),
            State::new([1.3], [0.0]),
        )
    };
    match find(0.05) {
        Err(Error::Search(SearchError::FarOrbit {
            distance, widths, ..
        })) => {
            // The guessed orbit is 2.6 wide.
            assert!((distance - 0.2).abs() < 1e-3, "{distance}");
            assert!((widths - 0.2 / 2.6).abs() < 1e-3, "{widths}");
        }
        other => panic!("{other:?}"),
    }
    let found = find(0.1).expect("it is accepted");
    assert!((found.start.q[0] - x).abs() < 1e-4, "{found:?}");
}
