//! The operations of compiled code, counted by the scalar it runs on: as many operations a site, a bond or
//! a pair whatever the size, and none beside.

pub mod counted;
// The definitions of the examples, with their runs.
#[allow(clippy::duplicate_mod, dead_code)]
#[path = "../examples/solar_system.rs"]
mod solar_system;
#[allow(clippy::duplicate_mod, dead_code)]
#[path = "../examples/toda.rs"]
mod toda;

use counted::{Called, Counted, Counts, counted};
use hamiltonian::{
    System, Vector,
    schemes::author::{Dynamics, VectorField},
};
use solar_system::Gravity;
use toda::Toda;

/// The operations of each function of a system, preparation apart.
struct Work {
    prepare: Counts,
    energy: Counts,
    gradient: Counts,
    energy_and_gradient: Counts,
    hessian: Counts,
    flow: Counts,
}

/// Runs all functions of a system in an arbitrary state, of `f64` and of the scalar that counts:
/// the bits are the same.
fn work<S: System>(system: &S) -> Work {
    let plain = filled(System::zeros::<f64>(system), |x| x);
    let state = filled(System::zeros::<Counted>(system), Called);
    let ((q, p), (vq, vp)) = (&state, &state);
    let (mut dq, mut dp) = (q.zeros_like(), q.zeros_like());
    let (prepared, prepare) = counted(|| System::prepare::<Counted>(system));
    let zero: Counted = Called(0.0);
    let (_, energy) = counted(|| prepared.energy(zero, q, p));
    let (_, gradient) = counted(|| prepared.gradient(zero, q, p, &mut dq, &mut dp));
    let (mut plain_dq, mut plain_dp) = (plain.0.zeros_like(), plain.0.zeros_like());
    System::prepare::<f64>(system).gradient(0.0, &plain.0, &plain.1, &mut plain_dq, &mut plain_dp);
    for (ours, theirs) in [(&dq, &plain_dq), (&dp, &plain_dp)] {
        assert!(ours.components().map(|x| x.0).eq(theirs.components()));
    }
    let (_, energy_and_gradient) =
        counted(|| prepared.energy_and_gradient(zero, q, p, &mut dq, &mut dp));
    let (_, hessian) = counted(|| prepared.hessian_vector(zero, q, p, vq, vp, &mut dq, &mut dp));
    let field = prepared.field(Called(0.5));
    let (_, flow) = counted(|| field.add(zero, q, p, &mut dq, &mut dp));
    Work {
        prepare,
        energy,
        gradient,
        energy_and_gradient,
        hessian,
        flow,
    }
}

/// Coordinates and momenta, all different.
fn filled<V: Vector>(zeros: V, of: impl Fn(f64) -> V::Scalar) -> (V, V) {
    let (mut q, mut p) = (zeros.clone(), zeros);
    for at in 0..q.len() {
        *q.component_mut(at) = of((1.0 + at as f64).sin());
        *p.component_mut(at) = of((2.0 + at as f64).cos());
    }
    (q, p)
}

fn counts(additions: usize, multiplications: usize) -> Counts {
    Counts {
        additions,
        multiplications,
        ..Counts::default()
    }
}

/// A lattice of N sites has N bonds: one exponential each, whose product with 1 and −1 is the force
/// on both sides, and no division anywhere.
fn lattice<const N: usize>() {
    let work = work(&Toda::<N> {});
    let per_site = |additions, multiplications| Counts {
        exponentials: N,
        ..counts(additions * N, multiplications * N)
    };
    // A long sum is eight sums and their tree.
    let with_tree = |counts: Counts| Counts {
        additions: counts.additions + if N < 32 { 0 } else { 8 },
        ..counts
    };
    assert_eq!(work.prepare, Counts::default());
    // q − q, and into the sum ½·p·p + exp.
    assert_eq!(work.energy, with_tree(per_site(3, 2)));
    // The gradient is the field with other signs: q − q, c·exp to one side and from the other; ∂H/∂p is c·p.
    assert_eq!(work.gradient, per_site(4, 2));
    assert_eq!(work.energy_and_gradient, with_tree(per_site(5, 2)));
    // It is the gradient of dual numbers.
    assert_eq!((work.hessian.exponentials, work.hessian.divisions), (N, 0));
    // q += c·p; c·exp is added twice.
    assert_eq!(work.flow, per_site(4, 2));
}

#[test]
fn one_exponential_for_each_bond() {
    lattice::<1>();
    lattice::<8>();
    lattice::<200>();
    // Arrays of this size stand on the stack.
    let large = std::thread::Builder::new().stack_size(16 << 20);
    let large = large.spawn(lattice::<10_000>).expect("a thread");
    large.join().expect("a lattice of 10 000 sites");
}

/// Each pair of bodies is visited once, with one square root and one division; the division by each
/// mass is made once, in preparation.
#[test]
fn one_root_and_one_division_for_each_pair() {
    for n in [1, 2, 3, 7, 20] {
        let masses = (1..=n).map(|i| i as f64).collect::<Vec<_>>();
        let work = work(&Gravity::new(n, masses).unwrap());
        let pairs = n * (n - 1) / 2;
        let linear = |pair: usize, body: usize, once: usize| pair * pairs + body * n + once;
        let prepare = Counts {
            divisions: n,
            ..Counts::default()
        };
        assert_eq!(work.prepare, prepare);
        let expected = |additions, multiplications| Counts {
            roots: pairs,
            divisions: pairs,
            ..counts(additions, multiplications)
        };
        // A pair: 3 differences, 2 sums for the square of the distance, 6 for the force on both. The gradient is the kick
        // and the drift, with coefficients 1: a body's own part of both, c·G·m and c/m, and c·G.
        let gradient = expected(linear(11, 6, 0), linear(9, 5, 1));
        assert_eq!(work.gradient, gradient);
        let with_energy = expected(linear(12, 7, 1), linear(10, 9, 2));
        assert_eq!(work.energy_and_gradient, with_energy);
        for work in [work.energy, work.flow] {
            assert_eq!((work.roots, work.divisions), (pairs, pairs));
        }
        // Over dual numbers, the derivatives of a root and of a reciprocal are quotients.
        let hessian = work.hessian;
        assert_eq!((hessian.roots, hessian.divisions), (pairs, 3 * pairs));
    }
}
