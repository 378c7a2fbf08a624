//! Solutions to compare with, by a method that shares nothing with the library's schemes.

use hamiltonian_core::{Dynamics, Real, State, System, Vector};

/// z(t) by extrapolation of the modified midpoint rule (Gragg 1965, Bulirsch and Stoer 1966) with
/// sequences 2, 4, …, 2·ROWS: order 2·ROWS, over steps of at most 1/64.
///
/// E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.9.
pub fn solution<T: Real, S: System<T>>(
    system: &S,
    start: &State<S::Vector>,
    t: T,
) -> State<S::Vector> {
    const ROWS: usize = 8;
    let steps = (((t - start.t).to_f64()).abs() * 64.0).ceil().max(1.0);
    let big = (t - start.t) / T::constant(steps, 0.0);
    let prepared = system.prepare();
    let mut state = start.clone();
    for k in 0..steps as u64 {
        state.t = T::constant(k as f64, 0.0).fma(big, start.t);
        let mut rows: Vec<State<S::Vector>> = Vec::new();
        for row in 0..ROWS {
            let n = 2 * (row + 1);
            let mut new = midpoint(&prepared, &state, big, n);
            // Neville's scheme in (H/n)².
            let mut previous = Vec::new();
            for (column, old) in rows.iter().enumerate() {
                let ratio =
                    T::constant(n as f64, 0.0) / T::constant((2 * (row - column)) as f64, 0.0);
                let factor = T::one() / (ratio * ratio - T::one());
                let mut next = new.clone();
                for (next, new, old) in
                    [(&mut next.q, &new.q, &old.q), (&mut next.p, &new.p, &old.p)]
                {
                    next.accumulate(factor, new);
                    next.accumulate(-factor, old);
                }
                previous.push(new);
                new = next;
            }
            previous.push(new);
            rows = previous;
        }
        let last = rows.pop().expect("there is a row");
        state.q = last.q;
        state.p = last.p;
    }
    state.t = t;
    state
}

/// One modified midpoint integration over `big` in `n` steps, without smoothing.
fn midpoint<T: Real, D: Dynamics<T>>(
    prepared: &D,
    start: &State<D::Vector>,
    big: T,
    n: usize,
) -> State<D::Vector> {
    let h = big / T::constant(n as f64, 0.0);
    let (mut dq, mut dp) = (start.q.zeros_like(), start.q.zeros_like());
    let (mut before, mut now) = (start.clone(), start.clone());
    prepared.gradient(start.t, &start.q, &start.p, &mut dq, &mut dp);
    now.q.accumulate(h, &dp);
    now.p.accumulate(-h, &dq);
    for k in 1..n {
        let t = T::constant(k as f64, 0.0).fma(h, start.t);
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
