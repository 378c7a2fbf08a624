//! Modules that tests share, without those that are not needed here.

#[path = "../common/bits.rs"]
pub mod bits;
#[path = "../common/derivatives.rs"]
pub mod derivatives;

use hamiltonian::lanes::Cpu;

/// All levels of this CPU.
pub fn levels() -> Vec<Cpu> {
    Cpu::available().collect()
}
