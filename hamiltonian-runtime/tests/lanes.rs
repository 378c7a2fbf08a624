//! Packs compute functions with data, and Hessians without a program, lane by lane.
//!
//! Input: a definition with functions of one number and of two, and one with loops. Output: a panic with the first difference.

use hamiltonian::nalgebra::DVector;
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::Dynamics;
use hamiltonian_runtime::{Definition, RuntimeSystem, Values};

/// The system with functions, and numbers of points in their range.
fn tabulated() -> (RuntimeSystem, Vec<f64>) {
    let text =
        "struct Tabulated { V: fn(r), W: fn(x, y) } H(x, y; u, v) = u*v + V(x)*(1 + y^2) + W(x, y)";
    let number = |k: u32| 0.8 + 0.7 * f64::sin(f64::from(k) * 1.7);
    let numbers: Vec<f64> = (0..32).map(number).collect();
    let spline = Spline::natural(&[0.0, 0.4, 1.0, 1.7, 2.0], &numbers[..5]);
    let grid = Grid::natural([0.0; 2], [0.5; 2], &[&numbers[..5]; 5].map(<[f64]>::to_vec));
    let values = Values::new()
        .with("V", spline.expect("it has knots"))
        .with("W", grid.expect("it has points"));
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    (definition.system(values).expect("it has all"), numbers)
}

/// A system with loops, whose Hessian is the gradient over dual numbers.
fn chain() -> RuntimeSystem {
    let text = "struct Chain { n: usize, m: [n] } H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + q[i]^4 }
        + sum(i in 1..n) { cos(q[i] - q[i - 1]*p[i]) + erf(q[i]) }";
    let values = Values::new().with("n", 2).with("m", [1.0, 3.0]);
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    definition.system(values).expect("it has all")
}

/// H, its gradient, and its Hessian times a vector, at the point with these words.
fn evaluated<T: Real>(system: &RuntimeSystem, words: &[f64]) -> Vec<f64> {
    let mut words = words.iter().copied();
    let mut next = || {
        words
            .next()
            .expect("there is one for each lane of each part")
    };
    let mut vector = || DVector::from_fn(2, |_, _| T::read_words(&mut next));
    let (q, p) = (vector(), vector());
    let (mut by_q, mut by_p) = (q.clone(), p.clone());
    let prepared = system.prepare::<T>();
    let energy = prepared.energy_and_gradient(T::zero(), &q, &p, &mut by_q, &mut by_p);
    let (mut hessian_q, mut hessian_p) = (q.clone(), p.clone());
    prepared.hessian_vector(T::zero(), &q, &p, &p, &q, &mut hessian_q, &mut hessian_p);
    let mut found = Vec::new();
    let all = [&by_q, &by_p, &hessian_q, &hessian_p].into_iter().flatten();
    for number in [&energy].into_iter().chain(all) {
        number.write_words(&mut |word| found.push(word));
    }
    found
}

#[test]
fn packs_have_the_bits_of_each_lane() {
    type Two = hamiltonian::lanes::W<f64, 2>;
    let (tabulated, numbers) = tabulated();
    for system in [tabulated, chain()] {
        let (few, some) = (&numbers[..8], &numbers[..16]);
        let plain = evaluated::<Two>(&system, few);
        let packs = evaluated::<Dual<Two>>(&system, some);
        let deep = evaluated::<Dual<Dual<Two>>>(&system, &numbers);
        for lane in 0..2 {
            let of = |words: &[f64]| -> Vec<f64> {
                words.iter().skip(lane).step_by(2).copied().collect()
            };
            let alone = evaluated::<f64>(&system, &of(few));
            assert!(alone.iter().all(|word| word.is_finite() && *word != 0.0));
            assert_eq!(of(&plain), alone);
            let alone = evaluated::<Dual<f64>>(&system, &of(some));
            assert!(alone.iter().all(|word| word.is_finite()));
            assert_eq!(of(&packs), alone);
            let alone = evaluated::<Dual<Dual<f64>>>(&system, &of(&numbers));
            assert_eq!(of(&deep), alone);
        }
    }
}
