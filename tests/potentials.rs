//! Rust functions as potentials: derivatives by dual numbers, and functions with data as parameters.

use hamiltonian::errors::StepError;
use hamiltonian::prelude::*;
use hamiltonian::schemes::Srkn6b;
use hamiltonian::schemes::author::Dynamics;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

fn morse<T: Real>(r: T) -> T {
    let x = T::one() - (T::one() - r).exp();
    x * x
}
fn wrong_slope<T: Real>(r: T) -> T {
    T::constant(3.0, 0.0) * r
}
fn egg_box<T: Real>(x: T, y: T) -> T {
    x.cos() * y.sin() + x * x * y
}

hamiltonian! {
    /// The potential of Morse, as a Rust function and in the language.
    pub struct ByRust { m = 1.0 }
    fn V(r) = morse;
    H(x, y; px, py) = (px^2 + py^2)/(2*m) + V(hypot(x, y))
}
hamiltonian! {
    pub struct InLanguage { m = 1.0 }
    let V(r) = (1 - exp(1 - r))^2;
    H(x, y; px, py) = (px^2 + py^2)/(2*m) + V(hypot(x, y))
}
hamiltonian! {
    /// A first derivative that is given wins over that of dual numbers, and second ones follow from it.
    pub struct Given {}
    fn V(r) = morse, (wrong_slope);
    H(q; p) = p^2/2 + V(q)
}
hamiltonian! {
    pub struct TwoByRust {}
    fn V(x, y) = egg_box;
    H(x, y; px, py) = (px^2 + py^2)/2 + V(x, y);
    monitor pull = bracket(px, H)
}
hamiltonian! {
    pub struct TwoInLanguage {}
    H(x, y; px, py) = (px^2 + py^2)/2 + cos(x)*sin(y) + x^2*y;
    monitor pull = bracket(px, H)
}
hamiltonian! {
    /// Its second derivatives have third ones of a Rust function.
    pub struct SlopeByRust {}
    fn V(x, y) = egg_box;
    H(x, y; px, py) = (px^2 + py^2)/2 + bracket(V(x, y), px)
}
hamiltonian! {
    pub struct SlopeInLanguage {}
    H(x, y; px, py) = (px^2 + py^2)/2 - sin(x)*sin(y) + 2*x*y
}
hamiltonian! {
    /// A particle in a potential that is given when the program runs.
    pub struct Well {
        /// The potential.
        V: fn(r),
        m = 1.0,
    }
    H(x, y; px, py) = (px^2 + py^2)/(2*m) + V(hypot(x, y))
}
hamiltonian! {
    /// Atoms in a line, each bound to its neighbours and to a substrate.
    pub struct Chain { n: usize, bond: fn(r), site: fn(x, y), k = 0.5 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + site(q[i], k) + bond(q[(i + 1) % n] - q[i]) }
}

/// The close approximation of `f` on [a, b] by a natural spline on `n` intervals.
fn spline(f: impl Fn(f64) -> f64, [a, b]: [f64; 2], n: usize) -> Spline {
    let knots: Vec<f64> = (0..=n).map(|i| a + (b - a) * i as f64 / n as f64).collect();
    let values: Vec<f64> = knots.iter().map(|x| f(*x)).collect();
    Spline::natural(&knots, &values).unwrap()
}

/// The numbers of H, its gradient and its Hessian times a direction at a point.
macro_rules! derivatives {
    ($system:expr, $q:expr, $p:expr) => {{
        let (system, start) = ($system, State::new($q, $p));
        let (mut vq, mut vp) = (start.q, start.p);
        // Some direction.
        (vq[0], vp[0]) = (0.8, -0.3);
        let prepared = system.prepare();
        let gradient = system.gradient(&start);
        let mut all = vec![system.energy(&start)];
        all.extend(gradient.q.iter().chain(gradient.p.iter()));
        let (mut hq, mut hp) = (start.q, start.p);
        prepared.hessian_vector(0.0, &start.q, &start.p, &vq, &vp, &mut hq, &mut hp);
        all.extend(hq.iter().chain(hp.iter()));
        all
    }};
}

