//! Changes of coordinates, another time, velocities and lattices: states and runs have the bits of compiled ones.
//!
//! Input: definitions, each compiled and read at run time from the same tokens. Output: a panic with the first component
//! that differs. Invariant: numbers are compared in the order in which each system stores them, which is the same.

use hamiltonian::prelude::*;
use hamiltonian::{Lattice, Vector};
use hamiltonian_runtime::{Definition, FlatState, Run, RunError, RuntimeSystem, Values};

fn made(text: &str, values: Values) -> RuntimeSystem {
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let made = definition.system(values);
    made.unwrap_or_else(|error| panic!("{error}"))
}

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

both!(planet: pub struct Planet { k = 0.1 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2) + k*x/(x^2 + y^2);
    coordinates polar(x, y);
    split { Free = p_r^2/2 + p_phi^2/(2*r^2); Potential = -1/r + k*cos(phi)/r });
both!(hung: pub struct Hung { m = 1.0 }
    H(x, q[3]; p_x, p[3]) = p_x^2/2 + norm_squared(p)/(2*m) + m*q[2] + (norm(q) - 1)^2*(5 + x);
    coordinates spherical(q));
both!(planets: pub struct Planets { n: usize, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m));
both!(sundman: pub struct Sundman {}
    H(x, y; p_x, p_y; t) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2) + x*cos(t)/100;
    coordinates polar(x, y);
    dt = sqrt(x^2 + y^2)*ds);
both!(swing: pub struct Swing { l = 2.0 }
    L(x, y; u, v) = l*(u^2 + v^2 + u*v)/2 - x^4 - y^2;
    dt = (1 + x^2)*ds);
both!(sheet: pub struct Sheet { n: usize, m: usize, k = 2.0 }
H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
    p[i][j]^2/2 + k*(1 - cos(u[(i + 1) % n][j] - u[i][j])) + (u[i][(j + 1) % m] - u[i][j])^4/4
});

/// The bits of a state.
fn bits<V: Vector<Scalar = f64>>(state: &State<V>) -> Vec<u64> {
    let all = state.q.components().chain(state.p.components());
    all.chain([state.t]).map(f64::to_bits).collect()
}

/// The end of a compiled run.
fn end<S: System, M: Scheme<S>>(
    system: &S,
    scheme: M,
    start: State<hamiltonian::VectorOf<S>>,
    step: f64,
) -> Vec<u64> {
    let mut run = Integrator::new(system, scheme, start, step).unwrap_or_else(|e| panic!("{e}"));
    bits(run.advance(50).unwrap_or_else(|e| panic!("{e}")))
}

/// The end of a run whose scheme has a name.
fn end_by_name(system: &RuntimeSystem, scheme: &str, start: FlatState, step: f64) -> Vec<u64> {
    let mut run = Run::new(system, scheme, start, step).unwrap_or_else(|e| panic!("{e}"));
    run.advance(50).unwrap_or_else(|e| panic!("{e}"));
    bits(run.state())
}

#[test]
fn other_coordinates() {
    let compiled = planet::Planet::default();
    let own = made(planet::TEXT, Values::new());
    let due = compiled.from_declared(&State::new([0.0, 0.5], [-1.5, 0.1]));
    let start = State::new(vec![0.0, 0.5], vec![-1.5, 0.1]);
    let found = own.from_declared(&start).unwrap();
    assert_eq!(bits(&found), bits(&due));
    assert_ne!(found.q, start.q);
    let back = own.to_declared(&found).unwrap();
    assert_eq!(bits(&back), bits(&compiled.to_declared(&due)));
    let names: Vec<&str> = own.coordinates().iter().map(|of| of.name()).collect();
    assert_eq!(names, ["r", "phi"]);
    assert_eq!(own.declared_coordinates()[0].momentum(), "p_x");
    let due = end(&compiled, BlanesMoan4, due, 0.01);
    assert_eq!(end_by_name(&own, "BlanesMoan4", found, 0.01), due);

    let (compiled, own) = (hung::Hung::default(), made(hung::TEXT, Values::new()));
    let due = compiled.from_declared(&State {
        t: 0.5,
        q: hung::HungDeclared::new(0.5, [0.6, 0.0, -0.8]),
        p: hung::HungDeclared::new(1.0, [0.0, 0.1, 0.0]),
    });
    let start = State::new(vec![0.5, 0.6, 0.0, -0.8], vec![1.0, 0.0, 0.1, 0.0]).at(0.5);
    let found = own.from_declared(&start).unwrap();
    assert_eq!(bits(&found), bits(&due));
    let back = own.to_declared(&found).unwrap();
    assert_eq!(bits(&back), bits(&compiled.to_declared(&due)));
}

