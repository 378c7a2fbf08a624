//! Members of an ensemble, in the lanes of each level of this CPU, have the bits of single runs.

use hamiltonian::lanes::Cpu;
use hamiltonian::prelude::*;

hamiltonian! {
    /// A pendulum whose weight sways.
    pub struct Pendulum { l = 1.0, g = 1.0, a = 0.2 }
    H(q; p; t) = p^2/(2*l^2) - g*l*(1 + a*cos(3*t))*cos(q)
}

#[test]
fn members_have_the_bits_of_single_runs() {
    const COUNT: usize = 67;
    let make = |member: Member| {
        let at = member.index as f64 / COUNT as f64;
        let l = 1.0 + 0.3 * at;
        let system = Pendulum {
            l,
            ..Default::default()
        };
        (system, State::new([2.0 * at - 1.0], [0.4 - at]).at(at))
    };
    // No other test of this binary depends on the level of the process.
    for cpu in Cpu::available() {
        Cpu::limit_to(cpu);
        let scheme = StormerVerlet::default();
        let members = Ensemble::new(COUNT, make, scheme, 0.03125).expect("there are members");
        let mut members = members.reproducible().with_threads(2);
        members.advance(13);
        for (index, end) in members.states().enumerate() {
            let (system, start) = make(Member::new(index, 0));
            let run = Integrator::new(&system, scheme, start, 0.03125);
            let mut run = run.expect("a good start");
            let expected = run.advance(13).expect("finite");
            assert_eq!(&end.expect("finite"), expected, "{cpu:?}, member {index}");
        }
    }
    Cpu::limit_to(Cpu::Avx512);
}
