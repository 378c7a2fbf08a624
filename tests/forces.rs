//! Forces: systems that lose energy, against closed forms, and the order of every scheme that takes
//! forces.

use crate::allocator::allocations;
use crate::common::order::slope;
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::schemes::walk::{
    Visitor, visit_any, visit_implicit, visit_separable, visit_split,
};
use hamiltonian::schemes::{Composition, Yoshida4};
use hamiltonian::{DoubleDouble, Scheme, Separable, Split, hamiltonian};

hamiltonian! {
    /// A damped oscillator.
    pub struct Damped { gamma = 0.3, omega = 1.2 }
    H = p^2/2 + omega^2*q^2/2;
    force(q; p) = -gamma*p
}

hamiltonian! {
    /// A pendulum with friction that is linear in the momentum.
    pub struct Linear { gamma = 0.4 }
    H = sqrt(1 + p^2) - cos(q);
    force(q; p) = -gamma*p
}

hamiltonian! {
    /// A pendulum in air.
    pub struct Air { c = 0.4 }
    H = p^2/2 - cos(q);
    force(q; p) = -c*abs(p)*p
}

hamiltonian! {
    /// A pendulum pushed by a force without a potential of its own in H.
    pub struct Pushed {}
    H(q; p; t) = sqrt(1 + p^2) - cos(q);
    force(q; p) = sin(2*t)*cos(q)
}

hamiltonian! {
    /// Friction that depends on time and place.
    pub struct Changing {}
    H(q; p; t) = (1 + sin(t)/2)*p^2/2 - cos(q)*(2 + cos(t));
    force(q; p) = -(1 + sin(3*t)/2)*(1 + q^2/4)*p + q/5
}

hamiltonian! {
    /// A chain whose bonds push two masses each, every mass with a friction of its own.
    pub struct Chain<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + (q[(i + 1) % N] - q[i])^4/4 };
    force(q; p) = -0.3*p
}

hamiltonian! {
    /// The same with a number of masses set at run time, and a mass each.
    pub struct Long { N: usize, m: [N] }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/(2*m[i]) + (q[(i + 1) % N] - q[i])^4/4 };
    force(q; p) = -0.3*p
}

hamiltonian! {
    /// A charge in a magnetic field that grows with x, and in air: momenta push each other.
    pub struct Turning { a = 0.3, b = 0.2, w = 0.7 }
    H(x, y; p_x, p_y; t) = sqrt(1 + p_x^2 + p_y^2) + x^4/4 + y^2/2 + cos(t)*x*y/3;
    force(x, y; p_x, p_y) = [(b + w*(1 + x^2))*p_y - a*p_x + sin(t), (b - w*(1 + x^2))*p_x - a*p_y]
}

hamiltonian! {
    /// Friction along one direction, of a number of masses set at run time.
    pub struct Sliding { N: usize, u: [N] }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + q[i]^2/2 + q[i]^4/4 };
    force(q; p) = -dot(u, p)*u
}

hamiltonian! {
    /// The same masses in air.
    pub struct Falling { N: usize, c = 0.3 }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + q[i]^2/2 + q[i]^4/4 };
    force(q; p) = -c*norm(p)*p
}

hamiltonian! {
    /// Dry friction, whose derivative by p is that of the viscous part alone.
    pub struct Dry { gamma = 0.1, mu = 0.2 }
    H = p^2/2 + q^2/2;
    force(q; p) = -gamma*p - mu*sign(p)
}

hamiltonian! {
    /// (34), which is not separable, with friction and a push.
    pub struct Bound { gamma = 0.3 }
    H(q; p; t) = 0.5*(q^2 + 1)*(p^2 + 1);
    force(q; p) = -gamma*(1 + q^2)*p + sin(t)
}

