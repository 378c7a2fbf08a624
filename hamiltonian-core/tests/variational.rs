//! Variational integrators held against the actions they are made of.
//!
//! Input: degrees and quadratures. Output: the identities with Runge–Kutta methods, orders, forms,
//! momentum maps, forced motion. Invariant: actions are computed here from the Lagrangian and the
//! path, with none of the library's equations.

use super::common::measures::assert_order;
use super::common::start;
use super::common::systems::{
    DoublePendulum, Formula, Hand, Pendulum, Pumped, Relativistic, pendulum,
};
use super::schemes::{on_34, on_the_double_pendulum, symplectic};
use hamiltonian_core::VectorOf;
use hamiltonian_core::errors::{SearchError, StartError};
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::author::Ends;
use hamiltonian_core::schemes::collocation::Collocation;
use hamiltonian_core::schemes::*;
use hamiltonian_core::{
    Dual, Error, Integrator, Real, Scheme, State, System,
    schemes::author::{Description, Dynamics, Group, Listed, VectorField},
};
use hamiltonian_lanes::Pack;

type Pendulums = Hand<DoublePendulum, 2>;
type Pair = [f64; 2];

/// L of the double pendulum, whose mass depends on the angles.
fn lagrangian<T: Real>(q: [T; 2], v: [T; 2]) -> T {
    let (half, two, g) = (number::<T>(0.5), number::<T>(2.0), number::<T>(9.81));
    let coupled = v[0] * v[1] * (q[0] - q[1]).cos();
    v[0] * v[0] + half * v[1] * v[1] + coupled + g * (two * q[0].cos() + q[1].cos())
}

fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

/// Lagrange's polynomials on `knots` and their derivatives at x.
fn lagrange(knots: &[f64], x: f64) -> Vec<(f64, f64)> {
    (0..knots.len())
        .map(|k| {
            let (mut value, mut slope) = (1.0, 0.0);
            for (j, knot) in knots.iter().enumerate().filter(|(j, _)| *j != k) {
                assert_ne!(j, k);
                let scale = 1.0 / (knots[k] - knot);
                slope = slope * (x - knot) * scale + value * scale;
                value *= (x - knot) * scale;
            }
            (value, slope)
        })
        .collect()
}

/// S of the path through `points` at equal distances in time.
fn action<T: Real>(points: &[[T; 2]], nodes: &[f64], weights: &[f64], h: f64) -> T {
    let last = (points.len() - 1) as f64;
    let knots: Vec<_> = (0..points.len()).map(|k| k as f64 / last).collect();
    let mut sum = T::zero();
    for (c, b) in nodes.iter().zip(weights) {
        let (mut q, mut v) = ([T::zero(); 2], [T::zero(); 2]);
        for (point, (value, slope)) in points.iter().zip(lagrange(&knots, *c)) {
            for k in 0..2 {
                q[k] += number::<T>(value) * point[k];
                v[k] += number::<T>(slope / h) * point[k];
            }
        }
        sum += number::<T>(h * b) * lagrangian(q, v);
    }
    sum
}

/// The momenta −∂S/∂q₀, ∂S/∂q₁ of the path of this degree from q₀ to q₁ that makes S stationary.
fn momenta(degree: usize, nodes: &[f64], weights: &[f64], h: f64, ends: [Pair; 2]) -> [Pair; 2] {
    let mut points: Vec<Pair> = (0..=degree)
        .map(|k| {
            let x = k as f64 / degree as f64;
            [0, 1].map(|i| ends[0][i] + x * (ends[1][i] - ends[0][i]))
        })
        .collect();
    let gradient = |points: &[Pair], at: usize| {
        let mut lifted: Vec<_> = points.iter().map(|p| p.map(Dual::fixed)).collect();
        lifted[at / 2][at % 2].eps = 1.0;
        action(&lifted, nodes, weights, h).eps
    };
    let inner = 2..2 * degree;
    let n = inner.len();
    for _ in 0..8 * usize::from(n > 0) {
        // Newton's method, with second derivatives by dual numbers of dual numbers.
        let mut matrix = vec![vec![0.0; n + 1]; n];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate().take(n) {
                let mut lifted: Vec<_> = (points.iter())
                    .map(|p| p.map(|x| Dual::fixed(Dual::fixed(x))))
                    .collect();
                lifted[(i + 2) / 2][i % 2].eps.re = 1.0;
                lifted[(j + 2) / 2][j % 2].re.eps = 1.0;
                *entry = action(&lifted, nodes, weights, h).eps.eps;
            }
            row[n] = gradient(&points, i + 2);
        }
        for k in 0..n {
            let pivot = (k..n).max_by(|a, b| matrix[*a][k].abs().total_cmp(&matrix[*b][k].abs()));
            matrix.swap(k, pivot.expect("a row"));
            let pivot = matrix[k].clone();
            for (_, row) in matrix.iter_mut().enumerate().filter(|(i, _)| *i != k) {
                let factor = row[k] / pivot[k];
                for (entry, pivot) in row.iter_mut().zip(&pivot) {
                    *entry -= factor * pivot;
                }
            }
        }
        for (i, row) in matrix.iter().enumerate() {
            points[(i + 2) / 2][i % 2] -= row[n] / row[i];
        }
    }
    let of = |at: usize| gradient(&points, at);
    [[-of(0), -of(1)], [of(2 * degree), of(2 * degree + 1)]]
}

