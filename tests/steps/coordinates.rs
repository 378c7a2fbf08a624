//! Canonical coordinates: the variables they replace, whole and in mixed shapes, and the maps between both.

use hamiltonian::prelude::*;

use crate::canonical::same_system;
use crate::common::canonical::{close, equal};

hamiltonian! {
    /// A planet in the plane.
    pub struct Flat { mu = 1.2, B = 0.3 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - mu/sqrt(x^2 + y^2) + B*(x*p_y - y*p_x);
    invariant angular_momentum = x*p_y - y*p_x
}

hamiltonian! {
    /// The same in polar coordinates.
    pub struct Polar { mu = 1.2, B = 0.3 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - mu/sqrt(x^2 + y^2) + B*(x*p_y - y*p_x);
    coordinates polar(x, y);
    invariant angular_momentum = x*p_y - y*p_x
}

hamiltonian! {
    /// The planet as a vector.
    pub struct Plane { mu = 1.2, B = 0.3 }
    H(q[2]; p[2]) = norm_squared(p)/2 - mu/norm(q) + B*(q[0]*p[1] - q[1]*p[0]);
    coordinates polar(q);
    invariant angular_momentum = q[0]*p[1] - q[1]*p[0]
}

hamiltonian! {
    /// A vector in space.
    pub struct Vectorial { g = 0.2 }
    H(q[3]; p[3]) = norm_squared(p)/2 - 1/norm(q) + g*q[2]*q[0] + g*dot(q, p)
}

hamiltonian! {
    /// The same in spherical coordinates.
    pub struct FromVector { g = 0.2 }
    H(q[3]; p[3]) = norm_squared(p)/2 - 1/norm(q) + g*q[2]*q[0] + g*dot(q, p);
    coordinates spherical(q)
}

hamiltonian! {
    /// A vector between a chain and a number.
    pub struct Mixed {}
    H(s[4], q[2], u; w[4], p[2], p_u) = (norm_squared(w) + norm_squared(p) + 3*p_u^2)/2
        + sum(i in 0..3) { (s[i + 1] - s[i])^2*norm_squared(q) } + q[0]*u + 1/norm(q)
}

hamiltonian! {
    /// The same with polar coordinates for the vector.
    pub struct MixedPolar {}
    H(s[4], q[2], u; w[4], p[2], p_u) = (norm_squared(w) + norm_squared(p) + 3*p_u^2)/2
        + sum(i in 0..3) { (s[i + 1] - s[i])^2*norm_squared(q) } + q[0]*u + 1/norm(q);
    coordinates polar(q);
    event up = q[1]
}

hamiltonian! {
    /// Two vectors, of which one stays.
    pub struct Pair {}
    H(a[2], b[2]; c[2], d[2]) = (norm_squared(c) + norm_squared(d))/2 + norm_squared(a - b) + 1/norm(a)
}

hamiltonian! {
    /// The same: the polar ones come first, then the other.
    pub struct PairPolar {}
    H(a[2], b[2]; c[2], d[2]) = (norm_squared(c) + norm_squared(d))/2 + norm_squared(a - b) + 1/norm(a);
    coordinates polar(a)
}

hamiltonian! {
    /// A chain of run-time length beside a planet.
    pub struct Beside { n: usize }
    H(s[n], x, y; w[n], p_x, p_y) = norm_squared(w)/2 + (p_x^2 + p_y^2)/2
        + sum(i in 0..n) { (s[i] - s[(i + 1) % n])^2*x } + 1/sqrt(x^2 + y^2)
}

hamiltonian! {
    /// The same with the planet in polar coordinates.
    pub struct BesidePolar { n: usize }
    H(s[n], x, y; w[n], p_x, p_y) = norm_squared(w)/2 + (p_x^2 + p_y^2)/2
        + sum(i in 0..n) { (s[i] - s[(i + 1) % n])^2*x } + 1/sqrt(x^2 + y^2);
    coordinates polar(x, y)
}

hamiltonian! {
    /// A magnetic dipole's field and a linear potential along z.
    pub struct Space { mu = 0.8, g = 0.2 }
    let r = sqrt(x^2 + y^2 + z^2);
    H(x, y, z; p_x, p_y, p_z) = ((p_x + mu*y/r^3)^2 + (p_y - mu*x/r^3)^2 + p_z^2)/2 + g*z - 1/r
}

hamiltonian! {
    /// The same in spherical coordinates.
    pub struct Spherical { mu = 0.8, g = 0.2 }
    let r = sqrt(x^2 + y^2 + z^2);
    H(x, y, z; p_x, p_y, p_z) = ((p_x + mu*y/r^3)^2 + (p_y - mu*x/r^3)^2 + p_z^2)/2 + g*z - 1/r;
    coordinates spherical(x, y, z)
}

hamiltonian! {
    /// Four bodies.
    pub struct Bodies { m: [4] }
    H(q[4][3]; p[4][3]) = sum(i in 0..4) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..4, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    invariant total_momentum = sum(i in 0..4) { p[i] }
}

hamiltonian! {
    /// Four bodies in Jacobi coordinates.
    pub struct Jacobi { m: [4] }
    H(q[4][3]; p[4][3]) = sum(i in 0..4) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..4, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates jacobi(q, m);
    invariant total_momentum = sum(i in 0..4) { p[i] }
}

hamiltonian! {
    /// Four bodies in heliocentric coordinates.
    pub struct Heliocentric { m: [4] }
    H(q[4][3]; p[4][3]) = sum(i in 0..4) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..4, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m);
    invariant total_momentum = sum(i in 0..4) { p[i] }
}

hamiltonian! {
    /// Coordinates that are replaced around one that stays, with forces on all.
    pub struct Around {}
    H(x, u, y; p_x, p_u, p_y) = (p_x^2 + 2*p_u^2 + p_y^2)/2 + (x^2 + y^2)*u^2 + x*u;
    force(x, u, y; p_x, p_u, p_y) = [-p_x*y, -3*p_u*x, -p_y]
}

hamiltonian! {
    /// The same with two of them polar.
    pub struct AroundPolar {}
    H(x, u, y; p_x, p_u, p_y) = (p_x^2 + 2*p_u^2 + p_y^2)/2 + (x^2 + y^2)*u^2 + x*u;
    coordinates polar(x, y);
    force(x, u, y; p_x, p_u, p_y) = [-p_x*y, -3*p_u*x, -p_y]
}

hamiltonian! {
    /// Any number of bodies, on springs to their neighbours too.
    pub struct Swarm<const N: usize> { k = 0.1, m: [N] }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m[i]) + k*q[i][0]^4 }
        - sum(i in 0..N, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }
        + k*sum(i in 0..N - 1) { norm_squared(q[i + 1] - q[i]) + dot(p[i + 1], q[i])*i };
    force(q; p) = -k*norm_squared(q[0])*p;
    monitor momentum = sum(i in 0..N) { p[i] }
}

