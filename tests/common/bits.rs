//! The bits of a system in lanes, against its iterations one by one.
//!
//! `Called<false>` is an `f64` that has no form in lanes: its loops go one by one.

use super::derivatives::numbers;
use super::levels;
use crate::counting::counted::Called;
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::{
    Vector,
    schemes::author::{Dynamics, VectorField},
};
use hamiltonian_lanes::Cpu;
use std::sync::{PoisonError, RwLock};

/// Tests that hide levels from the whole process write it; those whose bits depend on the level read it.
pub static LEVEL: RwLock<()> = RwLock::new(());

/// Every output of a system: values, then elements.
fn outputs<T, S>(system: &S, seed: u64, word: fn(T) -> f64, number: fn(f64) -> T) -> Vec<u64>
where
    T: Real,
    S: System,
{
    let prepared = system.prepare();
    let mut some = numbers(seed);
    let mut vector = || {
        let mut vector = system.zeros();
        for k in 0..<VectorOf<S, T> as Vector>::PARTS {
            for (to, from) in vector.part_mut(k).iter_mut().zip(&mut some) {
                *to = number(from);
            }
        }
        vector
    };
    let [q, p, vq, vp, mut a, mut b] = [(); 6].map(|()| vector());
    let t = number(0.25);
    let mut words = vec![prepared.energy(t, &q, &p)];
    let push = |words: &mut Vec<T>, a: &VectorOf<S, T>, b: &VectorOf<S, T>| {
        for vector in [a, b] {
            (0..<VectorOf<S, T> as Vector>::PARTS).for_each(|k| words.extend(vector.part(k)));
        }
    };
    prepared.field(number(0.125)).add(t, &q, &p, &mut a, &mut b);
    push(&mut words, &a, &b);
    words.push(prepared.energy_and_gradient(t, &q, &p, &mut a, &mut b));
    push(&mut words, &a, &b);
    prepared.gradient_q(t, &q, &p, &mut a);
    prepared.gradient_p(t, &q, &p, &mut b);
    push(&mut words, &a, &b);
    prepared.gradient(t, &q, &p, &mut a, &mut b);
    push(&mut words, &a, &b);
    prepared.hessian_vector(t, &q, &p, &vq, &vp, &mut a, &mut b);
    push(&mut words, &a, &b);
    words
        .into_iter()
        .map(|value| word(value).to_bits())
        .collect()
}

/// The bits of a system over `f64` on every level, and one by one.
#[track_caller]
pub fn check<S: System>(system: &S, seed: u64) {
    let expected = outputs::<Called<false>, S>(system, seed, |x| x.0, Called);
    let _hidden = LEVEL.write().unwrap_or_else(PoisonError::into_inner);
    for limit in levels() {
        Cpu::limit_to(limit);
        let found = outputs::<f64, S>(system, seed, |x| x, |x| x);
        let differ = expected.iter().zip(&found).position(|(a, b)| a != b);
        assert_eq!(differ, None, "{limit:?}, {} words", expected.len());
    }
    Cpu::limit_to(Cpu::Avx512);
}