fn agree(a: &[f64], b: &[f64], bound: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= bound * (1.0 + b.abs()), "{a} and {b}");
    }
}

#[test]
fn derivatives_of_rust_functions_are_those_of_the_language() {
    let (q, p) = ([0.7, 1.9], [0.2, -0.4]);
    let ours = derivatives!(ByRust::default(), q, p);
    agree(&ours, &derivatives!(InLanguage::default(), q, p), 1e-14);
    let ours = derivatives!(TwoByRust {}, q, p);
    agree(&ours, &derivatives!(TwoInLanguage {}, q, p), 1e-14);
    let ours = derivatives!(SlopeByRust {}, q, p);
    agree(&ours, &derivatives!(SlopeInLanguage {}, q, p), 1e-14);
    let start = State::new(q, p);
    let pull = TwoInLanguage {}.pull(&start);
    assert!((TwoByRust {}.pull(&start) - pull).abs() < 1e-14);
}

#[test]
fn given_derivatives_win() {
    // V′ is 3q where it is given, so V″ is 3.
    let found = derivatives!(Given {}, [2.0], [0.5]);
    assert_eq!(found[1..], [6.0, 0.5, 3.0 * 0.8, -0.3]);
}

#[test]
fn a_spline_is_a_potential() -> Result<(), Error> {
    let (q, p) = ([0.7, 1.9], [0.2, -0.4]);
    let well = Well::new(spline(morse, [0.0, 6.0], 600));
    agree(
        &derivatives!(well.clone(), q, p),
        &derivatives!(InLanguage::default(), q, p),
        2e-4,
    );
    // The scheme is symplectic: H has no drift, although it is a spline.
    let start = State::new([1.5, 0.0], [0.0, 0.6]);
    let mut run = Integrator::new(&well, BlanesMoan4, start, 0.02)?.observe(EnergyDrift::new());
    run.advance(20_000)?;
    assert!(run.observer().max_relative() < 1e-6);
    // A particle that leaves the knots ends the run with an error, and not with a wrong number.
    let away = State::new([5.5, 0.0], [3.0, 0.0]);
    let mut run = Integrator::new(&well, BlanesMoan4, away, 0.02)?;
    let error = run.advance(1000);
    assert!(
        matches!(error, Err(Error::Step(StepError::NotFinite { .. }))),
        "{error:?}"
    );
    Ok(())
}

#[test]
fn functions_stand_in_loops_over_sites() -> Result<(), Error> {
    let n = 40;
    let bond = spline(|r| 0.5 * r * r + 0.1 * r * r * r * r, [-8.0, 8.0], 800);
    let spacing = std::f64::consts::TAU / 32.0;
    let rows: Vec<Vec<f64>> = (0..32)
        .map(|i| vec![1.0 - (i as f64 * spacing).cos(); 4])
        .collect();
    let site = Grid::periodic([0.0; 2], [spacing, 0.25], &rows)?;
    let chain = Chain::new(n, bond.clone(), site.clone())?;
    let q: Vec<f64> = (0..n).map(|i| (0.7 * i as f64).sin()).collect();
    let start = State::new(q.clone(), vec![0.3; n]);
    let force = |i: usize| {
        let stretch = |i: usize| q[(i + 1) % n] - q[i % n];
        let bond = |r: f64| bond.value([Dual::variable(r)]).eps;
        let site = site.value([Dual::variable(q[i]), Dual::fixed(0.5)]).eps;
        site + bond(stretch(i + n - 1)) - bond(stretch(i))
    };
    let gradient = chain.gradient(&start);
    for i in 0..n {
        assert!((gradient.q[i] - force(i)).abs() < 1e-13, "site {i}");
    }
    let mut run =
        Integrator::new(&chain, StormerVerlet::default(), start, 0.01)?.observe(EnergyDrift::new());
    run.advance(5000)?;
    assert!(run.observer().max_relative() < 1e-4);
    Ok(())
}

