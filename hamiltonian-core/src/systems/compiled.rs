//! Packs as the crate is compiled.
//!
//! Input: a pack, and whether this crate is optimised (`build.rs`). Output: [`Compiled`]. Invariant: the bits are those of
//! the pack.

// By calls in code that is not optimised.
#[cfg(unoptimised)]
pub(crate) use hamiltonian_lanes::Called as Compiled;

/// The pack in loops: in optimised code, itself.
#[cfg(not(unoptimised))]
pub(crate) type Compiled<P> = P;
