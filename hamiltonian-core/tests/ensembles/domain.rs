//! Members that leave the domain of H: the errors of their single runs.

use super::*;
use hamiltonian::Status;
use hamiltonian::errors::SweepError;

/// The generated members.
const MEMBERS: usize = 330;
/// The number of steps: two blocks and a part of one.
const STEPS: u64 = 2600;
const STEP: f64 = 0.004;

/// The number of kinds of floors.
const KINDS: u64 = 6;
/// The kinds below which derivatives have no value either.
const BROKEN: [u64; 2] = [2, 3];

/// A start above the floor, from which some members fall through it, at any time.
fn falling(member: Member) -> (Floor, StateOf<Floor>) {
    let part = |shift: u32| (member.seed.rotate_left(shift) >> 11) as f64 / (1_u64 << 53) as f64;
    let system = Floor {
        g: 0.01 + 0.2 * part(0).powi(6),
        k: 10_f64.powf(-1.0 - 4.0 * part(17)),
        kind: kind(member) as f64,
        ..Default::default()
    };
    let start = State::new([0.2 + 1.2 * part(31)], [0.5 * part(47) - 0.25]);
    (system, start.at(part(5)))
}

fn kind(member: Member) -> u64 {
    member.seed.rotate_left(23) % KINDS
}

/// The height and whether H is finite there, after each step of leapfrog written by hand.
fn by_hand(member: Member) -> Vec<(f64, bool)> {
    let (Floor { g, k, .. }, start) = falling(member);
    let kind = kind(member);
    let slope = |x: f64| {
        let rest = 1.0 - (1.0 - x / 8.0) * (1.0 - x / 8.0);
        k * [
            -1.0 / x,
            1.0,
            2.5 * x.powf(1.5),
            -0.125 / rest.sqrt(),
            -0.125 / rest,
            0.0,
        ][kind as usize]
    };
    let (mut x, mut p) = (start.q[0], start.p[0]);
    let steps = 0..STEPS;
    steps
        .map(|_| {
            p -= STEP / 2.0 * (g + slope(x));
            x += STEP * p;
            p -= STEP / 2.0 * (g + slope(x));
            (x, p.is_finite() && x > 0.0)
        })
        .collect()
}

/// The end of a single run, or its error without the index of the member.
fn single(index: usize, end: Option<f64>) -> Result<Vec<u64>, String> {
    let (system, start) = falling(Member::new(index, 0));
    let mut run = Integrator::new(&system, StormerVerlet::default(), start, STEP)
        .map_err(|error| error.to_string())?;
    let state = match end {
        Some(t) => run.advance_until(t),
        None => run.advance(STEPS).cloned(),
    };
    state
        .map(|state| bits(&state))
        .map_err(|error| error.to_string())
}

/// The error inside that of a member.
fn alone(error: &Error) -> String {
    match error {
        Error::Sweep(SweepError::Member { error, .. }) => error.to_string(),
        other => other.to_string(),
    }
}

