//! H(t) with jumps at the ends of steps: each scheme is that of smooth systems one after the other, or is refused.

use crate::common::systems::{Formula, Halves, Hand};
use hamiltonian_core::errors::StartError;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_compensated, visit_doubled, visit_energy, visit_exact,
    visit_implicit, visit_nystrom, visit_quadratic, visit_separable, visit_split, visit_unforced,
};
use hamiltonian_core::schemes::{
    Adjoint, Compensated, Composition, Gauss, ImplicitMidpoint, KahanLi6, RungeKutta4, Srkn6b,
    StormerVerlet, Strang, Suzuki4, SymplecticEuler, author::Group,
};
use hamiltonian_core::{Error, Integrator, QuadraticKinetic, Real, Scheme, State};

/// H = a(t)·p²/2 + b(t)·(q²/2 + q⁴/4)(1 + cos(t)/4); a jumps twice if `T`, b if `V`. `SAID` is true if the constants
/// say so.
#[derive(Debug, Clone)]
struct Switched<const V: bool, const T: bool, const SAID: bool> {
    /// The times of the jumps.
    at: [f64; 2],
    /// True if the earlier value holds at such a time.
    includes: bool,
    /// a or b before, between and after.
    values: [f64; 3],
}

impl<const V: bool, const T: bool, const SAID: bool> Switched<V, T, SAID> {
    fn factor<R: Real>(&self, t: R) -> R {
        let [before, between, after] = self.values.map(|x| R::constant(x, 0.0));
        let [first, second] = self.at.map(|at| {
            let at = R::constant(at, 0.0);
            if self.includes { t.le(at) } else { t.lt(at) }
        });
        R::select(first, before, R::select(second, between, after))
    }
    fn factors<R: Real>(&self, t: R) -> [R; 2] {
        let sways = R::one() + R::constant(0.25, 0.0) * t.cos();
        let one = R::one();
        let factor = self.factor(t);
        [
            if T { factor } else { one },
            if V { factor * sways } else { sways },
        ]
    }
    /// The smooth system before the jumps, between them or after them.
    fn smooth(&self, part: usize) -> Self {
        let values = [self.values[part]; 3];
        Switched {
            values,
            ..self.clone()
        }
    }
}

impl<const V: bool, const T: bool, const SAID: bool> Formula<1> for Switched<V, T, SAID> {
    const NAME: &'static str = "Switched";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    const JUMPING: [bool; 2] = [V && SAID, T && SAID];
    fn energy<R: Real>(&self, t: R, [q]: &[R; 1], [p]: &[R; 1]) -> R {
        let [a, b] = self.factors(t);
        let (half, quarter) = (R::constant(0.5, 0.0), R::constant(0.25, 0.0));
        let square = *q * *q;
        a * half * *p * *p + b * (half * square + quarter * square * square)
    }
    fn gradient<R: Real>(&self, t: R, q: &[R; 1], p: &[R; 1]) -> ([R; 1], [R; 1]) {
        (self.force(t, q), self.velocity(t, p))
    }
}

impl<const V: bool, const T: bool, const SAID: bool> Halves<1> for Switched<V, T, SAID> {
    /// ∂V/∂q
    fn force<R: Real>(&self, t: R, [q]: &[R; 1]) -> [R; 1] {
        [self.factors(t)[1] * (*q + *q * *q * *q)]
    }
    fn velocity<R: Real>(&self, t: R, [p]: &[R; 1]) -> [R; 1] {
        [self.factors(t)[0] * *p]
    }
}

impl<const SAID: bool> QuadraticKinetic for Hand<Switched<true, false, SAID>, 1> {}

/// A linear congruential generator of numbers from 0 to 1.
struct Numbers(u64);

