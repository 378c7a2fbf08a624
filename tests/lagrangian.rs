//! Systems from their Lagrangians: the same H as written by hand, momenta from velocities and back.

use hamiltonian::prelude::*;
use hamiltonian::schemes::Variational;
use hamiltonian::schemes::author::Ends;
use hamiltonian::{Dual, Vector};

hamiltonian! {
    /// A double pendulum from its Lagrangian.
    pub struct DoublePendulum { m1 = 1.0, m2 = 0.8, l1 = 1.2, l2 = 0.9, g = 9.81 }
    L(a, b; va, vb) = (m1 + m2)*l1^2*va^2/2 + m2*l2^2*vb^2/2 + m2*l1*l2*va*vb*cos(a - b)
        + (m1 + m2)*g*l1*cos(a) + m2*g*l2*cos(b);
    /// The height of the lower bob grows at this rate.
    monitor rise = l1*sin(a)*va + l2*sin(b)*vb;
    monitor twice_kinetic = p_a*va + p_b*vb
}

hamiltonian! {
    /// The same from its Hamiltonian.
    pub struct ByHand { m1 = 1.0, m2 = 0.8, l1 = 1.2, l2 = 0.9, g = 9.81 }
    H(q1, q2; p1, p2) = (m2*l2^2*p1^2 + (m1 + m2)*l1^2*p2^2 - 2*m2*l1*l2*p1*p2*cos(q1 - q2))
        /(2*m2*l1^2*l2^2*(m1 + m2*sin(q1 - q2)^2))
        - (m1 + m2)*g*l1*cos(q1) - m2*g*l2*cos(q2)
}

hamiltonian! {
    /// A full mass matrix of three, which depends on the coordinates.
    pub struct Dense3 { m = 2.0 }
    L(x, y, z; u, v, w) = m*u^2/2 + (1 + x^2)*v^2 + (2 + sin(y)^2)*w^2/2
        + x*u*v/2 + cos(z)*v*w/3 + y*u*w/4 - x^2 - y^2*z^2
}

hamiltonian! {
    /// A full mass matrix of four.
    pub struct Dense4 {}
    L(a, b, c, d; va, vb, vc, vd) = 2*va^2 + (3 + a^2)*vb^2 + (2 + cos(d))*vc^2 + 2*vd^2
        + va*vb*sin(c)/2 + va*vc/3 + va*vd*b/4 + vb*vc*d/5 + vb*vd/2 + vc*vd*cos(a)
        - a^2 - b^2/2 - c^4 - cos(d) + va*b - vc*a*d
}

hamiltonian! {
    /// A charge in a uniform magnetic field along z and a potential.
    pub struct Charge { m = 1.5, e = -2.0, B = 0.7, k = 0.3 }
    L(x, y, z; u, v, w) = m*(u^2 + v^2 + w^2)/2 + e*B*(x*v - y*u)/2 - k*(x^2 + y^2 - 2*z^2)
}

hamiltonian! {
    /// The same charge from its Hamiltonian.
    pub struct ChargeByHand { m = 1.5, e = -2.0, B = 0.7, k = 0.3 }
    H(x, y, z; p_x, p_y, p_z) = ((p_x + e*B*y/2)^2 + (p_y - e*B*x/2)^2 + p_z^2)/(2*m)
        + k*(x^2 + y^2 - 2*z^2)
}

hamiltonian! {
    /// A chain of different masses, how many is known at run time.
    pub struct Chain { n: usize, m: [n], k = 2.0 }
    L(q[n]; v[n]) = sum(i in 0..n) { m[i]*v[i]^2/2 }
        - sum(i in 1..n) { k*(q[i] - q[i - 1])^2/2 + (q[i] - q[i - 1])^4/4 };
    monitor kinetic = sum(i in 0..n) { m[i]*v[i]^2/2 };
    invariant momentum = sum(i in 0..n) { m[i]*v[i] }
}

