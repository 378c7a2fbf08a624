//! Nests of loops, which enter the level of the CPU once for all iterations.
//!
//! Input: a nest of loops over rows ([`Nest`]), written by the macro. Output: the stored elements. Invariant: the rows
//! are computed in order, each as by [`Stretch::run`].

use super::packs::packs;
use super::{Body, Mode, STRIDE, Stretch};
use crate::systems::compiled::{self, Rounded, has_lanes, rounded};
use crate::systems::system::Arithmetic;
use hamiltonian_lanes::{Cpu, Kernel, Level, Pack, Real, dispatch};

/// A nest of loops with `G` loop-invariant numbers, `R` columns to read, `C` columns to write, and `Z` sizes.
pub trait Nest<T: Real, const G: usize, const R: usize, const C: usize, const Z: usize> {
    /// Computes all iterations.
    fn run<M: Mode>(
        given: [T; G],
        reads: [&[T]; R],
        columns: [&mut [T]; C],
        sizes: [usize; Z],
        arithmetic: Arithmetic,
    );
}

/// One iteration after the other.
struct OneByOne;

impl Mode for OneByOne {
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
        let length = stretch.length;
        stretch.one_by_one::<B, W>(length);
    }
}

/// Iterations in packs.
struct In<P>(core::marker::PhantomData<P>);

impl<P: Pack> Mode for In<P> {
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
        mut stretch: Stretch<'_, T, G, R, C, S, A>,
    ) {
        let before = stretch.before::<B, W>();
        if before > 0 {
            stretch.reborrow().first_ones::<B, W>(before);
            stretch.skip::<B, W>(before);
        }
        if stretch.length >= STRIDE {
            packs::<T, B, P, G, R, C, S, A, W>(stretch, false);
        }
    }
}

/// Computes all iterations of a nest, in lanes if `is_long`.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn nest<
    T: Real,
    N: Nest<T, G, R, C, Z>,
    const G: usize,
    const R: usize,
    const C: usize,
    const Z: usize,
>(
    _: N,
    is_long: bool,
    given: [T; G],
    reads: [&[T]; R],
    columns: [&mut [T]; C],
    sizes: [usize; Z],
    arithmetic: Arithmetic,
) {
    let mut columns = columns;
    if T::WIDENS && arithmetic.lanes && is_long {
        let kernel = NestKernel::<T, N, G, R, C, Z> {
            given,
            reads,
            columns,
            sizes,
            arithmetic,
            nest: core::marker::PhantomData,
        };
        columns = match dispatch(kernel) {
            Some(columns) => columns,
            None => return,
        };
    }
    N::run::<OneByOne>(given, reads, columns, sizes, arithmetic);
}

/// A nest as a kernel that enters a level, and returns the columns on levels without lanes.
struct NestKernel<'a, T, N, const G: usize, const R: usize, const C: usize, const Z: usize> {
    given: [T; G],
    reads: [&'a [T]; R],
    columns: [&'a mut [T]; C],
    sizes: [usize; Z],
    arithmetic: Arithmetic,
    nest: core::marker::PhantomData<N>,
}

impl<
    'a,
    T: Real,
    N: Nest<T, G, R, C, Z>,
    const G: usize,
    const R: usize,
    const C: usize,
    const Z: usize,
> Kernel for NestKernel<'a, T, N, G, R, C, Z>
{
    type Output = Option<[&'a mut [T]; C]>;
    const BEST: Cpu = compiled::BEST;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn best(&self) -> Cpu {
        compiled::best(self.arithmetic.fused)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> Self::Output {
        if const { has_lanes(L::CPU) } {
            rounded::<L, L::Eight, _>(self.arithmetic.fused, self);
            None
        } else {
            Some(self.columns)
        }
    }
}

impl<
    T: Real,
    N: Nest<T, G, R, C, Z>,
    const G: usize,
    const R: usize,
    const C: usize,
    const Z: usize,
> Rounded for NestKernel<'_, T, N, G, R, C, Z>
{
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<P: Pack>(self) {
        let NestKernel {
            given,
            reads,
            columns,
            sizes,
            arithmetic,
            ..
        } = self;
        N::run::<In<P>>(given, reads, columns, sizes, arithmetic);
    }
}
