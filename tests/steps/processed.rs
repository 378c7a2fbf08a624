//! Processed splittings against the best of the same order without a processor, and Wisdom and Holman's map with
//! and without its corrector.

use crate::common::is_heavy;
use hamiltonian::VectorOf;
use hamiltonian::nalgebra::{SMatrix, SVector};
use hamiltonian::prelude::*;
use hamiltonian::schemes::{
    CheapProcessed4, Processed4, Processed6, WisdomHolman3, WisdomHolman17,
};
use hamiltonian::{DoubleDouble, Exact, Scheme, Split, Unforced, Vector};
use std::f64::consts::FRAC_PI_2;

hamiltonian! {
    /// The paper's (34), in the two pieces whose errors are least.
    pub struct Coupled {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1);
    split {
        Drift = p^2/2 + 0.5;
        Stretch = q^2*(p^2 + 1)/2;
    }
}

hamiltonian! {
    /// A driven pendulum in air.
    pub struct Damped {}
    H(q; p; t) = p^2/2 - cos(q)*(1 + sin(t)/4);
    force(q; p) = -p/10
}

hamiltonian! {
    /// An orbit round a black hole in four pieces.
    pub struct BlackHole { E = 0.995, L = 4.6 }
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2)
        - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2);
    split {
        Falling = -p_r^2/r;
        Radial = p_r^2/2;
        Turning = p_theta^2/(2*r^2);
        Potential = -E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2);
    }
}