hamiltonian! {
    /// Bodies in space.
    pub struct Bodies<const N: usize> { m: [N] }
    L(q[N][3]; v[N][3]) = sum(i in 0..N) { m[i]*norm_squared(v[i])/2 }
        + sum(i in 0..N, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    invariant angular_momentum = sum(i in 0..N) { m[i]*cross(q[i], v[i]) }
}

hamiltonian! {
    /// A pendulum whose pivot is shaken, with a mass that grows.
    pub struct Shaken { a = 0.2, omega = 3.0, l = 1.1, g = 9.81, growth = 0.05 }
    L(q; v; t) = (1 + growth*t)*(l^2*v^2/2 + a*omega*cos(omega*t)*l*sin(q)*v + g*l*cos(q));
    monitor speed = l*v
}

hamiltonian! {
    /// The same from its Hamiltonian.
    pub struct ShakenByHand { a = 0.2, omega = 3.0, l = 1.1, g = 9.81, growth = 0.05 }
    let M = 1 + growth*t;
    let A = M*a*omega*cos(omega*t)*l*sin(q);
    H(q; p; t) = (p - A)^2/(2*M*l^2) - M*g*l*cos(q)
}

#[track_caller]
fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-13 * (1.0 + a.abs()), "{a} is not {b}");
}

/// Energies and gradients at many points of the cube.
#[track_caller]
fn same<const N: usize, A, B>(a: &A, b: &B)
where
    A: System<Shape = hamiltonian::nalgebra::SVector<(), N>>,
    B: System<Shape = hamiltonian::nalgebra::SVector<(), N>>,
{
    for point in 0..20 {
        let at = |k: usize| (1.7 * k as f64 + 0.37 * f64::from(point)).sin() * 1.5;
        let q: [f64; N] = std::array::from_fn(at);
        let p: [f64; N] = std::array::from_fn(|k| at(k + N));
        let state = State::new(q, p).at(f64::from(point) / 10.0);
        close(a.energy(&state), b.energy(&state));
        let (ga, gb) = (a.gradient::<f64>(&state), b.gradient::<f64>(&state));
        for k in 0..N {
            close(ga.q.component(k), gb.q.component(k));
            close(ga.p.component(k), gb.p.component(k));
        }
    }
}

type Scalars<T, const N: usize> =
    <[T; N] as hamiltonian::IntoVector<hamiltonian::shape::Array>>::Vector;

/// (q, v) → (q, p) → v, H = p·v − L, and dH/dp = v: all that a Legendre transform promises.
macro_rules! check {
    ($system:expr, $q:expr, $v:expr, $lagrangian:expr) => {{
        let (system, q, v) = ($system, $q, $v);
        let state = system.state_from_velocity(0.25, q.clone(), v.clone());
        let velocity = system.velocity(&state);
        let back = system.conjugate_momentum(0.25, &state.q, &velocity);
        let wanted = State::new(q, v);
        let lagrangian: f64 = $lagrangian(&wanted.q, &wanted.p);
        let gradient = System::gradient::<f64>(&system, &state);
        let mut legendre = -lagrangian;
        for k in 0..state.q.len() {
            close(velocity.component(k), wanted.p.component(k));
            close(back.component(k), state.p.component(k));
            close(gradient.p.component(k), velocity.component(k));
            legendre += state.p.component(k) * velocity.component(k);
        }
        close(legendre, System::energy::<f64>(&system, &state));
        // The gradient against duals of H.
        for k in 0..2 * state.q.len() {
            let lift = |vector: &_| {
                let mut lifted = System::zeros::<Dual<f64>>(&system);
                for j in 0..Vector::len(vector) {
                    *lifted.component_mut(j) = Dual::fixed(Vector::component(vector, j));
                }
                lifted
            };
            let (mut q, mut p) = (lift(&state.q), lift(&state.p));
            let n = state.q.len();
            let expected = if k < n {
                q.component_mut(k).eps = 1.0;
                gradient.q.component(k)
            } else {
                p.component_mut(k - n).eps = 1.0;
                gradient.p.component(k - n)
            };
            let dual = State {
                t: Dual::fixed(0.25),
                q,
                p,
            };
            close(System::energy::<Dual<f64>>(&system, &dual).eps, expected);
        }
        state
    }};
}

