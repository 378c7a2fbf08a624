//! The views of observers, and the files they write.

use crate::common::systems::*;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::{DVector, Group, SVector};
use hamiltonian_core::{
    Observer, Vector, View,
    schemes::author::{Description, Dynamics, Pair},
};
use hamiltonian_lanes::Pack;

use std::ops::ControlFlow;

type One = SVector<f64, 1>;

fn run() -> Run<Hand<Pendulum, 1>, StormerVerlet> {
    let start = State::new([0.7], [0.0]);
    Integrator::new(&pendulum(true), StormerVerlet::default(), start, 0.01).unwrap()
}

/// The steps at which it is shown a state.
#[derive(Default)]
struct Steps(Vec<u64>);

impl<S: System> Observer<f64, S> for Steps {
    fn observe(&mut self, view: &View<'_, f64, S>) -> ControlFlow<()> {
        self.0.push(view.steps);
        ControlFlow::Continue(())
    }
}

#[test]
fn the_start_and_every_multiple_are_seen_on_every_path() {
    let seen = |drive: &dyn Fn(&mut Integrator<_, _, _, _>)| {
        let mut run = run().observe((every(4, Steps::default()), every(6, Steps::default())));
        drive(&mut run);
        let (fours, sixes) = run.into_observer();
        (fours.into_inner().0, sixes.into_inner().0)
    };
    let expected = (vec![0, 4, 8, 12, 16], vec![0, 6, 12]);
    assert_eq!(
        seen(&|run| assert_eq!(run.advance(17).unwrap().t, 0.17)),
        expected
    );
    assert_eq!(
        seen(&|run| assert_eq!(run.advance_to(0.17).unwrap().t, 0.17)),
        expected
    );
    assert_eq!(
        seen(&|run| assert_eq!(run.states(1).take(17).count(), 17)),
        expected
    );
    assert_eq!(
        seen(&|run| {
            for n in [3, 5, 0, 9] {
                run.advance(n).unwrap();
            }
        }),
        expected
    );
    // Attached late: the present state, then multiples.
    let mut late = run();
    late.advance(5).unwrap();
    let mut late = late.observe(every(4, Steps::default()));
    late.advance(8).unwrap();
    assert_eq!(late.observer().inner().0, [5, 8, 12]);
}

#[test]
fn drifts_are_those_of_the_states() {
    let mut energies = Vec::new();
    let mut heights = Vec::new();
    let mut plain = run();
    let prepared = System::prepare::<f64>(&pendulum(true));
    let mut record = |state: &State<One>| {
        energies.push(prepared.energy(state.t, &state.q, &state.p));
        heights.push(-10.0 * state.q[0].cos());
    };
    record(plain.state());
    for state in plain.states(1).take(500) {
        record(&state.unwrap());
    }
    let mut drift = EnergyDrift::new();
    let mut monitors = Monitors::new();
    run()
        .observe((&mut drift, &mut monitors))
        .advance(500)
        .unwrap();
    let worst = energies
        .iter()
        .map(|h| (h - energies[0]).abs())
        .fold(0.0, f64::max);
    assert_eq!(drift.max_relative(), worst / energies[0]);
    let sum: f64 = energies.iter().map(|h| (h - energies[0]).abs()).sum();
    assert_eq!(drift.mean_relative(), sum / 501.0 / energies[0]);
    // Two ways to add 501 numbers.
    let mean = energies.iter().sum::<f64>() / 501.0;
    assert!((drift.mean() / mean - 1.0).abs() <= 501.0 * f64::EPSILON);
    assert_eq!(drift.drift().unwrap().count(), 501);
    let height = monitors.get("height").unwrap();
    assert_eq!(height.start(), heights[0]);
    let worst = heights
        .iter()
        .map(|h| (h - heights[0]).abs())
        .fold(0.0, f64::max);
    assert_eq!(height.max_absolute(), worst);
    assert!(monitors.get("depth").is_none());
}

