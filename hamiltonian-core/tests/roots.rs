//! Events at roots on steps and between them, near poles and jumps, against the construction of the function.
//!
//! Input: random functions of time, products of powers with roots, poles and changes of sign at known times, many of
//! them exactly on steps. Output: the located events. Control: the last sign of a function alone, without what lies
//! between zeros.

use crate::common::random::{Random, cases};
use crate::common::systems::{Hand, HenonHeiles};
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::{Dual, Scheme};

type Plane = SVector<f64, 2>;

/// The behaviour of a function at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
enum At {
    /// (t − c)ᵏ.
    Root(i32),
    /// (t − c)⁻ᵏ.
    Pole(i32),
    /// sign(t − c), which is 0 at c.
    Jump,
}

/// A product of factors.
#[derive(Debug, Clone)]
struct Product {
    factors: Vec<(f64, At)>,
    scale: f64,
}

impl Product {
    fn value(&self, t: f64) -> f64 {
        self.factors.iter().fold(self.scale, |product, (c, at)| {
            let x = t - c;
            product
                * match at {
                    At::Root(k) => x.powi(*k),
                    At::Pole(k) => x.powi(-k),
                    At::Jump if x == 0.0 => 0.0,
                    At::Jump => x.signum(),
                }
        })
    }

    /// A random function over `steps` steps of the size `step`: what it does on steps, and in some steps something
    /// between.
    fn random(random: &mut Random, steps: u32, step: impl Fn(f64) -> f64) -> Self {
        let mut factors = Vec::new();
        for k in 0..steps {
            let mut place = |at: f64, random: &mut Random| {
                let kind = match random.below(10) {
                    0 => At::Pole(1 + random.below(2) as i32),
                    1 => At::Jump,
                    2 => At::Root(2),
                    3 => At::Root(3),
                    _ => At::Root(1),
                };
                factors.push((step(at), kind));
            };
            if random.below(2) == 0 {
                place(f64::from(k), random);
            }
            if random.below(5) == 0 {
                place(f64::from(k) + random.between(0.02, 0.98), random);
            }
        }
        let scale = random.between(0.5, 2.0) * if random.below(2) == 0 { 1.0 } else { -1.0 };
        Product { factors, scale }
    }

    /// The roots of odd order after the start and before the last time, in the direction of the run.
    fn roots(&self, last: f64) -> Vec<(f64, bool)> {
        let mut roots: Vec<(f64, bool)> = Vec::new();
        for (c, at) in &self.factors {
            let is_inside = c.abs() > 0.0 && c.abs() < last.abs();
            if let At::Root(k) = at
                && k % 2 == 1
                && is_inside
            {
                let mut after = self.clone();
                after.factors.retain(|(other, _)| other != c);
                let rises = after.value(*c) > 0.0;
                roots.push((*c, rises == (last > 0.0)));
            }
        }
        roots.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        roots
    }
}

/// The located events of a function of time.
fn located(
    product: &Product,
    step: f64,
    steps: u64,
    change: impl Fn(Event<Plane>) -> Event<Plane>,
) -> Vec<(f64, bool)> {
    let product = product.clone();
    let event = Event::of("f", move |state: &State<Plane>| product.value(state.t));
    let start = State::new([0.1, -0.25], [0.42, 0.1]);
    let mut run = Integrator::new(&Hand(HenonHeiles), StormerVerlet::default(), start, step)
        .expect("a good start")
        .observe(Events::new([change(event)]));
    run.advance(steps).expect("finite");
    let located = run.observer().located().iter();
    located.map(|found| (found.state.t, found.rising)).collect()
}

fn agree(found: &[(f64, bool)], expected: &[(f64, bool)]) -> bool {
    let near = |(a, b): (&(f64, bool), &(f64, bool))| a.1 == b.1 && (a.0 - b.0).abs() < 1e-9;
    found.len() == expected.len() && found.iter().zip(expected).all(near)
}

/// Events of signs after steps alone.
fn by_signs(product: &Product, step: f64, steps: u64) -> usize {
    let (mut last, mut count) = (0.0, 0);
    for k in 0..=steps {
        let value = product.value(k as f64 * step);
        if value != 0.0 {
            count += usize::from(last * value < 0.0);
            last = value;
        }
    }
    count
}

