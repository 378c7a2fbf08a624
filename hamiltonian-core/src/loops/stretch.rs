//! Loops over arrays: the iterations of an innermost loop, in lanes where the scalar has lanes.
//!
//! Input: the arithmetic of one iteration ([`Body`]), written by the macro, and a stretch of the loop in
//! which every element moves on by one ([`Stretch`]). Output: what the iterations store and sum. Invariant:
//! each element is added to in the order of the iterations and, within one, in the order of its stores;
//! sums of [`LONG`] iterations or more are [`STRIDE`] partial sums and a tree, whatever the scalar. So a
//! result does not depend on whether, or on which CPU, iterations went through lanes, unless products
//! [fuse](Arithmetic::fused) there.

mod body;
mod nest;
mod packs;
mod waiting;
mod whole;

use crate::loops::slabs::{on_two_threads, slabs};
use crate::systems::compiled::{self, Rounded, has_lanes, rounded};
use crate::systems::system::Arithmetic;
pub use body::{AddedTo, Body, Change, ColumnStore, InRing, OfStore};
use body::{changed, has_shared, is_first_of_column, is_read, store_of};
use hamiltonian_lanes::{Cpu, Kernel, Level, Pack, Real, dispatch};
pub use nest::{Nest, nest};
use packs::packs;
pub use whole::{Loop, Mode};

/// The least extent of a loop whose sums are partial sums, and whose iterations may go through lanes.
pub const LONG: usize = 32;

/// The least number of iterations of a loop without sums that are faster in lanes than one after the other, from the
/// number of sums and products in one and that of other operations: the way into a level takes as long as some fifty
/// additions. (At 64 sites a step of the FPUT chain took 57 ns without lanes and 91 with them; at 128 sites it is the
/// other way round. Eight Kepler flows take 560 ns one after the other. Zen 4.)
#[must_use]
pub const fn worth(sums_and_products: usize, others: usize) -> usize {
    match (sums_and_products, others) {
        (0..=8, 0) => 3 * LONG,
        (_, 8..) => STRIDE,
        _ => LONG,
    }
}

/// The number of partial sums: iteration k of a loop adds to sum k mod 8.
pub const STRIDE: usize = 8;

/// The most iterations whose results wait for the order in which elements are changed.
const BLOCK: usize = 128;

/// The largest distance of elements of a column that an iteration changes at once.
const REACH: usize = 32;

/// The number of results that are kept from the block before: as far as stores reach, and what did not
/// fill a pack.
const CARRY: usize = REACH + STRIDE;

/// A stretch of a loop: as many iterations as move every element on by one.
#[derive(Debug)]
pub struct Stretch<
    'a,
    T,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const A: usize,
> {
    /// The number of iterations.
    pub length: usize,
    /// The number of the first one in the loop, from 0 on.
    pub first: usize,
    /// The loop variable there.
    pub number: usize,
    /// What does not vary.
    pub given: [T; G],
    /// What is read, from the first iteration's element on.
    pub reads: [&'a [T]; R],
    /// The columns that are written.
    pub columns: [&'a mut [T]; C],
    /// For each store the place of the first iteration's element in its column.
    pub offsets: [usize; S],
    /// The partial sums.
    pub sums: &'a mut [[T; STRIDE]; A],
    /// The arithmetic: lanes or one iteration after the other, and in lanes, fused products or none.
    pub arithmetic: Arithmetic,
}

/// The sum of partial sums, as a tree: ((0+4)+(2+6)) + ((1+5)+(3+7)).
#[cfg_attr(not(unoptimised), inline(always))]
#[must_use]
pub fn total<T: Real>(s: &[T; STRIDE]) -> T {
    ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]))
}

/// `i % n`, 0 in a ring without elements; most indices are below n and are not divided.
#[cfg_attr(not(unoptimised), inline(always))]
#[must_use]
pub fn wrapped(i: usize, n: usize) -> usize {
    if i < n {
        i
    } else {
        i.checked_rem(n).unwrap_or(0)
    }
}

