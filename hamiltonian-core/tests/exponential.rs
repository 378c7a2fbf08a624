//! Exponentials of quadratic forms: lanes by themselves, and the digits of short steps.

use crate::common::four::Four;
use hamiltonian_core::private::{Exponential, SVector, raised};
use hamiltonian_core::{
    Real,
    schemes::author::{Flow, Point},
};

/// The rates of h = ½p² + gqp + ½kq² + q.
#[derive(Debug, Clone)]
struct Rates<T>(T);

const G: f64 = 0.3;
const K: f64 = 1.7;

impl<T: Real> Flow<Point<SVector<T, 1>>> for Rates<T> {
    const NAME: &'static str = "h";
    type Work = ();
    fn apply(&self, _: T, x: &mut Point<SVector<T, 1>>, (): &mut ()) {
        let (q, p) = (x.q[0], x.p[0]);
        let (g, k) = (T::constant(G, 0.0), T::constant(K, 0.0));
        x.q[0] += self.0 * (p + g * q);
        x.p[0] -= self.0 * (k * q + g * p + T::one());
    }
}

fn exponential<T: Real>(c: T) -> Exponential<Rates<T>, T, 2> {
    let zero = SVector::from([T::zero()]);
    let rates = Rates(raised(c));
    Exponential::new(&rates, &Point { q: zero, p: zero })
}

/// The point that so many steps lead to from (1, ½).
fn turned<T: Real>(flow: &Exponential<Rates<T>, T, 2>, steps: u32) -> [T; 2] {
    let mut x = Point {
        q: SVector::from([T::one()]),
        p: SVector::from([T::constant(0.5, 0.0)]),
    };
    for _ in 0..steps {
        flow.apply(T::zero(), &mut x, &mut ());
    }
    [x.q[0], x.p[0]]
}

/// Lanes with steps, and so squarings, of their own.
#[test]
fn a_lane_is_exponentiated_alone() {
    let steps = [1e-3, 0.4, -20.0, f64::NAN];
    let lanes = turned(&exponential(Four(steps)), 3);
    for (k, c) in steps.into_iter().enumerate().take(3) {
        let alone = turned(&exponential(c), 3);
        assert_eq!(lanes.map(|x| x.0[k]), alone, "{c}");
    }
    assert!(lanes[0].0[3].is_nan());
}

/// Of a short step M's diagonal keeps its digits too: what they cut off would be lost once a step, always
/// to the same side.
#[test]
fn a_million_short_steps_keep_h() {
    let h = |[q, p]: [f64; 2]| 0.5 * p * p + G * q * p + 0.5 * K * q * q + q;
    for c in [7e-4, 1e-3, 1.3e-3] {
        let change = h(turned(&exponential(c), 1_000_000)) / h([1.0, 0.5]) - 1.0;
        assert!(change.abs() < 2e-12, "{c}: {change:e}");
    }
}