hamiltonian! {
    /// The Sun and five planets, each measured from the centre of mass of those before it.
    pub struct OuterPlanets {
        G = 2.95912208286e-4,
        m: [6],
    }
    let inside(i) = sum(j in 0..i) { m[j] };
    H(q[6][3]; p[6][3]) = sum(i in 0..6) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..6, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates jacobi(q, m);
    split {
        Ellipses = sum(i in 1..6) {
            norm_squared(p_jacobi[i])*(1/m[i] + 1/inside(i))/2 - G*m[0]*m[i]/norm(q_jacobi[i])
        };
        Pulls = norm_squared(p_jacobi[0])/(2*inside(6))
            + G*m[0]*sum(i in 1..6) { m[i]*(1/norm(q_jacobi[i]) - 1/norm(q[i] - q[0])) }
            - G*sum(i in 1..6, j in 1..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    }
}

/// The fewest stages a unit of time with max |H/H(0) − 1| ≤ 1e-8 in every step, within a hundredth.
fn stages<S, M>(
    system: &S,
    scheme: &M,
    start: &State<VectorOf<S>>,
    end: f64,
    (stages, least): (f64, f64),
) -> f64
where
    S: System,
    M: Scheme<S>,
{
    let mut rate = least;
    loop {
        let steps = (end * rate / stages).ceil();
        let run = Integrator::new(system, scheme.clone(), start.clone(), end / steps).unwrap();
        let mut run = run.observe(EnergyDrift::new());
        let done = run.advance(steps as u64).is_ok();
        if done && run.observer().max_relative() <= 1e-8 {
            return steps * stages / end;
        }
        rate *= 1.01;
    }
}

/// How many times as much work [`BlanesMoan6`] is as [`Processed6`].
fn gain<S>(system: &S, start: &State<VectorOf<S>>, end: f64, least: f64) -> f64
where
    S: Split + Exact + Unforced,
{
    let plain = stages(system, &BlanesMoan6, start, end, (10.0, least));
    let processed = stages(system, &Processed6::default(), start, end, (8.0, least));
    println!(
        "{}: {plain:.3} and {processed:.3} stages a unit of time",
        system.description().name
    );
    plain / processed
}

#[test]
fn processing_saves_a_quarter_of_the_stages_of_order_6() {
    let of_34 = gain(&Coupled {}, &State::new([-3.0], [0.0]), 10.0, 60.0);
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    let round_the_hole = gain(&BlackHole::default(), &start, 1000.0, 0.6);
    println!("{of_34:.2}, {round_the_hole:.2}");
    assert!(of_34 >= 1.3, "{of_34}");
    assert!(round_the_hole >= 1.3, "{round_the_hole}");
}

/// Stages of runs whose states are seen, relative to [`BlanesMoan4`]; both have an error of 1e-8 in H.
struct Seen {
    /// [`Processed4`] without its processors.
    processed: f64,
    /// [`CheapProcessed4`] without its means.
    cheap: f64,
}

impl Seen {
    fn new<S>(system: &S, start: &State<VectorOf<S>>, end: f64, least: f64) -> Seen
    where
        S: Split + Exact + Unforced,
    {
        let (processed, cheap) = (Processed4::default(), CheapProcessed4::default());
        let plain = stages(system, &BlanesMoan4, start, end, (6.0, least));
        Seen {
            processed: stages(system, &processed, start, end, (5.0, least)) / plain,
            cheap: stages(system, &cheap, start, end, (5.0, least)) / plain,
        }
    }

    /// With one state seen in `every` steps: 12 stages of π, or 2 × 2½ of the mean, for 5 of a step.
    fn every(&self, every: f64) -> [f64; 2] {
        [
            self.processed * (1.0 + 12.0 / 5.0 / every),
            self.cheap * (1.0 + 1.0 / every),
        ]
    }
}

/// The table in `book/src/schemes.md`: where every step is seen, the scheme without a processor is the best of the
/// three, and where every tenth is, that with the cheap post-processor.
#[test]
fn a_cheap_post_processor_saves_work_where_many_steps_are_seen() {
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    for (name, seen) in [
        (
            "(34)",
            Seen::new(&Coupled {}, &State::new([-3.0], [0.0]), 10.0, 60.0),
        ),
        (
            "black hole",
            Seen::new(&BlackHole::default(), &start, 1000.0, 0.6),
        ),
    ] {
        for every in [1.0, 2.0, 5.0, 10.0, 20.0] {
            println!("{name}, one in {every}: {:.2?}", seen.every(every));
        }
        let [processed, cheap] = seen.every(1.0);
        assert!(1.0 < cheap && cheap < 0.65 * processed, "{name}");
        let [processed, cheap] = seen.every(10.0);
        assert!(cheap < 1.0 && cheap < 0.95 * processed, "{name}");
    }
}

/// The Sun and the outer planets on 5 September 1994 (Hairer, Lubich, Wanner, Geometric Numerical Integration,
/// 2006, table I.2.2): mass, position, velocity.
#[rustfmt::skip]
const PLANETS: [(f64, [f64; 3], [f64; 3]); 6] = [
    (1.00000597682, [0.0; 3], [0.0; 3]),
    (0.000954786104043, [-3.5023653, -3.8169847, -1.5507963], [0.00565429, -0.00412490, -0.00190589]),
    (0.000285583733151, [9.0755314, -3.0458353, -1.6483708], [0.00168318, 0.00483525, 0.00192462]),
    (0.0000437273164546, [8.3101420, -16.2901086, -7.2521278], [0.00354178, 0.00137102, 0.00055029]),
    (0.0000517759138449, [11.4707666, -25.7294829, -10.8169456], [0.00288930, 0.00114527, 0.00039677]),
    (1.0 / 1.3e8, [-15.5387357, -25.2225594, -3.1902382], [0.00276725, -0.00170702, -0.00136504]),
];

#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn correctors_make_the_error_of_planets_a_hundred_times_smaller() {
    const STEP: f64 = 60.0;
    const STEPS: u64 = 6_087;
    let system = OuterPlanets::new(SVector::<f64, 6>::from_fn(|i, _| PLANETS[i].0));
    let start = State {
        t: 0.0,
        q: SMatrix::<f64, 6, 3>::from_fn(|i, c| PLANETS[i].1[c]),
        p: SMatrix::<f64, 6, 3>::from_fn(|i, c| PLANETS[i].0 * PLANETS[i].2[c]),
    };
    let start = system.from_declared(&start);
    let end = |fine: bool| {
        let (parts, h) = if fine {
            (8, STEP / 8.0)
        } else {
            (4, STEP / 4.0)
        };
        let mut run = Integrator::new(&system, Aba1064, start.clone(), h).unwrap();
        run.advance(parts * STEPS).unwrap().clone()
    };
    let exact = end(true);
    let unsure = end(false).q.distance(&exact.q);
    fn run<M: Scheme<OuterPlanets>>(
        system: &OuterPlanets,
        start: &StateOf<OuterPlanets>,
        scheme: M,
    ) -> (StateOf<OuterPlanets>, f64) {
        let run = Integrator::new(system, scheme, start.clone(), STEP).unwrap();
        let mut run = run.observe(every(10, EnergyDrift::new()));
        let end = run.advance(STEPS).unwrap().clone();
        (end, run.observer().inner().max_relative())
    }
    let plain = run(&system, &start, Strang);
    let corrected = run(&system, &start, WisdomHolman17::default());
    let (before, after) = (
        plain.0.q.distance(&exact.q),
        corrected.0.q.distance(&exact.q),
    );
    println!(
        "end point {before:.2e} and {after:.2e} (known to {unsure:.0e}), H {:.2e} and {:.2e}",
        plain.1, corrected.1
    );
    assert!(after > 2.0 * unsure, "{after:e} {unsure:e}");
    assert!(before / after >= 100.0, "{before:e} {after:e}");
    assert!(
        plain.1 / corrected.1 >= 100.0,
        "{} {}",
        plain.1,
        corrected.1
    );
}