#[test]
fn double_pendulum() {
    same(&DoublePendulum::default(), &ByHand::default());
    let (m1, m2, l1, l2, g) = (1.0, 0.8, 1.2, 0.9, 9.81);
    let system = DoublePendulum::default();
    let state = check!(system.clone(), [0.5, -0.3], [1.1, 0.4], |q: &_, v: &_| {
        let (q, v): (&Scalars<f64, 2>, &Scalars<f64, 2>) = (q, v);
        (m1 + m2) * l1 * l1 * v[0] * v[0] / 2.0
            + m2 * l2 * l2 * v[1] * v[1] / 2.0
            + m2 * l1 * l2 * v[0] * v[1] * (q[0] - q[1]).cos()
            + (m1 + m2) * g * l1 * q[0].cos()
            + m2 * g * l2 * q[1].cos()
    });
    let rise: f64 = system.rise(&state);
    close(rise, l1 * 0.5f64.sin() * 1.1 + l2 * (-0.3f64).sin() * 0.4);
    let twice: f64 = system.twice_kinetic(&state);
    close(twice, state.p[0] * 1.1 + state.p[1] * 0.4);
    // A monitor's gradient is one in q and p.
    let gradient = system.twice_kinetic_gradient(&state);
    close(gradient.p[0], 2.0 * 1.1);
    close(gradient.p[1], 2.0 * 0.4);
}

#[test]
fn dense_mass_matrices() {
    for x in [-0.9, 0.2, 1.3] {
        check!(
            Dense3::default(),
            [x, 0.7, -0.4],
            [0.3, -0.8, x],
            |q: &Scalars<f64, 3>, s: &Scalars<f64, 3>| {
                let ([x, y, z], [u, v, w]): ([f64; 3], [f64; 3]) = ((*q).into(), (*s).into());
                u * u
                    + (1.0 + x * x) * v * v
                    + (2.0 + y.sin().powi(2)) * w * w / 2.0
                    + x * u * v / 2.0
                    + z.cos() * v * w / 3.0
                    + y * u * w / 4.0
                    - x * x
                    - y * y * z * z
            }
        );
        check!(
            Dense4 {},
            [x, 0.7, -0.4, 0.6],
            [0.3, -0.8, x, 0.5],
            |q: &Scalars<f64, 4>, s: &Scalars<f64, 4>| {
                let ([a, b, c, d], [va, vb, vc, vd]): ([f64; 4], [f64; 4]) =
                    ((*q).into(), (*s).into());
                2.0 * va * va
                    + (3.0 + a * a) * vb * vb
                    + (2.0 + d.cos()) * vc * vc
                    + 2.0 * vd * vd
                    + va * vb * c.sin() / 2.0
                    + va * vc / 3.0
                    + va * vd * b / 4.0
                    + vb * vc * d / 5.0
                    + vb * vd / 2.0
                    + vc * vd * a.cos()
                    - a * a
                    - b * b / 2.0
                    - c.powi(4)
                    - d.cos()
                    + va * b
                    - vc * a * d
            }
        );
    }
}

#[test]
fn gyroscopic_terms() {
    same(&Charge::default(), &ChargeByHand::default());
    let charge = Charge::default();
    let state = charge.state_from_velocity(0.0, [1.0, 2.0, 3.0], [0.1, 0.2, 0.3]);
    close(state.p[0], 1.5 * 0.1 + 2.0 * 0.7 * 2.0 / 2.0);
}

