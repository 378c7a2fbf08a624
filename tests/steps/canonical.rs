//! Systems in other coordinates are compared with the system as it was declared.

use crate::common::canonical::close;
use hamiltonian::{State, Vector};

/// A state as 2n numbers.
pub fn flat<V: Vector>(state: &State<V>) -> Vec<V::Scalar> {
    state.q.components().chain(state.p.components()).collect()
}

/// 2n numbers in the shape of another state.
pub fn shaped<V: Vector>(t: V::Scalar, numbers: &[V::Scalar], like: &State<V>) -> State<V> {
    let mut state = State { t, ..like.clone() };
    let n = state.q.len();
    assert_eq!(numbers.len(), 2 * n);
    for k in 0..n {
        *state.q.component_mut(k) = numbers[k];
        *state.p.component_mut(k) = numbers[n + k];
    }
    state
}

/// MᵀJM = J for the matrix with these columns.
#[track_caller]
pub fn symplectic(columns: &[Vec<f64>]) {
    let n = columns.len() / 2;
    for (i, a) in columns.iter().enumerate() {
        for (j, b) in columns.iter().enumerate() {
            let form: f64 = (0..n).map(|k| a[k] * b[k + n] - a[k + n] * b[k]).sum();
            let wanted = f64::from(i8::from(j == i + n)) - f64::from(i8::from(i == j + n));
            close(wanted, form);
        }
    }
}

/// The energy is the same in both, the maps undo each other and are canonical, the gradient is
/// that of duals, and the dynamics agree. `$declared` is the system as it was written.
macro_rules! same_system {
    ($declared:expr, $new:expr, $state:expr) => {{
        use hamiltonian::prelude::{Integrator, RungeKutta4, State};
        use hamiltonian::{Dual, System, Vector, schemes::author::Dynamics};
        use $crate::canonical::{flat, shaped, symplectic};
        use $crate::common::canonical::{close, equal};
        let (declared, new, written) = ($declared, $new, $state);
        let ones = State {
            t: 0.0,
            q: System::zeros::<f64>(&new),
            p: System::zeros::<f64>(&new),
        };
        let numbers = flat(&written);
        let old = shaped(written.t, &numbers, &new.to_declared(&ones));
        let there = new.from_declared(&old);
        let back = new.to_declared(&there);
        assert_eq!((there.t, back.t), (old.t, old.t));
        equal(&back.q, &old.q);
        equal(&back.p, &old.p);
        let (prepared, energy) = (
            System::prepare::<f64>(&declared),
            System::prepare::<f64>(&new),
        );
        close(
            prepared.energy(written.t, &written.q, &written.p),
            energy.energy(there.t, &there.q, &there.p),
        );

        let ones = State {
            t: Dual::fixed(0.0),
            q: System::zeros::<Dual<f64>>(&new),
            p: System::zeros::<Dual<f64>>(&new),
        };
        let like = new.to_declared(&ones);
        let n = old.q.len();
        let along = |numbers: &[f64], k: usize| -> Vec<Dual<f64>> {
            let mut dual: Vec<Dual<f64>> = numbers.iter().map(|x| Dual::fixed(*x)).collect();
            dual[k].eps = 1.0;
            dual
        };
        let columns: Vec<Vec<f64>> = (0..2 * n)
            .map(|k| {
                let dual = shaped(Dual::fixed(old.t), &along(&numbers, k), &like);
                flat(&new.from_declared(&dual))
                    .iter()
                    .map(|x| x.eps)
                    .collect()
            })
            .collect();
        symplectic(&columns);

        let (mut by_q, mut by_p) = (there.q.zeros_like(), there.p.zeros_like());
        energy.gradient(there.t, &there.q, &there.p, &mut by_q, &mut by_p);
        let gradient = flat(&State {
            t: 0.0,
            q: by_q,
            p: by_p,
        });
        let dual = System::prepare::<Dual<f64>>(&new);
        for (k, slope) in gradient.iter().enumerate() {
            let at = shaped(Dual::fixed(there.t), &along(&flat(&there), k), &ones);
            close(*slope, dual.energy(at.t, &at.q, &at.p).eps);
        }

        // Both runs end at the same place.
        let mut ours = Integrator::new(&new, RungeKutta4, there, 1e-3).unwrap();
        let mut theirs = Integrator::new(&declared, RungeKutta4, written, 1e-3).unwrap();
        ours.advance(500).unwrap();
        theirs.advance(500).unwrap();
        let end = new.to_declared(ours.state());
        for (a, b) in flat(&end).iter().zip(flat(theirs.state())) {
            assert!((a - b).abs() < 1e-9, "{a} is not {b}");
        }
    }};
}
pub(crate) use same_system;
