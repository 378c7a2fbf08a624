//! Members of ensembles need little stack of their caller, also in unoptimised code as these tests are.

use hamiltonian::Error;
use hamiltonian::prelude::*;

hamiltonian! {
    /// A planar pendulum.
    pub struct Swung { l = 1.0, g = 9.81 }
    H(theta; p) = p^2/(2*l^2) - g*l*cos(theta);
    event bottom = theta
}

/// Work on a thread with as much stack as the main thread has on Windows.
fn on_a_small_stack<A: Send + 'static>(work: impl FnOnce() -> A + Send + 'static) -> A {
    let thread = std::thread::Builder::new().stack_size(1 << 20);
    let thread = thread.spawn(work).expect("a thread");
    thread.join().expect("work that does not panic")
}

fn start(member: Member) -> (Swung, StateOf<Swung>) {
    let theta = 0.01 * (member.index + 1) as f64;
    (Swung::default(), State::new([theta], [0.0]))
}

#[test]
fn members_advance_on_one_thread_and_on_several() {
    for threads in [1, 2] {
        let ends = on_a_small_stack(move || -> Result<Vec<f64>, Error> {
            let swarm = Ensemble::new(100, start, StormerVerlet::default(), 0.01)?;
            let mut swarm = swarm.with_threads(threads).observe(|_| {
                let bottom = Event::named("bottom");
                (EnergyDrift::new(), Events::new([bottom]))
            });
            swarm.advance(200);
            assert!(
                swarm
                    .observers()
                    .all(|(_, events)| events.count("bottom") > 0)
            );
            swarm.states().map(|end| Ok(end?.q[0])).collect()
        });
        assert_eq!(ends.expect("members that do not fail").len(), 100);
    }
}

#[test]
fn sweeps_and_exponents_are_computed() -> Result<(), Error> {
    let rows = on_a_small_stack(|| {
        let sweep = Sweep::new(100, start, StormerVerlet::default(), 0.01).with_steps(200);
        let sweep = sweep
            .with_threads(1)
            .record(["theta"], |end| [end.state.q[0]]);
        sweep.fold(0, |rows, _| rows + 1)
    })?;
    assert_eq!(rows, 100);
    let exponents = on_a_small_stack(|| {
        let all = Lyapunov::new(20, start, StormerVerlet::default(), 0.01);
        all.with_steps(200).with_threads(1).collect()
    })?;
    assert_eq!(exponents.len(), 20);
    Ok(())
}
