//! Figures of runs: closure, conserved quantities, variable steps, low words, small pieces.
//!
//! Input: schemes on systems written by hand. Output: numbers against closed forms and against
//! schemes that should do worse. Invariant: every bound has a scheme that breaks it.

use super::common::kepler::Kepler;
use super::common::systems::{
    Formula, Halves, Hand, HenonHeiles, Paper34, Pendulum, counting, counting::Counted34, pendulum,
};
use super::common::{difference, start};
use hamiltonian_core::VectorOf;
use hamiltonian_core::errors::{StepError, TimeError};
use hamiltonian_core::schemes::*;
use hamiltonian_core::{
    DoubleDouble, Error, Integrator, Real, Scheme, State, System, Vector,
    schemes::author::{Group, Map, Scratch, Step},
};

/// The Jacobi function cn(u | m), by the arithmetic–geometric mean (Abramowitz and Stegun, 16.4).
fn cn(u: f64, m: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (1.0 - m).sqrt());
    let mut ratios = vec![];
    while (a - b).abs() > 1e-17 * a && ratios.len() < 20 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        ratios.push(c / a);
    }
    let mut phi = a * u * f64::from(1_u32 << ratios.len());
    for ratio in ratios.iter().rev() {
        phi = 0.5 * (phi + (ratio * phi.sin()).asin());
    }
    phi.cos()
}

/// The period of (34) from (−3, 0).
const PERIOD: f64 = 3.261_057_238_358_885;

/// The distance from (−3, 0) after ten periods of `steps` steps each, and the gradients of a period.
fn closure(scheme: impl Scheme<Hand<Counted34, 1>>, steps: u64) -> (f64, u64) {
    let system = Hand(Counted34);
    counting::reset();
    let run = Integrator::new(
        &system,
        scheme,
        State::new([-3.0], [0.0]),
        PERIOD / steps as f64,
    );
    let mut run = run.expect("a good start");
    let end = run.advance(10 * steps).expect("good steps");
    let missed = (end.q[0] + 3.0).hypot(end.p[0]);
    (missed, counting::calls().0 / 10)
}

#[test]
fn ten_periods_of_34_close() {
    let (projected, gradients) = closure(MidpointProjected::<KahanLi8>::default(), 88);
    let (second, as_many) = closure(MidpointProjected::<Strang>::default(), 1026);
    println!("Kahan–Li 8: {projected:.1e} with {gradients}, Strang: {second:.1e} with {as_many}");
    assert!(projected <= 3e-12, "{projected:e}");
    assert!((3000..=3100).contains(&gradients), "{gradients}");
    assert!(second > 1e-6, "{second:e}");
    assert!((3000..=3100).contains(&as_many), "{as_many}");
}

#[test]
fn orbits_of_34_are_jacobis_cosine() {
    let system = Hand(Paper34);
    let mut run = Integrator::new(
        &system,
        Semiexplicit::<KahanLi8>::default(),
        State::new([-3.0], [0.0]),
        0.02,
    )
    .expect("a good start");
    let mut worst = 0.0_f64;
    for k in 1..=500 {
        let q = run.advance(1).expect("a good step").q[0];
        let exact = -3.0 * cn(10.0_f64.sqrt() * 0.02 * f64::from(k), 0.9);
        worst = worst.max((q - exact).abs());
    }
    println!("q against −3 cn to t = 10: {worst:.1e}");
    assert!(worst <= 1e-11, "{worst:e}");
    // Sixteen stages, twelve steps a period.
    let (scheme, begin) = (Gauss::<16>::default(), State::new([-3.0], [0.0]));
    let long = Integrator::new(&system, scheme, begin, 0.25);
    let end = long.expect("a good start").advance(40).cloned();
    let missed = end.expect("good steps").q[0] + 2.402_238_313_100_827;
    println!("Gauss 16: {missed:.1e}");
    assert!(missed.abs() <= 1e-12, "{missed:e}");
    let end = run.state();
    assert!((end.q[0] + 2.402_238_313_100_827).abs() <= 1e-11);
    assert!((end.p[0] - 0.690_609_507_457_253_4).abs() <= 1e-11);
}

