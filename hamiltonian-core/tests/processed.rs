//! Processed splittings: the kernel alone, three pieces, observers, steps of different sizes, long runs.

use crate::common::pieces::Polar;
use crate::common::systems::*;
use crate::common::{difference, start};
use crate::composition::{is, slope};
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::{
    BlanesCasasMurua8, CheapProcessed4, Composition, Processed, Processed4, Processed6,
    WisdomHolman17,
};
use hamiltonian_core::schemes::{
    author::{Durations, Splitting, Weight},
    inside::{Kernel4, Kernel6},
};
use hamiltonian_core::{
    DoubleDouble, Exact, Real, Scheme, Split,
    schemes::author::{Entry, Group, Listed, OneStep},
};

/// A processor that does nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Idle;

impl Listed for Idle {
    fn entry(&self) -> Entry {
        Processed6::default().entry()
    }
}

impl Splitting for Idle {
    type Of<U> = [U; 1];
    fn stages(&self) -> [Durations; 1] {
        [(Weight(0.0, 0.0), Weight(0.0, 0.0))]
    }
    fn filled<U: Clone>(&self, value: U) -> [U; 1] {
        [value]
    }
}

#[test]
fn a_kernel_alone_has_order_2() {
    fn alone<K: Splitting>(kernel: K) -> f64 {
        let processor = Idle;
        slope(
            &Hand(Pumped),
            Processed::new(kernel, processor),
            &[0.9],
            &[0.4],
        )
    }
    is(2.0, alone(Kernel4));
    is(2.0, alone(Kernel6));
}

#[test]
fn three_pieces_have_the_order_of_two() {
    let (q, p) = (&[0.4, 0.7][..], &[0.2, 0.15][..]);
    is(4.0, slope(&Hand(Polar::<3>), Processed4::default(), q, p));
    is(4.0, slope(&Hand(Polar::<4>), Processed4::default(), q, p));
    is(6.0, slope(&Hand(Polar::<3>), Processed6::default(), q, p));
    is(6.0, slope(&Hand(Polar::<4>), Processed6::default(), q, p));
}

/// A run carries the kernel's point, so its bits do not depend on the observers.
#[test]
fn observers_change_no_bit() {
    let system = Hand(Pumped);
    let begin = start(&system, &[0.9], &[0.4]);
    let new = || Integrator::new(&system, Processed6::default(), begin.clone(), 0.1).unwrap();
    let mut unseen = new();
    let mut seen: Vec<f64> = Vec::new();
    let mut watched = new().watch(1, |view| seen.push(view.state.q[0]));
    for _ in 0..30 {
        watched.advance(1).unwrap();
    }
    unseen.advance(30).unwrap();
    assert_eq!(unseen.carried(), watched.carried());
    assert_eq!(unseen.state(), watched.state());
    // The processor is no identity, and is undone at the start.
    assert!((unseen.carried().q[0] - unseen.state().q[0]).abs() > 1e-9);
    drop(watched);
    assert_eq!(seen[0], 0.9);
}

/// Three and four pieces, and pieces that depend on time.
#[test]
fn a_cheap_post_processor_is_off_by_its_order_and_no_bit_is_carried() {
    fn holds<S: Split + Exact>(system: &S, q: &[f64], p: &[f64]) {
        let begin = start::<DoubleDouble, S>(system, q, p);
        let off = |n: u64| {
            let h = DoubleDouble::one() / DoubleDouble::from(n as f64);
            let mut cheap =
                Integrator::new(system, CheapProcessed4::default(), begin.clone(), h).unwrap();
            let mut processed =
                Integrator::new(system, Processed4::default(), begin.clone(), h).unwrap();
            cheap.advance(n).unwrap();
            processed.advance(n).unwrap();
            assert_eq!(cheap.carried(), processed.carried());
            difference(cheap.state(), processed.state())
        };
        // Over seven halvings of the step: the terms h⁵ and h⁶ cancel somewhere between.
        let order = (off(64) / off(8192)).log2() / 7.0;
        assert!((4.95..6.0).contains(&order), "{order}");
        is(4.0, slope(system, CheapProcessed4::default(), q, p));
        // ρ alone is no processor: the control.
        let alone = Processed::new(Kernel4, *CheapProcessed4::default().mean_of());
        is(3.0, slope(system, alone, q, p));
    }
    holds(&Hand(Polar::<3>), &[0.4, 0.7], &[0.2, 0.15]);
    holds(&Hand(Polar::<4>), &[0.4, 0.7], &[0.2, 0.15]);
    holds(&Hand(Pumped), &[0.9], &[0.4]);
}

/// V = r²/4 with r = x² + y², or r = (x − y)².
#[derive(Debug, Clone)]
struct Quartic {
    pair: bool,
}

impl Formula<2> for Quartic {
    const NAME: &'static str = "Quartic";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p_x", 0), Group::scalar("y", "p_y", 1)];
    fn energy<T: Real>(&self, _: T, [x, y]: &[T; 2], [px, py]: &[T; 2]) -> T {
        let apart = *x - *y;
        let r = match self.pair {
            true => apart * apart,
            false => *x * *x + *y * *y,
        };
        number::<T>(0.5) * (*px * *px + *py * *py) + number::<T>(0.25) * r * r
    }
    fn gradient<T: Real>(&self, t: T, q: &[T; 2], p: &[T; 2]) -> ([T; 2], [T; 2]) {
        (self.force(t, q), self.velocity(t, p))
    }
}

