//! The systems of the examples: derivatives against duals, against H in plain Rust, and, where they
//! have loops, against the same written out term by term.

// Only the definitions of the examples are used, and their common module is read many times.
#![allow(dead_code, clippy::duplicate_mod)]

#[path = "../examples/dipole.rs"]
mod dipole;
#[path = "../examples/double_pendulum.rs"]
mod double_pendulum;
#[path = "../examples/driven_pendulum.rs"]
mod driven_pendulum;
#[path = "../examples/fput.rs"]
mod fput;
#[path = "../examples/henon_heiles.rs"]
mod henon_heiles;
#[path = "../examples/kerr.rs"]
mod kerr;
#[path = "../examples/nbody.rs"]
mod nbody;
#[path = "../examples/solar_system.rs"]
mod solar_system;
#[path = "../examples/three_body.rs"]
mod three_body;
#[path = "../examples/toda.rs"]
mod toda;

use crate::common::derivatives::{
    LENGTHS, Plain, agree, check_at, check_plain, chosen, close, numbers,
};
use dipole::Dipole;
use double_pendulum::{FromHamiltonian, FromLagrangian};
use driven_pendulum::DrivenPendulum;
use fput::Fput;
use hamiltonian::Real;
use hamiltonian::nalgebra::SVector;
use hamiltonian::prelude::*;
use henon_heiles::HenonHeiles;
use kerr::Kerr;
use three_body::{SlowNearBodies, ThreeBody};
use toda::Toda;

fn number<T: Real>(value: f64) -> T {
    T::constant(value, 0.0)
}

fn sum<T: Real>(terms: impl Iterator<Item = T>) -> T {
    terms.fold(T::zero(), |sum, term| sum + term)
}

fn half_square<T: Real>(x: T) -> T {
    x * x / number(2.0)
}

/// Both checks in a state that numbers choose.
fn check<S: System>(system: &S, plain: &impl Plain) {
    let state = chosen(system, 1);
    check_at(system, &state);
    check_plain(system, &state, plain);
}

/// The same in twenty states, which `within` brings into the domain.
fn check_states<S, const N: usize>(
    system: &S,
    plain: &impl Plain,
    within: impl Fn([f64; N], [f64; N]) -> ([f64; N], [f64; N]),
) where
    S: System,
    S: System<Shape = SVector<(), N>>,
{
    for seed in 10..30 {
        let state = chosen(system, 3 * seed);
        let (q, p) = within(state.q.into(), state.p.into());
        let state = State::new(q, p).at(state.t);
        check_at(system, &state);
        check_plain(system, &state, plain);
    }
}

struct PlainToda;

impl Plain for PlainToda {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let n = q.len();
        sum((0..n).map(|i| half_square(p[i]) + (q[i] - q[(i + 1) % n]).exp()))
    }
}

struct PlainFput;

impl Plain for PlainFput {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let n = q.len();
        // The walls are particles that do not move.
        let at = |i: usize| match i {
            0 => T::zero(),
            _ if i == n + 1 => T::zero(),
            _ => q[i - 1],
        };
        let spring = |r: T| half_square(r) + number::<T>(0.25) * r * r * r / number(3.0);
        let kinetic = sum(p.iter().map(|p| half_square(*p)));
        kinetic + sum((0..=n).map(|i| spring(at(i + 1) - at(i))))
    }
}

/// [`check`] for every length of a system with a length.
macro_rules! for_lengths {
    ($system:ident, $plain:expr; $($n:literal)*) => {
        $(check(&$system::<$n>::default(), $plain);)*
    };
}

#[test]
fn toda_of_every_length() {
    for_lengths!(Toda, &PlainToda; 1 2 3 7 64 131);
}

#[test]
fn fput_of_every_length() {
    for_lengths!(Fput, &PlainFput; 1 2 3 7 64 131);
}

struct PlainGravity {
    constant: f64,
    softening: f64,
    masses: Vec<f64>,
}

