//! Tables of sweeps: no row is lost, and the times of records are checked.

use super::*;
use core::ops::ControlFlow;
use hamiltonian::Status;
use hamiltonian::View;
use hamiltonian::errors::{StepError, TimeError};

/// The members of each sweep.
const MEMBERS: usize = 13;
/// The number of generated sweeps.
const CASES: u64 = 400;

/// A linear congruential generator.
struct Numbers(u64);

impl Numbers {
    /// A number from 0 to 1.
    fn part(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn below(&mut self, n: usize) -> usize {
        (self.part() * n as f64) as usize
    }
}

/// A fault of the times of a record.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// Two times are exchanged.
    Order,
    /// All times are in the direction of a negative step.
    Direction,
    /// A time is NaN or infinite.
    Number,
    /// The first time is before the start of some members.
    Early,
}

const FAULTS: [Fault; 5] = [
    Fault::None,
    Fault::Order,
    Fault::Direction,
    Fault::Number,
    Fault::Early,
];

/// Members that fall into the hole at several times, one that starts outside of it, and one that cannot be made.
fn falling(member: Member) -> Result<(Hole, StateOf<Hole>), Error> {
    let q = match member.index {
        3 => -1.0,
        8 => return Err(Error::other("it cannot be made")),
        index if index % 2 == 0 => 0.3 + 0.1 * index as f64,
        _ => 100.0,
    };
    let late = 0.25 * (member.index % 4) as f64;
    Ok((Hole::default(), State::new([q], [0.0]).at(late)))
}

/// Ends a member at a number of steps.
struct Until(u64);