impl Halves<2> for Quartic {
    fn force<T: Real>(&self, _: T, [x, y]: &[T; 2]) -> [T; 2] {
        let apart = *x - *y;
        let (cube, r) = (apart * apart * apart, *x * *x + *y * *y);
        match self.pair {
            true => [cube, -cube],
            false => [r * *x, r * *y],
        }
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 2]) -> [T; 2] {
        *p
    }
}

/// Compositions of flows preserve both; the mean of two points preserves linear functions alone.
#[test]
fn means_preserve_linear_invariants_and_no_quadratic_ones() {
    fn change<S: Scheme<Hand<Quartic, 2>>>(scheme: S, pair: bool, h: f64) -> f64 {
        let system = Hand(Quartic { pair });
        let value = |state: &State<SVector<f64, 2>>| {
            let ([x, y], [px, py]) = ([state.q[0], state.q[1]], [state.p[0], state.p[1]]);
            if pair { px + py } else { x * py - y * px }
        };
        let begin = start(&system, &[1.1, 0.3], &[-0.2, 0.7]);
        let (first, mut most) = (value(&begin), 0.0_f64);
        let mut run = Integrator::new(&system, scheme, begin, h).unwrap();
        for _ in 0..200 {
            most = most.max((value(run.advance(1).unwrap()) - first).abs());
        }
        most
    }
    let (cheap, processed) = (CheapProcessed4::default(), Processed4::default());
    let [far, middle, near] = [0.2, 0.1, 0.05].map(|h| change(cheap, false, h));
    println!("{far:e} {middle:e} {near:e}");
    is(6.0, (far / middle).log2());
    is(6.0, (middle / near).log2());
    assert!(change(processed, false, 0.2) <= 1e-14);
    assert!(change(cheap, true, 0.2) <= 1e-14);
}

/// Processors of different steps do not cancel: each stage closes and the next one opens.
#[test]
fn steps_of_different_sizes_follow_each_other() {
    let system = Hand(Pumped);
    let begin = start(&system, &[0.9], &[0.4]);
    let (first, second) = (0.0625, 0.1875);
    let weights = [0.25, 0.75].map(|weight| Weight(weight, 0.0));
    let both = Composition::new(Processed4::default(), weights, 4, "two sizes");
    let mut run = Integrator::new(&system, both, begin.clone(), first + second).unwrap();
    let mut apart = begin.clone();
    for _ in 0..3 {
        for h in [first, second] {
            let mut part = Integrator::new(&system, Processed4::default(), apart, h).unwrap();
            apart = part.advance(1).unwrap().clone();
        }
    }
    let off = difference(run.advance(3).unwrap(), &apart);
    assert!(off <= 1e-14, "{off:e}");
    // Steps of one size are joined: two halves of a composition are two steps.
    let halves = [Weight(0.5, 0.0); 2];
    let both = Composition::new(Processed4::default(), halves, 4, "halves");
    let mut run = Integrator::new(&system, both, begin.clone(), 0.25).unwrap();
    let mut plain = Integrator::new(&system, Processed4::default(), begin, 0.125).unwrap();
    let off = difference(run.advance(5).unwrap(), plain.advance(10).unwrap());
    assert!(off <= 1e-14, "{off:e}");
}

/// The adjoint of the adjoint is the scheme, with other types.
#[test]
fn adjoints_of_adjoints_are_the_scheme() {
    let scheme = Processed6::default();
    let twice = scheme.adjoint().adjoint();
    assert_eq!(scheme.kernel().stages(), twice.kernel().stages());
    assert_eq!(scheme.processor().stages(), twice.processor().stages());
    assert_ne!(
        scheme.processor().stages(),
        scheme.adjoint().processor().stages()
    );
}

/// max |H/H(0) − 1| of each tenth of a run of 10⁷ steps stays that of the first.
#[test]
fn energy_does_not_drift() {
    if std::env::var_os("HAMILTONIAN_HEAVY").is_none_or(|value| value != "1") {
        return;
    }
    fn tenths(scheme: impl Scheme<Hand<HenonHeiles, 2>>, h: f64) {
        const TENTH: u64 = 1_000_000;
        let system = Hand(HenonHeiles);
        let begin = start(&system, &[0.12, 0.23], &[0.31, -0.17]);
        let name = scheme.entry().name;
        let mut run = Integrator::new(&system, scheme, begin, h).unwrap();
        let energy = run.energy();
        let mut largest = Vec::new();
        for _ in 0..10 {
            let mut most = 0.0_f64;
            for _ in 0..TENTH / 100 {
                run.advance(100).unwrap();
                most = most.max((run.energy() / energy - 1.0).abs());
            }
            largest.push(most);
        }
        println!("{name}: {largest:?}");
        for most in &largest {
            assert!(
                (most / largest[0] - 1.0).abs() <= 0.02,
                "{name}: {largest:?}"
            );
        }
    }
    tenths(Processed4::default(), 0.5);
    tenths(Processed6::default(), 1.2);
    tenths(CheapProcessed4::default(), 0.5);
    tenths(BlanesCasasMurua8::default(), 1.2);
    tenths(WisdomHolman17::default(), 0.25);
}
