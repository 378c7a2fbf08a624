//! The iterations of a stretch in packs.
//!
//! Input: a stretch of at least [`STRIDE`] iterations. Output: its columns and its sums. Invariant: each
//! element is changed in the order of the iterations, and each sum has the terms of its iterations in order.

use super::waiting::{NONE, Waiting};
use super::{BLOCK, Body, CARRY, STRIDE, Stretch, changed, cut, has_shared, store_of};
use hamiltonian_lanes::{Pack, Real};

/// Computes at least [`STRIDE`] iterations in packs of as many lanes.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn packs<
    T: Real,
    B: Body<G, R, W>,
    P: Pack,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const A: usize,
    const W: usize,
>(
    stretch: Stretch<'_, T, G, R, C, S, A>,
    is_followed: bool,
) {
    let Stretch {
        length,
        number,
        given,
        mut reads,
        mut columns,
        mut offsets,
        sums,
        ..
    } = stretch;
    let mut constants = [T::Over::<P>::default(); G];
    let mut g = 0;
    while g < G {
        constants[g] = given[g].spread::<P>();
        g += 1;
    }
    let mut totals = [T::Over::<P>::default(); A];
    let mut a = 0;
    while a < A {
        totals[a] = T::gather::<P>(&sums[a]);
        a += 1;
    }
    // Lengths that the compiler knows to be those of the loop: no element needs a check.
    let mut r = 0;
    while r < R {
        if store_of(B::OWN, r).is_none() {
            reads[r] = &reads[r][..length];
        }
        r += 1;
    }
    let has_shared = const { has_shared(B::STORES) };
    let mut waiting = Waiting::<T, S, W>::new(B::STORES, offsets, length, is_followed);
    let does_wait = has_shared && waiting.is_any();
    cut(B::STORES, &mut columns, &mut offsets, length);
    // The last iterations, which fill no pack, are computed together with those before them, which are thus repeated.
    // The elements that a direct store changed there are restored first.
    let rest = length % STRIDE;
    let mut before = [T::Over::<P>::default(); S];
    let mut s = 0;
    while s < B::STORES.len() && rest > 0 {
        let store = &B::STORES[s];
        if waiting.is_taken_back(B::STORES, B::OWN, s) {
            let place = offsets[s] + length - STRIDE;
            before[s] = T::gather::<P>(&columns[store.column][place..place + STRIDE]);
        }
        s += 1;
    }
    let mut turned = [[T::zero(); 2 * STRIDE]; A];
    let block = if does_wait { BLOCK } else { length };
    let mut at = 0;
    while at < length {
        let end = at + block.min(length - at);
        let mut k = at;
        loop {
            while k + STRIDE <= end {
                let mut read = [T::Over::<P>::default(); R];
                let mut r = 0;
                while r < R {
                    let column = match store_of(B::OWN, r) {
                        Some(store) => &*columns[B::STORES[store].column],
                        None => reads[r],
                    };
                    read[r] = T::gather::<P>(&column[k..k + STRIDE]);
                    r += 1;
                }
                let ramp = match B::COUNTS {
                    true => ramp::<T, P>(number + k),
                    false => T::Over::<P>::default(),
                };
                let out = B::compute(constants, read, ramp);
                let mut s = 0;
                while s < B::STORES.len() {
                    let store = &B::STORES[s];
                    if store.is_shared && waiting.group[s] != NONE {
                        let place = CARRY + k - at;
                        let [a, b] = store.by;
                        T::scatter::<P>(out[a], &mut waiting.results[a][place..place + STRIDE]);
                        if a != b {
                            T::scatter::<P>(out[b], &mut waiting.results[b][place..place + STRIDE]);
                        }
                    } else {
                        let place = if store.is_shared { offsets[s] + k } else { k };
                        let places = &mut columns[store.column][place..place + STRIDE];
                        let by = [out[store.by[0]], out[store.by[1]]];
                        let new = changed(store.change, T::gather::<P>(places), by);
                        T::scatter::<P>(new, places);
                    }
                    s += 1;
                }
                let mut s = 0;
                while s < B::SUMS.len() {
                    let (sum, by) = B::SUMS[s];
                    totals[sum] += out[by];
                    s += 1;
                }
                k += STRIDE;
            }
            if k == end {
                break;
            }
            k = length - STRIDE;
            let mut s = 0;
            while s < B::STORES.len() {
                let store = &B::STORES[s];
                if waiting.is_taken_back(B::STORES, B::OWN, s) {
                    let place = if store.is_shared { offsets[s] + k } else { k };
                    T::scatter::<P>(before[s], &mut columns[store.column][place..place + STRIDE]);
                }
                s += 1;
            }
            // Iteration k adds to sum k mod 8: the lanes of the last pack begin with another one.
            let mut a = 0;
            while a < A {
                T::scatter::<P>(totals[a], &mut turned[a][STRIDE - rest..][..STRIDE]);
                totals[a] = T::gather::<P>(&turned[a][..STRIDE]);
                a += 1;
            }
        }
        if does_wait {
            waiting.store_due::<P, C>(B::STORES, &mut columns, at, end, end == length);
        }
        at = end;
    }
    let mut a = 0;
    while a < A {
        if rest > 0 {
            T::scatter::<P>(totals[a], &mut turned[a][..STRIDE]);
            totals[a] = T::gather::<P>(&turned[a][STRIDE - rest..][..STRIDE]);
        }
        T::scatter::<P>(totals[a], &mut sums[a]);
        a += 1;
    }
}

/// Successive numbers of iterations.
#[cfg_attr(not(unoptimised), inline(always))]
fn ramp<T: Real, P: Pack>(first: usize) -> T::Over<P> {
    let mut numbers = [T::zero(); STRIDE];
    let mut k = 0;
    while k < STRIDE {
        numbers[k] = T::constant((first + k) as f64, 0.0);
        k += 1;
    }
    T::gather::<P>(&numbers)
}
