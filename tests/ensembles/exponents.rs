//! Lyapunov exponents of members.

use super::*;
use std::sync::atomic::AtomicBool;

/// Exponents of members in lanes have the bits of single tangents.
fn deviates<S, M>(make: fn(Member) -> (S, StateOf<S>), scheme: M, deviations: usize)
where
    S: System<f64> + System<Dual<f64>>,
    M: Ensembles<S, Dual<f64>>,
{
    let h = 0.0625;
    let exponents = |count, threads| {
        Lyapunov::new(count, make, scheme.clone(), h)
            .deviations(deviations)
            .steps(50)
            .every(8)
            .threads(threads)
            .reproducible()
            .collect()
            .expect("there are members")
    };
    let all = exponents(COUNT, 2);
    assert_eq!(all.len(), COUNT);
    for (index, found) in all.iter().enumerate() {
        let (system, start) = make(Member::new(index, 0));
        let expected = Tangent::new(&system, scheme.clone(), start, h, deviations)
            .and_then(|mut tangent| tangent.lyapunov(50, 8));
        match (found, expected) {
            (Ok(found), Ok(expected)) => assert_eq!(
                found.iter().map(|rate| rate.to_bits()).collect::<Vec<_>>(),
                expected
                    .iter()
                    .map(|rate| rate.to_bits())
                    .collect::<Vec<_>>(),
                "member {index}: {found:?} {expected:?}"
            ),
            (Err(Error::Member { index: of, error }), Err(expected)) => {
                assert_eq!((*of, error.to_string()), (index, expected.to_string()));
            }
            (found, expected) => panic!("member {index}: {found:?}, alone {expected:?}"),
        }
    }
    let few = exponents(3, 1).into_iter().map(Result::ok);
    assert!(few.eq(all.into_iter().take(3).map(Result::ok)));
}

#[test]
fn exponents_of_members_are_those_of_single_tangents() {
    let falling = |member: Member| {
        // Some fall into the hole on the way, one starts outside of it.
        let q = if member.index == 11 {
            -1.0
        } else {
            0.2 + 50.0 * part(member.index)
        };
        (Hole::default(), State::new([q], [0.0]))
    };
    at_each_level(|_| {
        deviates(henon_heiles, StormerVerlet::default(), 3);
        deviates(pendulum, Gauss::<2>::default(), 2);
        deviates(falling, StormerVerlet::default(), 1);
        deviates(falling, StormerVerlet::default(), 2);
    });
    let _level = one_level();
    let of = || Lyapunov::new(2, mixture, ImplicitMidpoint::default(), 0.1);
    assert!(matches!(of().collect(), Err(Error::NoSteps)));
    let none = Lyapunov::new(0, mixture, ImplicitMidpoint::default(), 0.1).steps(1);
    assert!(matches!(none.collect(), Err(Error::NoMembers)));
    let many = of().steps(1).deviations(3).collect().expect("members");
    assert!(
        many.iter()
            .all(|one| matches!(one, Err(Error::Member { error, .. })
        if matches!(**error, Error::Deviations { most: 2, found: 3 })))
    );
    let stop = AtomicBool::new(true);
    let stopped = of().steps(1).cancel(&stop).collect();
    assert!(matches!(stopped, Err(Error::Cancelled { done: 0, of: 2 })));
}
