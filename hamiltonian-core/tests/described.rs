//! A system that is made at run time, with its names and formulas from a text.

use hamiltonian_core::prelude::*;
use hamiltonian_core::private::DVector;
use hamiltonian_core::schemes::author::{
    Description, Dynamics, Flow, Group, Observable, ObservableKind, Piece, Point, VectorField,
};
use hamiltonian_core::systems::NamedPiece;
use hamiltonian_core::{
    Exact, Split, TimeTransformed, Unforced, Vector,
    observers::{Event, Events},
};
use hamiltonian_lanes::Pack;
use std::sync::Arc;

/// H = Σ (p² + k q²)/2, with a name for each coordinate, and the coordinates as observables.
#[derive(Debug, Clone)]
struct Springs {
    description: Arc<Description>,
    k: f64,
}

/// `name: x y z; k`
fn read(text: &str) -> Springs {
    let (name, rest) = text.split_once(": ").expect("a name");
    let (names, k) = rest.split_once("; ").expect("names");
    let names: Vec<&str> = names.split(' ').collect();
    let sum = |parts: Vec<String>| parts.join(" + ");
    let kinetic = sum(names.iter().map(|q| format!("p_{q}^2/2")).collect());
    let potential = sum(names.iter().map(|q| format!("{k}*{q}^2/2")).collect());
    let groups = names.iter().enumerate().map(|(offset, q)| Group {
        coordinate: q.to_string().into(),
        momentum: format!("p_{q}").into(),
        offset,
        ..Group::scalar("", "", 0)
    });
    let observables = names.iter().map(|q| Observable {
        name: format!("at_{q}").into(),
        reads: [true, false],
        ..Observable::new(ObservableKind::Event, "")
    });
    let piece = |formula: &String| NamedPiece {
        name: formula.clone().into(),
        formula: formula.clone().into(),
        jumps: false,
    };
    let description = Description {
        name: name.to_owned().into(),
        formula: format!("H = {kinetic} + {potential}").into(),
        groups: groups.collect(),
        observables: observables.collect(),
        pieces: [&potential, &kinetic].map(piece).to_vec().into(),
        growth: Some(2),
        ..Description::NONE
    };
    Springs {
        description: Arc::new(description),
        k: k.parse().expect("a number"),
    }
}

impl System for Springs {
    type Shape = DVector<()>;
    type Prepared<T: Real> = Springs;
    fn description(&self) -> &Description {
        &self.description
    }
    fn prepare<T: Real>(&self) -> Springs {
        self.clone()
    }
    fn zeros<T: Real>(&self) -> DVector<T> {
        DVector::from_element(self.description.groups.len(), T::zero())
    }
    fn gather<T: Real, P: Pack>(members: &[&Springs]) -> Springs {
        members[0].clone()
    }
    fn fits<T: Real>(a: &Springs, b: &Springs) -> bool {
        a.description == b.description
    }
    fn equals<T: Real>(a: &Springs, b: &Springs) -> bool {
        a.k == b.k
    }
}
impl Unforced for Springs {}
impl Exact for Springs {}
impl hamiltonian_core::Autonomous for Springs {}

type V<T> = DVector<T>;

impl<T: Real> Dynamics<T> for Springs {
    type Vector = V<T>;
    type Field = Moving<T>;
    fn description(&self) -> &Description {
        &self.description
    }
    fn energy(&self, _: T, q: &V<T>, p: &V<T>) -> T {
        let (k, half) = (T::constant(self.k, 0.0), T::constant(0.5, 0.0));
        let terms = q.iter().zip(p.iter());
        terms.fold(T::zero(), |sum, (q, p)| {
            sum + half * (*p * *p + k * *q * *q)
        })
    }
    fn gradient_q(&self, _: T, q: &V<T>, _: &V<T>, out: &mut V<T>) {
        out.copy_from(q);
        out.scale(T::constant(self.k, 0.0));
    }
    fn gradient_p(&self, _: T, _: &V<T>, p: &V<T>, out: &mut V<T>) {
        out.copy_from(p);
    }
    fn time_derivative(&self, _: T, _: &V<T>, _: &V<T>) -> T {
        T::zero()
    }
    fn hessian_vector(
        &self,
        _: T,
        _: &V<T>,
        _: &V<T>,
        vq: &V<T>,
        vp: &V<T>,
        out_q: &mut V<T>,
        out_p: &mut V<T>,
    ) {
        out_q.copy_from(vq);
        out_q.scale(T::constant(self.k, 0.0));
        out_p.copy_from(vp);
    }
    fn observable(&self, index: usize, _: T, q: &V<T>, _: &V<T>) -> T {
        q[index]
    }
    fn field(&self, c: T) -> Moving<T> {
        Moving([c, c], T::constant(self.k, 0.0))
    }
}

/// Coefficients of the drift and of the kick.
#[derive(Debug, Clone)]
struct Moving<T>([T; 2], T);

impl<T: Real> VectorField<V<T>> for Moving<T> {
    fn add(&self, _: T, q: &V<T>, p: &V<T>, into_q: &mut V<T>, into_p: &mut V<T>) {
        let Moving([drift, kick], k) = self;
        into_q.accumulate(*drift, p);
        into_p.accumulate(-*kick * *k, q);
    }
}

/// The piece of this number.
#[derive(Debug, Clone, Copy)]
struct Numbered(usize);

