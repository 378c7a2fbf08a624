//! Derivatives of a system against dual numbers, against its energy in plain Rust, and against
//! another definition of it.

use crate::symbolic::cases;
use hamiltonian::VectorOf;
use hamiltonian::{
    Dual, Real, State, System, Vector,
    schemes::author::{Dynamics, VectorField},
};

/// The lengths that systems with a length are checked at: the last is long enough for the lanes of all loops, and no
/// multiple of them.
pub const LENGTHS: [usize; 6] = [1, 2, 3, 7, 64, 131];

#[track_caller]
pub fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 2e-13 * (1.0 + a.abs()), "{a} is not {b}");
}

/// A repeatable list of numbers in (−¾, ¾), none of them small (SplitMix64).
pub fn numbers(seed: u64) -> impl Iterator<Item = f64> {
    (1u64..).map(move |k| {
        let z = (k + (seed << 32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let x = ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        x + 0.25 * x.signum()
    })
}

/// The vector of a system with these components.
fn vector<S: System>(system: &S, mut values: impl Iterator<Item = f64>) -> VectorOf<S> {
    let mut vector = system.zeros();
    for at in 0..vector.len() {
        *vector.component_mut(at) = values.next().expect("as many values as components");
    }
    vector
}

/// A state that [`numbers`] choose.
pub fn chosen<S: System>(system: &S, seed: u64) -> State<VectorOf<S>> {
    State {
        t: numbers(seed + 2).next().expect("there is no end"),
        q: vector(system, numbers(seed)),
        p: vector(system, numbers(seed + 1)),
    }
}

/// [`check_at`] a state that [`numbers`] choose.
pub fn check<S>(system: &S)
where
    S: System,
{
    check_at(system, &chosen(system, 1));
}

/// The largest number of directions, or with `HAMILTONIAN_HEAVY=1` more of them.
fn directions() -> usize {
    cases(24, 64)
}

/// The gradient, the derivative by time, the Hessian and the flow against duals.
pub fn check_at<S>(system: &S, state: &State<VectorOf<S>>)
where
    S: System,
{
    let gradient = System::gradient::<f64>(system, state);
    let n = state.q.len();
    let lifted = |from: &VectorOf<S>| {
        let mut to = System::zeros::<Dual<f64>>(system);
        for at in 0..n {
            *to.component_mut(at) = Dual::fixed(from.component(at));
        }
        to
    };
    let prepared = System::prepare::<f64>(system);
    let (t, q, p) = (state.t, &state.q, &state.p);
    // In some directions, whatever the size, and in one that all components have a part in.
    let stride = (2 * n).div_ceil(directions());
    let mut all = State {
        t: Dual::fixed(t),
        q: lifted(q),
        p: lifted(p),
    };
    let (mut expected, mut size) = (0.0, 0.0);
    for (at, (a, b)) in numbers(5).zip(numbers(6)).take(n).enumerate() {
        (all.q.component_mut(at).eps, all.p.component_mut(at).eps) = (a, b);
        let terms = [a * gradient.q.component(at), b * gradient.p.component(at)];
        expected += terms[0] + terms[1];
        size += terms[0].abs() + terms[1].abs();
    }
    let found = System::energy::<Dual<f64>>(system, &all).eps;
    assert!(
        (found - expected).abs() <= 2e-13 * (1.0 + size),
        "{found} is not {expected}"
    );
    for at in (0..2 * n).step_by(stride) {
        let mut dual = State {
            t: Dual::fixed(t),
            q: lifted(q),
            p: lifted(p),
        };
        let mut direction = (System::zeros::<f64>(system), System::zeros::<f64>(system));
        let expected = if at < n {
            dual.q.component_mut(at).eps = 1.0;
            *direction.0.component_mut(at) = 1.0;
            gradient.q.component(at)
        } else {
            dual.p.component_mut(at - n).eps = 1.0;
            *direction.1.component_mut(at - n) = 1.0;
            gradient.p.component(at - n)
        };
        close(System::energy::<Dual<f64>>(system, &dual).eps, expected);
        let column = System::gradient::<Dual<f64>>(system, &dual);
        let (mut hq, mut hp) = (direction.0.clone(), direction.1.clone());
        prepared.hessian_vector(t, q, p, &direction.0, &direction.1, &mut hq, &mut hp);
        for k in 0..n {
            close(column.q.component(k).eps, hq.component(k));
            close(column.p.component(k).eps, hp.component(k));
        }
    }
    let later = State {
        t: Dual::variable(t),
        q: lifted(q),
        p: lifted(p),
    };
    let by_time = System::energy::<Dual<f64>>(system, &later).eps;
    close(by_time, prepared.time_derivative(t, q, p));
    let (mut to_q, mut to_p) = (q.clone(), p.clone());
    prepared.field(0.125).add(t, q, p, &mut to_q, &mut to_p);
    for k in 0..n {
        let moved = (gradient.p.component(k), -gradient.q.component(k));
        close(to_q.component(k), q.component(k) + 0.125 * moved.0);
        close(to_p.component(k), p.component(k) + 0.125 * moved.1);
    }
}

/// H in plain Rust; `q` and `p` are flat, columns of a matrix one after the other.
pub trait Plain {
    fn energy<T: Real>(&self, t: T, q: &[T], p: &[T]) -> T;
}

/// H and its gradient are those of plain Rust, differentiated by duals.
pub fn check_plain<S: System>(system: &S, state: &State<VectorOf<S>>, plain: &impl Plain) {
    let (q, p): (Vec<_>, Vec<_>) = (
        state.q.components().collect(),
        state.p.components().collect(),
    );
    let (mut dq, mut dp) = (state.q.clone(), state.p.clone());
    let energy = system
        .prepare()
        .energy_and_gradient(state.t, &state.q, &state.p, &mut dq, &mut dp);
    close(plain.energy(state.t, &q, &p), energy);
    let fixed = |values: &[f64]| values.iter().map(|x| Dual::fixed(*x)).collect::<Vec<_>>();
    let (mut q, mut p) = (fixed(&q), fixed(&p));
    let t = Dual::fixed(state.t);
    // In some components, whatever the size: [`check_at`] has all of the gradient.
    let stride = q.len().div_ceil(directions());
    for at in (0..q.len()).step_by(stride) {
        q[at].eps = 1.0;
        close(plain.energy(t, &q, &p).eps, dq.component(at));
        q[at].eps = 0.0;
        p[at].eps = 1.0;
        close(plain.energy(t, &q, &p).eps, dp.component(at));
        p[at].eps = 0.0;
    }
}

/// Two definitions of one system agree: H, its gradient and its Hessian times a vector.
pub fn agree<A: System, B: System>(a: &A, b: &B) {
    let (here, there) = (all(a), all(b));
    assert_eq!(here.len(), there.len());
    for (here, there) in here.into_iter().zip(there) {
        close(here, there);
    }
}

fn all<S: System>(system: &S) -> Vec<f64> {
    let [q, p, vq, vp] = [1, 2, 3, 4].map(|seed| vector(system, numbers(seed)));
    let prepared = system.prepare();
    let [mut dq, mut dp, mut hq, mut hp] = [(); 4].map(|()| system.zeros());
    let energy = prepared.energy_and_gradient(0.0, &q, &p, &mut dq, &mut dp);
    prepared.hessian_vector(0.0, &q, &p, &vq, &vp, &mut hq, &mut hp);
    let vectors = [dq, dp, hq, hp];
    let components = vectors.iter().flat_map(Vector::components);
    std::iter::once(energy).chain(components).collect()
}