impl<T: Real, const G: usize, const R: usize, const C: usize, const S: usize, const A: usize>
    Stretch<'_, T, G, R, C, S, A>
{
    /// Runs the iterations of a loop of at least [`LONG`] ones.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<B: Body<G, R, W>, const W: usize>(self) {
        let length = self.length;
        if !T::WIDENS {
            self.one_by_one::<B, W>(length);
        } else if self.arithmetic.lanes && length >= STRIDE {
            self.in_lanes::<B, W>();
        } else {
            self.first_ones::<B, W>(length);
        }
    }

    /// The iterations through lanes; those before the first partial sum one by one.
    #[inline(never)]
    fn in_lanes<B: Body<G, R, W>, const W: usize>(mut self) {
        let before = self.before::<B, W>();
        if before > 0 {
            self.reborrow().first_ones::<B, W>(before);
            self.skip::<B, W>(before);
        }
        if self.length == 0 {
            return;
        }
        let slabs = match B::SUMS.is_empty() {
            true => slabs(self.arithmetic, self.length),
            false => 1,
        };
        if slabs > 1
            && let Some(ends) = self.ends::<B, W>()
        {
            return self.cut::<B, W>(&ends, slabs, false);
        }
        self.dispatch::<B, W>(false);
    }

    /// The number of iterations before the first pack: up to one that adds to the first partial sum, and all
    /// if those after it fill no pack.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn before<B: Body<G, R, W>, const W: usize>(&self) -> usize {
        let before = match B::SUMS.is_empty() {
            true => 0,
            false => (STRIDE - self.first % STRIDE) % STRIDE,
        };
        match self.length < before + STRIDE {
            true => self.length,
            false => before,
        }
    }

    /// Leaves the first iterations out.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn skip<B: Body<G, R, W>, const W: usize>(&mut self, count: usize) {
        self.length -= count;
        self.first += count;
        self.number += count;
        let mut r = 0;
        while r < R {
            if store_of(B::OWN, r).is_none() {
                self.reads[r] = &self.reads[r][count..];
            }
            r += 1;
        }
        let mut s = 0;
        while s < S {
            self.offsets[s] += count;
            s += 1;
        }
    }

    /// The iterations through lanes. Where the stretch is followed, the elements that its last iterations
    /// share with those after it were changed before.
    fn dispatch<B: Body<G, R, W>, const W: usize>(self, is_followed: bool) {
        dispatch(StretchKernel::<_, B, G, R, C, S, A, W> {
            stretch: self,
            is_followed,
            body: core::marker::PhantomData,
        });
    }

    /// For each column the least and the largest offset of a store. `None` if stores lie too far apart for
    /// slabs, if results that wait have other bits outside of lanes, or if there are no lanes for them to wait in.
    fn ends<B: Body<G, R, W>, const W: usize>(&self) -> Option<[[usize; 2]; C]> {
        if has_shared(B::STORES) && (self.arithmetic.fused || !has_lanes(Cpu::best())) {
            return None;
        }
        let mut ends = [[usize::MAX, 0]; C];
        for (store, &offset) in B::STORES.iter().zip(&self.offsets) {
            let [least, most] = &mut ends[store.column];
            (*least, *most) = (offset.min(*least), offset.max(*most));
        }
        let is_near = |[least, most]: &[usize; 2]| most.saturating_sub(*least) <= REACH;
        ends.iter().all(is_near).then_some(ends)
    }

    /// The iterations through lanes in so many slabs, on threads; `ends` are those of this stretch.
    #[inline(never)]
    fn cut<B: Body<G, R, W>, const W: usize>(
        mut self,
        ends: &[[usize; 2]; C],
        slabs: usize,
        is_followed: bool,
    ) {
        if slabs < 2 {
            return self.dispatch::<B, W>(is_followed);
        }
        let half = slabs / 2;
        let middle = self.length * half / slabs / STRIDE * STRIDE;
        // Of the elements that both slabs reach, the iterations of the first one come first.
        if has_shared(B::STORES) {
            self.add_before::<B, W>(ends, middle);
        }
        let mut columns = self.columns;
        let mut after = no_elements();
        for ((column, after), [least, _]) in columns.iter_mut().zip(&mut after).zip(ends) {
            if *least != usize::MAX {
                (*column, *after) = core::mem::take(column).split_at_mut(least + middle);
            }
        }
        let mut offsets = self.offsets;
        for (store, offset) in B::STORES.iter().zip(&mut offsets) {
            *offset -= ends[store.column][0];
        }
        let (mut before, mut rest) = (self.reads, self.reads);
        for (before, rest) in before.iter_mut().zip(&mut rest) {
            // No elements of those that iterations change themselves.
            (*before, *rest) = before.split_at(middle.min(before.len()));
        }
        let mut no_sums = ([[T::zero(); STRIDE]; A], [[T::zero(); STRIDE]; A]);
        let mut first = Some(Stretch {
            length: middle,
            reads: before,
            columns,
            sums: &mut no_sums.0,
            ..self
        });
        let mut second = Some(Stretch {
            length: self.length - middle,
            first: self.first + middle,
            number: self.number + middle,
            reads: rest,
            columns: after,
            offsets,
            sums: &mut no_sums.1,
            ..self
        });
        let mut from_0 = *ends;
        for [least, most] in &mut from_0 {
            (*least, *most) = (0, most.saturating_sub(*least));
        }
        on_two_threads(
            &mut || {
                if let Some(first) = first.take() {
                    first.cut::<B, W>(ends, half, true);
                }
            },
            &mut || {
                if let Some(second) = second.take() {
                    second.cut::<B, W>(&from_0, slabs - half, is_followed);
                }
            },
        );
    }

    /// Adds the terms of the iterations before the middle to elements that the iterations after it reach too.
    #[inline(never)]
    fn add_before<B: Body<G, R, W>, const W: usize>(
        &mut self,
        ends: &[[usize; 2]; C],
        middle: usize,
    ) {
        for k in middle - REACH..middle {
            let number = match B::COUNTS {
                true => T::constant((self.number + k) as f64, 0.0),
                false => T::zero(),
            };
            let out = B::compute(self.given, elements(&self.reads, k), number);
            for (store, offset) in B::STORES.iter().zip(self.offsets) {
                if offset + k >= ends[store.column][0] + middle {
                    let place = &mut self.columns[store.column][offset + k];
                    *place = changed(store.change, *place, [out[store.by[0]], out[store.by[1]]]);
                }
            }
        }
    }

    /// The same stretch, for a part of its iterations.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn reborrow(&mut self) -> Stretch<'_, T, G, R, C, S, A> {
        Stretch {
            columns: reborrowed(&mut self.columns),
            sums: &mut *self.sums,
            ..*self
        }
    }

    /// The first iterations one by one: the one copy of them for scalars that have lanes.
    #[inline(never)]
    fn first_ones<B: Body<G, R, W>, const W: usize>(self, count: usize) {
        self.one_by_one::<B, W>(count);
    }

    /// The first iterations one by one.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn one_by_one<B: Body<G, R, W>, const W: usize>(self, count: usize) {
        let first = self.first;
        self.each::<B, W>(
            count,
            #[cfg_attr(not(unoptimised), inline(always))]
            |sums, k, sum, term| sums[sum][(first + k) % STRIDE] += term,
        );
    }

    /// All iterations one by one, with sums in their order.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn in_order<B: Body<G, R, W>, const W: usize>(self, sums: &mut [T; A]) {
        let length = self.length;
        let mut all = *sums;
        self.each::<B, W>(
            length,
            #[cfg_attr(not(unoptimised), inline(always))]
            |_, _, sum, term| all[sum] += term,
        );
        *sums = all;
    }

    /// The first iterations. `add` adds to a sum: it receives the partial sums, the number of the iteration, that of the
    /// sum, and the term.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn each<B: Body<G, R, W>, const W: usize>(
        mut self,
        count: usize,
        mut add: impl FnMut(&mut [[T; STRIDE]; A], usize, usize, T),
    ) {
        cut(B::STORES, &mut self.columns, &mut self.offsets, count);
        let mut r = 0;
        while r < R {
            if store_of(B::OWN, r).is_none() {
                self.reads[r] = &self.reads[r][..count];
            }
            r += 1;
        }
        // The compiler makes one operation on two numbers from those of two iterations. It does so by itself if there are
        // no partial sums.
        let are_paired = const {
            cfg!(not(unoptimised)) && T::WIDENS && !has_shared(B::STORES) && !B::SUMS.is_empty()
        };
        let mut k = 0;
        while are_paired && k + 1 < count {
            self.iterations::<B, W, 2>(k, &mut add);
            k += 2;
        }
        while k < count {
            self.iterations::<B, W, 1>(k, &mut add);
            k += 1;
            if are_paired {
                // It was the last one.
                break;
            }
        }
    }

    /// `N` iterations from `k` on. All elements are read before one is stored: if there are several iterations, none may
    /// read or change an element that another one stores.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn iterations<B: Body<G, R, W>, const W: usize, const N: usize>(
        &mut self,
        k: usize,
        add: &mut impl FnMut(&mut [[T; STRIDE]; A], usize, usize, T),
    ) {
        let mut out = [[T::zero(); W]; N];
        let mut n = 0;
        while n < N {
            let number = match B::COUNTS {
                true => T::constant((self.number + k + n) as f64, 0.0),
                false => T::zero(),
            };
            let mut read = [T::zero(); R];
            let mut r = 0;
            while r < R {
                read[r] = match store_of(B::OWN, r) {
                    Some(store) => {
                        let column = &self.columns[B::STORES[store].column];
                        column[self.offsets[store] + k + n]
                    }
                    None => self.reads[r][k + n],
                };
                r += 1;
            }
            out[n] = B::compute(self.given, read, number);
            n += 1;
        }
        let mut s = 0;
        while s < B::STORES.len() {
            let store = &B::STORES[s];
            let [a, b] = store.by;
            let first = self.offsets[s] + k;
            let places = &mut self.columns[store.column][first..first + N];
            let mut new = [T::zero(); N];
            let mut n = 0;
            while n < N {
                new[n] = changed(store.change, places[n], [out[n][a], out[n][b]]);
                n += 1;
            }
            places.copy_from_slice(&new);
            s += 1;
        }
        let mut n = 0;
        while n < N {
            let mut s = 0;
            while s < B::SUMS.len() {
                let (sum, by) = B::SUMS[s];
                add(self.sums, k + n, sum, out[n][by]);
                s += 1;
            }
            n += 1;
        }
    }
}