#[test]
fn loops() {
    for n in [1, 2, 5] {
        let masses: Vec<f64> = (1..=n).map(|i| i as f64).collect();
        let chain = Chain::new(n, masses.clone()).unwrap();
        let q: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let v: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
        let kinetic: f64 = (0..n).map(|i| masses[i] * v[i] * v[i] / 2.0).sum();
        let m = masses.clone();
        let state = check!(chain.clone(), q, v.clone(), |q: &_, _: &_| {
            let spring = |i: usize| {
                let r: f64 = Vector::component(q, i) - Vector::component(q, i - 1);
                r * r + r.powi(4) / 4.0
            };
            kinetic - (1..n).map(spring).sum::<f64>()
        });
        close(chain.kinetic(&state), kinetic);
        close(chain.momentum(&state), (0..n).map(|i| m[i] * v[i]).sum());
    }
    let bodies = Bodies::<3> {
        m: [1.0, 2.0, 3.0].into(),
    };
    let q = [[1.0, 0.0, 0.2], [0.0, 1.5, 0.1], [-1.0, 0.3, 0.0]];
    let v = [[0.1, 0.2, 0.3], [0.4, -0.5, 0.6], [-0.7, 0.8, -0.9]];
    let state = bodies.state_from_velocity(0.0, q, v);
    let velocity = bodies.velocity(&state);
    for (i, row) in v.iter().enumerate() {
        for (c, value) in row.iter().enumerate() {
            close(state.p[(i, c)], (i + 1) as f64 * value);
            close(velocity[(i, c)], *value);
        }
    }
}

#[test]
fn depending_on_time() {
    same(&Shaken::default(), &ShakenByHand::default());
    let shaken = Shaken::default();
    let state = shaken.state_from_velocity(0.7, [0.4], [-1.3]);
    assert_eq!(state.t, 0.7);
    close(shaken.velocity(&state)[0], -1.3);
    close(shaken.speed(&state), -1.3 * 1.1);
}

#[test]
fn runs_are_those_of_the_hamiltonian() {
    let system = DoublePendulum::default();
    let start = system.state_from_velocity(0.0, [0.5, -0.3], [0.2, 0.1]);
    let step = 1e-3;
    let mut ours =
        Integrator::new(&system, ImplicitMidpoint::default(), start.clone(), step).unwrap();
    let by_hand = ByHand::default();
    let mut theirs = Integrator::new(&by_hand, ImplicitMidpoint::default(), start, step).unwrap();
    ours.advance(2000).unwrap();
    theirs.advance(2000).unwrap();
    assert!((ours.state().q - theirs.state().q).norm() < 1e-11);
}