#[test]
fn mixing_holds_the_copies_together() {
    fn distance(coordinates: f64, momenta: f64) -> f64 {
        let system = Hand(Paper34);
        let scheme = Mixed::new(Strang).with_weights(coordinates, momenta);
        let start = State::new([-3.0], [0.0]);
        let mut run = Integrator::new(&system, scheme, start, 1e-3).expect("a good start");
        run.advance(4_000).expect("good steps");
        run.copy_distance()
    }
    let (unmixed, mixed) = (distance(1.0, 1.0), distance(1.0, 0.5));
    println!("copies at t = 4: unmixed {unmixed:.2e}, momenta averaged {mixed:.2e}");
    // The reference value of the scheme without mixing is 2.7.
    assert!((unmixed - 2.7).abs() < 0.1, "{unmixed}");
    assert!(mixed < 1e-3, "{mixed:e}");
}

#[test]
fn discrete_gradients_keep_h() {
    fn worst(scheme: impl Scheme<Hand<Pendulum, 1>>) -> f64 {
        let system = pendulum(true);
        let start = State::new([std::f64::consts::FRAC_PI_4], [0.0]);
        let energy = system.energy(&start);
        let mut run = Integrator::new(&system, scheme, start, 0.1).expect("a good start");
        let mut worst = 0.0_f64;
        for _ in 0..10_000 {
            let state = run.advance(1).expect("a good step");
            worst = worst.max((system.energy(state) / energy - 1.0).abs());
        }
        worst
    }
    let (keeps, does_not) = (
        worst(DiscreteGradient::default()),
        worst(ImplicitMidpoint::default()),
    );
    println!("|ΔH/H| over 10⁴ steps: {keeps:.1e}, implicit midpoint {does_not:.1e}");
    assert!(keeps <= 10.0 * f64::EPSILON * 100.0, "{keeps:e}");
    assert!(does_not > 1e-6, "{does_not:e}");
}

/// Steps ten times as long as the fastest motion: the fixed point is none, Newton's method is.
#[test]
fn gauss_solves_long_steps_by_newtons_method() {
    let stiff = || {
        Hand(Pendulum {
            m: 1.0,
            l: 1.0,
            g: 1e4,
            from_bottom: true,
        })
    };
    let start = || State::new([0.2], [0.0]);
    let system = stiff();
    let energy = system.energy(&start());
    let mut run =
        Integrator::new(&system, Gauss::<3>::default(), start(), 0.1).expect("a good start");
    let mut worst = 0.0_f64;
    for _ in 0..1_000 {
        let state = run.advance(1).expect("a step that Newton's method solves");
        worst = worst.max((system.energy(state) / energy - 1.0).abs());
    }
    println!("ωh = 10: |ΔH/H| stays at {worst:.1e}");
    assert!(worst < 0.2, "{worst}");
    let system = stiff();
    let mut run =
        Integrator::new(&system, ImplicitMidpoint::default(), start(), 0.1).expect("a good start");
    let error = run.advance(10).expect_err("no fixed point").to_string();
    assert!(error.contains("was not solved"), "{error}");
}

/// Steps with few stages are one loop. Made one by one they have the same bits, also if some of them need Newton's
/// method: at the bottom of the pendulum, but not where it turns.
#[test]
fn steps_with_few_stages_have_the_same_bits_together_and_one_by_one() {
    fn both<M: Scheme<Hand<Pendulum, 1>>>(scheme: M) {
        const STEPS: u64 = 200;
        let system = swinging();
        let new = || {
            let start = State::new([1.5], [0.0]);
            Integrator::new(&system, scheme.clone(), start, 1.6).expect("a good start")
        };
        let (mut together, mut one_by_one) = (new(), new());
        together.advance(STEPS).expect("steps that are solved");
        for _ in 0..STEPS {
            one_by_one.advance(1).expect("a step that is solved");
        }
        assert_eq!(together.state(), one_by_one.state());
        assert_eq!(together.carried(), one_by_one.carried());
    }
    fn swinging() -> Hand<Pendulum, 1> {
        Hand(Pendulum {
            m: 1.0,
            l: 1.0,
            g: 1.0,
            from_bottom: true,
        })
    }
    both(Gauss::<1>::default());
    both(Gauss::<2>::default());
    both(Gauss::<3>::default());
    // The fixed point alone solves the first steps, but not all.
    let start = State::new([1.5], [0.0]);
    let system = swinging();
    let mut run =
        Integrator::new(&system, ImplicitMidpoint::default(), start, 1.6).expect("a good start");
    let error = run.advance(200).expect_err("no fixed point");
    assert!(
        matches!(error, Error::Step(StepError::Unsolved { step, .. }) if step > 1),
        "{error}"
    );
}

/// Q = r^(−3/2).
#[derive(Debug, Clone, Copy)]
pub struct Close;

