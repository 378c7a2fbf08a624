//! Hashes that identify the members of a store.
//!
//! Input: a member's system, start and step. Output: 64 bits. Invariant: equal on every machine.

use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use core::fmt::Write;

/// FNV-1a over 64 bits (G. Fowler, L. C. Noll, K.-P. Vo; RFC 9923).
pub(crate) struct Hash(pub(crate) u64);

impl Hash {
    pub(crate) fn new() -> Self {
        Hash(0xcbf2_9ce4_8422_2325)
    }
    pub(crate) fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}

/// Returns a hash of a member's parameters, start and step. A handwritten system may have parameters without
/// describing them: if none are described, its prepared form is hashed in full.
pub(crate) fn hash_of<S: System>(system: &S, start: &State<VectorOf<S>>, step: f64) -> u64 {
    let mut hash = Hash::new();
    // Writing to a hash does not fail.
    let _ = system.describe_parameters(&mut hash);
    if hash.0 == Hash::new().0 {
        let _ = write!(hash, "{:?}", system.prepare::<f64>());
    }
    hash.word(start.t.to_bits());
    for number in start.q.components().chain(start.p.components()) {
        hash.word(number.to_bits());
    }
    hash.word(step.to_bits());
    hash.0
}