hamiltonian! {
    /// The same in heliocentric coordinates.
    pub struct SwarmAroundFirst<const N: usize> { k = 0.1, m: [N] }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m[i]) + k*q[i][0]^4 }
        - sum(i in 0..N, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }
        + k*sum(i in 0..N - 1) { norm_squared(q[i + 1] - q[i]) + dot(p[i + 1], q[i])*i };
    coordinates heliocentric(q, m);
    force(q; p) = -k*norm_squared(q[0])*p;
    monitor momentum = sum(i in 0..N) { p[i] };
    monitor last = q[N - 1][0]
}

hamiltonian! {
    /// Planets; their number is set at run time.
    pub struct Planets { n: usize, m: [n] }
    H(q[n][2]; p[n][2]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..n, j in i + 1..n) { m[i]*m[j]/norm(q[i] - q[j]) };
    /// A body is nowhere but where it is: the condition stands at its edge for i = j.
    monitor least = sum(i in 0..n, j in 0..n) { if q[i][0] <= q[j][0] { q[i][0] } else { q[j][0] } };
    invariant angular = sum(i in 0..n) { q[i][0]*p[i][1] - q[i][1]*p[i][0] }
}

hamiltonian! {
    /// The same in heliocentric coordinates.
    pub struct PlanetsAroundSun { n: usize, m: [n] }
    H(q[n][2]; p[n][2]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..n, j in i + 1..n) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m);
    monitor least = sum(i in 0..n, j in 0..n) { if q[i][0] <= q[j][0] { q[i][0] } else { q[j][0] } };
    invariant angular = sum(i in 0..n) { q[i][0]*p[i][1] - q[i][1]*p[i][0] }
}

hamiltonian! {
    /// A vector that becomes polar beside an array of any length.
    pub struct Ladder<const N: usize> {}
    H(s[N], q[2]; w[N], p[2]) = norm_squared(w)/2 + norm_squared(p)/2 + 1/norm(q)
        + sum(i in 0..N, j in 0..2) { (s[i] - q[j])^2 }
}