/// Type I: steps follow from the sum of L itself over a line from q₀ to q₁, p₀ = −∂S/∂q₀ and p₁ = ∂S/∂q₁,
/// though the definition is integrated by its H.
#[test]
fn steps_are_those_of_the_discrete_lagrangian() {
    fn lagrangian<T: Real>([a, b]: [T; 2], [va, vb]: [T; 2]) -> T {
        let number = |x: f64| T::constant(x, 0.0);
        number(0.5 * 1.8 * 1.2 * 1.2) * va * va
            + number(0.5 * 0.8 * 0.9 * 0.9) * vb * vb
            + number(0.8 * 1.2 * 0.9) * va * vb * (a - b).cos()
            + number(1.8 * 9.81 * 1.2) * a.cos()
            + number(0.8 * 9.81 * 0.9) * b.cos()
    }
    /// The distance of the action and the momenta of a step from those of S with these nodes and weights.
    fn apart<const POINTS: usize>(
        scheme: Variational<1, POINTS>,
        rule: [(f64, f64); POINTS],
    ) -> f64 {
        const H: f64 = 0.1;
        let system = DoublePendulum::default();
        let start = system.state_from_velocity(0.0, [0.5, -0.3], [0.2, 0.1]);
        let run = Integrator::new(&system, scheme, start.clone(), H);
        let end = run.expect("a good start").advance(1).cloned();
        let end = end.expect("a good step");
        let ends = Ends::Coordinates(start.q, end.q);
        let path = scheme.extremal(&system, 0.0, H, ends).expect("a path");
        let mut worst = 0.0_f64;
        for k in 0..4 {
            let mut at = [start.q[0], start.q[1], end.q[0], end.q[1]].map(Dual::fixed);
            at[k].eps = 1.0;
            let [a0, b0, a1, b1] = at;
            let (da, db) = (a1 - a0, b1 - b0);
            let v = [da, db].map(|d| d * Dual::fixed(1.0 / H));
            let mut action = Dual::fixed(0.0);
            for (c, weight) in rule {
                let c = Dual::fixed(c);
                action += Dual::fixed(H * weight) * lagrangian([a0 + c * da, b0 + c * db], v);
            }
            let momentum = match k {
                0 | 1 => -start.p[k],
                _ => end.p[k - 2],
            };
            worst = worst.max((action.eps - momentum).abs());
            worst = worst.max((action.re - path.action).abs());
        }
        worst
    }
    let far = 0.5 * (1.0 - 1.0 / 3.0_f64.sqrt());
    let same = [
        apart(Variational::gauss(), [(0.5, 1.0)]),
        apart(Variational::lobatto(), [(0.0, 0.5), (1.0, 0.5)]),
        apart(Variational::gauss(), [(far, 0.5), (1.0 - far, 0.5)]),
    ];
    // Negative control: another quadrature.
    let other = apart(Variational::gauss(), [(0.0, 0.5), (1.0, 0.5)]);
    println!("{same:?}, another quadrature {other:.1e}");
    assert!(same.iter().all(|error| *error <= 1e-13), "{same:?}");
    assert!(other > 1e-5, "{other:e}");
}

hamiltonian! {
    /// A ring whose masses differ and whose friction pulls on differences of velocities.
    struct Ring { n: usize, m: [n] }
    L(q[n]; v[n]) = sum(i in 0..n) { m[i]*v[i]^2/2 + v[i]*sum(j in 0..n) { q[i]*q[j] }
        - (q[(i + 1) % n] - q[i])^2/2 };
    monitor stretching = sum(i in 0..n) { (v[(i + 1) % n] - v[i])^2*(i + 1) }
}

hamiltonian! {
    /// Three coupled velocities; at a literal number they may be coupled in any way.
    struct CoupledRing {}
    L(q[3]; v[3]) = sum(i in 0..3) { (v[i] - v[(i + 1) % 3])^2/2 + v[i]^2/2 - q[i]^2/2 };
    monitor stretching = sum(i in 0..3) { (v[(i + 1) % 3] - v[i])^2 }
}

#[test]
fn velocities_around_a_ring() {
    for n in [1usize, 2, 3, 7] {
        let ring = Ring::new(n, (1..=n).map(|i| i as f64).collect::<Vec<_>>()).unwrap();
        let q: Vec<f64> = (0..n).map(|i| (i as f64 + 0.3).sin()).collect();
        let v: Vec<f64> = (0..n).map(|i| (i as f64 + 0.2).cos()).collect();
        let state = ring.state_from_velocity(0.0, q, v.clone());
        let stretching: f64 = (0..n)
            .map(|i| (v[(i + 1) % n] - v[i]).powi(2) * (i + 1) as f64)
            .sum();
        close(ring.stretching(&state), stretching);
    }
    let v = [0.5_f64, -0.2, 0.9];
    let state = check!(CoupledRing {}, [0.3, 0.1, -0.4], v, |q: &_, _: &_| {
        let q = |i| Vector::component(q, i);
        let ring: f64 = (0..3).map(|i| (v[i] - v[(i + 1) % 3]).powi(2)).sum();
        let kinetic: f64 = v.iter().map(|v| v * v).sum();
        ring / 2.0 + kinetic / 2.0 - (0..3).map(|i: usize| q(i) * q(i)).sum::<f64>() / 2.0
    });
    close(CoupledRing {}.stretching(&state), 0.49 + 1.21 + 0.16);
}

