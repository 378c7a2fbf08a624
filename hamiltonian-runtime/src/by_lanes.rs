//! Functions of numbers over packs, lane by lane.
//!
//! Input: numbers over a pack. Output: a function of each lane, over single numbers. Invariant: the bits are those of single
//! numbers; no pack has code of its own for these functions, which are long and are called seldom.

use crate::prepared::{Flat, Prepared};
use hamiltonian_core::private::{Varied, fixed, hessian_by_gradient};
use hamiltonian_lanes::{Dual, Real};
use std::any::Any;
use std::panic::AssertUnwindSafe;
use std::sync::{Arc, OnceLock};

/// The most words of a number that is taken apart.
const WORDS: usize = 128;

/// True for numbers over a pack, of few words, with this number of dual numbers inside each other.
pub(crate) const fn is_pack<T: Real>(duals: u32) -> bool {
    T::LANES > 1 && T::DUALS == duals && (T::LANES as usize) << duals <= WORDS
}

/// The words of a number over a pack: the lanes of the value, then those of its derivative.
fn words_of<T: Real>(x: T) -> [f64; WORDS] {
    let (mut words, mut next) = ([0.0; WORDS], 0);
    x.write_words(&mut |word| {
        words[next % WORDS] = word;
        next += 1;
    });
    words
}

/// The number with these words.
fn of_words<T: Real>(words: &[f64]) -> T {
    let mut words = words.iter();
    T::read_words(&mut || words.next().copied().unwrap_or(f64::NAN))
}

/// The number of a lane.
fn lane_of<E: Real>(words: &[f64], lane: usize, lanes: usize) -> E {
    let mut parts = words.iter().skip(lane).step_by(lanes);
    E::read_words(&mut || parts.next().copied().unwrap_or(f64::NAN))
}

/// Writes the number of a lane.
fn set_lane<E: Real>(words: &mut [f64], lane: usize, lanes: usize, x: E) {
    let mut places = words.iter_mut().skip(lane).step_by(lanes);
    x.write_words(&mut |word| {
        if let Some(place) = places.next() {
            *place = word;
        }
    });
}

/// A function of two numbers over a pack by that of each lane, which are numbers `E`.
#[inline(always)]
pub(crate) fn of_two<T: Real, E: Real>(at: [T; 2], f: impl Fn([E; 2]) -> E) -> T {
    let lanes = T::LANES as usize;
    let at = at.map(words_of);
    let mut found = [0.0; WORDS];
    for lane in 0..lanes {
        let value = f(at.each_ref().map(|words| lane_of(words, lane, lanes)));
        set_lane(&mut found, lane, lanes, value);
    }
    of_words(&found)
}

/// The systems of the lanes of a pack over numbers with derivatives, which are made when they are first needed and do not
/// change, so that a panic leaves them whole.
pub(crate) type Kept = Arc<OnceLock<AssertUnwindSafe<Box<dyn Any + Send + Sync>>>>;

impl<T: Real> Prepared<T> {
    /// The Hessian of H times a vector, from the gradient over numbers with derivatives.
    #[inline(always)]
    pub(crate) fn hessian_by_gradient(
        &self,
        t: T,
        [q, p]: [&Flat<T>; 2],
        [vq, vp]: [&Flat<T>; 2],
        out: [&mut Flat<T>; 2],
    ) {
        if const { is_pack::<T>(0) } {
            self.hessian_by_lanes::<f64>(t, [q, p, vq, vp], out);
        } else if const { is_pack::<T>(1) } {
            self.hessian_by_lanes::<Dual<f64>>(t, [q, p, vq, vp], out);
        } else {
            hessian_by_gradient(&self.lifted(), t, [q, p], [vq, vp], out);
        }
    }

    /// The same lane by lane, over numbers `E`.
    #[cold]
    fn hessian_by_lanes<E: Real>(&self, t: T, from: [&Flat<T>; 4], out: [&mut Flat<T>; 2]) {
        let all = |vector: &Flat<T>| -> Vec<f64> {
            let mut words = Vec::new();
            for x in vector {
                x.write_words(&mut |word| words.push(word));
            }
            words
        };
        let lanes = T::LANES as usize;
        let width = lanes << T::DUALS;
        let [by_q, by_p] = hessians(self.lanes::<E>(), &words_of(t)[..width], from.map(all));
        for (out, words) in out.into_iter().zip([by_q, by_p]) {
            for (x, words) in out.iter_mut().zip(words.chunks_exact(width)) {
                *x = of_words(words);
            }
        }
    }

    /// The system of each lane over numbers with derivatives, which are zero.
    fn lanes<E: Real>(&self) -> &[Prepared<Varied<E>>] {
        let lanes = T::LANES as usize;
        let systems = self.lanes.get_or_init(|| {
            let system = |lane: usize| {
                let of_lane = |numbers: &[T]| -> Vec<Varied<E>> {
                    let number = |x: &T| fixed(lane_of(&words_of(*x), lane, lanes));
                    numbers.iter().map(number).collect()
                };
                self.mapped(of_lane)
            };
            AssertUnwindSafe(Box::new((0..lanes).map(system).collect::<Vec<_>>()))
        });
        match systems.downcast_ref::<Vec<Prepared<Varied<E>>>>() {
            Some(systems) => systems,
            None => unreachable!("lanes of a scalar are numbers of one type"),
        }
    }
}

/// The Hessian of each system times a vector, from the words of all lanes: the time, and q, p and the vector's halves.
fn hessians<E: Real>(
    systems: &[Prepared<Varied<E>>],
    t: &[f64],
    from: [Vec<f64>; 4],
) -> [Vec<f64>; 2] {
    let lanes = systems.len();
    let mut found = [from[0].clone(), from[1].clone()];
    for (lane, system) in systems.iter().enumerate() {
        let [q, p, vq, vp] = from.each_ref().map(|words| -> Flat<E> {
            let numbers = words.chunks_exact(t.len());
            let numbers: Vec<E> = numbers.map(|words| lane_of(words, lane, lanes)).collect();
            numbers.into()
        });
        let mut out = [q.clone(), p.clone()];
        let [by_q, by_p] = &mut out;
        let t_of_lane = lane_of(t, lane, lanes);
        hessian_by_gradient(system, t_of_lane, [&q, &p], [&vq, &vp], [by_q, by_p]);
        for (found, out) in found.iter_mut().zip(&out) {
            for (words, x) in found.chunks_exact_mut(t.len()).zip(out) {
                set_lane(words, lane, lanes, *x);
            }
        }
    }
    found
}
