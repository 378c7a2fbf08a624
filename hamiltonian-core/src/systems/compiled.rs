//! Packs and levels as the crate is compiled.
//!
//! Input: a pack, work in lanes, and whether this crate is optimised (`build.rs`). Output: [`Compiled`], and the levels and
//! packs that the work is compiled for. Invariant: the bits are those of the pack, on each level.
//!
//! Optimised code has a copy of a loop for each level and rounding: AVX-512 and AVX2, fused and not. In code that is not
//! optimised they would be most of a program, and gain nothing. There a loop has two: fused products on AVX2, and products
//! that do not fuse on SSE2.

use hamiltonian_lanes::{Base, Cpu, Level, Nf, Pack};

// By calls in code that is not optimised.
#[cfg(unoptimised)]
pub(crate) use hamiltonian_lanes::Called as Compiled;

/// The pack in loops: in optimised code, itself.
#[cfg(not(unoptimised))]
pub(crate) type Compiled<P> = P;

/// The best level that loops are compiled for.
pub(crate) const BEST: Cpu = match cfg!(unoptimised) {
    true => Cpu::Avx2,
    false => Cpu::Avx512,
};

/// The best level that loops run on.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn best(fused: bool) -> Cpu {
    match cfg!(unoptimised) && !fused {
        true => Cpu::Sse2,
        false => BEST,
    }
}

/// Returns true if loops have a form in lanes on a level. In optimised code, two lanes without fused products gain too
/// little for a copy of each loop: iterations go one by one.
pub(crate) const fn has_lanes(cpu: Cpu) -> bool {
    cfg!(unoptimised) || cpu as u8 >= Cpu::Neon as u8
}

/// Work in packs, which are chosen by the rounding of products.
pub(crate) trait Rounded {
    /// Computes it.
    fn run<P: Pack>(self);
}

/// Computes work whose level is at most [`best`], in the packs of its rounding.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn rounded<L: Level, P: Base, K: Rounded>(fused: bool, work: K) {
    if const { cfg!(unoptimised) && L::FUSES } {
        work.run::<Compiled<P>>();
    } else if const { cfg!(unoptimised) } || !fused {
        work.run::<Compiled<Nf<P>>>();
    } else {
        work.run::<Compiled<P>>();
    }
}
