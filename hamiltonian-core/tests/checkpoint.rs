//! Saved runs: the same run bit for bit, or a typed error.

use crate::common::start;
use crate::common::systems::*;
use hamiltonian_core::VectorOf;
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::IntersectingSubTrajectories;
use hamiltonian_core::{
    errors::CheckpointError,
    observers::Every,
    schemes::author::{Description, Listed},
};
use hamiltonian_lanes::Pack;
use std::path::PathBuf;

/// A changed step, an end and a start of the clock are part of a run.
#[test]
fn a_changed_step_is_saved() {
    let system = Hand(HenonHeiles);
    let begin = start::<f64, _>(&system, &[0.1, -0.25], &[0.42, 0.1]);
    let mut run = Integrator::new(&system, Strang, begin, 0.01).unwrap();
    run.advance(5).unwrap();
    run.change_step(0.03).unwrap();
    run.advance(4).unwrap();
    let mut again = Integrator::resume(&system, Strang, run.checkpoint()).unwrap();
    assert_eq!((again.step(), again.steps()), (0.03, 9));
    assert_eq!(again.advance(100).unwrap(), run.advance(100).unwrap());
    assert_eq!(
        again.state_at(again.time() - 0.01),
        run.state_at(run.time() - 0.01)
    );

    let mut ended = run.watch(1, |_| core::ops::ControlFlow::Break(()));
    ended.advance(3).unwrap();
    let mut again = Integrator::resume(&system, Strang, ended.checkpoint())
        .unwrap()
        .watch(1, |_| {});
    let steps = again.steps();
    again.advance(3).unwrap();
    assert!(again.has_ended() && again.steps() == steps);
}

fn small() -> Vec<u8> {
    let start = State::new([0.3], [0.1]);
    let mut run = Integrator::new(&pendulum(true), Strang, start, 0.01)
        .unwrap()
        .observe(EnergyDrift::new());
    run.advance(3).unwrap();
    run.checkpoint().to_bytes()
}