hamiltonian! {
    /// The same with it polar.
    pub struct LadderPolar<const N: usize> {}
    H(s[N], q[2]; w[N], p[2]) = norm_squared(w)/2 + norm_squared(p)/2 + 1/norm(q)
        + sum(i in 0..N, j in 0..2) { (s[i] - q[j])^2 };
    coordinates polar(q)
}

fn planet() -> State<<[f64; 2] as hamiltonian::IntoVector<hamiltonian::shape::Array>>::Vector> {
    State::new([0.7, -0.4], [0.3, 1.1])
}

#[test]
fn polar() {
    for (x, y) in [(0.7, -0.4), (-0.8, 0.6), (-0.5, -0.9), (0.0, 1.0)] {
        same_system!(
            Flat::default(),
            Polar::default(),
            State::new([x, y], [0.3, 1.1])
        );
    }
    let polar = Polar::default();
    let groups = polar.description().groups.iter();
    let names: Vec<_> = groups.map(|g| &*g.coordinate).collect();
    assert_eq!(names, ["r", "phi"]);
    let state = polar.from_declared(&planet());
    let l: f64 = Flat::default().angular_momentum(&planet());
    close(polar.angular_momentum(&state), l);
    close(state.p[1], l);
    assert!(state.q[0] > 0.0);
}

#[test]
fn spherical() {
    for z in [-0.6, 0.1, 0.9] {
        let state = State::new([0.7, -0.4, z], [0.3, 1.1, -0.5]);
        same_system!(Space::default(), Spherical::default(), state);
    }
}

#[test]
fn bodies() {
    let m = [3.0, 1.0, 0.5, 0.2];
    let q = [
        [0.1, 0.0, 0.2],
        [1.0, 0.3, -0.2],
        [-1.5, 0.4, 0.5],
        [0.3, 2.2, 0.1],
    ];
    let p = [
        [0.1, -0.3, 0.2],
        [0.0, 1.3, -0.2],
        [-0.1, -0.4, 0.1],
        [0.05, 0.02, 0.01],
    ];
    let bodies = Bodies { m: m.into() };
    let (jacobi, helio) = (Jacobi { m: m.into() }, Heliocentric { m: m.into() });
    let state = State::new(q, p);
    same_system!(bodies.clone(), jacobi.clone(), state.clone());
    same_system!(bodies.clone(), helio.clone(), state.clone());
    // The same as the maps of the library.
    let ours = jacobi.from_declared(&state);
    let theirs = hamiltonian::systems::coordinates::to_jacobi(&state, &m).unwrap();
    equal(&ours.q, &theirs.q);
    equal(&ours.p, &theirs.p);
    let ours = helio.from_declared(&state);
    let theirs = hamiltonian::systems::coordinates::to_heliocentric(&state);
    equal(&ours.q, &theirs.q);
    equal(&ours.p, &theirs.p);
    equal(
        &jacobi.total_momentum(&jacobi.from_declared(&state)),
        &bodies.total_momentum(&state),
    );
}

#[test]
fn groups_that_stay_change_their_number() {
    let (around, polar) = (Around {}, AroundPolar {});
    let names = polar.description().groups.iter();
    let names: Vec<_> = names.map(|g| &*g.coordinate).collect();
    assert_eq!(names, ["r", "phi", "u"]);
    let old = State::new([0.7, 0.2, -0.4], [0.3, -0.6, 1.1]);
    let there = polar.from_declared(&old);
    close(there.q[2], 0.2);
    close(there.p[2], -0.6);
    let back = polar.to_declared(&there);
    equal(&back.q, &old.q);
    equal(&back.p, &old.p);
    close(around.energy(&old), polar.energy(&there));
    let (f, g) = (around.force(&old), polar.force(&there));
    close(g[2], f[1]);
    let power: f64 = f.dot(&around.gradient(&old).p);
    close(power, g.dot(&polar.gradient(&there).p));
}

#[test]
fn vectors_become_numbers() {
    for q in [[0.7, -0.4], [-0.8, 0.6], [-0.5, -0.9], [0.0, 1.0]] {
        same_system!(Flat::default(), Plane::default(), State::new(q, [0.3, 1.1]));
    }
    assert_eq!(
        Plane::default().description().groups,
        Polar::default().description().groups
    );
    // The same type of states, and the same numbers, as from scalars.
    let old = State::new([0.7, -0.4], [0.3, 1.1]);
    let (ours, theirs) = (Plane::default(), Polar::default());
    let there = ours.from_declared(&old);
    assert_eq!(there, theirs.from_declared(&old));
    assert_eq!(ours.gradient(&there), theirs.gradient(&there));
    assert_eq!(ours.angular_momentum(&there), there.p[1]);

    let state = State::new([0.7, -0.4, -0.6], [0.3, 1.1, -0.5]);
    same_system!(Vectorial::default(), FromVector::default(), state);
}