hamiltonian! {
    /// A top in air that turns it, in pieces by hand.
    pub struct Top { w = 0.4 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + x^2*y^2*(x*p_y - y*p_x) + x^4/4;
    split {
        Kinetic = (p_x^2 + p_y^2)/2;
        Potential = x^4/4;
        Along = x^3*y^2*p_y;
        Across = -x^2*y^3*p_x
    };
    force(x, y; p_x, p_y) = [w*p_y, -w*p_x]
}

hamiltonian! {
    /// (34) in air.
    pub struct Windy {}
    H = 0.5*(q^2 + 1)*(p^2 + 1);
    force(q; p) = -abs(p)*p/4
}

type D = DoubleDouble;

/// The slope of every scheme against a run of order 4 with a step 64 times as small.
struct Slopes<S: System> {
    system: S,
    start: State<VectorOf<S, D>>,
    exact: State<VectorOf<S, D>>,
    measured: usize,
}

const END: f64 = 1.0;

impl<S: System> Slopes<S> {
    fn new(system: S, start: State<VectorOf<S, D>>) -> Self {
        let h = D::from(END / 4096.0);
        let mut run = Integrator::new(&system, RungeKutta4, start.clone(), h).unwrap();
        let exact = run.advance(4096).unwrap().clone();
        Slopes {
            system,
            start,
            exact,
            measured: 0,
        }
    }
}

impl<S: System> Visitor<S> for Slopes<S> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let entry = scheme.entry();
        let points: Vec<(f64, f64)> = [16_u64, 32, 64, 128]
            .into_iter()
            .map(|n| {
                let h = D::from(END / n as f64);
                let run = Integrator::new(&self.system, scheme.clone(), self.start.clone(), h);
                let mut run = run.unwrap();
                let end = run.advance(n).unwrap();
                (
                    h.to_f64(),
                    crate::common::reference::difference(end, &self.exact),
                )
            })
            .collect();
        let slope = slope(&points);
        assert!(
            (slope - f64::from(entry.order)).abs() < 0.15,
            "{} {} on {}: slope {slope}, {points:?}",
            entry.name,
            entry.variant,
            self.system.description().name
        );
        self.measured += 1;
    }
}

fn all<S>(mut slopes: Slopes<S>)
where
    S: Separable + Split,
{
    visit_any(&mut slopes);
    visit_implicit(&mut slopes);
    visit_separable(&mut slopes);
    visit_split(&mut slopes);
    assert!(slopes.measured >= 11);
}

fn at(q: f64, p: f64) -> State<hamiltonian::private::SVector<D, 1>> {
    State::over([D::from(q)], [D::from(p)])
}

#[test]
fn orders_with_forces() {
    all(Slopes::new(Linear::default(), at(0.9, 0.4)));
    all(Slopes::new(Air::default(), at(-0.5, 1.5)));
    all(Slopes::new(Pushed::default(), at(0.9, 0.4)));
    all(Slopes::new(Changing::default(), at(0.9, 0.4)));
    let numbers = |v: [f64; 4]| v.map(D::from);
    let (q, p) = ([0.3, -0.2, 0.9, 0.1], [0.4, 0.1, -0.5, 0.2]);
    all(Slopes::new(
        Chain::<4>::default(),
        State::over(numbers(q), numbers(p)),
    ));
    let start = State::over([0.9, -0.2].map(D::from), [0.4, 0.3].map(D::from));
    let mut turning = Slopes::new(Turning::default(), start);
    turning.visit(Yoshida4);
    all(turning);
}

/// Returns true if rustc knows the flows of a system's pieces as exact.
macro_rules! is_exact {
    ($system:ty) => {{
        struct Probe<T>(core::marker::PhantomData<T>);
        #[allow(dead_code)]
        trait Otherwise {
            const IS: bool = false;
        }
        impl<T> Otherwise for Probe<T> {}
        #[allow(dead_code)]
        impl<T: hamiltonian::Exact> Probe<T> {
            const IS: bool = true;
        }
        Probe::<$system>::IS
    }};
}

