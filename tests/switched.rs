//! Loops of a run with and without lanes, and with fused products there.

use crate::arrays::Gravity;
use crate::common::bits::LEVEL;
use hamiltonian::prelude::*;
use hamiltonian::{Scheme, Vector};
use hamiltonian_lanes::Cpu;
use std::sync::PoisonError;

hamiltonian! {
    /// Sites with two neighbours, a sum that all sites share, and numbers of sites.
    pub struct Sites { n: usize, c = 0.75 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n])/(i + 1) }
        + c*sum(i in 0..n) { q[i] }^2/n
}

/// The bits of the end of a run.
fn end<S, M>(system: &S, scheme: M, lanes: bool, fused: bool) -> Vec<u64>
where
    S: System,
    M: Scheme<S>,
{
    let zeros = system.zeros();
    let mut start = State {
        q: zeros.clone(),
        p: zeros,
        t: 0.0,
    };
    for k in 0..start.q.len() {
        *start.q.component_mut(k) = (k as f64).sin();
        *start.p.component_mut(k) = (k as f64 + 0.5).cos();
    }
    let mut run = Integrator::new(system, scheme, start, 0.01)
        .unwrap()
        .with_lanes(lanes);
    if fused {
        run = run.fused();
    }
    run.advance(3).unwrap();
    let end = run.state();
    let all = end.q.components().chain(end.p.components());
    all.map(f64::to_bits).collect()
}

#[test]
fn lanes_change_no_bit_and_fused_products_do() {
    let _shown = LEVEL.read().unwrap_or_else(PoisonError::into_inner);
    for n in [1, 31, 32, 33, 40, 95, 96, 97, 101] {
        let sites = Sites::new(n).unwrap();
        let run = |lanes, fused| end(&sites, StormerVerlet::default(), lanes, fused);
        assert_eq!(run(true, false), run(false, false), "{n} sites");
        // Without lanes there is nothing to fuse in. What fuses here are sums and products, a few in an iteration: such
        // loops enter lanes from 96 iterations on.
        assert_eq!(run(false, true), run(false, false), "{n} sites");
        let fuses = matches!(Cpu::best(), Cpu::Avx2 | Cpu::Avx512 | Cpu::Neon);
        let differ = run(true, true) != run(true, false);
        assert_eq!(differ, fuses && n >= 96, "{n} sites");
    }
    let bodies = Gravity::new(40, vec![1.0 / 40.0; 40]).unwrap();
    let run = |lanes, fused| end(&bodies, Gauss::<2>::default(), lanes, fused);
    assert_eq!(run(true, false), run(false, false));
}