/// One step from `(q, p)`.
fn step(scheme: impl Scheme<Pendulums>, h: f64, q: Pair, p: Pair) -> (Pair, Pair) {
    let system = Hand(DoublePendulum);
    let run = Integrator::new(&system, scheme, State::new(q, p), h);
    let mut run = run.expect("a good start");
    let end = run.advance(1).expect("a good step");
    ([end.q[0], end.q[1]], [end.p[0], end.p[1]])
}

/// One step of the partitioned Runge–Kutta method Lobatto IIIA–IIIB, by plain iteration.
fn lobatto<const S: usize>(h: f64, q: Pair, p: Pair) -> (Pair, Pair) {
    partitioned::<S>(h, q, p, false)
}

/// The same, or IIIB–IIIA where the momenta are `first`.
fn partitioned<const S: usize>(h: f64, q: Pair, p: Pair, first: bool) -> (Pair, Pair) {
    let method = Collocation::<S>::lobatto();
    let formula = DoublePendulum;
    let mut slopes = [([0.0; 2], [0.0; 2]); S];
    let sum =
        |of: &[([f64; 2], [f64; 2]); S], a: &dyn Fn(usize) -> f64, k: usize, momenta: bool| {
            let slope = |j: usize| if momenta { -of[j].0[k] } else { of[j].1[k] };
            h * (0..S).map(|j| a(j) * slope(j)).sum::<f64>()
        };
    for _ in 0..200 {
        let before = slopes;
        for (i, slope) in slopes.iter_mut().enumerate() {
            let a = |j: usize| method.a(i, j).hi();
            let conjugate = |j: usize| method.conjugate(i, j).hi();
            let (of_q, of_p): (&dyn Fn(usize) -> f64, &dyn Fn(usize) -> f64) = match first {
                false => (&a, &conjugate),
                true => (&conjugate, &a),
            };
            let at = |k: usize| q[k] + sum(&before, of_q, k, false);
            let with = |k: usize| p[k] + sum(&before, of_p, k, true);
            *slope = formula.gradient(0.0, &[at(0), at(1)], &[with(0), with(1)]);
        }
    }
    let b = |j: usize| method.weights[j].hi();
    (
        [0, 1].map(|k| q[k] + sum(&slopes, &b, k, false)),
        [0, 1].map(|k| p[k] + sum(&slopes, &b, k, true)),
    )
}

fn apart(a: (Pair, Pair), b: (Pair, Pair)) -> f64 {
    let pairs = [(a.0, b.0), (a.1, b.1)];
    (pairs.iter())
        .flat_map(|(a, b)| [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()])
        .fold(0.0, f64::max)
}

const START: (Pair, Pair) = ([0.8, -0.4], [0.3, 0.2]);

/// The distance of a scheme's step from the stationary path of the action in the Lagrangian between the
/// same ends.
fn from_the_action<const D: usize, const S: usize>(
    scheme: Variational<D, S>,
    method: &Collocation<S>,
) -> f64 {
    let h = 0.1;
    let (q, p) = START;
    let end = step(scheme, h, q, p);
    let nodes = method.nodes.map(|c| c.hi());
    let weights = method.weights.map(|b| b.hi());
    let [p0, p1] = momenta(D, &nodes, &weights, h, [q, end.0]);
    let name = scheme.entry().variant;
    let error = apart((p, end.1), (p0, p1));
    println!("degree {D}, {S} points, {name}: {error:.1e}");
    error
}