/// Beside pieces of an H that is not separable the force is a piece of its own.
#[test]
fn a_force_is_a_piece_of_its_own() {
    let small = |q: f64, p: f64| State::over([D::from(q)], [D::from(p)]);
    let mut bound = Slopes::new(Bound::default(), small(0.3, 0.5));
    visit_split(&mut bound);
    bound.visit(Yoshida4);
    let mut windy = Slopes::new(Windy::default(), small(0.3, 0.5));
    visit_split(&mut windy);
    let start = State::over([0.4, -0.3].map(D::from), [0.4, 0.3].map(D::from));
    let mut top = Slopes::new(Top::default(), start);
    visit_split(&mut top);
    top.visit(Yoshida4);
    let top = Top::default();
    let names = top.description().piece_names();
    assert_eq!(names.last(), Some(&"force"));
    assert_eq!(names.len(), 5);
    assert!(top.description().is_forced);
    assert!(is_exact!(Bound) && is_exact!(Top) && !is_exact!(Windy));
}

/// A charge that turns 400 rad a step and slows down: Strang's step is the kick alone, to rounding.
#[test]
fn momenta_that_push_each_other_have_their_exact_flow() {
    hamiltonian! {
        /// A free charge in a uniform field, with friction.
        pub struct Larmor { omega = 40.0, gamma = 0.1 }
        H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2;
        force(x, y; p_x, p_y) = [omega*p_y - gamma*p_x, -omega*p_x - gamma*p_y]
    }
    let start = State::new([0.0, 0.0], [1.0, 0.0]);
    for h in [0.01, 0.3, 10.0, -0.3] {
        let mut run = Integrator::new(&Larmor::default(), Strang, start.clone(), h).unwrap();
        let end = run.advance(3).unwrap();
        let (size, angle) = ((-0.1 * end.t).exp(), 40.0 * end.t);
        for (found, exact) in [
            (end.p[0], size * angle.cos()),
            (end.p[1], -size * angle.sin()),
        ] {
            let allowed = (8.0 + angle.abs()) * f64::EPSILON * size;
            assert!((found - exact).abs() < allowed, "h = {h}: {found}, {exact}");
        }
    }
}

hamiltonian! {
    /// Grains with a drag and a wind of their own, which come off the one before.
    pub struct Grains { n: usize, gamma: [n] }
    H(q[n][2]; p[n][2]) = sum(i in 0..n) { norm_squared(p[i])/2 };
    force(q[i]; p[i]) = -gamma[i]*p[i] + [i, 1] + sum(j in 0..i) { p[j] }
}

hamiltonian! {
    /// The same of two grains, as one whole.
    pub struct TwoGrains { gamma: [2] }
    H(q[2][2]; p[2][2]) = (norm_squared(p[0]) + norm_squared(p[1]))/2;
    force(q[i]; p[i]) = -gamma[i]*p[i] + [i, 1] + sum(j in 0..i) { p[j] };
    coordinates heliocentric(q, gamma)
}

/// A force by rows: each has its own, in other coordinates too.
#[test]
fn rows_have_forces_of_their_own() {
    let gamma = [0.5, 2.0];
    let grains = Grains::new(2, gamma.to_vec()).unwrap();
    let p = [[1.0, 2.0], [3.0, 5.0]];
    let state = State::new(vec![[0.0; 2]; 2], p.to_vec());
    let force = grains.force(&state);
    assert_eq!(force.as_slice(), [-0.5, -4.0, 0.0, -7.0]);
    // Nothing else acts, and the flow of the force is exact: of the first grain p = e^(−γt)p₀ + (1 − e^(−γt))w/γ.
    let mut run = Integrator::new(&grains, Strang, state, 0.01).unwrap();
    let end = run.advance(100).unwrap();
    let rest = (-0.5_f64).exp();
    assert!((end.p[(0, 0)] - rest).abs() < 1e-14);
    assert!((end.p[(0, 1)] - (2.0 * rest + (1.0 - rest) / 0.5)).abs() < 1e-14);

    let two = TwoGrains::new(gamma);
    let moved = two.force(&two.from_declared(&State::new([[0.0; 2]; 2], p)));
    // Row 0 of the new momenta is the total one, row 1 that of body 1.
    let total = [force[(0, 0)] + force[(1, 0)], force[(0, 1)] + force[(1, 1)]];
    for c in 0..2 {
        assert_eq!([moved[(0, c)], moved[(1, c)]], [total[c], force[(1, c)]]);
    }
}