/// Cuts the columns that one store reaches to the elements of a stretch: no element of them needs a check.
#[cfg_attr(not(unoptimised), inline(always))]
fn cut<T, const C: usize, const S: usize>(
    stores: &[ColumnStore],
    columns: &mut [&mut [T]; C],
    offsets: &mut [usize; S],
    length: usize,
) {
    let mut is_cut = [false; C];
    let mut s = 0;
    while s < stores.len() {
        let store = &stores[s];
        if !store.is_shared {
            if !is_cut[store.column] {
                let column = core::mem::take(&mut columns[store.column]);
                columns[store.column] = &mut column[offsets[s]..offsets[s] + length];
                is_cut[store.column] = true;
            }
            offsets[s] = 0;
        }
        s += 1;
    }
}

/// Element `k` of each column.
#[cfg_attr(not(unoptimised), inline(always))]
fn elements<T: Real, const R: usize>(columns: &[&[T]; R], k: usize) -> [T; R] {
    let mut all = [T::zero(); R];
    let mut r = 0;
    while r < R {
        all[r] = columns[r][k];
        r += 1;
    }
    all
}

/// Columns without elements. (A closure in a method would be compiled for each body of a loop.)
fn no_elements<'a, T, const C: usize>() -> [&'a mut [T]; C] {
    [(); C].map(|()| &mut [][..])
}