hamiltonian! {
    /// Velocities coupled to the neighbours of their elements, on both sides.
    struct Neighbours { n: usize }
    L(q[n]; v[n]) = sum(i in 0..n) { v[i]^2/2 } + sum(i in 0..n - 1) { v[i]*q[i + 1]^2 }
        + sum(i in 1..n) { v[i]*q[i - 1] } + sum(i in 0..n - 1, j in 0..i) { v[i + 1]*q[j]^3 };
    monitor kinetic = sum(i in 0..n) { v[i]^2/2 };
    event first = v[0];
    monitor changed = bracket(q[0], sum(i in 0..n) { v[i]^2/2 })
}

hamiltonian! {
    /// The same of a literal length.
    struct Fourth<const N: usize> {}
    L(q[N]; v[N]) = sum(i in 0..N) { v[i]^2/2 } + sum(i in 1..N) { v[i]*q[i - 1] }
}

hamiltonian! {
    /// The notation of a sum from `i` on, where the velocity is that of row `i + 1`.
    struct Later { n: usize }
    L(q[n]; v[n]) = sum(i in 0..n) { v[i]^2/2 }
        + sum(i in 0..n - 1, j in 0..n) { if i <= j { v[i + 1]*q[j] } else { 0 } }
}

hamiltonian! {
    /// Beside velocities of neighbours, a sum under a condition that starts at the last element.
    struct Held { n: usize }
    let last = if q[0] > 0 { sum(i in n - 1..n) { q[i]^2 } } else { q[0] };
    L(q[n]; v[n]) = sum(i in 0..n) { v[i]^2/2 } + sum(i in 1..n) { v[i]*q[i - 1] } - last;
    monitor potential = last
}

/// b of p = v + b.
fn pulls(q: &[f64]) -> Vec<f64> {
    let pull = |i: usize| {
        let after = q.get(i + 1).map_or(0.0, |q| q * q);
        let before = if i > 0 { q[i - 1] } else { 0.0 };
        let all = q[..i.saturating_sub(1)].iter().map(|q| q.powi(3));
        after + before + all.sum::<f64>()
    };
    (0..q.len()).map(pull).collect()
}

#[test]
fn velocities_coupled_to_neighbours() {
    for n in [1usize, 2, 3, 4, 6] {
        let system = Neighbours::new(n).unwrap();
        let q: Vec<f64> = (0..n).map(|i| 0.3 + 0.2 * i as f64).collect();
        let v: Vec<f64> = (0..n).map(|i| 0.5 - 0.3 * i as f64).collect();
        let state = system.state_from_velocity(0.0, q.clone(), v.clone());
        let energy = |q: &[f64]| -> f64 {
            let velocities = state.p.iter().zip(pulls(q)).map(|(p, b)| p - b);
            velocities.map(|v| v * v / 2.0).sum()
        };
        close(system.energy(&state), energy(&q));
        close(system.kinetic(&state), energy(&q));
        close(system.first(&state), v[0]);
        close(system.changed(&state), v[0]);
        let velocity = system.velocity(&state);
        let gradient = system.gradient(&state);
        let first = system.first_gradient(&state);
        for i in 0..n {
            close(state.p[i], v[i] + pulls(&q)[i]);
            close(velocity[i], v[i]);
            close(gradient.p[i], v[i]);
            // ∂H/∂q = −Σ v·∂b/∂q
            let mut slope = 0.0;
            if i > 0 {
                slope -= v[i - 1] * 2.0 * q[i];
            }
            if i + 1 < n {
                slope -= v[i + 1];
            }
            slope -= v
                .iter()
                .skip(i + 2)
                .map(|v| v * 3.0 * q[i] * q[i])
                .sum::<f64>();
            close(gradient.q[i], slope);
            close(first.q[i], if i == 1 { -2.0 * q[1] } else { 0.0 });
        }
    }
    for n in [1usize, 2, 4] {
        let q: Vec<f64> = (0..n).map(|i| 0.3 + 0.2 * i as f64).collect();
        let state = Later::new(n)
            .unwrap()
            .state_from_velocity(0.0, q.clone(), vec![0.0; n]);
        for i in 0..n {
            let from = if i > 0 { i - 1 } else { n };
            close(state.p[i], q[from..].iter().sum::<f64>());
        }
    }
    for n in [1usize, 2, 4] {
        let system = Held::new(n).unwrap();
        let state = State::new(vec![0.5; n], vec![0.75; n]);
        close(system.potential(&state), 0.25);
        let kinetic = 0.75 * 0.75 / 2.0 + (n - 1) as f64 * 0.25 * 0.25 / 2.0;
        close(system.energy(&state), kinetic + 0.25);
    }
    fn fourth<const N: usize>() {
        let (q, p): ([f64; N], [f64; N]) = (
            std::array::from_fn(|i| 0.1 * (i + 1) as f64),
            std::array::from_fn(|i| (i + 1) as f64),
        );
        let v = |i: usize| p[i] - if i > 0 { q[i - 1] } else { 0.0 };
        let energy: f64 = (0..N).map(|i| v(i) * v(i) / 2.0).sum();
        close(Fourth::<N> {}.energy(&State::new(q, p)), energy);
    }
    fourth::<1>();
    fourth::<2>();
    fourth::<4>();
}