impl<T: Real> Piece<T, Springs> for Numbered {
    type Point = Point<V<T>>;
    type Flow = Moving<T>;
    fn flow(&self, prepared: &Springs, c: T) -> Moving<T> {
        let both = [[T::zero(), c], [c, T::zero()]];
        Moving(both[self.0], T::constant(prepared.k, 0.0))
    }
}

impl<T: Real> Flow<Point<V<T>>> for Moving<T> {
    const NAME: &'static str = "";
    type Work = ();
    fn apply(&self, _: T, x: &mut Point<V<T>>, (): &mut ()) {
        let Moving([drift, kick], k) = self;
        x.p.accumulate(-*kick * *k, &x.q);
        x.q.accumulate(*drift, &x.p);
    }
}

impl Split for Springs {
    type Pieces<T: Real> = (Numbered, Numbered);
    fn pieces<T: Real>() -> Self::Pieces<T> {
        (Numbered(0), Numbered(1))
    }
}

fn start() -> State<DVector<f64>> {
    State::new(vec![1.0, 0.5], vec![0.0, 0.0])
}

#[test]
fn a_system_made_at_run_time_has_names() -> Result<(), Error> {
    let system = read("Pair: x y; 4.0");
    let mut run = Integrator::new(&system, BlanesMoan4, start(), 0.01)?
        .observe((Recorder::new(), Events::new([Event::named("at_y")])));
    run.advance(100)?;
    let (recorder, events) = run.observer();
    let columns = ["t", "x", "y", "p_x", "p_y", "at_x", "at_y"];
    assert_eq!(recorder.columns(), columns);
    // y = cos(2t)/2 is 0 at π/4.
    assert!((events.located()[0].state.t - core::f64::consts::FRAC_PI_4).abs() < 1e-8);
    assert!(format!("{run:?}").contains("\"Pair\""));
    let long = State::new(vec![1.0; 3], vec![0.0; 2]);
    let refused = Integrator::new(&system, Strang, long, 0.01).expect_err("three of two");
    assert!(refused.to_string().contains("`x`"), "{refused}");
    // In the time of an observable, a function of the names.
    let far = State::new(vec![1.0, 0.5], vec![0.0, 3.0]);
    let slow = TimeTransformed::by(system, "at_x")?;
    let described = slow.description();
    assert_eq!(
        (described.clock(), &*described.groups[2].momentum),
        ("s", "p_t")
    );
    let run = Integrator::new(&slow, Gauss::<2>::default(), slow.start(&far)?, 0.01)?;
    assert_eq!(run.prepared().description().groups.len(), 3);
    Ok(())
}

/// Systems of one type are told apart by their descriptions.
#[test]
fn saved_runs_belong_to_one_description() -> Result<(), Error> {
    let system = read("Pair: x y; 4.0");
    let mut run = Integrator::new(&system, Strang, start(), 0.01)?;
    run.advance(10)?;
    let saved = || run.checkpoint();
    assert!(Integrator::resume(&system, Strang, saved()).is_ok());
    for (other, what) in [
        ("Pair: x z; 4.0", "p_z^2/2"),
        ("Two: x y; 4.0", "Two"),
        ("Pair: x y; 5.0", "5.0*x^2/2"),
    ] {
        let refused = Integrator::resume(&read(other), Strang, saved());
        let refused = refused.map(|_| ()).expect_err(what).to_string();
        assert!(refused.contains(what), "{refused}");
    }
    Ok(())
}

/// Pieces in another order make other steps: saved runs, ensembles and stores refuse them, and show both.
#[test]
fn other_pieces_are_refused() -> Result<(), Error> {
    let system = read("Pair: x y; 4.0");
    let mut other = system.clone();
    Arc::make_mut(&mut other.description)
        .pieces
        .to_mut()
        .reverse();
    let shows_both = |refused: Error| {
        let text = refused.to_string();
        let [kinetic, potential] = ["p_x^2/2 + p_y^2/2", "4.0*x^2/2 + 4.0*y^2/2"];
        assert!(text.contains("piece"), "{text}");
        assert!(text.contains(kinetic) && text.contains(potential), "{text}");
    };
    let saved = Integrator::new(&system, Strang, start(), 0.01)?.checkpoint();
    assert!(Integrator::resume(&system, Strang, saved.clone()).is_ok());
    let resumed = Integrator::resume(&other, Strang, saved);
    shows_both(resumed.map(|_| ()).expect_err("other pieces"));
    let make = |system: &Springs| {
        let system = system.clone();
        move |_: Member| (system.clone(), start())
    };
    let saved = Ensemble::new(3, make(&system), Strang, 0.01)?.checkpoint();
    let resumed = Ensemble::resume(3, make(&other), Strang, saved);
    shows_both(resumed.map(|_| ()).expect_err("other pieces"));
    let path = std::env::temp_dir().join(format!("pieces-{}.zarr", std::process::id()));
    let sweep = |system: &Springs| {
        let sweep = Sweep::new(3, make(system), Strang, 0.01).with_steps(5);
        sweep.record(["x"], |end| [end.state.q[0]]).store(&path)
    };
    sweep(&system)?;
    let (again, refused) = (sweep(&system), sweep(&other));
    std::fs::remove_dir_all(&path)?;
    again?;
    shows_both(refused.map(|_| ()).expect_err("other pieces"));
    Ok(())
}