#[test]
fn what_lies_between_zeros_on_steps_is_found_and_no_pole_is_a_root() {
    let (mut found, mut missed) = (0, 0);
    for seed in 0..cases(400, 40_000) {
        let mut random = Random(seed);
        let steps = 3 + random.below(8) as u32;
        let size = [0.25, 0.1, 1.0 / 3.0][seed as usize % 3];
        let step = if seed.is_multiple_of(2) { size } else { -size };
        let product = Product::random(&mut random, steps, |k| k * step);
        let last = f64::from(steps) * step;
        let expected = product.roots(last);
        for slope in [0, 1, -1] {
            let change = |event: Event<Plane>| match slope {
                1 => event.with_direction(1),
                -1 => event.with_direction(-1),
                _ => event,
            };
            let wanted = expected
                .iter()
                .filter(|root| slope == 0 || root.1 == (slope > 0));
            let wanted: Vec<_> = wanted.copied().collect();
            let located = located(&product, step, u64::from(steps), change);
            assert!(
                agree(&located, &wanted),
                "seed {seed}, slope {slope}, step {step}: {product:?}\n{located:?}\n{wanted:?}"
            );
        }
        found += expected.len();
        missed += usize::from(by_signs(&product, step, u64::from(steps)) != expected.len());
    }
    assert!(found > 1_000 && missed > 100, "{found} {missed}");
}

/// A run with steps of 1/4 on which functions of time are watched.
fn clock(events: Events<Plane>) -> Run<Hand<HenonHeiles, 2>, StormerVerlet, Events<Plane>> {
    let start = State::new([0.1, -0.25], [0.42, 0.1]);
    let run = Integrator::new(&Hand(HenonHeiles), StormerVerlet::default(), start, 0.25);
    run.expect("a good start").observe(events)
}