#[test]
fn steps_make_the_action_in_the_lagrangian_stationary() {
    fn check<const D: usize, const S: usize>() {
        let gauss = from_the_action(Variational::<D, S>::gauss(), &Collocation::gauss());
        // Velocities are differences of coordinates over h.
        assert!(gauss <= 1e-13, "{gauss:e}");
    }
    fn lobatto<const D: usize, const S: usize>() {
        let error = from_the_action(Variational::<D, S>::lobatto(), &Collocation::lobatto());
        assert!(error <= 1e-13, "{error:e}");
    }
    check::<1, 1>();
    check::<2, 2>();
    check::<3, 3>();
    check::<1, 2>();
    check::<2, 4>();
    lobatto::<1, 2>();
    lobatto::<2, 2>();
    lobatto::<2, 3>();
    lobatto::<3, 3>();
    lobatto::<3, 4>();
    // Negative control: the path of another degree.
    let wrong = from_the_action(Variational::<1, 2>::lobatto(), &Collocation::lobatto());
    let (q, p) = START;
    let end = step(Variational::<1, 2>::lobatto(), 0.1, q, p);
    let [p0, p1] = momenta(2, &[0.0, 1.0], &[0.5, 0.5], 0.1, [q, end.0]);
    assert!(apart((p, end.1), (p0, p1)) > 1e6 * wrong);
}

/// The paper's parabolas: with as many points as the degree they are Runge–Kutta methods.
#[test]
fn galerkin_identities() {
    let h = 0.3;
    let (q, p) = START;
    let verlet = lobatto::<2>(h, q, p);
    let third = lobatto::<3>(h, q, p);
    let same = [
        apart(step(Variational::<2, 2>::lobatto(), h, q, p), verlet),
        apart(step(Variational::<3, 3>::lobatto(), h, q, p), third),
        apart(
            step(Variational::<4, 4>::lobatto(), h, q, p),
            lobatto::<4>(h, q, p),
        ),
        apart(
            step(Variational::<1, 1>::gauss(), h, q, p),
            step(ImplicitMidpoint::default(), h, q, p),
        ),
        apart(
            step(Variational::<2, 2>::gauss(), h, q, p),
            step(Gauss::<2>::default(), h, q, p),
        ),
        apart(
            step(Variational::<5, 5>::gauss(), h, q, p),
            step(Gauss::<5>::default(), h, q, p),
        ),
    ];
    println!("identities: {same:?}");
    assert!(same.iter().all(|error| *error <= 1e-13), "{same:?}");
    // A line and the trapezoid rule, a parabola and Simpson's are others where the mass depends on q,
    let line = apart(step(Variational::<1, 2>::lobatto(), h, q, p), verlet);
    let parabola = apart(step(Variational::<2, 3>::lobatto(), h, q, p), third);
    println!("line and trapezoid {line:.1e}, parabola and Simpson {parabola:.1e}");
    assert!(line > 1e-5 && parabola > 1e-7, "{line:e} {parabola:e}");
    // and the same where it does not.
    fn of_the_pendulum(scheme: impl Scheme<Hand<Pendulum, 1>>) -> [f64; 2] {
        let system = pendulum(true);
        let run = Integrator::new(&system, scheme, State::new([0.7], [3.0]), 0.3);
        let mut run = run.expect("a good start");
        let end = run.advance(1).expect("a good step");
        [end.q[0], end.p[0]]
    }
    let line = of_the_pendulum(Variational::<1, 2>::lobatto());
    let verlet = of_the_pendulum(StormerVerlet::KickDriftKick);
    let parabola = of_the_pendulum(Variational::<2, 3>::lobatto());
    let third = of_the_pendulum(Variational::<3, 3>::lobatto());
    for (a, b) in [(line, verlet), (parabola, third)] {
        let error = (a[0] - b[0]).abs().max((a[1] - b[1]).abs() / 100.0);
        assert!(error <= 1e-14, "{a:?} {b:?}");
    }
}