impl<S: System> Density<S> for Close {
    fn rate<T: Real>(
        &self,
        _: T,
        q: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
        dq: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
    ) -> T {
        let (mut along, mut square) = (T::zero(), T::zero());
        for (q, dq) in q.components().zip(dq.components()) {
            along += q * dq;
            square += q * q;
        }
        T::constant(-1.5, 0.0) * along / square
    }
}

/// e = 0.9 from the pericentre.
fn kepler_start() -> State<VectorOf<Hand<Kepler, 2>>> {
    State::new([0.1, 0.0], [0.0, 19.0_f64.sqrt()])
}

#[test]
fn variable_steps_of_keplers_problem_do_not_drift() {
    let periods = if std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1") {
        100_000
    } else {
        1_000
    };
    // The largest |ΔH/H| of each tenth of the run, and the number of steps made.
    fn tenths<M: Scheme<Hand<Kepler, 2>>>(scheme: M, h: f64, end: f64) -> (Vec<f64>, u64) {
        let system = Hand(Kepler);
        let start = kepler_start();
        let energy = system.energy(&start);
        let mut run = Integrator::new(&system, scheme, start, h).expect("a good start");
        let mut worst = vec![0.0_f64; 10];
        loop {
            let state = run.advance(1).expect("a good step");
            let tenth = (10.0 * state.t / end) as usize;
            let error = (system.energy(state) / energy - 1.0).abs();
            match worst.get_mut(tenth) {
                Some(worst) => *worst = worst.max(error),
                None => return (worst, run.steps()),
            }
        }
    }
    let end = f64::from(periods) * std::f64::consts::TAU;
    let paced = Paced::new(StormerVerlet::default(), Close);
    let (errors, steps) = tenths(paced, 1e-3, end);
    println!("{errors:?} with {} steps a period", steps / periods as u64);
    let largest = errors.iter().copied().fold(0.0, f64::max);
    // No drift.
    assert!(largest <= 1.02 * errors[0], "{errors:?}");
    // Fixed steps of the same number are worse.
    let (fixed, _) = tenths(StormerVerlet::default(), end / steps as f64, end / 100.0);
    println!("fixed steps: {:.3e}", fixed[0]);
    assert!(fixed[0] > 20.0 * largest, "{fixed:?}");
}

/// Any time is reached by a part of a step, whatever the steps' durations; times of one are no steps.
#[test]
fn any_time_with_variable_steps() {
    let scheme = Paced::new(Suzuki4, Close);
    let fine = |t: f64| {
        let mut run =
            Integrator::new(&Hand(Kepler), KahanLi8, kepler_start(), t / 65536.0).unwrap();
        run.advance(65536).unwrap().clone()
    };
    for sign in [1.0, -1.0] {
        let with = |h| Integrator::new(&Hand(Kepler), scheme, kepler_start(), sign * h).unwrap();
        let new = || with(1e-3);
        let times = [0.0, 0.1, 0.1001, 0.7, 3.0].map(|t| sign * t);
        let mut run = new();
        let states: Vec<_> = run.states_at(times).map(Result::unwrap).collect();
        for (state, t) in states.iter().zip(times) {
            assert!((state.t - t).abs() < 1e-14, "{} for {t}", state.t);
            assert_eq!(state, &new().advance_until(t).unwrap());
            if t.abs() < 0.5 {
                continue;
            }
            // Of the scheme's order, 4.
            let exact = fine(t);
            let errors = [4e-3, 2e-3].map(|h| {
                let end = with(h).advance_until(t).unwrap();
                (end.q - exact.q).norm()
            });
            let slope = (errors[0] / errors[1]).log2();
            assert!((slope - 4.0).abs() < 0.2, "{slope}: {errors:?} at {t}");
        }
        // The run made whole steps alone.
        let mut beside = new();
        assert_eq!(beside.advance(run.steps()).unwrap(), run.state());
        let far = run.state_at(times[1]).unwrap_err();
        assert!(matches!(far, Error::Time(TimeError::Far { .. })), "{far}");
        assert!(matches!(
            run.advance_until(0.0),
            Err(Error::Time(TimeError::Far { .. }))
        ));
        assert!(matches!(
            run.advance_to(4.0),
            Err(Error::Time(TimeError::Uneven { .. }))
        ));
        assert!(run.advance_until(f64::NAN).is_err());
    }
}

