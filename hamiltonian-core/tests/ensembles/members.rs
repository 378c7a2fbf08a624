//! Members are single runs, bit by bit.

use super::*;
use hamiltonian::errors::{StartError, StepError, SweepError};
use hamiltonian::schemes::{SecondPoint, Tao, TwoStepMidpoint};

/// Members of a reproducible ensemble, advanced in two calls on two threads, have the bits of single runs, on each level.
pub(super) fn agrees<S, M>(make: impl Fn(Member) -> (S, StateOf<S>), scheme: M)
where
    S: System,
    M: Scheme<S>,
{
    let name = hamiltonian::schemes::author::Listed::entry(&scheme).to_string();
    let h = 0.03125;
    let alone = |index| {
        let (system, start) = make(Member::new(index, 0));
        let mut run = Integrator::new(&system, scheme.clone(), start, h).expect("a good start");
        run.advance(13).expect("finite").clone()
    };
    let expected: Vec<_> = (0..COUNT).map(alone).collect();
    at_each_level(|cpu| {
        let mut swarm = Ensemble::new(COUNT, &make, scheme.clone(), h)
            .expect("there are members")
            .reproducible()
            .with_threads(2);
        swarm.advance(7).advance(6);
        assert_eq!(swarm.states().count(), COUNT);
        for (index, (found, expected)) in swarm.states().zip(&expected).enumerate() {
            let found = found.expect("finite");
            assert_eq!(
                bits(&found),
                bits(expected),
                "{name} on {cpu:?}, member {index}: {found:?} {expected:?}"
            );
        }
    });
}

#[test]
fn members_have_the_bits_of_single_runs() {
    // `benches/catalogue.rs` does the same with every scheme.
    agrees(pendulum, StormerVerlet::default());
    agrees(pendulum, ImplicitMidpoint::default());
    agrees(henon_heiles, Gauss::<2>::default());
    agrees(mixture, Tao::default());
    agrees(
        mixture,
        TwoStepMidpoint::default().with_second_point(SecondPoint::SecondOrder),
    );
    agrees(chain, StormerVerlet::default());
}

#[test]
fn neither_threads_nor_calls_nor_neighbours_change_a_bit() {
    at_each_level(|cpu| {
        let ends = |count, threads, calls: &[u64]| {
            let mut swarm = Ensemble::new(count, pendulum, StormerVerlet::default(), 0.1)
                .expect("there are members")
                .with_threads(threads);
            for n in calls {
                swarm.advance(*n);
            }
            let ends = swarm.states().map(|end| bits(&end.expect("finite")));
            ends.collect::<Vec<_>>()
        };
        let all = ends(COUNT, 1, &[1500]);
        assert_eq!(all, ends(COUNT, 2, &[700, 1, 799]), "{cpu:?}");
        assert_eq!(all[..3], ends(3, 1, &[1500]), "{cpu:?}");
        let swarm = Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.1)
            .expect("there are members");
        let mut other = swarm.clone();
        other.advance(1500);
        let one = other.state_of(77).expect("there is one").expect("finite");
        assert_eq!(all[77], bits(&one));
        assert_eq!(swarm.steps(), 0, "the clone is another ensemble");
    });
}

#[test]
fn a_failing_member_says_where_and_disturbs_nobody() {
    let holes = |member: Member| {
        // Every seventh falls into the hole; one starts outside of it.
        let q = match member.index {
            11 => -1.0,
            index if index % 7 == 0 => 0.5 + 0.1 * part(index),
            _ => 100.0,
        };
        (Hole::default(), State::new([q], [0.0]))
    };
    let alone = |index| {
        let (system, start) = holes(Member::new(index, 0));
        Integrator::new(&system, StormerVerlet::default(), start, 0.01)
            .and_then(|mut run| run.advance(1800).cloned())
    };
    let singles: Vec<_> = (0..COUNT).map(alone).collect();
    at_each_level(|_| {
        let swarm = || {
            Ensemble::new(COUNT, holes, StormerVerlet::default(), 0.01).expect("there are members")
        };
        fail_alone(swarm(), &singles, false);
        fail_alone(swarm().reproducible(), &singles, true);
    });
}

fn fail_alone<A: hamiltonian::Rounding>(
    mut swarm: Ensemble<Hole, StormerVerlet, (), A>,
    singles: &[Result<StateOf<Hole>, Error>],
    is_exact: bool,
) {
    swarm.advance(900).advance(900);
    let mut failed = 0;
    assert_eq!(swarm.states().count(), singles.len());
    for (index, (single, end)) in singles.iter().zip(swarm.states()).enumerate() {
        match (single, end) {
            (Ok(expected), Ok(found)) => {
                assert!((found.q[0] - expected.q[0]).abs() < 1e-10);
                assert_eq!(swarm.steps_of(index), Some(1800));
            }
            (
                Err(expected),
                Err(Error::Sweep(SweepError::Member {
                    index: of, error, ..
                })),
            ) => {
                failed += 1;
                assert_eq!(of, index);
                if is_exact {
                    // By text, since a NaN is not itself.
                    assert_eq!(error.to_string(), expected.to_string());
                }
                let same = match (&*error, expected) {
                    (
                        Error::Step(StepError::NotFinite {
                            step: a, piece: c, ..
                        }),
                        Error::Step(StepError::NotFinite {
                            step: b, piece: d, ..
                        }),
                    ) => a.abs_diff(*b) <= 1 && c == d,
                    (
                        Error::Start(StartError::Values { .. }),
                        Error::Start(StartError::Values { .. }),
                    ) => true,
                    _ => false,
                };
                assert!(same, "{error} {expected}");
            }
            (single, end) => panic!("member {index}: {end:?}, alone {single:?}"),
        }
    }
    assert!(failed > COUNT / 7);
}
