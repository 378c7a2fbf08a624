//! The workloads: a run by the library and its hand-written twin, the same steps to the same end.
//!
//! Both are kept out of line and are given their inputs through `black_box`, so that neither is
//! computed by the compiler.

use hamiltonian::Scheme;
use hamiltonian::prelude::*;
use hamiltonian::schemes::{Composition, Pihajoki, Yoshida4};
use std::hint::black_box;

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(q; p) = p^2/(2*m*l^2) - m*g*l*cos(q)
}

hamiltonian! {
    /// The paper's equation (34).
    pub struct NonSeparable {}
    H(q; p) = 0.5*(q^2 + 1)*(p^2 + 1)
}

hamiltonian! {
    /// The Hénon–Heiles system.
    pub struct HenonHeiles {}
    H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

const STEP: f64 = 1e-3;

/// A workload: its name, and both ways to make `n` steps; the result is q and p at the end.
pub struct Workload {
    /// The workload.
    pub name: &'static str,
    /// By the library.
    pub library: fn(u64) -> Vec<f64>,
    /// By hand.
    pub twin: fn(u64) -> Vec<f64>,
}

/// All workloads.
pub const ALL: &[Workload] = &[
    Workload {
        name: "pendulum, Störmer–Verlet",
        library: pendulum,
        twin: pendulum_twin,
    },
    Workload {
        name: "(34), Pihajoki (29) fused",
        library: doubled,
        twin: doubled_twin,
    },
    Workload {
        name: "Hénon–Heiles, Störmer–Verlet",
        library: henon_heiles,
        twin: henon_heiles_twin,
    },
    Workload {
        name: "Hénon–Heiles, Yoshida 4",
        library: |n| yoshida(Yoshida4, n),
        twin: yoshida_twin,
    },
    Workload {
        name: "Hénon–Heiles, composed Strang",
        library: |n| yoshida(Composition::yoshida(Strang), n),
        twin: yoshida_twin,
    },
];

#[inline(never)]
fn pendulum(n: u64) -> Vec<f64> {
    let system = black_box(Pendulum::default());
    let start = black_box(State::new([0.7], [3.0]));
    let mut run = Integrator::new(
        &system,
        StormerVerlet::KickDriftKick,
        start,
        black_box(STEP),
    )
    .unwrap();
    let end = run.advance(n).unwrap();
    vec![end.q[0], end.p[0]]
}

#[inline(never)]
fn pendulum_twin(n: u64) -> Vec<f64> {
    let Pendulum { m, l, g } = black_box(Pendulum::default());
    let h = black_box(STEP);
    let (mut q, mut p): (f64, f64) = black_box((0.7, 3.0));
    let (kick, drift) = (h * (m * g * l), h / (m * l * l));
    p -= 0.5 * kick * Real::sin(q);
    q += drift * p;
    for _ in 1..n {
        p -= kick * Real::sin(q);
        q += drift * p;
    }
    p -= 0.5 * kick * Real::sin(q);
    vec![q, p]
}

#[inline(never)]
fn doubled(n: u64) -> Vec<f64> {
    let start = black_box(State::new([0.3], [0.4]));
    let mut run = Integrator::new(
        &NonSeparable {},
        Pihajoki::CoordinateFirst,
        start,
        black_box(STEP),
    )
    .unwrap();
    let end = run.advance(n).unwrap();
    vec![end.q[0], end.p[0]]
}

#[inline(never)]
fn doubled_twin(n: u64) -> Vec<f64> {
    let h = black_box(STEP);
    let (mut q, mut p): (f64, f64) = black_box((0.3, 0.4));
    let (mut q2, mut p2) = (q, p);
    let half = 0.5 * h;
    q += half * p * (q2 * q2 + 1.0);
    p2 -= half * q2 * (p * p + 1.0);
    for _ in 1..n {
        q2 += h * p2 * (q * q + 1.0);
        p -= h * q * (p2 * p2 + 1.0);
        q += h * p * (q2 * q2 + 1.0);
        p2 -= h * q2 * (p * p + 1.0);
    }
    q2 += h * p2 * (q * q + 1.0);
    p -= h * q * (p2 * p2 + 1.0);
    q += half * p * (q2 * q2 + 1.0);
    vec![q, p]
}

#[inline(never)]
fn henon_heiles(n: u64) -> Vec<f64> {
    let start = black_box(State::new([0.1, -0.1], [0.3, 0.2]));
    let mut run = Integrator::new(
        &HenonHeiles {},
        StormerVerlet::KickDriftKick,
        start,
        black_box(STEP),
    )
    .unwrap();
    let end = run.advance(n).unwrap();
    vec![end.q[0], end.q[1], end.p[0], end.p[1]]
}

#[inline(never)]
fn henon_heiles_twin(n: u64) -> Vec<f64> {
    let h = black_box(STEP);
    let ([mut x, mut y], [mut px, mut py]) = black_box(([0.1, -0.1], [0.3, 0.2]));
    let half = 0.5 * h;
    px -= half * x * (1.0 + 2.0 * y);
    py -= half * (y + x * x - y * y);
    x += h * px;
    y += h * py;
    for _ in 1..n {
        px -= h * x * (1.0 + 2.0 * y);
        py -= h * (y + x * x - y * y);
        x += h * px;
        y += h * py;
    }
    px -= half * x * (1.0 + 2.0 * y);
    py -= half * (y + x * x - y * y);
    vec![x, y, px, py]
}

#[inline(never)]
fn yoshida<M: Scheme<HenonHeiles>>(scheme: M, n: u64) -> Vec<f64> {
    let start = black_box(State::new([0.1, -0.1], [0.3, 0.2]));
    let mut run = Integrator::new(&HenonHeiles {}, scheme, start, black_box(STEP)).unwrap();
    let end = run.advance(n).unwrap();
    vec![end.q[0], end.q[1], end.p[0], end.p[1]]
}

#[inline(never)]
fn yoshida_twin(n: u64) -> Vec<f64> {
    let h = black_box(STEP);
    let ([mut x, mut y], [mut px, mut py]) = black_box(([0.1, -0.1], [0.3, 0.2]));
    let outer = h / (2.0 - 2.0_f64.cbrt());
    let inner = h - 2.0 * outer;
    let middle = 0.5 * (outer + inner);
    macro_rules! kick {
        ($c:expr) => {
            px -= $c * x * (1.0 + 2.0 * y);
            py -= $c * (y + x * x - y * y);
        };
    }
    macro_rules! drift {
        ($c:expr) => {
            x += $c * px;
            y += $c * py;
        };
    }
    let half = 0.5 * outer;
    kick!(half);
    for k in 0..n {
        if k > 0 {
            kick!(outer);
        }
        drift!(outer);
        kick!(middle);
        drift!(inner);
        kick!(middle);
        drift!(outer);
    }
    kick!(half);
    vec![x, y, px, py]
}