#[test]
fn only_affine_forces_are_exact() {
    assert!(is_exact!(Linear) && is_exact!(Turning) && is_exact!(Sliding) && is_exact!(Pushed));
    assert!(!is_exact!(Air) && !is_exact!(Falling) && !is_exact!(Dry));
}

/// q = e^(−γt/2) (cos ωt + γ/(2ω) sin ωt)
#[test]
fn damped_oscillator_in_closed_form() {
    let system = Damped::default();
    let exact = |t: f64| {
        let (g, w) = (
            system.gamma / 2.0,
            (system.omega.powi(2) - system.gamma.powi(2) / 4.0).sqrt(),
        );
        (-g * t).exp() * ((w * t).cos() + g / w * (w * t).sin())
    };
    let start = State::new([1.0], [0.0]);
    let fourth = Composition::yoshida(Strang);
    let mut run = Integrator::new(&system, fourth, start.clone(), 1e-3).unwrap();
    let end = run.advance_to(10.0).unwrap();
    assert!(
        (end.q[0] - exact(10.0)).abs() < 1e-11,
        "{}",
        end.q[0] - exact(10.0)
    );
    let mut run = Integrator::new(&system, ImplicitMidpoint::default(), start, 1e-3).unwrap();
    let end = run.advance_to(10.0).unwrap();
    assert!((end.q[0] - exact(10.0)).abs() < 1e-6);
}

/// With V = 0 the kick alone is the exact flow of the friction: p e^(−γt), to rounding, in any step.
#[test]
fn friction_alone_is_exact() {
    hamiltonian! {
        /// A free particle with friction.
        pub struct Free { gamma = 0.7 }
        H = p^2/2;
        force(q; p) = -gamma*p
    }
    let mut run = Integrator::new(&Free::default(), Strang, State::new([0.0], [2.0]), 0.5).unwrap();
    let end = run.advance(8).unwrap();
    let exact = 2.0 * (-0.7_f64 * 4.0).exp();
    assert!(
        (end.p[0] - exact).abs() < 8.0 * f64::EPSILON * exact,
        "{}",
        end.p[0]
    );
}

#[test]
fn a_kick_with_friction_allocates_nothing() {
    let long = Long::new(3, vec![1.0, 2.0, 0.5]).unwrap();
    let start = State::new(vec![0.3, -0.2, 0.9], vec![0.4, 0.1, -0.5]);
    let mut run = Integrator::new(&long, Yoshida4, start, 0.01).unwrap();
    let count = allocations(|| {
        run.advance(3000).unwrap();
    });
    assert_eq!(count, 0);
    let (q, p) = (vec![0.3, -0.2, 0.9], vec![0.4, 0.1, -0.5]);
    let start = State::new(q, p);
    let sliding = Sliding::new(3, vec![1.0, 0.5, -1.0]).unwrap();
    let mut run = Integrator::new(&sliding, Yoshida4, start.clone(), 0.01).unwrap();
    let falling = Falling::new(3).unwrap();
    let mut beside = Integrator::new(&falling, Strang, start, 0.01).unwrap();
    let count = allocations(|| {
        run.advance(3000).unwrap();
        beside.advance(3000).unwrap();
    });
    assert_eq!(count, 0);
}