impl Plain for PlainGravity {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let n = self.masses.len();
        let mass = |i: usize| number::<T>(self.masses[i]);
        let square = |x: &dyn Fn(usize) -> T| sum((0..3).map(|c| x(c) * x(c)));
        let kinetic = |i: usize| square(&|c| p[i + n * c]) / (mass(i) + mass(i));
        let pair = |i: usize, j: usize| {
            let distance = square(&|c| q[i + n * c] - q[j + n * c]);
            let distance = distance + number(self.softening * self.softening);
            mass(i) * mass(j) / distance.sqrt()
        };
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        sum((0..n).map(kinetic)) - number::<T>(self.constant) * sum(pairs.map(|(i, j)| pair(i, j)))
    }
}

fn masses(n: usize) -> Vec<f64> {
    numbers(3).take(n).map(|x| 1.5 + x).collect()
}

#[test]
fn bodies_of_every_number() {
    for n in LENGTHS {
        let mut plain = PlainGravity {
            constant: 0.75,
            softening: 0.0,
            masses: masses(n),
        };
        let mut planets = solar_system::Gravity::new(n, masses(n)).expect("as many masses");
        planets.G = plain.constant;
        check(&planets, &plain);
        (plain.constant, plain.softening) = (1.0, 0.25);
        let mut stars = nbody::Gravity::new(n, masses(n)).expect("as many masses");
        stars.epsilon = plain.softening;
        check(&stars, &plain);
    }
}

/// A lattice written out: each particle with its momentum and the next particle.
macro_rules! written_toda {
    ($name:ident: $($q:ident $p:ident $next:ident),*) => {
        hamiltonian! {
            pub struct $name {}
            H($($q),*; $($p),*) = 0 $(+ $p^2/2 + exp($q - $next))*
        }
    };
}

written_toda!(Toda1: a pa a);
written_toda!(Toda2: a pa b, b pb a);
written_toda!(Toda3: a pa b, b pb c, c pc a);
written_toda!(Toda7: a pa b, b pb c, c pc d, d pd e, e pe f, f pf g, g pg a);

/// A chain between walls written out: each particle with its momentum; each spring with its ends.
macro_rules! written_fput {
    ($name:ident: $($q:ident $p:ident),*; $($left:tt $right:tt),*) => {
        hamiltonian! {
            pub struct $name { alpha = 0.25 }
            H($($q),*; $($p),*) = 0 $(+ $p^2/2)*
                $(+ ($right - $left)^2/2 + alpha*($right - $left)^3/3)*
        }
    };
}

written_fput!(Fput1: a pa; 0 a, a 0);
written_fput!(Fput2: a pa, b pb; 0 a, a b, b 0);
written_fput!(Fput3: a pa, b pb, c pc; 0 a, a b, b c, c 0);
written_fput!(Fput7: a pa, b pb, c pc, d pd, e pe, f pf, g pg;
    0 a, a b, b c, c d, d e, e f, f g, g 0);

/// Bodies written out: (mass, position, momentum) of each, paired with all that follow.
macro_rules! written_bodies {
    ($name:ident: $($body:tt)*) => {
        written_bodies! { @pair $name [$($body)*] [] $($body)* }
    };
    (@pair $name:ident $all:tt [$($pair:tt)*] $one:tt $($other:tt)*) => {
        written_bodies! { @pair $name $all [$($pair)* $([$one $other])*] $($other)* }
    };
    (@pair $name:ident
        [$(($m:ident $x:ident $y:ident $z:ident $u:ident $v:ident $w:ident))*]
        [$([($m1:ident $x1:ident $y1:ident $z1:ident $($p1:ident)*)
            ($m2:ident $x2:ident $y2:ident $z2:ident $($p2:ident)*)])*]
    ) => {
        hamiltonian! {
            // One body alone reads neither.
            #[allow(unused_variables)]
            pub struct $name { G, epsilon, $($m),* }
            H($($x,)* $($y,)* $($z),*; $($u,)* $($v,)* $($w),*) =
                0 $(+ ($u^2 + $v^2 + $w^2)/(2*$m))*
                $(- G*$m1*$m2/sqrt(($x1 - $x2)^2 + ($y1 - $y2)^2 + ($z1 - $z2)^2 + epsilon^2))*
        }
        impl $name {
            /// Its masses from a list.
            fn of(constant: f64, epsilon: f64, masses: &[f64]) -> Self {
                let mut masses = masses.iter().copied();
                let mut next = || masses.next().expect("as many masses");
                Self { G: constant, epsilon, $($m: next()),* }
            }
        }
    };
}