impl<S: System> Observer<f64, S> for Until {
    fn observe(&mut self, view: &View<'_, f64, S>) -> ControlFlow<()> {
        match view.steps >= self.0 {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}

/// The observer of a member, which ends some members.
fn until(index: usize) -> Until {
    Until(if index.is_multiple_of(3) {
        5 * index as u64
    } else {
        u64::MAX
    })
}

/// The status and the values of each time of a single run; `None` for times that it does not reach. `ends` is true
/// if the observer may end it.
fn single(index: usize, times: &[f64], step: f64, ends: bool) -> (Status, Vec<Option<[f64; 2]>>) {
    let mut values = vec![None; times.len()];
    let begun = falling(Member::new(index, 0)).and_then(|(system, start)| {
        Integrator::new(&system, StormerVerlet::default(), start, step)
    });
    let Ok(run) = begun else {
        return (Status::Start, values);
    };
    let mut run = run.observe(if ends { until(index) } else { Until(u64::MAX) });
    for (k, (value, t)) in values.iter_mut().zip(times).enumerate() {
        // The time after the end has the state of the end.
        let has_ended = run.has_ended();
        match run.advance_until(*t) {
            Ok(_) if has_ended && k > 0 => return (Status::Stopped, values),
            Ok(state) => *value = Some([state.t, state.q[0]]),
            Err(Error::Step(StepError::NotFinite { .. })) => return (Status::NotFinite, values),
            Err(Error::Time(TimeError::Behind { .. })) if k == 0 => return (Status::Start, values),
            // The first time is the start, and the member runs in the other direction.
            Err(Error::Time(TimeError::Behind { .. })) => return (Status::Failed, values),
            Err(error) => panic!("{error}"),
        }
    }
    (
        if run.has_ended() {
            Status::Stopped
        } else {
            Status::Ended
        },
        values,
    )
}

#[test]
fn tables_of_generated_sweeps_lose_no_row_and_report_bad_times() {
    let _level = one_level();
    let mut numbers = Numbers(38);
    let mut seen = [0; 5];
    let (mut partly, mut whole, mut stopped, mut against) = (0, 0, 0, 0);
    for case in 0..CASES {
        let step = if numbers.part() < 0.5 { 0.05 } else { -0.05 };
        let fault = FAULTS[case as usize % FAULTS.len()];
        // From the latest start on, in the direction of the step.
        let origin = if step > 0.0 { 0.75 } else { 0.0 };
        let mut times: Vec<f64> = (0..2 + numbers.below(5))
            .map(|_| origin + step * (160.0 * numbers.part()).round() * 0.5)
            .collect();
        times.sort_by(|a, b| (a * step).total_cmp(&(b * step)));
        let last = times.len() - 1;
        match fault {
            Fault::None => {}
            Fault::Order => {
                times[last] += step;
                times.swap(last, last - 1);
            }
            Fault::Direction => {
                times[last] += step;
                times.reverse();
            }
            Fault::Number => {
                let at = numbers.below(times.len());
                times[at] = [f64::NAN, f64::INFINITY][numbers.below(2)];
            }
            Fault::Early => times[0] = if step > 0.0 { 0.5 } else { 0.25 },
        }
        let mut sweep = Sweep::try_new(MEMBERS, falling, StormerVerlet::default(), step)
            .reproducible()
            .with_chunk(1 + numbers.below(14))
            .with_threads(1 + numbers.below(2));
        // Steps of their own, of some members in the other direction; any order of times may then be meant.
        let is_own = !matches!(fault, Fault::Order | Fault::Direction) && numbers.below(3) == 0;
        let step_of = move |index: usize| match index % 4 {
            _ if !is_own => step,
            1 => -step,
            _ => step * (0.6 + 0.1 * (index % 9) as f64),
        };
        if is_own {
            sweep = sweep.with_step_each(move |member| step_of(member.index));
        }
        let ends = numbers.below(2) == 0;
        let table = match ends {
            true => sweep
                .observe(|member| until(member.index))
                .record_at(times.clone(), ["t", "q"], |end| {
                    [end.state.t, end.state.q[0]]
                })
                .collect(),
            false => sweep
                .record_at(times.clone(), ["t", "q"], |end| {
                    [end.state.t, end.state.q[0]]
                })
                .collect(),
        };
        seen[case as usize % FAULTS.len()] += 1;
        let context = format!("case {case}: {fault:?}, step {step}, {times:?}");
        let table = match (fault, table) {
            (Fault::Order | Fault::Direction, Err(Error::Time(TimeError::Behind { .. })))
            | (Fault::Number, Err(Error::Time(TimeError::Unreachable { .. }))) => continue,
            (Fault::None | Fault::Early, Ok(table)) => table,
            (_, other) => panic!("{context}: {:?}", other.err()),
        };
        assert_eq!(table.columns(), ["member", "t", "q", "status"]);
        assert_eq!(table.rows(), MEMBERS * times.len(), "{context}");
        let mut rows = table.iter();
        for index in 0..MEMBERS {
            let (status, values) = single(index, &times, step_of(index), ends);
            let reached = values.iter().flatten().count();
            partly += u32::from(reached > 0 && reached < values.len());
            whole += u32::from(reached == values.len());
            stopped += u32::from(status == Status::Stopped);
            against += u32::from(step_of(index) * step < 0.0);
            for value in values {
                let row = rows.next().expect("a row for each member and time");
                let [t, q] = value.unwrap_or([f64::NAN; 2]);
                let expected = [index as f64, t, q, f64::from(status as u8)];
                let bits = |row: &[f64]| row.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert_eq!(
                    bits(row),
                    bits(&expected),
                    "{context}, member {index}: {row:?}"
                );
            }
        }
    }
    // The generator makes each kind, and members that reach some, all and none of the times.
    assert!(seen.iter().all(|n| *n >= 60), "{seen:?}");
    assert!(
        partly > 100 && whole > 500 && stopped > 100 && against > 100,
        "{partly} partly, {whole} wholly recorded, {stopped} ended by observers, {against} against the times"
    );
}

#[test]
fn every_record_has_members_and_states_of_their_ends() {
    let _level = one_level();
    let sweep = || Sweep::try_new(MEMBERS, falling, StormerVerlet::default(), 0.05).with_end(4.0);
    let ends = sweep().record(["q"], |end| [end.state.q[0]]);
    let ends = ends.collect().expect("rows");
    assert_eq!(ends.columns(), ["member", "q", "status"]);
    assert!(
        ends.column("member")
            .expect("members")
            .eq((0..MEMBERS).map(|k| k as f64))
    );
    // Two rows of each member that ended, and one of each that failed.
    let rows = sweep().record_rows(["q"], |end| [[end.state.q[0]]; 2]);
    let rows = rows.collect().expect("rows");
    assert_eq!(rows.columns(), ["member", "q", "status"]);
    let mut found = rows.iter();
    for end in ends.iter() {
        let failed = end[2] != f64::from(Status::Ended as u8);
        assert_eq!(failed, end[1].is_nan());
        for _ in 0..if failed { 1 } else { 2 } {
            let row = found.next().expect("a row");
            assert!(row[0] == end[0] && row[2] == end[2]);
            assert_eq!(row[1].to_bits(), end[1].to_bits());
        }
    }
    assert!(found.next().is_none());
    // Members without rows that did not fail have none.
    let none = sweep().record_rows(["q"], |_| Vec::<[f64; 1]>::new());
    let none = none.collect().expect("rows");
    assert!(none.rows() < MEMBERS && none.column("q").expect("a column").all(f64::is_nan));
    let twice = sweep().record(["member"], |_| [0.0]);
    assert!(matches!(twice.collect(), Err(Error::Table(_))));
}