#[test]
fn csv_reads_back_to_the_same_bits() {
    let mut run = run().observe(every(100, Recorder::new()));
    run.advance(300).unwrap();
    let recorder = run.observer().inner();
    let mut csv = Vec::new();
    recorder.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("t,theta,p,height"));
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 4);
    assert!(recorder.iter().eq(rows.iter().map(Vec::as_slice)));
    let last = run.state();
    assert_eq!(
        rows[3],
        [last.t, last.q[0], last.p[0], -10.0 * Real::cos(last.q[0])]
    );
}

#[test]
fn names_of_a_chain() {
    let start = State::new(vec![0.1, 0.2], vec![0.0, 0.3]);
    let run = Integrator::new(&Chain { n: 2 }, StormerVerlet::default(), start, 0.1).unwrap();
    let run = run.observe(Recorder::new());
    assert_eq!(
        run.observer().columns(),
        ["t", "q[0]", "q[1]", "p[0]", "p[1]"]
    );
    assert_eq!(run.observer().row(0), Some(&[0.0, 0.1, 0.2, 0.0, 0.3][..]));
}

/// Two bodies in space and an angle: rank 2 is stored by columns and named by rows.
#[test]
fn names_of_mixed_shapes() {
    #[derive(Debug, Clone)]
    struct Mixed;
    type Matrix<T> = hamiltonian_core::private::SMatrix<T, 2, 3>;
    type V<T> = Pair<Matrix<T>, SVector<T, 1>>;
    type Matrix3 = Matrix<f64>;
    const GROUPS: &[Group] = &[
        Group::array("x", "u", 2, 0, 3),
        Group::array("a", "l", 0, 1, 1),
    ];
    const MIXED: &Description = &Description::new("Mixed", GROUPS);
    impl System for Mixed {
        type Shape = V<()>;
        type Prepared<T: Real> = Mixed;
        fn description(&self) -> &Description {
            MIXED
        }
        fn prepare<T: Real>(&self) -> Mixed {
            Mixed
        }
        fn zeros<T: Real>(&self) -> V<T> {
            Pair {
                x: Matrix::from_element(T::zero()),
                y: SVector::from_element(T::zero()),
            }
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
    #[derive(Debug, Clone)]
    struct NoField;
    impl<T: Real> hamiltonian_core::schemes::author::VectorField<V<T>> for NoField {
        fn add(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>, _: &mut V<T>) {}
    }
    impl<T: Real> Dynamics<T> for Mixed {
        type Vector = V<T>;
        type Field = NoField;
        fn description(&self) -> &Description {
            MIXED
        }
        fn energy(&self, _: T, _: &V<T>, _: &V<T>) -> T {
            T::zero()
        }
        fn gradient_q(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>) {}
        fn gradient_p(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>) {}
        fn gradient(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>, _: &mut V<T>) {}
        fn energy_and_gradient(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>, _: &mut V<T>) -> T {
            T::zero()
        }
        fn time_derivative(&self, _: T, _: &V<T>, _: &V<T>) -> T {
            T::zero()
        }
        fn hessian_vector(
            &self,
            _: T,
            _: &V<T>,
            _: &V<T>,
            _: &V<T>,
            _: &V<T>,
            _: &mut V<T>,
            _: &mut V<T>,
        ) {
        }
        fn observable(&self, _: usize, _: T, _: &V<T>, _: &V<T>) -> T {
            T::zero()
        }
        fn field(&self, _: T) -> NoField {
            NoField
        }
    }
    let q = Pair {
        x: Matrix3::from_row_slice(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        y: One::new(7.0),
    };
    let state = State::new(q.clone(), q);
    let run = Integrator::new(&Mixed, RungeKutta4, state, 1.0).unwrap();
    let run = run.observe(Recorder::new());
    let recorder = run.observer();
    let columns = recorder.columns();
    assert_eq!(
        columns[..5],
        ["t", "x[0][0]", "x[0][1]", "x[0][2]", "x[1][0]"]
    );
    assert_eq!(columns[7..9], ["a", "u[0][0]"]);
    assert_eq!(
        recorder.row(0).unwrap()[..8],
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    );
}

#[test]
fn vectors_by_flat_index() {
    let q = Pair {
        x: One::new(3.0),
        y: DVector::from_vec(vec![4.0, -6.0]),
    };
    assert_eq!((q.len(), q.component(0), q.component(2)), (3, 3.0, -6.0));
    assert_eq!(q.magnitude(), 6.0);
    assert_eq!(q.components().collect::<Vec<_>>(), [3.0, 4.0, -6.0]);
    let mut sum = q.clone();
    sum.accumulate(0.5, &q);
    sum.scale(2.0);
    assert_eq!(sum.components().collect::<Vec<_>>(), [9.0, 12.0, -18.0]);
    assert_eq!(sum.distance(&q), 12.0);
    *sum.component_mut(1) = f64::NAN;
    assert!(!sum.is_finite() && sum.magnitude().is_nan() && sum.distance(&q).is_nan());
    sum.set_zero();
    assert_eq!(sum, q.zeros_like());
    let longer = Pair {
        x: One::new(3.0),
        y: DVector::from_vec(vec![4.0; 3]),
    };
    assert!(q.same_shape(&sum) && !q.same_shape(&longer));
}

/// A closure beside an observer: attached where it is, shown multiples of its interval, its
/// argument without a type.
#[test]
fn closures_watch_beside_an_observer() {
    let mut alone = run().observe(EnergyDrift::new());
    let (mut seen, mut others) = (Vec::new(), 0);
    let mut watched = run();
    watched.advance(5).unwrap();
    let mut watched = watched
        .watch(3, |view| seen.push((view.steps, view.state.q[0])))
        .watch(0, |_| others += 1);
    alone.advance(11).unwrap();
    watched.advance(6).unwrap();
    assert_eq!(watched.state(), alone.state());
    let steps: Vec<u64> = seen.iter().map(|(step, _)| *step).collect();
    assert_eq!((steps, others), (vec![5, 6, 9], 7));
    let mut again = run()
        .observe(EnergyDrift::new())
        .watch(1, |view| assert!(view.energy() < 99.0));
    again.advance(11).unwrap();
    assert_eq!(again.observer().0, *alone.observer());
}

/// Code for any system reaches observables and their gradients by name.
#[test]
fn observables_by_name_in_generic_code() {
    fn slope<S: System>(system: &S, name: &str, q: f64) -> Option<f64> {
        let zeros = <S as System>::zeros::<f64>(system);
        let mut state = State {
            t: 0.0,
            q: zeros.clone(),
            p: zeros,
        };
        *state.q.component_mut(0) = q;
        let gradient = system.observable_gradient(name, &state)?;
        assert_eq!(gradient.p.component(0), 0.0);
        Some(gradient.q.component(0))
    }
    // height = −10 cos θ
    let system = pendulum(true);
    assert_eq!(slope(&system, "height", 0.3), Some(10.0 * 0.3_f64.sin()));
    assert_eq!(slope(&system, "depth", 0.3), None);
    let mut run = run();
    let state = run.advance(10).unwrap().clone();
    let height = Some(-10.0 * state.q[0].cos());
    assert_eq!(system.observable_named("height", &state), height);
    assert_eq!(run.observable_named("height"), height);
    assert_eq!(run.observable_named("depth"), None);
    let mut seen = Vec::new();
    let mut run = run.watch(1, |view| seen.push(view.observable_named("height")));
    run.advance(1).unwrap();
    drop(run);
    assert_eq!(seen[0], height);
    // No force acts.
    assert_eq!(system.force_at(&state)[0], 0.0);
}
