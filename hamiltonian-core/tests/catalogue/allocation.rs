//! Nothing allocates in a step: counted, for every scheme, with sizes set at compile and at run
//! time, observed and not.

use crate::common::allocator::allocations;
use crate::common::systems::*;
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::Variational;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_compensated, visit_doubled, visit_energy, visit_implicit,
    visit_separable, visit_split, visit_unforced,
};
use hamiltonian_core::{Scheme, Vector};

struct NoAllocations<S>(S);

impl<S: System> Visitor<S> for NoAllocations<S> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let mut start = State {
            t: 0.0,
            q: self.0.zeros(),
            p: self.0.zeros(),
        };
        for i in 0..start.q.len() {
            *start.q.component_mut(i) = 0.1 + 0.01 * i as f64;
        }
        let name = scheme.entry().name;
        let new = || Integrator::new(&self.0, scheme.clone(), start.clone(), 0.01).unwrap();
        let mut run = new();
        let count = allocations(|| {
            run.advance(3000).unwrap();
            run.advance(1).unwrap();
            run.advance_to(run.time() + run.duration() * 10.0).unwrap();
        });
        assert_eq!(count, 0, "{name} on {}", self.0.description().name);
        let observers = (
            EnergyDrift::new(),
            every(10, (Monitors::new(), Recorder::with_capacity(101))),
        );
        let mut run = new().observe(observers);
        let count = allocations(|| {
            run.advance(1000).unwrap();
        });
        assert_eq!(
            count,
            0,
            "{name} on {}, observed",
            self.0.description().name
        );
        assert_eq!(run.observer().1.inner().1.rows(), 101);
    }
}

#[test]
fn no_step_allocates() {
    assert_eq!(
        allocations(|| drop(Vec::<u8>::with_capacity(1))),
        1,
        "the counter counts"
    );
    let mut chain = NoAllocations(Chain { n: 17 });
    visit_any::<_>(&mut chain);
    visit_unforced::<_>(&mut chain);
    visit_separable::<_>(&mut chain);
    visit_split::<_>(&mut chain);
    let mut pendulum = NoAllocations(pendulum(true));
    visit_any::<_>(&mut pendulum);
    visit_unforced::<_>(&mut pendulum);
    visit_separable::<_>(&mut pendulum);
    visit_split::<_>(&mut pendulum);
    visit_implicit::<_>(&mut pendulum);
    visit_energy::<_>(&mut pendulum);
    visit_doubled::<_>(&mut pendulum);
    visit_compensated::<_>(&mut pendulum);
    Visitor::<_>::visit(&mut chain, Variational::<1, 2>::lobatto());
}