#[test]
fn vectors_among_others() {
    let s = [0.3, -0.2, 0.5, 0.1];
    let w = [0.1, 0.2, -0.3, 0.4];
    let old = State {
        t: 0.25,
        q: MixedVector::new(s, [0.7, -0.4], 1.5),
        p: MixedVector::new(w, [0.3, 1.1], -0.2),
    };
    same_system!(Mixed {}, MixedPolar {}, old);
    let declared = State {
        t: 0.25,
        q: MixedPolarDeclared::new(s, [0.7, -0.4], 1.5),
        p: MixedPolarDeclared::new(w, [0.3, 1.1], -0.2),
    };
    let there = MixedPolar {}.from_declared(&declared);
    assert_eq!(there.q.r, 0.7f64.hypot(0.4));
    assert_eq!((there.q.s, there.q.u), (s.into(), 1.5));
    close(MixedPolar {}.up(&there), -0.4);

    let old = State {
        t: 0.0,
        q: PairVector::new([0.7, -0.4], [1.5, 0.2]),
        p: PairVector::new([0.3, 1.1], [0.1, -0.2]),
    };
    same_system!(Pair {}, PairPolar {}, old);
}

#[test]
fn values_have_maps_too() {
    let k = 0.5;
    let value = hamiltonian! {
        H(s[2], q[2]; w[2], p[2]) = (norm_squared(w) + norm_squared(p))/2 + k*dot(s, q);
        coordinates polar(q)
    };
    let old = State {
        t: 0.0,
        q: value.declared_vector([0.1, 0.2], [0.0, 2.0]),
        p: value.declared_vector([0.3, 0.4], [3.0, 0.5]),
    };
    let there = value.from_declared(&old);
    assert_eq!((there.q.r, there.p.r, there.p.phi), (2.0, 0.5, -6.0));
    close(value.energy(&there), (0.09 + 0.16 + 9.25) / 2.0 + 0.2);
    equal(&value.to_declared(&there).p, &old.p);
}

#[test]
fn coordinates_beside_an_array_of_run_time_length() {
    for n in 1..4 {
        let s: Vec<f64> = (0..n).map(|k| 0.1 * k as f64).collect();
        let w: Vec<f64> = (0..n).map(|k| 0.3 - 0.1 * k as f64).collect();
        let old = State {
            t: 0.0,
            q: BesideVector::new(s, 0.7, -0.4),
            p: BesideVector::new(w, 0.3, 1.1),
        };
        same_system!(Beside::new(n).unwrap(), BesidePolar::new(n).unwrap(), old);
    }
}

/// Numbers between −1 and 1, rows of D, the last column `apart` from row to row.
fn rows<const D: usize>(n: usize, k: f64, apart: f64) -> Vec<[f64; D]> {
    let number = |at: usize| (at as f64 * k + 0.4).sin();
    let row = |i: usize| {
        let mut row: [f64; D] = std::array::from_fn(|c| number(D * i + c));
        row[D - 1] += apart * i as f64;
        row
    };
    (0..n).map(row).collect()
}

fn any_number<const N: usize>() {
    let m: [f64; N] = std::array::from_fn(|i| 1.0 + 0.3 * i as f64);
    let array = |k, apart| -> [[f64; 3]; N] { rows::<3>(N, k, apart).try_into().unwrap() };
    let state = State::new(array(1.1, 2.5), array(0.7, 0.0));
    let declared = Swarm::<N> {
        k: 0.1,
        m: m.into(),
    };
    let new = SwarmAroundFirst::<N> {
        k: 0.1,
        m: m.into(),
    };
    let there = new.from_declared(&state);
    let theirs = hamiltonian::systems::coordinates::to_heliocentric(&state);
    equal(&there.q, &theirs.q);
    equal(&there.p, &theirs.p);
    let back = hamiltonian::systems::coordinates::from_heliocentric(&there);
    equal(&new.to_declared(&there).q, &back.q);
    equal(&new.to_declared(&there).p, &back.p);
    close(new.last(&there), state.q[(N - 1, 0)]);
    equal(&new.momentum(&there), &declared.momentum(&state));
    // A force is carried as the momenta are.
    let (force, old) = (new.force(&there), declared.force(&state));
    // Generic code has it too.
    assert_eq!(System::force_at::<f64>(&new, &there), force);
    let pushed = hamiltonian::systems::coordinates::to_heliocentric(&State { p: old, ..state });
    equal(&force, &pushed.p);
    same_system!(declared, new, state);
}

