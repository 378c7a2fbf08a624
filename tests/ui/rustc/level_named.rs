use hamiltonian::lanes::{AtHand, Cpu, Kernel, Level};

struct Which;

impl Kernel for Which {
    type Output = Cpu;
    fn run<L: Level>(self) -> Cpu {
        L::CPU
    }
}

fn main() {
    // Each CPU has this level. A program cannot name others, which its CPU may not have.
    AtHand::enter(Which);
    hamiltonian::lanes::Avx2::enter(Which);
    hamiltonian::lanes::Avx512::enter(Which);
}
