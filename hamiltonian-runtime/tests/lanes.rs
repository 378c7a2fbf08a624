//! Functions with data over packs of dual numbers, which are computed lane by lane.
//!
//! Input: a definition with a function of one number and one of two. Output: a panic with the first difference.

use hamiltonian::nalgebra::DVector;
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::Dynamics;
use hamiltonian_runtime::{Definition, RuntimeSystem, Values};

/// The system, and numbers of points in the range of its functions.
fn made() -> (RuntimeSystem, Vec<f64>) {
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

/// H and its gradient at the point with these words.
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
    let mut found = Vec::new();
    for number in [energy].iter().chain(&by_q).chain(&by_p) {
        number.write_words(&mut |word| found.push(word));
    }
    found
}

#[test]
fn packs_of_dual_numbers_have_the_bits_of_each_lane() {
    type Two = hamiltonian::lanes::W<f64, 2>;
    let (system, numbers) = made();
    let simple = &numbers[..16];
    let packs = evaluated::<Dual<Two>>(&system, simple);
    let deep = evaluated::<Dual<Dual<Two>>>(&system, &numbers);
    for lane in 0..2 {
        let of =
            |words: &[f64]| -> Vec<f64> { words.iter().skip(lane).step_by(2).copied().collect() };
        let alone = evaluated::<Dual<f64>>(&system, &of(simple));
        assert!(alone.iter().all(|word| word.is_finite()));
        assert_eq!(of(&packs), alone);
        assert_eq!(
            of(&deep),
            evaluated::<Dual<Dual<f64>>>(&system, &of(&numbers))
        );
    }
}