hamiltonian! {
    /// A chain whose ends are heavier, with a force on one of them.
    struct HeavyEnds<const N: usize> { first = 3.0, last = 2.0 }
    L(q[N]; v[N]) = first*v[0]^2/2 + sum(i in 1..N - 1) { (i + 1)*v[i]^2/2 } + last*v[N - 1]^2/2
        + v[0]*q[N - 1] - sum(i in 1..N) { (q[i] - q[i - 1])^2/2 };
    monitor speed = v[0] + v[N - 1]
}

#[test]
fn elements_with_masses_of_their_own() {
    fn check<const N: usize>() {
        let q: [f64; N] = std::array::from_fn(|i| (i as f64 + 0.4).sin());
        let v: [f64; N] = std::array::from_fn(|i| (i as f64 + 0.9).cos());
        let mass = |i: usize| match i {
            0 => 3.0,
            i if i + 1 == N => 2.0,
            i => i as f64 + 1.0,
        };
        let state = check!(HeavyEnds::<N>::default(), q, v, |q: &_, v: &_| {
            let (q, v): (&Scalars<f64, N>, &Scalars<f64, N>) = (q, v);
            let kinetic: f64 = (0..N).map(|i| mass(i) * v[i] * v[i] / 2.0).sum();
            let springs: f64 = (1..N).map(|i| (q[i] - q[i - 1]).powi(2) / 2.0).sum();
            kinetic + v[0] * q[N - 1] - springs
        });
        close(HeavyEnds::<N>::default().speed(&state), v[0] + v[N - 1]);
    }
    check::<2>();
    check::<3>();
    check::<7>();
}

hamiltonian! {
    /// Bodies with a loop over components around one over bodies.
    struct Columns<const N: usize> {}
    L(q[N][3]; v[N][3]) = sum(c in 0..3, i in 0..N) { (c + 1)*v[i][c]^2/2 }
        - sum(i in 0..N, c in 0..3, j in 0..i) { (q[i][c] - q[j][c])^2 }
}

#[test]
fn loops_over_components_around_loops_over_bodies() {
    let system = Columns::<2> {};
    let (q, p): ([[f64; 3]; 2], [[f64; 3]; 2]) = (
        [[0.5, -1.0, 2.0], [1.5, 0.25, -0.5]],
        [[1.0, 2.0, 3.0], [-2.0, 0.5, 1.0]],
    );
    let mut energy = 0.0;
    for c in 0..3 {
        energy += (p[0][c].powi(2) + p[1][c].powi(2)) / (2.0 * (c as f64 + 1.0));
        energy += (q[1][c] - q[0][c]).powi(2);
    }
    close(system.energy(&State::new(q, p)), energy);
}
