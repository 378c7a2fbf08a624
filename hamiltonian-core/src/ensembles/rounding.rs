//! How the members of an ensemble round products and sums, as a type.
//!
//! Input: nothing. Output: [`Fused`], [`Unfused`]. Invariant: a program contains the code of a level only for the
//! rounding of the ensembles that it advances.

/// The rounding of members: [`Fused`] or [`Unfused`].
pub trait Rounding: sealed::SealedRounding + Send + Sync + 'static {
    /// True if a product and a sum are rounded together.
    #[doc(hidden)]
    const FUSES: bool;
}

/// Products and sums are fused if the CPU has such instructions. This is the default of ensembles.
#[derive(Debug)]
pub enum Fused {}

/// Products and sums are rounded apart: members have the bits of single runs on every CPU. It is chosen by
/// `reproducible`.
#[derive(Debug)]
pub enum Unfused {}

impl Rounding for Fused {
    const FUSES: bool = true;
}
impl Rounding for Unfused {
    const FUSES: bool = false;
}

mod sealed {
    pub trait SealedRounding {}
    impl SealedRounding for super::Fused {}
    impl SealedRounding for super::Unfused {}
}