/// Members of a pack stand in different intervals, and each has the bits of a run by itself.
#[test]
fn each_lane_finds_its_own_interval() -> Result<(), Error> {
    let well = Well::new(spline(morse, [0.0, 6.0], 600));
    let make = |member: Member| {
        let at = member.index as f64;
        let well = Well {
            m: 1.0 + 0.1 * at,
            ..well.clone()
        };
        (well, State::new([0.8 + 0.05 * at, 0.1], [0.1, 0.02 * at]))
    };
    let mut ensemble = Ensemble::new(21, make, Srkn6b, 0.03)?.reproducible();
    ensemble.advance(300);
    for (index, end) in ensemble.states().enumerate() {
        let (system, start) = make(Member::new(index, 0));
        let mut run = Integrator::new(&system, Srkn6b, start, 0.03)?;
        assert_eq!(&end?, run.advance(300)?, "member {index}");
    }
    Ok(())
}

#[test]
fn members_have_one_function() {
    let wells = [1.0, 2.0].map(|k| Well::new(spline(move |r| k * r * r, [0.0, 6.0], 60)));
    let make = |member: Member| {
        (
            wells[member.index].clone(),
            State::new([1.0, 0.0], [0.0, 0.0]),
        )
    };
    let ensemble = Ensemble::new(2, make, Srkn6b, 0.03).unwrap();
    let ends: Vec<_> = ensemble.states().collect();
    assert!(ends[0].is_ok());
    let error = ends[1].as_ref().unwrap_err().to_string();
    assert!(error.contains("other sizes or functions"), "{error}");
}

#[test]
fn a_saved_run_goes_on_with_the_same_data_only() -> Result<(), Error> {
    let [one, other] = [600, 601].map(|n| Well::new(spline(morse, [0.0, 6.0], n)));
    let start = State::new([1.5, 0.0], [0.0, 0.6]);
    let mut run = Integrator::new(&one, StormerVerlet::default(), start, 0.02)?;
    run.advance(50)?;
    let saved = run.checkpoint();
    let scheme = StormerVerlet::default();
    let again = Integrator::resume(&one.clone(), scheme, saved.clone())?;
    assert_eq!(again.state(), run.state());
    let error = Integrator::resume(&other, scheme, saved)
        .unwrap_err()
        .to_string();
    assert!(
        error.starts_with("the saved run has another parameter: saved `V = function "),
        "{error}"
    );
    Ok(())
}

#[test]
fn derivatives_by_parameters_keep_the_function() {
    let well = Well::new(spline(morse, [0.0, 6.0], 60));
    let gradient = well.parameter_gradient(&State::new([1.0, 0.0], [0.6, 0.0]));
    assert_eq!(
        (gradient.m, gradient.V.fingerprint()),
        (-0.18, well.V.fingerprint())
    );
}

/// A potential x² that counts how often a text of it is written.
#[derive(Debug, Clone)]
struct Counted(Arc<AtomicUsize>);

impl Function<1> for Counted {
    fn value<T: Real>(&self, [x]: [T; 1]) -> T {
        x * x
    }
    fn fingerprint(&self) -> u64 {
        self.0.fetch_add(1, Relaxed) as u64
    }
}

/// The text of the parameters is written when a run is saved, not when it begins or changes.
#[test]
fn a_run_that_is_not_saved_writes_no_parameters() -> Result<(), Error> {
    let written = Arc::new(AtomicUsize::new(0));
    let well = Well::new(Counted(Arc::clone(&written)));
    let start = State::new([0.5, 0.2], [0.0, 0.1]);
    let mut run = Integrator::new(&well, StormerVerlet::default(), start, 0.01)?;
    run.advance(3)?;
    run.set_system(&well)?;
    run.set_state(run.state().clone())?;
    run.clone().advance(1)?;
    assert_eq!(written.load(Relaxed), 0);
    // By a system of the same parameters in another time, also.
    let timed = TimeTransformed::new(well.clone(), well);
    let start = timed.start(run.state())?;
    let timed = Integrator::new(&timed, Gauss::<2>::default(), start, 0.01)?;
    assert_eq!(written.load(Relaxed), 0);
    run.checkpoint();
    assert_eq!(written.load(Relaxed), 1);
    timed.checkpoint();
    assert_eq!(written.load(Relaxed), 3);
    Ok(())
}
