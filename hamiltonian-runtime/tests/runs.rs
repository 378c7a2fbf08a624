//! Runs of definitions at run time have the bits of compiled runs that do not fuse.
//!
//! Input: definitions, each compiled and read at run time from the same tokens. Output: a panic with the first component
//! that differs. Invariant: six schemes are compiled, no more.

mod definitions;

use definitions::*;
use hamiltonian::prelude::*;
use hamiltonian::schemes::Srkn6b;
use hamiltonian::schemes::author::{Dynamics, Flow, Listed, Pieces, Point, Scratch};
use hamiltonian::{Error, Split, Vector};
use hamiltonian_runtime::{Definition, FlatState, Run, RunError, RuntimeSystem, Swarm, Values};

type Flat = hamiltonian::nalgebra::DVector<f64>;

/// The name of a scheme, with the number of its stages.
fn name_of(scheme: &impl Listed) -> String {
    match scheme.entry().name {
        "Gauss" => "Gauss8".to_owned(),
        name => name.to_owned(),
    }
}

fn made(text: &str, values: Values) -> RuntimeSystem {
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    definition
        .system(values)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The end of a compiled run, or its error.
fn end<S: System, M: Scheme<S>>(
    system: &S,
    scheme: M,
    start: State<hamiltonian::VectorOf<S>>,
    step: f64,
) -> Result<Vec<u64>, Error> {
    let mut run = Integrator::new(system, scheme, start, step)?;
    let state = run.advance(200)?;
    let all = state.q.components().chain(state.p.components());
    Ok(all.map(f64::to_bits).collect())
}

/// The end of a run whose scheme has a name.
fn end_by_name(
    system: &RuntimeSystem,
    scheme: &str,
    start: FlatState,
    step: f64,
) -> Result<Vec<u64>, RunError> {
    let mut run = Run::new(system, scheme, start, step)?;
    run.advance(200)?;
    Ok(run
        .q()
        .iter()
        .chain(run.p())
        .copied()
        .map(f64::to_bits)
        .collect())
}

/// Compares the ends of a compiled run and of one at run time by the name of its scheme, from flat coordinates and momenta.
macro_rules! agree {
    ($compiled:expr, $text:expr, $values:expr, $scheme:expr, $q:expr, $p:expr, $step:expr) => {{
        let (compiled, own) = ($compiled, made($text, $values));
        let (q, p): (Vec<f64>, Vec<f64>) = ($q.to_vec(), $p.to_vec());
        let mut start = State {
            t: 0.0,
            q: compiled.zeros::<f64>(),
            p: compiled.zeros::<f64>(),
        };
        for k in 0..q.len() {
            *start.q.component_mut(k) = q[k];
            *start.p.component_mut(k) = p[k];
        }
        let due = end(&compiled, $scheme, start, $step).unwrap_or_else(|error| panic!("{error}"));
        let found = end_by_name(&own, &name_of(&$scheme), State::new(q, p), $step);
        assert_eq!(
            found.unwrap_or_else(|error| panic!("{error}")),
            due,
            "{}",
            $text
        );
    }};
}

#[test]
fn separable_systems() {
    let values = Values::new;
    let pendulum = pendulum::Pendulum::default;
    agree!(
        pendulum(),
        pendulum::TEXT,
        values(),
        StormerVerlet::default(),
        [0.5],
        [3.0],
        0.1
    );
    agree!(
        pendulum(),
        pendulum::TEXT,
        values(),
        BlanesMoan4,
        [0.5],
        [3.0],
        0.1
    );
    agree!(
        pendulum(),
        pendulum::TEXT,
        values(),
        Srkn6b,
        [0.5],
        [3.0],
        0.1
    );
    agree!(
        pendulum(),
        pendulum::TEXT,
        values(),
        RungeKutta4,
        [0.5],
        [3.0],
        0.1
    );
    let henon = henon::Henon::default;
    agree!(
        henon(),
        henon::TEXT,
        values(),
        BlanesMoan4,
        [0.1, -0.1],
        [0.3, 0.2],
        0.1
    );
    agree!(
        henon(),
        henon::TEXT,
        values(),
        Gauss::<8>::default(),
        [0.1, -0.1],
        [0.3, 0.2],
        0.1
    );
    agree!(
        henon(),
        henon::TEXT,
        values(),
        ImplicitMidpoint::default(),
        [0.1, -0.1],
        [0.3, 0.2],
        0.1
    );
    let driven = driven::Driven::default;
    agree!(
        driven(),
        driven::TEXT,
        values(),
        StormerVerlet::default(),
        [1.0],
        [0.0],
        0.05
    );
    agree!(
        driven(),
        driven::TEXT,
        values(),
        Gauss::<8>::default(),
        [1.0],
        [0.0],
        0.05
    );
}

#[test]
fn pieces_forces_and_conditions() {
    let values = Values::new;
    let product = || product::Product {};
    agree!(
        product(),
        product::TEXT,
        values(),
        BlanesMoan4,
        [-3.0],
        [0.4],
        0.01
    );
    agree!(
        product(),
        product::TEXT,
        values(),
        ImplicitMidpoint::default(),
        [-3.0],
        [0.4],
        0.01
    );
    let damped = damped::Damped::default;
    agree!(
        damped(),
        damped::TEXT,
        values(),
        Gauss::<8>::default(),
        [1.0],
        [0.5],
        0.1
    );
    agree!(
        damped(),
        damped::TEXT,
        values(),
        RungeKutta4,
        [1.0],
        [0.5],
        0.1
    );
    let switched = switched::Switched::default;
    let (q, p) = ([0.3, -0.2], [0.1, 0.7]);
    agree!(
        switched(),
        switched::TEXT,
        values(),
        StormerVerlet::default(),
        q,
        p,
        0.1
    );
    agree!(switched(), switched::TEXT, values(), RungeKutta4, q, p, 0.1);
}

#[test]
fn loops_over_arrays() {
    for n in [3, 50] {
        let m: Vec<f64> = (0..n).map(|i| 1.0 + 0.1 * i as f64).collect();
        let (q, p): (Vec<f64>, Vec<f64>) = (0..n)
            .map(|i| (0.3 * f64::sin(i as f64), 0.2 * f64::cos(i as f64)))
            .unzip();
        let values = || Values::new().with("n", n).with("m", m.clone());
        let chain = || chain::Chain::new(n, m.clone()).unwrap();
        agree!(
            chain(),
            chain::TEXT,
            values(),
            StormerVerlet::default(),
            q,
            p,
            0.1
        );
        agree!(
            chain(),
            chain::TEXT,
            values(),
            Gauss::<8>::default(),
            q,
            p,
            0.1
        );
        agree!(chain(), chain::TEXT, values(), RungeKutta4, q, p, 0.1);
    }
    // Pairs of nine bodies are eight at a time.
    for n in [3, 9] {
        let m: Vec<f64> = (0..n).map(|i| 1.0 / (1.0 + i as f64)).collect();
        let (q, p): (Vec<f64>, Vec<f64>) = (0..3 * n)
            .map(|i| {
                (
                    3.0 * f64::sin(2.4 * i as f64),
                    0.1 * f64::cos(1.7 * i as f64),
                )
            })
            .unzip();
        let values = || Values::new().with("n", n).with("m", m.clone());
        let bodies = || bodies::Bodies::new(n, m.clone()).unwrap();
        agree!(bodies(), bodies::TEXT, values(), BlanesMoan4, q, p, 0.01);
        agree!(
            bodies(),
            bodies::TEXT,
            values(),
            ImplicitMidpoint::default(),
            q,
            p,
            0.01
        );
    }
}

#[test]
fn another_parameter_ends_elsewhere() {
    let text = pendulum::TEXT;
    let run = |g: f64| {
        let system = made(text, [("g", g)].into());
        end_by_name(
            &system,
            "StormerVerlet",
            State::new(vec![0.5], vec![3.0]),
            0.1,
        )
    };
    assert_eq!(run(9.81).unwrap(), run(9.81).unwrap());
    assert_ne!(run(9.81).unwrap(), run(9.810_000_000_000_002).unwrap());
}

#[test]
fn members_of_an_ensemble_have_the_bits_of_their_runs() {
    let definition =
        Definition::parse(pendulum::TEXT, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let system = |index: usize| {
        let g = 9.0 + 0.125 * index as f64;
        definition.system([("g", g)]).unwrap()
    };
    let systems: Vec<RuntimeSystem> = (0..11).map(system).collect();
    let mut q = vec![0.5; 11];
    let p = vec![3.0; 11];
    // A member that cannot start leaves the others alone.
    q[4] = f64::NAN;
    let mut swarm = Swarm::new(&systems, "StormerVerlet", &q, &p, 0.0, 0.1).unwrap();
    swarm.advance(150).unwrap();
    swarm.advance_to(20.0).unwrap();
    assert_eq!((swarm.steps(), swarm.t()), (200, 20.0));
    let states = swarm.states();
    assert_eq!(states.errors.len(), 1);
    assert_eq!(states.errors[0].0, 4);
    for (index, system) in systems.iter().enumerate() {
        if index == 4 {
            assert!(states.q[index].is_nan() && states.t[index].is_nan());
            continue;
        }
        let found = [states.q[index].to_bits(), states.p[index].to_bits()];
        let start = State::new(vec![0.5], vec![3.0]);
        let due = end_by_name(system, "StormerVerlet", start, 0.1).unwrap();
        assert_eq!(found.to_vec(), due, "member {index}");
    }
    let between = swarm.advance_until(20.25).unwrap();
    assert_eq!((swarm.steps(), between.t[0]), (202, 20.25));
}

#[test]
fn kicks_whose_force_reads_momenta() {
    let values = Values::new;
    // The force is affine in each momentum, with a rest and without; momenta push each other; it is neither.
    macro_rules! kicked {
        ($($module:ident $system:ident $scheme:expr, $q:expr, $p:expr;)*) => {$(
            agree!($module::$system::default(), $module::TEXT, values(), $scheme, $q, $p, 0.05);
        )*};
    }
    kicked! {
        dragged Dragged BlanesMoan4, [0.4, 0.5], [0.3, -0.2];
        slowed Slowed BlanesMoan4, [0.4, 0.5], [0.3, -0.2];
        turned Turned BlanesMoan4, [0.4, 0.5], [0.3, -0.2];
        damped Damped StormerVerlet::default(), [0.5], [0.4];
        whirled Whirled Strang, [0.4, 0.5], [0.3, -0.2];
    }
    // Sums of 32 terms and more.
    let n = 40;
    let numbers = |from: f64| -> Vec<f64> { (0..n).map(|k| (from + k as f64).sin()).collect() };
    let u = numbers(5.0);
    agree!(
        sliding::Sliding::new(n, u.clone()).unwrap(),
        sliding::TEXT,
        Values::new().with("n", n).with("u", u.clone()),
        BlanesMoan4,
        numbers(0.0),
        numbers(1.0),
        0.05
    );
}

#[test]
fn a_piece_with_long_sums() {
    let n = 40;
    let numbers = |from: f64| -> Vec<f64> { (0..=n).map(|k| (from + k as f64).sin()).collect() };
    agree!(
        mean::Mean::new(n).unwrap(),
        mean::TEXT,
        Values::new().with("n", n),
        BlanesMoan4,
        numbers(0.0),
        numbers(1.0),
        0.02
    );
}

#[test]
fn functions_with_data() {
    let knots: Vec<f64> = (0..9).map(|k| f64::from(k) - 4.0).collect();
    let heights: Vec<f64> = knots
        .iter()
        .map(|x| x * x / 2.0 + (3.0 * x).sin() / 5.0)
        .collect();
    let spline = Spline::natural(&knots, &heights).unwrap();
    let row = |x: &f64| {
        knots
            .iter()
            .map(|y| (x * y).sin() + y * y)
            .collect::<Vec<f64>>()
    };
    let rows: Vec<Vec<f64>> = knots.iter().map(row).collect();
    let grid = Grid::natural([-4.0; 2], [1.0; 2], &rows).unwrap();
    let values = || {
        Values::new()
            .with("V", spline.clone())
            .with("W", grid.clone())
    };
    let compiled = || tabulated::Tabulated::new(spline.clone(), grid.clone());
    // `Gauss8` solves with Newton's method too, which takes second derivatives.
    agree!(
        compiled(),
        tabulated::TEXT,
        values(),
        BlanesMoan4,
        [0.4, 0.5],
        [0.3, -0.2],
        0.1
    );
    agree!(
        compiled(),
        tabulated::TEXT,
        values(),
        Gauss::<8>::default(),
        [0.4, 0.5],
        [0.3, -0.2],
        0.1
    );

    let own = made(tabulated::TEXT, values());
    let (mut due, mut found) = (String::new(), String::new());
    compiled().describe_parameters(&mut due).unwrap();
    own.describe_parameters(&mut found).unwrap();
    assert_eq!(found, due);
    let (prepared, compiled) = (own.prepare::<f64>(), compiled().prepare::<f64>());
    let (q, p) = ([0.7, -0.3], [0.2, 0.4]);
    let [mut due_q, mut due_p] = [hamiltonian::nalgebra::Vector2::zeros(); 2];
    let [q2, p2] = [q, p].map(hamiltonian::nalgebra::Vector2::from);
    compiled.hessian_vector(0.0, &q2, &p2, &p2, &q2, &mut due_q, &mut due_p);
    let flat = |x: [f64; 2]| hamiltonian::nalgebra::DVector::from_vec(x.to_vec());
    let [mut own_q, mut own_p] = [flat([0.0; 2]), flat([0.0; 2])];
    prepared.hessian_vector(
        0.0,
        &flat(q),
        &flat(p),
        &flat(p),
        &flat(q),
        &mut own_q,
        &mut own_p,
    );
    assert_eq!(own_q.as_slice(), due_q.as_slice());
    assert_eq!(own_p.as_slice(), due_p.as_slice());
    assert_ne!(own_q[0], 0.0);
}

#[test]
fn pairs_in_tiles() {
    // From 4096 rows on there are tiles, here with a part of one at the end.
    let n = 4100;
    let q: Vec<f64> = (0..n).map(|k| ((k * k) as f64 * 0.37).sin()).collect();
    let own = made(cloud::TEXT, Values::new().with("n", n));
    let compiled = cloud::Cloud::new(n).unwrap();
    let flat = hamiltonian::nalgebra::DVector::from_vec(q);
    let zero = || hamiltonian::nalgebra::DVector::zeros(n);
    let (mut due, mut found) = (zero(), zero());
    (compiled.prepare::<f64>()).gradient_q(0.0, &flat, &zero(), &mut due);
    (own.prepare::<f64>()).gradient_q(0.0, &flat, &zero(), &mut found);
    assert_ne!(due[7], 0.0);
    assert_eq!(found, due);
}

/// A sweep is the whole of H, the outermost piece, one between others, or the innermost; a matrix exponential is the whole or
/// the innermost piece.
#[test]
fn terms_that_do_not_commute_and_matrices() {
    for n in [2, 5] {
        let (q, p): (Vec<f64>, Vec<f64>) = (0..n)
            .map(|i| (0.3 * f64::sin(i as f64), 0.2 * f64::cos(i as f64)))
            .unzip();
        let values = || Values::new().with("n", n);
        macro_rules! sweeps {
            ($($name:ident: $system:ident),+) => {$(
                let system = || $name::$system::new(n).unwrap();
                agree!(system(), $name::TEXT, values(), BlanesMoan4, q, p, 0.01);
            )+};
        }
        sweeps!(shifted: Shifted, between: Between, innermost: Innermost, outermost: Outermost);
        // Up is not down: the terms do not commute. Two sites are one term.
        let system = made(shifted::TEXT, values());
        let flow = <RuntimeSystem as Split>::pieces::<f64>().outer(&system.prepare::<f64>(), 0.3);
        let start = || Point {
            q: Flat::from_column_slice(&q),
            p: Flat::from_column_slice(&p),
        };
        let (mut down, mut up) = (start(), start());
        let mut work = Scratch::like(&down);
        flow.apply(0.0, &mut down, &mut work);
        flow.apply_reversed(0.0, &mut up, &mut work);
        assert_eq!(down == up, n == 2);
    }
    let (q, p) = ([0.3, -0.2, 0.1], [0.1, 0.7, -0.4]);
    let definition = Definition::parse(coupled::TEXT, "text").unwrap();
    let mut facts = definition.facts();
    assert!(facts.any(|fact| fact.contains("(matrix exponential)")));
    let whole = coupled::Coupled::default();
    agree!(
        whole.clone(),
        coupled::TEXT,
        Values::new(),
        BlanesMoan4,
        q,
        p,
        0.1
    );
    // Long steps, whose matrices are squared.
    agree!(whole, coupled::TEXT, Values::new(), BlanesMoan4, q, p, 9.0);
    let trapped = trapped::Trapped::default();
    agree!(
        trapped,
        trapped::TEXT,
        Values::new(),
        BlanesMoan4,
        q,
        p,
        0.05
    );
    let systems: Vec<RuntimeSystem> = (0..9)
        .map(|k| {
            made(
                trapped::TEXT,
                Values::new().with("k", 0.1 + 0.05 * f64::from(k)),
            )
        })
        .collect();
    let mut swarm = Swarm::new(
        &systems,
        "BlanesMoan4",
        &q.repeat(9),
        &p.repeat(9),
        0.0,
        0.05,
    )
    .unwrap();
    swarm.advance(200).unwrap();
    let states = swarm.states();
    for (index, system) in systems.iter().enumerate() {
        let start = State::new(q.to_vec(), p.to_vec());
        let due = end_by_name(system, "BlanesMoan4", start, 0.05).unwrap();
        let rows = [&states.q, &states.p].map(|rows| &rows[3 * index..3 * index + 3]);
        let found: Vec<u64> = rows.concat().into_iter().map(f64::to_bits).collect();
        assert_eq!(found, due, "member {index}");
    }
}