/// Polynomials of the momenta are Lobatto IIIB–IIIA.
#[test]
fn polynomials_of_momenta_are_the_conjugate_methods() {
    fn apart_from<const S: usize>(of_momenta: bool) -> f64 {
        let (h, (q, p)) = (0.3, START);
        let made = step(MomentumVariational::<S>::default(), h, q, p);
        apart(made, partitioned::<S>(h, q, p, of_momenta))
    }
    let same = [
        apart_from::<2>(true),
        apart_from::<3>(true),
        apart_from::<4>(true),
    ];
    // Negative control: those of the coordinates.
    let other = [apart_from::<2>(false), apart_from::<3>(false)];
    println!("of momenta {same:?}, of coordinates {other:?}");
    assert!(same.iter().all(|error| *error <= 1e-13), "{same:?}");
    assert!(other.iter().all(|error| *error > 1e-6), "{other:?}");
    // And kicks between drifts where H is separable.
    fn end(scheme: impl Scheme<Hand<Pendulum, 1>>) -> [f64; 2] {
        let system = pendulum(true);
        let run = Integrator::new(&system, scheme, State::new([0.7], [3.0]), 0.3);
        let mut run = run.expect("a good start");
        let end = run.advance(1).expect("a good step");
        [end.q[0], end.p[0]]
    }
    let (a, b) = (
        end(MomentumVariational::<2>::default()),
        end(StormerVerlet::DriftKickDrift),
    );
    let error = (a[0] - b[0]).abs().max((a[1] - b[1]).abs() / 100.0);
    assert!(error <= 1e-14, "{a:?} {b:?}");
    on_34(MomentumVariational::<3>::default(), 8);
    on_the_double_pendulum(MomentumVariational::<4>::default(), 8);
    symplectic(MomentumVariational::<3>::default());
}

#[test]
fn variational_integrators_have_their_order() {
    on_34(Variational::<1, 1>::gauss(), 16);
    on_34(Variational::<1, 2>::lobatto(), 16);
    on_34(Variational::<2, 2>::lobatto(), 16);
    on_34(Variational::<2, 3>::lobatto(), 8);
    on_34(Variational::<3, 3>::lobatto(), 8);
    on_34(Variational::<3, 4>::lobatto(), 4);
    on_the_double_pendulum(Variational::<2, 3>::gauss(), 8);
    fn one(scheme: impl Scheme<Hand<Relativistic, 1>>) {
        let system = Hand(Relativistic);
        let start = start(&system, &[0.9], &[0.4]);
        assert_order(&system, &scheme, &start, 2.0, 16);
    }
    one(Variational::<1, 2>::lobatto());
    one(Variational::<2, 2>::lobatto());
    one(Variational::<2, 3>::lobatto());
    one(Variational::<3, 3>::lobatto());
    one(Variational::<3, 3>::gauss());
    // H depends on time.
    let system = Hand(Pumped);
    let start = start(&system, &[0.9], &[0.4]);
    assert_order(&system, &Variational::<2, 3>::lobatto(), &start, 2.0, 16);
    assert_order(&system, &Variational::<3, 3>::lobatto(), &start, 2.0, 16);
}

#[test]
fn variational_integrators_are_symplectic() {
    symplectic(Variational::<1, 1>::gauss());
    symplectic(Variational::<1, 2>::lobatto());
    symplectic(Variational::<2, 2>::lobatto());
    symplectic(Variational::<2, 3>::lobatto());
    symplectic(Variational::<3, 3>::lobatto());
    symplectic(Variational::<2, 3>::gauss());
    symplectic(Variational::<4, 4>::gauss());
}

/// A particle in the plane whose mass is 1 + r²: H = p²/(2(1 + r²)) + √(1 + r²) + a·x², a breaking the
/// rotation.
#[derive(Debug, Clone)]
struct Plane {
    a: f64,
}

impl Formula<2> for Plane {
    const NAME: &'static str = "Plane";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p_x", 0), Group::scalar("y", "p_y", 1)];
    fn energy<T: Real>(&self, _: T, [x, y]: &[T; 2], [px, py]: &[T; 2]) -> T {
        let mass = T::one() + *x * *x + *y * *y;
        let kinetic = number::<T>(0.5) * (*px * *px + *py * *py) / mass;
        kinetic + mass.sqrt() + number::<T>(self.a) * *x * *x
    }
}

/// x p_y − y p_x at both ends of the path.
fn angular_momenta<const D: usize, const S: usize>(
    scheme: &Variational<D, S>,
    a: f64,
    ends: Ends<SVector<f64, 2>>,
) -> [f64; 2] {
    let path = (scheme.extremal(&Hand(Plane { a }), 0.0, 0.4, ends)).expect("a path");
    [path.start, path.end].map(|z| z.q[0] * z.p[1] - z.q[1] * z.p[0])
}

fn ends<T: Real>() -> [Ends<SVector<T, 2>>; 3] {
    let (a, b) = ([0.7, -0.2].map(number::<T>), [0.4, 0.5].map(number::<T>));
    [
        Ends::Coordinates(a.into(), b.into()),
        Ends::Right(a.into(), b.into()),
        Ends::Left(b.into(), a.into()),
    ]
}

