//! Repeatable numbers (SplitMix64).

/// The state of the sequence.
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// From 0 up to `limit`, which is left out.
    pub fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit
    }
    /// Between `low` and `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The number of random cases: a part, or with `HAMILTONIAN_HEAVY=1` all.
pub fn cases(part: u64, all: u64) -> u64 {
    let is_heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    if is_heavy { all } else { part }
}
