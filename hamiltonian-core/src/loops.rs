//! Loops over arrays: the iterations of an innermost loop, in lanes where the scalar has lanes.
//!
//! Input: the arithmetic of one iteration ([`Body`]), written by the macro, and a stretch of the loop in
//! which every element moves on by one ([`Stretch`]). Output: what the iterations store and sum. Invariant:
//! each element is added to in the order of the iterations and, within one, in the order of its stores;
//! sums of [`LONG`] iterations or more are [`STRIDE`] partial sums and a tree, whatever the scalar. So a
//! result does not depend on whether, or on which CPU, iterations went through lanes.

mod waiting;

use hamiltonian_lanes::{Kernel, Level, Nf, Pack, Real, dispatch};
use waiting::{NONE, Waiting};

/// The least extent of a loop whose sums are partial sums, and whose iterations may go through lanes.
pub const LONG: usize = 32;

/// The number of partial sums: iteration k of a loop adds to sum k mod 8.
pub const STRIDE: usize = 8;

/// The most iterations whose results wait for the order in which elements are changed.
const BLOCK: usize = 128;

/// The largest distance of elements of a column that an iteration changes at once.
const REACH: usize = 32;

/// The number of results that are kept from the block before: as far as stores reach, and what did not
/// fill a pack.
const CARRY: usize = REACH + STRIDE;

/// How an element is changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// `= a`
    Set,
    /// `+= a`
    Add,
    /// `−= a`
    Sub,
    /// `+= a·b`, fused where the scalar fuses
    AddProduct,
    /// `−= a·b`, fused where the scalar fuses
    SubProduct,
}

/// A store of an iteration.
#[derive(Debug, Clone, Copy)]
pub struct Store {
    /// The number of the column that is written.
    column: usize,
    /// How its element is changed.
    change: Change,
    /// The results that change it: `a` and, for a product, `b`.
    by: [usize; 2],
    /// Whether another store of the iteration reaches other elements of the column.
    is_shared: bool,
}

impl Store {
    /// The only store to a column.
    #[must_use]
    pub const fn to(column: usize, change: Change, by: [usize; 2]) -> Store {
        Store {
            column,
            change,
            by,
            is_shared: false,
        }
    }
    /// One of the stores to several elements of a column.
    #[must_use]
    pub const fn among(column: usize, change: Change, by: [usize; 2]) -> Store {
        Store {
            column,
            change,
            by,
            is_shared: true,
        }
    }
}

/// The arithmetic of one iteration: of `G` numbers that are the same in all of them, `R` elements that are
/// read, and the number of the iteration where it counts as a real.
pub trait Body<const G: usize, const R: usize, const W: usize> {
    /// Whether the number of the iteration is read.
    const COUNTS: bool = false;
    /// The stores, in order.
    const STORES: &'static [Store] = &[];
    /// The sums that results are added to, in order: number of the sum, number of the result.
    const SUMS: &'static [(usize, usize)] = &[];

    /// The results.
    fn compute<T: Real>(given: [T; G], read: [T; R], number: T) -> [T; W];
}

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
    pub starts: [usize; S],
    /// The partial sums.
    pub sums: &'a mut [[T; STRIDE]; A],
}

/// The sum of partial sums, as a tree: ((0+4)+(2+6)) + ((1+5)+(3+7)).
#[inline(always)]
#[must_use]
pub fn total<T: Real>(s: &[T; STRIDE]) -> T {
    ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]))
}

impl<T: Real, const G: usize, const R: usize, const C: usize, const S: usize, const A: usize>
    Stretch<'_, T, G, R, C, S, A>
{
    /// Runs the iterations of a loop of at least [`LONG`] ones.
    #[inline(always)]
    pub fn run<B: Body<G, R, W>, const W: usize>(self, _: B) {
        if T::WIDENS && self.length >= STRIDE {
            self.in_lanes::<B, W>();
        } else {
            self.one_by_one::<B, W>();
        }
    }

    /// The iterations through lanes; until their partial sums begin with the first, one by one.
    #[inline(never)]
    fn in_lanes<B: Body<G, R, W>, const W: usize>(mut self) {
        let late = self.first % STRIDE;
        if !B::SUMS.is_empty() && late != 0 {
            let count = self.length.min(STRIDE - late);
            let mut starts = self.starts;
            starts.iter_mut().for_each(|start| *start += count);
            let reads = self.reads.map(|read| &read[count..]);
            Stretch {
                length: count,
                columns: self.columns.each_mut().map(|column| &mut **column),
                sums: &mut *self.sums,
                ..self
            }
            .one_by_one::<B, W>();
            self.length -= count;
            self.first += count;
            self.number += count;
            self.reads = reads;
            self.starts = starts;
        }
        dispatch(InLanes::<_, B, G, R, C, S, A, W>(
            self,
            core::marker::PhantomData,
        ));
    }

    #[inline(always)]
    fn one_by_one<B: Body<G, R, W>, const W: usize>(self) {
        let Stretch {
            length,
            first,
            number,
            given,
            reads,
            columns,
            starts,
            sums,
        } = self;
        for k in 0..length {
            let mut read = [T::zero(); R];
            let mut r = 0;
            while r < R {
                read[r] = reads[r][k];
                r += 1;
            }
            let number = match B::COUNTS {
                true => T::constant((number + k) as f64, 0.0),
                false => T::zero(),
            };
            let out = B::compute(given, read, number);
            let mut s = 0;
            while s < B::STORES.len() {
                let store = &B::STORES[s];
                let place = &mut columns[store.column][starts[s] + k];
                *place = changed(store.change, *place, store.by.map(|by| out[by]));
                s += 1;
            }
            let mut s = 0;
            while s < B::SUMS.len() {
                let (sum, by) = B::SUMS[s];
                sums[sum][(first + k) % STRIDE] += out[by];
                s += 1;
            }
        }
    }
}