written_bodies!(Bodies1: (m1 x1 y1 z1 u1 v1 w1));
written_bodies!(Bodies2: (m1 x1 y1 z1 u1 v1 w1) (m2 x2 y2 z2 u2 v2 w2));
written_bodies!(Bodies3: (m1 x1 y1 z1 u1 v1 w1) (m2 x2 y2 z2 u2 v2 w2) (m3 x3 y3 z3 u3 v3 w3));
written_bodies!(Bodies7: (m1 x1 y1 z1 u1 v1 w1) (m2 x2 y2 z2 u2 v2 w2) (m3 x3 y3 z3 u3 v3 w3)
    (m4 x4 y4 z4 u4 v4 w4) (m5 x5 y5 z5 u5 v5 w5) (m6 x6 y6 z6 u6 v6 w6) (m7 x7 y7 z7 u7 v7 w7));

#[test]
fn loops_are_what_they_are_written_out() {
    agree(&Toda::<1> {}, &Toda1 {});
    agree(&Toda::<2> {}, &Toda2 {});
    agree(&Toda::<3> {}, &Toda3 {});
    agree(&Toda::<7> {}, &Toda7 {});
    let alpha = 0.75;
    agree(&Fput::<1> { alpha }, &Fput1 { alpha });
    agree(&Fput::<2> { alpha }, &Fput2 { alpha });
    agree(&Fput::<3> { alpha }, &Fput3 { alpha });
    agree(&Fput::<7> { alpha }, &Fput7 { alpha });
    macro_rules! bodies {
        ($($n:literal $written:ident)*) => {
            $(
                let mut planets = solar_system::Gravity::new($n, masses($n)).expect("as many masses");
                planets.G = 0.75;
                agree(&planets, &$written::of(0.75, 0.0, &masses($n)));
                let mut stars = nbody::Gravity::new($n, masses($n)).expect("as many masses");
                stars.epsilon = 0.25;
                agree(&stars, &$written::of(1.0, 0.25, &masses($n)));
            )*
        };
    }
    bodies!(1 Bodies1 2 Bodies2 3 Bodies3 7 Bodies7);
}

struct PlainDoublePendulum;

impl Plain for PlainDoublePendulum {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let [m1, m2, l1, l2, g] = [1.1, 0.8, 1.2, 0.9, 9.81].map(number::<T>);
        // ½ pᵀM⁻¹p.
        let (one, other) = ((m1 + m2) * l1 * l1, m2 * l2 * l2);
        let coupling = m2 * l1 * l2 * (q[0] - q[1]).cos();
        let determinant = one * other - coupling * coupling;
        let twice = number::<T>(2.0) * coupling * p[0] * p[1];
        (other * p[0] * p[0] + one * p[1] * p[1] - twice) / (determinant + determinant)
            - (m1 + m2) * g * l1 * q[0].cos()
            - m2 * g * l2 * q[1].cos()
    }
}

#[test]
fn double_pendulum() {
    let (m1, m2, l1, l2, g) = (1.1, 0.8, 1.2, 0.9, 9.81);
    let system = FromHamiltonian { m1, m2, l1, l2, g };
    check_states(&system, &PlainDoublePendulum, |q, p| (q, p));
    let system = FromLagrangian { m1, m2, l1, l2, g };
    check_states(&system, &PlainDoublePendulum, |q, p| (q, p));
}

struct PlainDrivenPendulum;

impl Plain for PlainDrivenPendulum {
    fn energy<T: Real>(&self, t: T, q: &[T], p: &[T]) -> T {
        let [l, g, a, omega] = [1.25, 0.75, 0.125, 3.0].map(number::<T>);
        let weight = g - a * omega * omega * (omega * t).cos();
        half_square(p[0] / l) - weight * l * q[0].cos()
    }
}