impl Numbers {
    fn part(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

type System<const V: bool, const T: bool, const SAID: bool> = Hand<Switched<V, T, SAID>, 1>;

/// A generated system with a start: the numbers of steps before, between and after the jumps.
struct Case<const V: bool, const T: bool, const SAID: bool> {
    system: Switched<V, T, SAID>,
    start: State<SVector<f64, 1>>,
    h: f64,
    counts: [u64; 3],
}

impl<const V: bool, const T: bool, const SAID: bool> Case<V, T, SAID> {
    fn new(numbers: &mut Numbers) -> Self {
        let h = 0.04 + 0.06 * numbers.part();
        let start = State::new([0.4 + numbers.part()], [numbers.part() - 0.5]).at(numbers.part());
        let counts = [2.0, 1.0, 2.0].map(|least| (least + 4.0 * numbers.part()) as u64);
        let system = Switched {
            at: [counts[0], counts[0] + counts[1]].map(|steps| h.fma(steps as f64, start.t)),
            includes: numbers.part() < 0.5,
            values: [1.5, 0.5, 1.5].map(|least| least + numbers.part()),
        };
        Case {
            system,
            start,
            h,
            counts,
        }
    }

    /// The same with steps of a fraction of the size.
    fn finer(&self, by: u64) -> Self {
        Case {
            system: self.system.clone(),
            start: self.start.clone(),
            h: self.h / by as f64,
            counts: self.counts.map(|steps| by * steps),
        }
    }

    /// The end of a run, or its error.
    fn end<M: Scheme<System<V, T, SAID>>>(&self, scheme: M) -> Result<[f64; 2], Error> {
        let system = Hand(self.system.clone());
        let mut run = Integrator::new(&system, scheme, self.start.clone(), self.h)?;
        run.advance(self.counts.iter().sum())
            .map(|end| [end.q[0], end.p[0]])
    }

    /// The end of runs of the smooth systems, each from the end of the one before.
    fn in_parts<M: Scheme<System<V, T, SAID>>>(&self, scheme: M) -> [f64; 2] {
        let mut state = self.start.clone();
        for (part, steps) in self.counts.into_iter().enumerate() {
            let system = Hand(self.system.smooth(part));
            let mut run = Integrator::new(&system, scheme.clone(), state, self.h).expect("smooth");
            state = run.advance(steps).expect("finite").clone();
        }
        [state.q[0], state.p[0]]
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// Runs all generated cases with each scheme that it visits.
#[derive(Default)]
struct Walk {
    cases: u32,
    /// The cases with errors above rounding, in which the order is measured.
    measured: u32,
    accepted: Vec<String>,
    refused: Vec<String>,
}

/// The cases for each scheme.
const EACH: u64 = 18;

impl<const V: bool, const T: bool> Visitor<System<V, T, true>> for Walk {
    fn visit<M: Scheme<System<V, T, true>>>(&mut self, scheme: M) {
        let (name, order) = (scheme.entry().to_string(), scheme.entry().order);
        let mut numbers = Numbers(38 + self.cases as u64);
        for _ in 0..EACH {
            self.cases += 1;
            let case = Case::<V, T, true>::new(&mut numbers);
            // The smooth systems, by the method that every system accepts, with fine steps.
            let exact = case.finer(8).in_parts(Gauss::<4>::default());
            let end = match case.end(scheme.clone()) {
                Err(Error::Start(StartError::Jumps { .. })) => {
                    self.refused.push(name.clone());
                    continue;
                }
                Err(error) => panic!("{name}: {error}"),
                Ok(end) => end,
            };
            self.accepted.push(name.clone());
            // What is carried from step to step, such as a start of an iteration, may change the last digits.
            let off = distance(end, case.in_parts(scheme.clone()));
            assert!(off < 1e-11, "{name}: {off}");
            let errors = [1, 2, 4, 8].map(|by| {
                let end = case.finer(by).end(scheme.clone()).expect("accepted");
                distance(end, exact)
            });
            // Errors near rounding have no slope. The finest pair above it has that of the order.
            let above = |pair: &&[f64]| pair[1] > 2e-11;
            match errors.windows(2).rfind(above) {
                Some(pair) => {
                    let slope = (pair[0] / pair[1]).log2();
                    assert!(
                        (slope - f64::from(order)).abs() < 0.15,
                        "{name}: {slope}, {errors:?}"
                    );
                    self.measured += 1;
                }
                None => assert!(errors[3] < 2e-11, "{name}: {errors:?}"),
            }
        }
    }
}

impl Walk {
    /// The names of accepted and of refused schemes, each once.
    fn names(mut self) -> [Vec<String>; 2] {
        for names in [&mut self.accepted, &mut self.refused] {
            names.dedup();
        }
        [self.accepted, self.refused]
    }
}

#[test]
fn every_scheme_keeps_its_order_or_is_refused() {
    type DriftJumps = System<false, true, true>;
    type KickJumps = System<true, false, true>;
    let mut walk = Walk::default();
    visit_any::<DriftJumps>(&mut walk);
    visit_unforced::<DriftJumps>(&mut walk);
    visit_split::<DriftJumps>(&mut walk);
    visit_exact::<DriftJumps>(&mut walk);
    visit_separable::<DriftJumps>(&mut walk);
    visit_implicit::<DriftJumps>(&mut walk);
    visit_energy::<DriftJumps>(&mut walk);
    visit_doubled::<DriftJumps>(&mut walk);
    visit_compensated::<DriftJumps>(&mut walk);
    let (cases, measured) = (walk.cases, walk.measured);
    let [accepted, refused] = walk.names();
    let is_in = |names: &[String], name: &str| names.iter().any(|one| one.starts_with(name));
    for name in [
        "Strang",
        "BlanesMoan4",
        "KahanLi8",
        "StormerVerlet",
        "Gauss",
        "ImplicitMidpoint",
    ] {
        assert!(
            is_in(&accepted, name) && !is_in(&refused, name),
            "{name}: {accepted:?}"
        );
    }
    for name in [
        "RungeKutta4",
        "TwoStepMidpoint",
        "Pihajoki",
        "Tao",
        "Processed4",
        "Variational",
    ] {
        assert!(
            is_in(&refused, name) && !is_in(&accepted, name),
            "{name}: {refused:?}"
        );
    }
    let mut walk = Walk::default();
    visit_separable::<KickJumps>(&mut walk);
    visit_nystrom::<KickJumps>(&mut walk);
    visit_quadratic::<KickJumps>(&mut walk);
    visit_compensated::<KickJumps>(&mut walk);
    let (all, measured) = (cases + walk.cases, measured + walk.measured);
    let [accepted, refused] = walk.names();
    for name in [
        "StormerVerlet (kick",
        "StormerVerlet (drift",
        "Srkn14a",
        "GaussNystrom",
    ] {
        assert!(
            is_in(&accepted, name) && !is_in(&refused, name),
            "{name}: {accepted:?}"
        );
    }
    for name in ["Srkn6b", "SymplecticEuler", "Compensated"] {
        assert!(is_in(&refused, name), "{name}: {refused:?}");
    }
    assert!(all >= 900 && measured >= 300, "{all} cases, {measured}");
}

/// A scheme on a system whose V jumps is that of smooth systems, to rounding.
fn is_in_parts<M>(scheme: M, numbers: &mut Numbers)
where
    M: Scheme<System<true, false, true>>,
{
    for _ in 0..20 {
        let case = Case::<true, false, true>::new(numbers);
        let end = case.end(scheme.clone()).expect("accepted");
        let off = distance(end, case.in_parts(scheme.clone()));
        assert!(off < 1e-12, "{scheme:?}: {off}");
    }
}

#[test]
fn a_jump_at_the_end_of_a_step_ends_one_smooth_run_and_begins_another() {
    let mut numbers = Numbers(381);
    is_in_parts(StormerVerlet::KickDriftKick, &mut numbers);
    is_in_parts(StormerVerlet::DriftKickDrift, &mut numbers);
    is_in_parts(ImplicitMidpoint::default(), &mut numbers);
    is_in_parts(Suzuki4.of(StormerVerlet::default()), &mut numbers);
    is_in_parts(KahanLi6.of(ImplicitMidpoint::default()), &mut numbers);
    is_in_parts(
        Composition::yoshida(ImplicitMidpoint::default()),
        &mut numbers,
    );
    is_in_parts(Adjoint(StormerVerlet::default()), &mut numbers);
}

#[test]
fn schemes_that_evaluate_jumps_at_the_ends_of_steps_are_refused() {
    let mut numbers = Numbers(382);
    let case = Case::<true, true, true>::new(&mut numbers);
    // If both halves jump, one of them is evaluated at the ends of steps.
    let refused = |result: Result<[f64; 2], Error>| {
        let error = result.expect_err("refused");
        assert!(
            matches!(error, Error::Start(StartError::Jumps { .. })),
            "{error}"
        );
        assert!(error.to_string().contains("use `Gauss`"), "{error}");
    };
    refused(case.end(StormerVerlet::default()));
    refused(case.end(Strang));
    refused(case.end(Composition::with_adjoint(SymplecticEuler::default())));
    assert!(case.end(Gauss::<2>::default()).is_ok());
    // A system that does not say that it jumps is not refused, and these schemes are wrong.
    let mut worst = [f64::INFINITY; 4];
    for _ in 0..20 {
        let case = Case::<true, false, false>::new(&mut numbers);
        let off = [
            distance(
                case.end(StormerVerlet::default()).unwrap(),
                case.in_parts(StormerVerlet::default()),
            ),
            distance(case.end(RungeKutta4).unwrap(), case.in_parts(RungeKutta4)),
            distance(case.end(Srkn6b).unwrap(), case.in_parts(Srkn6b)),
            distance(
                case.end(Compensated(Strang)).unwrap(),
                case.in_parts(Compensated(Strang)),
            ),
        ];
        for (worst, off) in worst.iter_mut().zip(off) {
            *worst = worst.min(off);
        }
    }
    assert!(worst.iter().all(|off| *off > 1e-5), "{worst:?}");
}
