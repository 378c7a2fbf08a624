//! Two modules that the tests of the facade share.

#[path = "../../../tests/common/bits.rs"]
pub mod bits;
#[path = "../../../tests/common/derivatives.rs"]
pub mod derivatives;

use hamiltonian::lanes::Cpu;

/// All levels of this CPU.
pub fn levels() -> Vec<Cpu> {
    Cpu::available().collect()
}
