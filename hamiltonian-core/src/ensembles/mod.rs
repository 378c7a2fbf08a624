//! Ensembles: many members of one system and scheme, which advance together in the lanes of packs.
//!
//! Input: a system and a start for each index. Output: [`Ensemble`], whose members stay in memory, and
//! [`Sweep`], which keeps a record of each. Invariant: the bits of a member depend on neither the thread
//! count nor its lane, its chunk or the other members.
//!
//! The modules follow the data:
//!
//! - [`host`]: the run of a member, and its owner; [`occupants`]: the members in the lanes of a pack;
//!   [`block`]: a block of steps;
//! - [`marks`], [`close`]: the steps whose states observers of signs require;
//! - [`rounding`]: whether products and sums are fused, as a type;
//! - [`drive`]: the integration of members to their ends, in lanes of any pack; [`bound`]: the pack of each level;
//! - [`chunk`], [`in_memory`], [`to_time`], [`until`], [`saved`]: members in memory;
//! - [`sweep`], `sweep::host`, [`record`], [`collected`], `stored`: members that are run to their ends and recorded;
//! - [`lyapunov`], `drive::deviations`: indicators of chaos of members.

mod block;
mod bound;
mod change;
mod chunk;
mod close;
mod drive;
mod guard;
mod host;
mod marks;
mod occupants;
mod ordered;
mod record;
mod rounding;
mod threads;

// The documentation shows the methods in the order of these modules.
mod in_memory;

mod to_time;
mod until;

mod saved;

mod sweep;

mod collected;
#[cfg(feature = "std")]
mod stored;

mod lyapunov;

pub use in_memory::Ensemble;
pub use lyapunov::Lyapunov;
pub use record::{End, Record, Row, Status};
pub use rounding::{Fused, Rounding, Unfused};
pub use sweep::Sweep;

use crate::errors::Error;
use crate::systems::state::State;
use crate::systems::system::VectorOf;
use alloc::boxed::Box;

/// A member of an ensemble: its index and its seed, from which its system and its start are made.
///
/// ```
/// use hamiltonian::prelude::*;
/// let member = Member::new(7, 42);
/// assert_eq!(member.index, 7);
/// // The same index and the same seed of the ensemble give the same number, on every machine.
/// assert_eq!(member.seed, Member::new(7, 42).seed);
/// assert_ne!(member.seed, Member::new(8, 42).seed);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Member {
    /// Its index, from 0.
    pub index: usize,
    /// A seed for random number generators. It depends only on the index and on the seed of
    /// [`Sweep::with_seed`](crate::Sweep::with_seed), which is 0 by default and in an [`Ensemble`].
    pub seed: u64,
}

impl Member {
    /// Returns member `index` of an ensemble with the seed `seed`.
    ///
    /// The seed of a member is number `index` of the SplitMix64 sequence whose state is the first number of
    /// the sequence of `seed` (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014, 453, doi:10.1145/2660193.2660195).
    pub fn new(index: usize, seed: u64) -> Self {
        let state = mixed(seed.wrapping_add(GAMMA));
        let seed = mixed(state.wrapping_add(GAMMA.wrapping_mul((index as u64).wrapping_add(1))));
        Member { index, seed }
    }
}

/// Makes the system and the start of a member.
type MakeMember<'a, S> =
    Box<dyn Fn(Member) -> Result<(S, State<VectorOf<S>>), Error> + Send + Sync + 'a>;

/// The odd number nearest to 2⁶⁴ divided by the golden ratio.
const GAMMA: u64 = 0x9e37_79b9_7f4a_7c15;

/// The finalizer of SplitMix64.
fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
