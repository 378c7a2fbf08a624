//! Exponents and other indicators of chaos of members.

use super::*;
use hamiltonian::errors::{StartError, SweepError};
use std::sync::atomic::AtomicBool;

/// Exponents, MEGNO and GALI of members in lanes have the bits of single tangents.
fn deviates<S, M>(make: fn(Member) -> (S, StateOf<S>), scheme: M, deviations: usize)
where
    S: System,
    M: Scheme<S>,
{
    type Found = Result<Vec<f64>, Error>;
    // More than the lanes of a level, and not a multiple of them.
    const COUNT: usize = 67;
    let h = 0.0625;
    let swarm = |count, threads| {
        Lyapunov::new(count, make, scheme.clone(), h)
            .with_deviations(deviations)
            .with_steps(50)
            .with_interval(8)
            .with_threads(threads)
            .reproducible()
    };
    let tangent =
        |system: &S, start, deviations| Tangent::new(system, scheme.clone(), start, h, deviations);
    // Single tangents are the same on each level.
    let alone = |indicator: &dyn Fn(&S, StateOf<S>) -> Found| -> Vec<Found> {
        let members = (0..COUNT).map(|index| make(Member::new(index, 0)));
        members
            .map(|(system, start)| indicator(&system, start))
            .collect()
    };
    let exponents = alone(&|system, start| tangent(system, start, deviations)?.lyapunov(50, 8));
    let megnos = alone(&|system, start| Ok(vec![megno(system, scheme.clone(), start, h, 50, 8)?]));
    let galis = alone(&|system, start| {
        let mut tangent = tangent(system, start, deviations)?;
        for _ in 0..6 {
            tangent.advance(8)?;
            tangent.normalise();
        }
        tangent.advance(2)?;
        Ok(vec![tangent.gali()])
    });
    let compare = |all: &[Found], alone: &[Found]| {
        assert_eq!(all.len(), COUNT);
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        for (index, both) in all.iter().zip(alone).enumerate() {
            match both {
                (Ok(found), Ok(expected)) => {
                    let same = bits(found) == bits(expected);
                    assert!(same, "member {index}: {found:?} {expected:?}");
                }
                (
                    Err(Error::Sweep(SweepError::Member {
                        index: of, error, ..
                    })),
                    Err(expected),
                ) => {
                    assert_eq!((*of, error.to_string()), (index, expected.to_string()));
                }
                (found, expected) => panic!("member {index}: {found:?}, alone {expected:?}"),
            }
        }
    };
    at_each_level(|_| {
        let all = swarm(COUNT, 2).collect().expect("there are members");
        compare(&all, &exponents);
        let few = swarm(3, 1).collect().expect("there are members");
        assert!(
            few.iter()
                .zip(&all)
                .all(|(few, all)| few.as_ref().ok() == all.as_ref().ok())
        );

        let each = |all: Result<Vec<Result<f64, Error>>, Error>| -> Vec<Found> {
            let all = all.expect("there are members").into_iter();
            all.map(|one| one.map(|number| vec![number])).collect()
        };
        compare(&each(swarm(COUNT, 2).megno()), &megnos);
        compare(&each(swarm(COUNT, 2).gali(deviations)), &galis);
    });
}

#[test]
fn indicators_of_members_are_those_of_single_tangents() {
    let falling = |member: Member| {
        // Some fall into the hole on the way, one starts outside of it.
        let q = if member.index == 11 {
            -1.0
        } else {
            0.2 + 50.0 * part(member.index)
        };
        (Hole::default(), State::new([q], [0.0]))
    };
    deviates(henon_heiles, StormerVerlet::default(), 3);
    deviates(pendulum, Gauss::<2>::default(), 2);
    deviates(falling, StormerVerlet::default(), 1);
    deviates(falling, StormerVerlet::default(), 2);
    let _level = one_level();
    let of = || Lyapunov::new(2, mixture, ImplicitMidpoint::default(), 0.1);
    assert!(matches!(
        of().collect(),
        Err(Error::Start(StartError::NoSteps { .. }))
    ));
    assert!(matches!(
        of().megno(),
        Err(Error::Start(StartError::NoSteps { .. }))
    ));
    let three = of().with_steps(1).gali(3).expect("members");
    assert!(three.iter().all(
        |one| matches!(one, Err(Error::Sweep(SweepError::Member { error, .. }))
        if matches!(**error, Error::Start(StartError::Deviations { most: 2, found: 3, .. })))
    ));
    let none = Lyapunov::new(0, mixture, ImplicitMidpoint::default(), 0.1).with_steps(1);
    assert!(matches!(
        none.collect(),
        Err(Error::Sweep(SweepError::NoMembers { .. }))
    ));
    let many = of()
        .with_steps(1)
        .with_deviations(3)
        .collect()
        .expect("members");
    assert!(many.iter().all(
        |one| matches!(one, Err(Error::Sweep(SweepError::Member { error, .. }))
        if matches!(**error, Error::Start(StartError::Deviations { most: 2, found: 3, .. })))
    ));
    let stop = AtomicBool::new(true);
    let stopped = of().with_steps(1).with_cancel(&stop).collect();
    assert!(matches!(
        stopped,
        Err(Error::Sweep(SweepError::Cancelled { done: 0, of: 2, .. }))
    ));
}