fn refused(bytes: &[u8]) -> CheckpointError {
    match Checkpoint::from_bytes(bytes).unwrap_err() {
        Error::Checkpoint(error) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn damage_is_found_wherever_it_is() {
    let bytes = small();
    assert!(Checkpoint::from_bytes(&bytes).is_ok());
    for place in 0..bytes.len() {
        for flip in [1, 0x80, 0xff] {
            let mut bad = bytes.clone();
            bad[place] ^= flip;
            let error = refused(&bad);
            let right = match place {
                0..8 => matches!(error, CheckpointError::Foreign { .. }),
                8 if bad[8] < bytes[8] => matches!(error, CheckpointError::Older { .. }),
                8..16 => matches!(error, CheckpointError::Newer { .. }),
                _ => matches!(error, CheckpointError::Damaged { .. }),
            };
            assert!(right, "byte {place} ^ {flip}: {error:?}");
        }
    }
    for length in 0..bytes.len() {
        let error = refused(&bytes[..length]);
        let right = match length {
            0..8 => matches!(error, CheckpointError::Foreign { .. }),
            _ => matches!(error, CheckpointError::Damaged { .. }),
        };
        assert!(right, "{length} bytes: {error:?}");
    }
    let longer = [&bytes[..], &[0; 8]].concat();
    assert!(matches!(refused(&longer), CheckpointError::Damaged { .. }));
    let foreign = refused(b"no saved run at all");
    assert!(matches!(foreign, CheckpointError::Foreign { .. }));
    let mut newer = bytes.clone();
    newer[8] += 1;
    let error = refused(&newer);
    let own = u64::from(bytes[8]);
    assert!(matches!(
        error,
        CheckpointError::Newer { version, readable, .. } if (version, readable) == (own + 1, own)
    ));
    assert!(error.to_string().contains("update"), "{error}");
    newer[8] = 1;
    let error = refused(&newer);
    assert!(matches!(
        error,
        CheckpointError::Older { version: 1, readable, .. } if readable == own
    ));
    assert!(
        error.to_string().contains("the version that saved it"),
        "{error}"
    );
}

/// The part of the run that is another one, or None.
fn other(outcome: Result<impl Sized, Error>) -> Option<String> {
    match outcome {
        Ok(_) => None,
        Err(Error::Checkpoint(CheckpointError::Other { what, .. })) => Some(what.into()),
        Err(error) => panic!("{error:?}"),
    }
}

#[test]
fn another_run_is_refused() {
    let saved = || Checkpoint::from_bytes(&small()).unwrap();
    let system = pendulum(true);
    assert_eq!(other(Integrator::resume(&system, Strang, saved())), None);
    let found = Integrator::resume(&Hand(Paper34), RungeKutta4, saved());
    assert_eq!(other(found).as_deref(), Some("system"));
    let scheme = StormerVerlet::KickDriftKick;
    let found = Integrator::resume(&system, scheme, saved());
    assert_eq!(other(found).as_deref(), Some("scheme"));
    let found = Integrator::<f32, _, _>::resume_over(&system, Strang, saved());
    assert_eq!(other(found).as_deref(), Some("scalar"));
    // Choices of a scheme are part of it.
    let [few, many] = [20, 30].map(|most| ImplicitMidpoint::default().with_max_iterations(most));
    let run = Integrator::new(&system, few, State::new([0.3], [0.1]), 0.01).unwrap();
    let found = Integrator::resume(&system, many, run.checkpoint());
    assert_eq!(other(found).as_deref(), Some("scheme"));
    assert_eq!(few.entry(), many.entry());
    // A variant alone says nothing without the name of its scheme.
    let start = State::new([0.3], [0.1]);
    let run = Integrator::new(&system, StormerVerlet::KickDriftKick, start, 0.01).unwrap();
    let found = Integrator::resume(&system, StormerVerlet::DriftKickDrift, run.checkpoint());
    assert_eq!(
        found.unwrap_err().to_string(),
        "the saved run has another scheme: saved `StormerVerlet (kick-drift-kick)`, given \
         `StormerVerlet (drift-kick-drift)`"
    );
    // Sizes are part of a system.
    let chain = State::new(vec![0.1, 0.2], vec![0.0, 0.0]);
    let run = Integrator::new(&Chain { n: 2 }, Strang, chain, 0.01).unwrap();
    let found = Integrator::resume(&Chain { n: 3 }, Strang, run.checkpoint());
    assert_eq!(other(found).as_deref(), Some("system"));
    // Another observer in the place: the run does not start.
    let mut run = Integrator::resume(&system, Strang, saved())
        .unwrap()
        .observe(Recorder::new());
    assert_eq!(other(run.advance(1)).as_deref(), Some("observer"));
    assert_eq!(run.steps(), 3);
    // One more than was saved, which is no damage.
    let mut run = Integrator::resume(&system, Strang, saved())
        .unwrap()
        .observe((EnergyDrift::new(), Recorder::new()));
    assert_eq!(
        run.advance(1).unwrap_err().to_string(),
        "the saved run has another observer: saved `nothing`, given `Recorder`"
    );
    // Other columns, other roots.
    let columns = [
        Recorder::new(),
        Recorder::new().with_energy(),
        Recorder::of(["t", "theta"]),
        Recorder::new().with_wrapped("theta"),
    ];
    let what = "list of columns";
    for other in 1..4 {
        assert_eq!(
            goes_on_with(columns.clone(), 0, other).as_deref(),
            Some(what)
        );
        assert_eq!(
            goes_on_with(columns.clone(), other, 0).as_deref(),
            Some(what)
        );
        assert_eq!(goes_on_with(columns.clone(), other, other), None);
    }
    let zero = || Event::of("zero", |state: &StateOf<Hand<Pendulum, 1>>| state.q[0]);
    let events = [
        zero(),
        zero().with_direction(1),
        zero().with_direction(-1),
        zero().with_period(6.0),
        zero().with_end_after(5),
    ]
    .map(|event| Events::new([event]));
    for other in 1..4 {
        assert_eq!(
            goes_on_with(events.clone(), 0, other).as_deref(),
            Some("event")
        );
        assert_eq!(goes_on_with(events.clone(), other, other), None);
    }
    // It may end elsewhere.
    assert_eq!(goes_on_with(events.clone(), 0, 4), None);
    // A system whose parameters are written tells them apart.
    let [one, two] = [1.0, 2.0].map(|k| Spring(k, pendulum(true)));
    let run = Integrator::new(&one, RungeKutta4, State::new([0.3], [0.1]), 0.01).unwrap();
    let found = Integrator::resume(&two, RungeKutta4, run.checkpoint());
    assert_eq!(other(found).as_deref(), Some("parameter"));
    let found = Integrator::resume(&one, RungeKutta4, run.checkpoint());
    assert_eq!(other(found), None);
}

/// The parameters of a saved run are those of the run.
#[test]
fn parameters_are_those_of_the_run() {
    let [one, two] = [1.0, 2.0].map(|k| Spring(k, pendulum(true)));
    let mut run = Integrator::new(&one, RungeKutta4, State::new([0.3], [0.1]), 0.01).unwrap();
    let fits = |run: &Run<Spring, RungeKutta4>, system: &Spring| {
        Integrator::resume(system, RungeKutta4, run.checkpoint()).is_ok()
    };
    let clone = run.clone();
    run.set_system(&two).unwrap();
    run.set_state(run.state().clone()).unwrap();
    run.advance(3).unwrap();
    for (run, [first, second]) in [(&run, [false, true]), (&clone, [true, false])] {
        assert_eq!((fits(run, &one), fits(run, &two)), (first, second));
    }
    let resumed = Integrator::resume(&two, RungeKutta4, run.checkpoint()).unwrap();
    assert_eq!(resumed.checkpoint(), run.checkpoint());
}

/// The part in which observer `given` differs from the `saved` one, whose run it is to go on with.
fn goes_on_with<O: Observer<f64, Hand<Pendulum, 1>> + Clone, const N: usize>(
    observers: [O; N],
    saved: usize,
    given: usize,
) -> Option<String> {
    let system = pendulum(true);
    let start = State::new([0.3], [0.1]);
    let run = Integrator::new(&system, Strang, start, 0.01).unwrap();
    let run = run.observe(observers[saved].clone());
    let again = Integrator::resume(&system, Strang, run.checkpoint()).unwrap();
    other(again.observe(observers[given].clone()).advance(1))
}

/// The pendulum with a parameter that it writes.
struct Spring(f64, Hand<Pendulum, 1>);

impl System for Spring {
    type Shape = hamiltonian_core::private::SVector<(), 1>;
    type Prepared<T: Real> = Ready<Pendulum, 1>;
    fn description(&self) -> &Description {
        self.1.description()
    }
    fn describe_parameters(&self, to: &mut dyn core::fmt::Write) -> core::fmt::Result {
        writeln!(to, "k = {:?}", self.0)
    }
    fn prepare<T: Real>(&self) -> Self::Prepared<T> {
        System::prepare::<T>(&self.1)
    }
    fn zeros<T: Real>(&self) -> VectorOf<Self, T> {
        System::zeros::<T>(&self.1)
    }
    fn gather<T: Real, P: Pack>(members: &[&Self::Prepared<T>]) -> Self::Prepared<T::Over<P>> {
        members[0].clone()
    }
    fn fits<T: Real>(_: &Self::Prepared<T>, _: &Self::Prepared<T>) -> bool {
        true
    }
    fn equals<T: Real>(_: &Self::Prepared<T>, _: &Self::Prepared<T>) -> bool {
        true
    }
}

fn place(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("hamiltonian-{name}-{}", std::process::id()))
}

#[test]
fn files_that_cannot_be_read_or_written() {
    let file = |outcome: Result<Checkpoint, Error>| match outcome.unwrap_err() {
        Error::Checkpoint(CheckpointError::File { path, .. }) => path.into_string(),
        other => panic!("{other:?}"),
    };
    let missing = place("missing");
    assert_eq!(
        file(Checkpoint::load(&missing)),
        missing.display().to_string()
    );
    let saved = Checkpoint::from_bytes(&small()).unwrap();
    let nowhere = missing.join("in a directory that is not there");
    let outcome = saved.save(&nowhere).map(|()| saved.clone());
    assert_eq!(file(outcome), nowhere.display().to_string());
    let there = place("there");
    saved.save(&there).unwrap();
    saved.save(&there).unwrap();
    let again = Checkpoint::load(&there);
    std::fs::remove_file(&there).unwrap();
    assert_eq!(again.unwrap(), saved);
}

/// The run with observers that were saved, one of them missing.
#[test]
fn fewer_observers_than_were_saved_are_refused() {
    let system = pendulum(true);
    let start = || State::new([0.7], [0.1]);
    let mut run = Integrator::new(&system, Strang, start(), 0.01)
        .unwrap()
        .observe((EnergyDrift::new(), Recorder::new()))
        .watch(1, |_| {});
    run.advance(5).unwrap();
    let saved = || Integrator::resume(&system, Strang, run.checkpoint()).unwrap();
    let refused = |outcome: Result<_, Error>, name: &str| {
        let error = outcome.map(|_: u64| ()).unwrap_err().to_string();
        assert_eq!(
            error,
            format!("the saved run has another observer: saved `{name}`, given `nothing`")
        );
    };
    let mut none = saved();
    refused(none.advance(1).map(|_| 0), "EnergyDrift");
    assert_eq!(none.steps(), 5);
    let mut one = saved().observe(EnergyDrift::new());
    refused(one.advance(1).map(|_| 0), "Recorder");
    refused(one.states(1).next().unwrap().map(|_| 0), "Recorder");
    let mut two = saved().observe((EnergyDrift::new(), Recorder::new()));
    refused(two.advance(1).map(|_| 0), "a closure");
    let observers = (EnergyDrift::new(), Recorder::new());
    saved()
        .observe(observers)
        .watch(1, |_| {})
        .advance(1)
        .unwrap();
}

#[test]
fn a_run_saves_itself_and_is_not_changed_by_it() {
    let system = pendulum(true);
    let start = || State::new([0.7], [0.1]);
    let observers = || (EnergyDrift::new(), every(3, Recorder::new()));
    let new = || Integrator::new(&system, BlanesMoan4, start(), 0.01).unwrap();
    let folder = std::env::temp_dir().join(format!("hamiltonian-every-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("run.saved");
    let mut plain = new().observe(observers());
    let mut saving = new().with_checkpoints(7, &path).observe(observers());
    let mut seen = Vec::new();
    for _ in 0..10 {
        plain.advance(5).unwrap();
        saving.advance(5).unwrap();
        seen.push(Checkpoint::load(&path).map_or(0, |saved| saved.steps()));
    }
    assert_eq!(seen, [0, 7, 14, 14, 21, 28, 35, 35, 42, 49]);
    assert_eq!(saving.checkpoint(), plain.checkpoint());
    let saved = Checkpoint::load(&path).unwrap();
    let mut again = Integrator::resume(&system, BlanesMoan4, saved)
        .unwrap()
        .observe(observers());
    again.advance(1).unwrap();
    assert_eq!(again.checkpoint(), plain.checkpoint());
    // A clone does not write over the file of the run it was made from.
    saving.clone().advance(7).unwrap();
    assert_eq!(Checkpoint::load(&path).unwrap().steps(), 49);
    // A file that cannot be written: the run stands after the step and goes on.
    let nowhere = folder.join("missing").join("run.saved");
    let mut failing = new().with_checkpoints(4, &nowhere).observe(observers());
    let error = failing.advance(6).unwrap_err();
    assert!(matches!(
        error,
        Error::Checkpoint(CheckpointError::File { .. })
    ));
    assert_eq!(failing.steps(), 4);
    failing.advance(3).unwrap();
    assert_eq!(failing.steps(), 7);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[cfg(unix)]
mod kills {
    use super::*;
    use hamiltonian_core::Run;
    use std::process::{Command, Stdio};
    use std::time::Duration;

    /// The file to which the process that is killed saves its run.
    const PLACE: &str = "HAMILTONIAN_SAVED_RUN";
    /// Steps between two times it saves.
    const CHUNK: u64 = 1009;

    type Observed =
        Run<Hand<Pendulum, 1>, IntersectingSubTrajectories, (EnergyDrift, Every<Recorder>)>;

    fn observed() -> (EnergyDrift, Every<Recorder>) {
        (EnergyDrift::new(), every(4001, Recorder::new()))
    }

    fn fresh() -> Observed {
        let start = State::new([2.0], [0.1]);
        let scheme = IntersectingSubTrajectories::default();
        let run = Integrator::new(&pendulum(true), scheme, start, 1e-3).unwrap();
        run.observe(observed())
    }

    fn resumed(path: &str) -> Observed {
        let saved = Checkpoint::load(path).unwrap();
        let scheme = IntersectingSubTrajectories::default();
        let run = Integrator::resume(&pendulum(true), scheme, saved).unwrap();
        run.observe(observed())
    }

    /// The process that is killed: it goes on with the saved run, or begins one, and saves it.
    #[test]
    fn victim() {
        let Ok(path) = std::env::var(PLACE) else {
            return;
        };
        let mut run = match std::fs::exists(&path).unwrap() {
            true => resumed(&path),
            false => fresh(),
        };
        loop {
            run.advance(CHUNK).unwrap();
            run.checkpoint().save(&path).unwrap();
        }
    }

    #[test]
    fn a_killed_run_goes_on_with_the_same_bits() {
        let directory = place("killed");
        std::fs::create_dir_all(&directory).unwrap();
        let path = directory.join("run").display().to_string();
        let mut random = 0x9e37_79b9_7f4a_7c15_u64;
        let (mut steps, mut went_on) = (0, 0);
        for _ in 0..100 {
            let mut victim = Command::new(std::env::current_exe().unwrap())
                .args(["--exact", "checkpoint::kills::victim"])
                .env(PLACE, &path)
                .stdout(Stdio::null())
                .spawn()
                .unwrap();
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            std::thread::sleep(Duration::from_micros(4_000 + (random >> 33) % 36_000));
            assert_eq!(victim.try_wait().unwrap(), None, "it ended by itself");
            victim.kill().unwrap();
            victim.wait().unwrap();
            if steps > 0 || std::fs::exists(&path).unwrap() {
                // The file is whole, and never an older one.
                let saved = Checkpoint::load(&path).unwrap().steps();
                assert!(saved >= steps && saved.is_multiple_of(CHUNK));
                went_on += u32::from(saved > steps);
                steps = saved;
            }
        }
        let again = resumed(&path);
        std::fs::remove_dir_all(&directory).unwrap();
        assert!(went_on > 1, "{went_on} of 100 got as far as saving");
        let mut whole = fresh();
        whole.advance(steps).unwrap();
        assert_eq!(again.state(), whole.state());
        assert_eq!(again.carried(), whole.carried());
        assert_eq!(again.observer().0, whole.observer().0);
        assert_eq!(again.observer().1.inner(), whole.observer().1.inner());
    }
}