/// For whatever ends, not only along a motion.
#[test]
fn discrete_momentum_maps_are_kept() {
    fn check<const D: usize, const S: usize>(scheme: &Variational<D, S>) {
        for of in ends() {
            let [start, end] = angular_momenta(scheme, 0.0, of.clone());
            assert!((start - end).abs() <= 1e-14, "{start} {end} {of:?}");
            // Negative control: no rotation leaves H as it is.
            let [start, end] = angular_momenta(scheme, 0.3, of.clone());
            assert!((start - end).abs() > 1e-3, "{start} {end} {of:?}");
        }
    }
    check(&Variational::<1, 1>::gauss());
    check(&Variational::<1, 2>::lobatto());
    check(&Variational::<2, 2>::lobatto());
    check(&Variational::<2, 3>::lobatto());
    check(&Variational::<3, 3>::lobatto());
    check(&Variational::<4, 4>::gauss());
    // And so along runs.
    let system = Hand(Plane { a: 0.0 });
    let start = State::new([0.7, -0.2], [0.4, 0.5]);
    let scheme = Variational::<2, 3>::lobatto();
    let mut run = Integrator::new(&system, scheme, start, 0.2).expect("a good start");
    let end = run.advance(1_000).expect("good steps");
    let moment = end.q[0] * end.p[1] - end.q[1] * end.p[0];
    assert!((moment - 0.43).abs() <= 1e-13, "{moment}");
}

/// The derivatives of the action by the given ends are the unknown ones, the paper's (4), (5)
/// and (18), (19); and the paths are the scheme's steps.
#[test]
fn momenta_are_derivatives_of_the_action() {
    fn check<const D: usize, const S: usize>(scheme: Variational<D, S>) {
        let system = Hand(Plane { a: 0.3 });
        let (t, h) = (Dual::fixed(0.0), Dual::fixed(0.4));
        for (of, kind) in ends::<f64>().iter().zip(0..) {
            let path = scheme.extremal(&system, 0.0, 0.4, of.clone());
            let path = path.expect("a path");
            let start = State::new([path.start.q[0], path.start.q[1]], [0.0; 2]);
            let start = State {
                p: path.start.p,
                ..start
            };
            let mut run = Integrator::new(&system, scheme, start, 0.4).expect("a good start");
            let end = run.advance(1).expect("a good step");
            let missed = (end.q - path.end.q).amax().max((end.p - path.end.p).amax());
            assert!(missed <= 1e-13, "{missed:e}");
            for k in 0..4 {
                let mut all = ends::<Dual<f64>>();
                let (Ends::Coordinates(a, b) | Ends::Right(a, b) | Ends::Left(a, b)) =
                    &mut all[kind];
                if k < 2 {
                    a[k].eps = 1.0;
                } else {
                    b[k - 2].eps = 1.0;
                }
                let moved = scheme.extremal(&system, t, h, all[kind].clone());
                let moved = moved.expect("a path");
                let (derivative, expected) = match kind {
                    0 => (moved.action, [-path.start.p, path.end.p]),
                    1 => (moved.right(), [path.start.p, path.end.q]),
                    _ => (moved.left(), [-path.start.q, -path.end.p]),
                };
                let error = (derivative.eps - expected[k / 2][k % 2]).abs();
                assert!(error <= 1e-13, "{kind} {k}: {error:e}");
            }
        }
    }
    check(Variational::<1, 2>::lobatto());
    check(Variational::<2, 2>::lobatto());
    check(Variational::<3, 3>::lobatto());
    check(Variational::<3, 4>::gauss());
}

#[test]
fn ends_without_a_path_are_errors() {
    let scheme = Variational::<2, 2>::lobatto();
    let ends = || Ends::Coordinates([0.0].into(), [1.0].into());
    let system = Hand(Relativistic);
    for h in [0.0, f64::NAN] {
        let error = scheme
            .extremal(&system, 0.0, h, ends())
            .expect_err("no step");
        assert!(
            matches!(error, Error::Start(StartError::Step { .. })),
            "{error}"
        );
    }
    // Faster than light.
    let error = scheme
        .extremal(&system, 0.0, 0.5, ends())
        .expect_err("no path");
    assert!(
        matches!(
            error,
            Error::Search(SearchError::NoStationaryPath { length: 0.5, .. })
        ),
        "{error}"
    );
}

