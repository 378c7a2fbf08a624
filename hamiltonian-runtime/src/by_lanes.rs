//! Hessians over packs, lane by lane.
//!
//! Input: a system, numbers over a pack. Output: the Hessian of H times a vector. Invariant: the bits are those of single
//! numbers; no pack has code of its own over numbers with derivatives.

use crate::prepared::{Flat, Prepared};
use crate::words::{is_pack, lane_of, of_words, set_lane, words_of};
use hamiltonian_core::private::{Varied, fixed, hessian_by_gradient};
use hamiltonian_lanes::{Dual, Real};
use std::panic::AssertUnwindSafe;

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
