//! Compositions of exact flows: orders, symplectic forms, and energies that stay.

use crate::common::geometry::Geometry;
use crate::common::is_heavy;
use crate::common::order::Order;
use crate::common::systems::Paper34;
use crate::splits::{Body, InFour, Schwarzschild, Vortices};
use hamiltonian::prelude::*;
use hamiltonian::schemes::Visitor;
use hamiltonian::{DoubleDouble, Dual, Exact, Split};
use std::f64::consts::FRAC_PI_2;

/// The slope of Strang's scheme and of three compositions of it, from (q, p) over a time.
fn orders<S: Split<DoubleDouble> + Exact>(system: S, q: &[f64], p: &[f64], span: f64) {
    let mut order = Order::new(system, q, p, span, span / 16.0);
    order.visit(Strang);
    order.visit(Yoshida4);
    order.visit(KahanLi6);
    order.visit(KahanLi8);
    let slopes: Vec<f64> = order.measured.iter().map(|(_, slope)| *slope).collect();
    println!("{}: {slopes:?}", S::NAME);
    assert_eq!(slopes.len(), 4);
}

#[test]
fn orders_of_paper_34() {
    orders(Paper34::default(), &[0.8], &[-0.5], 1.0);
}

#[test]
fn orders_of_a_body() {
    orders(Body::default(), &[0.7, 0.2], &[0.5, 1.3], 1.0);
}

/// MᵀJM = J of one, two and three steps.
fn symplectic<S: Split<Dual<f64>> + Exact>(system: S, q: &[f64], p: &[f64], h: f64) {
    let mut geometry = Geometry::new(system, q, p, h);
    geometry.visit(Strang);
    geometry.visit(KahanLi8);
    for (entry, defect) in &geometry.measured {
        println!("{} on {}: {defect:e}", entry.name, S::NAME);
    }
    assert_eq!(geometry.measured.len(), 2 * 3);
}

#[test]
fn compositions_are_symplectic() {
    symplectic(Paper34::default(), &[0.8], &[-0.5], 0.3);
    symplectic(Schwarzschild::default(), &[5.0, 1.3], &[0.1, 2.0], 0.5);
    symplectic(Body::default(), &[0.7, 0.2], &[0.5, 1.3], 0.3);
    let strengths = [1.0, 1.2, 0.8].map(Dual::fixed).to_vec();
    let vortices = Vortices::new(3, strengths).expect("three strengths");
    symplectic(vortices, &[1.0, -1.0, 0.1], &[0.1, 0.2, 1.3], 0.3);
}

/// The largest |H − H₀| in the first and in the second half of a run.
fn halves<S: Split<f64>>(system: &S, start: &State<S::Vector>, h: f64, steps: u64) -> [f64; 2] {
    let first = system.energy(start);
    let mut run = Integrator::new(system, Strang, start.clone(), h).expect("a good start");
    let mut worst = [0.0_f64; 2];
    for worst in &mut worst {
        for _ in 0..steps / 2 {
            let state = run.advance(1).expect("a good step");
            *worst = worst.max((system.energy(state) - first).abs());
        }
    }
    println!("{}: {worst:?}", S::NAME);
    worst
}

#[test]
fn energies_do_not_drift() {
    let steps = if is_heavy() { 10_000_000 } else { 100_000 };
    let start = State::new([-3.0], [0.0]);
    let paper = halves(&Paper34::default(), &start, 1e-3, steps);
    // Of H = 5.
    assert!(paper[0] / 5.0 < 1.0e-6, "{paper:?}");
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    let four = halves(&InFour::default(), &start, 1.0, steps);
    assert!((7.2e-6..7.35e-6).contains(&four[0]), "{four:?}");
    for [early, late] in [paper, four] {
        assert!((0.98..1.02).contains(&(late / early)), "{early:e} {late:e}");
    }
}