/// H = p²/(2m) + q²/2 with the force −γp: m = 1.3, γ = 0.4.
#[derive(Debug, Clone)]
struct Damped;

const MASS: f64 = 1.3;
const DAMPING: f64 = 0.4;
const DAMPED: &Description = &Description::new("Damped", &[]);

#[derive(Debug, Clone)]
struct DampedField<T>(T);

impl System for Damped {
    type Shape = SVector<(), 1>;
    type Prepared<T: Real> = Damped;
    fn description(&self) -> &Description {
        DAMPED
    }
    fn prepare<T: Real>(&self) -> Damped {
        Damped
    }
    fn zeros<T: Real>(&self) -> VectorOf<Self, T> {
        SVector::from_element(T::zero())
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

impl<T: Real> Dynamics<T> for Damped {
    type Vector = SVector<T, 1>;
    type Field = DampedField<T>;
    fn description(&self) -> &Description {
        DAMPED
    }
    fn energy(&self, _: T, q: &Self::Vector, p: &Self::Vector) -> T {
        number::<T>(0.5) * (p[0] * p[0] / number(MASS) + q[0] * q[0])
    }
    fn gradient_q(&self, _: T, q: &Self::Vector, _: &Self::Vector, out: &mut Self::Vector) {
        out[0] = q[0];
    }
    fn gradient_p(&self, _: T, _: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        out[0] = p[0] / number(MASS);
    }
    fn time_derivative(&self, _: T, _: &Self::Vector, _: &Self::Vector) -> T {
        T::zero()
    }
    fn hessian_vector(
        &self,
        t: T,
        _: &Self::Vector,
        _: &Self::Vector,
        vq: &Self::Vector,
        vp: &Self::Vector,
        out_q: &mut Self::Vector,
        out_p: &mut Self::Vector,
    ) {
        Dynamics::gradient(self, t, vq, vp, out_q, out_p);
    }
    fn force(&self, _: T, _: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        out[0] = -number::<T>(DAMPING) * p[0];
    }
    fn observable(&self, _: usize, _: T, _: &Self::Vector, _: &Self::Vector) -> T {
        T::zero()
    }
    fn field(&self, c: T) -> DampedField<T> {
        DampedField(c)
    }
}

impl<T: Real> VectorField<SVector<T, 1>> for DampedField<T> {
    fn add(
        &self,
        _: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        into_q: &mut SVector<T, 1>,
        into_p: &mut SVector<T, 1>,
    ) {
        into_q[0] += self.0 * p[0] / number(MASS);
        into_p[0] -= self.0 * (q[0] + number::<T>(DAMPING) * p[0]);
    }
}

/// q of the damped oscillator at t from (1, 0): e^(−γt/2)(cos ωt + γ/(2ω) sin ωt).
fn damped(t: f64) -> f64 {
    let omega = (1.0 / MASS - DAMPING * DAMPING / 4.0).sqrt();
    let (sin, cos) = (omega * t).sin_cos();
    (-DAMPING * t / 2.0).exp() * (cos + DAMPING / (2.0 * omega) * sin)
}

/// The discrete Lagrange–d'Alembert principle keeps the order where energy is lost.
#[test]
fn forced_paths_follow_the_damped_oscillator() {
    fn check<const D: usize, const S: usize>(scheme: Variational<D, S>, coarsest: u32) {
        let errors: Vec<_> = (0..5)
            .map(|halving| {
                let steps = coarsest << halving;
                let start = State::new([1.0], [0.0]);
                let h = 10.0 / f64::from(steps);
                let mut run = Integrator::new(&Damped, scheme, start, h).expect("a good start");
                let end = run.advance(u64::from(steps)).expect("good steps");
                (end.q[0] - damped(10.0)).abs()
            })
            .collect();
        let order = f64::from(Listed::entry(&scheme).order);
        let slope = (errors[0] / errors[4]).log2() / 4.0;
        println!("{scheme:?}: {slope:.3} {errors:?}");
        assert!((slope - order).abs() <= 0.1, "{slope} {errors:?}");
    }
    check(Variational::<1, 1>::gauss(), 50);
    check(Variational::<1, 2>::lobatto(), 50);
    check(Variational::<2, 2>::lobatto(), 50);
    check(Variational::<2, 3>::lobatto(), 20);
    check(Variational::<3, 3>::lobatto(), 20);
    check(Variational::<2, 2>::gauss(), 20);
}
