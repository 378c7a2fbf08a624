//! An innermost loop as data: its segments, in lanes or one iteration after the other.
//!
//! Input: a loop whose elements move on by one with it, some of them in rings ([`Loop`]), written by the macro. Output:
//! the stored elements and the sums. Invariant: within a segment no element passes the end of its ring. Sums of a short
//! loop are added to in the order of the iterations, those of a long one are partial sums and a tree.
//!
//! # Example: a ring of N springs
//! Iteration i of `sum(i in 0..N) { (q[(i + 1) % N] - q[i])^2/2 }` reads `q[i]` and `q[(i + 1) % N]`. The second one moves
//! in a ring of N elements and is at 1 in iteration 0. The first segment has N − 1 iterations, in which it moves on to
//! N − 1. The second one has the last iteration, in which it is at 0.

use super::{Body, LONG, STRIDE, Stretch, reborrowed, store_of, total, wrapped};
use crate::systems::system::Arithmetic;
use hamiltonian_lanes::Real;

/// An innermost loop.
#[derive(Debug)]
pub struct Loop<
    'a,
    T,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const V: usize,
    const A: usize,
> {
    /// The number of iterations.
    pub length: usize,
    /// The loop variable in the first iteration.
    pub number: usize,
    /// The numbers that do not vary.
    pub given: [T; G],
    /// The columns that are read, each with the place of the first iteration's element; in a ring, with the place of
    /// the ring's first element. No column for the elements that iterations change themselves.
    pub reads: [(&'a [T], usize); R],
    /// The columns that are written.
    pub columns: [&'a mut [T]; C],
    /// For each store such a place in its column.
    pub offsets: [usize; S],
    /// For each ring the place in it of the first iteration's element, and its number of elements.
    pub rings: [[usize; 2]; V],
    /// The sums before.
    pub sums: [T; A],
    /// The arithmetic.
    pub arithmetic: Arithmetic,
}

/// The way in which the stretches of a loop are computed.
pub trait Mode {
    /// True if each stretch enters the level by itself.
    const ENTERS: bool = false;
    /// Computes the iterations of a stretch.
    fn run<
        T: Real,
        B: Body<G, R, W>,
        const G: usize,
        const R: usize,
        const C: usize,
        const S: usize,
        const A: usize,
        const W: usize,
    >(
        stretch: Stretch<'_, T, G, R, C, S, A>,
    );
    /// Computes the iterations of a loop; returns its sums.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run_all<
        T: Real,
        B: Body<G, R, W>,
        const G: usize,
        const R: usize,
        const C: usize,
        const S: usize,
        const V: usize,
        const A: usize,
        const W: usize,
    >(
        of: Loop<'_, T, G, R, C, S, V, A>,
        _: B,
    ) -> [T; A]
    where
        Self: Sized,
    {
        of.run_as::<Self, B, W>()
    }
}

/// Each stretch enters the level by itself.
struct Entering;

impl Mode for Entering {
    const ENTERS: bool = true;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<
        T: Real,
        B: Body<G, R, W>,
        const G: usize,
        const R: usize,
        const C: usize,
        const S: usize,
        const A: usize,
        const W: usize,
    >(
        stretch: Stretch<'_, T, G, R, C, S, A>,
    ) {
        stretch.run::<B, W>();
    }
}

impl<
    T: Real,
    const G: usize,
    const R: usize,
    const C: usize,
    const S: usize,
    const V: usize,
    const A: usize,
> Loop<'_, T, G, R, C, S, V, A>
{
    /// Runs all iterations; returns the sums.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn run<B: Body<G, R, W>, const W: usize>(self, _: B) -> [T; A] {
        self.run_as::<Entering, B, W>()
    }

    /// Runs all iterations as long ones, whatever their number; returns the sums.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn run_long<B: Body<G, R, W>, const W: usize>(self, _: B) -> [T; A] {
        self.segments::<Entering, B, W>(true)
    }

    /// Runs all iterations one after the other; returns the sums.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn run_short<B: Body<G, R, W>, const W: usize>(self, _: B) -> [T; A] {
        self.segments::<Entering, B, W>(false)
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn run_as<M: Mode, B: Body<G, R, W>, const W: usize>(self) -> [T; A] {
        let least = if M::ENTERS { B::LEAST } else { LONG };
        let is_long = match B::SUMS.is_empty() {
            true => T::WIDENS && self.length >= least,
            false => self.length >= LONG,
        };
        self.segments::<M, B, W>(is_long)
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn segments<M: Mode, B: Body<G, R, W>, const W: usize>(mut self, is_long: bool) -> [T; A] {
        let mut trees = [[T::zero(); STRIDE]; A];
        let mut done = 0;
        while done < self.length {
            let mut length = self.length - done;
            let mut places = [0; V];
            let mut v = 0;
            while v < V {
                let [first, extent] = self.rings[v];
                places[v] = wrapped(first + done, extent);
                length = length.min(extent - places[v]);
                v += 1;
            }
            let mut reads = [&[][..]; R];
            let mut starts = [done; R];
            let mut k = 0;
            while k < B::RINGS.len() {
                let (read, ring) = B::RINGS[k];
                starts[read] = places[ring];
                k += 1;
            }
            let mut r = 0;
            while r < R {
                if store_of(B::OWN, r).is_none() {
                    let (column, first) = self.reads[r];
                    reads[r] = &column[first + starts[r]..][..length];
                }
                r += 1;
            }
            let mut offsets = self.offsets;
            let mut s = 0;
            while s < S {
                offsets[s] += match B::STORES[s].ring {
                    Some(ring) => places[ring],
                    None => done,
                };
                s += 1;
            }
            let stretch = Stretch {
                length,
                first: done,
                number: self.number + done,
                given: self.given,
                reads,
                columns: reborrowed(&mut self.columns),
                offsets,
                sums: &mut trees,
                arithmetic: self.arithmetic,
            };
            if is_long && (V == 0 || A > 0 || length >= STRIDE) {
                M::run::<T, B, G, R, C, S, A, W>(stretch);
            } else {
                stretch.in_order::<B, W>(&mut self.sums);
            }
            done += length;
        }
        let mut a = 0;
        while is_long && a < A {
            self.sums[a] += total(&trees[a]);
            a += 1;
        }
        self.sums
    }
}