/// The same columns, borrowed for a shorter time.
fn reborrowed<'a, T, const C: usize>(columns: &'a mut [&mut [T]; C]) -> [&'a mut [T]; C] {
    columns.each_mut().map(|column| &mut **column)
}

/// A stretch as a kernel that enters a level.
struct StretchKernel<
    'a,
    T,
    B,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const A: usize,
    const W: usize,
> {
    stretch: Stretch<'a, T, G, R, C, S, A>,
    is_followed: bool,
    body: core::marker::PhantomData<B>,
}

impl<
    T: Real,
    B: Body<G, R, W>,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const A: usize,
    const W: usize,
> Kernel for StretchKernel<'_, T, B, G, R, C, S, A, W>
{
    type Output = ();
    const BEST: Cpu = compiled::BEST;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn best(&self) -> Cpu {
        compiled::best(self.stretch.arithmetic.fused)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) {
        if const { has_lanes(L::CPU) } {
            rounded::<L, L::Eight, _>(self.stretch.arithmetic.fused, self);
        } else {
            let length = self.stretch.length;
            self.stretch.first_ones::<B, W>(length);
        }
    }
}

impl<
    T: Real,
    B: Body<G, R, W>,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const A: usize,
    const W: usize,
> Rounded for StretchKernel<'_, T, B, G, R, C, S, A, W>
{
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<P: Pack>(self) {
        packs::<T, B, P, G, R, C, S, A, W>(self.stretch, self.is_followed);
    }
}