#[test]
fn other_coordinates_of_bodies() {
    let m = [1.0, 0.5, 0.25];
    let compiled = planets::Planets::new(3, m.to_vec()).unwrap();
    let own = made(planets::TEXT, Values::new().with("n", 3).with("m", m));
    let q = [[0.1, 0.0, 0.0], [1.1, 0.0, 0.2], [0.0, -2.0, 0.1]];
    let p = [[0.0, -0.5, 0.0], [0.0, 0.5, 0.1], [0.2, 0.0, 0.0]];
    let by_columns =
        |rows: [[f64; 3]; 3]| -> Vec<f64> { (0..9).map(|at| rows[at % 3][at / 3]).collect() };
    let due = compiled.from_declared(&State::new(q.to_vec(), p.to_vec()));
    let start = State::new(by_columns(q), by_columns(p));
    let found = own.from_declared(&start).unwrap();
    assert_eq!(bits(&found), bits(&due));
    let back = own.to_declared(&found).unwrap();
    assert_eq!(bits(&back), bits(&compiled.to_declared(&due)));
    let due = end(&compiled, RungeKutta4, due, 0.01);
    assert_eq!(end_by_name(&own, "RungeKutta4", found, 0.01), due);
}

#[test]
fn another_time() {
    let compiled = sundman::Sundman::default();
    let own = made(sundman::TEXT, Values::new());
    assert_eq!(own.description().clock(), "s");
    let due = compiled.from_declared(&State::new([0.1, 0.0], [0.0, 4.0]).at(0.25));
    let start = State::new(vec![0.1, 0.0], vec![0.0, 4.0]).at(0.25);
    let found = own.from_declared(&start).unwrap();
    assert_eq!(bits(&found), bits(&due));
    assert_eq!((found.t, found.q[2]), (0.0, 0.25));
    let back = own.to_declared(&found).unwrap();
    assert_eq!(bits(&back), bits(&compiled.to_declared(&due)));
    assert_eq!(back.t, 0.25);
    let off = State::new(found.q.as_slice().to_vec(), vec![0.0, 0.4, 7.0]);
    let refused = Run::new(&own, "RungeKutta4", off.clone(), 0.01).unwrap_err();
    assert!(refused.to_string().contains("shell"), "{refused}");
    assert!(Run::new(&own, "RungeKutta4", own.on_shell(&off).unwrap(), 0.01).is_ok());
    let due = end(&compiled, RungeKutta4, due, 0.01);
    assert_eq!(end_by_name(&own, "RungeKutta4", found, 0.01), due);
}

#[test]
fn velocities() {
    let (compiled, own) = (swing::Swing::default(), made(swing::TEXT, Values::new()));
    let due = compiled.state_from_velocity(0.5, [1.0, 0.5], [0.25, -1.0]);
    let velocities = State::new(vec![1.0, 0.5], vec![0.25, -1.0]).at(0.5);
    let found = own.state_from_velocity(&velocities).unwrap();
    assert_eq!(bits(&found), bits(&due));
    assert_ne!(found.p[0], 0.25);
    let error = made(planet::TEXT, Values::new()).state_from_velocity(&velocities);
    assert_eq!(error, Err(RunError::NoLagrangian));
}

#[test]
fn lattices() {
    let (n, m) = (6, 40);
    let compiled = sheet::Sheet::new(n, m).unwrap();
    let own = made(sheet::TEXT, Values::new().with("n", n).with("m", m));
    assert_eq!(own.coordinates()[0].extents(), [n, m]);
    let u = |at: usize| ((at * at) as f64 * 0.37).sin();
    let q = Lattice::from_fn([n, m], |[i, j]| u(i * m + j));
    let p = Lattice::from_fn([n, m], |[i, j]| u(i * m + j + 7));
    let start = State::new(
        (0..n * m).map(u).collect::<Vec<_>>(),
        (7..n * m + 7).map(u).collect(),
    );
    let due = end(&compiled, BlanesMoan4, State::new(q, p), 0.05);
    assert_eq!(end_by_name(&own, "BlanesMoan4", start, 0.05), due);
}

#[test]
fn states_of_another_length_are_refused() {
    let planet = made(planet::TEXT, Values::new());
    let sundman = made(sundman::TEXT, Values::new());
    let two = State::new(vec![1.0; 2], vec![1.0; 2]);
    let three = State::new(vec![1.0; 2], vec![1.0; 3]);
    for result in [
        planet.from_declared(&three),
        planet.to_declared(&three),
        sundman.from_declared(&three),
        sundman.to_declared(&two),
        sundman.on_shell(&two),
    ] {
        assert!(matches!(result, Err(RunError::Length { .. })));
    }
}