/// An element after a store.
#[inline(always)]
fn changed<T: Real>(change: Change, place: T, [a, b]: [T; 2]) -> T {
    match change {
        Change::Set => a,
        Change::Add => place + a,
        Change::Sub => place - a,
        Change::AddProduct => a.fma(b, place),
        Change::SubProduct => (-a).fma(b, place),
    }
}

/// The way into a level.
struct InLanes<
    'a,
    T,
    B,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const A: usize,
    const W: usize,
>(Stretch<'a, T, G, R, C, S, A>, core::marker::PhantomData<B>);

impl<
    T: Real,
    B: Body<G, R, W>,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const A: usize,
    const W: usize,
> Kernel for InLanes<'_, T, B, G, R, C, S, A, W>
{
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        packs::<T, B, Nf<L::Eight>, G, R, C, S, A, W>(self.0);
    }
}

/// At least [`STRIDE`] iterations in packs of as many; with sums, the last pack has as many as are left.
#[inline(always)]
fn packs<
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
) {
    let Stretch {
        length,
        number,
        given,
        mut reads,
        mut columns,
        starts,
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
        reads[r] = &reads[r][..length];
        r += 1;
    }
    let mut is_cut = [false; C];
    let mut s = 0;
    while s < B::STORES.len() {
        let store = &B::STORES[s];
        if !store.is_shared && !is_cut[store.column] {
            let column = core::mem::take(&mut columns[store.column]);
            columns[store.column] = &mut column[starts[s]..starts[s] + length];
            is_cut[store.column] = true;
        }
        s += 1;
    }
    let has_shared = const { has_shared(B::STORES) };
    let mut waiting = Waiting::<T, S, W>::new(B::STORES, starts, length);
    let does_wait = has_shared && waiting.is_any();
    let block = if does_wait { BLOCK } else { length };
    let mut at = 0;
    while at < length {
        let end = at + block.min(length - at);
        let mut k = at;
        // `lanes` iterations from `k` on; a direct store puts `value` in the place of the element `old`.
        macro_rules! iterate {
            ($lanes:expr, |$old:ident, $new:ident| $value:expr) => {{
                let lanes = $lanes;
                let mut read = [T::Over::<P>::default(); R];
                let mut r = 0;
                while r < R {
                    read[r] = T::gather::<P>(&reads[r][k..k + lanes]);
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
                        let place = if store.is_shared { starts[s] + k } else { k };
                        let places = &mut columns[store.column][place..place + lanes];
                        let $old = T::gather::<P>(places);
                        let by = [out[store.by[0]], out[store.by[1]]];
                        let $new = changed(store.change, $old, by);
                        T::scatter::<P>($value, places);
                    }
                    s += 1;
                }
                out
            }};
        }
        while k + STRIDE <= end {
            let out = iterate!(STRIDE, |_old, new| new);
            let mut s = 0;
            while s < B::SUMS.len() {
                let (sum, by) = B::SUMS[s];
                totals[sum] += out[by];
                s += 1;
            }
            k += STRIDE;
        }
        if k < end && B::SUMS.is_empty() {
            // The last iterations fill a pack with some before them, whose results are known: those wait
            // again, and elements keep what they have.
            let again = STRIDE - (end - k);
            k = end - STRIDE;
            let again = T::constant(again as f64, 0.0).spread::<P>();
            let is_known = ramp::<T, P>(0).lt(again);
            iterate!(STRIDE, |old, new| T::Over::<P>::select(is_known, old, new));
        } else if k < end {
            let out = iterate!(end - k, |_old, new| new);
            let mut s = 0;
            while s < B::SUMS.len() {
                let (sum, by) = B::SUMS[s];
                totals[sum] = add_first::<T, P>(totals[sum], out[by], end - k);
                s += 1;
            }
        }
        if does_wait {
            waiting.settle::<P, C>(B::STORES, &mut columns, at, end, end == length);
        }
        at = end;
    }
    let mut a = 0;
    while a < A {
        T::scatter::<P>(totals[a], &mut sums[a]);
        a += 1;
    }
}

/// Whether results of any store wait.
const fn has_shared(stores: &[Store]) -> bool {
    let mut s = 0;
    while s < stores.len() {
        if stores[s].is_shared {
            return true;
        }
        s += 1;
    }
    false
}

/// A sum in the first lanes; the others stay.
#[inline(always)]
fn add_first<T: Real, P: Pack>(to: T::Over<P>, term: T::Over<P>, lanes: usize) -> T::Over<P> {
    let (mut sums, mut terms) = ([T::zero(); STRIDE], [T::zero(); STRIDE]);
    T::scatter::<P>(to, &mut sums);
    T::scatter::<P>(term, &mut terms);
    for (sum, term) in sums.iter_mut().zip(terms).take(lanes) {
        *sum += term;
    }
    T::gather::<P>(&sums)
}

/// Successive numbers of iterations.
#[inline(always)]
fn ramp<T: Real, P: Pack>(first: usize) -> T::Over<P> {
    let mut numbers = [T::zero(); STRIDE];
    let mut k = 0;
    while k < STRIDE {
        numbers[k] = T::constant((first + k) as f64, 0.0);
        k += 1;
    }
    T::gather::<P>(&numbers)
}
