//! Definitions at run time against compiled ones: `cargo bench -p hamiltonian-runtime`.
//!
//! Input: definitions, each compiled and read at run time. Output: the time from a text to the first step, and the ratios of
//! the CPU time of runs and ensembles to that of compiled ones that do not fuse. Invariant: before anything is timed, both
//! ends are compared, and have the same bits. Times are the fastest of alternating rounds.

use hamiltonian::prelude::{
    BlanesMoan6, Ensemble, Gauss, GaussNystrom, Integrator, Member, RungeKutta4, Scheme, State,
    StateOf, StormerVerlet, System, Vector,
};
use hamiltonian::schemes::{Processed6, Srkn11b, Strang, Yoshida6};
use hamiltonian_runtime::{Definition, Run, RuntimeSystem, Swarm, Values};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// A compiled definition `$name`, and its text.
macro_rules! both {
    ($name:ident: $($definition:tt)*) => {
        mod $name {
            use hamiltonian::prelude::*;
            hamiltonian! { $($definition)* }
            pub const TEXT: &str = stringify!($($definition)*);
        }
    };
}

both!(pendulum: pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 } H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta));
both!(henon: pub struct Henon { lambda = 1.0 }
    H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lambda*(x^2*y - y^3/3));
both!(product: pub struct Product {} H(q; p) = (q^2 + 1)*(p^2 + 1)/2);
both!(bodies: pub struct Bodies { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) });

fn parsed(text: &str) -> Definition {
    Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"))
}

fn made(text: &str, values: Values) -> RuntimeSystem {
    let system = parsed(text).system(values);
    system.unwrap_or_else(|error| panic!("{error}"))
}

/// The fastest of several rounds of each, one after the other.
fn fastest<const N: usize>(mut rounds: [&mut dyn FnMut(); N]) -> [Duration; N] {
    const ROUNDS: usize = 15;
    let mut best = [Duration::MAX; N];
    for _ in 0..ROUNDS {
        for (best, round) in best.iter_mut().zip(&mut rounds) {
            let begin = Instant::now();
            round();
            *best = (*best).min(begin.elapsed());
        }
    }
    best
}

/// Prints how often the time of the first is that of the second.
fn print(name: &str, [own, compiled]: [Duration; 2], unit: &str, units: f64) {
    let [a, b] = [own, compiled].map(|time| time.as_secs_f64() * 1e9 / units);
    println!("{name:44} {:6.2}   {a:9.1} and {b:9.1} ns a {unit}", a / b);
}

/// Compares the ends of one orbit, and times both.
fn orbit<S: System, M: Scheme<S>>(
    name: &str,
    (compiled, own): (&S, &RuntimeSystem),
    (scheme, by_name): (M, &str),
    (q, p, h): (&[f64], &[f64], f64),
    steps: u64,
) {
    let mut start: StateOf<S> = State {
        t: 0.0,
        q: compiled.zeros::<f64>(),
        p: compiled.zeros::<f64>(),
    };
    for k in 0..q.len() {
        *start.q.component_mut(k) = q[k];
        *start.p.component_mut(k) = p[k];
    }
    let run = || Integrator::new(compiled, scheme.clone(), start.clone(), h).unwrap();
    let named = || Run::new(own, by_name, State::new(q.to_vec(), p.to_vec()), h).unwrap();
    let (mut a, mut b) = (named(), run());
    a.advance(50).unwrap();
    b.advance(50).unwrap();
    let due: Vec<f64> = b
        .state()
        .q
        .components()
        .chain(b.state().p.components())
        .collect();
    let found: Vec<f64> = a.q().iter().chain(a.p()).copied().collect();
    assert_eq!(found, due, "{name}, {by_name}");
    let times = fastest([&mut || a.advance(steps).unwrap(), &mut || {
        black_box(b.advance(steps).unwrap());
    }]);
    print(&format!("{name}, {by_name}"), times, "step", steps as f64);
}

fn ensembles<S: System + Clone, M: Scheme<S>>(
    name: &str,
    (compiled, own): (S, &RuntimeSystem),
    (scheme, by_name): (M, &str),
    make: impl Fn(usize) -> StateOf<S>,
    steps: u64,
) {
    const MEMBERS: usize = 10_000;
    const H: f64 = 0.01;
    const THREADS: usize = 2;
    let start = |member: Member| (compiled.clone(), make(member.index));
    let mut b = Ensemble::new(MEMBERS, start, scheme, H)
        .unwrap()
        .reproducible()
        .with_threads(THREADS);
    let starts: Vec<StateOf<S>> = (0..MEMBERS).map(&make).collect();
    let q: Vec<f64> = starts
        .iter()
        .flat_map(|state| state.q.components())
        .collect();
    let p: Vec<f64> = starts
        .iter()
        .flat_map(|state| state.p.components())
        .collect();
    let systems = std::slice::from_ref(own);
    let mut a = Swarm::new(systems, by_name, &q, &p, 0.0, H)
        .unwrap()
        .with_threads(THREADS);
    a.advance(20).unwrap();
    b.advance(20);
    let found = a.states();
    let due: Vec<f64> = b
        .states()
        .flat_map(|state| state.unwrap().q.components().collect::<Vec<_>>())
        .collect();
    assert_eq!(found.q, due, "{name}, {by_name}");
    let times = fastest([&mut || a.advance(steps).unwrap(), &mut || {
        black_box(b.advance(steps));
    }]);
    print(
        &format!("10 000 × {name}, {by_name}"),
        times,
        "member and step",
        steps as f64 * MEMBERS as f64,
    );
}