#[test]
fn variable_steps_return() {
    let system = Hand(Kepler);
    let prepared = System::prepare::<f64>(&system);
    let scheme = Paced::new(Suzuki4, Close);
    let mut carried = Scheme::<Hand<Kepler, 2>>::start(&scheme, &prepared, &kepler_start(), 2e-3);
    let begin = carried.clone();
    for h in [2e-3, -2e-3] {
        let map = Scheme::<Hand<Kepler, 2>>::prepare(&scheme, &prepared, Step::of(h));
        let mut work = Scratch::like(&carried);
        for _ in 0..2_000 {
            map.step(0.0, h, &mut carried, &mut work);
        }
        let away = carried.distance(&begin);
        println!("after steps of {h}: {away:.1e}");
        assert_eq!(away < 1e-9, h < 0.0, "{away:e}");
    }
}

/// Rounding errors of `scheme` on Hénon–Heiles after so many steps, root mean square over the
/// trajectories: of H relative, and of the point, f64 less double-double of the same steps.
fn rounding<M>(scheme: &M, trajectories: u32, counts: &[u64]) -> Vec<(f64, f64)>
where
    M: Scheme<Hand<HenonHeiles, 2>>,
{
    let system = Hand(HenonHeiles);
    let mut sums = vec![(0.0, 0.0); counts.len()];
    for k in 0..trajectories {
        let x = 0.01 * f64::from(k) / f64::from(trajectories);
        let (q, p) = ([x, 0.1], [0.3, 0.1 + x]);
        let h = 0.05;
        let begin = start::<f64, _>(&system, &q, &p);
        let rounded = Integrator::new(&system, scheme.clone(), begin, h);
        let mut rounded = rounded.expect("a good start");
        let begin = start::<DoubleDouble, _>(&system, &q, &p);
        let exact = Integrator::new(&system, scheme.clone(), begin, DoubleDouble::from(h));
        let mut exact = exact.expect("a good start");
        for (steps, (energies, points)) in counts.iter().zip(&mut sums) {
            let rounded = (rounded.advance(steps - rounded.steps())).expect("good steps");
            let exact = (exact.advance(steps - exact.steps())).expect("good steps");
            // H at the ends, in double-double, so that evaluating it adds no rounding.
            let lifted = State {
                t: exact.t,
                q: rounded.q.map(DoubleDouble::from),
                p: rounded.p.map(DoubleDouble::from),
            };
            let energy = system.energy(exact);
            let error = ((system.energy(&lifted) - energy) / energy).to_f64();
            *energies += error * error;
            *points += difference(&lifted, exact).powi(2);
        }
    }
    let mean = |sum: f64| (sum / f64::from(trajectories)).sqrt();
    (sums.into_iter())
        .map(|(energy, point)| (mean(energy), mean(point)))
        .collect()
}

/// Random walks: of the energy the error grows like √t, of the phase like t√t; and not like t, t².
#[test]
fn low_words_keep_rounding_from_growing() {
    let heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    let (trajectories, longest) = if heavy { (32, 1_000_000) } else { (8, 4_000) };
    let counts = [1000, 100, 10, 1].map(|part| longest / part);
    let compensated = rounding(&Compensated(KahanLi8), trajectories, &counts);
    for (steps, (energy, point)) in counts.iter().zip(&compensated) {
        println!("{steps} steps, compensated: H {energy:.2e}, point {point:.2e}");
    }
    let plain = rounding(&KahanLi8, trajectories, &counts[3..])[0];
    let last = compensated[3];
    println!(
        "{longest} steps, plain: H {:.2e}, point {:.2e}",
        plain.0, plain.1
    );
    assert!(plain.0 > 20.0 * last.0, "H: {} and {}", plain.0, last.0);
    assert!(plain.1 > 20.0 * last.1, "point: {} and {}", plain.1, last.1);
    if heavy {
        let slope = |of: fn(&(f64, f64)) -> f64| (of(&last) / of(&compensated[0])).log10() / 3.0;
        let (energy, point) = (slope(|e| e.0), slope(|e| e.1));
        println!("slopes: H {energy:.3}, point {point:.3}");
        assert!((energy - 0.5).abs() <= 0.1, "{energy}");
        assert!((point - 1.5).abs() <= 0.15, "{point}");
    }
}

/// A large potential and a small kinetic energy: H = −cos q − sin 2q + ε√(1 + p²).
#[derive(Debug, Clone)]
struct Small(f64);