/// A force that is affine in p is a part of an exact kick, and processed schemes keep their order: that of 1024 and
/// 2048 steps, as the leading term of the error of order 6 is small.
#[test]
fn forced_systems_have_the_order_of_the_scheme() {
    fn end<M: Scheme<Damped>>(scheme: M, steps: u64) -> [DoubleDouble; 2] {
        let number = DoubleDouble::from;
        let start = State::over([number(1.25)], [number(0.25)]);
        let h = number(8.0) / number(steps as f64);
        let mut run = Integrator::new(&Damped {}, scheme, start, h).unwrap();
        let end = run.advance(steps).unwrap();
        [end.q[0], end.p[0]]
    }
    fn is_of_order<M: Scheme<Damped>>(scheme: M, exact: [DoubleDouble; 2]) {
        let entry = scheme.entry();
        let [coarse, fine] = [1024, 2048].map(|steps| {
            let [q, p] = end(scheme.clone(), steps);
            ((q - exact[0]).abs() + (p - exact[1]).abs()).hi()
        });
        let (order, expected) = ((coarse / fine).log2(), f64::from(entry.order));
        assert!((order - expected).abs() < 0.1, "{}: {order}", entry.name);
    }
    let exact = end(Gauss::<8>::default(), 128);
    is_of_order(Processed4::default(), exact);
    is_of_order(Processed6::default(), exact);
    is_of_order(WisdomHolman3::default(), exact);
    is_of_order(CheapProcessed4::default(), exact);
}

/// max |ΔH| of every tenth of 10⁷ steps round the black hole is that of the first.
#[test]
fn energy_does_not_drift_round_the_black_hole() {
    if !is_heavy() {
        return;
    }
    let system = BlackHole::default();
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    let mut run = Integrator::new(&system, Processed6::default(), start, 8.0).unwrap();
    let energy = run.energy();
    let tenths: Vec<f64> = (0..10)
        .map(|_| {
            let moved = |_| {
                run.advance(10).unwrap();
                (run.energy() / energy - 1.0).abs()
            };
            (0..100_000).map(moved).fold(0.0, f64::max)
        })
        .collect();
    println!("{tenths:?}");
    for most in &tenths {
        assert!((most / tenths[0] - 1.0).abs() <= 0.05, "{tenths:?}");
    }
}