#[test]
fn driven_pendulum() {
    let (l, g, a, omega) = (1.25, 0.75, 0.125, 3.0);
    let system = DrivenPendulum { l, g, a, omega };
    check_states(&system, &PlainDrivenPendulum, |q, p| (q, p));
}

struct PlainThreeBody;

/// The distances from both bodies.
fn distances<T: Real>(q: &[T]) -> [T; 2] {
    [0.012277471, 0.012277471 - 1.0].map(|x| (q[0] + number(x)).hypot(q[1]))
}

impl Plain for PlainThreeBody {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let mu = number::<T>(0.012277471);
        let [earth, moon] = distances(q);
        let turning = q[1] * p[0] - q[0] * p[1];
        half_square(p[0]) + half_square(p[1]) + turning - (T::one() - mu) / earth - mu / moon
    }
}

struct PlainSlowNearBodies;

impl Plain for PlainSlowNearBodies {
    fn energy<T: Real>(&self, t: T, q: &[T], p: &[T]) -> T {
        let [earth, moon] = distances(q);
        (earth * moon).pow(number(1.5)) * (PlainThreeBody.energy(t, q, p) + p[2])
    }
}

#[test]
fn three_body() {
    check_states(&ThreeBody::default(), &PlainThreeBody, |q, p| (q, p));
    let slow = SlowNearBodies::default();
    check_states(&slow, &PlainSlowNearBodies, |q, p| (q, p));
}

struct PlainDipole;

impl Plain for PlainDipole {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let mu = number::<T>(1.5);
        let r = sum(q.iter().map(|q| *q * *q)).sqrt();
        let about = mu / (r * r * r);
        half_square(p[0] + about * q[1]) + half_square(p[1] - about * q[0]) + half_square(p[2])
    }
}

#[test]
fn dipole() {
    let system = Dipole { mu: 1.5 };
    check_states(&system, &PlainDipole, |q, p| (q, p));
}

struct PlainKerr;

impl Plain for PlainKerr {
    /// ½ gᵘᵛ p_u p_v with the inverse metric entry by entry.
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let (a, energy) = (number::<T>(0.8), number::<T>(0.95));
        let (r, two) = (q[0], number::<T>(2.0));
        let (sin, cos) = q[1].sin_cos();
        let sigma = r * r + a * a * cos * cos;
        let delta = r * r - two * r + a * a;
        let sum = r * r + a * a;
        let tt = -(sum * sum - delta * a * a * sin * sin) / (sigma * delta);
        let tp = -(two * a * r) / (sigma * delta);
        let pp = (delta - a * a * sin * sin) / (sigma * delta * sin * sin);
        let l = p[2];
        // p_t = −E.
        half_square(p[0]) * delta / sigma
            + half_square(p[1]) / sigma
            + (tt * energy * energy - two * tp * energy * l + pp * l * l) / two
    }
}

#[test]
fn kerr() {
    let system = Kerr { a: 0.8, E: 0.95 };
    // Outside of the horizon, away from the axis.
    let outside = |[r, theta, phi]: [f64; 3], p| ([5.0 + 4.0 * r, 1.5 + theta, phi], p);
    check_states(&system, &PlainKerr, outside);
}

struct PlainHenonHeiles;

impl Plain for PlainHenonHeiles {
    fn energy<T: Real>(&self, _: T, q: &[T], p: &[T]) -> T {
        let (x, y) = (q[0], q[1]);
        let quadratic = sum([p[0], p[1], x, y].into_iter().map(half_square));
        quadratic + x * x * y - y * y * y / number(3.0)
    }
}

#[test]
fn henon_heiles() {
    check_states(&HenonHeiles {}, &PlainHenonHeiles, |q, p| (q, p));
    let state = State::new([0.0, 0.5], [0.0, 0.0]);
    close(HenonHeiles {}.energy(&state), 0.125 - 0.125 / 3.0);
}