/// The time from a text to the first step.
fn first_step(name: &str, text: &str, values: &Values, q: &[f64], p: &[f64]) {
    let [time] = fastest([&mut || {
        let system = made(text, values.clone());
        let mut run = Run::new(
            &system,
            "StormerVerlet",
            State::new(q.to_vec(), p.to_vec()),
            0.01,
        )
        .unwrap();
        run.advance(1).unwrap();
        black_box(run.state());
    }]);
    println!("{name:44} {:6.2} ms", time.as_secs_f64() * 1e3);
}

fn main() {
    let nine: Vec<f64> = (0..27).map(|k| 3.0 * f64::sin(k as f64 * 2.4)).collect();
    let speeds: Vec<f64> = (0..27).map(|k| 0.1 * f64::cos(k as f64 * 1.7)).collect();
    let masses: Vec<f64> = (0..9).map(|k| 1.0 / (1.0 + k as f64)).collect();
    let of_nine = Values::new().with("n", 9).with("m", masses.clone());

    println!("from a text to the first step");
    first_step("pendulum", pendulum::TEXT, &Values::new(), &[0.5], &[3.0]);
    first_step(
        "Hénon–Heiles",
        henon::TEXT,
        &Values::new(),
        &[0.1, -0.1],
        &[0.3, 0.2],
    );
    first_step("nine bodies", bodies::TEXT, &of_nine, &nine, &speeds);

    println!("\none orbit: the time of the runtime in that of compiled code that does not fuse");
    let compiled = pendulum::Pendulum::default();
    let own = made(pendulum::TEXT, Values::new());
    let start = (&[0.5][..], &[3.0][..], 0.05);
    macro_rules! all {
        ($name:literal, ($compiled:ident, $own:ident, $start:ident), $($scheme:expr, $by_name:literal, $steps:literal;)+) => {
            $(orbit($name, (&$compiled, &$own), ($scheme, $by_name), $start, $steps);)+
        };
    }
    all! { "pendulum", (compiled, own, start),
        StormerVerlet::default(), "StormerVerlet", 20_000;
        Strang, "Strang", 20_000;
        Yoshida6, "Yoshida6", 5_000;
        BlanesMoan6, "BlanesMoan6", 5_000;
        Srkn11b, "Srkn11b", 5_000;
        Processed6::default(), "Processed6", 5_000;
        RungeKutta4, "RungeKutta4", 10_000;
        Gauss::<4>::default(), "Gauss4", 2_000;
        Gauss::<8>::default(), "Gauss8", 1_000;
        GaussNystrom::<8>::default(), "GaussNystrom8", 1_000;
    }
    let compiled = henon::Henon::default();
    let own = made(henon::TEXT, Values::new());
    let start = (&[0.1, -0.1][..], &[0.3, 0.2][..], 0.1);
    all! { "Hénon–Heiles", (compiled, own, start),
        StormerVerlet::default(), "StormerVerlet", 20_000;
        BlanesMoan6, "BlanesMoan6", 5_000;
        Gauss::<8>::default(), "Gauss8", 1_000;
        GaussNystrom::<8>::default(), "GaussNystrom8", 1_000;
    }
    let compiled = product::Product {};
    let own = made(product::TEXT, Values::new());
    let start = (&[-3.0][..], &[0.4][..], 0.01);
    all! { "(q² + 1)(p² + 1)/2", (compiled, own, start),
        Strang, "Strang", 20_000;
        BlanesMoan6, "BlanesMoan6", 5_000;
    }
    let compiled = bodies::Bodies::new(9, masses).unwrap();
    let own = made(bodies::TEXT, of_nine);
    let start = (&nine[..], &speeds[..], 1e-4);
    all! { "nine bodies", (compiled, own, start),
        StormerVerlet::default(), "StormerVerlet", 1_000;
        BlanesMoan6, "BlanesMoan6", 100;
        GaussNystrom::<8>::default(), "GaussNystrom8", 50;
    }

    println!("\nensembles on two threads: likewise");
    let own = made(pendulum::TEXT, Values::new());
    let at = |index: usize| 1e-4 * index as f64;
    ensembles(
        "pendulum",
        (pendulum::Pendulum::default(), &own),
        (StormerVerlet::default(), "StormerVerlet"),
        |index| State::new([at(index)], [3.0]),
        200,
    );
    let own = made(henon::TEXT, Values::new());
    ensembles(
        "Hénon–Heiles",
        (henon::Henon::default(), &own),
        (StormerVerlet::default(), "StormerVerlet"),
        |index| State::new([0.3 * at(index), -0.1], [0.3, 0.2]),
        200,
    );
}