impl Formula<1> for Small {
    const NAME: &'static str = "Small";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    fn energy<T: Real>(&self, _: T, q: &[T; 1], p: &[T; 1]) -> T {
        let epsilon = T::constant(self.0, 0.0);
        let two = T::constant(2.0, 0.0);
        epsilon * (T::one() + p[0] * p[0]).sqrt() - q[0].cos() - (two * q[0]).sin()
    }
}

impl Halves<1> for Small {
    fn force<T: Real>(&self, _: T, q: &[T; 1]) -> [T; 1] {
        let two = T::constant(2.0, 0.0);
        [q[0].sin() - two * (two * q[0]).cos()]
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 1]) -> [T; 1] {
        [T::constant(self.0, 0.0) * p[0] / (T::one() + p[0] * p[0]).sqrt()]
    }
}

/// SABA's error falls with ε², Strang's with ε.
#[test]
fn errors_scale_with_the_small_piece() {
    fn error<M: Scheme<Hand<Small, 1>>>(scheme: M, epsilon: f64) -> f64 {
        let system = Hand(Small(epsilon));
        let end = |steps: u64, scheme: &dyn Fn(DoubleDouble) -> State<_>| {
            scheme(DoubleDouble::from(1.0) / DoubleDouble::from(steps as f64))
        };
        let begin: State<_> = start(&system, &[0.4], &[0.3]);
        let coarse = end(10, &|h| {
            let run = Integrator::new(&system, scheme.clone(), begin.clone(), h);
            run.expect("a good start")
                .advance(10)
                .expect("good steps")
                .clone()
        });
        let exact = end(40, &|h| {
            let run = Integrator::new(&system, SofroniouSpaletta10, begin.clone(), h);
            run.expect("a good start")
                .advance(40)
                .expect("good steps")
                .clone()
        });
        difference(&coarse, &exact)
    }
    fn exponent<M: Scheme<Hand<Small, 1>>>(scheme: M) -> f64 {
        let exponent = (error(scheme.clone(), 1e-3) / error(scheme.clone(), 1e-4)).log10();
        println!("{}: error ~ ε^{exponent:.3}", scheme.entry().name);
        exponent
    }
    assert!((exponent(Strang) - 1.0).abs() < 0.1);
    for exponent in [exponent(Saba3), exponent(Saba4), exponent(Aba104)] {
        assert!((exponent - 2.0).abs() < 0.1, "{exponent}");
    }
}

/// Five sites of the discrete nonlinear Schrödinger equation, ψ = (q + ip)/√2.
#[derive(Debug, Clone)]
struct Dnls;

impl Formula<5> for Dnls {
    const NAME: &'static str = "Dnls";
    const GROUPS: &'static [Group] = &[
        Group::scalar("q0", "p0", 0),
        Group::scalar("q1", "p1", 1),
        Group::scalar("q2", "p2", 2),
        Group::scalar("q3", "p3", 3),
        Group::scalar("q4", "p4", 4),
    ];
    fn energy<T: Real>(&self, _: T, q: &[T; 5], p: &[T; 5]) -> T {
        let mut sum = T::zero();
        for i in 0..5 {
            let next = (i + 1) % 5;
            let square = q[i] * q[i] + p[i] * p[i];
            sum += T::constant(0.25, 0.0) * square * square - q[i] * q[next] - p[i] * p[next];
        }
        sum
    }
}

/// Σ(q² + p²) is quadratic, and so kept by the semiexplicit method.
#[test]
fn semiexplicit_keeps_quadratic_invariants() {
    fn change<M: Scheme<Hand<Dnls, 5>>>(scheme: M) -> f64 {
        let system = Hand(Dnls);
        let start = start(
            &system,
            &[0.9, 0.1, -0.4, 0.2, 0.3],
            &[0.1, 0.5, 0.2, -0.3, 0.0],
        );
        let norm = |state: &State<VectorOf<Hand<Dnls, 5>>>| {
            state.q.norm_squared() + state.p.norm_squared()
        };
        let begin = norm(&start);
        let mut run = Integrator::new(&system, scheme, start, 0.05).expect("a good start");
        let mut worst = 0.0_f64;
        for _ in 0..5_000 {
            worst = worst.max((norm(run.advance(1).expect("a good step")) / begin - 1.0).abs());
        }
        worst
    }
    let kept = change(Semiexplicit::<Suzuki4>::default());
    let control = change(MidpointProjected::<Suzuki4>::default());
    println!("Σ(q² + p²) over 5000 steps: {kept:.1e}, midpoint-projected {control:.1e}");
    assert!(kept < 1e-13, "{kept:e}");
    assert!(control > 100.0 * kept, "{control:e}");
}
