//! Solutions to compare with, by methods that share nothing with the library's schemes.

use hamiltonian::VectorOf;
use hamiltonian::{DoubleDouble, Real, State, System, Vector, schemes::author::Dynamics};

/// The local error a step of [`solution`] is accepted with, estimated two orders below its own:
/// with the rounding of double-doubles (2.5e-32) amplified by the extrapolation (some 10³), what a
/// solution has lost after a few hundred steps stays below 1e-24 times its condition number.
const TOLERANCE: f64 = 1e-26;

/// z(t) in double-doubles by extrapolation of the modified midpoint rule (Gragg 1965, Bulirsch and
/// Stoer 1966) with the sequence 2, 4, …, 2·ROWS, over steps of the size the error asks for.
///
/// E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.9.
pub fn solution<S: System>(
    system: &S,
    start: &State<VectorOf<S, DoubleDouble>>,
    t: DoubleDouble,
) -> State<VectorOf<S, DoubleDouble>> {
    const ROWS: usize = 10;
    let prepared = system.prepare();
    let mut state = start.clone();
    let mut size = (t - start.t).to_f64() / 8.0;
    loop {
        let left = t - state.t;
        let is_last = size.abs() >= left.to_f64().abs();
        let big = if is_last {
            left
        } else {
            DoubleDouble::from(size)
        };
        // Neville's scheme in (H/n)².
        let mut rows: Vec<State<VectorOf<S, DoubleDouble>>> = Vec::new();
        let mut error = f64::INFINITY;
        for row in 0..ROWS {
            let n = 2 * (row + 1);
            let mut new = midpoint(&prepared, &state, big, n);
            let mut next_rows = Vec::new();
            for (column, old) in rows.iter().enumerate() {
                let ratio =
                    DoubleDouble::from(n as f64) / DoubleDouble::from(2.0 * (row - column) as f64);
                let factor = DoubleDouble::one() / (ratio * ratio - DoubleDouble::one());
                let mut next = new.clone();
                for (next, new, old) in
                    [(&mut next.q, &new.q, &old.q), (&mut next.p, &new.p, &old.p)]
                {
                    next.accumulate(factor, new);
                    next.accumulate(-factor, old);
                }
                error = difference(&next, &new);
                next_rows.push(new);
                new = next;
            }
            next_rows.push(new);
            rows = next_rows;
        }
        let factor = 0.8 * (TOLERANCE / error).powf(1.0 / (2 * ROWS - 1) as f64);
        let is_accepted = error <= TOLERANCE;
        if is_accepted {
            let last = rows.pop().expect("there is a row");
            state = State {
                t: state.t + big,
                ..last
            };
            if is_last {
                state.t = t;
                return state;
            }
        }
        assert!(
            factor > 0.0,
            "{}: no step is small enough at {}",
            system.description().name,
            state.t
        );
        size = big.to_f64() * factor.clamp(0.1, 4.0);
    }
}

/// One modified midpoint integration over `big` in `n` steps, without smoothing.
fn midpoint<D: Dynamics<DoubleDouble>>(
    prepared: &D,
    start: &State<D::Vector>,
    big: DoubleDouble,
    n: usize,
) -> State<D::Vector> {
    let h = big / DoubleDouble::from(n as f64);
    let (mut dq, mut dp) = (start.q.zeros_like(), start.q.zeros_like());
    let (mut before, mut now) = (start.clone(), start.clone());
    prepared.gradient(start.t, &start.q, &start.p, &mut dq, &mut dp);
    now.q.accumulate(h, &dp);
    now.p.accumulate(-h, &dq);
    for k in 1..n {
        let t = DoubleDouble::from(k as f64).fma(h, start.t);
        prepared.gradient(t, &now.q, &now.p, &mut dq, &mut dp);
        before.q.accumulate(h + h, &dp);
        before.p.accumulate(-(h + h), &dq);
        std::mem::swap(&mut before, &mut now);
    }
    now
}

/// The largest difference of any component.
pub fn difference<V: Vector>(a: &State<V>, b: &State<V>) -> f64 {
    a.q.distance(&b.q).max(a.p.distance(&b.p))
}

/// sn, cn and dn of (u | m), 0 ≤ m < 1, by descending Landen transformations.
///
/// M. Abramowitz, I. Stegun, Handbook of Mathematical Functions (1964), 16.4.
pub fn jacobi<T: Real>(u: T, m: T) -> [T; 3] {
    let means = means(m);
    let (last, rest) = means.split_last().expect("there is a mean");
    let scale = T::constant(f64::from(1u32 << rest.len()), 0.0);
    let mut angle = scale * last[0] * u;
    for [a, c] in means[1..].iter().rev() {
        angle = T::constant(0.5, 0.0) * (angle + (*c / *a * angle.sin()).asin());
    }
    let (sn, cn) = angle.sin_cos();
    [sn, cn, (T::one() - m * sn * sn).sqrt()]
}

/// K(m), the complete elliptic integral of the first kind: π/2 over the arithmetic-geometric mean.
pub fn quarter_period<T: Real>(m: T) -> T {
    let means = means(m);
    let last = means.last().expect("there is a mean")[0];
    let pi = T::constant(std::f64::consts::PI, hamiltonian_symbolic::PI_LOW);
    pi / (last + last)
}

/// Pairs (aₙ, cₙ) of the arithmetic-geometric mean from (1, √(1 − m)).
fn means<T: Real>(m: T) -> Vec<[T; 2]> {
    let half = T::constant(0.5, 0.0);
    let (mut a, mut b, mut c) = (T::one(), (T::one() - m).sqrt(), m.sqrt());
    let mut means = vec![[a, c]];
    while c.magnitude() > T::epsilon() {
        (a, b, c) = (half * (a + b), (a * b).sqrt(), half * (a - b));
        means.push([a, c]);
    }
    means
}
