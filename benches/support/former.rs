//! Gauss' method as it was before stages had lanes: stage by stage, sums from the first stage on, iterated
//! until the change no longer shrinks. A measure for the schemes of today in the same process.

use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::schemes::collocation::Collocation;
use hamiltonian::{
    DoubleDouble, Vector,
    schemes::author::{Dynamics, Point, VectorField},
};
use std::array::from_fn;

/// A change that no longer shrinks is rounding if it is at most this many ε of the numbers added.
const ROUNDING: f64 = 1024.0;
const LIMIT: usize = 100;

/// The matrix that extrapolates the slopes of a step to the next: the terms of their polynomial below
/// degree 8.
fn extrapolation<const S: usize>(method: &Collocation<S>) -> [[f64; S]; S] {
    let legendre = |x: f64| -> [f64; 8] {
        let mut all = [1.0, x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        for k in 2..8 {
            all[k] = ((2 * k - 1) as f64 * x * all[k - 1] - (k - 1) as f64 * all[k - 2]) / k as f64;
        }
        all
    };
    let nodes = method.nodes.map(|c| 2.0 * c.hi() - 1.0);
    from_fn(|i| {
        from_fn(|j| {
            let (here, there) = (legendre(nodes[i] + 2.0), legendre(nodes[j]));
            let terms = (0..S.min(8)).map(|k| (2 * k + 1) as f64 * here[k] * there[k]);
            method.weights[j].hi() * terms.sum::<f64>()
        })
    })
}

/// Adds the low words to the point and keeps what rounding takes.
fn carry<V: Vector<Scalar = f64>>(point: &mut V, low: &mut V) {
    for k in 0..V::PARTS {
        for (z, low) in point.part_mut(k).iter_mut().zip(low.part_mut(k)) {
            let (before, sum) = (*z, *z + *low);
            let rest = sum - before;
            *low = (before - (sum - rest)) + (*low - rest);
            *z = sum;
        }
    }
}

/// Iterates until the change is 0 or does not shrink any more.
fn iterate<V: Vector<Scalar = f64>, const S: usize>(
    slopes: &mut [V; S],
    next: &mut [V; S],
    mut map: impl FnMut(&[V; S], &mut [V; S]),
    scale: impl Fn(&[V; S]) -> f64,
) {
    let mut before = f64::INFINITY;
    for _ in 0..LIMIT {
        map(slopes, next);
        let mut change = 0.0;
        for (to, from) in slopes.iter_mut().zip(next.iter()) {
            change += from.size_of_difference(to);
            to.copy_from(from);
        }
        let stalls = before <= change && before < f64::INFINITY;
        if change == 0.0 || (stalls && change < ROUNDING * f64::EPSILON * scale(slopes)) {
            return;
        }
        before = change;
    }
    panic!("the iteration does not converge");
}

/// `n` steps of `Gauss::<S>`.
pub fn gauss<Y: System, const S: usize>(
    system: &Y,
    start: &State<VectorOf<Y>>,
    h: f64,
    n: u64,
) -> State<VectorOf<Y>> {
    let method = Collocation::<S>::gauss();
    let (mu, guess) = (method.symplectic::<f64>(), extrapolation(&method));
    let (weights, times) = (
        method.weights.map(|b| b.hi() * h),
        method.nodes.map(|c| c.hi() * h),
    );
    let field = system.prepare().field(1.0);
    let mut point = start.point();
    let zero = point.zeros_like();
    let mut stage = zero.clone();
    let mut low = zero.clone();
    let mut slopes: [_; S] = from_fn(|_| zero.clone());
    let mut guesses = slopes.clone();
    let mut increments = slopes.clone();
    let mut next = slopes.clone();
    for k in 0..n {
        let t = start.t + k as f64 * h;
        for (to, row) in guesses.iter_mut().zip(&guess) {
            to.set_zero();
            for (factor, slope) in row.iter().zip(&slopes) {
                to.accumulate(*factor, slope);
            }
        }
        for (to, from) in slopes.iter_mut().zip(&guesses) {
            to.copy_from(from);
        }
        let size = S as f64 * point.size() / h.abs();
        let map = |slopes: &[_; S], next: &mut [Point<VectorOf<Y>>; S]| {
            for j in 0..S {
                increments[j].copy_from(&slopes[j]);
                increments[j].scale(weights[j]);
            }
            for i in 0..S {
                stage.set_zero();
                for j in 0..S {
                    stage.accumulate(mu[i][j], &increments[j]);
                }
                stage.accumulate(1.0, &point);
                let to = &mut next[i];
                to.set_zero();
                field.add(t + times[i], &stage.q, &stage.p, &mut to.q, &mut to.p);
            }
        };
        let scale =
            |slopes: &[Point<VectorOf<Y>>; S]| size + slopes.iter().map(Vector::size).sum::<f64>();
        iterate(&mut slopes, &mut next, map, scale);
        for (weight, slope) in weights.iter().zip(&slopes) {
            low.accumulate(*weight, slope);
        }
        carry(&mut point, &mut low);
    }
    State {
        t: start.t + n as f64 * h,
        q: point.q,
        p: point.p,
    }
}

/// `n` steps of `GaussNystrom::<S>`.
pub fn gauss_nystrom<Y: System, const S: usize>(
    system: &Y,
    start: &State<VectorOf<Y>>,
    h: f64,
    n: u64,
) -> State<VectorOf<Y>> {
    let method = Collocation::<S>::gauss();
    let guess = extrapolation(&method);
    let (b, c) = (method.weights.map(|b| b.hi()), method.nodes.map(|c| c.hi()));
    let double: [[f64; S]; S] = from_fn(|i| {
        from_fn(|j| {
            let terms = (0..S).map(|k| method.a(i, k) * method.a(k, j));
            h * terms
                .fold(DoubleDouble::from(0.0), |sum, term| sum + term)
                .hi()
        })
    });
    let prepared = system.prepare();
    let mut point = start.point();
    let zero = point.q.zeros_like();
    let (mut stage, mut impulse, mut moved) = (zero.clone(), zero.clone(), zero.clone());
    let mut velocity = zero.clone();
    let mut low = point.zeros_like();
    let mut forces: [_; S] = from_fn(|_| zero.clone());
    let mut guesses = forces.clone();
    let mut next = forces.clone();
    for k in 0..n {
        let t = start.t + k as f64 * h;
        for (to, row) in guesses.iter_mut().zip(&guess) {
            to.set_zero();
            for (factor, force) in row.iter().zip(&forces) {
                to.accumulate(*factor, force);
            }
        }
        for (to, from) in forces.iter_mut().zip(&guesses) {
            to.copy_from(from);
        }
        prepared.gradient_p(t, &point.q, &point.p, &mut velocity);
        let size = S as f64 * (point.q.size() / (h * h) + point.p.size() / h.abs());
        let map = |forces: &[VectorOf<Y>; S], next: &mut [VectorOf<Y>; S]| {
            for i in 0..S {
                let t = t + c[i] * h;
                impulse.set_zero();
                for j in 0..S {
                    impulse.accumulate(double[i][j], &forces[j]);
                }
                prepared.gradient_p(t, &point.q, &impulse, &mut moved);
                stage.set_zero();
                stage.accumulate(h, &moved);
                stage.accumulate(c[i] * h, &velocity);
                stage.accumulate(1.0, &point.q);
                prepared.gradient_q(t, &stage, &point.p, &mut next[i]);
                next[i].scale(-1.0);
            }
        };
        let scale = |forces: &[VectorOf<Y>; S]| size + forces.iter().map(Vector::size).sum::<f64>();
        iterate(&mut forces, &mut next, map, scale);
        impulse.set_zero();
        for j in 0..S {
            impulse.accumulate(b[j] * (1.0 - c[j]) * h, &forces[j]);
            low.p.accumulate(b[j] * h, &forces[j]);
        }
        prepared.gradient_p(t, &point.q, &impulse, &mut moved);
        low.q.accumulate(h, &moved);
        low.q.accumulate(h, &velocity);
        carry(&mut point, &mut low);
    }
    State {
        t: start.t + n as f64 * h,
        q: point.q,
        p: point.p,
    }
}