/// A run that was saved under one force, or one order of pieces, does not go on under another.
#[test]
fn a_saved_run_knows_its_force_and_its_pieces() {
    mod other {
        hamiltonian::hamiltonian! {
            /// The damped oscillator, driven.
            pub struct Damped { gamma = 0.3, omega = 1.2 }
            H = p^2/2 + omega^2*q^2/2;
            force(q; p) = -gamma*p + cos(q)
        }
    }
    let start = State::new([1.0], [0.0]);
    let mut run = Integrator::new(&Damped::default(), Strang, start, 0.1).unwrap();
    run.advance(3).unwrap();
    let saved = || run.checkpoint();
    assert!(Integrator::resume(&Damped::default(), Strang, saved()).is_ok());
    let error = Integrator::resume(&other::Damped::default(), Strang, saved()).unwrap_err();
    assert!(error.to_string().contains("cos(q)"), "{error}");

    mod split {
        hamiltonian::hamiltonian! {
            /// An oscillator, kicked first.
            pub struct Halves {}
            H = p^2/2 + q^2/2;
            split { V = q^2/2; T = p^2/2 }
        }
        pub mod turned {
            hamiltonian::hamiltonian! {
                /// An oscillator that drifts first.
                pub struct Halves {}
                H = p^2/2 + q^2/2;
                split { T = p^2/2; V = q^2/2 }
            }
        }
    }
    let start = State::new([1.0], [0.0]);
    let run = Integrator::new(&split::Halves::default(), Strang, start, 0.1).unwrap();
    let turned = split::turned::Halves::default();
    assert!(Integrator::resume(&turned, Strang, run.checkpoint()).is_err());
}

hamiltonian! {
    /// A damping for each site.
    pub struct Rubbed { n: usize, m: usize, gamma: [n][m] }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { (p[i][j]^2 + u[i][j]^2)/2 };
    force(u[i][j]; p[i][j]) = -gamma[i][j]*p[i][j] + i - 2*j
}

hamiltonian! {
    /// Columns that are written out.
    pub struct Columns { n: usize }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/2 };
    force(q[i][j]; p[i][j]) = -[2, 3, 5][j]*p[i][j] + i*q[i][j]
}

hamiltonian! {
    /// Two names on three axes: a force is a vector.
    pub struct Stacked { n: usize, m: usize, k: usize }
    H(u[n][m][k]; p[n][m][k]) = sum(i in 0..n, j in 0..m, l in 0..k) { p[i][j][l]^2/2 };
    force(u[i][j]; p[i][j]) = -(i + 1)*p[i][j] + j*u[i][j]
}

#[test]
fn a_force_is_written_for_an_element() {
    let value =
        |[i, j, l]: [usize; 3], salt: usize| ((7 * i + 5 * j + 3 * l + 11 * salt) as f64).sin();
    let nested = |n, m, salt| -> Vec<Vec<f64>> {
        let row = |i| (0..m).map(|j| value([i, j, 0], salt)).collect();
        (0..n).map(row).collect()
    };
    let places = |n, m| (0..n).flat_map(move |i| (0..m).map(move |j: usize| (i, j)));
    let rubbed = Rubbed::new(3, 6, nested(3, 6, 2)).unwrap();
    let force = rubbed.force(&State::new(nested(3, 6, 0), nested(3, 6, 1)));
    for (i, j) in places(3, 6) {
        let due = -nested(3, 6, 2)[i][j] * nested(3, 6, 1)[i][j] + i as f64 - 2.0 * j as f64;
        assert!((force[[i, j]] - due).abs() < 1e-14, "[{i}][{j}]");
    }
    let array = |salt| [0, 1, 2, 3].map(|i| [0, 1, 2].map(|j| value([i, j, 0], salt)));
    let columns = Columns::new(4).unwrap();
    let force = columns.force(&State::new(array(0).to_vec(), array(1).to_vec()));
    for (i, j) in places(4, 3) {
        let due = -[2.0, 3.0, 5.0][j] * array(1)[i][j] + i as f64 * array(0)[i][j];
        assert!((force[(i, j)] - due).abs() < 1e-14, "[{i}][{j}]");
    }
    let stack =
        |salt| [0, 1].map(|i| [0, 1, 2].map(|j| [0, 1, 2, 3].map(|l| value([i, j, l], salt))));
    let force = Stacked::new(2, 3, 4).unwrap().force(&State::new(
        stack(0).map(Vec::from).to_vec(),
        stack(1).map(Vec::from).to_vec(),
    ));
    for (i, j) in places(2, 3) {
        for l in 0..4 {
            let due = -(i as f64 + 1.0) * stack(1)[i][j][l] + j as f64 * stack(0)[i][j][l];
            assert!((force[[i, j, l]] - due).abs() < 1e-14, "[{i}][{j}][{l}]");
        }
    }
}
