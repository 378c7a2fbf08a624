//! Stages in the lanes of one trajectory: how much faster than stage by stage.
//!
//! Output: for each problem the CPU time of `Gauss::<8>` or `GaussNystrom::<8>` in lanes, unfused and fused, and
//! how many times longer the same steps take without lanes and by the former code (`support/former.rs`),
//! with the distance of the end points. Times are the least of several, alternating, in one process;
//! nothing is asserted but that a run without lanes has the same bits.

use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::{Run, Scheme, Vector};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};
use std::time::Instant;

#[path = "support/former.rs"]
mod former;
#[allow(dead_code)]
#[path = "../examples/support/planets.rs"]
mod planets;

hamiltonian! {
    /// A planet on an ellipse.
    pub struct Kepler {}
    H(x, y; u, v) = (u^2 + v^2)/2 - 1/sqrt(x^2 + y^2);
    monitor radius = sqrt(x^2 + y^2)
}

hamiltonian! {
    /// The same in the time s, dt = r ds.
    pub struct Sundman {}
    H(x, y; u, v) = (u^2 + v^2)/2 - 1/sqrt(x^2 + y^2);
    dt = sqrt(x^2 + y^2)*ds
}

hamiltonian! {
    /// Hénon and Heiles' potential.
    pub struct HenonHeiles {}
    H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

hamiltonian! {
    /// A pendulum.
    pub struct Pendulum {}
    H(q; p) = p^2/2 - 0.981*cos(q)
}

hamiltonian! {
    /// (34).
    pub struct NonSeparable {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1)
}

hamiltonian! {
    /// An orbit round a black hole in Schwarzschild's coordinates.
    pub struct Schwarzschild { E = 0.995, L = 4.6 }
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2)
        - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2)
}

hamiltonian! {
    /// The Sun and the outer planets.
    pub struct Outer {
        /// The constant of gravity in AU³/(day² solar masses).
        G,
        m: [6],
    }
    H(q[6][3]; p[6][3]) = sum(i in 0..6) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..6, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }
}

/// Rounds of measurements.
const ROUNDS: usize = 7;
/// Seconds that the former code takes in a measurement, about.
const SECONDS: f64 = 0.08;

/// The CPU time of this thread in seconds; where the system does not say, the time.
fn seconds() -> f64 {
    thread_local!(static START: Instant = Instant::now());
    let of_thread = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = of_thread.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    match nanoseconds {
        Some(nanoseconds) => nanoseconds * 1e-9,
        None => START.with(|start| start.elapsed().as_secs_f64()),
    }
}

/// The time that work takes, and its result.
fn timed<O>(work: impl FnOnce() -> O) -> (f64, O) {
    let start = seconds();
    let result = work();
    (seconds() - start, result)
}

/// The maximum norm of the difference of two states.
fn distance<V: Vector<Scalar = f64>>(a: &State<V>, b: &State<V>) -> f64 {
    a.q.distance(&b.q).max(a.p.distance(&b.p))
}

/// Former code: so many steps of a size from a start.
type Former<Y> = fn(&Y, &StateOf<Y>, f64, u64) -> StateOf<Y>;

/// Measures steps of a scheme against former code for the same steps.
fn compare<Y, M>(
    name: &str,
    system: &Y,
    scheme: M,
    start: &State<VectorOf<Y>>,
    h: f64,
    former: Former<Y>,
) where
    Y: System,
    M: Scheme<Y>,
{
    let entry = scheme.entry();
    let (once, _) = timed(|| former(system, start, h, 2000));
    let n = (2000.0 * SECONDS / once.max(1e-4)) as u64;
    let run = |change: fn(Run<Y, M>) -> Run<Y, M>| {
        let run = Integrator::new(system, scheme.clone(), start.clone(), h);
        let mut run = change(run.expect("a run begins"));
        let (time, outcome) = timed(|| run.advance(n).map(|_| ()));
        outcome.expect("every step is solved");
        (time, run.state().clone())
    };
    let mut least = [f64::INFINITY; 4];
    let mut ends = Vec::new();
    for _ in 0..ROUNDS {
        let measured = [
            timed(|| former(system, start, h, n)),
            run(|run| run.with_lanes(false)),
            run(|run| run),
            run(|run| run.fused()),
        ];
        for (least, (time, _)) in least.iter_mut().zip(&measured) {
            *least = least.min(*time);
        }
        ends = measured.map(|(_, end)| end).to_vec();
    }
    let [former, scalar, lanes, fused] = least;
    let [before, alone, beside, once_rounded] = &ends[..] else {
        unreachable!("four runs were measured");
    };
    assert_eq!(alone, beside, "{name}: other bits without lanes");
    println!(
        "{name:<14} {:<13} {:8.1} {:8.2} {:8.2} {:8.2} {:10.1e} {:10.1e}",
        entry.name,
        lanes * 1e9 / n as f64,
        former / lanes,
        former / fused,
        former / scalar,
        distance(before, beside),
        distance(once_rounded, beside),
    );
}