#[test]
fn heliocentric_coordinates_of_any_number_of_bodies() {
    any_number::<1>();
    any_number::<2>();
    any_number::<3>();
    any_number::<7>();
    for n in [1usize, 2, 3, 7] {
        let m: Vec<f64> = (0..n).map(|i| 1.0 / (1.0 + i as f64)).collect();
        let state = State::new(rows::<2>(n, 1.1, 2.5), rows::<2>(n, 0.7, 0.0));
        let planets = Planets::new(n, m.clone()).unwrap();
        let new = PlanetsAroundSun::new(n, m).unwrap();
        let there = new.from_declared(&state);
        let theirs = hamiltonian::systems::coordinates::to_heliocentric(&state);
        equal(&there.q, &theirs.q);
        equal(&there.p, &theirs.p);
        close(planets.angular(&state), new.angular(&there));
        close(planets.least(&state), new.least(&there));
        same_system!(planets, new, state);
    }
}

#[test]
fn vectors_beside_arrays_of_any_length() {
    let state = State {
        t: 0.0,
        q: LadderVector::<3, f64>::new([0.1, 0.2, 0.3], [0.7, -0.4]),
        p: LadderVector::<3, f64>::new([0.4, 0.5, 0.6], [0.3, 1.1]),
    };
    same_system!(Ladder::<3> {}, LadderPolar::<3> {}, state);
}

/// The same H twice: as declared, and in heliocentric coordinates.
macro_rules! both {
    ($as_declared:ident, $around_first:ident, $($h:tt)*) => {
        hamiltonian! {
            /// As declared.
            #[allow(unused_variables)]
            pub struct $as_declared { n: usize, m: [n] }
            $($h)*
        }
        hamiltonian! {
            /// In heliocentric coordinates.
            pub struct $around_first { n: usize, m: [n] }
            $($h)*;
            coordinates heliocentric(q, m)
        }
    };
}

both! {
    Backwards, BackwardsAroundFirst,
    H(q[n]; p[n]) = sum(i in 0..n) { p[n - 1 - i]^2/(2*m[i]) + sin(q[n - 1 - i])*q[i] }
}
both! {
    Shifted, ShiftedAroundFirst,
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 1..n, j in 0..i) { p[i - 1]*p[j]*q[i]*q[i - j - 1]/(5 + i + 2*j) }
}
both! {
    Crossed, CrossedAroundFirst,
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n - 1) { q[i + 1]*p[n - 2 - i] }
}

#[test]
fn rows_in_any_order_are_row_0_or_another_where_they_are_read() {
    for n in [1usize, 2, 4, 5] {
        let m: Vec<f64> = (0..n).map(|i| 1.0 + 0.5 * i as f64).collect();
        let numbers = |k: f64| -> Vec<f64> { (0..n).map(|i| (k * i as f64 + 0.4).sin()).collect() };
        let state = State::new(numbers(1.1), numbers(0.7));
        same_system!(
            Backwards::new(n, m.clone()).unwrap(),
            BackwardsAroundFirst::new(n, m.clone()).unwrap(),
            state.clone()
        );
        same_system!(
            Shifted::new(n, m.clone()).unwrap(),
            ShiftedAroundFirst::new(n, m.clone()).unwrap(),
            state.clone()
        );
        same_system!(
            Crossed::new(n, m.clone()).unwrap(),
            CrossedAroundFirst::new(n, m).unwrap(),
            state
        );
    }
}

hamiltonian! {
    /// Reads a body that few bodies do not have, and as many as another size says.
    pub struct Reaching { n: usize, k: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) } + (q[4] - q[0])^2 + sum(i in 0..k) { q[i]^2 }
}
hamiltonian! {
    /// The same around the first.
    pub struct ReachingAroundFirst { n: usize, k: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) } + (q[4] - q[0])^2 + sum(i in 0..k) { q[i]^2 };
    coordinates heliocentric(q, m)
}

#[test]
fn sizes_that_bound_each_other() {
    for (n, k) in [(5, 5), (6, 2), (7, 0)] {
        let m = vec![2.0; n];
        let numbers = |k: f64| -> Vec<f64> { (0..n).map(|i| (k * i as f64 + 0.4).sin()).collect() };
        same_system!(
            Reaching::new(n, k, m.clone()).unwrap(),
            ReachingAroundFirst::new(n, k, m).unwrap(),
            State::new(numbers(1.1), numbers(0.7))
        );
    }
}