fn at(name: &str, function: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Event<Plane> {
    Event::of(name, move |state: &State<Plane>| function(state.t))
}

/// The index, the direction and the time of each event.
fn all(events: &Events<Plane>) -> Vec<(usize, bool, f64)> {
    let located = events.located().iter();
    let times = located.map(|found| (found.event, found.rising, found.state.t));
    times.collect()
}

fn assert_all(events: &Events<Plane>, expected: &[(usize, bool, f64)]) {
    let mut found = all(events);
    assert!(
        found.windows(2).all(|pair| pair[0].2 <= pair[1].2),
        "{found:?}"
    );
    // By event: roots of two of them may differ by rounding.
    found.sort_by_key(|found| found.0);
    let mut expected = expected.to_vec();
    expected.sort_by_key(|expected| expected.0);
    let near = |(a, b): (&(usize, bool, f64), &(usize, bool, f64))| {
        (a.0, a.1) == (b.0, b.1) && (a.2 - b.2).abs() < 1e-12
    };
    let agree = found.len() == expected.len() && found.iter().zip(&expected).all(near);
    assert!(agree, "{found:?}\n{expected:?}");
}

#[test]
fn successive_zeros_poles_on_steps_and_jumps_are_told_apart() {
    let mut run = clock(Events::new([
        at("two zeros", |t| (t - 0.25) * (t - 0.5)),
        at("pole", |t| 1.0 / (t - 0.5)),
        at("three roots", |t| (t - 0.25) * (t - 0.3) * (t - 0.5)),
        at("from the start", |t| t * (t - 0.1) * (t - 0.25)),
        at("zero", |_| 0.0),
        at("sign", |t| if t == 0.5 { 0.0 } else { (t - 0.5).signum() }),
        at("sign between", |t| (t - 0.6).signum()),
        at("small, then large", |t| if t < 0.6 { -1e-3 } else { 1.0 }),
        at("poles on both sides", |t| {
            (t - 0.6) / ((t - 0.5) * (t - 0.75))
        }),
        at("plateau", |t| {
            if t > 0.9 { t - 0.9 } else { (t - 0.4).min(0.0) }
        }),
        at("touches", |t| (t - 0.25).powi(2) * (t - 0.5).powi(2)),
        at("cubes", |t| ((t - 0.25) * (t - 0.5)).powi(3)),
        at("cube root", |t| (t - 0.5).cbrt()),
        at("one zero", |t| (t - 0.25) * (t - 0.3)),
        at("undefined", |t| (t - 0.5) * (t - 0.6) / (t - 0.5)),
    ]));
    run.advance(8).expect("finite");
    let expected = [
        (0, false, 0.25),
        (0, true, 0.5),
        (2, true, 0.25),
        (2, false, 0.3),
        (2, true, 0.5),
        (3, false, 0.1),
        (3, true, 0.25),
        (8, false, 0.6),
        (9, true, 0.75),
        (11, false, 0.25),
        (11, true, 0.5),
        (12, true, 0.5),
        (13, false, 0.25),
        (13, true, 0.3),
        (14, true, 0.6),
    ];
    assert_all(run.observer(), &expected);
}

#[test]
fn a_run_that_ended_at_a_zero_on_a_step_goes_on_without_it() {
    let events = || {
        Events::new([
            at("a", |t| (t - 0.25) * (t - 0.5)).with_end_after(1),
            at("b", |t| (t - 0.25) * (t - 0.3) * (t - 0.5)),
            at("c", |t| (t - 0.25) * (t - 0.5))
                .with_direction(-1)
                .with_end_after(1),
        ])
    };
    let expected = [
        (0, false, 0.25),
        (1, true, 0.25),
        (2, false, 0.25),
        (1, false, 0.3),
        (0, true, 0.5),
        (1, true, 0.5),
    ];
    let mut whole = clock(events());
    whole.advance(8).expect("finite");
    assert_eq!(whole.time(), 0.25);
    for step in [0.25, 0.125, 0.1] {
        let mut run = clock(events());
        run.advance(8).expect("finite");
        assert_eq!((run.time(), run.has_ended()), (0.25, true));
        if step != 0.25 {
            run.change_step(step).expect("a good step");
        }
        for _ in 0..3 {
            run.go_on();
            run.advance(8).expect("finite");
        }
        assert_all(run.observer(), &expected);
    }
    // Saved at the zeros, and at the end.
    for made in 0..5 {
        let mut run = clock(events());
        run.advance(made).expect("finite");
        let saved = run.checkpoint();
        let again = Integrator::resume(&Hand(HenonHeiles), StormerVerlet::default(), saved);
        let mut again = again.expect("the same run").observe(events());
        for _ in 0..4 {
            again.go_on();
            again.advance(8).expect("finite");
        }
        assert_all(again.observer(), &expected);
    }
}

/// Derivative parts do not decide what is a root.
#[test]
fn zeros_on_steps_are_found_over_duals() {
    let number = |x: f64, by: f64| Dual::new(x, by);
    let start = State::over(
        [number(0.1, 1e9), number(-0.25, 0.0)],
        [number(0.42, -1e9), number(0.1, 1.0)],
    );
    let event = Event::of("f", |state: &State<SVector<Dual<f64>, 2>>| {
        let t = state.t - state.q[0] + Dual::fixed(state.q[0].re);
        (t - Dual::fixed(0.25)) * (t - Dual::fixed(0.5))
    });
    let step = Dual::fixed(0.25);
    let mut run = Integrator::new(&Hand(HenonHeiles), StormerVerlet::default(), start, step)
        .expect("a good start")
        .observe(Events::new([event]));
    run.advance(4).expect("finite");
    let times: Vec<f64> = run
        .observer()
        .located()
        .iter()
        .map(|found| found.state.t.re)
        .collect();
    assert_eq!(times, [0.25, 0.5]);
}

/// Products of differences from values that the orbit itself has after steps, so that they are exactly 0 there, and from
/// values between. Their roots are those of the factors.
#[test]
fn roots_of_products_are_those_of_their_factors() {
    type Schemes = (StormerVerlet, BlanesMoan4, ImplicitMidpoint);
    let (verlet, moan, midpoint) = Schemes::default();
    let mut count = 0;
    for seed in 0..cases(300, 3_000) {
        let mut random = Random(1_000_000 + seed);
        let h = random.between(0.05, 0.2) * if seed.is_multiple_of(2) { 1.0 } else { -1.0 };
        count += match seed % 3 {
            0 => product_of_differences(verlet, h, &mut random),
            1 => product_of_differences(moan, h, &mut random),
            _ => product_of_differences(midpoint, h, &mut random),
        };
    }
    assert!(count > 900, "{count}");
}

/// The number of roots of one product, which is compared with its factors.
fn product_of_differences<M: Scheme<Hand<HenonHeiles, 2>>>(
    scheme: M,
    h: f64,
    random: &mut Random,
) -> usize {
    let mut number = || random.between(-0.3, 0.3);
    let start = State::new([number(), number()], [number(), number()]);
    let steps = 40;
    let new = || Integrator::new(&Hand(HenonHeiles), scheme.clone(), start.clone(), h);
    let mut plain = new().expect("a good start");
    let mut values = vec![start.q[0]];
    for _ in 0..steps {
        values.push(plain.advance(1).expect("finite").q[0]);
    }
    // Two values after successive steps, one after another step, one between steps.
    let k = 1 + random.below(steps - 2) as usize;
    let other = random.below(steps) as usize;
    let part = random.between(0.1, 0.9);
    let between = random.below(steps) as usize;
    let between = values[between] + part * (values[between + 1] - values[between]);
    let mut levels = vec![values[k], values[k + 1], values[other], between];
    levels.truncate(2 + random.below(3) as usize);
    let locate = |levels: Vec<f64>| {
        let event = Event::of("f", move |state: &State<Plane>| {
            levels.iter().map(|level| state.q[0] - level).product()
        });
        let mut run = new().expect("a good start").observe(Events::new([event]));
        run.advance(steps).expect("finite");
        let located = run.observer().located().iter();
        located.map(|found| found.state.t / h).collect::<Vec<f64>>()
    };
    let mut expected: Vec<f64> = levels
        .iter()
        .flat_map(|level| locate(vec![*level]))
        .collect();
    expected.sort_by(f64::total_cmp);
    // Two roots inside a step without a zero at its ends, roots next to each other, and turning points are beyond what
    // is promised.
    let on_step = |t: f64| (t - t.round()).abs() < 1e-9;
    let is_close = |pair: &[f64]| pair[1] - pair[0] < 0.02;
    let is_between =
        |pair: &[f64]| pair[0].floor() == pair[1].floor() && !on_step(pair[0]) && !on_step(pair[1]);
    if expected
        .windows(2)
        .any(|pair| is_close(pair) || is_between(pair))
    {
        return 0;
    }
    let found = locate(levels.clone());
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6;
    assert!(
        found.len() == expected.len() && found.iter().zip(&expected).all(near),
        "{levels:?}, step {h}\n{found:?}\n{expected:?}"
    );
    found.len()
}

/// A run that an event ends goes on, is saved and resumed anywhere, and finds the roots of a run that does not.
#[test]
fn ended_and_saved_runs_find_the_same_roots() {
    let (mut ended, mut on_steps) = (0, 0);
    for seed in 0..cases(400, 20_000) {
        let mut random = Random(2_000_000 + seed);
        let steps = 3 + random.below(8) as u32;
        let size = [0.25, 0.1, 1.0 / 3.0][seed as usize % 3];
        let step = if random.below(2) == 0 { size } else { -size };
        let product = Product::random(&mut random, steps, |k| k * step);
        // After an end, roots in the rest of the same step are located in the next one.
        let steps = steps + 1;
        let expected = product.roots(f64::from(steps) * step);
        let ends_after = 1 + random.below(3);
        let is_restarted = random.below(2) == 0;
        let events = || {
            let product = product.clone();
            let event = Event::of("f", move |state: &State<Plane>| product.value(state.t));
            Events::new([event.with_end_after(ends_after)])
        };
        let start = State::new([0.1, -0.25], [0.42, 0.1]);
        let (system, scheme) = (Hand(HenonHeiles), StormerVerlet::default());
        let run = Integrator::new(&system, scheme, start, step).expect("a good start");
        let mut run = run.observe(events());
        let mut ends = Vec::new();
        loop {
            let left = u64::from(steps) - run.steps();
            if left == 0 && !run.has_ended() {
                break;
            }
            run.advance(1 + random.below(left.max(1))).expect("finite");
            if run.has_ended() {
                ends.push(run.time());
                run.go_on();
            }
            if is_restarted {
                let saved = run.checkpoint();
                let again = Integrator::resume(&system, scheme, saved).expect("the same run");
                run = again.observe(events());
            }
        }
        let located = run.observer().located().iter();
        let located: Vec<_> = located.map(|found| (found.state.t, found.rising)).collect();
        let place =
            format!("seed {seed}, step {step}: {product:?}\n{located:?}\n{expected:?}\n{ends:?}");
        assert!(agree(&located, &expected), "{place}");
        let end = expected.get(ends_after as usize - 1);
        assert!(ends.len() == usize::from(end.is_some()), "{place}");
        if let (Some((t, _)), Some(found)) = (end, ends.first()) {
            assert!((t - found).abs() < 1e-9, "{place}");
            ended += 1;
            on_steps += usize::from((t / step - (t / step).round()).abs() < 1e-9);
        }
    }
    assert!(ended > 150 && on_steps > 80, "{ended} {on_steps}");
}

/// Multiples of a period, many of them after steps, of functions that grow and of functions that jump back.
#[test]
fn multiples_of_periods_are_found_on_steps_and_between() {
    let (mut found, mut on_steps, mut missed) = (0, 0, 0);
    for seed in 0..cases(400, 20_000) {
        let mut random = Random(3_000_000 + seed);
        let step = if random.below(2) == 0 { 0.25 } else { -0.25 };
        // All values after steps are exact. In a step the function changes by less than half a period.
        let slope =
            (1 + random.below(15)) as f64 / 4.0 * if random.below(2) == 0 { 1.0 } else { -1.0 };
        let period = 2.0 + random.below(5) as f64 / 4.0;
        let offset = match random.below(2) {
            0 => random.below(16) as f64 / 16.0,
            _ => random.between(0.0, period),
        };
        let is_wrapped = random.below(2) == 0;
        let function = move |t: f64| {
            let value = slope * t - offset;
            match is_wrapped {
                true => value - period * (value / period).round(),
                false => value,
            }
        };
        let direction = random.below(3);
        let event = move || {
            let event =
                Event::of("f", move |state: &State<Plane>| function(state.t)).with_period(period);
            match direction {
                1 => event.with_direction(1),
                2 => event.with_direction(-1),
                _ => event,
            }
        };
        let rises = slope * step > 0.0;
        let steps = 24;
        let last = f64::from(steps) * step;
        let mut expected: Vec<(f64, bool)> = (-40..=40)
            .map(|k| ((offset + period * f64::from(k)) / slope, rises))
            .filter(|(t, _)| t * step > 0.0 && t.abs() < last.abs())
            .filter(|_| direction == 0 || rises == (direction == 1))
            .collect();
        expected.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let start = State::new([0.1, -0.25], [0.42, 0.1]);
        let run = Integrator::new(&Hand(HenonHeiles), StormerVerlet::default(), start, step);
        let mut run = run.expect("a good start").observe(Events::new([event()]));
        run.advance(steps as u64).expect("finite");
        let located = run.observer().located().iter();
        let located: Vec<_> = located.map(|found| (found.state.t, found.rising)).collect();
        assert!(
            agree(&located, &expected),
            "seed {seed}: {slope}*t - {offset}, modulo {period}, step {step}, {is_wrapped}\n{located:?}\n{expected:?}"
        );
        found += expected.len();
        on_steps += expected
            .iter()
            .filter(|(t, _)| (t / step).fract() == 0.0)
            .count();
        // Control: signs of the function as it is.
        let signs: Vec<bool> = (0..=steps)
            .map(|k| function(f64::from(k) * step) > 0.0)
            .collect();
        let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        missed += usize::from(changes != expected.len());
    }
    assert!(
        found > 900 && on_steps > 60 && missed > 100,
        "{found} {on_steps} {missed}"
    );
}