fn main() {
    println!("Eight stages; former code: stage by stage, until the change no longer shrinks.\n");
    println!(
        "{:<14} {:<13} {:>8} {:>8} {:>8} {:>8} {:>10} {:>10}",
        "", "", "ns/step", "lanes", "fused", "scalar", "|former|", "|fused|"
    );
    let kepler = State::new([0.4, 0.0], [0.0, 2.0]);
    let h = TAU / 40.0;
    let (gauss, nystrom) = (Gauss::<8>::default(), GaussNystrom::<8>::default());
    compare(
        "Kepler e = .6",
        &Kepler {},
        nystrom,
        &kepler,
        h,
        former::gauss_nystrom::<_, 8>,
    );
    compare(
        "Kepler e = .6",
        &Kepler {},
        gauss,
        &kepler,
        h,
        former::gauss::<_, 8>,
    );
    in_another_time();
    let start = State::new([0.1, -0.1], [0.3, 0.2]);
    let system = HenonHeiles {};
    compare(
        "Henon-Heiles",
        &system,
        nystrom,
        &start,
        0.5,
        former::gauss_nystrom::<_, 8>,
    );
    compare(
        "Henon-Heiles",
        &system,
        gauss,
        &start,
        0.5,
        former::gauss::<_, 8>,
    );
    let start = State::new([FRAC_PI_4], [0.0]);
    let system = Pendulum {};
    compare(
        "pendulum",
        &system,
        nystrom,
        &start,
        1.0,
        former::gauss_nystrom::<_, 8>,
    );
    compare(
        "pendulum",
        &system,
        gauss,
        &start,
        1.0,
        former::gauss::<_, 8>,
    );
    let start = State::new([-3.0], [0.0]);
    compare(
        "(34)",
        &NonSeparable {},
        gauss,
        &start,
        0.1,
        former::gauss::<_, 8>,
    );
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    compare(
        "black hole",
        &Schwarzschild::default(),
        gauss,
        &start,
        1.0,
        former::gauss::<_, 8>,
    );

    let (masses, planets) = planets::start();
    let array = |from: &dyn Fn(usize, usize) -> f64| -> [[f64; 3]; 6] {
        std::array::from_fn(|i| std::array::from_fn(|c| from(i, c)))
    };
    let start = State::new(
        array(&|i, c| planets.q[(i, c)]),
        array(&|i, c| planets.p[(i, c)]),
    );
    let system = Outer {
        G: 2.95912208286e-4,
        m: std::array::from_fn::<f64, 6, _>(|i| masses[i]).into(),
    };
    compare(
        "outer planets",
        &system,
        nystrom,
        &start,
        100.0,
        former::gauss_nystrom::<_, 8>,
    );
    compare(
        "outer planets",
        &system,
        gauss,
        &start,
        100.0,
        former::gauss::<_, 8>,
    );

    println!("\nOne stage against ImplicitMidpoint, CPU time of a step in ns:");
    let start = State::new([FRAC_PI_4], [0.0]);
    one_stage("pendulum", &Pendulum {}, start, 0.01);
    one_stage("(34)", &NonSeparable {}, State::new([-3.0], [0.0]), 0.01);
    let start = State::new([0.1, -0.1], [0.3, 0.2]);
    one_stage("Henon-Heiles", &HenonHeiles {}, start, 0.05);
}

/// Measures [`Gauss`] in the time of the distance, which the definition declares or a monitor is.
fn in_another_time() {
    let (gauss, h) = (Gauss::<8>::default(), TAU / 40.0);
    let start = State::new([0.1, 0.0], [0.0, 19.0_f64.sqrt()]);
    let system = Sundman {};
    let declared = system.from_declared(&start);
    compare(
        "dt = r ds",
        &system,
        gauss,
        &declared,
        h,
        former::gauss::<_, 8>,
    );
    let system = TimeTransformed::by(Kepler {}, "radius").expect("it is declared");
    let start = system.start(&start).expect("r is positive");
    compare(
        "monitor r",
        &system,
        gauss,
        &start,
        h,
        former::gauss::<_, 8>,
    );
}

/// Measures [`Gauss`] with one stage against [`ImplicitMidpoint`].
fn one_stage<Y: System>(name: &str, system: &Y, start: State<VectorOf<Y>>, h: f64) {
    const STEPS: u64 = 200_000;
    let mut least = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        let times = [
            time_of_steps(system, Gauss::<1>::default(), &start, h, STEPS),
            time_of_steps(system, ImplicitMidpoint::default(), &start, h, STEPS),
        ];
        for (least, time) in least.iter_mut().zip(times) {
            *least = least.min(time * 1e9 / STEPS as f64);
        }
    }
    let [gauss, midpoint] = least;
    println!(
        "{name:<14} {gauss:8.1} {midpoint:8.1}  x {:.2}",
        gauss / midpoint
    );
}

/// The time of the steps of one run.
fn time_of_steps<Y: System, M: Scheme<Y>>(
    system: &Y,
    scheme: M,
    start: &State<VectorOf<Y>>,
    h: f64,
    steps: u64,
) -> f64 {
    let run = Integrator::new(system, scheme, start.clone(), h);
    let mut run = run.expect("a run begins");
    let (time, outcome) = timed(|| run.advance(steps).map(|_| ()));
    outcome.expect("every step is solved");
    time
}