#[test]
fn members_that_leave_the_domain_have_the_errors_of_single_runs() {
    let _level = one_level();
    let expected: Vec<_> = (0..MEMBERS).map(|index| single(index, None)).collect();
    let failed = expected.iter().filter(|end| end.is_err()).count();
    assert!(
        failed > 90 && MEMBERS - failed > 90,
        "{failed} of {MEMBERS} fail"
    );
    let (mut of_kinds, mut unseen) = ([0; KINDS as usize], 0);
    for (index, end) in expected.iter().enumerate() {
        let member = Member::new(index, 0);
        let path = by_hand(member);
        // Control: numbers alone, which stay finite.
        let last = path.last().map_or(0.0, |(x, _)| *x);
        unseen += usize::from(end.is_err() && last.is_finite());
        let bad = path.iter().position(|(_, is_inside)| !is_inside);
        // Rounding decides next to the edge.
        if path.iter().any(|(x, _)| x.abs() < 1e-9) {
            continue;
        }
        let place = format!("member {index}, kind {}: {end:?}", kind(member));
        assert_eq!(end.is_err(), bad.is_some(), "{place}");
        if let (Err(text), Some(bad)) = (end, bad) {
            assert!(text.contains(&format!("step {} ", bad + 1)), "{place}");
            let names_h = text.contains("H is NaN") || text.contains("H is inf");
            assert_eq!(names_h, !BROKEN.contains(&kind(member)), "{place}");
            of_kinds[kind(member) as usize] += 1;
        }
    }
    assert!(
        of_kinds.iter().all(|n| *n > 8) && unseen > 50,
        "{of_kinds:?} {unseen}"
    );
    // An ensemble, in one call and in several.
    for calls in [[STEPS, 0], [700, STEPS - 700]] {
        let mut swarm = Ensemble::new(MEMBERS, falling, StormerVerlet::default(), STEP)
            .expect("there are members")
            .reproducible();
        for n in calls {
            swarm.advance(n);
        }
        for (expected, end) in expected.iter().zip(swarm.states()) {
            let end = end.map(|state| bits(&state)).map_err(|error| alone(&error));
            assert_eq!(&end, expected);
        }
    }
    // A sweep with an observer in lanes, one with an observer of states, and one in fused arithmetic.
    let sweep = || {
        Sweep::new(MEMBERS, falling, StormerVerlet::default(), STEP)
            .with_steps(STEPS)
            .with_chunk(100)
    };
    let take = |mut all: Vec<_>, row: &hamiltonian::Row<'_>| {
        assert_eq!(row.error.is_some(), row.values[0].is_nan());
        all.push((row.status, row.error.map(alone)));
        all
    };
    let followed = sweep()
        .reproducible()
        .observe(|_| every(3, EnergyDrift::new()))
        .record(["drift"], |end| [end.observer.inner().max_relative()]);
    let followed = followed.fold(vec![], take).expect("rows");
    let watched = sweep()
        .reproducible()
        .observe(|_| every(5, Recorder::of(["x"])))
        .record(["least"], |end| {
            [end.observer
                .inner()
                .column("x")
                .map_or(f64::NAN, |x| x.fold(f64::MAX, f64::min))]
        });
    let watched = watched.fold(vec![], take).expect("rows");
    let fused = sweep().record(["x"], |end| [end.state.q[0]]);
    let fused = fused.fold(vec![], take).expect("rows");
    for (index, expected) in expected.iter().enumerate() {
        let status = match expected {
            Ok(_) => Status::Ended,
            Err(_) => Status::NotFinite,
        };
        let error = expected.as_ref().err();
        for rows in [&followed, &watched] {
            assert_eq!(
                (rows[index].0, rows[index].1.as_ref()),
                (status, error),
                "member {index}"
            );
        }
        assert_eq!(fused[index].0, status, "member {index}");
    }
}

#[test]
fn parts_of_steps_and_deviations_stay_in_the_domain() {
    let _level = one_level();
    // Ends between steps.
    let end = |member: Member| {
        let (_, start) = falling(member);
        start.t + STEP * (0.5 + STEPS as f64 * (member.index as f64 / MEMBERS as f64))
    };
    let sweep = Sweep::new(MEMBERS, falling, StormerVerlet::default(), STEP)
        .reproducible()
        .with_end_each(end)
        .record(["x"], |end| [end.state.q[0]]);
    let rows = sweep.fold(vec![], |mut all, row| {
        all.push(row.error.map(alone));
        all
    });
    let mut failed = 0;
    for (index, found) in rows.expect("rows").into_iter().enumerate() {
        let expected = single(index, Some(end(Member::new(index, 0)))).err();
        failed += u32::from(expected.is_some());
        assert_eq!(found, expected, "member {index}");
    }
    assert!(failed > 30, "{failed} failed");
    let all = Lyapunov::new(MEMBERS, falling, StormerVerlet::default(), STEP)
        .with_steps(STEPS)
        .collect()
        .expect("there are members");
    for (index, found) in all.iter().enumerate() {
        let expected = single(index, None);
        match (&expected, found) {
            (Ok(_), Ok(exponents)) => assert!(exponents.iter().all(|rate| rate.is_finite())),
            (Err(text), Err(error)) => {
                // Deviations do not change the orbit, but their arithmetic is fused.
                let step = |text: &str| text.split(' ').nth(1).and_then(|n| n.parse::<i64>().ok());
                let found = alone(error);
                let apart = step(text).zip(step(&found)).map(|(a, b)| (a - b).abs());
                assert!(apart.is_some_and(|apart| apart <= 1), "{text} {found}");
            }
            (single, found) => panic!("member {index}: {found:?}, alone {single:?}"),
        }
    }
}
